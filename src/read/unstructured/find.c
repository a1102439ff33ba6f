/* Which unstructured mesh a pair lies on. */
#include "base/memory.h"
#include "read/unstructured/unstructured.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void fg__nc_unstructured_destroy(fg__nc_unstructured *mesh)
{
  free(mesh);
}

bool fg__nc_same_dimension(const fg__nc_file *file, int a, int b)
{
  const fg__nc_dimension *of = file->dimensions;
  return a == b || (of[a].root != of[b].root && of[a].length == of[b].length);
}

fg__nc_role fg__nc_angle_role(const fg__nc_variable *v)
{
  char text[FG__NC_TEXT];
  const fg__nc_role role = v->geographic;
  fg__nc_text(v, "units", text, sizeof text);
  if (role != FG__NC_NO_ROLE || strncmp(text, "rad", 3) != 0)
    return role;
  fg__nc_text(v, "standard_name", text, sizeof text);
  if (strcmp(text, "longitude") == 0 || strcmp(text, "latitude") == 0)
    return strcmp(text, "longitude") == 0 ? FG__NC_X : FG__NC_Y;
  if (strstr(v->plain_name, "lon") || strstr(v->plain_name, "Lon"))
    return FG__NC_X;
  return strstr(v->plain_name, "lat") || strstr(v->plain_name, "Lat") ? FG__NC_Y
                                                                      : FG__NC_NO_ROLE;
}

/* Whether y is the first of two coordinates. */
static bool is_turned(const fg__nc_variable *first, const fg__nc_variable *second)
{
  if (fg__nc_angle_role(first) != FG__NC_NO_ROLE)
    return fg__nc_angle_role(first) == FG__NC_Y;
  char text[FG__NC_TEXT];
  fg__nc_text(second, "standard_name", text, sizeof text);
  return strcmp(text, "projection_x_coordinate") == 0;
}

bool fg__nc_named_positions(const fg__nc_variable *out[2], const fg__nc_file *file,
                            const char *names)
{
  char name[2][FG__NC_TEXT];
  if (sscanf(names, "%255s %255s", name[0], name[1]) != 2)
    return false;
  for (int k = 0; k < 2; ++k) {
    out[k] = fg__nc_find(file, name[k]);
    if (!out[k] || !fg__nc_is_array(out[k]) || out[k]->rank != 1)
      return false;
  }
  if (!fg__nc_same_dimension(file, out[0]->dimension[0], out[1]->dimension[0]))
    return false;
  if (is_turned(out[0], out[1])) {
    const fg__nc_variable *first = out[0];
    out[0] = out[1];
    out[1] = first;
  }
  return true;
}

/* Whether a dimension may be one of places, which time is not; but it may be that of a
 * vector's only dimension, or of all but levels, where each time has its place, as those
 * of a drifter. */
static bool may_be_places(const fg__nc_search *search, bool of_times)
{
  int position[FG__NC_ROLES];
  const fg__nc_variable *u = search->u;
  if (search->file->dimensions[u->dimension[search->k]].length < 3)
    return false;
  fg__nc_roles(position, search->file, u);
  if (position[FG__NC_TIME] != search->k)
    return true;
  if (!of_times)
    return false;
  fg__nc_roles_beside(position, search->file, u, search->k);
  return u->rank == 1 || (u->rank == 2 && position[FG__NC_LEVEL] >= 0);
}

/* Names the mesh of a variable where the file lacks it: by its attribute `mesh` of
 * UGRID, or CDI's word of its kind. */
static void name_absent(fg__nc_search *search)
{
  char text[FG__NC_TEXT];
  const fg__nc_variable *u = search->u;
  if (fg__nc_text(u, "mesh", text, sizeof text) && text[0] &&
      !fg__nc_find(search->file, text))
    snprintf(search->lacks, sizeof search->lacks,
             "'%.60s' lies on the mesh '%.60s', which is not in the file%s",
             u->plain_name, text, search->file->root_count > 1 ? "s" : "");
  else if (fg__nc_text(u, "CDI_grid_type", text, sizeof text) &&
           strcmp(text, "unstructured") == 0)
    snprintf(search->lacks, sizeof search->lacks,
             "'%.60s' lies on an unstructured grid (CDI_grid_type), which is not in the "
             "file",
             u->plain_name);
  search->elsewhere = search->lacks[0] != '\0';
}

