/* What the page of a field in 2D holds of a run's arrows. */
#include "base/context.h"
#include "base/memory.h"
#include "write/view/parts.h"

#include <stdlib.h>

/* A row for each arrow; viewer/page/arrows.js has the same list. */
enum {
  ID,
  AREA,
  SPEED,
  WIDTH,
  TAIL_WIDTH,
  HEAD_LENGTH,
  HEAD_WIDTH,
  CENTER,
  SEED = CENTER + 2,
  WAY = SEED + 2,
  POINTS = WAY + 2,
  COLUMNS
};

static void fill_row(double *row, const fg_icon *icon)
{
  row[ID] = icon->id;
  row[AREA] = icon->area;
  row[SPEED] = icon->speed;
  row[WIDTH] = icon->width;
  row[TAIL_WIDTH] = icon->tail_width;
  row[HEAD_LENGTH] = icon->head_length;
  row[HEAD_WIDTH] = icon->head_width;
  for (int k = 0; k < 2; ++k) {
    row[CENTER + k] = icon->center[k];
    row[SEED + k] = icon->seed[k];
    row[WAY + k] = icon->way[k];
  }
  row[POINTS] = icon->point_count;
}

fg_status fg__view_arrows(FILE *stream, fg_context *context, const fg_icons *icons)
{
  const size_t count = (size_t)fg_icons_count(icons);
  double *rows = fg__allocate(count * COLUMNS + 1, sizeof *rows);
  for (size_t n = 0; rows && n < count; ++n)
    fill_row(rows + n * COLUMNS, fg_icons_at(icons, (int)n));
  fputs("\"arrows\":{\"rows\":", stream);
  const bool done = rows && fg__view_bytes(stream, rows, count * COLUMNS * sizeof *rows);
  free(rows);
  putc(',', stream);
  fg_status status =
      done ? fg__view_paths(stream, context, icons, 2)
           : fg__fail_memory(context, "a page's arrows", count * COLUMNS * sizeof *rows);
  putc('}', stream);
  return status;
}
