#include <math.h>

#include "read/netcdf/sample_example.h"

enum { NX = 5, NY = 4, COUNT = NX * NY, MOST_BYTES = 1 << 15 };

/* Linear in the place, so that linear cells give it back exactly. */
static double velocity_at(double x, double y, int k, double factor)
{
  return factor * (k == 0 ? x + 2.0 * y : 3.0 - x);
}

static void check_field(const fg_field *field, double factor)
{
  const fg_field_arrays *a = fg_field_contents(field);
  size_t n = 0;
  assert_int_equal(a->dimension, 2);
  for (int y = 0; y < a->size[1]; ++y)
    for (int x = 0; x < a->size[0]; ++x, ++n)
      for (int k = 0; k < 2; ++k) {
        const double wanted = velocity_at(a->axis[0][x], a->axis[1][y], k, factor);
        assert_true(!a->valid || a->valid[n]);
        if (fabs((double)a->velocity[k][n] - wanted) > 1e-5)
          fail_msg("at %g %g component %d is %g, not %g", a->axis[0][x], a->axis[1][y], k,
                   (double)a->velocity[k][n], wanted);
      }
}

static void read_and_check(sample_file *f, const fg__format *format,
                           const fg_read_options *options, double factor)
{
  fg_field *field = NULL;
  fg__source source;
  if (fg_field_read(&field, f->context, f->path, options))
    fail_msg("%s", fg_context_message(f->context));
  check_field(field, factor);
  assert_int_equal(fg__source_open(&source, f->context, f->path), FG_STATUS_OK);
  assert_true(fg__format_find(source.bytes, source.size) == format);
  assert_slabs_alike(format, &source, options, field);
  fg__source_close(&source, NULL, FG_STATUS_OK);
  fg_field_destroy(field);
}

static void refuse(sample_file *f, const fg_read_options *options, const char *words)
{
  fg_field *field = NULL;
  fg_context_clear(f->context);
  assert_int_not_equal(fg_field_read(&field, f->context, f->path, options), FG_STATUS_OK);
  if (field || !strstr(fg_context_message(f->context), words))
    fail_msg("\"%s\" lacks \"%s\"", fg_context_message(f->context), words);
}

static int group(int parent, const char *name)
{
  int id;
  nc_must(nc_def_grp(parent, name, &id));
  return id;
}

/* A variable of numbers along up to four dimensions. */
static void put(int parent, const char *name, nc_type type, int rank,
                const size_t *length, const double *values)
{
  int id, dimension[4];
  char words[64];
  for (int k = 0; k < rank; ++k) {
    snprintf(words, sizeof words, "%s of %d", name, k);
    nc_must(nc_def_dim(parent, words, length[k], &dimension[k]));
  }
  nc_must(nc_def_var(parent, name, type, rank, dimension, &id));
  nc_must(nc_put_var_double(parent, id, values));
}

#define PUT(parent, name, ...)                                                           \
  put(parent, name, NC_INT64, 1,                                                         \
      (size_t[]){sizeof((double[]){__VA_ARGS__}) / sizeof(double)},                      \
      (double[]){__VA_ARGS__})

/* Begins a file with its group VTKHDF. */
static int begin(sample_file *f, const char *type)
{
  sample_begin(f, NC_NETCDF4);
  const int id = group(f->id, "VTKHDF");
  nc_must(nc_put_att_text(id, NC_GLOBAL, "Type", strlen(type), type));
  nc_must(nc_put_att_int(id, NC_GLOBAL, "Version", NC_INT, 2, (int[]){2, 0}));
  return id;
}

/* An image from (1, 2) on in steps of 0.5 and 0.25, at two times, of which the second
 * stands first where `offsets` say so. */
