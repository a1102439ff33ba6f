#include "read/vtk/vti_example.h"

/* 3 x 2 points */
#define SIX "1 10 0 2 20 0 3 30 0\n4 40 0 5 50 0 6 60 0"
#define SIX2 "7 1 7 1 7 1 7 1 7 1 7 1"

static const char GOOD[] =
    "<VTKFile type='ImageData' byte_order='LittleEndian' header_type='UInt32'>"
    "<ImageData WholeExtent='0 2 0 1 0 0' Origin='0 0 0' Spacing='1 1 1' "
    "Direction='1 0 0 0 1 0 0 0 1'><Piece Extent='0 2 0 1 0 0'><PointData>"
    "<DataArray type='Float64' Name='U' NumberOfComponents='2' format='ascii'>" SIX2
    "</DataArray></PointData></Piece></ImageData></VTKFile>";

static void wrong_markup_is_refused(void **state)
{
  static const example_change cases[] = {
      {"<VTKFile", "<VTKfile", FG_STATUS_FILE_FORMAT, "not XML"},
      {"type='ImageData'", "type='Table'", FG_STATUS_UNSUPPORTED, "Table"},
      {"type='ImageData'", "type='RectilinearGrid'", FG_STATUS_FILE_FORMAT,
       "no RectilinearGrid"},
      {"<ImageData", "<x></x><ImageDat", FG_STATUS_FILE_FORMAT, "not XML"},
      {"'LittleEndian'", "'Middle'", FG_STATUS_FILE_FORMAT, "byte_order"},
      {"'UInt32'", "'UInt16'", FG_STATUS_FILE_FORMAT, "header_type"},
      {"WholeExtent='0 2 0 1 0 0'", "", FG_STATUS_FILE_FORMAT, "WholeExtent"},
      {"WholeExtent='0 2 0 1 0 0'", "WholeExtent='0 2 0 1 0'", FG_STATUS_FILE_FORMAT,
       "WholeExtent"},
      {"WholeExtent='0 2 0 1 0 0'", "WholeExtent='0 2 0 1 0 0 0'", FG_STATUS_FILE_FORMAT,
       "WholeExtent"},
      {"WholeExtent='0 2 0 1 0 0'", "WholeExtent='2 0 0 1 0 0'", FG_STATUS_FILE_FORMAT,
       "WholeExtent"},
      {"WholeExtent='0 2 0 1 0 0'", "WholeExtent='0 2 0 1 0 99999999999'",
       FG_STATUS_FILE_FORMAT, "WholeExtent"},
      {"WholeExtent='0 2 0 1 0 0'",
       "WholeExtent='-2147483648 2147483647 -2147483648 2147483647 0 0'",
       FG_STATUS_FILE_FORMAT, "WholeExtent"},
      {"WholeExtent='0 2 0 1 0 0'", "WholeExtent='0 46339 0 46339 0 0'",
       FG_STATUS_FILE_FORMAT, "cells"},
      {"<Piece Extent='0 2 0 1 0 0'>", "<Piece>", FG_STATUS_FILE_FORMAT, "Extent"},
      {"<Piece Extent='0 2 0 1 0 0'>", "<Piece Extent='0 3 0 1 0 0'>",
       FG_STATUS_FILE_FORMAT, "Extent"},
      {"<Piece Extent='0 2 0 1 0 0'>", "<Piece Extent='0 1 0 1 0 0'>",
       FG_STATUS_FILE_FORMAT, "1 cells"},
      {"<Piece Extent='0 2 0 1 0 0'>", "<Piece Extent='0 2 0 0 0 0'>",
       FG_STATUS_FILE_FORMAT, "U"},
      {"Origin='0 0 0'", "Origin='0 0 nan'", FG_STATUS_FILE_FORMAT, "Origin"},
      {"Origin='0 0 0'", "Origin='1e300 0 0'", FG_STATUS_FILE_FORMAT, "no axis"},
      {"Spacing='1 1 1'", "Spacing='1 0 1'", FG_STATUS_FILE_FORMAT, "Spacing"},
      {"Spacing='1 1 1'", "Spacing='1 -1 1'", FG_STATUS_FILE_FORMAT, "Spacing"},
      {"Direction='1 0 0 0 1 0 0 0 1'", "Direction='0 1 0 1 0 0 0 0 1'", FG_STATUS_OK,
       ""},
      {"Direction='1 0 0 0 1 0 0 0 1'", "Direction='1'", FG_STATUS_FILE_FORMAT,
       "Direction"},
      {"NumberOfComponents='2'", "NumberOfComponents='0'", FG_STATUS_FILE_FORMAT,
       "NumberOfComponents"},
      {"NumberOfComponents='2'", "NumberOfComponents='3'", FG_STATUS_FILE_FORMAT, "U"},
      {"type='Float64'", "type='String'", FG_STATUS_UNSUPPORTED, "no vectors"},
      {"format='ascii'", "format='text'", FG_STATUS_FILE_FORMAT, "format"},
      {"format='ascii'", "format='appended' offset='0'", FG_STATUS_FILE_FORMAT,
       "no AppendedData"},
      {"format='ascii'", "format='appended'", FG_STATUS_FILE_FORMAT, "offset"},
      {"format='ascii'", "format='appended' offset='-1'", FG_STATUS_FILE_FORMAT,
       "offset"},
      {"format='ascii'", "format='binary'", FG_STATUS_FILE_FORMAT, "U"},
      {"7 1 7", "7 one 7", FG_STATUS_FILE_FORMAT, "12 numbers promised, 1 found"},
      {"7 1 7", "7 1 7 7", FG_STATUS_FILE_FORMAT, "after its 12 numbers"},
      {"7 1 7", "7 1e99 7", FG_STATUS_ARGUMENT, "speeds up to 1e+30"},
      {"7 1 7", "7 -1e16 7", FG_STATUS_ARGUMENT, "is -1e+16 at sample"},
      {"7 1 7", "7 &x; 7", FG_STATUS_FILE_FORMAT, "not XML"},
  };
  example_try_changes(*state, &fg__format_vti, GOOD, cases,
                      sizeof cases / sizeof cases[0]);
}

