/* Whether variables can be a vector's components: numeric, not larger than the file can
 * hold, and at the same places. */
#include "interpret/interpret.h"
#include "terms/names.h"
#include "terms/text.h"
#include "terms/units.h"

#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

/* Deflate compresses by at most 1032 (zlib's documentation); a field of more bytes than
 * that times the file's size is not in the file. */
static const size_t LARGEST_COMPRESSION = 1032;

/* The most times or levels of two files that are compared. */
enum { MOST_COMPARED = 100000 };

static void write_shape(char *out, size_t size, const fg__dataset *data,
                        const fg__variable *v)
{
  size_t n = 0;
  out[0] = '\0';
  for (int k = 0; k < v->rank && k < FG__RANK && n < size; ++k)
    n += (size_t)snprintf(out + n, size - n, "%s%zu", k > 0 ? " x " : "",
                          data->dimensions[v->dimension[k]].length);
}

/* An attribute of the packing that is a text, but no number; NULL: none. */
static const char *unread_packing(const fg__variable *v)
{
  static const char *const names[] = {"scale_factor", "add_offset"};
  double number;
  for (int n = 0; n < 2; ++n) {
    const fg__attribute *a = fg__attribute_find(v, names[n]);
    if (a && a->text && fg__attribute_numbers(v, names[n], &number, 1) == 0)
      return names[n];
  }
  return NULL;
}

void fg__check_packing(fg__grid *grid, const fg__pair *pair)
{
  fg__packing of[2];
  bool packed[2];
  for (int k = 0; k < 2; ++k) {
    const fg__variable *v = pair->component[k];
    const char *const unread = unread_packing(v);
    of[k] = fg__packing_of(v);
    packed[k] = of[k].scale != 1.0 || of[k].offset != 0.0;
    if (unread)
      fg__set_unusable(grid->unusable, "'%.60s' has a %s that is no number: '%.60s'",
                       v->plain_name, unread, fg__attribute_find(v, unread)->text);
  }
  const fg__variable *with = pair->component[packed[1]],
                     *without = pair->component[packed[0]];
  if (pair->polar.sense == 0 && packed[0] != packed[1] && !fg__is_floating(with) &&
      with->type == without->type)
    fg__set_unusable(grid->unusable,
                     "'%.60s' has a scale_factor of %g, '%.60s' none, and both are whole "
                     "numbers",
                     with->plain_name, of[packed[1]].scale, without->plain_name);
}

void fg__check_variable(fg__grid *grid, const fg__variable *v)
{
  if (v->unusable)
    fg__set_unusable(grid->unusable, "%s", v->unusable);
  else if (v->type == FG__TYPE_LETTERS || v->type == FG__TYPE_TEXTS)
    fg__set_unusable(grid->unusable, "'%s' holds text, not numbers", v->name);
  else if (!fg__is_number(v))
    fg__set_unusable(grid->unusable,
                     "'%s' is of a type made by its author, not of numbers", v->name);
  else if (v->rank < 2)
    fg__set_unusable(grid->unusable, "'%s' has %d dimension%s; a field has two or more",
                     v->name, v->rank, v->rank == 1 ? "" : "s");
  else if (v->rank > FG__RANK)
    fg__set_unusable(grid->unusable, "'%s' has more than %d dimensions", v->name,
                     FG__RANK);
}

void fg__check_dimensions(fg__grid *grid, const fg__dataset *data, const fg__variable *v)
{
  for (int k = 0; k < v->rank; ++k) {
    const fg__dimension *d = &data->dimensions[v->dimension[k]];
    if (d->length == 0)
      fg__set_unusable(grid->unusable, "dimension '%.120s' is empty", d->name);
    else if (d->length >= INT_MAX)
      fg__set_unusable(grid->unusable, "dimension '%.120s' has %zu samples, more than %d",
                       d->name, d->length, INT_MAX - 1);
    for (int n = 0; n < k; ++n)
      if (v->dimension[n] == v->dimension[k])
        fg__set_unusable(grid->unusable, "'%.60s' lies along dimension '%.60s' twice",
                         v->plain_name, d->name);
  }
}

static bool fits_file(const fg__dataset *data, const fg__variable *v, size_t samples)
{
  return v->fits_file || samples / LARGEST_COMPRESSION * fg__type_bytes(v->type) <=
                             data->file[v->file].size;
}

/* Whether numbers differ by no more than rounding; what is none in both is the same.
 * Compares in blocks, so that a small file that declares large variables takes little
 * memory. */