static void write_image(sample_file *f, bool offsets, size_t rows)
{
  double values[2 * COUNT * 3];
  const int id = begin(f, "ImageData");
  for (int n = 0; n < 2 * COUNT; ++n)
    for (int k = 0; k < 3; ++k)
      values[3 * n + k] =
          k == 2 ? 0.0
                 : velocity_at(1.0 + 0.5 * (n % NX), 2.0 + 0.25 * (n / NX % NY), k,
                               n < COUNT ? 1.0 : 4.0);
  nc_must(nc_put_att_int(id, NC_GLOBAL, "WholeExtent", NC_INT, 6,
                         (int[]){0, NX - 1, 0, NY - 1, 0, 0}));
  nc_must(
      nc_put_att_double(id, NC_GLOBAL, "Origin", NC_DOUBLE, 3, (double[]){1.0, 2.0, 0}));
  nc_must(nc_put_att_double(id, NC_GLOBAL, "Spacing", NC_DOUBLE, 3,
                            (double[]){0.5, 0.25, 1.0}));
  put(group(id, "PointData"), "U", NC_DOUBLE, 4, (size_t[]){2, rows, NX, 3}, values);
  const int steps = group(id, "Steps");
  put(steps, "Values", NC_DOUBLE, 1, (size_t[]){2}, (double[]){0.5, 1.5});
  if (offsets)
    PUT(group(steps, "PointDataOffsets"), "U", 1, 0);
  sample_end(f);
}

static void images_have_times(void **state)
{
  sample_file *f = *state;
  for (int offsets = 0; offsets < 2; ++offsets) {
    write_image(f, offsets, NY);
    for (int time = 0; time < 2; ++time)
      read_and_check(f, &fg__format_vtkhdf, &(fg_read_options){.time = time},
                     time != offsets ? 4.0 : 1.0);
  }
  refuse(f, &(fg_read_options){.time = 2}, "time 2 is asked for; there are 2");
  write_image(f, false, NY - 1);
  refuse(f, NULL, "has 90 numbers, for 20 of an image at 2 times");
}

/* What is wrong with a file of parts. */
typedef struct part_faults {
  double corner, points, type;
} part_faults;

/* Two squares side by side, a part each, at two times; the second time's are twice as
 * large. Velocities at points. */
static void write_parts(sample_file *f, bool polygons, part_faults faults)
{
  double point[4 * 4 * 3], value[4 * 4 * 2];
  const int id = begin(f, polygons ? "PolyData" : "UnstructuredGrid");
  for (int n = 0; n < 16; ++n) {
    const double large = n < 8 ? 1.0 : 2.0;
    const double x = large * ((n / 4 % 2) + (n % 4 == 1 || n % 4 == 2)),
                 y = large * (n % 4 > 1);
    point[3 * n] = x;
    point[3 * n + 1] = y;
    point[3 * n + 2] = 0.0;
    for (int k = 0; k < 2; ++k)
      value[2 * n + k] = velocity_at(x, y, k, n < 8 ? 1.0 : 3.0);
  }
  PUT(id, "NumberOfPoints", 4, 4 + faults.points, 4, 4);
  put(id, "Points", NC_FLOAT, 2, (size_t[]){16, 3}, point);
  put(group(id, "PointData"), "U", NC_DOUBLE, 2, (size_t[]){16, 2}, value);
  static const char *const lists[] = {"Vertices", "Lines", "Polygons", "Strips"};
  for (int k = 0; k < (polygons ? 4 : 1); ++k) {
    const int at = polygons ? group(id, lists[k]) : id;
    if (polygons && k != 2) {
      PUT(at, "NumberOfCells", 0, 0, 0, 0);
      PUT(at, "NumberOfConnectivityIds", 0, 0, 0, 0);
      PUT(at, "Offsets", 0, 0, 0, 0);
      PUT(at, "Connectivity", 0);
      continue;
    }
    PUT(at, "NumberOfCells", 1, 1, 1, 1);
    PUT(at, "NumberOfConnectivityIds", 4, 4, 4, 4);
    PUT(at, "Offsets", 0, 4, 0, 4, 0, 4, 0, 4);
    PUT(at, "Connectivity", 0, 1, 2, 3, 0, 1, 2, 3 + faults.corner, 0, 1, 2, 3, 0, 1, 2,
        3);
    if (!polygons)
      PUT(at, "Types", 9, 9 + faults.type, 9, 9);
  }
  const int steps = group(id, "Steps");
  put(steps, "Values", NC_DOUBLE, 1, (size_t[]){2}, (double[]){0.5, 1.5});
  PUT(steps, "PartOffsets", 0, 2);
  PUT(steps, "NumberOfParts", 2, 2);
  PUT(steps, "PointOffsets", 0, 8);
  const double each[8] = {[6] = 2.0}, corners[8] = {[6] = 8.0};
  const size_t lengths[2] = {2, polygons ? 4 : 1};
  const double alone[2] = {0.0, 2.0}, alone_corners[2] = {0.0, 8.0};
  put(steps, "CellOffsets", NC_INT, 2, lengths, polygons ? each : alone);
  put(steps, "ConnectivityIdOffsets", NC_INT, 2, lengths,
      polygons ? corners : alone_corners);
  PUT(group(steps, "PointDataOffsets"), "U", 0, 8);
  sample_end(f);
}

