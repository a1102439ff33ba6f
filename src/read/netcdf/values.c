/* Samples of a component at one time and level: unpacked, with missing values found (CF
 * conventions, chapters 2.5 and 8.1). */
#include "base/memory.h"
#include "read/netcdf/netcdf.h"

#include <float.h>
#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

/* Values in a block: 32 megabytes as double hold whole chunks of common files; without
 * chunks, as many as stay in a core's cache. */
static const size_t BLOCK_VALUES = (size_t)1 << 22, PLAIN_BLOCK_VALUES = (size_t)1 << 16;

enum { MOST_FILLS = 16 };

typedef struct packing {
  double scale, offset;
  double fill[MOST_FILLS]; /* in stored values */
  int fills;
  double least, largest; /* valid range */
  bool range_unpacked;   /* the range is of unpacked values, not of stored ones */
  double wrap;           /* added to negative values of _Unsigned data, or 0 */
} packing;

/* The fill value of libnetcdf for values that were never written; types of one byte have
 * none. */
static bool default_fill(nc_type type, double *fill)
{
  switch (type) {
  case NC_SHORT:
    *fill = NC_FILL_SHORT;
    return true;
  case NC_INT:
    *fill = NC_FILL_INT;
    return true;
  case NC_FLOAT:
    *fill = (double)NC_FILL_FLOAT;
    return true;
  case NC_DOUBLE:
    *fill = NC_FILL_DOUBLE;
    return true;
  case NC_USHORT:
    *fill = NC_FILL_USHORT;
    return true;
  case NC_UINT:
    *fill = NC_FILL_UINT;
    return true;
  case NC_INT64:
    *fill = (double)NC_FILL_INT64;
    return true;
  case NC_UINT64:
    *fill = (double)NC_FILL_UINT64;
    return true;
  default:
    return false;
  }
}

static double round_to_type(double value, nc_type type)
{
  return type == NC_FLOAT && fabs(value) <= (double)FLT_MAX ? (double)(float)value
                                                            : value;
}

static void find_fills(packing *p, const fg__nc_variable *v)
{
  nc_type type;
  p->fills = fg__nc_numbers(v, "_FillValue", p->fill, 1, &type);
  if (p->fills == 0)
    p->fills = default_fill(v->type, p->fill);
  p->fills += fg__nc_numbers(v, "missing_value", p->fill + p->fills,
                             MOST_FILLS - p->fills, &type);
  for (int i = 0; i < p->fills; ++i)
    p->fill[i] = round_to_type(p->fill[i], v->type);
}

static bool is_floating(nc_type type)
{
  return type == NC_FLOAT || type == NC_DOUBLE;
}

static void find_range(packing *p, const fg__nc_variable *v, bool packed)
{
  double range[2];
  nc_type type = NC_NAT;
  p->least = -HUGE_VAL;
  p->largest = HUGE_VAL;
  if (fg__nc_numbers(v, "valid_range", range, 2, &type) == 2) {
    p->least = range[0];
    p->largest = range[1];
  } else {
    fg__nc_numbers(v, "valid_min", &p->least, 1, &type);
    fg__nc_numbers(v, "valid_max", &p->largest, 1, &type);
  }
  /* NUG, appendix A: a range of the unpacked type is of the unpacked values */
  p->range_unpacked = packed && is_floating(type) && !is_floating(v->type);
  if (!p->range_unpacked) {
    p->least = round_to_type(p->least, v->type);
    p->largest = round_to_type(p->largest, v->type);
  }
  if (!(p->least <= p->largest)) { /* an empty range is a mistake and ignored */
    p->least = -HUGE_VAL;
    p->largest = HUGE_VAL;
  }
}

static void find_unsigned(packing *p, const fg__nc_variable *v)
{
  char text[FG__NC_TEXT];
  if (!fg__nc_text(v, "_Unsigned", text, sizeof text) || strcasecmp(text, "true") != 0)
    return;
  p->wrap = v->type == NC_BYTE    ? 256.0
            : v->type == NC_SHORT ? 65536.0
            : v->type == NC_INT   ? 4294967296.0
                                  : 0.0;
  for (int i = 0; i < p->fills; ++i)
    if (p->fill[i] < 0.0)
      p->fill[i] += p->wrap;
  if (p->wrap > 0.0 && !p->range_unpacked) {
    p->least += p->least < 0.0 ? p->wrap : 0.0;
    p->largest += p->largest < 0.0 ? p->wrap : 0.0;
  }
}

