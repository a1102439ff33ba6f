#include "evolve/component_shape.h"

#include <string.h>

#include "base/memory.h"

/* Steps of a share, and more than the eight whole cells that a node can have. */
static const float share_steps = 0x1p24F, beyond_all_shares = 9.0F;
enum { whole_cell = 1 << 24 };

/* More than the shares of a whole cell's corners may lack for having been rounded. */
static const double rounding = 1e-4;

/* The root of a run's tree. */
static int find(struct fg__run *run, int index)
{
  while (run[index].parent != index) {
    run[index].parent = run[run[index].parent].parent;
    index = run[index].parent;
  }
  return index;
}

/* Joins two trees; the earlier root stays, so that a root is its piece's first run. */
static inline void join(struct fg__run *run, int a, int b)
{
  if (run[a].parent == run[b].parent)
    return;
  a = find(run, a);
  b = find(run, b);
  if (a < b)
    run[b].parent = a;
  else
    run[a].parent = b;
}

static inline int later(int a, int b)
{
  return a > b ? a : b;
}

static inline int earlier(int a, int b)
{
  return a < b ? a : b;
}

/* What one row of nodes is cut with. */
typedef struct cutter {
  fg__components *components;
  fg__shape shape;
  int run_count;
  unsigned char *marks; /* of the row's positive nodes; zeros before and after */
  unsigned char *cells; /* active cells round the x-edge that starts at each node, from
                           node -1; only with a mask */
  int *ends;            /* where runs start, and where each has ended */
  float *plane[2];      /* shares from the planes of cells before and after the row */
  float *space;
  int64_t
      enough; /* as in the box, in steps of a share; 0: every run is measured at once */
} cutter;

/* Marks the row's positive nodes, of a masked grid only those with an active cell. */
static void mark(cutter *c, int j, int k)
{
  const fg__shape *s = &c->shape;
  const float *u = fg__shape_row(s, j, k);
  int width = s->nodes[0];
  unsigned char *marks = c->marks, *cells = c->cells;
  for (int x = 0; x < width; ++x)
    marks[x] = u[x] > 0.0F;
  if (!s->active)
    return;
  fg__gate gate = fg__gate_of(s, j - 1, j, k - 1, k);
  for (int x = -1; x < width; ++x) {
    int cell = fg__shape_cell(s, 0, x);
    cells[x] = 0;
    for (int n = 0; n < gate.count && cell != FG__NOWHERE; ++n)
      cells[x] = (unsigned char)(cells[x] + (gate.row[n][cell] != 0));
  }
  for (int x = 0; x < width; ++x)
    marks[x] = marks[x] && (cells[x - 1] || cells[x]);
}

/* Eight marks, the first in the lowest byte. */
static uint64_t eight(const unsigned char *marks)
{
  uint64_t bytes;
  memcpy(&bytes, marks, sizeof bytes);
#if defined(__BYTE_ORDER__) && __BYTE_ORDER__ == __ORDER_BIG_ENDIAN__
  bytes = __builtin_bswap64(bytes);
#endif
  return bytes;
}

/* Lists where marks change, eight at once: most of a row lies wholly inside or outside.
 * The marks go on with zeros for 8 nodes at least. */
static int list_changes(const unsigned char *marks, int width, int *ends)
{
  int count = 0;
  for (int x = 0; x <= width; x += 8) {
    uint64_t changes = eight(marks + x) ^ eight(marks + x - 1);
    for (; changes; changes &= changes - 1)
      ends[count++] = x + __builtin_ctzll(changes) / 8;
  }
  return count;
}

/* The same with a mask: an edge without an active cell parts its nodes. */
static int list_changes_masked(const cutter *c, int *ends)
{
  int count = 0;
  for (int x = 0; x <= c->shape.nodes[0]; ++x) {
    bool before = c->marks[x - 1], here = c->marks[x];
    if (before && here && c->cells[x - 1])
      continue;
    if (before)
      ends[count++] = x;
    if (here)
      ends[count++] = x;
  }
  return count;
}

/* Nodes of a run, each counted for the part of the cells round it that is active, in
 * units of 2^-d cells. */
