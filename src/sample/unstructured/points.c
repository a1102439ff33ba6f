/* Fields of points without a mesh: their places, vectors and what takes vectors out. */
#include "base/memory.h"
#include "sample/missing.h"
#include "sample/unstructured/mesh.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Numbers of a variable at all places, at the time and level that are read. */
static fg_status read_places(double *out, const fg__mesh_request *r,
                             const fg__variable *v, const fg__grid *grid,
                             fg__missing_counts *missing)
{
  const fg__unstructured *mesh = r->grid->unstructured;
  const fg__packing packing = fg__packing_of(v);
  size_t start[FG__RANK] = {0}, count[FG__RANK];
  for (int k = 0; k < v->rank; ++k) {
    const bool along = fg__along_places(r->data, mesh, v, k);
    count[k] = along ? r->data->dimensions[v->dimension[k]].length : 1;
    if (k == grid->time && (size_t)r->options->time < grid->times)
      start[k] = (size_t)r->options->time;
    if (k == grid->level && (size_t)r->options->level < grid->levels)
      start[k] = (size_t)r->options->level;
  }
  const fg_status status = fg__variable_fetch(v, start, count, out);
  for (size_t n = 0; n < grid->samples && status == FG_STATUS_OK; ++n)
    out[n] = fg__unpack(&packing, out[n], missing);
  return status;
}

/* Speeds and directions become components; a calm needs no direction. */
static fg_status turn_polar(double *const velocity[3], const fg__mesh_request *r)
{
  const fg__polar *polar = &r->pair->polar;
  const fg__variable *direction = r->pair->component[1];
  fg__angles angles = {0};
  const bool turns = polar->sense != 0 && velocity[0] && velocity[1];
  for (size_t n = 0; n < r->grid->samples && turns; ++n) {
    double one[2] = {velocity[0][n], velocity[1][n]};
    if (one[0] == 0.0)
      one[1] = 0.0;
    fg__angles_add(&angles, one[1]);
    fg__polar_turn(one, polar);
    velocity[0][n] = one[0];
    velocity[1][n] = one[1];
  }
  return polar->sense == 0 ? FG_STATUS_OK
                           : fg__angles_check(&angles, r->data->context, polar,
                                              direction->path, direction->name);
}

static fg_status read_velocity(double *velocity[3], const fg__mesh_request *r,
                               int dimension)
{
  fg_status status = FG_STATUS_OK;
  for (int k = 0; k < dimension && status == FG_STATUS_OK; ++k) {
    const fg__variable *v = r->pair->component[k];
    const fg__grid *grid = k == 1 ? &r->grid->unstructured->of_v : r->grid;
    fg__missing_counts missing = {0};
    velocity[k] = fg__allocate(r->grid->samples, sizeof **velocity);
    status = velocity[k] ? read_places(velocity[k], r, v, grid, &missing)
                         : fg__fail_memory(r->data->context, "the velocity",
                                           r->grid->samples * sizeof **velocity);
    if (status == FG_STATUS_OK && !r->counts_only)
      status = fg__check_any(v, &missing, r->grid->samples);
  }
  return status;
}

/* The vectors in single precision, without codes for missing values. */
static fg_status settle(fg__scatter *out, double *const velocity[3],
                        const unsigned char *valid, const fg__mesh_request *r)
{
  fg__raw_samples raw = fg__raw_samples_of(r->data, r->pair, out->dimension,
                                           out->velocity, r->grid->samples);
  raw.valid = valid;
  for (int k = 0; k < out->dimension && k < 3 && velocity[k]; ++k)
    for (size_t n = 0; n < raw.count; ++n)
      out->velocity[k][n] = fg__as_velocity(velocity[k][n]);
  fg_status status = fg__missing_settle(r->data->context, &raw, &r->data->missing);
  for (int k = 0; k < 2 && r->pair->polar.sense != 0 && velocity[k]; ++k)
    for (size_t n = 0; n < raw.count; ++n)
      velocity[k][n] = isnan(out->velocity[k][n]) ? (double)NAN : velocity[k][n];
  if (status == FG_STATUS_OK)
    status = turn_polar(velocity, r);
  for (int k = 0; k < 2 && r->pair->polar.sense != 0 && velocity[k]; ++k)
    for (size_t n = 0; n < raw.count; ++n)
      out->velocity[k][n] = fg__as_velocity(velocity[k][n]);
  return status;
}

/* Takes out points where a mask that the options name, or that the file has for its mesh,
 * is 0. */
static fg_status apply_mask(unsigned char *valid, double *mask, const fg__mesh_request *r)
{
  const fg__unstructured *mesh = r->grid->unstructured;
  const fg__variable *v;
  fg__grid grid;
  fg__missing_counts missing = {0};
  const fg_status found =
      fg__mesh_mask_find(&v, &grid, r->data, r->pair, mesh, r->options->mask);
  if (found != FG_STATUS_OK || !v)
    return found;
  const bool dry = v == mesh->wet && mesh->wet_is_zero;
  const fg_status status = read_places(mask, r, v, &grid, &missing);
  for (size_t n = 0; n < grid.samples && status == FG_STATUS_OK; ++n)
    if (!(dry ? mask[n] <= 0.0 : mask[n] > 0.0))
      valid[n] = 0;
  return status;
}

