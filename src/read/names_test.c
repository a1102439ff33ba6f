/* One answer to each name: tests/vectors.txt through every format that can carry it. */
#include <netcdf.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>
#include <zlib.h>

#include "base/context_test.h"

enum { N = 3, COUNT = N * N, MOST_NAMES = 8, LINE_BYTES = 256 };

/* A file of scalars on a grid of 3 x 3 points. */
typedef struct scalars {
  const char *name[MOST_NAMES];
  int count;
} scalars;

static double value_of(int which, int n)
{
  return 1.0 + which + 0.5 * (n % N) - 0.25 * (n / N);
}

static void must(bool good, const char *what)
{
  if (!good)
    fail_msg("%s", what);
}

static void write_netcdf(FILE *file, const char *path, const scalars *s)
{
  static const double at[N] = {0.0, 1.0, 2.0};
  int id, dimension[2], axis[2], variable[MOST_NAMES];
  (void)file;
  must(!nc_create(path, NC_NETCDF4 | NC_CLOBBER, &id), path);
  for (int k = 0; k < 2; ++k) {
    const char *name = k == 0 ? "lat" : "lon",
               *units = k == 0 ? "degrees_north" : "degrees_east";
    must(!nc_def_dim(id, name, N, &dimension[k]), name);
    must(!nc_def_var(id, name, NC_DOUBLE, 1, &dimension[k], &axis[k]), name);
    must(!nc_put_att_text(id, axis[k], "units", strlen(units), units), name);
  }
  for (int i = 0; i < s->count; ++i)
    must(!nc_def_var(id, s->name[i], NC_DOUBLE, 2, dimension, &variable[i]), s->name[i]);
  for (int k = 0; k < 2; ++k)
    must(!nc_put_var_double(id, axis[k], at), path);
  for (int i = 0; i < s->count; ++i) {
    double values[COUNT];
    for (int n = 0; n < COUNT; ++n)
      values[n] = value_of(i, n);
    must(!nc_put_var_double(id, variable[i], values), s->name[i]);
  }
  must(!nc_close(id), path);
}

static void write_csv(FILE *file, const char *path, const scalars *s)
{
  (void)path;
  fputs("lon,lat", file);
  for (int i = 0; i < s->count; ++i)
    fprintf(file, ",%s", s->name[i]);
  for (int n = 0; n < COUNT; ++n) {
    fprintf(file, "\n%d,%d", n % N, n / N);
    for (int i = 0; i < s->count; ++i)
      fprintf(file, ",%g", value_of(i, n));
  }
  fputc('\n', file);
}

static void write_arrays(FILE *file, const scalars *s)
{
  fputs("<PointData>", file);
  for (int i = 0; i < s->count; ++i) {
    fprintf(file, "<DataArray type=\"Float64\" Name=\"%s\" format=\"ascii\">",
            s->name[i]);
    for (int n = 0; n < COUNT; ++n)
      fprintf(file, "%g ", value_of(i, n));
    fputs("</DataArray>", file);
  }
  fputs("</PointData>", file);
}

static void write_vti(FILE *file, const char *path, const scalars *s)
{
  (void)path;
  fputs("<VTKFile type=\"ImageData\"><ImageData WholeExtent=\"0 2 0 2 0 0\" "
        "Origin=\"0 0 0\" Spacing=\"1 1 1\"><Piece Extent=\"0 2 0 2 0 0\">",
        file);
  write_arrays(file, s);
  fputs("</Piece></ImageData></VTKFile>\n", file);
}

static void write_legacy(FILE *file, const char *path, const scalars *s)
{
  (void)path;
  fprintf(file,
          "# vtk DataFile Version 3.0\nscalars\nASCII\nDATASET STRUCTURED_POINTS\n"
          "DIMENSIONS 3 3 1\nORIGIN 0 0 0\nSPACING 1 1 1\nPOINT_DATA %d\n",
          COUNT);
  for (int i = 0; i < s->count; ++i) {
    fprintf(file, "SCALARS %s double 1\nLOOKUP_TABLE default\n", s->name[i]);
    for (int n = 0; n < COUNT; ++n)
      fprintf(file, "%g\n", value_of(i, n));
  }
}

static void write_vtkhdf(FILE *file, const char *path, const scalars *s)
{
  int id, group, samples, dimension[2], variable;
  (void)file;
  must(!nc_create(path, NC_NETCDF4 | NC_CLOBBER, &id), path);
  must(!nc_def_grp(id, "VTKHDF", &group), path);
  must(!nc_put_att_int(group, NC_GLOBAL, "Version", NC_INT, 2, (int[]){1, 0}), path);
  must(!nc_put_att_text(group, NC_GLOBAL, "Type", 9, "ImageData"), path);
  must(!nc_put_att_int(group, NC_GLOBAL, "WholeExtent", NC_INT, 6,
                       (int[]){0, N - 1, 0, N - 1, 0, 0}),
       path);
  must(!nc_def_grp(group, "PointData", &samples), path);
  for (int k = 0; k < 2; ++k)
    must(!nc_def_dim(samples, k ? "along" : "across", N, &dimension[k]), path);
  for (int i = 0; i < s->count; ++i) {
    double values[COUNT];
    for (int n = 0; n < COUNT; ++n)
      values[n] = value_of(i, n);
    must(!nc_def_var(samples, s->name[i], NC_DOUBLE, 2, dimension, &variable), path);
    must(!nc_put_var_double(samples, variable, values), s->name[i]);
  }
  must(!nc_close(id), path);
}

