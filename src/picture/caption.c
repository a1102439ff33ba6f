#include "picture/caption.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "picture/plain_text.h"
#include "picture/ticks.h"

bool fg__speed_range(double range[2], const fg_icons *icons)
{
  if (range[1] > range[0])
    return true;
  fg_icons_speed_range(range, icons);
  if (fg_icons_count(icons) == 0) {
    range[1] = 1.0;
    return false;
  }
  /* Speeds that differ by rounding are equal: nothing to tell apart. */
  if (!(range[1] - range[0] > 1e-6 * range[1])) {
    range[0] = 0.0;
    range[1] = range[1] > 0.0 ? range[1] : 1.0;
  }
  fg__tick_axis plain = {.style = FG__TICKS_NUMBER, .factor = 1.0};
  double step = fg__ticks_step(&plain, (range[1] - range[0]) / 6.0);
  range[0] = floor(range[0] / step * (1.0 + 1e-9)) * step;
  range[1] = ceil(range[1] / step * (1.0 - 1e-9)) * step;
  return true;
}

void fg__speeds_beyond(bool beyond[2], const fg_icons *icons, const double range[2])
{
  double rounding = 1e-9 * (range[1] - range[0]);
  beyond[0] = beyond[1] = false;
  for (int n = 0; n < fg_icons_count(icons); ++n) {
    double speed = fg_icons_at(icons, n)->speed;
    beyond[0] = beyond[0] || speed < range[0] - rounding;
    beyond[1] = beyond[1] || speed > range[1] + rounding;
  }
}

/* Adds a part of the subtitle after a middle dot. */
static void add_part(char text[FG__CAPTION_BYTES], const char *part)
{
  char clean[FG__CAPTION_BYTES];
  if (!part || !part[0])
    return;
  fg__text_clean(clean, sizeof clean, part);
  size_t used = strlen(text);
  if (used + strlen(clean) + 5 < FG__CAPTION_BYTES)
    snprintf(text + used, FG__CAPTION_BYTES - used, "%s%s", used ? " \xC2\xB7 " : "",
             clean);
}

/* Whole degrees, below three with a decimal, never less than the error. */
static const char *say_error(char *words, size_t room, const fg_score *score)
{
  double degrees =
      score->mean < 3.0 ? ceil(10.0 * score->mean) / 10.0 : ceil(score->mean);
  snprintf(words, room, "read within %g\xC2\xB0", degrees);
  return words;
}

void fg__caption_write(char title[FG__CAPTION_BYTES], char subtitle[FG__CAPTION_BYTES],
                       const fg_field_arrays *field, const fg_icons *icons,
                       const char *wanted, double scale_time)
{
  title[0] = subtitle[0] = '\0';
  if (wanted) {
    fg__text_clean(title, FG__CAPTION_BYTES, wanted);
    return;
  }
  char names[FG__CAPTION_BYTES];
  snprintf(names, sizeof names, "%.100s, %.100s", field->velocity_name[0],
           field->velocity_name[1]);
  bool telling = strcmp(names, "u, v") != 0 &&
                 strcmp(field->velocity_name[0], field->velocity_name[1]) != 0;
  if (telling && field->dimension == 3) {
    size_t used = strlen(names);
    snprintf(names + used, sizeof names - used, ", %.100s", field->velocity_name[2]);
  }
  fg__text_clean(title, FG__CAPTION_BYTES, field->title);
  if (!title[0] && telling)
    fg__text_clean(title, FG__CAPTION_BYTES, names);
  else if (telling)
    add_part(subtitle, names);
  add_part(subtitle, field->time);
  add_part(subtitle, field->level);
  char words[64];
  if (icons) {
    int arrows = fg_icons_count(icons);
    snprintf(words, sizeof words, "%d arrow%s", arrows, arrows == 1 ? "" : "s");
    add_part(subtitle, words);
    if (fg_icons_kept_score(icons))
      add_part(subtitle, say_error(words, sizeof words, fg_icons_kept_score(icons)));
  }
  if (scale_time > 0.0) {
    snprintf(words, sizeof words, "scale t = %.3g", scale_time);
    add_part(subtitle, words);
  }
}
