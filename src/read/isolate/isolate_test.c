#include "read/isolate/isolate.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/context_test.h"
#include "field/fingerprint.h"
#include "field/slab.h"

enum { NX = 5, NY = 4, NZ = 3, COUNT = NX * NY * NZ };

/* What a format's reader does at "times": a reader that makes fields, or one that comes
 * to another end. */
typedef enum reader {
  READ_PLANE,
  READ_BOX,
  READ_HALF_A_GIGABYTE,
  READ_TWO_GIGABYTES,
  READ_COMPLAIN,
  READ_CRASH,
  READ_GIVE_UP,
  READ_LEAVE,
  READ_FOR_EVER,
  READ_NEVER
} reader;

static int told[2]; /* a pipe: the children's process numbers */

/* Periodic, with missing and infinite samples and words of all kinds. */
static fg_status make_field(fg_field **out, fg_context *context, int dimension,
                            fg__slab_index slab)
{
  static const double axis[3][NX] = {{0, 1, 2.5, 3, 4}, {-3, -2, -1, 7}, {1, 2, 3}};
  static const int size[3] = {NX, NY, NZ};
  float samples[3][COUNT], *velocity[3] = {NULL, NULL, NULL};
  for (int i = 0; i < COUNT; ++i)
    for (int k = 0; k < 3; ++k)
      samples[k][i] = (float)sin(1.0 + i + 7.0 * k);
  samples[0][7] = NAN;
  samples[1][13] = INFINITY;
  fg_field_arrays arrays = {.dimension = dimension,
                            .period = {6.0},
                            .scale = FG_SCALE_MAP,
                            .velocity_name = {"easting", "northing", "up"},
                            .axis_units = {"km", NULL, ""},
                            .title = "a title",
                            .time = "noon"};
  size_t row = 1;
  for (int k = 0; k < dimension; ++k) {
    arrays.size[k] = size[k];
    arrays.axis[k] = axis[k];
    row *= k < dimension - 1 ? (size_t)size[k] : 1;
  }
  const fg__rows rows = fg__rows_of(&slab, size[dimension - 1], false);
  for (int k = 0; k < dimension; ++k) {
    arrays.velocity[k] = velocity[k] = malloc(row * (size_t)rows.held * sizeof(float));
    assert_non_null(velocity[k]);
    memcpy(velocity[k], samples[k] + row * (size_t)rows.first,
           row * (size_t)rows.held * sizeof(float));
  }
  fg_status status = fg__field_of_rows(out, context, &arrays, velocity, &slab);
  if (status == FG_STATUS_OK) {
    (*out)->normal_share = 0.25;
    if ((*out)->slab) {
      (*out)->slab->has_reasons = true;
      (*out)->slab->counts.by_reason[1][2] = 5;
    }
  }
  return status;
}

static fg_status take_memory(fg_context *context, size_t bytes)
{
  char *volatile taken = malloc(bytes);
  free(taken);
  return taken ? fg__fail(context, FG_STATUS_UNSUPPORTED, "had it")
               : fg__fail(context, FG_STATUS_MEMORY, "had it not");
}

static fg_status read_any(fg_field **out, fg_context *context,
                          const fg__question *question)
{
  const pid_t own = getpid();
  if (write(told[1], &own, sizeof own) != (ssize_t)sizeof own)
    _exit(1);
  switch ((reader)question->time) {
  case READ_PLANE:
  case READ_BOX:
    return make_field(out, context, question->time == READ_BOX ? 3 : 2, question->slab);
  case READ_HALF_A_GIGABYTE:
  case READ_TWO_GIGABYTES:
    return take_memory(context,
                       (size_t)1 << (question->time == READ_TWO_GIGABYTES ? 31 : 29));
  case READ_COMPLAIN:
    fg__fail(context, FG_STATUS_UNSUPPORTED, "made up: no");
    fg__hint(context, "otherwise");
    return FG_STATUS_UNSUPPORTED;
  case READ_CRASH:
    raise(SIGSEGV);
    break;
  case READ_GIVE_UP:
    abort();
  case READ_LEAVE:
    _exit(3);
  case READ_FOR_EVER:
    for (volatile unsigned long count = 0;; ++count)
      ;
  case READ_NEVER:
    for (;;)
      pause();
  }
  return FG_STATUS_ARGUMENT;
}

