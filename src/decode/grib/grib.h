/* GRIB, editions 1 and 2, as a dataset: scan finds messages and their sections, about
 * what they are of, grid where their values are; dataset makes variables of them, whose
 * values `values` unpacks; library stands round every call of ecCodes. */
#ifndef FG__GRIB_H
#define FG__GRIB_H

#include "decode/openers.h"

#include <eccodes.h>
#include <stdint.h>

enum { FG__GRIB_WORD = 64, FG__GRIB_SECTIONS = 8, FG__GRIB_NO_MEMBER = -1 };

/* scan.c: the fields of a file, found without ecCodes. */

/* One grid of values: a message of edition 1, or of edition 2 the sections that belong
 * together in a message of one field or several. */
typedef struct fg__grib_field {
  const unsigned char *message; /* the whole message */
  size_t size;
  size_t number;                     /* among the file's messages, from 1 */
  size_t section[FG__GRIB_SECTIONS]; /* where each begins in the message; 0: none */
  unsigned char edition;
  bool alone;      /* the only field of its message */
  int kind;        /* index into the file's */
  int64_t time;    /* minutes since 1970 that it is valid at */
  int64_t started; /* minutes since 1970 that its forecast began at */
  double level;    /* in the units of its kind's levels */
  long member;     /* of an ensemble, or FG__GRIB_NO_MEMBER */
} fg__grib_field;

/* What fields of a variable have in common. */
typedef struct fg__grib_kind {
  char name[FG__GRIB_WORD];       /* ecCodes' short name, or "0.2.2" for its numbers */
  char other_name[FG__GRIB_WORD]; /* as variables are named, "u10" */
  char standard_name[FG__TEXT_BYTES];
  char title[FG__TEXT_BYTES]; /* "10 metre U wind component" */
  char units[FG__GRIB_WORD];
  char level_type[FG__GRIB_WORD]; /* "isobaricInhPa" */
  char step_type[FG__GRIB_WORD];  /* "instant", "max" */
  int grid;                       /* index into the file's */
  size_t axis[3];                 /* of time, level and member: of the file's axes */
  int axes;                       /* 2 without members */
} fg__grib_kind;

typedef enum fg__grib_layout {
  FG__GRIB_LONLAT, /* rows along parallels, regular or Gaussian */
  FG__GRIB_PLANE,  /* rows along x of a projection */
  FG__GRIB_ROWS,   /* rows along parallels about a pole of their own */
  FG__GRIB_REDUCED /* rows of different lengths along parallels, perhaps about such */
} fg__grib_layout;

/* The coordinates of a plane in metres. */
typedef struct fg__grib_projection {
  enum { FG__GRIB_LAMBERT, FG__GRIB_STEREOGRAPHIC, FG__GRIB_MERCATOR } kind;
  double radius, minor, eccentricity;   /* half-axes in metres */
  double meridian, origin, parallel[2]; /* degrees */
  double cone, scale, apex;
} fg__grib_projection;

/* Points in rows as a mesh: its nodes are the points, then poles that rows close round
 * but do not reach. */
typedef struct fg__grib_mesh {
  double *position[2]; /* [nodes] longitude, latitude */
  double *turn[2];     /* [nodes] cosine and sine of the angle from east to the rows */
  int *corner;         /* [faces][4], the last -1 of triangles */
  size_t nodes, faces, poles;
} fg__grib_mesh;

typedef struct fg__grib_grid {
  uint64_t key; /* of the bytes that say it */
  fg__grib_layout layout;
  char type[FG__GRIB_WORD]; /* "regular_ll" */
  size_t points;
  size_t size[2]; /* columns and rows; REDUCED: the longest row, and rows */
  bool x_descends, y_descends, along_y, alternates; /* how values follow each other */
  bool relative;       /* components are along the grid, not to east and north */
  double *axis[2];     /* [size] ascending; degrees or metres; of ROWS and REDUCED, about
                          their own pole; REDUCED has no x */
  double period;       /* of x: 360, or 0 */
  size_t *row;         /* REDUCED: points of each row, from south to north */
  double *west, *step; /* REDUCED: first longitude of each row, and between points */
  bool rotated;        /* the pole below is not the Earth's */
  double pole_latitude, pole_longitude, pole_angle; /* of the south pole; degrees */
  fg__grib_projection projection;                   /* PLANE */
  fg__grib_mesh mesh; /* ROWS and REDUCED, once it is made */
  int dimension[2];   /* of x and y, or of the mesh's nodes: the dataset's indices */
  char unusable[2 * FG__TEXT_BYTES]; /* "" or why its values cannot be read */
} fg__grib_grid;

/* What fields are compared by: PLACE is the kind, then all others. */
typedef enum fg__grib_along {
  FG__GRIB_TIME,
  FG__GRIB_LEVEL,
  FG__GRIB_MEMBER,
  FG__GRIB_PLACE
} fg__grib_along;

/* The samples along time, level or member of variables that share them. */
typedef struct fg__grib_axis {
  fg__grib_along along;
  char name[FG__GRIB_WORD];
  const fg__grib_field **at; /* [count] a field of each, in ascending order */
  size_t count;
  int dimension; /* index into the dataset's */
} fg__grib_axis;

