/* The mesh of a Uniform grid of XDMF, and its attributes. */
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "base/memory.h"
#include "decode/hdf/xdmf.h"

/* Grids with dimensions, slowest first. */
static const struct {
  const char *name;
  fg__vtk_kind kind;
  bool uneven;
  int dimension;
} GRIDS[] = {{"2DCoRectMesh", FG__VTK_ALONG_AXES, false, 2},
             {"3DCoRectMesh", FG__VTK_ALONG_AXES, false, 3},
             {"2DRectMesh", FG__VTK_ALONG_AXES, true, 2},
             {"3DRectMesh", FG__VTK_ALONG_AXES, true, 3},
             {"2DSMesh", FG__VTK_CURVILINEAR, false, 2},
             {"3DSMesh", FG__VTK_CURVILINEAR, false, 3},
             {"Curvilinear", FG__VTK_CURVILINEAR, false, 3}};

/* Cells of one type: XDMF's number of it, VTK's, and how many corners each has (0: as
 * NodesPerElement says). Those whose middles come in another order than VTK's are left
 * out. */
static const struct {
  const char *name, *other;
  int number, type;
  size_t corners;
} CELLS[] = {{"Polyvertex", "", 1, 2, 0},
             {"Polyline", "", 2, 4, 0},
             {"Polygon", "", 3, 7, 0},
             {"Triangle", "", 4, 5, 3},
             {"Quadrilateral", "Quad", 5, 9, 4},
             {"Tetrahedron", "Tet", 6, 10, 4},
             {"Pyramid", "", 7, 14, 5},
             {"Wedge", "", 8, 13, 6},
             {"Hexahedron", "Hex", 9, 12, 8},
             {"Edge_3", "", 0x22, 21, 3},
             {"Triangle_6", "Tri_6", 0x24, 22, 6},
             {"Quadrilateral_8", "Quad_8", 0x25, 23, 8},
             {"Quadrilateral_9", "Quad_9", 0x23, 28, 9},
             {"Tetrahedron_10", "Tet_10", 0x26, 24, 10},
             {"Pyramid_13", "", 0x27, 27, 13}};
enum {
  CELL_KINDS = sizeof CELLS / sizeof *CELLS,
  GRID_KINDS = sizeof GRIDS / sizeof *GRIDS
};

static fg_status fail_kind(fg__vtk *vtk, const xmlNode *node, const char *word)
{
  fg__fail(vtk->context, FG_STATUS_UNSUPPORTED,
           "%s: line %ld: a %s of type \"%.100s\", which cannot be read", vtk->path,
           xmlGetLineNo(node), (const char *)node->name, word);
  fg__hint(vtk->context, "%s", FG__RESAMPLE);
  return FG_STATUS_UNSUPPORTED;
}

/* Adds an array of numbers that was made, which is taken over. */
static fg_status add_numbers(size_t *out, fg__vtk *vtk, const char *name, double *number,
                             size_t count, int components)
{
  fg__vtk_array *array;
  const fg_status status = fg__vtk_add_array(&array, vtk, name, FG__VTK_COORDINATES);
  if (status != FG_STATUS_OK) {
    free(number);
    return status;
  }
  *out = vtk->array_count - 1;
  array->type = FG__TYPE_FLOAT64;
  array->components = components;
  array->storage = FG__VTK_RAW;
  array->text = array->joined_text = (char *)number;
  array->text_size = count * sizeof *number;
  return FG_STATUS_OK;
}

/* Numbers of DataItem `n` of the geometry, which must be `wanted` where that is not 0. */
static fg_status create_item(double **out, size_t *count, fg__vtk *vtk,
                             const xmlNode *geometry, int n, size_t wanted)
{
  const xmlNode *item = NULL;
  fg_status status = fg__xdmf_child(&item, vtk, geometry, "DataItem", n);
  if (status == FG_STATUS_OK)
    status = fg__xdmf_create(out, count, vtk, item);
  if (status == FG_STATUS_OK && wanted > 0 && *count != wanted) {
    free(*out);
    *out = NULL;
    status = fg__fail(vtk->context, FG_STATUS_FILE_FORMAT,
                      "%s: line %ld: %zu numbers of a mesh that has %zu there", vtk->path,
                      xmlGetLineNo(geometry), *count, wanted);
  }
  return status;
}

