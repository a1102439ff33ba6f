/* The ends of a colour key. */
#include "flowgrain/flowgrain.h"

#include <math.h>

/* Quartiles of fewer values say little. */
enum { FEWEST = 8 };

/* Tukey's outer fence, Exploratory Data Analysis, 1977, section 2D: what lies beyond is
 * "far out". */
static const double FENCE = 3.0;

/* Speeds that differ by less than this share are the same, but for interpolation. */
static const double EQUAL = 1e-4;

/* Bisections until a quartile is known to a share of 1e-9 of the range. */
enum { BISECTIONS = 30 };

/* Below it lies this share of the speeds. */
static double quantile(const fg_icons *icons, double share, double low, double high)
{
  int count = fg_icons_count(icons);
  for (int k = 0; k < BISECTIONS; ++k) {
    double middle = 0.5 * (low + high);
    int below = 0;
    for (int n = 0; n < count; ++n)
      below += fg_icons_at(icons, n)->speed <= middle;
    if (below >= share * count)
      high = middle;
    else
      low = middle;
  }
  return high;
}

static double largest_up_to(const fg_icons *icons, double limit)
{
  double largest = -HUGE_VAL;
  for (int n = 0; n < fg_icons_count(icons); ++n) {
    double speed = fg_icons_at(icons, n)->speed;
    if (speed <= limit)
      largest = fmax(largest, speed);
  }
  return largest;
}

void fg_icons_speed_range(double range[2], const fg_icons *icons)
{
  int count = 0;
  range[0] = range[1] = 0.0;
  for (int n = 0; n < fg_icons_count(icons); ++n) {
    double speed = fg_icons_at(icons, n)->speed;
    if (!isfinite(speed))
      continue;
    range[0] = count ? fmin(range[0], speed) : speed;
    range[1] = count ? fmax(range[1], speed) : speed;
    ++count;
  }
  if (range[1] - range[0] < EQUAL * range[1])
    range[0] = range[1];
  if (count < FEWEST || count < fg_icons_count(icons))
    return;
  double low = quantile(icons, 0.25, range[0], range[1]);
  double high = quantile(icons, 0.75, range[0], range[1]);
  double fence = high + FENCE * (high - low);
  /* most speeds are the same: there is no scale to measure by */
  if (high - low > EQUAL * high && range[1] > fence)
    range[1] = largest_up_to(icons, fence);
}
