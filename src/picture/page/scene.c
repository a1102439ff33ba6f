#include "picture/page/scene.h"

#include "base/memory.h"
#include "field/mask.h"
#include "icon/icons.h"
#include "icon/measure.h"
#include "picture/polygons.h"

#include <math.h>
#include <stdlib.h>

/* Vertices that move an outline by less are dropped, points: a pixel of a printer with
 * 3600 dots an inch; the areas behind the arrows have no sharp details. */
static const double outline_tolerance = 0.02;
static const double area_tolerance = 0.06;

/* Finer masks than so many cells a point are sampled: nobody sees the difference. */
static const double mask_cells_a_point = 2.0;

/* Round what is valid this share of its longer side stays, so that its shape is seen. Who
 * frames a field wide by choice, with less than a quarter of nothing, gets it so. */
static const double shown_margin = 0.04;
static const double most_shown = 0.75;

void fg__scene_box(double low[2], double high[2], const fg_field_arrays *field)
{
  for (int k = 0; k < 2; ++k) {
    low[k] = field->axis[k][0];
    high[k] = field->period[k] > 0.0 ? low[k] + field->period[k]
                                     : field->axis[k][field->size[k] - 1];
  }
}

/* Whether a sample with such a place along axis k is valid. */
static bool has_valid(const fg_field *field, int k, int place)
{
  const int *size = fg_field_contents(field)->size;
  for (int n = 0; n < size[1 - k]; ++n)
    if (fg__field_sample_is_valid(field, k == 0 ? place : n, k == 0 ? n : place))
      return true;
  return false;
}

void fg__scene_shown(double low[2], double high[2], const fg_field *field)
{
  const fg_field_arrays *grid = fg_field_contents(field);
  double area = 1.0, shown_low[2], shown_high[2], larger = 0.0;
  fg__scene_box(low, high, grid);
  for (int k = 0; k < 2; ++k) {
    int first = 0, last = grid->size[k] - 1;
    while (first < last && !has_valid(field, k, first))
      ++first;
    while (last > first && !has_valid(field, k, last))
      --last;
    bool whole = grid->period[k] > 0.0;
    shown_low[k] = whole ? low[k] : grid->axis[k][first];
    shown_high[k] = whole ? high[k] : grid->axis[k][last];
    larger = fmax(larger, shown_high[k] - shown_low[k]);
  }
  for (int k = 0; k < 2; ++k) {
    shown_low[k] = fmax(shown_low[k] - shown_margin * larger, low[k]);
    shown_high[k] = fmin(shown_high[k] + shown_margin * larger, high[k]);
    area *= (shown_high[k] - shown_low[k]) / (high[k] - low[k]);
  }
  if (!(larger > 0.0) || area > most_shown)
    return;
  for (int k = 0; k < 2; ++k) {
    low[k] = shown_low[k];
    high[k] = shown_high[k];
  }
}

/* From coordinates to the page. */
typedef struct placement {
  const fg__page *page;
  const double *low; /* of its frame */
} placement;

static void place_all(const placement *p, fg__polygons *polygons)
{
  for (size_t n = 0; n < polygons->point_count; ++n)
    fg__page_project(p->page, p->low, polygons->point[n]);
}

/* Cells of a mask along one axis: their edges, and the data cell that each shows. */
typedef struct mask_axis {
  int count;
  double *edge;
  int *cell;
} mask_axis;

static void mask_axis_clear(mask_axis *axis)
{
  free(axis->edge);
  free(axis->cell);
}

