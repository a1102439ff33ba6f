/* Blocks of elements, and the cells that they are. */
#include "decode/exodus/exodus.h"

#include "base/memory.h"
#include "base/names.h"

#include <ctype.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

enum { VERTEX = 1, LINE = 4 };

/* The nodes of middles come in another order than VTK's: those of edges upwards before
 * those round the upper end. */
static const fg__exodus_shape SHAPES[] = {
    {"HEX", 8, 12, 8, {0}},
    {"HEX", 20, 25, 20, {0,  1,  2,  3,  4,  5,  6,  7,  8,  9,
                         10, 11, 16, 17, 18, 19, 12, 13, 14, 15}},
    {"HEX", 27, 29, 27, {0,  1,  2,  3,  4,  5,  6,  7,  8,  9,  10, 11, 16, 17,
                         18, 19, 12, 13, 14, 15, 23, 24, 25, 26, 21, 22, 20}},
    {"TET", 4, 10, 4, {0}},
    {"TET", 10, 24, 10, {0}},
    {"TET", 14, 24, 10, {0}},
    {"TET", 15, 24, 10, {0}},
    {"WEDGE", 6, 13, 6, {0}},
    {"WEDGE", 15, 26, 15, {0, 1, 2, 3, 4, 5, 6, 7, 8, 12, 13, 14, 9, 10, 11}},
    {"PYR", 5, 14, 5, {0}},
    {"PYR", 13, 27, 13, {0}},
    {"QUAD", 4, 9, 4, {0}},
    {"QUAD", 8, 23, 8, {0}},
    {"QUAD", 9, 28, 9, {0}},
    {"SHELL", 3, 5, 3, {0}},
    {"SHELL", 4, 9, 4, {0}},
    {"SHELL", 8, 23, 8, {0}},
    {"SHELL", 9, 28, 9, {0}},
    {"TRI", 3, 5, 3, {0}},
    {"TRI", 6, 22, 6, {0}},
    {"TRI", 7, 34, 7, {0}},
    {"BAR", 0, LINE, 2, {0}},
    {"BEAM", 0, LINE, 2, {0}},
    {"TRUSS", 0, LINE, 2, {0}},
    {"EDGE", 0, LINE, 2, {0}},
    {"ROD", 0, LINE, 2, {0}},
    {"SPRING", 0, LINE, 2, {0}},
    {"SPHERE", 0, VERTEX, 1, {0}},
    {"CIRCLE", 0, VERTEX, 1, {0}},
    {"POINT", 0, VERTEX, 1, {0}},
};

const fg__exodus_shape *fg__exodus_shape_find(const char *name, size_t nodes)
{
  for (size_t i = 0; i < sizeof SHAPES / sizeof *SHAPES; ++i)
    if (strncasecmp(name, SHAPES[i].begins, strlen(SHAPES[i].begins)) == 0 &&
        (SHAPES[i].nodes == 0 ? nodes >= (size_t)SHAPES[i].taken
                              : nodes == (size_t)SHAPES[i].nodes))
      return &SHAPES[i];
  return NULL;
}

/* Its own name, else "block_10" for its identity. */
static void name_block(fg__exodus_block *block, const fg__exodus *e)
{
  double identity = block->number;
  const size_t first = (size_t)block->number - 1, one = 1;
  const fg__variable *v = fg__dataset_find(&e->file, "eb_prop1");
  fg__exodus_text(block->name, e, "eb_names", first);
  if (block->name[0])
    return;
  if (v && v->rank == 1 && e->file.dimensions[v->dimension[0]].length > first)
    (void)fg__exodus_numbers(&identity, e, v, &first, &one, 1);
  snprintf(block->name, sizeof block->name, "block_%.0f", identity);
}

static fg_status describe_block(fg__exodus_block *block, const fg__exodus *e)
{
  const fg__variable *v = block->nodes;
  char type[FG__EXODUS_NAME];
  if (v->rank != 2)
    return fg__fail(e->file.context, FG_STATUS_FILE_FORMAT,
                    "%s: '%.100s' is no list of elements' nodes: it has %d dimensions",
                    v->path, v->name, v->rank);
  block->cells = e->file.dimensions[v->dimension[0]].length;
  block->per_cell = e->file.dimensions[v->dimension[1]].length;
  fg__attribute_text(v, "elem_type", type, sizeof type);
  fg_status status = fg__exodus_check(e, v, (size_t[2]){0, 0},
                                      (size_t[2]){block->cells, block->per_cell}, 2);
  if (status != FG_STATUS_OK)
    return status;
  block->shape = fg__exodus_shape_find(type, block->per_cell);
  if (block->shape)
    return FG_STATUS_OK;
  fg__fail(e->file.context, FG_STATUS_UNSUPPORTED,
           "%s: block %d has elements of type \"%.60s\" with %zu nodes; only linear and "
           "quadratic cells can be read",
           v->path, block->number, type, block->per_cell);
  fg__hint(e->file.context, "%s", FG__RESAMPLE);
  return FG_STATUS_UNSUPPORTED;
}

