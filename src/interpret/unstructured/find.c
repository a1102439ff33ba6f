/* Which unstructured mesh a pair lies on. */
#include "base/memory.h"
#include "interpret/unstructured/unstructured.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void fg__unstructured_destroy(fg__unstructured *mesh)
{
  if (mesh) {
    free(mesh->rows_time.value);
    free(mesh->rows_level.value);
  }
  free(mesh);
}

bool fg__same_dimension(const fg__dataset *data, int a, int b)
{
  const fg__dimension *of = data->dimensions;
  return a == b || (of[a].file != of[b].file && of[a].length == of[b].length);
}

bool fg__search_lies(const fg__mesh_search *search, const fg__variable *v, int rank)
{
  bool same = v->rank == rank && v->element == 0 && fg__is_array(v);
  for (int k = 0; k < rank && same; ++k)
    same = fg__same_dimension(search->data, v->dimension[k],
                              search->u->dimension[search->k - rank + 1 + k]);
  return same;
}

bool fg__search_along(const fg__mesh_search *search, int dimension)
{
  return fg__same_dimension(search->data, search->u->dimension[search->k], dimension);
}

/* Whether y is the first of two coordinates. */
static bool is_turned(const fg__variable *first, const fg__variable *second)
{
  if (first->geographic != FG__NO_ROLE)
    return first->geographic == FG__ROLE_Y;
  char text[FG__TEXT_BYTES];
  fg__attribute_text(second, "standard_name", text, sizeof text);
  return strcmp(text, "projection_x_coordinate") == 0;
}

bool fg__named_positions(const fg__variable *out[2], const fg__dataset *data,
                         const char *names)
{
  char name[2][FG__TEXT_BYTES];
  if (sscanf(names, "%255s %255s", name[0], name[1]) != 2)
    return false;
  for (int k = 0; k < 2; ++k) {
    out[k] = fg__dataset_find(data, name[k]);
    if (!out[k] || !fg__is_array(out[k]) || out[k]->rank != 1)
      return false;
  }
  if (!fg__same_dimension(data, out[0]->dimension[0], out[1]->dimension[0]))
    return false;
  if (is_turned(out[0], out[1])) {
    const fg__variable *first = out[0];
    out[0] = out[1];
    out[1] = first;
  }
  return true;
}

/* Whether a dimension may be one of places, which time is not; but it may be that of a
 * vector's only dimension, or of all but levels, where each time has its place, as those
 * of a drifter. */
static bool may_be_places(const fg__mesh_search *search, bool of_times)
{
  int position[FG__ROLES];
  const fg__variable *u = search->u;
  if (search->data->dimensions[u->dimension[search->k]].length < 3)
    return false;
  fg__roles_find(position, search->data, u);
  if (position[FG__ROLE_TIME] != search->k)
    return true;
  if (!of_times)
    return false;
  fg__roles_find_beside(position, search->data, u, search->k);
  return u->rank == 1 || (u->rank == 2 && position[FG__ROLE_LEVEL] >= 0);
}

/* Names the mesh of a variable where the file lacks it: by its attribute `mesh` of
 * UGRID, or CDI's word of its kind. */
static void name_absent(fg__mesh_search *search)
{
  char text[FG__TEXT_BYTES];
  const fg__variable *u = search->u;
  if (fg__attribute_text(u, "mesh", text, sizeof text) && text[0] &&
      !fg__dataset_find(search->data, text))
    snprintf(search->lacks, sizeof search->lacks,
             "'%.60s' lies on the mesh '%.60s', which is not in the file%s",
             u->plain_name, text, search->data->files > 1 ? "s" : "");
  else if (fg__attribute_text(u, "CDI_grid_type", text, sizeof text) &&
           strcmp(text, "unstructured") == 0)
    snprintf(search->lacks, sizeof search->lacks,
             "'%.60s' lies on an unstructured grid (CDI_grid_type), which is not in the "
             "file",
             u->plain_name);
  search->elsewhere = search->lacks[0] != '\0';
}

static bool recognise(fg__unstructured *out, fg__mesh_search *search)
{
  static const struct {
    bool (*find)(fg__unstructured *, fg__mesh_search *);
    bool of_times; /* also along times that have places */
  } rules[] = {{fg__find_ugrid, false}, {fg__find_healpix, false},
               {fg__find_model, false}, {fg__find_coordinates, true},
               {fg__find_tiles, false}, {fg__find_trajectories, true},
               {fg__find_places, true}};
  const size_t count = sizeof rules / sizeof *rules;
  const bool named = search->pair && search->pair->position[0];
  for (size_t n = named ? count - 1 : 0; n < count && !search->lacks[0]; ++n)
    for (int k = 0; k < search->u->rank; ++k) {
      *out = (fg__unstructured){.dimension = search->u->dimension[k]};
      search->k = k;
      if (may_be_places(search, rules[n].of_times) && rules[n].find(out, search))
        return true;
    }
  if (!search->lacks[0])
    name_absent(search);
  return false;
}

