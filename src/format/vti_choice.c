/* Which arrays of a file are the vectors. */
#include "base/memory.h"
#include "format/vti.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* The first piece speaks for all. */
static const fg__vti_array *arrays_of_file(const fg__vti *vti, size_t *count)
{
  *count = vti->piece_count > 0 ? vti->pieces[0].array_count : 0;
  return vti->piece_count > 0 ? vti->arrays + vti->pieces[0].first_array : NULL;
}

static bool is_float(const fg__vti_array *array)
{
  return array->type == FG__VTI_FLOAT32 || array->type == FG__VTI_FLOAT64;
}

static bool is_active(const fg__vti *vti, const fg__vti_array *array)
{
  const char *name = vti->vectors[array->place];
  return name && strcmp(name, array->name) == 0;
}

static bool has_vectors(const fg__vti_array *array)
{
  return array->type != FG__VTI_UNKNOWN &&
         (array->components == 2 || array->components == 3);
}

/* Three bytes are a colour more often than a velocity: whole numbers count only when the
 * file calls them vectors. */
static bool is_vector(const fg__vti *vti, const fg__vti_array *array)
{
  return has_vectors(array) && (is_float(array) || is_active(vti, array));
}

static fg__vti_vector vector_of(const fg__vti *vti, const fg__vti_array *array)
{
  return (fg__vti_vector){.name = {array->name},
                          .names = 1,
                          .components = array->components,
                          .place = array->place,
                          .found_by = is_active(vti, array) ? "Vectors attribute"
                                                            : "vector variable",
                          .units = array->units};
}

/* "u10" for letter "u" and a name "v10"-like: names that differ in one letter, u against
 * v or x against y, at their beginning or end or before figures: u v, U V, vx vy, u10
 * v10, velocity_x velocity_y; but not bare x and y, which are coordinates. */
static bool are_a_pair(const char *first, const char *second)
{
  static const char *const letters[] = {"uv", "UV", "xy", "XY"};
  size_t length = strlen(first), at = 0;
  if (length != strlen(second) || length == 0)
    return false;
  while (at < length && first[at] == second[at])
    ++at;
  if (at == length || strcmp(first + at + 1, second + at + 1) != 0)
    return false;
  bool known = false;
  for (size_t k = 0; k < 4; ++k)
    known = known || (first[at] == letters[k][0] && second[at] == letters[k][1]);
  size_t figures = strspn(first + at + 1, "0123456789_");
  bool coordinates = length == 1 && (first[0] == 'x' || first[0] == 'X');
  return known && !coordinates && (at == 0 || at + 1 + figures == length);
}

static bool is_scalar(const fg__vti_array *array)
{
  return array->components == 1 && array->type != FG__VTI_UNKNOWN;
}

static fg_status add(fg__vti_vector **out, size_t *count, size_t *capacity,
                     const fg__vti *vti, fg__vti_vector vector)
{
  void *vectors = *out;
  if (!fg__grow(&vectors, capacity, *count + 1, sizeof **out))
    return fg__fail_memory(vti->context, "a list of vectors", *count * sizeof **out);
  *out = vectors;
  (*out)[(*count)++] = vector;
  return FG_STATUS_OK;
}

static fg_status add_pairs(fg__vti_vector **out, size_t *count, size_t *capacity,
                           const fg__vti *vti, const fg__vti_array *first)
{
  size_t arrays;
  const fg__vti_array *second = arrays_of_file(vti, &arrays);
  for (size_t i = 0; i < arrays; ++i, ++second) {
    if (second->place != first->place || !is_scalar(second) || !is_float(second) ||
        !are_a_pair(first->name, second->name))
      continue;
    fg_status status = add(out, count, capacity, vti,
                           (fg__vti_vector){.name = {first->name, second->name},
                                            .names = 2,
                                            .components = 2,
                                            .place = first->place,
                                            .found_by = "names",
                                            .units = first->units});
    if (status != FG_STATUS_OK)
      return status;
  }
  return FG_STATUS_OK;
}

