/* Finds the positions of a pair's points that do not lie on two axes. */
#include "base/memory.h"
#include "interpret/curvilinear/curvilinear.h"
#include "terms/frame.h"

#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void fg__curvilinear_destroy(fg__curvilinear *mesh)
{
  free(mesh);
}

/* Sets the variable's dimensions in the plane, its time and level. */
static bool set_part(fg__curvilinear_part *part, const fg__dataset *data,
                     const fg__variable *variable)
{
  int position[FG__ROLES];
  part->variable = variable;
  part->grid.dimension = 2;
  if (fg__roles_find(position, data, variable) >= 0 || position[FG__ROLE_X] < 0 ||
      position[FG__ROLE_Y] < 0)
    return false;
  for (int k = 0; k < 2; ++k) {
    fg__grid_axis *axis = &part->grid.axis[k];
    axis->position = position[k];
    axis->dimension = variable->dimension[position[k]];
    axis->size = data->dimensions[axis->dimension].length;
    if (axis->size < 2)
      return false;
  }
  part->grid.samples = part->grid.axis[0].size * part->grid.axis[1].size;
  part->grid.time = position[FG__ROLE_TIME];
  part->grid.level = position[FG__ROLE_LEVEL];
  return true;
}

/* Finds longitude and latitude of a part's dimensions: two-dimensional, or one along
 * each. */
static void find_positions(fg__curvilinear_part *part, const fg__dataset *data)
{
  const fg__variable *u = part->variable;
  const fg__variable *x = fg__plane_coordinate(&part->grid, data, u, FG__ROLE_X);
  const fg__variable *y = fg__plane_coordinate(&part->grid, data, u, FG__ROLE_Y);
  if (x && y && fg__lies_on(data, x, &part->grid, u) &&
      fg__lies_on(data, y, &part->grid, u)) {
    part->longitude = x;
    part->latitude = y;
    return;
  }
  x = fg__coordinate(data, u, part->grid.axis[0].position);
  y = fg__coordinate(data, u, part->grid.axis[1].position);
  if (x && y && x->geographic == FG__ROLE_X && y->geographic == FG__ROLE_Y) {
    part->longitude = x;
    part->latitude = y;
  }
}

/* Whether a part has the dimensions; those of another file may have their names. Not so
 * in the files of components where these are two: there each has the positions of its own
 * faces (NEMO). */
static bool has_dimensions(const fg__curvilinear *mesh, const fg__dataset *data,
                           const fg__curvilinear_part *part, const int dimension[2])
{
  const bool by_name = mesh->part[0].variable->file == mesh->part[1].variable->file ||
                       part->variable->file >= data->component_files;
  for (int k = 0; k < 2; ++k) {
    const int own = part->grid.axis[k].dimension;
    if (own != dimension[k] && !(by_name && fg__alike_dimension(data, own, dimension[k])))
      return false;
  }
  return true;
}

static bool names_centres(const fg__variable *v)
{
  const size_t length = strlen(v->plain_name);
  return length > 4 && strcmp(v->plain_name + length - 4, "_rho") == 0;
}

/* Finds longitudes of the centres: on the dimension that each component has across its
 * own direction, or (ROMS, whose components have other dimensions) on dimensions of these
 * sizes. */
static bool find_centres(fg__curvilinear *mesh, const fg__dataset *data)
{
  const int dimension[2] = {mesh->part[1].grid.axis[0].dimension,
                            mesh->part[0].grid.axis[1].dimension};
  for (int strict = 1; strict >= 0; --strict)
    for (size_t i = 0; i < data->variable_count; ++i) {
      const fg__variable *v = &data->variables[i];
      fg__curvilinear_part part = {0};
      if (v->rank < 2 || v->rank > 3 || !fg__is_array(v) || v->geographic != FG__ROLE_X ||
          !set_part(&part, data, v))
        continue;
      if (strict ? !has_dimensions(mesh, data, &part, dimension)
                 : part.grid.axis[0].size != mesh->size[0] ||
                       part.grid.axis[1].size != mesh->size[1] || !names_centres(v))
        continue;
      part.longitude = v;
      part.latitude = fg__plane_coordinate(&part.grid, data, v, FG__ROLE_Y);
      if (!part.latitude || !fg__lies_on(data, part.latitude, &part.grid, v))
        continue;
      mesh->centre = part;
      return true;
    }
  return false;
}

