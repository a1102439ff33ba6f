#include "base/feature.h"

/* FG__NETCDF and so on are 1 or 0: CMakeLists.txt. */
static const struct about {
  bool present;
  const char *name;
  const char *words;  /* "this build has no ..." */
  const char *option; /* CMake's */
} features[FG_FEATURES] = {
    [FG_FEATURE_NETCDF] = {FG__NETCDF != 0, "netcdf", "NetCDF", "FLOWGRAIN_NETCDF"},
    [FG_FEATURE_VTK] = {FG__VTK != 0, "vtk", "reader of VTK files", "FLOWGRAIN_VTK"},
    [FG_FEATURE_IMAGES] = {FG__IMAGES != 0, "images", "reader of images",
                           "FLOWGRAIN_IMAGES"},
    [FG_FEATURE_PICTURES] = {FG__PICTURES != 0, "pictures", "pictures",
                             "FLOWGRAIN_PICTURES"},
    [FG_FEATURE_RENDER] = {FG__RENDER != 0, "render", "pictures in 3D",
                           "FLOWGRAIN_RENDER"},
    [FG_FEATURE_MAPS] = {FG__MAPS != 0, "maps", "map projections", "FLOWGRAIN_MAPS"},
    [FG_FEATURE_MPI] = {FG__MPI != 0, "mpi", "MPI", "FLOWGRAIN_MPI"},
    [FG_FEATURE_GRIB] = {FG__GRIB != 0, "grib", "reader of GRIB files", "FLOWGRAIN_GRIB"},
    [FG_FEATURE_VIEWER] = {FG__VIEWER != 0, "viewer", "page for browsers",
                           "FLOWGRAIN_VIEWER"},
};

static bool is_feature(fg_feature feature)
{
  return (int)feature >= 0 && (int)feature < FG_FEATURES;
}

bool fg_has_feature(fg_feature feature)
{
  return is_feature(feature) && features[feature].present;
}

const char *fg_feature_name(fg_feature feature)
{
  return is_feature(feature) ? features[feature].name : NULL;
}

fg_status fg_require_feature(fg_context *context, const char *what, fg_feature feature)
{
  if (!what || !is_feature(feature))
    return fg__fail(context, FG_STATUS_ARGUMENT, "no feature %d of %d", (int)feature,
                    (int)FG_FEATURES);
  return fg_has_feature(feature) ? FG_STATUS_OK : fg__fail_absent(context, what, feature);
}

fg_status fg__fail_absent(fg_context *context, const char *what, fg_feature feature)
{
  const struct about *about = &features[feature];
  return fg__fail(context, FG_STATUS_UNSUPPORTED, "%s: this build has no %s (%s=OFF)",
                  what, about->words, about->option);
}
