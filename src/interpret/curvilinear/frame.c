/* Whether components point east and north or along the grid: the first of four rules that
 * applies (docs/method/model-grids.md). */
#include "interpret/curvilinear/curvilinear.h"

#include <ctype.h>
#include <stdio.h>
#include <string.h>
#include <strings.h>

static bool starts_with(const char *text, const char *start)
{
  return strncmp(text, start, strlen(start)) == 0;
}

/* The first rule: standard names, which cfgrib writes whatever the flag of a message is.
 * Returns 1 for east, -1 for the grid, 0 for neither. */
static int by_standard_name(const fg__variable *u, char *name, size_t size)
{
  double relative;
  fg__attribute_text(u, "standard_name", name, size);
  if (fg__attribute_numbers(u, "GRIB_uvRelativeToGrid", &relative, 1) == 1)
    return relative > 0.0 ? -1 : 1;
  if (starts_with(name, "grid_"))
    return -1; /* grid_eastward_wind */
  if (strstr(name, "eastward") || strstr(name, "northward"))
    return 1;
  if (starts_with(name, "x_") || starts_with(name, "y_") || strstr(name, "_x_") ||
      strstr(name, "_y_"))
    return -1;
  return 0;
}

static bool contains(const char *text, const char *word)
{
  const size_t length = strlen(word);
  for (; *text; ++text)
    if (strncasecmp(text, word, length) == 0)
      return true;
  return false;
}

/* Words of the second rule. Of components along a grid models say zonal, too (POP). */
static const char *const geographic_words[] = {"eastward", "northward", "zonal",
                                               "meridional"};
enum { UNAMBIGUOUS_WORDS = 2, GEOGRAPHIC_WORDS = 4 };

/* The first of them in the names of a component; NULL: it has none. */
static const char *geographic_word(const fg__variable *v, size_t count)
{
  char text[FG__TEXT_BYTES];
  fg__attribute_text(v, "long_name", text, sizeof text);
  for (size_t n = 0; n < count; ++n)
    if (contains(v->plain_name, geographic_words[n]) ||
        contains(text, geographic_words[n]))
      return geographic_words[n];
  return NULL;
}

bool fg__says_east(const fg__variable *u)
{
  char name[FG__TEXT_BYTES];
  const int standard = by_standard_name(u, name, sizeof name);
  return standard > 0 || (standard == 0 && geographic_word(u, UNAMBIGUOUS_WORDS));
}

/* The same of a pair; in a file with the grid's angle only an unambiguous word counts. */
static const char *word_of_pair(const fg__pair *pair, bool angle)
{
  const size_t count = angle ? UNAMBIGUOUS_WORDS : GEOGRAPHIC_WORDS;
  const char *word = geographic_word(pair->component[0], count);
  return word ? word : geographic_word(pair->component[1], count);
}

static const fg__variable *find_on(const fg__curvilinear *mesh, const fg__dataset *data,
                                   const char *name)
{
  const fg__curvilinear_part *at = mesh->centre.variable ? &mesh->centre : &mesh->part[0];
  for (size_t i = 0; i < data->variable_count; ++i) {
    const fg__variable *v = &data->variables[i];
    if (strcmp(v->plain_name, name) == 0 && fg__lies_on(data, v, &at->grid, at->variable))
      return v;
  }
  return NULL;
}

static void find_angle(fg__curvilinear *mesh, const fg__dataset *data)
{
  static const char *const pairs[][2] = {{"COSALPHA", "SINALPHA"},
                                         {"AngleCS", "AngleSN"},
                                         {"CS", "SN"},
                                         {"cos_rot", "sin_rot"},
                                         {"cosrot", "sinrot"}};
  static const char *const angles[] = {"angle",  "ANGLE",      "Angle",     "ANGLET",
                                       "anglet", "grid_angle", "gridrot_0", "pang"};
  for (size_t n = 0; n < sizeof angles / sizeof *angles; ++n) {
    const fg__variable *v = find_on(mesh, data, angles[n]);
    if (!v)
      continue;
    mesh->angle[0] = v;
    mesh->turn = FG__TURN_ANGLE;
    return;
  }
  for (size_t n = 0; n < sizeof pairs / sizeof *pairs; ++n) {
    const fg__variable *c = find_on(mesh, data, pairs[n][0]);
    const fg__variable *s = find_on(mesh, data, pairs[n][1]);
    if (!c || !s)
      continue;
    mesh->angle[0] = c;
    mesh->angle[1] = s;
    mesh->turn = FG__TURN_COSINES;
    return;
  }
}

static bool counts_cells(const char *name)
{
  static const char *const known[] = {"i", "j", "ni", "nj"};
  if (starts_with(name, "xi_") || starts_with(name, "eta_"))
    return true;
  for (size_t n = 0; n < sizeof known / sizeof *known; ++n)
    if (strcmp(name, known[n]) == 0)
      return true;
  return false;
}

