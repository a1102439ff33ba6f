#include "base/context.h"
#include "base/memory.h"
#include "picture/map/graticule.h"
#include "picture/map/land.h"
#include "sphere/sphere.h"
#include "write/view/parts.h"

#include <math.h>
#include <stdlib.h>

/* Vertices that move a line by less than this share of the longest side are dropped: a
 * pixel of a window of 2000. */
static const double tolerance = 1.0 / 6000.0;
static const double round_tolerance = 1.0 / 50000.0; /* of degrees and the outline */

/* Lines go on beyond the frame; up to this share of the longest side they are kept. */
static const double margin = 0.05;

/* Metres in this share from which on coasts are generalised, as pictures have them for a
 * point of 480 (picture/map/map_scene.c). */
static const double coarse_from = 50e3, middle_from = 1e3;

static fg__coast_detail detail_of(const fg__plane *plane, double longest)
{
  const double metres = plane->metres * longest * tolerance;
  return metres >= coarse_from   ? FG__COAST_110M
         : metres >= middle_from ? FG__COAST_50M
                                 : FG__COAST_10M;
}

/* Where the nodes of a raster lie on the globe, as directions in space, between which
 * places can be found linearly. */
enum { NODES = 65 };

static fg_status write_places(FILE *stream, fg_context *context, const fg__plane *plane)
{
  enum { COUNT = NODES * NODES };
  double *x = fg__allocate((size_t)4 * COUNT, sizeof *x);
  float *direction = fg__allocate((size_t)3 * COUNT, sizeof *direction);
  bool done = x && direction;
  if (done) {
    double *y = x + COUNT, *longitude = y + COUNT, *latitude = longitude + COUNT;
    for (int n = 0; n < COUNT; ++n) {
      const double share[2] = {n % NODES / (NODES - 1.0), n / NODES / (NODES - 1.0)};
      x[n] = plane->low[0] + share[0] * (plane->high[0] - plane->low[0]);
      y[n] = plane->low[1] + share[1] * (plane->high[1] - plane->low[1]);
    }
    fg__plane_inverse(plane, COUNT, x, y, longitude, latitude);
    for (int n = 0; n < COUNT; ++n) {
      double up[3];
      fg__sphere_unit_vector(up, longitude[n], latitude[n]);
      for (int k = 0; k < 3; ++k)
        direction[3 * n + k] = (float)up[k];
    }
    fprintf(stream,
            ",\"places\":{\"nodes\":[%d,%d],\"low\":[%.17g,%.17g],"
            "\"high\":[%.17g,%.17g],\"directions\":",
            NODES, NODES, plane->low[0], plane->low[1], plane->high[0], plane->high[1]);
    done = fg__view_bytes(stream, direction, (size_t)3 * COUNT * sizeof *direction);
    putc('}', stream);
  }
  free(x);
  free(direction);
  return done ? FG_STATUS_OK
              : fg__fail_memory(context, "a page's map", (size_t)4 * COUNT * sizeof *x);
}

typedef struct map_lines {
  fg__polygons land, shore, lakes, banks;
} map_lines;

static fg_status trace(map_lines *out, fg_context *context, const fg__plane *plane,
                       fg__coast_detail detail)
{
  fg_status status =
      fg__land_trace(&out->land, &out->shore, context, plane, FG__COAST_LAND, detail);
  if (!status)
    status =
        fg__land_trace(&out->lakes, &out->banks, context, plane, FG__COAST_LAKES, detail);
  return status;
}

static fg_status write_map(FILE *stream, fg_context *context, fg__plane *plane,
                           fg__graticule *graticule)
{
  map_lines lines = {.land = {.point = NULL}};
  const double longest =
      fmax(plane->high[0] - plane->low[0], plane->high[1] - plane->low[1]);
  fg_status status = trace(&lines, context, plane, detail_of(plane, longest));
  struct {
    const char *name;
    fg__polygons *polygons;
  } layers[] = {{"land", &lines.land},         {"shore", &lines.shore},
                {"lakes", &lines.lakes},       {"banks", &lines.banks},
                {"degrees", &graticule->line}, {"outline", &plane->outline}};
  double low[2], high[2];
  for (int k = 0; k < 2; ++k) {
    low[k] = plane->low[k] - margin * longest;
    high[k] = plane->high[k] + margin * longest;
  }
  fprintf(stream, "\"map\":{\"low\":[%.17g,%.17g],\"high\":[%.17g,%.17g]", low[0], low[1],
          high[0], high[1]);
  for (size_t k = 0; k < sizeof layers / sizeof *layers && !status; ++k) {
    const bool round =
        layers[k].polygons == &graticule->line || layers[k].polygons == &plane->outline;
    fg__polygons_simplify(layers[k].polygons,
                          (round ? round_tolerance : tolerance) * longest);
    putc(',', stream);
    if (!fg__view_lines(stream, layers[k].name, layers[k].polygons, low, high))
      status = fg__fail_memory(context, "a page's map", layers[k].polygons->point_count);
  }
  if (!status && plane->kind != FG__PLANE_DEGREES)
    status = write_places(stream, context, plane);
  putc('}', stream);
  fg__polygons_clear(&lines.land);
  fg__polygons_clear(&lines.shore);
  fg__polygons_clear(&lines.lakes);
  fg__polygons_clear(&lines.banks);
  return status;
}

fg_status fg__view_map(FILE *stream, fg_context *context, const fg_field *field)
{
  const fg_field_arrays *a = fg_field_contents(field);
  double low[2], high[2];
  for (int k = 0; k < 2; ++k) {
    low[k] = a->axis[k][0];
    high[k] = a->period[k] > 0.0 ? low[k] + a->period[k] : a->axis[k][a->size[k] - 1];
  }
  fg__plane plane = {.kind = FG__PLANE_NONE};
  fg_status status = fg__plane_create(&plane, context, field, low, high);
  if (!status && plane.kind == FG__PLANE_NONE)
    fputs("\"map\":null", stream);
  else if (!status) {
    fg__graticule graticule;
    status = fg__graticule_create(&graticule, context, &plane);
    if (!status) {
      status = write_map(stream, context, &plane, &graticule);
      fg__graticule_clear(&graticule);
    }
  }
  fg__plane_clear(&plane);
  return status;
}
