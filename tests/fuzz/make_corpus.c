/* Makes the binary inputs of tests/fuzz/corpus anew, with the examples of the readers'
 * tests: `make_corpus FOLDER`, a folder that has grib, grid, image and netcdf. */
#define H5_USE_110_API
#include <hdf5.h>
#include <stdio.h>

#include <jpeglib.h>
#include <png.h>

#include "make_corpus.h"
#include "read/netcdf/sample_example.h"
#include "read/vtk/cells_example.h"

static void must(int64_t id)
{
  if (id < 0)
    abort();
}

/* Frees the file. Its first two thirds are no file. */
static void store_text(const char *name, example_text file)
{
  char path[256];
  snprintf(path, sizeof path, "grid/seed-%s", name);
  store(path, file.bytes, file.size);
  snprintf(path, sizeof path, "grid/fault-short-%s", name);
  store(path, file.bytes, 2 * file.size / 3);
  example_free(&file);
}

static example_text image_data(const example_encoding *encoding, bool rectilinear)
{
  example_text file = {0}, appended = {0};
  const char *kind = rectilinear ? "RectilinearGrid" : "ImageData";
  double place[3 * COUNT], vector[3 * COUNT];
  grid_points(place, vector, 0.25);
  example_begin_kind(&file, encoding, kind,
                     "WholeExtent=\"0 4 0 3 0 2\" Origin=\"1 2 3\" Spacing=\"1 2 0.5\"");
  example_words(&file, "<Piece Extent=\"0 4 0 3 0 2\"><PointData Vectors=\"U\">\n");
  example_array(&file, &appended, encoding, "U", 3, vector, 3 * COUNT);
  example_words(&file, "</PointData>");
  if (rectilinear) {
    static const size_t length[3] = {NX, NY, NZ};
    example_words(&file, "<Coordinates>");
    for (int k = 0; k < 3; ++k)
      example_array(&file, &appended, encoding, "c", 1, EDGES[k], length[k]);
    example_words(&file, "</Coordinates>");
  }
  example_words(&file, "</Piece>\n");
  example_end_kind(&file, &appended, encoding, kind);
  return file;
}

static void make_grids(void)
{
  const example_encoding raw = {.storage = EXAMPLE_APPENDED_RAW, .type = EXAMPLE_FLOAT64},
                         zlib = {.storage = EXAMPLE_APPENDED_BASE64,
                                 .zlib = true,
                                 .block = 96,
                                 .type = EXAMPLE_FLOAT64},
                         lz4 = {.storage = EXAMPLE_INLINE,
                                .lz4 = true,
                                .block = 128,
                                .wide = true,
                                .big = true,
                                .type = EXAMPLE_FLOAT64};
  store_text("raw.vti", image_data(&raw, false));
  store_text("zlib.vti", image_data(&zlib, false));
  store_text("lz4.vti", image_data(&lz4, false));
  store_text("raw.vtr", image_data(&raw, true));
  store_text("zlib.vts", vts(&zlib, 0.0));
  store_text("raw.vts", vts(&raw, 0.0));
  store_text("lz4.vtu", vtu(&lz4, ""));
  store_text("raw.vtu", vtu(&raw, ""));
  store_text("cells.vtk", legacy(true, false));
  store_text("offsets.vtk", legacy(true, true));
}

enum { SIDE = 16 };

static void line_of(unsigned char line[SIDE * 4], int row)
{
  for (int i = 0; i < SIDE * 4; ++i)
    line[i] = (unsigned char)(i * (row + 3) % 251);
}

static void make_png(const char *name, int type, int depth, int channels, int interlace)
{
  FILE *file = fopen(name, "wb");
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, NULL, NULL, NULL);
  png_infop info = png_create_info_struct(png);
  unsigned char rows[SIDE][SIDE * 4];
  unsigned char *row[SIDE];
  if (!file)
    abort();
  png_init_io(png, file);
  const int width = SIDE * 4 / (channels * depth / 8);
  png_set_IHDR(png, info, (png_uint_32)width, SIDE, depth, type, interlace,
               PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  for (int j = 0; j < SIDE; ++j)
    line_of(row[j] = rows[j], j);
  png_write_info(png, info);
  png_write_image(png, row);
  png_write_end(png, info);
  png_destroy_write_struct(&png, &info);
  fclose(file);
}

