/* From arrays to a field: on axes, or of points. */
#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "base/memory.h"
#include "read/npy/npy.h"

/* How a component's samples lie in its array. */
typedef struct layout {
  const fg__npy_array *array;
  size_t offset, stride[3];
} layout;

typedef struct plan {
  fg__npy_file *file;
  const fg__npy_choice *choice;
  int dimension;
  size_t size[3], samples; /* 1 beyond the dimension */
  layout velocity[3], position[3], mask;
  bool has_places, at_axes; /* places along axes, or one for each sample */
} plan;

static fg_status fail_shape(const plan *p, const fg__npy_array *a, const char *unlike)
{
  char shape[128] = "";
  size_t used = 0;
  for (int k = 0; k < a->rank && k < FG__NPY_RANK; ++k)
    used += (size_t)snprintf(shape + used, sizeof shape - used, "%s%zu", k ? " x " : "",
                             a->shape[k]);
  return fg__fail(p->file->context, FG_STATUS_FILE_FORMAT,
                  "%s: array \"%s\" of %s numbers does not fit \"%s\" of %zu x %zu x %zu "
                  "samples along x, y and z",
                  p->file->path, a->name, used ? shape : "1", unlike, p->size[0],
                  p->size[1], p->size[2]);
}

/* The layout of an array whose axes from `first` on are z, y, x. */
static layout layout_of(const fg__npy_array *a, int first, int dimension)
{
  layout out = {.array = a};
  for (int k = 0; k < dimension && k < 3; ++k)
    out.stride[k] = a->stride[first + dimension - 1 - k];
  return out;
}

static void set_size(plan *p, const fg__npy_array *a, int first)
{
  p->size[0] = p->size[1] = p->size[2] = 1;
  for (int k = 0; k < p->dimension && k < 3; ++k)
    p->size[k] = a->shape[first + p->dimension - 1 - k];
  p->samples = p->size[0] * p->size[1] * p->size[2];
}

static bool has_shape(const plan *p, const fg__npy_array *a, int first)
{
  bool same = a->rank == first + p->dimension;
  for (int k = 0; k < p->dimension && k < 3 && same; ++k)
    same = a->shape[first + p->dimension - 1 - k] == p->size[k];
  return same;
}

/* One array of vectors: its components are along an axis, or the parts of complex
 * numbers. */
static void plan_vector(plan *p)
{
  const fg__npy_array *a = p->choice->velocity[0];
  const int axis = p->choice->component_axis, first = axis == 0 ? 1 : 0;
  set_size(p, a, first);
  for (int c = 0; c < p->dimension && c < 3; ++c) {
    p->velocity[c] = layout_of(a, first, p->dimension);
    p->velocity[c].offset = (size_t)c * (axis < 0 ? 1 : a->stride[axis]);
  }
}

/* Arrays by name: a line of points, a plane, a volume, or planes of several times. */
static fg_status plan_components(plan *p, const fg_read_options *options)
{
  const fg__npy_array *u = p->choice->velocity[0];
  const int first = u->rank > p->dimension ? u->rank - p->dimension : 0;
  fg_status status = FG_STATUS_OK;
  if (u->rank < p->dimension && u->rank != 1)
    p->dimension = u->rank;
  if (u->rank == 1) {
    p->size[0] = p->samples = u->shape[0];
    p->size[1] = p->size[2] = 1;
  } else if (first > 1 || u->rank == 0) {
    p->size[0] = p->size[1] = p->size[2] = 1;
    return fail_shape(p, u, "u");
  } else {
    set_size(p, u, first);
  }
  if (first == 0 ? options->time != 0 : (size_t)options->time >= u->shape[0])
    return fg__fail(p->file->context, FG_STATUS_ARGUMENT,
                    "%s: time %d is asked for, of %zu", p->file->path, options->time,
                    first ? u->shape[0] : (size_t)1);
  for (int c = 0; c < p->dimension && c < 3 && status == FG_STATUS_OK; ++c) {
    const fg__npy_array *a = p->choice->velocity[c];
    bool fits = a->rank == u->rank && a->count == u->count;
    for (int k = 0; k < a->rank && k < FG__NPY_RANK && fits; ++k)
      fits = a->shape[k] == u->shape[k];
    if (!fits)
      return fail_shape(p, a, u->name);
    p->velocity[c] = u->rank == 1 ? (layout){a, 0, {a->stride[0], 0, 0}}
                                  : layout_of(a, first, p->dimension);
    if (first == 1)
      p->velocity[c].offset = (size_t)options->time * a->stride[0];
  }
  return status;
}

/* A table of points: x, y, u, v in each row. */
static void plan_rows(plan *p)
{
  const fg__npy_array *a = p->choice->velocity[0];
  p->size[0] = p->samples = a->shape[0];
  p->size[1] = p->size[2] = 1;
  p->has_places = true;
  for (int c = 0; c < p->dimension && c < 3; ++c) {
    const layout row = {a, 0, {a->stride[0], 0, 0}};
    p->position[c] = p->velocity[c] = row;
    p->position[c].offset = (size_t)c * a->stride[1];
    p->velocity[c].offset = (size_t)(c + p->dimension) * a->stride[1];
  }
}

