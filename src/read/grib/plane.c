/* Grids in the plane of a projection. Its formulas are Snyder's (Map Projections: A
 * Working Manual, 1987); the plane is the one that PROJ makes of the same numbers. */
#include "base/angle.h"
#include "base/memory.h"
#include "file/number_text.h"
#include "read/grib/grib.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* Snyder's m (14-15): the radius of a parallel over the larger half-axis. */
static double radius_at(double sine, double cosine, double e)
{
  return cosine / sqrt(1.0 - e * e * sine * sine);
}

/* Snyder's t (15-9): 0 at the North Pole. */
static double conformal_at(double latitude, double e)
{
  const double sine = sin(latitude * FG__RADIANS);
  return tan((45.0 - 0.5 * latitude) * FG__RADIANS) /
         pow((1.0 - e * sine) / (1.0 + e * sine), 0.5 * e);
}

static double radius_of(double latitude, double e)
{
  return radius_at(sin(latitude * FG__RADIANS), cos(latitude * FG__RADIANS), e);
}

void fg__grib_forward(const fg__grib_projection *p, double longitude, double latitude,
                      double *x, double *y)
{
  double turn = fmod(longitude - p->meridian, 360.0);
  turn += turn < -180.0 ? 360.0 : turn > 180.0 ? -360.0 : 0.0;
  const double t = conformal_at(latitude, p->eccentricity);
  if (p->kind == FG__GRIB_MERCATOR) {
    *x = p->scale * turn * FG__RADIANS;
    *y = -p->scale * log(t);
    return;
  }
  const double distance = p->scale * pow(t, p->cone),
               angle = p->cone * turn * FG__RADIANS;
  *x = distance * sin(angle);
  *y = p->apex - distance * cos(angle);
}

static void make_lambert(fg__grib_projection *p, const fg__grib_numbers *n)
{
  const double e = p->eccentricity, one = n->parallel_1, two = n->parallel_2;
  const double t = conformal_at(one, e);
  p->cone = fabs(one - two) < 1e-9 ? sin(one * FG__RADIANS)
                                   : (log(radius_of(one, e)) - log(radius_of(two, e))) /
                                         (log(t) - log(conformal_at(two, e)));
  p->scale = p->radius * radius_of(one, e) / (p->cone * pow(t, p->cone));
  p->apex = p->scale * pow(conformal_at(n->parallel, e), p->cone);
}

/* A cone of 1 about the North Pole, of -1 about the South Pole. */
static void make_stereographic(fg__grib_projection *p, const fg__grib_numbers *n)
{
  const double e = p->eccentricity, parallel = fabs(n->parallel);
  const double scale = parallel > 90.0 - 1e-9
                           ? 2.0 / sqrt(pow(1.0 + e, 1.0 + e) * pow(1.0 - e, 1.0 - e))
                           : radius_of(parallel, e) / conformal_at(parallel, e);
  p->cone = n->south == 1.0 ? -1.0 : 1.0;
  p->scale = p->cone * p->radius * scale;
  p->apex = 0.0;
}

/* Its meridian is the grid's middle, so that no column lies beyond the cut. */
static void make_mercator(fg__grib_projection *p, const fg__grib_grid *grid,
                          const fg__grib_numbers *n)
{
  p->scale = p->radius * radius_of(n->parallel, p->eccentricity);
  const double width =
      (double)(grid->size[0] - 1) * n->spacing[0] / p->scale / FG__RADIANS;
  p->meridian = n->first[0] + (grid->x_descends ? -0.5 : 0.5) * width;
  p->meridian -= 360.0 * floor((p->meridian + 180.0) / 360.0);
  if (!(width <= 360.0 + 1e-3))
    p->scale = (double)NAN;
}

static bool are_finite(const double *numbers, int count)
{
  for (int k = 0; k < count; ++k)
    if (!isfinite(numbers[k]))
      return false;
  return true;
}

/* Whether the numbers are those of a grid on a body of the Earth's kind. */
static bool check_numbers(fg__grib_grid *grid, const fg__grib_numbers *n, double major,
                          double minor)
{
  const double numbers[] = {n->first[0], n->first[1], n->meridian, n->parallel};
  const bool lambert = strcmp(grid->type, "lambert") == 0;
  if (!(n->spacing[0] > 0.0 && n->spacing[1] > 0.0))
    fg__set_unusable(grid->unusable, "its points lie %g and %g m apart", n->spacing[0],
                     n->spacing[1]);
  else if (!(major >= 1e6 && major <= 1e8 && minor >= 0.9 * major && minor <= major))
    fg__set_unusable(grid->unusable, "the Earth has half-axes of %g and %g m there",
                     major, minor);
  else if (!are_finite(numbers, 4) || fabs(n->first[1]) > 90.0 ||
           fabs(n->parallel) > 90.0 || fabs(n->first[0]) > 720.0 ||
           fabs(n->meridian) > 720.0 ||
           (lambert && !(fabs(n->parallel_1) < 90.0 && fabs(n->parallel_2) < 90.0)))
    fg__set_unusable(grid->unusable, "its projection is not said in full");
  else if (strcmp(grid->type, "mercator") == 0 && n->meridian != 0.0)
    fg__set_unusable(grid->unusable, "its projection is Mercator's turned by %g degrees",
                     n->meridian);
  return !grid->unusable[0];
}

