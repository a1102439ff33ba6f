#include "picture/caption.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "picture/plain_text.h"

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
  return fg__speed_range_common(range, &(fg_panel){.icons = icons}, 1);
}

bool fg__speed_range_common(double range[2], const fg_panel *panel, int count)
{
  double ends[2] = {HUGE_VAL, -HUGE_VAL};
  if (range[1] > range[0])
    return true;
  for (int k = 0; k < count; ++k) {
    double own[2];
    if (fg_icons_count(panel[k].icons) == 0)
      continue;
    fg_icons_speed_range(own, panel[k].icons);
    ends[0] = fmin(ends[0], own[0]);
    ends[1] = fmax(ends[1], own[1]);
  }
  const bool some = ends[0] <= ends[1];
  range[0] = some ? ends[0] : 0.0;
  range[1] = some ? ends[1] : 1.0;
  if (some)
    fg_picture_round_speeds(range);
  return some;
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

/* Appends a part to a text, after a middle dot where it is not the first. */
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

/* Where the mean weighted by speed is less than this share of the mean by area, most of
 * the domain hardly moves (an artery in a box of noise: a fifth; open flows: a half or
 * more). */
static const double STILL_SHARE = 1.0 / 3.0;

/* Whole degrees, below three with a decimal, never less than the error. */
static double round_up(double degrees)
{
  return degrees < 3.0 ? ceil(10.0 * degrees) / 10.0 : ceil(degrees);
}

static const char *format_error(char *words, size_t room, const fg_score *score)
{
  double weighted = (score->diffusion.speed_weighted + score->nearest.speed_weighted +
                     score->inverse_distance.speed_weighted) /
                    3.0;
  int used =
      snprintf(words, room, "mean direction error %g\xC2\xB0", round_up(score->mean));
  if (weighted > 0.0 && weighted < STILL_SHARE * score->mean)
    snprintf(words + used, room - (size_t)used, ", weighted by speed %g\xC2\xB0",
             round_up(weighted));
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

/* Bytes of the separator at the beginning of a text: spaces, commas, a middle dot (C2
 * B7), dashes (E2 80 93, 94). */
static size_t separator(const char *text)
{
  size_t length = 0;
  for (;;) {
    const char *at = text + length;
    if (*at && strchr(" ,;:|/-", *at))
      ++length;
    else if (strncmp(at, "\xC2\xB7", 2) == 0)
      length += 2;
    else if (strncmp(at, "\xE2\x80\x93", 3) == 0 || strncmp(at, "\xE2\x80\x94", 3) == 0)
      length += 3;
    else
      return length;
  }
}

/* For a name without a value: removes the separator before it, or at the beginning of the
 * text the one after it, and brackets round it. Returns where the template goes on. */
static const char *leave_out(char out[FG__CAPTION_BYTES], const char *at)
{
  size_t used = strlen(out);
  if (used > 0 && out[used - 1] == '(' && *at == ')') {
    out[--used] = '\0';
    ++at;
  }
  for (size_t n = 0; n < used; ++n)
    if (((unsigned char)out[n] & 0xC0) != 0x80 && n + separator(out + n) == used)
      out[used = n] = '\0';
  return used == 0 ? at + separator(at) : at;
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
      at += strlen(values[k].name);
      append(out, text, strlen(text));
      if (!*text)
        at = leave_out(out, at);
    } else if (*at) {
      append(out, at++, 1);
    }
  }
}

/* A given label is kept with the offset or factor that the ticks' numbers leave out. */
void fg__caption_label_speeds(fg__tick_axis *speed, const char *wanted, const char *units)
{
  char label[FG__CAPTION_BYTES];
  if (!wanted)
    return;
  if (speed->offset != 0.0) {
    fg__text_clean(label, sizeof label, wanted);
    fg__axis_of_numbers(speed, speed->low, speed->high, speed->high - speed->low, label,
                        units);
    return;
  }
  const fg__caption_value known = {"{units}", speed->units};
  snprintf(label, sizeof label, "%.250s%s", wanted,
           *wanted && speed->factor != 1.0 && !strstr(wanted, known.name) ? " ({units})"
                                                                          : "");
  fg__caption_fill(speed->label, label, &known, 1);
  speed->units[0] = '\0';
}

/* The texts of a caption, from a field and its icons, cleaned; "" where they have none.
 */
typedef struct caption_texts {
  char title[FG__CAPTION_BYTES], names[FG__CAPTION_BYTES], time[FG__CAPTION_BYTES],
      level[FG__CAPTION_BYTES], scale[32], arrows[32];
  bool has_names; /* other than u, v, and one name for all */
} caption_texts;

/* Length of the name that a vector variable has where its components are called after it,
 * U_x and U_y; 0 for others. */
static size_t vector_name(const fg_field_arrays *field)
{
  const size_t whole = strlen(field->velocity_name[0]),
               length = whole < 2 ? 0 : whole - 2;
  for (int k = 0; k < field->dimension; ++k) {
    const char *name = field->velocity_name[k];
    if (strlen(name) != length + 2 || name[length] != '_' ||
        name[length + 1] != "xyz"[k] ||
        strncmp(name, field->velocity_name[0], length) != 0)
      return 0;
  }
  return length;
}