/* Takes out points of other times or levels than are read. */
static fg_status keep_one(unsigned char *kept, double *value, const fg__mesh_request *r,
                          const fg__row_axis *axis, int wanted)
{
  if (!axis->value || wanted < 0 || (size_t)wanted >= axis->count)
    return FG_STATUS_OK;
  const fg_status status =
      fg__row_values(value, r->data, axis->variable, r->grid->samples);
  for (size_t n = 0; n < r->grid->samples && status == FG_STATUS_OK; ++n)
    kept[n] =
        kept[n] && value[n] >= axis->value[wanted] && value[n] <= axis->value[wanted];
  return status;
}

/* Which points have a vector, and which are read at all. */
static fg_status find_flags(unsigned char *valid, unsigned char *kept,
                            const fg__mesh_request *r)
{
  const fg__unstructured *mesh = r->grid->unstructured;
  double *value = fg__allocate(r->grid->samples, sizeof *value);
  fg_status status =
      value ? fg__rows_hide(valid, r->data, mesh, r->grid->samples)
            : fg__fail_memory(r->data->context, "rows", r->grid->samples * sizeof *value);
  if (status == FG_STATUS_OK)
    status = apply_mask(valid, value, r);
  if (status == FG_STATUS_OK)
    status = keep_one(kept, value, r, &mesh->rows_time, r->options->time);
  if (status == FG_STATUS_OK && r->grid->dimension == 2)
    status = keep_one(kept, value, r, &mesh->rows_level, r->options->level);
  free(value);
  return status;
}

/* Moves the points that have a place, and are read, together. */
static void gather(fg__scatter *out, size_t *missing, const unsigned char *valid,
                   const unsigned char *kept, const fg__mesh_request *r)
{
  const fg__unstructured *mesh = r->grid->unstructured;
  const bool one_number =
      out->geographic && !r->data->dimensions[mesh->dimension].is_nameless;
  const size_t count = out->count;
  *missing = 0;
  out->count = 0;
  for (size_t n = 0; n < count; ++n) {
    bool placed = kept[n], known = valid[n];
    for (int k = 0; k < out->dimension; ++k) {
      placed = placed && !isnan(out->position[k][n]);
      known = known && isfinite(out->velocity[k][n]);
    }
    *missing += kept[n] && !known;
    if (!placed)
      continue;
    const size_t to = out->count++;
    for (int k = 0; k < out->dimension; ++k) {
      out->position[k][to] = out->position[k][n];
      out->velocity[k][to] = valid[n] ? out->velocity[k][n] : NAN;
    }
    if (one_number)
      out->position[0][to] = remainder(out->position[0][to], 360.0);
    out->record[to] = (int)fg__variable_record(mesh->node[0], n);
  }
}

static fg_status read_positions(fg__scatter *out, const fg__mesh_request *r)
{
  const fg__unstructured *mesh = r->grid->unstructured;
  const size_t count = r->grid->samples;
  fg_status status =
      fg__positions_of(out->position, r->data, mesh, mesh->node, count, out->dimension);
  for (int k = 0; k < out->dimension && status == FG_STATUS_OK; ++k) {
    out->velocity[k] = fg__allocate(count, sizeof *out->velocity[k]);
    if (!out->velocity[k])
      status = fg__fail_memory(r->data->context, "the velocity", count * 4);
  }
  out->record = fg__allocate(count, sizeof *out->record);
  if (status == FG_STATUS_OK && !out->record)
    status = fg__fail_memory(r->data->context, "points", count * sizeof *out->record);
  return status;
}

/* The points of a vector; to be cleared even after a failure. */
static fg_status make_scatter(fg__scatter *out, size_t *missing,
                              const fg__mesh_request *r)
{
  const fg__unstructured *mesh = r->grid->unstructured;
  const size_t count = r->grid->samples;
  const fg__decoder *decoder = r->data->file[mesh->node[0]->file].decoder;
  double *velocity[3] = {NULL, NULL, NULL};
  unsigned char *valid = fg__allocate(2 * count, 1), *kept = valid ? valid + count : NULL;
  *out = (fg__scatter){.context = r->data->context,
                       .path = r->data->file[0].path,
                       .count = count,
                       .dimension = fg__places_dimension(mesh, r->pair),
                       .records = decoder->records ? decoder->records : "point"};
  out->region = r->region;
  out->geographic = !mesh->in_plane && out->dimension == 2;
  fg_status status = valid ? read_velocity(velocity, r, out->dimension)
                           : fg__fail_memory(r->data->context, "points", 2 * count);
  if (valid)
    memset(valid, 1, 2 * count);
  if (status == FG_STATUS_OK)
    status = read_positions(out, r);
  if (status == FG_STATUS_OK)
    status = find_flags(valid, kept, r);
  if (status == FG_STATUS_OK)
    status = settle(out, velocity, valid, r);
  if (status == FG_STATUS_OK)
    gather(out, missing, valid, kept, r);
  for (int k = 0; k < 3; ++k)
    free(velocity[k]);
  free(valid);
  return status;
}

fg_status fg__points_sphere(fg__sphere **sphere, fg__scatter_between *between,
                            size_t *missing, const fg__mesh_request *r)
{
  fg__scatter points = {0};
  fg_status status = make_scatter(&points, missing, r);
  if (status == FG_STATUS_OK)
    status = fg__scatter_sphere(sphere, between, &points, &r->texts);
  fg__scatter_clear(&points);
  return status;
}

fg_status fg__points_field(fg_field **out, fg__scatter_between *between, size_t *missing,
                           const fg__mesh_request *r, const fg_field_arrays *texts,
                           fg__slab_index slab)
{
  fg__scatter points = {0};
  fg_status status = make_scatter(&points, missing, r);
  if (status == FG_STATUS_OK)
    status = fg__scatter_field(out, between, &points, texts, slab);
  fg__scatter_clear(&points);
  return status;
}