static void write_number(char *out, const char *word, double number)
{
  char text[FG__NUMBER_BYTES];
  const size_t used = strlen(out);
  fg__number_write(text, number);
  snprintf(out + used, FG__GRIB_TEXT - used, " +%s=%s", word, text);
}

static bool write_projection(char *out, const fg__grib_projection *p,
                             const fg__grib_numbers *n, double minor)
{
  static const char *const names[] = {"lcc", "stere", "merc"};
  fg__number_locale locale;
  if (!fg__number_locale_begin(&locale))
    return false;
  snprintf(out, FG__GRIB_TEXT, "+proj=%s", names[p->kind]);
  if (p->kind == FG__GRIB_LAMBERT) {
    write_number(out, "lat_1", n->parallel_1);
    write_number(out, "lat_2", n->parallel_2);
    write_number(out, "lat_0", n->parallel);
  } else {
    if (p->kind == FG__GRIB_STEREOGRAPHIC)
      write_number(out, "lat_0", 90.0 * p->cone);
    write_number(out, "lat_ts",
                 p->kind == FG__GRIB_STEREOGRAPHIC ? fabs(n->parallel) * p->cone
                                                   : n->parallel);
  }
  write_number(out, "lon_0", p->meridian);
  if (p->eccentricity > 0.0) {
    write_number(out, "a", p->radius);
    write_number(out, "b", minor);
  } else {
    write_number(out, "R", p->radius);
  }
  const size_t used = strlen(out);
  snprintf(out + used, FG__GRIB_TEXT - used, " +units=m +no_defs");
  fg__number_locale_end(&locale);
  return true;
}

static void make_projection(fg__grib_projection *p, const fg__grib_grid *grid,
                            const fg__grib_numbers *n, double major, double minor)
{
  const double ratio = minor / major;
  *p = (fg__grib_projection){.radius = major,
                             .eccentricity = sqrt(fmax(0.0, 1.0 - ratio * ratio)),
                             .meridian = n->meridian};
  p->kind = strcmp(grid->type, "lambert") == 0    ? FG__GRIB_LAMBERT
            : strcmp(grid->type, "mercator") == 0 ? FG__GRIB_MERCATOR
                                                  : FG__GRIB_STEREOGRAPHIC;
  if (p->kind == FG__GRIB_LAMBERT)
    make_lambert(p, n);
  else if (p->kind == FG__GRIB_STEREOGRAPHIC)
    make_stereographic(p, n);
  else
    make_mercator(p, grid, n);
}

fg_status fg__grib_plane(fg__grib_grid *grid, fg_context *context,
                         const fg__grib_numbers *n)
{
  const bool oblate = n->oblate == 1.0;
  const double major = oblate ? n->major : n->radius, minor = oblate ? n->minor : major;
  fg__grib_projection p;
  double first[2];
  if (!check_numbers(grid, n, major, minor))
    return FG_STATUS_OK;
  make_projection(&p, grid, n, major, minor);
  fg__grib_forward(&p, n->first[0], n->first[1], &first[0], &first[1]);
  if (!are_finite(first, 2) || !(fabs(first[0]) < 1e9 && fabs(first[1]) < 1e9)) {
    fg__set_unusable(grid->unusable,
                     "its projection does not show its first point, %g, %g", n->first[0],
                     n->first[1]);
    return FG_STATUS_OK;
  }
  grid->cone = p.cone;
  grid->apex = p.apex;
  for (int k = 0; k < 2; ++k) {
    const bool descends = k == 0 ? grid->x_descends : grid->y_descends;
    const double low =
        first[k] - (descends ? (double)(grid->size[k] - 1) * n->spacing[k] : 0.0);
    grid->axis[k] = fg__allocate(grid->size[k], sizeof(double));
    if (!grid->axis[k])
      return fg__fail_memory(context, "an axis", grid->size[k] * sizeof(double));
    for (size_t i = 0; i < grid->size[k]; ++i)
      grid->axis[k][i] = low + (double)i * n->spacing[k];
  }
  if (!write_projection(grid->projection, &p, n, minor))
    return fg__fail_memory(context, "a projection", FG__GRIB_TEXT);
  return FG_STATUS_OK;
}

void fg__grib_turn(float *u, float *v, const fg__grib_grid *grid)
{
  const double sign = grid->cone < 0.0 ? -1.0 : 1.0;
  if (grid->layout != FG__GRIB_PLANE || grid->relative || grid->cone == 0.0)
    return;
  for (size_t j = 0; j < grid->size[1]; ++j)
    for (size_t i = 0; i < grid->size[0]; ++i) {
      const double x = sign * grid->axis[0][i],
                   y = sign * (grid->apex - grid->axis[1][j]);
      const double distance = hypot(x, y);
      const double cosine = distance > 0.0 ? y / distance : 1.0;
      const double sine = distance > 0.0 ? x / distance : 0.0;
      const size_t n = j * grid->size[0] + i;
      const double east = (double)u[n], north = (double)v[n];
      u[n] = (float)(east * cosine - north * sine);
      v[n] = (float)(east * sine + north * cosine);
    }
}
