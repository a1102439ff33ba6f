/* What a file of any format holds: variables along dimensions, as xarray and the
 * CF conventions have them. A decoder (decode/) fills it from bytes and knows nothing of
 * vectors, times or maps; interpret/ finds those in it and knows nothing of formats. */
#ifndef FG__DATASET_H
#define FG__DATASET_H

#include "base/context.h"
#include "field/cell_types.h"
#include "field/region.h"
#include "terms/coordinates.h"

enum {
  FG__DATASET_FILES = 3, /* the input and two more with what it lacks */
  FG__RANK = 8,          /* more dimensions than any field has */
  FG__TEXT_BYTES = 256,  /* that are read of a text */
  FG__DIMENSION_BYTES = 257,
  FG__NAME_BYTES = 514, /* group/variable */
  FG__MOST_FILLS = 16
};

typedef struct fg__dataset fg__dataset;

typedef struct fg__attribute {
  char *name;
  char *text;     /* NULL: it is of numbers */
  double *number; /* [count] */
  size_t count;
  bool is_floating;
} fg__attribute;

typedef struct fg__dimension {
  char name[FG__DIMENSION_BYTES];
  int file;
  int id;        /* the decoder's own */
  size_t length; /* 1 where one sample is chosen */
  size_t chosen; /* the first sample that is read: 0, or the chosen one */
  bool is_chosen;
  bool unlimited;
  bool is_nameless; /* its name is the decoder's: it may get that of a coordinate */
} fg__dimension;

typedef enum fg__type {
  FG__TYPE_OTHER = 0,
  FG__TYPE_LETTERS, /* its last dimension counts the letters of texts */
  FG__TYPE_TEXTS,
  FG__TYPE_INT8,
  FG__TYPE_UINT8,
  FG__TYPE_INT16,
  FG__TYPE_UINT16,
  FG__TYPE_INT32,
  FG__TYPE_UINT32,
  FG__TYPE_INT64,
  FG__TYPE_UINT64,
  FG__TYPE_FLOAT32,
  FG__TYPE_FLOAT64
} fg__type;

/* Where a variable's samples are: along dimensions, or in space. */
typedef enum fg__location { FG__ON_GRID = 0, FG__AT_POINTS, FG__OF_CELLS } fg__location;

typedef struct fg__variable {
  fg__dataset *owner;
  int file;               /* below FG__DATASET_FILES */
  int group;              /* of the dataset's groups */
  char *name;             /* with the names of its groups: "ocean/u" */
  const char *plain_name; /* the last part */
  const char *path;       /* of its file */
  fg__type type;
  int rank;                /* FG__RANK + 1 when it has more */
  int dimension[FG__RANK]; /* indices into the dataset's dimensions */
  int element;    /* from 1: of a vector variable, whose dimension of components is not
                     counted    in `rank`, and which may also be there as a whole: 0 */
  int components; /* of a vector variable in space; of others 0 */
  fg__location location;
  bool is_marked;   /* the file calls it the vector */
  bool no_velocity; /* the file says that it is something else, such as normals */
  fg__attribute *attribute;
  size_t attributes;
  double fill;          /* of samples that were never written; NaN: there is none */
  bool in_one_run;      /* its samples lie in the file one after the other */
  bool fits_file;       /* the decoder has compared its size with the file's */
  const char *unusable; /* why it cannot be read, the decoder's; NULL: it can */
  int place, id;        /* the decoder's own */
  /* by interpret/, once a dataset is open */
  fg__role geographic; /* longitude (X), latitude (Y), or neither */
} fg__variable;

/* What a format must do for the variables of a file; each returns OK, or a status with
 * its message. */
typedef struct fg__decoder {
  /* Numbers as they are stored; indices are the file's. */
  fg_status (*fetch)(const fg__variable *variable, const size_t *start,
                     const size_t *count, double *out);
  /* Texts [first, first + count) of a variable of texts, or of rows of letters: each
   * takes `size` bytes, ended by NUL. NULL: the format has numbers alone. */
  fg_status (*fetch_texts)(const fg__variable *variable, size_t first, size_t count,
                           char *out, size_t size);
  size_t state_bytes; /* of a file's state, which is zeroed and freed; 0: the caller's */
  void (*close)(void *state); /* frees what the state has; NULL: nothing */
  /* Whether the file has the samples at these indices; NULL: it has all. */
  bool (*has)(const fg__variable *variable, const size_t *index);
  bool has_no_titles; /* but names and units alone */
  /* Of a text: what sample number n of a column stands in, "line", and its number;
   * NULL: samples are counted. */
  const char *records;
  size_t (*record)(const fg__variable *variable, size_t n);
  /* Returns `status`, or fg__source_check of further files that it has opened; may be
   * NULL.
   */
  fg_status (*check)(const void *state, fg_status status);
} fg__decoder;

