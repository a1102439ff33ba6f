#include "folder/scale_files.h"

#include <stdio.h>

#include "build_features.h"
#include "option/table.h"

bool scales_are_solid(const fg_field *field)
{
  return fg_field_contents(field)->dimension == 3;
}

bool scales_have_density(const run_settings *settings, const fg_field *field)
{
  return settings->save_field || scales_are_solid(field);
}

static int add_end(char ends[SCALE_FILES][SCALE_END_BYTES], int count, const char *end)
{
  snprintf(ends[count], SCALE_END_BYTES, ".%s", end);
  return count + 1;
}

int scale_file_ends(char ends[SCALE_FILES][SCALE_END_BYTES], const run_settings *settings,
                    const fg_field *field)
{
  int count = add_end(ends, 0, "geojson");
  bool solid = scales_are_solid(field);
  unsigned formats = formats_to_draw(settings->formats, solid);
  for (int kind = 0; kind < FORMAT_KINDS; ++kind)
    if (formats & (1U << kind)) {
      count = add_end(ends, count, format_words[kind]);
      for (int view = 1; view < settings->picture.view_count && solid; ++view)
        snprintf(ends[count++], SCALE_END_BYTES, "-%d.%s", view + 1, format_words[kind]);
    }
  if (solid) {
    count = add_end(ends, count, "vtp");
    count = add_end(ends, count, "glb");
  }
  if (scales_have_density(settings, field))
    count = add_end(ends, count, "vti");
  return count;
}
