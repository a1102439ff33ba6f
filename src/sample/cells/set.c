#include "sample/cells/set.h"

#include <limits.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"

void fg__cell_set_clear(fg__cell_set *set)
{
  free(set->position);
  free(set->shape);
  free(set->number);
  free(set->first);
  free(set->corner);
  free(set->place);
  free(set->middle);
  free(set->parent);
  *set = (fg__cell_set){0};
}

static bool grow_cells(fg__cell_set *set)
{
  if (set->count < set->capacity)
    return true;
  size_t capacity = set->capacity;
  void *shape = set->shape, *number = set->number, *first = set->first;
  bool grown = fg__grow(&shape, &capacity, set->count + 1, sizeof *set->shape);
  set->shape = shape;
  capacity = set->capacity;
  grown = grown && fg__grow(&number, &capacity, set->count + 1, sizeof *set->number);
  set->number = number;
  capacity = set->capacity;
  grown = grown && fg__grow(&first, &capacity, set->count + 1, sizeof *set->first);
  set->first = first;
  if (grown)
    set->capacity = capacity;
  return grown;
}

fg_status fg__cell_set_add_points(fg__cell_set *set, fg__cell_shape shape,
                                  const int *point, int number)
{
  const size_t corners = (size_t)fg__cell_corners(shape);
  void *all = set->corner;
  if (set->corners > INT_MAX - corners)
    return fg__fail(set->context, FG_STATUS_UNSUPPORTED, "%s: more than %d corners",
                    set->path, INT_MAX);
  if (!grow_cells(set) || !fg__grow(&all, &set->corners_capacity, set->corners + corners,
                                    sizeof *set->corner))
    return fg__fail_memory(set->context, "cells", set->corners * sizeof *set->corner);
  set->corner = all;
  memcpy(set->corner + set->corners, point, corners * sizeof *point);
  set->shape[set->count] = (unsigned char)shape;
  set->number[set->count] = number;
  set->first[set->count++] = set->corners;
  set->corners += corners;
  return FG_STATUS_OK;
}

const double *fg__cell_set_corner(const fg__cell_set *set, size_t cell, int corner)
{
  return set->position + 3 * (size_t)set->corner[set->first[cell] + (size_t)corner];
}

/* How much of a middle's value each of its corners has, and each of the points between
 * two: serendipity functions of a quad (4, 4) and of a hexahedron (8, 12). */
static const double SHARE_OF_CORNER = -0.25;

static double share_of_between(const fg__cell_middle *middle)
{
  return (1.0 + 0.25 * middle->corners) / middle->betweens;
}

void fg__cell_set_fill_middles(float *of_point, const fg__cell_set *set)
{
  for (size_t m = 0; m < set->middles; ++m) {
    const fg__cell_middle *middle = &set->middle[m];
    const int *parent = set->parent + middle->first;
    double sum = 0.0;
    for (int i = 0; i < middle->corners + middle->betweens; ++i)
      sum += (i < middle->corners ? SHARE_OF_CORNER : share_of_between(middle)) *
             (double)of_point[parent[i]];
    of_point[set->file_points + m] = (float)sum;
  }
}

static void place_middle(double out[3], const fg__cell_set *set,
                         const fg__cell_middle *middle)
{
  const int *parent = set->parent + middle->first;
  out[0] = out[1] = out[2] = 0.0;
  for (int i = 0; i < middle->corners + middle->betweens; ++i)
    for (int k = 0; k < 3; ++k)
      out[k] += (i < middle->corners ? SHARE_OF_CORNER : share_of_between(middle)) *
                set->position[3 * (size_t)parent[i] + (size_t)k];
}