static void swap(size_t *a, size_t *b)
{
  const size_t kept = *a;
  *a = *b;
  *b = kept;
}

/* Samples stored with y fastest, as their axes' lengths tell. */
static void turn_where_transposed(plan *p)
{
  const fg__npy_array *x = p->choice->position[0], *y = p->choice->position[1];
  if (p->dimension != 2 || p->size[0] == p->size[1] || x->rank != 1 || y->rank != 1 ||
      x->count != p->size[1] || y->count != p->size[0])
    return;
  swap(&p->size[0], &p->size[1]);
  for (int c = 0; c < 2; ++c)
    swap(&p->velocity[c].stride[0], &p->velocity[c].stride[1]);
}

static fg_status plan_places(plan *p)
{
  fg__npy_array *const *position = p->choice->position;
  if (p->choice->table)
    return FG_STATUS_OK;
  if (p->dimension == 3 && !position[2] && position[0])
    return fg__fail(p->file->context, FG_STATUS_UNSUPPORTED,
                    "%s: x, but no z beside three components", p->file->path);
  p->has_places = position[0] && position[1];
  const bool points = p->choice->velocity[0]->rank == 1;
  if (!p->has_places)
    return points ? fg__fail(p->file->context, FG_STATUS_UNSUPPORTED,
                             "%s: \"%s\" has one dimension; such points need arrays x "
                             "and y",
                             p->file->path, p->choice->velocity[0]->name)
                  : FG_STATUS_OK;
  turn_where_transposed(p);
  p->at_axes = !points && position[0]->rank == 1;
  for (int k = 0; k < p->dimension && k < 3; ++k) {
    const fg__npy_array *a = position[k];
    if (a->kind == FG__NPY_COMPLEX || !a->name[0])
      return fail_shape(p, a, "u");
    if (points || p->at_axes) {
      if (a->rank != 1 || a->count != (points ? p->samples : p->size[k]))
        return fail_shape(p, a, p->choice->velocity[0]->name);
      p->position[k] = (layout){a, 0, {a->stride[0], 0, 0}};
    } else {
      if (!has_shape(p, a, 0))
        return fail_shape(p, a, p->choice->velocity[0]->name);
      p->position[k] = layout_of(a, 0, p->dimension);
    }
  }
  return FG_STATUS_OK;
}

static fg_status plan_mask(plan *p)
{
  const fg__npy_array *a = p->choice->mask;
  if (!a)
    return FG_STATUS_OK;
  if (p->choice->velocity[0]->rank == 1 || p->choice->table) {
    if (a->rank != 1 || a->count != p->samples)
      return fail_shape(p, a, p->choice->velocity[0]->name);
    p->mask = (layout){a, 0, {a->stride[0], 0, 0}};
    return FG_STATUS_OK;
  }
  if (!has_shape(p, a, 0))
    return fail_shape(p, a, p->choice->velocity[0]->name);
  p->mask = layout_of(a, 0, p->dimension);
  return FG_STATUS_OK;
}

static fg_status load(plan *p)
{
  const fg__npy_choice *c = p->choice;
  fg__npy_array *const needed[] = {c->velocity[0], c->velocity[1], c->velocity[2],
                                   c->position[0], c->position[1], c->position[2],
                                   c->mask};
  fg_status status = FG_STATUS_OK;
  for (size_t i = 0; i < sizeof needed / sizeof *needed && status == FG_STATUS_OK; ++i)
    if (needed[i])
      status = fg__npy_load(p->file, needed[i]);
  return status;
}

static double sample(const layout *l, size_t i, size_t j, size_t k)
{
  return fg__npy_value(l->array, l->offset + i * l->stride[0] + j * l->stride[1] +
                                     k * l->stride[2]);
}

static bool is_hidden(const plan *p, size_t i, size_t j, size_t k)
{
  if (!p->mask.array)
    return false;
  const double value = sample(&p->mask, i, j, k);
  return p->choice->mask_hides ? value != 0.0 : !(value > 0.0);
}

static fg_status read_velocity(float *out[3], const plan *p)
{
  for (int c = 0; c < p->dimension && c < 3; ++c) {
    float *to = out[c] = fg__allocate(p->samples, sizeof *to);
    if (!to)
      return fg__fail_memory(p->file->context, "a field's samples", p->samples * 4);
    for (size_t k = 0; k < p->size[2]; ++k)
      for (size_t j = 0; j < p->size[1]; ++j)
        for (size_t i = 0; i < p->size[0]; ++i)
          *to++ = is_hidden(p, i, j, k)
                      ? NAN
                      : fg__as_velocity(sample(&p->velocity[c], i, j, k));
  }
  return FG_STATUS_OK;
}

