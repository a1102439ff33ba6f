/* Legacy VTK files: what their lines say. */
#include "base/memory.h"
#include "decode/vtk/legacy_scan.h"

#include <ctype.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* More than any program writes. */
enum { MOST_ARRAYS = 1000 };

typedef struct legacy_file {
  fg__vtk *vtk;
  fg__legacy_cursor cursor;
  bool sized, in_piece, polygons;
  fg__vtk_place place; /* of the section that is read */
  size_t tuples;       /* of each of its arrays */
  int named_vectors[2];
} legacy_file;

/* In names of files of version 3 and later %20 is a space. */
static void decode_name(char *name)
{
  char *out = name;
  for (const char *in = name; *in; ++in) {
    unsigned code;
    if (*in == '%' && isxdigit((unsigned char)in[1]) && isxdigit((unsigned char)in[2]) &&
        sscanf(in + 1, "%2x", &code) == 1 && code != 0) {
      *out++ = (char)code;
      in += 2;
    } else {
      *out++ = *in;
    }
  }
  *out = '\0';
}

/* Adds an array and takes its numbers, from the next line on. */
static fg_status add_array(legacy_file *file, fg__vtk_array **out, char *name,
                           const char *type, int components, size_t tuples)
{
  if (file->vtk->array_count == MOST_ARRAYS)
    return fg__fail(file->cursor.context, FG_STATUS_UNSUPPORTED,
                    "%s: more than %d arrays", file->cursor.path, MOST_ARRAYS);
  decode_name(name);
  fg_status status = fg__vtk_add_array(out, file->vtk, name, file->place);
  if (status != FG_STATUS_OK)
    return status;
  (*out)->components = components;
  if (tuples > SIZE_MAX / 8 / (size_t)components)
    return fg__legacy_fail(&file->cursor, "sizes overflow in array", name);
  return fg__legacy_take(&file->cursor, *out, type, tuples * (size_t)components);
}

static fg_status read_word(fg__legacy_cursor *c, char word[FG__LEGACY_WORD],
                           const char *what, const char *after)
{
  return fg__legacy_word(c, word) ? FG_STATUS_OK : fg__legacy_fail(c, what, after);
}

/* The first vectors are the active ones, as VTK has it; several may be meant. */
static fg_status mark_vectors(legacy_file *file, const char *name)
{
  char **active = &file->vtk->vectors[file->place];
  free(*active);
  *active = NULL;
  if (file->named_vectors[file->place]++ > 0)
    return FG_STATUS_OK;
  *active = fg__copy_text(name);
  return *active
             ? FG_STATUS_OK
             : fg__fail_memory(file->cursor.context, "an array's name", strlen(name) + 1);
}

/* A number of components may stand in the line; then in most files comes a line that
 * names a table of colours. */
static fg_status read_rest_of_scalars(fg__legacy_cursor *c, int *components)
{
  char word[FG__LEGACY_WORD];
  fg_status status = FG_STATUS_OK;
  if (fg__legacy_word_of_line(c, word)) {
    c->at -= strlen(word);
    status = fg__legacy_whole(c, components, 1, "a number of components");
  }
  fg__legacy_cursor ahead = *c;
  fg__legacy_skip_line(&ahead);
  if (fg__legacy_word_of_line(&ahead, word) && fg__legacy_is(word, "LOOKUP_TABLE"))
    *c = ahead;
  return status;
}

typedef enum attribute_kind {
  SCALARS,
  VECTORS,
  OTHER,
  COLORS,
  COLOR_TABLE
} attribute_kind;

/* What is said of points or cells. Words: the array's name, then its type (t) and a
 * number of components (c) in this order; without a type they are colours, in binary
 * bytes. */
