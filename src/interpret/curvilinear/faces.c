/* Components on the faces of rectilinear cells: Arakawa's C grid in a plane. */
#include "interpret/curvilinear/curvilinear.h"

#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Coordinates that differ by less than this fraction of a step are equal. */
static const double SAME_PLACE = 0.1;

static const fg__variable *line_of(const fg__dataset *data,
                                   const fg__curvilinear_part *part, int k)
{
  return fg__coordinate(data, part->variable, part->grid.axis[k].position);
}

/* Sets shift[k] from the first values of the coordinates of faces and centres. */
static bool shift_by_lines(fg__curvilinear *mesh, const fg__dataset *data, int k)
{
  const fg__variable *faces = line_of(data, &mesh->part[k], k);
  const fg__variable *centres = line_of(data, &mesh->part[1 - k], k);
  static const size_t start = 0, count = 2;
  double face[2], centre[2];
  if (!faces || !centres || faces == centres ||
      fg__variable_fetch(faces, &start, &count, face) ||
      fg__variable_fetch(centres, &start, &count, centre))
    return false;
  const double off = (face[0] - centre[0]) / (centre[1] - centre[0]);
  mesh->apart = mesh->apart || fabs(off) >= 1.0 - SAME_PLACE;
  if (!(fabs(off) > SAME_PLACE) || mesh->apart)
    return false;
  mesh->shift[k] = off > 0.0 ? 1 : -1;
  return true;
}

/* Whether v, of the centres' two dimensions, varies along axis k alone. */
static bool varies_along(const fg__variable *v, const fg__dataset *data,
                         const fg__grid_axis *axis)
{
  const int other = v->dimension[0] == axis->dimension ? 1 : 0;
  const size_t last = data->dimensions[v->dimension[other]].length - 1;
  double step = 0.0, most = 0.0, before = 0.0;
  for (size_t n = 0; n < data->dimensions[axis->dimension].length; ++n) {
    double here, there;
    size_t at[2] = {0, 0};
    at[1 - other] = n;
    if (fg__variable_fetch_one(v, at, &here))
      return false;
    at[other] = last;
    if (fg__variable_fetch_one(v, at, &there))
      return false;
    most = fmax(most, fabs(there - here));
    step = n > 0 ? fabs(here - before) : 0.0;
    before = here;
  }
  return most < SAME_PLACE * step;
}

/* A coordinate in a unit of length on both dimensions of the centres: x_rho of ROMS, XC
 * of MITgcm. */
static const fg__variable *find_plane(const fg__grid *grid, const fg__dataset *data,
                                      int k)
{
  const int x = grid->axis[0].dimension, y = grid->axis[1].dimension;
  for (size_t i = 0; i < data->variable_count; ++i) {
    const fg__variable *v = &data->variables[i];
    if (v->rank != 2 || !fg__is_array(v) ||
        tolower((unsigned char)v->plain_name[0]) != "xy"[k] ||
        !((v->dimension[0] == x && v->dimension[1] == y) ||
          (v->dimension[0] == y && v->dimension[1] == x)))
      continue;
    if (fg__units_of(v, NULL, 0) == FG__QUANTITY_LENGTH &&
        varies_along(v, data, &grid->axis[k]))
      return v;
  }
  return NULL;
}

static fg_status read_axes(fg__grid *grid, const fg__dataset *data,
                           const fg__curvilinear *mesh)
{
  fg_status status = FG_STATUS_OK;
  for (int k = 0; k < 2 && status == FG_STATUS_OK; ++k) {
    const fg__variable *v = line_of(data, &mesh->part[1 - k], k);
    v = v ? v : find_plane(grid, data, k);
    status =
        v ? fg__grid_axis_read(grid, data, k, v) : fg__grid_axis_count(grid, data, k);
  }
  return status;
}

/* Restricts the axes to centres that lie between two faces. False where there are too
 * few. */
static bool place_centres(fg__grid *grid, const fg__curvilinear *mesh)
{
  for (int k = 0; k < 2; ++k) {
    fg__grid_axis *axis = &grid->axis[k];
    const size_t before = mesh->shift[k] > 0 ? 1 : 0;
    const size_t end = mesh->part[k].grid.axis[k].size - 1 + before;
    free(axis->coordinate);
    *axis = mesh->part[1 - k].grid.axis[k];
    axis->first = before;
    axis->size = (end < axis->size ? end : axis->size) - before;
    grid->faces.before[k] = before;
    if (axis->size < 2)
      return false;
  }
  return true;
}

fg_status fg__staggered_find(fg__grid *grid, const fg__dataset *data,
                             const fg__pair *pair)
{
  fg__curvilinear mesh = {.turn = FG__TURN_NONE};
  if (pair->volume || !fg__curvilinear_parts(&mesh, data, pair))
    return FG_STATUS_OK;
  for (int k = 0; k < 2 && grid->scale == FG_SCALE_AUTO; ++k)
    if (fg__plane_coordinate(&mesh.part[k].grid, data, mesh.part[k].variable, FG__ROLE_X))
      return FG_STATUS_OK; /* in degrees: mesh/find.c */
  for (int k = 0; k < 2; ++k) {
    bool found =
        mesh.part[k].grid.axis[k].size == mesh.size[k] && shift_by_lines(&mesh, data, k);
    if (mesh.apart)
      fg__refuse_apart(grid, pair);
    else if (!found)
      found = fg__shift_by_size(&mesh, data, k);
    if (!found)
      return FG_STATUS_OK;
  }
  if (!place_centres(grid, &mesh))
    return FG_STATUS_OK;
  grid->faces.used = true;
  for (int k = 0; k < 2; ++k) {
    const fg__grid *own = &mesh.part[k].grid;
    const int position[FG__ROLES] = {own->axis[0].position, own->axis[1].position,
                                     own->time, own->level};
    memcpy(grid->faces.position[k], position, sizeof position);
  }
  grid->unusable[0] = grid->hint[0] = '\0';
  grid->samples = grid->axis[0].size * grid->axis[1].size;
  return read_axes(grid, data, &mesh);
}
