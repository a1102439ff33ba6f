#include "place/reader/readers.h"

#include "place/fields_test.h"

enum { MOST_LINES = 3 };

typedef struct setting {
  fg_context *context;
  fg_field *field;
  fg__place_domain domain;
  fg__place_scale scale;
  fg__place_raster raster;
  fg__place_line line[MOST_LINES];
  fg__place_contribution contribution[MOST_LINES];
  int lines;
} setting;

static setting set(fg_context *context, const sampling *box, velocity_of velocity,
                   int count)
{
  setting s = {.context = context, .field = field_of(context, box, velocity)};
  assert_int_equal(fg__place_domain_create(&s.domain, context, s.field), FG_STATUS_OK);
  s.scale = fg__place_scale_of(&s.domain, count, true, FG__PLACE_FINE);
  assert_int_equal(fg__place_raster_create(&s.raster, context, &s.domain, &s.scale),
                   FG_STATUS_OK);
  return s;
}

static void clear(setting *s)
{
  for (int n = 0; n < s->lines; ++n)
    fg__place_contribution_clear(&s->contribution[n]);
  fg__place_raster_clear(&s->raster);
  fg__place_domain_clear(&s->domain);
  fg_field_destroy(s->field);
}

static void add(setting *s, double x, double y, double z)
{
  const double lambda = s->scale.lambda;
  const fg__place_seed seed = {{x, y, z}, {0.45 * lambda, 0.7 * lambda}};
  fg__place_line *line = &s->line[s->lines];
  fg__place_trace(line, &s->domain, &s->scale, &seed);
  assert_true(line->count > 0);
  assert_int_equal(fg__place_contribution_compute(&s->contribution[s->lines++],
                                                  s->context, &s->raster, &s->scale,
                                                  line),
                   FG_STATUS_OK);
}

static fg__place_box whole_box(const setting *s)
{
  fg__place_box box = {{0}, {0}};
  memcpy(box.size, s->raster.cells, sizeof box.size);
  return box;
}

static void start(fg__place_contribution *contribution, const setting *s)
{
  fg__place_box box = whole_box(s);
  *contribution = (fg__place_contribution){0};
  assert_int_equal(
      fg__place_contribution_start(contribution, s->context, s->raster.dimension, &box,
                                   (float)(s->scale.reach / s->scale.lambda)),
      FG_STATUS_OK);
}

/* What two readers of some lines make of a point, in lambda, by the definitions. */
typedef struct answer {
  double square;       /* to the nearest sample */
  double doubt;        /* how much farther the second nearest is */
  double vector[2][3]; /* nearest, by inverse distance */
} answer;

static answer evaluate(const setting *s, const double point[3])
{
  const int dimension = s->scale.dimension;
  const double reach = s->scale.reach / s->scale.lambda, epsilon = 0.05 * 0.05;
  answer a = {.square = reach * reach, .doubt = HUGE_VAL};
  for (int l = 0; l < s->lines; ++l) {
    const fg__place_line *line = &s->line[l];
    double least = HUGE_VAL, nearest[3] = {0};
    for (int n = 0; n < line->count; ++n) {
      double square = 0.0;
      for (int k = 0; k < dimension; ++k)
        square += pow(point[k] - (double)line->position[k][n], 2);
      if (square >= reach * reach)
        continue;
      a.doubt = fmin(a.doubt, fabs(square - fmin(least, a.square)));
      if (square < least) {
        least = square;
        for (int k = 0; k < dimension; ++k)
          nearest[k] = (double)line->tangent[k][n];
      }
    }
    if (!(least < HUGE_VAL))
      continue;
    double weight = pow(1 - least / (reach * reach), 2) /
                    pow(least + epsilon, dimension == 2 ? 1.5 : 2);
    for (int k = 0; k < dimension; ++k)
      a.vector[1][k] += weight * nearest[k];
    if (least < a.square) {
      a.square = least;
      memcpy(a.vector[0], nearest, sizeof nearest);
    }
  }
  return a;
}