static fg_status fail_name(const fg__exodus *e, const char *wanted, size_t count)
{
  fg__names names = {0};
  for (size_t i = 0; i < count; ++i)
    fg__names_add(&names, ", ", "%s", e->block[i].name);
  fg__fail(e->file.context, FG_STATUS_ARGUMENT, "%s: there is no block \"%.100s\"",
           e->file.file[0].path, wanted);
  fg__hint(e->file.context, "the blocks are: %s", names.text);
  return FG_STATUS_ARGUMENT;
}

/* Blocks that have elements; those without have no list of nodes. */
static fg_status list_blocks(fg__exodus *e)
{
  const size_t count = fg__exodus_length(e, "num_el_blk");
  if (count > e->file.file[0].size / 4) /* bytes of its status and of its identity */
    return fg__fail(e->file.context, FG_STATUS_FILE_FORMAT,
                    "%s: %zu blocks of elements in a file of %zu bytes",
                    e->file.file[0].path, count, e->file.file[0].size);
  e->block = fg__allocate(count, sizeof *e->block);
  if (!e->block)
    return fg__fail_memory(e->file.context, "blocks", count * sizeof *e->block);
  for (size_t i = 0; i < count; ++i) {
    char name[32];
    snprintf(name, sizeof name, "connect%zu", i + 1);
    fg__exodus_block *block = &e->block[e->blocks];
    *block = (fg__exodus_block){.nodes = fg__dataset_find(&e->file, name),
                                .number = (int)i + 1};
    if (!block->nodes)
      continue;
    name_block(block, e);
    ++e->blocks;
  }
  return FG_STATUS_OK;
}

fg_status fg__exodus_blocks(fg__exodus *e, const char *wanted)
{
  fg_status status = list_blocks(e);
  const size_t count = e->blocks;
  e->blocks = 0;
  for (size_t i = 0; i < count && status == FG_STATUS_OK; ++i) {
    fg__exodus_block block = e->block[i];
    if (wanted && strcmp(block.name, wanted) != 0)
      continue;
    status = describe_block(&block, e);
    e->block[e->blocks++] = block;
    if (status == FG_STATUS_OK && block.cells > INT_MAX - e->cells)
      status = fg__fail(e->file.context, FG_STATUS_UNSUPPORTED, "%s: more than %d cells",
                        e->file.file[0].path, INT_MAX);
    e->cells += block.cells;
  }
  if (status != FG_STATUS_OK || e->blocks > 0)
    return status;
  return wanted ? fail_name(e, wanted, count)
                : fg__fail(e->file.context, FG_STATUS_FILE_FORMAT,
                           "%s: none of its blocks has elements", e->file.file[0].path);
}

/* Adds the cells of a block, whose nodes count from 1, in VTK's order. */
static fg_status add_block(fg__dataset *data, const fg__exodus *e,
                           const fg__exodus_block *block)
{
  const size_t first[2] = {0, 0}, count[2] = {block->cells, block->per_cell};
  const fg__exodus_shape *shape = block->shape;
  const fg__piece_points points = {0, e->points};
  double *node = fg__allocate(block->cells * block->per_cell, sizeof *node);
  if (!node)
    return fg__fail_memory(data->context, "cells", block->cells * block->per_cell * 8);
  fg_status status = fg__exodus_numbers(node, e, block->nodes, first, count, 2);
  for (size_t c = 0; c < block->cells && status == FG_STATUS_OK; ++c) {
    double corner[FG__EXODUS_NODES];
    for (int i = 0; i < shape->taken; ++i)
      corner[i] =
          node[c * block->per_cell + (size_t)(shape->order[1] ? shape->order[i] : i)] -
          1.0;
    status = fg__topology_add(data, shape->type, corner, (size_t)shape->taken, NULL, 0,
                              &points);
  }
  free(node);
  return status;
}

fg_status fg__exodus_add_cells(fg__dataset *data, const fg__exodus *e)
{
  fg_status status = FG_STATUS_OK;
  for (size_t b = 0; b < e->blocks && status == FG_STATUS_OK; ++b)
    status = add_block(data, e, &e->block[b]);
  return status;
}