static int64_t covered_by(const cutter *c, const struct fg__run *run, int row_weight)
{
  if (c->shape.active) {
    int64_t sum = 0;
    for (int x = run->first; x <= run->last; ++x)
      sum += c->cells[x - 1] + c->cells[x];
    return sum;
  }
  const fg__shape *s = &c->shape;
  int64_t halves = 2 * ((int64_t)run->last - run->first + 1);
  if (run->first == 0 && s->low[0] == FG__SIDE_BORDER)
    --halves;
  if (run->last == s->nodes[0] - 1 && s->high[0] == FG__SIDE_BORDER)
    --halves;
  return halves * row_weight;
}

/* Rows of cells round a row of nodes. */
static int row_weight(const fg__shape *s, int j, int k)
{
  int weight[2];
  for (int axis = 1; axis <= 2; ++axis) {
    int index = axis == 1 ? j : k;
    weight[axis - 1] = (fg__shape_cell(s, axis, index - 1) != FG__NOWHERE) +
                       (fg__shape_cell(s, axis, index) != FG__NOWHERE);
  }
  return weight[0] * weight[1];
}

/* The share of every node of a row in whole steps; of no meaning where u is not positive.
 * Two loops, each of which compilers turn into vector instructions. */
static void count_steps(const float *u, const float *before, const float *after,
                        fg__stretch nodes, float *share, int *steps)
{
  for (int x = nodes.first; x <= nodes.last; ++x) {
    float of_node = u[x] * (before[x] + after[x]);
    share[x] = of_node < beyond_all_shares ? of_node : 0.0F; /* u may be infinite */
  }
  for (int x = nodes.first; x <= nodes.last; ++x)
    steps[x] = (int)(share[x] * share_steps);
}

static int *steps_of(const cutter *c)
{
  return c->ends + 2 * c->shape.nodes[0] + 2;
}

/* The steps of a stretch of row (j, k), from the shares in `plane`. */
static void measure(const cutter *c, int j, int k, fg__stretch nodes)
{
  ptrdiff_t row = (ptrdiff_t)j * c->shape.nodes[0];
  count_steps(fg__shape_row(&c->shape, j, k), c->plane[0] + row, c->plane[1] + row, nodes,
              c->space, steps_of(c));
}

static int64_t steps_within(const cutter *c, int first, int last)
{
  const int *steps = steps_of(c);
  int64_t sum = 0;
  for (int x = first; x <= last; ++x)
    sum += steps[x];
  return sum;
}

static void add_run(cutter *c, int first, int last)
{
  int number = c->run_count++;
  c->components->run[number] =
      (struct fg__run){.parent = number,
                       .first = first,
                       .last = last,
                       .size = c->enough ? 0 : steps_within(c, first, last)};
}

/* Cuts row (j, k) into runs; returns what they cover. */
static int64_t cut_row(cutter *c, int j, int k)
{
  const fg__shape *s = &c->shape;
  int width = s->nodes[0], first = c->run_count;
  mark(c, j, k);
  int ends = s->active ? list_changes_masked(c, c->ends)
                       : list_changes(c->marks, width, c->ends);
  if (ends == 0)
    return 0;
  if (!c->enough)
    measure(c, j, k, (fg__stretch){0, width - 1});
  int weight = row_weight(s, j, k);
  int64_t covered = 0;
  for (int n = 0; n < ends; n += 2) {
    add_run(c, c->ends[n], c->ends[n + 1] - 1);
    covered += covered_by(c, &c->components->run[c->run_count - 1], weight);
  }
  struct fg__run *run = c->components->run;
  int last = c->run_count - 1;
  if (s->low[0] == FG__SIDE_WRAP && run[first].first == 0 &&
      run[last].last == width - 1 && (!s->active || c->cells[-1]))
    join(run, first, last);
  return covered;
}

/* Whether the face of corners (x, row a), (x + 1, row b) > 0 joins them. */
static bool face_joins(const fg__shape *s, const float *a, const float *b, int x,
                       const fg__gate *gate)
{
  int next = fg__shape_node(s, 0, x + 1);
  return fg__gate_open(gate, s, x, x) &&
         fg__components_saddle_joins(a[x], a[next], b[x], b[next]);
}

/* Joins the runs of two rows that are neighbours along the middle or the outer axis. The
 * gate's cells adjoin both. */
