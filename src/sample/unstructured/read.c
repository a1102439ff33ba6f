/* Fields of unstructured meshes: vectors and a mask read, cells made, on the sphere or in
 * the plane. */
#include "base/memory.h"
#include "field/refused.h"
#include "interpret/projector.h"
#include "sample/cells/set.h"
#include "sample/globe.h"
#include "sample/layers.h"
#include "sample/missing.h"
#include "sample/points/points.h"
#include "sample/unstructured/mesh.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Memory that a vector and the cells round it take on the way to a sphere. */
static const double BYTES_PER_VECTOR = 200.0;

enum { FEW_FACES = 16 }; /* of fewer one may be half as wide as all */

typedef fg__mesh_request request;

static fg_status find_words(request *r)
{
  const fg_status status =
      fg__vector_words_find(&r->words, r->data, r->pair, r->grid, r->options);
  r->texts = fg__vector_texts(&r->words, r->pair, r->grid);
  return status;
}

static fg_status read_values(float **out, const request *r, const fg__variable *v,
                             const fg__grid *grid, bool is_mask)
{
  fg__missing_counts missing = {0};
  const size_t time = (size_t)r->options->time, level = (size_t)r->options->level;
  *out = fg__allocate(grid->samples, sizeof **out);
  if (!*out)
    return fg__fail_memory(r->data->context, "the velocity", grid->samples * 4);
  const fg_status status = fg__read_values(
      *out, &missing, r->data, v, grid, grid->time >= 0 && time < grid->times ? time : 0,
      grid->level >= 0 && level < grid->levels ? level : 0);
  return status == FG_STATUS_OK && !is_mask && !r->counts_only
             ? fg__check_any(v, &missing, grid->samples)
             : status;
}

fg_status fg__mesh_mask_find(const fg__variable **out, fg__grid *grid,
                             const fg__dataset *data, const fg__pair *pair,
                             const fg__unstructured *mesh, const char *name)
{
  const fg__variable *v = *out = name ? fg__dataset_find(data, name) : mesh->wet;
  *grid = (fg__grid){0};
  if (!v && name)
    return fg__fail(data->context, FG_STATUS_ARGUMENT,
                    "%s: has no variable '%s' for the mask", data->file[0].path, name);
  if (v && (!fg__is_array(v) || v->rank >= FG__RANK ||
            !fg__unstructured_axis(grid, data, v, mesh)))
    return fg__fail(data->context, FG_STATUS_ARGUMENT,
                    "%s: the mask '%s' does not lie on the mesh of '%s'", v->path,
                    v->name, pair->component[0]->name);
  return FG_STATUS_OK;
}

/* Takes out vectors where a mask is 0, or 1 where that means land, or missing. */
static fg_status apply_mask(float *velocity, const request *r)
{
  const fg__unstructured *mesh = r->grid->unstructured;
  const fg__variable *v;
  fg__grid grid;
  float *mask = NULL;
  const fg_status found =
      fg__mesh_mask_find(&v, &grid, r->data, r->pair, mesh, r->options->mask);
  if (found != FG_STATUS_OK || !v)
    return found;
  const bool wet = v == mesh->wet && mesh->wet_is_zero;
  const fg_status status = read_values(&mask, r, v, &grid, true);
  for (size_t n = 0; n < grid.samples && status == FG_STATUS_OK; ++n)
    if (!(wet ? mask[n] <= 0.0f : mask[n] > 0.0f))
      velocity[n] = NAN;
  free(mask);
  return status;
}

/* Turns vectors along a mesh's rows to east and north. */
static fg_status turn_vectors(float *const velocity[2], const request *r)
{
  const fg__unstructured *mesh = r->grid->unstructured;
  double *turn[2] = {NULL, NULL};
  if (!mesh->turn[0])
    return FG_STATUS_OK;
  const fg_status status =
      fg__positions_of(turn, r->data, mesh, mesh->turn, r->grid->samples, 2);
  for (size_t n = 0; n < r->grid->samples && status == FG_STATUS_OK; ++n) {
    const double u = (double)velocity[0][n], v = (double)velocity[1][n];
    velocity[0][n] = (float)(u * turn[0][n] - v * turn[1][n]);
    velocity[1][n] = (float)(u * turn[1][n] + v * turn[0][n]);
  }
  free(turn[0]);
  free(turn[1]);
  return status;
}

