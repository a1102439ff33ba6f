/* The vector that is meant by variables with names, dimensions and attributes, as xarray
 * and the CF conventions have them: for programs that read files themselves. The rules
 * are those of fg_field_read. */
#ifndef FLOWGRAIN_DATASET_H
#define FLOWGRAIN_DATASET_H

#include "flowgrain/field.h"

#ifdef __cplusplus
extern "C" {
#endif

enum { FG_MOST_DIMENSIONS = 8 };

typedef struct fg_attribute {
  const char *name;
  const char *text;     /* NULL: it is of numbers */
  const double *number; /* [count] */
  size_t count;
} fg_attribute;

typedef struct fg_variable {
  const char *name;
  int rank; /* FG_MOST_DIMENSIONS at most */
  const char *dimension[FG_MOST_DIMENSIONS];
  size_t length[FG_MOST_DIMENSIONS];
  bool is_number; /* else text */
  const fg_attribute *attribute;
  size_t attributes;
} fg_variable;

typedef struct fg_variables {
  const char *name; /* of the whole, before messages */
  const fg_variable *variable;
  size_t count;
  /* Gives the numbers from start[k] on, count[k] along each dimension, the last one
   * fastest. False: it cannot. */
  bool (*fetch)(void *user, size_t variable, const size_t *start, const size_t *count,
                double *out);
  void *user;
} fg_variables;

/* Numbers of variables; -1: none. */
typedef struct fg_vector_meaning {
  int component[3];
  int coordinate[2]; /* along x and y, of one dimension or two; -1: samples are counted */
  bool is_polar;     /* components are a speed and its direction */
  int mask;          /* of a model's grid: zero on land */
  bool is_geographic; /* coordinates are longitude and latitude */
  bool is_along_grid; /* components of a grid with coordinates in two dimensions */
  int side[2];      /* of components on the faces of cells, along x and y: -1, face n lies
                       before centre n; 1, behind it; 0: they are not */
  char doubts[512]; /* what is unsure, a line each */
} fg_vector_meaning;

/* Finds the vector that options name, or the only one of the best rank. options: NULL for
 * none. Dimensions that are neither time nor level, such as members, are the caller's.
 * ARGUMENT (no such vector, or several), UNSUPPORTED (also points and unstructured
 * meshes), FILE_ACCESS (what cannot be fetched), MEMORY. */
FG_API fg_status fg_vector_find(fg_vector_meaning *out, fg_context *context,
                                const fg_variables *variables,
                                const fg_read_options *options);

#ifdef __cplusplus
}
#endif

#endif
