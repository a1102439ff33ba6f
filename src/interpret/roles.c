/* Which dimension is x, y, time and level: by the coordinates' attributes (CF
 * conventions, chapter 4), then by their names, then by their order. */
#include "interpret/interpret.h"

#include <ctype.h>
#include <string.h>
#include <strings.h>

typedef struct word_role {
  const char *word;
  fg__role role;
} word_role;

static fg__role find_role(const word_role *table, size_t count, const char *word)
{
  for (size_t i = 0; i < count; ++i)
    if (strcasecmp(table[i].word, word) == 0)
      return table[i].role;
  return FG__NO_ROLE;
}

static fg__role role_of_standard_name(const char *name)
{
  static const word_role known[] = {
      {"longitude", FG__ROLE_X},
      {"grid_longitude", FG__ROLE_X},
      {"projection_x_coordinate", FG__ROLE_X},
      {"projection_x_angular_coordinate", FG__ROLE_X},
      {"x_grid_index", FG__ROLE_X},
      {"latitude", FG__ROLE_Y},
      {"grid_latitude", FG__ROLE_Y},
      {"projection_y_coordinate", FG__ROLE_Y},
      {"projection_y_angular_coordinate", FG__ROLE_Y},
      {"y_grid_index", FG__ROLE_Y},
      {"time", FG__ROLE_TIME},
      {"forecast_period", FG__ROLE_TIME},
      {"forecast_reference_time", FG__ROLE_TIME},
      {"depth", FG__ROLE_LEVEL},
      {"height", FG__ROLE_LEVEL},
      {"altitude", FG__ROLE_LEVEL},
      {"geopotential_height", FG__ROLE_LEVEL},
      {"air_pressure", FG__ROLE_LEVEL},
      {"sea_water_pressure", FG__ROLE_LEVEL},
      {"model_level_number", FG__ROLE_LEVEL},
  };
  if (strstr(name, "sigma") || strstr(name, "ocean_s_coordinate") ||
      strstr(name, "hybrid"))
    return FG__ROLE_LEVEL;
  return find_role(known, sizeof known / sizeof *known, name);
}

static fg__role role_of_attributes(const fg__variable *coordinate)
{
  static const word_role axis[] = {
      {"X", FG__ROLE_X}, {"Y", FG__ROLE_Y}, {"T", FG__ROLE_TIME}, {"Z", FG__ROLE_LEVEL}};
  char text[FG__TEXT_BYTES];
  char label[FG__TEXT_BYTES];
  fg__attribute_text(coordinate, "axis", text, sizeof text);
  fg__role role = find_role(axis, sizeof axis / sizeof *axis, text);
  if (role == FG__NO_ROLE &&
      fg__attribute_text(coordinate, "standard_name", text, sizeof text))
    role = role_of_standard_name(text);
  if (role != FG__NO_ROLE)
    return role;
  fg__attribute_text(coordinate, "units", text, sizeof text);
  switch (fg__units_read(text, label, sizeof label)) {
  case FG__QUANTITY_DEGREES_EAST:
    return FG__ROLE_X;
  case FG__QUANTITY_DEGREES_NORTH:
    return FG__ROLE_Y;
  case FG__QUANTITY_DATE:
    return FG__ROLE_TIME;
  case FG__QUANTITY_PRESSURE:
    return FG__ROLE_LEVEL;
  default:
    break;
  }
  if (fg__attribute_text(coordinate, "positive", text, sizeof text))
    return FG__ROLE_LEVEL;
  return FG__NO_ROLE;
}

static bool starts_with(const char *text, const char *start)
{
  return strncasecmp(text, start, strlen(start)) == 0;
}

static bool starts_with_any(const char *text, const char *const *starts, size_t count)
{
  for (size_t i = 0; i < count; ++i)
    if (starts_with(text, starts[i]))
      return true;
  return false;
}

