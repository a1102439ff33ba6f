/* Whether components point east and north or along the grid: the first of four rules that
 * applies (docs/method/model-grids.md). */
#include "terms/frame.h"
#include "interpret/curvilinear/curvilinear.h"
#include "terms/text.h"

#include <stdio.h>
#include <string.h>

static bool starts_with(const char *text, const char *start)
{
  return strncmp(text, start, strlen(start)) == 0;
}

static const fg__variable *find_on(const fg__curvilinear *mesh, const fg__dataset *data,
                                   const char *name)
{
  const fg__curvilinear_part *at = &mesh->at;
  for (size_t i = 0; i < data->variable_count; ++i) {
    const fg__variable *v = &data->variables[i];
    if (strcmp(v->plain_name, name) == 0 && fg__lies_on(data, v, &at->grid, at->variable))
      return v;
  }
  return NULL;
}

/* The angle of the grid, or its cosine and sine, where the file has them. */
static void find_angle(fg__curvilinear *mesh, const fg__dataset *data)
{
  for (int n = 0; fg__angle_names[n][0]; ++n) {
    const char *const *name = fg__angle_names[n];
    const fg__variable *of[2] = {find_on(mesh, data, name[0]),
                                 name[1] ? find_on(mesh, data, name[1]) : NULL};
    if (!of[0] || (name[1] && !of[1]))
      continue;
    memcpy(mesh->angle, of, sizeof of);
    mesh->turn = name[1] ? FG__TURN_COSINES : FG__TURN_ANGLE;
    return;
  }
}

/* Whether u and v are along dimensions that models name after the grid's own
 * directions. */
static bool is_on_indices(const fg__curvilinear *mesh, const fg__dataset *data)
{
  for (int k = 0; k < 2; ++k)
    if (!fg__counts_cells(data->dimensions[mesh->part[0].grid.axis[k].dimension].name))
      return false;
  return true;
}

/* Whether u and v are along coordinates of a plane, as of a projection, or of a rotated
 * pole. */
static bool is_on_a_plane(const fg__curvilinear *mesh, const fg__dataset *data)
{
  for (int k = 0; k < 2; ++k) {
    char text[FG__TEXT_BYTES];
    const fg__curvilinear_part *u = &mesh->part[0];
    const fg__variable *along =
        fg__coordinate(data, u->variable, u->grid.axis[k].position);
    if (!along)
      return false;
    if (fg__units_of(along, NULL, 0) == FG__QUANTITY_LENGTH)
      continue;
    fg__attribute_text(along, "standard_name", text, sizeof text);
    if (!starts_with(text, "projection_") && !starts_with(text, "grid_l") &&
        !starts_with(along->plain_name, k == 0 ? "rlon" : "rlat"))
      return false;
  }
  return true;
}

/* WRF's variables, but not those that its tools have turned ("earth rotated u,v"). */
static bool is_of_wrf(const fg__variable *u)
{
  char text[FG__TEXT_BYTES];
  return fg__attribute_text(u, "MemoryOrder", text, sizeof text) && text[0] == 'X' &&
         !(fg__attribute_text(u, "description", text, sizeof text) &&
           fg__find_text(text, "earth"));
}

static bool is_staggered(const fg__curvilinear *mesh)
{
  return mesh->shift[0] != 0 || mesh->shift[1] != 0;
}

static void set_rule(fg__curvilinear *mesh, const char *why)
{
  if (mesh->turn == FG__TURN_NONE)
    snprintf(mesh->rule, sizeof mesh->rule, "east and north (%.200s)", why);
  else if (mesh->turn == FG__TURN_GEOMETRY)
    snprintf(mesh->rule, sizeof mesh->rule,
             "along the grid, turned by its positions (%.200s)", why);
  else
    snprintf(mesh->rule, sizeof mesh->rule, "along the grid, turned by '%.60s' (%.200s)",
             mesh->angle[0]->plain_name, why);
}

bool fg__is_along_grid(const fg__grid *grid, const fg__dataset *data,
                       const fg__pair *pair, fg_frame wanted)
{
  char why[2 * FG__TEXT_BYTES];
  const fg__term u = fg__term_of(pair->component[0]), v = fg__term_of(pair->component[1]);
  if (wanted != FG_FRAME_AUTO || pair->polar.sense != 0)
    return wanted == FG_FRAME_GRID;
  fg__curvilinear mesh = {.at = {.variable = pair->component[0], .grid = *grid}};
  find_angle(&mesh, data);
  const fg__frame_evidence evidence = {.angle = mesh.turn != FG__TURN_NONE};
  return fg__frame_of_terms(why, sizeof why, &u, &v, &evidence) < 0;
}

void fg__check_frame(fg__grid *grid, const fg__pair *pair, fg_frame wanted)
{
  for (int k = 0; k < 2 && wanted == FG_FRAME_AUTO && pair->polar.sense == 0; ++k) {
    const fg__term t = fg__term_of(pair->component[k]);
    if (!fg__frame_is_contradicted(&t))
      continue;
    fg__set_unusable(grid->unusable,
                     "'%.60s' is along east and north by its standard name '%.60s', and "
                     "along the grid by its long name '%.60s'",
                     pair->component[k]->plain_name, t.standard_name, t.long_name);
    snprintf(grid->hint, sizeof grid->hint, "--frame east or --frame grid decides");
  }
}

bool fg__frame_find(fg__curvilinear *mesh, const fg__dataset *data, const fg__pair *pair,
                    fg_frame wanted)
{
  char why[2 * FG__TEXT_BYTES] = "as asked";
  const fg__term u = fg__term_of(pair->component[0]), v = fg__term_of(pair->component[1]);
  mesh->turn = FG__TURN_GEOMETRY;
  find_angle(mesh, data);
  const fg__frame_evidence evidence = {.staggered = is_staggered(mesh),
                                       .angle = mesh->turn != FG__TURN_GEOMETRY,
                                       .of_wrf = is_of_wrf(pair->component[0]),
                                       .on_indices = is_on_indices(mesh, data),
                                       .on_plane = is_on_a_plane(mesh, data)};
  int frame = wanted == FG_FRAME_EAST ? 1 : -1;
  if (pair->polar.sense != 0) {
    frame = 1;
    fg__pair_polar_words(why, sizeof why, pair);
  } else if (wanted == FG_FRAME_AUTO) {
    frame = fg__frame_of_terms(why, sizeof why, &u, &v, &evidence);
  }
  if (frame > 0)
    mesh->turn = FG__TURN_NONE;
  if (frame != 0)
    set_rule(mesh, why);
  return frame != 0;
}