/* scale: points a unit of the coordinates. */
static bool mask_axis_create(mask_axis *out, const fg_field_arrays *field, int k,
                             double scale)
{
  int samples = field->size[k];
  int cells = field->period[k] > 0.0 ? samples : samples - 1;
  double low = field->axis[k][0];
  double high =
      field->period[k] > 0.0 ? low + field->period[k] : field->axis[k][samples - 1];
  double most = fmax(ceil(mask_cells_a_point * scale * (high - low)), 1.0);
  bool sampled = cells > most;
  out->count = sampled ? (int)most : cells;
  out->edge = fg__allocate((size_t)out->count + 1, sizeof *out->edge);
  out->cell = fg__allocate((size_t)out->count, sizeof *out->cell);
  if (!out->edge || !out->cell)
    return false;
  int at = 0;
  for (int n = 0; n < out->count; ++n) {
    out->edge[n] = sampled ? low + (high - low) * n / out->count : field->axis[k][n];
    double middle = low + (high - low) * (n + 0.5) / out->count;
    while (sampled && at + 1 < cells && field->axis[k][at + 1] <= middle)
      ++at;
    out->cell[n] = sampled ? at : n;
  }
  out->edge[out->count] = high;
  return true;
}

static bool sample_valid(const fg_field *field, int i, int j)
{
  const int *size = fg_field_contents(field)->size;
  return fg__field_sample_is_valid(field, i == size[0] ? 0 : i, j == size[1] ? 0 : j);
}

/* Whether samples at a cell's corners are missing; of a cell that the outline of a map
 * cuts, those that are on the map. */
static bool cell_masked(const fg_field *field, const fg__polygons *outline, int i, int j)
{
  const fg_field_arrays *grid = fg_field_contents(field);
  int valid = 0, beyond = 0;
  for (int k = 0; k < 4; ++k)
    valid += sample_valid(field, i + k % 2, j + k / 2);
  for (int k = 0; k < 4 && outline && outline->count && valid > 0 && valid < 4; ++k)
    beyond += !sample_valid(field, i + k % 2, j + k / 2) &&
              !fg__polygon_contains(outline, 0, grid->axis[0][i + k % 2],
                                    grid->axis[1][j + k / 2]);
  return valid + beyond < 4;
}

/* In the field's coordinates. */
static fg_status make_mask(fg__polygons *out, fg_context *context, const fg__page *page,
                           const fg_field *field, const fg__polygons *outline)
{
  fg_status status = FG_STATUS_OK;
  const fg_field_arrays *grid = fg_field_contents(field);
  mask_axis axis[2] = {{0}, {0}};
  unsigned char *mask = NULL;
  if (!mask_axis_create(&axis[0], grid, 0, page->scale) ||
      !mask_axis_create(&axis[1], grid, 1, page->scale)) {
    status = fg__fail_memory(context, "the mask's grid", sizeof axis);
    goto cleanup;
  }
  size_t count = (size_t)axis[0].count * (size_t)axis[1].count;
  mask = fg__allocate(count, 1);
  if (!mask) {
    status = fg__fail_memory(context, "the mask", count);
    goto cleanup;
  }
  unsigned char *next = mask;
  for (int j = 0; j < axis[1].count; ++j)
    for (int i = 0; i < axis[0].count; ++i)
      *next++ = cell_masked(field, outline, axis[0].cell[i], axis[1].cell[j]);
  const int size[2] = {axis[0].count, axis[1].count};
  const double *const edges[2] = {axis[0].edge, axis[1].edge};
  status = fg__contour_cells(out, context, mask, size, edges);
cleanup:
  free(mask);
  mask_axis_clear(&axis[0]);
  mask_axis_clear(&axis[1]);
  return status;
}

fg_status fg__scene_mask(fg__polygons *out, fg_context *context, const fg__page *page,
                         const fg_field *field, const double low[2],
                         const fg__polygons *outline)
{
  const placement p = {page, low};
  fg_status status = make_mask(out, context, page, field, outline);
  if (status)
    return status;
  place_all(&p, out);
  fg__polygons_simplify(out, area_tolerance);
  return FG_STATUS_OK;
}

