/* Vectors of points as vectors in space, what is missing of them, and samples between. */
#include "base/memory.h"
#include "sphere/inside.h"

#include <stdlib.h>
#include <string.h>

void fg__sphere_destroy(fg__sphere *sphere)
{
  if (!sphere)
    return;
  for (int i = 0; i < sphere->texts; ++i)
    free(sphere->word[i]);
  for (int f = 0; f < FG__SPHERE_FACES; ++f) {
    free(sphere->face[f].start);
    free(sphere->face[f].cell);
  }
  free(sphere->vector);
  free(sphere->missing);
  free(sphere->position);
  free(sphere->corner);
  free(sphere);
}

static bool keep_text(fg__sphere *sphere, const char **slot, const char *text)
{
  *slot = NULL;
  if (!text)
    return true;
  char *copy = fg__copy_text(text);
  if (!copy)
    return false;
  sphere->word[sphere->texts++] = copy;
  *slot = copy;
  return true;
}

static bool keep_texts(fg__sphere *sphere, const fg_field_arrays *words)
{
  fg_field_arrays *own = &sphere->words;
  bool kept = true;
  for (int k = 0; k < 3; ++k)
    kept = kept && keep_text(sphere, &own->velocity_name[k], words->velocity_name[k]);
  return kept && keep_text(sphere, &own->velocity_units, words->velocity_units) &&
         keep_text(sphere, &own->title, words->title) &&
         keep_text(sphere, &own->time, words->time) &&
         keep_text(sphere, &own->level, words->level) &&
         keep_text(sphere, &own->projection, words->projection) &&
         keep_text(sphere, &own->doubts, words->doubts);
}

fg_status fg__sphere_begin(fg__sphere *sphere, fg_context *context, size_t points,
                           const fg_field_arrays *words)
{
  sphere->points = points;
  sphere->vector = fg__allocate(points, 3 * sizeof *sphere->vector);
  sphere->missing = fg__allocate(points, 1);
  if (!sphere->vector || !sphere->missing)
    return fg__fail_memory(context, "vectors on the sphere",
                           points * 3 * sizeof *sphere->vector);
  if (words && !keep_texts(sphere, words))
    return fg__fail_memory(context, "the field's words", 0);
  return FG_STATUS_OK;
}

void fg__sphere_all_set(fg__sphere *sphere, bool any_missing)
{
  if (any_missing)
    return;
  free(sphere->missing);
  sphere->missing = NULL;
}

/* Adds the corners of a cell that are not missing to those that are. */
static void share_in_cell(fg__sphere *sphere, unsigned *shares, const int point[4],
                          int corners)
{
  float *vector = sphere->vector;
  for (int a = 0; a < corners; ++a) {
    const size_t to = (size_t)point[a];
    if (!sphere->missing[to])
      continue;
    for (int b = 0; b < corners; ++b) {
      const size_t from = (size_t)point[b];
      if (sphere->missing[from])
        continue;
      for (size_t k = 0; k < 3; ++k)
        vector[3 * to + k] += vector[3 * from + k];
      ++shares[to];
    }
  }
}

fg_status fg__sphere_fill(fg__sphere *sphere, fg_context *context)
{
  if (!sphere->missing)
    return FG_STATUS_OK;
  unsigned *shares = fg__allocate(sphere->points, sizeof *shares);
  if (!shares)
    return fg__fail_memory(context, "points beside missing ones",
                           sphere->points * sizeof *shares);
  for (size_t n = 0; n < sphere->count; ++n) {
    int point[4];
    const int corners = fg__sphere_corners(sphere, n, point);
    share_in_cell(sphere, shares, point, corners);
  }
  for (size_t n = 0; n < sphere->points; ++n)
    for (size_t k = 0; k < 3 && sphere->missing[n]; ++k)
      sphere->vector[3 * n + k] =
          shares[n] > 0 ? sphere->vector[3 * n + k] / (float)shares[n] : NAN;
  free(shares);
  return FG_STATUS_OK;
}

