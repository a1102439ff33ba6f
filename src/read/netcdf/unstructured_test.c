/* Unstructured meshes as models write them, each with its own names, made of one lattice
 * of quads on the sphere, some divided into triangles, and one flow: what is read is that
 * flow, to the error of interpolation, which falls with the square of the spacing. */
#include "read/netcdf/mesh_example.h"
#include "sample/unstructured/mesh.h"

static void assert_rule(sample_file *f, const char *words)
{
  fg_inventory *inventory;
  if (fg_inventory_read(&inventory, f->context, f->path) != FG_STATUS_OK)
    fail_msg("%s", fg_context_message(f->context));
  const fg_inventory_vector *vector = fg_inventory_vector_at(inventory, 0);
  if (!vector->frame || !strstr(vector->frame, words))
    fail_msg("\"%s\" lacks \"%s\" (%s)", vector->frame ? vector->frame : "", words,
             vector->unusable ? vector->unusable : "");
  fg_inventory_destroy(inventory);
}

/* Values within the faces: next to the rim they are those of the face. */
static void read_and_compare(sample_file *f, const char *vars, double tolerance,
                             const char *rule)
{
  fg_field *field = read_with(f, &(fg_read_options){.vars = vars});
  assert_true(assert_flow(field, tolerance) > 150);
  fg_field_destroy(field);
  assert_rule(f, rule);
}

/* Of nodes and of faces, counted from 0 and from 1, by rows and by columns. */
static void ugrid(void **state)
{
  sample_file *f = *state;
  for (int n = 0; n < 4; ++n) {
    const int start = n & 1;
    const bool turned = n >> 1, at_nodes = turned != (start == 1);
    example_mesh m = mesh_made(start, true);
    double *const node[2] = {m.node[0], m.node[1]};
    double *const centre[2] = {m.centre[0], m.centre[1]};
    sample_begin(f, NC_NETCDF4);
    const int nodes = sample_dimension(f, "nodes", NODES);
    const int faces = sample_dimension(f, "faces", m.faces);
    const int corners = sample_dimension(f, "corners", CORNERS);
    put_topology(f, "lat lon");
    put_corners(f, "nodes_of_faces", &m, faces, corners, turned);
    put_places(f, LON_LAT, nodes, NODES, node, 1.0);
    put_flow(f, U_V, at_nodes ? nodes : faces, at_nodes ? NODES : m.faces,
             at_nodes ? node : centre, NULL, (attributes){"mesh", "mesh", NULL, NULL});
    sample_end(f);
    read_and_compare(f, NULL, at_nodes ? 2e-3 : 5e-2,
                     at_nodes ? "on the nodes of the mesh 'mesh' (cf_role"
                              : "on the faces of the mesh 'mesh' (cf_role");
  }
}

/* Cells with their own corners, in radians; some have no value, and the field ends at
 * their sides. A point amid four cells without a value has none. */
