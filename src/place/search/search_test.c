#include "place/search/search.h"

#include "place/fields_test.h"
#include "place/search/even.h"
#include "place/search/peaks.h"

typedef struct setting {
  fg_field *field;
  fg__place_domain domain;
  fg__place_search search;
} setting;

static void set(setting *s, fg_context *context, const sampling *box,
                velocity_of velocity, int count, bool free)
{
  *s = (setting){.field = field_of(context, box, velocity)};
  assert_int_equal(fg__place_domain_create(&s->domain, context, s->field), FG_STATUS_OK);
  assert_int_equal(fg__place_search_create(&s->search, context, &s->domain, count, free,
                                           FG__PLACE_FINE),
                   FG_STATUS_OK);
}

static void set_even(setting *s, fg_context *context, const sampling *box,
                     velocity_of velocity, int count, bool free)
{
  set(s, context, box, velocity, count, free);
  assert_int_equal(fg__place_fill_evenly(&s->search, count), FG_STATUS_OK);
  assert_int_equal(fg__place_complete(&s->search), FG_STATUS_OK);
  assert_int_equal(s->search.count, count);
}

static void clear(setting *s)
{
  fg__place_search_clear(&s->search);
  fg__place_domain_clear(&s->domain);
  fg_field_destroy(s->field);
}

static double energy_of(setting *s)
{
  double energy;
  assert_int_equal(fg__place_energy(&s->search, &energy), FG_STATUS_OK);
  return energy;
}

/* Sweep by sweep, but for what the trials' solutions of the diffusion reader near their
 * lines miss of the whole one, and to well below the start. */
static void descend(fg_context *context, const sampling *box, velocity_of velocity,
                    bool free)
{
  setting s;
  set_even(&s, context, box, velocity, 24, free);
  assert_int_equal(fg__place_set_reference_error(&s.search), FG_STATUS_OK);
  double first = energy_of(&s), before = first;
  for (int sweep = 0; sweep < 8; ++sweep) {
    assert_int_equal(fg__place_relax(&s.search, 1), FG_STATUS_OK);
    double now = energy_of(&s);
    if (now > before * (1 + 5e-3))
      fail_msg("from %.9g to %.9g in sweep %d", before, now, sweep);
    before = now;
  }
  assert_true(before < 0.9 * first);
  clear(&s);
}

static void the_energy_falls(void **state)
{
  descend(*state, &PLAIN, coast, true);
  descend(*state, &PLAIN, swirl, false);
  descend(*state, &SOLID, hall, true);
}

/* An exchange pays, or leaves every icon as it was. */
static void an_exchange_that_does_not_pay_is_undone(void **state)
{
  enum { COUNT = 20 };
  setting s;
  set_even(&s, *state, &PLAIN, coast, COUNT, true);
  assert_int_equal(fg__place_relax(&s.search, 2), FG_STATUS_OK);
  assert_int_equal(fg__place_set_reference_error(&s.search), FG_STATUS_OK);
  assert_int_equal(fg__place_relax(&s.search, 8), FG_STATUS_OK);
  int paid = 0, undone = 0;
  for (int n = 0; n < 14 && undone < 3; ++n) {
    fg__place_seed seed[COUNT];
    int identity[COUNT];
    for (int k = 0; k < COUNT; ++k) {
      seed[k] = s.search.icon[k]->seed;
      identity[k] = s.search.icon[k]->identity;
    }
    double before = energy_of(&s);
    assert_int_equal(fg__place_exchange(&s.search, 1, 1, 0.0), FG_STATUS_OK);
    assert_int_equal(s.search.count, COUNT);
    bool same = true;
    for (int k = 0; k < COUNT; ++k)
      same = same && identity[k] == s.search.icon[k]->identity &&
             memcmp(&seed[k], &s.search.icon[k]->seed, sizeof *seed) == 0;
    assert_true(same || energy_of(&s) < before * (1 + 1e-5));
    ++*(same ? &undone : &paid);
  }
  assert_true(paid > 0 && undone > 0);
  clear(&s);
}

static const sampling ROUGH = {
    .dimension = 2, .nodes = {129, 129}, .low = {0, 0}, .high = {128, 128}};