/* A file that is open: the decoder's state. */
typedef struct fg__grib_file {
  fg_context *context;
  const char *path;
  fg__source source;
  bool owns_source;
  fg__grib_field *field;
  size_t fields, field_capacity;
  size_t without_grid; /* messages that are left out, for they do not say their grids */
  fg__grib_kind *kind;
  size_t kinds, kind_capacity;
  fg__grib_grid *grid;
  size_t grids, grid_capacity;
  fg__grib_axis *axis;
  size_t axes, axis_capacity;
  const fg__grib_field **place;   /* fields by kind, time, level and member */
  size_t *first;                  /* [kinds + 1] into `place` */
  const fg__grib_field *unpacked; /* the field whose values these are: */
  double *value;
} fg__grib_file;

/* describe.c: what a variable is, fg__variable.place; its `id` is the number of an axis,
 * a grid or a kind. */
typedef enum fg__grib_content {
  FG__GRIB_SAMPLES,
  FG__GRIB_STARTED, /* the times at which forecasts began, along an axis of time */
  FG__GRIB_GRID_X,
  FG__GRIB_GRID_Y,
  FG__GRIB_POSITION_X, /* of a mesh's nodes, as are the two after the next */
  FG__GRIB_POSITION_Y,
  FG__GRIB_COSINE,
  FG__GRIB_SINE,
  FG__GRIB_FACES,
  FG__GRIB_DESCRIPTION, /* of a projection or mesh: without a value */
  FG__GRIB_FIELD
} fg__grib_content;

/* Adds a file's dimensions and variables. MEMORY. */
fg_status fg__grib_describe(fg__dataset *data, fg__grib_file *file);

int fg__grib_compare(fg__grib_along along, const fg__grib_field *a,
                     const fg__grib_field *b);
int fg__grib_by_place(const void *one, const void *other); /* for qsort */

/* Whether values lie on axes, not on a mesh. */
bool fg__grib_has_lines(const fg__grib_grid *grid);

/* FILE_FORMAT, UNSUPPORTED, MEMORY. */
fg_status fg__grib_scan(fg__grib_file *file);

/* Bytes of section n of a field, NULL when it has none. */
const unsigned char *fg__grib_section(const fg__grib_field *field, int n, size_t *size);

/* A whole number of `bytes` bytes, the highest first. */
uint64_t fg__grib_number(const unsigned char *at, int bytes);

/* library.c: ecCodes, which may stop at damaged messages, and prints. */

/* Calls work(data), which calls ecCodes. Where ecCodes finds itself in a state that must
 * not be, it is left by longjmp, and its memory is lost: FILE_FORMAT. Else OK; `work`
 * reports its own failures through data. */
fg_status fg__grib_guard(const fg__grib_file *file, const fg__grib_field *field,
                         void (*work)(codes_handle *handle, void *data), void *data);

/* Reads a word of a message's key; "": there is none. */
void fg__grib_word(codes_handle *handle, const char *key, char *out, size_t size);

/* about.c: fills in about and time of every field, kinds and grids. Statuses as
 * fg__grib_guard. */
fg_status fg__grib_tell_all(fg__grib_file *file);

/* names.c: CF's standard name of what a title says, "" where it is of no vector; and
 * units, standard name and direction of a type of levels, each "" where there is none. */
const char *fg__grib_standard_name(const char *title);

typedef struct fg__grib_levels {
  const char *type, *units, *standard_name, *positive;
} fg__grib_levels;

const fg__grib_levels *fg__grib_levels_of(const char *type);

/* grid.c: where the values are. What makes a grid unusable is no status. FILE_FORMAT,
 * MEMORY. */
fg_status fg__grib_grid_find(fg__grib_grid *out, const fg__grib_file *file,
                             const fg__grib_field *field);
void fg__grib_grid_clear(fg__grib_grid *grid);
void fg__grib_unusable(fg__grib_grid *grid, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

/* The numbers that say a grid, as ecCodes tells them; NAN where there is none. */
typedef struct fg__grib_numbers {
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

/* Adds the projection as CF's grid mapping. MEMORY. */
fg_status fg__grib_plane_add(fg__variable *variable, const fg__grib_grid *grid);

/* rows.c. How large a mesh is, and its parts. MEMORY. */
void fg__grib_mesh_count(fg__grib_mesh *out, const fg__grib_grid *grid);
fg_status fg__grib_mesh_make(fg__grib_grid *grid, fg_context *context);

/* packing.c: whether an image of JPEG 2000 says that it has one component of `count`
 * samples. */
bool fg__grib_jpeg_has(const unsigned char *jpeg, size_t size, uint64_t count);

/* packing.c: whether section 5 has a block size, a reference interval and bits for each
 * value that CCSDS' packing allows. */
bool fg__grib_ccsds_is_sound(const unsigned char *packing, size_t size);

/* packing.c: whether the groups of complex packing have `count` values together, all in
 * the data; packing is section 5, data what follows the head of section 7. */
bool fg__grib_groups_fit(const unsigned char *packing, size_t packing_size,
                         const unsigned char *data, size_t size, uint64_t count);

/* values.c: fills out[points] in the order of the axes, x fastest; REDUCED: in that of
 * the file. NAN: missing. FILE_FORMAT, MEMORY. */
fg_status fg__grib_values(double *out, const fg__grib_file *file,
                          const fg__grib_field *field, const fg__grib_grid *grid);

#endif