static void cells_with_bounds(void **state)
{
  sample_file *f = *state;
  example_mesh m = mesh_made(0, false);
  double *const centre[2] = {m.centre[0], m.centre[1]};
  double bounds[2][MOST_FACES * CORNERS], hole[MOST_FACES];
  for (size_t n = 0; n < m.faces * CORNERS; ++n)
    for (int k = 0; k < 2; ++k)
      bounds[k][n] = m.node[k][(int)m.corner[n]] * RADIANS -
                     (k == 0 && n % 7 == 0) * 360.0 * RADIANS;
  for (size_t n = 0; n < m.faces; ++n)
    hole[n] = n / SIDE >= 6 && n / SIDE < 10 && n % SIDE >= 6 && n % SIDE < 10;
  sample_begin(f, 0);
  const int dimension[2] = {sample_dimension(f, "ncells", m.faces),
                            sample_dimension(f, "vertices", CORNERS)};
  static const char *const name[2][2] = {{"clon", "clat"}, {"clon_b", "clat_b"}};
  static const char *const word[2] = {"longitude", "latitude"};
  for (int k = 0; k < 2; ++k) {
    double radians[MOST_FACES];
    for (size_t n = 0; n < m.faces; ++n)
      radians[n] = m.centre[k][n] * RADIANS;
    const int id = put(f, name[0][k], NC_DOUBLE, 1, dimension, radians,
                       (attributes){"units", "radian", "bounds", name[1][k]});
    sample_text(f, id, "standard_name", word[k]);
    put(f, name[1][k], NC_DOUBLE, 2, dimension, bounds[k], NOTHING);
  }
  put_flow(f, U_V, dimension[0], m.faces, centre, hole,
           (attributes){"coordinates", "clat clon", "CDI_grid_type", "unstructured"});
  sample_end(f);
  read_and_compare(f, NULL, 5e-2, "on cells at 'clon', 'clat' with 4 corners ('clon_b')");
  fg_field *field = read_with(f, NULL);
  const fg_field_arrays *a = fg_field_contents(field);
  size_t holes = 0, inside = 0;
  for (int j = 0; j < a->size[1]; ++j)
    for (int i = 0; i < a->size[0]; ++i) {
      const double x = (a->axis[0][i] - WEST) / STEP, y = (a->axis[1][j] - SOUTH) / STEP;
      if (!(x > 6.3 && x < 9.7 && y > 6.3 && y < 9.7))
        continue;
      ++inside;
      holes += isnan(a->velocity[0][j * a->size[0] + i]) != 0;
    }
  assert_true(inside > 4 && holes == inside);
  fg_field_destroy(field);
}

/* Cells' centres alone. */
static void points_alone(void **state)
{
  sample_file *f = *state;
  example_mesh m = mesh_made(0, true);
  double *const centre[2] = {m.centre[0], m.centre[1]};
  sample_begin(f, 0);
  const int cells = sample_dimension(f, "ncol", m.faces);
  put_places(f, LON_LAT, cells, m.faces, centre, 1.0);
  put_flow(f, U_V, cells, m.faces, centre, NULL, NOTHING);
  sample_end(f);
  read_and_compare(f, NULL, 4e-3, "on points at 'lon', 'lat', triangulated");
}

/* Places at times, one after the other or as an array [trajectories][places], which is no
 * grid. */
static void points_of_trajectories(void **state)
{
  sample_file *f = *state;
  for (int rank = 1; rank <= 2; ++rank) {
    example_mesh m = mesh_made(0, false);
    const size_t along = rank == 1 ? m.faces : SIDE;
    double values[5][SIDE * SIDE];
    for (size_t n = 0; n < m.faces; ++n) {
      double flow[2];
      const size_t from = n * 7 % m.faces; /* neighbours lie apart */
      flow_at(flow, m.centre[0][from], m.centre[1][from]);
      for (int k = 0; k < 2; ++k) {
        values[k][n] = m.centre[k][from];
        values[2 + k][n] = flow[k];
      }
      values[4][n] = (double)n;
    }
    sample_begin(f, 0);
    const int dimension[2] = {sample_dimension(f, "trajectory", SIDE),
                              sample_dimension(f, "obs", along)};
    static const char *const names[] = {"lon", "lat", "u", "v", "time"};
    static const char *const units[] = {"degrees_east", "degrees_north", "m/s", "m/s",
                                        "days since 2020-01-01"};
    sample_text(f, NC_GLOBAL, "featureType", "trajectory");
    for (int k = 0; k < 5; ++k)
      put(f, names[k], NC_DOUBLE, rank, dimension + 2 - rank, values[k],
          (attributes){"units", units[k], NULL, NULL});
    sample_end(f);
    read_and_compare(f, NULL, 4e-3,
                     rank == 1 ? "on points at 'lon', 'lat' at all their times"
                               : "on points of trajectories at 'lon', 'lat' at all");
  }
}

