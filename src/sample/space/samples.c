/* From numbers at points or of cells to the points of a plane or volume. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "sample/missing.h"
#include "sample/space/space.h"

/* Numbers that are fetched at once: those of all components of them stay in memory. */
enum { AT_ONCE = 1 << 20 };

/* What a number of the file stands for; of hiding samples with the bits that hide. */
typedef float meaning(double number, unsigned bits);

static float as_flag(bool inside)
{
  return inside ? 1.0f : NAN;
}

static float as_velocity(double number, unsigned bits)
{
  (void)bits;
  return fg__as_velocity(number);
}

static float as_scalar_mask(double number, unsigned bits)
{
  (void)bits;
  return as_flag(number > 0.0);
}

static float as_vector_mask(double number, unsigned bits)
{
  (void)bits;
  return as_flag(number > 0.0 || number < 0.0);
}

/* Without bits it is 0 that hides. */
static float as_hiding(double number, unsigned bits)
{
  if (bits == 0)
    return as_flag(number != 0.0);
  return as_flag(!(number >= 0.0 && number < 256.0 && ((unsigned)number & bits) != 0));
}

/* Up to three variables, all at the same place, and the rows that are wanted of them, in
 * the file's order. */
typedef struct request {
  const fg__dataset *data;
  const fg__space_domain *domain;
  const fg__variable *variable[3];
  int count;
  meaning *means;
  unsigned bits;
  fg__row_range rows;
  bool *is_settled; /* fg__space_samples */
} request;

/* The numbers that are read for that, which may be more than those wanted: a point takes
 * its value from the cells on both sides. */
typedef struct box {
  size_t origin[3], size[3]; /* along x, y, z; of lists all, along the first */
  size_t points[3];          /* of the domain along its axes, `skipped` rows more */
  size_t skipped;
} box;

static bool is_of_cells(const request *r)
{
  return r->variable[0] && r->variable[0]->location == FG__OF_CELLS;
}

static box box_of(const request *r)
{
  const fg__space_domain *domain = r->domain;
  const int last = domain->dimension - 1;
  box b = {.size = {1, 1, 1}, .points = {1, 1, 1}};
  if (domain->cells) {
    b.size[0] = is_of_cells(r) ? domain->cells->numbers : domain->cells->file_points;
    return b;
  }
  const bool cells = is_of_cells(r);
  const size_t margin = cells ? 1 : 0, end = r->rows.first + r->rows.count + margin;
  const size_t first = r->rows.first > margin ? r->rows.first - margin : 0;
  for (int k = 0; k < 3; ++k)
    b.size[k] = r->data->space.points[k];
  b.origin[domain->axis[last]] = first;
  b.size[domain->axis[last]] =
      (end < domain->size[last] ? end : domain->size[last]) - first;
  b.skipped = r->rows.first - first;
  for (int k = 0; k <= last; ++k)
    b.points[k] = b.size[domain->axis[k]];
  for (int k = 0; k < 3 && cells; ++k)
    b.size[k] -= b.size[k] > 1;
  return b;
}

/* Reads the variables' numbers; out[k] are to be freed also after a failure. One number
 * is fetched first: the file then shows that it holds all it promises. */
static fg_status read_box(float *out[3], const request *r, const box *b)
{
  const size_t plane = b->size[0] * b->size[1], count = plane * b->size[2];
  const bool listed = r->domain->cells != NULL;
  const size_t length = listed ? b->size[0] : b->size[2], step = listed ? 1 : plane;
  const size_t most = step < AT_ONCE ? AT_ONCE / step : 1;
  const size_t once = most < length ? most : length;
  size_t start[3] = {b->origin[2], b->origin[1], b->origin[0]};
  size_t some[3] = {1, b->size[1], b->size[0]};
  double probe;
  fg_status status = FG_STATUS_OK;
  for (int k = 0; k < r->count && status == FG_STATUS_OK; ++k)
    status =
        fg__variable_fetch_one(r->variable[k], listed ? &b->origin[0] : start, &probe);
  double *block =
      status == FG_STATUS_OK ? fg__allocate(once * step, sizeof *block) : NULL;
  for (int k = 0; k < r->count && block; ++k)
    out[k] = fg__allocate(count, sizeof **out);
  for (int k = 0; k < r->count && status == FG_STATUS_OK; ++k)
    if (!block || !out[k])
      status =
          fg__fail_memory(r->data->context, "a field's samples", count * sizeof **out);
  for (size_t first = 0; first < length && status == FG_STATUS_OK; first += once) {
    start[0] = (listed ? 0 : b->origin[2]) + first;
    some[0] = length - first < once ? length - first : once;
    for (int k = 0; k < r->count && status == FG_STATUS_OK; ++k) {
      float *to = out[k] + first * step;
      status = fg__variable_fetch(r->variable[k], start, some, block);
      for (size_t i = 0; i < some[0] * step && status == FG_STATUS_OK; ++i)
        to[i] = r->means(block[i], r->bits);
    }
    if (status == FG_STATUS_OK)
      status = fg__check_stop(r->data->context);
  }
  free(block);
  return status;
}

