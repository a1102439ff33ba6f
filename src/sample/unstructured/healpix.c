/* HEALPix: twelve base pixels, each divided into sides * sides pixels of equal area
 * (Gorski, Hivon, Banday, Wandelt, Hansen, Reinecke, Bartelmann 2005, ApJ 622, 759). */
#include "base/memory.h"
#include "sample/unstructured/mesh.h"

#include <limits.h>
#include <math.h>
#include <stdlib.h>

enum { LOOKS_UP = 1 << 16 }; /* pixels between looks whether to stop */

static const double DEGREES_PER_RADIAN = 57.29577951308232;

/* The rows and columns of base pixels (equations 10 and 11 there): the ring of the lowest
 * corner in sides, and the longitude of the middle in eighths of a turn. */
static int row_of(int f)
{
  return f / 4 + 2;
}

static int column_of(int f)
{
  return 2 * (f % 4) - f / 4 % 2 + 1;
}

void fg__healpix_place(double at[2], long sides, int f, double x, double y)
{
  const double n = (double)sides;
  const double ring = row_of(f) - (x + y) / n;          /* from the north pole, 0 to 4 */
  const double cap = fmin(fmin(ring, 4.0 - ring), 1.0); /* 1 between the polar caps */
  const double z =
      cap < 1.0 ? copysign(1.0 - cap * cap / 3.0, 2.0 - ring) : (2.0 - ring) * 2.0 / 3.0;
  /* a cap narrows with its rings, about the middle of each quarter */
  const double eighths = column_of(f) + (cap > 0.0 ? (x - y) / n / cap : 0.0);
  at[0] = eighths * 45.0;
  at[1] = cap < 1.0 ? copysign(90.0 - 2.0 * asin(cap / sqrt(6.0)) * DEGREES_PER_RADIAN, z)
                    : asin(z) * DEGREES_PER_RADIAN;
}

/* Every second bit of a number, from `bit` on. */
static long every_second_bit(long long number, int bit)
{
  long out = 0;
  for (int k = 0; number >> (2 * k + bit) > 0; ++k)
    out |= (long)(number >> (2 * k + bit) & 1) << k;
  return out;
}

/* The ring of a pixel, 1 to 4 sides - 1, and its place in it, from 0. */
static void find_ring(long long *ring, long long *place, long long n, long long number)
{
  const long long cap = 2 * n * (n - 1), all = 12 * n * n;
  if (number >= cap && number < all - cap) {
    *ring = n + (number - cap) / (4 * n);
    *place = (number - cap) % (4 * n);
    return;
  }
  const long long from_pole = number < cap ? number : all - 1 - number;
  long long r = (long long)((1.0 + sqrt(1.0 + 2.0 * (double)from_pole)) / 2.0);
  while (2 * r * (r - 1) > from_pole)
    --r;
  while (2 * r * (r + 1) <= from_pole)
    ++r;
  const long long there = from_pole - 2 * r * (r - 1);
  *ring = number < cap ? r : 4 * n - r;
  *place = number < cap ? there : 4 * r - 1 - there;
}

/* The place in the ring is that of equation 13, which is solved for x - y in each base
 * pixel; x + y is that of the ring. */
static void find_in_ring(fg__healpix_pixel *out, long long n, long long number)
{
  long long ring, place;
  find_ring(&ring, &place, n, number);
  const long long north = ring < 4 * n - ring ? ring : 4 * n - ring;
  const long long length = north < n ? north : n; /* a quarter of the ring */
  const long long odd = north < n ? 0 : (ring - n) & 1;
  for (int f = 0; f < 12; ++f) {
    const long long sum = row_of(f) * n - ring - 1;
    long long difference = 2 * place + 1 - odd - column_of(f) * length;
    difference += difference < -4 * length ? 8 * length : 0;
    difference -= difference > 4 * length ? 8 * length : 0;
    const long long x = sum + difference, y = sum - difference; /* twice */
    if (x >= 0 && y >= 0 && x < 2 * n && y < 2 * n && x % 2 == 0)
      *out = (fg__healpix_pixel){f, (long)(x / 2), (long)(y / 2)};
  }
}

