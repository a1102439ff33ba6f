/* What a sphere's cells cover: longitudes and latitudes, area, mean spacing. */
#include "base/memory.h"
#include "field/field.h"
#include "sphere/inside.h"

#include <stdlib.h>

enum { BINS = 720 }; /* of longitude, half a degree each */

static const double BIN = 360.0 / BINS;
static const double WHOLE_AREA = 12.566370614359172; /* 4 pi */

/* The longitudes of a bin that are covered, in degrees from its beginning. */
typedef struct bin {
  bool covered;
  double low, high;
} bin;

typedef struct cover {
  bin bins[BINS];
  double south, north;
  double area; /* of the parts of cells that have values */
  size_t present;
  bool has_quads;
} cover;

typedef struct cell_shape {
  int corners;
  double longitude[4], latitude[4];
} cell_shape;

static void add_longitude(cover *sum, double longitude, double reach)
{
  double turned = fabs(longitude) < 360.0 ? longitude : fmod(longitude, 360.0);
  turned = turned < 0.0 ? turned + 360.0 : turned;
  int n = (int)(turned / BIN);
  n = n < BINS ? n : BINS - 1;
  for (double left = reach; left >= 0.0; ++n) {
    bin *b = &sum->bins[n % BINS];
    const double low = reach == left ? turned - n * BIN : 0.0;
    const double high = low + left < BIN ? low + left : BIN;
    b->low = b->covered && b->low < low ? b->low : low;
    b->high = b->covered && b->high > high ? b->high : high;
    b->covered = true;
    if (low + left <= BIN)
      return;
    left -= BIN - low;
  }
}

/* From one longitude to another, the shorter way. */
static double turn_between(double from, double to)
{
  const double turn = to - from;
  return fabs(turn) <= 180.0 ? turn : remainder(turn, 360.0);
}

/* Corners in consecutive turns, about the first that is not at a pole. Returns how many
 * times they go round the pole: 0, 1 or -1. */
static int unwrap(cell_shape *shape, double *low, double *high)
{
  double first = (double)NAN, last = (double)NAN, round = 0.0;
  for (int k = 0; k <= shape->corners; ++k) {
    const double longitude = shape->longitude[k % shape->corners];
    if (fabs(shape->latitude[k % shape->corners]) > 90.0 - 1e-9)
      continue;
    if (isnan(first)) {
      first = last = *low = *high = longitude;
      continue;
    }
    const double step = turn_between(last, longitude);
    round += step;
    last = longitude;
    *low = fmin(*low, first + round);
    *high = fmax(*high, first + round);
  }
  return isnan(first) ? 0 : (int)lround(round / 360.0);
}

static void add_cell(cover *sum, cell_shape *shape)
{
  double low = 0.0, high = 0.0;
  if (unwrap(shape, &low, &high) != 0) { /* round a pole */
    add_longitude(sum, 0.0, 360.0);
    sum->south = shape->latitude[0] < 0.0 ? -90.0 : sum->south;
    sum->north = shape->latitude[0] > 0.0 ? 90.0 : sum->north;
  } else {
    add_longitude(sum, low, high - low < 360.0 ? high - low : 360.0);
  }
  for (int k = 0; k < shape->corners; ++k) {
    sum->south = fmin(sum->south, shape->latitude[k]);
    sum->north = fmax(sum->north, shape->latitude[k]);
  }
}

/* Half the length of the diagonals' cross product, or of two sides'. */
static double area_of(const fg__sphere *sphere, const int point[4], int corners)
{
  const double *p = sphere->position + 3 * (size_t)point[0];
  const double *q = sphere->position + 3 * (size_t)point[1];
  const double *r = sphere->position + 3 * (size_t)point[2];
  const double *s = sphere->position + 3 * (size_t)point[corners - 1];
  double a[3], b[3], normal[3];
  fg__subtract(r, p, a);
  fg__subtract(s, q, b);
  fg__cross(a, b, normal);
  return 0.5 * fg__length(normal);
}

static double area_in_grid(const cell_shape *shape)
{
  const double turn = remainder(shape->longitude[1] - shape->longitude[0], 360.0);
  const double height =
      sin(shape->latitude[2] * FG__RADIANS) - sin(shape->latitude[0] * FG__RADIANS);
  return fabs(turn * FG__RADIANS * height);
}

static void place_corners(cell_shape *shape, const fg__sphere *sphere,
                          const double *longitude, const double *latitude,
                          const int point[4])
{
  const fg_field_arrays *grid = sphere->field ? fg_field_contents(sphere->field) : NULL;
  for (int k = 0; k < shape->corners; ++k) {
    const int n = point[k];
    shape->longitude[k] = grid ? grid->axis[0][n % grid->size[0]] : longitude[n];
    shape->latitude[k] = grid ? grid->axis[1][n / grid->size[0]] : latitude[n];
  }
}

typedef struct measuring {
  const fg__sphere *sphere;
  const double *longitude, *latitude;
  int parts;
  cover *part; /* [parts] */
} measuring;