static bool add_outline(fg__polygons *out, const fg_icon *icon, const placement *p,
                        const double offset[2])
{
  double(*vertices)[2] = NULL;
  int count = 0;
  if (fg_icon_outline(icon, &vertices, &count))
    return false;
  bool good = fg__polygons_begin(out);
  for (int n = 0; good && n < count; ++n) {
    double point[2] = {vertices[n][0] + offset[0], vertices[n][1] + offset[1]};
    fg__page_project(p->page, p->low, point);
    good = fg__polygons_add(out, point);
  }
  free(vertices);
  return good;
}

/* Whole periods by which an icon is moved so that some of it lies in the domain. */
static void period_range(int range[2], const fg_icon *icon, int k, double low,
                         double high, double period)
{
  range[0] = range[1] = 0;
  if (!(period > 0.0))
    return;
  double least = icon->points[0][k], most = least;
  for (int n = 1; n < icon->point_count; ++n) {
    least = fmin(least, icon->points[n][k]);
    most = fmax(most, icon->points[n][k]);
  }
  double reach = fmax(icon->head_width, icon->width);
  /* an icon from a file may be anywhere: two periods either way is what this one draws */
  range[0] = (int)fmax(ceil((low - most - reach) / period), -2.0);
  range[1] = (int)fmin(floor((high - least + reach) / period), 2.0);
}

/* Whether an icon lies all on one side of an outline: no edge of it is in its box. */
static bool is_clear_of(const fg_icon *icon, const fg__polygons *outline)
{
  double low[2] = {HUGE_VAL, HUGE_VAL}, high[2] = {-HUGE_VAL, -HUGE_VAL};
  for (int n = 0; n < icon->point_count; ++n)
    for (int k = 0; k < 2; ++k) {
      low[k] = fmin(low[k], icon->points[n][k]);
      high[k] = fmax(high[k], icon->points[n][k]);
    }
  const size_t count = outline->start[1];
  for (size_t n = 0; n < count; ++n) {
    const double *a = outline->point[n], *b = outline->point[n + 1 < count ? n + 1 : 0];
    if (fmax(a[0], b[0]) >= low[0] && fmin(a[0], b[0]) <= high[0] &&
        fmax(a[1], b[1]) >= low[1] && fmin(a[1], b[1]) <= high[1])
      return false;
  }
  return true;
}

/* Whether a point, or a copy of it by a period, is in the frame. */
static bool is_within(const fg_field_arrays *field, const double point[3],
                      const double low[2], const double high[2])
{
  for (int k = 0; k < 2; ++k) {
    const double period = field->period[k];
    const double turns = period > 0.0 ? floor((point[k] - low[k]) / period) : 0.0;
    const double at = point[k] - turns * period;
    if (at < low[k] || at > high[k])
      return false;
  }
  return true;
}

/* Whether a head is in the frame, and at least half of its line. */
static bool is_shown(const fg_field_arrays *field, const fg_icon *icon,
                     const double low[2], const double high[2],
                     const fg__polygons *outline)
{
  double all = 0.0, shown = 0.0;
  bool within = false, before = false, inside = true;
  const bool cut = outline->count && !is_clear_of(icon, outline);
  if (outline->count)
    inside = fg__polygon_contains(outline, 0, icon->points[0][0], icon->points[0][1]);
  for (int n = 0; n < icon->point_count; ++n, before = within) {
    const double *at = icon->points[n], *from = icon->points[n > 0 ? n - 1 : 0];
    const double length = hypot(at[0] - from[0], at[1] - from[1]);
    if (cut)
      inside = fg__polygon_contains(outline, 0, at[0], at[1]);
    within = inside && is_within(field, at, low, high);
    all += length;
    shown += within && before ? length : 0.0;
  }
  return within && shown >= 0.5 * all;
}

