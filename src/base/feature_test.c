#include <string.h>

#include "base/context_test.h"
#include "base/feature.h"

static void features_have_names_of_their_own(void **state)
{
  (void)state;
  for (int k = 0; k < FG_FEATURES; ++k) {
    assert_non_null(fg_feature_name((fg_feature)k));
    for (int i = 0; i < k; ++i)
      assert_string_not_equal(fg_feature_name((fg_feature)i),
                              fg_feature_name((fg_feature)k));
  }
  assert_null(fg_feature_name(FG_FEATURES));
  assert_false(fg_has_feature(FG_FEATURES));
}

/* Fields in 3D are drawn on pages. */
static void rendering_needs_pictures(void **state)
{
  (void)state;
  assert_true(fg_has_feature(FG_FEATURE_PICTURES) || !fg_has_feature(FG_FEATURE_RENDER));
}

static void what_is_absent_is_named(void **state)
{
  (void)state;
  fg_context *context;
  assert_int_equal(fg_context_create(&context), FG_STATUS_OK);
  assert_int_equal(fg__fail_absent(context, "wind.nc", FG_FEATURE_NETCDF),
                   FG_STATUS_UNSUPPORTED);
  assert_string_equal(fg_context_message(context),
                      "wind.nc: this build has no NetCDF (FLOWGRAIN_NETCDF=OFF)");
  for (int k = 0; k < FG_FEATURES; ++k) {
    fg_feature feature = (fg_feature)k;
    fg_context_clear(context);
    assert_int_equal(fg_require_feature(context, "a file", feature) == FG_STATUS_OK,
                     fg_has_feature(feature));
  }
  fg_context_clear(context);
  assert_int_equal(fg_require_feature(context, "a file", FG_FEATURES),
                   FG_STATUS_ARGUMENT);
  fg_context_destroy(context);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(features_have_names_of_their_own),
      cmocka_unit_test(rendering_needs_pictures),
      cmocka_unit_test(what_is_absent_is_named),
  };
  return cmocka_run_group_tests_name("base/feature", tests, NULL, NULL);
}