/* A number below zero has the minus sign that ticks have. */
static void write_minus(char text[FG__CAPTION_BYTES])
{
  static const char minus[] = "\xE2\x88\x92";
  char *at = strstr(text, " -");
  if (!at || !strchr("0123456789.", at[2]) || !at[2] ||
      strlen(text) + sizeof minus > FG__CAPTION_BYTES)
    return;
  memmove(at + sizeof minus, at + 2, strlen(at + 2) + 1);
  memcpy(at + 1, minus, sizeof minus - 1);
}

static void collect_texts(caption_texts *out, const fg__caption_panel *panel)
{
  const fg_field_arrays *field = panel->field;
  char names[FG__CAPTION_BYTES];
  snprintf(names, sizeof names, "%.100s, %.100s", field->velocity_name[0],
           field->velocity_name[1]);
  out->has_names = strcmp(names, "u, v") != 0 &&
                   strcmp(field->velocity_name[0], field->velocity_name[1]) != 0;
  if (out->has_names && field->dimension == 3) {
    size_t used = strlen(names);
    snprintf(names + used, sizeof names - used, ", %.100s", field->velocity_name[2]);
  }
  const size_t of_vector = vector_name(field);
  if (of_vector > 0)
    snprintf(names, sizeof names, "%.*s", (int)of_vector, field->velocity_name[0]);
  fg__text_clean(out->names, sizeof out->names, names);
  fg__text_clean(out->title, sizeof out->title, field->title);
  fg__text_clean(out->time, sizeof out->time, field->time ? field->time : "");
  fg__text_clean(out->level, sizeof out->level, field->level ? field->level : "");
  write_minus(out->level);
  out->scale[0] = '\0';
  if (panel->scale_time > 0.0)
    snprintf(out->scale, sizeof out->scale, "scale t = %.3g", panel->scale_time);
  snprintf(out->arrows, sizeof out->arrows, "%d",
           panel->icons ? fg_icons_count(panel->icons) : 0);
}

/* Length of a date in ISO 8601 form: 10 bytes to its day, 16 to the minute, 19 to the
 * second; 0: the text is none. */
static size_t date_length(const char *text)
{
  static const char form[] = "0000-00-00 00:00:00";
  size_t length = strlen(text);
  if (length != 10 && length != 16 && length != 19)
    return 0;
  for (size_t n = 0; n < length; ++n)
    if (form[n] == '0' ? text[n] < '0' || text[n] > '9' : text[n] != form[n])
      return 0;
  return length;
}

/* Extends a date to the precision of the most precise one among the panels. */
static void complete_date(caption_texts *out, const fg__caption_panel *panel, int count)
{
  static const char midnight[] = " 00:00:00";
  const size_t own = date_length(out->time);
  size_t longest = own;
  for (int n = 0; n < count && own; ++n) {
    const char *time = panel[n].field->time;
    const size_t length = date_length(time ? time : "");
    longest = length > longest ? length : longest;
  }
  if (longest > own)
    snprintf(out->time + own, sizeof out->time - own, "%.*s", (int)(longest - own),
             midnight + own - 10);
}

enum { TEXTS = 6 };

static char *text_at(caption_texts *texts, int k)
{
  char *const words[TEXTS] = {texts->title, texts->names, texts->time,
                              texts->level, texts->scale, texts->arrows};
  return words[k];
}

/* Keeps of a time what another has, too: the day of dates, or what stands in brackets at
 * the end, as in "16 May (climatology)". */
static void keep_shared_time(char time[FG__CAPTION_BYTES], const char *other)
{
  const char *end = strrchr(time, '('), *others = strrchr(other, '(');
  if (strcmp(time, other) == 0)
    return;
  if (date_length(time) && date_length(other) && strncmp(time, other, 10) == 0)
    time[10] = '\0';
  else if (end && others && strcmp(end, others) == 0)
    memmove(time, end, strlen(end) + 1);
  else
    time[0] = '\0';
}

/* Takes what all panels share out of one's time, and brackets round it. */
static void leave_out_shared_time(char time[FG__CAPTION_BYTES], const char *shared)
{
  char *at = *shared && strcmp(time, shared) != 0 ? strstr(time, shared) : NULL;
  if (at == time) {
    at += strlen(shared);
    at += strspn(at, " ");
    memmove(time, at, strlen(at) + 1);
  } else if (at) {
    at[-1] = '\0';
    while (--at > time && at[-1] == ' ')
      at[-1] = '\0';
  }
}

/* The texts that all panels have in common, "" for others. */
static void collect_common(caption_texts *out, const fg__caption_panel *panel, int count)
{
  caption_texts other;
  collect_texts(out, &panel[0]);
  for (int n = 1; n < count; ++n) {
    collect_texts(&other, &panel[n]);
    keep_shared_time(out->time, other.time);
    if (out->time[0])
      snprintf(other.time, sizeof other.time, "%s", out->time);
    for (int k = 0; k < TEXTS; ++k)
      if (strcmp(text_at(out, k), text_at(&other, k)) != 0)
        text_at(out, k)[0] = '\0';
  }
  const size_t length = strlen(out->time);
  if (out->time[0] == '(' && out->time[length - 1] == ')') {
    memmove(out->time, out->time + 1, length - 2);
    out->time[length - 2] = '\0';
  }
}

