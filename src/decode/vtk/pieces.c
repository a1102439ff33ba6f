/* The pieces of a VTK XML grid, and the arrays in them. */
#include "base/memory.h"
#include "decode/vtk/document.h"
#include "file/number_text.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

static fg__type type_of(const char *name)
{
  static const char *const names[] = {"Int8",   "UInt8", "Int16",  "UInt16",  "Int32",
                                      "UInt32", "Int64", "UInt64", "Float32", "Float64"};
  for (int i = 0; name && i <= FG__TYPE_FLOAT64 - FG__TYPE_INT8; ++i)
    if (strcmp(names[i], name) == 0)
      return (fg__type)(FG__TYPE_INT8 + i);
  return name && strcmp(name, "String") == 0 ? FG__TYPE_TEXTS : FG__TYPE_OTHER;
}

static bool is_blank_text(const xmlNode *node)
{
  const char *text = (const char *)node->content;
  return !text || text[strspn(text, " \t\r\n")] == '\0';
}

static bool holds_text(const xmlNode *node)
{
  return (node->type == XML_TEXT_NODE || node->type == XML_CDATA_SECTION_NODE) &&
         !is_blank_text(node);
}

/* Other elements may stand among the text; mostly one part holds it all and is borrowed.
 */
static bool find_text(fg__vtk_array *array, const xmlNode *node)
{
  size_t parts = 0;
  array->text = "";
  for (const xmlNode *child = node->children; child; child = child->next)
    if (holds_text(child)) {
      ++parts;
      array->text = (const char *)child->content;
      array->text_size += strlen(array->text);
    }
  if (parts <= 1)
    return true;
  array->joined_text = fg__allocate(array->text_size + 1, 1);
  if (!array->joined_text)
    return false;
  size_t at = 0;
  for (const xmlNode *child = node->children; child; child = child->next)
    if (holds_text(child)) {
      size_t length = strlen((const char *)child->content);
      memcpy(array->joined_text + at, child->content, length);
      at += length;
    }
  array->text = array->joined_text;
  return true;
}

static char *find_units(fg__vtk *vtk, const xmlNode *node)
{
  for (const xmlNode *child = node->children; child; child = child->next)
    if (fg__vtk_is_element(child, "InformationKey") &&
        fg__vtk_attribute_is(vtk, child, "name", "UNITS_LABEL"))
      return fg__vtk_content(vtk, child);
  return NULL;
}

static fg_status read_storage(fg__vtk *vtk, fg__vtk_array *array, const xmlNode *node)
{
  char *format = fg__vtk_attribute(vtk, node, "format");
  bool known = true;
  if (!format || strcmp(format, "ascii") == 0)
    array->storage = FG__VTK_ASCII;
  else if (strcmp(format, "binary") == 0)
    array->storage = FG__VTK_INLINE;
  else if (strcmp(format, "appended") == 0)
    array->storage = FG__VTK_APPENDED;
  else
    known = false;
  free(format);
  if (!known)
    return fg__vtk_bad_attribute(vtk, node, "format");
  if (array->storage != FG__VTK_APPENDED)
    return find_text(array, node)
               ? FG_STATUS_OK
               : fg__fail_memory(vtk->context, "an array's text", array->text_size);
  char *text = fg__vtk_attribute(vtk, node, "offset");
  char *end = text;
  errno = 0;
  unsigned long long offset = text ? strtoull(text, &end, 10) : 0;
  bool good = end != text && *end == '\0' && errno == 0 && !strchr(text, '-') &&
              offset <= SIZE_MAX;
  free(text);
  array->offset = (size_t)offset;
  return good ? FG_STATUS_OK : fg__vtk_bad_attribute(vtk, node, "offset");
}

static fg_status read_array(fg__vtk *vtk, const xmlNode *node, fg__vtk_place place)
{
  fg__vtk_array *array = NULL;
  char *name = fg__vtk_attribute(vtk, node, "Name");
  /* for messages: points need no name of their own */
  const char *unnamed =
      place == FG__VTK_COORDINATES ? (const char *)node->parent->name : "";
  fg_status status = fg__vtk_add_array(&array, vtk, name ? name : unnamed, place);
  free(name);
  if (status != FG_STATUS_OK)
    return status;

  char *type = fg__vtk_attribute(vtk, node, "type");
  array->type = type_of(type);
  free(type);
  array->units = find_units(vtk, node);
  char *components = fg__vtk_attribute(vtk, node, "NumberOfComponents");
  bool good =
      !components || (fg__number_read_integers(&array->components, 1, components) &&
                      array->components >= 1);
  free(components);
  if (!good)
    return fg__vtk_bad_attribute(vtk, node, "NumberOfComponents");
  return read_storage(vtk, array, node);
}

