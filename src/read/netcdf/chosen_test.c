/* Dimensions that are neither time nor level, of which one sample is chosen. */
#include "read/netcdf/plain_example.h"

enum { TIMES = 2, MEMBERS = 3, VERSIONS = 2, LEVELS = 2 };
enum { ALL = TIMES * MEMBERS * VERSIONS * LEVELS * COUNT };

/* What tells the samples apart is added to u and v. */
static double marked(int member, int version)
{
  return 1000.0 * member + 10000.0 * version;
}

/* A file with u, v along time, member, version, lev, y, x; in chunks of two members. */
static void make_ensemble(sample_file *f, int mode)
{
  static const double member[MEMBERS] = {0.0, 10.0, 20.0}, lev[LEVELS] = {850.0, 500.0};
  static double values[ALL];
  const size_t chunk[6] = {1, 2, VERSIONS, 1, NY, NX};
  sample_begin(f, mode);
  int all[6];
  all[0] = sample_dimension(f, "time", TIMES);
  all[1] = sample_axis(f, "member", MEMBERS, member, "1");
  all[2] = sample_dimension(f, "version", VERSIONS);
  all[3] = sample_axis(f, "lev", LEVELS, lev, "hPa");
  all[4] = sample_axis(f, "y", NY, Y, "km");
  all[5] = sample_axis(f, "x", NX, X, "km");
  sample_dimension(f, "letters", 3);
  for (int k = 0; k < 2; ++k) {
    const int id = sample_variable(f, k == 0 ? "u" : "v", NC_FLOAT, 6, all);
    if (mode & NC_NETCDF4)
      nc_must(nc_def_var_chunking(f->id, id, NC_CHUNKED, chunk));
    for (int n = 0; n < ALL; ++n) {
      const double x = X[n % NX], y = Y[n / NX % NY];
      const int z = n / COUNT % LEVELS, version = n / COUNT / LEVELS % VERSIONS;
      const int above = n / COUNT / LEVELS / VERSIONS;
      const int t = above / MEMBERS;
      values[n] = (k == 0 ? u_of : v_of)(x, y, t, z) + marked(above % MEMBERS, version);
    }
    sample_put(f, id, values);
  }
  sample_end(f);
}

static void one_of_several_dimensions_is_read(void **state)
{
  static const struct {
    const char *at, *level;
    int member, version;
  } cases[] = {{"member=0,version=0", "500 hPa, member 0, version 0", 0, 0},
               {"version=1,member=2", "500 hPa, member 20, version 1", 2, 1},
               {"member=10.,version=1", "500 hPa, member 10, version 1", 1, 1}};
  sample_file *f = *state;
  for (size_t n = 0; n < 2 * sizeof cases / sizeof *cases; ++n) {
    make_ensemble(f, n % 2 ? NC_NETCDF4 : 0);
    fg_field *field =
        read_with(f, &(fg_read_options){.at = cases[n / 2].at, .time = 1, .level = 1});
    const fg_field_arrays *a = fg_field_contents(field);
    assert_string_equal(a->level, cases[n / 2].level);
    const double mark = marked(cases[n / 2].member, cases[n / 2].version);
    for (int i = 0; i < COUNT; ++i) {
      const double x = X[i % NX], y = Y[i / NX];
      assert_true(a->velocity[0][i] == (float)(u_of(x, y, 1, 1) + mark));
      assert_true(a->velocity[1][i] == (float)(v_of(x, y, 1, 1) + mark));
    }
    fg_field_destroy(field);
  }
}

/* A number that is a value is that one: of 1 and 5 the 5 is number 1, and 1 number 0;
 * else it is an index. */
static void values_go_before_indices(void **state)
{
  static const struct {
    const char *at, *level;
    float first;
  } cases[] = {{"expver=1", "expver 1", 1.0f},
               {"expver=5", "expver 5", 101.0f},
               {"expver=0", "expver 1", 1.0f}};
  static const double expver[] = {1.0, 5.0};
  double values[2 * COUNT];
  sample_file *f = *state;
  for (size_t n = 0; n < sizeof cases / sizeof *cases; ++n) {
    sample_begin(f, 0);
    const int all[3] = {sample_axis(f, "expver", 2, expver, NULL),
                        sample_axis(f, "y", NY, Y, "km"),
                        sample_axis(f, "x", NX, X, "km")};
    for (int i = 0; i < 2 * COUNT; ++i)
      values[i] = 100.0 * (i / COUNT) + i % COUNT + 1.0;
    for (int k = 0; k < 2; ++k)
      sample_put(f, sample_variable(f, k ? "v" : "u", NC_FLOAT, 3, all), values);
    sample_end(f);
    fg_field *field = read_with(f, &(fg_read_options){.at = cases[n].at});
    assert_string_equal(fg_field_contents(field)->level, cases[n].level);
    assert_true(fg_field_contents(field)->velocity[0][0] == cases[n].first);
    fg_field_destroy(field);
  }
  refuse_with(f, &(fg_read_options){.at = "expver=1.2"}, FG_STATUS_ARGUMENT,
              "'expver=1.2' is not there; the nearest is expver 1");
  fg_field *field = NULL;
  const fg_read_options both = {.at = "expver=0:1"};
  fg_context_clear(f->context);
  assert_int_equal(fg_field_read(&field, f->context, f->path, &both), FG_STATUS_ARGUMENT);
  assert_non_null(strstr(fg_context_message(f->context), "are 2 samples"));
  assert_non_null(strstr(fg_context_hint(f->context), "flowgrain draw"));
}

