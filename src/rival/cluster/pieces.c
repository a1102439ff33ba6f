#include "rival/cluster/pieces.h"

#include "base/memory.h"
#include "cluster/pieces.h"

#include <stdlib.h>

/* Cells of one cluster that are joined within the box, before small ones are left out. */
typedef struct piece {
  int cluster, cells;
} piece;

typedef struct parting {
  fg_context *context;
  const fg__domain *domain;
  const int *label;      /* clusters */
  unsigned char *across; /* [clusters + 1] it crosses a periodic boundary */
  int *whole;            /* [clusters + 1] the piece of one that does not; -1: none yet */
  int *cells;            /* [clusters + 1] */
  int *at;               /* a piece's number a cell, from 0 on, -1: none */
  int *queue;            /* [cells] */
  piece *piece;
  size_t capacity;
  int pieces, clusters;
} parting;

static int cell_count(const parting *p)
{
  return p->domain->cells[0] * p->domain->cells[1];
}

static fg_status allocate(parting *p)
{
  size_t cells = (size_t)cell_count(p), clusters = (size_t)p->clusters + 1;
  p->across = fg__allocate(clusters, 1);
  p->whole = fg__allocate(clusters, sizeof *p->whole);
  p->cells = fg__allocate(clusters, sizeof *p->cells);
  p->at = fg__allocate(cells, sizeof *p->at);
  p->queue = fg__allocate(cells, sizeof *p->queue);
  if (!p->across || !p->whole || !p->cells || !p->at || !p->queue)
    return fg__fail_memory(p->context, "parts of clusters", cells * 2 * sizeof *p->at);
  for (size_t n = 0; n < clusters; n++)
    p->whole[n] = -1;
  for (size_t i = 0; i < cells; i++)
    p->at[i] = -1;
  return FG_STATUS_OK;
}

static void clear(parting *p)
{
  free(p->across);
  free(p->whole);
  free(p->cells);
  free(p->at);
  free(p->queue);
  free(p->piece);
}

static void find_across(const parting *p)
{
  int wide = p->domain->cells[0], high = p->domain->cells[1];
  for (int y = 0; y < high && p->domain->period[0] > 0; y++)
    if (p->label[y * wide] == p->label[y * wide + wide - 1])
      p->across[p->label[y * wide]] = 1;
  for (int x = 0; x < wide && p->domain->period[1] > 0; x++)
    if (p->label[x] == p->label[(high - 1) * wide + x])
      p->across[p->label[x]] = 1;
}

static fg_status add_piece(parting *p, int cluster)
{
  if (!fg__grow((void **)&p->piece, &p->capacity, (size_t)p->pieces + 1,
                sizeof *p->piece))
    return fg__fail_memory(p->context, "parts of clusters",
                           ((size_t)p->pieces + 1) * sizeof *p->piece);
  p->piece[p->pieces++] = (piece){.cluster = cluster};
  return FG_STATUS_OK;
}

/* Gives all cells joined with one, by their sides within the box, the last piece. */
static void flood(parting *p, int first)
{
  static const int step[4][2] = {{1, 0}, {-1, 0}, {0, 1}, {0, -1}};
  const int *size = p->domain->cells;
  int tail = 0, number = p->pieces - 1;
  p->queue[tail++] = first;
  p->at[first] = number;
  for (int head = 0; head < tail; head++) {
    int cell = p->queue[head];
    for (int d = 0; d < 4; d++) {
      int x = cell % size[0] + step[d][0], y = cell / size[0] + step[d][1];
      int next = y * size[0] + x;
      if (x < 0 || x >= size[0] || y < 0 || y >= size[1] || p->at[next] >= 0 ||
          p->label[next] != p->label[first])
        continue;
      p->at[next] = number;
      p->queue[tail++] = next;
    }
  }
}

