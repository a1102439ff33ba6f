/* Checkpoints of several ranks: the bytes of one rank alone, read by any number; what one
 * rank can not do is a failure of all, and leaves the last checkpoint good. */
#include "evolution/steps_test.h"

#include <errno.h>
#include <signal.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include "evolution/checkpoint/layout.h"

typedef struct subject {
  const char *field;
  bool masked; /* two parts, one with a hole; 2D only */
  fg_evolution_options options;
} subject;

static const subject SUBJECTS[] = {
    {"vortex3", false, {.nodes = 65, .seed = 3}},
    {"vortex3", true, {.nodes = 65, .coverage = 0.4}},
    {"benard", false, {.nodes = 97}}, /* periodic */
    {"benard", false, {.nodes = 65, .scheme = FG_SCHEME_THETA}},
    {"abc", false, {.nodes = 33}}, /* 3D, periodic */
    {"vortex3d", false, {.nodes = 33}},
};
enum {
  SUBJECT_COUNT = sizeof SUBJECTS / sizeof *SUBJECTS,
  SIDE = 33,
  BEFORE = 5,
  AFTER = 4
};

/* Names in a folder that rank 0 makes, the same on all ranks. */
static char folder[64], path[96], previous[128], part[128], other[128];

static void forget(void)
{
  fg__ranks_agree(us.ranks, us.context, FG_STATUS_OK); /* wait for all */
  if (us.ranks->rank == 0) {
    unlink(path);
    unlink(previous);
    unlink(part);
    unlink(other);
  }
  fg__ranks_agree(us.ranks, us.context, FG_STATUS_OK);
}

static void end_case(fg_evolution *evolution, fg_field *field)
{
  fg_evolution_destroy(evolution);
  fg_field_destroy(field);
  forget();
  end_together();
}

static bool is_there(const char *name)
{
  struct stat about;
  return stat(name, &about) == 0;
}

static fg_field *field_of(const subject *s)
{
  fg_field *field;
  expect(fg_field_create_analytic(&field, us.context, s->field, SIDE) == FG_STATUS_OK);
  if (!s->masked)
    return field;
  unsigned char valid[SIDE * SIDE];
  for (int j = 0; j < SIDE; ++j)
    for (int i = 0; i < SIDE; ++i)
      valid[j * SIDE + i] = i != 14 && !(i > 20 && i < 26 && j > 5 && j < 12);
  fg_field_arrays arrays = *fg_field_contents(field);
  arrays.valid = valid;
  fg_field *masked;
  expect(fg_field_create(&masked, us.context, &arrays) == FG_STATUS_OK);
  fg_field_destroy(field);
  return masked;
}

static fg_evolution *begin(const subject *s, const fg_field *field,
                           const fg__ranks *ranks)
{
  fg_evolution *e;
  expect(fg__evolution_create(&e, us.context, ranks, field, &s->options) == FG_STATUS_OK);
  return e;
}

static fg_evolution *resume(const subject *s, const fg_field *field,
                            const fg__ranks *ranks, const char *name, fg_step *step)
{
  fg_checkpoint *checkpoint;
  expect(fg__checkpoint_open(&checkpoint, us.context, name, ranks) == FG_STATUS_OK);
  expect(strcmp(fg_checkpoint_damage(checkpoint), "") == 0);
  expect(strcmp(fg_checkpoint_note(checkpoint), "a note") == 0);
  fg_evolution *e = begin(s, field, ranks);
  expect(fg_evolution_resume(e, step, checkpoint) == FG_STATUS_OK);
  fg_checkpoint_destroy(checkpoint);
  return e;
}