static void parts_have_times(void **state)
{
  sample_file *f = *state;
  for (int polygons = 0; polygons < 2; ++polygons) {
    write_parts(f, polygons, (part_faults){.corner = 0});
    read_and_check(f, &fg__format_vtkhdf, &(fg_read_options){.time = 0}, 1.0);
    read_and_check(f, &fg__format_vtkhdf, &(fg_read_options){.time = 1}, 3.0);
    write_parts(f, polygons, (part_faults){.corner = 1});
    refuse(f, NULL, "point 4 of 4");
    write_parts(f, polygons, (part_faults){.points = 1e9});
    refuse(f, NULL, "numbers where its grid needs");
    write_parts(f, polygons, (part_faults){.points = -5});
    refuse(f, NULL, "no count but -1");
  }
  write_parts(f, false, (part_faults){.type = 90});
  refuse(f, NULL, "99");
  begin(f, "HyperTreeGrid");
  sample_end(f);
  refuse(f, NULL, "type \"HyperTreeGrid\"");
}

/* Cut off anywhere, a file is refused; with a byte changed it may be another. The HDF5
 * library crashes on some: another process reads them. */
static void damaged_files_do_no_harm(void **state)
{
  sample_file *f = *state;
  static unsigned char bytes[MOST_BYTES];
  write_parts(f, false, (part_faults){.corner = 0});
  FILE *file = fopen(f->path, "rb");
  assert_non_null(file);
  const size_t size = fread(bytes, 1, sizeof bytes, file);
  fclose(file);
  assert_true(size > 5000 && size < sizeof bytes);
  fg_context_set_input(f->context, &(fg_input_options){.isolate = true});
  for (size_t n = 50; n < 2 * size; n += 397) {
    fg_field *field = NULL;
    const unsigned char kept = bytes[n % size];
    if (n >= size)
      bytes[n % size] = (unsigned char)(kept ^ 0x81);
    file = fopen(f->path, "wb");
    assert_non_null(file);
    fwrite(bytes, 1, n < size ? n : size, file);
    assert_int_equal(fclose(file), 0);
    bytes[n % size] = kept;
    const fg_status status = fg_field_read(&field, f->context, f->path, NULL);
    assert_true((field != NULL) == (status == FG_STATUS_OK));
    assert_true(n >= size || status != FG_STATUS_OK);
    fg_field_destroy(field);
    fg_context_clear(f->context);
  }
}

#define ITEM(dimensions, rest) "<DataItem Dimensions='" dimensions "'" rest "</DataItem>"
#define HDF5(dimensions, name) ITEM(dimensions, " Format='HDF'>b.h5:/" name)
#define VECTOR(item)                                                                     \
  "<Attribute Name='U' AttributeType='Vector' Center='Node'>" item "</Attribute>"
