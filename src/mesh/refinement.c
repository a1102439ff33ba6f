#include "mesh/refinement.h"

#include <stdlib.h>
#include <string.h>

#include "base/memory.h"

/* The nodes of a box that have a cell in `cells`, given by lower corners, beside them. */
static fg__box nodes_beside(const fg__box *cells, const fg__box *box, int dimension)
{
  fg__box nodes = *cells, inner = {{0, 0, 0}, {0, 0, 0}};
  for (int k = 0; k < 3; ++k) {
    nodes.nodes[k] += k < dimension;
    inner.nodes[k] = box->nodes[k];
  }
  return fg__box_intersection(&nodes, &inner);
}

/* Adds what the list lacks of a box. */
static bool add_missing(fg__box_list *list, const fg__box *added)
{
  fg__box_list missing = {0};
  bool done = fg__box_list_add(&missing, added);
  for (size_t n = 0; done && n < list->count; ++n)
    done = fg__box_list_take_out(&missing, &list->box[n]);
  for (size_t n = 0; done && n < missing.count; ++n)
    done = fg__box_list_add(list, &missing.box[n]);
  free(missing.box);
  return done;
}

static bool add_border(fg__uncovered **out, size_t *count, size_t *capacity, int box,
                       const fg__box_list *nodes)
{
  void *memory = *out;
  bool grown = fg__grow(&memory, capacity, *count + nodes->count, sizeof **out);
  *out = memory;
  for (size_t n = 0; grown && n < nodes->count; ++n)
    (*out)[(*count)++] = (fg__uncovered){box, nodes->box[n]};
  return grown;
}

fg_status fg__border_nodes(fg__uncovered **out, int *count, fg_context *context,
                           const fg__partition *level, const fg__uncovered *uncovered,
                           int uncovered_count)
{
  int own_count;
  const fg__box *own = fg__own_boxes(level, &own_count);
  size_t found = 0, capacity = 0;
  bool done = true;
  *out = NULL;
  for (int b = 0; done && b < own_count; ++b) {
    fg__box_list border = {0};
    for (int n = 0; done && n < uncovered_count; ++n) {
      if (uncovered[n].box != b)
        continue;
      fg__box nodes = nodes_beside(&uncovered[n].nodes, &own[b], level->dimension);
      if (!fg__box_is_empty(&nodes))
        done = add_missing(&border, &nodes);
    }
    done = done && add_border(out, &found, &capacity, b, &border);
    free(border.box);
  }
  *count = (int)found;
  if (done)
    return FG_STATUS_OK;
  free(*out);
  *out = NULL;
  return fg__fail_memory(context, "a level's border", found * sizeof **out);
}

typedef struct canvas {
  fg__box cells; /* in global indices */
  unsigned char *kind;
} canvas;

static void paint(const canvas *on, const fg__box *cells, fg__cell_kind kind)
{
  fg__box part = fg__box_intersection(&on->cells, cells);
  const int *size = on->cells.nodes;
  for (int k = 0; k < part.nodes[2]; ++k)
    for (int j = 0; j < part.nodes[1]; ++j) {
      size_t row = (size_t)(part.first[2] - on->cells.first[2] + k) * (size_t)size[1] +
                   (size_t)(part.first[1] - on->cells.first[1] + j);
      if (part.nodes[0] > 0)
        memset(on->kind + row * (size_t)size[0] + (part.first[0] - on->cells.first[0]),
               kind, (size_t)part.nodes[0]);
    }
}

/* Paints cells and their images round periodic axes and beyond natural borders. */
static void paint_images(const canvas *on, const fg__partition *level,
                         const fg__box *cells, fg__cell_kind kind)
{
  int depth = level->dimension == 3;
  for (int z = -depth; z <= depth; ++z)
    for (int y = -1; y <= 1; ++y)
      for (int x = -1; x <= 1; ++x) {
        const int side[3] = {x, y, z};
        fg__box image = *cells;
        for (int k = 0; k < 3; ++k) {
          int end = image.first[k] + image.nodes[k];
          if (side[k] != 0 && level->periodic[k])
            image.first[k] += side[k] * level->cells[k];
          else if (side[k] < 0)
            image.first[k] = -end;
          else if (side[k] > 0)
            image.first[k] = 2 * level->cells[k] - end;
        }
        paint(on, &image, kind);
      }
}

void fg__cell_kinds(unsigned char *out, const fg__mesh *mesh, int level,
                    const fg__box *box)
{
  const fg__partition *own = &mesh->level[level];
  canvas on = {.cells = *box, .kind = out};
  size_t count = 1;
  for (int k = 0; k < 3; ++k) {
    if (k < mesh->dimension) {
      --on.cells.first[k];
      ++on.cells.nodes[k];
    }
    count *= (size_t)on.cells.nodes[k];
  }
  memset(out, FG__CELL_OUTSIDE, count);
  for (int n = 0; n < own->count; ++n) {
    fg__box cells = fg__box_cells(own, &own->box[n]);
    paint_images(&on, own, &cells, FG__CELL_LEAF);
  }
  for (int n = 0; level > 0 && n < mesh->level[level - 1].count; ++n) {
    const fg__partition *finer = &mesh->level[level - 1];
    fg__box cells = fg__box_cells(finer, &finer->box[n]);
    for (int k = 0; k < mesh->dimension; ++k) {
      cells.first[k] /= 2;
      cells.nodes[k] /= 2;
    }
    paint_images(&on, own, &cells, FG__CELL_REFINED);
  }
}
