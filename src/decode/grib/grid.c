/* Where the values of a field are. */
#include "base/memory.h"
#include "decode/grib/grib.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* A field may have so many points, and so many more for each byte of its message: fields
 * of one value take none for theirs, and compression has its limit. */
enum { POINTS = 1 << 21, POINTS_A_BYTE = 1024 };

enum { MOST_GAUSSIAN = 10000 };

/* Of the flags of resolution and components. */
enum { ALONG_GRID = 8 };

/* A circle of longitude is closed when what is missing to 360 degrees is a step like the
 * others, within so much of it. */
static const double CLOSING_TOLERANCE = 0.25;

/* Coordinates are given in thousandths or millionths of a degree. */
static const double ROUNDING = 0.0011;

void fg__grib_unusable(fg__grib_grid *grid, const char *format, ...)
{
  if (grid->unusable[0])
    return;
  va_list arguments;
  va_start(arguments, format);
  vsnprintf(grid->unusable, sizeof grid->unusable, format, arguments);
  va_end(arguments);
}

typedef struct asking {
  char type[FG__GRIB_WORD];
  fg__grib_numbers numbers;
  long *row; /* of a reduced grid, as the message has them */
  size_t rows;
  bool exhausted;
  int error;
} asking;

static double number_of(codes_handle *handle, const char *key)
{
  double number;
  int error = CODES_SUCCESS;
  if (codes_is_missing(handle, key, &error) || error != CODES_SUCCESS ||
      codes_get_double(handle, key, &number) != CODES_SUCCESS)
    return (double)NAN;
  return number;
}

static void ask_rows(codes_handle *handle, asking *a)
{
  size_t count = 0;
  if (codes_get_size(handle, "pl", &count) != CODES_SUCCESS || count == 0)
    return;
  a->row = fg__allocate(count, sizeof *a->row);
  a->exhausted = !a->row;
  a->rows = count;
  if (a->row && codes_get_long_array(handle, "pl", a->row, &a->rows) != CODES_SUCCESS)
    a->rows = 0;
}

static void ask_numbers(codes_handle *handle, void *data)
{
  asking *a = data;
  fg__grib_numbers *n = &a->numbers;
  const struct wanted {
    const char *key;
    double *number;
  } wanted[] = {{"numberOfDataPoints", &n->points},
                {"Ni", &n->columns},
                {"Nj", &n->rows},
                {"iScansNegatively", &n->x_descends},
                {"jScansPositively", &n->y_ascends},
                {"jPointsAreConsecutive", &n->along_y},
                {"alternativeRowScanning", &n->alternates},
                {"resolutionAndComponentFlags", &n->flags},
                {"longitudeOfFirstGridPointInDegrees", &n->first[0]},
                {"latitudeOfFirstGridPointInDegrees", &n->first[1]},
                {"longitudeOfLastGridPointInDegrees", &n->last[0]},
                {"latitudeOfLastGridPointInDegrees", &n->last[1]},
                {"N", &n->gaussian},
                {"longitudeOfSouthernPoleInDegrees", &n->pole[0]},
                {"latitudeOfSouthernPoleInDegrees", &n->pole[1]},
                {"angleOfRotationInDegrees", &n->pole_angle},
                {"DxInMetres", &n->spacing[0]},
                {"DyInMetres", &n->spacing[1]},
                {"LaDInDegrees", &n->parallel},
                {"Latin1InDegrees", &n->parallel_1},
                {"Latin2InDegrees", &n->parallel_2},
                {"southPoleOnProjectionPlane", &n->south},
                {"earthIsOblate", &n->oblate},
                {"radius", &n->radius},
                {"earthMajorAxisInMetres", &n->major},
                {"earthMinorAxisInMetres", &n->minor}};
  size_t length = sizeof a->type;
  a->error = handle ? CODES_SUCCESS : CODES_INVALID_MESSAGE;
  if (!handle)
    return;
  a->error = codes_get_string(handle, "gridType", a->type, &length);
  for (size_t i = 0; i < sizeof wanted / sizeof *wanted; ++i)
    *wanted[i].number = number_of(handle, wanted[i].key);
  n->meridian = number_of(handle, strcmp(a->type, "lambert") == 0
                                      ? "LoVInDegrees"
                                      : "orientationOfTheGridInDegrees");
  if (strncmp(a->type, "reduced", 7) == 0)
    ask_rows(handle, a);
}