fg_status fg__vti_vectors(fg__vti_vector **out, size_t *count, const fg__vti *vti)
{
  *out = NULL;
  *count = 0;
  size_t capacity = 0;
  fg_status status = FG_STATUS_OK;
  size_t arrays;
  const fg__vti_array *array = arrays_of_file(vti, &arrays);
  for (size_t i = 0; i < arrays && status == FG_STATUS_OK; ++i, ++array) {
    if (is_vector(vti, array))
      status = add(out, count, &capacity, vti, vector_of(vti, array));
    else if (is_scalar(array) && is_float(array))
      status = add_pairs(out, count, &capacity, vti, array);
  }
  if (status != FG_STATUS_OK) {
    free(*out);
    *out = NULL;
    *count = 0;
  }
  return status;
}

/* ---- by the user's word
 * ---------------------------------------------------------------- */

static const fg__vti_array *find_anywhere(const fg__vti *vti, const char *name)
{
  const fg__vti_array *array = fg__vti_find(vti, 0, FG__VTI_POINTS, name);
  return array ? array : fg__vti_find(vti, 0, FG__VTI_CELLS, name);
}

static void list_names(char *text, size_t size, const fg__vti *vti)
{
  size_t arrays, used = 0;
  const fg__vti_array *array = arrays_of_file(vti, &arrays);
  snprintf(text, size, "none");
  for (size_t i = 0; i < arrays && used < size; ++i, ++array)
    used += (size_t)snprintf(text + used, size - used, "%s%.100s", i ? ", " : "",
                             array->name);
}

fg_status fg__vti_fail_unknown(const fg__vti *vti, const char *name)
{
  char names[512];
  list_names(names, sizeof names, vti);
  fg_status status = fg__fail(vti->context, FG_STATUS_ARGUMENT,
                              "%s: there is no variable \"%.100s\"", vti->path, name);
  fg__hint(vti->context, "the variables are: %s", names);
  return status;
}

static fg_status choose_scalars(fg__vti_vector *out, const fg__vti *vti, char *names)
{
  *out = (fg__vti_vector){.found_by = "--vars"};
  char *rest = names;
  while (rest) {
    char *name = rest;
    rest = strchr(rest, ',');
    if (rest)
      *rest++ = '\0';
    if (out->names == 3)
      return fg__fail(vti->context, FG_STATUS_ARGUMENT,
                      "%s: more than three variables are named", vti->path);
    const fg__vti_array *array = out->names == 0 ? find_anywhere(vti, name)
                                                 : fg__vti_find(vti, 0, out->place, name);
    if (!array && find_anywhere(vti, name))
      return fg__fail(vti->context, FG_STATUS_ARGUMENT,
                      "%s: \"%.100s\" and \"%.100s\" lie on different places, points and "
                      "cells",
                      vti->path, out->name[0], name);
    if (!array)
      return fg__vti_fail_unknown(vti, name);
    if (!is_scalar(array))
      return fg__fail(vti->context, FG_STATUS_ARGUMENT,
                      "%s: \"%.100s\" has %d components; one of several variables must "
                      "have one",
                      vti->path, name, array->components);
    out->place = array->place;
    out->units = array->units;
    out->name[out->names++] = name;
  }
  out->components = out->names;
  return FG_STATUS_OK;
}

static fg_status choose_named(fg__vti_vector *out, char **names_storage,
                              const fg__vti *vti, const char *vars)
{
  const fg__vti_array *array = find_anywhere(vti, vars);
  if (array && has_vectors(array)) {
    *out = vector_of(vti, array);
    out->found_by = "--vars";
    return FG_STATUS_OK;
  }
  if (array)
    return fg__fail(vti->context, FG_STATUS_ARGUMENT,
                    "%s: \"%.100s\" has %d component%s, not 2 or 3", vti->path, vars,
                    array->components, array->components == 1 ? "" : "s");
  if (!strchr(vars, ','))
    return fg__vti_fail_unknown(vti, vars);
  *names_storage = fg__copy_text(vars);
  if (!*names_storage)
    return fg__fail_memory(vti->context, "names of variables", strlen(vars) + 1);
  return choose_scalars(out, vti, *names_storage);
}

