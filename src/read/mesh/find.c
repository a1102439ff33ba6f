/* Finds the positions of a pair's points that do not lie on two axes. */
#include "base/memory.h"
#include "read/mesh/mesh.h"

#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

void fg__nc_mesh_destroy(fg__nc_mesh *mesh)
{
  free(mesh);
}

/* Sets the variable's dimensions in the plane, its time and level. */
static bool set_part(fg__nc_part *part, const fg__nc_file *file,
                     const fg__nc_variable *variable)
{
  int position[FG__NC_ROLES];
  part->variable = variable;
  part->grid.dimension = 2;
  if (fg__nc_roles(position, file, variable) >= 0 || position[FG__NC_X] < 0 ||
      position[FG__NC_Y] < 0)
    return false;
  for (int k = 0; k < 2; ++k) {
    fg__nc_axis *axis = &part->grid.axis[k];
    axis->position = position[k];
    axis->dimension = variable->dimension[position[k]];
    axis->size = file->dimensions[axis->dimension].length;
    if (axis->size < 2)
      return false;
  }
  part->grid.samples = part->grid.axis[0].size * part->grid.axis[1].size;
  part->grid.time = position[FG__NC_TIME];
  part->grid.level = position[FG__NC_LEVEL];
  return true;
}

/* Finds longitude and latitude of a part's dimensions: two-dimensional, or one along
 * each. */
static void find_positions(fg__nc_part *part, const fg__nc_file *file)
{
  const fg__nc_variable *u = part->variable;
  const fg__nc_variable *x = fg__nc_plane_coordinate(&part->grid, file, u, FG__NC_X);
  const fg__nc_variable *y = fg__nc_plane_coordinate(&part->grid, file, u, FG__NC_Y);
  if (x && y && fg__nc_lies_on(file, x, &part->grid, u) &&
      fg__nc_lies_on(file, y, &part->grid, u)) {
    part->longitude = x;
    part->latitude = y;
    return;
  }
  x = fg__nc_coordinate(file, u, part->grid.axis[0].position);
  y = fg__nc_coordinate(file, u, part->grid.axis[1].position);
  if (x && y && x->geographic == FG__NC_X && y->geographic == FG__NC_Y) {
    part->longitude = x;
    part->latitude = y;
  }
}

/* Whether a part has the dimensions; those of another file may have their names. Not so
 * in the files of components where these are two: there each has the positions of its own
 * faces (NEMO). */
static bool has_dimensions(const fg__nc_mesh *mesh, const fg__nc_file *file,
                           const fg__nc_part *part, const int dimension[2])
{
  const bool by_name = mesh->part[0].variable->file == mesh->part[1].variable->file ||
                       part->variable->file >= file->component_files;
  for (int k = 0; k < 2; ++k) {
    const int own = part->grid.axis[k].dimension;
    if (own != dimension[k] &&
        !(by_name && fg__nc_alike_dimension(file, own, dimension[k])))
      return false;
  }
  return true;
}

static bool names_centres(const fg__nc_variable *v)
{
  const size_t length = strlen(v->plain_name);
  return length > 4 && strcmp(v->plain_name + length - 4, "_rho") == 0;
}

/* Finds longitudes of the centres: on the dimension that each component has across its
 * own direction, or (ROMS, whose components have other dimensions) on dimensions of these
 * sizes. */
static bool find_centres(fg__nc_mesh *mesh, const fg__nc_file *file)
{
  const int dimension[2] = {mesh->part[1].grid.axis[0].dimension,
                            mesh->part[0].grid.axis[1].dimension};
  for (int strict = 1; strict >= 0; --strict)
    for (size_t i = 0; i < file->variable_count; ++i) {
      const fg__nc_variable *v = &file->variables[i];
      fg__nc_part part = {0};
      if (v->rank < 2 || v->rank > 3 || !fg__nc_is_array(v) ||
          v->geographic != FG__NC_X || !set_part(&part, file, v))
        continue;
      if (strict ? !has_dimensions(mesh, file, &part, dimension)
                 : part.grid.axis[0].size != mesh->size[0] ||
                       part.grid.axis[1].size != mesh->size[1] || !names_centres(v))
        continue;
      part.longitude = v;
      part.latitude = fg__nc_plane_coordinate(&part.grid, file, v, FG__NC_Y);
      if (!part.latitude || !fg__nc_lies_on(file, part.latitude, &part.grid, v))
        continue;
      mesh->centre = part;
      return true;
    }
  return false;
}

