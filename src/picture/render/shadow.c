#include "picture/render/shadow.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "base/vector.h"
#include "picture/render/light.h"

/* Texels along a side at most: no picture is larger. */
static const double most_texels = 8192.0;

/* Side of a texel in pixels, in the middle of the box. */
static const double texel_pixels = 1.0;

/* What is lower casts no shadow: it touches the floor. In longest sides of the box. */
static const double off_floor = 2e-5;

/* A triangle in units of texels: its corners on the floor, and their heights. */
typedef struct footprint {
  double at[3][2], above[3];
  bool clipped;
} footprint;

static void find_footprint(const fg__shadow *s, const fg__caster *caster, footprint *out)
{
  for (int n = 0; n < 3; ++n) {
    for (int k = 0; k < 2; ++k)
      out->at[n][k] = (caster->at[n][k] - s->low[k]) / s->texel;
    out->above[n] = (caster->at[n][2] - s->height) / s->texel;
  }
  out->clipped = caster->clipped;
}

/* The texels whose places may lie in a triangle; first > last: none. */
static inline fg__band_rows texels_between(const double at[3][2], int axis, int first,
                                           int last)
{
  double low = fg__least(fg__least(at[0][axis], at[1][axis]), at[2][axis]);
  double high = fg__most(fg__most(at[0][axis], at[1][axis]), at[2][axis]);
  if (!(high >= first) || !(low <= last))
    return (fg__band_rows){0, -1};
  int begin = (int)fg__most(low, first);
  begin += low > begin;
  return (fg__band_rows){begin, (int)fg__least(high, last)};
}

/* Whether the point above a texel that hides it from a lamp lies in the box. */
static bool is_inside(const fg__shadow *s, const fg__lamp *lamp, double above, int x,
                      int y)
{
  const int texel[2] = {x, y};
  if (above * s->texel > 2.0 * s->bound[2])
    return false;
  for (int k = 0; k < 2; ++k)
    if (fabs(s->low[k] + s->texel * (texel[k] + lamp->place[k] +
                                     above * lamp->slope[k])) > s->bound[k])
      return false;
  return true;
}

/* Marks the texels of a band, whose first row is `row`, that a triangle hides from a
 * lamp. A triangle that faces away from the light has another before it, but where the
 * box cuts an arrow open. */
static void mark(const fg__shadow *s, int number, const footprint *f, int row, int rows,
                 uint32_t *marks)
{
  const fg__lamp *lamp = &s->lamp[number];
  double at[3][2], value[3], step[3][2];
  for (int n = 0; n < 3; ++n)
    for (int k = 0; k < 2; ++k)
      at[n][k] = f->at[n][k] - f->above[n] * lamp->slope[k] - lamp->place[k];
  fg__band_rows columns = texels_between((const double(*)[2])at, 0, 0, s->size[0] - 1);
  if (columns.first > columns.last)
    return;
  fg__band_rows lines = texels_between((const double(*)[2])at, 1, row, row + rows - 1);
  double area = (at[1][0] - at[0][0]) * (at[2][1] - at[0][1]) -
                (at[1][1] - at[0][1]) * (at[2][0] - at[0][0]);
  if (lines.first > lines.last || !(f->clipped ? fabs(area) > 0.0 : area > 0.0))
    return;
  for (int n = 0; n < 3; ++n) { /* not negative inside */
    const double *a = at[(n + 1) % 3], *b = at[(n + 2) % 3];
    double sign = area > 0.0 ? 1.0 : -1.0;
    step[n][0] = sign * (a[1] - b[1]);
    step[n][1] = sign * (b[0] - a[0]);
    value[n] = sign * (a[0] * b[1] - a[1] * b[0]);
  }
  for (int y = lines.first; y <= lines.last; ++y)
    for (int x = columns.first; x <= columns.last; ++x) {
      double share[3], above = 0.0;
      for (int n = 0; n < 3; ++n)
        share[n] = value[n] + step[n][0] * x + step[n][1] * y;
      if (share[0] < 0.0 || share[1] < 0.0 || share[2] < 0.0)
        continue;
      for (int n = 0; n < 3; ++n)
        above += share[n] * f->above[n] / fabs(area);
      if (above * s->texel < off_floor ||
          (f->clipped && !is_inside(s, lamp, above, x, y)))
        continue;
      marks[(ptrdiff_t)(y - row) * s->size[0] + x] |= 1U << number;
    }
}

