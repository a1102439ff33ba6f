#include "evolve/level.h"

#include <stdlib.h>
#include <string.h>

#include "base/memory.h"

static int round_to_lanes(int count)
{
  return (count + FG__LANES - 1) / FG__LANES * FG__LANES;
}

/* Several arrays from one piece of memory, each an odd number of vectors after the last,
 * so that equal rows of different arrays do not fall into the same cache sets. */
static fg_status take_arrays(fg__level *level, fg_context *context, float **const out[],
                             int count)
{
  size_t apart = level->array_size + FG__LANES;
  float *memory = fg__allocate_aligned(apart * (size_t)count, sizeof *memory);
  if (!memory)
    return fg__fail_memory(context, "a multigrid level",
                           apart * (size_t)count * sizeof *memory);
  level->memory[level->memory_count++] = memory;
  for (int n = 0; n < count; ++n)
    *out[n] = memory + (size_t)n * apart + level->first;
  return FG_STATUS_OK;
}

static void lay_out(fg__level *level)
{
  for (int k = 0; k < 2; ++k) {
    int nodes = level->periodic[k] ? level->cells[k] : level->cells[k] + 1;
    *(k == 0 ? &level->columns : &level->rows) = nodes;
  }
  int columns = level->columns;
  level->even_count = round_to_lanes((columns + 1) / 2);
  level->odd_count = round_to_lanes(columns / 2);
  /* each part has a pad of one vector before it and at least one ghost after it */
  int even_part = round_to_lanes((columns + 1) / 2 + 1);
  int odd_part = round_to_lanes(columns / 2 + 1);
  level->odd_offset = even_part + FG__LANES;
  level->stride = even_part + odd_part + 2 * FG__LANES;
  level->array_size = (size_t)level->stride * (size_t)(level->rows + 2) + FG__LANES;
  level->first = level->stride + FG__LANES;
  int last = columns - 1;
  level->ghost_column[0] = level->odd_offset - 1;
  level->ghost_column[1] = fg__column(level, columns);
  level->ghost_column_source[0] = fg__column(level, level->periodic[0] ? last : 1);
  level->ghost_column_source[1] = fg__column(level, level->periodic[0] ? 0 : last - 1);
  level->ghost_row_source[0] = level->periodic[1] ? level->rows - 1 : 1;
  level->ghost_row_source[1] = level->periodic[1] ? 0 : level->rows - 2;
}

void fg__fill_ghost_row(const fg__level *level, float *array, int side)
{
  float *ghost = fg__row(level, array, side == 0 ? -1 : level->rows);
  const float *source = fg__row(level, array, level->ghost_row_source[side]);
  memcpy(ghost - FG__LANES, source - FG__LANES, (size_t)level->stride * sizeof *ghost);
}

void fg__fill_ghosts(const fg__level *level, float *array)
{
  for (int j = 0; j < level->rows; ++j)
    fg__fill_ghost_columns(level, fg__row(level, array, j));
  fg__fill_ghost_row(level, array, 0);
  fg__fill_ghost_row(level, array, 1);
}

void fg__level_import(const fg__level *level, float *array, const float *plain)
{
  for (int j = 0; j < level->rows; ++j)
    for (int i = 0; i < level->columns; ++i)
      *fg__node(level, array, i, j) =
          plain[(size_t)j * (size_t)level->columns + (size_t)i];
  fg__fill_ghosts(level, array);
}

void fg__level_export(const fg__level *level, const float *array, float *plain)
{
  for (int j = 0; j < level->rows; ++j) {
    const float *even = array + (ptrdiff_t)j * level->stride;
    const float *odd = even + level->odd_offset;
    float *row = plain + (size_t)j * (size_t)level->columns;
    for (int k = 0; k < (level->columns + 1) / 2; ++k)
      row[2 * k] = even[k];
    for (int k = 0; k < level->columns / 2; ++k)
      row[2 * k + 1] = odd[k];
  }
}

/* A cell of the extended mesh: beyond natural borders its mirror image, whose
 * off-diagonal tensor entry has the other sign for each axis mirrored. */
typedef struct cell {
  double xx, xy, yy, weight;
} cell;

static cell extended_cell(const fg__level *level, int i, int j)
{
  int index[2] = {i, j};
  double sign = 1.0;
  for (int k = 0; k < 2; ++k) {
    int count = level->cells[k];
    if (index[k] >= 0 && index[k] < count)
      continue;
    if (level->periodic[k]) {
      index[k] = (index[k] + count) % count;
    } else {
      index[k] = index[k] < 0 ? -1 - index[k] : 2 * count - 1 - index[k];
      sign = -sign;
    }
  }
  size_t n = (size_t)index[1] * (size_t)level->cells[0] + (size_t)index[0];
  return (cell){.xx = (double)level->cell_xx[n],
                .xy = sign * (double)level->cell_xy[n],
                .yy = (double)level->cell_yy[n],
                .weight = (double)level->cell_weight[n]};
}