static fg_status read_vectors(float *velocity[2], const request *r)
{
  const fg__grid *grid = r->grid;
  fg_status status = fg__check_memory(r->data->context, r->data->file[0].path,
                                      (double)grid->samples, BYTES_PER_VECTOR);
  if (status == FG_STATUS_OK)
    status = read_values(&velocity[0], r, r->pair->component[0], grid, false);
  if (status == FG_STATUS_OK)
    status = read_values(&velocity[1], r, r->pair->component[1],
                         &grid->unstructured->of_v, false);
  if (status == FG_STATUS_OK)
    status = apply_mask(velocity[0], r);
  const fg__raw_samples raw =
      fg__raw_samples_of(r->data, r->pair, 2, velocity, grid->samples);
  if (status == FG_STATUS_OK)
    status = fg__missing_settle(r->data->context, &raw, &r->data->missing);
  if (status == FG_STATUS_OK)
    status =
        fg__polar_turn_all(r->data->context, velocity, grid->samples, &r->pair->polar,
                           r->data->file[0].path, r->pair->component[1]->plain_name);
  if (status == FG_STATUS_OK)
    status = turn_vectors(velocity, r);
  if (status != FG_STATUS_OK || r->counts_only)
    return status;
  return fg__refuse_missing_codes(r->data->context, r->data->file[0].path, velocity,
                                  grid->samples);
}

/* In a plane that repeats itself faces across its seam are as wide as all of it: they are
 * left out. */
static void drop_wide_faces(float *velocity, const fg__mesh_topology *faces)
{
  double low[2] = {HUGE_VAL, HUGE_VAL}, high[2] = {-HUGE_VAL, -HUGE_VAL};
  for (int k = 0; k < 2; ++k)
    for (size_t n = 0; n < faces->nodes; ++n) {
      low[k] = fmin(low[k], faces->at[k][n]);
      high[k] = fmax(high[k], faces->at[k][n]);
    }
  for (size_t f = 0; f < faces->count && faces->count >= FEW_FACES; ++f)
    for (int k = 0; k < 2; ++k) {
      double least = HUGE_VAL, largest = -HUGE_VAL;
      for (int c = faces->first[f]; c < faces->first[f + 1]; ++c) {
        least = fmin(least, faces->at[k][faces->node[c]]);
        largest = fmax(largest, faces->at[k][faces->node[c]]);
      }
      if (largest - least > 0.5 * (high[k] - low[k]))
        velocity[f] = NAN;
    }
}

static size_t missing_of(float *const velocity[2], size_t count)
{
  size_t missing = 0;
  for (size_t n = 0; n < count; ++n)
    missing += !isfinite(velocity[0][n]) || !isfinite(velocity[1][n]);
  return missing;
}

static fg_status check_count(const request *r, size_t count)
{
  if (count == r->grid->samples)
    return FG_STATUS_OK;
  return fg__fail(r->data->context, FG_STATUS_FILE_FORMAT,
                  "%s: '%s' has %zu vectors, but its mesh has %zu places for them",
                  r->data->file[0].path, r->pair->component[0]->name, r->grid->samples,
                  count);
}