/* Waves of all directions down to five nodes: lines break and end in hooks. */
static void eddies(const double position[3], double v[3])
{
  unsigned state = 2;
  v[0] = v[1] = 0.0;
  for (int n = 0; n < 120; ++n) {
    const double k = 0.1 * pow(14.0, n / 120.0);
    const double angle = 360.0 * DEGREE * next_random(&state);
    const double phase = 360.0 * DEGREE * next_random(&state);
    const double wave =
        pow(k, 0.4) *
        sin(k * (cos(angle) * position[0] + sin(angle) * position[1]) + phase);
    v[0] -= sin(angle) * wave;
    v[1] += cos(angle) * wave;
  }
}

/* Also where lines were cut: a state that is left comes back whole. */
static void a_seed_gives_its_icons_line(void **state)
{
  enum { COUNT = 25 };
  setting s;
  fg__place_snapshot before = {0};
  set_even(&s, *state, &ROUGH, eddies, COUNT, true);
  assert_int_equal(fg__place_set_reference_error(&s.search), FG_STATUS_OK);
  assert_int_equal(fg__place_relax(&s.search, 8), FG_STATUS_OK);
  for (int n = 0; n < COUNT; ++n) {
    const fg__place_icon *icon = s.search.icon[n];
    fg__place_line line;
    fg__place_trace(&line, &s.domain, &s.search.scale, &icon->seed);
    for (int k = 0; k < 2; ++k)
      assert_true(fabs(line.way[k] - icon->line.way[k]) < 1e-5 * s.search.scale.lambda);
  }
  const double energy = energy_of(&s);
  assert_int_equal(fg__place_remember(&before, &s.search), FG_STATUS_OK);
  assert_int_equal(fg__place_thin(&s.search, COUNT / 2), FG_STATUS_OK);
  assert_int_equal(fg__place_restore(&s.search, &before), FG_STATUS_OK);
  assert_int_equal(s.search.count, COUNT);
  assert_true(fabs(energy_of(&s) - energy) < 1e-2 * energy);
  fg__place_snapshot_clear(&before);
  clear(&s);
}

/* The energy of a region, from the others' contributions and one line's. */
static double region_energy_of(setting *s, const fg__place_box *box, int index)
{
  fg__place_search *search = &s->search;
  fg__place_icon *icon = search->icon[index];
  assert_int_equal(fg__place_gather(&search->own, box, index), FG_STATUS_OK);
  return fg__place_cost(NULL, &search->raster, box, &search->own.others,
                        &icon->contribution, &search->weights) +
         fg__place_line_penalty(&search->scale, &search->own.beside, &icon->line);
}

/* Icons move one after the other, most of them by moves that the search would not take:
 * the region's energy changes by as much as that of all. */
static void a_move_changes_the_energy_of_its_region_alone(void **state)
{
  setting s;
  set_even(&s, *state, &PLAIN, swirl, 20, true);
  s.search.scale.crowding = s.search.scale.ends = s.search.scale.touch = 0.0;
  assert_int_equal(fg__place_set_reference_error(&s.search), FG_STATUS_OK);
  unsigned random = 17;
  int moved = 0;
  for (int n = 0; n < s.search.count; ++n) {
    fg__place_icon *icon = s.search.icon[n];
    fg__place_seed seed = icon->seed;
    for (int k = 0; k < 2; ++k)
      seed.position[k] += (next_random(&random) - 0.5) * s.search.scale.lambda;
    seed.way[0] *= 0.6 + next_random(&random);
    fg__place_line line;
    fg__place_trace(&line, &s.domain, &s.search.scale, &seed);
    if (line.count == 0)
      continue;
    fg__place_box region = icon->contribution.box,
                  to = fg__place_box_of(&s.search.raster, &s.search.scale, &line);
    fg__place_box_widen(&region, &to);
    double all = energy_of(&s), here = region_energy_of(&s, &region, n);
    icon->seed = seed;
    icon->line = line;
    assert_int_equal(fg__place_contribution_compute(&icon->contribution, *state,
                                                    &s.search.raster, &s.search.scale,
                                                    &line),
                     FG_STATUS_OK);
    assert_close(region_energy_of(&s, &region, n) - here, energy_of(&s) - all,
                 1e-5 * all);
    ++moved;
  }
  assert_true(moved > 10);
  clear(&s);
}