#define EVEN                                                                             \
  "<Topology TopologyType='2DCoRectMesh' Dimensions='4 5'/>"                             \
  "<Geometry GeometryType='ORIGIN_DXDY'>" ITEM("2", ">2 1")                              \
      ITEM("2", ">0.25 0.5") "</Geometry>"
#define MESH(type, more, item)                                                           \
  "<Topology TopologyType='" type "' " more ">" item "</Topology><Geometry "             \
  "GeometryType='XY'>" HDF5("20 2", "g/xy") "</Geometry>"
#define CURVED                                                                           \
  "<Topology Type='2DSMesh' NumberOfElements='4 5'/><Geometry Type='XY'>" HDF5(          \
      "4 5 2", "g/xy") "</Geometry>"
#define INCLUDED                                                                         \
  "<include xpointer='xpointer(//Grid[@Name=\"m\"]/*[self::Topology or "                 \
  "self::Geometry])'/>"
#define JOINED                                                                           \
  "<DataItem ItemType='Function' Function='JOIN($0 , $1)' Dimensions='4 5 2'>" HDF5(     \
      "4 5", "u") HDF5("4 5", "v") "</DataItem>"
#define SLAB(of)                                                                         \
  "<DataItem ItemType='HyperSlab' Dimensions='4 5 2'>" ITEM(                             \
      "3 4", ">1 0 0 0 1 1 1 2 1 4 5 2") of "</DataItem>"