/* Points and cells; to be freed even after a failure. */
static fg_status make_cells(fg__sphere_cells *out, size_t *missing, const request *r)
{
  const fg__unstructured *mesh = r->grid->unstructured;
  const bool nodes = mesh->location == FG__MESH_ON_NODES;
  float *velocity[2] = {NULL, NULL};
  fg__mesh_topology faces = {0};
  fg_status status = read_vectors(velocity, r);
  if (status == FG_STATUS_OK)
    status = fg__mesh_topology_read(&faces, r->data, mesh);
  if (status == FG_STATUS_OK)
    status = check_count(r, nodes ? faces.nodes : faces.count);
  if (status == FG_STATUS_OK) {
    if (mesh->in_plane && !nodes)
      drop_wide_faces(velocity[0], &faces);
    fg__fill_poles(&faces, mesh->poles, velocity);
    *missing = missing_of(velocity, r->grid->samples);
    status = nodes ? fg__cells_of_nodes(out, r->data->context, &faces, velocity)
                   : fg__cells_of_faces(out, r->data->context, &faces, velocity,
                                        !mesh->in_plane);
  }
  if (status == FG_STATUS_OK && out->count == 0)
    status = fg__fail(r->data->context, FG_STATUS_FILE_FORMAT,
                      "%s: none of the mesh's %zu faces has three corners and a value of "
                      "'%s'",
                      r->data->file[0].path, faces.count, r->pair->component[0]->name);
  fg__mesh_topology_clear(&faces);
  free(velocity[0]);
  free(velocity[1]);
  return status;
}

static bool is_on_points(const request *r)
{
  return r->grid->unstructured->location == FG__MESH_ON_POINTS;
}

static fg_status make_sphere(fg__sphere **out, fg__scatter_between *between,
                             size_t *missing, const request *r)
{
  fg__sphere_cells cells = {0};
  if (is_on_points(r))
    return fg__points_sphere(out, between, missing, r);
  fg_status status = make_cells(&cells, missing, r);
  cells.words = &r->texts;
  if (status == FG_STATUS_OK)
    return fg__sphere_of_cells(out, r->data->context, &cells);
  fg__sphere_cells_clear(&cells);
  return status;
}

/* Cells in the plane, whose places are in longitude and latitude's stead. */
static fg_status add_cells(fg__cell_set *set, const fg__sphere_cells *cells)
{
  fg_status status = FG_STATUS_OK;
  set->position = fg__allocate(3 * cells->points, sizeof *set->position);
  if (!set->position)
    return fg__fail_memory(set->context, "points", 3 * cells->points * 8);
  set->points = cells->points;
  set->numbers = cells->count;
  for (size_t n = 0; n < cells->points; ++n) {
    set->position[3 * n] = cells->longitude[n];
    set->position[3 * n + 1] = cells->latitude[n];
  }
  for (size_t n = 0; n < cells->count && status == FG_STATUS_OK; ++n) {
    const int *corner = cells->corner + 4 * n;
    status = fg__cell_set_add_points(
        set, corner[3] < 0 ? FG__CELL_TRIANGLE : FG__CELL_QUAD, corner, (int)n);
  }
  return status;
}

/* FVCOM has a PROJ string as an attribute of its file, "proj=utm +ellps=WGS84 +zone=19",
 * or words that are none. */
static void find_model_projection(fg__grid *plane, const fg__variable *at)
{
  char text[FG__TEXT_BYTES], projection[FG__TEXT_BYTES + 1];
  const fg__variable *root = fg__file_of(at);
  if (!fg__attribute_text(root, "CoordinateProjection", text, sizeof text) ||
      strncmp(text, "proj=", 5) != 0)
    return;
  snprintf(projection, sizeof projection, "+%s", text);
  const fg__projector *by = at->owner->projector;
  fg__map *map = NULL;
  if (!by || by->create(&map, NULL, projection) != FG_STATUS_OK)
    return;
  snprintf(plane->projection, sizeof plane->projection, "%s", by->projection(map));
  by->destroy(map);
}