static void join_rows(cutter *c, const int a[2], const int b[2], const fg__gate *gate)
{
  const fg__shape *s = &c->shape;
  const int *run_of_row = c->components->run_of_row;
  struct fg__run *run = c->components->run;
  const float *row_a = fg__shape_row(s, a[0], a[1]);
  const float *row_b = fg__shape_row(s, b[0], b[1]);
  int number_a = fg__row_number(s, a[0], a[1]), number_b = fg__row_number(s, b[0], b[1]);
  int m = run_of_row[number_a], m_end = run_of_row[number_a + 1];
  int n = run_of_row[number_b], n_end = run_of_row[number_b + 1];
  if (m == m_end || n == n_end)
    return;
  if (s->low[0] == FG__SIDE_WRAP) {
    int end = s->nodes[0] - 1;
    if (run[m_end - 1].last == end && run[n].first == 0 &&
        face_joins(s, row_a, row_b, end, gate))
      join(run, m_end - 1, n);
    if (run[n_end - 1].last == end && run[m].first == 0 &&
        face_joins(s, row_b, row_a, end, gate))
      join(run, n_end - 1, m);
  }
  const struct fg__run *p = run + m, *p_end = run + m_end;
  const struct fg__run *q = run + n, *q_end = run + n_end;
  while (p < p_end && q < q_end) {
    int low = later(p->first, q->first), high = earlier(p->last, q->last);
    if (low <= high) {
      if (p->parent != q->parent && fg__gate_open(gate, s, low - 1, high))
        join(run, (int)(p - run), (int)(q - run));
      if (c->enough) /* cells that are positive throughout */
        run[p - run].size += (int64_t)(high - low) * whole_cell;
    } else if (low == high + 1) {
      bool forward = p->last == high;
      if (face_joins(s, forward ? row_a : row_b, forward ? row_b : row_a, high, gate))
        join(run, (int)(p - run), (int)(q - run));
    }
    bool p_ends_first = p->last < q->last; /* no branch: neither way is likelier */
    p += p_ends_first;
    q += !p_ends_first;
  }
}

/* Joins runs of two rows that face each other across the faces between them, whose other
 * corners lie in the rows `other`. Mostly those have joined them already. */
static void join_across(cutter *c, const int a[2], const int d[2], const fg__gate *gate)
{
  const fg__shape *s = &c->shape;
  const int *run_of_row = c->components->run_of_row;
  struct fg__run *run = c->components->run;
  const float *row_a = fg__shape_row(s, a[0], a[1]);
  const float *row_b = fg__shape_row(s, a[0], d[1]);
  const float *row_c = fg__shape_row(s, d[0], a[1]);
  const float *row_d = fg__shape_row(s, d[0], d[1]);
  int number_a = fg__row_number(s, a[0], a[1]), number_d = fg__row_number(s, d[0], d[1]);
  const struct fg__run *p = run + run_of_row[number_a];
  const struct fg__run *p_end = run + run_of_row[number_a + 1];
  const struct fg__run *q = run + run_of_row[number_d];
  const struct fg__run *q_end = run + run_of_row[number_d + 1];
  while (p < p_end && q < q_end) {
    int low = later(p->first, q->first), high = earlier(p->last, q->last);
    int m = (int)(p - run), n = (int)(q - run);
    bool p_ends_first = p->last < q->last;
    p += p_ends_first;
    q += !p_ends_first;
    if (low > high || run[m].parent == run[n].parent || find(run, m) == find(run, n))
      continue;
    for (int x = low; x <= high; ++x)
      if (fg__components_saddle_joins(row_a[x], row_b[x], row_c[x], row_d[x]) &&
          fg__gate_open(gate, s, x - 1, x)) {
        join(run, m, n);
        break;
      }
  }
}

/* Joins row (j, k) with those of plane `below`, across the plane of cells k - 1. */
static void join_below(cutter *c, int j, int k, int below)
{
  const fg__shape *s = &c->shape;
  const int row[2] = {j, k}, under[2] = {j, below};
  fg__gate gate = fg__gate_of(s, j - 1, j, k - 1, k - 1);
  join_rows(c, row, under, &gate);
  for (int side = -1; side <= 1; side += 2) {
    int cell = side < 0 ? j - 1 : j;
    int beside = fg__shape_node(s, 1, j + side);
    if (beside < 0 || beside >= s->nodes[1])
      continue;
    const int across[2] = {beside, below};
    gate = fg__gate_of(s, cell, cell, k - 1, k - 1);
    join_across(c, row, across, &gate);
  }
}

/* Joins row (j, k) with row `beside` of its plane, across the row of cells `cell`. */
static void join_beside(cutter *c, int j, int beside, int cell, int k)
{
  const int row[2] = {j, k}, other[2] = {beside, k};
  fg__gate gate = fg__gate_of(&c->shape, cell, cell, k - 1, k);
  join_rows(c, row, other, &gate);
}

