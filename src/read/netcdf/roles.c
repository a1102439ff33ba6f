/* Which dimension is x, y, time and level: by the coordinates' attributes (CF
 * conventions, chapter 4), then by their names, then by their order. */
#include "read/netcdf/netcdf.h"

#include <ctype.h>
#include <string.h>
#include <strings.h>

typedef struct word_role {
  const char *word;
  fg__nc_role role;
} word_role;

static fg__nc_role find_role(const word_role *table, size_t count, const char *word)
{
  for (size_t i = 0; i < count; ++i)
    if (strcasecmp(table[i].word, word) == 0)
      return table[i].role;
  return FG__NC_NO_ROLE;
}

static fg__nc_role role_of_standard_name(const char *name)
{
  static const word_role known[] = {
      {"longitude", FG__NC_X},
      {"grid_longitude", FG__NC_X},
      {"projection_x_coordinate", FG__NC_X},
      {"projection_x_angular_coordinate", FG__NC_X},
      {"x_grid_index", FG__NC_X},
      {"latitude", FG__NC_Y},
      {"grid_latitude", FG__NC_Y},
      {"projection_y_coordinate", FG__NC_Y},
      {"projection_y_angular_coordinate", FG__NC_Y},
      {"y_grid_index", FG__NC_Y},
      {"time", FG__NC_TIME},
      {"forecast_period", FG__NC_TIME},
      {"forecast_reference_time", FG__NC_TIME},
      {"depth", FG__NC_LEVEL},
      {"height", FG__NC_LEVEL},
      {"altitude", FG__NC_LEVEL},
      {"geopotential_height", FG__NC_LEVEL},
      {"air_pressure", FG__NC_LEVEL},
      {"sea_water_pressure", FG__NC_LEVEL},
      {"model_level_number", FG__NC_LEVEL},
  };
  if (strstr(name, "sigma") || strstr(name, "ocean_s_coordinate") ||
      strstr(name, "hybrid"))
    return FG__NC_LEVEL;
  return find_role(known, sizeof known / sizeof *known, name);
}