/* A whole number that is one of points; 0: it is none. */
static size_t count_of(double number)
{
  return number >= 1.0 && number <= 2147483646.0 ? (size_t)number : 0;
}

static bool is_set(double flag)
{
  return flag == 1.0;
}

static fg_status allocate_axis(fg__grib_grid *grid, fg_context *context, int k)
{
  grid->axis[k] = fg__allocate(grid->size[k], sizeof(double));
  return grid->axis[k]
             ? FG_STATUS_OK
             : fg__fail_memory(context, "an axis", grid->size[k] * sizeof(double));
}

/* `count` coordinates from `first` on, the last at `last`, made to ascend. */
static void fill_evenly(double *axis, size_t count, double first, double last)
{
  const double low = fmin(first, last), width = fabs(last - first);
  for (size_t i = 0; i < count; ++i)
    axis[i] = low + width * (double)i / (double)(count - 1);
}

/* Longitudes from west to east; columns that repeat the first one 360 degrees on stay. */
static fg_status fill_longitudes(fg__grib_grid *grid, fg_context *context,
                                 const fg__grib_numbers *n)
{
  double first = n->first[0], last = n->last[0];
  fg_status status = allocate_axis(grid, context, 0);
  if (status != FG_STATUS_OK)
    return status;
  if (grid->x_descends)
    last -= last >= first ? 360.0 * (floor((last - first) / 360.0) + 1.0) : 0.0;
  else
    last += last <= first ? 360.0 * (floor((first - last) / 360.0) + 1.0) : 0.0;
  const double width = fabs(last - first), step = width / (double)(grid->size[0] - 1);
  if (!isfinite(width) || width > 360.0 + ROUNDING || fabs(first) > 720.0) {
    fg__grib_unusable(grid, "its longitudes go from %g to %g", n->first[0], n->last[0]);
    return FG_STATUS_OK;
  }
  fill_evenly(grid->axis[0], grid->size[0], first, last);
  if (fabs(360.0 - width - step) <= CLOSING_TOLERANCE * step)
    grid->period = 360.0;
  return FG_STATUS_OK;
}

/* Those of all latitudes of a Gaussian grid that are the field's: from the one nearest to
 * the first on. They come from north to south. */
static void take_gaussian(fg__grib_grid *grid, const double *all, size_t count,
                          const fg__grib_numbers *n)
{
  const double north = fmax(n->first[1], n->last[1]);
  size_t at = 0;
  while (at + 1 < count && fabs(all[at + 1] - north) < fabs(all[at] - north))
    ++at;
  const double spacing = 180.0 / (double)count;
  if (grid->size[1] > count - at || fabs(all[at] - north) > 0.5 * spacing ||
      fabs(all[at + grid->size[1] - 1] - fmin(n->first[1], n->last[1])) > 0.5 * spacing) {
    fg__grib_unusable(grid, "%zu rows from %g to %g are not of a Gaussian grid of %zu",
                      grid->size[1], n->first[1], n->last[1], count);
    return;
  }
  for (size_t j = 0; j < grid->size[1]; ++j)
    grid->axis[1][grid->size[1] - 1 - j] = all[at + j];
}