void fg__shadow_fill(fg__shadow *s, int band, uint32_t *marks)
{
  int row = band * FG__BAND, rows = s->size[1] - row;
  rows = rows < FG__BAND ? rows : FG__BAND;
  size_t texels = (size_t)rows * (size_t)s->size[0];
  if (s->bands.first[band] == s->bands.first[band + 1])
    return; /* the raster is empty from the beginning */
  memset(marks, 0, texels * sizeof *marks);
  for (size_t n = s->bands.first[band]; n < s->bands.first[band + 1]; ++n) {
    footprint f;
    find_footprint(s, &s->caster[s->bands.member[n]], &f);
    for (int lamp = 0; lamp < FG__LAMPS; ++lamp)
      mark(s, lamp, &f, row, rows, marks);
  }
  uint8_t *hidden = s->hidden + (size_t)row * (size_t)s->size[0];
  for (size_t n = 0; n < texels; ++n)
    hidden[n] = (uint8_t)__builtin_popcount(marks[n]);
}

/* The rows that a triangle's shadow may touch, whatever the lamp. */
static fg__band_rows rows_of(const fg__shadow *s, const fg__caster *caster)
{
  double low = HUGE_VAL, high = -HUGE_VAL;
  for (int n = 0; n < 3; ++n) {
    double reach = fabs(caster->at[n][2] - s->height) * fg__overhead_size;
    low = fg__least(low, caster->at[n][1] - reach);
    high = fg__most(high, caster->at[n][1] + reach);
  }
  return fg__rows_between((low - s->low[1]) / s->texel - 1.0,
                          (high - s->low[1]) / s->texel + 1.0, s->size[1]);
}

static fg_status sort_casters(fg__shadow *s, fg_context *context, size_t count)
{
  fg__band_rows *rows = fg__allocate(count, sizeof *rows);
  if (!rows)
    return fg__fail_memory(context, "shadows", count * sizeof *rows);
  for (size_t n = 0; n < count; ++n)
    rows[n] = rows_of(s, &s->caster[n]);
  fg_status status = fg__bands_make(&s->bands, context, rows, count, s->size[1]);
  free(rows);
  return status;
}

fg_status fg__shadow_make(fg__shadow *out, fg_context *context,
                          const fg__rendering *about, const fg__geometry *geometry)
{
  const double *half = about->view_box.half;
  double pixel = fg__length(about->camera.eye) / about->camera.factor;
  *out = (fg__shadow){.caster = geometry->caster, .bound = half, .height = -half[2]};
  if (geometry->caster_count == 0)
    return FG_STATUS_OK;
  out->texel =
      fmax(texel_pixels * pixel, 2.0 * fmax(half[0], half[1]) / (most_texels - 1.0));
  for (int k = 0; k < 2; ++k) {
    out->low[k] = -half[k];
    out->size[k] = (int)ceil(2.0 * half[k] / out->texel) + 1;
  }
  for (int n = 0; n < FG__LAMPS; ++n)
    fg__overhead_place(n, FG__LAMPS, out->lamp[n].slope, out->lamp[n].place);
  size_t texels = (size_t)out->size[0] * (size_t)out->size[1];
  out->hidden = fg__allocate(texels, sizeof *out->hidden);
  if (!out->hidden)
    return fg__fail_memory(context, "shadows", texels);
  return sort_casters(out, context, geometry->caster_count);
}

void fg__shadow_clear(fg__shadow *shadow)
{
  free(shadow->hidden);
  fg__bands_clear(&shadow->bands);
  *shadow = (fg__shadow){.hidden = NULL};
}

double fg__shadow_light(const fg__shadow *s, const double place[3])
{
  int texel[2];
  double share[2];
  if (!s->hidden)
    return 1.0;
  for (int k = 0; k < 2; ++k) { /* between the texels' middles */
    double at = fmax((place[k] - s->low[k]) / s->texel - 0.5, 0.0);
    texel[k] = (int)fmin(at, s->size[k] - 2.0);
    texel[k] = texel[k] > 0 ? texel[k] : 0;
    share[k] = fmin(at - texel[k], 1.0);
  }
  const uint8_t *row = s->hidden + (ptrdiff_t)texel[1] * s->size[0] + texel[0];
  int right = s->size[0] > 1, above = s->size[1] > 1 ? s->size[0] : 0;
  double lower = (1.0 - share[0]) * row[0] + share[0] * row[right];
  double upper = (1.0 - share[0]) * row[above] + share[0] * row[above + right];
  return 1.0 - ((1.0 - share[1]) * lower + share[1] * upper) / FG__LAMPS;
}