/* Without the mesh the points would be joined across its holes. */
static void wavewatch(void **state)
{
  sample_file *f = *state;
  example_mesh m = mesh_made(1, true);
  double *const node[2] = {m.node[0], m.node[1]};
  sample_begin(f, NC_NETCDF4);
  const int nodes = sample_dimension(f, "node", NODES);
  put_corners(f, "tri", &m, sample_dimension(f, "element", m.faces),
              sample_dimension(f, "noel", CORNERS), false);
  put_places(f, (const char *const[]){"longitude", "latitude"}, nodes, NODES, node, 1.0);
  put_flow(f, (const char *const[]){"uwnd", "vwnd"}, nodes, NODES, node, NULL, NOTHING);
  sample_end(f);
  read_and_compare(f, NULL, 2e-3, "on the nodes of a mesh of triangles ('tri' with 'lon");
}

/* Radians without a word about it, polygons whose rows are filled with anything; numbers
 * along the axes of space are no map's. */
static void mpas(void **state)
{
  static const char *const at_cells[] = {"lonCell", "latCell"};
  static const char *const at_vertices[] = {"lonVertex", "latVertex"};
  static const char *const zonal[] = {"uReconstructZonal", "uReconstructMeridional"};
  static const char *const in_space[] = {"uReconstructX", "uReconstructY"};
  sample_file *f = *state;
  example_mesh m = mesh_made(1, true);
  double *const node[2] = {m.node[0], m.node[1]};
  double *const centre[2] = {m.centre[0], m.centre[1]};
  double count[MOST_FACES];
  for (size_t n = 0; n < m.faces; ++n) {
    count[n] = m.corner[n * CORNERS + 3] < 0.0 ? 3.0 : 4.0;
    if (count[n] < 4.0)
      m.corner[n * CORNERS + 3] = 7.0;
  }
  char mesh[128];
  snprintf(mesh, sizeof mesh, "%s.mesh", f->path);
  for (int apart = 1; apart >= 0; --apart) {
    sample_begin(f, 0);
    const int cells = sample_dimension(f, "nCells", m.faces);
    const int vertices = sample_dimension(f, "nVertices", NODES);
    const int edges = sample_dimension(f, "maxEdges", CORNERS);
    put_corners(f, "verticesOnCell", &m, cells, edges, false);
    put(f, "nEdgesOnCell", NC_INT, 1, &cells, count, NOTHING);
    put_places(f, at_cells, cells, m.faces, centre, RADIANS);
    put_places(f, at_vertices, vertices, NODES, node, RADIANS);
    if (apart) {
      sample_end(f);
      assert_int_equal(rename(f->path, mesh), 0);
      sample_begin(f, 0);
    }
    const int own = apart ? sample_dimension(f, "nCells", m.faces) : cells;
    put_flow(f, zonal, own, m.faces, centre, NULL, NOTHING);
    put_flow(f, in_space, own, m.faces, centre, NULL, NOTHING);
    sample_end(f);
    if (apart)
      refuse_with(f, NULL, FG_STATUS_UNSUPPORTED,
                  "lonCell and latCell are not in the file");
    fg_field *field = read_with(f, &(fg_read_options){.vars_from = apart ? mesh : NULL});
    assert_true(assert_flow(field, 5e-2) > 150);
    fg_field_destroy(field);
  }
  unlink(mesh);
  assert_rule(f, "on the cells of an MPAS mesh (verticesOnCell)");
  refuse_with(f, &(fg_read_options){.vars = "uReconstructX,uReconstructY"},
              FG_STATUS_UNSUPPORTED, "along an axis in space");
}

/* FVCOM in its plane of metres, where longitudes are all 0: what is linear is so between
 * the centres. Dry cells have no value; level 1 is half of level 0. */
