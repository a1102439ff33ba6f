#include "component/cutter.h"

static inline int later(int a, int b)
{
  return a > b ? a : b;
}

static inline int earlier(int a, int b)
{
  return a < b ? a : b;
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
static void join_rows(fg__cutter *c, const int a[2], const int b[2], const fg__gate *gate)
{
  const fg__shape *s = &c->shape;
  const int *run_of_row = c->components->run_of_row;
  struct fg__component_run *run = c->components->run;
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
      fg__cutter_join(run, m_end - 1, n);
    if (run[n_end - 1].last == end && run[m].first == 0 &&
        face_joins(s, row_b, row_a, end, gate))
      fg__cutter_join(run, n_end - 1, m);
  }
  const struct fg__component_run *p = run + m, *p_end = run + m_end;
  const struct fg__component_run *q = run + n, *q_end = run + n_end;
  while (p < p_end && q < q_end) {
    int low = later(p->first, q->first), high = earlier(p->last, q->last);
    if (low <= high) {
      if (p->parent != q->parent && fg__gate_open(gate, s, low - 1, high))
        fg__cutter_join(run, (int)(p - run), (int)(q - run));
      if (c->exact_below) /* cells that are positive throughout */
        run[p - run].size += (int64_t)(high - low) * FG__WHOLE_CELL;
    } else if (low == high + 1) {
      bool forward = p->last == high;
      if (face_joins(s, forward ? row_a : row_b, forward ? row_b : row_a, high, gate))
        fg__cutter_join(run, (int)(p - run), (int)(q - run));
    }
    bool p_ends_first = p->last < q->last; /* no branch: neither way is likelier */
    p += p_ends_first;
    q += !p_ends_first;
  }
}

/* Joins runs of two rows that face each other across the faces between them, whose other
 * corners lie in the rows `other`. Mostly those have joined them already. */
static void join_across(fg__cutter *c, const int a[2], const int d[2],
                        const fg__gate *gate)
{
  const fg__shape *s = &c->shape;
  const int *run_of_row = c->components->run_of_row;
  struct fg__component_run *run = c->components->run;
  const float *row_a = fg__shape_row(s, a[0], a[1]);
  const float *row_b = fg__shape_row(s, a[0], d[1]);
  const float *row_c = fg__shape_row(s, d[0], a[1]);
  const float *row_d = fg__shape_row(s, d[0], d[1]);
  int number_a = fg__row_number(s, a[0], a[1]), number_d = fg__row_number(s, d[0], d[1]);
  const struct fg__component_run *p = run + run_of_row[number_a];
  const struct fg__component_run *p_end = run + run_of_row[number_a + 1];
  const struct fg__component_run *q = run + run_of_row[number_d];
  const struct fg__component_run *q_end = run + run_of_row[number_d + 1];
  while (p < p_end && q < q_end) {
    int low = later(p->first, q->first), high = earlier(p->last, q->last);
    int m = (int)(p - run), n = (int)(q - run);
    bool p_ends_first = p->last < q->last;
    p += p_ends_first;
    q += !p_ends_first;
    if (low > high || run[m].parent == run[n].parent ||
        fg__cutter_root(run, m) == fg__cutter_root(run, n))
      continue;
    for (int x = low; x <= high; ++x)
      if (fg__components_saddle_joins(row_a[x], row_b[x], row_c[x], row_d[x]) &&
          fg__gate_open(gate, s, x - 1, x)) {
        fg__cutter_join(run, m, n);
        break;
      }
  }
}

void fg__cutter_join_below(fg__cutter *c, int j, int k, int below)
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

void fg__cutter_join_beside(fg__cutter *c, int j, int beside, int cell, int k)
{
  const int row[2] = {j, k}, other[2] = {beside, k};
  fg__gate gate = fg__gate_of(&c->shape, cell, cell, k - 1, k);
  join_rows(c, row, other, &gate);
}