static bool same_numbers(const fg__variable *a, const fg__variable *b, size_t n,
                         double rounding)
{
  enum { AT_ONCE = 4096 };
  double x[AT_ONCE], y[AT_ONCE];
  for (size_t start = 0; start < n; start += AT_ONCE) {
    const size_t count = n - start < AT_ONCE ? n - start : AT_ONCE;
    if (fg__variable_fetch(a, &start, &count, x) ||
        fg__variable_fetch(b, &start, &count, y))
      return false;
    for (size_t i = 0; i < count; ++i)
      if (x[i] != y[i] && !(fabs(x[i] - y[i]) <= rounding) &&
          !(isnan(x[i]) && isnan(y[i])))
        return false;
  }
  return true;
}

/* Whether a file has longitudes in two dimensions, of which one is `dimension`. */
static bool has_plane_along(const fg__dataset *data, int dimension)
{
  for (size_t i = 0; i < data->variable_count; ++i) {
    const fg__variable *v = &data->variables[i];
    if (v->rank == 2 && v->geographic == FG__ROLE_X &&
        (v->dimension[0] == dimension || v->dimension[1] == dimension))
      return true;
  }
  return false;
}

/* Coordinates that only count samples (i and i_g of MITgcm) say nothing of places where
 * the file has positions, or one is of faces. */
static bool only_count(const fg__dataset *data, const fg__variable *of_a,
                       const fg__variable *of_b)
{
  return fg__may_be_index(of_a) && fg__may_be_index(of_b) &&
         (has_plane_along(data, of_a->dimension[0]) ||
          has_plane_along(data, of_b->dimension[0]) ||
          fg__side_of_faces(data, of_a, 0) != fg__side_of_faces(data, of_b, 0));
}

/* Whether two coordinates of n dates begin and end at the same (1) or others (0); -1:
 * they are no dates. */
static int compare_dates(const fg__variable *a, const fg__variable *b, size_t n)
{
  char of_a[FG__UNIT_BYTES], of_b[FG__UNIT_BYTES];
  double at_a, at_b;
  bool same = true;
  for (int end = 0; end < 2; ++end) {
    const size_t index = end ? n - 1 : 0;
    if (fg__variable_fetch_one(a, &index, &at_a) ||
        !fg__write_date(of_a, FG__UNIT_BYTES, a, at_a) ||
        fg__variable_fetch_one(b, &index, &at_b) ||
        !fg__write_date(of_b, FG__UNIT_BYTES, b, at_b))
      return -1;
    same = same && strcmp(of_a, of_b) == 0;
  }
  return same;
}

static bool same_coordinates(const fg__dataset *data, const fg__variable *a,
                             const fg__variable *b, int k)
{
  const size_t n = data->dimensions[a->dimension[k]].length;
  const fg__variable *of_a = fg__coordinate(data, a, k);
  const fg__variable *of_b = fg__coordinate(data, b, k);
  /* where a third file has the positions, they are found by the dimensions' names */
  const bool by_name = data->files > data->component_files;
  if (!of_a || !of_b)
    return !of_a && !of_b && a->file != b->file &&
           (!by_name || strcmp(data->dimensions[a->dimension[k]].name,
                               data->dimensions[b->dimension[k]].name) == 0);
  return !only_count(data, of_a, of_b) && fits_file(data, of_a, n) &&
         fits_file(data, of_b, n) &&
         (same_numbers(of_a, of_b, n, 0.0) || compare_dates(of_a, of_b, n) == 1);
}

/* Whether two coordinates of n numbers in two units, of which one is `factor` of the
 * other where both are known, begin or end at other dates or numbers. */
static bool have_other_ends(const fg__variable *a, const fg__variable *b, size_t n,
                            double factor, bool known)
{
  const int dates = compare_dates(a, b, n);
  double at_a, at_b;
  bool other = dates == 0;
  for (int end = 0; end < 2 && dates < 0 && known && factor != 0.0; ++end) {
    const size_t index = end ? n - 1 : 0;
    other = other || (!fg__variable_fetch_one(a, &index, &at_a) &&
                      !fg__variable_fetch_one(b, &index, &at_b) &&
                      fabs(factor * at_a - at_b) > 1e-4 * fabs(at_b));
  }
  return other;
}

/* Whether two coordinates of n numbers have a value that differs by more than rounding.
 */
