#include "texture/raster.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/angle.h"
#include "base/memory.h"
#include "field/field.h"

/* As fg_field_tangent has it. */
static const double smallest_cosine = 1.745e-4;
/* Where pixels lie between the field's samples along one axis. */
typedef struct places {
  double *coordinate;
  int *cell;
  float *fraction;
} places;

static void places_clear(places *p)
{
  free(p->coordinate);
  free(p->cell);
  free(p->fraction);
}

static bool places_create(places *out, const fg__axis *axis, int pixels)
{
  size_t count = (size_t)pixels;
  out->coordinate = fg__allocate(count, sizeof *out->coordinate);
  out->cell = fg__allocate(count, sizeof *out->cell);
  out->fraction = fg__allocate(count, sizeof *out->fraction);
  if (!out->coordinate || !out->cell || !out->fraction)
    return false;
  const double low = axis->coordinate[0];
  const double side = axis->coordinate[axis->cells] - low;
  int cell = 0;
  for (int i = 0; i < pixels; ++i) {
    double x = low + side * ((i + 0.5) / pixels);
    while (cell + 1 < axis->cells && x >= axis->coordinate[cell + 1])
      ++cell;
    double inside = (x - axis->coordinate[cell]) * axis->inverse_width[cell];
    out->coordinate[i] = x;
    out->cell[i] = cell;
    out->fraction[i] = (float)fmin(fmax(inside, 0.0), 1.0);
  }
  return true;
}

typedef struct sampling {
  fg__raster *raster;
  const fg_field *field;
  places axis[2];
  double pixels_a_unit[2]; /* but for a common factor */
  float *row;              /* two rows of samples a thread */
} sampling;

/* The samples of a component between two rows of the grid. */
static void mix_rows(float *out, const sampling *s, int k, int cell, float t)
{
  const fg__axis *y = &s->field->axis[1];
  const int n = s->field->axis[0].samples;
  const int next = cell + 1 == y->samples ? 0 : cell + 1;
  const float *lower = s->field->velocity[k] + (size_t)cell * (size_t)n;
  const float *upper = s->field->velocity[k] + (size_t)next * (size_t)n;
  for (int i = 0; i < n; ++i)
    out[i] = (1.0F - t) * lower[i] + t * upper[i];
  out[n] = out[0];
}

static void sample_row(const sampling *s, float *const row[2], int j)
{
  fg__raster *r = s->raster;
  const fg__axis *x = &s->field->axis[0];
  const int cell_row = s->axis[1].cell[j];
  const size_t at = (size_t)j * (size_t)r->size[0];
  for (int k = 0; k < 2; ++k)
    mix_rows(row[k], s, k, cell_row, s->axis[1].fraction[j]);
  double factor[2] = {s->pixels_a_unit[0], s->pixels_a_unit[1]};
  if (s->field->contents.scale == FG_SCALE_GEO)
    factor[0] /= fmax(cos(s->axis[1].coordinate[j] * FG__RADIANS), smallest_cosine);
  const unsigned char *valid = s->field->valid_cell;
  if (valid)
    valid += (size_t)cell_row * (size_t)x->cells;
  float(*direction)[2] = r->direction + fg__raster_at(r, 0, j);
  for (int i = 0; i < r->size[0]; ++i) {
    const int cell = s->axis[0].cell[i];
    const float share = s->axis[0].fraction[i];
    double v[2];
    for (int k = 0; k < 2; ++k)
      v[k] = (double)((1.0F - share) * row[k][cell] + share * row[k][cell + 1]);
    const double along[2] = {factor[0] * v[0], factor[1] * v[1]};
    const double size = sqrt(along[0] * along[0] + along[1] * along[1]);
    const bool known = !valid || valid[cell];
    const bool moves = known && size > 0.0;
    r->pixel[at + (size_t)i] =
        !known ? FG__PIXEL_MASKED : (moves ? FG__PIXEL_MOVING : FG__PIXEL_STILL);
    r->speed[at + (size_t)i] = known ? (float)sqrt(v[0] * v[0] + v[1] * v[1]) : NAN;
    direction[i][0] = moves ? (float)(along[0] / size) : 0.0F;
    direction[i][1] = moves ? (float)(along[1] / size) : 0.0F;
  }
}

static void sample_part(void *argument, const fg__thread *thread)
{
  const sampling *s = argument;
  const size_t samples = (size_t)s->field->axis[0].samples + 1;
  float *own = s->row + (size_t)thread->index * 2 * samples;
  float *const row[2] = {own, own + samples};
  int begin, end;
  fg__threads_range(thread, s->raster->size[1], 1, &begin, &end);
  for (int j = begin; j < end; ++j)
    sample_row(s, row, j);
}