/* Only unambiguous names: in files converted from GRIB "gridx" is an index. */
static fg__role role_of_name(const char *name)
{
  static const word_role whole[] = {
      {"x", FG__ROLE_X},        {"nx", FG__ROLE_X},       {"i", FG__ROLE_X},
      {"ni", FG__ROLE_X},       {"nlon", FG__ROLE_X},     {"easting", FG__ROLE_X},
      {"xc", FG__ROLE_X},       {"y", FG__ROLE_Y},        {"ny", FG__ROLE_Y},
      {"j", FG__ROLE_Y},        {"nj", FG__ROLE_Y},       {"nlat", FG__ROLE_Y},
      {"northing", FG__ROLE_Y}, {"yc", FG__ROLE_Y},       {"t", FG__ROLE_TIME},
      {"date", FG__ROLE_TIME},  {"month", FG__ROLE_TIME}, {"record", FG__ROLE_TIME},
      {"step", FG__ROLE_TIME},  {"z", FG__ROLE_LEVEL},    {"nz", FG__ROLE_LEVEL},
      {"k", FG__ROLE_LEVEL},    {"alt", FG__ROLE_LEVEL},  {"s_rho", FG__ROLE_LEVEL},
      {"rlon", FG__ROLE_X},     {"rlat", FG__ROLE_Y},
  };
  static const char *const x[] = {"lon", "xi_", "west_east", "xt_", "xu_", "x_"};
  static const char *const y[] = {"lat", "eta_", "south_north", "yt_", "yu_", "y_"};
  static const char *const level[] = {"lev",    "lv_",        "depth",  "height",
                                      "plev",   "press",      "isobar", "sigma",
                                      "hybrid", "bottom_top", "layer",  "altitude"};
  const fg__role role = find_role(whole, sizeof whole / sizeof *whole, name);
  if (role != FG__NO_ROLE)
    return role;
  for (const char *c = name; *c; ++c)
    if (starts_with(c, "time"))
      return FG__ROLE_TIME;
  if (starts_with_any(name, x, sizeof x / sizeof *x))
    return FG__ROLE_X;
  if (starts_with_any(name, y, sizeof y / sizeof *y))
    return FG__ROLE_Y;
  if (starts_with_any(name, level, sizeof level / sizeof *level))
    return FG__ROLE_LEVEL;
  return FG__NO_ROLE;
}

static fg__role geographic_role(const fg__variable *coordinate)
{
  char text[FG__TEXT_BYTES];
  char label[FG__TEXT_BYTES];
  fg__attribute_text(coordinate, "units", text, sizeof text);
  const bool has_units = text[0] != '\0';
  const fg__quantity quantity = fg__units_read(text, label, sizeof label);
  if (quantity == FG__QUANTITY_DEGREES_EAST)
    return FG__ROLE_X;
  if (quantity == FG__QUANTITY_DEGREES_NORTH)
    return FG__ROLE_Y;
  if (has_units && quantity != FG__QUANTITY_DEGREES)
    return FG__NO_ROLE;
  fg__attribute_text(coordinate, "standard_name", text, sizeof text);
  if (strcmp(text, "longitude") == 0)
    return FG__ROLE_X;
  if (strcmp(text, "latitude") == 0)
    return FG__ROLE_Y;
  if (text[0] != '\0')
    return FG__NO_ROLE;
  const char *name = coordinate->plain_name;
  if (starts_with(name, "lon") || strcasecmp(name, "nav_lon") == 0 ||
      strcasecmp(name, "xlong") == 0)
    return FG__ROLE_X;
  if (starts_with(name, "lat") || strcasecmp(name, "nav_lat") == 0 ||
      strcasecmp(name, "xlat") == 0)
    return FG__ROLE_Y;
  return FG__NO_ROLE;
}

/* CF: "upward_air_velocity", "upward_sea_water_velocity". */
static bool is_upward_velocity(const fg__variable *v)
{
  char name[FG__TEXT_BYTES];
  fg__attribute_text(v, "standard_name", name, sizeof name);
  return strncmp(name, "upward_", 7) == 0 && strstr(name, "velocity");
}

void fg__classify(fg__variable *variable)
{
  variable->geographic = geographic_role(variable);
  variable->upward = is_upward_velocity(variable);
}

bool fg__may_be_index(const fg__variable *coordinate)
{
  char text[FG__TEXT_BYTES];
  char label[FG__TEXT_BYTES];
  fg__attribute_text(coordinate, "standard_name", text, sizeof text);
  if (strstr(text, "grid_index"))
    return true;
  if (text[0] != '\0' || coordinate->geographic != FG__NO_ROLE)
    return false;
  fg__attribute_text(coordinate, "units", text, sizeof text);
  return fg__units_read(text, label, sizeof label) == FG__QUANTITY_UNKNOWN;
}

