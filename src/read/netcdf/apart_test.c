/* Unstructured meshes in a file of their own. */
#include "read/netcdf/mesh_example.h"

/* Begins a file beside the sample's. */
static sample_file file_beside(const sample_file *f, const char *name)
{
  sample_file other = *f;
  snprintf(other.path, sizeof other.path, "%s/%s", f->folder, name);
  sample_begin(&other, NC_NETCDF4);
  return other;
}

/* SCHISM from 5.10: each component in a file of its own, and the mesh in a third, with
 * which nodes are dry at a time. The mesh file's own vectors are not meant. */
static void components_and_mesh_in_three_files(void **state)
{
  static const char *const names[] = {"horizontalVelX", "horizontalVelY"};
  enum { DRY = 4 * (SIDE + 1) + 8 };
  static const double dry[2 * NODES] = {[NODES + DRY] = 1.0};
  static double values[2 * NODES * 2];
  sample_file *f = *state;
  example_mesh m = mesh_made(1, true);
  double *const node[2] = {m.node[0], m.node[1]};
  sample_file part[2] = {*f, *f};
  for (int k = 0; k < 2; ++k) {
    if (k == 0)
      sample_begin(&part[0], NC_NETCDF4);
    else
      part[1] = file_beside(f, "second.nc");
    const int all[3] = {sample_dimension(&part[k], "time", 2),
                        sample_dimension(&part[k], "nSCHISM_hgrid_node", NODES),
                        sample_dimension(&part[k], "nSCHISM_vgrid_layers", 2)};
    for (int n = 0; n < 2 * NODES; ++n) {
      double flow[2];
      flow_at(flow, m.node[0][n % NODES], m.node[1][n % NODES]);
      values[2 * n] = -7.0;
      values[2 * n + 1] = n < NODES ? -flow[k] : flow[k];
    }
    put(&part[k], names[k], NC_FLOAT, 3, all, values,
        (attributes){"mesh", "mesh", "location", "node"});
    sample_end(&part[k]);
  }
  sample_file third = file_beside(f, "mesh.nc");
  const int of_dry[2] = {sample_dimension(&third, "time", 2),
                         sample_dimension(&third, "nSCHISM_hgrid_node", NODES)};
  const int faces = sample_dimension(&third, "faces", m.faces);
  const int corners = sample_dimension(&third, "corners", CORNERS);
  put_topology(&third, "lon lat");
  put_corners(&third, "nodes_of_faces", &m, faces, corners, false);
  put_places(&third, LON_LAT, of_dry[1], NODES, node, 1.0);
  put(&third, "dryFlagNode", NC_DOUBLE, 2, of_dry, dry, NOTHING);
  put_flow(&third, U_V, of_dry[1], NODES, node, NULL, NOTHING);
  sample_end(&third);
  const fg_read_options all = {
      .vars_from = part[1].path, .mesh_from = third.path, .time = 1, .level = 1};
  *f = part[0];
  for (int time = 0; time < 2; ++time) {
    fg_read_options options = all;
    double velocity[2];
    options.time = time;
    fg_field *field = read_with(f, &options);
    assert_string_equal(fg_field_contents(field)->velocity_name[0], names[0]);
    assert_true(time == 0 || assert_flow(field, 2e-3) > 150);
    assert_int_equal(
        fg_field_velocity(field, (double[]){m.node[0][DRY], m.node[1][DRY]}, velocity),
        time == 0);
    fg_field_destroy(field);
  }
  refuse_with(f, &(fg_read_options){.vars_from = part[1].path}, FG_STATUS_UNSUPPORTED,
              "lies on the mesh 'mesh', which is not in the file");
  assert_non_null(strstr(fg_context_hint(f->context), "--mesh-from"));
  unlink(part[1].path);
  unlink(third.path);
}