bool fg__unstructured_line(const fg__dataset *data, const fg__variable *v)
{
  fg__mesh_search search = {.data = data, .u = v};
  fg__unstructured ignored;
  return v->rank == 1 && fg__is_array(v) &&
         (recognise(&ignored, &search) || search.lacks[0]);
}

int fg__unstructured_file(const fg__unstructured *mesh)
{
  return mesh->connectivity ? mesh->connectivity->file
         : mesh->node[0]    ? mesh->node[0]->file
         : mesh->centre[0]  ? mesh->centre[0]->file
                            : 0;
}

bool fg__unstructured_elsewhere(const fg__dataset *data, const fg__variable *v)
{
  fg__mesh_search search = {.data = data, .u = v};
  fg__unstructured mesh;
  return recognise(&mesh, &search) && mesh.sides == 0 &&
         fg__unstructured_file(&mesh) != v->file;
}

static fg__grid_axis axis_along(const fg__dataset *data, const fg__variable *v, int k)
{
  return (fg__grid_axis){.dimension = v->dimension[k],
                         .position = k,
                         .size = data->dimensions[v->dimension[k]].length};
}

bool fg__points_north(const fg__unstructured *mesh)
{
  return !mesh->in_plane || (mesh->location == FG__MESH_ON_POINTS &&
                             mesh->node[0]->geographic == FG__ROLE_X &&
                             mesh->node[1]->geographic == FG__ROLE_Y);
}

bool fg__lies_at_places(const fg__unstructured *mesh, const fg__variable *v)
{
  const int rank = mesh->rank > 1 ? mesh->rank : 1;
  bool same =
      v->element == 0 && v->rank == rank && v->dimension[rank - 1] == mesh->dimension;
  for (int k = 0; k + 1 < rank && same; ++k)
    same = v->dimension[k] == mesh->before[k];
  return same;
}

int fg__places_dimension(const fg__unstructured *mesh, const fg__pair *pair)
{
  return mesh->node[2] && pair->component[2] ? 3 : 2;
}

bool fg__along_places(const fg__dataset *data, const fg__unstructured *mesh,
                      const fg__variable *v, int k)
{
  if (mesh->rank > 1 && !mesh->is_tiled)
    return k >= v->rank - mesh->rank;
  bool along = fg__same_dimension(data, v->dimension[k], mesh->dimension);
  for (int n = 0; n + 1 < mesh->rank; ++n)
    along = along || v->dimension[k] == mesh->before[n];
  return along;
}

/* Of arrays of places: all of them are one axis, beside which are time and level, in this
 * order where nothing says which is which. */
static bool axis_of_arrays(fg__grid *grid, const fg__dataset *data, const fg__variable *v,
                           const fg__unstructured *mesh)
{
  int *const place[] = {&grid->time, &grid->level};
  int along = 0, dimension[FG__RANK];
  grid->time = grid->level = -1;
  grid->samples = 1;
  for (int k = 0; k < v->rank; ++k) {
    if (fg__along_places(data, mesh, v, k)) {
      dimension[along++] = k;
      grid->samples *= data->dimensions[v->dimension[k]].length;
      continue;
    }
    const fg__role role = fg__claimed_role(data, v, k);
    int n = role == FG__ROLE_LEVEL;
    if (role != FG__ROLE_TIME && *place[n] >= 0)
      n = 1;
    if (*place[n] >= 0 && data->dimensions[v->dimension[k]].length > 1)
      return false;
    if (*place[n] < 0)
      *place[n] = k;
  }
  bool same = along == mesh->rank;
  for (int k = 0; k < along && same; ++k)
    same = fg__same_dimension(data, v->dimension[dimension[k]],
                              k + 1 < mesh->rank ? mesh->before[k] : mesh->dimension);
  if (!same)
    return false;
  grid->axis[0] = axis_along(data, v, dimension[along - 1]);
  grid->axis[1] = axis_along(data, v, dimension[along - 2]);
  fg__set_index_axes(grid, data, v);
  return true;
}

/* A second axis of length 1 that is none of the variable's makes it a plane to the
 * readers of values. */
