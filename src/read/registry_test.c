#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/context_test.h"
#include "read/format.h"

typedef struct place {
  char folder[64];
  char path[96];
  fg_context *context;
} place;

static int set_up(void **state)
{
  static place p;
  strcpy(p.folder, "/tmp/flowgrain-registry-XXXXXX");
  if (!mkdtemp(p.folder) || fg_context_create(&p.context) != FG_STATUS_OK)
    return 1;
  snprintf(p.path, sizeof p.path, "%s/file", p.folder);
  *state = &p;
  return 0;
}

static int tear_down(void **state)
{
  place *p = *state;
  unlink(p->path);
  rmdir(p->folder);
  fg_context_destroy(p->context);
  return 0;
}

static void refuse(place *p, const char *input, fg_status status, const char *words)
{
  fg_field *field = NULL;
  fg_inventory *inventory = NULL;
  for (int inventoried = 0; inventoried < 2; ++inventoried) {
    fg_context_clear(p->context);
    const fg_status found = inventoried ? fg_inventory_read(&inventory, p->context, input)
                                        : fg_field_read(&field, p->context, input, NULL);
    assert_int_equal(found, status);
    assert_null(field);
    assert_null(inventory);
    const char *message = fg_context_message(p->context);
    if (!strstr(message, words) || strncmp(message, input, strlen(input)) != 0)
      fail_msg("\"%s\" lacks \"%s\" or the input's name", message, words);
  }
}

static void write_file(const place *p, const char *text)
{
  FILE *file = fopen(p->path, "wb");
  assert_non_null(file);
  fputs(text, file);
  assert_int_equal(fclose(file), 0);
}

static void what_is_no_file_is_refused(void **state)
{
  place *p = *state;
  refuse(p, p->path, FG_STATUS_FILE_ACCESS, "No such file");
  refuse(p, p->folder, FG_STATUS_FILE_ACCESS, "directory");
  refuse(p, "/dev/null", FG_STATUS_FILE_ACCESS, "no regular file");
  assert_int_equal(mkfifo(p->path, 0600), 0);
  refuse(p, p->path, FG_STATUS_FILE_ACCESS, "pipe");
}

static void files_that_may_not_be_read_are_refused(void **state)
{
  place *p = *state;
  if (geteuid() == 0)
    skip(); /* root may read everything */
  write_file(p, "CDF\001");
  assert_int_equal(chmod(p->path, 0), 0);
  refuse(p, p->path, FG_STATUS_FILE_ACCESS, "Permission denied");
}

static void unknown_formats_are_told_the_known_ones(void **state)
{
  place *p = *state;
  write_file(p, "");
  refuse(p, p->path, FG_STATUS_FILE_FORMAT, "empty");
  write_file(p, "PL\003\004 not an archive");
  refuse(p, p->path, FG_STATUS_FILE_FORMAT,
         "unknown format (19 bytes, starting with 50 4c");
  assert_non_null(strstr(fg_context_hint(p->context), "NetCDF"));
  assert_non_null(strstr(fg_context_hint(p->context), ".vti"));
  write_file(p, "\n");
  refuse(p, p->path, FG_STATUS_FILE_FORMAT, "starting with 0a)");
}

static void files_of_others_are_named(void **state)
{
  static const char *const files[][2] = {
      {"\x1f\x8b\x08 and so on", "is compressed by gzip, which"},
      {"PK\003\004 and so on", "is a ZIP archive"},
      {"MATLAB 5.0 MAT-file, Platform: GLNXA64", "is a .mat file of MATLAB"},
      {"\xff\xfex", "is text in UTF-16"},
      {"\n<!DOCTYPE html>\n<title>404</title>", "is a web page"},
      {"/*---*\\\n\\*---*/\nFoamFile\n{\n}\n(1 2 3 4)\n(1 2 3 4)\n", "of OpenFOAM"},
      {"FORMAT\ntype: ensight gold\n", "is a case of EnSight"}};
  place *p = *state;
  for (size_t i = 0; i < sizeof files / sizeof *files; ++i) {
    write_file(p, files[i][0]);
    refuse(p, p->path, FG_STATUS_FILE_FORMAT, files[i][1]);
    assert_true(fg_context_hint(p->context)[0]);
  }
}

static void impossible_calls_are_refused(void **state)
{
  place *p = *state;
  fg_field *field = NULL;
  assert_int_equal(fg_field_read(NULL, p->context, p->path, NULL), FG_STATUS_ARGUMENT);
  assert_int_equal(fg_field_read(&field, p->context, NULL, NULL), FG_STATUS_ARGUMENT);
  assert_int_equal(fg_inventory_read(NULL, p->context, p->path), FG_STATUS_ARGUMENT);
  fg_context_clear(p->context);
  assert_int_equal(fg_field_read(&field, p->context, "synth:nothing-like-it", NULL),
                   FG_STATUS_ARGUMENT);
  assert_null(field);
}