static void add(setting *s, double x, double y, bool expected)
{
  const double lambda = s->search.scale.lambda;
  const fg__place_seed seed = {{x, y}, {0.5 * lambda, 0.5 * lambda}};
  bool added;
  assert_int_equal(fg__place_add(&s->search, &added, &seed, s->search.next_identity++),
                   FG_STATUS_OK);
  assert_true(added == expected);
}

/* Two lines of a lambda each, the second so many lambda along the flow and across. */
static void set_two(setting *s, fg_context *context, double along, double across)
{
  set(s, context, &PLAIN, slant, 12, true);
  const double lambda = s->search.scale.lambda;
  add(s, -1, 7, true);
  add(s, -1 + lambda * (along * cos(SLANT) - across * sin(SLANT)),
      7 + lambda * (along * sin(SLANT) + across * cos(SLANT)), true);
}

/* What a line costs beside all icons but one. */
static double penalty_beside(setting *s, const fg__place_line *line, int except)
{
  fg__place_box all = {{0}, {0}};
  memcpy(all.size, s->search.raster.cells, sizeof all.size);
  assert_int_equal(fg__place_gather(&s->search.own, &all, except), FG_STATUS_OK);
  return fg__place_line_penalty(&s->search.scale, &s->search.own.beside, line);
}

static void crowding_is_dear_and_so_are_short_lines(void **state)
{
  setting s;
  set_two(&s, *state, 0.0, 0.1);
  s.search.scale.ends = s.search.scale.touch = 0.0;
  /* 2 mu for each lambda */
  assert_close(penalty_beside(&s, &s.search.icon[1]->line, 1),
               2 * s.search.scale.crowding * exp(-0.01 / 0.18), 0.01);
  assert_int_equal(fg__place_remove(&s.search, 0), FG_STATUS_OK);
  assert_true(penalty_beside(&s, &s.search.icon[0]->line, 0) < 1e-9);
  const double brief = 0.3 * s.search.scale.lambda;
  const fg__place_seed seed = {{2, 8}, {brief, brief}};
  fg__place_line shorter;
  fg__place_trace(&shorter, &s.domain, &s.search.scale, &seed);
  assert_close(penalty_beside(&s, &shorter, 0), 4 * 0.2 * 0.2, 1e-6);
  clear(&s);
}

static void lines_do_not_touch(void **state)
{
  setting s;
  set_two(&s, *state, 0.0, 0.06);
  s.search.scale.crowding = s.search.scale.ends = 0.0;
  const fg__place_line *line = &s.search.icon[1]->line;
  const double length = line->length / s.search.scale.lambda;
  const double penalty = 7 * length * pow(1 - 0.06 / 0.15, 2);
  double share;
  assert_close(penalty_beside(&s, line, 1), penalty, 0.1 * penalty);
  assert_int_equal(fg__place_touching(&s.search, &share), FG_STATUS_OK);
  assert_close(share, 1, 0.05);
  clear(&s);
  set_two(&s, *state, 0.0, 0.13);
  assert_int_equal(fg__place_touching(&s.search, &share), FG_STATUS_OK);
  assert_true(share == 0.0);
  clear(&s);
}

/* A line that begins a tenth of lambda behind another's head: two ends, each half of the
 * gap away. */
static void heads_keep_away_from_other_ends(void **state)
{
  setting s;
  set_two(&s, *state, 1.1, 0.0);
  s.search.scale.crowding = s.search.scale.touch = 0.0;
  assert_close(penalty_beside(&s, &s.search.icon[1]->line, 1), 0.7 * 0.25, 0.02);
  assert_int_equal(fg__place_remove(&s.search, 0), FG_STATUS_OK);
  assert_true(penalty_beside(&s, &s.search.icon[0]->line, 0) < 1e-9);
  clear(&s);
}

static void thinning_takes_the_ones_that_say_least(void **state)
{
  setting s;
  set_even(&s, *state, &PLAIN, slant, 12, true);
  assert_int_equal(fg__place_set_reference_error(&s.search), FG_STATUS_OK);
  int twin = s.search.next_identity;
  const double *at = s.search.icon[4]->seed.position;
  int other = s.search.icon[4]->identity;
  add(&s, at[0] + 0.02, at[1] + 0.02, true);
  assert_int_equal(fg__place_thin(&s.search, 12), FG_STATUS_OK);
  assert_int_equal(s.search.count, 12);
  bool first = false, second = false;
  for (int n = 0; n < 12; ++n) {
    first = first || s.search.icon[n]->identity == other;
    second = second || s.search.icon[n]->identity == twin;
  }
  assert_true(first != second);
  clear(&s);
}

