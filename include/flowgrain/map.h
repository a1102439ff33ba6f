/* Maps: fields in longitude and latitude laid on the plane of a map projection. Included
 * by flowgrain.h. */
#ifndef FLOWGRAIN_MAP_H
#define FLOWGRAIN_MAP_H

#include "flowgrain/icons.h"
#include "flowgrain/inventory.h"

#ifdef __cplusplus
extern "C" {
#endif

/* A zero field means its default, in brackets. */
struct fg_map_options {
  /* "auto": by what the field covers; "none": longitude and latitude stay as they are; a
   * name, PROJ's or a usual one ("robinson", "polar"), whose parameters follow from what
   * the field covers; a PROJ string, "+proj=laea +lat_0=52 +lon_0=10"; or "EPSG:3035".
   * ["auto"] */
  const char *projection;
  bool has_center;          /* center[0] counts [from what the field covers] */
  bool has_center_latitude; /* so does center[1] [likewise] */
  double center[2];   /* longitude and latitude in the middle, degrees; not of strings and
                         codes, which have theirs */
  bool has_region;    /* `region` counts [all that the field covers] */
  bool region_is_box; /* so do its last two numbers: the field is a volume */
  double region[6];   /* west, east, south, north in degrees; an east that is not beyond
                         west is a turn farther. Of fields that go on no map bounds along
                         x, y and z, in the axes' units: what is read is that part alone,
                         which ends at the region's bounds or the field's */
  int samples;        /* along the plane's longer side [768] */
  int threads;        /* [as many as there are cores, where there is work for them] */
};

/* The projection that "auto" takes for a vector of a file: PROJ's name of it, or the PROJ
 * string of a model's own; NULL where the vector lies on no globe, and in builds without
 * maps. Borrowed; it lives as long as the inventory. */
FG_API const char *fg_map_auto(const fg_inventory_vector *vector);

/* Lays a field on a longitude-latitude grid (2D, scale GEO), or on the plane of a known
 * projection (2D, scale MAP; "auto" is then that one), on the plane of a projection:
 * a field of scale MAP in kilometres, whose velocity lies along the plane's axes and
 * keeps its length, with square samples; missing outside the outline. The same bits on
 * any number of threads. Projections of our own stand on a sphere of 6371 km. ARGUMENT
 * (no such projection, a region without values, a field of another scale), UNSUPPORTED (a
 * build without maps), MEMORY. */
FG_API fg_status fg_field_project(fg_field **out, fg_context *context,
                                  const fg_field *field, const fg_map_options *options);

/* Takes icons to the plane of a field: they become others where that is not theirs. Icons
 * of no known plane are taken for longitudes and latitudes where the field is on a map;
 * a field of no map leaves all as they are. Widths change by the root of the areas'
 * scales; of a line across the new map's cut the longer part stays, and an icon without
 * an image goes. A score is of the old plane: it is not kept there. ARGUMENT (a
 * projection that is none), UNSUPPORTED (a build without maps), MEMORY. */
FG_API fg_status fg_icons_project(fg_icons **icons, fg_context *context,
                                  const fg_field *field);

#ifdef __cplusplus
}
#endif

#endif
