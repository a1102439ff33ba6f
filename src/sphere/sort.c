/* Cells are sorted by where they lie. The sphere is projected from its centre onto the
 * faces of a cube, where the sides of cells are straight; each face is divided into
 * squares that know the cells in them. */
#include "base/memory.h"
#include "sphere/inside.h"

#include <stdlib.h>
#include <string.h>

/* Squares: about as many as cells, on each face no more than these a side. */
static const int MOST_SQUARES = 1 << 14;

/* Squares that a cell lies in, in the mean: some four where all cells are alike. */
static const int MOST_ENTRIES = 16;

/* Of the cells on a face. */
typedef struct face_sum {
  size_t cells;
  double low[2], high[2];
  double width[2]; /* of all cells */
} face_sum;

typedef struct sorting {
  fg__sphere *sphere;
  unsigned char *faces; /* [count] a bit for each face on which a cell has a part */
  int parts;
  face_sum (*part)[FG__SPHERE_FACES]; /* [parts] */
  face_sum sum[FG__SPHERE_FACES];
  int thread[FG__SPHERE_FACES];     /* that sorts the face */
  size_t lacking[FG__SPHERE_FACES]; /* bytes that were not to be had, or 0 */
} sorting;

/* The rectangle of a cell on face f; false when it has no part there. */
static bool cover(double low[2], double high[2], const fg__sphere *sphere, size_t n,
                  int f)
{
  int point[4];
  const int corners = fg__sphere_corners(sphere, n, point);
  low[0] = low[1] = HUGE_VAL;
  high[0] = high[1] = -HUGE_VAL;
  for (int k = 0; k < corners; ++k) {
    double at[2];
    if (!fg__sphere_onto_face(at, fg__sphere_position(sphere, point[k]), f))
      return false;
    for (int c = 0; c < 2; ++c) {
      low[c] = at[c] < low[c] ? at[c] : low[c];
      high[c] = at[c] > high[c] ? at[c] : high[c];
    }
  }
  for (int c = 0; c < 2; ++c) {
    if (low[c] > 1.0 || high[c] < -1.0)
      return false;
    low[c] = low[c] > -1.0 ? low[c] : -1.0;
    high[c] = high[c] < 1.0 ? high[c] : 1.0;
  }
  return true;
}

/* The face that a cell lies inside of, with all of its corners; -1 for more than one. */
static int only_face(const fg__sphere *sphere, size_t n)
{
  int point[4];
  const int corners = fg__sphere_corners(sphere, n, point);
  const int face = fg__sphere_face_of(fg__sphere_position(sphere, point[0]));
  const int axis = face / 2, first = axis == 2 ? 0 : axis + 1;
  const int second = first == 2 ? 0 : first + 1;
  for (int k = 0; k < corners; ++k) {
    const double *up = fg__sphere_position(sphere, point[k]);
    const double height = face & 1 ? -up[axis] : up[axis];
    if (!(fabs(up[first]) < height && fabs(up[second]) < height))
      return -1;
  }
  return face;
}

static void include(face_sum *sum, const double low[2], const double high[2])
{
  for (int c = 0; c < 2; ++c) {
    sum->low[c] = sum->cells == 0 || low[c] < sum->low[c] ? low[c] : sum->low[c];
    sum->high[c] = sum->cells == 0 || high[c] > sum->high[c] ? high[c] : sum->high[c];
    sum->width[c] += high[c] - low[c];
  }
  ++sum->cells;
}

/* Of a part's cells, on which faces they lie and where. */
static void mark_part(const sorting *work, int part)
{
  const fg__sphere *sphere = work->sphere;
  const size_t parts = (size_t)work->parts, count = sphere->count;
  const size_t end = count * ((size_t)part + 1) / parts;
  for (size_t n = count * (size_t)part / parts; n < end; ++n) {
    const int only = only_face(sphere, n);
    unsigned marks = 0;
    for (int f = only < 0 ? 0 : only; f < (only < 0 ? FG__SPHERE_FACES : only + 1); ++f) {
      double low[2], high[2];
      if (!cover(low, high, sphere, n, f))
        continue;
      marks |= 1U << f;
      include(&work->part[part][f], low, high);
    }
    work->faces[n] = (unsigned char)marks;
  }
}