/* For a grid staggered along axes: each component has the centres' coordinate across its
 * own direction. */
static bool find_centre_lines(fg__curvilinear *mesh, const fg__dataset *data)
{
  const fg__curvilinear_part *u = &mesh->part[0], *v = &mesh->part[1];
  const fg__variable *x = fg__coordinate(data, v->variable, v->grid.axis[0].position);
  const fg__variable *y = fg__coordinate(data, u->variable, u->grid.axis[1].position);
  if (!x || !y || x->geographic != FG__ROLE_X || y->geographic != FG__ROLE_Y)
    return false;
  mesh->centre = *u;
  mesh->centre.grid.axis[0] = v->grid.axis[0];
  mesh->centre.longitude = x;
  mesh->centre.latitude = y;
  return true;
}

static bool is_same_place(const fg__curvilinear_part *a, const fg__curvilinear_part *b)
{
  return a->grid.axis[0].dimension == b->grid.axis[0].dimension &&
         a->grid.axis[1].dimension == b->grid.axis[1].dimension &&
         a->longitude == b->longitude && a->latitude == b->latitude;
}

/* Whether components have the same times, or the same levels. */
static bool runs_alike(const fg__dataset *data, const fg__curvilinear_part *u, int of_u,
                       const fg__curvilinear_part *v, int of_v)
{
  if (of_u < 0 || of_v < 0)
    return of_u == of_v;
  const int a = u->variable->dimension[of_u], b = v->variable->dimension[of_v];
  const fg__dimension *of = data->dimensions;
  if (a == b || of[a].length != of[b].length)
    return a == b;
  return u->variable->file == v->variable->file ? strcmp(of[a].name, of[b].name) == 0
                                                : fg__named_alike(of[a].name, of[b].name);
}

static bool fits(const fg__curvilinear *mesh)
{
  for (int k = 0; k < 2; ++k) {
    const size_t own = mesh->part[k].grid.axis[k].size, centres = mesh->size[k];
    const size_t across = mesh->part[k].grid.axis[1 - k].size;
    if (own + 1 < centres || own > centres + 1 || across != mesh->size[1 - k])
      return false;
  }
  return mesh->size[0] < INT_MAX / 4 / mesh->size[1];
}

bool fg__curvilinear_parts(fg__curvilinear *mesh, const fg__dataset *data,
                           const fg__pair *pair)
{
  const fg__curvilinear_part *u = &mesh->part[0], *v = &mesh->part[1];
  for (int k = 0; k < 2; ++k)
    if (!set_part(&mesh->part[k], data, pair->component[k]))
      return false;
  mesh->size[0] = v->grid.axis[0].size;
  mesh->size[1] = u->grid.axis[1].size;
  return fits(mesh) && runs_alike(data, u, u->grid.time, v, v->grid.time) &&
         runs_alike(data, u, u->grid.level, v, v->grid.level);
}

/* Finds a variable on the centres that is 0 on land, where models write no fill
 * values. */
static void find_mask(fg__curvilinear *mesh, const fg__dataset *data)
{
  const fg__curvilinear_part *at = &mesh->at;
  for (int n = 0; fg__mask_names[n] && !mesh->mask; ++n) {
    const fg__variable *v = fg__dataset_find(data, fg__mask_names[n]);
    if (v && strcmp(v->plain_name, fg__mask_names[n]) == 0 &&
        fg__lies_on(data, v, &at->grid, at->variable))
      mesh->mask = v;
  }
}

static void check_storage(fg__grid *grid, const fg__dataset *data,
                          const fg__curvilinear *mesh)
{
  const fg__curvilinear_part *parts[] = {&mesh->part[0], &mesh->part[1], &mesh->centre};
  for (int n = 0; n < 3; ++n) {
    fg__grid one = {.samples = parts[n]->grid.samples};
    if (!parts[n]->variable)
      continue;
    fg__check_storage(&one, data, n < 2 ? parts[n]->variable : parts[n]->longitude);
    if (parts[n]->longitude && parts[n]->longitude->rank > 1) {
      fg__check_storage(&one, data, parts[n]->longitude);
      fg__check_storage(&one, data, parts[n]->latitude);
    }
    if (one.unusable[0])
      snprintf(grid->unusable, sizeof grid->unusable, "%s", one.unusable);
  }
}

