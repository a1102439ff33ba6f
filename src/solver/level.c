#include "solver/level.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "solver/interpolation.h"
#include "solver/stencil.h"

/* What kernels keep of slices for themselves: one line and three gathered slices of four
 * quantities; in 3D three lines more that become a gathered one; and a line of its own.
 */
enum { SHAPE_SLICES = 3, SCRATCH_QUANTITIES = 4, SCRATCH_SLICES = 3, SCRATCH_LINES = 4 };

/* With a mask slices are fine ones, and corrections a line of their own. */
enum { CORRECTION_LINES = 2 };

static int round_to_lanes(int count)
{
  return (count + FG__LANES - 1) / FG__LANES * FG__LANES;
}

/* Several arrays from one piece of memory, each an odd number of vectors after the last,
 * so that equal rows of different arrays do not fall into the same cache sets. */
static fg_status take_arrays(fg__level *level, fg_context *context, float **const out[],
                             int count)
{
  size_t apart = level->layout.array_size + FG__LANES;
  void *base;
  float *memory = fg__allocate_untouched(&base, apart * (size_t)count, sizeof *memory);
  if (!memory)
    return fg__fail_memory(context, "a multigrid level",
                           apart * (size_t)count * sizeof *memory);
  level->memory[level->memory_count++] = base;
  for (int n = 0; n < count; ++n)
    *out[n] = memory + (size_t)n * apart + level->layout.first;
  return FG_STATUS_OK;
}

/* Sums of terms up to 8 on average stay below 2^53 multiples of the smallest number, so
 * that they are exact; the constant adds 52 bits to it (Demmel and Nguyen, Fast
 * reproducible floating-point summation, 2013, use the same device). */
static double rounding_for(double nodes, double most_mean)
{
  double quantum = ldexp(exp2(ceil(log2(nodes))) * most_mean, -52);
  return 1.5 * ldexp(quantum, 52);
}

double fg__level_rounding(double nodes)
{
  return rounding_for(nodes, 8.0);
}

double fg__level_change_rounding(double nodes)
{
  return rounding_for(nodes, 0.125);
}

static double unit_of(double rounding)
{
  return ldexp(rounding / 1.5, -52);
}

uint64_t fg__level_units(double sum, double rounding, int ranks)
{
  const double beyond = 0x1p60 / ranks;
  double number = sum / unit_of(rounding);
  number = fabs(number) < beyond ? number : beyond;
  return (uint64_t)(int64_t)number;
}

double fg__level_sum(uint64_t units, double rounding)
{
  return (double)(int64_t)units * unit_of(rounding);
}

/* The nodes -1 and n of an axis as images of own ones; what is no image of those is its
 * own source: filling it changes nothing. box: a block; NULL for the whole level. */
static void find_images(const fg__level *level, const fg__box *box, int axis, int whole,
                        int source[2])
{
  int nodes = level->layout.nodes[axis];
  bool spans = !box || box->nodes[axis] == whole;
  source[0] = -1;
  source[1] = nodes;
  if (level->periodic[axis] && spans) {
    source[0] = nodes - 1;
    source[1] = 0;
  }
  if (level->boundary[axis][0] && nodes > 1)
    source[0] = 1;
  if (level->boundary[axis][1] && nodes > 1)
    source[1] = nodes - 2;
}

static void find_ghost_sources(fg__level *level, const fg__box *box, const int whole[3])
{
  int columns[2];
  find_images(level, box, 0, whole[0], columns);
  find_images(level, box, 1, whole[1], level->ghost_row_source);
  find_images(level, box, 2, whole[2], level->ghost_plane_source);
  for (int side = 0; side < 2; ++side)
    level->ghost_column_source[side] = fg__column(&level->layout, columns[side]);
}