/* A file's bytes, without the line that says how long the run took: *count of them. */
static unsigned char *bytes_of(const char *name, size_t *count)
{
  static const char line[] = "\nevolution.seconds ";
  FILE *stream = fopen(name, "rb");
  if (!stream)
    abort();
  fseek(stream, 0, SEEK_END);
  long size = ftell(stream);
  rewind(stream);
  unsigned char *bytes = allocate_or_end((size_t)size, 1);
  expect(fread(bytes, 1, (size_t)size, stream) == (size_t)size);
  fclose(stream);
  *count = (size_t)size;
  for (size_t n = 0; n + sizeof line + 16 < *count; ++n)
    if (memcmp(bytes + n, line, sizeof line - 1) == 0)
      memset(bytes + n + sizeof line - 1, '-', 16);
  memset(bytes + FG__AT_TEXT_CHECKSUM, 0, 4);
  memset(bytes + FG__AT_PREAMBLE_CHECKSUM, 0, 4);
  return bytes;
}

static void expect_same_files(const char *a, const char *b)
{
  size_t count[2];
  unsigned char *one_file = bytes_of(a, &count[0]), *other_file = bytes_of(b, &count[1]);
  expect(count[0] == count[1] && memcmp(one_file, other_file, count[0]) == 0);
  free(one_file);
  free(other_file);
}

/* Written by all and by one rank alone: the same file; and read by either, the same steps
 * after. So any number of ranks reads what any other wrote. */
static void written_by_any_read_by_any(void **state)
{
  (void)state;
  for (int n = 0; n < SUBJECT_COUNT; ++n) {
    const subject *s = &SUBJECTS[n];
    fg_field *field = field_of(s);
    bool first = us.ranks->rank == 0; /* the one that works alone, too */
    fg_evolution *all = begin(s, field, us.ranks), *alone = NULL, *by_one = NULL;
    fg_step left = advance(all, BEFORE), step, expected = {0};
    expect_alike(&left);
    expect(fg_evolution_save(all, path, "a note") == FG_STATUS_OK);
    if (first) {
      alone = begin(s, field, &fg__single_rank);
      step = advance(alone, BEFORE);
      expect_same(&step, &left);
      expect(fg_evolution_save(alone, other, "a note") == FG_STATUS_OK);
      expect(!is_there(part));
      expect_same_files(path, other);
      expected = advance(alone, AFTER);
    }
    fg__ranks_agree(us.ranks, us.context, FG_STATUS_OK);
    fg_evolution *by_all = resume(s, field, us.ranks, other, &step);
    expect_same(&step, &left);
    step = advance(by_all, AFTER);
    expect_alike(&step);
    if (first) {
      expect_same(&step, &expected);
      by_one = resume(s, field, &fg__single_rank, path, &step);
      expect_same(&step, &left);
      step = advance(by_one, AFTER);
      expect_same(&step, &expected);
    }
    /* and once more, from the resumed ones */
    forget();
    expect(fg_evolution_save(by_all, path, "a note") == FG_STATUS_OK);
    if (first) {
      expect(fg_evolution_save(by_one, other, "a note") == FG_STATUS_OK);
      expect_same_files(path, other);
    }
    fg__ranks_agree(us.ranks, us.context, FG_STATUS_OK);
    fg_evolution_destroy(all);
    fg_evolution_destroy(alone);
    fg_evolution_destroy(by_all);
    fg_evolution_destroy(by_one);
    fg_field_destroy(field);
    forget();
  }
  end_together();
}

/* Inverts a byte of a file; again: as it was. */
static void spoil(const char *name, long at)
{
  fg__ranks_agree(us.ranks, us.context, FG_STATUS_OK);
  if (us.ranks->rank == 0) {
    FILE *stream = fopen(name, "r+b");
    if (!stream)
      abort();
    fseek(stream, at, SEEK_SET);
    int byte = fgetc(stream);
    fseek(stream, at, SEEK_SET);
    expect(fputc(byte ^ 0xff, stream) != EOF);
    expect(fclose(stream) == 0);
  }
  fg__ranks_agree(us.ranks, us.context, FG_STATUS_OK);
}