/* Mean over the layers of the flat axis, or all as it is in a volume; a NaN in one makes
 * the mean one. */
static void flatten(float *out, const float *samples, const box *b,
                    const fg__space_domain *domain)
{
  const size_t step[3] = {1, b->size[0], b->size[0] * b->size[1]};
  if (domain->dimension == 3) {
    memcpy(out, samples, b->size[2] * step[2] * sizeof *out);
    return;
  }
  const size_t layers = b->size[domain->flat];
  for (size_t j = 0; j < b->size[domain->axis[1]]; ++j)
    for (size_t i = 0; i < b->size[domain->axis[0]]; ++i) {
      const size_t at = j * step[domain->axis[1]] + i * step[domain->axis[0]];
      double sum = 0.0;
      for (size_t layer = 0; layer < layers; ++layer)
        sum += (double)samples[at + layer * step[domain->flat]];
      *out++ = (float)(sum / (double)layers);
    }
}

/* The cells that touch point i of an axis: [*first, *end) of `points` - 1. */
static void cells_round(size_t i, size_t points, size_t *first, size_t *end)
{
  *first = i > 0 ? i - 1 : 0;
  *end = i + 1 < points ? i + 1 : i;
  if (points == 1)
    *end = 1; /* a plane's only layer */
}

/* A point's value is the mean of the cells round it, up to eight (VTK's
 * CellDataToPointData); a NaN in one of them makes it one, so that no point beside a hole
 * pretends to know the flow there. */
static void cells_to_points(float *out, const float *cells, const size_t points[3])
{
  const size_t columns = points[0] - 1, rows = points[1] - 1;
  for (size_t k = 0; k < points[2]; ++k)
    for (size_t j = 0; j < points[1]; ++j)
      for (size_t i = 0; i < points[0]; ++i) {
        size_t first[3], end[3];
        const size_t at[3] = {i, j, k};
        for (int d = 0; d < 3; ++d)
          cells_round(at[d], points[d], &first[d], &end[d]);
        double sum = 0.0;
        int count = 0;
        for (size_t z = first[2]; z < end[2]; ++z)
          for (size_t y = first[1]; y < end[1]; ++y)
            for (size_t x = first[0]; x < end[0]; ++x) {
              sum += (double)cells[(z * rows + y) * columns + x];
              ++count;
            }
        *out++ = (float)(sum / count);
      }
}

/* From a box of samples, which is taken over, to the wanted rows' points. */
static fg_status to_rows(float **out, float *samples, const request *r, const box *b)
{
  const bool cells = is_of_cells(r);
  *out = samples;
  if (r->domain->dimension == 3 && !cells)
    return FG_STATUS_OK;
  const size_t count = b->points[0] * b->points[1] * b->points[2];
  const size_t row = fg__space_domain_row(r->domain);
  float *flat = fg__allocate(count, sizeof *flat);
  float *points = cells ? fg__allocate(count, sizeof *points) : NULL;
  *out = flat;
  if (flat && (points || !cells))
    flatten(flat, samples, b, r->domain);
  free(samples);
  if (!flat || (cells && !points)) {
    free(points);
    return fg__fail_memory(r->data->context, "a field's samples",
                           2 * count * sizeof *flat);
  }
  if (points) {
    cells_to_points(points, flat, b->points);
    memmove(points, points + b->skipped * row, r->rows.count * row * sizeof *points);
    free(flat);
    *out = points;
  }
  return FG_STATUS_OK;
}

/* The same from the points or cells of a set to its raster. */
static fg_status to_raster(float **out, float *samples, const request *r)
{
  const fg__cell_set *set = r->domain->cells;
  const size_t row = fg__space_domain_row(r->domain), count = row * r->rows.count;
  float *points = fg__allocate(set->points, sizeof *points);
  float *raster = fg__allocate(count, sizeof *raster);
  fg_status status = FG_STATUS_OK;
  *out = raster;
  if (!points || !raster)
    status = fg__fail_memory(set->context, "a field's samples", count * sizeof *raster);
  else if (is_of_cells(r))
    status = fg__cell_set_to_points(points, set, samples);
  else
    memcpy(points, samples, set->file_points * sizeof *points);
  if (status == FG_STATUS_OK && !is_of_cells(r))
    fg__cell_set_fill_middles(points, set);
  if (status == FG_STATUS_OK)
    fg__cell_set_sample(raster, set, points, r->rows.first * row, count);
  free(points);
  free(samples);
  return status;
}

