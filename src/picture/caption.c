#include "picture/caption.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "picture/plain_text.h"
#include "picture/ticks.h"

void fg_picture_round_speeds(double range[2])
{
  /* Speeds that differ by rounding are equal: nothing to tell apart. */
  if (!(range[1] - range[0] > 1e-6 * range[1])) {
    range[0] = 0.0;
    range[1] = range[1] > 0.0 ? range[1] : 1.0;
  }
  fg__tick_axis plain = {.style = FG__TICKS_NUMBER, .factor = 1.0};
  double step = fg__ticks_step(&plain, (range[1] - range[0]) / 6.0);
  range[0] = floor(range[0] / step * (1.0 + 1e-9)) * step;
  range[1] = ceil(range[1] / step * (1.0 - 1e-9)) * step;
}

bool fg__speed_range(double range[2], const fg_icons *icons)
{
  if (range[1] > range[0])
    return true;
  fg_icons_speed_range(range, icons);
  if (fg_icons_count(icons) == 0) {
    range[1] = 1.0;
    return false;
  }
  fg_picture_round_speeds(range);
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

static void append(char out[FG__CAPTION_BYTES], const char *text, size_t length)
{
  const size_t used = strlen(out);
  /* a text that has no room is cut before a whole character */
  if (used + length >= FG__CAPTION_BYTES)
    length = FG__CAPTION_BYTES - 1 - used;
  while (length > 0 && ((unsigned char)text[length] & 0xC0) == 0x80)
    --length;
  memcpy(out + used, text, length);
  out[used + length] = '\0';
}

void fg__caption_fill(char out[FG__CAPTION_BYTES], const char *wanted,
                      const fg__caption_value *values, size_t count)
{
  char clean[FG__CAPTION_BYTES];
  fg__text_clean(clean, sizeof clean, wanted);
  out[0] = '\0';
  for (const char *at = clean; *at;) {
    const size_t plain = strcspn(at, "{");
    append(out, at, plain);
    at += plain;
    size_t k = 0;
    while (*at && k < count && strncmp(at, values[k].name, strlen(values[k].name)) != 0)
      ++k;
    if (*at && k < count) {
      const char *text = values[k].text ? values[k].text : "";
      append(out, text, strlen(text));
      at += strlen(values[k].name);
    } else if (*at) {
      append(out, at++, 1);
    }
  }
}

/* What a field and its icons say of themselves, cleaned. */
typedef struct told_words {
  char title[FG__CAPTION_BYTES], names[FG__CAPTION_BYTES], time[FG__CAPTION_BYTES],
      level[FG__CAPTION_BYTES], arrows[32];
  bool telling; /* the names are more than u and v */
} told_words;

static void collect_words(told_words *out, const fg_field_arrays *field,
                          const fg_icons *icons)
{
  char names[FG__CAPTION_BYTES];
  snprintf(names, sizeof names, "%.100s, %.100s", field->velocity_name[0],
           field->velocity_name[1]);
  out->telling = strcmp(names, "u, v") != 0 &&
                 strcmp(field->velocity_name[0], field->velocity_name[1]) != 0;
  if (out->telling && field->dimension == 3) {
    size_t used = strlen(names);
    snprintf(names + used, sizeof names - used, ", %.100s", field->velocity_name[2]);
  }
  fg__text_clean(out->names, sizeof out->names, names);
  fg__text_clean(out->title, sizeof out->title, field->title);
  fg__text_clean(out->time, sizeof out->time, field->time ? field->time : "");
  fg__text_clean(out->level, sizeof out->level, field->level ? field->level : "");
  snprintf(out->arrows, sizeof out->arrows, "%d", icons ? fg_icons_count(icons) : 0);
}

static void write_subtitle(char subtitle[FG__CAPTION_BYTES], const told_words *told,
                           const fg_icons *icons, double scale_time)
{
  char words[64];
  if (told->title[0] && told->telling)
    add_part(subtitle, told->names);
  add_part(subtitle, told->time);
  add_part(subtitle, told->level);
  if (icons) {
    snprintf(words, sizeof words, "%s arrow%s", told->arrows,
             fg_icons_count(icons) == 1 ? "" : "s");
    add_part(subtitle, words);
    if (fg_icons_kept_score(icons))
      add_part(subtitle, say_error(words, sizeof words, fg_icons_kept_score(icons)));
  }
  if (scale_time > 0.0) {
    snprintf(words, sizeof words, "scale t = %.3g", scale_time);
    add_part(subtitle, words);
  }
}

void fg__caption_write(char title[FG__CAPTION_BYTES], char subtitle[FG__CAPTION_BYTES],
                       const fg_field_arrays *field, const fg_icons *icons,
                       const char *const wanted[2], double scale_time)
{
  told_words told;
  collect_words(&told, field, icons);
  const fg__caption_value values[] = {{"{title}", told.title},
                                      {"{names}", told.names},
                                      {"{time}", told.time},
                                      {"{level}", told.level},
                                      {"{arrows}", told.arrows}};
  const size_t count = sizeof values / sizeof *values;
  title[0] = subtitle[0] = '\0';
  if (wanted[0])
    fg__caption_fill(title, wanted[0], values, count);
  else if (told.title[0] || told.telling)
    snprintf(title, FG__CAPTION_BYTES, "%s", told.title[0] ? told.title : told.names);
  if (wanted[1])
    fg__caption_fill(subtitle, wanted[1], values, count);
  else if (!wanted[0])
    write_subtitle(subtitle, &told, icons, scale_time);
}
