/* What the page of a field in 2D holds of a run's arrows. */
#include "base/context.h"
#include "base/memory.h"
#include "icon/icons.h"
#include "icon/outline/smooth_line.h"
#include "icon/row.h"
#include "write/view/parts.h"

#include <stdlib.h>

/* A row for each arrow: its id, then its numbers. */
enum { ID, NUMBERS, COLUMNS = NUMBERS + FG__ROW_COLUMNS };

/* The icons with their lines as pictures draw them. */
static fg_status smooth_all(fg_icons **out, fg_context *context, const fg_icons *icons)
{
  fg_status status = fg__icons_create_empty(out, context);
  for (int n = 0; n < fg_icons_count(icons) && !status; ++n) {
    fg_icon icon = *fg_icons_at(icons, n);
    double(*smooth)[3] = NULL;
    int count = 0;
    if (!fg__icon_smooth(&smooth, &count, &icon))
      status = fg__fail_memory(context, "a page's arrows", sizeof icon);
    if (smooth) {
      icon.points = (const double(*)[3])smooth;
      icon.point_count = count;
    }
    if (!status)
      status = fg__icons_add(*out, context, &icon);
    free(smooth);
  }
  return status;
}

static fg_status write_arrows(FILE *stream, fg_context *context, const fg_icons *icons)
{
  const size_t count = (size_t)fg_icons_count(icons);
  double *rows = fg__allocate(count * COLUMNS + 1, sizeof *rows);
  for (size_t n = 0; rows && n < count; ++n) {
    const fg_icon *icon = fg_icons_at(icons, (int)n);
    rows[n * COLUMNS + ID] = icon->id;
    fg__icon_row(rows + n * COLUMNS + NUMBERS, icon);
  }
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

fg_status fg__view_arrows(FILE *stream, fg_context *context, const fg_icons *icons)
{
  fg_icons *drawn = NULL;
  fg_status status = smooth_all(&drawn, context, icons);
  if (!status)
    status = write_arrows(stream, context, drawn);
  fg_icons_destroy(drawn);
  return status;
}