/* The dimension of a file with positions may be another of that name. */
static bool lies_along(const fg__dataset *data, const fg__variable *v, int dimension)
{
  return v->rank == 1 && fg__is_number(v) &&
         (v->dimension[0] == dimension ||
          (v->file >= data->component_files &&
           fg__alike_dimension(data, v->dimension[0], dimension)));
}

const fg__variable *fg__coordinate(const fg__dataset *data, const fg__variable *variable,
                                   int k)
{
  const int dimension = variable->dimension[k];
  const fg__variable *otherwise = NULL;
  for (size_t i = 0; i < data->variable_count; ++i) {
    const fg__variable *v = &data->variables[i];
    if (!lies_along(data, v, dimension))
      continue;
    if (strcmp(v->plain_name, data->dimensions[dimension].name) == 0)
      return v;
    if (!otherwise && role_of_attributes(v) != FG__NO_ROLE)
      otherwise = v;
  }
  return otherwise;
}

/* Whether a variable names a coordinate, or xarray lists it for the file. */
static bool is_named(const fg__variable *variable, const fg__variable *coordinate)
{
  char names[FG__TEXT_BYTES];
  const fg__variable *root = fg__file_of(variable);
  const fg__variable *of[] = {variable, root};
  for (int k = 0; k < 2; ++k)
    if (fg__attribute_text(of[k], "coordinates", names, sizeof names) &&
        fg__is_listed(names, coordinate->plain_name))
      return true;
  return false;
}

static bool has_dimension(const fg__variable *v, int dimension)
{
  int k = 0;
  while (k < v->rank && v->dimension[k] != dimension)
    ++k;
  return k < v->rank;
}

/* Whether a variable is one number that lies along no dimension of another. */
static bool is_single(const fg__dataset *data, const fg__variable *v,
                      const fg__variable *variable)
{
  return fg__is_number(v) &&
         (v->rank == 0 ||
          (v->rank == 1 && data->dimensions[v->dimension[0]].length == 1 &&
           !has_dimension(variable, v->dimension[0])));
}

const fg__variable *fg__single_coordinate(const fg__dataset *data,
                                          const fg__variable *variable, fg__role role)
{
  char text[FG__TEXT_BYTES], label[FG__TEXT_BYTES];
  for (size_t i = 0; i < data->variable_count; ++i) {
    const fg__variable *v = &data->variables[i];
    if (v->file != variable->file || !is_single(data, v, variable) ||
        !is_named(variable, v) || role_of_attributes(v) != role)
      continue;
    fg__attribute_text(v, "units", text, sizeof text);
    const bool date = fg__units_read(text, label, sizeof label) == FG__QUANTITY_DATE;
    fg__attribute_text(v, "standard_name", text, sizeof text);
    if (role != FG__ROLE_TIME || (date && strcmp(text, "forecast_reference_time") != 0))
      return v;
  }
  return NULL;
}

typedef struct claim {
  fg__role role;
  int strength; /* 2: by attributes; 1: by name */
} claim;

/* Whether a dimension is one of a swath: longitudes lie along it and another of the
 * variable's, and times only beside them. */
static bool is_of_swath(const fg__dataset *data, const fg__variable *variable, int k,
                        const fg__variable *coordinate)
{
  const int dimension = variable->dimension[k];
  if (strcmp(coordinate->plain_name, data->dimensions[dimension].name) == 0)
    return false;
  for (size_t i = 0; i < data->variable_count; ++i) {
    const fg__variable *v = &data->variables[i];
    if (v->rank == 2 && v->geographic == FG__ROLE_X && has_dimension(v, dimension) &&
        has_dimension(variable, v->dimension[0]) &&
        has_dimension(variable, v->dimension[1]))
      return true;
  }
  return false;
}

