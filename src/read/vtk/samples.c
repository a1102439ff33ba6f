/* From the arrays of a grid, in pieces and on points or cells, to the points of a plane
 * or volume. */
#include "base/memory.h"
#include "read/vtk/gather.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* vtkDataSetAttributes: what a sample of vtkGhostType says by its bits. */
enum { HIDDEN_POINT = 2, REFINED_CELL = 8, HIDDEN_CELL = 32 };

static float as_flag(bool inside)
{
  return inside ? 1.0f : NAN;
}

static float as_scalar_mask(double number)
{
  return as_flag(number > 0.0);
}

static float as_vector_mask(double number)
{
  return as_flag(number > 0.0 || number < 0.0);
}

static float as_valid_point(double number)
{
  return as_flag(number != 0.0);
}

static bool has_bit(double number, unsigned bits)
{
  return number >= 0.0 && number < 256.0 && ((unsigned)number & bits) != 0;
}

static float as_ghost_point(double number)
{
  return as_flag(!has_bit(number, HIDDEN_POINT));
}

static float as_ghost_cell(double number)
{
  return as_flag(!has_bit(number, REFINED_CELL | HIDDEN_CELL));
}

/* Mean over the layers of the flat axis, or all as it is in a volume; a NaN in one makes
 * the mean one. */
static void flatten(float *out, const float *samples, const fg__vtk_view *v)
{
  const fg__vtk_grid *grid = &v->grid;
  size_t length[3], step[3] = {1, 0, 0};
  for (int k = 0; k < 3; ++k)
    length[k] = fg__vtk_length(v->extent, k, v->place);
  step[1] = length[0];
  step[2] = length[0] * length[1];
  if (grid->dimension == 3) {
    memcpy(out, samples, length[2] * step[2] * sizeof *out);
    return;
  }
  size_t layers = length[grid->flat];
  for (size_t j = 0; j < length[grid->axis[1]]; ++j)
    for (size_t i = 0; i < length[grid->axis[0]]; ++i) {
      size_t at = j * step[grid->axis[1]] + i * step[grid->axis[0]];
      double sum = 0.0;
      for (size_t layer = 0; layer < layers; ++layer)
        sum += (double)samples[at + layer * step[grid->flat]];
      *out++ = (float)(sum / (double)layers);
    }
}

/* The cells that touch point i of an axis: [*first, *end) of `points` - 1. */
static void cells_round(size_t i, size_t points, size_t *first, size_t *end)
{
  *first = i > 0 ? i - 1 : 0;
  *end = i + 1 < points ? i + 1 : i;
  if (points == 1)
    *end = 1; /* a plane's only layer */
}

/* A point's value is the mean of the cells round it, up to eight (VTK's
 * CellDataToPointData); a NaN in one of them makes it one, so that no point beside a hole
 * pretends to know the flow there. */
static void cells_to_points(float *out, const float *cells, const size_t points[3])
{
  size_t columns = points[0] - 1, rows = points[1] - 1;
  for (size_t k = 0; k < points[2]; ++k)
    for (size_t j = 0; j < points[1]; ++j)
      for (size_t i = 0; i < points[0]; ++i) {
        size_t first[3], end[3];
        const size_t at[3] = {i, j, k};
        for (int d = 0; d < 3; ++d)
          cells_round(at[d], points[d], &first[d], &end[d]);
        double sum = 0.0;
        int count = 0;
        for (size_t z = first[2]; z < end[2]; ++z)
          for (size_t y = first[1]; y < end[1]; ++y)
            for (size_t x = first[0]; x < end[0]; ++x) {
              sum += (double)cells[(z * rows + y) * columns + x];
              ++count;
            }
        *out++ = (float)(sum / count);
      }
}

/* Drops the rows that were read for their neighbours' sake. */
static void drop_margins(float *samples, const fg__vtk_view *v, const fg__vtk_grid *grid)
{
  const size_t row = fg__vtk_grid_wanted(grid) / grid->rows;
  if (v->skipped > 0)
    memmove(samples, samples + v->skipped * row, grid->rows * row * sizeof *samples);
}