static bool is_hiding(const fg__variable *v)
{
  return v->element < 2 && fg__attribute_find(v, "hiding_bits");
}

static fg__raw_samples raw_of(float *const samples[3], const request *r, size_t count)
{
  fg__raw_samples raw = {
      .path = r->data->file[0].path, .components = r->count, .count = count};
  for (int k = 0; k < r->count; ++k) {
    raw.name[k] = r->variable[k]->name;
    raw.component[k] = samples[k];
  }
  return raw;
}

/* All rows at once, since those of cells' numbers overlap. */
static fg_status settle_all(const request *r, const fg__missing_numbers *given)
{
  request whole = *r;
  float *samples[3] = {NULL, NULL, NULL};
  whole.rows = (fg__row_range){0, r->domain->size[r->domain->dimension - 1]};
  const box b = box_of(&whole);
  fg_status status = read_box(samples, &whole, &b);
  if (status == FG_STATUS_OK) {
    const fg__raw_samples raw =
        raw_of(samples, &whole, b.size[0] * b.size[1] * b.size[2]);
    status = fg__missing_settle(r->data->context, &raw, given);
  }
  for (int k = 0; k < 3; ++k)
    free(samples[k]);
  return status;
}

/* Missing numbers that the file does not declare; where it hides samples, it does. Of
 * some rows that may hold such a number all rows decide, once for all parts. */
static fg_status settle_missing(float *samples[3], const request *r, size_t count)
{
  fg__missing_numbers given = r->data->missing;
  for (size_t n = 0; n < r->data->variable_count && given.count == 0; ++n)
    given.none = given.none || is_hiding(&r->data->variables[n]);
  const fg__raw_samples raw = raw_of(samples, r, count);
  if (r->domain->cells || r->rows.count == r->domain->size[r->domain->dimension - 1])
    return fg__missing_settle(r->data->context, &raw, &given);
  fg__extremes extremes = {.count = 0};
  fg__missing_mask(&raw, &given);
  fg__extremes_add(&extremes, &raw);
  if (given.none || (r->is_settled && *r->is_settled) ||
      !fg__extremes_are_suspect(&extremes, raw.components))
    return FG_STATUS_OK;
  if (r->is_settled)
    *r->is_settled = true;
  return settle_all(r, &given);
}

/* Reads the variables onto the wanted rows' points. With `any`, the first result stands
 * for all: a number where one of them is. out[k] are to be freed also after a failure. */
static fg_status read_onto_points(float *out[3], const request *r, bool any)
{
  const box b = box_of(r);
  const size_t count = b.size[0] * b.size[1] * b.size[2];
  fg_status status = read_box(out, r, &b);
  if (status == FG_STATUS_OK && !any)
    status = settle_missing(out, r, count);
  for (int k = 1; k < r->count && any; ++k) {
    for (size_t i = 0; i < count && status == FG_STATUS_OK; ++i)
      if (isnan(out[0][i]))
        out[0][i] = out[k][i];
    free(out[k]);
    out[k] = NULL;
  }
  for (int k = 0; k < (any ? 1 : r->count) && status == FG_STATUS_OK; ++k)
    status = r->domain->cells ? to_raster(&out[k], out[k], r)
                              : to_rows(&out[k], out[k], r, &b);
  return status;
}

static fg_status apply_marks(float *velocity[3], const request *r)
{
  float *marks[3] = {NULL, NULL, NULL};
  const size_t count = fg__space_domain_row(r->domain) * r->rows.count;
  const fg_status status = read_onto_points(marks, r, true);
  for (int k = 0; k < r->domain->dimension && status == FG_STATUS_OK; ++k)
    for (size_t i = 0; i < count && marks[0]; ++i)
      if (isnan(marks[0][i]))
        velocity[k][i] = NAN;
  for (int k = 0; k < 3; ++k)
    free(marks[k]);
  return status;
}

/* Applies what the file says of hidden points and cells. */
static fg_status apply_hiding(float *velocity[3], request r)
{
  fg_status status = FG_STATUS_OK;
  for (size_t n = 0; n < r.data->variable_count && status == FG_STATUS_OK; ++n) {
    double bits = 0.0;
    const fg__variable *v = &r.data->variables[n];
    if (!is_hiding(v))
      continue;
    fg__attribute_numbers(v, "hiding_bits", &bits, 1);
    r.variable[0] = v;
    r.count = 1;
    r.means = as_hiding;
    r.bits = (unsigned)bits;
    status = apply_marks(velocity, &r);
  }
  return status;
}