/* Where the points are, x y z of each together: so in the file, without z, or each axis
 * apart. */
static fg_status read_points(size_t *points, fg__vtk *vtk, const xmlNode *geometry,
                             size_t wanted)
{
  char word[FG__XDMF_WORD];
  double *out = NULL;
  size_t found = 0;
  fg_status status = FG_STATUS_OK;
  fg__xdmf_word(word, vtk, geometry, "GeometryType", "Type", "XYZ");
  const bool apart = strchr(word, '_') != NULL;
  const size_t width = strcasecmp(word, "XYZ") == 0 || strcasecmp(word, "X_Y_Z") == 0 ? 3
                       : strcasecmp(word, "XY") == 0 || strcasecmp(word, "X_Y") == 0  ? 2
                                                                                      : 0;
  *points = wanted;
  if (width == 0)
    return fail_kind(vtk, geometry, word);
  for (size_t k = 0; k < (apart ? width : 1) && status == FG_STATUS_OK; ++k) {
    double *number = NULL;
    size_t count = 0;
    status = create_item(&number, &count, vtk, geometry, (int)k,
                         apart ? *points : *points * width);
    if (status == FG_STATUS_OK && !out) {
      *points = apart ? count : count / width;
      out = fg__allocate(3 * *points, sizeof *out);
      if (!out)
        status = fg__fail_memory(vtk->context, "points", 3 * *points * sizeof *out);
    }
    if (status == FG_STATUS_OK && !apart && *points * width != count)
      status = fail_kind(vtk, geometry, word);
    for (size_t n = 0; status == FG_STATUS_OK && n < *points; ++n)
      for (size_t c = 0; c < (apart ? 1 : width); ++c)
        out[3 * n + (apart ? k : c)] = number[apart ? n : n * width + c];
    free(number);
  }
  if (status == FG_STATUS_OK)
    status = add_numbers(&found, vtk, "points", out, 3 * *points, 3);
  else
    free(out);
  vtk->pieces[vtk->piece_count - 1].positions = found;
  return status;
}

/* Origin and spacing, slowest first as the dimensions. */
static fg_status read_even(fg__vtk *vtk, const xmlNode *geometry, int dimension)
{
  char word[FG__XDMF_WORD];
  double *to[2] = {vtk->origin, vtk->spacing};
  fg_status status = FG_STATUS_OK;
  fg__xdmf_word(word, vtk, geometry, "GeometryType", "Type", "");
  if (strcasecmp(word, dimension == 3 ? "ORIGIN_DXDYDZ" : "ORIGIN_DXDY") != 0)
    return fail_kind(vtk, geometry, word);
  vtk->origin[2] = 0.0;
  vtk->spacing[2] = 1.0;
  for (int n = 0; n < 2 && status == FG_STATUS_OK; ++n) {
    double *number = NULL;
    size_t count;
    status = create_item(&number, &count, vtk, geometry, n, (size_t)dimension);
    for (int k = 0; k < dimension && status == FG_STATUS_OK; ++k)
      to[n][k] = number[dimension - 1 - k];
    free(number);
  }
  for (int k = 0; k < dimension && status == FG_STATUS_OK; ++k)
    if (!(vtk->spacing[k] > 0.0))
      status = fg__fail(vtk->context, FG_STATUS_FILE_FORMAT,
                        "%s: line %ld: a grid whose points are %g apart", vtk->path,
                        xmlGetLineNo(geometry), vtk->spacing[k]);
  return status;
}

