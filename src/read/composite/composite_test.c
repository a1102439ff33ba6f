/* Files that name others: in parallel, as blocks, over time. */
#include <math.h>
#include <sys/stat.h>
#include <unistd.h>

#include "read/vtk/cells_example.h"

typedef struct folder {
  fg_context *context;
  char path[64];
} folder;

static int set_up(void **state)
{
  static folder f;
  snprintf(f.path, sizeof f.path, "/tmp/flowgrain-composite-XXXXXX");
  *state = &f;
  return !mkdtemp(f.path) || fg_context_create(&f.context) != FG_STATUS_OK;
}

static int tear_down(void **state)
{
  folder *f = *state;
  char command[128];
  snprintf(command, sizeof command, "rm -r %s", f->path);
  fg_context_destroy(f->context);
  return system(command);
}

static char *path_in(const folder *f, const char *name)
{
  static char path[256];
  snprintf(path, sizeof path, "%s/%s", f->path, name);
  return path;
}

static void store(const folder *f, const char *name, const void *bytes, size_t size)
{
  FILE *file = fopen(path_in(f, name), "wb");
  assert_non_null(file);
  assert_int_equal(fwrite(bytes, 1, size, file), size);
  assert_int_equal(fclose(file), 0);
}

static void store_words(const folder *f, const char *name, const char *words)
{
  store(f, name, words, strlen(words));
}

/* An image of points [first, last] along x of 5 x 3 x 1, with U = (x, 10 y, 0) times
 * so much. */
static void store_image(const folder *f, const char *name, int first, int last,
                        double times)
{
  char text[4096];
  int used = snprintf(text, sizeof text,
                      "<VTKFile type='ImageData'><ImageData WholeExtent='%d %d 0 2 0 0' "
                      "Origin='0 0 0' Spacing='1 1 1'><Piece Extent='%d %d 0 2 0 0'>"
                      "<PointData Vectors='U'><DataArray type='Float64' Name='U' "
                      "NumberOfComponents='3' format='ascii'>",
                      first, last, first, last);
  for (int j = 0; j <= 2; ++j)
    for (int i = first; i <= last; ++i)
      used += snprintf(text + used, sizeof text - (size_t)used, "%g %g 0 ", times * i,
                       times * 10 * j);
  snprintf(text + used, sizeof text - (size_t)used,
           "</DataArray></PointData></Piece></ImageData></VTKFile>");
  store_words(f, name, text);
}

static fg_field *read_as(const folder *f, const char *name,
                         const fg_read_options *options)
{
  fg_field *field = NULL;
  if (fg_field_read(&field, f->context, path_in(f, name), options))
    fail_msg("%s", fg_context_message(f->context));
  return field;
}

static void refused(const folder *f, const char *name, const fg_read_options *options,
                    fg_status status, const char *words)
{
  fg_field *field = NULL;
  const fg_status got = fg_field_read(&field, f->context, path_in(f, name), options);
  assert_null(field);
  if (got != status || !strstr(fg_context_message(f->context), words))
    fail_msg("%s: %d \"%s\" lacks \"%s\"", name, got, fg_context_message(f->context),
             words);
  fg_context_clear(f->context);
}

static void assert_image(const fg_field *field, double times)
{
  const fg_field_arrays *a = fg_field_contents(field);
  assert_int_equal(a->size[0], 5);
  assert_int_equal(a->size[1], 3);
  for (int n = 0; n < 15; ++n) {
    assert_true(fabs((double)a->velocity[0][n] - times * (n % 5)) < 1e-6);
    assert_true(fabs((double)a->velocity[1][n] - times * 10 * (n / 5)) < 1e-6);
  }
}

#define PVTI(extent, pieces)                                                             \
  "<VTKFile type='PImageData'><PImageData WholeExtent='" extent                          \
  "' Origin='0 0 0' Spacing='1 1 1'>" pieces "</PImageData></VTKFile>"