static fg_status cut_plane(cutter *c, fg_context *context, int k, int64_t *covered)
{
  fg__components *components = c->components;
  const fg__shape *s = &c->shape;
  for (int j = 0; j < s->nodes[1]; ++j) {
    size_t needed = (size_t)c->run_count + (size_t)s->nodes[0];
    if (!fg__grow((void **)&components->run, &components->run_capacity, needed,
                  sizeof *components->run))
      return fg__fail_memory(context, "runs of nodes", needed * sizeof *components->run);
    int number = fg__row_number(s, j, k);
    components->run_of_row[number] = c->run_count;
    *covered += cut_row(c, j, k);
    components->run_of_row[number + 1] = c->run_count;
    if (j > 0)
      join_beside(c, j, j - 1, j - 1, k);
  }
  for (int j = 0; j < s->nodes[1] && k > 0; ++j)
    join_below(c, j, k, k - 1);
  if (s->high[1] == FG__SIDE_WRAP)
    join_beside(c, s->nodes[1] - 1, 0, s->nodes[1] - 1, k);
  return FG_STATUS_OK;
}

/* Gathers runs into pieces; a root comes before all its other runs. */
static fg_status gather_pieces(cutter *c, fg_context *context)
{
  fg__components *components = c->components;
  const fg__shape *s = &c->shape;
  struct fg__run *run = components->run;
  int rows = s->nodes[1] * s->nodes[2];
  components->piece_count = 0;
  for (int row = 0; row < rows; ++row)
    for (int n = components->run_of_row[row]; n < components->run_of_row[row + 1]; ++n) {
      if (run[n].parent != n) {
        run[n].piece = run[find(run, n)].piece;
        components->piece[run[n].piece].size += run[n].size;
        continue;
      }
      size_t needed = (size_t)components->piece_count + 1;
      if (!fg__grow((void **)&components->piece, &components->piece_capacity, needed,
                    sizeof *components->piece))
        return fg__fail_memory(context, "pieces of clusters",
                               needed * sizeof *components->piece);
      int64_t first = s->first + run[n].first + row % s->nodes[1] * s->step[1] +
                      row / s->nodes[1] * s->step[2];
      run[n].piece = components->piece_count++;
      components->piece[run[n].piece] = (fg__component_piece){first, run[n].size};
    }
  return FG_STATUS_OK;
}

/* Measures, in 2D, the pieces whose cells that are positive throughout are not enough.
 * Until it is known, -1 - size stands for the size of such a piece. */
static void measure_small_pieces(cutter *c)
{
  fg__components *components = c->components;
  const fg__shape *s = &c->shape;
  fg__component_piece *piece = components->piece;
  for (int n = 0; n < components->piece_count; ++n)
    if (piece[n].size < c->enough)
      piece[n].size = -1;
  for (int k = 0; k < s->nodes[2]; ++k)
    for (int n = components->run_of_row[k]; n < components->run_of_row[k + 1]; ++n) {
      const struct fg__run *run = &components->run[n];
      if (piece[run->piece].size >= 0)
        continue;
      const fg__stretch nodes = {run->first, run->last};
      fg__share_plane(s, k - 1, nodes, c->space, c->plane[0]);
      fg__share_plane(s, k, nodes, c->space, c->plane[1]);
      measure(c, 0, k, nodes);
      piece[run->piece].size -= steps_within(c, run->first, run->last);
    }
  for (int n = 0; n < components->piece_count; ++n)
    if (piece[n].size < 0)
      piece[n].size = -1 - piece[n].size;
}

static fg_status check_size(fg_context *context, const fg__component_box *box)
{
  bool flat = box->grid_nodes[2] <= 1;
  int64_t planes = flat ? 1 : box->nodes[2];
  int64_t rows = (int64_t)box->nodes[1] * planes;
  if (rows <= INT_MAX && rows * box->nodes[0] <= INT_MAX)
    return FG_STATUS_OK;
  return fg__fail(context, FG_STATUS_ARGUMENT,
                  "clusters: %d x %d x %d nodes are too many", box->nodes[0],
                  box->nodes[1], flat ? 1 : box->nodes[2]);
}