static claim claim_of(const fg__dataset *data, const fg__variable *variable, int k)
{
  const fg__variable *coordinate = fg__coordinate(data, variable, k);
  claim c = {FG__NO_ROLE, 2};
  if (coordinate)
    c.role = role_of_attributes(coordinate);
  if (c.role == FG__ROLE_TIME && is_of_swath(data, variable, k, coordinate)) {
    coordinate = NULL;
    c.role = FG__NO_ROLE;
  }
  if (c.role != FG__NO_ROLE)
    return c;
  c.strength = 1;
  c.role = role_of_name(data->dimensions[variable->dimension[k]].name);
  if (c.role == FG__NO_ROLE && coordinate)
    c.role = role_of_name(coordinate->plain_name);
  return c;
}

/* A dimension of which one sample is chosen is neither time nor level any more. */
static claim open_claim_of(const fg__dataset *data, const fg__variable *variable, int k)
{
  claim c = claim_of(data, variable, k);
  if (data->dimensions[variable->dimension[k]].is_chosen &&
      (c.role == FG__ROLE_TIME || c.role == FG__ROLE_LEVEL))
    c.role = FG__NO_ROLE;
  return c;
}

bool fg__is_time(const fg__dataset *data, const fg__variable *variable, int k)
{
  return claim_of(data, variable, k).role == FG__ROLE_TIME;
}

/* Where several dimensions claim a role, x and y go to the last, time and level to the
 * first. */
static void assign_claims(int position[FG__ROLES], const claim *claims, int rank)
{
  for (int role = 0; role < FG__ROLES; ++role) {
    position[role] = -1;
    int strength = 0;
    for (int i = 0; i < rank; ++i) {
      const int k = role <= FG__ROLE_Y ? rank - 1 - i : i;
      if ((int)claims[k].role == role && claims[k].strength > strength) {
        position[role] = k;
        strength = claims[k].strength;
      }
    }
  }
}

static bool is_taken(const int position[FG__ROLES], int k)
{
  for (int role = 0; role < FG__ROLES; ++role)
    if (position[role] == k)
      return true;
  return false;
}

static int last_free(const int position[FG__ROLES], const fg__dataset *data,
                     const fg__variable *v, size_t least)
{
  for (int k = v->rank - 1; k >= 0; --k)
    if (!is_taken(position, k) && data->dimensions[v->dimension[k]].length >= least)
      return k;
  return -1;
}

/* Assigns time and level to remaining dimensions; returns one that can be neither, or
 * -1. */
static int assign_others(int position[FG__ROLES], const fg__dataset *data,
                         const fg__variable *variable)
{
  for (int k = 0; k < variable->rank; ++k) {
    const fg__dimension *d = &data->dimensions[variable->dimension[k]];
    if (is_taken(position, k) || d->is_chosen)
      continue;
    if (position[FG__ROLE_TIME] < 0 && d->unlimited)
      position[FG__ROLE_TIME] = k;
    else if (d->length != 1 && position[FG__ROLE_LEVEL] < 0)
      position[FG__ROLE_LEVEL] = k;
    else if (d->length != 1 && position[FG__ROLE_TIME] < 0)
      position[FG__ROLE_TIME] = k;
    else if (d->length != 1)
      return k;
  }
  return -1;
}

int fg__roles_find(int position[FG__ROLES], const fg__dataset *data,
                   const fg__variable *variable)
{
  claim claims[FG__RANK];
  for (int k = 0; k < variable->rank; ++k)
    claims[k] = open_claim_of(data, variable, k);
  assign_claims(position, claims, variable->rank);
  for (int role = FG__ROLE_X; role <= FG__ROLE_Y; ++role)
    if (position[role] < 0)
      position[role] = last_free(position, data, variable, 2);
  for (int role = FG__ROLE_X; role <= FG__ROLE_Y; ++role)
    if (position[role] < 0)
      position[role] = last_free(position, data, variable, 0);
  return assign_others(position, data, variable);
}

int fg__roles_find_beside(int position[FG__ROLES], const fg__dataset *data,
                          const fg__variable *variable, int along)
{
  claim claims[FG__RANK];
  for (int k = 0; k < variable->rank; ++k) {
    claims[k] = open_claim_of(data, variable, k);
    if (k == along || claims[k].role == FG__ROLE_X || claims[k].role == FG__ROLE_Y)
      claims[k].role = FG__NO_ROLE;
  }
  assign_claims(position, claims, variable->rank);
  position[FG__ROLE_X] = along;
  return assign_others(position, data, variable);
}