static void pieces_of_an_image_are_one(void **state)
{
  folder *f = *state;
  store_image(f, "left.vti", 0, 2, 1.0);
  store_image(f, "right.vti", 2, 4, 1.0);
  store_words(f, "whole.pvti",
              PVTI("0 4 0 2 0 0", "<Piece Extent='0 2 0 2 0 0' Source='left.vti'/>"
                                  "<Piece Extent='2 4 0 2 0 0' Source='./right.vti'/>"));
  fg_field *field = read_as(f, "whole.pvti", NULL);
  assert_image(field, 1.0);
  fg_field_destroy(field);
  store_words(f, "part.pvti", PVTI("0 4 0 2 0 0", "<Piece Source='left.vti'/>"));
  refused(f, "part.pvti", NULL, FG_STATUS_FILE_FORMAT, "1 pieces have");
  store_words(f, "small.pvti", PVTI("0 1 0 2 0 0", "<Piece Source='left.vti'/>"));
  refused(f, "small.pvti", NULL, FG_STATUS_FILE_FORMAT, "is no piece of the grid");
  store_words(
      f, "twice.pvti",
      PVTI("0 4 0 2 0 0", "<Piece Source='left.vti'/><Piece Source='left.vti'/>"));
  refused(f, "twice.pvti", NULL, FG_STATUS_FILE_FORMAT, "named twice");
  store_words(f, "none.pvti", PVTI("0 4 0 2 0 0", ""));
  refused(f, "none.pvti", NULL, FG_STATUS_FILE_FORMAT, "names no file");
  store_words(f, "itself.pvti", PVTI("0 4 0 2 0 0", "<Piece Source='itself.pvti'/>"));
  refused(f, "itself.pvti", NULL, FG_STATUS_FILE_FORMAT, "named twice");
  store_words(f, "like.pvti", PVTI("0 4 0 2 0 0", "<Piece Source='whole.pvti'/>"));
  refused(f, "like.pvti", NULL, FG_STATUS_FILE_FORMAT, "PImageData");
  store_words(f, "lost.pvti", PVTI("0 4 0 2 0 0", "<Piece Source='lost.vti'/>"));
  refused(f, "lost.pvti", NULL, FG_STATUS_FILE_ACCESS, "lost.vti: No such file");
}

/* Only what lies in the folder or below is opened. */
static void files_elsewhere_are_not_opened(void **state)
{
  static const char *const names[] = {"/etc/passwd", "../left.vti", "a/../../left.vti",
                                      "..",          ".",           "a/.."};
  folder *f = *state;
  char text[512];
  for (size_t n = 0; n < sizeof names / sizeof names[0]; ++n) {
    snprintf(text, sizeof text, PVTI("0 4 0 2 0 0", "<Piece Source='%s'/>"), names[n]);
    store_words(f, "bad.pvti", text);
    refused(f, "bad.pvti", NULL, FG_STATUS_UNSUPPORTED, "not in its folder or below");
  }
  mkdir(path_in(f, "a"), 0700);
  store_image(f, "a/all.vti", 0, 4, 1.0);
  store_words(f, "good.pvti", PVTI("0 4 0 2 0 0", "<Piece Source='a/b/../all.vti'/>"));
  refused(f, "good.pvti", NULL, FG_STATUS_FILE_ACCESS, "No such file");
  store_words(f, "good.pvti", PVTI("0 4 0 2 0 0", "<Piece Source='a/all.vti'/>"));
  fg_field *field = read_as(f, "good.pvti", NULL);
  assert_image(field, 1.0);
  fg_field_destroy(field);
}

/* Links are followed before: of a file, of a folder on the way, and back in. */
static void links_do_not_lead_out_of_the_folder(void **state)
{
  static const struct {
    const char *name, *to, *source;
    bool good;
  } rows[] = {{"file.vti", "../elsewhere/left.vti", "file.vti", false},
              {"chain.vti", "file.vti", "chain.vti", false},
              {"way", "../elsewhere", "way/left.vti", false},
              {"back", "../here/below", "back/all.vti", true},
              {"own.vti", "below/all.vti", "own.vti", true}};
  folder *f = *state;
  char text[512], link[256];
  mkdir(path_in(f, "here"), 0700);
  mkdir(path_in(f, "here/below"), 0700);
  mkdir(path_in(f, "elsewhere"), 0700);
  store_image(f, "elsewhere/left.vti", 0, 4, 1.0);
  store_image(f, "here/below/all.vti", 0, 4, 1.0);
  for (size_t n = 0; n < sizeof rows / sizeof *rows; ++n) {
    snprintf(link, sizeof link, "%s/here/%s", f->path, rows[n].name);
    assert_int_equal(symlink(rows[n].to, link), 0);
    snprintf(text, sizeof text, PVTI("0 4 0 2 0 0", "<Piece Source='%s'/>"),
             rows[n].source);
    store_words(f, "here/it.pvti", text);
    if (rows[n].good)
      fg_field_destroy(read_as(f, "here/it.pvti", NULL));
    else
      refused(f, "here/it.pvti", NULL, FG_STATUS_UNSUPPORTED,
              "which links lead out of its folder");
  }
  /* a folder that is itself a link */
  snprintf(link, sizeof link, "%s/linked", f->path);
  assert_int_equal(symlink("here", link), 0);
  fg_field_destroy(read_as(f, "linked/it.pvti", NULL));
}

