/* Whether variables can be a vector's components: numeric, not larger than the file can
 * hold, and at the same places. */
#include "read/netcdf/netcdf.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* Deflate compresses by at most 1032 (zlib's documentation); a field of more bytes than
 * that times the file's size is not in the file. */
static const size_t LARGEST_COMPRESSION = 1032;

/* So many times or levels of two files are compared. */
enum { MOST_COMPARED = 100000 };

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

/* Whether numbers differ by no more than rounding; what is none in both is the same.
 * Compares in blocks, so that a small file that declares large variables takes little
 * memory. */
static bool same_numbers(const fg__nc_variable *a, const fg__nc_variable *b, size_t n,
                         double rounding)
{
  enum { AT_ONCE = 4096 };
  double x[AT_ONCE], y[AT_ONCE];
  for (size_t start = 0; start < n; start += AT_ONCE) {
    const size_t count = n - start < AT_ONCE ? n - start : AT_ONCE;
    if (fg__nc_fetch(a, &start, &count, x) || fg__nc_fetch(b, &start, &count, y))
      return false;
    for (size_t i = 0; i < count; ++i)
      if (x[i] != y[i] && !(fabs(x[i] - y[i]) <= rounding) &&
          !(isnan(x[i]) && isnan(y[i])))
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
         same_numbers(of_a, of_b, n, 0.0);
}

/* Whether two coordinates of n numbers, in one unit, have a value that differs by more
 * than rounding. */
static bool differ(const fg__nc_variable *a, const fg__nc_variable *b, size_t n)
{
  const size_t last = n - 1;
  double first_value, last_value;
  char of_a[FG__NC_TEXT], of_b[FG__NC_TEXT];
  fg__nc_text(a, "units", of_a, sizeof of_a);
  fg__nc_text(b, "units", of_b, sizeof of_b);
  if (strcmp(of_a, of_b) != 0 || fg__nc_fetch_one(a, (size_t[]){0}, &first_value) ||
      fg__nc_fetch_one(a, &last, &last_value))
    return false;
  const double step = n > 1 ? fabs(last_value - first_value) / (double)last : 0.0;
  const double rounding = fmax(0.01 * step, 1e-6 * fabs(last_value));
  return !same_numbers(a, b, n, rounding);
}

/* Compares times, levels and what else is not in the plane where components have
 * different dimensions for them. */
static bool check_index_axes(fg__nc_grid *grid, const fg__nc_file *file,
                             const fg__nc_variable *u, const fg__nc_variable *v)
{
  int position[FG__NC_ROLES];
  fg__nc_roles(position, file, u);
  for (int k = 0; k < u->rank && u->rank == v->rank; ++k) {
    const int a = u->dimension[k], b = v->dimension[k];
    const size_t n = file->dimensions[a].length;
    if (k == position[FG__NC_X] || k == position[FG__NC_Y] || a == b ||
        n != file->dimensions[b].length || n > MOST_COMPARED)
      continue;
    const fg__nc_variable *x = fg__nc_coordinate(file, u, k);
    const fg__nc_variable *y = fg__nc_coordinate(file, v, k);
    if (!x || !y || !fits_file(file, x, n) || !fits_file(file, y, n) || !differ(x, y, n))
      continue;
    fg__set_unusable(grid->unusable,
                     "'%.60s' of '%.60s' and '%.60s' of '%.60s' have different values",
                     x->plain_name, u->plain_name, y->plain_name, v->plain_name);
    return false;
  }
  return true;
}

void fg__nc_check_shapes(fg__nc_grid *grid, const fg__nc_file *file,
                         const fg__nc_variable *u, const fg__nc_variable *v)
{
  char of_u[FG__NC_TEXT / 2];
  char of_v[FG__NC_TEXT / 2];
  if (!check_index_axes(grid, file, u, v))
    return;
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

void fg__nc_refuse_apart(fg__nc_grid *grid, const fg__nc_pair *pair)
{
  const fg__nc_variable *u = pair->component[0], *v = pair->component[1];
  const bool other = u->file != v->file;
  snprintf(grid->unusable, sizeof grid->unusable,
           "'%.60s' and '%.60s'%s%.200s lie more than half a cell apart: they are of "
           "different grids",
           u->plain_name, v->plain_name, other ? " of " : "", other ? v->path : "");
  grid->hint[0] = '\0';
}

void fg__nc_check_storage(fg__nc_grid *grid, const fg__nc_file *file,
                          const fg__nc_variable *v)
{
  if (!fits_file(file, v, grid->samples))
    fg__set_unusable(grid->unusable,
                     "'%.120s' has %zu samples, but the file has only %zu bytes", v->name,
                     grid->samples, file->sizes[v->file]);
}
