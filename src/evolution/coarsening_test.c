/* How patterns coarsen: by gamma and not by the mesh, without pinning, and to the shape
 * that the anisotropy needs. docs/design quotes the figures printed here. */
#include "component/components.h"
#include "evolution/curve_test.h"

enum { SEEDS = 4 };

/* The same gamma and noise on two meshes: curves agree far better than those of two
 * seeds. */
static void the_mesh_does_not_matter(fg_energy energy, double interface_cells,
                                     double anisotropy, const char *field_name)
{
  double width = interface_cells / 128.0;
  fg_evolution_options options = {.energy = energy, .gamma = width * width / anisotropy};
  curve *coarse[SEEDS], *fine[SEEDS];
  double end = 0.0, times[TIMES];
  for (int s = 0; s < SEEDS; ++s) {
    options.seed = (uint64_t)s + 1;
    options.nodes = 129;
    coarse[s] = run_curve(field_name, &options, s == 0 ? 12 : 0, end, NULL);
    end = s == 0 ? end_of(coarse[0]) : end;
    options.nodes = 257;
    fine[s] = run_curve(field_name, &options, 0, end, NULL);
  }
  spread_times(1.5 * first_count_time(coarse[0]), end, times);
  double difference = 0.0, scatter = 0.0, bias = 0.0;
  for (int k = 0; k < TIMES; ++k) {
    double values[SEEDS];
    for (int s = 0; s < SEEDS; ++s) {
      values[s] = clusters_at(coarse[s], times[k]);
      double change = clusters_at(fine[s], times[k]) - values[s];
      difference += fabs(change) / SEEDS / TIMES;
      bias += change / SEEDS / TIMES;
    }
    scatter += scatter_of(values, SEEDS) / TIMES;
  }
  print_message("# %s: 129 and 257 nodes differ by %.2f clusters (mean %+.2f), seeds "
                "scatter by %.2f\n",
                field_name, difference, bias, scatter);
  assert_true(difference < scatter);
  assert_true(fabs(bias) < 0.5 * scatter);
  for (int s = 0; s < SEEDS; ++s) {
    destroy_curve(coarse[s]);
    destroy_curve(fine[s]);
  }
}

static void the_length_scale_follows_from_gamma(void **state)
{
  (void)state;
  the_mesh_does_not_matter(FG_ENERGY_FLOW, 1.1, 0.15, "vortex3");
}

static void the_isotropic_length_scale_follows_from_gamma(void **state)
{
  (void)state;
  the_mesh_does_not_matter(FG_ENERGY_ISOTROPIC, 1.5, 1.0, "uniform");
}

/* A pinned pattern would stop; this one goes on at a steady pace, in both halves of the
 * run's logarithmic time alike. Diffusion gives t^(-2/3) in the end, less before. */
static void isotropic_patterns_are_not_pinned(void **state)
{
  (void)state;
  curve *c = run_curve("uniform", &(fg_evolution_options){.energy = FG_ENERGY_ISOTROPIC},
                       12, 0.0, NULL);
  double whole = exponent_of(c, false, 100), late = exponent_of(c, false, 30);
  double of_energy = exponent_of(c, true, 100);
  print_message("# isotropic: N ~ t^%.3f from 100, t^%.3f from 30 clusters on; E ~ "
                "t^%.3f\n",
                whole, late, of_energy);
  assert_true(whole < -1.0 / 3.0 && whole > -2.0 / 3.0);
  assert_true(late < -0.25);
  assert_true(of_energy < -0.2 && of_energy > -0.4);
  destroy_curve(c);
}

/* Second moments of the clusters that touch no boundary. */
typedef struct elongation {
  double aspect, degrees;
  int clusters;
} elongation;