static void fvcom_in_metres(void **state)
{
  static const char *const x_y[] = {"x", "y"}, *const xc_yc[] = {"xc", "yc"};
  sample_file *f = *state;
  example_mesh m = mesh_made(1, false);
  double *const node[2] = {m.node[0], m.node[1]};
  double *const centre[2] = {m.centre[0], m.centre[1]};
  double zero[NODES] = {0.0}, values[2 * MOST_FACES], wet[MOST_FACES];
  sample_begin(f, 0);
  const int nodes = sample_dimension(f, "node", NODES);
  const int corners = sample_dimension(f, "three", CORNERS);
  const int cells[] = {sample_dimension(f, "time", NC_UNLIMITED),
                       sample_dimension(f, "siglay", 2),
                       sample_dimension(f, "nele", m.faces)};
  put_corners(f, "nv", &m, cells[2], corners, true);
  for (int k = 0; k < 2; ++k) {
    put(f, LON_LAT[k], NC_DOUBLE, 1, &nodes, zero, k == 0 ? EAST : NORTH);
    put(f, x_y[k], NC_DOUBLE, 1, &nodes, node[k],
        (attributes){"units", "meters", NULL, NULL});
    put(f, xc_yc[k], NC_DOUBLE, 1, &cells[2], centre[k],
        (attributes){"units", "meters", NULL, NULL});
  }
  for (size_t n = 0; n < m.faces; ++n)
    wet[n] = n % SIDE < 4 ? 0.0 : 1.0;
  put(f, "wet_cells", NC_INT, 1, &cells[2], wet, NOTHING);
  sample_text(f, NC_GLOBAL, "CoordinateProjection", "proj=utm +ellps=WGS84 +zone=19");
  for (int k = 0; k < 2; ++k) {
    for (size_t n = 0; n < 2 * m.faces; ++n)
      values[n] = (centre[k][n % m.faces] + 2.0 * centre[1 - k][n % m.faces]) *
                  (n < m.faces ? 1.0 : 0.5);
    const int id = sample_variable(f, U_V[k], NC_DOUBLE, 3, cells);
    const size_t start[3] = {0, 0, 0}, count[3] = {1, 2, m.faces};
    sample_write(f);
    nc_must(nc_put_vara_double(f->id, id, start, count, values));
  }
  sample_end(f);
  for (int level = 0; level < 2; ++level) {
    fg_field *field = read_with(f, &(fg_read_options){.level = level});
    const fg_field_arrays *a = fg_field_contents(field);
    size_t found = 0;
    assert_int_equal(a->scale, FG_SCALE_MAP);
    assert_string_equal(a->axis_units[0], "m");
    if (fg_has_feature(FG_FEATURE_MAPS))
      assert_string_equal(a->projection, "+proj=utm +ellps=WGS84 +zone=19");
    assert_true(a->axis[0][0] > WEST + 3.0 * STEP);
    for (int n = 0; n < a->size[0] * a->size[1]; ++n) {
      const double x = a->axis[0][n % a->size[0]], y = a->axis[1][n / a->size[0]];
      const double expected = (x + 2.0 * y) * (level ? 0.5 : 1.0);
      if (isnan(a->velocity[0][n]))
        continue;
      ++found;
      if (x > WEST + 6.0 * STEP && x < WEST + 14.0 * STEP && y > SOUTH + 2.0 * STEP &&
          y < SOUTH + 14.0 * STEP)
        assert_float_equal(a->velocity[0][n], expected, 0.02);
    }
    assert_true(found > 100);
    fg_field_destroy(field);
  }
  assert_rule(f,
              "along x and y, on the faces of a mesh of triangles ('nv' with 'x', 'y')");
}

/* Places and numbers that healpy's documentation gives. */
static void healpix_numbers(void **state)
{
  (void)state;
  static const long long ring[] = {1440, 427, 1520, 0, 3068};
  static const double theta[] = {1.52911759, 0.78550497, 1.57079633, 0.05103658,
                                 3.09055608};
  static const double phi[] = {0.0, 0.78539816, 1.61988371, 0.78539816, 0.78539816};
  for (int n = 0; n < 5; ++n) {
    double at[2];
    const fg__healpix_pixel p = fg__healpix_find(16, ring[n], false);
    fg__healpix_place(at, 16, p.base, (double)p.x + 0.5, (double)p.y + 0.5);
    assert_true(fabs(90.0 - at[1] - theta[n] / RADIANS) < 1e-6);
    assert_true(fabs(remainder(at[0] - phi[n] / RADIANS, 360.0)) < 1e-6);
  }
  static const long long of_nested[] = {13, 5, 4, 0, 15, 7, 6, 1, 17, 9};
  for (int n = 0; n < 10; ++n) {
    const fg__healpix_pixel a = fg__healpix_find(2, n, true);
    const fg__healpix_pixel b = fg__healpix_find(2, of_nested[n], false);
    assert_true(a.base == b.base && a.x == b.x && a.y == b.y);
  }
  unsigned char seen[12 * 8 * 8] = {0};
  for (int n = 0; n < 12 * 8 * 8; ++n) {
    const fg__healpix_pixel p = fg__healpix_find(8, n, false);
    ++seen[p.base * 64 + p.y * 8 + p.x];
  }
  for (int n = 0; n < 12 * 8 * 8; ++n)
    assert_int_equal(seen[n], 1);
}