/* Whether components on the same dimensions have positions of their own, those of their
 * faces. Of other positions on these dimensions nothing says that they are the
 * centres'. */
static bool have_own_positions(const fg__curvilinear_part *u,
                               const fg__curvilinear_part *v)
{
  return u->grid.axis[0].dimension == v->grid.axis[0].dimension &&
         u->grid.axis[1].dimension == v->grid.axis[1].dimension && u->longitude &&
         v->longitude && u->longitude != v->longitude;
}

static fg_status find_shift(bool *found, fg__curvilinear *mesh, const fg__dataset *data)
{
  *found = true;
  if (is_same_place(&mesh->part[0], &mesh->part[1]) && mesh->part[0].longitude)
    return FG_STATUS_OK; /* not staggered */
  if (have_own_positions(&mesh->part[0], &mesh->part[1]))
    return fg__shift_find(found, mesh, data);
  if (!find_centres(mesh, data) && !find_centre_lines(mesh, data) &&
      (!mesh->part[0].longitude || !mesh->part[1].longitude)) {
    *found = false;
    return FG_STATUS_OK;
  }
  return fg__shift_find(found, mesh, data);
}

/* Of components on one point a file may have positions of several (TLONG and ULONG). */
static fg_status check_others(fg__grid *grid, const fg__dataset *data,
                              const fg__curvilinear *mesh)
{
  const fg__curvilinear_part *at = &mesh->part[0];
  if (!at->longitude || !is_same_place(at, &mesh->part[1]))
    return FG_STATUS_OK;
  return fg__check_other_places(grid, data, at->variable,
                                (const fg__variable *[]){at->longitude, at->latitude});
}

static fg_status recognise(fg__curvilinear *mesh, fg__grid *grid, const fg__dataset *data,
                           const fg__pair *pair, fg_frame frame, bool *found)
{
  *found = false;
  mesh->polar = pair->polar;
  if (!fg__curvilinear_parts(mesh, data, pair))
    return FG_STATUS_OK;
  for (int k = 0; k < 2; ++k)
    find_positions(&mesh->part[k], data);
  fg__grid storage = {0};
  check_storage(&storage, data, mesh);
  if (storage.unusable[0])
    return FG_STATUS_OK;
  fg_status status = find_shift(found, mesh, data);
  if (status == FG_STATUS_OK && mesh->apart)
    fg__refuse_apart(grid, pair);
  if (status != FG_STATUS_OK || !*found)
    return status;
  mesh->at = mesh->centre.variable ? mesh->centre : mesh->part[0];
  if (mesh->at.grid.axis[0].size != mesh->size[0])
    mesh->at.grid.axis[0] = mesh->part[1].grid.axis[0];
  grid->unusable[0] = grid->hint[0] = '\0';
  check_storage(grid, data, mesh);
  status = check_others(grid, data, mesh);
  find_mask(mesh, data);
  fg__check_frame(grid, pair, frame);
  if (status == FG_STATUS_OK && !fg__frame_find(mesh, data, pair, frame)) {
    fg__set_unusable(grid->unusable,
                     "nothing says whether '%.60s' and '%.60s' point east and north or "
                     "along the grid",
                     pair->component[0]->plain_name, pair->component[1]->plain_name);
    snprintf(grid->hint, sizeof grid->hint,
             "--frame east or --frame grid says so; --scale plain reads it on its index "
             "grid");
  }
  return status;
}

fg_status fg__curvilinear_find(fg__grid *grid, const fg__dataset *data,
                               const fg__pair *pair, const fg_read_options *options)
{
  if (options->scale != FG_SCALE_AUTO && options->scale != FG_SCALE_GEO)
    return FG_STATUS_OK;
  fg__curvilinear *mesh = fg__allocate(1, sizeof *mesh);
  if (!mesh)
    return fg__fail_memory(data->context, "a mesh", sizeof *mesh);
  bool found;
  const fg_status status = recognise(mesh, grid, data, pair, options->frame, &found);
  if (status != FG_STATUS_OK || !found) {
    fg__curvilinear_destroy(mesh);
    return status;
  }
  grid->mesh = mesh;
  grid->scale = FG_SCALE_GEO;
  grid->dimension = 2;
  grid->samples = mesh->size[0] * mesh->size[1];
  return FG_STATUS_OK;
}