/* Whether u and v are along dimensions that models name after the grid's own
 * directions. */
static bool is_on_indices(const fg__curvilinear *mesh, const fg__dataset *data)
{
  for (int k = 0; k < 2; ++k)
    if (!counts_cells(data->dimensions[mesh->part[0].grid.axis[k].dimension].name))
      return false;
  return true;
}

/* Whether u and v are along coordinates of a plane, as of a projection, or of a rotated
 * pole. */
static bool is_on_a_plane(const fg__curvilinear *mesh, const fg__dataset *data)
{
  for (int k = 0; k < 2; ++k) {
    char text[FG__TEXT_BYTES], label[FG__TEXT_BYTES];
    const fg__curvilinear_part *u = &mesh->part[0];
    const fg__variable *along =
        fg__coordinate(data, u->variable, u->grid.axis[k].position);
    if (!along)
      return false;
    fg__attribute_text(along, "units", text, sizeof text);
    if (fg__units_read(text, label, sizeof label) == FG__QUANTITY_LENGTH)
      continue;
    fg__attribute_text(along, "standard_name", text, sizeof text);
    if (!starts_with(text, "projection_") && !starts_with(text, "grid_l") &&
        !starts_with(along->plain_name, k == 0 ? "rlon" : "rlat"))
      return false;
  }
  return true;
}

/* Whether the names are NEMO's for components along the grid. */
static bool is_of_nemo(const fg__variable *u)
{
  return starts_with(u->plain_name, "vozo") || starts_with(u->plain_name, "sozo");
}

/* WRF's variables, but not those that its tools have turned ("earth rotated u,v"). */
static bool is_of_wrf(const fg__variable *u)
{
  char text[FG__TEXT_BYTES];
  return fg__attribute_text(u, "MemoryOrder", text, sizeof text) && text[0] == 'X' &&
         !(fg__attribute_text(u, "description", text, sizeof text) &&
           contains(text, "earth"));
}

static bool is_staggered(const fg__curvilinear *mesh)
{
  return mesh->shift[0] != 0 || mesh->shift[1] != 0;
}

static void set_rule(fg__curvilinear *mesh, const char *why)
{
  if (mesh->turn == FG__TURN_NONE)
    snprintf(mesh->rule, sizeof mesh->rule, "east and north (%.200s)", why);
  else if (mesh->turn == FG__TURN_GEOMETRY)
    snprintf(mesh->rule, sizeof mesh->rule,
             "along the grid, turned by its positions (%.200s)", why);
  else
    snprintf(mesh->rule, sizeof mesh->rule, "along the grid, turned by '%.60s' (%.200s)",
             mesh->angle[0]->plain_name, why);
}

bool fg__frame_find(fg__curvilinear *mesh, const fg__dataset *data, const fg__pair *pair,
                    fg_frame wanted)
{
  char name[FG__TEXT_BYTES], why[2 * FG__TEXT_BYTES];
  const fg__variable *u = pair->component[0];
  mesh->turn = FG__TURN_GEOMETRY;
  find_angle(mesh, data);
  const int standard = by_standard_name(u, name, sizeof name);
  const bool angle = mesh->turn != FG__TURN_GEOMETRY;
  const char *word = word_of_pair(pair, angle);
  int frame = 0; /* 1: east, -1: grid */
  if (pair->polar.sense != 0) {
    frame = 1;
    fg__pair_polar_words(why, sizeof why, pair);
  } else if (wanted != FG_FRAME_AUTO) {
    frame = wanted == FG_FRAME_EAST ? 1 : -1;
    snprintf(why, sizeof why, "as asked");
  } else if (standard != 0) {
    frame = standard;
    snprintf(why, sizeof why, "standard_name %.120s", name);
  } else if (word && !is_staggered(mesh)) {
    frame = 1;
    snprintf(why, sizeof why, "its name says %s", word);
  } else if (angle || is_staggered(mesh) || is_of_nemo(u) || is_of_wrf(u) ||
             is_on_indices(mesh, data) || is_on_a_plane(mesh, data)) {
    frame = -1;
    snprintf(why, sizeof why, "%s",
             is_staggered(mesh)          ? "a staggered grid"
             : angle                     ? "the file has the grid's angle"
             : is_of_nemo(u)             ? "NEMO's names"
             : is_of_wrf(u)              ? "WRF's attributes"
             : is_on_indices(mesh, data) ? "its dimensions count cells"
                                         : "its axes are a plane's");
  }
  if (frame > 0)
    mesh->turn = FG__TURN_NONE;
  if (frame != 0)
    set_rule(mesh, why);
  return frame != 0;
}