/* Entries of the exact Q1 stiffness of a rectangle hx x hy with constant tensor, divided
 * by hx hy. With corner differences x, y, q of the Haar basis the energy is
 * (a x^2 + 2 b x y + c y^2 + (a + c) q^2 / 12) / 2, a = Axx / hx^2, b = Axy / (hx hy),
 * c = Ayy / hy^2. */
typedef struct entries {
  double horizontal, vertical, northeast, northwest;
} entries;

static entries stiffness(double xx, double xy, double yy, const double spacing[2])
{
  double a = xx / (spacing[0] * spacing[0]);
  double b = xy / (spacing[0] * spacing[1]);
  double c = yy / (spacing[1] * spacing[1]);
  return (entries){.horizontal = c / 6.0 - a / 3.0,
                   .vertical = a / 6.0 - c / 3.0,
                   .northeast = -(a + c) / 6.0 - b / 2.0,
                   .northwest = -(a + c) / 6.0 + b / 2.0};
}

static entries cell_entries(const fg__level *level, int i, int j, double gamma)
{
  cell c = extended_cell(level, i, j);
  return stiffness(gamma * c.xx, gamma * c.xy, gamma * c.yy, level->spacing);
}

static entries cell_laplacian(const fg__level *level, int i, int j)
{
  double weight = extended_cell(level, i, j).weight;
  return stiffness(weight, 0.0, weight, level->spacing);
}

/* Assembles couplings from cells at nodes -1 ... columns and -1 ... rows (the ghosts'
 * couplings to real nodes are read from them), then diagonals: rows sum to zero. */
static void assemble(const fg__level *level, const fg__stencil *out, double gamma,
                     bool laplacian)
{
#define ENTRIES(i, j)                                                                    \
  (laplacian ? cell_laplacian(level, i, j) : cell_entries(level, i, j, gamma))
  for (int j = -1; j <= level->rows; ++j)
    for (int i = -1; i <= level->columns; ++i) {
      entries northeast = ENTRIES(i, j), southeast = ENTRIES(i, j - 1);
      entries northwest = ENTRIES(i - 1, j);
      ptrdiff_t n = (ptrdiff_t)j * level->stride +
                    (i == -1 ? level->ghost_column[0] : fg__column(level, i));
      out->east[n] = (float)(northeast.horizontal + southeast.horizontal);
      out->north[n] = (float)(northeast.vertical + northwest.vertical);
      out->northeast[n] = (float)northeast.northeast;
      out->northwest[n] = (float)northwest.northwest;
    }
#undef ENTRIES
  for (int j = 0; j < level->rows; ++j)
    for (int i = 0; i < level->columns; ++i) {
      ptrdiff_t n = (ptrdiff_t)j * level->stride + fg__column(level, i);
      ptrdiff_t west = (ptrdiff_t)j * level->stride +
                       (i == 0 ? level->ghost_column[0] : fg__column(level, i - 1));
      ptrdiff_t east = (ptrdiff_t)j * level->stride + fg__column(level, i + 1);
      float sum = out->east[n] + out->east[west] + out->north[n] +
                  out->north[n - level->stride] + out->northeast[n] +
                  out->northeast[west - level->stride] + out->northwest[n] +
                  out->northwest[east - level->stride];
      out->center[n] = -sum;
    }
}

static bool has_mask(const fg__level *level)
{
  size_t count = (size_t)level->cells[0] * (size_t)level->cells[1];
  for (size_t n = 0; n < count; ++n)
    if (level->cell_weight[n] < 1.0F)
      return true;
  return false;
}

/* Relative mass of a node from the cells round it. */
static void weigh_nodes(const fg__level *level)
{
  for (int j = 0; j < level->rows; ++j)
    for (int i = 0; i < level->columns; ++i) {
      double mass = 0.25 * (extended_cell(level, i, j).weight +
                            extended_cell(level, i - 1, j).weight +
                            extended_cell(level, i, j - 1).weight +
                            extended_cell(level, i - 1, j - 1).weight);
      *fg__node(level, level->mass, i, j) = (float)mass;
      *fg__node(level, level->mass_inverse, i, j) =
          mass > 0.0 ? (float)(1.0 / mass) : 0.0F;
    }
  fg__fill_ghosts(level, level->mass);
  fg__fill_ghosts(level, level->mass_inverse);
}

static fg_status take_rows(fg__level *level, fg_context *context)
{
  size_t stride = (size_t)level->stride, count = (3 + FG__SCRATCH_ROWS) * stride;
  float *memory = fg__allocate_aligned(count, sizeof *memory);
  if (!memory)
    return fg__fail_memory(context, "a multigrid level", count * sizeof *memory);
  level->memory[level->memory_count++] = memory;
  level->column_mass = memory + FG__LANES;
  level->column_east = level->column_mass + stride;
  level->column_west = level->column_east + stride;
  level->scratch = memory + 3 * stride;
  for (int i = 0; i < level->columns; ++i) {
    bool first = !level->periodic[0] && i == 0;
    bool last = !level->periodic[0] && i == level->columns - 1;
    ptrdiff_t n = fg__column(level, i);
    level->column_mass[n] = first || last ? 0.5F : 1.0F;
    level->column_east[n] = last ? 0.0F : 1.0F;
    level->column_west[n] = first ? 0.0F : 1.0F;
  }
  return FG_STATUS_OK;
}

