/* What the elements and attributes of a VTK XML image say. */
#include "base/memory.h"
#include "format/number_text.h"
#include "format/vti.h"

#include <errno.h>
#include <limits.h>
#include <stdlib.h>
#include <string.h>

#include <libxml/tree.h>

/* More arrays in a piece than any program writes; names are compared each with each. */
enum { ARRAYS_MAX = 1000 };

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

/* Copy of an attribute; NULL when it is not there. End with free. */
static char *attribute(const xmlNode *node, const char *name)
{
  xmlChar *value = xmlGetNoNsProp(node, (const xmlChar *)name);
  char *copy = fg__copy_text((const char *)value);
  xmlFree(value);
  return copy;
}

static bool attribute_is(const xmlNode *node, const char *name, const char *expected)
{
  char *value = attribute(node, name);
  bool same = value && strcmp(value, expected) == 0;
  free(value);
  return same;
}

static fg_status bad_attribute(const fg__vti *vti, const xmlNode *node, const char *name)
{
  char *value = attribute(node, name);
  fg_status status =
      fg__fail(vti->context, FG_STATUS_FILE_FORMAT, "%s: line %ld: %s has %s \"%.200s\"",
               vti->path, xmlGetLineNo(node), (const char *)node->name, name,
               value ? value : "(not given)");
  free(value);
  return status;
}

static fg_status read_file_attributes(fg__vti *vti, const xmlNode *root)
{
  const uint16_t one = 1;
  const bool little_machine = *(const unsigned char *)&one == 1;
  char *order = attribute(root, "byte_order");
  bool big = order && strcmp(order, "BigEndian") == 0;
  bool order_known = !order || big || strcmp(order, "LittleEndian") == 0;
  free(order);
  if (!order_known)
    return bad_attribute(vti, root, "byte_order");
  vti->swap = big == little_machine;

  char *header = attribute(root, "header_type");
  vti->header_bytes = header && strcmp(header, "UInt64") == 0 ? 8 : 4;
  bool header_known = !header || vti->header_bytes == 8 || strcmp(header, "UInt32") == 0;
  free(header);
  if (!header_known)
    return bad_attribute(vti, root, "header_type");

  vti->compressor = attribute(root, "compressor");
  if (!vti->compressor || !vti->compressor[0])
    vti->compression = FG__VTI_PLAIN;
  else if (strcmp(vti->compressor, "vtkZLibDataCompressor") == 0)
    vti->compression = FG__VTI_ZLIB;
  else
    vti->compression = FG__VTI_OTHER_COMPRESSION;
  return FG_STATUS_OK;
}

