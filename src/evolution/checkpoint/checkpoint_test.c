/* A resumed evolution is the uninterrupted one to the last bit; what does not belong to
 * it, or is damaged, is refused. */
#include "evolution/fixture_test.h"

#include <stdio.h>
#include <sys/stat.h>
#include <unistd.h>

enum { NODES = 65 };

static char folder[] = "/tmp/flowgrain-resume-XXXXXX";
static char path[64], previous[96];

static int make_folder(void **state)
{
  (void)state;
  if (!mkdtemp(folder))
    return 1;
  snprintf(path, sizeof path, "%s/checkpoint", folder);
  snprintf(previous, sizeof previous, "%s.previous", path);
  return 0;
}

static int remove_folder(void **state)
{
  (void)state;
  return rmdir(folder);
}

static int forget(void **state)
{
  unlink(path);
  unlink(previous);
  return tear_down(state);
}

static fg_evolution *begin(fixture *f, const fg_field *field,
                           const fg_evolution_options *options)
{
  fg_evolution *e = NULL;
  fg_status status = fg_evolution_create(&e, f->context, field, options);
  if (status)
    fail_msg("%s", fg_context_message(f->context));
  return e;
}

static fg_step advance(fixture *f, fg_evolution *e, int steps)
{
  fg_step step = {0};
  for (int n = 0; n < steps; ++n)
    if (fg_evolution_step(e, &step))
      fail_msg("%s", fg_context_message(f->context));
  return step;
}

static void save(fixture *f, const fg_evolution *e, const char *note)
{
  if (fg_evolution_save(e, path, note))
    fail_msg("%s", fg_context_message(f->context));
}

static fg_evolution *resume(fixture *f, const fg_field *field,
                            const fg_evolution_options *options, fg_step *step)
{
  fg_checkpoint *checkpoint;
  if (fg_checkpoint_open(&checkpoint, f->context, path))
    fail_msg("%s", fg_context_message(f->context));
  fg_evolution *e = begin(f, field, options);
  if (fg_evolution_resume(e, step, checkpoint))
    fail_msg("%s", fg_context_message(f->context));
  fg_checkpoint_destroy(checkpoint);
  return e;
}

static void same_number(double one, double other)
{
  assert_memory_equal(&one, &other, sizeof one);
}

static void same_state(const fg_step *one, const fg_step *other)
{
  assert_int_equal(one->step, other->step);
  same_number(one->time, other->time);
  same_number(one->tau, other->tau);
  same_number(one->energy, other->energy);
  same_number(one->mass, other->mass);
  same_number(one->area_fraction, other->area_fraction);
  same_number(one->increment, other->increment);
  assert_int_equal(one->clusters, other->clusters);
  assert_int_equal(one->cells, other->cells);
  assert_int_equal(one->stationary, other->stationary);
}

static void same_density(const fg_evolution *one, const fg_evolution *other)
{
  fg_density *a, *b;
  assert_int_equal(fg_density_create(&a, one), FG_STATUS_OK);
  assert_int_equal(fg_density_create(&b, other), FG_STATUS_OK);
  const fg_density_arrays *x = fg_density_contents(a), *y = fg_density_contents(b);
  size_t count = 1;
  for (int k = 0; k < 3; ++k) {
    assert_int_equal(x->nodes[k], y->nodes[k]);
    count *= (size_t)x->nodes[k];
  }
  assert_memory_equal(x->u, y->u, count * sizeof *x->u);
  fg_density_destroy(a);
  fg_density_destroy(b);
}

/* Saves after each of the given numbers of further steps and resumes: `more` steps of the
 * resumed evolution are those of one that was never saved. */
static void goes_on_over(fixture *f, const fg_field *field,
                         const fg_evolution_options *options, const int *steps, int count,
                         int more)
{
  fg_evolution *saved = begin(f, field, options), *plain = begin(f, field, options);
  for (int n = 0; n < count; ++n) {
    fg_step expected = advance(f, plain, steps[n]), step;
    advance(f, saved, steps[n]);
    save(f, saved, NULL);
    fg_evolution *resumed = resume(f, field, options, &step);
    if (steps[n])
      same_state(&step, &expected);
    same_density(resumed, plain);
    for (int k = 0; k < more; ++k) {
      expected = advance(f, plain, 1);
      step = advance(f, resumed, 1);
      same_state(&step, &expected);
      assert_int_equal(step.cycles, expected.cycles);
      assert_int_equal(step.rejected, expected.rejected);
    }
    same_density(resumed, plain);
    fg_evolution_destroy(saved);
    saved = resumed; /* a resumed one is saved again, without the layout's history */
  }
  fg_evolution_destroy(saved);
  fg_evolution_destroy(plain);
}

