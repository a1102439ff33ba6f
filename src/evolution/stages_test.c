/* The stages of an evolution, by the parts of its energy: from weak noise the phases
 * separate first, which costs interfaces, and then interfaces get fewer. */
#include <math.h>
#include <string.h>

#include "base/context_test.h"

typedef struct parts {
  double chemical, gradient;
} parts;

typedef struct subject {
  fg_context *context;
  fg_field *field;
  fg_evolution *evolution;
} subject;

static void begin(subject *s, double noise)
{
  const fg_evolution_options options = {.nodes = 97, .noise = noise, .seed = 3};
  assert_int_equal(fg_context_create(&s->context), FG_STATUS_OK);
  assert_int_equal(fg_field_create_analytic(&s->field, s->context, "benard", 0),
                   FG_STATUS_OK);
  assert_int_equal(fg_evolution_create(&s->evolution, s->context, s->field, &options),
                   FG_STATUS_OK);
}

static void end(subject *s)
{
  fg_evolution_destroy(s->evolution);
  fg_field_destroy(s->field);
  fg_context_destroy(s->context);
}

/* The integral of (u^2 - 1)^2 / 2 with lumped masses, and what is left of the energy. */
static parts parts_of(const subject *s, double energy)
{
  fg_density *density = NULL;
  assert_int_equal(fg_density_create(&density, s->evolution), FG_STATUS_OK);
  const fg_density_arrays *d = fg_density_contents(density);
  const fg_mesh_info *mesh = fg_evolution_mesh(s->evolution);
  double chemical = 0.0;
  for (int j = 0; j < d->nodes[1]; ++j)
    for (int i = 0; i < d->nodes[0]; ++i) {
      double u = (double)d->u[(size_t)j * (size_t)d->nodes[0] + (size_t)i], mass = 1.0;
      if (!d->periodic[0] && (i == 0 || i == d->nodes[0] - 1))
        mass *= 0.5;
      if (!d->periodic[1] && (j == 0 || j == d->nodes[1] - 1))
        mass *= 0.5;
      chemical += 0.5 * mass * (u * u - 1.0) * (u * u - 1.0);
    }
  chemical *= mesh->spacing[0] * mesh->spacing[1] / (mesh->length * mesh->length);
  fg_density_destroy(density);
  return (parts){chemical, energy - chemical};
}

static parts step(const subject *s, fg_step *now)
{
  assert_int_equal(fg_evolution_step(s->evolution, now), FG_STATUS_OK);
  parts measured = parts_of(s, now->energy);
  assert_true(fabs(now->chemical_energy - measured.chemical) <= 1e-5 * now->energy);
  assert_true(fabs(now->chemical_energy + now->gradient_energy - now->energy) <=
              1e-14 * now->energy);
  return measured;
}

/* Once what does not grow of the noise is smoothed away, the chemical energy is exchanged
 * for interfaces until the phases are separate. */
static void weak_noise_begins_with_separation(void **state)
{
  (void)state;
  subject s;
  begin(&s, 0.05);
  fg_step now;
  const parts first = step(&s, &now);
  parts before = first, after;
  do {
    after = step(&s, &now);
    if (before.gradient < 1e-3 * first.chemical && after.gradient > before.gradient)
      break;
    assert_true(after.gradient < before.gradient);
    before = after;
  } while (now.step < 40);
  const parts least = before;
  assert_true(least.chemical > 0.99 * first.chemical);
  while (now.clusters == 0) {
    before = after;
    after = step(&s, &now);
    assert_true(after.chemical < before.chemical);
    assert_true(after.gradient > before.gradient);
  }
  print_message("# chemical energy from %.4f to %.4f, of gradients from %.5f to %.4f\n",
                least.chemical, after.chemical, least.gradient, after.gradient);
  assert_true(after.chemical < 0.5 * least.chemical);
  assert_true(after.gradient > 100.0 * least.gradient);
  const parts most = after;
  while (now.clusters > 6)
    after = step(&s, &now);
  assert_true(after.gradient < 0.8 * most.gradient); /* and then interfaces get fewer */
  end(&s);
}

static void noise_of_the_usual_amplitude_begins_with_interfaces(void **state)
{
  (void)state;
  subject s;
  begin(&s, 0.0);
  fg_step now;
  double most = 0.0;
  parts now_parts;
  do {
    now_parts = step(&s, &now);
    most = fmax(most, now_parts.gradient);
  } while (now.clusters == 0);
  assert_true(most > 2.0 * now_parts.gradient);
  subject same;
  begin(&same, 1.5);
  fg_step other = {0};
  for (long n = 0; n < now.step; ++n)
    step(&same, &other);
  assert_true(memcmp(&other.energy, &now.energy, sizeof now.energy) == 0);
  end(&same);
  end(&s);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(weak_noise_begins_with_separation),
      cmocka_unit_test(noise_of_the_usual_amplitude_begins_with_interfaces),
  };
  return cmocka_run_group_tests_name("evolution/stages", tests, NULL, NULL);
}
