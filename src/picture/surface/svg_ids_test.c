#include <stdlib.h>
#include <string.h>

#include "base/context_test.h"
#include "picture/surface/svg_ids.h"

static void expect(const char *given, const char *wanted)
{
  char written[512];
  FILE *stream = tmpfile();
  assert_non_null(stream);
  assert_true(fg__svg_ids_write(stream, given, strlen(given)));
  rewind(stream);
  size_t length = fread(written, 1, sizeof written - 1, stream);
  written[length] = '\0';
  assert_string_equal(written, wanted);
  fclose(stream);
}

static void names_are_numbered_by_their_first_mention(void **state)
{
  (void)state;
  expect("<g id=\"surface51\"/><image id=\"image9\" a=\"#surface7\"/>"
         "<use href=\"#surface51\" fill=\"url(#image9)\"/>",
         "<g id=\"surface1\"/><image id=\"image1\" a=\"#surface2\"/>"
         "<use href=\"#surface1\" fill=\"url(#image1)\"/>");
}

static void all_else_stays(void **state)
{
  (void)state;
  static const char *const same[] = {
      "",
      "surface7",
      "\"surface\"",
      "\"surface7 \"",
      "\"images3\"",
      "\"image3",
      "<text>surface 12 of image5</text> \"glyph0-1\" #clip3 ",
      "\"image3333333333333333333333\""};
  for (size_t n = 0; n < sizeof same / sizeof *same; ++n)
    expect(same[n], same[n]);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(names_are_numbered_by_their_first_mention),
      cmocka_unit_test(all_else_stays),
  };
  return cmocka_run_group_tests_name("picture/page/svg_ids", tests, NULL, NULL);
}