static fg_status list(fg_inventory *inventory, fg_context *context)
{
  static const fg_axis_value level[] = {{850.0, "hPa", "850 hPa"},
                                        {(double)NAN, "", "top"}};
  fg_inventory_vector vector = {.components = 2,
                                .name = {"u", "v"},
                                .units = "m/s",
                                .times = 4,
                                .levels = 2,
                                .usual_level = 3,
                                .absent = "lat, lon",
                                .level_value = level,
                                .plane = "+proj=laea",
                                .axis_name = {"along"}};
  fg_status status = fg__inventory_add(inventory, context, &vector);
  vector.unusable = "why not";
  return status ? status : fg__inventory_add(inventory, context, &vector);
}

static fg_status answer(fg__answer *out, fg_context *context, fg_input *input,
                        const fg__question *question)
{
  *out = (fg__answer){.field = NULL};
  if (question->kind == FG__ASK_FIELD)
    return read_any(&out->field, context, question);
  fg_status status = fg__inventory_create(&out->inventory, context, input->name);
  return status ? status : list(out->inventory, context);
}

/* Three inputs of one kind: the second is isolated. */
static fg_input input_of(const char *library)
{
  return (fg_input){.name = "made up",
                    .answer = answer,
                    .source = {.path = "made up"},
                    .isolation = {.library = library}};
}

static fg_status read_as(fg_field **out, fg_context *context, fg_input *input,
                         reader what, int slab, int slabs)
{
  fg_context_clear(context);
  return fg_input_field(out, context, input, (int)what, 0, slab, slabs);
}

/* The number of the process that has read. */
static pid_t process_told(void)
{
  pid_t child;
  assert_int_equal(read(told[0], &child, sizeof child), sizeof child);
  return child;
}

static int set_up(void **state)
{
  static fg_context *context;
  if (pipe(told) != 0 || fg_context_create(&context) != FG_STATUS_OK)
    return 1;
  *state = context;
  return 0;
}

static int tear_down(void **state)
{
  fg_context_destroy(*state);
  close(told[0]);
  close(told[1]);
  return 0;
}

static void assert_same_word(const char *a, const char *b)
{
  assert_true((a == NULL) == (b == NULL));
  if (a)
    assert_string_equal(a, b);
}

static void assert_same_field(fg_field *a, fg_field *b)
{
  assert_int_equal(fg__field_fingerprint_grid(a), fg__field_fingerprint_grid(b));
  assert_int_equal(fg__field_fingerprint_samples(a), fg__field_fingerprint_samples(b));
  assert_int_equal(fg_field_infinite(a), fg_field_infinite(b));
  assert_true(a->normal_share == b->normal_share);
  for (int n = 0; n < FG__FIELD_WORDS; ++n)
    assert_same_word(*fg__arrays_word(&a->contents, n),
                     *fg__arrays_word(&b->contents, n));
  assert_true((a->slab == NULL) == (b->slab == NULL));
  if (!a->slab)
    return;
  assert_memory_equal(&a->slab->counts, &b->slab->counts, sizeof a->slab->counts);
  assert_int_equal(a->slab->key, b->slab->key);
  assert_int_equal(a->slab->number, b->slab->number);
  assert_int_equal(a->slab->own, b->slab->own);
  assert_true(a->slab->has_reasons && b->slab->has_reasons);
  assert_same_word(a->slab->input, b->slab->input);
}

static void fields_come_as_they_are(void **state)
{
  for (int slabs = 1; slabs <= 9; slabs += slabs == 1 ? 1 : 7)
    for (int box = 0; box < 2; ++box) {
      fg_input here = input_of(NULL), there = input_of("HDF5");
      for (int slab = 0; slab < (slabs < 3 ? slabs : 1); ++slab) {
        fg_field *a, *b;
        const reader what = box ? READ_BOX : READ_PLANE;
        assert_int_equal(read_as(&a, *state, &here, what, slab, slabs), FG_STATUS_OK);
        assert_int_equal(process_told(), getpid());
        assert_int_equal(read_as(&b, *state, &there, what, slab, slabs), FG_STATUS_OK);
        assert_int_equal(process_told(), there.isolation.child.process);
        assert_same_field(a, b);
        fg_field_destroy(a);
        fg_field_destroy(b);
      }
      fg__isolation_end(&there.isolation);
    }
}