/* "40 arrows", "40 arrows each"; "" where the number is not known. */
static const char *format_arrows(char *words, size_t room, const caption_texts *texts,
                                 bool of_several)
{
  snprintf(words, room, "%s arrow%s%s", texts->arrows,
           strcmp(texts->arrows, "1") == 0 ? "" : "s", of_several ? " each" : "");
  return texts->arrows[0] ? words : "";
}

static void write_subtitle(char subtitle[FG__CAPTION_BYTES], const caption_texts *texts,
                           const fg__caption_panel *panel, int count)
{
  char words[64];
  const fg_icons *icons = panel[0].icons;
  add_part(subtitle, texts->time);
  add_part(subtitle, texts->level);
  if (icons)
    add_part(subtitle, format_arrows(words, sizeof words, texts, count > 1));
  if (icons && count == 1 && fg_icons_kept_score(icons))
    add_part(subtitle, format_error(words, sizeof words, fg_icons_kept_score(icons)));
  add_part(subtitle, texts->scale);
}

enum { CAPTION_NAMES = 5 };

static void list_values(fg__caption_value out[CAPTION_NAMES], const caption_texts *texts)
{
  const fg__caption_value values[CAPTION_NAMES] = {{"{title}", texts->title},
                                                   {"{names}", texts->names},
                                                   {"{time}", texts->time},
                                                   {"{level}", texts->level},
                                                   {"{arrows}", texts->arrows}};
  memcpy(out, values, sizeof values);
}

/* A name in words begins as a sentence does: "wind at 10 m"; "ua_850" and "rhoU" are no
 * words, and the names of analytic fields are the program's. */
static void begin_sentence(char *title)
{
  const size_t letters = strspn(title, "abcdefghijklmnopqrstuvwxyz");
  if (letters > 1 && strchr(" -", title[letters]) && !strstr(title, "(analytic)"))
    title[0] = (char)(title[0] - 'a' + 'A');
}

void fg__caption_write_common(char title[FG__CAPTION_BYTES],
                              char subtitle[FG__CAPTION_BYTES],
                              const fg__caption_panel *panel, int count,
                              const char *const wanted[2])
{
  caption_texts own;
  fg__caption_value values[CAPTION_NAMES];
  collect_common(&own, panel, count);
  list_values(values, &own);
  title[0] = subtitle[0] = '\0';
  if (wanted[0])
    fg__caption_fill(title, wanted[0], values, CAPTION_NAMES);
  else if (own.title[0]) {
    snprintf(title, FG__CAPTION_BYTES, "%s", own.title);
    begin_sentence(title);
  } else if (own.has_names)
    snprintf(title, FG__CAPTION_BYTES, "%s", own.names);
  if (wanted[1])
    fg__caption_fill(subtitle, wanted[1], values, CAPTION_NAMES);
  else if (!wanted[0])
    write_subtitle(subtitle, &own, panel, count);
}

void fg__caption_write(char title[FG__CAPTION_BYTES], char subtitle[FG__CAPTION_BYTES],
                       const fg_field_arrays *field, const fg_icons *icons,
                       const char *const wanted[2], double scale_time)
{
  const fg__caption_panel alone = {field, icons, scale_time};
  fg__caption_write_common(title, subtitle, &alone, 1, wanted);
}

/* a to z, then aa, ab, ... */
static void write_letter(char out[4], int k)
{
  if (k < 26)
    snprintf(out, 4, "%c", 'a' + k);
  else
    snprintf(out, 4, "%c%c", 'a' + (k / 26 - 1) % 26, 'a' + k % 26);
}

void fg__caption_write_label(char label[FG__CAPTION_BYTES],
                             const fg__caption_panel *panel, int count, int k,
                             const char *wanted)
{
  caption_texts own, common;
  fg__caption_value values[CAPTION_NAMES + 1];
  char letter[4], words[64], rest[FG__CAPTION_BYTES] = "";
  collect_texts(&own, &panel[k]);
  complete_date(&own, panel, count);
  list_values(values, &own);
  write_letter(letter, k);
  values[CAPTION_NAMES] = (fg__caption_value){"{letter}", letter};
  if (wanted) {
    fg__caption_fill(label, wanted, values, CAPTION_NAMES + 1);
    return;
  }
  collect_common(&common, panel, count);
  leave_out_shared_time(own.time, common.time);
  for (int n = 0; n < TEXTS; ++n)
    if (strcmp(text_at(&own, n), text_at(&common, n)) != 0)
      add_part(rest, text_at(&own, n) == own.arrows
                         ? format_arrows(words, sizeof words, &own, false)
                         : text_at(&own, n));
  snprintf(label, FG__CAPTION_BYTES, "(%s)%s%.300s", letter, *rest ? " " : "", rest);
}
