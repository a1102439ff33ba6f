#include "mesh/refinement.h"

#include <stdlib.h>
#include <string.h>

#include "base/memory.h"

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
               (int)kind, (size_t)part.nodes[0]);
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
  const fg__partition *own = &mesh->cover[level];
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
  for (int n = 0; level > 0 && n < mesh->cover[level - 1].count; ++n) {
    const fg__partition *finer = &mesh->cover[level - 1];
    fg__box cells = fg__box_cells(finer, &finer->box[n]);
    for (int k = 0; k < mesh->dimension; ++k) {
      cells.first[k] /= 2;
      cells.nodes[k] /= 2;
    }
    paint_images(&on, own, &cells, FG__CELL_REFINED);
  }
}
