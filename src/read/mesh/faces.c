/* Components on the faces of rectilinear cells: Arakawa's C grid in a plane. */
#include "read/mesh/mesh.h"

#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Coordinates that differ by less than this fraction of a step are equal. */
static const double SAME_PLACE = 0.1;

static const fg__nc_variable *line_of(const fg__nc_file *file, const fg__nc_part *part,
                                      int k)
{
  return fg__nc_coordinate(file, part->variable, part->grid.axis[k].position);
}

/* Sets shift[k] from the first values of the coordinates of faces and centres. */
static bool shift_by_lines(fg__nc_mesh *mesh, const fg__nc_file *file, int k)
{
  const fg__nc_variable *faces = line_of(file, &mesh->part[k], k);
  const fg__nc_variable *centres = line_of(file, &mesh->part[1 - k], k);
  static const size_t start = 0, count = 2;
  double face[2], centre[2];
  if (!faces || !centres || faces == centres ||
      fg__nc_fetch(faces, &start, &count, face) ||
      fg__nc_fetch(centres, &start, &count, centre))
    return false;
  const double off = (face[0] - centre[0]) / (centre[1] - centre[0]);
  mesh->apart = mesh->apart || fabs(off) >= 1.0 - SAME_PLACE;
  if (!(fabs(off) > SAME_PLACE) || mesh->apart)
    return false;
  mesh->shift[k] = off > 0.0 ? 1 : -1;
  return true;
}

/* Whether v, of the centres' two dimensions, varies along axis k alone. */
static bool varies_along(const fg__nc_variable *v, const fg__nc_file *file,
                         const fg__nc_axis *axis)
{
  const int other = v->dimension[0] == axis->dimension ? 1 : 0;
  const size_t last = file->dimensions[v->dimension[other]].length - 1;
  double step = 0.0, most = 0.0, before = 0.0;
  for (size_t n = 0; n < file->dimensions[axis->dimension].length; ++n) {
    double here, there;
    size_t at[2] = {0, 0};
    at[1 - other] = n;
    if (fg__nc_fetch_one(v, at, &here))
      return false;
    at[other] = last;
    if (fg__nc_fetch_one(v, at, &there))
      return false;
    most = fmax(most, fabs(there - here));
    step = n > 0 ? fabs(here - before) : 0.0;
    before = here;
  }
  return most < SAME_PLACE * step;
}

/* A coordinate in a unit of length on both dimensions of the centres: x_rho of ROMS, XC
 * of MITgcm. */
static const fg__nc_variable *find_plane(const fg__nc_grid *grid, const fg__nc_file *file,
                                         int k)
{
  const int x = grid->axis[0].dimension, y = grid->axis[1].dimension;
  char text[FG__NC_TEXT], label[FG__NC_TEXT];
  for (size_t i = 0; i < file->variable_count; ++i) {
    const fg__nc_variable *v = &file->variables[i];
    if (v->rank != 2 || !fg__nc_is_array(v) ||
        tolower((unsigned char)v->plain_name[0]) != "xy"[k] ||
        !((v->dimension[0] == x && v->dimension[1] == y) ||
          (v->dimension[0] == y && v->dimension[1] == x)))
      continue;
    fg__nc_text(v, "units", text, sizeof text);
    if (fg__nc_units(text, label, sizeof label) == FG__NC_LENGTH &&
        varies_along(v, file, &grid->axis[k]))
      return v;
  }
  return NULL;
}

static fg_status read_axes(fg__nc_grid *grid, const fg__nc_file *file,
                           const fg__nc_mesh *mesh)
{
  fg_status status = FG_STATUS_OK;
  for (int k = 0; k < 2 && status == FG_STATUS_OK; ++k) {
    const fg__nc_variable *v = line_of(file, &mesh->part[1 - k], k);
    v = v ? v : find_plane(grid, file, k);
    status = v ? fg__nc_axis_read(grid, file, k, v) : fg__nc_axis_count(grid, file, k);
  }
  return status;
}

/* Restricts the axes to centres that lie between two faces. False where there are too
 * few. */
static bool place_centres(fg__nc_grid *grid, const fg__nc_mesh *mesh)
{
  for (int k = 0; k < 2; ++k) {
    fg__nc_axis *axis = &grid->axis[k];
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

fg_status fg__nc_faces_find(fg__nc_grid *grid, const fg__nc_file *file,
                            const fg__nc_pair *pair)
{
  fg__nc_mesh mesh = {.turn = FG__NC_TURN_NONE};
  if (pair->volume || !fg__nc_mesh_parts(&mesh, file, pair))
    return FG_STATUS_OK;
  for (int k = 0; k < 2 && grid->scale == FG_SCALE_AUTO; ++k)
    if (fg__nc_plane_coordinate(&mesh.part[k].grid, file, mesh.part[k].variable,
                                FG__NC_X))
      return FG_STATUS_OK; /* in degrees: mesh/find.c */
  for (int k = 0; k < 2; ++k) {
    bool found =
        mesh.part[k].grid.axis[k].size == mesh.size[k] && shift_by_lines(&mesh, file, k);
    if (mesh.apart)
      fg__nc_refuse_apart(grid, pair);
    else if (!found)
      found = fg__nc_shift_by_size(&mesh, file, k);
    if (!found)
      return FG_STATUS_OK;
  }
  if (!place_centres(grid, &mesh))
    return FG_STATUS_OK;
  grid->faces.used = true;
  for (int k = 0; k < 2; ++k) {
    const fg__nc_grid *own = &mesh.part[k].grid;
    const int position[FG__NC_ROLES] = {own->axis[0].position, own->axis[1].position,
                                        own->time, own->level};
    memcpy(grid->faces.position[k], position, sizeof position);
  }
  grid->unusable[0] = grid->hint[0] = '\0';
  grid->samples = grid->axis[0].size * grid->axis[1].size;
  return read_axes(grid, file, &mesh);
}