bool fg__unstructured_axis(fg__grid *grid, const fg__dataset *data, const fg__variable *v,
                           const fg__unstructured *mesh)
{
  int position[FG__ROLES], k = 0;
  if (mesh->rank > 1)
    return axis_of_arrays(grid, data, v, mesh);
  while (k < v->rank && !fg__same_dimension(data, v->dimension[k], mesh->dimension))
    ++k;
  if (k == v->rank || fg__roles_find_beside(position, data, v, k) >= 0)
    return false;
  grid->axis[0] = axis_along(data, v, k);
  grid->axis[1] = (fg__grid_axis){.dimension = -1, .position = v->rank, .size = 1};
  grid->time = position[FG__ROLE_TIME];
  grid->level = position[FG__ROLE_LEVEL];
  grid->samples = grid->axis[0].size;
  fg__set_index_axes(grid, data, v);
  return true;
}

/* Refuses variables that declare more bytes than the file can hold. */
static void check_storage(fg__grid *grid, const fg__dataset *data,
                          const fg__unstructured *mesh, const fg__pair *pair)
{
  const fg__variable *all[] = {pair->component[0], pair->component[1], mesh->connectivity,
                               mesh->corner_count, mesh->node[0],      mesh->node[1],
                               mesh->node[2],      mesh->centre[0],    mesh->centre[1],
                               mesh->bounds[0],    mesh->bounds[1],    mesh->pixel};
  for (size_t n = 0; n < sizeof all / sizeof *all; ++n) {
    fg__grid one = {.samples = grid->samples};
    if (!all[n])
      continue;
    if (n >= 2) {
      one.samples = 1;
      for (int k = 0; k < all[n]->rank; ++k)
        one.samples *= data->dimensions[all[n]->dimension[k]].length;
    }
    fg__check_storage(&one, data, all[n]);
    if (one.unusable[0])
      fg__set_unusable(grid->unusable, "%s", one.unusable);
  }
}

/* A variable that is 0 on land along the vectors' dimension, or 1 there. */
static void find_mask(fg__unstructured *mesh, const fg__dataset *data)
{
  static const struct {
    const char *name;
    bool dry;
  } known[] = {{"wet_cells", false},  {"wet_nodes", false},     {"wetdry_elem", true},
               {"wetdry_node", true}, {"dryFlagElement", true}, {"dryFlagNode", true}};
  for (size_t n = 0; n < sizeof known / sizeof *known && !mesh->wet; ++n) {
    const fg__variable *v = fg__dataset_find(data, known[n].name);
    for (int k = 0; v && fg__is_array(v) && k < v->rank; ++k)
      if (fg__same_dimension(data, v->dimension[k], mesh->dimension)) {
        mesh->wet = v;
        mesh->wet_is_zero = known[n].dry;
      }
  }
}

static void check_pair(fg__grid *grid, const fg__dataset *data, const fg__pair *pair,
                       const fg_read_options *options)
{
  fg__unstructured *mesh = grid->unstructured;
  const fg__variable *u = pair->component[0], *v = pair->component[1];
  if (!fg__unstructured_axis(grid, data, u, mesh))
    fg__set_unusable(grid->unusable,
                     "'%.60s' has a dimension that is neither time nor level",
                     u->plain_name);
  else if (!fg__unstructured_axis(&mesh->of_v, data, v, mesh) ||
           mesh->of_v.times != grid->times || mesh->of_v.levels != grid->levels)
    fg__set_unusable(grid->unusable, "'%.60s' does not lie on the dimensions of '%.60s'",
                     v->plain_name, u->plain_name);
  else if (pair->volume && fg__places_dimension(mesh, pair) == 2)
    fg__set_unusable(grid->unusable,
                     "three components on an unstructured mesh; two can be read");
  else if (options->frame == FG_FRAME_GRID)
    fg__set_unusable(grid->unusable, "an unstructured mesh has no directions of its own");
  else if (mesh->is_tiled)
    fg__check_tiles(grid, pair, options->frame);
  check_storage(grid, data, mesh, pair);
}

/* Whether most of the second places are farther from the first ones than half the
 * distance between neighbours, if these were even in their extent. */
static bool lie_apart(double *const a[2], double *const b[2], size_t count, bool globe)
{
  double extent[2];
  size_t far = 0;
  for (int k = 0; k < 2; ++k) {
    double low = HUGE_VAL, high = -HUGE_VAL;
    for (size_t n = 0; n < count; ++n) {
      low = fmin(low, a[k][n]);
      high = fmax(high, a[k][n]);
    }
    extent[k] = high - low;
  }
  const double between = sqrt(extent[0] * extent[1] / (double)count);
  for (size_t n = 0; n < count; ++n) {
    const double x = b[0][n] - a[0][n];
    far += hypot(globe ? remainder(x, 360.0) : x, b[1][n] - a[1][n]) > 0.5 * between;
  }
  return 2 * far > count;
}

