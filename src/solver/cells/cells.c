#include "solver/cells/cells.h"

#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "solver/cells/images.h"

/* The axes whose mirror image changes a component's sign. */
static const unsigned char odd_axes[FG__TENSOR_COMPONENTS][2] = {{0, 0}, {0, 1}, {1, 1},
                                                                 {2, 2}, {0, 2}, {1, 2}};

static int component_count(int dimension)
{
  return dimension == 3 ? FG__TENSOR_COMPONENTS : 3;
}

static fg_status allocate(fg__cells_of_box *out, fg_context *context, int dimension,
                          const int nodes[3])
{
  fg__cell_layout layout = fg__cell_layout_of(dimension, nodes);
  *out = (fg__cells_of_box){
      .dimension = dimension, .row = layout.row, .plane = layout.plane};
  memcpy(out->nodes, layout.nodes, sizeof out->nodes);
  size_t size = layout.size, arrays = (size_t)component_count(dimension) + 1;
  float *memory = fg__allocate(size * arrays, sizeof *memory);
  if (!memory)
    return fg__fail_memory(context, "the tensor", size * arrays * sizeof *memory);
  out->memory = memory;
  float *origin = memory + layout.origin;
  for (size_t n = 0; n + 1 < arrays; ++n)
    out->component[n] = origin + n * size;
  out->weight = origin + (arrays - 1) * size;
  return FG_STATUS_OK;
}

/* The nodes of a whole level. */
static fg__box box_of_level(int dimension, const int cells[3], const bool periodic[3])
{
  fg__box out = {{0, 0, 0}, {1, 1, 1}};
  for (int k = 0; k < dimension; ++k)
    out.nodes[k] = cells[k] + !periodic[k];
  return out;
}

static void copy_image(const void *argument, ptrdiff_t to, ptrdiff_t from, int axis,
                       bool mirrored)
{
  const fg__cells_of_box *cells = argument;
  for (int c = 0; c < component_count(cells->dimension); ++c) {
    bool odd = mirrored && odd_axes[c][0] != odd_axes[c][1] &&
               (odd_axes[c][0] == axis || odd_axes[c][1] == axis);
    float value = cells->component[c][from];
    cells->component[c][to] = odd ? -value : value;
  }
  cells->weight[to] = cells->weight[from];
}

void fg__cells_fill_images(const fg__cells_of_box *cells, const fg__box *box,
                           const int level_cells[3], const bool periodic[3])
{
  fg__cell_layout layout = fg__cell_layout_of(cells->dimension, cells->nodes);
  fg__cell_images_fill(&layout, box, level_cells, periodic, copy_image, cells);
}

/* Cells to be filled, of which threads take slices along the outermost axis. */
typedef struct filling {
  const fg__cells_of_box *out;
  int first[3], count[3];       /* cells of `out` */
  const fg__tensor *tensor;     /* from this, */
  const fg__cells_of_box *fine; /* or by means over these */
} filling;

static void part_of(const filling *f, const fg__thread *thread, int begin[3], int end[3])
{
  int axis = f->out->dimension - 1;
  for (int k = 0; k < 3; ++k) {
    begin[k] = 0;
    end[k] = f->count[k];
  }
  fg__threads_range(thread, f->count[axis], 1, &begin[axis], &end[axis]);
}

static void fill_from_tensor(void *argument, const fg__thread *thread)
{
  const filling *f = argument;
  const fg__cells_of_box *out = f->out;
  const fg__tensor *t = f->tensor;
  const float *source[FG__TENSOR_COMPONENTS] = {t->xx, t->xy, t->yy, t->zz, t->xz, t->yz};
  int begin[3], end[3];
  part_of(f, thread, begin, end);
  for (int k = begin[2]; k < end[2]; ++k)
    for (int j = begin[1]; j < end[1]; ++j) {
      size_t n = ((size_t)k * (size_t)f->count[1] + (size_t)j) * (size_t)f->count[0];
      ptrdiff_t at = fg__cell_at(out, f->first[0], f->first[1] + j, f->first[2] + k);
      for (int i = 0; i < f->count[0]; ++i, ++n, ++at) {
        bool active = t->active[n];
        for (int c = 0; c < component_count(out->dimension); ++c)
          out->component[c][at] = active ? source[c][n] : 0.0F;
        out->weight[at] = active ? 1.0F : 0.0F;
      }
    }
}

