#include "base/context.h"
#include "base/memory.h"
#include "write/view/parts.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { PASSES = 10 };

/* On a side of the box is what is nearer to it than a step of a place. */
static const double SIDE = 1.0 / FG__VIEW_STEPS;

/* A vertex, and the cell that it lies in. */
typedef struct placed_vertex {
  uint64_t cell;
  int vertex;
} placed_vertex;

typedef struct packed_surface {
  placed_vertex *order; /* of the surface's vertices, by cell */
  int *merged;          /* of each vertex of the surface, the one that it becomes */
  double (*mean)[3];    /* places of those, from 0 to 1 in the box */
  double (*sum)[4];     /* of their neighbours' places, and how many */
  int32_t *place[3];    /* the same, on a raster of FG__VIEW_STEPS */
  int32_t *corner;
  size_t vertices, corners;
} packed_surface;

static int by_cell(const void *a, const void *b)
{
  const placed_vertex *one = a, *other = b;
  if (one->cell != other->cell)
    return one->cell < other->cell ? -1 : 1;
  return (one->vertex > other->vertex) - (one->vertex < other->vertex);
}

static bool make_room(packed_surface *out, const fg_surface *s)
{
  const size_t vertices = (size_t)s->vertex_count;
  *out = (packed_surface){
      .order = fg__allocate(vertices, sizeof *out->order),
      .merged = fg__allocate(vertices, sizeof *out->merged),
      .mean = fg__allocate(vertices, sizeof *out->mean),
      .sum = fg__allocate(vertices, sizeof *out->sum),
      .corner = fg__allocate((size_t)3 * (size_t)s->triangle_count, sizeof *out->corner)};
  bool room = out->order && out->merged && out->mean && out->sum && out->corner;
  for (int k = 0; k < 3; ++k) {
    out->place[k] = fg__allocate(vertices, sizeof *out->place[k]);
    room = room && out->place[k];
  }
  return room;
}

static void clear(packed_surface *s)
{
  free(s->order);
  free(s->merged);
  free(s->mean);
  free(s->sum);
  free(s->corner);
  for (int k = 0; k < 3; ++k)
    free(s->place[k]);
}

/* Vertices on a side of the box are merged among themselves, so that the surface still
 * ends there. */
static void sort_vertices(packed_surface *out, const fg_surface *s, const double low[3],
                          const double high[3], double cell)
{
  for (int n = 0; n < s->vertex_count; ++n) {
    uint64_t index = 0, sides = 0;
    for (int k = 2; k >= 0; --k) {
      const double far = s->vertex[n][k] - low[k], side = high[k] - low[k];
      index = index << 18 | (uint64_t)fmin(fmax(floor(far / cell), 0.0), 262143.0);
      sides = sides << 2 | (uint64_t)(far < SIDE * side) |
              (uint64_t)(far > (1.0 - SIDE) * side) << 1;
    }
    out->order[n] = (placed_vertex){index << 6 | sides, n};
  }
  qsort(out->order, (size_t)s->vertex_count, sizeof *out->order, by_cell);
}

/* The vertices of a cell become their mean. */
static void merge(packed_surface *out, const fg_surface *s, const double low[3],
                  const double high[3])
{
  const size_t count = (size_t)s->vertex_count;
  for (size_t first = 0, end = 0; first < count; first = end) {
    double sum[3] = {0.0, 0.0, 0.0};
    for (end = first; end < count && out->order[end].cell == out->order[first].cell;
         ++end) {
      const int vertex = out->order[end].vertex;
      out->merged[vertex] = (int)out->vertices;
      for (int k = 0; k < 3; ++k)
        sum[k] += s->vertex[vertex][k];
    }
    for (int k = 0; k < 3; ++k) {
      const double share = (sum[k] / (double)(end - first) - low[k]) / (high[k] - low[k]);
      out->mean[out->vertices][k] = fmin(fmax(share, 0.0), 1.0);
    }
    ++out->vertices;
  }
}

/* A triangle by its corners in ascending order, and whether that goes round as it does.
 */
typedef struct merged_triangle {
  int32_t corner[3];
  size_t first; /* where its corners lie */
  int way;
} merged_triangle;

static int by_corners(const void *a, const void *b)
{
  const merged_triangle *one = a, *other = b;
  for (int k = 0; k < 3; ++k)
    if (one->corner[k] != other->corner[k])
      return one->corner[k] < other->corner[k] ? -1 : 1;
  return (one->first > other->first) - (one->first < other->first);
}

static void swap_if_greater(merged_triangle *t, int a, int b)
{
  if (t->corner[a] <= t->corner[b])
    return;
  const int32_t kept = t->corner[a];
  t->corner[a] = t->corner[b];
  t->corner[b] = kept;
  t->way = -t->way;
}

static merged_triangle sorted(const int32_t *corner, size_t first)
{
  merged_triangle out = {{corner[0], corner[1], corner[2]}, first, 1};
  swap_if_greater(&out, 0, 1);
  swap_if_greater(&out, 1, 2);
  swap_if_greater(&out, 0, 1);
  return out;
}

