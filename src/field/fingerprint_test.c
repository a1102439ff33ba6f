/* Fingerprints tell fields apart by every number in them, and by nothing else. */
#include <math.h>
#include <string.h>

#include "base/context_test.h"
#include "field/fingerprint.h"

enum { NX = 5, NY = 4 };

typedef struct samples {
  double x[NX], y[NY];
  float u[NX * NY], v[NX * NY];
  unsigned char valid[NX * NY];
  fg_field_arrays arrays;
} samples;

static void fill(samples *s)
{
  memset(s, 0, sizeof *s);
  for (int n = 0; n < NX * NY; ++n) {
    s->u[n] = (float)(1.5 + 0.25 * n);
    s->v[n] = (float)(3.0 - 0.5 * n);
    s->valid[n] = 1;
  }
  for (int i = 0; i < NX; ++i)
    s->x[i] = 2.0 + i;
  for (int j = 0; j < NY; ++j)
    s->y[j] = -1.0 + 0.5 * j;
  s->arrays = (fg_field_arrays){.dimension = 2,
                                .size = {NX, NY, 1},
                                .axis = {s->x, s->y},
                                .velocity = {s->u, s->v},
                                .valid = s->valid};
}

static uint64_t print_of(const samples *s)
{
  fg_field *field;
  assert_int_equal(fg_field_create(&field, NULL, &s->arrays), FG_STATUS_OK);
  uint64_t number = fg__field_fingerprint(field);
  fg_field_destroy(field);
  return number;
}

static void equal_fields_have_equal_numbers(void **state)
{
  (void)state;
  samples one, other;
  fill(&one);
  fill(&other);
  other.arrays.title = "another title";
  other.arrays.velocity_units = "m/s";
  assert_true(print_of(&one) == print_of(&other));
}

static void every_number_counts(void **state)
{
  (void)state;
  samples s;
  fill(&s);
  uint64_t seen[2 * NX * NY + NX + NY + 32];
  size_t count = 0;
  seen[count++] = print_of(&s);
  for (int n = 0; n < NX * NY; ++n) {
    s.u[n] = nextafterf(s.u[n], 9.0F);
    seen[count++] = print_of(&s);
    fill(&s);
    s.v[n] = -s.v[n] - 0.125F;
    seen[count++] = print_of(&s);
    fill(&s);
  }
  for (int i = 0; i < NX; ++i) {
    s.x[i] = nextafter(s.x[i], 9.0);
    seen[count++] = print_of(&s);
    fill(&s);
  }
  for (int j = 0; j < NY; ++j) {
    s.y[j] = nextafter(s.y[j], 9.0);
    seen[count++] = print_of(&s);
    fill(&s);
  }
  s.valid[NX * NY - 1] = 0;
  seen[count++] = print_of(&s);
  s.valid[0] = 0;
  seen[count++] = print_of(&s);
  fill(&s);
  s.arrays.period[0] = 5.5;
  seen[count++] = print_of(&s);
  s.arrays.period[0] = 6.0;
  seen[count++] = print_of(&s);
  fill(&s);
  s.arrays.scale = FG_SCALE_MAP;
  seen[count++] = print_of(&s);
  fill(&s);
  s.arrays.velocity[0] = s.v; /* components exchanged */
  s.arrays.velocity[1] = s.u;
  seen[count++] = print_of(&s);
  fill(&s);
  float kept = s.u[3]; /* two samples exchanged */
  s.u[3] = s.u[4];
  s.u[4] = kept;
  seen[count++] = print_of(&s);
  for (size_t n = 0; n < count; ++n)
    for (size_t m = 0; m < n; ++m)
      assert_true(seen[n] != seen[m]);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(equal_fields_have_equal_numbers),
      cmocka_unit_test(every_number_counts),
  };
  return cmocka_run_group_tests_name("field/fingerprint", tests, NULL, NULL);
}