static fg_status read_uneven(fg__vtk *vtk, const xmlNode *geometry, int dimension)
{
  static const char *const names[] = {"x", "y", "z"};
  char word[FG__XDMF_WORD];
  size_t at = 0;
  fg_status status = FG_STATUS_OK;
  fg__xdmf_word(word, vtk, geometry, "GeometryType", "Type", "");
  if (strcasecmp(word, dimension == 3 ? "VXVYVZ" : "VXVY") != 0)
    return fail_kind(vtk, geometry, word);
  for (int k = 0; k < 3 && status == FG_STATUS_OK; ++k) {
    double *number = NULL;
    size_t count = 1;
    if (k < dimension)
      status = create_item(&number, &count, vtk, geometry, k,
                           fg__vtk_length(vtk->extent, k, FG__VTK_POINTS));
    else if (!(number = fg__allocate(1, sizeof *number))) /* 0 */
      status = fg__fail_memory(vtk->context, "an axis", sizeof *number);
    if (status == FG_STATUS_OK)
      status = add_numbers(&at, vtk, names[k], number, count, 1);
  }
  vtk->pieces[vtk->piece_count - 1].coordinates = at - 2;
  vtk->uneven = true;
  return status;
}

/* Cells of mixed types: each begins with the number of its type, and where that has any
 * number of corners with how many. *used becomes the numbers that are left. */
static bool part_mixed(double *number, size_t count, double *type, fg__vtk_list *list)
{
  size_t to = 0;
  list->cells = 0;
  for (size_t at = 0; at < count;) {
    int k = 0;
    while (k < CELL_KINDS && !((double)CELLS[k].number >= number[at] &&
                               (double)CELLS[k].number <= number[at]))
      ++k;
    if (k == CELL_KINDS)
      return false;
    const bool counted = CELLS[k].corners == 0;
    const double said = !counted         ? (double)CELLS[k].corners
                        : at + 1 < count ? number[at + 1]
                                         : -1.0;
    at += counted ? 2 : 1;
    if (!(said >= 1.0 && at <= count && said <= (double)(count - at)))
      return false;
    const size_t corners = (size_t)said;
    type[list->cells++] = CELLS[k].type == 2 && corners == 1 ? 1 : CELLS[k].type;
    number[to++] = (double)corners;
    memmove(number + to, number + at, corners * sizeof *number);
    to += corners;
    at += corners;
  }
  list->corner_numbers = to;
  return true;
}

static fg_status read_mixed(fg__vtk *vtk, const xmlNode *topology, double *number,
                            size_t count, fg__vtk_list *list)
{
  double *type = fg__allocate(count, sizeof *type);
  if (!type) {
    free(number);
    return fg__fail_memory(vtk->context, "types of cells", count * sizeof *type);
  }
  fg_status status = FG_STATUS_OK;
  if (!part_mixed(number, count, type, list))
    status = fg__fail(vtk->context, FG_STATUS_UNSUPPORTED,
                      "%s: line %ld: after %zu of its cells one of a type that cannot be "
                      "read, or that is cut short",
                      vtk->path, xmlGetLineNo(topology), list->cells);
  if (status == FG_STATUS_OK)
    status = add_numbers(&list->types, vtk, "types", type, list->cells, 1);
  else
    free(type);
  if (status == FG_STATUS_OK)
    return add_numbers(&list->corners, vtk, "cells", number, list->corner_numbers, 1);
  free(number);
  return status;
}

/* Cells of one type. Vertices without a list are the points. */
static fg_status read_alike(fg__vtk *vtk, const xmlNode *topology, int kind,
                            double *number, size_t count, fg__vtk_list *list)
{
  size_t each = CELLS[kind].corners;
  if (each == 0 && fg__xdmf_lengths(&each, 1, vtk, topology, "NodesPerElement") != 1)
    each = CELLS[kind].type == 2 ? 1 : 0;
  if (each == 0 || count % each != 0) {
    free(number);
    return fg__fail(vtk->context, FG_STATUS_FILE_FORMAT,
                    "%s: line %ld: %zu numbers are no cells of %zu corners", vtk->path,
                    xmlGetLineNo(topology), count, each);
  }
  list->cells = count / each;
  list->per_cell = each;
  list->corner_numbers = count;
  list->type = CELLS[kind].type == 2 && each == 1 ? 1 : CELLS[kind].type;
  return add_numbers(&list->corners, vtk, "cells", number, count, 1);
}

