/* What the elements and attributes of a VTK XML grid say. */
#include "base/memory.h"
#include "file/number_text.h"
#include "read/vtk/vtk.h"

#include <errno.h>
#include <limits.h>
#include <stdlib.h>
#include <string.h>

#include <libxml/tree.h>

static bool is_element(const xmlNode *node, const char *name)
{
  return node->type == XML_ELEMENT_NODE && strcmp((const char *)node->name, name) == 0;
}

static const xmlNode *child_named(const xmlNode *parent, const char *name)
{
  const xmlNode *node = parent->children;
  while (node && !is_element(node, name))
    node = node->next;
  return node;
}

/* A copy of what libxml2 has copied, which NULL shows it could not. End with free. */
static char *copy_of(fg__vtk *vtk, xmlChar *value)
{
  char *copy = fg__copy_text((const char *)value);
  xmlFree(value);
  if (!copy) {
    vtk->exhausted = true;
    fg__fail_memory(vtk->context, "what the markup says", 0);
  }
  return copy;
}

/* Copy of an attribute; NULL when it is not there. End with free. */
static char *attribute(fg__vtk *vtk, const xmlNode *node, const char *name)
{
  return xmlHasNsProp(node, (const xmlChar *)name, NULL)
             ? copy_of(vtk, xmlGetNoNsProp(node, (const xmlChar *)name))
             : NULL;
}

static bool attribute_is(fg__vtk *vtk, const xmlNode *node, const char *name,
                         const char *expected)
{
  char *value = attribute(vtk, node, name);
  bool same = value && strcmp(value, expected) == 0;
  free(value);
  return same;
}

static fg_status bad_attribute(fg__vtk *vtk, const xmlNode *node, const char *name)
{
  char *value = attribute(vtk, node, name);
  fg_status status =
      fg__fail(vtk->context, FG_STATUS_FILE_FORMAT, "%s: line %ld: %s has %s \"%.200s\"",
               vtk->path, xmlGetLineNo(node), (const char *)node->name, name,
               value ? value : "(not given)");
  free(value);
  return status;
}

static fg_status read_file_attributes(fg__vtk *vtk, const xmlNode *root)
{
  const uint16_t one = 1;
  const bool little_machine = *(const unsigned char *)&one == 1;
  char *order = attribute(vtk, root, "byte_order");
  bool big = order && strcmp(order, "BigEndian") == 0;
  bool order_known = !order || big || strcmp(order, "LittleEndian") == 0;
  free(order);
  if (!order_known)
    return bad_attribute(vtk, root, "byte_order");
  vtk->swap = big == little_machine;

  char *header = attribute(vtk, root, "header_type");
  vtk->header_bytes = header && strcmp(header, "UInt64") == 0 ? 8 : 4;
  bool header_known = !header || vtk->header_bytes == 8 || strcmp(header, "UInt32") == 0;
  free(header);
  if (!header_known)
    return bad_attribute(vtk, root, "header_type");

  vtk->compressor = attribute(vtk, root, "compressor");
  if (!vtk->compressor || !vtk->compressor[0])
    vtk->compression = FG__VTK_PLAIN;
  else if (strcmp(vtk->compressor, "vtkZLibDataCompressor") == 0)
    vtk->compression = FG__VTK_ZLIB;
  else if (strcmp(vtk->compressor, "vtkLZ4DataCompressor") == 0)
    vtk->compression = FG__VTK_LZ4;
  else
    vtk->compression = FG__VTK_OTHER_COMPRESSION;
  return FG_STATUS_OK;
}