static const struct {
  const char *keyword, *words;
  int components;
  attribute_kind kind;
} ATTRIBUTES[] = {{"SCALARS", "t", 1, SCALARS},
                  {"VECTORS", "t", 3, VECTORS},
                  {"NORMALS", "t", 3, OTHER},
                  {"TENSORS", "t", 9, OTHER},
                  {"TENSORS6", "t", 6, OTHER},
                  {"GLOBAL_IDS", "t", 1, OTHER},
                  {"PEDIGREE_IDS", "t", 1, OTHER},
                  {"EDGE_FLAGS", "t", 1, OTHER},
                  {"TEXTURE_COORDINATES", "ct", 0, OTHER},
                  {"COLOR_SCALARS", "c", 0, COLORS},
                  {"LOOKUP_TABLE", "c", 0, COLOR_TABLE}};

static fg_status read_attribute_of(legacy_file *file, size_t n)
{
  fg__legacy_cursor *c = &file->cursor;
  char name[FG__LEGACY_WORD], type[FG__LEGACY_WORD] = "float";
  const attribute_kind kind = ATTRIBUTES[n].kind;
  int components = ATTRIBUTES[n].components;
  size_t tuples = file->tuples;
  fg__vtk_array *array = NULL;
  fg_status status = read_word(c, name, "no name after", ATTRIBUTES[n].keyword);
  if (c->binary)
    strcpy(type, "unsigned_char");
  for (const char *w = ATTRIBUTES[n].words; *w && status == FG_STATUS_OK; ++w)
    status = *w == 't' ? read_word(c, type, "no type of array", name)
                       : fg__legacy_whole(c, &components, 1,
                                          "a number of components or colours");
  if (status == FG_STATUS_OK && kind == SCALARS)
    status = read_rest_of_scalars(c, &components);
  if (kind == COLOR_TABLE) { /* colours of four numbers each */
    tuples = (size_t)components;
    components = 4;
  }
  if (status == FG_STATUS_OK)
    status = add_array(file, &array, name, type, components, tuples);
  if (status != FG_STATUS_OK)
    return status;
  array->no_velocity = kind >= OTHER;
  return kind == VECTORS ? mark_vectors(file, array->name) : FG_STATUS_OK;
}

/* COMPONENTS TUPLES TYPE, after a name. */
static fg_status read_field_array(legacy_file *file, char *name)
{
  fg__legacy_cursor *c = &file->cursor;
  char type[FG__LEGACY_WORD];
  int components = 0, tuples = 0;
  fg__vtk_array *array;
  fg_status status = fg__legacy_whole(c, &components, 0, "a number of components");
  if (status == FG_STATUS_OK)
    status = fg__legacy_whole(c, &tuples, 0, "a number of tuples");
  if (status == FG_STATUS_OK)
    status = read_word(c, type, "no type of array", name);
  if (status == FG_STATUS_OK)
    status = add_array(file, &array, name, type, components > 0 ? components : 1,
                       components > 0 ? (size_t)tuples : 0);
  return status;
}

/* FIELD NAME COUNT, then arrays. */
static fg_status read_field_block(legacy_file *file)
{
  fg__legacy_cursor *c = &file->cursor;
  char name[FG__LEGACY_WORD];
  int arrays = 0;
  fg_status status = read_word(c, name, "no name after", "FIELD");
  if (status == FG_STATUS_OK)
    status = fg__legacy_whole(c, &arrays, 0, "a number of arrays");
  for (int i = 0; i < arrays && status == FG_STATUS_OK; ++i) {
    if (!fg__legacy_word(c, name))
      return fg__legacy_fail(c, "no name of an array after", name);
    if (!fg__legacy_is(name, "NULL_ARRAY"))
      status = read_field_array(file, name);
  }
  return status;
}

static fg_status read_dimensions(legacy_file *file)
{
  fg__vtk *vtk = file->vtk;
  for (int k = 0; k < 3; ++k) {
    int count = 0;
    fg_status status = fg__legacy_whole(&file->cursor, &count, 1, "a number of points");
    if (status != FG_STATUS_OK)
      return status;
    vtk->extent[2 * k] = 0;
    vtk->extent[2 * k + 1] = count - 1;
  }
  size_t points;
  if (!fg__vtk_count(&points, vtk->extent, FG__VTK_POINTS)) {
    fg__fail(vtk->context, FG_STATUS_FILE_FORMAT, "%s: DIMENSIONS %d x %d x %d",
             vtk->path, vtk->extent[1] + 1, vtk->extent[3] + 1, vtk->extent[5] + 1);
    fg__hint(vtk->context, "at most %d points can be read", INT_MAX);
    return FG_STATUS_FILE_FORMAT;
  }
  file->sized = true;
  return FG_STATUS_OK;
}

