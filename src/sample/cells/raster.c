/* Which raster cells are interpolated onto, and which of its samples lies in which cell.
 */
#include <limits.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "base/weighted.h"
#include "field/refused.h"
#include "sample/cells/set.h"

/* Fuzzing takes rasters of fewer samples: what it tries in a second is what counts. */
#ifdef FUZZING_BUILD_MODE_UNSAFE_FOR_PRODUCTION
enum { FEWER = 6 };
#else
enum { FEWER = 0 };
#endif

enum {
  MOST_SAMPLES = 1 << (20 - FEWER),
  FEWEST_SAMPLES = 1 << (12 - FEWER),
  /* few cells of very different sizes have at most so many, and these of each */
  SAMPLES_OF_FEW = 1 << (16 - FEWER),
  SAMPLES_A_CELL = 1 << (12 - FEWER),
  FINEST =
      8, /* samples a cell, where there is room: stairs at slanting edges are finer */
  MEASURED_CELLS = 1 << 16, /* evenly chosen ones, which tell the spacing */
  MOST_COVER = 64, /* times that cells' boxes may cover the raster: sound meshes do it
                      1 to 6 times (tetrahedra fill a sixth of their boxes), thin
                      slanting layers 30 times and more */
  MOST_TRIED = 1 << (24 - FEWER), /* samples in all boxes: they take 0.4 us each */
  /* Samples in all boxes of few cells, and more of each: a raster in which a handful of
     cells lie over each other is coarser. */
  FEW_TRIED = 3 << (19 - FEWER),
  TRIED_A_CELL = FINEST * FINEST * FINEST
};

/* Of the width: single precision rounds coordinates by less, and no layer is thinner. */
static const double FLAT = 1e-5;

/* Of the cells' widths along an axis the one that this share is narrower than. */
static const double NARROWER = 0.25;

/* A sample may lie so far outside a cell, whose size is 1: coordinates are rounded. */
static const double TOLERANCE = 1e-4;

typedef struct cell_box {
  double low[3], high[3];
} cell_box;

static cell_box empty_box(void)
{
  return (cell_box){{HUGE_VAL, HUGE_VAL, HUGE_VAL}, {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL}};
}

static void extend(cell_box *box, const double position[3])
{
  for (int k = 0; k < 3; ++k) {
    if (position[k] < box->low[k])
      box->low[k] = position[k];
    if (position[k] > box->high[k])
      box->high[k] = position[k];
  }
}

static cell_box box_of(const fg__cell_set *set, size_t cell)
{
  cell_box box = empty_box();
  for (int i = 0; i < fg__cell_corners(set->shape[cell]); ++i)
    extend(&box, fg__cell_set_corner(set, cell, i));
  return box;
}

/* A few points far beyond all others have no place: what stands there is a fill value. */
static fg_status check_apart(const fg__cell_set *set)
{
  for (size_t k = 0; k < 3; ++k) {
    const size_t n = fg__find_apart_position(set->position + k, 3, set->points);
    if (n < set->points)
      return fg__fail(set->context, FG_STATUS_FILE_FORMAT,
                      "%s: point %zu is at (%g, %g, %g), far beyond most others",
                      set->path, n, set->position[3 * n], set->position[3 * n + 1],
                      set->position[3 * n + 2]);
  }
  return FG_STATUS_OK;
}

static fg_status find_box(cell_box *out, const fg__cell_set *set)
{
  *out = empty_box();
  for (size_t c = 0; c < set->count; ++c)
    for (int i = 0; i < fg__cell_corners(set->shape[c]); ++i) {
      const double *position = fg__cell_set_corner(set, c, i);
      /* a sum of three is finite when each is, and far from where products overflow */
      if (!(fabs(position[0]) + fabs(position[1]) + fabs(position[2]) < 1e60))
        return fg__fail(set->context, FG_STATUS_FILE_FORMAT,
                        "%s: corner %d of cell %d is at (%g, %g, %g)", set->path, i,
                        set->number[c], position[0], position[1], position[2]);
      extend(out, position);
    }
  return check_apart(set);
}

/* Whether all corners lie on one of the box's two sides across an axis: a layer of cells,
 * one cell thick. */