static void lines_are_refused(void **state)
{
  char file[EXAMPLE_FILE_BYTES];
  fg_field *field = NULL;
  example_image(file, "", "0 2 0 0 0 0", POINTS(VECTOR("U", "1 1 1 1 1 1 1 1 1")));
  assert_int_equal(example_read_words(&field, *state, file, NULL), FG_STATUS_UNSUPPORTED);
  assert_non_null(strstr(fg_context_message(*state), "3 x 1 x 1"));
}

static void compression_that_is_not_known_is_refused(void **state)
{
  char file[EXAMPLE_FILE_BYTES];
  const char *at = strstr(GOOD, "header_type");
  snprintf(file, sizeof file, "%.*scompressor='vtkLZMADataCompressor' %s",
           (int)(at - GOOD), GOOD, at);
  fg_field_destroy(
      example_field(*state, file, NULL)); /* what is not compressed can be read */
  char *format = strstr(file, "'ascii'");
  assert_non_null(format);
  memcpy(format, "'binary", 7);
  memmove(format + 8, format + 7, strlen(format + 7) + 1);
  format[7] = '\'';
  fg_field *field = NULL;
  assert_int_equal(example_read_words(&field, *state, file, NULL), FG_STATUS_UNSUPPORTED);
  assert_non_null(strstr(fg_context_message(*state), "vtkLZMADataCompressor"));
  assert_non_null(strstr(fg_context_hint(*state), "zlib"));
}

/* libxml2 takes time by the square of a tag's attributes. */
static void endless_tags_are_refused(void **state)
{
  static const char *const starts[] = {"<VTKFile", "<?x \" ?><VTKFile a='>'",
                                       "<!-- ' --><VTKFile a=\">\""};
  for (size_t s = 0; s < 3; ++s) {
    example_text file = {0};
    example_words(&file, starts[s]);
    for (int i = 0; i < 200000; ++i) {
      char attribute[32];
      snprintf(attribute, sizeof attribute, " a%d='>'", i);
      example_words(&file, attribute);
    }
    example_words(&file, "/>");
    fg_field *field = NULL;
    assert_int_equal(example_read(&field, *state, file.bytes, file.size, NULL),
                     FG_STATUS_FILE_FORMAT);
    assert_non_null(strstr(fg_context_message(*state), "a tag of"));
    example_free(&file);
  }
}

/* Entities that stand for ten others each would fill the memory. */
static void entities_are_not_expanded(void **state)
{
  static const char file[] =
      "<?xml version=\"1.0\"?>\n<!DOCTYPE VTKFile [<!ENTITY a \"aaaaaaaaaa\">"
      "<!ENTITY b \"&a;&a;&a;&a;&a;&a;&a;&a;&a;&a;\">"
      "<!ENTITY c \"&b;&b;&b;&b;&b;&b;&b;&b;&b;&b;\">]>"
      "<VTKFile type=\"&c;\"><ImageData/></VTKFile>";
  fg_field *field = NULL;
  assert_int_equal(example_read_words(&field, *state, file, NULL), FG_STATUS_FILE_FORMAT);
  assert_non_null(strstr(fg_context_message(*state), "document type"));
}

static void the_format_is_known_by_its_first_tag(void **state)
{
  (void)state;
  static const struct {
    const char *start;
    bool mine;
  } cases[] = {{"<VTKFile", true},
               {"\xEF\xBB\xBF<?xml version='1.0'?>\n<VTKFile type", true},
               {"<!-- a word -->\n<VTKFile", true},
               {"<VTKFil", false},
               {"# vtk DataFile Version 3.0", false},
               {"CDF\x01 <VTKFile", false},
               {"<svg>", false}};
  for (size_t i = 0; i < sizeof cases / sizeof cases[0]; ++i)
    assert_true(fg__format_vti.is_mine((const unsigned char *)cases[i].start,
                                       strlen(cases[i].start)) == cases[i].mine);
  assert_false(fg__format_vti.is_mine((const unsigned char *)"", 0));
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(wrong_markup_is_refused),
      cmocka_unit_test(lines_are_refused),
      cmocka_unit_test(compression_that_is_not_known_is_refused),
      cmocka_unit_test(endless_tags_are_refused),
      cmocka_unit_test(entities_are_not_expanded),
      cmocka_unit_test(the_format_is_known_by_its_first_tag),
  };
  return cmocka_run_group_tests_name("read/vtk/vti_refusal", tests, context_set_up,
                                     context_tear_down);
}