fg_status fg__scene_keep_shown(fg_icons **out, fg_context *context,
                               const fg_field_arrays *field, const fg_icons *icons,
                               const double low[2], const double high[2],
                               const fg__polygons *outline)
{
  const int count = fg_icons_count(icons);
  *out = NULL;
  fg_status status = fg__icons_create_empty(out, context);
  for (int n = 0; n < count && !status; ++n) {
    const fg_icon *icon = fg_icons_at(icons, n);
    if (is_shown(field, icon, low, high, outline))
      status = fg__icons_add(*out, context, icon);
  }
  if (!status && fg_icons_count(*out) < count)
    return FG_STATUS_OK;
  fg_icons_destroy(*out);
  *out = NULL;
  return status;
}

static fg_status make_arrows(fg__scene *out, fg_context *context, const placement *p,
                             const double high[2], const fg_field_arrays *field,
                             const fg_icons *icons, const fg__palette *palette,
                             const double range[2])
{
  size_t capacity = 0;
  for (int n = 0; n < fg_icons_count(icons); ++n) {
    const fg_icon *icon = fg_icons_at(icons, n);
    double share = (icon->speed - range[0]) / (range[1] - range[0]);
    int shift[2][2];
    for (int k = 0; k < 2; ++k)
      period_range(shift[k], icon, k, p->low[k], high[k], field->period[k]);
    for (int sy = shift[1][0]; sy <= shift[1][1]; ++sy) {
      for (int sx = shift[0][0]; sx <= shift[0][1]; ++sx) {
        const double offset[2] = {sx * field->period[0], sy * field->period[1]};
        void *colors = out->arrow_color;
        bool good =
            fg__grow(&colors, &capacity, out->arrows.count + 1, sizeof *out->arrow_color);
        out->arrow_color = colors;
        if (!good || !add_outline(&out->arrows, icon, p, offset))
          return fg__fail_memory(context, "the arrows' outlines",
                                 out->arrows.point_count * sizeof *out->arrows.point);
        out->arrow_color[out->arrows.count - 1] = fg__palette_color(palette, share);
      }
    }
  }
  return FG_STATUS_OK;
}

typedef struct ranked_icon {
  double key;
  int index;
  const fg_icon *icon;
} ranked_icon;

static int compare_keys(const void *a, const void *b)
{
  const ranked_icon *one = a, *other = b;
  if (one->key != other->key)
    return one->key < other->key ? -1 : 1;
  return one->index - other->index;
}

fg_status fg__scene_typical_icon(fg__typical_icon *out, fg_context *context,
                                 const fg_panel *panel, int panels)
{
  *out = (fg__typical_icon){0.0, NULL};
  int count = 0;
  for (int k = 0; k < panels; ++k)
    count += fg_icons_count(panel[k].icons);
  if (count == 0)
    return FG_STATUS_OK;
  ranked_icon *ranked = fg__allocate((size_t)count, sizeof *ranked);
  if (!ranked)
    return fg__fail_memory(context, "the arrows' lengths",
                           (size_t)count * sizeof *ranked);
  int used = 0;
  for (int k = 0; k < panels; ++k)
    for (int n = 0; n < fg_icons_count(panel[k].icons); ++n, ++used) {
      const fg_icon *icon = fg_icons_at(panel[k].icons, n);
      ranked[used] = (ranked_icon){fg__icon_length(icon), used, icon};
    }
  qsort(ranked, (size_t)count, sizeof *ranked, compare_keys);
  out->length = ranked[count / 2].key;
  for (int n = 0; n < count; ++n)
    ranked[n].key = ranked[n].key > 0.0 ? ranked[n].icon->width / ranked[n].key : 0.0;
  qsort(ranked, (size_t)count, sizeof *ranked, compare_keys);
  out->shape = ranked[count / 2].icon;
  free(ranked);
  return FG_STATUS_OK;
}