static void goes_on(fixture *f, const fg_evolution_options *options, const int *steps,
                    int count, int more)
{
  fg_field *field = make(f);
  goes_on_over(f, field, options, steps, count, more);
  fg_field_destroy(field);
}

static void goes_on_bit_for_bit(void **state)
{
  static const int steps[] = {0, 1, 1, 7, 40};
  fg_evolution_options options = {.nodes = NODES, .seed = 3};
  goes_on(*state, &options, steps, 5, 5);
}

static void goes_on_in_3d(void **state)
{
  fixture *f = *state;
  static const int steps[] = {2, 20};
  fg_evolution_options options = {.nodes = 17};
  fg_field *field;
  assert_int_equal(fg_field_create_analytic(&field, f->context, "abc", 9), FG_STATUS_OK);
  goes_on_over(f, field, &options, steps, 2, 5);
  fg_field_destroy(field);
}

static void goes_on_by_theta(void **state)
{
  static const int steps[] = {0, 1, 1, 7, 40};
  fg_evolution_options options = {.nodes = NODES, .scheme = FG_SCHEME_THETA};
  goes_on(*state, &options, steps, 5, 5);
  options.theta = 0.25;
  options.alpha = 1.0;
  options.residual = 1e-2;
  goes_on(*state, &options, steps, 4, 5);
}

static void goes_on_with_a_mask(void **state)
{
  fixture *f = *state;
  for (int j = 0; j < SIDE; ++j) /* two parts, one with a hole */
    for (int i = 0; i < SIDE; ++i)
      f->valid[j * SIDE + i] =
          i != 20 && !(i > 40 && i < 50 && j > 10 && j < 30) && i + j > 9;
  static const int steps[] = {3, 30};
  fg_evolution_options options = {.nodes = NODES, .coverage = 0.4};
  goes_on(f, &options, steps, 2, 10);
}

static void goes_on_round_a_period(void **state)
{
  fixture *f = *state;
  f->arrays.period[0] = 3.1;
  static const int steps[] = {3, 30};
  fg_evolution_options options = {.nodes = NODES + 24};
  goes_on(f, &options, steps, 2, 10);
  f->arrays.period[1] = 2.4;
  goes_on(f, &options, steps, 2, 10);
}

/* Few cycles and long steps: attempts are rejected, and history is dropped. */
static void goes_on_after_rejected_steps(void **state)
{
  fixture *f = *state;
  fg_evolution_options options = {.nodes = NODES, .accuracy = 1.0, .cycles = 1};
  fg_field *field = make(f);
  fg_evolution *e = begin(f, field, &options);
  int rejected = 0;
  for (int n = 0; n < 60; ++n)
    rejected += advance(f, e, 1).rejected;
  fg_evolution_destroy(e);
  fg_field_destroy(field);
  assert_true(rejected > 0);
  int steps[30];
  for (int n = 0; n < 30; ++n)
    steps[n] = 1;
  goes_on(f, &options, steps, 30, 1);
}

static void goes_on_after_a_stop(void **state)
{
  fixture *f = *state;
  fg_evolution_options options = {.nodes = NODES};
  fg_field *field = make(f);
  fg_evolution *plain = begin(f, field, &options), *stopped = begin(f, field, &options);
  advance(f, plain, 20);
  advance(f, stopped, 20);
  fg_step step, expected = advance(f, plain, 20);
  fg_context_stop(f->context);
  assert_int_equal(fg_evolution_step(stopped, &step), FG_STATUS_STOPPED);
  fg_context_clear(f->context);
  save(f, stopped, "");
  fg_context_destroy(f->context);
  assert_int_equal(fg_context_create(&f->context), FG_STATUS_OK);
  fg_evolution *resumed = resume(f, field, &options, &step);
  step = advance(f, resumed, 20);
  same_state(&step, &expected);
  same_density(resumed, plain);
  fg_evolution_destroy(plain);
  fg_evolution_destroy(stopped);
  fg_evolution_destroy(resumed);
  fg_field_destroy(field);
}

/* Saved a few steps before the pattern counts as stationary. */
static void comes_to_rest_in_the_same_step(void **state)
{
  fixture *f = *state;
  fg_evolution_options options = {.nodes = 33};
  fg_field *field = make(f);
  fg_evolution *e = begin(f, field, &options);
  fg_step last = advance(f, e, 1), step;
  for (int n = 0; !last.stationary && n < 20000; ++n)
    last = advance(f, e, 1);
  assert_true(last.stationary);
  fg_evolution_destroy(e);
  e = begin(f, field, &options);
  advance(f, e, (int)last.step - 5);
  save(f, e, NULL);
  fg_evolution *resumed = resume(f, field, &options, &step);
  for (int n = 0; n < 5; ++n) {
    assert_false(step.stationary);
    step = advance(f, resumed, 1);
  }
  same_state(&step, &last);
  fg_evolution_destroy(e);
  fg_evolution_destroy(resumed);
  fg_field_destroy(field);
}

