/* Meshes as the UGRID conventions (1.0, 2016) have them; also of models that follow them
 * in part: SCHISM, Delft3D FM, LFRic, ADCIRC, FVCOM behind a server. */
#include "interpret/unstructured/unstructured.h"

#include <stdio.h>
#include <string.h>

enum {
  MOST_SIDES = 4
}; /* of faces, where a dimension's length must tell it from theirs */

static bool is_topology(const fg__variable *v)
{
  char text[FG__TEXT_BYTES];
  double dimensions = 2.0;
  if (!fg__attribute_text(v, "cf_role", text, sizeof text) ||
      strcmp(text, "mesh_topology") != 0)
    return false;
  fg__attribute_numbers(v, "topology_dimension", &dimensions, 1);
  return dimensions > 1.5 && dimensions < 2.5;
}

/* A variable that an attribute names; NULL where it names none, or one that is not there:
 * then `lacks` says so. */
static const fg__variable *named_by(fg__mesh_search *search, const fg__variable *topology,
                                    const char *attribute)
{
  char name[FG__TEXT_BYTES];
  fg__attribute_text(topology, attribute, name, sizeof name);
  const fg__variable *v = name[0] ? fg__dataset_find(search->data, name) : NULL;
  if (v && fg__is_array(v) && v->rank == 2)
    return v;
  if (name[0] && !search->lacks[0])
    snprintf(search->lacks, sizeof search->lacks,
             "the mesh '%.60s' names '%.60s' as its %s, which %s", topology->plain_name,
             name, attribute, v ? "is no array of two dimensions" : "is not in the file");
  return NULL;
}

/* Which dimension of a connectivity is the faces': the one that is named; else the second
 * where the first is as short as faces have corners. */
static int faces_along(const fg__dataset *data, const fg__variable *topology,
                       const fg__variable *connectivity)
{
  char name[FG__TEXT_BYTES];
  const fg__dimension *of = data->dimensions;
  const int *dimension = connectivity->dimension;
  fg__attribute_text(topology, "face_dimension", name, sizeof name);
  for (int k = 0; k < 2; ++k)
    if (name[0] && strcmp(of[dimension[k]].name, name) == 0)
      return k;
  return of[dimension[0]].length <= MOST_SIDES && of[dimension[1]].length > MOST_SIDES;
}

static bool positions_by(const fg__variable *out[2], const fg__dataset *data,
                         const fg__variable *topology, const char *attribute)
{
  char names[FG__TEXT_BYTES];
  return fg__attribute_text(topology, attribute, names, sizeof names) &&
         fg__named_positions(out, data, names);
}

static void settle(fg__unstructured *out, const fg__variable *topology, const char *where)
{
  const fg__variable *at = out->node[0];
  out->in_plane = at->geographic == FG__NO_ROLE;
  snprintf(out->rule, sizeof out->rule,
           "%s, on the %s of the mesh '%.100s' (cf_role mesh_topology)",
           out->in_plane  ? "along x and y"
           : out->turn[0] ? "along its rows, turned to east and north"
                          : "east and north",
           where, topology->plain_name);
}

/* Rows about a pole of their own: vectors may be along these, and rows may close round a
 * pole that they do not reach. */
static void find_rows(fg__unstructured *out, const fg__mesh_search *search,
                      const fg__variable *topology)
{
  double relative = 0.0, poles = 0.0;
  fg__attribute_numbers(search->u, "GRIB_uvRelativeToGrid", &relative, 1);
  if (!(relative > 0.0) || (search->pair && search->pair->polar.sense != 0) ||
      !positions_by(out->turn, search->data, topology, "node_rotation"))
    out->turn[0] = out->turn[1] = NULL;
  fg__attribute_numbers(topology, "pole_nodes", &poles, 1);
  out->poles = poles > 0.0 ? (size_t)poles : 0;
}

/* Vectors on edges: their middles are points, where the file has them. */
static bool find_edges(fg__unstructured *out, fg__mesh_search *search,
                       const fg__variable *topology)
{
  const fg__variable *at[2];
  char name[FG__TEXT_BYTES];
  fg__attribute_text(topology, "edge_node_connectivity", name, sizeof name);
  const fg__variable *edges = name[0] ? fg__dataset_find(search->data, name) : NULL;
  if (!edges || edges->rank < 1 || !fg__is_array(edges) ||
      !fg__search_along(search, edges->dimension[0]))
    return false;
  if (!positions_by(at, search->data, topology, "edge_coordinates") ||
      !fg__search_along(search, at[0]->dimension[0])) {
    snprintf(search->lacks, sizeof search->lacks,
             "the mesh '%.60s' says not where its edges are: it has no edge_coordinates",
             topology->plain_name);
    return false;
  }
  out->connectivity = NULL;
  out->location = FG__MESH_ON_POINTS;
  memcpy(out->node, at, sizeof at);
  settle(out, topology, "edges' middles");
  return true;
}

static bool find_on(fg__unstructured *out, fg__mesh_search *search,
                    const fg__variable *topology)
{
  const fg__dataset *data = search->data;
  out->connectivity = named_by(search, topology, "face_node_connectivity");
  if (!out->connectivity)
    return false;
  out->faces_along = faces_along(data, topology, out->connectivity);
  if (!positions_by(out->node, data, topology, "node_coordinates")) {
    snprintf(search->lacks, sizeof search->lacks,
             "the mesh '%.60s' has no node_coordinates that are two arrays of one length",
             topology->plain_name);
    return false;
  }
  if (fg__search_along(search, out->connectivity->dimension[out->faces_along])) {
    out->location = FG__MESH_ON_FACES;
    if (!positions_by(out->centre, data, topology, "face_coordinates") ||
        !fg__search_along(search, out->centre[0]->dimension[0]))
      out->centre[0] = out->centre[1] = NULL;
    settle(out, topology, "faces");
    return true;
  }
  if (fg__search_along(search, out->node[0]->dimension[0])) {
    out->location = FG__MESH_ON_NODES;
    find_rows(out, search, topology);
    settle(out, topology, "nodes");
    return true;
  }
  return find_edges(out, search, topology);
}

/* The mesh that the variable names goes before others that have its dimension. What is
 * lacking is said of no other. */
bool fg__find_ugrid(fg__unstructured *out, fg__mesh_search *search)
{
  char name[FG__TEXT_BYTES];
  const int dimension = out->dimension;
  fg__attribute_text(search->u, "mesh", name, sizeof name);
  const fg__variable *named = name[0] ? fg__dataset_find(search->data, name) : NULL;
  if (named && is_topology(named))
    return find_on(out, search, named);
  for (size_t n = 0; n < search->data->variable_count; ++n) {
    const fg__variable *v = &search->data->variables[n];
    if (!is_topology(v))
      continue;
    *out = (fg__unstructured){.dimension = dimension};
    if (find_on(out, search, v))
      return true;
    search->lacks[0] = '\0';
  }
  return false;
}
