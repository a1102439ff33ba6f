/* Grids of tiles, as the faces of a cubed sphere, under the names and orders of
 * dimensions of several models, and what only looks like them. The flow is that of
 * model_example.h.
 */
#include "read/netcdf/model_example.h"

enum { MOST_DIMENSIONS = 6, ALONG = 40, MOST_POINTS = 6 * ALONG * ALONG };

typedef struct tiled {
  const char *what;
  const char *dimensions; /* of the components, with blanks between */
  const char *tile, *row, *column;
  const char *place[2]; /* the longitudes' and latitudes' names */
  const char *name[2];
  const char *attribute[3]; /* of the components: name, values */
  size_t tiles;
  fg_frame frame;
  bool alike;          /* all at the places of the first */
  const char *refused; /* words; NULL: it is read */
} tiled;

static const tiled FILES[] = {
    {.what = "GEOS",
     .dimensions = "time lev nf Ydim Xdim",
     .tile = "nf",
     .row = "Ydim",
     .column = "Xdim",
     .place = {"lons", "lats"},
     .name = {"U", "V"},
     .attribute = {"standard_name", "eastward_wind", "northward_wind"},
     .tiles = 6},
    {.what = "tiles before levels",
     .dimensions = "time tile pfull grid_yt grid_xt",
     .tile = "tile",
     .row = "grid_yt",
     .column = "grid_xt",
     .place = {"lon", "lat"},
     .name = {"ugrd", "vgrd"},
     .attribute = {"long_name", "zonal wind", "meridional wind"},
     .tiles = 6,
     .frame = FG_FRAME_EAST},
    {.what = "two faces, and no time",
     .dimensions = "face j i",
     .tile = "face",
     .row = "j",
     .column = "i",
     .place = {"XC", "YC"},
     .name = {"uo", "vo"},
     .attribute = {"standard_name", "eastward_sea_water_velocity",
                   "northward_sea_water_velocity"},
     .tiles = 2},
    {.what = "no word of the directions",
     .dimensions = "time face j i",
     .tile = "face",
     .row = "j",
     .column = "i",
     .place = {"XC", "YC"},
     .name = {"u", "v"},
     .tiles = 6,
     .refused = "nothing says whether 'u' and 'v' point east and north"},
    {.what = "along the tiles",
     .dimensions = "time face j i",
     .tile = "face",
     .row = "j",
     .column = "i",
     .place = {"XC", "YC"},
     .name = {"u", "v"},
     .attribute = {"standard_name", "sea_water_x_velocity", "sea_water_y_velocity"},
     .tiles = 6,
     .refused = "are along the grids of their tiles"},
    {.what = "members at the same places",
     .dimensions = "time level member j i",
     .tile = "member",
     .row = "j",
     .column = "i",
     .place = {"lon", "lat"},
     .name = {"u", "v"},
     .attribute = {"standard_name", "eastward_wind", "northward_wind"},
     .tiles = 6,
     .alike = true,
     .refused = "dimension 'member' of 6 samples is neither time nor level"},
};

/* The place of a point of a cube's face. */
static void place_on_face(double at[2], size_t face, size_t j, size_t i)
{
  const double a = tan(((double)i + 0.5) / ALONG * 1.5707963 - 0.78539816);
  const double b = tan(((double)j + 0.5) / ALONG * 1.5707963 - 0.78539816);
  const double p[6][3] = {{1.0, a, b},    {-a, 1.0, b},  {-b, a, 1.0},
                          {-1.0, -b, -a}, {b, -1.0, -a}, {b, a, -1.0}};
  const double length = sqrt(dot(p[face], p[face]));
  at[0] = atan2(p[face][1], p[face][0]) / RADIANS;
  at[1] = asin(p[face][2] / length) / RADIANS;
}

static double value_at(const tiled *t, int what, size_t point)
{
  double at[2], flow[2];
  const size_t tile = t->alike ? 0 : point / (ALONG * ALONG);
  place_on_face(at, tile, point / ALONG % ALONG, point % ALONG);
  exact(flow, at[0], at[1]);
  return what < 2 ? at[what] : flow[what - 2];
}