/* A body of a Domain, and what is wrong with it: NULL, nothing. */
static const struct {
  const char *domain, *fault;
  double factor;
  int time;
  const char *block;
} XDMF[] = {
    {"<Grid>" EVEN VECTOR(HDF5("4 5 2", "U")) "</Grid>", NULL, 1.0, 0, NULL},
    {"<Grid>" EVEN VECTOR(JOINED) "</Grid>", NULL, 1.0, 0, NULL},
    {"<Grid>" EVEN VECTOR(SLAB(HDF5("2 4 5 4", "wide"))) "</Grid>", NULL, 1.0, 0, NULL},
    {"<Grid>" EVEN VECTOR(ITEM("40", " Format='Binary' Precision='8' Seek='3' "
                                     "Endian='Big'>c.bin")) "</Grid>",
     NULL, 1.0, 0, NULL},
    {"<Grid>" CURVED VECTOR(HDF5("20 2", "U")) "</Grid>", NULL, 1.0, 0, NULL},
    {"<Grid>" MESH("Quadrilateral", "NumberOfElements='12'", HDF5("12 4", "g/quads"))
         VECTOR(HDF5("20 2", "U")) "</Grid>",
     NULL, 1.0, 0, NULL},
    {"<Grid>" MESH("Mixed", "NumberOfElements='12'", HDF5("60", "g/mixed"))
         VECTOR(HDF5("20 2", "U")) "</Grid>",
     NULL, 1.0, 0, NULL},
    {"<Grid Name='m'>" MESH(
         "Quadrilateral", "",
         HDF5("12 4", "g/quads")) "</Grid><Grid GridType='Collection' "
                                  "CollectionType='Temporal'><Grid>" INCLUDED
                                  "<Time Value='2'/>" VECTOR(
                                      JOINED) "</Grid><Grid>" INCLUDED
                                              "<Time Value='3.5'/>" VECTOR(
                                                  HDF5("20 2", "twice")) "</Grid></Grid>",
     NULL, 2.0, 1, NULL},
    {"<DataItem Dimensions='4 5 2' Format='HDF'>b.h5:/U</DataItem><Grid "
     "Name='one'>" EVEN VECTOR(HDF5("4 5 2", "twice")) "</Grid><Grid Name='other'>" EVEN
         VECTOR("<DataItem Reference='/Xdmf/Domain/DataItem[1]'/>") "</Grid>",
     NULL, 1.0, 0, "other"},
    {"<Grid Name='one'>" EVEN VECTOR(JOINED) "</Grid><Grid Name='other'>" EVEN VECTOR(
         JOINED) "</Grid>",
     "2 grids, of which several may be meant", 0, 0, NULL},
    {"<Grid>" EVEN VECTOR(HDF5("4 5 2", "U")) "</Grid>", "no block \"up\"", 0, 0, "up"},
    {"<Grid>" EVEN VECTOR(HDF5("4 5 3", "U")) "</Grid>",
     "Dimensions of 60 numbers, but 'U' of", 0, 0, NULL},
    {"<Grid>" EVEN VECTOR(HDF5("5 4 2", "U")) "</Grid>",
     "Dimensions other than those of 'U' of", 0, 0, NULL},
    {"<Grid>" EVEN VECTOR(HDF5("2 4 5 4", "wide")) "</Grid>", "no vectors found", 0, 0,
     NULL},
    {"<Grid>" EVEN VECTOR(ITEM("7", ">1 2 3 4 5 6 7")) "</Grid>",
     "has 7 numbers for 20 points", 0, 0, NULL},
    {"<Grid>" EVEN VECTOR(ITEM("4 5 2", ">1 2 3")) "</Grid>", "40 numbers", 0, 0, NULL},
    {"<Grid>" EVEN VECTOR(HDF5("4 5 2", "none")) "</Grid>", "has no array \"/none\"", 0,
     0, NULL},
    {"<Grid>" EVEN VECTOR(ITEM("4 5 2", " Format='HDF'>/etc/b.h5:/U")) "</Grid>",
     "is not in its folder", 0, 0, NULL},
    {"<Grid>" EVEN VECTOR(ITEM("4 5 2", " Format='HDF'>../b.h5:/U")) "</Grid>",
     "is not in its folder", 0, 0, NULL},
    {"<Grid>" EVEN VECTOR(ITEM("400", " Format='Binary' Precision='8'>c.bin")) "</Grid>",
     "3200 bytes from 0 on", 0, 0, NULL},
    {"<Grid>" EVEN VECTOR(SLAB(HDF5("4 5 2", "U"))) "</Grid>", "not within the array", 0,
     0, NULL},
    {"<Grid>" EVEN VECTOR("<DataItem ItemType='Function' Function='$0 + $1' "
                          "Dimensions='4 5 2'/>") "</Grid>",
     "cannot be read: \"$0 + $1\"", 0, 0, NULL},
    {"<Grid>" EVEN VECTOR("<DataItem Reference='//Attribute[1]/DataItem'/>") "</Grid>",
     "refers to nothing", 0, 0, NULL},
    {"<Grid>" MESH("Hexahedron_20", "", HDF5("12 4", "g/quads"))
         VECTOR(HDF5("20 2", "U")) "</Grid>",
     "type \"Hexahedron_20\"", 0, 0, NULL},
    {"<Grid>" MESH("Triangle", "NumberOfElements='12'", HDF5("12 4", "g/quads"))
         VECTOR(HDF5("20 2", "U")) "</Grid>",
     "Topology of 12 elements, whose list has 16", 0, 0, NULL},
    {"<Grid>" MESH("Quadrilateral", "BaseOffset='1'", HDF5("12 4", "g/quads"))
         VECTOR(HDF5("20 2", "U")) "</Grid>",
     "point -1 of 20", 0, 0, NULL},
    {"<Grid>" MESH("Mixed", "", HDF5("12 4", "g/quads"))
         VECTOR(HDF5("20 2", "U")) "</Grid>",
     "of a type that cannot be read", 0, 0, NULL},
    {"<Grid>" EVEN "</Grid><Grid", "not XML", 0, 0, NULL},
    {"", "has no Grid", 0, 0, NULL},
};