static fg_status find_pieces(parting *p)
{
  find_across(p);
  for (int i = 0; i < cell_count(p); i++) {
    int cluster = p->label[i];
    if (cluster < 1)
      continue;
    p->cells[cluster]++;
    if (p->at[i] >= 0) /* the flood was here */
      continue;
    if (p->whole[cluster] >= 0) {
      p->at[i] = p->whole[cluster];
      continue;
    }
    fg_status status = add_piece(p, cluster);
    if (status != FG_STATUS_OK)
      return status;
    if (p->across[cluster])
      flood(p, i);
    else
      p->at[i] = p->whole[cluster] = p->pieces - 1;
  }
  for (int i = 0; i < cell_count(p) && p->piece; i++)
    if (p->at[i] >= 0)
      p->piece[p->at[i]].cells++;
  return FG_STATUS_OK;
}

/* Numbers the pieces that are kept, cluster by cluster; number[pieces], 0: left out. */
static void number_pieces(const parting *p, fg__rival_pieces *out, int *number)
{
  double mean = (double)p->domain->valid_count / (p->clusters > 0 ? p->clusters : 1);
  int *largest = p->whole; /* of each cluster, from here on */
  for (int n = 0; n < p->pieces; n++) {
    int *most = &largest[p->piece[n].cluster];
    if (*most < 0 || p->piece[n].cells > p->piece[*most].cells)
      *most = n;
  }
  for (int n = 0; n < p->pieces; n++) {
    double least = fg__piece_least(p->cells[p->piece[n].cluster], mean);
    number[n] = n == largest[p->piece[n].cluster] || p->piece[n].cells >= least;
  }
  int *next = p->cells; /* of each cluster, from here on: how many parts are before it */
  for (int cluster = 0; cluster <= p->clusters; cluster++)
    next[cluster] = 0;
  for (int n = 0; n < p->pieces; n++)
    next[p->piece[n].cluster] += number[n];
  for (int cluster = 0; cluster <= p->clusters; cluster++) {
    int kept = next[cluster];
    next[cluster] = out->count;
    out->count += kept;
  }
  for (int n = 0; n < p->pieces; n++)
    if (number[n]) {
      int at = next[p->piece[n].cluster]++;
      out->cluster[at] = p->piece[n].cluster;
      out->cells[at] = p->piece[n].cells;
      number[n] = at + 1;
    }
}

static fg_status keep_pieces(const parting *p, fg__rival_pieces *out)
{
  size_t cells = (size_t)cell_count(p), pieces = (size_t)p->pieces;
  int *number = fg__allocate(pieces, sizeof *number);
  out->label = fg__allocate(cells, sizeof *out->label);
  out->cluster = fg__allocate(pieces, sizeof *out->cluster);
  out->cells = fg__allocate(pieces, sizeof *out->cells);
  fg_status status = FG_STATUS_OK;
  if (!number || !out->label || !out->cluster || !out->cells)
    status = fg__fail_memory(p->context, "parts of clusters", cells * sizeof *number);
  else
    number_pieces(p, out, number);
  for (size_t i = 0; i < cells && status == FG_STATUS_OK; i++)
    out->label[i] = p->at[i] < 0 ? 0 : number[p->at[i]];
  free(number);
  return status;
}

fg_status fg__rival_pieces_create(fg__rival_pieces *out, fg_context *context,
                                  const fg__domain *domain, const int *label, int count)
{
  *out = (fg__rival_pieces){0};
  parting p = {.context = context, .domain = domain, .label = label, .clusters = count};
  fg_status status = allocate(&p);
  if (status == FG_STATUS_OK)
    status = find_pieces(&p);
  if (status == FG_STATUS_OK)
    status = keep_pieces(&p, out);
  clear(&p);
  if (status != FG_STATUS_OK)
    fg__rival_pieces_clear(out);
  return status;
}

void fg__rival_pieces_clear(fg__rival_pieces *pieces)
{
  free(pieces->label);
  free(pieces->cluster);
  free(pieces->cells);
  *pieces = (fg__rival_pieces){0};
}
