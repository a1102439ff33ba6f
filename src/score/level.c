#include "score/level.h"

#include "base/memory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static bool allocate(double **out, size_t count)
{
  *out = fg__allocate(count, sizeof(double));
  return *out != NULL;
}

fg_status fg__score_level_create(fg__score_level *out, fg_context *context, int dimension,
                                 const int size[3])
{
  *out = (fg__score_level){.dimension = dimension, .margin = dimension == 3};
  memcpy(out->size, size, sizeof out->size);
  out->step[0] = 1;
  out->step[1] = size[0] + 2;
  out->step[2] = out->step[1] * (size[1] + 2);
  out->cells = (size_t)out->step[2] * (size_t)(size[2] + 2 * out->margin);
  out->begin = fg__score_level_place(out, 0, 0, 0);
  out->end = fg__score_level_place(out, size[0] - 1, size[1] - 1, size[2] - 1) + 1;
  out->kind = fg__allocate(out->cells, 1);
  out->degree = fg__allocate(out->cells, 1);
  bool all = out->kind && out->degree;
  double **const vectors[] = {&out->share, &out->work};
  for (size_t n = 0; n < sizeof vectors / sizeof vectors[0]; ++n)
    all = all && allocate(vectors[n], out->cells);
  for (int k = 0; k < dimension; ++k)
    all = all && allocate(&out->value[k], out->cells);
  all = all && allocate(&out->line, (size_t)size[0] + 6);
  all = all && allocate(&out->coarse_line, (size_t)size[0] + 6);
  return all ? FG_STATUS_OK
             : fg__fail_memory(context, "a raster to diffuse on",
                               out->cells * (2 + (size_t)dimension) * sizeof(double));
}

void fg__score_level_clear(fg__score_level *level)
{
  double *const vectors[] = {level->share,    level->right,    level->correction,
                             level->work,     level->value[0], level->value[1],
                             level->value[2], level->line,     level->coarse_line};
  for (size_t n = 0; n < sizeof vectors / sizeof vectors[0]; ++n)
    free(vectors[n]);
  free(level->kind);
  free(level->degree);
  *level = (fg__score_level){0};
}

void fg__score_level_fix(fg__score_level *level, size_t place)
{
  double length = 0.0;
  for (int k = 0; k < level->dimension; ++k)
    length += level->value[k][place] * level->value[k][place];
  length = sqrt(length);
  for (int k = 0; k < level->dimension; ++k)
    level->value[k][place] = length > 0.0 ? level->value[k][place] / length : 0.0;
  if (length > 0.0)
    level->kind[place] = FG__FIXED;
}

void fg__score_level_finish(fg__score_level *level)
{
  const ptrdiff_t *step = level->step;
  level->unknown = 0;
  for (size_t n = level->begin; n < level->end; ++n) {
    if (level->kind[n] != FG__UNKNOWN)
      continue;
    const unsigned char *kind = level->kind + n;
    int neighbours = 0;
    for (int k = 0; k < level->dimension; ++k)
      neighbours += (kind[step[k]] != FG__OUTSIDE) + (kind[-step[k]] != FG__OUTSIDE);
    level->degree[n] = (unsigned char)neighbours;
    ++level->unknown;
  }
}

static void add_cell(fg__score_level *coarse, size_t to, const fg__score_level *fine,
                     size_t from)
{
  if (fine->kind[from] == FG__OUTSIDE)
    return;
  coarse->kind[to] = FG__UNKNOWN;
  for (int k = 0; fine->kind[from] == FG__FIXED && k < fine->dimension; ++k)
    coarse->value[k][to] += fine->value[k][from];
}

/* Weights of coarse cells are added up by interpolating ones. */
static void set_share(fg__score_level *fine, const fg__score_level *coarse)
{
  double *one = coarse->work, *weight = fine->work;
  for (size_t n = 0; n < coarse->cells; ++n)
    one[n] = coarse->kind[n] == FG__OUTSIDE ? 0.0 : 1.0;
  for (size_t n = 0; n < fine->cells; ++n) {
    fine->share[n] = fine->kind[n] == FG__UNKNOWN ? 1.0 : 0.0;
    weight[n] = 0.0;
  }
  fg__score_level_interpolate(fine, weight, coarse, one);
  for (size_t n = 0; n < fine->cells; ++n)
    fine->share[n] = fine->kind[n] == FG__UNKNOWN ? 1.0 / weight[n] : 0.0;
  memset(coarse->work, 0, coarse->cells * sizeof(double));
  memset(fine->work, 0, fine->cells * sizeof(double));
}

fg_status fg__score_level_coarsen(fg__score_level *coarse, fg_context *context,
                                  fg__score_level *fine)
{
  int size[3] = {1, 1, 1};
  for (int k = 0; k < fine->dimension; ++k)
    size[k] = (fine->size[k] + 1) / 2;
  fg_status status = fg__score_level_create(coarse, context, fine->dimension, size);
  if (status != FG_STATUS_OK)
    return status;
  if (!allocate(&coarse->right, coarse->cells) ||
      !allocate(&coarse->correction, coarse->cells))
    return fg__fail_memory(context, "a raster to diffuse on",
                           2 * coarse->cells * sizeof(double));
  for (int k = 0; k < fine->size[2]; ++k)
    for (int j = 0; j < fine->size[1]; ++j)
      for (int i = 0; i < fine->size[0]; ++i)
        add_cell(coarse, fg__score_level_place(coarse, i / 2, j / 2, k / 2), fine,
                 fg__score_level_place(fine, i, j, k));
  for (size_t n = 0; n < coarse->cells; ++n)
    if (coarse->kind[n] != FG__OUTSIDE)
      fg__score_level_fix(coarse, n);
  fg__score_level_finish(coarse);
  set_share(fine, coarse);
  return FG_STATUS_OK;
}