static fg_status read_cells(fg__vtk *vtk, const xmlNode *topology, const char *word,
                            size_t points)
{
  int kind = 0;
  const xmlNode *item = NULL;
  double *number = NULL;
  size_t count = points, said = 0, base = 0;
  while (kind < CELL_KINDS && strcasecmp(word, CELLS[kind].name) != 0 &&
         strcasecmp(word, CELLS[kind].other) != 0)
    ++kind;
  if (kind == CELL_KINDS && strcasecmp(word, "Mixed") != 0)
    return fail_kind(vtk, topology, word);
  fg_status status = fg__xdmf_child(&item, vtk, topology, "DataItem", 0);
  if (status == FG_STATUS_OK && !item && kind == 0) {
    number = fg__allocate(points, sizeof *number);
    for (size_t n = 0; number && n < points; ++n)
      number[n] = (double)n;
    if (!number)
      status = fg__fail_memory(vtk->context, "cells", points * sizeof *number);
  } else if (status == FG_STATUS_OK) {
    status = fg__xdmf_create(&number, &count, vtk, item);
  }
  if (status != FG_STATUS_OK)
    return status;
  fg__xdmf_lengths(&base, 1, vtk, topology, "BaseOffset");
  fg__vtk_piece *piece = &vtk->pieces[vtk->piece_count - 1];
  fg__vtk_list *list = &piece->list[0];
  for (size_t n = 0; n < count && kind < CELL_KINDS; ++n)
    number[n] -= (double)base;
  status = kind == CELL_KINDS ? read_mixed(vtk, topology, number, count, list)
                              : read_alike(vtk, topology, kind, number, count, list);
  piece->cells = list->cells;
  if (status == FG_STATUS_OK && (points > INT_MAX || list->cells > INT_MAX))
    status = fg__fail(vtk->context, FG_STATUS_UNSUPPORTED, "%s: more than %d cells",
                      vtk->path, INT_MAX);
  if (status == FG_STATUS_OK &&
      (fg__xdmf_lengths(&said, 1, vtk, topology, "NumberOfElements") == 1 ||
       fg__xdmf_lengths(&said, 1, vtk, topology, "Dimensions") == 1) &&
      said != list->cells)
    status = fg__fail(vtk->context, FG_STATUS_FILE_FORMAT,
                      "%s: line %ld: a Topology of %zu elements, whose list has %zu",
                      vtk->path, xmlGetLineNo(topology), said, list->cells);
  return status;
}

/* The samples at points and of cells; those elsewhere are left out. */
static fg_status read_attributes(fg__vtk *vtk, const xmlNode *grid)
{
  fg_status status = FG_STATUS_OK;
  const xmlNode *node = NULL, *item = NULL;
  fg__vtk_piece *piece = &vtk->pieces[vtk->piece_count - 1];
  piece->first_array = vtk->array_count;
  for (int n = 0; status == FG_STATUS_OK; ++n) {
    char name[FG__XDMF_WORD], center[FG__XDMF_WORD];
    size_t tuples = 0;
    status = fg__xdmf_child(&node, vtk, grid, "Attribute", n);
    if (status != FG_STATUS_OK || !node)
      break;
    fg__xdmf_word(name, vtk, node, "Name", NULL, "");
    fg__xdmf_word(center, vtk, node, "Center", NULL, "Node");
    const bool at_points = strcasecmp(center, "Node") == 0;
    if (!at_points && strcasecmp(center, "Cell") != 0)
      continue;
    const fg__vtk_place place = at_points ? FG__VTK_POINTS : FG__VTK_CELLS;
    status = fg__xdmf_child(&item, vtk, node, "DataItem", 0);
    if (status == FG_STATUS_OK && item && fg__vtk_tuples(&tuples, vtk, piece, place))
      status = fg__xdmf_add_array(vtk, item, name, place, tuples);
  }
  return status == FG_STATUS_OK ? fg__vtk_end_piece(vtk) : status;
}