/* ---- by themselves
 * ---------------------------------------------------------------------- */

static void describe(char *text, size_t size, const fg__vti_vector *vector)
{
  if (vector->names == 1)
    snprintf(text, size, "%.100s", vector->name[0]);
  else
    snprintf(text, size, "%.100s,%.100s", vector->name[0], vector->name[1]);
}

static fg_status fail_ambiguous(const fg__vti *vti, const fg__vti_vector *vectors,
                                size_t count)
{
  char all[1024] = "", one[256];
  for (size_t i = 0; i < count; ++i) {
    describe(one, sizeof one, &vectors[i]);
    size_t used = strlen(all);
    snprintf(all + used, sizeof all - used, "%s%s", used ? " | " : "", one);
  }
  fg_status status =
      fg__fail(vti->context, FG_STATUS_ARGUMENT, "%s: %zu vectors could be meant: %s",
               vti->path, count, all);
  describe(one, sizeof one, &vectors[0]);
  fg__hint(vti->context, "choose one: --vars %s", one);
  return status;
}

static fg_status fail_none(const fg__vti *vti)
{
  char names[512];
  list_names(names, sizeof names, vti);
  return fg__fail(vti->context, FG_STATUS_UNSUPPORTED,
                  "%s: holds no vectors; its variables: %s", vti->path, names);
}

/* Vectors that the file marks as such come first, then vector variables, then pairs. One
 * name on points and on cells is one quantity: the points' is taken. */
static int rank(const fg__vti *vti, const fg__vti_vector *vector)
{
  if (vector->names > 1)
    return 2;
  const char *active = vti->vectors[vector->place];
  return active && strcmp(active, vector->name[0]) == 0 ? 0 : 1;
}

static bool is_the_same(const fg__vti_vector *a, const fg__vti_vector *b)
{
  if (a->names != b->names)
    return false;
  for (int k = 0; k < a->names; ++k)
    if (strcmp(a->name[k], b->name[k]) != 0)
      return false;
  return true;
}

static fg_status choose_among(fg__vti_vector *out, const fg__vti *vti,
                              fg__vti_vector *vectors, size_t count)
{
  int best = 2;
  for (size_t i = 0; i < count; ++i)
    if (rank(vti, &vectors[i]) < best)
      best = rank(vti, &vectors[i]);
  size_t kept = 0;
  for (size_t i = 0; i < count; ++i) {
    bool known = rank(vti, &vectors[i]) != best;
    for (size_t k = 0; k < kept && !known; ++k)
      if (is_the_same(&vectors[k], &vectors[i])) {
        known = true;
        if (vectors[i].place == FG__VTI_POINTS)
          vectors[k] = vectors[i];
      }
    if (!known)
      vectors[kept++] = vectors[i];
  }
  if (kept > 1)
    return fail_ambiguous(vti, vectors, kept);
  *out = vectors[0];
  return FG_STATUS_OK;
}

fg_status fg__vti_choose(fg__vti_vector *out, char **names_storage, const fg__vti *vti,
                         const char *vars)
{
  *names_storage = NULL;
  if (vars)
    return choose_named(out, names_storage, vti, vars);
  fg__vti_vector *vectors = NULL;
  size_t count = 0;
  fg_status status = fg__vti_vectors(&vectors, &count, vti);
  if (status == FG_STATUS_OK)
    status = count > 0 ? choose_among(out, vti, vectors, count) : fail_none(vti);
  free(vectors);
  return status;
}
