#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/context_test.h"
#include "tensor/tensor.h"

enum { ENTRIES = 6 };

static const double ANISOTROPY = 0.17;

typedef struct owned_tensor {
  fg__tensor tensor;
  float *memory;
} owned_tensor;

static owned_tensor tensor_for(const fg__cells *cells)
{
  size_t count = fg__cell_count(cells);
  owned_tensor t = {.memory = calloc(count, ENTRIES * sizeof(float))};
  assert_non_null(t.memory);
  float **const entry[] = {&t.tensor.xx, &t.tensor.xy, &t.tensor.yy,
                           &t.tensor.zz, &t.tensor.xz, &t.tensor.yz};
  for (size_t m = 0; m < (cells->dimension == 3 ? 6 : 3); ++m)
    *entry[m] = t.memory + m * count;
  t.tensor.active = calloc(count, 1);
  assert_non_null(t.tensor.active);
  return t;
}

static void tensor_free(owned_tensor *t)
{
  free(t->memory);
  free(t->tensor.active);
}

/* A rough field with holes, periodic along x. */
static fg_field *rough_field(fg_context *context, int dimension)
{
  enum { NX = 12, NY = 9, NZ = 8, COUNT = NX * NY * NZ };
  static float velocity[3][COUNT];
  static double axis[3][NX];
  uint64_t random_state = 77;
  for (int c = 0; c < 3; ++c)
    for (int n = 0; n < COUNT; ++n) {
      random_state = random_state * 6364136223846793005U + 1442695040888963407U;
      velocity[c][n] = (float)((double)(int64_t)random_state * 0x1p-63);
      if (n % 53 == 20)
        velocity[c][n] = NAN;
    }
  for (int k = 0; k < 3; ++k)
    for (int i = 0; i < NX; ++i)
      axis[k][i] = 0.3 * k + (1.0 + 0.1 * k) * i + 0.02 * i * i;
  fg_field_arrays arrays = {.dimension = dimension,
                            .size = {NX, NY, NZ},
                            .axis = {axis[0], axis[1], axis[2]},
                            .period = {axis[0][NX - 1] + 1.1},
                            .velocity = {velocity[0], velocity[1], velocity[2]}};
  fg_field *field = NULL;
  assert_int_equal(fg_field_create(&field, context, &arrays), FG_STATUS_OK);
  return field;
}

static fg__cells domain_cells(const fg_field *field)
{
  const fg_field_arrays *a = fg_field_contents(field);
  fg__cells cells = {.dimension = a->dimension, .count = {26, 19, 15}};
  for (int k = 0; k < a->dimension; ++k) {
    double side = a->period[k] > 0.0 ? a->period[k] : a->axis[k][a->size[k] - 1];
    cells.origin[k] = a->axis[k][0];
    cells.spacing[k] =
        (side - (a->period[k] > 0.0 ? 0.0 : a->axis[k][0])) / cells.count[k];
  }
  return cells;
}

static fg__cells box_of(const fg__cells *domain, const int first[3], const int count[3])
{
  fg__cells box = *domain;
  for (int k = 0; k < 3; ++k) {
    box.domain_count[k] = domain->count[k];
    box.first[k] = first[k];
    box.count[k] = count[k];
  }
  return box;
}

static size_t index_in(const fg__cells *domain, const fg__cells *box, int i, int j, int k)
{
  int at[3] = {i, j, k};
  for (int d = 0; d < 3; ++d)
    at[d] = (box->first[d] + at[d] + domain->count[d]) % domain->count[d];
  int layer = box->dimension == 3 ? at[2] : 0;
  return ((size_t)layer * (size_t)domain->count[1] + (size_t)at[1]) *
             (size_t)domain->count[0] +
         (size_t)at[0];
}

