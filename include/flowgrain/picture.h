/* Pictures of icons. */
#ifndef FLOWGRAIN_PICTURE_H
#define FLOWGRAIN_PICTURE_H

#include "flowgrain/icons.h"

#ifdef __cplusplus
extern "C" {
#endif

/* A zero field means its default, in brackets. Texts are UTF-8. Placeholders of the
 * caption are {title}, {time}, {level} and {names} of the field and {arrows}, the number
 * of arrows; {units} that of the colour key. */
typedef struct fg_picture_options {
  double width;            /* of the whole picture, in points of 1/72 inch [480] */
  double height;           /* [0: follows from the domain's shape] */
  double pixels_per_point; /* for PNG [2] */
  const char *palette; /* name of a colour map, or "#rrggbb" for one colour ["gale"] */
  double speed_min, speed_max;         /* ends of the colour key; equal: from the icons */
  bool no_frame;                       /* only mask and arrows */
  bool whole;                          /* all of the field's box [without what lies far
                                          outside of its values, of much of that] */
  bool transparent;                    /* no background */
  bool tint;                           /* tint the clusters (density needed) */
  const struct fg_texture *background; /* behind all, in pale greys; of
                                           FG_TEXTURE_SPEED in pale bands of the palette
                                           [blue], and arrows are dark; a palette of one
                                           colour is theirs (texture.h) [none] */
  double background_fade;              /* share of its way to white, 0 to 1 [0.7,
                                          stripes 0.85, speeds 0.3] */
  bool skeletons;       /* mark the clusters' spines and centres, where icons have
                           them */
  bool centers;         /* mark the centres alone, where icons have them */
  bool no_arrows;       /* nor keys for them: mask, tint, background and marks alone */
  const char *title;    /* caption; NULL: from the field; "" none */
  const char *subtitle; /* the line below; NULL: from the field, none where there is a
                           `title`; "" none */
  const char *label;    /* of the colour key; NULL: "mean speed" and the units; "" none */
  double font_size;     /* points [0: follows from the size; 9 at 480 points] */
  bool no_keys;         /* no colour key, no arrow for the size */
  bool outline_text;    /* texts are drawn as shapes [in SVG and PDF they stay texts] */
  const char *mask_color, *tint_color; /* "#rrggbb" [light grey, light blue] */
  bool no_coast;    /* of a field on the Earth: no land, coasts, lakes, borders */
  const char *land; /* "#rrggbb", colour of land [a pale grey] */
  bool borders;     /* of a field on the Earth: also borders of countries */
  double
      scale_time; /* t of the scale, for the caption [the density's; none without it] */
  int columns;    /* of fg_panels_write: panels in a row [from their shape] */
  double *key_width; /* set to the width, in points, from which on a picture of this shape
                        has room for the colour key, 0 where it has it, or shall have none
                        [not told] */
} fg_picture_options;

/* One of several panels in a figure. All are borrowed. */
typedef struct fg_panel {
  const fg_field *field;
  const fg_icons *icons;
  const fg_density *density;           /* NULL without tint */
  const struct fg_texture *background; /* NULL: none */
  double scale_time;                   /* as in fg_picture_options */
  const char *label; /* above it, with {letter} for a, b, ..., and as in a title {title},
                        {time}, {level}, {names}, {arrows}; "" none; NULL: the letter and
                        what tells this panel from the others */
  const char *name;  /* in messages; NULL: panel 1, panel 2, ... */
} fg_panel;

/* Names of the colour maps, ended by NULL. */
FG_API const char *const *fg_picture_palettes(void);

/* Rounds the ends of a colour key outwards to ticks; equal ends become a range round
 * their value. */
FG_API void fg_picture_round_speeds(double range[2]);

/* Draws icons; the format follows the name's end: .svg, .pdf or .png. density may be NULL
 * without tint, and must not be distributed; options may be NULL. FILE_ACCESS,
 * UNSUPPORTED, ARGUMENT, MEMORY, STOPPED. */
FG_API fg_status fg_picture_write(fg_context *context, const char *path,
                                  const fg_field *field, const fg_density *density,
                                  const fg_icons *icons,
                                  const fg_picture_options *options);

/* Draws `count` panels of one size, in columns and rows from the upper left, with one
 * caption, one colour key for the speeds of all and one arrow for the size. Width, height
 * and the size of the texts are the whole figure's. Numbers of axes and degrees are
 * written at the outer sides; the caption's names stand for what all panels have in
 * common. Fields must have the same box, map, components and units, 1 <= count <=
 * FG_MOST_PANELS; of the options neither background nor scale_time count. Statuses as of
 * fg_picture_write, ARGUMENT where two panels do not go together. */
enum { FG_MOST_PANELS = 100 };
FG_API fg_status fg_panels_write(fg_context *context, const char *path,
                                 const fg_panel *panels, int count,
                                 const fg_picture_options *options);

/* Pixels that the whole domain has in each panel that fg_panels_write would draw: as
 * fg_picture_frame. ARGUMENT, MEMORY. */
FG_API fg_status fg_panels_frame(int size[2], fg_context *context, const fg_panel *panels,
                                 int count, const fg_picture_options *options);

/* Pixels that the whole domain has in the picture that fg_picture_write would draw with
 * these options, whose frame may show less of it: the size of a background that needs no
 * stretching. Where that is more than 16 times the frame's pixels, so many of its shape.
 * ARGUMENT, MEMORY. */
FG_API fg_status fg_picture_frame(int size[2], fg_context *context, const fg_field *field,
                                  const fg_icons *icons,
                                  const fg_picture_options *options);

#ifdef __cplusplus
}
#endif

#endif