static void analytic_fields_are_inputs_too(void **state)
{
  place *p = *state;
  fg_field *field = NULL;
  fg_inventory *inventory = NULL;
  assert_int_equal(fg_field_read(&field, p->context, "synth:saddle", NULL), FG_STATUS_OK);
  const fg_field_arrays *a = fg_field_contents(field);
  assert_int_equal(fg_inventory_read(&inventory, p->context, "synth:saddle"),
                   FG_STATUS_OK);
  assert_int_equal(fg_inventory_vector_count(inventory), 1);
  const fg_inventory_vector *v = fg_inventory_vector_at(inventory, 0);
  for (int k = 0; k < 2; ++k) {
    assert_int_equal(v->size[k], 257);
    assert_int_equal(v->size[k], a->size[k]);
    assert_string_equal(v->name[k], a->velocity_name[k]);
    assert_true(v->bounds[2 * k] == 0.0 && v->bounds[2 * k + 1] == 1.0);
  }
  assert_null(v->unusable);
  fg_inventory_destroy(inventory);
  fg_field_destroy(field);
}

static void inventories_own_their_words(void **state)
{
  place *p = *state;
  fg_inventory *inventory = NULL;
  char name[] = "velocity";
  const fg_inventory_vector vector = {
      .components = 3, .name = {name, NULL, NULL}, .times = 7, .unusable = name + 3};
  assert_int_equal(fg__inventory_create(&inventory, p->context, "X"), FG_STATUS_OK);
  for (int i = 0; i < 100; ++i)
    assert_int_equal(fg__inventory_add(inventory, p->context, &vector), FG_STATUS_OK);
  memset(name, '?', sizeof name - 1);
  assert_string_equal(fg_inventory_format(inventory), "X");
  assert_int_equal(fg_inventory_vector_count(inventory), 100);
  const fg_inventory_vector *last = fg_inventory_vector_at(inventory, 99);
  assert_string_equal(last->name[0], "velocity");
  assert_null(last->name[1]);
  assert_string_equal(last->units, "");
  assert_string_equal(last->found_by, "");
  assert_string_equal(last->unusable, "ocity");
  assert_int_equal(last->times, 7);
  assert_null(fg_inventory_vector_at(inventory, 100));
  assert_null(fg_inventory_vector_at(inventory, -1));
  fg_inventory_destroy(inventory);
}

static void analytic_fields_offer_no_choice(void **state)
{
  place *p = *state;
  const fg_read_options choices[] = {
      {.vars = "a,b"}, {.vars_from = "x"},      {.mask = "m"},          {.time = 3},
      {.level = 1},    {.scale = FG_SCALE_GEO}, {.scale = FG_SCALE_MAP}};
  for (size_t k = 0; k < sizeof choices / sizeof *choices; ++k) {
    fg_field *field = NULL;
    fg_context_clear(p->context);
    assert_int_equal(fg_field_read(&field, p->context, "synth:vortex", &choices[k]),
                     FG_STATUS_ARGUMENT);
    assert_null(field);
    assert_non_null(strstr(fg_context_message(p->context), "synth:vortex: "));
  }
}

static void planes_are_read_from_words(void **state)
{
  place *p = *state;
  static const struct {
    const char *words;
    fg_plane plane;
  } good[] = {{"z=0.5", {{0, 0, 1}, {0, 0, 0.5}}},
              {"X=-2e-1", {{1, 0, 0}, {-0.2, 0, 0}}},
              {"1,0,-1@0.25,.5,3", {{1, 0, -1}, {0.25, 0.5, 3}}}};
  static const char *const bad[] = {
      "",    "z",         "=1",      "z=",          "z=1 2",         "z=nan",
      "q=1", "1,2@1,2,3", "1,2,3@1", "0,0,0@1,1,1", "1,2,3,4@1,1,1", "@"};
  fg_field *volume = NULL, *cut = NULL;
  fg_plane plane;
  assert_int_equal(fg_field_create_analytic(&volume, p->context, "abc", 5), FG_STATUS_OK);
  for (size_t k = 0; k < sizeof good / sizeof *good; ++k) {
    assert_int_equal(fg_plane_parse(&plane, p->context, good[k].words, volume),
                     FG_STATUS_OK);
    for (int n = 0; n < 3; ++n)
      assert_true(plane.normal[n] == good[k].plane.normal[n] &&
                  plane.point[n] == good[k].plane.point[n]);
  }
  for (size_t k = 0; k < sizeof bad / sizeof *bad; ++k)
    assert_int_equal(fg_plane_parse(&plane, p->context, bad[k], volume),
                     FG_STATUS_ARGUMENT);
  fg_field_destroy(volume);
  fg_context_clear(p->context);
  /* each of two slabs has its rows of the cut */
  const fg_read_options options = {.slice = "y=0.5"};
  assert_int_equal(fg_field_read(&volume, p->context, "synth:vortex3d", &options),
                   FG_STATUS_OK);
  assert_int_equal(fg_field_read_slab(&cut, p->context, "synth:vortex3d", &options, 1, 2),
                   FG_STATUS_OK);
  int first = 0, count = 0;
  assert_true(fg_field_is_slab(cut, &first, &count));
  const fg_field_arrays *all = fg_field_contents(volume), *own = fg_field_contents(cut);
  assert_int_equal(all->dimension, 2);
  assert_string_equal(own->axis_name[1], "z");
  assert_int_equal(first + count, all->size[1]);
  assert_memory_equal(own->velocity[1],
                      all->velocity[1] + (size_t)first * (size_t)all->size[0],
                      (size_t)count * (size_t)all->size[0] * sizeof(float));
  fg_field_destroy(cut);
  fg_field_destroy(volume);
  cut = NULL;
  assert_int_equal(fg_field_read(&cut, p->context, "synth:vortex", &options),
                   FG_STATUS_FILE_FORMAT);
  assert_string_equal(fg_context_message(p->context),
                      "synth:vortex: a cut through a field in 2 dimensions; it needs 3");
}