/* The axes' words and what the file says of its projection. */
static fg_status name_axes(fg__grid *plane, fg_field_arrays *texts, const request *r)
{
  const fg__unstructured *mesh = r->grid->unstructured;
  const fg__variable *const *at = mesh->node[0] ? mesh->node : mesh->centre;
  *plane = *r->grid;
  for (int k = 0; k < r->grid->dimension; ++k) {
    fg__grid_axis *axis = &plane->axis[k];
    axis->dimension = mesh->dimension;
    axis->quantity = fg__units_of(at[k], axis->units, sizeof axis->units);
    texts->axis_name[k] = at[k]->plain_name;
    texts->axis_units[k] = axis->units;
  }
  const bool lengths = plane->axis[0].quantity == FG__QUANTITY_LENGTH &&
                       plane->axis[1].quantity == FG__QUANTITY_LENGTH &&
                       strcmp(plane->axis[0].units, plane->axis[1].units) == 0;
  texts->scale = r->grid->scale;
  if (r->options->scale == FG_SCALE_AUTO && !lengths)
    texts->scale = FG_SCALE_PLAIN;
  if (texts->scale != FG_SCALE_MAP || !lengths)
    return FG_STATUS_OK;
  fg_status status = fg__projection_find(plane, r->data, r->pair->component[0]);
  if (status == FG_STATUS_OK && !plane->projection[0])
    status = fg__projection_find(plane, r->data, at[0]);
  if (status == FG_STATUS_OK && !plane->projection[0])
    find_model_projection(plane, at[0]);
  if (plane->projection[0])
    texts->projection = plane->projection;
  return status;
}

static fg_status sample_cells(fg__point_grid *out, const request *r,
                              const fg__sphere_cells *cells)
{
  fg__cell_set set = {
      .context = r->data->context, .path = r->data->file[0].path, .region = r->region};
  fg_status status = add_cells(&set, cells);
  if (status == FG_STATUS_OK)
    status = fg__cell_set_locate(&set);
  if (status == FG_STATUS_OK)
    status =
        fg__point_grid_sample(out, &set, (float *const[2]){cells->east, cells->north});
  fg__cell_set_clear(&set);
  return status;
}

static fg_status plane_field(fg_field **out, fg__scatter_between *between,
                             size_t *missing, const request *r, fg__slab_index slab)
{
  fg__grid plane;
  fg_field_arrays texts = r->texts;
  fg__sphere_cells cells = {0};
  fg__point_grid grid = {0};
  request part = *r;
  fg_status status = name_axes(&plane, &texts, r);
  if (status != FG_STATUS_OK)
    return status;
  if (texts.scale != FG_SCALE_MAP || !texts.projection)
    part.region = r->data->region;
  if (is_on_points(r))
    return fg__points_field(out, between, missing, &part, &texts, slab);
  status = make_cells(&cells, missing, r);
  if (status == FG_STATUS_OK)
    status = sample_cells(&grid, &part, &cells);
  if (status == FG_STATUS_OK)
    status = fg__point_grid_field(out, r->data->context, &grid, &texts, slab);
  fg__point_grid_clear(&grid);
  fg__sphere_cells_clear(&cells);
  return status;
}

/* Points that are a grid's after all are read as that. */
static fg_status grid_of_points(fg_field **out, fg__scatter_between *between,
                                size_t *missing, const request *r, fg__slab_index slab)
{
  fg_field_arrays texts = r->texts;
  texts.scale = FG_SCALE_GEO;
  for (int k = 0; k < 2; ++k) {
    texts.axis_name[k] = k == 0 ? "longitude" : "latitude";
    texts.axis_units[k] = k == 0 ? "°E" : "°N";
  }
  return fg__points_field(out, between, missing, r, &texts, slab);
}

static fg_status make_field(fg_field **out, fg__scatter_between *between, size_t *missing,
                            const request *r, fg__slab_index slab)
{
  fg__sphere *sphere = NULL;
  if (r->grid->unstructured->in_plane)
    return plane_field(out, between, missing, r, slab);
  if (is_on_points(r))
    return grid_of_points(out, between, missing, r, slab);
  fg_status status = make_sphere(&sphere, between, missing, r);
  if (status == FG_STATUS_OK)
    status = fg__globe_field(out, r->data->context, sphere, slab);
  fg__sphere_destroy(sphere);
  return status;
}

fg_status fg__unstructured_sphere(fg__sphere **sphere, const fg__dataset *data,
                                  const fg__pair *pair, const fg__grid *grid,
                                  const fg_read_options *options)
{
  request r = {.data = data, .pair = pair, .grid = grid, .options = options};
  fg__scatter_between between;
  size_t missing;
  *sphere = NULL;
  const fg_status status = find_words(&r);
  return status == FG_STATUS_OK && !grid->unstructured->in_plane
             ? make_sphere(sphere, &between, &missing, &r)
             : status;
}