static void mark_faces(void *argument, const fg__thread *thread)
{
  const sorting *work = argument;
  for (int k = thread->index; k < work->parts; k += thread->count)
    mark_part(work, k);
}

/* The parts' sums are added in their order, whichever thread made them. */
static void add_parts(sorting *work)
{
  for (int f = 0; f < FG__SPHERE_FACES; ++f)
    for (int k = 0; k < work->parts; ++k) {
      const face_sum *more = &work->part[k][f];
      face_sum *sum = &work->sum[f];
      for (int c = 0; c < 2 && more->cells > 0; ++c) {
        sum->low[c] = sum->cells == 0 ? more->low[c] : fmin(sum->low[c], more->low[c]);
        sum->high[c] =
            sum->cells == 0 ? more->high[c] : fmax(sum->high[c], more->high[c]);
        sum->width[c] += more->width[c];
      }
      sum->cells += more->cells;
    }
}

/* A face's cells are sorted by one thread, so that each square has them in one order: the
 * faces with the most cells go first, each to the thread that has the fewest. */
static void share_faces(sorting *work, int threads)
{
  size_t load[FG__SPHERE_FACES] = {0};
  bool given[FG__SPHERE_FACES] = {false};
  const int most = threads < FG__SPHERE_FACES ? threads : FG__SPHERE_FACES;
  for (int turn = 0; turn < FG__SPHERE_FACES; ++turn) {
    int next = -1, thread = 0;
    for (int f = 0; f < FG__SPHERE_FACES; ++f)
      if (!given[f] && (next < 0 || work->sum[f].cells > work->sum[next].cells))
        next = f;
    for (int k = 1; k < most; ++k)
      thread = load[k] < load[thread] ? k : thread;
    given[next] = true;
    load[thread] += work->sum[next].cells;
    work->thread[next] = thread;
  }
}

/* First and last square along each axis that a rectangle may have a part in. */
static void squares_of(int first[2], int last[2], const fg__sphere_face *face,
                       const double low[2], const double high[2])
{
  for (int c = 0; c < 2; ++c) {
    const int count = c == 0 ? face->columns : face->rows;
    const double from = (low[c] - face->low[c]) * face->inverse[c];
    const double to = (high[c] - face->low[c]) * face->inverse[c];
    const double slack = FG__SPHERE_ROUNDING * (to - from + 1.0);
    first[c] = fg__sphere_square(from - slack, count);
    last[c] = fg__sphere_square(to + slack, count);
  }
}

/* Squares of the mean cell's size, but no more than twice as many as cells. */
static void divide(fg__sphere_face *face, const face_sum *sum)
{
  for (int c = 0; c < 2; ++c) {
    face->low[c] = sum->low[c];
    face->high[c] = sum->high[c];
  }
  double side[2], squares = 1.0;
  for (int c = 0; c < 2; ++c) {
    const double length = face->high[c] - face->low[c];
    const double mean = sum->width[c] / (double)sum->cells;
    side[c] = mean > 0.0 ? ceil(length / mean) : 1.0;
    squares *= side[c];
  }
  const double most = 2.0 * (double)sum->cells + 1.0;
  const double factor = squares > most ? sqrt(most / squares) : 1.0;
  for (int c = 0; c < 2; ++c) {
    const double length = face->high[c] - face->low[c];
    const int count = 1 + fg__sphere_square(side[c] * factor, MOST_SQUARES);
    *(c == 0 ? &face->columns : &face->rows) = count;
    face->inverse[c] = length > 0.0 ? count / length : 1.0;
  }
}

/* Counts each square's cells, or once there is room for them puts them in, from
 * start[n + 1] downwards. Returns in how many squares cells lie, all in all. */
