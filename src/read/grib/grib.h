/* The parts of the GRIB reader, in the order a file passes through them: scan, about,
 * pairs, grid, values; library stands round every call of ecCodes. */
#ifndef FG__GRIB_H
#define FG__GRIB_H

#include "decode/signature.h"
#include "read/format.h"
#include "sphere/sphere.h"
#include "terms/polar.h"

#include <eccodes.h>

enum { FG__GRIB_TEXT = 256, FG__GRIB_WORD = 64, FG__GRIB_SECTIONS = 8 };

/* scan.c: the fields of a file, found without ecCodes. */

/* One grid of values: a message of edition 1, or of edition 2 the sections that belong
 * together in a message of one field or several. */
typedef struct fg__grib_field {
  const unsigned char *message; /* the whole message */
  size_t size;
  size_t number;                     /* among the file's messages, from 1 */
  size_t section[FG__GRIB_SECTIONS]; /* where each begins in the message; 0: none */
  unsigned char file;                /* 0 or 1 */
  unsigned char edition;
  bool alone;      /* the only field of its message */
  int about;       /* index into the file's */
  int64_t time;    /* minutes since 1970 that it is valid at */
  int64_t started; /* minutes since 1970 that its forecast began at */
} fg__grib_field;

/* What fields have in common but for their time. */
typedef struct fg__grib_about {
  uint64_t key;             /* of the bytes that say it */
  int kind;                 /* index into the file's */
  double level;             /* in the units of its kind's levels */
  const fg__grib_field *of; /* the first of them */
} fg__grib_about;

/* What fields have in common but for time and level. */
typedef struct fg__grib_kind {
  char name[FG__GRIB_WORD];       /* ecCodes' short name, or "0.2.2" for its numbers */
  char other_name[FG__GRIB_WORD]; /* as variables are named, "u10" */
  char title[FG__GRIB_TEXT];      /* "10 metre U wind component" */
  char units[FG__GRIB_WORD];
  char level_type[FG__GRIB_WORD]; /* "isobaricInhPa" */
  char step_type[FG__GRIB_WORD];  /* "instant", "max" */
  long member;                    /* of an ensemble; -1: none */
  uint64_t grid;                  /* hash of the bytes that say its grid */
  int grid_number;                /* among the file's grids, from 1 */
} fg__grib_kind;

typedef struct fg__grib_file {
  fg_context *context;
  const char *path[2]; /* borrowed */
  fg__source source[2];
  int count;
  fg__grib_field *field;
  size_t fields, field_capacity;
  size_t without_grid; /* messages that are left out, for they do not say their grids */
  fg__grib_about *about;
  size_t abouts, about_capacity;
  fg__grib_kind *kind;
  size_t kinds, kind_capacity;
} fg__grib_file;

/* Adds the fields of the file's source number `file`. FILE_FORMAT, UNSUPPORTED, MEMORY.
 */
fg_status fg__grib_scan(fg__grib_file *file, int number);

/* Bytes of section n of a field, NULL when it has none. */
const unsigned char *fg__grib_section(const fg__grib_field *field, int n, size_t *size);

/* A whole number of `bytes` bytes, the highest first. */
uint64_t fg__grib_number(const unsigned char *at, int bytes);

/* library.c: ecCodes, which may stop at damaged messages, and prints. */

/* Calls work(data), which calls ecCodes. Where ecCodes finds itself in a state that must
 * not be, or allocates more than `most` bytes, it is left by longjmp, and its memory
 * is lost: FILE_FORMAT. Else OK; `work` reports its own failures through data. */
fg_status fg__grib_guard(const fg__grib_file *file, const fg__grib_field *field,
                         size_t most, void (*work)(codes_handle *handle, void *data),
                         void *data);

/* about.c: fills in about and time of every field. Statuses as fg__grib_guard. */
fg_status fg__grib_tell_all(fg__grib_file *file);

