/* The raster of domains that fill all of their box, and little of it. */
#include "critical/field_test.h"
#include "critical/raster.h"

/* The corner of a box along two of its faces. */
static void corner(const double position[3], double v[3])
{
  swirl(position, v);
  if (position[0] > 0.16 && position[1] > 0.16)
    v[0] = (double)NAN;
}

static double measure_of_cells(const fg__domain_raster *raster)
{
  double cells = 0.0;
  for (size_t n = 0; n < raster->cells; ++n)
    cells += raster->inside[n];
  return cells * raster->cell[0] * raster->cell[1] * raster->cell[2];
}

typedef struct expected {
  sampling box;
  velocity_of velocity;
  double measure, least, most; /* cells along a side of as large a square or cube */
} expected;

static void cells_are_wider_where_the_domain_fills_little_of_its_box(void **state)
{
  static const expected rasters[] = {
      {{.dimension = 2, .nodes = {9, 5}, .high = {8, 4}}, swirl, 32, 256, 256},
      {{.dimension = 3, .nodes = {5, 5, 3}, .high = {4, 4, 2}}, swirl, 32, 64, 64},
      {{.dimension = 2, .nodes = {257, 257}, .high = {12.8, 12.8}},
       corner,
       3.8175,
       180,
       205},
      {{.dimension = 3, .nodes = {257, 257, 3}, .high = {12.8, 12.8, 2}},
       corner,
       7.635,
       30,
       36},
  };
  for (size_t n = 0; n < sizeof rasters / sizeof rasters[0]; ++n) {
    const expected *e = &rasters[n];
    fg__domain_raster raster;
    fg_field *field = field_of(*state, &e->box, e->velocity);
    assert_int_equal(fg__domain_raster_create(&raster, *state, field, NULL),
                     FG_STATUS_OK);
    assert_close(raster.measure, e->measure, 1e-9);
    assert_close(measure_of_cells(&raster) / e->measure, 1.0, 0.2);
    const double cells = raster.side / raster.spacing;
    assert_in_range((int)(cells + 0.5), (int)e->least, (int)e->most);
    assert_true(raster.cells <= 3 << 19);
    fg__domain_raster_clear(&raster);
    fg_field_destroy(field);
  }
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      CASE(cells_are_wider_where_the_domain_fills_little_of_its_box),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