static fg_status copy_cells(fg__level *level, fg_context *context, const float *xx,
                            const float *xy, const float *yy, const float *weight)
{
  size_t count = (size_t)level->cells[0] * (size_t)level->cells[1];
  float *memory = fg__allocate(4 * count, sizeof *memory);
  if (!memory)
    return fg__fail_memory(context, "the tensor", 4 * count * sizeof *memory);
  level->memory[level->memory_count++] = memory;
  const float *source[4] = {xx, xy, yy, weight};
  float **target[4] = {&level->cell_xx, &level->cell_xy, &level->cell_yy,
                       &level->cell_weight};
  for (int n = 0; n < 4; ++n) {
    *target[n] = memory + (size_t)n * count;
    memcpy(*target[n], source[n], count * sizeof *memory);
  }
  return FG_STATUS_OK;
}

fg_status fg__level_create(fg__level *out, fg_context *context, const int cells[2],
                           const bool periodic[2], const double spacing[2], double gamma,
                           const float *xx, const float *xy, const float *yy,
                           const float *weight, bool finest)
{
  *out = (fg__level){0};
  for (int k = 0; k < 2; ++k) {
    out->cells[k] = cells[k];
    out->periodic[k] = periodic[k];
    out->spacing[k] = spacing[k];
  }
  lay_out(out);
  fg_status status = copy_cells(out, context, xx, xy, yy, weight);
  float **const arrays[] = {&out->u,
                            &out->w,
                            &out->p,
                            &out->energy.center,
                            &out->energy.east,
                            &out->energy.north,
                            &out->energy.northeast,
                            &out->energy.northwest,
                            &out->q,
                            &out->curvature};
  if (!status)
    status = take_rows(out, context);
  if (!status)
    status = take_arrays(out, context, arrays, finest ? 8 : 10);
  if (status)
    return status;
  assemble(out, &out->energy, gamma, false);
  entries inner = stiffness(1.0, 0.0, 1.0, spacing);
  out->laplacian_east = (float)(2.0 * inner.horizontal);
  out->laplacian_north = (float)(2.0 * inner.vertical);
  out->laplacian_diagonal = (float)inner.northeast;
  out->laplacian_center = -2.0F * (out->laplacian_east + out->laplacian_north) -
                          4.0F * out->laplacian_diagonal;
  if (!has_mask(out))
    return FG_STATUS_OK;
  float **const masked[] = {&out->laplacian.center,    &out->laplacian.east,
                            &out->laplacian.north,     &out->laplacian.northeast,
                            &out->laplacian.northwest, &out->mass,
                            &out->mass_inverse};
  status = take_arrays(out, context, masked, 7);
  if (status)
    return status;
  assemble(out, &out->laplacian, 1.0, true);
  weigh_nodes(out);
  return FG_STATUS_OK;
}

bool fg__level_can_coarsen(const fg__level *level)
{
  for (int k = 0; k < 2; ++k)
    if (level->cells[k] % 2 != 0 || level->cells[k] < 4)
      return false;
  return true;
}

fg_status fg__level_create_coarser(fg__level *out, fg_context *context,
                                   const fg__level *fine, double gamma)
{
  int cells[2] = {fine->cells[0] / 2, fine->cells[1] / 2};
  size_t count = (size_t)cells[0] * (size_t)cells[1];
  float *average = fg__allocate(4 * count, sizeof *average);
  if (!average)
    return fg__fail_memory(context, "the coarse tensor", 4 * count * sizeof *average);
  const float *source[4] = {fine->cell_xx, fine->cell_xy, fine->cell_yy,
                            fine->cell_weight};
  for (int n = 0; n < 4; ++n)
    for (int j = 0; j < cells[1]; ++j)
      for (int i = 0; i < cells[0]; ++i) {
        const float *low = source[n] + (size_t)(2 * j) * (size_t)fine->cells[0] + 2 * i;
        const float *high = low + fine->cells[0];
        average[(size_t)n * count + (size_t)j * (size_t)cells[0] + (size_t)i] =
            0.25F * (low[0] + low[1] + high[0] + high[1]);
      }
  double spacing[2] = {2.0 * fine->spacing[0], 2.0 * fine->spacing[1]};
  fg_status status =
      fg__level_create(out, context, cells, fine->periodic, spacing, gamma, average,
                       average + count, average + 2 * count, average + 3 * count, false);
  free(average);
  return status;
}

void fg__level_clear(fg__level *level)
{
  for (int n = 0; n < level->memory_count; ++n)
    free(level->memory[n]);
  *level = (fg__level){0};
}