static fg_status fill_gaussian(fg__grib_grid *grid, fg_context *context,
                               const fg__grib_numbers *n)
{
  const size_t half = count_of(n->gaussian);
  if (half == 0 || half > MOST_GAUSSIAN || grid->size[1] > 2 * half) {
    fg__grib_unusable(grid,
                      "it has %zu rows of a Gaussian grid with %g from pole to "
                      "equator",
                      grid->size[1], n->gaussian);
    return FG_STATUS_OK;
  }
  double *latitude = fg__allocate(2 * half, sizeof *latitude);
  if (!latitude)
    return fg__fail_memory(context, "latitudes", 2 * half * sizeof *latitude);
  const int error = codes_get_gaussian_latitudes((long)half, latitude);
  if (error)
    fg__grib_unusable(grid, "its Gaussian latitudes: %s", codes_get_error_message(error));
  else
    take_gaussian(grid, latitude, 2 * half, n);
  free(latitude);
  return FG_STATUS_OK;
}

static fg_status fill_latitudes(fg__grib_grid *grid, fg_context *context,
                                const fg__grib_numbers *n)
{
  fg_status status = allocate_axis(grid, context, 1);
  const double first = n->first[1], last = n->last[1];
  if (status != FG_STATUS_OK)
    return status;
  if (!(fabs(first) <= 90.0 + ROUNDING && fabs(last) <= 90.0 + ROUNDING) ||
      (grid->y_descends ? !(first > last) : !(first < last))) {
    fg__grib_unusable(grid, "its latitudes go from %g to %g, where they %s", first, last,
                      grid->y_descends ? "descend" : "ascend");
    return FG_STATUS_OK;
  }
  if (strstr(grid->type, "gg"))
    return fill_gaussian(grid, context, n);
  fill_evenly(grid->axis[1], grid->size[1], first, last);
  return FG_STATUS_OK;
}

static fg_status find_regular(fg__grib_grid *grid, fg_context *context,
                              const fg__grib_numbers *n)
{
  const fg_status status = fill_longitudes(grid, context, n);
  return status == FG_STATUS_OK ? fill_latitudes(grid, context, n) : status;
}

typedef enum row_kind {
  ALL_ROUND, /* from the first longitude on */
  CUT_OUT,   /* those of all round that lie from the first to the last longitude */
  BETWEEN    /* evenly from the first to the last longitude */
} row_kind;

/* The points of a row that is said to have `count`. */
static size_t place_row(fg__grib_grid *grid, size_t j, long count, row_kind kind,
                        double first, double last)
{
  long points = 0, begin = 0, end = 0;
  grid->step[j] = 360.0 / (double)count;
  grid->west[j] = first;
  if (kind == BETWEEN && count > 1)
    grid->step[j] = (last - first) / (double)(count - 1);
  if (kind != CUT_OUT)
    return (size_t)count;
  codes_get_reduced_row(count, first, last, &points, &begin, &end);
  grid->west[j] = (double)begin * grid->step[j];
  return points > 0 && points <= count ? (size_t)points : 0;
}

/* Returns how many points there are in all rows; 0 where a row has none. */
static size_t place_rows(fg__grib_grid *grid, const asking *a, row_kind kind)
{
  const double first = a->numbers.first[0];
  double last = a->numbers.last[0];
  last += last <= first ? 360.0 * (floor((first - last) / 360.0) + 1.0) : 0.0;
  size_t points = 0;
  grid->size[0] = 0;
  grid->period = kind == ALL_ROUND ? 360.0 : 0.0;
  for (size_t j = 0; j < a->rows; ++j) {
    const long count = a->row[grid->y_descends ? a->rows - 1 - j : j];
    grid->row[j] = place_row(grid, j, count, kind, first, last);
    grid->size[0] = grid->row[j] > grid->size[0] ? grid->row[j] : grid->size[0];
    if (grid->row[j] == 0)
      return 0;
    points += grid->row[j];
  }
  return points;
}

