/* Samples of a component at one time and level: unpacked, with missing values found (CF
 * conventions, chapters 2.5 and 8.1). */
#include "base/memory.h"
#include "interpret/interpret.h"

#include <float.h>
#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

/* Values in a block: 32 megabytes as double hold whole chunks of common files; without
 * chunks, as many as stay in a core's cache. */
static const size_t BLOCK_VALUES = (size_t)1 << 22, PLAIN_BLOCK_VALUES = (size_t)1 << 16;

typedef struct slab {
  size_t start[FG__RANK], count[FG__RANK];
  int outer, inner; /* positions of the two axes, in the file's order */
  const fg__grid_axis *outer_axis, *inner_axis;
  size_t outer_step, inner_step; /* strides in the field's array */
} slab;

static slab slab_of(const fg__variable *v, const fg__grid *grid,
                    const int position[FG__ROLES], size_t time, size_t level)
{
  slab s = {.count = {0}};
  for (int k = 0; k < v->rank; ++k)
    s.count[k] = 1;
  if (position[FG__ROLE_TIME] >= 0)
    s.start[position[FG__ROLE_TIME]] = time;
  if (position[FG__ROLE_LEVEL] >= 0)
    s.start[position[FG__ROLE_LEVEL]] = level;
  const int first = position[FG__ROLE_X] < position[FG__ROLE_Y] ? FG__ROLE_X : FG__ROLE_Y;
  s.outer = position[first];
  s.inner = position[1 - first];
  s.outer_axis = &grid->axis[first];
  s.inner_axis = &grid->axis[1 - first];
  s.outer_step = first == FG__ROLE_X ? 1 : grid->axis[0].size;
  s.inner_step = first == FG__ROLE_X ? grid->axis[0].size : 1;
  s.start[s.inner] = s.inner_axis->first;
  s.count[s.inner] = s.inner_axis->size;
  return s;
}

static size_t place(const fg__grid_axis *axis, size_t i)
{
  return axis->reversed ? axis->size - 1 - i : i;
}

static size_t next_place(size_t at, ptrdiff_t step)
{
  return (size_t)((ptrdiff_t)at + step);
}

/* Where a variable's numbers go: into one of three arrays. */
typedef struct sink {
  fg__packing packing;
  fg__missing_counts *missing;
  float *velocity;
  double *number;
  unsigned char *mask; /* 1 where they are above 0 */
} sink;

/* Puts a row of stored samples to places `step` apart from `first` on; a reversed axis
 * has a negative step. */
static void put(const sink *target, size_t first, ptrdiff_t step, const double *stored,
                size_t count)
{
  fg__missing_counts ignored = {0};
  const sink to = *target;
  fg__missing_counts *missing = to.missing ? to.missing : &ignored;
  for (size_t i = 0, at = first; i < count; ++i, at = next_place(at, step)) {
    const double value = fg__unpack(&to.packing, stored[i], missing);
    if (to.number)
      to.number[at] = value;
    else if (to.mask)
      to.mask[at] = value > 0.0; /* false for NaN */
    /* finite, but larger than float: still larger than any accepted speed */
    else if (!isinf(stored[i]) && fabs(value) > (double)FLT_MAX)
      to.velocity[at] = value > 0.0 ? FLT_MAX : -FLT_MAX;
    else
      to.velocity[at] = (float)value;
  }
}

static size_t values_at_once(const fg__variable *v)
{
  return v->in_one_run ? PLAIN_BLOCK_VALUES : BLOCK_VALUES;
}

static fg_status read_slab(slab s, const fg__dataset *data, const fg__variable *v,
                           const sink *target)
{
  const size_t row = s.inner_axis->size;
  const size_t rows = s.outer_axis->size;
  const ptrdiff_t step =
      s.inner_axis->reversed ? -(ptrdiff_t)s.inner_step : (ptrdiff_t)s.inner_step;
  size_t at_once = values_at_once(v) / row;
  at_once = at_once < 1 ? 1 : at_once > rows ? rows : at_once;
  double *block = fg__allocate(at_once * row, sizeof *block);
  if (!block)
    return fg__fail_memory(data->context, "samples", at_once * row * sizeof *block);
  fg_status status = FG_STATUS_OK;
  for (size_t first = 0; first < rows && status == FG_STATUS_OK; first += at_once) {
    const size_t count = rows - first < at_once ? rows - first : at_once;
    s.start[s.outer] = s.outer_axis->first + first;
    s.count[s.outer] = count;
    status = fg__variable_fetch(v, s.start, s.count, block);
    for (size_t j = 0; j < count && status == FG_STATUS_OK; ++j)
      put(target,
          place(s.outer_axis, first + j) * s.outer_step +
              place(s.inner_axis, 0) * s.inner_step,
          step, block + j * row, row);
    if (status == FG_STATUS_OK)
      status = fg__check_stop(data->context);
  }
  free(block);
  return status;
}