static void lay_out(fg__level *level, const fg__box *box)
{
  int whole[3] = {1, 1, 1}, dimension = level->layout.dimension;
  level->nodes = 1.0;
  level->cell_volume = 1.0;
  level->boxed = box;
  for (int k = 0; k < dimension; ++k) {
    whole[k] = level->periodic[k] ? level->cells[k] : level->cells[k] + 1;
    level->nodes *= whole[k];
    level->cell_volume *= level->spacing[k];
    level->boundary[k][0] = !level->periodic[k] && (!box || box->first[k] == 0);
    level->boundary[k][1] =
        !level->periodic[k] && (!box || box->first[k] + box->nodes[k] == whole[k]);
  }
  const int *nodes = box ? box->nodes : whole;
  level->layout = fg__layout_of(dimension, nodes);
  /* whole vectors are faster; ghosts are filled after them */
  level->even_count = round_to_lanes((nodes[0] + 1) / 2);
  level->odd_count = round_to_lanes(nodes[0] / 2);
  level->rounding = fg__level_rounding(level->nodes);
  level->change_rounding = fg__level_change_rounding(level->nodes);
  level->gradient_weight = 1.0;
  level->ghost_column[0] = level->layout.odd_offset - 1;
  level->ghost_column[1] = fg__column(&level->layout, nodes[0]);
  find_ghost_sources(level, box, whole);
}

void fg__fill_ghost_row(const fg__level *level, float *array, int k, int side)
{
  int ghost = side == 0 ? -1 : level->layout.nodes[1];
  memcpy(fg__row(level, array, ghost, k),
         fg__row(level, array, level->ghost_row_source[side], k),
         (size_t)level->layout.stride * sizeof *array);
}

void fg__fill_ghost_plane(const fg__level *level, float *array, int side)
{
  int ghost = side == 0 ? -1 : level->layout.nodes[2];
  memcpy(fg__row(level, array, -1, ghost),
         fg__row(level, array, -1, level->ghost_plane_source[side]),
         (size_t)level->layout.plane * sizeof *array);
}

void fg__fill_ghosts(const fg__level *level, float *array)
{
  for (int k = 0; k < level->layout.nodes[2]; ++k) {
    for (int j = 0; j < level->layout.nodes[1]; ++j)
      fg__fill_ghost_columns(level, fg__row(level, array, j, k));
    fg__fill_ghost_row(level, array, k, 0);
    fg__fill_ghost_row(level, array, k, 1);
  }
  for (int side = 0; side < 2 && level->layout.dimension == 3; ++side)
    fg__fill_ghost_plane(level, array, side);
}

void fg__level_import(const fg__level *level, float *array, const float *plain)
{
  const int *nodes = level->layout.nodes;
  for (int k = 0; k < nodes[2]; ++k)
    for (int j = 0; j < nodes[1]; ++j) {
      float *row = fg__row(level, array, j, k);
      for (int i = 0; i < nodes[0]; ++i)
        row[fg__column(&level->layout, i)] = *plain++;
    }
}

void fg__level_export(const fg__level *level, const float *array, float *plain)
{
  const int *nodes = level->layout.nodes;
  for (int k = 0; k < nodes[2]; ++k)
    for (int j = 0; j < nodes[1]; ++j, plain += nodes[0])
      fg__row_export(&level->layout, array, j, k, plain);
}

/* Threads, where there is more than a millisecond of work (some 60 ns a node). */
static fg__threads *worth_while(const fg__level *level, fg__threads *threads)
{
  return level->nodes >= 20000.0 ? threads : NULL;
}

/* Relative mass of a node from the cells round it; beyond one of several blocks it
 * comes from those who own it. */
static void weigh_nodes(const fg__level *level)
{
  const fg__layout *at = &level->layout;
  const fg__cells_of_box *tensor = &level->tensor;
  const fg__elements *elements = &level->elements;
  int corners = 1 << at->dimension;
  for (int k = 0; k < at->nodes[2]; ++k)
    for (int j = 0; j < at->nodes[1]; ++j)
      for (int i = 0; i < at->nodes[0]; ++i) {
        double mass = 0.0;
        for (int c = 0; c < corners; ++c) {
          int x = i - (c & 1), y = j - (c >> 1 & 1), z = k - (c >> 2);
          if (elements->memory)
            mass += (double)elements->value[fg__element_mass(at->dimension, c)]
                                           [fg__element_at(elements, x, y, z)];
          else
            mass += (double)tensor->weight[fg__cell_at(tensor, x, y, z)] / corners;
        }
        *fg__node(level, level->mass, i, j, k) = (float)mass;
        *fg__node(level, level->mass_inverse, i, j, k) =
            mass > 0.0 ? (float)(1.0 / mass) : 0.0F;
      }
  if (level->boxed)
    return;
  fg__fill_ghosts(level, level->mass);
  fg__fill_ghosts(level, level->mass_inverse);
}