/* The whole sphere, and the second half of its cells by their numbers: the southern
 * hemisphere and more. */
static void healpix_files(void **state)
{
  enum { PIXELS = 12 * 16 * 16 };
  static double at[2][PIXELS], number[PIXELS];
  double *const places[2] = {at[0], at[1]};
  sample_file *f = *state;
  for (int n = 0; n < 4; ++n) {
    const bool nested = n & 1;
    const int first = n >> 1 ? PIXELS / 2 : 0, count = PIXELS - first;
    for (int i = 0; i < count; ++i) {
      double place[2];
      const fg__healpix_pixel p = fg__healpix_find(16, first + i, nested);
      number[i] = first + i;
      fg__healpix_place(place, 16, p.base, (double)p.x + 0.5, (double)p.y + 0.5);
      at[0][i] = place[0];
      at[1][i] = place[1];
    }
    sample_begin(f, NC_NETCDF4);
    const int cell = sample_dimension(f, "cell", (size_t)count);
    const int crs = sample_variable(f, "crs", NC_INT, 0, NULL);
    sample_text(f, crs, "grid_mapping_name", "healpix");
    sample_number(f, crs, nested ? "refinement_level" : "healpix_nside", NC_INT,
                  nested ? 4.0 : 16.0);
    if (n < 3)
      sample_text(f, crs, nested ? "indexing_scheme" : "healpix_order",
                  nested ? "nested" : "ring");
    if (first > 0)
      put(f, "cell", NC_INT, 1, &cell, number, NOTHING);
    put_flow(f, U_V, cell, (size_t)count, places, NULL,
             (attributes){"grid_mapping", "crs", NULL, NULL});
    sample_end(f);
    if (n == 3) {
      refuse_with(f, NULL, FG_STATUS_UNSUPPORTED, "in ring or nested order");
      continue;
    }
    fg_field *field = read_with(f, NULL);
    assert_true(assert_flow(field, first ? 5e-2 : 5e-3) > 1000);
    fg_field_destroy(field);
    assert_rule(f, nested ? "N_side 16, nested order (indexing_scheme of 'crs')"
                          : "N_side 16, ring order (healpix_order of 'crs')");
  }
}

