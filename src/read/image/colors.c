#include "read/image/colors.h"

#include <stdlib.h>
#include <string.h>

#include <lcms2.h>

#include "base/memory.h"

/* Pixels that are converted at a time. */
enum { RUN = 256, MOST_COMPONENTS = 4 };

struct fg__colors {
  cmsContext library;
  cmsHTRANSFORM transform; /* NULL: inks without a profile */
  bool grey_as_rgb;        /* grey pixels with a profile of red, green and blue */
};

static fg_status open_transform(fg__colors *colors, fg_context *context, const char *path,
                                const void *bytes, size_t size, int components)
{
  colors->library = cmsCreateContext(NULL, NULL);
  if (!colors->library)
    return fg__fail_memory(context, "colours", 0);
  cmsHPROFILE screen = cmsCreate_sRGBProfileTHR(colors->library);
  cmsHPROFILE profile =
      size <= UINT32_MAX
          ? cmsOpenProfileFromMemTHR(colors->library, bytes, (cmsUInt32Number)size)
          : NULL;
  fg_status status = FG_STATUS_OK;
  cmsUInt32Number from = 0;
  if (!profile) {
    status = fg__fail(context, FG_STATUS_FILE_FORMAT,
                      "%s: the colour profile in it is damaged", path);
  } else {
    cmsColorSpaceSignature space = cmsGetColorSpace(profile);
    colors->grey_as_rgb = components == 1 && space == cmsSigRgbData;
    if (components == 1 && space == cmsSigGrayData)
      from = TYPE_GRAY_FLT;
    else if (components <= 3 && space == cmsSigRgbData)
      from = TYPE_RGB_FLT;
    else if (components == 4 && space == cmsSigCmykData)
      from = TYPE_CMYK_FLT;
    else
      status = fg__fail(context, FG_STATUS_FILE_FORMAT,
                        "%s: the colour profile in it is not for pixels of %d components",
                        path, components);
  }
  if (from) {
    colors->transform =
        cmsCreateTransformTHR(colors->library, profile, from, screen, TYPE_RGB_FLT,
                              INTENT_PERCEPTUAL, cmsFLAGS_NOCACHE);
    if (!colors->transform)
      status = fg__fail(context, FG_STATUS_FILE_FORMAT,
                        "%s: the colour profile in it can not be used", path);
  }
  if (profile)
    cmsCloseProfile(profile);
  if (screen)
    cmsCloseProfile(screen);
  return status;
}

static void close_transform(fg__colors *colors)
{
  if (colors->transform)
    cmsDeleteTransform(colors->transform);
  if (colors->library)
    cmsDeleteContext(colors->library);
}

static void transform_run(const fg__colors *colors, float *to, const float *from,
                          size_t count)
{
  cmsDoTransform(colors->transform, from, to, (cmsUInt32Number)count);
}

fg_status fg__colors_create(fg__colors **out, fg_context *context, const char *path,
                            const void *profile, size_t size, int components)
{
  *out = NULL;
  if (!profile && components <= 3)
    return FG_STATUS_OK;
  fg__colors *colors = fg__allocate(1, sizeof *colors);
  if (!colors)
    return fg__fail_memory(context, "colours", sizeof *colors);
  fg_status status = FG_STATUS_OK;
  if (profile)
    status = open_transform(colors, context, path, profile, size, components);
  if (status || (!colors->transform && components <= 3)) {
    fg__colors_destroy(colors);
    return status;
  }
  *out = colors;
  return FG_STATUS_OK;
}

void fg__colors_destroy(fg__colors *colors)
{
  if (!colors)
    return;
  close_transform(colors);
  free(colors);
}

/* Each ink takes its colour from what black leaves. */
static void absorb(float *to, const float *inks, size_t count)
{
  for (size_t n = 0; n < count; ++n)
    for (size_t k = 0; k < 3; ++k)
      to[3 * n + k] = (1.0F - inks[4 * n + k]) * (1.0F - inks[4 * n + 3]);
}

/* A pixel's components as the profile takes them: inks in per cent. */
static void prepare(const fg__colors *colors, float *run, const float *from, size_t count,
                    int components)
{
  size_t values = count * (size_t)components;
  if (colors->grey_as_rgb)
    for (size_t n = 0; n < count; ++n)
      run[3 * n] = run[3 * n + 1] = run[3 * n + 2] = from[n];
  else
    for (size_t n = 0; n < values; ++n)
      run[n] = components == 4 ? 100.0F * from[n] : from[n];
}

static void convert_run(const fg__colors *colors, float *to, const float *from,
                        size_t count, int components)
{
  float run[MOST_COMPONENTS * RUN], screen[3 * RUN];
  prepare(colors, run, from, count, components);
  transform_run(colors, screen, run, count);
  size_t channels = components == 1 ? 1 : 3;
  for (size_t n = 0; n < count; ++n)
    for (size_t k = 0; k < channels; ++k) {
      /* green stands for grey; colours that screens lack are clipped */
      float value = screen[3 * n + (channels == 1 ? 1 : k)];
      to[channels * n + k] = value > 0.0F ? value < 1.0F ? value : 1.0F : 0.0F;
    }
}

void fg__colors_convert(const fg__colors *colors, float *to, const float *from,
                        size_t count, int components)
{
  if (!colors) {
    memcpy(to, from, count * (size_t)components * sizeof *to);
    return;
  }
  if (!colors->transform) {
    absorb(to, from, count);
    return;
  }
  size_t channels = components == 1 ? 1 : 3;
  for (size_t n = 0; n < count; n += RUN)
    convert_run(colors, to + n * channels, from + n * (size_t)components,
                count - n < RUN ? count - n : RUN, components);
}
