/* Grids in the plane of a projection. Its formulas are Snyder's (Map Projections: A
 * Working Manual, 1987); the plane is the one that PROJ makes of the same numbers. */
#include "base/angle.h"
#include "base/memory.h"
#include "decode/grib/grib.h"

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

/* The plane's coordinates of a longitude and latitude, metres. */
static void forward(const fg__grib_projection *p, double longitude, double latitude,
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
  p->origin = n->parallel;
  p->parallel[0] = one;
  p->parallel[1] = two;
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
  p->origin = 90.0 * p->cone;
  p->parallel[0] = parallel * p->cone;
}

/* Its meridian is the grid's middle, so that no column lies beyond the cut. */
static void make_mercator(fg__grib_projection *p, const fg__grib_grid *grid,
                          const fg__grib_numbers *n)
{
  p->scale = p->radius * radius_of(n->parallel, p->eccentricity);
  p->parallel[0] = n->parallel;
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
    fg__grib_unusable(grid, "its points lie %g and %g m apart", n->spacing[0],
                      n->spacing[1]);
  else if (!(major >= 1e6 && major <= 1e8 && minor >= 0.9 * major && minor <= major))
    fg__grib_unusable(grid, "the Earth has half-axes of %g and %g m there", major, minor);
  else if (!are_finite(numbers, 4) || fabs(n->first[1]) > 90.0 ||
           fabs(n->parallel) > 90.0 || fabs(n->first[0]) > 720.0 ||
           fabs(n->meridian) > 720.0 ||
           (lambert && !(fabs(n->parallel_1) < 90.0 && fabs(n->parallel_2) < 90.0)))
    fg__grib_unusable(grid, "its projection is not said in full");
  else if (strcmp(grid->type, "mercator") == 0 && n->meridian != 0.0)
    fg__grib_unusable(grid, "its projection is Mercator's turned by %g degrees",
                      n->meridian);
  return !grid->unusable[0];
}

static void make_projection(fg__grib_projection *p, const fg__grib_grid *grid,
                            const fg__grib_numbers *n, double major, double minor)
{
  const double ratio = minor / major;
  *p = (fg__grib_projection){.radius = major,
                             .minor = minor,
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
  fg__grib_projection *p = &grid->projection;
  double first[2];
  if (!check_numbers(grid, n, major, minor))
    return FG_STATUS_OK;
  make_projection(p, grid, n, major, minor);
  forward(p, n->first[0], n->first[1], &first[0], &first[1]);
  if (!are_finite(first, 2) || !(fabs(first[0]) < 1e9 && fabs(first[1]) < 1e9)) {
    fg__grib_unusable(grid, "its projection does not show its first point, %g, %g",
                      n->first[0], n->first[1]);
    return FG_STATUS_OK;
  }
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
  return FG_STATUS_OK;
}

fg_status fg__grib_plane_add(fg__variable *variable, const fg__grib_grid *grid)
{
  const fg__grib_projection *p = &grid->projection;
  static const struct {
    const char *name, *meridian;
    int parallels;
  } cf[] = {
      [FG__GRIB_LAMBERT] = {"lambert_conformal_conic", "longitude_of_central_meridian",
                            2},
      [FG__GRIB_STEREOGRAPHIC] = {"polar_stereographic",
                                  "straight_vertical_longitude_from_pole", 1},
      [FG__GRIB_MERCATOR] = {"mercator", "longitude_of_projection_origin", 1},
  };
  const bool oblate = p->eccentricity > 0.0;
  const struct {
    const char *name;
    const double *number;
    size_t count;
  } numbers[] = {{"latitude_of_projection_origin", &p->origin, 1},
                 {cf[p->kind].meridian, &p->meridian, 1},
                 {"standard_parallel", p->parallel, (size_t)cf[p->kind].parallels},
                 {oblate ? "semi_major_axis" : "earth_radius", &p->radius, 1},
                 {"semi_minor_axis", &p->minor, 1}};
  const char *name = cf[p->kind].name;
  fg_status status =
      fg__variable_add_text(variable, "grid_mapping_name", name, strlen(name));
  for (size_t i = p->kind == FG__GRIB_MERCATOR;
       i < sizeof numbers / sizeof *numbers - !oblate && status == FG_STATUS_OK; ++i)
    status = fg__variable_add_numbers(variable, numbers[i].name, numbers[i].number,
                                      numbers[i].count, true);
  return status;
}