static uint64_t visit_squares(const sorting *work, int f)
{
  fg__sphere *sphere = work->sphere;
  fg__sphere_face *face = &sphere->face[f];
  uint64_t entries = 0;
  for (size_t n = 0; n < sphere->count; ++n) {
    double low[2], high[2];
    int first[2], last[2];
    if (!(work->faces[n] >> f & 1) || !cover(low, high, sphere, n, f))
      continue;
    squares_of(first, last, face, low, high);
    entries += (uint64_t)(last[0] - first[0] + 1) * (uint64_t)(last[1] - first[1] + 1);
    for (int j = first[1]; j <= last[1]; ++j)
      for (int i = first[0]; i <= last[0]; ++i) {
        uint32_t *start = &face->start[(size_t)j * (size_t)face->columns + (size_t)i];
        if (face->cell)
          face->cell[--*start] = (int)n;
        else
          ++*start;
      }
  }
  return entries;
}

static size_t squares_in(const fg__sphere_face *face)
{
  return (size_t)face->columns * (size_t)face->rows;
}

/* Counts the squares' cells. Squares become larger where cells of very different sizes
 * would lie in too many. */
static uint64_t count_in_squares(const sorting *work, int f)
{
  fg__sphere_face *face = &work->sphere->face[f];
  const uint64_t cells = work->sum[f].cells;
  uint64_t entries;
  while ((entries = visit_squares(work, f)) > (uint64_t)MOST_ENTRIES * cells) {
    memset(face->start, 0, squares_in(face) * sizeof *face->start);
    for (int c = 0; c < 2; ++c) {
      int *count = c == 0 ? &face->columns : &face->rows;
      face->inverse[c] *= (double)((*count + 1) / 2) / *count;
      *count = (*count + 1) / 2;
    }
  }
  return entries;
}

/* Returns the bytes that were not to be had, or 0. */
static size_t sort_face(const sorting *work, int f)
{
  fg__sphere_face *face = &work->sphere->face[f];
  if (work->sum[f].cells == 0)
    return 0;
  divide(face, &work->sum[f]);
  const size_t most = squares_in(face) + 1;
  face->start = fg__allocate(most, sizeof *face->start);
  if (!face->start)
    return most * sizeof *face->start;
  const uint64_t entries = count_in_squares(work, f);
  face->cell =
      entries < UINT32_MAX ? fg__allocate((size_t)entries, sizeof *face->cell) : NULL;
  if (!face->cell)
    return (size_t)entries * sizeof *face->cell;
  for (size_t n = 1; n <= squares_in(face); ++n)
    face->start[n] += face->start[n - 1];
  visit_squares(work, f);
  return 0;
}

static void sort_faces(void *argument, const fg__thread *thread)
{
  sorting *work = argument;
  for (int f = 0; f < FG__SPHERE_FACES; ++f)
    if (work->thread[f] == thread->index)
      work->lacking[f] = sort_face(work, f);
}

fg_status fg__sphere_sort_cells(fg__sphere *sphere, fg_context *context,
                                fg__threads *threads)
{
  sorting work = {.sphere = sphere, .parts = fg__sphere_parts(sphere)};
  fg_status status = FG_STATUS_OK;
  work.faces = fg__allocate(sphere->count, 1);
  work.part = fg__allocate((size_t)work.parts, sizeof *work.part);
  if (!work.faces || !work.part) {
    status = fg__fail_memory(context, "faces of cells", sphere->count);
    goto cleanup;
  }
  fg__threads_run(threads, mark_faces, &work);
  add_parts(&work);
  share_faces(&work, fg__threads_count(threads));
  fg__threads_run(threads, sort_faces, &work);
  for (int f = 0; f < FG__SPHERE_FACES && status == FG_STATUS_OK; ++f)
    if (work.lacking[f])
      status = fg__fail_memory(context, "squares of the sphere", work.lacking[f]);

cleanup:
  free(work.faces);
  free(work.part);
  return status;
}
