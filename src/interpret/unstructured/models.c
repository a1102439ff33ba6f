/* Meshes of models by their names: MPAS, FVCOM, ADCIRC, WAVEWATCH III, and grid files of
 * ICON. */
#include "interpret/unstructured/unstructured.h"

#include <stdio.h>
#include <string.h>

static const fg__variable *array_named(const fg__dataset *data, const char *name,
                                       int rank)
{
  const fg__variable *v = fg__dataset_find(data, name);
  return v && fg__is_array(v) && v->rank == rank && strcmp(v->plain_name, name) == 0
             ? v
             : NULL;
}

static bool pair_named(const fg__variable *out[2], const fg__dataset *data, const char *x,
                       const char *y)
{
  out[0] = array_named(data, x, 1);
  out[1] = array_named(data, y, 1);
  return out[0] && out[1] &&
         fg__same_dimension(data, out[0]->dimension[0], out[1]->dimension[0]);
}

/* Not on a sphere: a text of the file, "NO". */
static bool is_flat(const fg__variable *at)
{
  char text[FG__TEXT_BYTES];
  const fg__variable *root = fg__file_of(at);
  return fg__attribute_text(root, "on_a_sphere", text, sizeof text) &&
         strncmp(text, "NO", 2) == 0;
}

/* MPAS (Ringler et al. 2010; "MPAS Mesh Specification"): vectors at the centres of
 * Voronoi cells, or at their corners. Those on edges are across and along them. */
static bool find_mpas(fg__unstructured *out, fg__mesh_search *search)
{
  const fg__dataset *data = search->data;
  const char *along = data->dimensions[search->u->dimension[search->k]].name;
  const fg__variable *cell[2];
  if (strncmp(along, "nCells", 6) != 0 && strcmp(along, "nVertices") != 0 &&
      strcmp(along, "nEdges") != 0)
    return false;
  if (!pair_named(cell, data, "lonCell", "latCell")) {
    snprintf(
        search->lacks, sizeof search->lacks,
        "'%.60s' lies on cells of MPAS, whose lonCell and latCell are not in the file",
        search->u->plain_name);
    search->elsewhere = true;
    return false;
  }
  if (strcmp(along, "nEdges") == 0) {
    snprintf(search->lacks, sizeof search->lacks,
             "'%.60s' lies on the edges of an MPAS mesh, across or along each",
             search->u->plain_name);
    return false;
  }
  out->in_plane = is_flat(cell[0]);
  out->in_radians = true;
  const bool planar = out->in_plane;
  const fg__variable *centre[2];
  pair_named(centre, data, planar ? "xCell" : "lonCell", planar ? "yCell" : "latCell");
  pair_named(out->node, data, planar ? "xVertex" : "lonVertex",
             planar ? "yVertex" : "latVertex");
  out->connectivity = array_named(data, "verticesOnCell", 2);
  out->corner_count = array_named(data, "nEdgesOnCell", 1);
  out->start = 1;
  const char *const letter = strrchr(search->u->plain_name, 'X');
  if (!planar && letter && letter[1] == '\0') {
    snprintf(search->lacks, sizeof search->lacks,
             "'%.60s' is along an axis in space through the sphere's centre",
             search->u->plain_name);
    return false;
  }
  const char *frame = planar ? "along x and y" : "east and north";
  if (strcmp(along, "nVertices") == 0) {
    if (!out->connectivity || !out->node[0] || !out->node[1])
      return false;
    out->location = FG__MESH_ON_NODES;
    snprintf(out->rule, sizeof out->rule,
             "%s, on the vertices of an MPAS mesh "
             "(verticesOnCell)",
             frame);
    return true;
  }
  if (!centre[0] || !centre[1] || !fg__search_along(search, centre[0]->dimension[0]))
    return false;
  if (!out->connectivity || !out->node[0] || !out->node[1]) {
    out->connectivity = NULL;
    memcpy(out->node, centre, sizeof centre);
    snprintf(
        out->rule, sizeof out->rule,
        "%s, on cells of an MPAS mesh, triangulated (the file has no verticesOnCell)",
        frame);
    return true;
  }
  memcpy(out->centre, centre, sizeof centre);
  out->location = FG__MESH_ON_FACES;
  snprintf(out->rule, sizeof out->rule,
           "%s, on the cells of an MPAS mesh "
           "(verticesOnCell)",
           frame);
  return true;
}