/* Takes `samples` over. */
static fg_status to_grid(float **out, float *samples, const fg__vtk_view *v,
                         const fg__vtk_grid *grid)
{
  const bool of_cells = v->place == FG__VTK_CELLS;
  if (grid->dimension == 3 && !of_cells) {
    *out = samples;
    return FG_STATUS_OK;
  }
  size_t count = fg__vtk_grid_points(&v->grid);
  float *flat = fg__allocate(count, sizeof *flat);
  float *points = of_cells ? fg__allocate(count, sizeof *points) : NULL;
  if (!flat || (of_cells && !points)) {
    free(flat);
    free(points);
    free(samples);
    return fg__fail_memory(v->vtk->context, "a field's samples",
                           2 * count * sizeof *flat);
  }
  flatten(flat, samples, v);
  free(samples);
  *out = flat;
  if (points) {
    cells_to_points(points, flat, v->grid.points);
    free(flat);
    drop_margins(points, v, grid);
    *out = points;
  }
  return FG_STATUS_OK;
}

/* The same from the points or cells of a set to its raster. */
static fg_status to_raster(float **out, float *samples, const fg__vtk_view *v,
                           const fg__vtk_grid *grid)
{
  const fg__cell_set *set = &v->vtk->cells;
  const size_t count = fg__vtk_grid_wanted(grid), row = count / grid->rows;
  float *points = samples;
  fg_status status = FG_STATUS_OK;
  if (v->place == FG__VTK_CELLS) {
    points = fg__allocate(set->points, sizeof *points);
    status = points ? fg__cell_set_to_points(points, set, samples)
                    : fg__fail_memory(set->context, "means of cells", set->points * 4);
    free(samples);
  }
  float *raster = status == FG_STATUS_OK ? fg__allocate(count, sizeof *raster) : NULL;
  if (raster)
    fg__cell_set_sample(raster, set, points, grid->first_row * row, count);
  else if (status == FG_STATUS_OK)
    status = fg__fail_memory(set->context, "a field's samples", count * sizeof *raster);
  free(points);
  *out = raster;
  return status;
}

/* Reads the wanted components onto the wanted rows' points. With `any`, the first result
 * stands for all: a number where one of them is. */
static fg_status read_onto_points(float *out[], const fg__vtk *vtk,
                                  const fg__vtk_grid *grid, fg__vtk_gathering *wanted,
                                  bool any)
{
  size_t count;
  const fg__vtk_view v = fg__vtk_view_of(vtk, grid, wanted->place);
  fg_status status = fg__vtk_gather_check(vtk, wanted);
  const bool cells = vtk->cells.count > 0;
  if (cells)
    count = wanted->place == FG__VTK_CELLS ? vtk->cells.numbers : vtk->cells.points;
  else if (status == FG_STATUS_OK && !fg__vtk_count(&count, v.extent, wanted->place))
    status = FG_STATUS_FILE_FORMAT;
  for (int c = 0; c < wanted->components && status == FG_STATUS_OK; ++c) {
    wanted->out[c] = fg__allocate(count, sizeof(float));
    if (!wanted->out[c])
      status = fg__fail_memory(vtk->context, "a field's samples", count * sizeof(float));
  }
  if (status == FG_STATUS_OK)
    status = cells ? fg__vtk_gather_pieces(vtk, wanted) : fg__vtk_gather(&v, wanted);
  for (int c = 0; c < wanted->components && status == FG_STATUS_OK; ++c)
    if (cells && wanted->place == FG__VTK_POINTS)
      fg__cell_set_fill_middles(wanted->out[c], &vtk->cells);
  if (status == FG_STATUS_OK && any)
    for (int c = 1; c < wanted->components; ++c)
      for (size_t i = 0; i < count; ++i)
        if (isnan(wanted->out[0][i]))
          wanted->out[0][i] = wanted->out[c][i];
  for (int c = 0; c < (any ? 1 : wanted->components) && status == FG_STATUS_OK; ++c) {
    status = (cells ? to_raster : to_grid)(&out[c], wanted->out[c], &v, grid);
    wanted->out[c] = NULL;
  }
  for (int c = 0; c < wanted->components; ++c)
    free(wanted->out[c]);
  return status;
}

