/* Forty arrows of a field in memory, without a file: writes their points as lines of
 * "arrow x y", tail to head.
 *
 *     cc arrays.c $(pkg-config --cflags --libs flowgrain) -lm -o arrays && ./arrays
 */
#include <flowgrain/flowgrain.h>
#include <math.h>
#include <stdio.h>

enum { WIDE = 81, HIGH = 61 };

static void print(const fg_icons *icons)
{
  for (int n = 0; n < fg_icons_count(icons); ++n) {
    const fg_icon *icon = fg_icons_at(icons, n);
    for (int i = 0; i < icon->point_count; ++i)
      printf("%d %g %g\n", icon->id, icon->points[i][0], icon->points[i][1]);
  }
}

int main(void)
{
  static float u[HIGH][WIDE], v[HIGH][WIDE];
  static double x[WIDE], y[HIGH];
  for (int i = 0; i < WIDE; ++i)
    x[i] = 0.1 * i;
  for (int j = 0; j < HIGH; ++j)
    y[j] = 0.1 * j;
  for (int j = 0; j < HIGH; ++j)
    for (int i = 0; i < WIDE; ++i) {
      u[j][i] = (float)(-cos(x[i]) * sin(y[j]));
      v[j][i] = (float)(sin(x[i]) * cos(y[j]));
    }

  fg_context *context = NULL;
  fg_field *field = NULL;
  fg_icons *icons = NULL;
  fg_status status = fg_context_create(&context);
  if (!status)
    status = fg_field_create(&field, context,
                             &(fg_field_arrays){.dimension = 2,
                                                .size = {WIDE, HIGH},
                                                .axis = {x, y},
                                                .velocity = {u[0], v[0]}});
  if (!status)
    status = fg_arrows_create(&icons, context, field, &(fg_arrows_options){.count = 40});
  if (status)
    fprintf(stderr, "%s: %s\n", fg_status_name(status), fg_context_message(context));
  else
    print(icons);

  fg_icons_destroy(icons);
  fg_field_destroy(field);
  fg_context_destroy(context);
  return status ? 1 : 0;
}
