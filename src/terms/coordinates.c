#include "terms/coordinates.h"

#include "terms/text.h"
#include "terms/units.h"

#include <string.h>

typedef struct role_row {
  fg__role role;
  const char *words;
} role_row;

#define COUNT_OF(array) (sizeof(array) / sizeof *(array))

static const role_row STANDARD_NAMES[] = {
    {FG__ROLE_X, "longitude|grid_longitude|projection_x_coordinate|"
                 "projection_x_angular_coordinate|x_grid_index"},
    {FG__ROLE_Y, "latitude|grid_latitude|projection_y_coordinate|"
                 "projection_y_angular_coordinate|y_grid_index"},
    {FG__ROLE_TIME, "time|forecast_period|forecast_reference_time"},
    {FG__ROLE_LEVEL, "depth|height|altitude|geopotential_height|air_pressure|"
                     "sea_water_pressure|model_level_number"},
};

/* Names of dimensions and coordinates. */
static const role_row NAMES[] = {
    {FG__ROLE_X, "x|nx|i|ni|nlon|easting|xc|rlon"},
    {FG__ROLE_Y, "y|ny|j|nj|nlat|northing|yc|rlat"},
    {FG__ROLE_TIME, "t|date|month|record|step"},
    {FG__ROLE_LEVEL, "z|nz|k|alt|s_rho"},
};

/* And how others begin. */
static const role_row BEGINNINGS[] = {
    {FG__ROLE_X, "lon|xi_|west_east|xt_|xu_|x_"},
    {FG__ROLE_Y, "lat|eta_|south_north|yt_|yu_|y_"},
    {FG__ROLE_LEVEL, "lev|lv_|depth|height|plev|press|isobar|sigma|hybrid|bottom_top|"
                     "layer|altitude"},
};

#define Z_NAMES                                                                          \
  "z|zc|z_coordinate|z_coord|z_position|z_pos|zpos|pos_z|position_z|points_2|"           \
  "coordinates_2|altitude|z_0"

/* Plain names of columns. */
static const char *const COLUMNS[] = {
    [FG__COLUMN_X] = "x|xc|x_coordinate|x_coord|x_position|x_pos|xpos|pos_x|position_x|"
                     "points_0|coordinates_0|easting|x_0",
    [FG__COLUMN_Y] = "y|yc|y_coordinate|y_coord|y_position|y_pos|ypos|pos_y|position_y|"
                     "points_1|coordinates_1|northing|y_0",
    [FG__COLUMN_Z] = Z_NAMES,
    [FG__COLUMN_LONGITUDE] = "lon|long|longitude|lng|nav_lon|xlong|glon|lon_deg|"
                             "longitude_deg|lon_e|degrees_east|lon_dd|lond",
    [FG__COLUMN_LATITUDE] = "lat|latitude|nav_lat|xlat|glat|lat_deg|latitude_deg|lat_n|"
                            "degrees_north|lat_dd|latd",
    [FG__COLUMN_LEVEL] = Z_NAMES "|height|depth|level|lev|plane",
    [FG__COLUMN_TIME] = "time|t|time_s|timestep|time_step|step|snapshot|date|datetime|"
                        "date_time|timestamp|time_utc|date_utc|valid_time",
    [FG__COLUMN_VALIDITY] = "chc|vector_type|isvalid|is_valid|flags",
};

/* Names that a place has where no other column has it. */
static const char *const POSSIBLE[] = {
    [FG__COLUMN_X] = "px|xx", [FG__COLUMN_Y] = "py|yy", [FG__COLUMN_Z] = "pz|zz"};

/* A place on a grid is called after what it is, perhaps behind the grid and before the
 * point or a number: "x_rho", "xu", "grid_xt", "nav_lon_u", "ULAT", "lon_0", "glamt". */
static const char *const STEMS[] = {[FG__COLUMN_X] = "x|easting",
                                    [FG__COLUMN_Y] = "y|northing",
                                    [FG__COLUMN_Z] = "z",
                                    [FG__COLUMN_LONGITUDE] = "longitude|long|lon|glam",
                                    [FG__COLUMN_LATITUDE] = "latitude|lat|gphi"};
