/* A mesh for tests and the fuzzers' corpus: a lattice of quads on the sphere, some
 * divided into triangles, and a flow on it. */
#ifndef FG__MESH_EXAMPLE_H
#define FG__MESH_EXAMPLE_H

#include <math.h>

#include "base/context_test.h"
#include "read/netcdf/sample_example.h"

#define RADIANS 0.017453292519943295

enum {
  SIDE = 16,
  NODES = (SIDE + 1) * (SIDE + 1),
  MOST_FACES = 2 * SIDE * SIDE,
  CORNERS = 4
};

static const double FLOW[3][3] = {{0.9, -0.8, -0.4}, {0.7, -0.6, -0.5}, {0.3, 0.6, 0.2}};

/* Shear and strain: a linear map of space, without its part upwards. */
static inline void flow_at(double out[2], double longitude, double latitude)
{
  const double s = sin(longitude * RADIANS), c = cos(longitude * RADIANS);
  const double sine = sin(latitude * RADIANS), cosine = cos(latitude * RADIANS);
  const double at[3] = {cosine * c, cosine * s, sine};
  double w[3];
  for (int k = 0; k < 3; ++k)
    w[k] = FLOW[k][0] * at[0] + FLOW[k][1] * at[1] + FLOW[k][2] * at[2];
  out[0] = -s * w[0] + c * w[1];
  out[1] = -sine * (c * w[0] + s * w[1]) + cosine * w[2];
}

/* A mesh across the antimeridian; with `divided`, every third quad is two triangles,
 * which a fill value ends. */
typedef struct example_mesh {
  double node[2][NODES], centre[2][MOST_FACES];
  double corner[MOST_FACES * CORNERS];
  size_t faces;
} example_mesh;

static const double WEST = 160.0, SOUTH = 30.0, STEP = 2.5, FILL = -1.0;

static inline void add_face(example_mesh *m, const int *corner, int count, int start)
{
  for (int k = 0; k < 2; ++k)
    m->centre[k][m->faces] = 0.0;
  for (int c = 0; c < CORNERS; ++c) {
    m->corner[m->faces * CORNERS + (size_t)c] = c < count ? corner[c] + start : FILL;
    for (int k = 0; k < 2 && c < count; ++k)
      m->centre[k][m->faces] += m->node[k][corner[c]] / count;
  }
  ++m->faces;
}

static inline example_mesh mesh_made(int start, bool divided)
{
  example_mesh m = {.faces = 0};
  for (int n = 0; n < NODES; ++n) {
    const int i = n % (SIDE + 1), j = n / (SIDE + 1);
    m.node[0][n] = WEST + STEP * (i + 0.2 * sin(3.0 * j));
    m.node[1][n] = SOUTH + STEP * (j + 0.2 * sin(2.0 * i));
  }
  for (int q = 0; q < SIDE * SIDE; ++q) {
    const int a = q / SIDE * (SIDE + 1) + q % SIDE;
    const int quad[4] = {a, a + 1, a + SIDE + 2, a + SIDE + 1};
    const int half[3] = {quad[0], quad[2], quad[3]};
    add_face(&m, quad, divided && q % 3 == 0 ? 3 : 4, start);
    if (divided && q % 3 == 0)
      add_face(&m, half, 3, start);
  }
  return m;
}

/* A variable of the file with an attribute or two. */
typedef struct attributes {
  const char *name, *value, *other, *text;
} attributes;

static inline int put(const sample_file *f, const char *name, nc_type type, int rank,
                      const int *dimensions, const double *values, attributes with)
{
  const int id = sample_variable(f, name, type, rank, dimensions);
  if (with.name)
    sample_text(f, id, with.name, with.value);
  if (with.other)
    sample_text(f, id, with.other, with.text);
  sample_put(f, id, values);
  return id;
}

/* The flow at places, as two variables along one dimension. */
static inline void put_flow(const sample_file *f, const char *const name[2],
                            int dimension, size_t count, double *const at[2],
                            const double *hole, attributes with)
{
  double *values = malloc(count * sizeof *values);
  assert_non_null(values);
  for (int k = 0; k < 2; ++k) {
    for (size_t n = 0; n < count; ++n) {
      double flow[2];
      flow_at(flow, at[0][n], at[1][n]);
      values[n] = hole && hole[n] > 0.0 ? NC_FILL_DOUBLE : flow[k];
    }
    put(f, name[k], NC_DOUBLE, 1, &dimension, values, with);
  }
  free(values);
}

static const attributes EAST = {"units", "degrees_east", NULL, NULL};
static const attributes NORTH = {"units", "degrees_north", NULL, NULL};
static const attributes NOTHING = {NULL, NULL, NULL, NULL};

static const char *const U_V[] = {"u", "v"};
static const char *const LON_LAT[] = {"lon", "lat"};

/* Positions as two variables, times a factor, such as that of radians. */
static inline void put_places(const sample_file *f, const char *const name[2],
                              int dimension, size_t count, double *const at[2],
                              double factor)
{
  double *values = malloc(count * sizeof *values);
  assert_non_null(values);
  for (int k = 0; k < 2; ++k) {
    for (size_t n = 0; n < count; ++n)
      values[n] = at[k][n] * factor;
    put(f, name[k], NC_DOUBLE, 1, &dimension, values,
        factor < 1.0 ? NOTHING
        : k == 0     ? EAST
                     : NORTH);
  }
  free(values);
}

static inline int put_topology(const sample_file *f, const char *names)
{
  const int id = sample_variable(f, "mesh", NC_INT, 0, NULL);
  sample_text(f, id, "cf_role", "mesh_topology");
  sample_number(f, id, "topology_dimension", NC_INT, 2.0);
  sample_text(f, id, "node_coordinates", names);
  sample_text(f, id, "face_node_connectivity", "nodes_of_faces");
  return id;
}

static inline int put_corners(const sample_file *f, const char *name,
                              const example_mesh *m, int faces, int corners, bool turned)
{
  double values[MOST_FACES * CORNERS];
  const int dimension[2] = {turned ? corners : faces, turned ? faces : corners};
  for (size_t n = 0; n < m->faces * CORNERS; ++n)
    values[turned ? n % CORNERS * m->faces + n / CORNERS : n] = m->corner[n];
  const int id = sample_variable(f, name, NC_INT, 2, dimension);
  sample_number(f, id, "_FillValue", NC_INT, FILL);
  sample_put(f, id, values);
  return id;
}

/* Every sample is the flow's; returns how many have a value. */
static inline size_t assert_flow(const fg_field *field, double tolerance)
{
  const fg_field_arrays *a = fg_field_contents(field);
  size_t found = 0;
  for (int j = 0; j < a->size[1]; ++j)
    for (int i = 0; i < a->size[0]; ++i) {
      const size_t n = (size_t)j * (size_t)a->size[0] + (size_t)i;
      double flow[2];
      flow_at(flow, a->axis[0][i], a->axis[1][j]);
      if (isnan(a->velocity[0][n]))
        continue;
      ++found;
      if (hypot((double)a->velocity[0][n] - flow[0],
                (double)a->velocity[1][n] - flow[1]) > tolerance)
        fail_msg("at %g, %g: %g, %g instead of %g, %g", a->axis[0][i], a->axis[1][j],
                 (double)a->velocity[0][n], (double)a->velocity[1][n], flow[0], flow[1]);
    }
  return found;
}

#endif