/* A connectivity of triangles and the positions of its nodes and faces, by name. */
typedef struct known_mesh {
  const char *connectivity, *node[2][2], *centre[2][2];
} known_mesh;

static const known_mesh KNOWN[] = {
    {"nv", {{"lon", "lat"}, {"x", "y"}}, {{"lonc", "latc"}, {"xc", "yc"}}},
    {"element", {{"lon", "lat"}, {"x", "y"}}, {{NULL, NULL}, {NULL, NULL}}},
    {"tri", {{"lon", "lat"}, {"x", "y"}}, {{NULL, NULL}, {NULL, NULL}}},
    {"tri", {{"longitude", "latitude"}, {NULL, NULL}}, {{NULL, NULL}, {NULL, NULL}}},
    {"vertex_of_cell",
     {{"vlon", "vlat"}, {NULL, NULL}},
     {{"clon", "clat"}, {NULL, NULL}}},
};

/* FVCOM writes zeros as longitudes where its plane is of metres. */
static bool is_constant(const fg__variable *v, size_t length)
{
  double first, last, middle;
  const size_t at[3] = {0, length / 2, length - 1};
  return length < 2 ||
         (fg__variable_fetch_one(v, &at[0], &first) == FG_STATUS_OK &&
          fg__variable_fetch_one(v, &at[1], &middle) == FG_STATUS_OK &&
          fg__variable_fetch_one(v, &at[2], &last) == FG_STATUS_OK &&
          !(first < middle || first > middle || first < last || first > last));
}

static bool find_positions(fg__unstructured *out, fg__mesh_search *search,
                           const known_mesh *known)
{
  const fg__dataset *data = search->data;
  for (int n = 0; n < 2 && known->node[n][0]; ++n) {
    if (!pair_named(out->node, data, known->node[n][0], known->node[n][1]))
      continue;
    const size_t length = data->dimensions[out->node[0]->dimension[0]].length;
    if (n == 0 && is_constant(out->node[0], length) && is_constant(out->node[1], length))
      continue;
    if (!known->centre[n][0] ||
        !pair_named(out->centre, data, known->centre[n][0], known->centre[n][1]))
      out->centre[0] = out->centre[1] = NULL;
    out->in_plane = out->node[0]->geographic == FG__NO_ROLE && n > 0;
    return true;
  }
  return false;
}

static bool find_known(fg__unstructured *out, fg__mesh_search *search,
                       const known_mesh *known)
{
  const fg__dataset *data = search->data;
  out->connectivity = array_named(data, known->connectivity, 2);
  if (!out->connectivity || !find_positions(out, search, known))
    return false;
  const int *dimension = out->connectivity->dimension;
  out->faces_along =
      data->dimensions[dimension[1]].length > data->dimensions[dimension[0]].length;
  out->start = 1;
  if (fg__search_along(search, dimension[out->faces_along])) {
    out->location = FG__MESH_ON_FACES;
    if (out->centre[0] && !fg__search_along(search, out->centre[0]->dimension[0]))
      out->centre[0] = out->centre[1] = NULL;
  } else if (fg__search_along(search, out->node[0]->dimension[0])) {
    out->location = FG__MESH_ON_NODES;
  } else {
    return false;
  }
  snprintf(out->rule, sizeof out->rule,
           "%s, on the %s of a mesh of triangles ('%.40s' with '%.40s', '%.40s')",
           out->in_plane ? "along x and y" : "east and north",
           out->location == FG__MESH_ON_FACES ? "faces" : "nodes",
           out->connectivity->plain_name, out->node[0]->plain_name,
           out->node[1]->plain_name);
  return true;
}

bool fg__find_model(fg__unstructured *out, fg__mesh_search *search)
{
  const int dimension = out->dimension;
  if (find_mpas(out, search))
    return true;
  for (size_t n = 0; n < sizeof KNOWN / sizeof *KNOWN && !search->lacks[0]; ++n) {
    *out = (fg__unstructured){.dimension = dimension};
    if (find_known(out, search, &KNOWN[n]))
      return true;
  }
  return false;
}