static const char GRIDS[] = "grid_", GLOBES[] = "nav_|geo|t|u|v|p|q|c|e|g|x";
static const char POINTS[] =
    "rho|psi|t|u|v|w|c|f|d|h|l|r|q|p|m|g|s|cc|fc|cell|cells|face|faces|node|nodes|center|"
    "centers|centre|centres|corner|corners|edge|edges|vertex|vertices|point|points|grid|"
    "stag|mid|vor";

static fg__role find_role(const role_row *rows, size_t count, const char *word)
{
  for (size_t i = 0; i < count; ++i)
    if (fg__is_one_of(rows[i].words, word, strlen(word)))
      return rows[i].role;
  return FG__NO_ROLE;
}

static const char *or_empty(const char *text)
{
  return text ? text : "";
}

/* "x_mm" for axis 0: a letter with a unit. */
static bool is_place_with_unit(const char *plain, fg__column_use use)
{
  return use <= FG__COLUMN_Z && plain[0] == "xyz"[use] && plain[1] == '_' &&
         fg__is_unit_in_name(plain + 2);
}

/* Whether the rest of a name is a point of a grid or a number, or nothing. */
static bool is_point(const char *rest)
{
  rest += *rest == '_';
  return !rest[strspn(rest, "0123456789")] || fg__is_one_of(POINTS, rest, strlen(rest));
}

/* Whether a name is one of the words of a list, and a point behind. */
static bool is_at_point(const char *plain, const char *stems)
{
  for (size_t n; *stems; stems += n + (stems[n] == '|')) {
    n = strcspn(stems, "|");
    if (strncmp(plain, stems, n) == 0 && is_point(plain + n))
      return true;
  }
  return false;
}

static bool is_place_on_grid(const char *plain, fg__column_use use)
{
  if (use > FG__COLUMN_LATITUDE)
    return false;
  const char *before = use >= FG__COLUMN_LONGITUDE ? GLOBES : GRIDS;
  bool found = is_at_point(plain, STEMS[use]);
  for (size_t n; *before && !found; before += n + (before[n] == '|')) {
    n = strcspn(before, "|");
    found = strncmp(plain, before, n) == 0 && is_at_point(plain + n, STEMS[use]);
  }
  return found;
}

int fg__column_fits(const char *name, fg__column_use use)
{
  char plain[64];
  fg__plain_name(plain, sizeof plain, name);
  if (fg__is_one_of(COLUMNS[use], plain, strlen(plain)))
    return 2;
  return is_place_with_unit(plain, use) || is_place_on_grid(plain, use) ||
         (use <= FG__COLUMN_Z && fg__is_one_of(POSSIBLE[use], plain, strlen(plain)));
}

fg__role fg__place_of_name(int *fits, const char *name)
{
  static const fg__role roles[] = {FG__ROLE_X, FG__ROLE_Y, FG__ROLE_LEVEL, FG__ROLE_X,
                                   FG__ROLE_Y};
  fg__role role = FG__NO_ROLE;
  *fits = 0;
  for (int use = FG__COLUMN_LATITUDE; use >= FG__COLUMN_X; --use) {
    const int here = fg__column_fits(name, (fg__column_use)use);
    if (here > *fits) {
      *fits = here;
      role = roles[use];
    }
  }
  return role;
}

static fg__role role_of_standard_name(const char *name)
{
  return fg__contains_any(name, "sigma|ocean_s_coordinate|hybrid")
             ? FG__ROLE_LEVEL
             : find_role(STANDARD_NAMES, COUNT_OF(STANDARD_NAMES), name);
}

static fg__role role_of_units(const char *units)
{
  fg__unit unit;
  fg__unit_read(&unit, units);
  switch (unit.quantity) {
  case FG__QUANTITY_DEGREES_EAST:
    return FG__ROLE_X;
  case FG__QUANTITY_DEGREES_NORTH:
    return FG__ROLE_Y;
  case FG__QUANTITY_DATE:
    return FG__ROLE_TIME;
  case FG__QUANTITY_PRESSURE:
    return FG__ROLE_LEVEL;
  default:
    return FG__NO_ROLE;
  }
}

