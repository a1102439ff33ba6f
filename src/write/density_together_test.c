/* A density written by its ranks is the file that one rank writes, byte for byte. */
#include "cluster/divided_density_test.h"

#include <string.h>
#include <unistd.h>

static char *contents_of(const char *path, size_t *count)
{
  FILE *file = fopen(path, "rb");
  expect(file);
  if (!file)
    return NULL;
  fseek(file, 0, SEEK_END);
  *count = (size_t)ftell(file);
  rewind(file);
  char *out = allocate_or_end(*count, 1);
  expect(fread(out, 1, *count, file) == *count);
  fclose(file);
  return out;
}

static void compare_files(const char *one, const char *other)
{
  size_t count[2] = {0};
  char *bytes[2] = {contents_of(one, &count[0]), contents_of(other, &count[1])};
  expect(count[0] == count[1] && count[0] > 1000);
  expect(bytes[0] && bytes[1] && count[0] == count[1] &&
         memcmp(bytes[0], bytes[1], count[0]) == 0);
  free(bytes[0]);
  free(bytes[1]);
}

static void ranks_write_what_one_writes(void **state)
{
  (void)state;
  char shared[64], whole[64];
  snprintf(shared, sizeof shared, "shared-%ld.vti", (long)getpid());
  snprintf(whole, sizeof whole, "whole-%ld.vti", (long)getpid());
  for (int way = 0; way < 4; ++way) {
    bool periodic[2];
    set_periods(periodic, way);
    subject s = subject_of(&SHAPES[way], periodic, way > 1);
    bool writes = us.ranks->rank == 0;
    expect(fg_density_write(us.context, writes ? shared : NULL, s.shared) ==
           FG_STATUS_OK);
    if (writes) {
      expect(fg_density_write(us.context, whole, s.whole) == FG_STATUS_OK);
      compare_files(shared, whole);
      remove(shared);
      remove(whole);
    }
    subject_clear(&s);
  }
  end_together();
}

static void a_file_that_can_not_be_made_fails_on_all(void **state)
{
  (void)state;
  const bool periodic[2] = {false, true};
  subject s = subject_of(&SHAPES[0], periodic, false);
  expect(fg_density_write(us.context, "no/such/folder/u.vti", s.shared) ==
         FG_STATUS_FILE_ACCESS);
  expect(strstr(fg_context_message(us.context), "no/such/folder/u.vti"));
  fg_context_clear(us.context);
  const char *path = us.ranks->rank == 0 ? "u.vtk" : NULL;
  if (us.ranks->count > 1 || path)
    expect(fg_density_write(us.context, path, s.shared) == FG_STATUS_UNSUPPORTED);
  subject_clear(&s);
  end_together();
}

int main(void)
{
  start_together();
  const struct CMUnitTest tests[] = {
      TOGETHER(ranks_write_what_one_writes),
      TOGETHER(a_file_that_can_not_be_made_fails_on_all),
  };
  return cmocka_run_group_tests_name("write/density_together", tests, NULL, NULL);
}