typedef struct fg__dataset_file {
  char *path;
  size_t size; /* bytes */
  const fg__decoder *decoder;
  void *state;   /* the decoder's */
  bool was_read; /* numbers of it, since samples were chosen */
} fg__dataset_file;

/* Cells between points in space, numbered as VTK numbers their types and their corners
 * (vtkCellType.h). */
typedef struct fg__topology {
  size_t points, cells, cell_capacity, corners, corner_capacity;
  double *position;    /* [3 * points], x y z of a point together */
  unsigned char *type; /* [cells] */
  size_t *first;       /* [cells], each one's first corner */
  int *corner; /* points; of a polyhedron the number of its points, these, and perhaps how
                  many faces it has, and of each how many points and which */
} fg__topology;

/* Samples in space: on a grid along axes, or at points and of cells. */
typedef struct fg__space {
  bool is_there;
  bool on_axes;       /* dimensions are those of z, y, x; else points, or cells */
  size_t points[3];   /* along axes */
  int axis[3];        /* along axes: the variables with the coordinates along x, y, z */
  fg__topology cells; /* else */
  struct fg__space_domain
      *domain; /* by sample/: the plane or volume that the points fill */
} fg__space;

/* Numbers that a user takes for missing values: fg_read_options.missing. */
typedef struct fg__missing_numbers {
  double number[FG__MOST_FILLS];
  int count;
  bool none; /* every number is a value */
} fg__missing_numbers;

bool fg__is_given_missing(const fg__missing_numbers *given, double value);

/* The input and up to two files with what it lacks: the other component, the mesh. */
struct fg__dataset {
  fg_context *context;
  fg__dataset_file file[FG__DATASET_FILES];
  int files;
  int component_files; /* how many of them, from the first, may hold components */
  fg__dimension *dimensions;
  size_t dimension_count, dimension_capacity;
  fg__variable *variables;
  size_t variable_count, variable_capacity;
  fg__variable *groups; /* only their attributes; of each file its own first */
  size_t group_count, group_capacity;
  fg__space space;
  double *time; /* those that the opening chose one of; NULL: not known */
  int times;    /* 0: there was no choice */
  bool has_blocks;
  bool lost_names; /* a header names places, and its names do not fit the columns */
  bool takes_all_samples; /* other dimensions than time and level are the caller's */
  fg__missing_numbers missing;
  const struct fg__projector *projector; /* NULL: projections are not known */
  fg__field_region region; /* that samples are wanted of, where they go on no map */
};

/* For decoders: begin a file with its state, and add what it has, each group before its
 * variables. Texts are copied as UTF-8 (base/utf8.h); pointers are
 * borrowed until the next of their kind is added, and NULL, with the message, where
 * memory lacks. ARGUMENT (one file too many), MEMORY. */
fg_status fg__dataset_begin(fg__dataset *dataset, fg_context *context, const char *path,
                            size_t size, const fg__decoder *decoder);
fg__dimension *fg__dataset_add_dimension(fg__dataset *dataset, const char *name,
                                         size_t length);
fg__variable *fg__dataset_add_variable(fg__dataset *dataset, const char *group,
                                       const char *name);
fg__variable *fg__dataset_add_group(fg__dataset *dataset);
fg_status fg__variable_add_text(fg__variable *variable, const char *name,
                                const char *text, size_t length);
fg_status fg__variable_add_numbers(fg__variable *variable, const char *name,
                                   const double *number, size_t count, bool is_floating);

/* Makes `components` elements of the variable that was added last, or as many as a tensor
 * has. MEMORY. */
fg_status fg__dataset_split(fg__dataset *dataset, int components);

/* Takes over the times that a file has, from which number `wanted` is chosen. ARGUMENT.
 */