static fg_status make_grid(fg__point_grid *out, const plan *p)
{
  *out = (fg__point_grid){.dimension = p->dimension};
  for (int k = 0; k < p->dimension && k < 3; ++k) {
    if (p->size[k] < 2 || p->size[k] > INT_MAX)
      return fg__fail(p->file->context, FG_STATUS_UNSUPPORTED,
                      "%s: %zu samples along axis %d; a field needs two at least",
                      p->file->path, p->size[k], k + 1);
    out->size[k] = (int)p->size[k];
    out->axis[k] = fg__allocate(p->size[k], sizeof *out->axis[k]);
    if (!out->axis[k])
      return fg__fail_memory(p->file->context, "an axis", p->size[k] * 8);
    for (size_t i = 0; i < p->size[k]; ++i)
      out->axis[k][i] = p->has_places ? sample(&p->position[k], i, 0, 0) : (double)i;
  }
  return read_velocity(out->velocity, p);
}

/* Points without a place are left out. */
static fg_status make_points(fg__scatter *out, const plan *p)
{
  *out = (fg__scatter){.context = p->file->context,
                       .path = p->file->path,
                       .dimension = p->dimension,
                       .records = "point",
                       .geographic = p->choice->geographic && p->dimension == 2};
  fg_status status = read_velocity(out->velocity, p);
  for (int c = 0; c < p->dimension && c < 3 && status == FG_STATUS_OK; ++c) {
    out->position[c] = fg__allocate(p->samples, sizeof *out->position[c]);
    if (!out->position[c])
      status = fg__fail_memory(p->file->context, "points", p->samples * 8);
  }
  size_t from = 0;
  for (size_t k = 0; k < p->size[2] && status == FG_STATUS_OK; ++k)
    for (size_t j = 0; j < p->size[1]; ++j)
      for (size_t i = 0; i < p->size[0]; ++i, ++from) {
        bool placed = true;
        for (int c = 0; c < p->dimension && c < 3; ++c) {
          out->position[c][out->count] = sample(&p->position[c], i, j, k);
          out->velocity[c][out->count] = out->velocity[c][from];
          placed = placed && !isnan(out->position[c][out->count]);
        }
        out->count += placed;
      }
  return status;
}

static fg_field_arrays words_of(const plan *p, const fg_read_options *options)
{
  const fg__npy_choice *c = p->choice;
  fg_field_arrays words = {.scale = c->geographic && p->dimension == 2 ? FG_SCALE_GEO
                                    : options->scale == FG_SCALE_AUTO  ? FG_SCALE_PLAIN
                                                                       : options->scale};
  for (int k = 0; k < p->dimension && k < 3; ++k) {
    if (c->velocity[1])
      words.velocity_name[k] = c->velocity[k]->name;
    if (words.scale == FG_SCALE_GEO) {
      words.axis_name[k] = k == 0 ? "longitude" : "latitude";
      words.axis_units[k] = k == 0 ? "°E" : "°N";
    } else if (c->position[k]) {
      words.axis_name[k] = c->position[k]->name;
    }
  }
  return words;
}

fg_status fg__npy_field(fg_field **out, fg__scatter_between *between, fg__sphere **sphere,
                        fg__npy_file *file, const fg__npy_choice *choice,
                        const fg_read_options *options, fg__slab_index slab)
{
  plan p = {.file = file, .choice = choice, .dimension = choice->dimension};
  fg__point_grid grid = {0};
  fg__scatter points = {0};
  fg_status status = FG_STATUS_OK;
  *between = (fg__scatter_between){0};
  if (choice->table)
    plan_rows(&p);
  else if (choice->velocity[1])
    status = plan_components(&p, options);
  else
    plan_vector(&p);
  if (status == FG_STATUS_OK)
    status = plan_places(&p);
  if (status == FG_STATUS_OK)
    status = plan_mask(&p);
  if (status == FG_STATUS_OK)
    status = load(&p);
  if (status != FG_STATUS_OK)
    return status;
  const fg_field_arrays words = words_of(&p, options);
  if (p.at_axes || !p.has_places) {
    if (sphere)
      return FG_STATUS_OK;
    status = make_grid(&grid, &p);
    if (status == FG_STATUS_OK)
      status = fg__point_grid_straighten(&grid, file->context, file->path,
                                         words.scale == FG_SCALE_GEO);
    if (status == FG_STATUS_OK)
      status = fg__point_grid_field(out, file->context, &grid, &words, slab);
  } else if (!sphere || words.scale == FG_SCALE_GEO) {
    status = make_points(&points, &p);
    if (status == FG_STATUS_OK)
      status = sphere ? fg__scatter_sphere(sphere, &points, &words)
                      : fg__scatter_field(out, between, &points, &words, slab);
  }
  fg__point_grid_clear(&grid);
  fg__scatter_clear(&points);
  return status;
}
