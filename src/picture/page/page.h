/* A page: where the frame, the ticks, the keys and the caption lie, found from measured
 * texts before anything is drawn. */
#ifndef FG__PAGE_H
#define FG__PAGE_H

#include "flowgrain/critical.h"
#include "picture/caption.h"
#include "picture/page/text.h"
#include "picture/ticks.h"

/* Points of 1/72 inch from the page's upper left corner, y downwards. */
typedef struct fg__page_box {
  double x0, y0, x1, y1;
} fg__page_box;

enum {
  FG__TITLE_LINES = 3,
  FG__CAPTION_LINES = FG__TITLE_LINES + 3,
  FG__LABEL_LINES = 3, /* of the colour key */
  FG__PAGE_TEXT_BYTES = FG__CAPTION_BYTES,
  /* ticks of two axes and of the colour key, their labels, the caption, the size key */
  FG__SYMBOL_KINDS = 6, /* of critical points */
  FG__PAGE_TEXTS =
      3 * FG__TICK_LIMIT + FG__CAPTION_LINES + FG__LABEL_LINES + 8 + FG__SYMBOL_KINDS,
  FG__PAGE_LINES = 3 * FG__TICK_LIMIT
};

typedef enum fg__align { FG__ALIGN_START, FG__ALIGN_MIDDLE, FG__ALIGN_END } fg__align;

typedef struct fg__page_text {
  char text[FG__PAGE_TEXT_BYTES];
  double size;
  bool bold, quiet;
  bool halo;       /* stands over other things: has a white rim */
  bool upwards;    /* reads from below to above */
  fg__align align; /* what of it keeps its place in another font */
  double x, y;     /* where its baseline begins */
  fg__page_box box;
} fg__page_text;

typedef struct fg__page_line {
  double x0, y0, x1, y1;
} fg__page_line;

/* The sign of a critical point; y downwards, but the sense is as it is seen. */
typedef struct fg__symbol {
  fg_critical_kind kind;
  int sense, outward;
  double axis[2][2];
  double x, y, radius; /* points */
} fg__symbol;

typedef struct fg__page {
  double width, height;
  double font_size;
  fg__page_box frame;
  double scale; /* points a coordinate unit */
  bool framed;
  bool has_degrees; /* or the numbers of axes, as far as its panel writes them */
  fg__page_text text[FG__PAGE_TEXTS];
  int text_count;
  fg__page_line line[FG__PAGE_LINES];
  int line_count;
  bool has_color_key, color_key_upright;
  fg__page_box color_key;
  double color_key_point[2]; /* length of the points at its ends, for speeds beyond */
  bool has_size_key;
  double size_key[2];                  /* where its arrow's tail is */
  double size_key_length;              /* points */
  fg__symbol symbol[FG__SYMBOL_KINDS]; /* of the key */
  int symbol_count;
} fg__page;

/* What is laid out on a page. */
typedef struct fg__page_plan {
  double width;     /* points; 0: 480 at most, less for a tall domain */
  double height;    /* points; 0: follows */
  double font_size; /* points; 0: follows from the page's size */
  bool no_frame;    /* the domain's box, nothing else */
  fg__tick_axis axis[2];
  char title[FG__PAGE_TEXT_BYTES];    /* "" none */
  char subtitle[FG__PAGE_TEXT_BYTES]; /* "" none */
  bool color_key;
  fg__tick_axis speed;   /* with the ends of the colour key */
  bool speeds_beyond[2]; /* some arrows are slower or faster than these ends */
  bool size_key;
  fg__tick_axis length; /* how the size key's length is written; factor 0: as along x */
  double arrow_length;  /* of a typical arrow, coordinates */
  bool has_symbol[FG__SYMBOL_KINDS]; /* the key has it, as */
  fg__symbol symbol[FG__SYMBOL_KINDS];
  const struct fg__graticule *graticule; /* of a map: degrees where lines end, instead of
                                            axes; NULL: axes */
  bool short_key; /* of colours, as on maps: about half as long as the frame's side, and
                     in its middle */
  bool outlined;  /* the frame is no box: what lies in it has an outline of its own */
  int panels, columns; /* frames of one size side by side, from the upper left, row by
                          row; 0: one frame */
  const char (*panel_label)[FG__PAGE_TEXT_BYTES]; /* of each panel; "" none */
} fg__page_plan;

/* The size of its texts, points. */
double fg__page_font_size(const fg__page_plan *plan);

/* Lays out a page. What would leave the domain too little room is left out, the least
 * needed first; no two texts touch, and none leaves the page. `ruler` measures. */
void fg__page_layout(fg__page *out, const fg__page_plan *plan, cairo_t *ruler);

/* The same with plan->panels: out has the caption, the keys and a frame round all panels;
 * panel[k], of the same size, what lies round the frame of panel k: its label, and at the
 * outer sides of the whole the numbers of its axes or degrees. */
void fg__page_layout_panels(fg__page *out, fg__page *panel, const fg__page_plan *plan,
                            cairo_t *ruler);

/* The width from which on, to 5 %, a page of this shape has its colour key; 0 where the
 * page of the plan has it, or none is wanted. Sets page and panel to those of that width.
 */
double fg__page_key_width(fg__page *page, fg__page *panel, const fg__page_plan *plan);

/* Room round the frame, points. */
typedef struct fg__margins {
  double left, right, top, bottom;
} fg__margins;

/* page_items.c. The next of the texts, of the default size and not yet placed; NULL when
 * there are too many. */
fg__page_text *fg__page_next_text(fg__page *page, const char *text);

/* Where the page, whose frame's lower left corner is `low` in the field's coordinates,
 * has a point. */