static void assert_same(const fg__cells *domain, const owned_tensor *whole,
                        const fg__cells *box, const owned_tensor *part)
{
  size_t all = fg__cell_count(domain), count = fg__cell_count(box), n = 0;
  for (int k = 0; k < fg__layers(box); ++k)
    for (int j = 0; j < box->count[1]; ++j)
      for (int i = 0; i < box->count[0]; ++i, ++n) {
        size_t at = index_in(domain, box, i, j, k);
        assert_int_equal(whole->tensor.active[at], part->tensor.active[n]);
        for (size_t m = 0; m < (box->dimension == 3 ? 6 : 3); ++m)
          assert_memory_equal(whole->memory + m * all + at, part->memory + m * count + n,
                              sizeof(float));
      }
}

/* A cell gets the same bits whichever box it is computed in. */
static void boxes_get_what_the_whole_has(void **state)
{
  (void)state;
  static const struct {
    int first[3], count[3];
  } boxes[] = {{{0, 0, 0}, {26, 19, 15}}, {{0, 0, 0}, {13, 10, 8}},
               {{13, 10, 8}, {13, 9, 7}}, {{5, 7, 3}, {4, 1, 2}},
               {{25, 18, 14}, {1, 1, 1}}, {{-3, 2, 0}, {9, 5, 15}},
               {{20, 0, 6}, {11, 19, 4}}, {{7, 0, 0}, {26, 19, 3}}};
  const double width[] = {0.0, 0.35, 1.1, 30.0};
  const bool periodic[3] = {true, false, false};
  fg_context *context = NULL;
  assert_int_equal(fg_context_create(&context), FG_STATUS_OK);
  for (int dimension = 2; dimension <= 3; ++dimension) {
    fg_field *field = rough_field(context, dimension);
    fg__cells domain = domain_cells(field);
    for (size_t w = 0; w < sizeof width / sizeof *width; ++w) {
      owned_tensor whole = tensor_for(&domain);
      assert_int_equal(fg__tensor_fill(&whole.tensor, context, field, &fg__law_flow,
                                       ANISOTROPY, &domain, NULL),
                       FG_STATUS_OK);
      if (width[w] > 0.0)
        assert_int_equal(fg__tensor_smooth(&whole.tensor, context, ANISOTROPY, &domain,
                                           periodic, width[w], NULL),
                         FG_STATUS_OK);
      for (size_t b = 0; b < sizeof boxes / sizeof *boxes; ++b) {
        fg__cells box = box_of(&domain, boxes[b].first, boxes[b].count);
        owned_tensor part = tensor_for(&box);
        assert_int_equal(fg__tensor_fill_box(&part.tensor, context, field, &fg__law_flow,
                                             ANISOTROPY, &box, periodic, width[w], NULL),
                         FG_STATUS_OK);
        assert_same(&domain, &whole, &box, &part);
        tensor_free(&part);
      }
      tensor_free(&whole);
    }
    fg_field_destroy(field);
  }
  fg_context_destroy(context);
}