/* Triangles that still have three corners. */
static void take_triangles(packed_surface *out, const fg_surface *s)
{
  for (int n = 0; n < s->triangle_count; ++n) {
    int32_t *corner = out->corner + out->corners;
    for (int k = 0; k < 3; ++k)
      corner[k] = out->merged[s->corner[s->triangle[n][k]]];
    if (corner[0] != corner[1] && corner[1] != corner[2] && corner[2] != corner[0])
      out->corners += 3;
  }
}

/* Two triangles that lie on each other back to back hold nothing: both go. Of several
 * that are alike one stays. False: no memory. */
static bool drop_folds(packed_surface *s)
{
  const size_t count = s->corners / 3;
  merged_triangle *all = fg__allocate(count, sizeof *all);
  if (!all)
    return false;
  for (size_t n = 0; n < count; ++n)
    all[n] = sorted(s->corner + 3 * n, 3 * n);
  qsort(all, count, sizeof *all, by_corners);
  for (size_t n = 0, end; n < count; n = end) {
    int ways = 0;
    for (end = n;
         end < count && memcmp(all[end].corner, all[n].corner, sizeof all[n].corner) == 0;
         ++end)
      ways += all[end].way;
    bool kept = false;
    for (size_t k = n; k < end; ++k) {
      const bool keep = !kept && ways * all[k].way > 0;
      kept = kept || keep;
      if (!keep)
        s->corner[all[k].first] = -1;
    }
  }
  free(all);
  size_t left = 0;
  for (size_t n = 0; n < s->corners; n += 3)
    if (s->corner[n] >= 0) {
      memmove(s->corner + left, s->corner + n, 3 * sizeof *s->corner);
      left += 3;
    }
  s->corners = left;
  return true;
}

/* Moves each vertex by a share of the way to its neighbours' mean. Those on a side of the
 * box stay on it. */
static void relax(packed_surface *s, double share)
{
  for (size_t n = 0; n < s->vertices; ++n)
    for (int k = 0; k < 4; ++k)
      s->sum[n][k] = 0.0;
  for (size_t n = 0; n < s->corners; ++n) {
    const size_t first = n / 3 * 3;
    const double *next = s->mean[s->corner[first + (n + 1) % 3]];
    double *sum = s->sum[s->corner[n]];
    for (int k = 0; k < 3; ++k)
      sum[k] += next[k];
    sum[3] += 1.0;
  }
  for (size_t n = 0; n < s->vertices; ++n)
    for (int k = 0; k < 3 && s->sum[n][3] > 0.0; ++k) {
      const double at = s->mean[n][k], to = s->sum[n][k] / s->sum[n][3];
      if (at > SIDE && at < 1.0 - SIDE)
        s->mean[n][k] = fmin(fmax(at + share * (to - at), 0.0), 1.0);
    }
}

/* Merged triangles may lie over one another: smoothing without shrinking lays them flat
 * (Taubin 1995, with his shares). */
static void smooth(packed_surface *s)
{
  for (int pass = 0; pass < PASSES; ++pass) {
    relax(s, 0.33);
    relax(s, -0.34);
  }
  for (size_t n = 0; n < s->vertices; ++n)
    for (int k = 0; k < 3; ++k)
      s->place[k][n] = (int32_t)floor(FG__VIEW_STEPS * s->mean[n][k] + 0.5);
}

static bool write_all(FILE *stream, const packed_surface *s)
{
  static const char *const names[] = {"x", "y", "z"};
  bool done = true;
  fprintf(stream, "{\"vertices\":%zu,\"corners\":%zu", s->vertices, s->corners);
  for (int k = 0; k < 3 && done; ++k) {
    fprintf(stream, ",\"%s\":", names[k]);
    done = fg__view_packed(stream, s->place[k], s->vertices);
  }
  fputs(",\"triangles\":", stream);
  done = done && fg__view_packed(stream, s->corner, s->corners);
  putc('}', stream);
  return done;
}

fg_status fg__view_surface(FILE *stream, fg_context *context, const fg_surface *surface,
                           const double low[3], const double high[3], int cells)
{
  if (!surface || surface->triangle_count == 0) {
    fputs("null", stream);
    return FG_STATUS_OK;
  }
  packed_surface packed;
  bool done = make_room(&packed, surface);
  if (done) {
    double longest = 0.0;
    for (int k = 0; k < 3; ++k)
      longest = fmax(longest, high[k] - low[k]);
    sort_vertices(&packed, surface, low, high, longest / cells);
    merge(&packed, surface, low, high);
    take_triangles(&packed, surface);
    done = drop_folds(&packed);
  }
  if (done) {
    smooth(&packed);
    done = write_all(stream, &packed);
  }
  clear(&packed);
  return done ? FG_STATUS_OK
              : fg__fail_memory(context, "a page's surface",
                                (size_t)surface->vertex_count * sizeof(placed_vertex));
}