static bool differ(const fg__variable *a, const fg__variable *b, size_t n)
{
  const size_t last = n - 1;
  double first_value, last_value;
  char of_a[FG__TEXT_BYTES], of_b[FG__TEXT_BYTES];
  fg__attribute_text(a, "units", of_a, sizeof of_a);
  fg__attribute_text(b, "units", of_b, sizeof of_b);
  if (strcmp(of_a, of_b) != 0)
    return have_other_ends(a, b, n, fg__unit_factor(of_a, of_b), of_a[0] && of_b[0]);
  if (fg__variable_fetch_one(a, (size_t[]){0}, &first_value) ||
      fg__variable_fetch_one(a, &last, &last_value))
    return false;
  const double step = n > 1 ? fabs(last_value - first_value) / (double)last : 0.0;
  const double rounding = fmax(0.01 * step, 1e-6 * fabs(last_value));
  return !same_numbers(a, b, n, rounding);
}

/* Refuses components whose times or levels, of n numbers each, differ. */
static bool check_values(fg__grid *grid, const fg__dataset *data,
                         const fg__variable *const component[2],
                         const fg__variable *const of[2], size_t n)
{
  if (!of[0] || !of[1] || of[0] == of[1] || !fits_file(data, of[0], n) ||
      !fits_file(data, of[1], n) || !differ(of[0], of[1], n))
    return true;
  fg__set_unusable(grid->unusable,
                   "'%.60s' of '%.60s' and '%.60s' of '%.60s' have different values",
                   of[0]->plain_name, component[0]->plain_name, of[1]->plain_name,
                   component[1]->plain_name);
  return false;
}

/* Compares times, levels and what else is not in the plane where components have
 * different dimensions for them, or one value each. */
static bool check_index_axes(fg__grid *grid, const fg__dataset *data,
                             const fg__variable *u, const fg__variable *v)
{
  const fg__variable *const component[2] = {u, v};
  int position[FG__ROLES];
  fg__roles_find(position, data, u);
  for (int k = 0; k < u->rank && u->rank == v->rank; ++k) {
    const int a = u->dimension[k], b = v->dimension[k];
    const size_t n = data->dimensions[a].length;
    if (k == position[FG__ROLE_X] || k == position[FG__ROLE_Y] || a == b ||
        n != data->dimensions[b].length || n > MOST_COMPARED)
      continue;
    const fg__variable *const of[2] = {fg__coordinate(data, u, k),
                                       fg__coordinate(data, v, k)};
    if (!check_values(grid, data, component, of, n))
      return false;
  }
  for (int role = FG__ROLE_TIME; role <= FG__ROLE_LEVEL; ++role) {
    const fg__variable *const of[2] = {fg__single_coordinate(data, u, (fg__role)role),
                                       fg__single_coordinate(data, v, (fg__role)role)};
    if (!check_values(grid, data, component, of, 1))
      return false;
  }
  return true;
}

void fg__check_shapes(fg__grid *grid, const fg__dataset *data, const fg__variable *u,
                      const fg__variable *v)
{
  char of_u[FG__TEXT_BYTES / 2];
  char of_v[FG__TEXT_BYTES / 2];
  if (!check_index_axes(grid, data, u, v))
    return;
  write_shape(of_u, sizeof of_u, data, u);
  write_shape(of_v, sizeof of_v, data, v);
  if (strcmp(of_u, of_v) != 0) {
    grid->off_axes = true;
    fg__set_unusable(grid->unusable, "'%.60s' is %s, '%.60s' is %s samples%s",
                     u->plain_name, of_u, v->plain_name, of_v,
                     u->rank == v->rank ? ": a staggered grid" : "");
    return;
  }
  for (int k = 0; k < u->rank; ++k)
    if (u->dimension[k] != v->dimension[k] && !same_coordinates(data, u, v, k)) {
      grid->off_axes = true;
      fg__set_unusable(
          grid->unusable,
          "'%.60s' runs along '%.60s', '%.60s' along '%.60s': a staggered grid",
          u->plain_name, data->dimensions[u->dimension[k]].name, v->plain_name,
          data->dimensions[v->dimension[k]].name);
    }
}

typedef struct said {
  const char *source, *text;
  int component; /* 0 to the east, 1 to the north; -1: nothing is known */
} said;

enum { STANDARD_NAME = 1, SOURCES = 3 };

/* What a component's name, standard name and long name say. */
static bool list_said(said out[SOURCES], const fg__term *term)
{
  out[0] = (said){"name", fg__last_part(term->name), -1};
  out[1] = (said){"standard name", term->standard_name, -1};
  out[2] = (said){"long name", term->long_name, -1};
  for (int n = 1; n < SOURCES; ++n)
    if (out[n].text)
      out[n].component = fg__component_in_words(out[n].text);
  return fg__component_of_name(&out[0].component, out[0].text);
}

