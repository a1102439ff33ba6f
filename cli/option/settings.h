/* Results of parsing: a struct for each command, composed of groups that several share.
 * Zero means "not given". */
#ifndef OPTION_SETTINGS_H
#define OPTION_SETTINGS_H

#include "program.h"

enum { MAX_SCALES = FG_MOST_SCALES };

/* Views of a picture in 3D. */
enum { MAX_VIEWS = 8 };

/* Picture formats, as bits of `formats`. */
enum { FORMAT_SVG = 1, FORMAT_PNG = 2, FORMAT_PDF = 4, FORMAT_KINDS = 3 };

/* Numbers of arrows or clusters, descending. */
typedef struct number_list {
  int number[MAX_SCALES];
  int count;
} number_list;

/* Times of scales, ascending. */
typedef struct time_list {
  double time[MAX_SCALES];
  int count;
} time_list;

/* Operands after the first. */
typedef struct operand_list {
  char *const *operand;
  int count;
} operand_list;

/* How inputs are read. */
typedef struct input_settings {
  const char *format;     /* NULL: found from the content */
  const char *max_memory; /* NULL: the default */
} input_settings;

/* A field to read: INPUT and options that select from it. */
typedef struct reading_settings {
  const char *input;
  const char *vars, *vars_from, *mesh_from, *mask, *missing;
  const char *at;                     /* samples of further dimensions */
  const char *time_text, *level_text; /* as given; NULL: not given */
  int time, level;                    /* indices, set when the input is known */
  int scale;                          /* fg_scale */
  int frame;                          /* fg_frame */
  const char *slice;                  /* a plane */
  const char *block;
  fg_map_options map;
} reading_settings;

typedef struct evolution_settings {
  int nodes;
  int mesh;           /* fg_mesh_kind */
  int scheme;         /* fg_scheme */
  const char *energy; /* a word of energy_words, or a file; NULL: flow */
  double anisotropy, isotropic_below, coverage, gamma, noise;
  double theta, alpha, residual;
} evolution_settings;

typedef struct work_settings {
  uint64_t seed;
  int threads;
} work_settings;

/* Appearance of pictures. */
typedef struct picture_settings {
  double width, height, font_size;      /* points */
  double dpi;                           /* of pixels */
  const char *title, *subtitle, *label; /* NULL: not given */
  const char *palette, *mask_color, *tint_color;
  double speed_range[2]; /* equal: not given */
  double background_fade;
  bool no_keys, outline_text;
  bool tint, skeletons, centers, features, no_arrows, no_frame, transparent;
  bool surfaces;
  bool no_coast, borders;
  const char *land;           /* a colour */
  int background;             /* 0: none; else fg_texture_kind + 1 */
  double views[MAX_VIEWS][2]; /* azimuth, elevation, degrees */
  int view_count;             /* 0: one default view */
} picture_settings;

typedef struct run_settings {
  input_settings inputs;
  reading_settings reading;
  evolution_settings evolution;
  work_settings work;
  picture_settings picture;
  const char *output;           /* DIR */
  number_list arrows, clusters; /* neither: the default numbers of arrows */
  time_list times;              /* instead of either */
  double tolerance;             /* degrees */
  int start;                    /* of a placement: clusters (0), even */
  int effort;                   /* fg_effort */
  int lengths;                  /* fg_lengths */
  int extent;                   /* as extent_words: cluster (0), territory */
  double max_time;
  int max_steps;
  unsigned formats; /* 0: the default, SVG and PNG, in 3D PNG */
  bool save_field, no_page;
  double checkpoint; /* seconds between checkpoints; 0: after each step */
  bool resume, force, quiet, verbose;
  bool member;         /* part of a series, which prints the messages about it */
  int progress_socket; /* for progress.h; 0: none */
} run_settings;

typedef struct view_settings {
  run_settings run; /* first, as options of `run` are set in it; its input may be the DIR
                       of a run */
  const char *first_option; /* first given option of `run`; NULL: none */
  bool no_browser;
} view_settings;