fg_status fg__cells_from_tensor(fg__cells_of_box *out, fg_context *context,
                                const fg__tensor *tensor, int dimension,
                                const int cells[3], const bool periodic[3],
                                fg__threads *threads)
{
  const fg__box whole = box_of_level(dimension, cells, periodic);
  fg_status status = allocate(out, context, dimension, whole.nodes);
  if (status)
    return status;
  filling f = {.out = out,
               .count = {cells[0], cells[1], dimension == 3 ? cells[2] : 1},
               .tensor = tensor};
  fg__threads_run(threads, fill_from_tensor, &f);
  fg__cells_fill_images(out, &whole, cells, periodic);
  return FG_STATUS_OK;
}

fg_status fg__cells_from_arrays(fg__cells_of_box *out, fg_context *context,
                                const float *const values[], int dimension,
                                const int cells[3], const bool periodic[3])
{
  const fg__box whole = box_of_level(dimension, cells, periodic);
  fg_status status = allocate(out, context, dimension, whole.nodes);
  if (status)
    return status;
  int count[3] = {cells[0], cells[1], dimension == 3 ? cells[2] : 1};
  size_t n = 0;
  for (int k = 0; k < count[2]; ++k)
    for (int j = 0; j < count[1]; ++j)
      for (int i = 0; i < count[0]; ++i, ++n) {
        ptrdiff_t at = fg__cell_at(out, i, j, k);
        for (int c = 0; c < component_count(dimension); ++c)
          out->component[c][at] = values[c][n];
        out->weight[at] = values[component_count(dimension)][n];
      }
  fg__cells_fill_images(out, &whole, cells, periodic);
  return FG_STATUS_OK;
}

/* The mean of 2 x 2 (x 2) cells from the lowest one on. */
static float mean_of_corners(const float *low, ptrdiff_t row, ptrdiff_t plane,
                             int dimension)
{
  float sum = low[0] + low[1] + low[row] + low[row + 1];
  if (dimension == 2)
    return 0.25F * sum;
  low += plane;
  return 0.125F * (sum + (low[0] + low[1] + low[row] + low[row + 1]));
}

static float mean_of_cells(const fg__cells_of_box *fine, const float *values, int i,
                           int j, int k)
{
  return mean_of_corners(values + fg__cell_at(fine, 2 * i, 2 * j, 2 * k), fine->row,
                         fine->plane, fine->dimension);
}

static void fill_with_means(void *argument, const fg__thread *thread)
{
  const filling *f = argument;
  const fg__cells_of_box *out = f->out, *fine = f->fine;
  int begin[3], end[3];
  part_of(f, thread, begin, end);
  for (int k = begin[2]; k < end[2]; ++k)
    for (int j = begin[1]; j < end[1]; ++j)
      for (int i = 0; i < end[0]; ++i) {
        ptrdiff_t at = fg__cell_at(out, i, j, k);
        for (int c = 0; c < component_count(out->dimension); ++c)
          out->component[c][at] = mean_of_cells(fine, fine->component[c], i, j, k);
        out->weight[at] = mean_of_cells(fine, fine->weight, i, j, k);
      }
}

fg_status fg__cells_coarsen(fg__cells_of_box *out, fg_context *context,
                            const fg__cells_of_box *fine, const fg__box *box,
                            const int level_cells[3], fg__threads *threads)
{
  fg_status status = allocate(out, context, fine->dimension, box->nodes);
  if (status)
    return status;
  filling f = {.out = out, .count = {1, 1, 1}, .fine = fine};
  for (int k = 0; k < fine->dimension; ++k) {
    int left = level_cells[k] - box->first[k]; /* the last node begins no cell */
    f.count[k] = box->nodes[k] < left ? box->nodes[k] : left;
  }
  fg__threads_run(threads, fill_with_means, &f);
  return FG_STATUS_OK;
}

/* True cells [low, low + count) of a level along each axis, those of a box and one
 * beyond, none for an empty box; beyond natural boundaries there are none, nor beyond a
 * box that is all of a period. */
typedef struct range {
  int low[3], count[3];
} range;

static range range_of(int dimension, const bool periodic[3], const fg__box *box,
                      const int level_cells[3])
{
  range r = {{0, 0, 0}, {1, 1, 1}};
  if (fg__box_is_empty(box))
    return (range){.count = {0}};
  for (int k = 0; k < dimension; ++k) {
    int low = box->first[k] - 1, high = box->first[k] + box->nodes[k];
    bool ends = !periodic[k] || box->nodes[k] == level_cells[k];
    if (ends && low < 0)
      low = 0;
    if (ends && high > level_cells[k])
      high = level_cells[k];
    r.low[k] = low;
    r.count[k] = high - low;
  }
  return r;
}

