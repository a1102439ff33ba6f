/* Icons' lines as the page has them. */
#include "base/context.h"
#include "base/memory.h"
#include "write/view/parts.h"

#include <math.h>
#include <stdlib.h>

enum { PLACE_STEPS = 65535 };

int32_t fg__view_step(double share, int steps)
{
  return (int32_t)floor(steps * fmin(fmax(share, 0.0), 1.0) + 0.5);
}

/* The box round all points, of no side without length, the unit box without points;
 * returns how many there are. */
static size_t measure(double low[3], double high[3], const fg_icons *icons)
{
  size_t count = 0;
  for (int k = 0; k < 3; ++k) {
    low[k] = HUGE_VAL;
    high[k] = -HUGE_VAL;
  }
  for (int n = 0; n < fg_icons_count(icons); ++n) {
    const fg_icon *icon = fg_icons_at(icons, n);
    count += (size_t)icon->point_count;
    for (int i = 0; i < icon->point_count; ++i)
      for (int k = 0; k < 3; ++k) {
        low[k] = fmin(low[k], icon->points[i][k]);
        high[k] = fmax(high[k], icon->points[i][k]);
      }
  }
  for (int k = 0; k < 3; ++k) {
    low[k] = count > 0 ? low[k] : 0.0;
    if (!(high[k] > low[k]))
      high[k] = low[k] + 1.0;
  }
  return count;
}

static bool write_axis(FILE *stream, int32_t *steps, const fg_icons *icons, int k,
                       double low, double high)
{
  static const char axis[] = "xyz";
  size_t count = 0;
  for (int n = 0; n < fg_icons_count(icons); ++n) {
    const fg_icon *icon = fg_icons_at(icons, n);
    for (int i = 0; i < icon->point_count; ++i)
      steps[count++] =
          fg__view_step((icon->points[i][k] - low) / (high - low), PLACE_STEPS);
  }
  fprintf(stream, ",\"%c\":", axis[k]);
  return fg__view_packed(stream, steps, count);
}

static void write_corner(FILE *stream, const char *name, const double corner[3],
                         int dimension)
{
  fprintf(stream, "\"%s\":[", name);
  for (int k = 0; k < dimension; ++k)
    fprintf(stream, "%s%.9g", k ? "," : "", corner[k]);
  putc(']', stream);
}

fg_status fg__view_paths(FILE *stream, fg_context *context, const fg_icons *icons,
                         int dimension)
{
  double low[3] = {0.0}, high[3] = {0.0};
  const size_t count = measure(low, high, icons);
  int32_t *steps = fg__allocate(count + 1, sizeof *steps);
  bool done = steps != NULL;
  write_corner(stream, "low", low, dimension);
  putc(',', stream);
  write_corner(stream, "high", high, dimension);
  for (int k = 0; k < dimension && done; ++k)
    done = write_axis(stream, steps, icons, k, low[k], high[k]);
  free(steps);
  return done ? FG_STATUS_OK
              : fg__fail_memory(context, "a page's arrows", count * sizeof *steps);
}