/* What is chosen leaves its part, as that of time, to another dimension: a record
 * dimension, and one of time where there are two. */
static void others_take_the_parts_of_what_is_chosen(void **state)
{
  static const char *const first[] = {"number", "time"};
  double values[8 * COUNT];
  sample_file *f = *state;
  for (int n = 0; n < 2; ++n) {
    sample_begin(f, NC_NETCDF4);
    const int all[5] = {sample_dimension(f, first[n], NC_UNLIMITED),
                        sample_dimension(f, n ? "step" : "aa", 2),
                        sample_dimension(f, n ? "lev" : "bb", 2),
                        sample_axis(f, "y", NY, Y, "km"),
                        sample_axis(f, "x", NX, X, "km")};
    const size_t start[5] = {0}, count[5] = {2, 2, 2, NY, NX};
    for (int i = 0; i < 8 * COUNT; ++i)
      values[i] = 100.0 * (i / COUNT) + i % COUNT + 1.0;
    for (int k = 0; k < 2; ++k) {
      const int id = sample_variable(f, k ? "v" : "u", NC_FLOAT, 5, all);
      sample_write(f);
      nc_must(nc_put_vara_double(f->id, id, start, count, values));
    }
    sample_end(f);
    const char *at = n ? "time=1" : "number=1";
    fg_field *field = read_with(f, &(fg_read_options){.at = at, .time = 1, .level = 0});
    assert_true(fg_field_contents(field)->velocity[0][0] == (n ? 601.0f : 501.0f));
    fg_field_destroy(field);
  }
}

/* A further file's dimension of that name with a single sample has that for all. */
static void a_mask_without_members_serves_all(void **state)
{
  sample_file *f = *state;
  sample_file second = *f;
  double sea[COUNT];
  snprintf(second.path, sizeof second.path, "%s/second.nc", f->folder);
  sample_begin(&second, 0);
  const int all[3] = {sample_dimension(&second, "member", 1),
                      sample_axis(&second, "y", NY, Y, "km"),
                      sample_axis(&second, "x", NX, X, "km")};
  for (int i = 0; i < COUNT; ++i)
    sea[i] = i % 5 > 0;
  sample_put(&second, sample_variable(&second, "sea", NC_FLOAT, 3, all), sea);
  sample_end(&second);
  make_ensemble(f, 0);
  fg_field *field = read_with(f, &(fg_read_options){.at = "member=2,version=0",
                                                    .vars = "u,v",
                                                    .vars_from = second.path,
                                                    .mask = "sea"});
  assert_int_equal(fg_field_contents(field)->valid[5], 0);
  assert_true(fg_field_contents(field)->velocity[0][1] ==
              (float)(u_of(X[1], Y[0], 0, 0) + marked(2, 0)));
  fg_field_destroy(field);
  unlink(second.path);
}

static void inventories_tell_what_is_chosen(void **state)
{
  sample_file *f = *state;
  fg_inventory *inventory = NULL;
  make_ensemble(f, 0);
  const fg_read_options options = {.at = "version=1,member=20,time=0"};
  assert_int_equal(fg_inventory_read_chosen(&inventory, f->context, f->path, &options),
                   FG_STATUS_OK);
  assert_string_equal(fg_inventory_vector_at(inventory, 0)->chosen,
                      "member 20, version 1, time 0");
  assert_int_equal(fg_inventory_vector_at(inventory, 0)->levels, 2);
  fg_inventory_destroy(inventory);
}

/* A time can be chosen so, too, and is named. */
static void any_dimension_can_be_chosen(void **state)
{
  sample_file *f = *state;
  make_ensemble(f, 0);
  fg_field *field =
      read_with(f, &(fg_read_options){.at = "time=1,lev=500hPa,member=1,version=0"});
  const fg_field_arrays *a = fg_field_contents(field);
  assert_string_equal(a->time, "time 1");
  assert_string_equal(a->level, "member 10, version 0, 500 hPa");
  assert_true(a->velocity[0][0] == (float)(u_of(X[0], Y[0], 1, 1) + marked(1, 0)));
  fg_field_destroy(field);
}