static fg_status apply_marks(float *velocity[3], const fg__vtk *vtk,
                             const fg__vtk_grid *grid, fg__vtk_gathering *wanted)
{
  float *marks = NULL;
  fg_status status = read_onto_points(&marks, vtk, grid, wanted, true);
  if (status == FG_STATUS_OK)
    for (int k = 0; k < grid->dimension; ++k)
      for (size_t i = 0; i < fg__vtk_grid_wanted(grid); ++i)
        if (velocity[k] && isnan(marks[i]))
          velocity[k][i] = NAN;
  free(marks);
  return status;
}

static fg_status apply_known_marks(float *velocity[3], const fg__vtk *vtk,
                                   const fg__vtk_grid *grid)
{
  static const struct {
    const char *name;
    fg__vtk_place place;
    fg__vtk_meaning *means;
  } known[] = {{"vtkGhostType", FG__VTK_POINTS, as_ghost_point},
               {"vtkGhostType", FG__VTK_CELLS, as_ghost_cell},
               {"vtkValidPointMask", FG__VTK_POINTS, as_valid_point}};
  for (size_t k = 0; k < sizeof known / sizeof known[0]; ++k) {
    if (!fg__vtk_find(vtk, 0, known[k].place, known[k].name))
      continue;
    fg__vtk_gathering wanted = {.name = known[k].name,
                                .place = known[k].place,
                                .components = 1,
                                .means = known[k].means,
                                .absent = 1.0f};
    fg_status status = apply_marks(velocity, vtk, grid, &wanted);
    if (status != FG_STATUS_OK)
      return status;
  }
  return FG_STATUS_OK;
}

static fg_status apply_mask(float *velocity[3], const fg__vtk *vtk,
                            const fg__vtk_grid *grid, const char *mask)
{
  fg__vtk_place place = FG__VTK_POINTS;
  const fg__vtk_array *array = fg__vtk_find(vtk, 0, place, mask);
  if (!array) {
    place = FG__VTK_CELLS;
    array = fg__vtk_find(vtk, 0, place, mask);
  }
  if (!array)
    return fg__vtk_fail_unknown(vtk, mask);
  if (array->components > 3)
    return fg__fail(vtk->context, FG_STATUS_ARGUMENT,
                    "%s: mask \"%.100s\" has %d components; at most 3 can be a mask",
                    vtk->path, mask, array->components);
  fg__vtk_gathering wanted = {.name = mask,
                              .place = place,
                              .components = array->components,
                              .component = {0, 1, 2},
                              .means =
                                  array->components > 1 ? as_vector_mask : as_scalar_mask,
                              .absent = NAN};
  return apply_marks(velocity, vtk, grid, &wanted);
}

/* Which component lies along the grid's axis k: of three, the axis' own; two are meant
 * along a plane. */
static int component_along(const fg__vtk_vector *vector, const fg__vtk_grid *grid, int k)
{
  return vector->components == 3 ? grid->axis[k] : k;
}

/* Reads `count` components of a vector, which[k] as out[k]. */
static fg_status read_components(float *out[3], const fg__vtk *vtk,
                                 const fg__vtk_grid *grid, const fg__vtk_vector *vector,
                                 const int which[3], int count)
{
  fg_status status = FG_STATUS_OK;
  const bool one = vector->names == 1;
  for (int k = 0; k < (one ? 1 : count) && k < 3 && status == FG_STATUS_OK; ++k) {
    fg__vtk_gathering wanted = {.name = vector->name[one ? 0 : which[k]],
                                .place = vector->place,
                                .components = one ? count : 1,
                                .means = fg__as_velocity,
                                .absent = NAN};
    for (int c = 0; one && c < count && c < 3; ++c)
      wanted.component[c] = which[c];
    status = read_onto_points(out + k, vtk, grid, &wanted, false);
  }
  return status;
}