static size_t length_of(const tiled *t, const char *name)
{
  return strcmp(name, t->tile) == 0                                  ? t->tiles
         : strcmp(name, t->row) == 0 || strcmp(name, t->column) == 0 ? ALONG
         : strcmp(name, "time") == 0                                 ? 1
                                                                     : 2;
}

/* Writes a component; in levels or times before the last it is the opposite. */
static void put_component(const sample_file *f, const tiled *t, int k)
{
  char names[128], *left = names;
  int rank = 0, id[MOST_DIMENSIONS];
  size_t length[MOST_DIMENSIONS], samples = 1;
  snprintf(names, sizeof names, "%s", t->dimensions);
  const char *order[MOST_DIMENSIONS];
  for (char *one; (one = strtok_r(left, " ", &left)); ++rank) {
    order[rank] = one;
    length[rank] = length_of(t, one);
    id[rank] = dimension_of(f, one, length[rank]);
    samples *= length[rank];
  }
  const int v = sample_variable(f, t->name[k], NC_DOUBLE, rank, id);
  if (t->attribute[0])
    sample_text(f, v, t->attribute[0], t->attribute[1 + k]);
  double *values = malloc(samples * sizeof *values);
  assert_non_null(values);
  for (size_t n = 0; n < samples; ++n) {
    size_t left_of = n, at[3] = {0};
    bool last = true;
    for (int d = rank - 1; d >= 0; left_of /= length[d--]) {
      const size_t index = left_of % length[d];
      const char *const own[] = {t->tile, t->row, t->column};
      bool is_place = false;
      for (int q = 0; q < 3; ++q)
        if (strcmp(order[d], own[q]) == 0) {
          at[q] = index;
          is_place = true;
        }
      last = last && (is_place || index + 1 == length[d]);
    }
    values[n] =
        (last ? 1.0 : -1.0) * value_at(t, 2 + k, (at[0] * ALONG + at[1]) * ALONG + at[2]);
  }
  sample_put(f, v, values);
  free(values);
}

static void write_tiles(sample_file *f, const tiled *t)
{
  static double values[MOST_POINTS];
  sample_begin(f, NC_CLASSIC_MODEL);
  const int dimension[3] = {dimension_of(f, t->tile, t->tiles),
                            dimension_of(f, t->row, ALONG),
                            dimension_of(f, t->column, ALONG)};
  for (int k = 0; k < 2; ++k) {
    const int v = sample_variable(f, t->place[k], NC_DOUBLE, 3, dimension);
    sample_text(f, v, "units", k == 0 ? "degrees_east" : "degrees_north");
    for (size_t n = 0; n < t->tiles * ALONG * ALONG; ++n)
      values[n] = value_at(t, k, n);
    sample_put(f, v, values);
  }
  for (int k = 0; k < 2; ++k)
    put_component(f, t, k);
  sample_end(f);
}

static void tiles_are_one_sphere(void **state)
{
  sample_file *f = *state;
  for (size_t n = 0; n < sizeof FILES / sizeof *FILES; ++n) {
    const tiled *t = &FILES[n];
    const bool levels = strstr(t->dimensions, "lev") || strstr(t->dimensions, "pfull");
    const fg_read_options options = {.frame = t->frame, .level = levels};
    write_tiles(f, t);
    if (t->refused) {
      refuse_with(f, &options, FG_STATUS_UNSUPPORTED, t->refused);
      continue;
    }
    fg_field *field = read_with(f, &options);
    const fg_field_arrays *a = fg_field_contents(field);
    assert_near(field, 2000, 3e-3);
    if (t->tiles == 6)
      assert_true(a->period[0] > 0.0 && !a->valid);
    fg_field_destroy(field);
  }
}

/* One tile by its number is the curvilinear grid that it is. */
static void one_tile(void **state)
{
  sample_file *f = *state;
  write_tiles(f, &FILES[0]);
  fg_field *field = read_with(f, &(fg_read_options){.at = "nf=0", .level = 1});
  assert_near(field, 500, 3e-3);
  assert_true(fg_field_contents(field)->period[0] == 0.0);
  fg_field_destroy(field);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test_setup_teardown(tiles_are_one_sphere, sample_set_up,
                                      sample_tear_down),
      cmocka_unit_test_setup_teardown(one_tile, sample_set_up, sample_tear_down),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