static void add_cells(cover *sum, const measuring *work, size_t begin, size_t end)
{
  const fg__sphere *sphere = work->sphere;
  for (size_t n = begin; n < end; ++n) {
    int point[4], present = 0;
    cell_shape shape = {.corners = fg__sphere_corners(sphere, n, point)};
    sum->has_quads = sum->has_quads || shape.corners > 3;
    for (int k = 0; k < shape.corners; ++k)
      present += !sphere->missing || !sphere->missing[point[k]];
    if (present == 0)
      continue;
    place_corners(&shape, sphere, work->longitude, work->latitude, point);
    add_cell(sum, &shape);
    const double area =
        sphere->field ? area_in_grid(&shape) : area_of(sphere, point, shape.corners);
    sum->area += area * present / shape.corners;
  }
}

static void add_points(cover *sum, const fg__sphere *sphere, size_t begin, size_t end)
{
  for (size_t n = begin; n < end; ++n)
    sum->present += !sphere->missing || !sphere->missing[n];
}

/* The parts' division does not depend on the threads, nor so the area's last bits. */
static void measure_parts(void *argument, const fg__thread *thread)
{
  const measuring *work = argument;
  const fg__sphere *sphere = work->sphere;
  for (int k = thread->index; k < work->parts; k += thread->count) {
    cover *sum = &work->part[k];
    const size_t parts = (size_t)work->parts, part = (size_t)k;
    sum->south = 90.0;
    sum->north = -90.0;
    add_cells(sum, work, sphere->count * part / parts,
              sphere->count * (part + 1) / parts);
    add_points(sum, sphere, sphere->points * part / parts,
               sphere->points * (part + 1) / parts);
  }
}

static void unite(cover *sum, const cover *part)
{
  for (int n = 0; n < BINS; ++n) {
    const bin *more = &part->bins[n];
    bin *b = &sum->bins[n];
    if (!more->covered)
      continue;
    b->low = b->covered ? fmin(b->low, more->low) : more->low;
    b->high = b->covered ? fmax(b->high, more->high) : more->high;
    b->covered = true;
  }
  sum->south = fmin(sum->south, part->south);
  sum->north = fmax(sum->north, part->north);
  sum->area += part->area;
  sum->present += part->present;
  sum->has_quads = sum->has_quads || part->has_quads;
}

/* West and east of the longest run of bins that nothing covers. */
static void find_gap(fg__sphere_extent *out, const cover *sum)
{
  int longest = 0, after = 0;
  for (int first = 0; first < BINS; ++first) {
    if (!sum->bins[first].covered || sum->bins[(first + 1) % BINS].covered)
      continue;
    int length = 0;
    while (length < BINS && !sum->bins[(first + 1 + length) % BINS].covered)
      ++length;
    if (length > longest) {
      longest = length;
      after = (first + 1 + length) % BINS;
    }
  }
  out->west = -180.0;
  out->east = 180.0;
  if (longest == 0)
    return;
  const int last = (after - longest - 1 + 2 * BINS) % BINS;
  out->west = after * BIN + sum->bins[after].low;
  out->east = last * BIN + sum->bins[last].high;
  if (out->west >= 180.0)
    out->west -= 360.0;
  while (out->east < out->west)
    out->east += 360.0;
  while (out->east > out->west + 360.0)
    out->east -= 360.0;
}

static double describe(fg__sphere *sphere, const cover *sum)
{
  fg__sphere_extent *out = &sphere->extent;
  find_gap(out, sum);
  out->south = sphere->has_pole[0] ? -90.0 : sum->south;
  out->north = sphere->has_pole[1] ? 90.0 : sum->north;
  out->share = fmin(sum->area / WHOLE_AREA, 1.0);
  out->points = sum->present;
  out->scattered = !sum->has_quads;
  out->spacing =
      sqrt(sum->area / (double)(sum->present > 0 ? sum->present : 1)) / FG__RADIANS;
  const double height = sin(out->north * FG__RADIANS) - sin(out->south * FG__RADIANS);
  return sum->area / ((out->east - out->west) * FG__RADIANS * height);
}

fg_status fg__sphere_measure(double *layers, fg__sphere *sphere, fg_context *context,
                             fg__threads *threads, const double *longitude,
                             const double *latitude)
{
  measuring work = {.sphere = sphere,
                    .longitude = longitude,
                    .latitude = latitude,
                    .parts = fg__sphere_parts(sphere)};
  work.part = fg__allocate((size_t)work.parts, sizeof *work.part);
  if (!work.part)
    return fg__fail_memory(context, "what the cells cover",
                           (size_t)work.parts * sizeof *work.part);
  fg__threads_run(threads, measure_parts, &work);
  for (int k = 1; k < work.parts; ++k)
    unite(&work.part[0], &work.part[k]);
  *layers = describe(sphere, &work.part[0]);
  free(work.part);
  return FG_STATUS_OK;
}