static packing find_packing(const fg__nc_variable *v)
{
  packing p = {.scale = 1.0, .offset = 0.0};
  nc_type type;
  const int scaled = fg__nc_numbers(v, "scale_factor", &p.scale, 1, &type);
  const int moved = fg__nc_numbers(v, "add_offset", &p.offset, 1, &type);
  find_fills(&p, v);
  find_range(&p, v, scaled + moved > 0);
  find_unsigned(&p, v);
  return p;
}

/* The value of a stored number, NaN when it is missing. */
static double unpack(const packing *p, double stored, fg__nc_missing *missing)
{
  if (isnan(stored)) {
    ++missing->not_a_number;
    return stored;
  }
  if (stored < 0.0)
    stored += p->wrap;
  for (int i = 0; i < p->fills; ++i)
    if (stored == p->fill[i]) {
      ++missing->fill;
      return (double)NAN;
    }
  const double value = stored * p->scale + p->offset;
  const double ranged = p->range_unpacked ? value : stored;
  if (ranged < p->least || ranged > p->largest) {
    ++missing->range;
    return (double)NAN;
  }
  return value;
}

typedef struct slab {
  size_t start[FG__NC_RANK], count[FG__NC_RANK];
  int outer, inner; /* positions of the two axes, in the file's order */
  const fg__nc_axis *outer_axis, *inner_axis;
  size_t outer_step, inner_step; /* strides in the field's array */
} slab;

static slab slab_of(const fg__nc_variable *v, const fg__nc_grid *grid,
                    const int position[FG__NC_ROLES], size_t time, size_t level)
{
  slab s = {.count = {0}};
  for (int k = 0; k < v->rank; ++k)
    s.count[k] = 1;
  if (position[FG__NC_TIME] >= 0)
    s.start[position[FG__NC_TIME]] = time;
  if (position[FG__NC_LEVEL] >= 0)
    s.start[position[FG__NC_LEVEL]] = level;
  const int first = position[FG__NC_X] < position[FG__NC_Y] ? FG__NC_X : FG__NC_Y;
  s.outer = position[first];
  s.inner = position[1 - first];
  s.outer_axis = &grid->axis[first];
  s.inner_axis = &grid->axis[1 - first];
  s.outer_step = first == FG__NC_X ? 1 : grid->axis[0].size;
  s.inner_step = first == FG__NC_X ? grid->axis[0].size : 1;
  s.start[s.inner] = s.inner_axis->first;
  s.count[s.inner] = s.inner_axis->size;
  return s;
}

static size_t place(const fg__nc_axis *axis, size_t i)
{
  return axis->reversed ? axis->size - 1 - i : i;
}

static size_t next_place(size_t at, ptrdiff_t step)
{
  return (size_t)((ptrdiff_t)at + step);
}

/* Receives a row of stored samples, for places `step` apart from `first` on; a reversed
 * axis has a negative step. */
typedef void sink(void *target, size_t first, ptrdiff_t step, const double *stored,
                  size_t count);

static size_t values_at_once(const fg__nc_variable *v)
{
  int storage = NC_CHUNKED;
  const bool known = nc_inq_var_chunking(v->group, v->id, &storage, NULL) == NC_NOERR;
  return known && storage == NC_CONTIGUOUS ? PLAIN_BLOCK_VALUES : BLOCK_VALUES;
}