static void notes_come_back(void **state)
{
  fixture *f = *state;
  fg_field *field = make(f);
  fg_evolution_options options = {.nodes = 33};
  fg_evolution *e = begin(f, field, &options);
  static const char *const notes[] = {"", "\n\n", "tau 0\n\nclusters 9\n", "one line"};
  for (int n = 0; n < 4; ++n) {
    save(f, e, notes[n]);
    fg_checkpoint *checkpoint;
    assert_int_equal(fg_checkpoint_open(&checkpoint, f->context, path), FG_STATUS_OK);
    assert_string_equal(fg_checkpoint_note(checkpoint), notes[n]);
    assert_string_equal(fg_checkpoint_damage(checkpoint), "");
    fg_checkpoint_destroy(checkpoint);
  }
  fg_evolution_destroy(e);
  fg_field_destroy(field);
}

/* The checkpoint of `options` is refused by an evolution with `other`, in words. */
static void differs(fixture *f, const fg_field *field, const fg_evolution_options *other,
                    const char *words)
{
  fg_checkpoint *checkpoint;
  fg_step step;
  assert_int_equal(fg_checkpoint_open(&checkpoint, f->context, path), FG_STATUS_OK);
  fg_evolution *e = begin(f, field, other);
  assert_int_equal(fg_evolution_resume(e, &step, checkpoint), FG_STATUS_ARGUMENT);
  const char *message = fg_context_message(f->context);
  if (!strstr(message, words) || strstr(message, path) != message)
    fail_msg("\"%s\" does not say \"%s\"", message, words);
  fg_context_clear(f->context);
  fg_evolution_destroy(e);
  fg_checkpoint_destroy(checkpoint);
}

static void another_run_is_refused(void **state)
{
  fixture *f = *state;
  float u[33 * 33] = {0.0F};
  fg_evolution_options options = {.nodes = 33, .seed = 5, .initial = u};
  fg_field *field = make(f);
  fg_evolution *e = begin(f, field, &options);
  save(f, e, NULL);
  fg_evolution_destroy(e);
  fg_evolution_options other = options;
  other.nodes = 17;
  differs(f, field, &other, "nodes: 33, not 17");
  other = options;
  other.seed = 6;
  differs(f, field, &other, "seed: 5, not 6");
  other = options;
  other.coverage = 0.25;
  differs(f, field, &other, "coverage: 0.3, not 0.25");
  other = options;
  other.isotropic_below = 0.5;
  differs(f, field, &other, "isotropic-below: 0, not 0.5");
  other = options;
  other.noise = 0.25;
  differs(f, field, &other, "noise: 1.5, not 0.25");
  other = options;
  other.anisotropy = nextafter(0.15, 1.0);
  differs(f, field, &other, "anisotropy: 0.15, not 0.15000000000000002");
  other = options;
  other.energy = FG_ENERGY_ISOTROPIC;
  differs(f, field, &other, "energy: 0, not 1");
  other = options;
  other.accuracy = 0.03;
  differs(f, field, &other, "accuracy: 0.08, not 0.03");
  other = options;
  other.cycles = 4;
  differs(f, field, &other, "cycles: 2, not 4");
  other = options;
  other.residual = 1e-3;
  differs(f, field, &other, "residual: 0, not 0.001");
  other = options;
  other.scheme = FG_SCHEME_THETA;
  other.accuracy = 0.08; /* the defaults depend on the scheme */
  other.cycles = 2;
  differs(f, field, &other, "scheme: 0, not 2");
  other = options;
  other.gamma = 0.01;
  differs(f, field, &other, "gamma: ");
  other = options;
  u[500] = -0.0F; /* equal, but other bits */
  differs(f, field, &other, "another initial: ");
  u[500] = 0.0F;
  fg_field_destroy(field);
  f->v[77] = nextafterf(f->v[77], 2.0F);
  field = make(f);
  differs(f, field, &options, "another field: ");
  fg_field_destroy(field);
}

static void another_splitting_is_refused(void **state)
{
  fixture *f = *state;
  fg_evolution_options options = {
      .nodes = 33, .scheme = FG_SCHEME_THETA, .theta = 0.25, .alpha = 0.75};
  fg_field *field = make(f);
  fg_evolution *e = begin(f, field, &options);
  save(f, e, NULL);
  fg_evolution_destroy(e);
  fg_evolution_options other = options;
  other.theta = 0.125;
  differs(f, field, &other, "theta: 0.25, not 0.125");
  other = options;
  other.alpha = 1.0;
  differs(f, field, &other, "alpha: 0.75, not 1");
  fg_field_destroy(field);
}