static double degrees_of(const double *vector, const double *flow, int dimension)
{
  double square = 0.0;
  for (int k = 0; k < dimension; ++k)
    square += vector[k] * vector[k];
  return square > 0.0 ? degrees_between(vector, flow, dimension) : 90.0;
}

/* Every cell of the raster: the sum of contributions, and its weighted errors. */
static void check(setting *s)
{
  const int dimension = s->raster.dimension;
  const float far = 3.0F, reach = (float)(s->scale.reach / s->scale.lambda);
  fg__place_contribution all;
  start(&all, s);
  for (int l = 0; l < s->lines; ++l)
    fg__place_contribution_add(&all, &s->contribution[l]);
  fg__place_box box = whole_box(s);
  const fg__place_weights weighting = {1 / 20.0F, far, reach};
  float *cost = calloc(s->raster.count, sizeof *cost);
  double sum = fg__place_cost(cost, &s->raster, &box, &all, NULL, &weighting),
         total = 0.0, angles = 0.0, weights = 0.0;
  int reached = 0, doubtful = 0;
  for (size_t n = 0; n < s->raster.count; ++n) {
    size_t rest = n;
    double point[3] = {0}, flow[3] = {0}, angle = 0.0;
    for (int k = 0; k < dimension; ++k) {
      point[k] =
          ((double)(rest % (size_t)s->raster.cells[k]) + 0.5) * (double)s->raster.cell;
      rest /= (size_t)s->raster.cells[k];
      flow[k] = (double)s->raster.direction[k][n];
    }
    double weight = (double)s->raster.weight[n];
    const answer a = evaluate(s, point);
    total += (double)cost[n];
    weights += weight;
    if (a.doubt < 1e-4) {
      ++doubtful; /* two samples are equally near */
      angles +=
          weight * ((double)cost[n] / fmax(weight, 1e-9) - (double)far * a.square) * 20;
      continue;
    }
    assert_close((double)all.value[n], a.square, 1e-5);
    for (int reader = 0; reader < 2; ++reader) {
      double size = sqrt(a.vector[reader][0] * a.vector[reader][0] +
                         a.vector[reader][1] * a.vector[reader][1] +
                         a.vector[reader][2] * a.vector[reader][2]);
      for (int k = 0; k < dimension; ++k) {
        size_t array = (size_t)(FG__PLACE_NEAR + reader * dimension + k);
        assert_close((double)all.value[array * all.capacity + n], a.vector[reader][k],
                     5e-3 * size + 1e-6);
      }
      if (weight > 0.0)
        angle += degrees_of(a.vector[reader], flow, dimension);
    }
    reached += a.square < (double)(reach * reach);
    angles += weight * angle;
    assert_close((double)cost[n], weight * (angle / 20 + (double)far * a.square),
                 2e-3 * weight + 1e-9);
  }
  assert_true(reached > 200 && doubtful < reached / 4);
  assert_close(sum, total, 1e-4 * total);
  assert_close(weights, s->scale.count, 1e-3 * s->scale.count);
  const fg__place_weights errors = {1.0F, 0.0F, reach};
  assert_close(fg__place_cost(NULL, &s->raster, &box, &all, NULL, &errors) / weights,
               angles / weights, 0.2);
  free(cost);
  fg__place_contribution_clear(&all);
}

static void readers_follow_their_definitions(void **state)
{
  setting s = set(*state, &PLAIN, coast, 17);
  add(&s, 1.3, 8.1, 0);
  add(&s, 2.9, 6.2, 0);
  add(&s, -4.1, 7.3, 0);
  check(&s);
  clear(&s);
}

static void readers_in_space_too(void **state)
{
  setting s = set(*state, &SOLID, swirl, 8);
  add(&s, -4.3, 5.1, 0.4);
  add(&s, -3.1, 4.2, 1.1);
  add(&s, -5.2, 6.3, -0.7);
  check(&s);
  clear(&s);
}