fg_status fg__scene_reference(fg__polygons *out, fg_context *context,
                              const fg__page *page, const fg__typical_icon *median)
{
  enum { POINTS = 9 };
  if (!median->shape || !(median->length > 0.0) || !page->has_size_key)
    return FG_STATUS_OK;
  const fg_icon *typical = median->shape;
  const double length = page->size_key_length / page->scale;
  double share = length / fg__icon_length(typical);
  double points[POINTS][3] = {{0}};
  for (int n = 0; n < POINTS; ++n)
    points[n][0] = length * n / (POINTS - 1);
  const fg_icon icon = {.point_count = POINTS,
                        .points = (const double(*)[3])points,
                        .width = typical->width * share,
                        .tail_width = typical->tail_width * share,
                        .head_length = typical->head_length * share,
                        .head_width = typical->head_width * share};
  static const double origin[2] = {0.0, 0.0};
  const placement p = {page, origin};
  const double tail[2] = {(page->size_key[0] - page->frame.x0) / page->scale,
                          (page->frame.y1 - page->size_key[1]) / page->scale};
  return add_outline(out, &icon, &p, tail)
             ? FG_STATUS_OK
             : fg__fail_memory(context, "the reference arrow", sizeof points);
}

fg_status fg__scene_create(fg__scene *out, fg_context *context, const fg__page *page,
                           const fg_field *field, const double low[2],
                           const double high[2], const fg_density_arrays *density,
                           const fg_icons *icons, const fg__palette *palette,
                           const double range[2])
{
  const fg_field_arrays *grid = fg_field_contents(field);
  *out = (fg__scene){.arrow_color = NULL};
  const placement p = {page, low};
  fg_status status = FG_STATUS_OK;
  if (density)
    status = fg__contour_positive(&out->tint, context, density);
  place_all(&p, &out->tint);
  if (!status && icons)
    status = make_arrows(out, context, &p, high, grid, icons, palette, range);
  if (status) {
    fg__scene_clear(out);
    return status;
  }
  fg__polygons_simplify(&out->tint, area_tolerance);
  fg__polygons_simplify(&out->arrows, outline_tolerance);
  return FG_STATUS_OK;
}

static bool add_line(fg__polygons *out, const placement *p, const double (*points)[3],
                     int count, const double offset[2])
{
  bool good = fg__polygons_begin(out);
  for (int n = 0; good && n < count; ++n) {
    double point[2] = {points[n][0] + offset[0], points[n][1] + offset[1]};
    fg__page_project(p->page, p->low, point);
    good = fg__polygons_add(out, point);
  }
  return good;
}

fg_status fg__scene_add_skeletons(fg__scene *scene, fg_context *context,
                                  const fg__page *page, const fg_field_arrays *field,
                                  const double low[2], const double high[2],
                                  const fg_icons *icons, bool spines)
{
  const placement p = {page, low};
  for (int n = 0; n < fg_icons_count(icons); ++n) {
    const fg_icon *icon = fg_icons_at(icons, n);
    int x[2], y[2];
    period_range(x, icon, 0, p.low[0], high[0], field->period[0]);
    period_range(y, icon, 1, p.low[1], high[1], field->period[1]);
    for (int sy = y[0]; sy <= y[1] && icon->spine; ++sy)
      for (int sx = x[0]; sx <= x[1]; ++sx) {
        const double offset[2] = {sx * field->period[0], sy * field->period[1]};
        if ((spines &&
             !add_line(&scene->spines, &p, icon->spine, icon->spine_count, offset)) ||
            !add_line(&scene->centers, &p, &icon->center, 1, offset))
          return fg__fail_memory(context, "the spines",
                                 scene->spines.point_count * sizeof *scene->spines.point);
      }
  }
  return FG_STATUS_OK;
}

void fg__scene_clear(fg__scene *scene)
{
  fg__polygons_clear(&scene->mask);
  fg__polygons_clear(&scene->tint);
  fg__polygons_clear(&scene->arrows);
  fg__polygons_clear(&scene->spines);
  fg__polygons_clear(&scene->centers);
  free(scene->arrow_color);
  *scene = (fg__scene){.arrow_color = NULL};
}
