/* Which arrays of a file are the vectors. */
#include "base/memory.h"
#include "base/names.h"
#include "read/vtk/vtk.h"
#include "terms/vectors.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Vectors that the file marks as such come first, then vector variables, then those of
 * several arrays. */
enum { MARKED = 0, WHOLE_ARRAY, BY_NAMES };

/* The first piece speaks for all. */
static const fg__vtk_array *arrays_of_file(const fg__vtk *vtk, size_t *count)
{
  *count = vtk->piece_count > 0 ? vtk->pieces[0].array_count : 0;
  return *count > 0 ? fg__vtk_home(vtk, 0)->arrays + vtk->pieces[0].first_array : NULL;
}

static bool is_float(const fg__vtk_array *array)
{
  return array->type == FG__VTK_FLOAT32 || array->type == FG__VTK_FLOAT64;
}

static bool is_of_grid(const fg__vtk_array *array)
{
  return array->place == FG__VTK_POINTS || array->place == FG__VTK_CELLS;
}

static bool is_active(const fg__vtk *vtk, const fg__vtk_array *array)
{
  const char *name =
      is_of_grid(array) ? fg__vtk_home(vtk, 0)->vectors[array->place] : NULL;
  return name && strcmp(name, array->name) == 0;
}

static bool has_vectors(const fg__vtk_array *array)
{
  return fg__vtk_size_of(array->type) > 0 &&
         (array->components == 2 || array->components == 3);
}

/* Three bytes are a colour more often than a velocity: whole numbers count only when the
 * file calls them vectors. */
static bool is_vector(const fg__vtk *vtk, const fg__vtk_array *array)
{
  return is_of_grid(array) && has_vectors(array) && !array->no_velocity &&
         (is_float(array) || is_active(vtk, array));
}

static fg__vtk_vector vector_of(const fg__vtk *vtk, const fg__vtk_array *array)
{
  return (fg__vtk_vector){.name = {array->name},
                          .names = 1,
                          .components = array->components,
                          .place = array->place,
                          .rank = is_active(vtk, array) ? MARKED : WHOLE_ARRAY,
                          .found_by = is_active(vtk, array) ? "Vectors attribute"
                                                            : "vector variable",
                          .units = array->units};
}

static bool is_scalar(const fg__vtk_array *array)
{
  return is_of_grid(array) && array->components == 1 && fg__vtk_size_of(array->type) > 0;
}

static bool is_component(const fg__vtk_array *array)
{
  return is_scalar(array) && is_float(array) && !array->no_velocity;
}

static fg_status add(fg__vtk_vector **out, size_t *count, size_t *capacity,
                     const fg__vtk *vtk, fg__vtk_vector vector)
{
  void *vectors = *out;
  if (!fg__grow(&vectors, capacity, *count + 1, sizeof **out))
    return fg__fail_memory(vtk->context, "a list of vectors", *count * sizeof **out);
  *out = vectors;
  (*out)[(*count)++] = vector;
  return FG_STATUS_OK;
}

/* The arrays that may be components, with points and cells as groups. */
static fg__term *list_components(size_t *count, const fg__vtk *vtk)
{
  size_t arrays;
  const fg__vtk_array *array = arrays_of_file(vtk, &arrays);
  fg__term *terms = fg__allocate(arrays, sizeof *terms);
  *count = 0;
  for (size_t i = 0; i < arrays && terms; ++i)
    if (is_component(&array[i]))
      terms[(*count)++] = (fg__term){.name = array[i].name,
                                     .units = array[i].units,
                                     .group = array[i].place,
                                     .file = -1};
  return terms;
}

/* Adds vectors of so many arrays, by their names. */
static fg_status add_named(fg__vtk_vector **out, size_t *count, size_t *capacity,
                           const fg__vtk *vtk, int components)
{
  static const fg__vector_rules rules = {0};
  fg__vector *found = NULL;
  size_t terms, all = 0;
  fg__term *term = list_components(&terms, vtk);
  fg_status status = term && fg__vectors_find(&found, &all, term, terms, &rules)
                         ? FG_STATUS_OK
                         : fg__fail_memory(vtk->context, "names of arrays", 0);
  for (size_t i = 0; i < all && status == FG_STATUS_OK; ++i) {
    const int *c = found[i].component;
    if (found[i].is_upright || found[i].polar.sense != 0 || (components == 3 && c[2] < 0))
      continue;
    const bool volume = components == 3;
    status = add(out, count, capacity, vtk,
                 (fg__vtk_vector){.name = {term[c[0]].name, term[c[1]].name,
                                           volume ? term[c[2]].name : NULL},
                                  .names = components,
                                  .components = components,
                                  .place = (fg__vtk_place)term[c[0]].group,
                                  .rank = BY_NAMES + found[i].rank,
                                  .found_by = found[i].found_by,
                                  .units = term[c[0]].units});
  }
  free(found);
  free(term);
  return status;
}