/* For a grid staggered along axes: each component has the centres' coordinate across its
 * own direction. */
static bool find_centre_lines(fg__nc_mesh *mesh, const fg__nc_file *file)
{
  const fg__nc_part *u = &mesh->part[0], *v = &mesh->part[1];
  const fg__nc_variable *x =
      fg__nc_coordinate(file, v->variable, v->grid.axis[0].position);
  const fg__nc_variable *y =
      fg__nc_coordinate(file, u->variable, u->grid.axis[1].position);
  if (!x || !y || x->geographic != FG__NC_X || y->geographic != FG__NC_Y)
    return false;
  mesh->centre = *u;
  mesh->centre.grid.axis[0] = v->grid.axis[0];
  mesh->centre.longitude = x;
  mesh->centre.latitude = y;
  return true;
}

static bool is_same_place(const fg__nc_part *a, const fg__nc_part *b)
{
  return a->grid.axis[0].dimension == b->grid.axis[0].dimension &&
         a->grid.axis[1].dimension == b->grid.axis[1].dimension &&
         a->longitude == b->longitude && a->latitude == b->latitude;
}

/* Whether components have the same times, or the same levels. */
static bool runs_alike(const fg__nc_file *file, const fg__nc_part *u, int of_u,
                       const fg__nc_part *v, int of_v)
{
  if (of_u < 0 || of_v < 0)
    return of_u == of_v;
  const int a = u->variable->dimension[of_u], b = v->variable->dimension[of_v];
  const fg__nc_dimension *of = file->dimensions;
  if (a == b || of[a].length != of[b].length)
    return a == b;
  return u->variable->file == v->variable->file
             ? strcmp(of[a].name, of[b].name) == 0
             : fg__nc_named_alike(of[a].name, of[b].name);
}

static bool fits(const fg__nc_mesh *mesh)
{
  for (int k = 0; k < 2; ++k) {
    const size_t own = mesh->part[k].grid.axis[k].size, centres = mesh->size[k];
    const size_t across = mesh->part[k].grid.axis[1 - k].size;
    if (own + 1 < centres || own > centres + 1 || across != mesh->size[1 - k])
      return false;
  }
  return mesh->size[0] < INT_MAX / 4 / mesh->size[1];
}

bool fg__nc_mesh_parts(fg__nc_mesh *mesh, const fg__nc_file *file,
                       const fg__nc_pair *pair)
{
  const fg__nc_part *u = &mesh->part[0], *v = &mesh->part[1];
  for (int k = 0; k < 2; ++k)
    if (!set_part(&mesh->part[k], file, pair->component[k]))
      return false;
  mesh->size[0] = v->grid.axis[0].size;
  mesh->size[1] = u->grid.axis[1].size;
  return fits(mesh) && runs_alike(file, u, u->grid.time, v, v->grid.time) &&
         runs_alike(file, u, u->grid.level, v, v->grid.level);
}

/* Finds a variable on the centres that is 0 on land, where models write no fill
 * values. */
static void find_mask(fg__nc_mesh *mesh, const fg__nc_file *file)
{
  static const char *const known[] = {"wetdry_mask_rho", "mask_rho", "tmask", "maskC",
                                      "hFacC",           "wet",      "wet_c"};
  const fg__nc_part *at = mesh->centre.variable ? &mesh->centre : &mesh->part[0];
  for (size_t n = 0; n < sizeof known / sizeof *known && !mesh->mask; ++n) {
    const fg__nc_variable *v = fg__nc_find(file, known[n]);
    if (v && strcmp(v->plain_name, known[n]) == 0 &&
        fg__nc_lies_on(file, v, &at->grid, at->variable))
      mesh->mask = v;
  }
}