/* Components whose files have nodes each, which have to be the same. */
static void components_at_other_nodes_are_refused(void **state)
{
  sample_file *f = *state;
  for (int far = 0; far < 2; ++far) {
    example_mesh m = mesh_made(0, true);
    double *const node[2] = {m.node[0], m.node[1]};
    sample_begin(f, NC_NETCDF4);
    sample_file file[2] = {*f, file_beside(f, "second.nc")};
    for (int k = 0; k < 2; ++k) {
      for (int n = 0; n < NODES && k == 1; ++n)
        m.node[0][n] += far ? 3.0 : 360.0;
      const int nodes = sample_dimension(&file[k], "nodes", NODES);
      put_places(&file[k], LON_LAT, nodes, NODES, node, 1.0);
      put(&file[k], U_V[k], NC_DOUBLE, 1, &nodes, m.node[1],
          (attributes){"coordinates", "lon lat", NULL, NULL});
      sample_end(&file[k]);
    }
    const fg_read_options options = {.vars_from = file[1].path};
    if (far)
      refuse_with(f, &options, FG_STATUS_UNSUPPORTED,
                  "second.nc lie more than half a cell apart");
    else
      fg_field_destroy(read_with(f, &options));
    unlink(file[1].path);
  }
}

/* A file with the mesh that is not needed is refused as the wrong one. */
static void a_mesh_that_is_not_used_is_refused(void **state)
{
  sample_file *f = *state;
  example_mesh m = mesh_made(0, true);
  double *const node[2] = {m.node[0], m.node[1]};
  sample_file other = file_beside(f, "mesh.nc");
  const int beside = sample_dimension(&other, "elsewhere", 3);
  put(&other, "salt", NC_DOUBLE, 1, &beside, m.node[0], NOTHING);
  sample_end(&other);
  sample_begin(f, NC_NETCDF4);
  const int nodes = sample_dimension(f, "nodes", NODES);
  put_places(f, LON_LAT, nodes, NODES, node, 1.0);
  put_flow(f, U_V, nodes, NODES, node, NULL,
           (attributes){"coordinates", "lon lat", NULL, NULL});
  sample_end(f);
  fg_field *field = NULL;
  assert_int_equal(fg_field_read(&field, f->context, f->path,
                                 &(fg_read_options){.mesh_from = other.path}),
                   FG_STATUS_ARGUMENT);
  assert_non_null(strstr(fg_context_message(f->context), "mesh.nc: gives no position"));
  unlink(other.path);
}

/* Vectors along one dimension, whose mesh is in a file that is not given: it is named,
 * and no plane of times or levels is read. */
static void absent_meshes_are_named(void **state)
{
  static const struct {
    attributes of;
    const char *words;
  } cases[] = {
      {{"mesh", "SCHISM_hgrid", NULL, NULL}, "lies on the mesh 'SCHISM_hgrid', which is"},
      {{"CDI_grid_type", "unstructured", NULL, NULL}, "an unstructured grid (CDI_grid"}};
  static double values[2 * NODES];
  sample_file *f = *state;
  for (size_t n = 0; n < sizeof cases / sizeof *cases; ++n) {
    sample_begin(f, 0);
    const int dimension[2] = {sample_dimension(f, "layers", 2),
                              sample_dimension(f, "nodes", NODES)};
    for (int k = 0; k < 2; ++k)
      put(f, U_V[k], NC_DOUBLE, 2, dimension, values, cases[n].of);
    sample_end(f);
    refuse_with(f, NULL, FG_STATUS_UNSUPPORTED, cases[n].words);
    assert_non_null(strstr(fg_context_hint(f->context), "--mesh-from"));
  }
}

int main(void)
{
#define CASE(name) cmocka_unit_test_setup_teardown(name, sample_set_up, sample_tear_down)
  const struct CMUnitTest tests[] = {
      CASE(components_and_mesh_in_three_files),
      CASE(components_at_other_nodes_are_refused),
      CASE(a_mesh_that_is_not_used_is_refused),
      CASE(absent_meshes_are_named),
  };
  return cmocka_run_group_tests_name("read/netcdf/apart", tests, NULL, NULL);
}