/* Directions other than the axes' own would turn the vectors against the grid. */
static fg_status check_direction(fg__vtk *vtk, const xmlNode *image)
{
  static const double identity[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
  double direction[9];
  char *text = attribute(vtk, image, "Direction");
  if (!text)
    return FG_STATUS_OK;
  bool good = fg__number_read_list(direction, 9, text);
  free(text);
  if (!good)
    return bad_attribute(vtk, image, "Direction");
  for (int i = 0; i < 9; ++i)
    if (direction[i] != identity[i]) {
      text = attribute(vtk, image, "Direction");
      fg__fail(
          vtk->context, FG_STATUS_UNSUPPORTED,
          "%s: a turned image, with Direction \"%.200s\"; only images along the axes "
          "can be read",
          vtk->path, text ? text : "");
      free(text);
      return FG_STATUS_UNSUPPORTED;
    }
  return FG_STATUS_OK;
}

static fg_status read_numbers(fg__vtk *vtk, const xmlNode *node, const char *name,
                              double numbers[3])
{
  char *text = attribute(vtk, node, name);
  bool good = !text || fg__number_read_list(numbers, 3, text);
  free(text);
  return good ? FG_STATUS_OK : bad_attribute(vtk, node, name);
}

static fg_status read_extent(fg__vtk *vtk, const xmlNode *node, const char *name,
                             int extent[6])
{
  char *text = attribute(vtk, node, name);
  bool good = fg__number_read_integers(extent, 6, text);
  free(text);
  return good ? FG_STATUS_OK : bad_attribute(vtk, node, name);
}

static fg_status read_geometry(fg__vtk *vtk, const xmlNode *image)
{
  fg_status status = read_extent(vtk, image, "WholeExtent", vtk->extent);
  if (status != FG_STATUS_OK)
    return status;
  for (int k = 0; k < 3; ++k) {
    vtk->spacing[k] = 1.0;
    if (vtk->extent[2 * k + 1] < vtk->extent[2 * k])
      return bad_attribute(vtk, image, "WholeExtent");
  }
  size_t points;
  if (!fg__vtk_count(&points, vtk->extent, FG__VTK_POINTS)) {
    bad_attribute(vtk, image, "WholeExtent");
    fg__hint(vtk->context, "at most %d points can be read", INT_MAX);
    return FG_STATUS_FILE_FORMAT;
  }
  status = read_numbers(vtk, image, "Origin", vtk->origin);
  if (status == FG_STATUS_OK)
    status = read_numbers(vtk, image, "Spacing", vtk->spacing);
  if (status != FG_STATUS_OK)
    return status;
  for (int k = 0; k < 3; ++k)
    if (!(vtk->spacing[k] > 0.0) && vtk->extent[2 * k] < vtk->extent[2 * k + 1])
      return bad_attribute(vtk, image, "Spacing");
  return check_direction(vtk, image);
}

static fg__vtk_type type_of(const char *name)
{
  static const char *const names[] = {"",       "Int8",    "UInt8",  "Int16",
                                      "UInt16", "Int32",   "UInt32", "Int64",
                                      "UInt64", "Float32", "Float64"};
  for (int i = FG__VTK_INT8; name && i <= FG__VTK_FLOAT64; ++i)
    if (strcmp(names[i], name) == 0)
      return (fg__vtk_type)i;
  return FG__VTK_UNKNOWN;
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

static void trim(char *text)
{
  size_t start = strspn(text, " \t\r\n"), length = strlen(text + start);
  while (length > 0 && strchr(" \t\r\n", text[start + length - 1]))
    --length;
  memmove(text, text + start, length);
  text[length] = '\0';
}

static char *find_units(fg__vtk *vtk, const xmlNode *node)
{
  for (const xmlNode *child = node->children; child; child = child->next)
    if (is_element(child, "InformationKey") &&
        attribute_is(vtk, child, "name", "UNITS_LABEL")) {
      char *units = copy_of(vtk, xmlNodeGetContent(child));
      if (units)
        trim(units);
      return units;
    }
  return NULL;
}

static fg_status read_storage(fg__vtk *vtk, fg__vtk_array *array, const xmlNode *node)
{
  char *format = attribute(vtk, node, "format");
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
    return bad_attribute(vtk, node, "format");
  if (array->storage != FG__VTK_APPENDED)
    return find_text(array, node)
               ? FG_STATUS_OK
               : fg__fail_memory(vtk->context, "an array's text", array->text_size);
  char *text = attribute(vtk, node, "offset");
  char *end = text;
  errno = 0;
  unsigned long long offset = text ? strtoull(text, &end, 10) : 0;
  bool good = end != text && *end == '\0' && errno == 0 && !strchr(text, '-') &&
              offset <= SIZE_MAX;
  free(text);
  array->offset = (size_t)offset;
  return good ? FG_STATUS_OK : bad_attribute(vtk, node, "offset");
}

static fg_status read_array(fg__vtk *vtk, const xmlNode *node, fg__vtk_place place)
{
  fg__vtk_array *array = NULL;
  char *name = attribute(vtk, node, "Name");
  fg_status status = fg__vtk_add_array(&array, vtk, name ? name : "", place);
  free(name);
  if (status != FG_STATUS_OK)
    return status;

  char *type = attribute(vtk, node, "type");
  array->type = type_of(type);
  free(type);
  array->units = find_units(vtk, node);
  char *components = attribute(vtk, node, "NumberOfComponents");
  bool good =
      !components || (fg__number_read_integers(&array->components, 1, components) &&
                      array->components >= 1);
  free(components);
  if (!good)
    return bad_attribute(vtk, node, "NumberOfComponents");
  return read_storage(vtk, array, node);
}

static fg_status read_arrays(fg__vtk *vtk, const xmlNode *parent, const char *name,
                             fg__vtk_place place)
{
  const xmlNode *data = child_named(parent, name);
  if (!data)
    return FG_STATUS_OK;
  if (place <= FG__VTK_CELLS && !vtk->vectors[place])
    vtk->vectors[place] = attribute(vtk, data, "Vectors");
  for (const xmlNode *node = data->children; node; node = node->next)
    if (is_element(node, "DataArray")) {
      fg_status status = read_array(vtk, node, place);
      if (status != FG_STATUS_OK)
        return status;
    }
  return FG_STATUS_OK;
}

/* A piece's points, and the cells between them. */
static fg_status read_points(fg__vtk *vtk, const xmlNode *node)
{
  const size_t piece = vtk->piece_count - 1, first = vtk->array_count;
  fg_status status = read_arrays(vtk, node, "Points", FG__VTK_COORDINATES);
  if (status == FG_STATUS_OK &&
      (vtk->array_count != first + 1 || vtk->arrays[first].components != 3))
    status = fg__fail(vtk->context, FG_STATUS_FILE_FORMAT,
                      "%s: line %ld: a piece without one array of points x y z",
                      vtk->path, xmlGetLineNo(node));
  vtk->pieces[piece].positions = first;
  return status;
}

static fg_status read_cells(fg__vtk *vtk, const xmlNode *node)
{
  static const char *const names[3] = {"connectivity", "offsets", "types"};
  fg__vtk_piece *piece = &vtk->pieces[vtk->piece_count - 1];
  const size_t first = vtk->array_count;
  size_t *const found[3] = {&piece->corners, &piece->ends, &piece->types};
  fg_status status = read_arrays(vtk, node, "Cells", FG__VTK_COORDINATES);
  for (int k = 0; k < 3 && status == FG_STATUS_OK; ++k) {
    *found[k] = FG__VTK_NONE;
    for (size_t i = first; i < vtk->array_count; ++i)
      if (strcmp(vtk->arrays[i].name, names[k]) == 0 && vtk->arrays[i].components == 1)
        *found[k] = i;
    if (*found[k] == FG__VTK_NONE)
      status = fg__fail(vtk->context, FG_STATUS_FILE_FORMAT,
                        "%s: line %ld: a piece's cells without array \"%s\"", vtk->path,
                        xmlGetLineNo(node), names[k]);
  }
  return status;
}

static bool read_count(size_t *out, fg__vtk *vtk, const xmlNode *node, const char *name)
{
  int number = 0;
  char *text = attribute(vtk, node, name);
  const bool good = text && fg__number_read_integers(&number, 1, text) && number >= 0;
  free(text);
  *out = (size_t)number;
  return good;
}

static bool is_within(const int inner[6], const int outer[6])
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
  fg_status status = read_arrays(vtk, node, "Coordinates", FG__VTK_COORDINATES);
  if (status == FG_STATUS_OK && vtk->array_count != first + 3)
    status = fg__fail(vtk->context, FG_STATUS_FILE_FORMAT,
                      "%s: line %ld: a piece with %zu arrays of coordinates, not 3",
                      vtk->path, xmlGetLineNo(node), vtk->array_count - first);
  vtk->pieces[vtk->piece_count - 1].coordinates = first;
  return status;
}

static fg_status read_piece_arrays(fg__vtk *vtk, const xmlNode *node)
{
  fg_status status = read_arrays(vtk, node, "PointData", FG__VTK_POINTS);
  if (status == FG_STATUS_OK)
    status = read_arrays(vtk, node, "CellData", FG__VTK_CELLS);
  if (status == FG_STATUS_OK)
    status = fg__vtk_end_piece(vtk);
  if (status == FG_STATUS_OK && vtk->uneven)
    status = read_coordinates(vtk, node);
  if (status == FG_STATUS_OK && vtk->kind != FG__VTK_ALONG_AXES)
    status = read_points(vtk, node);
  if (status == FG_STATUS_OK && vtk->kind == FG__VTK_UNSTRUCTURED)
    status = read_cells(vtk, node);
  return status;
}

static fg_status read_unstructured_piece(fg__vtk *vtk, const xmlNode *node)
{
  size_t points, cells;
  if (!read_count(&points, vtk, node, "NumberOfPoints"))
    return bad_attribute(vtk, node, "NumberOfPoints");
  if (!read_count(&cells, vtk, node, "NumberOfCells"))
    return bad_attribute(vtk, node, "NumberOfCells");
  if (points == 0 || cells == 0)
    return FG_STATUS_OK;
  fg_status status = fg__vtk_add_piece(vtk, vtk->extent);
  if (status != FG_STATUS_OK)
    return status;
  vtk->pieces[vtk->piece_count - 1].points = points;
  vtk->pieces[vtk->piece_count - 1].cells = cells;
  return read_piece_arrays(vtk, node);
}

static fg_status read_piece(fg__vtk *vtk, const xmlNode *node)
{
  int extent[6];
  if (vtk->kind == FG__VTK_UNSTRUCTURED)
    return read_unstructured_piece(vtk, node);
  fg_status status = read_extent(vtk, node, "Extent", extent);
  if (status != FG_STATUS_OK)
    return status;
  for (int k = 0; k < 3; ++k)
    if (extent[2 * k + 1] < extent[2 * k])
      return FG_STATUS_OK; /* a processor that had nothing to write */
  if (!is_within(extent, vtk->extent))
    return bad_attribute(vtk, node, "Extent");

  status = fg__vtk_add_piece(vtk, extent);
  return status == FG_STATUS_OK ? read_piece_arrays(vtk, node) : status;
}

static fg_status fail_type(fg__vtk *vtk, const xmlNode *root)
{
  char *type = attribute(vtk, root, "type");
  fg__fail(vtk->context, FG_STATUS_UNSUPPORTED,
           "%s: a VTK file of type \"%.100s\"; of VTK's XML files only ImageData, "
           "RectilinearGrid, StructuredGrid and UnstructuredGrid can be read yet",
           vtk->path, type ? type : "");
  fg__hint(vtk->context, "%s", FG__VTK_RESAMPLE);
  free(type);
  return FG_STATUS_UNSUPPORTED;
}

static fg_status read_document(fg__vtk *vtk)
{
  const xmlNode *root = xmlDocGetRootElement(vtk->document);
  if (!root || !is_element(root, "VTKFile"))
    return fg__fail(vtk->context, FG_STATUS_FILE_FORMAT,
                    "%s: XML, but its first element is not VTKFile", vtk->path);
  static const char *const types[] = {"ImageData", "RectilinearGrid", "StructuredGrid",
                                      "UnstructuredGrid"};
  size_t at = 0;
  while (at < 4 && !attribute_is(vtk, root, "type", types[at]))
    ++at;
  if (at == 4)
    return fail_type(vtk, root);
  const char *type = types[at];
  vtk->uneven = at == 1;
  vtk->kind = at == 2   ? FG__VTK_CURVILINEAR
              : at == 3 ? FG__VTK_UNSTRUCTURED
                        : FG__VTK_ALONG_AXES;
  const xmlNode *image = child_named(root, type);
  if (!image)
    return fg__fail(vtk->context, FG_STATUS_FILE_FORMAT, "%s: no %s element", vtk->path,
                    type);
  fg_status status = read_file_attributes(vtk, root);
  if (status == FG_STATUS_OK && vtk->kind != FG__VTK_UNSTRUCTURED)
    status = read_geometry(vtk, image);
  if (status == FG_STATUS_OK && vtk->appended) {
    const xmlNode *appended = child_named(root, "AppendedData");
    vtk->appended_base64 = appended && attribute_is(vtk, appended, "encoding", "base64");
    if (!appended ||
        (!vtk->appended_base64 && !attribute_is(vtk, appended, "encoding", "raw")))
      status = bad_attribute(vtk, appended ? appended : root, "encoding");
  }
  if (status == FG_STATUS_OK)
    status = read_arrays(vtk, image, "FieldData", FG__VTK_FIELD);
  vtk->field_array_count = vtk->array_count;
  for (const xmlNode *node = image->children; node && status == FG_STATUS_OK;
       node = node->next)
    if (is_element(node, "Piece"))
      status = read_piece(vtk, node);
  return status == FG_STATUS_OK ? fg__vtk_check_pieces(vtk) : status;
}

fg_status fg__vtk_open_xml(fg__vtk *out, fg_context *context, const fg__source *source)
{
  *out = (fg__vtk){.context = context, .path = source->path, .file_size = source->size};
  fg_status status = fg__vtk_parse(out, source);
  if (status == FG_STATUS_OK)
    status = read_document(out);
  return out->exhausted ? FG_STATUS_MEMORY : status;
}