/* Whether the longest row closes: from its last point it is a step to the first. */
static bool goes_round(const asking *a, long longest)
{
  const double width = a->numbers.last[0] - a->numbers.first[0];
  const double rest = 360.0 - (width - 360.0 * floor(width / 360.0));
  return rest <= (1.0 + CLOSING_TOLERANCE) * 360.0 / (double)longest + ROUNDING;
}

static fg_status find_rows(fg__grib_grid *grid, fg_context *context, const asking *a)
{
  long longest = 1;
  grid->row = fg__allocate(a->rows, sizeof *grid->row);
  grid->west = fg__allocate(a->rows, sizeof *grid->west);
  grid->step = fg__allocate(a->rows, sizeof *grid->step);
  if (!grid->row || !grid->west || !grid->step)
    return fg__fail_memory(context, "rows", 3 * a->rows * sizeof *grid->step);
  for (size_t j = 0; j < a->rows; ++j) {
    if (a->row[j] < 1 || a->row[j] > 1 << 20) {
      fg__grib_unusable(grid, "a row of it has %ld points", a->row[j]);
      return FG_STATUS_OK;
    }
    longest = a->row[j] > longest ? a->row[j] : longest;
  }
  if ((goes_round(a, longest) && place_rows(grid, a, ALL_ROUND) == grid->points) ||
      place_rows(grid, a, CUT_OUT) == grid->points ||
      place_rows(grid, a, BETWEEN) == grid->points)
    return FG_STATUS_OK;
  fg__grib_unusable(grid, "its %zu rows do not have its %zu points together", a->rows,
                    grid->points);
  return FG_STATUS_OK;
}

static fg_status find_reduced(fg__grib_grid *grid, fg_context *context, const asking *a)
{
  if (a->rows < 2 || a->rows != grid->size[1] || grid->x_descends || grid->along_y ||
      grid->alternates || !isfinite(a->numbers.first[0]) ||
      !isfinite(a->numbers.last[0]) || fabs(a->numbers.first[0]) > 720.0 ||
      fabs(a->numbers.last[0]) > 720.0) {
    fg__grib_unusable(grid, "a reduced grid of %zu rows, of which %zu say their points",
                      grid->size[1], a->rows);
    return FG_STATUS_OK;
  }
  fg_status status = fill_latitudes(grid, context, &a->numbers);
  if (status == FG_STATUS_OK && !grid->unusable[0])
    status = find_rows(grid, context, a);
  return status;
}

static bool find_layout(fg__grib_grid *grid)
{
  static const struct {
    const char *type;
    fg__grib_layout layout;
    bool rotated;
  } known[] = {{"regular_ll", FG__GRIB_LONLAT, false},
               {"regular_gg", FG__GRIB_LONLAT, false},
               {"rotated_ll", FG__GRIB_ROWS, true},
               {"rotated_gg", FG__GRIB_ROWS, true},
               {"reduced_ll", FG__GRIB_REDUCED, false},
               {"reduced_gg", FG__GRIB_REDUCED, false},
               {"reduced_rotated_gg", FG__GRIB_REDUCED, true},
               {"lambert", FG__GRIB_PLANE, false},
               {"polar_stereographic", FG__GRIB_PLANE, false},
               {"mercator", FG__GRIB_PLANE, false}};
  for (size_t i = 0; i < sizeof known / sizeof *known; ++i)
    if (strcmp(grid->type, known[i].type) == 0) {
      grid->layout = known[i].layout;
      grid->rotated = known[i].rotated;
      return true;
    }
  if (strcmp(grid->type, "sh") == 0)
    fg__grib_unusable(grid, "it has spherical harmonics ('sh') and no grid, as "
                            "cdo sp2gp would make of them");
  else
    fg__grib_unusable(grid, "its grid is of a type that is not known here, '%s'",
                      grid->type);
  return false;
}

