#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "tensor/tensor.h"

/* The box with what smoothing reaches round it: up to the boundary of the domain, or
 * beyond the ends of a periodic axis unless that makes it the whole axis. */
static fg__cells widened(const fg__cells *cells, const bool periodic[3], double width)
{
  fg__cells wide = *cells;
  for (int k = 0; k < cells->dimension; ++k) {
    int all = fg__domain_count(cells, k), radius = fg__smoothing_radius(cells, k, width);
    int first = cells->first[k] - radius;
    int end = cells->first[k] + cells->count[k] + radius;
    if (periodic[k] && end - first >= all) {
      first = 0;
      end = all;
    } else if (!periodic[k]) {
      first = first > 0 ? first : 0;
      end = end < all ? end : all;
    }
    wide.domain_count[k] = all;
    wide.first[k] = first;
    wide.count[k] = end - first;
  }
  return wide;
}

fg__cells fg__tensor_reach(const fg_energy_law *law, const fg__cells *cells,
                           const bool periodic[3], double width)
{
  if (!law || !law->axes || !(width > 0.0))
    return *cells;
  return widened(cells, periodic, width);
}

static bool is_same(const fg__cells *a, const fg__cells *b)
{
  for (int k = 0; k < a->dimension; ++k)
    if (a->first[k] != b->first[k] || a->count[k] != b->count[k])
      return false;
  return true;
}

/* Index within the wide box of the n-th cell of the box along axis k. */
static size_t place(const fg__cells *cells, const fg__cells *wide, int k, int n)
{
  int all = wide->domain_count[k];
  return (size_t)(((cells->first[k] + n - wide->first[k]) % all + all) % all);
}

/* Copies the box out of the wide one, entries of `size` bytes. */
static void cut_out(void *to, const void *from, size_t size, const fg__cells *cells,
                    const fg__cells *wide)
{
  unsigned char *out = to;
  for (int k = 0; k < fg__layers(cells); ++k)
    for (int j = 0; j < cells->count[1]; ++j) {
      size_t layer = cells->dimension == 3 ? place(cells, wide, 2, k) : 0;
      size_t row = layer * (size_t)wide->count[1] + place(cells, wide, 1, j);
      const unsigned char *in =
          (const unsigned char *)from + row * (size_t)wide->count[0] * size;
      for (int i = 0, run; i < cells->count[0]; i += run) { /* until it goes round */
        size_t at = place(cells, wide, 0, i);
        run = wide->domain_count[0] - (int)at;
        run = run < cells->count[0] - i ? run : cells->count[0] - i;
        memcpy(out, in + at * size, (size_t)run * size);
        out += (size_t)run * size;
      }
    }
}

fg_status fg__wide_tensor_create(fg__wide_tensor *out, fg_context *context,
                                 const fg__cells *reach)
{
  size_t count = fg__cell_count(reach), arrays = reach->dimension == 3 ? 6 : 3;
  float *memory = fg__allocate(count, arrays * sizeof *memory + 1);
  *out = (fg__wide_tensor){.cells = *reach, .memory = memory};
  if (!memory)
    return fg__fail_memory(context, "a box of the tensor",
                           count * (arrays * sizeof *memory + 1));
  out->tensor = (fg__tensor){.xx = memory,
                             .xy = memory + count,
                             .yy = memory + 2 * count,
                             .active = (unsigned char *)(memory + arrays * count)};
  if (reach->dimension == 3) {
    out->tensor.zz = memory + 3 * count;
    out->tensor.xz = memory + 4 * count;
    out->tensor.yz = memory + 5 * count;
  }
  return FG_STATUS_OK;
}

void fg__wide_tensor_clear(fg__wide_tensor *wide)
{
  free(wide->memory);
  *wide = (fg__wide_tensor){0};
}

fg_status fg__wide_tensor_fill(fg__wide_tensor *wide, fg_context *context,
                               const fg_field *field, const fg_energy_law *law,
                               double anisotropy, int first, int count)
{
  const int last = wide->cells.dimension - 1;
  fg__cells cells = wide->cells;
  size_t skipped = fg__cell_count(&cells) / (size_t)cells.count[last] * (size_t)first;
  for (int k = 0; k <= last; ++k)
    cells.domain_count[k] = fg__domain_count(&wide->cells, k);
  cells.first[last] += first;
  cells.count[last] = count;
  fg__tensor part = wide->tensor;
  float **array[] = {&part.xx, &part.xy, &part.yy, &part.zz, &part.xz, &part.yz};
  for (int n = 0; n < (last == 2 ? 6 : 3); ++n)
    *array[n] += skipped;
  part.active += skipped;
  return fg__tensor_fill(&part, context, field, law, anisotropy, &cells, NULL);
}

fg_status fg__wide_tensor_finish(fg__tensor *tensor, fg_context *context,
                                 fg__wide_tensor *wide, const fg_energy_law *law,
                                 double anisotropy, const fg__cells *cells,
                                 const bool periodic[3], double width)
{
  const fg__tensor *all = &wide->tensor;
  fg_status status = FG_STATUS_OK;
  if (law->axes && width > 0.0)
    status = fg__tensor_smooth(&wide->tensor, context, anisotropy, &wide->cells, periodic,
                               width, NULL);
  if (status)
    return status;
  fg__cells from_box = wide->cells;
  for (int k = 0; k < cells->dimension; ++k)
    from_box.domain_count[k] = fg__domain_count(&wide->cells, k);
  const float *from[] = {all->xx, all->xy, all->yy, all->zz, all->xz, all->yz};
  float *to[] = {tensor->xx, tensor->xy, tensor->yy, tensor->zz, tensor->xz, tensor->yz};
  for (int n = 0; n < (cells->dimension == 3 ? 6 : 3); ++n)
    cut_out(to[n], from[n], sizeof(float), cells, &from_box);
  cut_out(tensor->active, all->active, 1, cells, &from_box);
  return FG_STATUS_OK;
}

fg_status fg__tensor_fill_box(fg__tensor *tensor, fg_context *context,
                              const fg_field *field, const fg_energy_law *law,
                              double anisotropy, const fg__cells *cells,
                              const bool periodic[3], double width, fg__threads *threads)
{
  if (!law || !law->axes || !(width > 0.0))
    return fg__tensor_fill(tensor, context, field, law, anisotropy, cells, threads);
  fg__cells reach = widened(cells, periodic, width);
  if (is_same(cells, &reach)) {
    fg_status status =
        fg__tensor_fill(tensor, context, field, law, anisotropy, cells, threads);
    return status ? status
                  : fg__tensor_smooth(tensor, context, anisotropy, cells, periodic, width,
                                      threads);
  }
  fg__wide_tensor wide;
  fg_status status = fg__wide_tensor_create(&wide, context, &reach);
  if (!status)
    status = fg__wide_tensor_fill(&wide, context, field, law, anisotropy, 0,
                                  reach.count[reach.dimension - 1]);
  if (!status)
    status = fg__wide_tensor_finish(tensor, context, &wide, law, anisotropy, cells,
                                    periodic, width);
  fg__wide_tensor_clear(&wide);
  return status;
}
