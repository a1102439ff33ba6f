/* Whether variables can be a vector's components: numeric, not larger than the file can
 * hold, and at the same places. */
#include "read/netcdf/netcdf.h"

#include <stdio.h>
#include <string.h>

/* Deflate compresses by at most 1032 (zlib's documentation); a field of more bytes than
 * that times the file's size is not in the file. */
static const size_t LARGEST_COMPRESSION = 1032;

static void write_shape(char *out, size_t size, const fg__nc_file *file,
                        const fg__nc_variable *v)
{
  size_t n = 0;
  out[0] = '\0';
  for (int k = 0; k < v->rank && k < FG__NC_RANK && n < size; ++k)
    n += (size_t)snprintf(out + n, size - n, "%s%zu", k > 0 ? " x " : "",
                          file->dimensions[v->dimension[k]].length);
}

void fg__nc_check_variable(fg__nc_grid *grid, const fg__nc_variable *v)
{
  if (v->type == NC_CHAR || v->type == NC_STRING)
    fg__set_unusable(grid->unusable, "'%s' holds text, not numbers", v->name);
  else if (v->type < NC_BYTE || v->type > NC_UINT64)
    fg__set_unusable(grid->unusable,
                     "'%s' is of a type made by its author, not of numbers", v->name);
  else if (v->rank < 2)
    fg__set_unusable(grid->unusable, "'%s' has %d dimension%s; a field has two or more",
                     v->name, v->rank, v->rank == 1 ? "" : "s");
  else if (v->rank > FG__NC_RANK)
    fg__set_unusable(grid->unusable, "'%s' has more than %d dimensions", v->name,
                     FG__NC_RANK);
}

static bool fits_file(const fg__nc_file *file, const fg__nc_variable *v, size_t samples)
{
  size_t width = 1;
  return nc_inq_type(v->group, v->type, NULL, &width) != NC_NOERR ||
         samples / LARGEST_COMPRESSION * width <= file->sizes[v->file];
}

/* Compares in blocks, so that a small file that declares large variables takes little
 * memory. */
static bool same_numbers(const fg__nc_variable *a, const fg__nc_variable *b, size_t n)
{
  enum { AT_ONCE = 4096 };
  double x[AT_ONCE], y[AT_ONCE];
  for (size_t start = 0; start < n; start += AT_ONCE) {
    const size_t count = n - start < AT_ONCE ? n - start : AT_ONCE;
    if (fg__nc_fetch(a, &start, &count, x) || fg__nc_fetch(b, &start, &count, y) ||
        memcmp(x, y, count * sizeof *x) != 0)
      return false;
  }
  return true;
}

static bool same_coordinates(const fg__nc_file *file, const fg__nc_variable *a,
                             const fg__nc_variable *b, int k)
{
  const size_t n = file->dimensions[a->dimension[k]].length;
  const fg__nc_variable *of_a = fg__nc_coordinate(file, a, k);
  const fg__nc_variable *of_b = fg__nc_coordinate(file, b, k);
  /* where a third file has the positions, they are found by the dimensions' names */
  const bool by_name = file->root_count > file->component_files;
  if (!of_a || !of_b)
    return !of_a && !of_b && a->file != b->file &&
           (!by_name || strcmp(file->dimensions[a->dimension[k]].name,
                               file->dimensions[b->dimension[k]].name) == 0);
  return fits_file(file, of_a, n) && fits_file(file, of_b, n) &&
         same_numbers(of_a, of_b, n);
}

void fg__nc_check_shapes(fg__nc_grid *grid, const fg__nc_file *file,
                         const fg__nc_variable *u, const fg__nc_variable *v)
{
  char of_u[FG__NC_TEXT / 2];
  char of_v[FG__NC_TEXT / 2];
  write_shape(of_u, sizeof of_u, file, u);
  write_shape(of_v, sizeof of_v, file, v);
  if (strcmp(of_u, of_v) != 0) {
    grid->off_axes = true;
    fg__set_unusable(grid->unusable, "'%.60s' is %s, '%.60s' is %s samples%s",
                     u->plain_name, of_u, v->plain_name, of_v,
                     u->rank == v->rank ? ": a staggered grid" : "");
    return;
  }
  for (int k = 0; k < u->rank; ++k)
    if (u->dimension[k] != v->dimension[k] && !same_coordinates(file, u, v, k)) {
      grid->off_axes = true;
      fg__set_unusable(
          grid->unusable,
          "'%.60s' runs along '%.60s', '%.60s' along '%.60s': a staggered grid",
          u->plain_name, file->dimensions[u->dimension[k]].name, v->plain_name,
          file->dimensions[v->dimension[k]].name);
    }
}

void fg__nc_check_storage(fg__nc_grid *grid, const fg__nc_file *file,
                          const fg__nc_variable *v)
{
  if (!fits_file(file, v, grid->samples))
    fg__set_unusable(grid->unusable,
                     "'%.120s' has %zu samples, but the file has only %zu bytes", v->name,
                     grid->samples, file->sizes[v->file]);
}