fg_status fg__dataset_choose_time(fg__dataset *dataset, const char *path, double *time,
                                  size_t times, int wanted);

void fg__dataset_close(fg__dataset *dataset);

/* topology.c. The points that a piece of a file has, from `first` on. */
typedef struct fg__piece_points {
  size_t first, count;
} fg__piece_points;

/* Adds a cell by the numbers of its points in their piece, and those of the faces of a
 * polyhedron: how many, and of each how many points and which. FILE_FORMAT (no such
 * point, faces that are not within the numbers), UNSUPPORTED (more than INT_MAX corners),
 * MEMORY. */
fg_status fg__topology_add(fg__dataset *dataset, int type, const double *node,
                           size_t nodes, const double *face, size_t numbers,
                           const fg__piece_points *points);

/* The variable of that name (whole, or its last part), or NULL. */
const fg__variable *fg__dataset_find(const fg__dataset *dataset, const char *name);

/* The attributes of a variable's file, and of its group, which may be the file. */
const fg__variable *fg__file_of(const fg__variable *variable);
const fg__variable *fg__group_of(const fg__variable *variable);

bool fg__is_number(const fg__variable *variable);
bool fg__is_floating(const fg__variable *variable);

/* Bytes of a number of a type; of others 1. */
size_t fg__type_bytes(fg__type type);

/* Whether this machine's numbers begin with their lowest byte. */
static inline bool fg__is_little_endian(void)
{
  const unsigned one = 1;
  return *(const unsigned char *)&one == 1;
}

/* The number of a type that begins at some bytes, which may have the other order than
 * this machine's; of others 0. */
double fg__number_of_bytes(fg__type type, const unsigned char *bytes, bool swapped);

/* A text attribute without white space at its ends, cut to the buffer; "" when there is
 * none. Returns whether there is one. */
bool fg__attribute_text(const fg__variable *variable, const char *attribute, char *out,
                        size_t size);

/* The numbers of an attribute, also where they are written as a text, at most `capacity`;
 * returns how many. */
int fg__attribute_numbers(const fg__variable *variable, const char *attribute,
                          double *out, int capacity);

/* The attribute of that name, or NULL. */
const fg__attribute *fg__attribute_find(const fg__variable *variable,
                                        const char *attribute);

/* Numbers of a variable as they are stored; indices along a dimension with a chosen
 * sample count from that. FILE_FORMAT, MEMORY. */
fg_status fg__variable_fetch(const fg__variable *variable, const size_t *start,
                             const size_t *count, double *out);
fg_status fg__variable_fetch_one(const fg__variable *variable, const size_t *index,
                                 double *out);

/* Whether the file has the samples there: some times lack levels that others have. */
bool fg__variable_has(const fg__variable *variable, const size_t *index);

/* Texts along the first dimension of a variable of texts, or of letters with two; indices
 * are the file's. */
fg_status fg__variable_fetch_texts(const fg__variable *variable, size_t first,
                                   size_t count, char *out, size_t size);

/* Whether variables of that one's file have nothing that could be a title. */
bool fg__has_no_titles(const fg__variable *variable);

/* The number of the record that has sample n of a variable. */
size_t fg__variable_record(const fg__variable *variable, size_t n);

/* packing.c. How a variable's samples are packed, and which are missing (CF conventions,
 * chapters 2.5 and 8.1). */
typedef struct fg__packing {
  double scale, offset;
  double fill[FG__MOST_FILLS]; /* in stored values */
  int fills;
  fg__missing_numbers unpacked; /* missing_value of packed data in the unpacked type */
  double least, largest;        /* valid range */
  bool range_unpacked;          /* the range is of unpacked values, not of stored ones */
  double wrap;                  /* added to negative values of _Unsigned data, or 0 */
  const fg__missing_numbers *given;
} fg__packing;

typedef struct fg__missing_counts {
  size_t fill, range, not_a_number; /* samples that are missing, by reason */
} fg__missing_counts;

/* 57.3 of longitudes and latitudes in radians, -1 of degrees west or south, else 1:
 * numbers that are unpacked are in degrees east and north. */
double fg__degrees_per_unit(const fg__variable *v);

fg__packing fg__packing_of(const fg__variable *variable);

/* The value of a stored number, NaN when it is missing. */
double fg__unpack(const fg__packing *packing, double stored, fg__missing_counts *missing);

#endif