/* Opening fails on all ranks alike, in these words. */
static void is_refused(const char *name, fg_status expected, const char *words)
{
  fg_checkpoint *checkpoint;
  fg_status status = fg_checkpoint_open(&checkpoint, us.context, name);
  const char *message = fg_context_message(us.context);
  expect(status == expected && checkpoint == NULL);
  expect(strstr(message, words) != NULL);
  /* the same on all */
  uint32_t letters = 0;
  for (const char *c = message; *c; ++c)
    letters = letters * 31 + (unsigned char)*c;
  expect(fg__ranks_alike(us.ranks, letters));
  fg_context_clear(us.context);
}

static void opens_previous(const subject *s, const fg_field *field, long expected,
                           const char *words)
{
  fg_checkpoint *checkpoint;
  fg_step step = {0};
  expect(fg_checkpoint_open(&checkpoint, us.context, path) == FG_STATUS_OK);
  expect(strstr(fg_checkpoint_damage(checkpoint), words) != NULL);
  expect(strcmp(fg_context_message(us.context), "") == 0);
  fg_evolution *e = begin(s, field, us.ranks);
  expect(fg_evolution_resume(e, &step, checkpoint) == FG_STATUS_OK);
  expect(step.step == expected);
  fg_evolution_destroy(e);
  fg_checkpoint_destroy(checkpoint);
}

static void damage_anywhere_is_refused_by_all(void **state)
{
  (void)state;
  const subject *s = &SUBJECTS[0];
  fg_field *field = field_of(s);
  fg_evolution *e = begin(s, field, us.ranks);
  advance(e, 2);
  expect(fg_evolution_save(e, path, "") == FG_STATUS_OK);
  size_t size;
  free(bytes_of(path, &size));
  int turns = 0;
  for (size_t at = 0; at < size; at += turns % 40 == 0 ? 7 : size / 60, ++turns) {
    spoil(path, (long)at);
    is_refused(path, FG_STATUS_FILE_FORMAT, at < 8 ? "no checkpoint" : "damaged");
    spoil(path, (long)at);
  }
  expect(turns > 50);
  spoil(path, 64 + 65 * 65 * 4 * 2 + 9);
  is_refused(path, FG_STATUS_FILE_FORMAT, "values of 'potential'");
  spoil(path, 64 + 65 * 65 * 4 * 2 + 9);
  advance(e, 2);
  expect(fg_evolution_save(e, path, "") == FG_STATUS_OK);
  spoil(path, (long)size / 2);
  opens_previous(s, field, 2, "damaged: the checksum of its values");
  spoil(previous, 20);
  is_refused(path, FG_STATUS_FILE_FORMAT, "damaged: the checksum of its values");
  end_case(e, field);
}

/* On one of the ranks, a limit on what it may use. Returns the limit there was. */
static struct rlimit limit(int rank, int what, rlim_t most)
{
  struct rlimit kept = {0}, now;
  if (us.ranks->rank == rank) {
    expect(getrlimit(what, &kept) == 0);
    now = kept;
    now.rlim_cur = most;
    expect(setrlimit(what, &now) == 0);
  }
  return kept;
}

static void lift(int rank, int what, struct rlimit kept)
{
  if (us.ranks->rank == rank)
    expect(setrlimit(what, &kept) == 0);
}