static void two_contributions_are_one_in_any_order(void **state)
{
  setting s = set(*state, &PLAIN, swirl, 17);
  add(&s, 1.3, 8.1, 0);
  add(&s, 2.2, 6.9, 0);
  fg__place_contribution one, other;
  start(&one, &s);
  start(&other, &s);
  fg__place_contribution_add(&one, &s.contribution[0]);
  fg__place_contribution_add(&one, &s.contribution[1]);
  fg__place_contribution_add(&other, &s.contribution[1]);
  fg__place_contribution_add(&other, &s.contribution[0]);
  for (int array = 0; array < FG__PLACE_ARRAYS(2); ++array)
    assert_memory_equal(one.value + (size_t)array * one.capacity,
                        other.value + (size_t)array * other.capacity,
                        s.raster.count * sizeof(float));
  /* both passed apart cost what their sum costs */
  const fg__place_weights weights = {1 / 30.0F, 5.0F,
                                     (float)(s.scale.reach / s.scale.lambda)};
  fg__place_box box = whole_box(&s), inner = s.contribution[0].box;
  double together = fg__place_cost(NULL, &s.raster, &box, &one, NULL, &weights);
  double apart = fg__place_cost(NULL, &s.raster, &box, &s.contribution[0],
                                &s.contribution[1], &weights);
  assert_true(together == apart);
  double none = fg__place_cost(NULL, &s.raster, &box, NULL, NULL, &weights);
  double alone =
      fg__place_cost(NULL, &s.raster, &box, &s.contribution[0], NULL, &weights);
  assert_true(together < alone && alone < none);
  /* a line costs nothing outside its box */
  double fall =
      fg__place_cost(NULL, &s.raster, &inner, NULL, NULL, &weights) -
      fg__place_cost(NULL, &s.raster, &inner, &s.contribution[0], NULL, &weights);
  assert_close(fall, none - alone, 1e-4 * none);
  fg__place_contribution_clear(&one);
  fg__place_contribution_clear(&other);
  clear(&s);
}

/* Of the cells that no line reaches. */
static double unreached_weight(const setting *s, const fg__place_contribution *all)
{
  const double reach = s->scale.reach / s->scale.lambda;
  double sum = 0.0;
  for (size_t n = 0; n < s->raster.count; ++n)
    sum +=
        (double)all->value[n] < reach * reach - 1e-4 ? 0.0 : (double)s->raster.weight[n];
  return sum;
}

static void an_exact_picture_has_no_error(void **state)
{
  setting s = set(*state, &PLAIN, slant, 2);
  add(&s, -3.6, 6.9, 0);
  add(&s, 2.1, 7.2, 0);
  fg__place_contribution all;
  start(&all, &s);
  fg__place_contribution_add(&all, &s.contribution[0]);
  fg__place_contribution_add(&all, &s.contribution[1]);
  const fg__place_weights errors = {1.0F, 0.0F, (float)(s.scale.reach / s.scale.lambda)};
  fg__place_box box = whole_box(&s);
  double cost = fg__place_cost(NULL, &s.raster, &box, &all, NULL, &errors);
  assert_true(fabs(cost - 180.0 * unreached_weight(&s, &all)) < 0.1 * s.scale.count);
  /* no line: a right angle everywhere */
  fg__place_contribution none;
  start(&none, &s);
  assert_close(fg__place_cost(NULL, &s.raster, &box, &none, NULL, &errors),
               180.0 * s.scale.count, 0.2);
  fg__place_contribution_clear(&all);
  fg__place_contribution_clear(&none);
  clear(&s);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      CASE(readers_follow_their_definitions),
      CASE(readers_in_space_too),
      CASE(two_contributions_are_one_in_any_order),
      CASE(an_exact_picture_has_no_error),
  };
  return cmocka_run_group_tests_name("place/reader/reader/readers", tests, NULL, NULL);
}