/* Half of the domain is empty: a new icon comes there. */
/* A box of new values after the other: the rows know the largest cell of all. */
static void peaks_follow_changes(void **state)
{
  enum { WIDE = 7, TALL = 5, DEEP = 3, COUNT = WIDE * TALL * DEEP };
  float value[COUNT], weight[COUNT];
  const fg__place_raster raster = {.dimension = 3, .cells = {WIDE, TALL, DEEP}};
  unsigned seed = 1;
  for (int n = 0; n < COUNT; ++n) {
    value[n] = 5.0F;
    weight[n] = n % 4 ? (float)(n % 3) : 1.0F;
  }
  fg__place_peaks peaks;
  assert_int_equal(fg__place_peaks_create(&peaks, *state, &raster, value, weight),
                   FG_STATUS_OK);
  for (int round = 0; round < 100; ++round) {
    int low[3], high[3], best = 1; /* which counts */
    for (int k = 0; k < 3; ++k) {
      seed = seed * 1664525U + 1013904223U;
      low[k] = (int)(seed >> 20) % raster.cells[k];
      high[k] = low[k] + 1 + (int)(seed >> 26) % 3; /* may stick out */
    }
    for (int n = 0; n < COUNT; ++n) {
      const int at[3] = {n % WIDE, n / WIDE % TALL, n / (WIDE * TALL)};
      bool in = true;
      for (int k = 0; k < 3; ++k)
        in = in && at[k] >= low[k] && at[k] < high[k];
      seed = seed * 1664525U + 1013904223U;
      if (in) /* few different values, so that some are equal */
        value[n] = (float)((seed >> 24) % 9);
    }
    for (int n = 0; n < COUNT; ++n) {
      const float ahead = value[n] * weight[n] - value[best] * weight[best];
      if (weight[n] > 0.0F && (ahead > 0.0F || (ahead >= 0.0F && n < best)))
        best = n;
    }
    size_t top;
    fg__place_peaks_renew(&peaks, low, high);
    assert_true(fg__place_peaks_top(&top, &peaks) == value[best] * weight[best]);
    assert_int_equal(top, best);
  }
  fg__place_peaks_clear(&peaks);
}

static void an_icon_comes_where_readers_err(void **state)
{
  setting s;
  set(&s, *state, &PLAIN, swirl, 8, true);
  add(&s, -5, 5, true);
  add(&s, -5, 9, true);
  add(&s, -2.5, 7, true);
  double before = energy_of(&s);
  fg__place_candidate list[FG__PLACE_CANDIDATES] = {{{{0}, {0}}, 0.0}};
  fg__place_candidates best = {.list = list, .most = FG__PLACE_CANDIDATES};
  bool inserted;
  assert_int_equal(fg__place_list_candidates(&best, &s.search), FG_STATUS_OK);
  assert_true(best.count > 1 && list[0].fall > list[1].fall);
  assert_int_equal(fg__place_add(&s.search, &inserted, &list[0].seed, 3), FG_STATUS_OK);
  assert_true(inserted);
  assert_int_equal(s.search.count, 4);
  assert_true(s.search.icon[3]->seed.position[0] > 0);
  assert_true(energy_of(&s) < before);
  clear(&s);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      CASE(the_energy_falls),
      CASE(an_exchange_that_does_not_pay_is_undone),
      CASE(a_seed_gives_its_icons_line),
      CASE(a_move_changes_the_energy_of_its_region_alone),
      CASE(crowding_is_dear_and_so_are_short_lines),
      CASE(lines_do_not_touch),
      CASE(heads_keep_away_from_other_ends),
      CASE(thinning_takes_the_ones_that_say_least),
      CASE(an_icon_comes_where_readers_err),
      CASE(peaks_follow_changes),
  };
  return cmocka_run_group_tests_name("place/search/search/search", tests, NULL, NULL);
}