static void write_xdmf(FILE *file, const char *path, const scalars *s)
{
  (void)path;
  fputs("<Xdmf><Domain><Grid><Topology TopologyType=\"2DCoRectMesh\" Dimensions=\"3 "
        "3\"/><Geometry GeometryType=\"ORIGIN_DXDY\"><DataItem Dimensions=\"2\">0 "
        "0</DataItem><DataItem Dimensions=\"2\">1 1</DataItem></Geometry>",
        file);
  for (int i = 0; i < s->count; ++i) {
    fprintf(file, "<Attribute Name=\"%s\"><DataItem Dimensions=\"3 3\">", s->name[i]);
    for (int n = 0; n < COUNT; ++n)
      fprintf(file, "%g ", value_of(i, n));
    fputs("</DataItem></Attribute>", file);
  }
  fputs("</Grid></Domain></Xdmf>", file);
}

/* Squares of an unstructured grid (kind Cells), or of polygons. */
static void write_squares(FILE *file, const scalars *s, const char *grid,
                          const char *cells, const char *counts, bool typed)
{
  static const int corner[4] = {0, 1, N + 1, N};
  fprintf(file,
          "<VTKFile type=\"%s\"><%s><Piece NumberOfPoints=\"%d\" %s=\"4\"><Points>"
          "<DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"ascii\">",
          grid, grid, COUNT, counts);
  for (int n = 0; n < COUNT; ++n)
    fprintf(file, "%d %d 0 ", n % N, n / N);
  fprintf(file,
          "</DataArray></Points><%s><DataArray type=\"Int64\" Name=\"connectivity\" "
          "format=\"ascii\">",
          cells);
  for (int c = 0; c < 4; ++c)
    for (int k = 0; k < 4; ++k)
      fprintf(file, "%d ", c % 2 + N * (c / 2) + corner[k]);
  fputs("</DataArray><DataArray type=\"Int64\" Name=\"offsets\" format=\"ascii\">4 8 12 "
        "16</DataArray>",
        file);
  if (typed)
    fputs("<DataArray type=\"UInt8\" Name=\"types\" format=\"ascii\">9 9 9 "
          "9</DataArray>",
          file);
  fprintf(file, "</%s>", cells);
  write_arrays(file, s);
  fprintf(file, "</Piece></%s></VTKFile>\n", grid);
}

static void write_vtu(FILE *file, const char *path, const scalars *s)
{
  (void)path;
  write_squares(file, s, "UnstructuredGrid", "Cells", "NumberOfCells", true);
}

static void write_vtp(FILE *file, const char *path, const scalars *s)
{
  (void)path;
  write_squares(file, s, "PolyData", "Polys", "NumberOfPolys", false);
}

static void write_short(FILE *file, unsigned value)
{
  fputc((int)(value & 0xff), file);
  fputc((int)(value >> 8 & 0xff), file);
}

static void write_long(FILE *file, unsigned long value)
{
  write_short(file, (unsigned)(value & 0xffff));
  write_short(file, (unsigned)(value >> 16 & 0xffff));
}

enum { NPY_HEADER = 128, NPY_BYTES = NPY_HEADER + COUNT * 8 };

static void make_npy(unsigned char out[NPY_BYTES], int which)
{
  static const unsigned char begin[] = {0x93, 'N', 'U', 'M', 'P', 'Y', 1, 0, 0x76, 0};
  static const char header[] =
      "{'descr': '<f8', 'fortran_order': False, 'shape': (3, 3), }";
  memset(out, ' ', NPY_HEADER);
  for (size_t n = 0; n < sizeof begin; ++n)
    out[n] = begin[n];
  for (size_t n = 0; header[n]; ++n)
    out[sizeof begin + n] = (unsigned char)header[n];
  out[NPY_HEADER - 1] = '\n';
  for (int n = 0; n < COUNT; ++n) {
    const double value = value_of(which, n);
    memcpy(out + NPY_HEADER + 8 * n, &value, 8);
  }
}

/* What a zip's entry and its line of the directory share. */
static void write_entry(FILE *file, unsigned long checksum, size_t name)
{
  write_short(file, 20);
  write_short(file, 0);
  write_short(file, 0); /* stored */
  write_long(file, 0x21);
  write_long(file, checksum);
  write_long(file, NPY_BYTES);
  write_long(file, NPY_BYTES);
  write_short(file, (unsigned)name);
  write_short(file, 0);
}