fg__healpix_pixel fg__healpix_find(long sides, long long number, bool nested)
{
  const long long n = sides, inside = number % (n * n);
  fg__healpix_pixel out = {(int)(number / (n * n)), every_second_bit(inside, 0),
                           every_second_bit(inside, 1)};
  if (!nested)
    find_in_ring(&out, n, number);
  return out;
}

static bool add_pixel(fg__mesh_topology *out, fg__node_table *table, size_t n, long sides,
                      const fg__healpix_pixel *pixel)
{
  const double x = (double)pixel->x, y = (double)pixel->y;
  double at[2];
  fg__healpix_place(at, sides, pixel->base, x + 0.5, y + 0.5);
  out->centre[0][n] = at[0];
  out->centre[1][n] = at[1];
  for (size_t c = 0; c < 4; ++c) {
    fg__healpix_place(at, sides, pixel->base, x + (c == 1 || c == 2), y + (c >= 2));
    out->node[4 * n + c] = fg__node_table_at(table, at[0], at[1]);
    if (out->node[4 * n + c] < 0)
      return false;
  }
  return true;
}

static fg_status read_numbers(double **out, const fg__dataset *data,
                              const fg__unstructured *mesh, size_t count)
{
  const double all = 12.0 * (double)mesh->sides * (double)mesh->sides;
  double *number = *out = fg__allocate(count, sizeof *number);
  fg_status status =
      number ? fg__read_all(number, data, mesh->pixel)
             : fg__fail_memory(data->context, "pixels", count * sizeof *number);
  for (size_t n = 0; n < count && status == FG_STATUS_OK; ++n)
    if (!(number[n] >= 0.0 && number[n] < all))
      status = fg__fail(data->context, FG_STATUS_FILE_FORMAT,
                        "%s: '%s' has pixel %.15g at %zu, but N_side %ld has pixels 0 to "
                        "%.15g",
                        mesh->pixel->path, mesh->pixel->name, number[n], n, mesh->sides,
                        all - 1.0);
  return status;
}

static fg_status add_pixels(fg__mesh_topology *out, const fg__dataset *data,
                            const double *number, const fg__unstructured *mesh)
{
  fg__node_table table = {0};
  bool memory = true;
  fg_status status = FG_STATUS_OK;
  for (size_t n = 0; n < out->count && memory && status == FG_STATUS_OK; ++n) {
    const fg__healpix_pixel pixel = fg__healpix_find(
        mesh->sides, number ? (long long)number[n] : (long long)n, mesh->nested);
    memory = add_pixel(out, &table, n, mesh->sides, &pixel);
    if (n % LOOKS_UP == 0)
      status = fg__check_stop(data->context);
  }
  out->nodes = table.nodes;
  for (int k = 0; k < 2; ++k) {
    out->at[k] = table.at[k];
    table.at[k] = NULL;
  }
  fg__node_table_clear(&table);
  return memory ? status : fg__fail_memory(data->context, "corners of pixels", 0);
}

fg_status fg__healpix_faces(fg__mesh_topology *out, const fg__dataset *data,
                            const fg__unstructured *mesh)
{
  const size_t count = mesh->pixel ? data->dimensions[mesh->pixel->dimension[0]].length
                                   : 12 * (size_t)mesh->sides * (size_t)mesh->sides;
  double *number = NULL;
  if (count >= INT_MAX / 8)
    return fg__fail(data->context, FG_STATUS_UNSUPPORTED,
                    "%s: %zu HEALPix cells are more than are handled", data->file[0].path,
                    count);
  out->count = count;
  out->first = fg__allocate(count + 1, sizeof *out->first);
  out->node = fg__allocate(count, 4 * sizeof *out->node);
  for (int k = 0; k < 2; ++k)
    out->centre[k] = fg__allocate(count, sizeof *out->centre[k]);
  if (!out->first || !out->node || !out->centre[0] || !out->centre[1])
    return fg__fail_memory(data->context, "pixels", count * 36);
  for (size_t n = 0; n <= count; ++n)
    out->first[n] = (int)(4 * n);
  fg_status status =
      mesh->pixel ? read_numbers(&number, data, mesh, count) : FG_STATUS_OK;
  if (status == FG_STATUS_OK)
    status = add_pixels(out, data, number, mesh);
  free(number);
  return status;
}