/* A grid with dimensions: the only one of the file. */
static fg_status read_grid(fg__vtk *vtk, const xmlNode *topology, const xmlNode *geometry,
                           int kind)
{
  size_t length[3] = {0}, points = 0;
  const int dimension =
      fg__xdmf_lengths(length, 3, vtk, topology, "Dimensions") > 0
          ? fg__xdmf_lengths(length, 3, vtk, topology, "Dimensions")
          : fg__xdmf_lengths(length, 3, vtk, topology, "NumberOfElements");
  bool good =
      dimension >= 2 && (dimension == GRIDS[kind].dimension || kind == GRID_KINDS - 1);
  for (int k = 0; k < dimension && good; ++k) {
    good = length[k] >= 1 && length[k] <= INT_MAX;
    vtk->extent[2 * (dimension - 1 - k) + 1] = (int)length[k] - 1;
  }
  if (!good || !fg__vtk_count(&points, vtk->extent, FG__VTK_POINTS))
    return fg__fail(vtk->context, FG_STATUS_FILE_FORMAT,
                    "%s: line %ld: a %s without good Dimensions", vtk->path,
                    xmlGetLineNo(topology), GRIDS[kind].name);
  if (vtk->piece_count > 0)
    return fg__fail(vtk->context, FG_STATUS_UNSUPPORTED,
                    "%s: line %ld: several grids with dimensions, of which one can be "
                    "read; name it by --block",
                    vtk->path, xmlGetLineNo(topology));
  vtk->kind = GRIDS[kind].kind;
  const fg_status status = fg__vtk_add_piece(vtk, vtk->extent);
  if (status != FG_STATUS_OK)
    return status;
  if (vtk->kind == FG__VTK_CURVILINEAR)
    return read_points(&points, vtk, geometry, points);
  return GRIDS[kind].uneven ? read_uneven(vtk, geometry, dimension)
                            : read_even(vtk, geometry, dimension);
}

fg_status fg__xdmf_read_uniform(fg__vtk *vtk, const xmlNode *grid)
{
  char word[FG__XDMF_WORD];
  int kind = 0;
  const xmlNode *topology = NULL, *geometry = NULL;
  fg_status status = fg__xdmf_child(&topology, vtk, grid, "Topology", 0);
  if (status == FG_STATUS_OK)
    status = fg__xdmf_child(&geometry, vtk, grid, "Geometry", 0);
  if (status == FG_STATUS_OK && (!topology || !geometry))
    status =
        fg__fail(vtk->context, FG_STATUS_FILE_FORMAT, "%s: line %ld: a Grid without a %s",
                 vtk->path, xmlGetLineNo(grid), topology ? "Geometry" : "Topology");
  if (status != FG_STATUS_OK)
    return status;
  fg__xdmf_word(word, vtk, topology, "TopologyType", "Type", "");
  while (kind < GRID_KINDS && strcasecmp(word, GRIDS[kind].name) != 0)
    ++kind;
  if (kind < GRID_KINDS) {
    status = read_grid(vtk, topology, geometry, kind);
  } else {
    size_t points = 0;
    if (vtk->piece_count > 0 && vtk->kind != FG__VTK_UNSTRUCTURED)
      return fail_kind(vtk, topology, word);
    vtk->kind = FG__VTK_UNSTRUCTURED;
    status = fg__vtk_add_piece(vtk, vtk->extent);
    if (status == FG_STATUS_OK)
      status = read_points(&points, vtk, geometry, 0);
    if (status == FG_STATUS_OK)
      vtk->pieces[vtk->piece_count - 1].points = points;
    if (status == FG_STATUS_OK)
      status = read_cells(vtk, topology, word, points);
  }
  return status == FG_STATUS_OK ? read_attributes(vtk, grid) : status;
}
