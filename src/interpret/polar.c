/* Speeds and directions in place of components: by CF standard names ("wind_speed" and
 * "wind_from_direction"), or by the units of a direction that the options name. */
#include "base/angle.h"
#include "interpret/curvilinear/curvilinear.h"
#include "interpret/unstructured/unstructured.h"

#include <ctype.h>
#include <stdio.h>
#include <string.h>

/* A standard name; "" where it is one of a quality ("wind_speed status_flag"). */
static void standard_name(char out[FG__TEXT_BYTES], const fg__variable *v)
{
  fg__attribute_text(v, "standard_name", out, FG__TEXT_BYTES);
  if (strpbrk(out, " \t"))
    out[0] = '\0';
}

static int sense_of(const fg__variable *v, const char *standard)
{
  char text[FG__TEXT_BYTES];
  if (standard[0])
    return strstr(standard, "from_direction") ? -1 : 1;
  fg__attribute_text(v, "long_name", text, sizeof text);
  return fg__polar_sense(v->plain_name, text);
}

bool fg__direction(fg__polar *out, const fg__variable *v)
{
  char standard[FG__TEXT_BYTES], units[FG__TEXT_BYTES];
  standard_name(standard, v);
  fg__attribute_text(v, "units", units, sizeof units);
  out->sense = sense_of(v, standard);
  out->unit = units[0] ? fg__polar_unit(units) : FG__RADIANS;
  return standard[0] ? strstr(standard, "direction") != NULL
                     : units[0] && out->unit > 0.0;
}

/* What moves: "sea_water" of "sea_water_velocity_to_direction", of
 * "direction_of_sea_water_velocity" and of "sea_water_speed"; "": nothing known. */
static void mover_of(char out[FG__TEXT_BYTES], const fg__variable *v)
{
  static const char *const ends[] = {"_speed", "_from_direction", "_to_direction"};
  static const char before[] = "direction_of_", after[] = "_velocity";
  char standard[FG__TEXT_BYTES];
  size_t length = 0;
  standard_name(standard, v);
  const char *start = standard;
  if (strncmp(start, before, strlen(before)) == 0) {
    start += strlen(before);
    length = strlen(start);
  }
  for (size_t i = 0; i < sizeof ends / sizeof *ends && length == 0; ++i) {
    const size_t all = strlen(start), end = strlen(ends[i]);
    if (all > end && strcmp(start + all - end, ends[i]) == 0)
      length = all - end;
  }
  const size_t cut = strlen(after);
  if (length > cut && strncmp(start + length - cut, after, cut) == 0)
    length -= cut;
  snprintf(out, FG__TEXT_BYTES, "%.*s", (int)length, start);
}

/* Whether names have the same digits, as "ws10" and "wd10". */
static bool same_digits(const char *a, const char *b)
{
  for (;; ++a, ++b) {
    while (*a && !isdigit((unsigned char)*a))
      ++a;
    while (*b && !isdigit((unsigned char)*b))
      ++b;
    if (*a != *b || !*a)
      return *a == *b;
  }
}

static bool stand_together(const fg__dataset *data, const fg__variable *a,
                           const fg__variable *b)
{
  bool same = a != b && a->rank == b->rank;
  for (int k = 0; same && k < a->rank; ++k)
    same = fg__alike_dimension(data, a->dimension[k], b->dimension[k]);
  return same;
}

/* The speed at the places of a direction, by their standard names; NULL: none. */
static const fg__variable *speed_of(const fg__dataset *data,
                                    const fg__variable *direction)
{
  char mover[FG__TEXT_BYTES], other[FG__TEXT_BYTES], standard[FG__TEXT_BYTES];
  const fg__variable *found = NULL;
  bool alike = false;
  mover_of(mover, direction);
  for (size_t i = 0; mover[0] && i < data->variable_count && !alike; ++i) {
    const fg__variable *v = &data->variables[i];
    if (v->file >= data->component_files || !fg__is_array(v) ||
        !stand_together(data, v, direction))
      continue;
    standard_name(standard, v);
    mover_of(other, v);
    if (!strstr(standard, "_speed") || strcmp(mover, other) != 0)
      continue;
    alike = same_digits(v->plain_name, direction->plain_name);
    found = found && !alike ? found : v;
  }
  return found;
}