static fg_status apply_mask(float *velocity[3], request r, const char *name)
{
  enum { MOST_COMPONENTS = 3 };
  const fg__variable *mask = fg__dataset_find(r.data, name);
  if (!mask || mask->location == FG__ON_GRID)
    return fg__fail_unknown(r.data, name);
  r.count = mask->element > 0 ? mask->components : 1;
  if (r.count > MOST_COMPONENTS || !fg__is_number(mask))
    return fg__fail(r.data->context, FG_STATUS_ARGUMENT,
                    "%s: mask \"%.100s\" has %d components; up to %d numbers can be a "
                    "mask",
                    mask->path, name, r.count, MOST_COMPONENTS);
  for (int k = 0; k < r.count; ++k)
    r.variable[k] = mask + k;
  r.means = r.count > 1 ? as_vector_mask : as_scalar_mask;
  return apply_marks(velocity, &r);
}

/* Keeps the components along a plane's two directions. */
static void turn(float *out[3], const fg__plane_basis *basis, size_t count)
{
  for (size_t n = 0; n < count && out[0] && out[1] && out[2]; ++n) {
    const double u[3] = {(double)out[0][n], (double)out[1][n], (double)out[2][n]};
    out[0][n] = (float)fg__dot(u, basis->direction[0]);
    out[1][n] = (float)fg__dot(u, basis->direction[1]);
    out[2][n] = (float)fg__dot(u, basis->normal);
  }
}

/* With `normal`, of a plane the component normal to it, as out[2], too. */
static fg_status read_vector(float *out[3], request r, const fg__pair *pair,
                             const fg__grid *grid, bool normal)
{
  const fg__space_domain *domain = r.domain;
  const bool three = fg__pair_components(pair) == 3, tilted = domain->is_tilted;
  const bool across = domain->dimension == 2 && three && (normal || tilted);
  int which[3] = {0, 1, 2};
  for (int k = 0; k < domain->dimension && !tilted; ++k)
    which[k] = grid->component[k];
  if (across && !tilted)
    which[2] = domain->flat;
  r.count = domain->dimension + (across ? 1 : 0);
  r.means = as_velocity;
  for (int k = 0; k < r.count; ++k)
    r.variable[k] = pair->component[which[k]];
  const fg_status status = read_onto_points(out, &r, false);
  if (status != FG_STATUS_OK)
    return status;
  if (tilted)
    turn(out, &domain->basis, fg__space_domain_row(domain) * r.rows.count);
  if (across && !normal) {
    free(out[2]);
    out[2] = NULL;
  }
  return FG_STATUS_OK;
}

/* Reverses `length` parts of `step` samples each. */
static void reverse(float *samples, size_t length, size_t step)
{
  for (size_t i = 0; i < length / 2; ++i)
    for (size_t n = 0; n < step; ++n) {
      float *a = samples + i * step + n, *b = samples + (length - 1 - i) * step + n;
      const float kept = *a;
      *a = *b;
      *b = kept;
    }
}

static void reverse_axes(float *samples, const fg__space_domain *domain, size_t rows)
{
  const float *end = samples + fg__space_domain_row(domain) * rows;
  size_t step = 1;
  for (int k = 0; k < domain->dimension; ++k) {
    const size_t length = k == domain->dimension - 1 ? rows : domain->size[k];
    for (float *at = samples; domain->descends[k] && at < end; at += length * step)
      reverse(at, length, step);
    step *= length;
  }
}

fg_status fg__space_samples(float *out[3], const fg__dataset *data, const fg__pair *pair,
                            const fg__grid *grid, const fg__row_range *rows,
                            const char *mask, bool normal, bool *is_settled)
{
  const fg__space_domain *domain = grid->domain;
  const int last = domain->dimension - 1;
  request r = {.data = data, .domain = domain, .rows = *rows, .is_settled = is_settled};
  if (domain->descends[last])
    r.rows.first = domain->size[last] - rows->first - rows->count;
  out[0] = out[1] = out[2] = NULL;
  fg_status status = read_vector(out, r, pair, grid, normal);
  if (status == FG_STATUS_OK)
    status = apply_hiding(out, r);
  if (status == FG_STATUS_OK && mask)
    status = apply_mask(out, r, mask);
  for (int k = 0; k < 3; ++k)
    if (status != FG_STATUS_OK) {
      free(out[k]);
      out[k] = NULL;
    } else if (out[k]) {
      reverse_axes(out[k], domain, rows->count);
    }
  return status;
}
