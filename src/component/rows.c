#include "component/cutter.h"

#include <string.h>

/* Steps of a share, and more than the eight whole cells that a node can have. */
static const float share_steps = 0x1p24F, beyond_all_shares = 9.0F;

void fg__cutter_mark(fg__cutter *c, int j, int k)
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
static int list_changes_masked(const fg__cutter *c, int *ends)
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
static int64_t covered_by(const fg__cutter *c, const struct fg__component_run *run,
                          int row_weight)
{
  if (c->shape.active) {
    int64_t sum = 0;
    for (int x = run->first; x <= run->last; ++x)
      sum += c->cells[x - 1] + c->cells[x];
    return sum;
  }
  const fg__shape *s = &c->shape;
  int64_t halves = 2 * ((int64_t)run->last - run->first + 1);
  if (run->first == 0 && s->low[0] == FG__SIDE_BOUNDARY)
    --halves;
  if (run->last == s->nodes[0] - 1 && s->high[0] == FG__SIDE_BOUNDARY)
    --halves;
  return halves * row_weight;
}

int fg__cutter_row_weight(const fg__shape *s, int j, int k)
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
                        fg__component_stretch nodes, float *share, int *steps)
{
  for (int x = nodes.first; x <= nodes.last; ++x) {
    float of_node = u[x] * (before[x] + after[x]);
    share[x] = of_node < beyond_all_shares ? of_node : 0.0F; /* u may be infinite */
  }
  for (int x = nodes.first; x <= nodes.last; ++x)
    steps[x] = (int)(share[x] * share_steps);
}

static int *steps_of(const fg__cutter *c)
{
  return c->ends + 2 * c->shape.nodes[0] + 2;
}

void fg__cutter_measure(const fg__cutter *c, int j, int k, fg__component_stretch nodes)
{
  ptrdiff_t row = (ptrdiff_t)j * c->shape.nodes[0];
  count_steps(fg__shape_row(&c->shape, j, k), c->plane[0] + row, c->plane[1] + row, nodes,
              c->space, steps_of(c));
}

int64_t fg__cutter_steps(const fg__cutter *c, int first, int last)
{
  const int *steps = steps_of(c);
  int64_t sum = 0;
  for (int x = first; x <= last; ++x)
    sum += steps[x];
  return sum;
}

static void add_run(fg__cutter *c, int first, int last)
{
  int number = c->run_count++;
  c->components->run[number] = (struct fg__component_run){
      .parent = number,
      .first = first,
      .last = last,
      .size = c->exact_below ? 0 : fg__cutter_steps(c, first, last)};
}

int64_t fg__cutter_cut_row(fg__cutter *c, int j, int k)
{
  const fg__shape *s = &c->shape;
  int width = s->nodes[0], first = c->run_count;
  fg__cutter_mark(c, j, k);
  int ends = s->active ? list_changes_masked(c, c->ends)
                       : list_changes(c->marks, width, c->ends);
  if (ends == 0)
    return 0;
  if (!c->exact_below)
    fg__cutter_measure(c, j, k, (fg__component_stretch){0, width - 1});
  int weight = fg__cutter_row_weight(s, j, k);
  int64_t covered = 0;
  for (int n = 0; n < ends; n += 2) {
    add_run(c, c->ends[n], c->ends[n + 1] - 1);
    covered += covered_by(c, &c->components->run[c->run_count - 1], weight);
  }
  struct fg__component_run *run = c->components->run;
  int last = c->run_count - 1;
  if (s->low[0] == FG__SIDE_WRAP && run[first].first == 0 &&
      run[last].last == width - 1 && (!s->active || c->cells[-1]))
    fg__cutter_join(run, first, last);
  return covered;
}
