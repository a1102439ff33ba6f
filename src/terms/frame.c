#include "terms/frame.h"

#include "terms/text.h"

#include <stdio.h>
#include <string.h>

const char *const fg__angle_names[][2] = {
    {"angle", NULL},          {"ANGLE", NULL},        {"Angle", NULL},
    {"ANGLET", NULL},         {"anglet", NULL},       {"grid_angle", NULL},
    {"gridrot_0", NULL},      {"pang", NULL},         {"angle_dx", NULL},
    {"COSALPHA", "SINALPHA"}, {"AngleCS", "AngleSN"}, {"CS", "SN"},
    {"cos_rot", "sin_rot"},   {"cosrot", "sinrot"},   {NULL, NULL}};

const char *const fg__mask_names[] = {"wetdry_mask_rho", "mask_rho", "tmask", "maskC",
                                      "hFacC",           "wet",      "wet_c", NULL};

/* Of components along a grid models say zonal, too (POP). */
static const char *const EAST_WORDS[] = {"eastward", "northward", "zonal", "meridional"};
enum { UNAMBIGUOUS_WORDS = 2, ALL_WORDS = 4 };

static const char *or_empty(const char *text)
{
  return text ? text : "";
}

static bool begins(const char *text, const char *start)
{
  return strncmp(text, start, strlen(start)) == 0;
}

/* cfgrib writes "eastward" whatever the flag of a message is. */
static int by_standard_name(const fg__term *u)
{
  const char *name = or_empty(u->standard_name);
  if (u->frame != 0)
    return u->frame;
  if (begins(name, "grid_"))
    return -1; /* grid_eastward_wind */
  if (strstr(name, "eastward") || strstr(name, "northward"))
    return 1;
  return begins(name, "x_") || begins(name, "y_") || strstr(name, "_x_") ||
                 strstr(name, "_y_")
             ? -1
             : 0;
}

/* The first of the words in the names of a component; NULL: it has none. */
static const char *east_word(const fg__term *t, int count)
{
  for (int n = 0; n < count; ++n)
    if (fg__find_text(fg__last_part(t->name), EAST_WORDS[n]) ||
        fg__find_text(or_empty(t->long_name), EAST_WORDS[n]))
      return EAST_WORDS[n];
  return NULL;
}

bool fg__says_east(const fg__term *u)
{
  const int standard = by_standard_name(u);
  return standard > 0 || (standard == 0 && east_word(u, UNAMBIGUOUS_WORDS));
}

bool fg__frame_is_contradicted(const fg__term *u)
{
  static const char words[] = "x component|x-component|y component|y-component|along i|"
                              "along j|along x|along y|along the grid|grid-relative|"
                              "relative to the grid|grid x|grid y|grid-x|grid-y";
  return u->frame == 0 && by_standard_name(u) > 0 && u->long_name &&
         fg__contains_any(u->long_name, words) && !east_word(u, ALL_WORDS);
}

bool fg__counts_cells(const char *dimension)
{
  static const char known[] = "i|j|ni|nj";
  return begins(dimension, "xi_") || begins(dimension, "eta_") ||
         fg__is_one_of(known, dimension, strlen(dimension));
}

int fg__frame_of_terms(char *why, size_t size, const fg__term *u, const fg__term *v,
                       const fg__frame_evidence *evidence)
{
  const int standard = by_standard_name(u);
  /* in a file with the grid's angle only an unambiguous word counts */
  const int words = evidence->angle ? UNAMBIGUOUS_WORDS : ALL_WORDS;
  const char *word = east_word(u, words), *plain = fg__last_part(u->name);
  word = word ? word : east_word(v, words);
  if (standard != 0) {
    if (u->frame != 0)
      snprintf(why, size, "GRIB_uvRelativeToGrid");
    else
      snprintf(why, size, "standard_name %.120s", u->standard_name);
    return standard;
  }
  if (word && !evidence->staggered) {
    snprintf(why, size, "its name says %s", word);
    return 1;
  }
  const char *grid = evidence->staggered ? "a staggered grid"
                     : evidence->angle   ? "the file has the grid's angle"
                     : begins(plain, "vozo") || begins(plain, "sozo") ? "NEMO's names"
                     : evidence->of_wrf                               ? "WRF's attributes"
                     : evidence->on_indices ? "its dimensions count cells"
                     : evidence->on_plane   ? "its axes are a plane's"
                                            : NULL;
  snprintf(why, size, "%s", grid ? grid : "");
  return grid ? -1 : 0;
}