/* A time is told once, though components name it among their coordinates (ERA5). */
static void a_time_that_is_chosen_is_told_once(void **state)
{
  static const double hours[TIMES] = {0.0, 6.0};
  sample_file *f = *state;
  const double values[TIMES * COUNT] = {[COUNT] = 1.0};
  sample_begin(f, 0);
  const int all[] = {sample_axis(f, "valid_time", TIMES, hours, "hours since 2020-01-01"),
                     sample_axis(f, "y", NY, Y, "km"), sample_axis(f, "x", NX, X, "km")};
  for (int k = 0; k < 2; ++k) {
    const int id = sample_variable(f, k == 0 ? "u" : "v", NC_FLOAT, 3, all);
    sample_text(f, id, "coordinates", "number valid_time");
    sample_put(f, id, values);
  }
  sample_end(f);
  fg_field *field = read_with(f, &(fg_read_options){.at = "valid_time=1"});
  assert_string_equal(fg_field_contents(field)->time, "2020-01-01 06:00");
  fg_field_destroy(field);
}

static void choices_are_checked(void **state)
{
  static const struct {
    const char *at, *words;
    fg_status status;
  } faults[] = {
      {NULL, "dimension 'member' of 3 samples is neither time nor level",
       FG_STATUS_UNSUPPORTED},
      {"member=0", "dimension 'version' of 2", FG_STATUS_UNSUPPORTED},
      {"member", "'member' is no choice of", FG_STATUS_ARGUMENT},
      {"member=", "'member=' is no choice of", FG_STATUS_ARGUMENT},
      {"=2", "'=2' is no choice of", FG_STATUS_ARGUMENT},
      {"member=0,", "'' is no choice of", FG_STATUS_ARGUMENT},
      {"number=0", "has no dimension 'number'", FG_STATUS_ARGUMENT},
      {"member=0, member=1", "of 'member' two samples are chosen", FG_STATUS_ARGUMENT},
      {"member=3", "member 3 asked for, and there are 3", FG_STATUS_UNSUPPORTED},
      {"member=0:1,version=0", "'member=0:1' are 2 samples", FG_STATUS_ARGUMENT},
      {"member=all,version=0", "'member=all' are 3 samples", FG_STATUS_ARGUMENT},
      {"member=0,version=0,letters=1", "'u' and 'v' have no dimension 'letters'",
       FG_STATUS_ARGUMENT},
      {"member=0,version=0,x=1", "its x axis 'x' has only 1", FG_STATUS_UNSUPPORTED}};
  static const char *const hints[] = {"--at member=WHICH reads one of them: 0, 10, 20",
                                      "--at version=0 reads the first of them"};
  sample_file *f = *state;
  make_ensemble(f, 0);
  for (size_t n = 0; n < sizeof faults / sizeof *faults; ++n) {
    fg_field *field = NULL;
    fg_context_clear(f->context);
    const fg_status status = fg_field_read(&field, f->context, f->path,
                                           &(fg_read_options){.at = faults[n].at});
    if (status != faults[n].status ||
        !strstr(fg_context_message(f->context), faults[n].words))
      fail_msg("%s: %d, \"%s\"", faults[n].at ? faults[n].at : "", (int)status,
               fg_context_message(f->context));
    assert_null(field);
    if (n < sizeof hints / sizeof *hints)
      assert_string_equal(fg_context_hint(f->context), hints[n]);
  }
  assert_int_equal(fg_field_read(&(fg_field *){NULL}, f->context, "synth:saddle",
                                 &(fg_read_options){.at = "member=1"}),
                   FG_STATUS_ARGUMENT);
}

/* Of many samples the first ones and the last are offered. */
static void many_samples_are_offered_in_short(void **state)
{
  static const double member[7] = {1, 2, 3, 4, 5, 6, 9}, lev[2] = {850, 500};
  static double values[2 * 7 * 2 * COUNT];
  sample_file *f = *state;
  for (int members = 5; members <= 7; members += 2) {
    sample_begin(f, 0);
    const int all[5] = {sample_dimension(f, "time", 2),
                        sample_axis(f, "member", (size_t)members, member, "1"),
                        sample_axis(f, "lev", 2, lev, "hPa"),
                        sample_axis(f, "y", NY, Y, "km"),
                        sample_axis(f, "x", NX, X, "km")};
    for (int k = 0; k < 2; ++k)
      sample_put(f, sample_variable(f, k ? "v" : "u", NC_FLOAT, 5, all), values);
    sample_end(f);
    refuse_with(f, &(fg_read_options){0}, FG_STATUS_UNSUPPORTED, "'member'");
    assert_string_equal(fg_context_hint(f->context),
                        members == 5
                            ? "--at member=WHICH reads one of them: 1, 2, 3, 4, 5"
                            : "--at member=WHICH reads one of them: 1, 2, 3, 4, ..., 9");
  }
}