/* A mesh with one thing wrong. */
static void faults_are_named(void **state)
{
  static const struct {
    const char *words;
    fg_status status;
  } faults[] = {
      {"'nodes_of_faces' has node 289 as a corner of face 5, but the nodes are 0 to 288",
       FG_STATUS_FILE_FORMAT},
      {"names 'nodes_of_faces' as its face_node_connectivity, which is not in the file",
       FG_STATUS_UNSUPPORTED},
      {"has no node_coordinates that are two arrays of one length",
       FG_STATUS_UNSUPPORTED},
      {"an unstructured mesh has no directions of its own", FG_STATUS_UNSUPPORTED},
      {"'v_node' does not lie on the dimensions of 'u'", FG_STATUS_UNSUPPORTED}};
  sample_file *f = *state;
  for (int n = 0; n < 5; ++n) {
    example_mesh m = mesh_made(0, false);
    double *const centre[2] = {m.centre[0], m.centre[1]};
    double *const node[2] = {m.node[0], m.node[1]};
    if (n == 0)
      m.corner[5 * CORNERS + 2] = NODES;
    sample_begin(f, NC_NETCDF4);
    const int nodes = sample_dimension(f, "nodes", NODES);
    const int faces = sample_dimension(f, "faces", m.faces);
    const int corners = sample_dimension(f, "corners", CORNERS);
    put_topology(f, n == 2 ? "lat" : "lat lon");
    const int id =
        put_corners(f, n == 1 ? "other" : "nodes_of_faces", &m, faces, corners, false);
    sample_number(f, id, "start_index", NC_INT, 0.0);
    put_places(f, LON_LAT, nodes, NODES, node, 1.0);
    put_flow(f, U_V, faces, m.faces, centre, NULL,
             (attributes){"mesh", "mesh", NULL, NULL});
    if (n == 4)
      put_flow(f, (const char *const[]){"u_node", "v_node"}, nodes, NODES, node, NULL,
               NOTHING);
    sample_end(f);
    refuse_with(f,
                &(fg_read_options){.frame = n == 3 ? FG_FRAME_GRID : FG_FRAME_AUTO,
                                   .vars = n == 4 ? "u,v_node" : NULL},
                faults[n].status, faults[n].words);
  }
}

/* SCHISM until 5.9: both components in one variable, by levels from the bottom up; here
 * the opposite flow lies at the bottom. */
static void vectors_of_one_variable(void **state)
{
  static double values[NODES * 2 * 2];
  sample_file *f = *state;
  example_mesh m = mesh_made(1, true);
  double *const node[2] = {m.node[0], m.node[1]};
  for (int n = 0; n < NODES; ++n) {
    double flow[2];
    flow_at(flow, m.node[0][n], m.node[1][n]);
    for (int k = 0; k < 4; ++k)
      values[4 * n + k] = k < 2 ? -flow[k] : flow[k - 2];
  }
  sample_begin(f, NC_NETCDF4);
  const int faces = sample_dimension(f, "faces", m.faces);
  const int corners = sample_dimension(f, "corners", CORNERS);
  const int all[3] = {sample_dimension(f, "nodes", NODES),
                      sample_dimension(f, "nSCHISM_vgrid_layers", 2),
                      sample_dimension(f, "two", 2)};
  put_topology(f, "lat lon");
  put_corners(f, "nodes_of_faces", &m, faces, corners, false);
  put_places(f, LON_LAT, all[0], NODES, node, 1.0);
  put(f, "hvel", NC_FLOAT, 3, all, values, (attributes){"mesh", "mesh", NULL, NULL});
  sample_end(f);
  fg_read_defaults defaults;
  assert_int_equal(fg_read_defaults_find(&defaults, f->context, f->path, NULL),
                   FG_STATUS_OK);
  assert_int_equal(defaults.level, 1);
  for (int named = 0; named < 2; ++named) {
    fg_field *field =
        read_with(f, &(fg_read_options){.level = 1, .vars = named ? "hvel" : NULL});
    assert_true(assert_flow(field, 2e-3) > 150);
    fg_field_destroy(field);
  }
  fg_inventory *inventory;
  assert_int_equal(fg_inventory_read(&inventory, f->context, f->path), FG_STATUS_OK);
  assert_int_equal(fg_inventory_vector_count(inventory), 1);
  const fg_inventory_vector *vector = fg_inventory_vector_at(inventory, 0);
  assert_string_equal(vector->name[0], "hvel");
  assert_true(vector->name[1] == NULL && vector->levels == 2);
  fg_inventory_destroy(inventory);
}

int main(void)
{
#define CASE(name) cmocka_unit_test_setup_teardown(name, sample_set_up, sample_tear_down)
  const struct CMUnitTest tests[] = {
      CASE(points_of_trajectories),
      CASE(ugrid),
      CASE(cells_with_bounds),
      CASE(points_alone),
      CASE(mpas),
      CASE(wavewatch),
      CASE(fvcom_in_metres),
      CASE(healpix_numbers),
      CASE(healpix_files),
      CASE(faults_are_named),
      CASE(vectors_of_one_variable),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
