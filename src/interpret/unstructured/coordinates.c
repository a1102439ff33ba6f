/* Meshes by CF's coordinates: longitudes and latitudes along one dimension, cells whose
 * corners are their bounds, and HEALPix, whose places follow from the numbers of its
 * cells. */
#include "interpret/unstructured/unstructured.h"
#include "terms/text.h"

#include <stdio.h>
#include <string.h>

enum { MOST_LEVELS = 13 }; /* 12 * 4^13 cells are the most that an int counts */

/* The attribute that says how HEALPix is ordered, and of what. */
static bool order_of(bool *nested, const fg__variable *v, char *words, size_t size)
{
  static const char *const known[] = {"healpix_order", "indexing_scheme", "order"};
  char text[FG__TEXT_BYTES];
  for (size_t n = 0; n < sizeof known / sizeof *known; ++n) {
    if (!fg__attribute_text(v, known[n], text, sizeof text))
      continue;
    *nested = fg__starts_with(text, "nest");
    if (!*nested && !fg__is_same(text, "ring"))
      continue;
    snprintf(words, size, "%s of '%.60s'", known[n],
             v == fg__file_of(v) ? "the file" : v->plain_name);
    return true;
  }
  return false;
}

static bool is_whole_power(double value)
{
  for (long n = 1; n <= 1L << MOST_LEVELS; n *= 2)
    if (value >= (double)n && value <= (double)n)
      return true;
  return false;
}

/* N_side of a variable's attributes; 0 where it has none. */
static long sides_of(const fg__variable *v)
{
  double value = 0.0;
  if ((fg__attribute_numbers(v, "healpix_nside", &value, 1) == 1 ||
       fg__attribute_numbers(v, "nside", &value, 1) == 1) &&
      is_whole_power(value))
    return (long)value;
  if (fg__attribute_numbers(v, "refinement_level", &value, 1) == 1 && value >= 0.0 &&
      value <= MOST_LEVELS)
    return 1L << (int)value;
  return 0;
}

static long sides_of_count(size_t cells)
{
  for (long n = 1; n <= 1L << MOST_LEVELS; n *= 2)
    if ((size_t)n * (size_t)n * 12 == cells)
      return n;
  return 0;
}

/* The variable that names HEALPix as its grid mapping, the file's only one, or none. */
static const fg__variable *healpix_mapping(const fg__mesh_search *search)
{
  char text[FG__TEXT_BYTES];
  const fg__variable *v = fg__grid_mapping_of(search->data, search->u);
  if (!v)
    v = fg__dataset_find(search->data, "crs");
  v = v ? v : fg__dataset_find(search->data, "healpix");
  return v && fg__attribute_text(v, "grid_mapping_name", text, sizeof text) &&
                 fg__is_same(text, "healpix")
             ? v
             : NULL;
}

/* Numbers of cells along the dimension, where not all are there. */
static const fg__variable *find_numbers(const fg__mesh_search *search)
{
  char text[FG__TEXT_BYTES];
  const int dimension = search->u->dimension[search->k];
  for (size_t n = 0; n < search->data->variable_count; ++n) {
    const fg__variable *v = &search->data->variables[n];
    if (v->rank != 1 || !fg__is_array(v) || v->dimension[0] != dimension)
      continue;
    fg__attribute_text(v, "standard_name", text, sizeof text);
    if (strcmp(text, "healpix_index") == 0 ||
        strcmp(v->plain_name, search->data->dimensions[dimension].name) == 0)
      return v;
  }
  return NULL;
}

bool fg__find_healpix(fg__unstructured *out, fg__mesh_search *search)
{
  const size_t cells = search->data->dimensions[search->u->dimension[search->k]].length;
  const fg__variable *mapping = healpix_mapping(search);
  const fg__variable *root = fg__file_of(search->u);
  const fg__variable *variable[] = {mapping, search->u, root};
  char words[2 * FG__TEXT_BYTES] = "";
  bool ordered = false;
  for (int n = 0; n < 3 && !ordered; ++n)
    if (variable[n])
      ordered = order_of(&out->nested, variable[n], words, sizeof words);
  /* "order" alone may be of anything */
  if (!mapping && strncmp(words, "healpix", 7) != 0)
    return false;
  for (int n = 0; n < 3 && out->sides == 0; ++n)
    if (variable[n])
      out->sides = sides_of(variable[n]);
  if (out->sides == 0)
    out->sides = sides_of_count(cells);
  if (out->sides == 0)
    return false;
  const size_t all = 12 * (size_t)out->sides * (size_t)out->sides;
  out->pixel = find_numbers(search);
  if (cells > all || (cells < all && !out->pixel))
    return false; /* time or level */
  if (!ordered) {
    snprintf(search->lacks, sizeof search->lacks,
             "nothing says whether its %zu HEALPix cells are in ring or nested order",
             cells);
    return false;
  }
  out->location = FG__MESH_ON_FACES;
  snprintf(out->rule, sizeof out->rule,
           "east and north, on HEALPix cells, N_side %ld, %s order (%.120s)", out->sides,
           out->nested ? "nested" : "ring", words);
  return true;
}

