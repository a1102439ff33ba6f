#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "tensor/tensor.h"

/* The box with what smoothing reaches round it: up to the border of the domain, or beyond
 * the ends of a periodic axis unless that makes it the whole axis. */
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

static fg_status fill_and_smooth(fg__tensor *tensor, fg_context *context,
                                 const fg_field *field, const fg_energy_law *law,
                                 double anisotropy, const fg__cells *cells,
                                 const bool periodic[3], double width)
{
  fg_status status =
      fg__tensor_fill(tensor, context, field, law, anisotropy, cells, NULL);
  return status ? status
                : fg__tensor_smooth(tensor, context, anisotropy, cells, periodic, width,
                                    NULL);
}

fg_status fg__tensor_fill_box(fg__tensor *tensor, fg_context *context,
                              const fg_field *field, const fg_energy_law *law,
                              double anisotropy, const fg__cells *cells,
                              const bool periodic[3], double width)
{
  if (!law || !law->axes || !(width > 0.0))
    return fg__tensor_fill(tensor, context, field, law, anisotropy, cells, NULL);
  fg__cells wide = widened(cells, periodic, width);
  if (is_same(cells, &wide))
    return fill_and_smooth(tensor, context, field, law, anisotropy, cells, periodic,
                           width);

  size_t count = fg__cell_count(&wide), arrays = cells->dimension == 3 ? 6 : 3;
  float *memory = fg__allocate(count, arrays * sizeof *memory);
  unsigned char *active = fg__allocate(count, 1);
  fg_status status = FG_STATUS_OK;
  if (!memory || !active) {
    status = fg__fail_memory(context, "a box of the tensor",
                             count * (arrays * sizeof *memory + 1));
    goto cleanup;
  }
  fg__tensor all = {
      .xx = memory, .xy = memory + count, .yy = memory + 2 * count, .active = active};
  if (cells->dimension == 3) {
    all.zz = memory + 3 * count;
    all.xz = memory + 4 * count;
    all.yz = memory + 5 * count;
  }
  status = fill_and_smooth(&all, context, field, law, anisotropy, &wide, periodic, width);
  if (status)
    goto cleanup;
  const float *from[] = {all.xx, all.xy, all.yy, all.zz, all.xz, all.yz};
  float *to[] = {tensor->xx, tensor->xy, tensor->yy, tensor->zz, tensor->xz, tensor->yz};
  for (size_t n = 0; n < arrays; ++n)
    cut_out(to[n], from[n], sizeof(float), cells, &wide);
  cut_out(tensor->active, active, 1, cells, &wide);
cleanup:
  free(memory);
  free(active);
  return status;
}