typedef enum jpeg_kind { BASELINE, PROGRESSIVE, INKS, TURNED, MANY_SCANS } jpeg_kind;

/* One for each frequency of each component. */
static void use_many_scans(struct jpeg_compress_struct *jpeg, jpeg_scan_info scans[])
{
  jpeg->num_scans = 1;
  scans[0] = (jpeg_scan_info){.comps_in_scan = 3, .component_index = {0, 1, 2}};
  for (int k = 0; k < 3; ++k)
    for (int n = 1; n < 64; ++n)
      scans[jpeg->num_scans++] =
          (jpeg_scan_info){.comps_in_scan = 1, .component_index = {k}, .Ss = n, .Se = n};
  jpeg->scan_info = scans;
}

static void make_jpeg(const char *name, jpeg_kind kind)
{
  /* turned by a quarter */
  static const unsigned char exif[] =
      "Exif\0\0MM\0*\0\0\0\10\0\1\1\22\0\3\0\0\0\1\0\6\0\0"
      "\0\0\0\0";
  struct jpeg_compress_struct jpeg;
  struct jpeg_error_mgr errors;
  jpeg_scan_info scans[1 + 3 * 63];
  unsigned char line[SIDE * 4], *row = line;
  FILE *file = fopen(name, "wb");
  if (!file)
    abort();
  jpeg.err = jpeg_std_error(&errors);
  jpeg_create_compress(&jpeg);
  jpeg_stdio_dest(&jpeg, file);
  jpeg.image_width = jpeg.image_height = SIDE;
  jpeg.input_components = kind == INKS ? 4 : 3;
  jpeg.in_color_space = kind == INKS ? JCS_CMYK : JCS_RGB;
  jpeg_set_defaults(&jpeg);
  if (kind == PROGRESSIVE)
    jpeg_simple_progression(&jpeg);
  if (kind == MANY_SCANS)
    use_many_scans(&jpeg, scans);
  jpeg_start_compress(&jpeg, TRUE);
  if (kind == TURNED)
    jpeg_write_marker(&jpeg, JPEG_APP0 + 1, exif, sizeof exif - 1);
  for (int j = 0; j < SIDE; ++j) {
    line_of(line, j);
    jpeg_write_scanlines(&jpeg, &row, 1);
  }
  jpeg_finish_compress(&jpeg);
  jpeg_destroy_compress(&jpeg);
  fclose(file);
}

static void make_images(void)
{
  make_png("image/seed-rgba.png", PNG_COLOR_TYPE_RGB_ALPHA, 8, 4, PNG_INTERLACE_NONE);
  make_png("image/seed-grey-deep.png", PNG_COLOR_TYPE_GRAY, 16, 1, PNG_INTERLACE_NONE);
  make_png("image/seed-interlaced.png", PNG_COLOR_TYPE_GRAY_ALPHA, 8, 2,
           PNG_INTERLACE_ADAM7);
  make_jpeg("image/seed-baseline.jpg", BASELINE);
  make_jpeg("image/seed-progressive.jpg", PROGRESSIVE);
  make_jpeg("image/seed-inks.jpg", INKS);
  make_jpeg("image/seed-turned.jpg", TURNED);
  make_jpeg("image/fault-many-scans.jpg", MANY_SCANS);
}

/* A pair of variables on an even grid; of two members each, or of one. */
static void make_members(const char *name, int mode, bool two)
{
  static const double x[] = {1, 2, 3, 4, 5}, y[] = {10, 20, 30, 40}, members[] = {0, 7};
  double values[40];
  int all[3] = {0};
  sample_file f;
  snprintf(f.path, sizeof f.path, "%.90s", name);
  sample_begin(&f, mode);
  if (two)
    all[0] = sample_axis(&f, "member", 2, members, "1");
  all[1] = sample_axis(&f, "y", 4, y, "km");
  all[2] = sample_axis(&f, "x", 5, x, "km");
  for (int k = 0; k < 2; ++k) {
    const int id =
        sample_variable(&f, k ? "v" : "u", NC_FLOAT, two ? 3 : 2, two ? all : all + 1);
    sample_text(&f, id, "units", "m s-1");
    for (int n = 0; n < 40; ++n)
      values[n] = (3 + k) * n % 11 - 4;
    sample_put(&f, id, values);
  }
  sample_end(&f);
}