/* Keeps the components along a plane's two directions. */
static void turn(float *out[3], const fg__vtk *vtk, const fg__vtk_grid *grid)
{
  const fg__plane_basis *basis = &vtk->cells.basis;
  for (size_t n = 0; out[2] && n < fg__vtk_grid_wanted(grid); ++n) {
    const double u[3] = {(double)out[0][n], (double)out[1][n], (double)out[2][n]};
    out[0][n] = (float)fg__dot(u, basis->direction[0]);
    out[1][n] = (float)fg__dot(u, basis->direction[1]);
    out[2][n] = (float)fg__dot(u, basis->normal);
  }
}

static fg_status check_components(const fg__vtk *vtk, const fg__vtk_grid *grid,
                                  const fg__vtk_vector *vector)
{
  if (vtk->cells.tilted && vector->components < 3)
    return fg__fail(vtk->context, FG_STATUS_UNSUPPORTED,
                    "%s: a tilted plane needs three components, \"%.100s\" has two",
                    vtk->path, vector->name[0]);
  if (grid->dimension <= vector->components)
    return FG_STATUS_OK;
  fg__fail(vtk->context, FG_STATUS_UNSUPPORTED,
           "%s: a volume of %zu x %zu x %zu points needs three components, \"%.100s\" "
           "has two",
           vtk->path, grid->points[0], grid->points[1], grid->points[2], vector->name[0]);
  fg__hint(vtk->context, "name three variables: --vars U,V,W");
  return FG_STATUS_UNSUPPORTED;
}

/* With `normal`, of a plane the component normal to it, as out[2], too. */
static fg_status read_vector(float *out[3], const fg__vtk *vtk, const fg__vtk_grid *grid,
                             const fg__vtk_vector *vector, bool normal)
{
  const bool tilted = vtk->cells.tilted;
  const bool across =
      grid->dimension == 2 && vector->components == 3 && (normal || tilted);
  int which[3] = {0, 1, 2};
  fg_status status = check_components(vtk, grid, vector);
  for (int k = 0; k < 3 && k < grid->dimension && !tilted; ++k)
    which[k] = component_along(vector, grid, k);
  if (across && !tilted)
    which[2] = grid->flat;
  if (status == FG_STATUS_OK)
    status = read_components(out, vtk, grid, vector, which,
                             grid->dimension + (across ? 1 : 0));
  if (status == FG_STATUS_OK && tilted)
    turn(out, vtk, grid);
  if (status == FG_STATUS_OK && across && !normal) {
    free(out[2]);
    out[2] = NULL;
  }
  return status;
}

fg_status fg__vtk_samples_read(float *out[3], const fg__vtk *vtk,
                               const fg__vtk_grid *grid, const fg__vtk_vector *vector,
                               const char *mask, bool normal)
{
  const int last = grid->dimension - 1;
  fg__vtk_grid stored = *grid; /* the same rows as the file counts them */
  if (grid->descends[last])
    stored.first_row = grid->points[last] - grid->first_row - grid->rows;
  out[0] = out[1] = out[2] = NULL;
  fg_status status = read_vector(out, vtk, &stored, vector, normal);
  if (status == FG_STATUS_OK)
    status = apply_known_marks(out, vtk, &stored);
  if (status == FG_STATUS_OK && mask)
    status = apply_mask(out, vtk, &stored, mask);
  for (int k = 0; k < 3; ++k)
    if (status != FG_STATUS_OK) {
      free(out[k]);
      out[k] = NULL;
    } else if (out[k]) {
      fg__vtk_grid_reverse(out[k], grid);
    }
  return status;
}