/* Working memory for a box; its parts follow each other in a few arrays. */
static fg_status take_memory(cutter *c, fg_context *context, const fg__component_box *box)
{
  fg__components *components = c->components;
  fg_status status = check_size(context, box);
  if (status)
    return status;
  c->shape = fg__shape_of(box);
  size_t width = (size_t)c->shape.nodes[0];
  size_t rows = (size_t)c->shape.nodes[1] * (size_t)c->shape.nodes[2];
  size_t plane = width * (size_t)c->shape.nodes[1];
  if (!fg__grow((void **)&components->run_of_row, &components->run_of_row_capacity,
                rows + 1, sizeof(int)) ||
      !fg__grow((void **)&components->ends, &components->ends_capacity, 3 * width + 2,
                sizeof(int)) ||
      !fg__grow((void **)&components->marks, &components->marks_capacity, width + 24,
                1) ||
      !fg__grow((void **)&components->cells, &components->cells_capacity, width + 2, 1) ||
      !fg__grow((void **)&components->shares, &components->shares_capacity,
                2 * plane + 4 * (width + 2), sizeof(float)))
    return fg__fail_memory(context, "working memory of clusters",
                           (rows + 3 * width + 2 * plane) * sizeof(float));
  memset(components->marks, 0, width + 24);
  c->marks = components->marks + 8;
  c->cells = components->cells + 1;
  c->ends = components->ends;
  c->plane[0] = components->shares;
  c->plane[1] = components->shares + plane;
  c->space = components->shares + 2 * plane;
  if (!box->u) {
    float *ones = c->space + 3 * (width + 2);
    for (size_t n = 0; n < width + 2; ++n)
      ones[n] = 1.0F;
    c->shape.ones = ones + 1;
  }
  if (box->enough > 0.0 && box->u && !box->active && c->shape.high[1] == FG__SIDE_FLAT)
    c->enough = 1 + (int64_t)(box->enough * (1.0 + rounding) * whole_cell);
  components->run_of_row[0] = 0;
  return FG_STATUS_OK;
}

/* In cells, of a number of 2^-d cells: exact. */
static double cells_of(const fg__shape *s, int64_t parts)
{
  return (double)parts * (s->high[1] == FG__SIDE_FLAT ? 0.25 : 0.125);
}

fg_status fg__components_cut(fg__components *components, fg_context *context,
                             const fg__component_box *box)
{
  cutter c = {.components = components};
  fg_status status = take_memory(&c, context, box);
  int64_t covered = 0;
  const fg__stretch all = {0, c.shape.nodes[0] - 1};
  if (!status && !c.enough)
    fg__share_plane(&c.shape, -1, all, c.space, c.plane[0]);
  for (int k = 0; !status && k < c.shape.nodes[2]; ++k) {
    if (!c.enough)
      fg__share_plane(&c.shape, k, all, c.space, c.plane[1]);
    status = cut_plane(&c, context, k, &covered);
    float *swap = c.plane[0];
    c.plane[0] = c.plane[1];
    c.plane[1] = swap;
  }
  if (status)
    return status;
  if (c.shape.high[2] == FG__SIDE_WRAP)
    for (int j = 0; j < c.shape.nodes[1]; ++j)
      join_below(&c, j, 0, c.shape.nodes[2] - 1);
  components->covered = cells_of(&c.shape, covered);
  status = gather_pieces(&c, context);
  if (!status && c.enough)
    measure_small_pieces(&c);
  return status;
}

fg_status fg__components_cover(fg__components *components, fg_context *context,
                               const fg__component_box *box)
{
  cutter c = {.components = components};
  fg_status status = take_memory(&c, context, box);
  if (status)
    return status;
  const fg__shape *s = &c.shape;
  int64_t covered = 0;
  for (int k = 0; k < s->nodes[2]; ++k)
    for (int j = 0; j < s->nodes[1]; ++j) {
      mark(&c, j, k);
      int64_t sum = 0;
      if (s->active) {
        for (int x = 0; x < s->nodes[0]; ++x)
          sum += c.marks[x] ? c.cells[x - 1] + c.cells[x] : 0;
        covered += sum;
        continue;
      }
      for (int x = 0; x < s->nodes[0]; ++x)
        sum += c.marks[x];
      sum *= 2;
      sum -= s->low[0] == FG__SIDE_BORDER && c.marks[0];
      sum -= s->high[0] == FG__SIDE_BORDER && c.marks[s->nodes[0] - 1];
      covered += sum * row_weight(s, j, k);
    }
  components->covered = cells_of(s, covered);
  return FG_STATUS_OK;
}
