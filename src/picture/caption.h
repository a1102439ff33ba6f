/* What a picture says of itself: its caption, and the ends of its colour key. */
#ifndef FG__CAPTION_H
#define FG__CAPTION_H

#include "flowgrain/flowgrain.h"
#include "picture/ticks.h"

/* Sets the ends of the colour key to fg_icons_speed_range, rounded out to ticks, unless
 * range already says some, ascending. False: there are no icons. */
bool fg__speed_range(double range[2], const fg_icons *icons);

/* The same of the icons of several panels together. */
bool fg__speed_range_common(double range[2], const fg_panel *panel, int count);

/* Whether some icons are slower, or faster, than the ends of the colour key. */
void fg__speeds_beyond(bool beyond[2], const fg_icons *icons, const double range[2]);

/* The caption: `wanted`, the title and the line below it, where they are not NULL, else
 * what the field says of itself; under a wanted title nothing. icons NULL, scale_time 0:
 * not told. Icons that keep a score tell it. */
enum { FG__CAPTION_BYTES = 320 };
void fg__caption_write(char title[FG__CAPTION_BYTES], char subtitle[FG__CAPTION_BYTES],
                       const fg_field_arrays *field, const fg_icons *icons,
                       const char *const wanted[2], double scale_time);

/* What tells one panel of a figure. */
typedef struct fg__caption_panel {
  const fg_field_arrays *field;
  const fg_icons *icons; /* NULL: not told */
  double scale_time;     /* 0: not told */
} fg__caption_panel;

/* The same of several: what stands for a name, and the line below the title, tell what
 * all panels have in common. */
void fg__caption_write_common(char title[FG__CAPTION_BYTES],
                              char subtitle[FG__CAPTION_BYTES],
                              const fg__caption_panel *panel, int count,
                              const char *const wanted[2]);

/* The label of panel k of several: `wanted`, in which {letter} stands for a, b, ..., else
 * its letter in brackets and what tells it from the others. */
void fg__caption_write_label(char label[FG__CAPTION_BYTES],
                             const fg__caption_panel *panel, int count, int k,
                             const char *wanted);

/* A name in braces, and what stands for it. */
typedef struct fg__caption_value {
  const char *name; /* "{time}" */
  const char *text; /* clean; NULL: "" */
} fg__caption_value;

/* Labels the axis of a colour key as is wanted, {units} being its units; NULL: it stays.
 */
void fg__caption_label_speeds(fg__tick_axis *speed, const char *wanted,
                              const char *units);

/* Fills in the values of the names in a template, cleaned and cut to the room. Where a
 * value is not there, its separator is left out, too: "Wind, {time}" becomes "Wind". */
void fg__caption_fill(char out[FG__CAPTION_BYTES], const char *wanted,
                      const fg__caption_value *values, size_t count);

#endif