static fg_status read_triple(legacy_file *file, double out[3], const char *what)
{
  fg_status status = FG_STATUS_OK;
  for (int k = 0; k < 3 && status == FG_STATUS_OK; ++k)
    status = fg__legacy_number(&file->cursor, &out[k], what);
  return status;
}

/* X_COORDINATES COUNT TYPE, then y's, then z's. */
static fg_status read_coordinates(legacy_file *file)
{
  static const char *const keyword[] = {"X_COORDINATES", "Y_COORDINATES",
                                        "Z_COORDINATES"};
  fg__legacy_cursor *c = &file->cursor;
  char word[FG__LEGACY_WORD];
  for (int k = 0; k < 3; ++k) {
    const int points = file->vtk->extent[2 * k + 1] + 1;
    int count = 0;
    if (!fg__legacy_word(c, word) || !fg__legacy_is(word, keyword[k]))
      return fg__legacy_fail(c, "no coordinates but", word);
    fg_status status = fg__legacy_whole(c, &count, 1, "a number of coordinates");
    if (status != FG_STATUS_OK)
      return status;
    if (count != points)
      return fg__fail(c->context, FG_STATUS_FILE_FORMAT,
                      "%s: %d coordinates along %c for %d points", c->path, count,
                      "xyz"[k], points);
    status = read_word(c, word, "no type of array", keyword[k]);
    if (status != FG_STATUS_OK)
      return status;
    char name[] = "coordinates";
    fg__vtk_array *array;
    file->place = FG__VTK_COORDINATES;
    status = add_array(file, &array, name, word, 1, (size_t)count);
    if (status != FG_STATUS_OK)
      return status;
  }
  return FG_STATUS_OK;
}

/* DIMENSIONS, and then what makes them a grid, in any order for images. */
static fg_status read_geometry_line(legacy_file *file, const char *keyword, bool *known)
{
  fg__vtk *vtk = file->vtk;
  *known = true;
  if (fg__legacy_is(keyword, "DIMENSIONS") && !file->sized)
    return read_dimensions(file);
  if (fg__legacy_is(keyword, "ORIGIN"))
    return read_triple(file, vtk->origin, "an origin");
  if (fg__legacy_is(keyword, "SPACING") || fg__legacy_is(keyword, "ASPECT_RATIO"))
    return read_triple(file, vtk->spacing, "a spacing");
  if (vtk->uneven && file->sized && vtk->piece_count == 0 &&
      fg__legacy_is(keyword, "X_COORDINATES")) {
    size_t first = vtk->array_count;
    vtk->field_array_count = first;
    file->cursor.at -= strlen(keyword);
    fg_status status = read_coordinates(file);
    if (status == FG_STATUS_OK)
      status = fg__vtk_add_piece(vtk, vtk->extent);
    if (status == FG_STATUS_OK)
      vtk->pieces[0].coordinates = first;
    return status;
  }
  if (vtk->kind != FG__VTK_ALONG_AXES && vtk->piece_count == 0 &&
      (file->sized || vtk->kind == FG__VTK_UNSTRUCTURED) &&
      fg__legacy_is(keyword, "POINTS"))
    return fg__legacy_points(vtk, &file->cursor);
  if (vtk->kind == FG__VTK_UNSTRUCTURED && vtk->piece_count > 0)
    return fg__legacy_cells_line(vtk, &file->cursor, file->polygons, keyword, known);
  *known = false;
  return FG_STATUS_OK;
}

