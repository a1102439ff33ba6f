/* A VTK XML image data file, taken apart: what vti_document.c finds in the markup
 * that vti_markup.c parsed, vti_values.c turns into numbers, vti_choice.c picks vectors
 * from, and vti_plane.c brings onto the points of a plane. Format: VTK File Formats,
 * Kitware, "XML File Formats". */
#ifndef FG__VTI_H
#define FG__VTI_H

#include "format/format.h"

typedef enum fg__vti_type {
  FG__VTI_UNKNOWN = 0, /* String, Bit, ... */
  FG__VTI_INT8,
  FG__VTI_UINT8,
  FG__VTI_INT16,
  FG__VTI_UINT16,
  FG__VTI_INT32,
  FG__VTI_UINT32,
  FG__VTI_INT64,
  FG__VTI_UINT64,
  FG__VTI_FLOAT32,
  FG__VTI_FLOAT64
} fg__vti_type;

typedef enum fg__vti_place { FG__VTI_POINTS, FG__VTI_CELLS, FG__VTI_FIELD } fg__vti_place;

typedef enum fg__vti_storage {
  FG__VTI_ASCII,
  FG__VTI_INLINE,
  FG__VTI_APPENDED
} fg__vti_storage;

typedef enum fg__vti_compression {
  FG__VTI_PLAIN,
  FG__VTI_ZLIB,
  FG__VTI_OTHER_COMPRESSION
} fg__vti_compression;

/* A DataArray element. */
typedef struct fg__vti_array {
  char *name;
  char *units; /* NULL: not said */
  fg__vti_type type;
  int components;
  fg__vti_place place;
  fg__vti_storage storage;
  const char *text; /* ascii, inline: what the element holds, ended by a NUL */
  size_t text_size;
  char *joined_text; /* owned, when text lay in several parts; else NULL */
  size_t offset;     /* appended: where it begins */
} fg__vti_array;

typedef struct fg__vti_piece {
  int extent[6];
  size_t first_array, array_count;
} fg__vti_piece;

typedef struct fg__vti {
  fg_context *context;
  const char *path;
  size_t file_size;
  void *document; /* libxml2's tree, which texts point into */
  bool swap;      /* the file's byte order is not this machine's */
  size_t header_bytes;
  fg__vti_compression compression;
  char *compressor;
  const unsigned char *appended; /* NULL: none */
  size_t appended_size;
  bool appended_base64;
  int extent[6]; /* first and last point along x, y, z */
  double origin[3], spacing[3];
  fg__vti_piece *pieces;
  size_t piece_count, piece_capacity;
  fg__vti_array *arrays;
  size_t array_count, array_capacity; /* FieldData's first, then the pieces' */
  size_t field_array_count;
  char *vectors[2]; /* the Vectors attribute of the points' and of the cells' data */
} fg__vti;

/* Parses the markup into `document` and finds the appended data. */
fg_status fg__vti_parse(fg__vti *vti, const fg__source *source);

/* Reads what the markup says. The result is to be closed even after a failure. */
fg_status fg__vti_open(fg__vti *out, fg_context *context, const fg__source *source);
void fg__vti_close(fg__vti *vti);

/* The array of this name; NULL when there is none. */
const fg__vti_array *fg__vti_find(const fg__vti *vti, size_t piece, fg__vti_place place,
                                  const char *name);

/* Points or cells of an extent along an axis; a flat axis has one cell. */
size_t fg__vti_length(const int extent[6], int axis, fg__vti_place place);

/* Their product; false when it does not fit an int: no field is that large. */
bool fg__vti_count(size_t *count, const int extent[6], fg__vti_place place);

/* Numbers of one array in this machine's byte order. */
typedef struct fg__vti_values {
  unsigned char *bytes;
  fg__vti_type type;
  size_t count; /* tuples * components */
} fg__vti_values;

/* Checks that the file holds `tuples` tuples of the array, without allocating: what it
 * promises against what there is. *stored becomes the bytes they take in the file. */
fg_status fg__vti_values_check(const fg__vti *vti, const fg__vti_array *array,
                               size_t tuples, size_t *stored);

/* Decodes an array; checks as above first. */
fg_status fg__vti_values_create(fg__vti_values *out, const fg__vti *vti,
                                const fg__vti_array *array, size_t tuples);
void fg__vti_values_clear(fg__vti_values *values);
double fg__vti_value(const fg__vti_values *values, size_t index);

/* A vector: one array of 2 or 3 components, or 2 or 3 arrays of one. Names are borrowed.
 */
typedef struct fg__vti_vector {
  const char *name[3];
  int names;
  int components;
  fg__vti_place place;
  const char *found_by;
  const char *units;
} fg__vti_vector;

/* Lists every vector that could be meant. End *out with free. */
fg_status fg__vti_vectors(fg__vti_vector **out, size_t *count, const fg__vti *vti);

/* Fails for a name that no array has; the hint lists those there are. */
fg_status fg__vti_fail_unknown(const fg__vti *vti, const char *name);

/* Picks the vector that vars names, or the only one that can be meant when it is NULL.
 * The names live as long as *names_storage, to be freed, and vti. */
fg_status fg__vti_choose(fg__vti_vector *out, char **names_storage, const fg__vti *vti,
                         const char *vars);

/* The plane that an image lies in. */
typedef struct fg__vti_plane {
  int axis[2]; /* the file's axes that span it, ascending */
  int flat;    /* the remaining one: one or two points thick */
  size_t points[2];
} fg__vti_plane;

/* Finds the plane; UNSUPPORTED for a line or a volume. */
fg_status fg__vti_plane_find(fg__vti_plane *out, const fg__vti *vti);

/* Brings both components of a vector in the plane onto its points: a mean over two layers
 * of points, a mean over the cells round a point (VTK's CellDataToPointData); NaN where
 * anything that goes into it is missing, hidden (vtkGhostType, vtkValidPointMask), or not
 * positive in the array `mask` (a vector: zero), which may be NULL. End them with free.
 */
fg_status fg__vti_plane_read(float *out[2], const fg__vti *vti,
                             const fg__vti_plane *plane, const fg__vti_vector *vector,
                             const char *mask);

#endif
