/* VTK files, XML and legacy: what document.c finds in the markup that markup.c parsed, or
 * legacy.c in a legacy file, values.c turns into numbers; fill.c makes a dataset of it,
 * with the cells of cells.c, and fetch.c its numbers. Format: VTK File Formats, Kitware.
 */
#ifndef FG__VTK_H
#define FG__VTK_H

#include "decode/openers.h"

typedef enum fg__vtk_place {
  FG__VTK_POINTS,
  FG__VTK_CELLS,
  FG__VTK_FIELD,
  FG__VTK_COORDINATES
} fg__vtk_place;

typedef enum fg__vtk_storage {
  FG__VTK_ASCII,
  FG__VTK_INLINE,
  FG__VTK_APPENDED,
  FG__VTK_TOKENS, /* a legacy file's text, not ended by a NUL */
  FG__VTK_RAW,    /* a legacy file's bytes, or numbers that were made */
  FG__VTK_HELD    /* elsewhere: `read` of the array reads them */
} fg__vtk_storage;

typedef enum fg__vtk_compression {
  FG__VTK_PLAIN,
  FG__VTK_ZLIB,
  FG__VTK_LZ4,
  FG__VTK_OTHER_COMPRESSION
} fg__vtk_compression;

struct fg__vtk;

/* A DataArray element, or an array of a legacy file. */
typedef struct fg__vtk_array {
  char *name;
  char *units; /* NULL: not said */
  fg__type type;
  int components;
  fg__vtk_place place;
  fg__vtk_storage storage;
  bool no_velocity; /* the file says that it is something else: normals, colours */
  const char *text; /* ascii, inline: what the element holds, ended by a NUL; tokens, raw:
                       where it lies in the file */
  size_t text_size; /* held: how many numbers there are from `offset` on */
  char *joined_text; /* owned, when text lay in several parts; else NULL */
  size_t offset;     /* appended, held: where it begins */
  /* held: reads numbers [first, first + count); what of is `item` */
  fg_status (*read)(double *out, const struct fg__vtk *vtk,
                    const struct fg__vtk_array *array, size_t first, size_t count);
  const void *item;
  bool is_read_whole; /* held: a part takes as long as all */
} fg__vtk_array;

/* Cells that a file lists: each by its points. */
typedef struct fg__vtk_list {
  size_t cells;
  size_t corners, types, ends;        /* arrays that say what these are; types: NONE where
                                         all have one type; ends: NONE where each cell's
                                         corners follow their number */
  size_t corner_numbers, end_numbers; /* of these arrays; 0: as the last end says, as
                                         many as cells */
  int type;                           /* VTK's number of the one type */
  size_t per_cell;                    /* corners of each cell; 0: as above */
  size_t faces, face_ends;            /* of polyhedra; NONE: not there */
  size_t apart[4]; /* the same from VTK 9.4 on: the faces' points, where each face ends,
                      the polyhedra's faces, where each cell ends */
} fg__vtk_list;

/* Of polygonal data: vertices, lines, polygons and strips, in the order of the cells'
 * data; an unstructured grid has one list. */
enum { FG__VTK_LISTS = 4 };

typedef struct fg__vtk_piece {
  int extent[6];
  size_t first_array, array_count; /* of points and cells */
  size_t coordinates;              /* the first of three arrays, on an uneven grid */
  size_t positions;                /* the array of its points, of cells */
  size_t points, cells;            /* of an unstructured grid */
  fg__vtk_list list[FG__VTK_LISTS];
  struct fg__vtk *file; /* that it is in; NULL: in the one that has this */
} fg__vtk_piece;

enum { FG__VTK_TEXT = 256 }; /* bytes of a text in FieldData */

#define FG__VTK_NONE SIZE_MAX

typedef enum fg__vtk_kind {
  FG__VTK_ALONG_AXES = 0,
  FG__VTK_CURVILINEAR,
  FG__VTK_UNSTRUCTURED /* and polygons, and several grids together */
} fg__vtk_kind;