static void check_storage(fg__nc_grid *grid, const fg__nc_file *file,
                          const fg__nc_mesh *mesh)
{
  const fg__nc_part *parts[] = {&mesh->part[0], &mesh->part[1], &mesh->centre};
  for (int n = 0; n < 3; ++n) {
    fg__nc_grid one = {.samples = parts[n]->grid.samples};
    if (!parts[n]->variable)
      continue;
    fg__nc_check_storage(&one, file, n < 2 ? parts[n]->variable : parts[n]->longitude);
    if (parts[n]->longitude && parts[n]->longitude->rank > 1) {
      fg__nc_check_storage(&one, file, parts[n]->longitude);
      fg__nc_check_storage(&one, file, parts[n]->latitude);
    }
    if (one.unusable[0])
      snprintf(grid->unusable, sizeof grid->unusable, "%s", one.unusable);
  }
}

/* Whether components on the same dimensions have positions of their own, those of their
 * faces. Of other positions on these dimensions nothing says that they are the
 * centres'. */
static bool have_own_positions(const fg__nc_part *u, const fg__nc_part *v)
{
  return u->grid.axis[0].dimension == v->grid.axis[0].dimension &&
         u->grid.axis[1].dimension == v->grid.axis[1].dimension && u->longitude &&
         v->longitude && u->longitude != v->longitude;
}

static fg_status find_shift(bool *found, fg__nc_mesh *mesh, const fg__nc_file *file)
{
  *found = true;
  if (is_same_place(&mesh->part[0], &mesh->part[1]) && mesh->part[0].longitude)
    return FG_STATUS_OK; /* not staggered */
  if (have_own_positions(&mesh->part[0], &mesh->part[1]))
    return fg__nc_shift_find(found, mesh, file);
  if (!find_centres(mesh, file) && !find_centre_lines(mesh, file) &&
      (!mesh->part[0].longitude || !mesh->part[1].longitude)) {
    *found = false;
    return FG_STATUS_OK;
  }
  return fg__nc_shift_find(found, mesh, file);
}

static fg_status recognise(fg__nc_mesh *mesh, fg__nc_grid *grid, const fg__nc_file *file,
                           const fg__nc_pair *pair, fg_frame frame, bool *found)
{
  *found = false;
  mesh->polar = pair->polar;
  if (!fg__nc_mesh_parts(mesh, file, pair))
    return FG_STATUS_OK;
  for (int k = 0; k < 2; ++k)
    find_positions(&mesh->part[k], file);
  fg__nc_grid storage = {0};
  check_storage(&storage, file, mesh);
  if (storage.unusable[0])
    return FG_STATUS_OK;
  fg_status status = find_shift(found, mesh, file);
  if (status == FG_STATUS_OK && mesh->apart)
    fg__nc_refuse_apart(grid, pair);
  if (status != FG_STATUS_OK || !*found)
    return status;
  grid->unusable[0] = grid->hint[0] = '\0';
  check_storage(grid, file, mesh);
  find_mask(mesh, file);
  if (!fg__nc_frame_find(mesh, file, pair, frame)) {
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

fg_status fg__nc_mesh_find(fg__nc_grid *grid, const fg__nc_file *file,
                           const fg__nc_pair *pair, const fg_read_options *options)
{
  if (options->scale != FG_SCALE_AUTO && options->scale != FG_SCALE_GEO)
    return FG_STATUS_OK;
  fg__nc_mesh *mesh = fg__allocate(1, sizeof *mesh);
  if (!mesh)
    return fg__fail_memory(file->context, "a mesh", sizeof *mesh);
  bool found;
  const fg_status status = recognise(mesh, grid, file, pair, options->frame, &found);
  if (status != FG_STATUS_OK || !found) {
    fg__nc_mesh_destroy(mesh);
    return status;
  }
  grid->mesh = mesh;
  grid->scale = FG_SCALE_GEO;
  grid->dimension = 2;
  grid->samples = mesh->size[0] * mesh->size[1];
  return FG_STATUS_OK;
}