/* pairs.c: the vectors. */

/* Minutes since 1970. */
typedef struct fg__grib_date {
  int64_t time, started;
} fg__grib_date;

typedef struct fg__grib_place {
  fg__grib_date date;
  double level;
  const fg__grib_field *component[2];
} fg__grib_place;

/* Which vectors are meant where a file has several: those of the first rank. */
typedef enum fg__grib_rank {
  FG__GRIB_VELOCITY,
  FG__GRIB_POLAR, /* a speed and a direction */
  FG__GRIB_OTHER
} fg__grib_rank;

typedef struct fg__grib_pair {
  const fg__grib_kind *kind[2];
  char name[2][FG__GRIB_TEXT]; /* with what tells it from others: "u@hybrid" */
  fg__grib_rank rank;
  fg__polar polar;       /* a length and its direction */
  fg__grib_place *place; /* ascending by time, then level */
  size_t places;
  fg__grib_date *time; /* ascending */
  double *level;
  size_t times, levels;
} fg__grib_pair;

typedef struct fg__grib_pairs {
  fg__grib_pair *pair;
  size_t count, capacity;
} fg__grib_pairs;

/* Matches components, by rank, then in the file's order. To be cleared even after a
 * failure. MEMORY. */
fg_status fg__grib_pairs_find(fg__grib_pairs *out, const fg__grib_file *file);

/* The pairs of components of these names: "u", "u10", "u@hybrid"; likewise. */
fg_status fg__grib_pairs_named(fg__grib_pairs *out, const fg__grib_file *file,
                               const char *u, const char *v);
void fg__grib_pair_clear(fg__grib_pair *pair);
void fg__grib_pairs_clear(fg__grib_pairs *pairs);

/* Whether a name of --vars is that of a kind. */
bool fg__grib_is_named(const fg__grib_kind *kind, const char *name);

/* words.c */

/* A kind by ecCodes' title, "U component of wind", or by its numbers, and its units. */
fg__term fg__grib_term(const fg__grib_kind *kind);

/* Words of a time and a level, and of a pair together. */
void fg__grib_time_words(const fg__grib_pair *pair, size_t time, char *out, size_t size);
void fg__grib_level_words(const fg__grib_pair *pair, double level, char *out,
                          size_t size);
void fg__grib_title(const fg__grib_pair *pair, char *out, size_t size);

/* The units of a pair's levels, "" when they have none. */
const char *fg__grib_level_units(const fg__grib_pair *pair);

/* choice.c: the one pair that the options choose, at their time and level; not every
 * time need have every level. To be cleared even after a failure. ARGUMENT, UNSUPPORTED,
 * MEMORY. */
fg_status fg__grib_choose(fg__grib_pairs *out, const fg__grib_file *file,
                          const fg_read_options *options);
fg_status fg__grib_find_place(const fg__grib_place **out, const fg__grib_file *file,
                              const fg__grib_pair *pair, const fg_read_options *options);

/* grid.c: where the values are. */

typedef enum fg__grib_layout {
  FG__GRIB_LONLAT, /* rows along parallels, regular or Gaussian */
  FG__GRIB_PLANE,  /* rows along x of a projection */
  FG__GRIB_ROWS,   /* points on the sphere in rows and columns: a rotated pole, ... */
  FG__GRIB_REDUCED /* rows of different lengths along parallels, perhaps rotated */
} fg__grib_layout;