/* What the element says are normals or the like are no velocities. */
static void mark_others(fg__vtk *vtk, const xmlNode *data, size_t first)
{
  static const char *const others[] = {"Normals", "TCoords", "Tangents"};
  for (size_t k = 0; k < sizeof others / sizeof others[0]; ++k) {
    char *name = fg__vtk_attribute(vtk, data, others[k]);
    for (size_t i = first; name && i < vtk->array_count; ++i)
      if (strcmp(vtk->arrays[i].name, name) == 0)
        vtk->arrays[i].no_velocity = true;
    free(name);
  }
}

fg_status fg__vtk_read_arrays(fg__vtk *vtk, const xmlNode *parent, const char *name,
                              fg__vtk_place place)
{
  const xmlNode *data = fg__vtk_child(parent, name);
  if (!data)
    return FG_STATUS_OK;
  if (place <= FG__VTK_CELLS && !vtk->vectors[place])
    vtk->vectors[place] = fg__vtk_attribute(vtk, data, "Vectors");
  const size_t first = vtk->array_count;
  for (const xmlNode *node = data->children; node; node = node->next)
    if (fg__vtk_is_element(node, "DataArray") || fg__vtk_is_element(node, "Array")) {
      fg_status status = read_array(vtk, node, place);
      if (status != FG_STATUS_OK)
        return status;
    }
  mark_others(vtk, data, first);
  return FG_STATUS_OK;
}

/* A piece's points, and the cells between them. */
static fg_status read_points(fg__vtk *vtk, const xmlNode *node)
{
  const size_t piece = vtk->piece_count - 1, first = vtk->array_count;
  fg_status status = fg__vtk_read_arrays(vtk, node, "Points", FG__VTK_COORDINATES);
  if (status == FG_STATUS_OK &&
      (vtk->array_count != first + 1 || vtk->arrays[first].components != 3))
    status = fg__fail(vtk->context, FG_STATUS_FILE_FORMAT,
                      "%s: line %ld: a piece without one array of points x y z",
                      vtk->path, xmlGetLineNo(node));
  vtk->pieces[piece].positions = first;
  return status;
}

/* The arrays that say what a list of cells is, in the element `name`. */
static fg_status read_cells(fg__vtk *vtk, const xmlNode *node, const char *name,
                            int number)
{
  enum { NEEDED = 3, NAMES = 9 };
  static const char *const names[NAMES] = {
      "connectivity",      "offsets",           "types",        "faces",
      "faceoffsets",       "face_connectivity", "face_offsets", "polyhedron_to_faces",
      "polyhedron_offsets"};
  const size_t first = vtk->array_count;
  fg__vtk_list *list = &vtk->pieces[vtk->piece_count - 1].list[number];
  size_t *const found[NAMES] = {&list->corners,  &list->ends,      &list->types,
                                &list->faces,    &list->face_ends, &list->apart[0],
                                &list->apart[1], &list->apart[2],  &list->apart[3]};
  fg_status status = fg__vtk_read_arrays(vtk, node, name, FG__VTK_COORDINATES);
  for (int k = 0; k < (vtk->polygons ? 2 : NAMES) && status == FG_STATUS_OK; ++k) {
    for (size_t i = first; i < vtk->array_count; ++i)
      if (strcmp(vtk->arrays[i].name, names[k]) == 0 && vtk->arrays[i].components == 1)
        *found[k] = i;
    if (k < NEEDED && *found[k] == FG__VTK_NONE)
      status = fg__fail(vtk->context, FG_STATUS_FILE_FORMAT,
                        "%s: line %ld: a piece's cells without array \"%s\"", vtk->path,
                        xmlGetLineNo(node), names[k]);
  }
  return status;
}

/* Of polygonal data, in the order of the cells' data, with VTK's numbers of their types.
 */
static const struct {
  const char *name, *count;
  int type;
} LISTS[FG__VTK_LISTS] = {{"Verts", "NumberOfVerts", 2},
                          {"Lines", "NumberOfLines", 4},
                          {"Polys", "NumberOfPolys", 7},
                          {"Strips", "NumberOfStrips", 6}};

static fg_status read_lists(fg__vtk *vtk, const xmlNode *node)
{
  fg_status status = FG_STATUS_OK;
  const size_t piece = vtk->piece_count - 1;
  if (!vtk->polygons)
    return read_cells(vtk, node, "Cells", 0);
  for (int k = 0; k < FG__VTK_LISTS && status == FG_STATUS_OK; ++k)
    if (vtk->pieces[piece].list[k].cells > 0)
      status = read_cells(vtk, node, LISTS[k].name, k);
  return status;
}