static fg__nc_role role_of_attributes(const fg__nc_variable *coordinate)
{
  static const word_role axis[] = {
      {"X", FG__NC_X}, {"Y", FG__NC_Y}, {"T", FG__NC_TIME}, {"Z", FG__NC_LEVEL}};
  char text[FG__NC_TEXT];
  char label[FG__NC_TEXT];
  fg__nc_text(coordinate, "axis", text, sizeof text);
  fg__nc_role role = find_role(axis, sizeof axis / sizeof *axis, text);
  if (role == FG__NC_NO_ROLE &&
      fg__nc_text(coordinate, "standard_name", text, sizeof text))
    role = role_of_standard_name(text);
  if (role != FG__NC_NO_ROLE)
    return role;
  fg__nc_text(coordinate, "units", text, sizeof text);
  switch (fg__nc_units(text, label, sizeof label)) {
  case FG__NC_DEGREES_EAST:
    return FG__NC_X;
  case FG__NC_DEGREES_NORTH:
    return FG__NC_Y;
  case FG__NC_DATE:
    return FG__NC_TIME;
  case FG__NC_PRESSURE:
    return FG__NC_LEVEL;
  default:
    break;
  }
  if (fg__nc_text(coordinate, "positive", text, sizeof text))
    return FG__NC_LEVEL;
  return FG__NC_NO_ROLE;
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
static fg__nc_role role_of_name(const char *name)
{
  static const word_role whole[] = {
      {"x", FG__NC_X},        {"nx", FG__NC_X},       {"i", FG__NC_X},
      {"ni", FG__NC_X},       {"nlon", FG__NC_X},     {"easting", FG__NC_X},
      {"xc", FG__NC_X},       {"y", FG__NC_Y},        {"ny", FG__NC_Y},
      {"j", FG__NC_Y},        {"nj", FG__NC_Y},       {"nlat", FG__NC_Y},
      {"northing", FG__NC_Y}, {"yc", FG__NC_Y},       {"t", FG__NC_TIME},
      {"date", FG__NC_TIME},  {"month", FG__NC_TIME}, {"record", FG__NC_TIME},
      {"step", FG__NC_TIME},  {"z", FG__NC_LEVEL},    {"nz", FG__NC_LEVEL},
      {"k", FG__NC_LEVEL},    {"alt", FG__NC_LEVEL},  {"s_rho", FG__NC_LEVEL},
      {"rlon", FG__NC_X},     {"rlat", FG__NC_Y},
  };
  static const char *const x[] = {"lon", "xi_", "west_east", "xt_", "xu_", "x_"};
  static const char *const y[] = {"lat", "eta_", "south_north", "yt_", "yu_", "y_"};
  static const char *const level[] = {"lev",    "lv_",        "depth",  "height",
                                      "plev",   "press",      "isobar", "sigma",
                                      "hybrid", "bottom_top", "layer",  "altitude"};
  const fg__nc_role role = find_role(whole, sizeof whole / sizeof *whole, name);
  if (role != FG__NC_NO_ROLE)
    return role;
  for (const char *c = name; *c; ++c)
    if (starts_with(c, "time"))
      return FG__NC_TIME;
  if (starts_with_any(name, x, sizeof x / sizeof *x))
    return FG__NC_X;
  if (starts_with_any(name, y, sizeof y / sizeof *y))
    return FG__NC_Y;
  if (starts_with_any(name, level, sizeof level / sizeof *level))
    return FG__NC_LEVEL;
  return FG__NC_NO_ROLE;
}

static fg__nc_role geographic_role(const fg__nc_variable *coordinate)
{
  char text[FG__NC_TEXT];
  char label[FG__NC_TEXT];
  fg__nc_text(coordinate, "units", text, sizeof text);
  const bool has_units = text[0] != '\0';
  const fg__nc_quantity quantity = fg__nc_units(text, label, sizeof label);
  if (quantity == FG__NC_DEGREES_EAST)
    return FG__NC_X;
  if (quantity == FG__NC_DEGREES_NORTH)
    return FG__NC_Y;
  if (has_units && quantity != FG__NC_DEGREES)
    return FG__NC_NO_ROLE;
  fg__nc_text(coordinate, "standard_name", text, sizeof text);
  if (strcmp(text, "longitude") == 0)
    return FG__NC_X;
  if (strcmp(text, "latitude") == 0)
    return FG__NC_Y;
  if (text[0] != '\0')
    return FG__NC_NO_ROLE;
  const char *name = coordinate->plain_name;
  if (starts_with(name, "lon") || strcasecmp(name, "nav_lon") == 0 ||
      strcasecmp(name, "xlong") == 0)
    return FG__NC_X;
  if (starts_with(name, "lat") || strcasecmp(name, "nav_lat") == 0 ||
      strcasecmp(name, "xlat") == 0)
    return FG__NC_Y;
  return FG__NC_NO_ROLE;
}

/* CF: "upward_air_velocity", "upward_sea_water_velocity". */
static bool is_upward_velocity(const fg__nc_variable *v)
{
  char name[FG__NC_TEXT];
  fg__nc_text(v, "standard_name", name, sizeof name);
  return strncmp(name, "upward_", 7) == 0 && strstr(name, "velocity");
}

void fg__nc_classify(fg__nc_variable *variable)
{
  variable->geographic = geographic_role(variable);
  variable->upward = is_upward_velocity(variable);
}

bool fg__nc_counts(const fg__nc_variable *coordinate)
{
  char text[FG__NC_TEXT];
  char label[FG__NC_TEXT];
  fg__nc_text(coordinate, "standard_name", text, sizeof text);
  if (strstr(text, "grid_index"))
    return true;
  if (text[0] != '\0' || coordinate->geographic != FG__NC_NO_ROLE)
    return false;
  fg__nc_text(coordinate, "units", text, sizeof text);
  return fg__nc_units(text, label, sizeof label) == FG__NC_UNKNOWN;
}

/* The dimension of a file with positions may be another of that name. */
static bool lies_along(const fg__nc_file *file, const fg__nc_variable *v, int dimension)
{
  return v->rank == 1 && v->type >= NC_BYTE && v->type <= NC_UINT64 &&
         v->type != NC_CHAR &&
         (v->dimension[0] == dimension ||
          (v->file >= file->component_files &&
           fg__nc_alike_dimension(file, v->dimension[0], dimension)));
}

const fg__nc_variable *fg__nc_coordinate(const fg__nc_file *file,
                                         const fg__nc_variable *variable, int k)
{
  const int dimension = variable->dimension[k];
  const fg__nc_variable *otherwise = NULL;
  for (size_t i = 0; i < file->variable_count; ++i) {
    const fg__nc_variable *v = &file->variables[i];
    if (!lies_along(file, v, dimension))
      continue;
    if (strcmp(v->plain_name, file->dimensions[dimension].name) == 0)
      return v;
    if (!otherwise && role_of_attributes(v) != FG__NC_NO_ROLE)
      otherwise = v;
  }
  return otherwise;
}

/* Whether a variable names a coordinate, or xarray lists it for the file. */
static bool is_named(const fg__nc_file *file, const fg__nc_variable *variable,
                     const fg__nc_variable *coordinate)
{
  char names[FG__NC_TEXT];
  const fg__nc_variable root = {
      .owner = variable->owner, .group = file->roots[variable->file], .id = NC_GLOBAL};
  const fg__nc_variable *of[] = {variable, &root};
  for (int k = 0; k < 2; ++k)
    if (fg__nc_text(of[k], "coordinates", names, sizeof names) &&
        fg__nc_is_listed(names, coordinate->plain_name))
      return true;
  return false;
}

static bool has_dimension(const fg__nc_variable *v, int dimension)
{
  int k = 0;
  while (k < v->rank && v->dimension[k] != dimension)
    ++k;
  return k < v->rank;
}

/* Whether a variable is one number that lies along no dimension of another. */
static bool is_single(const fg__nc_file *file, const fg__nc_variable *v,
                      const fg__nc_variable *variable)
{
  return v->type >= NC_BYTE && v->type <= NC_UINT64 && v->type != NC_CHAR &&
         (v->rank == 0 ||
          (v->rank == 1 && file->dimensions[v->dimension[0]].length == 1 &&
           !has_dimension(variable, v->dimension[0])));
}

const fg__nc_variable *fg__nc_single_coordinate(const fg__nc_file *file,
                                                const fg__nc_variable *variable,
                                                fg__nc_role role)
{
  char text[FG__NC_TEXT], label[FG__NC_TEXT];
  for (size_t i = 0; i < file->variable_count; ++i) {
    const fg__nc_variable *v = &file->variables[i];
    if (v->file != variable->file || !is_single(file, v, variable) ||
        !is_named(file, variable, v) || role_of_attributes(v) != role)
      continue;
    fg__nc_text(v, "units", text, sizeof text);
    const bool date = fg__nc_units(text, label, sizeof label) == FG__NC_DATE;
    fg__nc_text(v, "standard_name", text, sizeof text);
    if (role != FG__NC_TIME || (date && strcmp(text, "forecast_reference_time") != 0))
      return v;
  }
  return NULL;
}

typedef struct claim {
  fg__nc_role role;
  int strength; /* 2: by attributes; 1: by name */
} claim;

/* Whether a dimension is one of a swath: longitudes lie along it and another of the
 * variable's, and times only beside them. */
static bool is_of_swath(const fg__nc_file *file, const fg__nc_variable *variable, int k,
                        const fg__nc_variable *coordinate)
{
  const int dimension = variable->dimension[k];
  if (strcmp(coordinate->plain_name, file->dimensions[dimension].name) == 0)
    return false;
  for (size_t i = 0; i < file->variable_count; ++i) {
    const fg__nc_variable *v = &file->variables[i];
    if (v->rank == 2 && v->geographic == FG__NC_X && has_dimension(v, dimension) &&
        has_dimension(variable, v->dimension[0]) &&
        has_dimension(variable, v->dimension[1]))
      return true;
  }
  return false;
}

static claim claim_of(const fg__nc_file *file, const fg__nc_variable *variable, int k)
{
  const fg__nc_variable *coordinate = fg__nc_coordinate(file, variable, k);
  claim c = {FG__NC_NO_ROLE, 2};
  if (coordinate)
    c.role = role_of_attributes(coordinate);
  if (c.role == FG__NC_TIME && is_of_swath(file, variable, k, coordinate)) {
    coordinate = NULL;
    c.role = FG__NC_NO_ROLE;
  }
  if (c.role != FG__NC_NO_ROLE)
    return c;
  c.strength = 1;
  c.role = role_of_name(file->dimensions[variable->dimension[k]].name);
  if (c.role == FG__NC_NO_ROLE && coordinate)
    c.role = role_of_name(coordinate->plain_name);
  return c;
}

/* A dimension of which one sample is chosen is neither time nor level any more. */
static claim open_claim_of(const fg__nc_file *file, const fg__nc_variable *variable,
                           int k)
{
  claim c = claim_of(file, variable, k);
  if (file->dimensions[variable->dimension[k]].is_chosen &&
      (c.role == FG__NC_TIME || c.role == FG__NC_LEVEL))
    c.role = FG__NC_NO_ROLE;
  return c;
}

bool fg__nc_is_time(const fg__nc_file *file, const fg__nc_variable *variable, int k)
{
  return claim_of(file, variable, k).role == FG__NC_TIME;
}

/* Where several dimensions claim a role, x and y go to the last, time and level to the
 * first. */
static void assign_claims(int position[FG__NC_ROLES], const claim *claims, int rank)
{
  for (int role = 0; role < FG__NC_ROLES; ++role) {
    position[role] = -1;
    int strength = 0;
    for (int i = 0; i < rank; ++i) {
      const int k = role <= FG__NC_Y ? rank - 1 - i : i;
      if ((int)claims[k].role == role && claims[k].strength > strength) {
        position[role] = k;
        strength = claims[k].strength;
      }
    }
  }
}

static bool is_taken(const int position[FG__NC_ROLES], int k)
{
  for (int role = 0; role < FG__NC_ROLES; ++role)
    if (position[role] == k)
      return true;
  return false;
}

static int last_free(const int position[FG__NC_ROLES], const fg__nc_file *file,
                     const fg__nc_variable *v, size_t least)
{
  for (int k = v->rank - 1; k >= 0; --k)
    if (!is_taken(position, k) && file->dimensions[v->dimension[k]].length >= least)
      return k;
  return -1;
}

/* Assigns time and level to remaining dimensions; returns one that can be neither, or
 * -1. */
static int assign_others(int position[FG__NC_ROLES], const fg__nc_file *file,
                         const fg__nc_variable *variable)
{
  for (int k = 0; k < variable->rank; ++k) {
    const fg__nc_dimension *d = &file->dimensions[variable->dimension[k]];
    if (is_taken(position, k) || d->is_chosen)
      continue;
    if (position[FG__NC_TIME] < 0 && d->unlimited)
      position[FG__NC_TIME] = k;
    else if (d->length != 1 && position[FG__NC_LEVEL] < 0)
      position[FG__NC_LEVEL] = k;
    else if (d->length != 1 && position[FG__NC_TIME] < 0)
      position[FG__NC_TIME] = k;
    else if (d->length != 1)
      return k;
  }
  return -1;
}

int fg__nc_roles(int position[FG__NC_ROLES], const fg__nc_file *file,
                 const fg__nc_variable *variable)
{
  claim claims[FG__NC_RANK];
  for (int k = 0; k < variable->rank; ++k)
    claims[k] = open_claim_of(file, variable, k);
  assign_claims(position, claims, variable->rank);
  for (int role = FG__NC_X; role <= FG__NC_Y; ++role)
    if (position[role] < 0)
      position[role] = last_free(position, file, variable, 2);
  for (int role = FG__NC_X; role <= FG__NC_Y; ++role)
    if (position[role] < 0)
      position[role] = last_free(position, file, variable, 0);
  return assign_others(position, file, variable);
}

int fg__nc_roles_beside(int position[FG__NC_ROLES], const fg__nc_file *file,
                        const fg__nc_variable *variable, int along)
{
  claim claims[FG__NC_RANK];
  for (int k = 0; k < variable->rank; ++k) {
    claims[k] = open_claim_of(file, variable, k);
    if (k == along || claims[k].role == FG__NC_X || claims[k].role == FG__NC_Y)
      claims[k].role = FG__NC_NO_ROLE;
  }
  assign_claims(position, claims, variable->rank);
  position[FG__NC_X] = along;
  return assign_others(position, file, variable);
}