/* A coarse row beside a fine one, and its weight. */
typedef struct row_weight {
  size_t place; /* of its first cell */
  double weight;
} row_weight;

/* The 2, in 3D 4, coarse rows that a fine row lies between. */
static int find_rows(row_weight out[4], const fg__score_level *coarse, int j, int k)
{
  const int beside = j % 2 ? 1 : -1, above = k % 2 ? 1 : -1;
  const int layers = coarse->dimension == 3 ? 2 : 1;
  int count = 0;
  for (int layer = 0; layer < layers; ++layer)
    for (int row = 0; row < 2; ++row)
      out[count++] = (row_weight){
          fg__score_level_place(coarse, 0, j / 2 + row * beside, k / 2 + layer * above),
          (row ? 0.25 : 0.75) * (layers == 1 ? 1.0
                                 : layer     ? 0.25
                                             : 0.75)};
  return count;
}

/* Coarse cells of a fine row from -1 to the one behind the last, to line[0], ... */
static void blend_rows(double *restrict line, const double *from, const row_weight *rows,
                       int count, int columns)
{
  const double *restrict first = from + rows[0].place - 1;
  for (int i = 0; i < columns + 2; ++i)
    line[i] = rows[0].weight * first[i];
  for (int n = 1; n < count; ++n) {
    const double *restrict next = from + rows[n].place - 1;
    for (int i = 0; i < columns + 2; ++i)
      line[i] += rows[n].weight * next[i];
  }
}

void fg__score_level_interpolate(const fg__score_level *fine, double *to,
                                 const fg__score_level *coarse, const double *from)
{
  double *line = fine->coarse_line;
  const int columns = fine->size[0];
  for (int k = 0; k < fine->size[2]; ++k)
    for (int j = 0; j < fine->size[1]; ++j) {
      row_weight rows[4];
      const int count = find_rows(rows, coarse, j, k);
      blend_rows(line, from, rows, count, coarse->size[0]);
      const size_t place = fg__score_level_place(fine, 0, j, k);
      const double *restrict share = fine->share + place;
      double *restrict out = to + place;
      for (int i = 0; i + 1 < columns; i += 2) {
        const double *near = line + i / 2;
        out[i] += share[i] * (0.25 * near[0] + 0.75 * near[1]);
        out[i + 1] += share[i + 1] * (0.75 * near[1] + 0.25 * near[2]);
      }
      if (columns % 2)
        out[columns - 1] += share[columns - 1] *
                            (0.25 * line[columns / 2] + 0.75 * line[columns / 2 + 1]);
    }
}

void fg__score_level_restrict(const fg__score_level *coarse, double *to,
                              const fg__score_level *fine, const double *from)
{
  /* from cell -1 on; behind the row is room for an odd one's missing cell */
  double *restrict line = fine->line, *restrict half = fine->coarse_line;
  const int columns = fine->size[0], coarse_columns = coarse->size[0];
  memset(to, 0, coarse->cells * sizeof *to);
  for (int k = 0; k < fine->size[2]; ++k)
    for (int j = 0; j < fine->size[1]; ++j) {
      const size_t place = fg__score_level_place(fine, 0, j, k);
      row_weight rows[4];
      const int count = find_rows(rows, coarse, j, k);
      for (int i = 0; i < columns; ++i)
        line[i + 1] = fine->share[place + (size_t)i] * from[place + (size_t)i];
      line[0] = line[columns + 1] = line[columns + 2] = 0.0;
      for (int i = 0; i < coarse_columns; ++i)
        half[i] = 0.75 * (line[2 * i + 1] + line[2 * i + 2]) +
                  0.25 * (line[2 * i] + line[2 * i + 3]);
      for (int n = 0; n < count; ++n) {
        double *restrict out = to + rows[n].place;
        for (int i = 0; i < coarse_columns; ++i)
          out[i] += rows[n].weight * half[i];
      }
    }
  for (size_t n = 0; n < coarse->cells; ++n)
    to[n] = coarse->degree[n] ? to[n] : 0.0;
}

void fg__score_level_apply(const fg__score_level *level, double *restrict out,
                           const double *restrict x)
{
  const ptrdiff_t row = level->step[1], layer = level->step[2];
  const unsigned char *restrict degree = level->degree;
  if (level->dimension == 2)
    for (size_t n = level->begin; n < level->end; ++n) {
      const double *at = x + n;
      const double product = degree[n] * at[0] - (at[-1] + at[1] + at[-row] + at[row]);
      out[n] = degree[n] ? product : 0.0;
    }
  else
    for (size_t n = level->begin; n < level->end; ++n) {
      const double *at = x + n;
      const double product = degree[n] * at[0] - (at[-1] + at[1] + at[-row] + at[row] +
                                                  at[-layer] + at[layer]);
      out[n] = degree[n] ? product : 0.0;
    }
}
