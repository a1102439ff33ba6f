#include "build_features.h"
#include "inputs.h"

#include <stdio.h>

static void print_features(const char *title, bool present)
{
  const char *between = title;
  for (int k = 0; k < FG_FEATURES; ++k)
    if (fg_has_feature((fg_feature)k) == present) {
      printf("%s%s", between, fg_feature_name((fg_feature)k));
      between = ", ";
    }
  if (between != title)
    putchar('\n');
}

void print_version(void)
{
  printf("flowgrain %s\n", fg_version());
  print_features("with ", true);
  print_features("without ", false);
}

int require_feature(const char *what, fg_feature feature)
{
  fg_context *context;
  int code = create_context(&context);
  if (code)
    return code;
  fg_status status = fg_require_feature(context, what, feature);
  code = status ? complain_of(context, status, what) : EXIT_DONE;
  fg_context_destroy(context);
  return code;
}

static fg_feature feature_of(bool solid)
{
  return solid ? FG_FEATURE_RENDER : FG_FEATURE_PICTURES;
}

unsigned formats_to_draw(unsigned requested, bool solid)
{
  if (!fg_has_feature(feature_of(solid)))
    return 0;
  if (requested)
    return requested;
  return solid ? FORMAT_PNG : FORMAT_SVG | FORMAT_PNG;
}

int refuse_undrawable(unsigned requested, bool background, bool solid)
{
  if (requested)
    return require_feature("--formats", feature_of(solid));
  if (background)
    return require_feature("--background", feature_of(solid));
  return EXIT_DONE;
}