typedef struct draw_settings {
  input_settings inputs;
  picture_settings picture;
  const char *folder; /* DIR of a finished run or a series, or a file of icons */
  operand_list more;  /* further ones */
  const char *output; /* PICTURE */
  const char *input;  /* current path of the input */
  const char *vars_from, *mesh_from; /* those of further files */
  fg_map_options map;                /* instead of the run's map */
  int scale_index;                   /* -1: not given */
  number_list arrows, clusters; /* for each the finest scale with at most this number */
  bool all_scales;
  int columns;             /* of panels; 0: automatic */
  const char *panel_label; /* NULL: not given */
} draw_settings;

typedef struct texture_settings {
  input_settings inputs;
  reading_settings reading;
  evolution_settings evolution; /* of clusters */
  work_settings work;
  picture_settings picture;
  const char *output;
  int kind;           /* fg_texture_kind */
  int pixels;         /* along the longest side */
  double length;      /* of streaks, pixels */
  number_list number; /* of clusters: one */
  double max_time;
  double fade;
  bool key;
} texture_settings;

typedef struct brush_settings {
  work_settings work;
  const char *image, *output;
  number_list clusters;
  double anisotropy;
  double width; /* points */
  bool transparent, verbose;
} brush_settings;

typedef struct info_settings {
  input_settings inputs;
  reading_settings reading;
  bool json;
} info_settings;

typedef struct synth_settings {
  const char *name, *output;
  int nodes; /* samples a side */
} synth_settings;

typedef struct rival_settings {
  input_settings inputs;
  reading_settings reading;
  picture_settings picture;
  const char *output;
  int method;             /* fg_rival_method */
  number_list icons;      /* how many */
  int nodes;              /* of the raster that is clustered */
  double length;          /* of an arrow, fair shares */
  int by_speed;           /* 0: equal lengths; 1: proportional to speed */
  double position_weight; /* -1 when not given */
  double elongation;
  unsigned formats;
  bool save_field;
} rival_settings;

typedef struct score_settings {
  input_settings inputs;
  reading_settings reading;
  operand_list files; /* of icons */
  int length_class;   /* fg_score_class */
  number_list icons;  /* the nominal number: one */
  double ink;         /* 0: no limit */
  bool json;
} score_settings;

typedef struct gallery_settings {
  int figure;         /* the only one; 0: all */
  const char *output; /* DIR */
  bool force, quiet;
} gallery_settings;

/* Settings of any command. */
typedef union any_settings {
  run_settings run;
  view_settings view;
  draw_settings draw;
  texture_settings texture;
  brush_settings brush;
  info_settings info;
  synth_settings synth;
  rival_settings rival;
  score_settings score;
  gallery_settings gallery;
} any_settings;

/* Whether arrows are placed, in exact number; otherwise there is one for each cluster. */
bool settings_place(const run_settings *settings);

/* Conversion to option structs of the library. */
fg_read_options settings_reading(const reading_settings *settings);
fg_evolution_options settings_evolution(const evolution_settings *settings,
                                        const work_settings *work);
fg_placement_options settings_placement(const run_settings *settings);
fg_run_options settings_run(const run_settings *settings);
fg_icon_options settings_icons(const run_settings *settings);
fg_texture_options settings_texture(const texture_settings *settings);
/* map: of the field; its region is shown whole. */
fg_picture_options settings_picture(const picture_settings *settings,
                                    const fg_map_options *map);
fg_texture_style settings_texture_style(const texture_settings *settings,
                                        const fg_texture *texture);

/* Sets the ends of the colour key if given; else `speeds` stay. */
void settings_speeds(double speeds[2], const picture_settings *settings);

/* Options of one view in 3D, from 0. preset: azimuth and elevation of a view without its
 * own, or NULL. */
fg_solid_options settings_solid(const picture_settings *settings, int view,
                                const double preset[2]);

#endif