/* Longitude and latitude along a dimension, or two: those that the variable names, else
 * the file's first. */
static bool find_positions(const fg__variable *out[2], const fg__mesh_search *search,
                           int rank)
{
  char names[FG__TEXT_BYTES];
  fg__attribute_text(search->u, "coordinates", names, sizeof names);
  for (int named = 1; named >= 0; --named) {
    out[0] = out[1] = NULL;
    for (size_t n = 0; n < search->data->variable_count; ++n) {
      const fg__variable *v = &search->data->variables[n];
      if (!fg__search_lies(search, v, rank) || (named && !strstr(names, v->plain_name)))
        continue;
      const fg__role role = v->geographic;
      if (role != FG__NO_ROLE && !out[role])
        out[role] = v;
    }
    if (out[0] && out[1])
      return true;
  }
  return false;
}

static bool find_bounds(fg__unstructured *out, const fg__mesh_search *search)
{
  for (int k = 0; k < 2; ++k) {
    char name[FG__TEXT_BYTES];
    fg__attribute_text(out->centre[k], "bounds", name, sizeof name);
    const fg__variable *v = name[0] ? fg__dataset_find(search->data, name) : NULL;
    if (!v || !fg__is_array(v) || v->rank != 2 ||
        v->dimension[0] != out->centre[k]->dimension[0] ||
        search->data->dimensions[v->dimension[1]].length < 3 ||
        (k == 1 && v->dimension[1] != out->bounds[0]->dimension[1]))
      return false;
    out->bounds[k] = v;
  }
  return true;
}

/* Whether places have times of their own: dates along their dimensions. */
static bool have_times(const fg__mesh_search *search, int rank)
{
  for (size_t n = 0; n < search->data->variable_count; ++n) {
    const fg__variable *v = &search->data->variables[n];
    if (fg__search_lies(search, v, rank) && fg__units_of(v, NULL, 0) == FG__QUANTITY_DATE)
      return true;
  }
  return false;
}

/* Places of no mesh, those of all times together. */
static void take_points(fg__unstructured *out, const fg__mesh_search *search,
                        const fg__variable *const at[2], int rank)
{
  out->node[0] = at[0];
  out->node[1] = at[1];
  out->centre[0] = out->centre[1] = NULL;
  snprintf(out->rule, sizeof out->rule,
           "east and north, on points%s at '%.40s', '%.40s'%s",
           rank == 2 ? " of trajectories" : "", at[0]->plain_name, at[1]->plain_name,
           have_times(search, rank) ? " at all their times" : "");
}

bool fg__find_coordinates(fg__unstructured *out, fg__mesh_search *search)
{
  if (!find_positions(out->centre, search, 1))
    return false;
  const fg__variable *x = out->centre[0], *y = out->centre[1];
  if (find_bounds(out, search)) {
    out->location = FG__MESH_ON_FACES;
    snprintf(out->rule, sizeof out->rule,
             "east and north, on cells at '%.40s', '%.40s' with %zu corners ('%.40s')",
             x->plain_name, y->plain_name,
             search->data->dimensions[out->bounds[0]->dimension[1]].length,
             out->bounds[0]->plain_name);
    return true;
  }
  out->bounds[0] = out->bounds[1] = NULL;
  take_points(out, search, (const fg__variable *const[]){x, y}, 1);
  return true;
}

/* CF's feature type trajectory as an array [trajectories][places] (appendix H.4.1), which
 * is no curvilinear grid. */
bool fg__find_trajectories(fg__unstructured *out, fg__mesh_search *search)
{
  char text[FG__TEXT_BYTES];
  const fg__variable *at[2], *u = search->u;
  const fg__variable *root = fg__file_of(u);
  if (u->rank != 2 || search->k != 1 ||
      !fg__attribute_text(root, "featureType", text, sizeof text) ||
      !fg__is_same(text, "trajectory") || !find_positions(at, search, 2))
    return false;
  out->rank = 2;
  out->before[0] = u->dimension[0];
  take_points(out, search, at, 2);
  return true;
}