/* Bytes that a context was given are what "-" stands for, in the given format. */
static void bytes_are_an_input(void **state)
{
  place *p = *state;
  static const char words[] =
      "<VTKFile type='ImageData'><ImageData WholeExtent='0 2 0 1 0 0'><Piece "
      "Extent='0 2 0 1 0 0'><PointData><DataArray type='Float64' Name='U' "
      "NumberOfComponents='2' format='ascii'>1 2 3 4 5 6 7 8 9 10 11 12</DataArray>"
      "</PointData></Piece></ImageData></VTKFile>";
  static const char table[] = "x,y,u,v\n0,0,1,2\n1,0,2,3\n0,1,3,4\n1,1,4,5\n";
  static const struct {
    fg_input_options input;
    fg_status status;
    const char *message;
  } cases[] = {
      {{words, sizeof words - 1, NULL, 0.0, false}, FG_STATUS_OK, ""},
      {{words, sizeof words - 1, "vtk", 0.0, false}, FG_STATUS_OK, ""},
      {{words, sizeof words - 1, "vtk-xml", 48.0, false}, FG_STATUS_OK, ""},
      {{words, sizeof words - 1, "VTK XML", 0.0, false}, FG_STATUS_OK, ""},
      {{words, sizeof words - 1, "vti", 0.0, false}, FG_STATUS_OK, ""},
      {{table, sizeof table - 1, "csv", 0.0, false}, FG_STATUS_OK, ""},
      {{words, sizeof words - 1, "", 0.0, false},
       FG_STATUS_ARGUMENT,
       "standard input: no format is called \"\""},
      {{words, sizeof words - 1, NULL, 47.0, false},
       FG_STATUS_UNSUPPORTED,
       "standard input: a field of 6 samples takes"},
      {{words, sizeof words - 1, "netcdf", 0.0, false},
       FG_STATUS_FILE_FORMAT,
       "standard input: "},
      {{words, sizeof words - 1, "vt", 0.0, false},
       FG_STATUS_ARGUMENT,
       "standard input: no format is called \"vt\""},
      {{table, sizeof table - 1, NULL, 48.0, false}, FG_STATUS_OK, ""},
      {{table, sizeof table - 1, NULL, 47.0, false},
       FG_STATUS_UNSUPPORTED,
       "standard input: a field of 4 samples takes"},
      {{words, 0, NULL, 0.0, false}, FG_STATUS_FILE_FORMAT, "standard input: is empty"},
      {{NULL, 0, NULL, 0.0, false}, FG_STATUS_FILE_ACCESS, "-: No such file"},
  };
  for (size_t k = 0; k < sizeof cases / sizeof *cases; ++k) {
    fg_field *field = NULL;
    fg_context_clear(p->context);
    fg_context_set_input(p->context, &cases[k].input);
    const fg_status status = fg_field_read(&field, p->context, "-", NULL);
    if (status != cases[k].status ||
        strncmp(fg_context_message(p->context), cases[k].message,
                strlen(cases[k].message)) != 0)
      fail_msg("%zu: %d, %s", k, status, fg_context_message(p->context));
    if (field && cases[k].input.bytes == words)
      assert_true(fg_field_contents(field)->velocity[1][5] == 12.0f);
    fg_field_destroy(field);
  }
}

int main(void)
{
#define CASE(name) cmocka_unit_test_setup_teardown(name, set_up, tear_down)
  const struct CMUnitTest tests[] = {
      CASE(what_is_no_file_is_refused),
      CASE(files_that_may_not_be_read_are_refused),
      CASE(unknown_formats_are_told_the_known_ones),
      CASE(files_of_others_are_named),
      CASE(impossible_calls_are_refused),
      CASE(analytic_fields_are_inputs_too),
      CASE(inventories_own_their_words),
      CASE(analytic_fields_offer_no_choice),
      CASE(planes_are_read_from_words),
      CASE(bytes_are_an_input),
  };
  return cmocka_run_group_tests_name("read/registry", tests, NULL, NULL);
}