fg_status fg__read_values(float *out, fg__missing_counts *missing,
                          const fg__dataset *data, const fg__variable *variable,
                          const fg__grid *grid, size_t time, size_t level)
{
  const int position[FG__ROLES] = {grid->axis[0].position, grid->axis[1].position,
                                   grid->time, grid->level};
  const sink to = {
      .packing = fg__packing_of(variable), .missing = missing, .velocity = out};
  return read_slab(slab_of(variable, grid, position, time, level), data, variable, &to);
}

/* The variable's dimension that corresponds to one of the component's, or -1. */
static int matching(const fg__dataset *data, const fg__variable *v, int dimension)
{
  const fg__dimension *wanted = &data->dimensions[dimension];
  for (int k = 0; k < v->rank; ++k) {
    const fg__dimension *own = &data->dimensions[v->dimension[k]];
    if (v->dimension[k] == dimension ||
        (strcmp(own->name, wanted->name) == 0 && own->length == wanted->length))
      return k;
  }
  return -1;
}

/* Finds the positions of a component's grid dimensions among a variable's; false where it
 * lacks one of the plane's or has others. */
static bool find_places(int position[FG__ROLES], const fg__dataset *data,
                        const fg__variable *v, const fg__grid *grid,
                        const fg__variable *component)
{
  bool placed = true;
  for (int role = 0; role < FG__ROLES; ++role)
    position[role] = -1;
  for (int k = 0; k < 2; ++k)
    position[k] = matching(data, v, grid->axis[k].dimension);
  if (grid->time >= 0)
    position[FG__ROLE_TIME] = matching(data, v, component->dimension[grid->time]);
  if (grid->level >= 0)
    position[FG__ROLE_LEVEL] = matching(data, v, component->dimension[grid->level]);
  for (int k = 0; k < v->rank; ++k) {
    bool known = data->dimensions[v->dimension[k]].length == 1;
    for (int role = 0; role < FG__ROLES; ++role)
      known = known || position[role] == k;
    placed = placed && known;
  }
  return placed && position[FG__ROLE_X] >= 0 && position[FG__ROLE_Y] >= 0 &&
         position[FG__ROLE_X] != position[FG__ROLE_Y];
}

bool fg__is_array(const fg__variable *v)
{
  return v->rank >= 1 && v->rank <= FG__RANK && fg__is_number(v);
}

bool fg__lies_on(const fg__dataset *data, const fg__variable *v, const fg__grid *grid,
                 const fg__variable *component)
{
  int position[FG__ROLES];
  return fg__is_array(v) && v->rank >= 2 &&
         find_places(position, data, v, grid, component);
}

fg_status fg__read_mask(unsigned char *out, const fg__dataset *data,
                        const fg__variable *variable, const fg__grid *grid,
                        const fg__variable *component, size_t time, size_t level)
{
  if (variable->rank < 2 || !fg__is_array(variable))
    return fg__fail(data->context, FG_STATUS_ARGUMENT,
                    "%s: the mask '%s' is no array of numbers", variable->path,
                    variable->name);
  int position[FG__ROLES];
  if (!find_places(position, data, variable, grid, component))
    return fg__fail(data->context, FG_STATUS_ARGUMENT,
                    "%s: the mask '%s' does not lie on the grid of '%s'", variable->path,
                    variable->name, component->name);
  const sink to = {.packing = fg__packing_of(variable), .mask = out};
  return read_slab(slab_of(variable, grid, position, time, level), data, variable, &to);
}

fg_status fg__read_doubles(double *out, const fg__dataset *data,
                           const fg__variable *variable, const fg__grid *grid,
                           const fg__variable *component, size_t time, size_t level)
{
  int position[FG__ROLES];
  if (!fg__is_array(variable) || !find_places(position, data, variable, grid, component))
    return fg__fail(data->context, FG_STATUS_FILE_FORMAT,
                    "%s: '%s' does not lie on the grid of '%s'", variable->path,
                    variable->name, component->name);
  const sink to = {.packing = fg__packing_of(variable), .number = out};
  return read_slab(slab_of(variable, grid, position, time, level), data, variable, &to);
}

fg_status fg__read_all(double *out, const fg__dataset *data, const fg__variable *variable)
{
  const sink to = {.packing = fg__packing_of(variable), .number = out};
  size_t start[FG__RANK] = {0}, size[FG__RANK], count = 1;
  for (int k = 0; k < variable->rank; ++k) {
    size[k] = data->dimensions[variable->dimension[k]].length;
    count *= size[k];
  }
  const fg_status status = fg__variable_fetch(variable, start, size, out);
  if (status == FG_STATUS_OK)
    put(&to, 0, 1, out, count);
  return status;
}