static void threads_may_differ(void **state)
{
  fixture *f = *state;
  fg_evolution_options options = {.nodes = NODES, .threads = 1}, other = options;
  other.threads = 2;
  fg_field *field = make(f);
  fg_step step;
  fg_evolution *e = begin(f, field, &options);
  advance(f, e, 3);
  save(f, e, NULL);
  fg_evolution *resumed = resume(f, field, &other, &step);
  same_density(e, resumed);
  fg_evolution_destroy(e);
  fg_evolution_destroy(resumed);
  fg_field_destroy(field);
}

static void spoil(const char *name, long at)
{
  FILE *stream = fopen(name, "r+b");
  assert_non_null(stream);
  assert_int_equal(fseek(stream, at, SEEK_SET), 0);
  int byte = fgetc(stream);
  assert_int_not_equal(byte, EOF);
  assert_int_equal(fseek(stream, at, SEEK_SET), 0);
  assert_int_not_equal(fputc(byte ^ 0x10, stream), EOF);
  assert_int_equal(fclose(stream), 0);
}

/* Opens what is there and goes on from step `expected`, with these words of damage. */
static void opens(fixture *f, const fg_field *field, const fg_evolution_options *options,
                  long expected, const char *damage)
{
  fg_checkpoint *checkpoint;
  fg_step step;
  assert_int_equal(fg_checkpoint_open(&checkpoint, f->context, path), FG_STATUS_OK);
  assert_string_equal(fg_context_message(f->context), "");
  const char *said = fg_checkpoint_damage(checkpoint);
  if (*damage ? !strstr(said, damage) : *said)
    fail_msg("\"%s\" does not say \"%s\"", said, damage);
  fg_evolution *e = begin(f, field, options);
  assert_int_equal(fg_evolution_resume(e, &step, checkpoint), FG_STATUS_OK);
  assert_int_equal(step.step, expected);
  fg_evolution_destroy(e);
  fg_checkpoint_destroy(checkpoint);
}

static void the_previous_one_steps_in(void **state)
{
  fixture *f = *state;
  fg_evolution_options options = {.nodes = 33};
  fg_field *field = make(f);
  fg_evolution *e = begin(f, field, &options);
  advance(f, e, 4);
  save(f, e, NULL);
  advance(f, e, 4);
  save(f, e, NULL);
  opens(f, field, &options, 8, "");
  spoil(path, 2000); /* among the values */
  opens(f, field, &options, 4, "damaged: the checksum of its values of 'current'");
  unlink(path);
  opens(f, field, &options, 4, "cannot be read");
  advance(f, e, 4);
  save(f, e, NULL);
  opens(f, field, &options, 12, "");
  spoil(path, 20);
  spoil(previous, 2000);
  fg_checkpoint *checkpoint;
  assert_int_equal(fg_checkpoint_open(&checkpoint, f->context, path),
                   FG_STATUS_FILE_FORMAT);
  assert_null(checkpoint);
  assert_non_null(strstr(fg_context_message(f->context), "of its preamble"));
  fg_evolution_destroy(e);
  fg_field_destroy(field);
}

static void a_failed_save_leaves_the_evolution(void **state)
{
  fixture *f = *state;
  fg_evolution_options options = {.nodes = 33};
  fg_field *field = make(f);
  fg_evolution *e = begin(f, field, &options), *plain = begin(f, field, &options);
  advance(f, e, 3);
  assert_int_equal(fg_evolution_save(e, "/nowhere/checkpoint", NULL),
                   FG_STATUS_FILE_ACCESS);
  assert_non_null(strstr(fg_context_message(f->context), "/nowhere/checkpoint"));
  fg_context_clear(f->context);
  fg_step step = advance(f, e, 3), expected = advance(f, plain, 6);
  same_state(&step, &expected);
  fg_evolution_destroy(e);
  fg_evolution_destroy(plain);
  fg_field_destroy(field);
}

#define CASE(f) cmocka_unit_test_setup_teardown(f, set_up, forget)

int main(void)
{
  const struct CMUnitTest tests[] = {
      CASE(goes_on_bit_for_bit),
      CASE(goes_on_in_3d),
      CASE(goes_on_by_theta),
      CASE(goes_on_with_a_mask),
      CASE(goes_on_round_a_period),
      CASE(goes_on_after_rejected_steps),
      CASE(goes_on_after_a_stop),
      CASE(comes_to_rest_in_the_same_step),
      CASE(notes_come_back),
      CASE(another_run_is_refused),
      CASE(another_splitting_is_refused),
      CASE(threads_may_differ),
      CASE(the_previous_one_steps_in),
      CASE(a_failed_save_leaves_the_evolution),
  };
  return cmocka_run_group_tests_name("evolution/checkpoint/checkpoint", tests,
                                     make_folder, remove_folder);
}