static fg_status take_rows(fg__level *level, fg_context *context,
                           const fg__threads *threads, bool finest, bool masked)
{
  size_t stride = (size_t)level->layout.stride;
  size_t slice = stride; /* of the next coarser level, and room to spare */
  if (level->layout.dimension == 3)
    slice = masked ? (size_t)level->layout.plane
                   : stride * ((size_t)level->layout.nodes[1] / 2 + 1);
  level->scratch_size =
      SCRATCH_QUANTITIES * (SCRATCH_SLICES * slice + SCRATCH_LINES * stride) +
      (masked ? CORRECTION_LINES : 1) * stride;
  size_t slices = level->layout.dimension == 3 ? (size_t)level->layout.plane : stride;
  slices = finest ? SHAPE_SLICES * slices : 0;
  size_t thread_count = (size_t)fg__threads_count(threads);
  size_t count = 3 * stride + thread_count * (level->scratch_size + slices);
  float *memory = fg__allocate_aligned(count, sizeof *memory);
  if (!memory)
    return fg__fail_memory(context, "a multigrid level", count * sizeof *memory);
  level->memory[level->memory_count++] = memory;
  level->column_mass = memory;
  level->column_east = level->column_mass + stride;
  level->column_west = level->column_east + stride;
  level->scratch = memory + 3 * stride;
  if (finest)
    level->shapes = level->scratch + thread_count * level->scratch_size;
  int columns = level->layout.nodes[0];
  for (int i = 0; i < columns; ++i) {
    bool first = level->boundary[0][0] && i == 0;
    bool last = level->boundary[0][1] && i == columns - 1;
    ptrdiff_t n = fg__column(&level->layout, i);
    level->column_mass[n] = first || last ? 0.5F : 1.0F;
    level->column_east[n] = last ? 0.0F : 1.0F;
    level->column_west[n] = first ? 0.0F : 1.0F;
  }
  return FG_STATUS_OK;
}

static fg_status take_stencil(fg__level *level, fg_context *context, fg__stencil *out)
{
  float **arrays[1 + FG__MOST_COUPLINGS];
  int count = fg__coupling_count(level->layout.dimension);
  for (int n = 0; n < count; ++n)
    arrays[n] = &out->to[n];
  arrays[count] = &out->center;
  return take_arrays(level, context, arrays, count + 1);
}

static fg_status take_mask(fg__level *level, fg_context *context, bool masked,
                           fg__threads *threads)
{
  if (!masked)
    return FG_STATUS_OK;
  float **arrays[2 + FG__MOST_CORNERS] = {&level->mass, &level->mass_inverse};
  int sides = 1 << level->layout.dimension;
  for (int n = 0; n < sides; ++n)
    arrays[2 + n] = &level->interpolation[n];
  fg_status status = take_arrays(level, context, arrays, 2 + sides);
  if (!status)
    status = take_stencil(level, context, &level->laplacian);
  if (status)
    return status;
  fg__stencil_assemble(level, &level->laplacian, 1.0, true, worth_while(level, threads));
  weigh_nodes(level);
  for (int stage = 0; stage <= level->layout.dimension && !level->boxed; ++stage) {
    fg__interpolation_find(level, stage);
    for (int n = 0; n < sides; ++n)
      fg__fill_ghosts(level, level->interpolation[n]);
    fg__interpolation_mirror(level);
  }
  return FG_STATUS_OK;
}