static bool read_count(size_t *out, fg__vtk *vtk, const xmlNode *node, const char *name)
{
  int number = 0;
  char *text = fg__vtk_attribute(vtk, node, name);
  const bool good = text && fg__number_read_integers(&number, 1, text) && number >= 0;
  free(text);
  *out = (size_t)number;
  return good;
}

bool fg__vtk_is_within(const int inner[6], const int outer[6])
{
  for (int k = 0; k < 3; ++k)
    if (inner[2 * k] < outer[2 * k] || inner[2 * k + 1] > outer[2 * k + 1])
      return false;
  return true;
}

/* The three arrays of a piece's coordinates, along x, y and z. */
static fg_status read_coordinates(fg__vtk *vtk, const xmlNode *node)
{
  size_t first = vtk->array_count;
  fg_status status = fg__vtk_read_arrays(vtk, node, "Coordinates", FG__VTK_COORDINATES);
  if (status == FG_STATUS_OK && vtk->array_count != first + 3)
    status = fg__fail(vtk->context, FG_STATUS_FILE_FORMAT,
                      "%s: line %ld: a piece with %zu arrays of coordinates, not 3",
                      vtk->path, xmlGetLineNo(node), vtk->array_count - first);
  vtk->pieces[vtk->piece_count - 1].coordinates = first;
  return status;
}

static fg_status read_piece_arrays(fg__vtk *vtk, const xmlNode *node)
{
  fg_status status = fg__vtk_read_arrays(vtk, node, "PointData", FG__VTK_POINTS);
  if (status == FG_STATUS_OK)
    status = fg__vtk_read_arrays(vtk, node, "CellData", FG__VTK_CELLS);
  if (status == FG_STATUS_OK)
    status = fg__vtk_end_piece(vtk);
  if (status == FG_STATUS_OK && vtk->uneven)
    status = read_coordinates(vtk, node);
  if (status == FG_STATUS_OK && vtk->kind != FG__VTK_ALONG_AXES && !vtk->turned)
    status = read_points(vtk, node);
  if (status == FG_STATUS_OK && vtk->kind == FG__VTK_UNSTRUCTURED)
    status = read_lists(vtk, node);
  return status;
}

/* How many cells its lists have. */
static fg_status read_counts(fg__vtk_piece *piece, fg__vtk *vtk, const xmlNode *node)
{
  if (!read_count(&piece->points, vtk, node, "NumberOfPoints"))
    return fg__vtk_bad_attribute(vtk, node, "NumberOfPoints");
  for (int k = 0; k < (vtk->polygons ? FG__VTK_LISTS : 1); ++k) {
    fg__vtk_list *list = &piece->list[k];
    const char *name = vtk->polygons ? LISTS[k].count : "NumberOfCells";
    const bool said = xmlHasNsProp(node, (const xmlChar *)name, NULL);
    if ((said || !vtk->polygons) && !read_count(&list->cells, vtk, node, name))
      return fg__vtk_bad_attribute(vtk, node, name);
    list->type = LISTS[k].type;
    piece->cells += list->cells;
  }
  return FG_STATUS_OK;
}

static fg_status read_unstructured_piece(fg__vtk *vtk, const xmlNode *node)
{
  fg__vtk_piece counts = {.points = 0};
  fg_status status = read_counts(&counts, vtk, node);
  if (status != FG_STATUS_OK || counts.points == 0 || counts.cells == 0)
    return status;
  status = fg__vtk_add_piece(vtk, vtk->extent);
  if (status != FG_STATUS_OK)
    return status;
  fg__vtk_piece *piece = &vtk->pieces[vtk->piece_count - 1];
  piece->points = counts.points;
  piece->cells = counts.cells;
  for (int k = 0; k < FG__VTK_LISTS; ++k) {
    piece->list[k].cells = counts.list[k].cells;
    piece->list[k].type = counts.list[k].type;
  }
  return read_piece_arrays(vtk, node);
}

fg_status fg__vtk_read_piece(fg__vtk *vtk, const xmlNode *node)
{
  int extent[6];
  if (vtk->kind == FG__VTK_UNSTRUCTURED)
    return read_unstructured_piece(vtk, node);
  fg_status status = fg__vtk_read_extent(vtk, node, "Extent", extent);
  if (status != FG_STATUS_OK)
    return status;
  for (int k = 0; k < 3; ++k)
    if (extent[2 * k + 1] < extent[2 * k])
      return FG_STATUS_OK; /* a processor that had nothing to write */
  if (!fg__vtk_is_within(extent, vtk->extent))
    return fg__vtk_bad_attribute(vtk, node, "Extent");

  status = fg__vtk_add_piece(vtk, extent);
  return status == FG_STATUS_OK ? read_piece_arrays(vtk, node) : status;
}