static void make_netcdf(const char *name, int mode)
{
  make_members(name, mode, false);
}

typedef struct staggered_variable {
  const char *name, *row, *column, *units;
  size_t rows, columns;
  double first, step_row, step_column;
} staggered_variable;

static int dimension_named(const sample_file *f, const char *name, size_t length)
{
  int id;
  return nc_inq_dimid(f->id, name, &id) ? sample_dimension(f, name, length) : id;
}

/* A model's grid: components on the sides of cells, an angle and a mask. */
static void make_staggered(const char *name)
{
  static const staggered_variable all[] = {
      {"lon_rho", "eta_rho", "xi_rho", "degrees_east", 5, 6, 176.0, 0.3, 1.5},
      {"lat_rho", "eta_rho", "xi_rho", "degrees_north", 5, 6, 40.0, 1.0, -0.2},
      {"angle", "eta_rho", "xi_rho", "radians", 5, 6, -0.2, 0.001, 0.002},
      {"mask_rho", "eta_rho", "xi_rho", "1", 5, 6, 0.0, 1.0, 1.0},
      {"u", "eta_rho", "xi_u", "m s-1", 5, 5, 0.5, 0.1, -0.05},
      {"v", "eta_v", "xi_rho", "m s-1", 4, 6, -0.3, 0.07, 0.2}};
  sample_file f;
  snprintf(f.path, sizeof f.path, "%.90s", name);
  sample_begin(&f, NC_CLASSIC_MODEL);
  for (size_t n = 0; n < sizeof all / sizeof *all; ++n) {
    const staggered_variable *v = &all[n];
    double values[30];
    const int plane[2] = {dimension_named(&f, v->row, v->rows),
                          dimension_named(&f, v->column, v->columns)};
    const int id = sample_variable(&f, v->name, NC_FLOAT, 2, plane);
    sample_text(&f, id, "units", v->units);
    for (size_t k = 0; k < v->rows * v->columns; ++k)
      values[k] = v->first + v->step_row * (double)(k / v->columns) +
                  v->step_column * (double)(k % v->columns);
    sample_put(&f, id, values);
  }
  sample_end(&f);
}

/* Axes of a projection. */
static void make_projected(const char *name)
{
  sample_file f;
  make_netcdf(name, NC_CLASSIC_MODEL);
  nc_must(nc_open(name, NC_WRITE, &f.id));
  const int crs = sample_variable(&f, "crs", NC_INT, 0, NULL);
  sample_text(&f, crs, "grid_mapping_name", "lambert_conformal_conic");
  sample_number(&f, crs, "latitude_of_projection_origin", NC_DOUBLE, 63.0);
  sample_number(&f, crs, "longitude_of_central_meridian", NC_DOUBLE, 15.0);
  sample_number(&f, crs, "standard_parallel", NC_DOUBLE, 63.0);
  sample_number(&f, crs, "earth_radius", NC_DOUBLE, 6371000.0);
  for (int k = 0; k < 2; ++k) {
    int id;
    nc_must(nc_inq_varid(f.id, k ? "v" : "u", &id));
    sample_text(&f, id, "grid_mapping", "crs");
    sample_text(&f, id, "standard_name", k ? "northward_wind" : "eastward_wind");
  }
  sample_end(&f);
}

/* Longitudes, latitudes, or whatever goes on by a step. */
static void put_steps(const sample_file *f, const char *name, int dimension, int count,
                      const double step[2])
{
  const int id = sample_variable(f, name, NC_DOUBLE, 1, &dimension);
  double values[12];
  for (int n = 0; n < count; ++n) {
    const int column = n % 3, row = n / 3;
    values[n] = step[0] * column + step[1] * row;
  }
  sample_put(f, id, values);
}