static bool is_the_same(const fg__vtk_vector *a, const fg__vtk_vector *b)
{
  if (a->names != b->names)
    return false;
  for (int k = 0; k < a->names; ++k)
    if (strcmp(a->name[k], b->name[k]) != 0)
      return false;
  return true;
}

/* Leaves one of the vectors that have one name: a name on points and on cells is one
 * quantity, of which the one that is marked is taken, else the points'. */
static size_t drop_repeated(fg__vtk_vector *vectors, size_t count)
{
  size_t kept = 0;
  for (size_t i = 0; i < count; ++i) {
    size_t k = 0;
    while (k < kept && !is_the_same(&vectors[k], &vectors[i]))
      ++k;
    const int better = k < kept ? vectors[k].rank - vectors[i].rank : 1;
    if (better > 0 || (better == 0 && vectors[i].place == FG__VTK_POINTS))
      vectors[k] = vectors[i];
    kept += k == kept;
  }
  return kept;
}

/* Those of so many components; 0: two or three, arrays in pairs. */
static fg_status list_vectors(fg__vtk_vector **out, size_t *count, const fg__vtk *vtk,
                              int components)
{
  *out = NULL;
  *count = 0;
  size_t capacity = 0;
  fg_status status = FG_STATUS_OK;
  size_t arrays;
  const fg__vtk_array *array = arrays_of_file(vtk, &arrays);
  for (size_t i = 0; i < arrays && status == FG_STATUS_OK; ++i, ++array) {
    if (is_vector(vtk, array) && (components == 0 || array->components == components))
      status = add(out, count, &capacity, vtk, vector_of(vtk, array));
  }
  if (status == FG_STATUS_OK)
    status = add_named(out, count, &capacity, vtk, components == 3 ? 3 : 2);
  if (*count > 0)
    *count = drop_repeated(*out, *count);
  if (status != FG_STATUS_OK) {
    free(*out);
    *out = NULL;
    *count = 0;
  }
  return status;
}

fg_status fg__vtk_vectors(fg__vtk_vector **out, size_t *count, const fg__vtk *vtk)
{
  if (fg__vtk_is_volume(vtk)) {
    fg_status status = list_vectors(out, count, vtk, 3);
    if (status != FG_STATUS_OK || *count > 0)
      return status;
  }
  return list_vectors(out, count, vtk, 0);
}

static const fg__vtk_array *find_anywhere(const fg__vtk *vtk, const char *name)
{
  const fg__vtk_array *array = fg__vtk_find(vtk, 0, FG__VTK_POINTS, name);
  return array ? array : fg__vtk_find(vtk, 0, FG__VTK_CELLS, name);
}

static fg__names list_names(const fg__vtk *vtk)
{
  size_t arrays;
  fg__names names = {0};
  const fg__vtk_array *array = arrays_of_file(vtk, &arrays);
  for (size_t i = 0; i < arrays; ++i, ++array)
    if (array->place != FG__VTK_CELLS ||
        !fg__vtk_find(vtk, 0, FG__VTK_POINTS, array->name))
      fg__names_add(&names, ", ", "%s", array->name);
  if (names.count == 0)
    fg__names_add(&names, ", ", "none");
  return names;
}

fg_status fg__vtk_fail_unknown(const fg__vtk *vtk, const char *name)
{
  fg_status status = fg__fail(vtk->context, FG_STATUS_ARGUMENT,
                              "%s: there is no variable \"%.100s\"", vtk->path, name);
  fg__hint(vtk->context, "the variables are: %s", list_names(vtk).text);
  return status;
}