fg_status fg__unstructured_field(fg_field **out, const fg__dataset *data,
                                 const fg__pair *pair, const fg__grid *grid,
                                 const fg_read_options *options, fg__slab_index slab)
{
  request r = {.data = data, .pair = pair, .grid = grid, .options = options};
  fg__scatter_between between;
  size_t missing;
  const fg_status status = find_words(&r);
  return status == FG_STATUS_OK ? make_field(out, &between, &missing, &r, slab) : status;
}

static double missing_of_field(const fg_field *field)
{
  const fg_field_arrays *a = fg_field_contents(field);
  size_t samples = 1, missing = 0;
  for (int k = 0; k < a->dimension; ++k)
    samples *= (size_t)a->size[k];
  for (size_t n = 0; n < samples && a->valid; ++n)
    missing += !a->valid[n];
  return (double)missing / (double)samples;
}

/* What points become between which nothing is known. */
static void describe_points(fg_inventory_vector *vector, fg__unstructured *mesh,
                            const fg__scatter_between *between, const fg_field *field)
{
  const fg_field_arrays *plane = field ? fg_field_contents(field) : NULL;
  size_t used = strlen(mesh->rule);
  if (plane && plane->dimension == 2 && mesh->node[2] && plane->level)
    snprintf(mesh->rule + used, sizeof mesh->rule - used, "; in the plane %.80s",
             plane->level);
  used = strlen(mesh->rule);
  vector->cells = between->cells;
  vector->points = between->points;
  if (between->gaps > 0 && between->cells == 0)
    snprintf(mesh->rule + used, sizeof mesh->rule - used,
             ", a grid with gaps in %zu intervals", between->gaps);
  else if (between->gaps > 0)
    snprintf(mesh->rule + used, sizeof mesh->rule - used,
             ", triangulated; %zu triangles across gaps left out", between->gaps);
  else if (between->cells > 0)
    snprintf(mesh->rule + used, sizeof mesh->rule - used, ", triangulated");
  else if (between->points == 0 && !strchr(mesh->rule, ';'))
    vector->frame = NULL; /* on a grid after all */
}

fg_status fg__unstructured_describe(fg_inventory_vector *vector, const fg__dataset *data,
                                    const fg__pair *pair, const fg__grid *grid)
{
  const fg_read_options first = fg__first_samples(pair, grid);
  request r = {
      .data = data, .pair = pair, .grid = grid, .options = &first, .counts_only = true};
  fg__sphere *sphere = NULL;
  fg_field *field = NULL;
  fg__scatter_between between = {0};
  size_t missing = 0;
  fg_status status = find_words(&r);
  vector->frame = grid->unstructured->rule;
  vector->cells = grid->samples;
  if (status == FG_STATUS_OK && !grid->unstructured->in_plane)
    status = make_sphere(&sphere, &between, &missing, &r);
  if (status == FG_STATUS_OK && !sphere)
    status = make_field(&field, &between, &missing, &r, (fg__slab_index){0, 1});
  if (status == FG_STATUS_OK && is_on_points(&r))
    describe_points(vector, grid->unstructured, &between, field);
  if (status == FG_STATUS_OK && sphere) {
    fg__sphere_extent extent;
    fg__sphere_extent_of(&extent, sphere);
    fg__globe_describe(vector, &extent);
  } else if (status == FG_STATUS_OK) {
    fg__describe_field(vector, grid->unstructured->axis_name, field);
  }
  vector->missing_share = (double)missing / (double)grid->samples;
  if (field && is_on_points(&r))
    vector->missing_share = missing_of_field(field);
  if (status == FG_STATUS_FILE_FORMAT && missing == grid->samples) {
    fg_context_clear(data->context); /* nothing at the first time; others may have */
    status = FG_STATUS_OK;
  }
  fg__sphere_destroy(sphere);
  fg_field_destroy(field);
  return status;
}