static void put_corners(const sample_file *f, const char *name, int rows, int columns,
                        int start)
{
  static const int corner[5][4] = {
      {0, 1, 4, 3}, {1, 2, 5, -1}, {1, 5, 4, -1}, {3, 4, 7, 6}, {4, 5, 8, 7}};
  double values[20];
  const int all[2] = {rows, columns};
  const int id = sample_variable(f, name, NC_INT, 2, all);
  for (int n = 0; n < 20; ++n)
    values[n] = corner[n / 4][n % 4] + start;
  sample_number(f, id, "_FillValue", NC_INT, start - 1.0);
  sample_put(f, id, values);
}

/* Four quads, one of which is two triangles, each as UGRID and as MPAS has it. */
static void make_unstructured(void)
{
  static const double east[2] = {5.0, 0.5}, north[2] = {0.5, 5.0}, u[2] = {1.0, -2.0};
  sample_file f;
  strcpy(f.path, "netcdf/seed-ugrid.nc");
  sample_begin(&f, NC_CLASSIC_MODEL);
  const int nodes = sample_dimension(&f, "nodes", 9);
  const int mesh = sample_variable(&f, "mesh", NC_INT, 0, NULL);
  sample_text(&f, mesh, "cf_role", "mesh_topology");
  sample_text(&f, mesh, "node_coordinates", "lon lat");
  sample_text(&f, mesh, "face_node_connectivity", "corners");
  put_corners(&f, "corners", sample_dimension(&f, "faces", 5),
              sample_dimension(&f, "four", 4), 0);
  put_steps(&f, "lon", nodes, 9, east);
  put_steps(&f, "lat", nodes, 9, north);
  put_steps(&f, "u", nodes, 9, u);
  put_steps(&f, "v", nodes, 9, north);
  sample_end(&f);
  static const double radians[2][2] = {{0.1, 0.01}, {0.01, 0.1}};
  strcpy(f.path, "netcdf/seed-mpas.nc");
  sample_begin(&f, NC_CLASSIC_MODEL);
  const int cells = sample_dimension(&f, "nCells", 5);
  const int vertices = sample_dimension(&f, "nVertices", 9);
  put_corners(&f, "verticesOnCell", cells, sample_dimension(&f, "maxEdges", 4), 1);
  put_steps(&f, "lonVertex", vertices, 9, radians[0]);
  put_steps(&f, "latVertex", vertices, 9, radians[1]);
  put_steps(&f, "lonCell", cells, 5, radians[0]);
  put_steps(&f, "latCell", cells, 5, radians[1]);
  put_steps(&f, "uReconstructZonal", cells, 5, u);
  put_steps(&f, "uReconstructMeridional", cells, 5, north);
  sample_end(&f);
}

static void make_healpix(void)
{
  static const double u[2] = {1.0, -2.0}, v[2] = {3.0, 1.0};
  sample_file f;
  strcpy(f.path, "netcdf/seed-healpix.nc");
  sample_begin(&f, NC_CLASSIC_MODEL);
  const int crs = sample_variable(&f, "crs", NC_INT, 0, NULL);
  sample_text(&f, crs, "grid_mapping_name", "healpix");
  sample_text(&f, crs, "indexing_scheme", "ring");
  sample_number(&f, crs, "refinement_level", NC_INT, 4.0);
  const int cells = sample_dimension(&f, "cell", 12);
  const int number = sample_variable(&f, "cell", NC_INT, 1, &cells);
  /* a pole with all that is round it */
  sample_put(&f, number, (const double[]){0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11});
  put_steps(&f, "u", cells, 12, u);
  put_steps(&f, "v", cells, 12, v);
  sample_end(&f);
}

/* The same with something added. */
static hid_t open_another(const char *name)
{
  make_netcdf(name, NC_NETCDF4);
  const hid_t file = H5Fopen(name, H5F_ACC_RDWR, H5P_DEFAULT);
  must(file);
  return file;
}