/* Directions other than the axes' own would turn the vectors against the grid. */
static fg_status check_direction(const fg__vti *vti, const xmlNode *image)
{
  static const double identity[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
  double direction[9];
  char *text = attribute(image, "Direction");
  if (!text)
    return FG_STATUS_OK;
  bool good = fg__number_read_list(direction, 9, text);
  free(text);
  if (!good)
    return bad_attribute(vti, image, "Direction");
  for (int i = 0; i < 9; ++i)
    if (direction[i] != identity[i]) {
      text = attribute(image, "Direction");
      fg__fail(
          vti->context, FG_STATUS_UNSUPPORTED,
          "%s: a turned image, with Direction \"%.200s\"; only images along the axes "
          "can be read",
          vti->path, text ? text : "");
      free(text);
      return FG_STATUS_UNSUPPORTED;
    }
  return FG_STATUS_OK;
}

static fg_status read_numbers(const fg__vti *vti, const xmlNode *node, const char *name,
                              double numbers[3])
{
  char *text = attribute(node, name);
  bool good = !text || fg__number_read_list(numbers, 3, text);
  free(text);
  return good ? FG_STATUS_OK : bad_attribute(vti, node, name);
}

static fg_status read_extent(const fg__vti *vti, const xmlNode *node, const char *name,
                             int extent[6])
{
  char *text = attribute(node, name);
  bool good = fg__number_read_integers(extent, 6, text);
  free(text);
  return good ? FG_STATUS_OK : bad_attribute(vti, node, name);
}

static fg_status read_geometry(fg__vti *vti, const xmlNode *image)
{
  fg_status status = read_extent(vti, image, "WholeExtent", vti->extent);
  if (status != FG_STATUS_OK)
    return status;
  for (int k = 0; k < 3; ++k) {
    vti->spacing[k] = 1.0;
    if (vti->extent[2 * k + 1] < vti->extent[2 * k])
      return bad_attribute(vti, image, "WholeExtent");
  }
  size_t points;
  if (!fg__vti_count(&points, vti->extent, FG__VTI_POINTS)) {
    bad_attribute(vti, image, "WholeExtent");
    fg__hint(vti->context, "at most %d points can be read", INT_MAX);
    return FG_STATUS_FILE_FORMAT;
  }
  status = read_numbers(vti, image, "Origin", vti->origin);
  if (status == FG_STATUS_OK)
    status = read_numbers(vti, image, "Spacing", vti->spacing);
  if (status != FG_STATUS_OK)
    return status;
  for (int k = 0; k < 3; ++k)
    if (!(vti->spacing[k] > 0.0) && vti->extent[2 * k] < vti->extent[2 * k + 1])
      return bad_attribute(vti, image, "Spacing");
  return check_direction(vti, image);
}

static fg__vti_type type_of(const char *name)
{
  static const char *const names[] = {"",       "Int8",    "UInt8",  "Int16",
                                      "UInt16", "Int32",   "UInt32", "Int64",
                                      "UInt64", "Float32", "Float64"};
  for (int i = FG__VTI_INT8; name && i <= FG__VTI_FLOAT64; ++i)
    if (strcmp(names[i], name) == 0)
      return (fg__vti_type)i;
  return FG__VTI_UNKNOWN;
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
static bool find_text(fg__vti_array *array, const xmlNode *node)
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

static char *find_units(const xmlNode *node)
{
  for (const xmlNode *child = node->children; child; child = child->next)
    if (is_element(child, "InformationKey") &&
        attribute_is(child, "name", "UNITS_LABEL")) {
      xmlChar *content = xmlNodeGetContent(child);
      char *units = NULL;
      if (content) {
        char *text = (char *)content + strspn((char *)content, " \t\r\n");
        size_t length = strlen(text);
        while (length > 0 && strchr(" \t\r\n", text[length - 1]))
          --length;
        text[length] = '\0';
        units = fg__copy_text(text);
      }
      xmlFree(content);
      return units;
    }
  return NULL;
}

static fg_status read_storage(const fg__vti *vti, fg__vti_array *array,
                              const xmlNode *node)
{
  char *format = attribute(node, "format");
  bool known = true;
  if (!format || strcmp(format, "ascii") == 0)
    array->storage = FG__VTI_ASCII;
  else if (strcmp(format, "binary") == 0)
    array->storage = FG__VTI_INLINE;
  else if (strcmp(format, "appended") == 0)
    array->storage = FG__VTI_APPENDED;
  else
    known = false;
  free(format);
  if (!known)
    return bad_attribute(vti, node, "format");
  if (array->storage != FG__VTI_APPENDED)
    return find_text(array, node)
               ? FG_STATUS_OK
               : fg__fail_memory(vti->context, "an array's text", array->text_size);
  char *text = attribute(node, "offset");
  char *end = text;
  errno = 0;
  unsigned long long offset = text ? strtoull(text, &end, 10) : 0;
  bool good = end != text && *end == '\0' && errno == 0 && !strchr(text, '-') &&
              offset <= SIZE_MAX;
  free(text);
  array->offset = (size_t)offset;
  return good ? FG_STATUS_OK : bad_attribute(vti, node, "offset");
}

static fg_status read_array(fg__vti *vti, const xmlNode *node, fg__vti_place place)
{
  void *arrays = vti->arrays;
  if (!fg__grow(&arrays, &vti->array_capacity, vti->array_count + 1, sizeof *vti->arrays))
    return fg__fail_memory(vti->context, "a list of arrays", vti->array_count);
  vti->arrays = arrays;
  fg__vti_array *array = &vti->arrays[vti->array_count++];
  *array = (fg__vti_array){.place = place, .components = 1};

  char *type = attribute(node, "type");
  array->type = type_of(type);
  free(type);
  array->name = attribute(node, "Name");
  if (!array->name)
    array->name = fg__copy_text("");
  if (!array->name)
    return fg__fail_memory(vti->context, "an array's name", 1);
  array->units = find_units(node);
  char *components = attribute(node, "NumberOfComponents");
  bool good =
      !components || (fg__number_read_integers(&array->components, 1, components) &&
                      array->components >= 1);
  free(components);
  if (!good)
    return bad_attribute(vti, node, "NumberOfComponents");
  return read_storage(vti, array, node);
}

static fg_status read_arrays(fg__vti *vti, const xmlNode *parent, const char *name,
                             fg__vti_place place)
{
  const xmlNode *data = child_named(parent, name);
  if (!data)
    return FG_STATUS_OK;
  if (place != FG__VTI_FIELD && !vti->vectors[place])
    vti->vectors[place] = attribute(data, "Vectors");
  for (const xmlNode *node = data->children; node; node = node->next)
    if (is_element(node, "DataArray")) {
      fg_status status = read_array(vti, node, place);
      if (status != FG_STATUS_OK)
        return status;
    }
  return FG_STATUS_OK;
}

static bool is_within(const int inner[6], const int outer[6])
{
  for (int k = 0; k < 3; ++k)
    if (inner[2 * k] < outer[2 * k] || inner[2 * k + 1] > outer[2 * k + 1])
      return false;
  return true;
}

static fg_status read_piece(fg__vti *vti, const xmlNode *node)
{
  int extent[6];
  fg_status status = read_extent(vti, node, "Extent", extent);
  if (status != FG_STATUS_OK)
    return status;
  for (int k = 0; k < 3; ++k)
    if (extent[2 * k + 1] < extent[2 * k])
      return FG_STATUS_OK; /* a processor that had nothing to write */
  if (!is_within(extent, vti->extent))
    return bad_attribute(vti, node, "Extent");

  void *pieces = vti->pieces;
  if (!fg__grow(&pieces, &vti->piece_capacity, vti->piece_count + 1, sizeof *vti->pieces))
    return fg__fail_memory(vti->context, "a list of pieces", vti->piece_count);
  vti->pieces = pieces;
  size_t piece = vti->piece_count++;
  memcpy(vti->pieces[piece].extent, extent, sizeof extent);
  vti->pieces[piece].first_array = vti->array_count;
  status = read_arrays(vti, node, "PointData", FG__VTI_POINTS);
  if (status == FG_STATUS_OK)
    status = read_arrays(vti, node, "CellData", FG__VTI_CELLS);
  size_t count = vti->array_count - vti->pieces[piece].first_array;
  vti->pieces[piece].array_count = count;
  if (status == FG_STATUS_OK && count > ARRAYS_MAX)
    return fg__fail(vti->context, FG_STATUS_UNSUPPORTED,
                    "%s: %zu arrays; at most %d can be read", vti->path, count,
                    ARRAYS_MAX);
  return status;
}

/* Pieces too small for the whole are refused before anything is allocated for it. They
 * may overlap: VTK writes the whole in every piece when its source cannot be divided. */
static fg_status check_pieces(const fg__vti *vti)
{
  size_t whole, sum = 0;
  if (!fg__vti_count(&whole, vti->extent, FG__VTI_CELLS))
    return FG_STATUS_FILE_FORMAT;
  for (size_t p = 0; p < vti->piece_count && sum < whole; ++p) {
    size_t cells;
    if (!fg__vti_count(&cells, vti->pieces[p].extent, FG__VTI_CELLS))
      return FG_STATUS_FILE_FORMAT;
    sum += cells;
  }
  if (sum < whole)
    return fg__fail(vti->context, FG_STATUS_FILE_FORMAT,
                    "%s: its %zu pieces have %zu cells, the whole %zu", vti->path,
                    vti->piece_count, sum, whole);
  return FG_STATUS_OK;
}

static fg_status read_document(fg__vti *vti)
{
  const xmlNode *root = xmlDocGetRootElement(vti->document);
  if (!root || !is_element(root, "VTKFile"))
    return fg__fail(vti->context, FG_STATUS_FILE_FORMAT,
                    "%s: XML, but its first element is not VTKFile", vti->path);
  if (!attribute_is(root, "type", "ImageData")) {
    char *type = attribute(root, "type");
    fg__fail(
        vti->context, FG_STATUS_UNSUPPORTED,
        "%s: a VTK file of type \"%.100s\"; of VTK's XML files only ImageData can be "
        "read yet",
        vti->path, type ? type : "");
    free(type);
    return FG_STATUS_UNSUPPORTED;
  }
  const xmlNode *image = child_named(root, "ImageData");
  if (!image)
    return fg__fail(vti->context, FG_STATUS_FILE_FORMAT, "%s: no ImageData element",
                    vti->path);
  fg_status status = read_file_attributes(vti, root);
  if (status == FG_STATUS_OK)
    status = read_geometry(vti, image);
  if (status == FG_STATUS_OK && vti->appended) {
    const xmlNode *appended = child_named(root, "AppendedData");
    vti->appended_base64 = appended && attribute_is(appended, "encoding", "base64");
    if (!appended ||
        (!vti->appended_base64 && !attribute_is(appended, "encoding", "raw")))
      status = bad_attribute(vti, appended ? appended : root, "encoding");
  }
  if (status == FG_STATUS_OK)
    status = read_arrays(vti, image, "FieldData", FG__VTI_FIELD);
  vti->field_array_count = vti->array_count;
  for (const xmlNode *node = image->children; node && status == FG_STATUS_OK;
       node = node->next)
    if (is_element(node, "Piece"))
      status = read_piece(vti, node);
  return status == FG_STATUS_OK ? check_pieces(vti) : status;
}

fg_status fg__vti_open(fg__vti *out, fg_context *context, const fg__source *source)
{
  *out = (fg__vti){.context = context, .path = source->path, .file_size = source->size};
  fg_status status = fg__vti_parse(out, source);
  return status == FG_STATUS_OK ? read_document(out) : status;
}

void fg__vti_close(fg__vti *vti)
{
  for (size_t i = 0; i < vti->array_count; ++i) {
    free(vti->arrays[i].name);
    free(vti->arrays[i].units);
    free(vti->arrays[i].joined_text);
  }
  free(vti->arrays);
  free(vti->pieces);
  free(vti->vectors[0]);
  free(vti->vectors[1]);
  free(vti->compressor);
  if (vti->document)
    xmlFreeDoc(vti->document);
  *vti = (fg__vti){0};
}

const fg__vti_array *fg__vti_find(const fg__vti *vti, size_t piece, fg__vti_place place,
                                  const char *name)
{
  size_t first = 0, count = vti->field_array_count;
  if (place != FG__VTI_FIELD) {
    if (piece >= vti->piece_count)
      return NULL;
    first = vti->pieces[piece].first_array;
    count = vti->pieces[piece].array_count;
  }
  for (size_t i = first; i < first + count; ++i)
    if (vti->arrays[i].place == place && strcmp(vti->arrays[i].name, name) == 0)
      return &vti->arrays[i];
  return NULL;
}

size_t fg__vti_length(const int extent[6], int axis, fg__vti_place place)
{
  size_t intervals = (size_t)((int64_t)extent[2 * axis + 1] - (int64_t)extent[2 * axis]);
  if (place == FG__VTI_CELLS)
    return intervals > 0 ? intervals : 1;
  return intervals + 1;
}

bool fg__vti_count(size_t *count, const int extent[6], fg__vti_place place)
{
  *count = 1;
  for (int k = 0; k < 3; ++k) {
    size_t length = fg__vti_length(extent, k, place);
    if (length > (size_t)INT_MAX / *count)
      return false;
    *count *= length;
  }
  return true;
}