static fg_status read_slab(slab s, const fg__nc_file *file, const fg__nc_variable *v,
                           sink *put, void *target)
{
  if (file->exhausted)
    return FG_STATUS_MEMORY;
  const size_t row = s.inner_axis->size;
  const size_t rows = s.outer_axis->size;
  const ptrdiff_t step =
      s.inner_axis->reversed ? -(ptrdiff_t)s.inner_step : (ptrdiff_t)s.inner_step;
  size_t at_once = values_at_once(v) / row;
  at_once = at_once < 1 ? 1 : at_once > rows ? rows : at_once;
  double *block = fg__allocate(at_once * row, sizeof *block);
  if (!block)
    return fg__fail_memory(file->context, "samples", at_once * row * sizeof *block);
  fg_status status = FG_STATUS_OK;
  for (size_t first = 0; first < rows && status == FG_STATUS_OK; first += at_once) {
    const size_t count = rows - first < at_once ? rows - first : at_once;
    s.start[s.outer] = s.outer_axis->first + first;
    s.count[s.outer] = count;
    const int error = fg__nc_fetch(v, s.start, s.count, block);
    if (error)
      status = fg__nc_fail(file->context, v->path, v->name, error);
    for (size_t j = 0; j < count && status == FG_STATUS_OK; ++j)
      put(target,
          place(s.outer_axis, first + j) * s.outer_step +
              place(s.inner_axis, 0) * s.inner_step,
          step, block + j * row, row);
    if (status == FG_STATUS_OK)
      status = fg__check_stop(file->context);
  }
  free(block);
  return status;
}

typedef struct value_sink {
  const packing *packing;
  fg__nc_missing *missing;
  float *out;
} value_sink;

static void put_values(void *target, size_t first, ptrdiff_t step, const double *stored,
                       size_t count)
{
  const value_sink *to = target;
  const packing p = *to->packing;
  for (size_t i = 0, at = first; i < count; ++i, at = next_place(at, step)) {
    const double value = unpack(&p, stored[i], to->missing);
    /* finite, but larger than float: still larger than any accepted speed */
    if (!isinf(stored[i]) && fabs(value) > (double)FLT_MAX)
      to->out[at] = value > 0.0 ? FLT_MAX : -FLT_MAX;
    else
      to->out[at] = (float)value;
  }
}

fg_status fg__nc_values(float *out, fg__nc_missing *missing, const fg__nc_file *file,
                        const fg__nc_variable *variable, const fg__nc_grid *grid,
                        size_t time, size_t level)
{
  const packing p = find_packing(variable);
  const int position[FG__NC_ROLES] = {grid->axis[0].position, grid->axis[1].position,
                                      grid->time, grid->level};
  value_sink to = {&p, missing, out};
  const slab s = slab_of(variable, grid, position, time, level);
  return read_slab(s, file, variable, put_values, &to);
}

typedef struct mask_sink {
  const packing *packing;
  unsigned char *out;
} mask_sink;

static void put_mask(void *target, size_t first, ptrdiff_t step, const double *stored,
                     size_t count)
{
  const mask_sink *to = target;
  fg__nc_missing ignored = {0};
  for (size_t i = 0, at = first; i < count; ++i, at = next_place(at, step))
    to->out[at] = unpack(to->packing, stored[i], &ignored) > 0.0; /* false for NaN */
}

typedef struct number_sink {
  const packing *packing;
  double *out;
} number_sink;

static void put_numbers(void *target, size_t first, ptrdiff_t step, const double *stored,
                        size_t count)
{
  const number_sink *to = target;
  const packing p = *to->packing;
  fg__nc_missing ignored = {0};
  for (size_t i = 0, at = first; i < count; ++i, at = next_place(at, step))
    to->out[at] = unpack(&p, stored[i], &ignored);
}

/* The variable's dimension that corresponds to one of the component's, or -1. */
static int matching(const fg__nc_file *file, const fg__nc_variable *v, int dimension)
{
  const fg__nc_dimension *wanted = &file->dimensions[dimension];
  for (int k = 0; k < v->rank; ++k) {
    const fg__nc_dimension *own = &file->dimensions[v->dimension[k]];
    if (v->dimension[k] == dimension ||
        (strcmp(own->name, wanted->name) == 0 && own->length == wanted->length))
      return k;
  }
  return -1;
}

/* Finds the positions of a component's grid dimensions among a variable's; false where it
 * lacks one of the plane's or has others. */