static void write_npz(FILE *file, const char *path, const scalars *s)
{
  unsigned char array[NPY_BYTES];
  unsigned long at[MOST_NAMES], checksum[MOST_NAMES];
  (void)path;
  for (int i = 0; i < s->count; ++i) {
    make_npy(array, i);
    at[i] = (unsigned long)ftell(file);
    checksum[i] = crc32(0, array, NPY_BYTES);
    fputs("PK\x03\x04", file);
    write_entry(file, checksum[i], strlen(s->name[i]) + 4);
    fprintf(file, "%s.npy", s->name[i]);
    fwrite(array, 1, NPY_BYTES, file);
  }
  const unsigned long directory = (unsigned long)ftell(file);
  for (int i = 0; i < s->count; ++i) {
    fputs("PK\x01\x02", file);
    write_short(file, 20);
    write_entry(file, checksum[i], strlen(s->name[i]) + 4);
    write_short(file, 0); /* comment, disk, attributes */
    write_short(file, 0);
    write_short(file, 0);
    write_long(file, 0);
    write_long(file, at[i]);
    fprintf(file, "%s.npy", s->name[i]);
  }
  const unsigned long end = (unsigned long)ftell(file);
  fputs("PK\x05\x06", file);
  write_long(file, 0);
  write_short(file, (unsigned)s->count);
  write_short(file, (unsigned)s->count);
  write_long(file, end - directory);
  write_long(file, directory);
  write_short(file, 0);
}

static const struct {
  const char *file;
  void (*write)(FILE *file, const char *path, const scalars *s);
} FORMATS[] = {
    {"a.nc", write_netcdf}, {"a.vti", write_vti},       {"a.vtk", write_legacy},
    {"a.vtu", write_vtu},   {"a.vtp", write_vtp},       {"a.csv", write_csv},
    {"a.npz", write_npz},   {"a.vtkhdf", write_vtkhdf}, {"a.xdmf", write_xdmf}};
enum { FORMAT_COUNT = sizeof FORMATS / sizeof *FORMATS };

/* "u,v", "-" or "?". */
static void read_answer(char out[LINE_BYTES], fg_context *context, const char *path)
{
  fg_field *field = NULL;
  const fg_status status = fg_field_read(&field, context, path, NULL);
  const char *message = fg_context_message(context);
  if (status == FG_STATUS_OK)
    snprintf(out, LINE_BYTES, "%s,%s", fg_field_contents(field)->velocity_name[0],
             fg_field_contents(field)->velocity_name[1]);
  else if (status == FG_STATUS_ARGUMENT && strstr(message, " vectors"))
    snprintf(out, LINE_BYTES, "?");
  else if (status == FG_STATUS_UNSUPPORTED &&
           (strstr(message, "no vectors") || strstr(message, "which are")))
    snprintf(out, LINE_BYTES, "-");
  else
    snprintf(out, LINE_BYTES, "%s", message);
  fg_field_destroy(field);
  fg_context_clear(context);
}

static void check_names(const scalars *s, const char *line, const char *wanted,
                        fg_context *context)
{
  for (int f = 0; f < FORMAT_COUNT; ++f) {
    char found[LINE_BYTES];
    FILE *file = fopen(FORMATS[f].file, "wb");
    assert_non_null(file);
    FORMATS[f].write(file, FORMATS[f].file, s);
    fclose(file);
    read_answer(found, context, FORMATS[f].file);
    if (strcmp(found, wanted) != 0)
      fail_msg("%s: \"%s\" is \"%s\", not \"%s\"", FORMATS[f].file, line, found, wanted);
    unlink(FORMATS[f].file);
  }
}

static void every_format_gives_the_same_answer(void **state)
{
  char line[LINE_BYTES], folder[] = "/tmp/flowgrain-names-XXXXXX";
  int rows = 0;
  FILE *table = fopen(FLOWGRAIN_SOURCE_DIR "/tests/vectors.txt", "r");
  assert_non_null(table);
  assert_non_null(mkdtemp(folder));
  assert_int_equal(chdir(folder), 0);
  while (fgets(line, sizeof line, table)) {
    char names[LINE_BYTES];
    scalars s = {.count = 0};
    char *equals = strstr(line, " = ");
    if (line[0] == '#' || !equals)
      continue;
    equals[3 + strcspn(equals + 3, "\n")] = *equals = '\0';
    snprintf(names, sizeof names, "%s", line);
    for (char *name = strtok(names, " "); name && s.count < MOST_NAMES;
         name = strtok(NULL, " "))
      s.name[s.count++] = name;
    check_names(&s, line, equals + 3, *state);
    ++rows;
  }
  fclose(table);
  assert_true(rows > 40);
  assert_int_equal(chdir("/"), 0);
  rmdir(folder);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(every_format_gives_the_same_answer)};
  return cmocka_run_group_tests_name("read/names", tests, context_set_up,
                                     context_tear_down);
}