bool fg__sphere_place_is_missing(const fg__sphere *sphere, const fg__sphere_place *place)
{
  int nearest = 0;
  for (int k = 1; k < 4; ++k)
    if (place->weight[k] > place->weight[nearest])
      nearest = k;
  const int point = place->point[nearest];
  return sphere->missing && point >= 0 && sphere->missing[point];
}

static const float *vector_of(const fg__sphere *sphere, int point)
{
  if (point < 0)
    return sphere->pole[point == FG__SPHERE_NORTH];
  return sphere->vector + 3 * (size_t)point;
}

static void add_vector(double sum[3], const fg__sphere *sphere,
                       const fg__sphere_place *place)
{
  for (int k = 0; k < 4; ++k) {
    if (place->weight[k] == 0.0)
      continue;
    const float *vector = vector_of(sphere, place->point[k]);
    for (int c = 0; c < 3; ++c)
      sum[c] += place->weight[k] * (double)vector[c];
  }
}

static bool find_in_grid(fg__sphere_place *out, const fg__sphere *sphere,
                         double longitude, double latitude)
{
  return fg__sphere_place_in_grid(out, sphere, longitude, latitude) &&
         !fg__sphere_place_is_missing(sphere, out);
}

void fg__sphere_sample(float *east, float *north, const fg__sphere *sphere, size_t n,
                       const double *longitude, const double *latitude)
{
  int hint = -1;
  for (size_t i = 0; i < n; ++i) {
    east[i] = north[i] = NAN;
    if (!isfinite(longitude[i]) || !(fabs(latitude[i]) <= 90.0))
      continue;
    const fg__sphere_frame at = fg__sphere_frame_at(longitude[i], latitude[i]);
    fg__sphere_place place;
    if (sphere->field ? !find_in_grid(&place, sphere, longitude[i], latitude[i])
                      : !fg__sphere_place_in_cells(&place, sphere, at.up, &hint))
      continue;
    double w[3] = {0.0, 0.0, 0.0};
    add_vector(w, sphere, &place);
    east[i] = (float)fg__dot(w, at.east);
    north[i] = (float)fg__dot(w, at.north);
  }
}

size_t fg__sphere_add(double sum[3], const fg__sphere *sphere, size_t n,
                      const double (*up)[3], int *hint)
{
  size_t found = 0;
  for (size_t i = 0; i < n; ++i) {
    fg__sphere_place place;
    if (sphere->field
            ? !find_in_grid(&place, sphere, atan2(up[i][1], up[i][0]) / FG__RADIANS,
                            asin(fmax(-1.0, fmin(up[i][2], 1.0))) / FG__RADIANS)
            : !fg__sphere_place_in_cells(&place, sphere, up[i], hint))
      continue;
    add_vector(sum, sphere, &place);
    ++found;
  }
  return found;
}

void fg__sphere_extent_of(fg__sphere_extent *out, const fg__sphere *sphere)
{
  *out = sphere->extent;
}

size_t fg__sphere_places(double *longitude, double *latitude, const fg__sphere *sphere,
                         size_t most)
{
  size_t count = 0;
  if (!sphere->position)
    return 0;
  const size_t step = sphere->points / (most ? most : 1) + 1;
  for (size_t n = 0; n < sphere->points && count < most; n += step) {
    const double *up = sphere->position + 3 * n;
    if (!isfinite(up[0]) || (sphere->missing && sphere->missing[n]))
      continue;
    longitude[count] = atan2(up[1], up[0]) / FG__RADIANS;
    latitude[count++] = asin(fmin(fmax(up[2], -1.0), 1.0)) / FG__RADIANS;
  }
  return count;
}

const fg_field_arrays *fg__sphere_words(const fg__sphere *sphere)
{
  return &sphere->words;
}