/* A limit on the size of files fails a write as a full disk does. */
static void a_rank_that_can_not_write(void **state)
{
  (void)state;
  signal(SIGXFSZ, SIG_IGN);
  const subject *s = &SUBJECTS[0];
  fg_field *field = field_of(s);
  fg_evolution *e = begin(s, field, us.ranks);
  fg_step step;
  advance(e, 2);
  expect(fg_evolution_save(e, path, "a note") == FG_STATUS_OK);
  advance(e, 1);
  for (int rank = 0; rank < us.ranks->count; ++rank) {
    struct rlimit kept = limit(rank, RLIMIT_FSIZE, 30000);
    fg_status status = fg_evolution_save(e, path, "a note");
    lift(rank, RLIMIT_FSIZE, kept);
    expect(status == FG_STATUS_FILE_ACCESS);
    expect(strstr(fg_context_message(us.context), strerror(EFBIG)) != NULL);
    expect(strstr(fg_context_message(us.context), path) != NULL);
    fg_context_clear(us.context);
    expect(!is_there(part) && !is_there(previous));
    fg_evolution *last = resume(s, field, us.ranks, path, &step);
    expect(step.step == 2);
    fg_evolution_destroy(last);
  }
  for (int rank = 0; rank < us.ranks->count; ++rank) {
    struct rlimit kept = limit(rank, RLIMIT_NOFILE, 0);
    fg_status status = fg_evolution_save(e, path, "a note");
    lift(rank, RLIMIT_NOFILE, kept);
    expect(status == FG_STATUS_FILE_ACCESS);
    expect(strstr(fg_context_message(us.context), strerror(EMFILE)) != NULL);
    fg_context_clear(us.context);
    expect(!is_there(part) && !is_there(previous));
  }
  expect(fg_evolution_save(e, path, "a note") == FG_STATUS_OK);
  fg_evolution_destroy(resume(s, field, us.ranks, path, &step));
  expect(step.step == 3 && is_there(previous));
  end_case(e, field);
}

static void a_rank_that_can_not_read(void **state)
{
  (void)state;
  const subject *s = &SUBJECTS[0];
  fg_field *field = field_of(s);
  fg_evolution *e = begin(s, field, us.ranks);
  fg_step step;
  advance(e, 2);
  expect(fg_evolution_save(e, path, "a note") == FG_STATUS_OK);
  for (int rank = 0; rank < us.ranks->count; ++rank) {
    struct rlimit kept = limit(rank, RLIMIT_NOFILE, 0);
    is_refused(path, FG_STATUS_FILE_ACCESS, strerror(EMFILE));
    lift(rank, RLIMIT_NOFILE, kept);
    /* one that looks elsewhere */
    is_refused(us.ranks->rank == rank ? other : path, FG_STATUS_FILE_ACCESS,
               strerror(ENOENT));
  }
  fg_evolution_destroy(resume(s, field, us.ranks, path, &step));
  expect(step.step == 2);
  end_case(e, field);
}

/* Folders of the same name on machines of their own. */
static void ranks_that_find_different_files(void **state)
{
  (void)state;
  const subject *s = &SUBJECTS[0];
  fg_field *field = field_of(s);
  fg_evolution *e = begin(s, field, us.ranks);
  advance(e, 1);
  expect(fg_evolution_save(e, path, "") == FG_STATUS_OK);
  advance(e, 1);
  expect(fg_evolution_save(e, other, "") == FG_STATUS_OK);
  bool last = us.ranks->rank == us.ranks->count - 1;
  if (us.ranks->count > 1)
    is_refused(last ? other : path, FG_STATUS_FILE_ACCESS, "different files");
  end_case(e, field);
}

/* All have the same folder; rank 0 removes it. */
static int make_folder(void **state)
{
  (void)state;
  name_folder(folder, sizeof folder);
  snprintf(path, sizeof path, "%s/checkpoint", folder);
  snprintf(previous, sizeof previous, "%s.previous", path);
  snprintf(part, sizeof part, "%s.part", path);
  snprintf(other, sizeof other, "%s.other", path);
  bool made = us.ranks->rank != 0 || mkdir(folder, 0777) == 0;
  return !made;
}

static int remove_folder(void **state)
{
  (void)state;
  return us.ranks->rank == 0 ? rmdir(folder) : 0;
}

int main(void)
{
  start_together();
  const struct CMUnitTest tests[] = {
      TOGETHER(written_by_any_read_by_any),
      TOGETHER(damage_anywhere_is_refused_by_all),
      TOGETHER(a_rank_that_can_not_write),
      TOGETHER(a_rank_that_can_not_read),
      TOGETHER(ranks_that_find_different_files),
  };
  return cmocka_run_group_tests_name("evolution/checkpoint/checkpoint_together", tests,
                                     make_folder, remove_folder);
}