/* The piece that its points have begun is to have all else, too. */
static fg_status begin_piece_of_cells(legacy_file *file)
{
  fg__vtk *vtk = file->vtk;
  fg__vtk_piece *piece = vtk->piece_count > 0 ? &vtk->pieces[0] : NULL;
  const bool listed = vtk->kind == FG__VTK_UNSTRUCTURED && !file->polygons;
  const fg__vtk_list *list = piece ? &piece->list[0] : NULL;
  if (!list || (listed && (list->corners == FG__VTK_NONE || list->types == FG__VTK_NONE)))
    return fg__fail(vtk->context, FG_STATUS_FILE_FORMAT, "%s: has no %s", vtk->path,
                    !list                           ? "POINTS"
                    : list->corners == FG__VTK_NONE ? "CELLS"
                                                    : "CELL_TYPES");
  piece->first_array = vtk->array_count;
  file->in_piece = true;
  return FG_STATUS_OK;
}

/* The piece is begun by the coordinates or, for an image, here. */
static fg_status begin_piece(legacy_file *file)
{
  fg__vtk *vtk = file->vtk;
  if (vtk->kind != FG__VTK_ALONG_AXES)
    return begin_piece_of_cells(file);
  if (vtk->piece_count == 0) {
    if (!file->sized || vtk->uneven)
      return fg__fail(vtk->context, FG_STATUS_FILE_FORMAT, "%s: has no %s", vtk->path,
                      file->sized ? "X_COORDINATES" : "DIMENSIONS");
    vtk->field_array_count = vtk->array_count;
    for (int k = 0; k < 3; ++k)
      if (!(vtk->spacing[k] > 0.0) && vtk->extent[2 * k + 1] > 0)
        return fg__fail(vtk->context, FG_STATUS_FILE_FORMAT,
                        "%s: SPACING %g %g %g is not positive", vtk->path,
                        vtk->spacing[0], vtk->spacing[1], vtk->spacing[2]);
    fg_status status = fg__vtk_add_piece(vtk, vtk->extent);
    if (status != FG_STATUS_OK)
      return status;
  }
  file->in_piece = true;
  return FG_STATUS_OK;
}

/* POINT_DATA or CELL_DATA and how many there are. */
static fg_status begin_section(legacy_file *file, fg__vtk_place place)
{
  int count = 0;
  size_t expected = 0;
  fg_status status =
      fg__legacy_whole(&file->cursor, &count, 0, "a number of points or cells");
  if (status == FG_STATUS_OK && !file->in_piece)
    status = begin_piece(file);
  if (status != FG_STATUS_OK)
    return status;
  fg__vtk_tuples(&expected, file->vtk, &file->vtk->pieces[0], place);
  if ((size_t)count != expected)
    return fg__fail(file->cursor.context, FG_STATUS_FILE_FORMAT,
                    "%s: %s_DATA of %d where the grid has %zu", file->cursor.path,
                    place == FG__VTK_POINTS ? "POINT" : "CELL", count, expected);
  file->place = place;
  file->tuples = expected;
  return FG_STATUS_OK;
}

static fg_status read_attribute(legacy_file *file, const char *keyword)
{
  for (size_t n = 0; n < sizeof ATTRIBUTES / sizeof *ATTRIBUTES; ++n)
    if (fg__legacy_is(keyword, ATTRIBUTES[n].keyword))
      return read_attribute_of(file, n);
  return fg__legacy_fail(&file->cursor, "an unknown keyword", keyword);
}

static fg_status read_section(legacy_file *file, const char *keyword)
{
  bool known = false;
  fg_status status = FG_STATUS_OK;
  if (fg__legacy_is(keyword, "FIELD"))
    return read_field_block(file);
  if (fg__legacy_is(keyword, "POINT_DATA"))
    return begin_section(file, FG__VTK_POINTS);
  if (fg__legacy_is(keyword, "CELL_DATA"))
    return begin_section(file, FG__VTK_CELLS);
  if (!file->in_piece)
    status = read_geometry_line(file, keyword, &known);
  if (status != FG_STATUS_OK || known)
    return status;
  if (!file->in_piece)
    return fg__legacy_fail(&file->cursor, "before POINT_DATA or CELL_DATA comes",
                           keyword);
  return read_attribute(file, keyword);
}

