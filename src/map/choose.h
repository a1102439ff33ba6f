/* Which projection shows a part of the globe. */
#ifndef FG__MAP_CHOOSE_H
#define FG__MAP_CHOOSE_H

#include "flowgrain/map.h"
#include "map/words.h"

/* An arc of so many degrees is all round. */
enum { FG__MAP_ALL_ROUND = 300 };

/* What is to be shown, in degrees: east - west in (0, 360]. */
typedef struct fg__map_area {
  double west, east, south, north;
  bool sea; /* values at sea alone: the map is cut through land */
} fg__map_area;

/* Finds the PROJ string of the options' projection, in kilometres. ARGUMENT (an unknown
 * name or code, a centre beside a string). */
fg_status fg__map_choose(char out[FG__MAP_STRING_BYTES], fg_context *context,
                         const fg_map_options *options, const fg__map_area *area);

/* The name that "auto" stands for; "laea" is then about a pole or oblique by the area. */
const char *fg__map_auto(const fg__map_area *area);

/* The name of ours that the "+proj=" of a string may be another for; NULL: none. */
const char *fg__map_name_near(const char *string);

/* The string of a projected system of coordinates "EPSG:n", by PROJ's database. */
fg_status fg__map_of_code(fg__map_words *out, fg_context *context, const char *code);

#endif
