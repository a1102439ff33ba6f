/* What the files of the program share: exit codes, settings, messages. */
#ifndef PROGRAM_H
#define PROGRAM_H

#include "flowgrain/flowgrain.h"

/* Exit codes of every command. */
enum { EXIT_DONE = 0, EXIT_FAILED = 1, EXIT_USAGE = 2, EXIT_INTERRUPTED = 130 };

enum { MAX_SCALES = FG_MOST_SCALES };

/* Views of a picture in 3D. */
enum { MAX_VIEWS = 8 };

/* Picture formats, as bits of settings.formats. */
enum { FORMAT_SVG = 1, FORMAT_PNG = 2, FORMAT_PDF = 4, FORMAT_KINDS = 3 };

/* Everything a command line can say. Zero means "not said". */
typedef struct cli_settings {
  const char *operand; /* INPUT, FILE, DIR or NAME */
  char *const *files;  /* score: the operands after it */
  int file_count;
  const char *output;

  const char *vars, *vars_from, *mask;
  int time, level;
  int scale; /* fg_scale */

  int nodes;
  int mesh;           /* fg_mesh_kind */
  int scheme;         /* fg_scheme */
  const char *energy; /* a word of energy_words or a file; NULL: flow */
  double anisotropy, isotropic_below, coverage, gamma, noise;
  uint64_t seed;
  double max_time;
  int max_steps;
  int threads;
  int clusters[MAX_SCALES]; /* descending */
  int cluster_count;
  int arrows[MAX_SCALES]; /* descending; none and no clusters: the default list */
  int arrow_count;
  double tolerance;  /* degrees; 0: not said */
  int start;         /* of a placement: clusters (0), even */
  int effort;        /* fg_effort */
  int extent;        /* cluster (0), the only one */
  double checkpoint; /* seconds between checkpoints; 0: after every step */

  unsigned formats; /* 0: the default, SVG and PNG, in 3D PNG */
  double width;
  const char *palette;
  bool tint, skeletons, centers, no_arrows, no_frame, transparent;
  bool surfaces;
  bool key;
  double views[MAX_VIEWS][2]; /* azimuth, elevation, degrees */
  int view_count;             /* 0: one, the usual */

  int method;       /* rival: fg_rival_method */
  int lengths;      /* run: fg_lengths; rival: 1 with the speed */
  int length_class; /* score: fg_score_class */
  double ink;       /* score: 0: no limit */
  int kind;         /* fg_texture_kind */
  int background;   /* 0: none; 1 more than fg_texture_kind */
  int longest;      /* pixels */
  double length, fade;
  double position_weight, elongation;

  const char *input; /* draw: the field, where it is now */
  int scale_index;   /* draw: -1 when not said */
  int figure;        /* gallery: the only one; 0: all */

  bool save_field, resume, force, quiet, verbose, json;
} cli_settings;

/* From now on complaints are kept, not printed: on ranks other than 0, for all to agree
 * on (ranks.h). */
void keep_complaints(void);

/* Prints "flowgrain: TEXT" on standard error, or keeps it. */
void complain(const char *format, ...) __attribute__((format(printf, 1, 2)));

/* The same of a second line, which says what to do about the complaint. */
void advise(const char *format, ...) __attribute__((format(printf, 1, 2)));

/* A text of a file without what a terminal would obey: control characters become '?'.
 * Returns `out`; longer texts are cut. */
enum { CLEAN_BYTES = 1024 };
const char *clean_text(char out[CLEAN_BYTES], const char *text);

/* What was last complained of, and advised on it; "" before. */
const char *last_complaint(void);
const char *last_advice(void);

/* Prints a context's message and its hint, after `file` unless the message begins with a
 * file's name of its own; returns the exit code for the failure. */
int complain_of(const fg_context *context, fg_status status, const char *file);

/* The same of a file that is written under the name `partial` first, which is not told.
 */
int complain_of_partial(const fg_context *context, fg_status status, const char *partial,
                        const char *file);

/* Prints a file's error from errno, "flowgrain: PATH: No such file ..."; EXIT_FAILED. */
int complain_of_file(const char *path, const char *what);

/* Says how many samples of a field are missing because they are infinite, if any are. */
void say_infinite(const char *file, const fg_field *field);

/* Creates a context, or complains. Returns an exit code. */
int create_context(fg_context **out);

/* Joins two texts, or a folder and a name with a slash between. NULL without memory. End
 * with free. */
char *join_texts(const char *first, const char *second);
char *join_path(const char *folder, const char *name);

/* Complains of a picture whose name has not the end of a known format, or that can not be
 * put where it shall be; an exit code. */
int check_picture_name(const char *path, const char *command);

int command_run(const cli_settings *settings);
int command_draw(const cli_settings *settings);
int command_info(const cli_settings *settings);
int command_synth(const cli_settings *settings);
int command_rival(const cli_settings *settings);
int command_score(const cli_settings *settings);
int command_texture(const cli_settings *settings);
int command_brush(const cli_settings *settings);
int command_gallery(const cli_settings *settings);

/* Does what a command line says, argv[0] being the program; returns its exit code. */
int program_perform(int argc, char **argv);

fg_read_options settings_reading(const cli_settings *settings);
fg_run_options settings_scales(const cli_settings *settings);
fg_evolution_options settings_evolution(const cli_settings *settings);

fg_picture_options settings_picture(const cli_settings *settings);

/* Whether arrows are placed, exactly so many; else they are their clusters' own. */
bool settings_place(const cli_settings *settings);
fg_placement_options settings_placement(const cli_settings *settings);

/* The options of one of the views in 3D, from 0. usual: azimuth and elevation where none
 * is asked for, or NULL. */
fg_solid_options settings_solid(const cli_settings *settings, int view,
                                const double usual[2]);
fg_texture_options settings_texture(const cli_settings *settings);

#endif
