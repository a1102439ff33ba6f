/* What the elements and attributes of a VTK XML grid say. */
#include "decode/vtk/document.h"
#include "base/memory.h"
#include "file/number_text.h"

#include <errno.h>
#include <limits.h>
#include <stdlib.h>
#include <string.h>

bool fg__vtk_is_element(const xmlNode *node, const char *name)
{
  return node->type == XML_ELEMENT_NODE && strcmp((const char *)node->name, name) == 0;
}

const xmlNode *fg__vtk_child(const xmlNode *parent, const char *name)
{
  const xmlNode *node = parent->children;
  while (node && !fg__vtk_is_element(node, name))
    node = node->next;
  return node;
}

/* A copy of what libxml2 has copied, which NULL shows it could not. End with free. */
char *fg__vtk_copy_of(fg__vtk *vtk, xmlChar *value)
{
  char *copy = fg__copy_text((const char *)value);
  xmlFree(value);
  if (!copy) {
    vtk->exhausted = true;
    fg__fail_memory(vtk->context, "what the markup says", 0);
  }
  return copy;
}

char *fg__vtk_content(fg__vtk *vtk, const xmlNode *node)
{
  char *text = fg__vtk_copy_of(vtk, xmlNodeGetContent(node));
  const size_t first = text ? strspn(text, " \t\r\n") : 0;
  size_t length = text ? strlen(text + first) : 0;
  while (length > 0 && strchr(" \t\r\n", text[first + length - 1]))
    --length;
  if (text) {
    memmove(text, text + first, length);
    text[length] = '\0';
  }
  return text;
}

/* Copy of an attribute; NULL when it is not there. End with free. */
char *fg__vtk_attribute(fg__vtk *vtk, const xmlNode *node, const char *name)
{
  return xmlHasNsProp(node, (const xmlChar *)name, NULL)
             ? fg__vtk_copy_of(vtk, xmlGetNoNsProp(node, (const xmlChar *)name))
             : NULL;
}

bool fg__vtk_attribute_is(fg__vtk *vtk, const xmlNode *node, const char *name,
                          const char *expected)
{
  char *value = fg__vtk_attribute(vtk, node, name);
  bool same = value && strcmp(value, expected) == 0;
  free(value);
  return same;
}

fg_status fg__vtk_bad_attribute(fg__vtk *vtk, const xmlNode *node, const char *name)
{
  char *value = fg__vtk_attribute(vtk, node, name);
  fg_status status =
      fg__fail(vtk->context, FG_STATUS_FILE_FORMAT, "%s: line %ld: %s has %s \"%.200s\"",
               vtk->path, xmlGetLineNo(node), (const char *)node->name, name,
               value ? value : "(not given)");
  free(value);
  return status;
}