void fg__page_project(const fg__page *page, const double low[2], double point[2]);

/* Lets the room grow so that it holds a box. */
void fg__margins_hold(fg__margins *room, const fg__page_box *frame,
                      const fg__page_box *box);

/* A text that is to be placed. */
typedef struct fg__words {
  const char *text;
  double size; /* points; 0: the page's font size */
  bool bold, quiet, upwards;
  fg__align align;
} fg__words;

/* Adds a text with its baseline at y, aligned at x; upwards the baseline is the vertical
 * line at x, and the text aligned at y. The room grows to hold it. Returns the text;
 * where there are too many, an empty one. */
const fg__page_text *fg__page_add_text(fg__page *page, fg__margins *room, cairo_t *ruler,
                                       const fg__words *words, double x, double y);

/* Breaks a text at spaces into at most `limit` lines of a width; the last takes the rest.
 * Lines that are too long end with an ellipsis. Returns whether none did. */
bool fg__page_break_lines(char line[][FG__PAGE_TEXT_BYTES], int limit, int *count,
                          cairo_t *ruler, const char *text, double size, bool bold,
                          double width);
/* Breaks a text at spaces into at most `limit` lines of a width, in a size that is so far
 * below `size` as it must, at least two thirds of it; what is too long even then ends
 * with an ellipsis. Returns the size. */
double fg__page_fit_lines(char line[][FG__PAGE_TEXT_BYTES], int limit, int *count,
                          cairo_t *ruler, const char *text, double size, bool bold,
                          double width);
/* A title and a subtitle broken into lines, the title's first. */
typedef struct fg__caption_lines {
  char line[FG__CAPTION_LINES][FG__PAGE_TEXT_BYTES];
  int titles, count;
  double title_size, size;
} fg__caption_lines;

/* Breaks them into lines of a width, in sizes that are at most those asked for. Returns
 * whether none had to shrink. */
bool fg__caption_break(fg__caption_lines *out, cairo_t *ruler, const char *title,
                       const char *subtitle, double title_size, double size,
                       double width);

/* The label of a colour key in lines, and the size of its letters. */
typedef struct fg__bar_label {
  char line[FG__LABEL_LINES][FG__PAGE_TEXT_BYTES];
  int count;
  double size;
} fg__bar_label;

void fg__page_add_line(fg__page *page, double x0, double y0, double x1, double y1);

/* Ticks of an axis of `length` points whose labels keep a distance. */
void fg__page_choose_ticks(fg__ticks *out, const fg__tick_axis *axis, cairo_t *ruler,
                           double length, double font_size, bool upright);

/* In units of the font size: from a tick's end to its number, and from the middle of a
 * digit to its baseline. */
#define FG__TICK_GAP 0.3
#define FG__HALF_DIGIT 0.36

/* The line of an axis or a key along which its ticks stand, points: to the right, with
 * ticks below, or upwards, with ticks to the right (side 1) or left (-1). */
typedef struct fg__scale {
  const fg__tick_axis *axis;
  double from[2], to[2]; /* where the axis is low and high */
  int side;              /* 0: below */
  double tick;           /* its length, in units of the font size */
  bool numbers;          /* are written */
} fg__scale;

/* Adds ticks and numbers, which keep a distance; the room grows to hold them. */
void fg__page_add_ticks(fg__page *page, fg__margins *room, cairo_t *ruler,
                        const fg__scale *scale);

/* Sides of a frame. */
typedef struct fg__page_sides {
  bool left, right, bottom, top;
} fg__page_sides;

/* Which parts a page has. */
typedef struct fg__page_parts {
  bool axes, axis_labels, color_key, size_key, symbols, caption;
  bool keys_below;
  fg__page_sides sides; /* where numbers and degrees are written; ticks are at all */
} fg__page_parts;

/* page_panels.c. Frames in a row, k = 0, or in a column. */
int fg__page_frames(const fg__page_plan *plan, int k);

/* The number of columns, for the shape of `panels` frames: the whole has about the shape
 * 3 : 2, and few places are empty. */
int fg__page_choose_columns(const fg__page_plan *plan);

/* Frames of the panels in page->frame, `gap` apart across and upright. */
void fg__page_place_frames(const fg__page *page, fg__page *panel,
                           const fg__page_plan *plan, const double gap[2]);

/* Adds to each panel what lies round its frame; sets the space that this takes round all
 * panels, and between two. */
void fg__page_place_panels(fg__page *panel, fg__margins *room, double between[2],
                           const fg__page_plan *plan, const fg__page_parts *parts,
                           cairo_t *ruler);

/* These add to the page what lies round page->frame, and set `room` to the space that it
 * takes: axes or a map's degrees, where the parts have them; axes; keys. */
void fg__page_place_sides(fg__page *page, fg__margins *room, const fg__page_plan *plan,
                          const fg__page_parts *parts, cairo_t *ruler);
void fg__page_place_axes(fg__page *page, fg__margins *room, const fg__page_plan *plan,
                         const fg__page_parts *parts, cairo_t *ruler);
void fg__page_place_keys(fg__page *page, fg__margins *room, const fg__page_plan *plan,
                         const fg__page_parts *parts, cairo_t *ruler);

/* Adds the caption above whatever else stands above the frame; too narrow a page gets
 * none. */
void fg__page_place_caption(fg__page *page, fg__margins *room, const fg__page_plan *plan,
                            cairo_t *ruler);

/* Adds the plan's caption above a frame as wide as the page, which moves down by a whole
 * number of steps, and a key of speeds below, in its middle; page->height grows by what
 * they need. Too narrow a page gets none. */
void fg__page_place_lone(fg__page *page, const fg__page_plan *plan, double step);

#endif