/* Numbers of one array, or some of them in a row. */
typedef struct fg__vtk_values {
  unsigned char *bytes;
  bool swapped; /* their order is not this machine's */
  fg__type type;
  size_t first, count; /* of the array's numbers, tuples * components */
} fg__vtk_values;

typedef struct fg__vtk {
  fg_context *context;
  const char *path;
  size_t file_size;
  void *document; /* libxml2's tree, which texts point into; NULL: a legacy file */
  bool may_have_document_type; /* before it is parsed */
  bool swap;                   /* the file's byte order is not this machine's */
  size_t header_bytes;
  fg__vtk_compression compression;
  char *compressor;
  const unsigned char *appended; /* NULL: none */
  size_t appended_size;
  bool appended_base64;
  fg__vtk_kind kind;
  bool polygons; /* unstructured, and its cells are polygonal data */
  bool merged;   /* several grids: one may lack another's arrays */
  bool turned;   /* a curvilinear grid that is an image whose axes are turned */
  double direction[9];
  int extent[6]; /* first and last point along x, y, z */
  double origin[3], spacing[3];
  bool uneven;           /* each piece has its coordinates */
  double *coordinate[3]; /* of an uneven grid, from the first point of extent on */
  fg__vtk_piece *pieces;
  size_t piece_count, piece_capacity;
  fg__vtk_array *arrays;
  size_t array_count, array_capacity; /* FieldData's first, then the pieces' */
  size_t field_array_count;
  void *held; /* what its held arrays are in, and the end of that */
  void (*close_held)(void *held);
  struct fg__vtk_file *files; /* that this one names, and whose pieces it has */
  size_t file_count, file_capacity;
  char *vectors[2]; /* the Vectors attribute of the points' and of the cells' data */
  bool exhausted;   /* memory for what the markup says was lacking; the context says so */
  fg__vtk_values kept; /* the numbers that were fetched last, */
  const fg__vtk_array *kept_of;
  const char *checked; /* and which array was found to be in all pieces */
  fg__vtk_place checked_at;
} fg__vtk;

/* Parses the markup into `document` and finds the appended data. */
fg_status fg__vtk_parse(fg__vtk *vtk, const fg__source *source);

/* Begin a file of a dataset, and when it has been taken apart make that of it.
 * FILE_FORMAT, UNSUPPORTED, MEMORY. */
fg_status fg__vtk_begin(fg__vtk **out, fg__dataset *data, fg_context *context,
                        const fg__source *source);
fg_status fg__vtk_fill(fg__dataset *data, fg__vtk *vtk);

/* Takes a legacy file apart, into a state that is otherwise empty. */
fg_status fg__vtk_read_legacy(fg__vtk *vtk, const fg__source *source);

/* A file that another one names. */
typedef struct fg__vtk_file {
  char *path;
  fg__source source;
  fg__vtk *vtk;
} fg__vtk_file;

/* The file that a piece is in. */
static inline const fg__vtk *fg__vtk_home(const fg__vtk *vtk, size_t piece)
{
  const fg__vtk *file = piece < vtk->piece_count ? vtk->pieces[piece].file : NULL;
  return file ? file : vtk;
}

/* Returns `status`, or fg__source_check of the files that it names. */
fg_status fg__vtk_check(const fg__vtk *vtk, fg_status status);
void fg__vtk_close(fg__vtk *vtk);

/* Adds an array of one component and unknown type, named by a copy of `name`. *out is
 * borrowed until the next is added. */
fg_status fg__vtk_add_array(fg__vtk_array **out, fg__vtk *vtk, const char *name,
                            fg__vtk_place place);

/* Adds a piece. Its arrays are those added from now on, until its array_count is set;
 * UNSUPPORTED when those are more than any program writes. */