fg__role fg__role_of_attributes(const fg__term *term, const char *axis, bool has_positive)
{
  static const role_row axes[] = {
      {FG__ROLE_X, "x"}, {FG__ROLE_Y, "y"}, {FG__ROLE_TIME, "t"}, {FG__ROLE_LEVEL, "z"}};
  fg__role role = find_role(axes, COUNT_OF(axes), axis);
  if (role == FG__NO_ROLE)
    role = role_of_standard_name(or_empty(term->standard_name));
  if (role == FG__NO_ROLE)
    role = role_of_units(or_empty(term->units));
  return role == FG__NO_ROLE && has_positive ? FG__ROLE_LEVEL : role;
}

fg__role fg__role_of_name(const char *name)
{
  char plain[64];
  int fits;
  fg__role role = find_role(NAMES, COUNT_OF(NAMES), name);
  fg__plain_name(plain, sizeof plain, name);
  char *point = strrchr(plain, '_');
  if (role == FG__NO_ROLE && point && is_point(point)) {
    *point = '\0'; /* "ni_u", "j_g" */
    role = find_role(NAMES, COUNT_OF(NAMES), plain);
  }
  if (role == FG__NO_ROLE)
    role = fg__place_of_name(&fits, name);
  if (role != FG__NO_ROLE)
    return role;
  if (fg__find_text(name, "time"))
    return FG__ROLE_TIME;
  for (size_t i = 0; i < COUNT_OF(BEGINNINGS); ++i)
    if (fg__starts_with_one_of(BEGINNINGS[i].words, name, strlen(name)))
      return BEGINNINGS[i].role;
  return FG__NO_ROLE;
}

fg__role fg__geographic_role(const fg__term *term)
{
  static const role_row standard[] = {{FG__ROLE_X, "longitude"},
                                      {FG__ROLE_Y, "latitude"}};
  const char *units = or_empty(term->units), *name = or_empty(term->standard_name),
             *plain = fg__last_part(term->name);
  fg__unit unit;
  fg__unit_read(&unit, units);
  if (unit.quantity == FG__QUANTITY_DEGREES_EAST ||
      unit.quantity == FG__QUANTITY_DEGREES_NORTH)
    return unit.quantity == FG__QUANTITY_DEGREES_EAST ? FG__ROLE_X : FG__ROLE_Y;
  const bool radians = unit.quantity == FG__QUANTITY_RADIANS;
  if (units[0] && unit.quantity != FG__QUANTITY_DEGREES && !radians)
    return FG__NO_ROLE;
  if (name[0])
    return find_role(standard, COUNT_OF(standard), name);
  for (int k = 0; k < 2; ++k)
    if (fg__starts_with(plain, k == 0 ? "lon" : "lat") ||
        (radians && fg__find_text(plain, k == 0 ? "lon" : "lat")) ||
        fg__column_fits(plain, k == 0 ? FG__COLUMN_LONGITUDE : FG__COLUMN_LATITUDE))
      return k == 0 ? FG__ROLE_X : FG__ROLE_Y;
  return FG__NO_ROLE;
}

bool fg__term_may_be_index(const fg__term *term)
{
  const char *standard = or_empty(term->standard_name);
  fg__unit unit;
  if (strstr(standard, "grid_index"))
    return true;
  if (standard[0] || fg__geographic_role(term) != FG__NO_ROLE)
    return false;
  fg__unit_read(&unit, or_empty(term->units));
  return unit.quantity == FG__QUANTITY_UNKNOWN || unit.quantity == FG__QUANTITY_TIME ||
         unit.quantity == FG__QUANTITY_RADIANS;
}

bool fg__names_coordinate(const char *name)
{
  char plain[64];
  fg__plain_name(plain, sizeof plain, name);
  for (int use = FG__COLUMN_X; use <= FG__COLUMN_LATITUDE; ++use)
    if (fg__column_fits(name, (fg__column_use)use) == 2 ||
        is_place_with_unit(plain, (fg__column_use)use) ||
        is_place_on_grid(plain, (fg__column_use)use))
      return true;
  return false;
}
