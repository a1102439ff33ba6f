#include <math.h>
#include <stdlib.h>
#include <string.h>

#include <lcms2.h>

#include "base/context_test.h"
#include "read/image/colors.h"

static void without_a_profile_all_but_inks_stay(void **state)
{
  fg__colors *colors;
  const float from[6] = {0.1F, 0.7F, 0.25F, 0.9F, 0.0F, 1.0F};
  float to[6];
  for (int components = 1; components <= 3; components += 2) {
    assert_int_equal(fg__colors_create(&colors, *state, "made.img", NULL, 0, components),
                     FG_STATUS_OK);
    fg__colors_convert(colors, to, from, 6 / (size_t)components, components);
    assert_memory_equal(to, from, sizeof to);
    fg__colors_destroy(colors);
  }
}

/* Paper is white, black ink alone leaves what it does not cover, and each ink takes its
 * own colour only. */
static void inks_absorb_light(void **state)
{
  fg__colors *colors;
  const float inks[5][4] = {{0.0F, 0.0F, 0.0F, 0.0F},
                            {0.0F, 0.0F, 0.0F, 0.75F},
                            {0.25F, 0.0F, 0.0F, 0.0F},
                            {0.0F, 1.0F, 0.5F, 0.0F},
                            {1.0F, 1.0F, 1.0F, 0.3F}};
  const float seen[5][3] = {{1.0F, 1.0F, 1.0F},
                            {0.25F, 0.25F, 0.25F},
                            {0.75F, 1.0F, 1.0F},
                            {1.0F, 0.0F, 0.5F},
                            {0.0F, 0.0F, 0.0F}};
  float to[5][3];
  assert_int_equal(fg__colors_create(&colors, *state, "made.img", NULL, 0, 4),
                   FG_STATUS_OK);
  fg__colors_convert(colors, to[0], inks[0], 5, 4);
  assert_memory_equal(to, seen, sizeof to);
  fg__colors_destroy(colors);
}

static void damaged_profiles_are_refused(void **state)
{
  fg__colors *colors;
  unsigned char bytes[300];
  memset(bytes, 0x5a, sizeof bytes);
  for (int components = 1; components <= 4; components += components < 3 ? 2 : 1) {
    fg_status status =
        fg__colors_create(&colors, *state, "made.img", bytes, sizeof bytes, components);
    assert_true(status == FG_STATUS_FILE_FORMAT || status == FG_STATUS_UNSUPPORTED);
    assert_null(colors);
    assert_non_null(strstr(fg_context_message(*state), "made.img: "));
    fg_context_clear(*state);
  }
}

enum { MOST_BYTES = 1 << 16 };

/* An RGB profile with that gamma whose green is at (x, y). */
static size_t profile_of(unsigned char bytes[MOST_BYTES], double gamma, double x,
                         double y)
{
  cmsCIExyY white = {0.3127, 0.3290, 1.0};
  cmsCIExyYTRIPLE primaries = {{0.64, 0.33, 1.0}, {x, y, 1.0}, {0.15, 0.06, 1.0}};
  cmsToneCurve *curve = cmsBuildGamma(NULL, gamma);
  cmsToneCurve *curves[3] = {curve, curve, curve};
  cmsHPROFILE profile = cmsCreateRGBProfile(&white, &primaries, curves);
  cmsUInt32Number size = 0;
  assert_true(cmsSaveProfileToMem(profile, NULL, &size) && size <= MOST_BYTES);
  assert_true(cmsSaveProfileToMem(profile, bytes, &size));
  cmsCloseProfile(profile);
  cmsFreeToneCurve(curve);
  return size;
}

static void convert(fg_context *context, float *to, const float *from, size_t count,
                    int components, const unsigned char *profile, size_t size)
{
  fg__colors *colors;
  assert_int_equal(
      fg__colors_create(&colors, context, "made.img", profile, size, components),
      FG_STATUS_OK);
  fg__colors_convert(colors, to, from, count, components);
  fg__colors_destroy(colors);
}

/* The value on a screen of light of that share (IEC 61966-2-1). */
static double screen_value(double light)
{
  return light <= 0.0031308 ? 12.92 * light : 1.055 * pow(light, 1.0 / 2.4) - 0.055;
}

enum { COUNT = 700 }; /* no multiple of what is converted at a time */

static void a_profile_with_another_gamma_bends_greys(void **state)
{
  static unsigned char bytes[MOST_BYTES];
  static float from[3 * COUNT], to[3 * COUNT], grey[COUNT];
  size_t size = profile_of(bytes, 1.0, 0.3, 0.6); /* sRGB's own colours, linear */
  for (int n = 0; n < COUNT; ++n)
    from[3 * n] = from[3 * n + 1] = from[3 * n + 2] = grey[n] = (float)n / (COUNT - 1.0F);
  convert(*state, to, from, COUNT, 3, bytes, size);
  for (int n = 0; n < 3 * COUNT; ++n)
    assert_true(fabs((double)to[n] - screen_value((double)from[n])) < 0.004);
  convert(*state, to, grey, COUNT, 1, bytes, size);
  for (int n = 0; n < COUNT; ++n)
    assert_true(fabs((double)to[n] - screen_value((double)grey[n])) < 0.004);
}

/* Adobe RGB's green is beyond what a screen shows; what both show becomes more colourful.
 */
static void a_wider_profile_makes_colours_stronger(void **state)
{
  static unsigned char bytes[MOST_BYTES];
  size_t size = profile_of(bytes, 2.2, 0.21, 0.71);
  const float from[9] = {0.0F, 1.0F, 0.0F, 0.4F, 0.6F, 0.4F, 0.5F, 0.5F, 0.5F};
  float to[9];
  convert(*state, to, from, 3, 3, bytes, size);
  assert_true(to[0] == 0.0F && to[1] > 0.99F); /* clipped */
  assert_true(to[3] < 0.35F && fabs((double)to[4] - 0.6) < 0.02);
  assert_true(fabs((double)to[6] - (double)to[7]) < 0.002);
}

/* Whatever a part of a profile is taken for. */
static void short_profiles_do_no_harm(void **state)
{
  static unsigned char bytes[MOST_BYTES];
  size_t size = profile_of(bytes, 2.2, 0.21, 0.71);
  for (size_t length = 0; length + 4 < size; ++length) {
    fg__colors *colors;
    unsigned char *part = malloc(length + 1);
    assert_non_null(part);
    memcpy(part, bytes, length);
    fg__colors_create(&colors, *state, "made.img", part, length, 3);
    fg__colors_destroy(colors);
    free(part);
    fg_context_clear(*state);
  }
  fg__colors *colors;
  assert_int_equal(fg__colors_create(&colors, *state, "made.img", bytes, size, 4),
                   FG_STATUS_FILE_FORMAT);
  assert_non_null(strstr(fg_context_message(*state), "4 components"));
}

int main(void)
{
#define CASE(name)                                                                       \
  cmocka_unit_test_setup_teardown(name, context_set_up, context_tear_down)
  const struct CMUnitTest tests[] = {
      CASE(without_a_profile_all_but_inks_stay),
      CASE(inks_absorb_light),
      CASE(damaged_profiles_are_refused),
      CASE(a_profile_with_another_gamma_bends_greys),
      CASE(a_wider_profile_makes_colours_stronger),
      CASE(short_profiles_do_no_harm),
  };
  return cmocka_run_group_tests_name("read/image/colors", tests, NULL, NULL);
}