static fg_status read_file_attributes(fg__vtk *vtk, const xmlNode *root)
{
  char *order = fg__vtk_attribute(vtk, root, "byte_order");
  bool big = order && strcmp(order, "BigEndian") == 0;
  bool order_known = !order || big || strcmp(order, "LittleEndian") == 0;
  free(order);
  if (!order_known)
    return fg__vtk_bad_attribute(vtk, root, "byte_order");
  vtk->swap = big == fg__is_little_endian();

  char *header = fg__vtk_attribute(vtk, root, "header_type");
  vtk->header_bytes = header && strcmp(header, "UInt64") == 0 ? 8 : 4;
  bool header_known = !header || vtk->header_bytes == 8 || strcmp(header, "UInt32") == 0;
  free(header);
  if (!header_known)
    return fg__vtk_bad_attribute(vtk, root, "header_type");

  vtk->compressor = fg__vtk_attribute(vtk, root, "compressor");
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

/* An image whose directions are not the axes' own is a curvilinear grid. */
static fg_status read_direction(fg__vtk *vtk, const xmlNode *image)
{
  static const double identity[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
  char *text = fg__vtk_attribute(vtk, image, "Direction");
  if (!text)
    return FG_STATUS_OK;
  bool good = fg__number_read_list(vtk->direction, 9, text);
  free(text);
  if (!good)
    return fg__vtk_bad_attribute(vtk, image, "Direction");
  for (int i = 0; i < 9; ++i)
    if (vtk->direction[i] > identity[i] || vtk->direction[i] < identity[i])
      vtk->turned = true;
  if (vtk->turned)
    vtk->kind = FG__VTK_CURVILINEAR;
  return FG_STATUS_OK;
}

static fg_status read_numbers(fg__vtk *vtk, const xmlNode *node, const char *name,
                              double numbers[3])
{
  char *text = fg__vtk_attribute(vtk, node, name);
  bool good = !text || fg__number_read_list(numbers, 3, text);
  free(text);
  return good ? FG_STATUS_OK : fg__vtk_bad_attribute(vtk, node, name);
}

fg_status fg__vtk_read_extent(fg__vtk *vtk, const xmlNode *node, const char *name,
                              int extent[6])
{
  char *text = fg__vtk_attribute(vtk, node, name);
  bool good = fg__number_read_integers(extent, 6, text);
  free(text);
  return good ? FG_STATUS_OK : fg__vtk_bad_attribute(vtk, node, name);
}

fg_status fg__vtk_read_geometry(fg__vtk *vtk, const xmlNode *image)
{
  fg_status status = fg__vtk_read_extent(vtk, image, "WholeExtent", vtk->extent);
  if (status != FG_STATUS_OK)
    return status;
  for (int k = 0; k < 3; ++k) {
    vtk->spacing[k] = 1.0;
    if (vtk->extent[2 * k + 1] < vtk->extent[2 * k])
      return fg__vtk_bad_attribute(vtk, image, "WholeExtent");
  }
  size_t points;
  if (!fg__vtk_count(&points, vtk->extent, FG__VTK_POINTS)) {
    fg__vtk_bad_attribute(vtk, image, "WholeExtent");
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
      return fg__vtk_bad_attribute(vtk, image, "Spacing");
  return read_direction(vtk, image);
}

static fg_status fail_type(fg__vtk *vtk, const xmlNode *root)
{
  char *type = fg__vtk_attribute(vtk, root, "type");
  fg__fail(
      vtk->context, FG_STATUS_UNSUPPORTED,
      "%s: a VTK file of type \"%.100s\"; of VTK's XML files ImageData, "
      "RectilinearGrid, StructuredGrid, UnstructuredGrid, PolyData, what names files "
      "of these in parallel or as blocks, and collections can be read",
      vtk->path, type ? type : "");
  fg__hint(vtk->context, "%s", FG__RESAMPLE);
  free(type);
  return FG_STATUS_UNSUPPORTED;
}

fg_status fg__vtk_read_document(fg__vtk *vtk)
{
  const xmlNode *root = xmlDocGetRootElement(vtk->document);
  if (!root || !fg__vtk_is_element(root, "VTKFile"))
    return fg__fail(vtk->context, FG_STATUS_FILE_FORMAT,
                    "%s: XML, but its first element is not VTKFile", vtk->path);
  static const char *const types[] = {"ImageData", "RectilinearGrid", "StructuredGrid",
                                      "UnstructuredGrid", "PolyData"};
  size_t at = 0;
  while (at < 5 && !fg__vtk_attribute_is(vtk, root, "type", types[at]))
    ++at;
  if (at == 5)
    return fail_type(vtk, root);
  const char *type = types[at];
  vtk->uneven = at == 1;
  vtk->polygons = at == 4;
  vtk->kind = at == 2   ? FG__VTK_CURVILINEAR
              : at >= 3 ? FG__VTK_UNSTRUCTURED
                        : FG__VTK_ALONG_AXES;
  const xmlNode *image = fg__vtk_child(root, type);
  if (!image)
    return fg__fail(vtk->context, FG_STATUS_FILE_FORMAT, "%s: no %s element", vtk->path,
                    type);
  fg_status status = read_file_attributes(vtk, root);
  if (status == FG_STATUS_OK && vtk->kind != FG__VTK_UNSTRUCTURED)
    status = fg__vtk_read_geometry(vtk, image);
  if (status == FG_STATUS_OK && vtk->appended) {
    const xmlNode *appended = fg__vtk_child(root, "AppendedData");
    vtk->appended_base64 =
        appended && fg__vtk_attribute_is(vtk, appended, "encoding", "base64");
    if (!appended || (!vtk->appended_base64 &&
                      !fg__vtk_attribute_is(vtk, appended, "encoding", "raw")))
      status = fg__vtk_bad_attribute(vtk, appended ? appended : root, "encoding");
  }
  if (status == FG_STATUS_OK)
    status = fg__vtk_check_appended(vtk);
  if (status == FG_STATUS_OK)
    status = fg__vtk_read_arrays(vtk, image, "FieldData", FG__VTK_FIELD);
  vtk->field_array_count = vtk->array_count;
  for (const xmlNode *node = image->children; node && status == FG_STATUS_OK;
       node = node->next)
    if (fg__vtk_is_element(node, "Piece"))
      status = fg__vtk_read_piece(vtk, node);
  return status == FG_STATUS_OK ? fg__vtk_check_pieces(vtk) : status;
}