static bool is_layer(const fg__cell_set *set, const cell_box *box, int axis)
{
  const double most = FLAT * (box->high[axis] - box->low[axis]);
  for (size_t c = 0; c < set->count; ++c)
    for (int i = 0; i < fg__cell_corners(set->shape[c]); ++i) {
      const size_t point = (size_t)set->corner[set->first[c] + (size_t)i];
      const double at = set->position[3 * point + (size_t)axis];
      if (set->middles > 0 && point >= set->file_points)
        continue; /* a middle lies between the sides */
      if (at - box->low[axis] > most && box->high[axis] - at > most)
        return false;
    }
  return true;
}

/* Widths of a box along the axes that are below rounding of the widest. */
static int count_thin(bool thin[3], const cell_box *box)
{
  double widest = 0.0;
  int count = 0;
  for (int k = 0; k < 3; ++k)
    widest = fmax(widest, box->high[k] - box->low[k]);
  for (int k = 0; k < 3; ++k) {
    thin[k] = box->high[k] - box->low[k] <= FLAT * widest;
    count += thin[k];
  }
  return count;
}

/* The axis that a plane or a layer lies across; -1 in a volume, and of a plane that lies
 * across none. */
static fg_status find_flat(int *out, const fg__cell_set *set, const cell_box *box)
{
  const bool plane = fg__cell_dimension(set->shape[0]) == 2;
  bool thin[3];
  *out = -1;
  if (count_thin(thin, box) > (plane ? 1 : 0))
    return fg__fail(set->context, FG_STATUS_UNSUPPORTED,
                    "%s: its cells fill no %s: all are within %g x %g x %g", set->path,
                    plane ? "area" : "volume", box->high[0] - box->low[0],
                    box->high[1] - box->low[1], box->high[2] - box->low[2]);
  for (int k = 0; k < 3; ++k)
    if (thin[k] || (!plane && is_layer(set, box, k)))
      *out = k;
  return FG_STATUS_OK;
}

/* The same after a tilted plane has been turned into its own coordinates. */
static fg_status find_box_and_flat(cell_box *box, fg__cell_set *set)
{
  fg_status status = find_box(box, set);
  if (status == FG_STATUS_OK)
    status = find_flat(&set->flat, set, box);
  if (status != FG_STATUS_OK || set->flat >= 0 || fg__cell_dimension(set->shape[0]) == 3)
    return status;
  status = fg__cell_set_turn(set);
  if (status == FG_STATUS_OK)
    status = find_box(box, set);
  return status == FG_STATUS_OK ? find_flat(&set->flat, set, box) : status;
}

/* Whether a cell's box and another have a place in common. */
static bool meets(const fg__cell_set *set, const cell_box *cell, const cell_box *other)
{
  bool both = true;
  for (int k = 0; k < 3; ++k)
    both = both && (k == set->flat ||
                    (cell->low[k] <= other->high[k] && cell->high[k] >= other->low[k]));
  return both;
}

/* Narrows the box of all cells to the region; *cells: how many reach into it. */
static fg_status find_part(cell_box *box, size_t *cells, const fg__cell_set *set)
{
  static const char *const letters[] = {"x", "y", "z"};
  fg_status status = FG_STATUS_OK;
  *cells = set->region.axes > 0 ? 0 : set->count;
  for (int k = 0, n = 0; k < 3 && status == FG_STATUS_OK; ++k)
    if (k != set->flat) {
      status = fg__region_clip(&box->low[k], &box->high[k], set->context, set->path,
                               &set->region, n, letters[k], "");
      ++n;
    }
  for (size_t c = 0; c < set->count && set->region.axes > 0; ++c) {
    const cell_box cell = box_of(set, c);
    *cells += meets(set, &cell, box);
  }
  if (status == FG_STATUS_OK && *cells == 0)
    status = fg__fail(set->context, FG_STATUS_ARGUMENT,
                      "%s: no cell lies in the region: %g to %g, %g to %g, %g to %g",
                      set->path, box->low[0], box->high[0], box->low[1], box->high[1],
                      box->low[2], box->high[2]);
  return status;
}