static bool find_places(int position[FG__NC_ROLES], const fg__nc_file *file,
                        const fg__nc_variable *v, const fg__nc_grid *grid,
                        const fg__nc_variable *component)
{
  bool placed = true;
  for (int role = 0; role < FG__NC_ROLES; ++role)
    position[role] = -1;
  for (int k = 0; k < 2; ++k)
    position[k] = matching(file, v, grid->axis[k].dimension);
  if (grid->time >= 0)
    position[FG__NC_TIME] = matching(file, v, component->dimension[grid->time]);
  if (grid->level >= 0)
    position[FG__NC_LEVEL] = matching(file, v, component->dimension[grid->level]);
  for (int k = 0; k < v->rank; ++k) {
    bool known = file->dimensions[v->dimension[k]].length == 1;
    for (int role = 0; role < FG__NC_ROLES; ++role)
      known = known || position[role] == k;
    placed = placed && known;
  }
  return placed && position[FG__NC_X] >= 0 && position[FG__NC_Y] >= 0 &&
         position[FG__NC_X] != position[FG__NC_Y];
}

bool fg__nc_is_array(const fg__nc_variable *v)
{
  return v->rank >= 1 && v->rank <= FG__NC_RANK && v->type >= NC_BYTE &&
         v->type <= NC_UINT64 && v->type != NC_CHAR;
}

bool fg__nc_lies_on(const fg__nc_file *file, const fg__nc_variable *v,
                    const fg__nc_grid *grid, const fg__nc_variable *component)
{
  int position[FG__NC_ROLES];
  return fg__nc_is_array(v) && v->rank >= 2 &&
         find_places(position, file, v, grid, component);
}

fg_status fg__nc_mask(unsigned char *out, const fg__nc_file *file,
                      const fg__nc_variable *variable, const fg__nc_grid *grid,
                      const fg__nc_variable *component, size_t time, size_t level)
{
  if (variable->rank < 2 || !fg__nc_is_array(variable))
    return fg__fail(file->context, FG_STATUS_ARGUMENT,
                    "%s: the mask '%s' is no array of numbers", variable->path,
                    variable->name);
  int position[FG__NC_ROLES];
  if (!find_places(position, file, variable, grid, component))
    return fg__fail(file->context, FG_STATUS_ARGUMENT,
                    "%s: the mask '%s' does not lie on the grid of '%s'", variable->path,
                    variable->name, component->name);
  const packing p = find_packing(variable);
  mask_sink to = {&p, out};
  const slab s = slab_of(variable, grid, position, time, level);
  return read_slab(s, file, variable, put_mask, &to);
}

fg_status fg__nc_doubles(double *out, const fg__nc_file *file,
                         const fg__nc_variable *variable, const fg__nc_grid *grid,
                         const fg__nc_variable *component, size_t time, size_t level)
{
  int position[FG__NC_ROLES];
  if (!fg__nc_is_array(variable) ||
      !find_places(position, file, variable, grid, component))
    return fg__fail(file->context, FG_STATUS_FILE_FORMAT,
                    "%s: '%s' does not lie on the grid of '%s'", variable->path,
                    variable->name, component->name);
  const packing p = find_packing(variable);
  number_sink to = {&p, out};
  const slab s = slab_of(variable, grid, position, time, level);
  return read_slab(s, file, variable, put_numbers, &to);
}

fg_status fg__nc_line(double *out, const fg__nc_file *file,
                      const fg__nc_variable *variable)
{
  const packing p = find_packing(variable);
  size_t start[FG__NC_RANK] = {0}, size[FG__NC_RANK], count = 1;
  for (int k = 0; k < variable->rank; ++k) {
    size[k] = file->dimensions[variable->dimension[k]].length;
    count *= size[k];
  }
  if (file->exhausted)
    return FG_STATUS_MEMORY;
  const int error = fg__nc_fetch(variable, start, size, out);
  if (error)
    return fg__nc_fail(file->context, variable->path, variable->name, error);
  number_sink to = {&p, out};
  put_numbers(&to, 0, 1, out, count);
  return FG_STATUS_OK;
}