static fg_status read_sections(legacy_file *file)
{
  char keyword[FG__LEGACY_WORD];
  fg_status status = FG_STATUS_OK;
  while (status == FG_STATUS_OK && fg__legacy_word(&file->cursor, keyword))
    status = read_section(file, keyword);
  if (status == FG_STATUS_OK && file->cursor.at < file->cursor.size)
    status = fg__legacy_fail(&file->cursor, "a word too long:", keyword);
  if (status == FG_STATUS_OK && !file->in_piece)
    status = begin_piece(file);
  return status == FG_STATUS_OK ? fg__vtk_end_piece(file->vtk) : status;
}

static fg_status fail_dataset(const fg__vtk *vtk, const char *kind)
{
  fg__fail(vtk->context, FG_STATUS_UNSUPPORTED,
           "%s: a legacy VTK file of a %.40s; only STRUCTURED_POINTS, RECTILINEAR_GRID, "
           "STRUCTURED_GRID, UNSTRUCTURED_GRID and POLYDATA can be read",
           vtk->path, kind);
  fg__hint(vtk->context, "%s", FG__RESAMPLE);
  return FG_STATUS_UNSUPPORTED;
}

/* Three lines: the mark, a title, ASCII or BINARY; then DATASET and its kind. */
static fg_status read_header(legacy_file *file)
{
  fg__legacy_cursor *c = &file->cursor;
  char word[FG__LEGACY_WORD];
  fg__legacy_skip_line(c);
  fg__legacy_skip_line(c);
  bool known = fg__legacy_word(c, word);
  c->binary = fg__legacy_is(word, "BINARY");
  if (!known || (!c->binary && !fg__legacy_is(word, "ASCII")))
    return fg__legacy_fail(c, "neither ASCII nor BINARY but", word);
  if (!fg__legacy_word(c, word) || !fg__legacy_is(word, "DATASET"))
    return fg__legacy_fail(c, "no DATASET but", word);
  if (!fg__legacy_word(c, word))
    return fg__legacy_fail(c, "no kind of DATASET but", word);
  file->vtk->uneven = fg__legacy_is(word, "RECTILINEAR_GRID");
  file->polygons = fg__legacy_is(word, "POLYDATA");
  if (fg__legacy_is(word, "STRUCTURED_GRID"))
    file->vtk->kind = FG__VTK_CURVILINEAR;
  else if (fg__legacy_is(word, "UNSTRUCTURED_GRID") || file->polygons)
    file->vtk->kind = FG__VTK_UNSTRUCTURED;
  else if (!file->vtk->uneven && !fg__legacy_is(word, "STRUCTURED_POINTS"))
    return fail_dataset(file->vtk, word);
  return FG_STATUS_OK;
}

fg_status fg__vtk_read_legacy(fg__vtk *vtk, const fg__source *source)
{
  vtk->swap = fg__is_little_endian(); /* files are big-endian */
  for (int k = 0; k < 3; ++k)
    vtk->spacing[k] = 1.0;
  legacy_file file = {.vtk = vtk,
                      .cursor = {.context = vtk->context,
                                 .path = vtk->path,
                                 .bytes = (const char *)source->bytes,
                                 .size = source->size},
                      .place = FG__VTK_FIELD};
  const fg_status status = read_header(&file);
  return status == FG_STATUS_OK ? read_sections(&file) : status;
}

fg_status fg__vtk_open_legacy(fg__dataset *data, fg_context *context,
                              const fg__source *source, const fg_read_options *options)
{
  fg__vtk *vtk = NULL;
  fg_status status = fg__vtk_begin(&vtk, data, context, source);
  (void)options;
  if (status == FG_STATUS_OK)
    status = fg__vtk_read_legacy(vtk, source);
  return status == FG_STATUS_OK ? fg__vtk_fill(data, vtk) : status;
}