bool fg__find_polar(fg__pair *out, const fg__dataset *data, const fg__variable *direction)
{
  if (!fg__direction(&out->polar, direction))
    return false;
  out->component[0] = speed_of(data, direction);
  out->component[1] = direction;
  return out->component[0] != NULL;
}

/* Whether a variable may be a speed: units of one, or none, or by its standard name. */
static bool is_speed(const fg__variable *v)
{
  char text[FG__TEXT_BYTES], label[FG__TEXT_BYTES];
  standard_name(text, v);
  if (strstr(text, "speed"))
    return true;
  fg__attribute_text(v, "units", text, sizeof text);
  return !text[0] || fg__units_read(text, label, sizeof label) == FG__QUANTITY_SPEED;
}

fg_status fg__settle_polar(fg__pair *pair, const fg__dataset *data)
{
  fg__polar polar[2];
  const bool way[2] = {fg__direction(&polar[0], pair->component[0]),
                       fg__direction(&polar[1], pair->component[1])};
  if (way[0] == way[1])
    return FG_STATUS_OK;
  const int k = way[0] ? 0 : 1;
  const fg__variable *direction = pair->component[k], *speed = pair->component[1 - k];
  if (!is_speed(speed)) {
    const fg__variable *meant = speed_of(data, direction);
    fg__fail(data->context, FG_STATUS_ARGUMENT,
             "%s: '%.200s' is a direction, and '%.200s' is no speed", data->file[0].path,
             direction->name, speed->name);
    fg__hint(data->context, "name a speed and its direction: --vars %s,%s",
             meant ? meant->name : "SPEED", direction->name);
    return FG_STATUS_ARGUMENT;
  }
  pair->component[0] = speed;
  pair->component[1] = direction;
  pair->polar = polar[k];
  return FG_STATUS_OK;
}

void fg__check_polar(fg__grid *grid, const fg__pair *pair, const fg_read_options *options)
{
  const fg__variable *direction = pair->component[1];
  const fg__grid_axis *axis = grid->axis;
  if (pair->polar.sense == 0)
    return;
  if (pair->polar.unit == 0.0)
    fg__set_unusable(grid->unusable,
                     "the direction '%.120s' is not in degrees or radians",
                     direction->name);
  if (grid->faces.used || (grid->mesh && (grid->mesh->shift[0] || grid->mesh->shift[1])))
    fg__set_unusable(grid->unusable, "speed and direction lie at different places");
  if (options->frame == FG_FRAME_GRID)
    fg__set_unusable(grid->unusable,
                     "'%.120s' is a direction from north, not from the grid's lines",
                     direction->name);
  const bool on_globe =
      grid->mesh || (grid->unstructured && !grid->unstructured->in_plane) ||
      grid->points_east ||
      (axis[0].quantity == FG__QUANTITY_DEGREES_EAST &&
       axis[1].quantity == FG__QUANTITY_DEGREES_NORTH) ||
      (grid->scale == FG_SCALE_GEO && strcmp(axis[0].name, "grid longitude") != 0);
  if (!on_globe && !grid->unusable[0]) {
    fg__set_unusable(grid->unusable,
                     "'%.120s' is a direction from north, and where north lies on its "
                     "grid is not known",
                     direction->name);
    snprintf(grid->hint, sizeof grid->hint,
             "speed and direction are read with longitude and latitude, or in a "
             "projection that the file describes");
  }
}

const char *fg__component_name(const fg__pair *pair, int k)
{
  return pair->polar.sense == 0 ? pair->component[k]->name : NULL;
}

void fg__pair_polar_words(char *out, size_t size, const fg__pair *pair)
{
  char standard[FG__TEXT_BYTES], rule[FG__TEXT_BYTES];
  const fg__variable *direction = pair->component[1];
  standard_name(standard, direction);
  snprintf(rule, sizeof rule, "%s %.80s", standard[0] ? "standard_name" : "its name is",
           standard[0] ? standard : direction->plain_name);
  fg__polar_words(out, size, &pair->polar, rule);
}