/* Intervals that the cells in a box suggest along an axis of it. */
static fg_status count_intervals(double *out, const fg__cell_set *set, int axis,
                                 const cell_box *part, size_t cells)
{
  const double width = part->high[axis] - part->low[axis];
  const size_t step = cells / MEASURED_CELLS + 1;
  double *widths = fg__allocate(cells / step + 1, sizeof *widths);
  size_t measured = 0, met = 0;
  if (!widths)
    return fg__fail_memory(set->context, "widths of cells", MEASURED_CELLS * 8);
  for (size_t c = 0; c < set->count; ++c) {
    const cell_box box = box_of(set, c);
    if (!meets(set, &box, part) || met++ % step != 0)
      continue;
    if (box.high[axis] - box.low[axis] > FLAT * FLAT * width)
      widths[measured++] = box.high[axis] - box.low[axis];
  }
  qsort(widths, measured, sizeof *widths, fg__by_size);
  *out = measured > 0 ? width / widths[(size_t)(NARROWER * (double)measured)] : 1.0;
  free(widths);
  return FG_STATUS_OK;
}

static double count_samples(const int intervals[3])
{
  return (intervals[0] + 1.0) * (intervals[1] + 1.0) * (intervals[2] + 1.0);
}

/* Whole numbers of intervals: as many times those suggested as `most` samples allow, or
 * the same share of each. In a volume two at least, for a layer would be taken for a
 * plane.
 */
static void fit_intervals(int out[3], const double suggested[3], int flat, double most)
{
  const double least = flat < 0 ? 2.0 : 1.0;
  double times = FINEST;
  do {
    for (int k = 0; k < 3; ++k) {
      const double wanted = floor(ceil(suggested[k] - FLAT) * times);
      out[k] = k == flat ? 0 : (int)fmin(fmax(wanted, least), MOST_SAMPLES);
    }
    times = times > 1.0 ? times - 1.0 : 0.98 * times;
  } while (count_samples(out) > fmax(most, FEWEST_SAMPLES));
}

/* Samples that a cell's box, made larger by the tolerance, holds: [first, end). */
static bool samples_in(int first[3], int end[3], const fg__cell_set *set,
                       const cell_box *box)
{
  for (int k = 0; k < 3; ++k) {
    const double margin = TOLERANCE * (box->high[k] - box->low[k]);
    const double low = (box->low[k] - margin - set->origin[k]) / set->spacing[k];
    const double high = (box->high[k] + margin - set->origin[k]) / set->spacing[k];
    first[k] = k == set->flat ? 0 : (int)fmax(0.0, ceil(low - FLAT));
    end[k] =
        k == set->flat ? 1 : (int)fmin((double)set->size[k], floor(high + FLAT) + 1.0);
    if (first[k] >= end[k])
      return false;
  }
  return true;
}

/* Samples in the boxes of all cells together. */
static double count_tried(const fg__cell_set *set)
{
  double tried = 0.0;
  for (size_t c = 0; c < set->count; ++c) {
    const cell_box box = box_of(set, c);
    int first[3], end[3];
    if (samples_in(first, end, set, &box))
      tried += (double)(end[0] - first[0]) * (end[1] - first[1]) * (end[2] - first[2]);
  }
  return tried;
}

/* The raster of a box whose intervals are as suggested where `most` samples allow. */
static void set_raster(fg__cell_set *set, const cell_box *box, const double suggested[3],
                       double most)
{
  int fitted[3];
  fit_intervals(fitted, suggested, set->flat, most);
  for (int k = 0; k < 3; ++k) {
    set->size[k] = fitted[k] + 1;
    set->origin[k] = box->low[k];
    set->spacing[k] = fitted[k] > 0 ? (box->high[k] - box->low[k]) / fitted[k] : 1.0;
  }
  if (set->flat >= 0) /* the middle of a layer */
    set->origin[set->flat] = 0.5 * (box->low[set->flat] + box->high[set->flat]);
}

static double count_raster(const fg__cell_set *set)
{
  return (double)set->size[0] * set->size[1] * set->size[2];
}

fg_status fg__cell_set_choose_raster(fg__cell_set *set)
{
  cell_box box;
  double intervals[3] = {0.0, 0.0, 0.0};
  size_t cells = set->count;
  fg_status status = find_box_and_flat(&box, set);
  if (status == FG_STATUS_OK)
    status = find_part(&box, &cells, set);
  for (int k = 0; k < 3 && status == FG_STATUS_OK; ++k)
    if (k != set->flat)
      status = count_intervals(&intervals[k], set, k, &box, cells);
  if (status != FG_STATUS_OK)
    return status;
  set->dimension = set->flat < 0 ? 3 : 2;
  set_raster(set, &box, intervals,
             fmin(MOST_SAMPLES, SAMPLES_OF_FEW + SAMPLES_A_CELL * (double)cells));
  const double most = FEW_TRIED + TRIED_A_CELL * (double)cells;
  set->tried = count_tried(set);
  if (set->tried > most) {
    set_raster(set, &box, intervals, count_raster(set) * most / set->tried);
    set->tried = count_tried(set);
  }
  return FG_STATUS_OK;
}