/* The middles become points after the file's. */
static fg_status place_middles(fg__cell_set *set)
{
  set->file_points = set->points;
  if (set->middles == 0)
    return FG_STATUS_OK;
  if (set->middles > INT_MAX - set->points)
    return fg__fail(set->context, FG_STATUS_UNSUPPORTED, "%s: more than %d points",
                    set->path, INT_MAX);
  const size_t points = set->points + set->middles;
  double *position = realloc(set->position, points * 3 * sizeof *position);
  if (!position)
    return fg__fail_memory(set->context, "points", points * 3 * sizeof *position);
  set->position = position;
  for (size_t m = 0; m < set->middles; ++m)
    place_middle(position + 3 * (set->points + m), set, &set->middle[m]);
  for (size_t i = 0; i < set->corners; ++i)
    if (set->corner[i] < 0)
      set->corner[i] = (int)(set->points + (size_t)(-1 - set->corner[i]));
  set->points = points;
  return FG_STATUS_OK;
}

size_t fg__cell_set_count(const fg__cell_set *set)
{
  size_t count = 0;
  for (size_t c = 0; c < set->count; ++c)
    count += c == 0 || set->number[c] != set->number[c - 1];
  return count;
}

/* Keeps cells of the largest dimension alone. */
static void drop_lower(fg__cell_set *set)
{
  int most = 0;
  size_t kept = 0;
  for (size_t c = 0; c < set->count; ++c)
    if (fg__cell_dimension(set->shape[c]) > most)
      most = fg__cell_dimension(set->shape[c]);
  for (size_t c = 0; c < set->count; ++c)
    if (fg__cell_dimension(set->shape[c]) == most) {
      set->shape[kept] = set->shape[c];
      set->number[kept] = set->number[c];
      set->first[kept++] = set->first[c];
    }
  set->count = kept;
}

fg_status fg__cell_set_locate(fg__cell_set *set)
{
  if (set->count == 0) {
    fg__fail(set->context, FG_STATUS_UNSUPPORTED,
             "%s: none of its %zu cells has an area or a volume", set->path,
             set->numbers);
    fg__hint(set->context, "points alone are read from tables: save them as .csv, by "
                           "ParaView's Save Data");
    return FG_STATUS_UNSUPPORTED;
  }
  drop_lower(set);
  fg_status status = place_middles(set);
  if (status == FG_STATUS_OK)
    status = fg__cell_set_choose_raster(set);
  return status == FG_STATUS_OK ? fg__cell_set_find_places(set) : status;
}

fg_status fg__cell_set_to_points(float *of_point, const fg__cell_set *set,
                                 const float *of_cell)
{
  double *sum = fg__allocate(set->points, sizeof *sum);
  int *cells = fg__allocate(set->points, sizeof *cells);
  int *latest = fg__allocate(set->points, sizeof *latest); /* 1 + the cell counted last */
  if (!sum || !cells || !latest) {
    free(sum);
    free(cells);
    free(latest);
    return fg__fail_memory(set->context, "means of cells", set->points * 16);
  }
  for (size_t c = 0; c < set->count; ++c)
    for (int i = 0; i < fg__cell_corners(set->shape[c]); ++i) {
      const int point = set->corner[set->first[c] + (size_t)i];
      if (latest[point] == 1 + set->number[c])
        continue; /* by another of its parts */
      latest[point] = 1 + set->number[c];
      sum[point] += (double)of_cell[set->number[c]];
      ++cells[point];
    }
  for (size_t p = 0; p < set->points; ++p)
    of_point[p] = cells[p] > 0 ? (float)(sum[p] / cells[p]) : NAN;
  free(sum);
  free(cells);
  free(latest);
  return FG_STATUS_OK;
}

void fg__cell_set_sample(float *out, const fg__cell_set *set, const float *of_point,
                         size_t first, size_t count)
{
  for (size_t n = 0; n < count; ++n) {
    const fg__cell_place *place = &set->place[first + n];
    out[n] = NAN;
    if (place->cell < 0)
      continue;
    const fg__cell_shape shape = set->shape[place->cell];
    const int *corner = set->corner + set->first[place->cell];
    double weight[FG__CELL_CORNERS], sum = 0.0;
    const double at[3] = {(double)place->at[0], (double)place->at[1],
                          (double)place->at[2]};
    fg__cell_weights(shape, at, weight, NULL);
    for (int i = 0; i < fg__cell_corners(shape); ++i)
      sum += weight[i] * (double)of_point[corner[i]];
    out[n] = (float)sum;
  }
}
