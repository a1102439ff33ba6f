#include "grid/exchange/brick.h"

/* Nodes of one row and parity lie side by side (layout.h). */
typedef struct run {
  int start; /* first column, from the brick's first */
  int count;
} run;

static run run_of(const fg__brick *brick, int parity)
{
  int start = parity ^ brick->odd[0];
  return (run){start, (brick->nodes.nodes[0] - start + 1) / 2};
}

/* Which columns of row j of plane k the set has: bit 0 even ones, bit 1 odd ones. */
static unsigned columns_of(const fg__brick *brick, unsigned colours, int j, int k)
{
  int row = (brick->odd[1] + j) & 1, plane = (brick->odd[2] + k) & 1;
  return colours >> (2 * row + 4 * plane) & 3U;
}

static ptrdiff_t offset_of(const fg__brick *brick, const fg__layout *layout, run r, int j,
                           int k)
{
  const int *first = brick->nodes.first;
  return fg__node_at(layout, first[0] + r.start, first[1] + j, first[2] + k);
}

/* How many of `count` indices, of which the first is even or odd, are odd or even. */
static int share(int count, int first_odd, int odd)
{
  return (count + (first_odd == odd)) / 2;
}

int64_t fg__brick_count(const fg__brick *brick, unsigned colours)
{
  const int *nodes = brick->nodes.nodes;
  int64_t sum = 0;
  for (int colour = 0; colour < 8; ++colour)
    if (colours >> colour & 1U)
      sum += (int64_t)share(nodes[0], brick->odd[0], colour & 1) *
             share(nodes[1], brick->odd[1], colour >> 1 & 1) *
             share(nodes[2], brick->odd[2], colour >> 2 & 1);
  return sum;
}

/* A column of nodes: one from each row of a plane that has the colour. */
typedef struct column {
  int start, step, end; /* rows */
} column;

static column column_of(const fg__brick *brick, unsigned colours, int k)
{
  unsigned plane = colours >> (4 * ((brick->odd[2] + k) & 1) + (brick->odd[0] & 1));
  bool even = plane & 1U, odd = plane >> 2 & 1U;
  bool first = brick->odd[1] ? odd : even, both = even && odd;
  return (column){.start = first ? 0 : 1,
                  .step = both ? 1 : 2,
                  .end = even || odd ? brick->nodes.nodes[1] : 0};
}

/* Where a column begins, counting from row 0 of the brick. */
static ptrdiff_t column_offset(const fg__brick *brick, const fg__layout *layout, int k)
{
  const int *first = brick->nodes.first;
  return fg__node_at(layout, first[0], first[1], first[2] + k);
}

#define FOR_PLANES(brick) for (int k = 0; k < (brick)->nodes.nodes[2]; ++k)

#define FOR_RUNS(brick, colours)                                                         \
  for (int j = 0; j < (brick)->nodes.nodes[1]; ++j)                                      \
    for (int parity = 0; parity < 2; ++parity)                                           \
      if (columns_of(brick, colours, j, k) >> parity & 1U)

float *fg__brick_pack(const fg__brick *brick, const fg__layout *layout,
                      const float *array, unsigned colours, float *out)
{
  FOR_PLANES(brick)
  {
    if (brick->nodes.nodes[0] == 1) {
      column c = column_of(brick, colours, k);
      const float *in = array + column_offset(brick, layout, k);
      for (int j = c.start; j < c.end; j += c.step)
        *out++ = in[j * layout->stride];
      continue;
    }
    FOR_RUNS(brick, colours)
    {
      run r = run_of(brick, parity);
      const float *in = array + offset_of(brick, layout, r, j, k);
      for (int n = 0; n < r.count; ++n)
        out[n] = in[n];
      out += r.count;
    }
  }
  return out;
}

const float *fg__brick_unpack(const fg__brick *brick, const fg__layout *layout,
                              float *array, unsigned colours, const float *in)
{
  FOR_PLANES(brick)
  {
    if (brick->nodes.nodes[0] == 1) {
      column c = column_of(brick, colours, k);
      float *out = array + column_offset(brick, layout, k);
      for (int j = c.start; j < c.end; j += c.step)
        out[j * layout->stride] = *in++;
      continue;
    }
    FOR_RUNS(brick, colours)
    {
      run r = run_of(brick, parity);
      float *out = array + offset_of(brick, layout, r, j, k);
      for (int n = 0; n < r.count; ++n)
        out[n] = in[n];
      in += r.count;
    }
  }
  return in;
}

void fg__brick_copy(const fg__brick *to, const fg__layout *to_layout, float *to_array,
                    const fg__brick *from, const fg__layout *from_layout,
                    const float *from_array, unsigned colours)
{
  FOR_PLANES(to)
  {
    if (to->nodes.nodes[0] == 1) {
      column c = column_of(to, colours, k);
      float *out = to_array + column_offset(to, to_layout, k);
      const float *in = from_array + column_offset(from, from_layout, k);
      for (int j = c.start; j < c.end; j += c.step)
        out[j * to_layout->stride] = in[j * from_layout->stride];
      continue;
    }
    FOR_RUNS(to, colours)
    {
      run r = run_of(to, parity);
      float *out = to_array + offset_of(to, to_layout, r, j, k);
      const float *in = from_array + offset_of(from, from_layout, r, j, k);
      for (int n = 0; n < r.count; ++n)
        out[n] = in[n];
    }
  }
}