/* Samples are chosen by the names that a file has for them, and told by these: strings,
 * or rows of characters, under the dimension's name or another. */
static void samples_have_labels(void **state)
{
  const char *names[] = {"historical", "ssp\xB9 26", "ssp585"};
  sample_file *f = *state;
  for (int kind = 0; kind < 3; ++kind) {
    static double values[MEMBERS * COUNT];
    char letters[MEMBERS][12] = {{0}};
    sample_begin(f, NC_NETCDF4);
    const int all[3] = {sample_dimension(f, "scenario", MEMBERS),
                        sample_axis(f, "y", NY, Y, "km"),
                        sample_axis(f, "x", NX, X, "km")};
    const int plane[2] = {all[0], sample_dimension(f, "letters", sizeof letters[0])};
    const int id = sample_variable(f, kind == 1 ? "label" : "scenario",
                                   kind ? NC_CHAR : NC_STRING, kind ? 2 : 1, plane);
    sample_write(f);
    for (int n = 0; n < MEMBERS; ++n)
      snprintf(letters[n], sizeof letters[n], "%-11s", names[n]);
    nc_must(kind ? nc_put_var_text(f->id, id, letters[0])
                 : nc_put_var_string(f->id, id, names));
    for (int k = 0; k < 2; ++k) {
      for (int n = 0; n < MEMBERS * COUNT; ++n)
        values[n] = 100.0 * (n / COUNT) + n % COUNT + k + 1.0;
      sample_put(f, sample_variable(f, k ? "v" : "u", NC_FLOAT, 3, all), values);
    }
    sample_end(f);
    fg_field *field = read_with(f, &(fg_read_options){.at = "scenario=ssp585"});
    const fg_field_arrays *a = fg_field_contents(field);
    assert_string_equal(a->level, "scenario ssp585");
    assert_true(a->velocity[0][0] == 201.0f);
    fg_field_destroy(field);
    field = read_with(f, &(fg_read_options){.at = "scenario=1"}); /* in Latin-1 */
    assert_string_equal(fg_field_contents(field)->level, "scenario ssp\xC2\xB9 26");
    fg_field_destroy(field);
    refuse_with(f, &(fg_read_options){.at = "scenario=ssp999"}, FG_STATUS_UNSUPPORTED,
                "0 is historical, 2 is ssp585");
  }
}

/* Readers without named dimensions say so, also of a file with the mesh. */
static void other_formats_refuse_choices(void **state)
{
  static const fg_read_options of[] = {{.at = "x=1"}, {.mesh_from = "mesh.nc"}};
  static const char *const words[] = {"a sample of a named dimension", "a file with the"};
  sample_file *f = *state;
  FILE *table = fopen(f->path, "w");
  assert_non_null(table);
  fputs("x,y,u,v\n0,0,1,1\n1,0,1,2\n0,1,1,3\n1,1,1,4\n", table);
  assert_int_equal(fclose(table), 0);
  for (int n = 0; n < 2; ++n) {
    fg_field *field = NULL;
    fg_inventory *inventory = NULL;
    assert_int_equal(fg_field_read(&field, f->context, f->path, &of[n]),
                     FG_STATUS_UNSUPPORTED);
    assert_non_null(strstr(fg_context_message(f->context), words[n]));
    fg_context_clear(f->context);
    assert_int_equal(fg_inventory_read_chosen(&inventory, f->context, f->path, &of[n]),
                     FG_STATUS_UNSUPPORTED);
    assert_non_null(strstr(fg_context_message(f->context), words[n]));
    fg_context_clear(f->context);
  }
}

int main(void)
{
#define CASE(name) cmocka_unit_test_setup_teardown(name, sample_set_up, sample_tear_down)
  const struct CMUnitTest tests[] = {
      CASE(one_of_several_dimensions_is_read),
      CASE(inventories_tell_what_is_chosen),
      CASE(any_dimension_can_be_chosen),
      CASE(a_time_that_is_chosen_is_told_once),
      CASE(choices_are_checked),
      CASE(many_samples_are_offered_in_short),
      CASE(samples_have_labels),
      CASE(values_go_before_indices),
      CASE(others_take_the_parts_of_what_is_chosen),
      CASE(a_mask_without_members_serves_all),
      CASE(other_formats_refuse_choices),
  };
  return cmocka_run_group_tests_name("read/netcdf/chosen", tests, NULL, NULL);
}
