/* An icon in 2D as a row of numbers, as pages and the core for browsers pass it on;
 * viewer/ page/arrows.js and viewer/src/core.js read the columns in this order. */
#ifndef FG__ICON_ROW_H
#define FG__ICON_ROW_H

#include "flowgrain/icons.h"

enum {
  FG__ROW_AREA,
  FG__ROW_SPEED,
  FG__ROW_WIDTH,
  FG__ROW_TAIL_WIDTH,
  FG__ROW_HEAD_LENGTH,
  FG__ROW_HEAD_WIDTH,
  FG__ROW_CENTER,
  FG__ROW_SEED = FG__ROW_CENTER + 2,
  FG__ROW_WAY = FG__ROW_SEED + 2,
  FG__ROW_POINTS = FG__ROW_WAY + 2, /* how many; their places are in another table */
  FG__ROW_COLUMNS
};

static inline void fg__icon_row(double row[FG__ROW_COLUMNS], const fg_icon *icon)
{
  row[FG__ROW_AREA] = icon->area;
  row[FG__ROW_SPEED] = icon->speed;
  row[FG__ROW_WIDTH] = icon->width;
  row[FG__ROW_TAIL_WIDTH] = icon->tail_width;
  row[FG__ROW_HEAD_LENGTH] = icon->head_length;
  row[FG__ROW_HEAD_WIDTH] = icon->head_width;
  for (int k = 0; k < 2; ++k) {
    row[FG__ROW_CENTER + k] = icon->center[k];
    row[FG__ROW_SEED + k] = icon->seed[k];
    row[FG__ROW_WAY + k] = icon->way[k];
  }
  row[FG__ROW_POINTS] = icon->point_count;
}

#endif