static void inventories_and_defaults_come_as_they_are(void **state)
{
  fg_input input = input_of("HDF5");
  fg__answer answer;
  fg_read_defaults defaults;
  assert_int_equal(fg_input_defaults(&defaults, *state, &input), FG_STATUS_OK);
  assert_int_equal(defaults.level, 3);
  assert_string_equal(defaults.absent, "lat, lon");
  assert_int_equal(fg__isolation_ask(&answer, *state, &input,
                                     &(fg__question){.kind = FG__ASK_ALL_VECTORS}),
                   FG_STATUS_OK);
  assert_string_equal(fg_inventory_format(answer.inventory), "made up");
  assert_int_equal(fg_inventory_vector_count(answer.inventory), 2);
  const fg_inventory_vector *one = fg_inventory_vector_at(answer.inventory, 0),
                            *two = fg_inventory_vector_at(answer.inventory, 1);
  assert_null(one->unusable);
  assert_string_equal(two->unusable, "why not");
  assert_string_equal(one->name[1], "v");
  assert_null(one->name[2]);
  assert_string_equal(one->found_by, "");
  assert_string_equal(one->plane, "+proj=laea");
  assert_string_equal(one->axis_name[0], "along");
  assert_null(one->time_value);
  assert_true(one->level_value[0].value == 850.0 && isnan(one->level_value[1].value));
  assert_string_equal(one->level_value[0].units, "hPa");
  assert_string_equal(two->level_value[1].words, "top");
  fg_inventory_destroy(answer.inventory);
  fg_inventory_destroy(input.inventory);
  fg__isolation_end(&input.isolation);
}

static void a_library_that_ends_is_told(void **state)
{
  static const struct {
    reader what;
    fg_status status;
    const char *message;
  } cases[] = {
      {READ_COMPLAIN, FG_STATUS_UNSUPPORTED, "made up: no"},
      {READ_CRASH, FG_STATUS_FILE_ACCESS,
       "made up: damaged: the ecCodes library does not survive reading it (signal 11)"},
      {READ_GIVE_UP, FG_STATUS_FILE_ACCESS,
       "made up: damaged: the ecCodes library does not survive reading it (signal 6)"},
      {READ_LEAVE, FG_STATUS_FILE_ACCESS,
       "made up: damaged: the ecCodes library does not survive reading it (signal 0)"},
      {READ_FOR_EVER, FG_STATUS_FILE_ACCESS,
       "made up: damaged: reading it takes more than 1 s"},
  };
  /* while a parent ignores SIGCHLD, waitpid fails */
  signal(SIGCHLD, SIG_IGN);
  for (size_t n = 0; n < sizeof cases / sizeof *cases; ++n) {
    fg_input input = input_of("ecCodes");
    fg_field *field = NULL;
    assert_int_equal(read_as(&field, *state, &input, READ_PLANE, 0, 1), FG_STATUS_OK);
    fg_field_destroy(field);
    const pid_t child = process_told();
    for (int turn = 0; turn < 2; ++turn) {
      assert_int_equal(read_as(&field, *state, &input, cases[n].what, 0, 1),
                       cases[n].status);
      assert_null(field);
      assert_string_equal(fg_context_message(*state), cases[n].message);
      assert_string_equal(fg_context_hint(*state), n == 0 ? "otherwise" : "");
      if (turn == 0 || n == 0) /* no other process goes the same way */
        assert_int_equal(process_told(), child);
    }
    fg__isolation_end(&input.isolation);
  }
  assert_true(signal(SIGCHLD, SIG_DFL) == SIG_IGN);
}

#ifndef __SANITIZE_ADDRESS__
static void its_memory_is_bounded(void **state)
{
  fg_input input = input_of("HDF5");
  fg_field *field = NULL;
  for (int turn = 0; turn < 2; ++turn) {
    assert_int_equal(read_as(&field, *state, &input, READ_HALF_A_GIGABYTE, 0, 1),
                     FG_STATUS_UNSUPPORTED);
    assert_int_equal(read_as(&field, *state, &input, READ_TWO_GIGABYTES, 0, 1),
                     FG_STATUS_MEMORY);
  }
  fg__isolation_end(&input.isolation);
}

#endif
static fg_context *stopped;

static void stop(int number)
{
  (void)number;
  /* it may be called from a handler (context.h): NOLINTNEXTLINE */
  fg_context_stop(stopped);
}