fg_status fg__check_names(fg__grid *grid, const fg__dataset *data, const fg__pair *pair)
{
  said of[2][SOURCES];
  fg__term term[2];
  if (pair->polar.sense != 0)
    return FG_STATUS_OK;
  for (int k = 0; k < 2; ++k) {
    term[k] = fg__term_of(pair->component[k]);
    if (!list_said(of[k], &term[k]))
      return fg__fail_memory(data->context, "names", 0);
    for (int n = 1; n < SOURCES; ++n)
      if (of[k][n].text && fg__counts_backwards(of[k][n].text))
        fg__set_unusable(grid->unusable,
                         "'%.60s' is counted to the west or south: %s '%.80s'",
                         of[k][0].text, of[k][n].source, of[k][n].text);
    if (term[k].comment && fg__is_positive_backwards(term[k].comment))
      fg__set_unusable(grid->unusable,
                       "'%.60s' is counted to the west or south: comment '%.80s'",
                       of[k][0].text, term[k].comment);
  }
  for (int n = 1; n < SOURCES; ++n)
    if (of[0][n].text && of[1][n].text &&
        fg__counts_downward(of[0][n].text) * fg__counts_downward(of[1][n].text) < 0)
      fg__set_unusable(grid->unusable,
                       "one component is counted upward, the other downward: %ss '%.80s' "
                       "and '%.80s'",
                       of[0][n].source, of[0][n].text, of[1][n].text);
  for (int k = 0; k < 2; ++k)
    for (int n = 0; n < SOURCES; ++n)
      for (int m = n + 1; m < SOURCES; ++m)
        if (of[k][n].component >= 0 && of[k][m].component == !of[k][n].component &&
            (m == STANDARD_NAME || of[!k][m].component >= 0))
          fg__set_unusable(grid->unusable,
                           "'%.60s' is the component to the %s by its %s, and to the %s "
                           "by its %s '%.80s'",
                           of[k][0].text, of[k][n].component ? "north" : "east",
                           of[k][n].source, of[k][m].component ? "north" : "east",
                           of[k][m].source, of[k][m].text);
  if (grid->unusable[0])
    snprintf(grid->hint, sizeof grid->hint,
             "--vars EAST,NORTH takes them as they are named there");
  return FG_STATUS_OK;
}

/* Whether the file has both components at a time and level. */
static bool has_samples(const fg__pair *pair, const fg__grid *grid, int time, int level)
{
  bool has = true;
  for (int k = 0; k < 2; ++k) {
    size_t index[FG__RANK] = {0};
    if (grid->time >= 0)
      index[grid->time] = (size_t)time;
    if (grid->level >= 0)
      index[grid->level] = (size_t)level;
    has = has && fg__variable_has(pair->component[k], index);
  }
  return has;
}

fg_status fg__check_samples(const fg__dataset *data, const fg__pair *pair,
                            const fg__grid *grid, const fg_read_options *options)
{
  fg__vector_words words;
  if (has_samples(pair, grid, options->time, options->level))
    return FG_STATUS_OK;
  const fg_status status = fg__vector_words_find(&words, data, pair, grid, options);
  return status != FG_STATUS_OK
             ? status
             : fg__fail(data->context, FG_STATUS_ARGUMENT,
                        "%s: has no '%.200s' and '%.200s' at time %d (%s) and level %d "
                        "(%s)",
                        data->file[0].path, pair->component[0]->name,
                        pair->component[1]->name, options->time, words.time,
                        options->level, words.level);
}

fg_read_options fg__first_samples(const fg__pair *pair, const fg__grid *grid)
{
  fg_read_options first = {0};
  for (int time = 0; time < (int)grid->times; ++time)
    for (int level = 0; level < (int)grid->levels; ++level)
      if (has_samples(pair, grid, time, level)) {
        first.time = time;
        first.level = level;
        return first;
      }
  return first;
}

void fg__refuse_apart(fg__grid *grid, const fg__pair *pair)
{
  const fg__variable *u = pair->component[0], *v = pair->component[1];
  const bool other = u->file != v->file;
  snprintf(grid->unusable, sizeof grid->unusable,
           "'%.60s' and '%.60s'%s%.200s lie more than half a cell apart: they are of "
           "different grids",
           u->plain_name, v->plain_name, other ? " of " : "", other ? v->path : "");
  grid->hint[0] = '\0';
}

void fg__check_storage(fg__grid *grid, const fg__dataset *data, const fg__variable *v)
{
  if (!fits_file(data, v, grid->samples))
    fg__set_unusable(grid->unusable,
                     "'%.120s' has %zu samples, but the file has only %zu bytes", v->name,
                     grid->samples, data->file[v->file].size);
}