fg_status fg__vtk_add_piece(fg__vtk *vtk, const int extent[6]);
fg_status fg__vtk_end_piece(fg__vtk *vtk);

/* axes.c. Reads an uneven grid's coordinates from its pieces. */
fg_status fg__vtk_read_coordinates(fg__vtk *vtk);

/* Points or cells of a piece; false as for fg__vtk_count. */
bool fg__vtk_tuples(size_t *count, const fg__vtk *vtk, const fg__vtk_piece *piece,
                    fg__vtk_place place);

/* cells.c. Reads points and cells into the dataset's topology; but a curvilinear grid
 * whose lines are along the axes becomes an uneven one. */
fg_status fg__vtk_read_cells(fg__dataset *data, fg__vtk *vtk);

/* fetch.c. The decoder's function. */
fg_status fg__vtk_fetch(const fg__variable *variable, const size_t *start,
                        const size_t *count, double *out);

/* A point's coordinate along an axis; i counts from the first of extent. */
double fg__vtk_coordinate(const fg__vtk *vtk, int axis, size_t i);

/* The array of this name; NULL when there is none. */
const fg__vtk_array *fg__vtk_find(const fg__vtk *vtk, size_t piece, fg__vtk_place place,
                                  const char *name);

/* Points or cells of an extent along an axis; a flat axis has one cell. */
size_t fg__vtk_length(const int extent[6], int axis, fg__vtk_place place);

/* Their product; false when it does not fit an int: no field is that large. */
bool fg__vtk_count(size_t *count, const int extent[6], fg__vtk_place place);

/* Whether an extent lies in another. */
bool fg__vtk_is_within(const int inner[6], const int outer[6]);

/* Pieces too small for the whole are refused before anything is allocated for it. They
 * may overlap: VTK writes the whole in every piece when its source cannot be divided. */
fg_status fg__vtk_check_pieces(const fg__vtk *vtk);

/* Checks that the file holds `tuples` tuples of the array, without allocating: what it
 * promises against what there is. *stored becomes the bytes they take in the file. */
fg_status fg__vtk_values_check(const fg__vtk *vtk, const fg__vtk_array *array,
                               size_t tuples, size_t *stored);

/* Whether reading a part of an array takes as long as reading all: of text. */
bool fg__vtk_is_read_whole(const fg__vtk_array *array);

/* How many numbers a binary array has by its own account. */
fg_status fg__vtk_values_count(size_t *out, const fg__vtk *vtk,
                               const fg__vtk_array *array);

/* A size before binary data, of vtk->header_bytes bytes. */
uint64_t fg__vtk_size(const fg__vtk *vtk, const unsigned char *bytes);

/* Decodes an array; checks as above first. */
fg_status fg__vtk_values_create(fg__vtk_values *out, const fg__vtk *vtk,
                                const fg__vtk_array *array, size_t tuples);

/* The same, and keeps tuples [first, end) alone. Of binary arrays only the blocks that
 * hold them are decoded; text is read through. */
fg_status fg__vtk_values_create_some(fg__vtk_values *out, const fg__vtk *vtk,
                                     const fg__vtk_array *array, size_t tuples,
                                     size_t first, size_t end);
void fg__vtk_values_clear(fg__vtk_values *values);

/* All numbers of an array. */
fg_status fg__vtk_read_numbers(double *out, const fg__vtk *vtk,
                               const fg__vtk_array *array, size_t tuples);

/* text.c. Reads an array of `all` numbers in text and keeps what out has room for. */
fg_status fg__vtk_values_from_text(fg__vtk_values *out, const fg__vtk *vtk,
                                   const fg__vtk_array *array, size_t all);

/* words.c. Makes attributes of what FieldData tells: of the file, or of axes. */
fg_status fg__vtk_add_words(fg__dataset *data, const fg__vtk *vtk);

/* Number `index` of the array; it must have been kept. */
double fg__vtk_value(const fg__vtk_values *values, size_t index);

#endif
