/* CF's words for titles of ecCodes' tables, and for types of levels. */
#include "decode/grib/grib.h"

#include <string.h>
#include <strings.h>

static const char *const TITLES[][2] = {
    {"U component of wind", "eastward_wind"},
    {"U-component of wind", "eastward_wind"},
    {"U wind component", "eastward_wind"},
    {"V component of wind", "northward_wind"},
    {"V-component of wind", "northward_wind"},
    {"V wind component", "northward_wind"},
    {"U-component of current", "eastward_sea_water_velocity"},
    {"V-component of current", "northward_sea_water_velocity"},
    {"wind speed", "wind_speed"},
    {"wind direction", "wind_from_direction"},
    {"Significant height of combined wind waves and swell",
     "sea_surface_wave_significant_height"},
    {"Mean wave direction", "sea_surface_wave_from_direction"},
    {"Significant height of wind waves", "sea_surface_wind_wave_significant_height"},
    {"Mean direction of wind waves", "sea_surface_wind_wave_from_direction"},
    {"Significant height of total swell", "sea_surface_swell_wave_significant_height"},
    {"Mean direction of total swell", "sea_surface_swell_wave_from_direction"},
};

/* "10 metre U wind component" is of a wind as any other. */
static const char *without_height(const char *title)
{
  static const char metre[] = " metre ";
  const size_t digits = strspn(title, "0123456789");
  return digits > 0 && strncmp(title + digits, metre, sizeof metre - 1) == 0
             ? title + digits + sizeof metre - 1
             : title;
}

const char *fg__grib_standard_name(const char *title)
{
  title = without_height(title);
  size_t length = strlen(title);
  while (length > 0 && title[length - 1] == ' ')
    --length;
  for (size_t i = 0; i < sizeof TITLES / sizeof *TITLES; ++i)
    if (strlen(TITLES[i][0]) == length && strncasecmp(title, TITLES[i][0], length) == 0)
      return TITLES[i][1];
  return "";
}

const fg__grib_levels *fg__grib_levels_of(const char *type)
{
  static const fg__grib_levels known[] = {
      {"isobaricInhPa", "hPa", "air_pressure", "down"},
      {"isobaricInPa", "Pa", "air_pressure", "down"},
      {"heightAboveGround", "m", "height", "up"},
      {"heightAboveSea", "m", "altitude", "up"},
      {"depthBelowSea", "m", "depth", "down"},
      {"depthBelowLand", "m", "depth", "down"},
      {"theta", "K", "air_potential_temperature", "up"},
      {"hybrid", "1", "model_level_number", "down"},
  };
  for (size_t i = 0; i < sizeof known / sizeof *known; ++i)
    if (strcmp(type, known[i].type) == 0)
      return &known[i];
  return NULL;
}