static void a_collection_has_times(void **state)
{
  folder *f = *state;
  store_image(f, "a.vti", 0, 4, 3.0);
  store_image(f, "b.vti", 0, 4, 1.0);
  store_image(f, "c.vti", 0, 4, 2.0);
  store_words(
      f, "all.pvd",
      "<VTKFile type='Collection'><Collection>"
      "<DataSet timestep='2.5' file='a.vti'/><DataSet timestep='-1' file='b.vti'/>"
      "<DataSet timestep='0.5' file='c.vti'/></Collection></VTKFile>");
  static const char *const words[] = {"t = -1", "t = 0.5", "t = 2.5"};
  for (int t = 0; t < 3; ++t) {
    fg_field *field = read_as(f, "all.pvd", &(fg_read_options){.time = t});
    assert_image(field, 1.0 + t);
    assert_string_equal(fg_field_contents(field)->time, words[t]);
    fg_field_destroy(field);
  }
  refused(f, "all.pvd", &(fg_read_options){.time = 3}, FG_STATUS_ARGUMENT, "there are 3");
  refused(f, "a.vti", &(fg_read_options){.block = "x"}, FG_STATUS_ARGUMENT, "no blocks");
  fg_inventory *inventory = NULL;
  assert_int_equal(fg_inventory_read(&inventory, f->context, path_in(f, "all.pvd")),
                   FG_STATUS_OK);
  const fg_inventory_vector *vector = fg_inventory_vector_at(inventory, 0);
  assert_int_equal(vector->times, 3);
  for (int t = 0; t < 3; ++t)
    assert_string_equal(vector->time_value[t].words, words[t]);
  fg_inventory_destroy(inventory);
}

/* ParaView's list, of files of any kind; without times these are the places in it. */
static void a_series_has_times(void **state)
{
  static const char legacy[] =
      "# vtk DataFile Version 3.0\nt\nASCII\nDATASET STRUCTURED_POINTS\nDIMENSIONS 3 2 "
      "1\n"
      "ORIGIN 0 0 0\nSPACING 1 1 1\nPOINT_DATA 6\nVECTORS v float\n"
      "7 1 0 7 1 0 7 1 0 7 1 0 7 1 0 7 1 0\n";
  static const char *const words[] = {"t = -1", "t = 0.5", "t = 2.5"};
  static const struct {
    const char *text, *part;
  } wrong[] = {
      {"{\"file-series-version\": 1", "is not JSON"},
      {"{\"file-series-version\": 1}", "no list \"files\""},
      {"{\"file-series-version\": 1, \"files\": [{\"time\": 1}]}", "has no name"},
      {"{\"file-series-version\": 1, \"files\": [{\"name\": \"a.vti\", \"time\": "
       "\"x\"}]}",
       "no number as its time"},
      {"{\"file-series-version\": 1, \"files\": []}", "names no file"},
      {"{\"file-series-version\": 1, \"files\": [{\"name\": \"../a.vti\"}]}",
       "not in its folder"},
      {"{\"file-series-version\": 1, \"files\": [{\"name\": \"it.series\"}]}",
       "named twice"}};
  folder *f = *state;
  store_image(f, "a.vti", 0, 4, 3.0);
  store_image(f, "b.vti", 0, 4, 1.0);
  store_words(f, "c.vtk", legacy);
  store_words(f, "it.series",
              " {\"file-series-version\": \"1.0\", \"files\": [\n"
              "{\"name\": \"a.vti\", \"time\": 2.5}, {\"name\": \"b.vti\", \"time\": -1},"
              "{\"name\": \"c.vtk\", \"time\": 0.5}]}\n");
  for (int t = 0; t < 3; ++t) {
    fg_field *field = read_as(f, "it.series", &(fg_read_options){.time = t});
    const fg_field_arrays *a = fg_field_contents(field);
    assert_string_equal(a->time, words[t]);
    if (t == 1)
      assert_true(a->velocity[0][0] == 7.0f);
    else
      assert_image(field, 1.0 + t);
    fg_field_destroy(field);
  }
  refused(f, "it.series", &(fg_read_options){.time = 3}, FG_STATUS_ARGUMENT,
          "there are 3");
  for (size_t n = 0; n < sizeof wrong / sizeof *wrong; ++n) {
    store_words(f, "it.series", wrong[n].text);
    const bool elsewhere = strstr(wrong[n].text, "../") != NULL;
    refused(f, "it.series", NULL,
            elsewhere ? FG_STATUS_UNSUPPORTED : FG_STATUS_FILE_FORMAT, wrong[n].part);
  }
  store_words(f, "it.series",
              "{\"file-series-version\": \"1.0\", \"files\": [{\"name\": \"b.vti\"}, "
              "{\"name\": \"a.vti\"}]}");
  fg_field *field = read_as(f, "it.series", &(fg_read_options){.time = 1});
  assert_image(field, 3.0);
  assert_string_equal(fg_field_contents(field)->time, "t = 1");
  fg_field_destroy(field);
}