static bool finds_all_moving(const fg__raster *r)
{
  size_t count = (size_t)r->size[0] * (size_t)r->size[1];
  for (size_t n = 0; n < count; ++n)
    if (r->pixel[n] != FG__PIXEL_MOVING)
      return false;
  return true;
}

static fg_status fill(fg__raster *r, fg_context *context)
{
  const size_t columns = (size_t)r->size[0];
  const size_t count = columns * (size_t)r->size[1];
  float(*plain)[2] = fg__allocate(count, sizeof *plain);
  if (!plain)
    return fg__fail_memory(context, "directions", count * sizeof *plain);
  for (int j = 0; j < r->size[1]; ++j)
    memcpy(plain + (size_t)j * columns, r->direction + fg__raster_at(r, 0, j),
           columns * sizeof *plain);
  fg_status status = fg__fill_directions(plain, context, r->pixel, r->size);
  for (int j = 0; j < r->size[1]; ++j)
    memcpy(r->direction + fg__raster_at(r, 0, j), plain + (size_t)j * columns,
           columns * sizeof *plain);
  free(plain);
  return status;
}

static void pad_rows(fg__raster *r)
{
  const size_t row = (size_t)r->stride * sizeof *r->direction;
  for (int j = 0; j < r->size[1]; ++j) {
    for (int i = -r->margin; i < 0; ++i)
      memcpy(r->direction[fg__raster_at(r, i, j)],
             r->direction[fg__raster_at(r, fg__raster_wrap(r, 0, i), j)],
             sizeof *r->direction);
    for (int i = r->size[0]; i < r->size[0] + r->margin; ++i)
      memcpy(r->direction[fg__raster_at(r, i, j)],
             r->direction[fg__raster_at(r, fg__raster_wrap(r, 0, i), j)],
             sizeof *r->direction);
  }
  for (int j = -r->margin; j < r->size[1] + r->margin; ++j)
    if (j < 0 || j >= r->size[1])
      memcpy(r->direction[fg__raster_at(r, -r->margin, j)],
             r->direction[fg__raster_at(r, -r->margin, fg__raster_wrap(r, 1, j))], row);
}

static fg_status allocate(fg__raster *r, fg_context *context)
{
  size_t padded = (size_t)r->stride * (size_t)r->rows;
  size_t count = (size_t)r->size[0] * (size_t)r->size[1];
  r->direction = fg__allocate_aligned(padded, sizeof *r->direction);
  r->speed = fg__allocate(count, sizeof *r->speed);
  r->pixel = fg__allocate(count, 1);
  if (r->direction && r->speed && r->pixel)
    return FG_STATUS_OK;
  return fg__fail_memory(context, "a picture's directions",
                         padded * sizeof *r->direction + count * 5);
}

fg_status fg__raster_create(fg__raster *out, fg_context *context, const fg_field *field,
                            const int size[2], int margin, fg__threads *threads)
{
  *out = (fg__raster){.margin = margin};
  sampling s = {.raster = out, .field = field};
  bool placed = true;
  for (int k = 0; k < 2; ++k) {
    const fg__axis *axis = &field->axis[k];
    out->size[k] = size[k];
    out->periodic[k] = axis->period > 0.0;
    s.pixels_a_unit[k] = size[k] / (axis->coordinate[axis->cells] - axis->coordinate[0]);
    placed = placed && places_create(&s.axis[k], axis, size[k]);
  }
  const double larger = fmax(s.pixels_a_unit[0], s.pixels_a_unit[1]);
  for (int k = 0; k < 2; ++k)
    s.pixels_a_unit[k] /= larger;
  out->stride = size[0] + 2 * margin;
  out->rows = size[1] + 2 * margin;
  size_t samples =
      (size_t)fg__threads_count(threads) * 2 * ((size_t)field->axis[0].samples + 1);
  s.row = fg__allocate(samples, sizeof *s.row);
  fg_status status = FG_STATUS_OK;
  if (!placed || !s.row)
    status = fg__fail_memory(context, "a picture's rows", samples * sizeof *s.row);
  else
    status = allocate(out, context);
  if (!status) {
    fg__threads_run(threads, sample_part, &s);
    out->all_moving = finds_all_moving(out);
    if (!out->all_moving)
      status = fill(out, context);
    pad_rows(out);
  }
  places_clear(&s.axis[0]);
  places_clear(&s.axis[1]);
  free(s.row);
  if (status)
    fg__raster_clear(out);
  return status;
}

void fg__raster_clear(fg__raster *raster)
{
  free(raster->direction);
  free(raster->speed);
  free(raster->pixel);
  *raster = (fg__raster){.direction = NULL};
}