/* The variable of a place's name and length in another file; NULL: none. */
static const fg__variable *namesake(const fg__dataset *data, const fg__variable *of,
                                    int number)
{
  for (size_t i = 0; i < data->variable_count; ++i) {
    const fg__variable *v = &data->variables[i];
    if (v->file == number && v != of && v->rank == 1 && fg__is_array(v) &&
        strcmp(v->name, of->name) == 0 &&
        fg__same_dimension(data, v->dimension[0], of->dimension[0]))
      return v;
  }
  return NULL;
}

/* Components of two files that have places each: they have to be the same. */
static fg_status check_places(fg__grid *grid, const fg__dataset *data,
                              const fg__pair *pair)
{
  const fg__unstructured *mesh = grid->unstructured;
  const fg__variable *const *of_u = mesh->node[0] ? mesh->node : mesh->centre;
  const int number = pair->component[1]->file;
  double *a[2] = {NULL, NULL}, *b[2] = {NULL, NULL};
  if (pair->component[0]->file == number || !of_u[0] || of_u[0]->file == number ||
      of_u[0]->rank != 1)
    return FG_STATUS_OK;
  const fg__variable *const of_v[2] = {namesake(data, of_u[0], number),
                                       namesake(data, of_u[1], number)};
  if (!of_v[0] || !of_v[1])
    return FG_STATUS_OK;
  const size_t count = data->dimensions[of_u[0]->dimension[0]].length;
  fg_status status = fg__positions_of(a, data, mesh, of_u, count, 2);
  if (status == FG_STATUS_OK)
    status = fg__positions_of(b, data, mesh, of_v, count, 2);
  if (status == FG_STATUS_OK && lie_apart(a, b, count, !mesh->in_plane))
    fg__refuse_apart(grid, pair);
  for (int k = 0; k < 2; ++k) {
    free(a[k]);
    free(b[k]);
  }
  return status;
}

static bool is_numbers(const fg__variable *v)
{
  return fg__is_array(v) && v->rank < FG__RANK;
}

/* Refuses a plane whose places are in two units of one quantity. */
static void check_units(fg__grid *grid)
{
  const fg__variable *const *place = grid->unstructured->node;
  char label[3][FG__TEXT_BYTES];
  for (int k = 0; k < grid->dimension && place[k]; ++k) {
    const fg__quantity quantity = fg__units_of(place[k], label[k], sizeof label[k]);
    if (k == 0 || !label[0][0] || strcmp(label[0], label[k]) == 0 ||
        quantity != fg__units_of(place[0], NULL, 0))
      continue;
    fg__set_unusable(grid->unusable, "'%.60s' is in %.40s, '%.60s' in %.40s: no plane",
                     place[0]->plain_name, label[0], place[k]->plain_name, label[k]);
    snprintf(grid->hint, sizeof grid->hint, "--scale plain takes their numbers");
  }
}

fg_status fg__unstructured_find(fg__grid *grid, const fg__dataset *data,
                                const fg__pair *pair, const fg_read_options *options)
{
  fg__mesh_search search = {.data = data, .u = pair->component[0], .pair = pair};
  if (!is_numbers(pair->component[0]) || !is_numbers(pair->component[1]))
    return FG_STATUS_OK;
  fg__unstructured *mesh = fg__allocate(1, sizeof *mesh);
  if (!mesh)
    return fg__fail_memory(data->context, "a mesh", sizeof *mesh);
  if (!recognise(mesh, &search)) {
    free(mesh);
    if (search.lacks[0])
      fg__set_unusable(grid->unusable, "%s", search.lacks);
    if (search.elsewhere)
      snprintf(grid->hint, sizeof grid->hint, "%s",
               "--mesh-from names the file that has it");
    return FG_STATUS_OK;
  }
  grid->unstructured = mesh;
  grid->dimension = fg__places_dimension(mesh, pair);
  find_mask(mesh, data);
  check_pair(grid, data, pair, options);
  fg_status status = grid->unusable[0] ? FG_STATUS_OK : check_places(grid, data, pair);
  if (status == FG_STATUS_OK && !grid->unusable[0])
    status = fg__rows_find(grid, data, pair, options);
  if (options->scale == FG_SCALE_GEO && mesh->location == FG__MESH_ON_POINTS)
    mesh->in_plane = false;
  grid->scale = !mesh->in_plane                                 ? FG_SCALE_GEO
                : data->dimensions[mesh->dimension].is_nameless ? FG_SCALE_PLAIN
                                                                : FG_SCALE_MAP;
  if (options->scale == FG_SCALE_GEO && mesh->in_plane)
    fg__set_unusable(grid->unusable, "scale geo needs longitudes and latitudes");
  if (options->scale == FG_SCALE_PLAIN || options->scale == FG_SCALE_MAP) {
    grid->scale = options->scale;
    mesh->in_plane = true;
  }
  if (mesh->in_plane && options->scale != FG_SCALE_PLAIN && !grid->unusable[0])
    check_units(grid);
  return status;
}