fg_status fg__level_create(fg__level *out, fg_context *context,
                           const fg__level_description *description,
                           fg__cells_of_box *tensor, fg__elements *elements)
{
  *out = (fg__level){.layout.dimension = description->dimension};
  bool masked = description->masked || elements;
  if (elements) {
    out->elements = *elements;
    *elements = (fg__elements){0};
  }
  if (tensor) {
    out->tensor = *tensor;
    *tensor = (fg__cells_of_box){0};
  }
  for (int k = 0; k < 3; ++k) {
    bool used = k < description->dimension;
    out->cells[k] = used ? description->cells[k] : 1;
    out->periodic[k] = used && description->periodic[k];
    out->spacing[k] = used ? description->spacing[k] : 1.0;
  }
  lay_out(out, description->box);
  float **const arrays[] = {&out->u,         &out->w,
                            &out->p,         &out->q,
                            &out->coupling,  &out->shape_curvature,
                            &out->scale,     &out->scale_inverse,
                            &out->curvature, &out->relaxation};
  fg_status status =
      take_rows(out, context, description->threads, description->finest, masked);
  if (!status)
    status = take_arrays(out, context, arrays, description->finest ? 3 : 10);
  if (!status)
    status = take_stencil(out, context, &out->energy);
  if (status)
    return status;
  fg__stencil_assemble(out, &out->energy, description->gamma, false,
                       worth_while(out, description->threads));
  fg__stencil_set_constants(out);
  return take_mask(out, context, masked, description->threads);
}

bool fg__level_can_coarsen(const fg__level *level)
{
  for (int k = 0; k < level->layout.dimension; ++k)
    if (level->cells[k] % 2 != 0 || level->cells[k] < 4)
      return false;
  return true;
}

fg_status fg__level_coarsen_cells(fg__elements *out, fg_context *context,
                                  const fg__level *fine, double gamma, const int nodes[3],
                                  const int count[3], fg__threads *threads)
{
  fg__fine_cells cells = {.tensor = fine->elements.memory ? NULL : &fine->tensor,
                          .elements = &fine->elements,
                          .spacing = fine->spacing,
                          .gamma = gamma,
                          .layout = &fine->layout,
                          .interpolation = fine->interpolation};
  return fg__elements_coarsen(out, context, &cells, nodes, count, threads);
}

fg_status fg__level_create_coarser(fg__level *out, fg_context *context,
                                   const fg__level *fine, double gamma,
                                   fg__threads *threads)
{
  fg__level_description description = {
      .dimension = fine->layout.dimension, .gamma = gamma, .threads = threads};
  for (int k = 0; k < 3; ++k) {
    description.cells[k] = fine->cells[k] / 2;
    description.periodic[k] = fine->periodic[k];
    description.spacing[k] = 2.0 * fine->spacing[k];
  }
  *out = (fg__level){0};
  fg_status status;
  fg__box whole = {{0, 0, 0}, {1, 1, 1}};
  int count[3] = {1, 1, 1};
  for (int k = 0; k < description.dimension; ++k) {
    count[k] = description.cells[k];
    whole.nodes[k] = count[k] + !fine->periodic[k];
  }
  if (fine->mass) {
    fg__elements elements;
    status = fg__level_coarsen_cells(&elements, context, fine, gamma, whole.nodes, count,
                                     worth_while(fine, threads));
    if (status)
      return status;
    fg__elements_fill_images(&elements, &whole, count, fine->periodic);
    return fg__level_create(out, context, &description, NULL, &elements);
  }
  fg__cells_of_box tensor;
  status = fg__cells_coarsen(&tensor, context, &fine->tensor, &whole, count,
                             worth_while(fine, threads));
  if (status)
    return status;
  fg__cells_fill_images(&tensor, &whole, count, fine->periodic);
  return fg__level_create(out, context, &description, &tensor, NULL);
}

void fg__level_clear(fg__level *level)
{
  fg__cells_clear(&level->tensor);
  fg__elements_clear(&level->elements);
  for (int n = 0; n < level->memory_count; ++n)
    free(level->memory[n]);
  *level = (fg__level){0};
}