static bool recognise(fg__nc_unstructured *out, fg__nc_search *search)
{
  static const struct {
    bool (*find)(fg__nc_unstructured *, fg__nc_search *);
    bool of_times; /* also along times that have places */
  } rules[] = {{fg__nc_find_ugrid, false},
               {fg__nc_find_healpix, false},
               {fg__nc_find_model, false},
               {fg__nc_find_coordinates, true},
               {fg__nc_find_trajectories, true}};
  for (size_t n = 0; n < sizeof rules / sizeof *rules && !search->lacks[0]; ++n)
    for (int k = 0; k < search->u->rank; ++k) {
      *out = (fg__nc_unstructured){.dimension = search->u->dimension[k]};
      search->k = k;
      if (may_be_places(search, rules[n].of_times) && rules[n].find(out, search))
        return true;
    }
  if (!search->lacks[0])
    name_absent(search);
  return false;
}

bool fg__nc_unstructured_line(const fg__nc_file *file, const fg__nc_variable *v)
{
  fg__nc_search search = {.file = file, .u = v};
  fg__nc_unstructured ignored;
  return v->rank == 1 && fg__nc_is_array(v) &&
         (recognise(&ignored, &search) || search.lacks[0]);
}

int fg__nc_unstructured_file(const fg__nc_unstructured *mesh)
{
  return mesh->connectivity ? mesh->connectivity->file
         : mesh->node[0]    ? mesh->node[0]->file
         : mesh->centre[0]  ? mesh->centre[0]->file
                            : 0;
}

bool fg__nc_unstructured_elsewhere(const fg__nc_file *file, const fg__nc_variable *v)
{
  fg__nc_search search = {.file = file, .u = v};
  fg__nc_unstructured mesh;
  return recognise(&mesh, &search) && mesh.sides == 0 &&
         fg__nc_unstructured_file(&mesh) != v->file;
}

static fg__nc_axis axis_along(const fg__nc_file *file, const fg__nc_variable *v, int k)
{
  return (fg__nc_axis){.dimension = v->dimension[k],
                       .position = k,
                       .size = file->dimensions[v->dimension[k]].length};
}

/* A second axis of length 1 that is none of the variable's makes it a plane to the
 * readers of values. */
bool fg__nc_unstructured_axis(fg__nc_grid *grid, const fg__nc_file *file,
                              const fg__nc_variable *v, const fg__nc_unstructured *mesh)
{
  int position[FG__NC_ROLES], k = 0;
  while (k < v->rank && !fg__nc_same_dimension(file, v->dimension[k], mesh->dimension))
    ++k;
  if (k == v->rank)
    return false;
  grid->axis[0] = axis_along(file, v, k);
  if (mesh->of_trajectories) {
    if (v->rank != 2 || !fg__nc_same_dimension(file, v->dimension[1 - k], mesh->beside))
      return false;
    grid->axis[1] = axis_along(file, v, 1 - k);
    grid->time = grid->level = -1;
  } else {
    if (fg__nc_roles_beside(position, file, v, k) >= 0)
      return false;
    grid->axis[1] = (fg__nc_axis){.dimension = -1, .position = v->rank, .size = 1};
    grid->time = position[FG__NC_TIME];
    grid->level = position[FG__NC_LEVEL];
  }
  grid->samples = grid->axis[0].size * grid->axis[1].size;
  fg__nc_set_index_axes(grid, file, v);
  return true;
}

/* Variables that hold all that is read, if the file has so many bytes. */
static void check_storage(fg__nc_grid *grid, const fg__nc_file *file,
                          const fg__nc_unstructured *mesh, const fg__nc_pair *pair)
{
  const fg__nc_variable *all[] = {
      pair->component[0], pair->component[1], mesh->connectivity, mesh->corner_count,
      mesh->node[0],      mesh->node[1],      mesh->centre[0],    mesh->centre[1],
      mesh->bounds[0],    mesh->bounds[1],    mesh->pixel};
  for (size_t n = 0; n < sizeof all / sizeof *all; ++n) {
    fg__nc_grid one = {.samples = grid->samples};
    if (!all[n])
      continue;
    if (n >= 2) {
      one.samples = 1;
      for (int k = 0; k < all[n]->rank; ++k)
        one.samples *= file->dimensions[all[n]->dimension[k]].length;
    }
    fg__nc_check_storage(&one, file, all[n]);
    if (one.unusable[0])
      fg__set_unusable(grid->unusable, "%s", one.unusable);
  }
}

/* A variable that is 0 on land along the vectors' dimension, or 1 there. */
static void find_mask(fg__nc_unstructured *mesh, const fg__nc_file *file)
{
  static const struct {
    const char *name;
    bool dry;
  } known[] = {{"wet_cells", false},  {"wet_nodes", false},     {"wetdry_elem", true},
               {"wetdry_node", true}, {"dryFlagElement", true}, {"dryFlagNode", true}};
  for (size_t n = 0; n < sizeof known / sizeof *known && !mesh->wet; ++n) {
    const fg__nc_variable *v = fg__nc_find(file, known[n].name);
    for (int k = 0; v && fg__nc_is_array(v) && k < v->rank; ++k)
      if (fg__nc_same_dimension(file, v->dimension[k], mesh->dimension)) {
        mesh->wet = v;
        mesh->wet_is_zero = known[n].dry;
      }
  }
}