static fg_status check_cover(const fg__cell_set *set, size_t samples)
{
  if (set->tried > fmin(MOST_COVER * (double)samples, MOST_TRIED))
    return fg__fail(set->context, FG_STATUS_FILE_FORMAT,
                    "%s: its cells lie over each other: the boxes round them cover all "
                    "their space %.0f times",
                    set->path, set->tried / (double)samples);
  return FG_STATUS_OK;
}

typedef struct located_cell {
  fg__cell_shape shape;
  int axis[3];                        /* of its dimensions */
  double corner[FG__CELL_CORNERS][3]; /* from the first corner on, along these */
  double zero[3], width;
} located_cell;

static located_cell cell_at(const fg__cell_set *set, size_t cell, const cell_box *box)
{
  located_cell out = {.shape = set->shape[cell]};
  const int dimension = fg__cell_dimension(out.shape);
  for (int k = 0, n = 0; k < 3; ++k)
    if (dimension == 3 || k != set->flat)
      out.axis[n++] = k;
  for (int n = 0; n < dimension; ++n) {
    out.zero[n] = fg__cell_set_corner(set, cell, 0)[out.axis[n]];
    out.width = fmax(out.width, box->high[out.axis[n]] - box->low[out.axis[n]]);
    for (int i = 0; i < fg__cell_corners(out.shape); ++i)
      out.corner[i][n] = fg__cell_set_corner(set, cell, i)[out.axis[n]] - out.zero[n];
  }
  return out;
}

/* Of several cells that a sample lies in, within the tolerance, the first that it lies
 * deepest in, with nothing deeper than inside: neighbours agree on their common face. */
static void find_in_cell(fg__cell_set *set, float *excess, size_t cell)
{
  int first[3], end[3], index[3];
  const cell_box box = box_of(set, cell);
  if (!samples_in(first, end, set, &box))
    return;
  located_cell here = cell_at(set, cell, &box);
  const int dimension = fg__cell_dimension(here.shape);
  for (index[2] = first[2]; index[2] < end[2]; ++index[2])
    for (index[1] = first[1]; index[1] < end[1]; ++index[1]) {
      double at[3] = {0.5, 0.5, 0.5};
      for (index[0] = first[0]; index[0] < end[0]; ++index[0]) {
        double point[3] = {0.0, 0.0, 0.0};
        for (int n = 0; n < dimension; ++n) {
          const int k = here.axis[n];
          point[n] = set->origin[k] + set->spacing[k] * index[k] - here.zero[n];
        }
        if (!fg__cell_invert(at, here.shape, here.corner, point, here.width)) {
          at[0] = at[1] = at[2] = 0.5;
          continue;
        }
        const double outside = fmax(0.0, fg__cell_excess(here.shape, at));
        const size_t n = ((size_t)index[2] * (size_t)set->size[1] + (size_t)index[1]) *
                             (size_t)set->size[0] +
                         (size_t)index[0];
        if (outside > TOLERANCE || (float)outside >= excess[n])
          continue;
        excess[n] = (float)outside;
        set->place[n].cell = (int)cell;
        for (int k = 0; k < 3; ++k)
          set->place[n].at[k] = (float)at[k];
      }
    }
}

fg_status fg__cell_set_find_places(fg__cell_set *set)
{
  const size_t samples =
      (size_t)set->size[0] * (size_t)set->size[1] * (size_t)set->size[2];
  fg_status status = check_cover(set, samples);
  if (status != FG_STATUS_OK)
    return status;
  float *excess = fg__allocate(samples, sizeof *excess);
  set->place = fg__allocate(samples, sizeof *set->place);
  if (!excess || !set->place) {
    free(excess);
    return fg__fail_memory(set->context, "a raster", samples * sizeof *set->place);
  }
  for (size_t n = 0; n < samples; ++n) {
    excess[n] = HUGE_VALF;
    set->place[n].cell = -1;
  }
  for (size_t c = 0; c < set->count; ++c)
    find_in_cell(set, excess, c);
  free(excess);
  return FG_STATUS_OK;
}