/* A rank whose box is all hole has nothing to complain of; the domain has. */
static void only_an_empty_domain_is_refused(void **state)
{
  (void)state;
  fg_context *context = NULL;
  fg_field *field = NULL;
  assert_int_equal(fg_context_create(&context), FG_STATUS_OK);
  const double axis[] = {0.0, 1.0, 2.0, 3.0};
  float velocity[64];
  for (int n = 0; n < 64; ++n)
    velocity[n] = n % 4 < 2 && n / 4 % 4 < 2 && n / 16 < 2 ? 1.0F : NAN;
  fg_field_arrays arrays = {.dimension = 3,
                            .size = {4, 4, 4},
                            .axis = {axis, axis, axis},
                            .velocity = {velocity, velocity, velocity}};
  assert_int_equal(fg_field_create(&field, context, &arrays), FG_STATUS_OK);
  fg__cells cells = {.dimension = 3,
                     .count = {3, 3, 3},
                     .spacing = {0.5, 0.5, 0.5},
                     .domain_count = {6, 6, 6},
                     .first = {3, 3, 3}};
  owned_tensor t = tensor_for(&cells);
  assert_int_equal(
      fg__tensor_fill(&t.tensor, context, field, &fg__law_isotropic, 1.0, &cells, NULL),
      FG_STATUS_OK);
  for (size_t n = 0; n < 27; ++n)
    assert_true(t.tensor.active[n] == 0 && t.tensor.zz[n] == 0.0F);
  memset(cells.first, 0, sizeof cells.first);
  memset(cells.domain_count, 0, sizeof cells.domain_count);
  for (int k = 0; k < 3; ++k)
    cells.origin[k] = 1.5;
  assert_int_equal(
      fg__tensor_fill(&t.tensor, context, field, &fg__law_isotropic, 1.0, &cells, NULL),
      FG_STATUS_ARGUMENT);
  assert_non_null(strstr(fg_context_message(context), "3 x 3 x 3"));
  tensor_free(&t);
  fg_field_destroy(field);
  fg_context_destroy(context);
}

/* v = A v and a n = A n for what is across it, with the velocity of a formula. */
static void eigenvectors_follow_the_flow(void **state)
{
  (void)state;
  fg_context *context = NULL;
  fg_field *field = NULL;
  assert_int_equal(fg_context_create(&context), FG_STATUS_OK);
  assert_int_equal(fg_field_create_analytic(&field, context, "abc", 49), FG_STATUS_OK);
  fg__cells cells = {.dimension = 3, .count = {7, 6, 5}};
  for (int k = 0; k < 3; ++k)
    cells.spacing[k] = 1.0 / cells.count[k];
  owned_tensor t = tensor_for(&cells);
  assert_int_equal(
      fg__tensor_fill(&t.tensor, context, field, &fg__law_flow, ANISOTROPY, &cells, NULL),
      FG_STATUS_OK);
  for (size_t n = 0; n < fg__cell_count(&cells); ++n) {
    double at[3] = {((double)(n % 7) + 0.5) / 7, ((double)(n / 7 % 6) + 0.5) / 6,
                    ((double)(n / 42) + 0.5) / 5};
    double v[3], x[3];
    for (int k = 0; k < 3; ++k)
      x[k] = 2.0 * 3.14159265358979 * at[k];
    for (int k = 0; k < 3; ++k)
      v[k] = sin(x[(k + 2) % 3]) + cos(x[(k + 1) % 3]);
    const fg__tensor *a = &t.tensor;
    double m[3][3] = {{(double)a->xx[n], (double)a->xy[n], (double)a->xz[n]},
                      {(double)a->xy[n], (double)a->yy[n], (double)a->yz[n]},
                      {(double)a->xz[n], (double)a->yz[n], (double)a->zz[n]}};
    double across[2][3] = {{v[1], -v[0], 0.0}, {0.0, v[2], -v[1]}};
    for (int k = 0; k < 3; ++k) {
      double along = 0.0, sideways[2] = {0.0, 0.0};
      for (int l = 0; l < 3; ++l) {
        along += m[k][l] * v[l];
        sideways[0] += m[k][l] * across[0][l];
        sideways[1] += m[k][l] * across[1][l];
      }
      /* interpolation between 48 samples a wave errs by (2 pi / 48)^2 / 8 */
      assert_true(fabs(along - v[k]) < 0.006);
      for (int s = 0; s < 2; ++s)
        assert_true(fabs(sideways[s] - ANISOTROPY * across[s][k]) < 0.006);
    }
  }
  tensor_free(&t);
  fg_field_destroy(field);
  fg_context_destroy(context);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(boxes_get_what_the_whole_has),
      cmocka_unit_test(only_an_empty_domain_is_refused),
      cmocka_unit_test(eigenvectors_follow_the_flow),
  };
  return cmocka_run_group_tests_name("tensor/box", tests, NULL, NULL);
}