static void a_stop_ends_it(void **state)
{
  fg_input input = input_of("HDF5");
  fg_field *field = NULL;
  stopped = *state;
  signal(SIGALRM, stop);
  alarm(1);
  assert_int_equal(read_as(&field, *state, &input, READ_NEVER, 0, 1), FG_STATUS_STOPPED);
  assert_null(field);
  assert_int_equal(kill(process_told(), 0), -1);
  fg__isolation_end(&input.isolation);
}

static void it_ends_with_its_parent(void **state)
{
  fg_input input = input_of("HDF5");
  fg_field *field = NULL;
  const pid_t parent = fork();
  if (parent == 0) {
    close(told[0]);
    read_as(&field, *state, &input, READ_NEVER, 0, 1);
    _exit(0);
  }
  close(told[1]);
  process_told();
  kill(parent, SIGKILL);
  waitpid(parent, NULL, 0);
  /* the child has the other end open until it ends */
  char none;
  alarm(20);
  assert_int_equal(read(told[0], &none, 1), 0);
  alarm(0);
}

static void only_libraries_that_crash_are_isolated(void **state)
{
  static const struct {
    const char *start;
    size_t size;
    const char *library;
  } cases[] = {{"\211HDF\r\n\032\n....", 12, "HDF5"},
               {"a heading\nGRIB\0\0\0\2\0\0\0\0\0\0\1\0", 26, "ecCodes"},
               {"<Xdmf Version='3'/>", 19, "HDF5"},
               {"CDF\001........", 12, NULL},
               {"x,y,u,v\n0,0,1,1\n", 16, NULL}};
  (void)state;
  for (size_t n = 0; n < sizeof cases / sizeof *cases; ++n) {
    char path[] = "/tmp/flowgrain-isolate-XXXXXX";
    fg_input input = {.source = {.bytes = (const unsigned char *)cases[n].start,
                                 .size = cases[n].size}};
    const int file = mkstemp(path);
    assert_int_equal(write(file, cases[n].start, cases[n].size), cases[n].size);
    close(file);
    fg__isolation found;
    fg__isolation_find(&found, &input);
    assert_same_word(found.library, cases[n].library);
    assert_int_equal(found.bytes, cases[n].library ? cases[n].size : 0);
    input = (fg_input){.source = {.bytes = (const unsigned char *)"CDF\001", .size = 4},
                       .options = {.vars_from = "no such file", .mesh_from = path}};
    fg__isolation_find(&found, &input);
    assert_same_word(found.library, cases[n].library);
    assert_int_equal(found.bytes, cases[n].library ? cases[n].size : 0);
    unlink(path);
  }
}

/* Time and memory of a child process are by the bytes of all that it may read. */
static void what_markup_names_counts(void **state)
{
  static const char markup[] = "<Xdmf a:b='c'><D>b.h5:/U</D><D>\nb.h5:/V </D></Xdmf>";
  static const char stored[] = "\211HDF\r\n\032\n....";
  char folder[] = "/tmp/flowgrain-isolate-XXXXXX", path[64], other[64];
  (void)state;
  assert_non_null(mkdtemp(folder));
  snprintf(path, sizeof path, "%s/a.xdmf", folder);
  snprintf(other, sizeof other, "%s/b.h5", folder);
  FILE *file = fopen(other, "wb");
  assert_non_null(file);
  fwrite(stored, 1, 12, file);
  fclose(file);
  fg_input input = {.source = {.path = path,
                               .on_disk = true,
                               .bytes = (const unsigned char *)markup,
                               .size = sizeof markup - 1}};
  fg__isolation found;
  fg__isolation_find(&found, &input);
  assert_same_word(found.library, "HDF5");
  assert_int_equal(found.bytes, sizeof markup - 1 + 12);
  unlink(other);
  rmdir(folder);
}

int main(void)
{
#define CASE(name) cmocka_unit_test_setup_teardown(name, set_up, tear_down)
  const struct CMUnitTest tests[] = {
      CASE(fields_come_as_they_are),
      CASE(inventories_and_defaults_come_as_they_are),
      CASE(a_library_that_ends_is_told),
#ifndef __SANITIZE_ADDRESS__ /* the sanitizer ends a process whose allocation fails */
      CASE(its_memory_is_bounded),
#endif
      CASE(a_stop_ends_it),
      CASE(it_ends_with_its_parent),
      CASE(only_libraries_that_crash_are_isolated),
      CASE(what_markup_names_counts),
  };
  return cmocka_run_group_tests_name("read/isolate", tests, NULL, NULL);
}