static void check_pair(fg__nc_grid *grid, const fg__nc_file *file,
                       const fg__nc_pair *pair, const fg_read_options *options)
{
  fg__nc_unstructured *mesh = grid->unstructured;
  const fg__nc_variable *u = pair->component[0], *v = pair->component[1];
  if (!fg__nc_unstructured_axis(grid, file, u, mesh))
    fg__set_unusable(grid->unusable,
                     "'%.60s' has a dimension that is neither time nor level",
                     u->plain_name);
  else if (!fg__nc_unstructured_axis(&mesh->of_v, file, v, mesh) ||
           mesh->of_v.times != grid->times || mesh->of_v.levels != grid->levels)
    fg__set_unusable(grid->unusable, "'%.60s' does not lie on the dimensions of '%.60s'",
                     v->plain_name, u->plain_name);
  else if (pair->volume)
    fg__set_unusable(grid->unusable,
                     "three components on an unstructured mesh; two can be read");
  else if (options->frame == FG_FRAME_GRID)
    fg__set_unusable(grid->unusable, "an unstructured mesh has no directions of its own");
  check_storage(grid, file, mesh, pair);
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
static const fg__nc_variable *namesake(const fg__nc_file *file, const fg__nc_variable *of,
                                       int number)
{
  for (size_t i = 0; i < file->variable_count; ++i) {
    const fg__nc_variable *v = &file->variables[i];
    if (v->file == number && v != of && v->rank == 1 && fg__nc_is_array(v) &&
        strcmp(v->name, of->name) == 0 &&
        fg__nc_same_dimension(file, v->dimension[0], of->dimension[0]))
      return v;
  }
  return NULL;
}

/* Components of two files that have places each: they have to be the same. */
static fg_status check_places(fg__nc_grid *grid, const fg__nc_file *file,
                              const fg__nc_pair *pair)
{
  const fg__nc_unstructured *mesh = grid->unstructured;
  const fg__nc_variable *const *of_u = mesh->node[0] ? mesh->node : mesh->centre;
  const int number = pair->component[1]->file;
  double *a[2] = {NULL, NULL}, *b[2] = {NULL, NULL};
  if (pair->component[0]->file == number || !of_u[0] || of_u[0]->file == number ||
      of_u[0]->rank != 1)
    return FG_STATUS_OK;
  const fg__nc_variable *const of_v[2] = {namesake(file, of_u[0], number),
                                          namesake(file, of_u[1], number)};
  if (!of_v[0] || !of_v[1])
    return FG_STATUS_OK;
  const size_t count = file->dimensions[of_u[0]->dimension[0]].length;
  fg_status status = fg__nc_positions_of(a, file, mesh, of_u, count);
  if (status == FG_STATUS_OK)
    status = fg__nc_positions_of(b, file, mesh, of_v, count);
  if (status == FG_STATUS_OK && lie_apart(a, b, count, !mesh->in_plane))
    fg__nc_refuse_apart(grid, pair);
  for (int k = 0; k < 2; ++k) {
    free(a[k]);
    free(b[k]);
  }
  return status;
}

static bool is_numbers(const fg__nc_variable *v)
{
  return fg__nc_is_array(v) && v->rank < FG__NC_RANK;
}

fg_status fg__nc_unstructured_find(fg__nc_grid *grid, const fg__nc_file *file,
                                   const fg__nc_pair *pair,
                                   const fg_read_options *options)
{
  fg__nc_search search = {.file = file, .u = pair->component[0]};
  if (!is_numbers(pair->component[0]) || !is_numbers(pair->component[1]))
    return FG_STATUS_OK;
  fg__nc_unstructured *mesh = fg__allocate(1, sizeof *mesh);
  if (!mesh)
    return fg__fail_memory(file->context, "a mesh", sizeof *mesh);
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
  grid->dimension = 2;
  find_mask(mesh, file);
  check_pair(grid, file, pair, options);
  const fg_status status =
      grid->unusable[0] ? FG_STATUS_OK : check_places(grid, file, pair);
  grid->scale = mesh->in_plane ? FG_SCALE_MAP : FG_SCALE_GEO;
  if (options->scale == FG_SCALE_GEO && mesh->in_plane)
    fg__set_unusable(grid->unusable, "scale geo needs longitudes and latitudes");
  if (options->scale == FG_SCALE_PLAIN || options->scale == FG_SCALE_MAP) {
    grid->scale = options->scale;
    mesh->in_plane = true;
  }
  return fg__nc_status(file, status);
}