static void check_counts(fg__grib_grid *grid, const fg__grib_field *field,
                         const fg__grib_numbers *n)
{
  const size_t most = POINTS + POINTS_A_BYTE * field->size;
  if (grid->points == 0 || grid->points > most)
    fg__grib_unusable(grid, "it has %g points, and a message of %zu bytes at most %zu",
                      n->points, field->size, most);
  else if (grid->size[1] < 2 || (grid->layout != FG__GRIB_REDUCED && grid->size[0] < 2))
    fg__grib_unusable(grid, "it has %g columns and %g rows", n->columns, n->rows);
  else if (grid->layout != FG__GRIB_REDUCED &&
           grid->size[0] * grid->size[1] != grid->points)
    fg__grib_unusable(grid, "%zu columns and %zu rows are not its %zu points",
                      grid->size[0], grid->size[1], grid->points);
  if (grid->rotated &&
      !(fabs(n->pole[1]) <= 90.0 + ROUNDING && fabs(n->pole[0]) <= 720.0))
    fg__grib_unusable(grid, "its southern pole is at %g, %g", n->pole[0], n->pole[1]);
}

static fg_status find(fg__grib_grid *grid, fg_context *context,
                      const fg__grib_field *field, const asking *a)
{
  const fg__grib_numbers *n = &a->numbers;
  snprintf(grid->type, sizeof grid->type, "%s", a->type);
  if (!find_layout(grid))
    return FG_STATUS_OK;
  grid->points = count_of(n->points);
  grid->size[0] = grid->layout == FG__GRIB_REDUCED ? 0 : count_of(n->columns);
  grid->size[1] = count_of(n->rows);
  grid->x_descends = is_set(n->x_descends);
  grid->y_descends = !is_set(n->y_ascends);
  grid->along_y = is_set(n->along_y);
  grid->alternates = is_set(n->alternates);
  grid->relative = n->flags >= 0.0 && n->flags < 256.0 && ((int)n->flags & ALONG_GRID);
  grid->pole_longitude = n->pole[0];
  grid->pole_latitude = n->pole[1];
  grid->pole_angle = isfinite(n->pole_angle) ? n->pole_angle : 0.0;
  check_counts(grid, field, n);
  if (grid->unusable[0])
    return FG_STATUS_OK;
  if (grid->layout == FG__GRIB_PLANE)
    return fg__grib_plane(grid, context, n);
  const fg_status status = grid->layout == FG__GRIB_REDUCED
                               ? find_reduced(grid, context, a)
                               : find_regular(grid, context, n);
  if (grid->layout != FG__GRIB_LONLAT && status == FG_STATUS_OK && !grid->unusable[0])
    fg__grib_mesh_count(&grid->mesh, grid);
  return status;
}

fg_status fg__grib_grid_find(fg__grib_grid *out, const fg__grib_file *file,
                             const fg__grib_field *field)
{
  asking a = {.error = CODES_SUCCESS};
  memset(out, 0, sizeof *out);
  fg_status status = fg__grib_guard(file, field, ask_numbers, &a);
  if (status == FG_STATUS_OK && a.exhausted)
    status = fg__fail_memory(file->context, "rows", a.rows * sizeof *a.row);
  if (status == FG_STATUS_OK && a.error)
    status = fg__fail(file->context, FG_STATUS_FILE_FORMAT,
                      "%s: message %zu does not say its grid: %s", file->path,
                      field->number, codes_get_error_message(a.error));
  if (status == FG_STATUS_OK)
    status = find(out, file->context, field, &a);
  free(a.row);
  return status;
}

void fg__grib_grid_clear(fg__grib_grid *grid)
{
  for (int k = 0; k < 2; ++k)
    free(grid->axis[k]);
  free(grid->row);
  free(grid->west);
  free(grid->step);
  for (int k = 0; k < 2; ++k) {
    free(grid->mesh.position[k]);
    free(grid->mesh.turn[k]);
  }
  free(grid->mesh.corner);
  memset(grid, 0, sizeof *grid);
}