/* An image beside cells: all together, each by its name, and one without the vectors. */
static void blocks_are_merged_or_chosen(void **state)
{
  folder *f = *state;
  const example_encoding encoding = {.type = EXAMPLE_FLOAT64};
  example_text cells = vtu(&encoding, "");
  store(f, "cells.vtu", cells.bytes, cells.size);
  example_free(&cells);
  store_image(f, "image.vti", 0, 4, 1.0);
  store_words(
      f, "other.vtp",
      "<VTKFile type='PolyData'><PolyData><Piece NumberOfPoints='3' "
      "NumberOfPolys='1'><Points><DataArray type='Float64' "
      "NumberOfComponents='3' format='ascii'>0 0 0 -1 0 0 -1 2 0</DataArray>"
      "</Points><Polys><DataArray type='Int32' Name='connectivity' format='ascii'>"
      "0 1 2</DataArray><DataArray type='Int32' Name='offsets' format='ascii'>3"
      "</DataArray></Polys></Piece></PolyData></VTKFile>");
  store_words(f, "all.vtm",
              "<VTKFile type='vtkMultiBlockDataSet'><vtkMultiBlockDataSet>"
              "<Block index='0' name='flat'><DataSet name='image' file='image.vti'/>"
              "<DataSet name='other' file='other.vtp'/></Block>"
              "<DataSet name='cells' file='cells.vtu'/>"
              "</vtkMultiBlockDataSet></VTKFile>");
  fg_field *field = read_as(f, "all.vtm", &(fg_read_options){.block = "image"});
  assert_image(field, 1.0);
  fg_field_destroy(field);
  field = read_as(f, "all.vtm", &(fg_read_options){.block = "cells"});
  assert_string_equal(fg_field_contents(field)->axis_name[1], "z");
  fg_field_destroy(field);
  field = read_as(f, "all.vtm", &(fg_read_options){.block = "flat"});
  const fg_field_arrays *a = fg_field_contents(field);
  assert_true(a->axis[0][0] == -1.0 && a->axis[0][a->size[0] - 1] == 4.0);
  int missing = 0;
  for (int n = 0; n < a->size[0] * a->size[1]; ++n) {
    const double x = a->axis[0][n % a->size[0]], y = a->axis[1][n / a->size[0]];
    missing += isnan(a->velocity[0][n]);
    if (x > 1e-9)
      assert_true(fabs((double)a->velocity[0][n] - x) < 1e-5 &&
                  fabs((double)a->velocity[1][n] - 10 * y) < 1e-4);
    else if (x < -1e-9)
      assert_true(isnan(a->velocity[0][n]));
  }
  assert_true(missing > 10);
  fg_field_destroy(field);
  refused(f, "all.vtm", NULL, FG_STATUS_UNSUPPORTED, "not plane");
  refused(f, "all.vtm", &(fg_read_options){.block = "imag"}, FG_STATUS_ARGUMENT,
          "no block \"imag\"");
}

#define CASE(f) cmocka_unit_test_setup_teardown(f, set_up, tear_down)

int main(void)
{
  const struct CMUnitTest tests[] = {
      CASE(pieces_of_an_image_are_one),
      CASE(files_elsewhere_are_not_opened),
      CASE(links_do_not_lead_out_of_the_folder),
      CASE(a_collection_has_times),
      CASE(a_series_has_times),
      CASE(blocks_are_merged_or_chosen),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