static elongation elongation_of(const fg_evolution *evolution)
{
  fg_density *density = NULL;
  assert_int_equal(fg_density_create(&density, evolution), FG_STATUS_OK);
  const fg_density_arrays *d = fg_density_contents(density);
  fg__component_grid grid = {.nodes = {d->nodes[0], d->nodes[1]},
                             .u = d->u,
                             .debris_area =
                                 d->debris_area / (d->spacing[0] * d->spacing[1])};
  fg__components components = {0};
  assert_int_equal(fg__components_find(&components, NULL, &grid), FG_STATUS_OK);
  elongation result = {0};
  double logarithm = 0.0, cosine = 0.0, sine = 0.0;
  for (int label = 1; label <= components.count; ++label) {
    double m = 0.0, x = 0.0, y = 0.0, xx = 0.0, xy = 0.0, yy = 0.0;
    bool inside = true;
    for (size_t n = 0; n < node_count(d); ++n) {
      if (components.label[n] != label)
        continue;
      double i = (double)(n % (size_t)d->nodes[0]), j = (double)(n / (size_t)d->nodes[0]);
      inside &= i > 0.0 && j > 0.0 && i + 1 < d->nodes[0] && j + 1 < d->nodes[1];
      m += 1.0;
      x += i;
      y += j;
      xx += i * i;
      xy += i * j;
      yy += j * j;
    }
    if (!inside)
      continue;
    xx = xx / m - x / m * (x / m);
    xy = xy / m - x / m * (y / m);
    yy = yy / m - y / m * (y / m);
    double mean = 0.5 * (xx + yy), spread = hypot(0.5 * (xx - yy), xy);
    logarithm += 0.5 * log((mean + spread) / (mean - spread));
    cosine += xx - yy;
    sine += 2.0 * xy;
    ++result.clusters;
  }
  if (result.clusters > 0)
    result.aspect = exp(logarithm / result.clusters);
  result.degrees = 0.5 * atan2(sine, cosine) * 180.0 / acos(-1.0);
  fg__components_clear(&components);
  fg_density_destroy(density);
  return result;
}

/* Late in a run of the uniform field, at 25 degrees: a Wulff shape of aspect 1/sqrt(a).
 */
static void assert_elongated(double anisotropy)
{
  fg_context *context = NULL;
  fg_field *field = NULL;
  fg_evolution *evolution = NULL;
  assert_int_equal(fg_context_create(&context), FG_STATUS_OK);
  assert_int_equal(fg_field_create_analytic(&field, context, "uniform", 33),
                   FG_STATUS_OK);
  fg_evolution_options options = {.anisotropy = anisotropy, .seed = 3};
  assert_int_equal(fg_evolution_create(&evolution, context, field, &options),
                   FG_STATUS_OK);
  const int at[] = {40, 30, 20, 15};
  double aspect = 0.0, degrees = 0.0;
  fg_step step;
  for (int k = 0; k < 4; ++k) {
    do
      assert_int_equal(fg_evolution_step(evolution, &step), FG_STATUS_OK);
    while (step.clusters == 0 || step.clusters > at[k]);
    elongation e = elongation_of(evolution);
    print_message("# a = %g, %d clusters: %d inside, aspect %.2f, direction %.1f\n",
                  anisotropy, step.clusters, e.clusters, e.aspect, e.degrees);
    assert_true(e.clusters > 2);
    aspect += 0.25 * e.aspect;
    degrees += 0.25 * e.degrees;
  }
  assert_true(fabs(log(aspect * sqrt(anisotropy))) < log(1.4));
  assert_true(fabs(degrees - 25.0) < 3.0);
  fg_evolution_destroy(evolution);
  fg_field_destroy(field);
  fg_context_destroy(context);
}

static void clusters_are_as_long_as_the_anisotropy_asks(void **state)
{
  (void)state;
  assert_elongated(0.15);
  assert_elongated(0.4);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(the_length_scale_follows_from_gamma),
      cmocka_unit_test(the_isotropic_length_scale_follows_from_gamma),
      cmocka_unit_test(isotropic_patterns_are_not_pinned),
      cmocka_unit_test(clusters_are_as_long_as_the_anisotropy_asks),
  };
  return cmocka_run_group_tests_name("evolution/coarsening", tests, NULL, NULL);
}