/* What the files above name. */
static void write_arrays(sample_file *f, const char *path)
{
  double U[COUNT * 2], twice[COUNT * 2], part[2][COUNT], xy[COUNT * 2], quad[12 * 4],
      mixed[12 * 5], wide[2 * COUNT * 4] = {0};
  unsigned char bytes[3 + sizeof U];
  for (int n = 0; n < COUNT; ++n)
    for (int k = 0; k < 2; ++k) {
      xy[2 * n] = 1.0 + 0.5 * (n % NX);
      xy[2 * n + 1] = 2.0 + 0.25 * (n / NX);
      U[2 * n + k] = part[k][n] = velocity_at(xy[2 * n], xy[2 * n + 1], k, 1.0);
      twice[2 * n + k] = 2.0 * U[2 * n + k];
      wide[4 * (COUNT + n) + 2 * k] = U[2 * n + k];
      const unsigned char *from = (const unsigned char *)&U[2 * n + k];
      const uint16_t one = 1;
      for (int b = 0; b < 8; ++b)
        bytes[3 + 8 * (2 * n + k) + b] =
            from[*(const unsigned char *)&one == 1 ? 7 - b : b];
    }
  for (int c = 0; c < 12; ++c)
    for (int k = 0; k < 4; ++k) {
      mixed[5 * c] = 5; /* XDMF's quadrilateral */
      quad[4 * c + k] = mixed[5 * c + 1 + k] =
          c % 4 + NX * (c / 4) + (k == 1 || k == 2) + NX * (k > 1);
    }
  nc_must(nc_create(path, NC_NETCDF4 | NC_CLOBBER, &f->id));
  const int g = group(f->id, "g");
  put(f->id, "U", NC_DOUBLE, 3, (size_t[]){NY, NX, 2}, U);
  put(f->id, "twice", NC_DOUBLE, 3, (size_t[]){NY, NX, 2}, twice);
  put(f->id, "u", NC_DOUBLE, 2, (size_t[]){NY, NX}, part[0]);
  put(f->id, "v", NC_DOUBLE, 2, (size_t[]){NY, NX}, part[1]);
  put(f->id, "wide", NC_DOUBLE, 4, (size_t[]){2, NY, NX, 4}, wide);
  put(g, "xy", NC_DOUBLE, 2, (size_t[]){COUNT, 2}, xy);
  put(g, "quads", NC_INT, 2, (size_t[]){12, 4}, quad);
  put(g, "mixed", NC_INT, 1, (size_t[]){60}, mixed);
  nc_must(nc_close(f->id));
  char name[128];
  snprintf(name, sizeof name, "%s/c.bin", f->folder);
  FILE *file = fopen(name, "wb");
  assert_non_null(file);
  memset(bytes, 7, 3);
  assert_int_equal(fwrite(bytes, 1, sizeof bytes, file), sizeof bytes);
  fclose(file);
}

static void markup_names_arrays(void **state)
{
  sample_file *f = *state;
  char path[128];
  snprintf(path, sizeof path, "%s/b.h5", f->folder);
  write_arrays(f, path);
  for (size_t n = 0; n < sizeof XDMF / sizeof *XDMF; ++n) {
    const fg_read_options options = {.time = XDMF[n].time, .block = XDMF[n].block};
    FILE *file = fopen(f->path, "w");
    assert_non_null(file);
    fprintf(file,
            "<?xml version=\"1.0\"?>\n<!DOCTYPE Xdmf SYSTEM \"Xdmf.dtd\" []>\n"
            "<Xdmf Version=\"3.0\"><Domain>%s</Domain></Xdmf>\n",
            XDMF[n].domain);
    fclose(file);
    if (XDMF[n].fault)
      refuse(f, &options, XDMF[n].fault);
    else
      read_and_check(f, &fg__format_xdmf, &options, XDMF[n].factor);
  }
  unlink(path);
  snprintf(path, sizeof path, "%s/c.bin", f->folder);
  unlink(path);
}

int main(void)
{
#define TEST(name) cmocka_unit_test_setup_teardown(name, sample_set_up, sample_tear_down)
  const struct CMUnitTest tests[] = {TEST(images_have_times), TEST(parts_have_times),
                                     TEST(damaged_files_do_no_harm),
                                     TEST(markup_names_arrays)};
  return cmocka_run_group_tests_name("read/hdf", tests, NULL, NULL);
}
