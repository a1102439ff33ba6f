/* The plane in which a weather model's grid is evenly spaced: the projection in the
 * global attributes of WRF (Skamarock et al., A Description of the Advanced Research WRF,
 * NCAR/TN-475+STR, section 3.4 and appendix of map projections). */
#include "base/decimal.h"
#include "interpret/curvilinear/curvilinear.h"
#include "interpret/projector.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* The Earth's radius in WRF, metres (share/module_model_constants). */
static const double RADIUS = 6370000.0;

/* Values of MAP_PROJ. MERCATOR and 6 (longitude-latitude) have rectilinear grids, which
 * are no mesh; with 6 they are evenly spaced in degrees. */
enum { LAMBERT = 1, STEREOGRAPHIC = 2, MERCATOR = 3 };

/* Number of points compared along each axis, and their largest deviation from an even
 * grid, in cells. A larger one means another projection, or a subset of the grid. */
enum { COMPARED = 24 };
static const double LARGEST_RESIDUAL = 0.5;

/* A global attribute; NaN where there is none. */
static double number_of(const fg__variable *all, const char *name)
{
  double value;
  return fg__attribute_numbers(all, name, &value, 1) == 1 ? value : (double)NAN;
}

static double or_else(double value, double other)
{
  return isfinite(value) ? value : other;
}

/* Appends " +KEY=VALUE" of nine digits, as many as attributes of four bytes have. */
static void add(char *out, size_t size, const char *key, double value)
{
  char number[FG__NUMBER_BYTES];
  const size_t used = strlen(out);
  fg__number_round(number, value, 9);
  snprintf(out + used, size - used, " +%s=%s", key, number);
}

static bool compose(char *out, size_t size, const fg__variable *all)
{
  const double kind = number_of(all, "MAP_PROJ"), one = number_of(all, "TRUELAT1");
  const double meridian = number_of(all, "STAND_LON");
  const double latitude =
      or_else(number_of(all, "MOAD_CEN_LAT"), number_of(all, "CEN_LAT"));
  if (!(fabs(one) <= 90.0 && fabs(meridian) <= 360.0))
    return false;
  if (kind == LAMBERT && fabs(latitude) < 90.0) {
    snprintf(out, size, "+proj=lcc");
    add(out, size, "lat_1", one);
    add(out, size, "lat_2", or_else(number_of(all, "TRUELAT2"), one));
    add(out, size, "lat_0", latitude);
  } else if (kind == STEREOGRAPHIC) {
    snprintf(out, size, "+proj=stere +lat_0=%d", one < 0.0 ? -90 : 90);
    add(out, size, "lat_ts", one);
  } else if (kind == MERCATOR && fabs(one) < 90.0) {
    snprintf(out, size, "+proj=merc");
    add(out, size, "lat_ts", one);
  } else {
    return false;
  }
  add(out, size, "lon_0", meridian);
  add(out, size, "R", RADIUS);
  const size_t used = strlen(out);
  return (size_t)snprintf(out + used, size - used, " +units=km") < size - used;
}

/* Positions of a grid: one for each point, or along axes. */
typedef struct lattice {
  const double *longitude, *latitude;
  size_t size[2];
  bool on_axes;
} lattice;

static double longitude_of(const lattice *of, size_t i, size_t j)
{
  return of->longitude[of->on_axes ? i : j * of->size[0] + i];
}

/* The first and last index along each axis with both coordinates. */
static bool find_inside(size_t low[2], size_t high[2], const lattice *of)
{
  low[0] = of->size[0], low[1] = of->size[1], high[0] = high[1] = 0;
  for (size_t j = 0; j < of->size[1]; ++j)
    for (size_t i = 0; i < of->size[0]; ++i) {
      const size_t at[2] = {i, j};
      for (int k = 0; k < 2 && isfinite(longitude_of(of, i, j)); ++k) {
        low[k] = at[k] < low[k] ? at[k] : low[k];
        high[k] = at[k] > high[k] ? at[k] : high[k];
      }
    }
  return low[0] < high[0] && low[1] < high[1];
}

static void image_of(double at[2], const fg__projector *by, const fg__map *map,
                     const lattice *of, size_t i, size_t j)
{
  double longitude = longitude_of(of, i, j);
  const double latitude = of->latitude[of->on_axes ? j : j * of->size[0] + i];
  longitude -= 360.0 * nearbyint((longitude - by->center(map)) / 360.0);
  by->forward(map, 1, &longitude, &latitude, &at[0], &at[1]);
}

/* Whether the points are evenly spaced along the plane's axes. */
static bool is_even(const fg__projector *by, const fg__map *map, const lattice *of)
{
  size_t low[2], high[2];
  double first[2], last[2], step[2];
  if (!find_inside(low, high, of))
    return false;
  image_of(first, by, map, of, low[0], low[1]);
  image_of(last, by, map, of, high[0], high[1]);
  for (int k = 0; k < 2; ++k)
    step[k] = (last[k] - first[k]) / (double)(high[k] - low[k]);
  for (size_t j = low[1]; j <= high[1]; j += (high[1] - low[1]) / COMPARED + 1)
    for (size_t i = low[0]; i <= high[0]; i += (high[0] - low[0]) / COMPARED + 1) {
      double at[2];
      image_of(at, by, map, of, i, j);
      const double off[2] = {at[0] - first[0] - step[0] * (double)(i - low[0]),
                             at[1] - first[1] - step[1] * (double)(j - low[1])};
      if (!(fabs(off[0]) <= LARGEST_RESIDUAL * fabs(step[0]) &&
            fabs(off[1]) <= LARGEST_RESIDUAL * fabs(step[1])))
        return false;
    }
  return true;
}

/* The plane of the attributes; "" without them, or where they do not agree with
 * positions. */
static void find_plane(char *out, size_t size, const fg__variable *u, const lattice *of)
{
  const fg__variable *all = fg__file_of(u);
  const fg__projector *by = u->owner->projector;
  fg__map *map = NULL;
  if (!by || !compose(out, size, all) || by->create(&map, NULL, out) != FG_STATUS_OK ||
      !is_even(by, map, of))
    out[0] = '\0';
  if (map)
    by->destroy(map);
}

void fg__model_plane(fg__curvilinear *mesh, const fg__variable *u,
                     const fg__sphere_cells *cells)
{
  const lattice of = {.longitude = cells->longitude,
                      .latitude = cells->latitude,
                      .size = {mesh->size[0], mesh->size[1]}};
  mesh->plane[0] = '\0';
  if (cells->points == mesh->size[0] * mesh->size[1])
    find_plane(mesh->plane, sizeof mesh->plane, u, &of);
}

const char *fg__axes_plane(char out[FG__TEXT_BYTES], const fg__variable *u,
                           const fg__grid *grid)
{
  if (grid->dimension != 2 || grid->scale != FG_SCALE_GEO || !grid->axis[0].coordinate ||
      !grid->axis[1].coordinate)
    return NULL;
  const lattice of = {.longitude = grid->axis[0].coordinate,
                      .latitude = grid->axis[1].coordinate,
                      .size = {grid->axis[0].size, grid->axis[1].size},
                      .on_axes = true};
  find_plane(out, FG__TEXT_BYTES, u, &of);
  return out[0] ? out : NULL;
}