static fg__cells cells_of(const fg__tensor_recipe *recipe, const range *r)
{
  fg__cells cells = {.dimension = recipe->dimension};
  for (int k = 0; k < recipe->dimension; ++k) {
    cells.count[k] = r->count[k];
    cells.first[k] = r->low[k];
    cells.domain_count[k] = recipe->cells[k];
    cells.origin[k] = recipe->origin[k];
    cells.spacing[k] = recipe->spacing[k];
  }
  return cells;
}

fg__cells fg__cells_needed(const fg__tensor_recipe *recipe, const fg__box *box)
{
  range r = range_of(recipe->dimension, recipe->periodic, box, recipe->cells);
  fg__cells cells = cells_of(recipe, &r);
  if (fg__box_is_empty(box))
    return cells;
  return fg__tensor_reach(recipe->law, &cells, recipe->periodic, recipe->width);
}

/* Arrays for the tensor of so many cells. */
static fg_status take_tensor(fg__tensor *out, fg_context *context, int dimension,
                             size_t count)
{
  size_t components = (size_t)component_count(dimension);
  float *memory = fg__allocate(count, components * sizeof *memory + 1);
  *out = (fg__tensor){.xx = memory};
  if (!memory)
    return fg__fail_memory(context, "the tensor",
                           count * (components * sizeof *memory + 1));
  out->xy = memory + count;
  out->yy = memory + 2 * count;
  if (dimension == 3) {
    out->zz = memory + 3 * count;
    out->xz = memory + 4 * count;
    out->yz = memory + 5 * count;
  }
  out->active = (unsigned char *)(memory + components * count);
  return FG_STATUS_OK;
}

static fg_status fill_tensor(fg__tensor *out, fg_context *context,
                             const fg__tensor_recipe *recipe, fg__wide_tensor *wide,
                             const fg__cells *cells, fg__threads *threads)
{
  if (wide->memory)
    return fg__wide_tensor_finish(out, context, wide, recipe->law, recipe->anisotropy,
                                  cells, recipe->periodic, recipe->width);
  return fg__tensor_fill_box(out, context, recipe->field, recipe->law, recipe->anisotropy,
                             cells, recipe->periodic, recipe->width, threads);
}

fg_status fg__cells_for_box(fg__cells_of_box *out, fg_context *context,
                            const fg__tensor_recipe *recipe, const fg__box *box,
                            fg__wide_tensor *wide, fg__threads *threads)
{
  int dimension = recipe->dimension;
  range r = range_of(dimension, recipe->periodic, box, recipe->cells);
  fg__cells cells = cells_of(recipe, &r);
  fg__tensor tensor;
  *out = (fg__cells_of_box){0};
  fg_status status = take_tensor(&tensor, context, dimension, fg__cell_count(&cells));
  if (!status && !fg__box_is_empty(box))
    status = fill_tensor(&tensor, context, recipe, wide, &cells, threads);
  fg__wide_tensor_clear(wide);
  if (!status)
    status = allocate(out, context, dimension, box->nodes);
  if (!status) {
    filling f = {.out = out, .tensor = &tensor};
    for (int k = 0; k < 3; ++k) {
      f.first[k] = k < dimension ? r.low[k] - box->first[k] : 0;
      f.count[k] = r.count[k];
    }
    fg__threads_run(threads, fill_from_tensor, &f);
    fg__cells_fill_images(out, box, recipe->cells, recipe->periodic);
  }
  free(tensor.xx);
  return status;
}

unsigned char *fg__cells_mask(const fg__cells_of_box *cells, ptrdiff_t *origin)
{
  fg__cell_layout layout = fg__cell_layout_of(cells->dimension, cells->nodes);
  *origin = layout.origin;
  unsigned char *active = fg__allocate(layout.size, 1);
  for (size_t n = 0; n < layout.size && active; ++n)
    active[n] = cells->weight[(ptrdiff_t)n - *origin] > 0.0F;
  return active;
}

void fg__cells_clear(fg__cells_of_box *cells)
{
  free(cells->memory);
  *cells = (fg__cells_of_box){0};
}