typedef struct fg__grib_grid {
  fg__grib_layout layout;
  char type[FG__GRIB_WORD]; /* "regular_ll" */
  size_t points;
  size_t size[2]; /* columns and rows; REDUCED: the longest row, and rows */
  bool x_descends, y_descends, along_y, alternates; /* how values follow each other */
  bool relative;       /* components are along the grid, not to east and north */
  double *axis[2];     /* [size] ascending; degrees or metres; of ROWS and REDUCED, of
                          their own pole; REDUCED has no x */
  double period;       /* of x: 360, or 0 */
  size_t *row;         /* REDUCED: points of each row, from south to north */
  double *west, *step; /* REDUCED: first longitude of each row, and between points */
  bool rotated;        /* the pole below is not the Earth's */
  double pole_latitude, pole_longitude, pole_angle; /* of the south pole; degrees */
  double cone, meridian, apex;     /* PLANE: north turns by cone * (longitude - meridian);
                                      its poles lie at x = 0, y = apex */
  char projection[FG__GRIB_TEXT];  /* PLANE: for PROJ; "" else */
  char unusable[FG__REASON_BYTES]; /* "" or why it cannot be read */
} fg__grib_grid;

/* Finds the grid of a field. What makes it unusable is no status. FILE_FORMAT, MEMORY. */
fg_status fg__grib_grid_find(fg__grib_grid *out, const fg__grib_file *file,
                             const fg__grib_field *field);
void fg__grib_grid_clear(fg__grib_grid *grid);

/* The numbers that say a grid, as ecCodes tells them; NAN where there is none. */
typedef struct fg__grib_numbers {
  char type[FG__GRIB_WORD];
  double points, columns, rows, x_descends, y_ascends, along_y, alternates, flags;
  double first[2], last[2];   /* longitude, latitude; degrees */
  double gaussian;            /* rows between a pole and the equator */
  double pole[2], pole_angle; /* longitude, latitude of the south pole */
  double spacing[2];          /* metres */
  double meridian, parallel, parallel_1, parallel_2, south;
  double oblate, radius, major, minor; /* metres */
} fg__grib_numbers;

/* plane.c. Makes a grid one in the plane of its projection. MEMORY. */
fg_status fg__grib_plane(fg__grib_grid *grid, fg_context *context,
                         const fg__grib_numbers *numbers);

/* The plane's coordinates of a longitude and latitude, metres. */
typedef struct fg__grib_projection {
  enum { FG__GRIB_LAMBERT, FG__GRIB_STEREOGRAPHIC, FG__GRIB_MERCATOR } kind;
  double radius, eccentricity;
  double meridian; /* degrees */
  double cone, scale, apex;
} fg__grib_projection;

void fg__grib_forward(const fg__grib_projection *projection, double longitude,
                      double latitude, double *x, double *y);

/* png.c: whether an image is whole, one that libpng unpacks without complaint. */
bool fg__grib_is_png(const unsigned char *png, size_t size);

/* packing.c: whether an image of JPEG 2000 says that it has one component of so many
 * samples. */
bool fg__grib_jpeg_has(const unsigned char *jpeg, size_t size, uint64_t count);

/* packing.c: whether section 5 has a block size, a reference interval and bits for each
 * value that CCSDS' packing allows. */
bool fg__grib_ccsds_is_sound(const unsigned char *packing, size_t size);

/* packing.c: whether the groups of complex packing have so many values together, all in
 * the data; packing is section 5, data what follows the head of section 7. */
bool fg__grib_groups_fit(const unsigned char *packing, size_t packing_size,
                         const unsigned char *data, size_t size, uint64_t count);

/* values.c: fills out[points] in the order of the axes, x fastest; REDUCED: in that of
 * the file. NAN: missing. FILE_FORMAT, UNSUPPORTED, MEMORY. */
fg_status fg__grib_values(float *out, const fg__grib_file *file,
                          const fg__grib_field *field, const fg__grib_grid *grid);

/* Turns components to the axes of a plane (plane.c) where they are to east and north. */
void fg__grib_turn(float *u, float *v, const fg__grib_grid *grid);

/* sphere.c: points and cells of a grid of ROWS or REDUCED, with the components to east
 * and north, and the poles where rows close round them. MEMORY. */
fg_status fg__grib_cells(fg__sphere_cells *out, fg_context *context,
                         const fg__grib_grid *grid, const float *const velocity[2]);

#endif