/* Each of twelve ways leads to where all begin. */
static void make_links(void)
{
  hid_t file = open_another("netcdf/fault-hard-links-round.nc");
  const hid_t group = H5Gcreate2(file, "part", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
  must(group);
  for (int k = 0; k < 12; ++k) {
    char way[16];
    snprintf(way, sizeof way, "way%d", k);
    must(H5Lcreate_hard(file, "/", group, way, H5P_DEFAULT, H5P_DEFAULT));
  }
  H5Gclose(group);
  must(H5Fclose(file));
  file = open_another("netcdf/fault-soft-link-round.nc");
  must(H5Lcreate_soft("/", file, "round", H5P_DEFAULT, H5P_DEFAULT));
  must(H5Fclose(file));
  file = open_another("netcdf/fault-link-outside.nc");
  must(
      H5Lcreate_external("elsewhere", "/u", file, "elsewhere", H5P_DEFAULT, H5P_DEFAULT));
  must(H5Fclose(file));
}

typedef enum stored { OUTSIDE, VIRTUAL, LARGE_CHUNKS } stored;

static void make_set(const char *name, stored how)
{
  const hsize_t length[2] = {4, 5}, most[2] = {H5S_UNLIMITED, H5S_UNLIMITED},
                chunk[2] = {30000, 30000};
  const hid_t file = open_another(name),
              space = H5Screate_simple(2, length, how == LARGE_CHUNKS ? most : NULL),
              creation = H5Pcreate(H5P_DATASET_CREATE);
  if (how == OUTSIDE)
    must(H5Pset_external(creation, "elsewhere", 0, H5F_UNLIMITED));
  else if (how == VIRTUAL)
    must(H5Pset_virtual(creation, space, "elsewhere", "/u", space));
  else
    must(H5Pset_chunk(creation, 2, chunk));
  const hid_t set = H5Dcreate2(file, "extra", H5T_NATIVE_FLOAT, space, H5P_DEFAULT,
                               creation, H5P_DEFAULT);
  must(set);
  H5Dclose(set);
  H5Pclose(creation);
  H5Sclose(space);
  must(H5Fclose(file));
}

/* x is as long as 32 bits can say. */
static void make_endless(const char *name)
{
  unsigned char bytes[4096];
  make_netcdf(name, NC_CLASSIC_MODEL);
  FILE *file = fopen(name, "rb");
  if (!file)
    abort();
  const size_t size = fread(bytes, 1, sizeof bytes, file);
  fclose(file);
  for (size_t at = 8; at + 12 < size; ++at)
    if (memcmp(bytes + at, "\0\0\0\1x\0\0\0", 8) == 0) {
      memcpy(bytes + at + 8, "\x7f\xff\xff\xff", 4);
      break;
    }
  store(name, bytes, size);
}

static void make_netcdfs(void)
{
  make_netcdf("netcdf/seed-classic.nc", NC_CLASSIC_MODEL);
  make_netcdf("netcdf/seed-64-bit-offset.nc", NC_64BIT_OFFSET);
  make_netcdf("netcdf/seed-cdf5.nc", NC_64BIT_DATA);
  make_netcdf("netcdf/seed-netcdf4.nc", NC_NETCDF4);
  make_members("netcdf/seed-members.nc", NC_CLASSIC_MODEL, true);
  make_members("netcdf/seed-members4.nc", NC_NETCDF4, true);
  make_staggered("netcdf/seed-staggered.nc");
  make_projected("netcdf/seed-projected.nc");
  make_unstructured();
  make_healpix();
  make_endless("netcdf/fault-endless-dimension.nc");
  make_links();
  make_set("netcdf/fault-stored-outside.nc", OUTSIDE);
  make_set("netcdf/fault-virtual.nc", VIRTUAL);
  make_set("netcdf/fault-large-chunks.nc", LARGE_CHUNKS);
}

int main(int count, char **argument)
{
  if (count != 2 || chdir(argument[1]))
    return 2;
  make_grids();
  make_images();
  make_netcdfs();
  make_gribs();
  return 0;
}
