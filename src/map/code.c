/* Projections of PROJ's database, by their numbers. */
#include <proj.h>
#include <stdlib.h>
#include <string.h>

#include "map/choose.h"

static bool is_number(const char *text)
{
  return *text && strspn(text, "0123456789") == strlen(text) && strlen(text) <= 7;
}

static fg_status refuse(fg_context *context, const char *code, PJ_TYPE type)
{
  const bool degrees = type == PJ_TYPE_GEOGRAPHIC_2D_CRS ||
                       type == PJ_TYPE_GEOGRAPHIC_3D_CRS || type == PJ_TYPE_GEODETIC_CRS;
  fg_status status = fg__fail(context, FG_STATUS_ARGUMENT,
                              degrees ? "projection \"%.200s\": longitude and latitude, "
                                        "no plane"
                                      : "projection \"%.200s\": PROJ's database has no "
                                        "projected system of that number",
                              code);
  if (degrees)
    fg__hint(context, "--projection none leaves longitude and latitude as they are");
  return status;
}

fg_status fg__map_of_code(fg__map_words *out, fg_context *context, const char *code)
{
  if (!is_number(code + strlen("EPSG:")))
    return fg__fail(context, FG_STATUS_ARGUMENT,
                    "projection \"%.200s\": EPSG: and a number are needed", code);
  PJ_CONTEXT *own = proj_context_create();
  if (!own)
    return fg__fail_memory(context, "a projection", 1);
  proj_log_level(own, PJ_LOG_NONE);
  proj_context_set_enable_network(own, 0);
  PJ *system = proj_create(own, code);
  const PJ_TYPE type = system ? proj_get_type(system) : PJ_TYPE_UNKNOWN;
  const char *string = type == PJ_TYPE_PROJECTED_CRS
                           ? proj_as_proj_string(own, system, PJ_PROJ_4, NULL)
                           : NULL;
  fg_status status =
      string ? fg__map_words_read(out, context, string) : refuse(context, code, type);
  proj_destroy(system);
  proj_context_destroy(own);
  return status;
}