static fg_status choose_scalars(fg__vtk_vector *out, const fg__vtk *vtk, char *names)
{
  *out = (fg__vtk_vector){.found_by = "--vars"};
  char *rest = names;
  while (rest) {
    char *name = rest;
    rest = strchr(rest, ',');
    if (rest)
      *rest++ = '\0';
    if (out->names == 3)
      return fg__fail(vtk->context, FG_STATUS_ARGUMENT,
                      "%s: more than three variables are named", vtk->path);
    const fg__vtk_array *array = out->names == 0 ? find_anywhere(vtk, name)
                                                 : fg__vtk_find(vtk, 0, out->place, name);
    if (!array && find_anywhere(vtk, name))
      return fg__fail(vtk->context, FG_STATUS_ARGUMENT,
                      "%s: \"%.100s\" and \"%.100s\" lie on different places, points and "
                      "cells",
                      vtk->path, out->name[0], name);
    if (!array)
      return fg__vtk_fail_unknown(vtk, name);
    if (!is_scalar(array))
      return fg__fail(vtk->context, FG_STATUS_ARGUMENT,
                      "%s: \"%.100s\" has %d components; one of several variables must "
                      "have one",
                      vtk->path, name, array->components);
    out->place = array->place;
    out->units = array->units;
    out->name[out->names++] = name;
  }
  out->components = out->names;
  return FG_STATUS_OK;
}

static fg_status choose_named(fg__vtk_vector *out, char **names_storage,
                              const fg__vtk *vtk, const char *vars)
{
  const fg__vtk_array *array = find_anywhere(vtk, vars);
  if (array && has_vectors(array)) {
    *out = vector_of(vtk, array);
    out->found_by = "--vars";
    return FG_STATUS_OK;
  }
  if (array)
    return fg__fail(vtk->context, FG_STATUS_ARGUMENT,
                    "%s: \"%.100s\" has %d component%s, not 2 or 3", vtk->path, vars,
                    array->components, array->components == 1 ? "" : "s");
  if (!strchr(vars, ','))
    return fg__vtk_fail_unknown(vtk, vars);
  *names_storage = fg__copy_text(vars);
  if (!*names_storage)
    return fg__fail_memory(vtk->context, "names of variables", strlen(vars) + 1);
  return choose_scalars(out, vtk, *names_storage);
}

static void describe(char *text, size_t size, const fg__vtk_vector *vector)
{
  if (vector->names == 1)
    snprintf(text, size, "%.100s", vector->name[0]);
  else if (vector->names == 2)
    snprintf(text, size, "%.80s,%.80s", vector->name[0], vector->name[1]);
  else
    snprintf(text, size, "%.80s,%.80s,%.80s", vector->name[0], vector->name[1],
             vector->name[2]);
}

static fg_status fail_ambiguous(const fg__vtk *vtk, const fg__vtk_vector *vectors,
                                size_t count)
{
  char one[256];
  fg__names all = {0};
  for (size_t i = 0; i < count; ++i) {
    describe(one, sizeof one, &vectors[i]);
    fg__names_add(&all, " | ", "%s", one);
  }
  fg_status status =
      fg__fail(vtk->context, FG_STATUS_ARGUMENT, "%s: %zu vectors could be meant: %s",
               vtk->path, count, all.text);
  describe(one, sizeof one, &vectors[0]);
  fg__hint(vtk->context, "choose one: --vars %s", one);
  return status;
}

static fg_status fail_none(const fg__vtk *vtk)
{
  return fg__fail(vtk->context, FG_STATUS_UNSUPPORTED,
                  "%s: holds no vectors; its variables: %s", vtk->path,
                  list_names(vtk).text);
}

static fg_status choose_among(fg__vtk_vector *out, const fg__vtk *vtk,
                              fg__vtk_vector *vectors, size_t count)
{
  int best = vectors[0].rank;
  for (size_t i = 1; i < count; ++i)
    best = vectors[i].rank < best ? vectors[i].rank : best;
  size_t kept = 0;
  for (size_t i = 0; i < count; ++i)
    if (vectors[i].rank == best)
      vectors[kept++] = vectors[i];
  if (kept > 1)
    return fail_ambiguous(vtk, vectors, kept);
  *out = vectors[0];
  return FG_STATUS_OK;
}

fg_status fg__vtk_choose(fg__vtk_vector *out, char **names_storage, const fg__vtk *vtk,
                         const char *vars)
{
  *names_storage = NULL;
  if (vars)
    return choose_named(out, names_storage, vtk, vars);
  fg__vtk_vector *vectors = NULL;
  size_t count = 0;
  fg_status status = fg__vtk_vectors(&vectors, &count, vtk);
  if (status == FG_STATUS_OK)
    status = count > 0 ? choose_among(out, vtk, vectors, count) : fail_none(vtk);
  free(vectors);
  return status;
}
