/* The readers of nearest tangents against all distances one by one. */
#include "score/picture_test.h"
#include "score/reader.h"

typedef struct bench {
  fg_field *field;
  fg_icons *icons;
  fg__domain_raster raster;
  fg__samples samples;
  fg__nearest nearest;
  double lambda;
} bench;

static void set_up(bench *b, fg_context *context, const sampling *box,
                   velocity_of velocity, int count, int thread_count)
{
  fg__threads *threads = NULL;
  *b = (bench){.field = field_of(context, box, velocity), .icons = no_icons(context)};
  assert_int_equal(fg__threads_create(&threads, context, thread_count), FG_STATUS_OK);
  assert_int_equal(fg__domain_raster_create(&b->raster, context, b->field, threads),
                   FG_STATUS_OK);
  b->lambda = b->raster.side / (box->dimension == 3 ? cbrt(count) : sqrt(count));
  add_scribbles(b->icons, context, box, count, 0.4 * b->lambda);
  assert_int_equal(
      fg__samples_create(&b->samples, context, &b->raster, b->icons, b->lambda, HUGE_VAL),
      FG_STATUS_OK);
  assert_int_equal(fg__nearest_create(&b->nearest, context, &b->raster, &b->samples,
                                      b->lambda, threads),
                   FG_STATUS_OK);
  fg__threads_destroy(threads);
}

static void tear_down(bench *b)
{
  fg__nearest_clear(&b->nearest);
  fg__samples_clear(&b->samples);
  fg__domain_raster_clear(&b->raster);
  fg_icons_destroy(b->icons);
  fg_field_destroy(b->field);
}

static double squared_distance(const double a[3], const double b[3])
{
  double sum = 0;
  for (int k = 0; k < 3; ++k)
    sum += (a[k] - b[k]) * (a[k] - b[k]);
  return sum;
}

static double angle_to(const double a[3], const fg__domain_raster *raster, size_t place)
{
  double inner = 0, length = 0;
  for (int k = 0; k < raster->dimension; ++k) {
    inner += a[k] * (double)raster->direction[k][place];
    length += a[k] * a[k];
  }
  return acos(fmax(-1, fmin(1, inner / sqrt(length)))) * 180 / 3.14159265358979;
}

static void check_cell(const bench *b, size_t place, const double position[3])
{
  const fg__samples *samples = &b->samples;
  const double epsilon = 0.05 * b->lambda;
  double best = HUGE_VAL, near[3] = {0}, sum[3] = {0};
  for (int n = 0; n < samples->icons; ++n) {
    double own = HUGE_VAL;
    size_t nearest = 0;
    for (size_t i = samples->first[n]; i < samples->first[n + 1]; ++i) {
      const double square = squared_distance(samples->position[i], position);
      if (square < own) {
        own = square;
        nearest = i;
      }
    }
    if (own == HUGE_VAL)
      continue;
    for (int k = 0; k < 3; ++k)
      sum[k] += samples->tangent[nearest][k] /
                pow(own + epsilon * epsilon, b->raster.dimension == 3 ? 2 : 1.5);
    if (own < best) {
      best = own;
      memcpy(near, samples->tangent[nearest], sizeof near);
    }
  }
  assert_close((double)b->nearest.distance[place], sqrt(best), 1e-5 * b->lambda);
  if (!b->raster.counts[place])
    return;
  /* acos is good to some hundred thousandths of a degree near 0 */
  assert_close((double)b->nearest.angle[place], angle_to(near, &b->raster, place), 3e-2);
  assert_close((double)b->nearest.weighted_angle[place], angle_to(sum, &b->raster, place),
               3e-2);
}

/* Every `stride`th cell. */
static void check_cells(const bench *b, size_t stride)
{
  const fg__domain_raster *raster = &b->raster;
  const size_t columns = (size_t)raster->size[0], rows = (size_t)raster->size[1];
  size_t checked = 0;
  for (size_t place = 0; place < raster->cells; place += stride) {
    const int at[3] = {(int)(place % columns), (int)(place / columns % rows),
                       (int)(place / columns / rows)};
    double position[3];
    fg__domain_raster_centre(raster, at, position);
    if (raster->dimension == 2)
      position[2] = 0;
    if (!raster->inside[place])
      continue;
    check_cell(b, place, position);
    ++checked;
  }
  assert_true(checked > 300);
}

static void in_2d_all_is_as_if_every_distance_were_taken(void **state)
{
  bench b;
  set_up(&b, *state, &PLAIN, coast, 23, 1);
  check_cells(&b, 37);
  tear_down(&b);
}

static const sampling SOLID = {
    .dimension = 3, .nodes = {12, 9, 14}, .low = {-7, 3, 1}, .high = {5, 11, 6}};

static void in_3d_too(void **state)
{
  bench b;
  set_up(&b, *state, &SOLID, swirl, 17, 1);
  check_cells(&b, 211);
  tear_down(&b);
}

static void threads_do_not_show(void **state)
{
  bench one, three;
  set_up(&one, *state, &PLAIN, coast, 23, 1);
  set_up(&three, *state, &PLAIN, coast, 23, 3);
  const size_t bytes = one.raster.cells * sizeof(float);
  assert_memory_equal(one.nearest.angle, three.nearest.angle, bytes);
  assert_memory_equal(one.nearest.weighted_angle, three.nearest.weighted_angle, bytes);
  assert_memory_equal(one.nearest.distance, three.nearest.distance, bytes);
  tear_down(&one);
  tear_down(&three);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      CASE(in_2d_all_is_as_if_every_distance_were_taken),
      CASE(in_3d_too),
      CASE(threads_do_not_show),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
