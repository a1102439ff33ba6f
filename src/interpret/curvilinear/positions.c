/* Positions of a grid's samples, and on which side of the centres components are. */
#include "base/angle.h"
#include "base/memory.h"
#include "base/vector.h"
#include "interpret/curvilinear/curvilinear.h"
#include "terms/units.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Points nearer than this fraction of a cell coincide. */
static const double SAME_PLACE = 0.1;

/* Components on faces are half a cell from the centres; a tenth more is rounding. */
static const double HALF_A_CELL = 0.6;

void fg__positions_clear(fg__positions *positions)
{
  free(positions->longitude);
  free(positions->latitude);
  *positions = (fg__positions){0};
}

static size_t count_of(const fg__curvilinear_part *part)
{
  return part->grid.axis[0].size * part->grid.axis[1].size;
}

/* Reads a coordinate of one dimension and repeats it along the other. */
static fg_status read_line(double *out, const fg__dataset *data,
                           const fg__curvilinear_part *part, const fg__variable *v)
{
  const size_t columns = part->grid.axis[0].size, rows = part->grid.axis[1].size;
  const bool along_x = v->dimension[0] == part->grid.axis[0].dimension;
  const size_t count = along_x ? columns : rows;
  double *line = fg__allocate(count, sizeof *line);
  if (!line)
    return fg__fail_memory(data->context, "a coordinate", count * sizeof *line);
  fg_status status = fg__read_all(line, data, v);
  for (size_t n = 0; n < columns * rows && status == FG_STATUS_OK; ++n)
    out[n] = line[along_x ? n % columns : n / columns];
  free(line);
  return status;
}

static fg_status read_coordinate(double **out, const fg__dataset *data,
                                 const fg__curvilinear_part *part, const fg__variable *v,
                                 size_t time)
{
  const size_t count = count_of(part);
  *out = fg__allocate(count, sizeof **out);
  if (!*out)
    return fg__fail_memory(data->context, "a coordinate", count * sizeof **out);
  return v->rank == 1
             ? read_line(*out, data, part, v)
             : fg__read_doubles(*out, data, v, &part->grid, part->variable, time, 0);
}

static bool are_same(const fg__positions *at, size_t a, size_t b)
{
  return at->longitude[a] == at->longitude[b] && at->latitude[a] == at->latitude[b];
}

/* Whether point n has the position of a neighbour along one direction, in which it is the
 * i-th of `count`. */
static bool is_repeated(const fg__positions *at, size_t n, size_t i, size_t count,
                        size_t step)
{
  return (i > 0 && are_same(at, n, n - step)) ||
         (i + 1 < count && are_same(at, n, n + step));
}

/* Marks the points that have the position of a neighbour along i and of one along j: it
 * stands for none, as the zeros do that NEMO writes where it leaves out land. */
static fg_status leave_out_repeated(fg__positions *at, fg_context *context,
                                    size_t columns, size_t rows)
{
  const size_t count = columns * rows;
  bool *repeated = fg__allocate(count, sizeof *repeated);
  if (!repeated)
    return fg__fail_memory(context, "positions", count * sizeof *repeated);
  for (size_t j = 0; j < rows; ++j)
    for (size_t i = 0; i < columns; ++i) {
      const size_t n = j * columns + i;
      repeated[n] =
          is_repeated(at, n, i, columns, 1) && is_repeated(at, n, j, rows, columns);
    }
  for (size_t n = 0; n < count; ++n)
    if (repeated[n])
      at->longitude[n] = at->latitude[n] = (double)NAN;
  free(repeated);
  return FG_STATUS_OK;
}

fg_status fg__positions_read(fg__positions *out, const fg__dataset *data,
                             const fg__curvilinear_part *part, size_t time)
{
  *out = (fg__positions){0};
  fg_status status = read_coordinate(&out->longitude, data, part, part->longitude, time);
  if (status == FG_STATUS_OK)
    status = read_coordinate(&out->latitude, data, part, part->latitude, time);
  if (status == FG_STATUS_OK)
    status = fg__check_degrees(data->context, part->longitude->path, out->longitude,
                               out->latitude, count_of(part));
  return status == FG_STATUS_OK
             ? leave_out_repeated(out, data->context, part->grid.axis[0].size,
                                  part->grid.axis[1].size)
             : status;
}

/* The unit vector of a position; out[0] is NaN where the position is missing. */
static void unit_vector(double out[3], double longitude, double latitude)
{
  fg__sphere_unit_vector(out, longitude, latitude);
  if (!(fabs(latitude) <= 90.0) || !isfinite(longitude))
    out[0] = (double)NAN;
}

void fg__unit_vector(double out[3], const fg__positions *positions, size_t n)
{
  unit_vector(out, positions->longitude[n], positions->latitude[n]);
}

/* Positions of a part's samples. */
typedef struct lattice {
  fg__positions at;
  size_t size[2];
} lattice;

static fg_status read_lattice(lattice *out, const fg__dataset *data,
                              const fg__curvilinear_part *part)
{
  *out = (lattice){{0}, {part->grid.axis[0].size, part->grid.axis[1].size}};
  return fg__positions_read(&out->at, data, part, 0);
}

/* The unit vector of sample (i, j). */
static void place_of(double out[3], const lattice *of, size_t i, size_t j)
{
  fg__unit_vector(out, &of->at, j * of->size[0] + i);
}

/* The mid-point of sample (i, j) and the one before or after it along direction k; false
 * where there is none. */
static bool half_way(double out[3], const lattice *of, size_t i, size_t j, int k,
                     int side)
{
  size_t at[2] = {i, j};
  if (at[0] >= of->size[0] || at[1] >= of->size[1] ||
      (side < 0 ? at[k] == 0 : at[k] + 1 >= of->size[k]))
    return false;
  double here[3], there[3];
  at[k] = side < 0 ? at[k] - 1 : at[k] + 1;
  place_of(here, of, i, j);
  place_of(there, of, at[0], at[1]);
  for (int c = 0; c < 3; ++c)
    out[c] = 0.5 * (here[c] + there[c]);
  return isfinite(out[0]);
}

/* Number of points compared along each direction. */
enum { COMPARED = 40 };

static size_t stride(size_t size)
{
  return size / COMPARED + 1;
}

/* Distances between points that should coincide. */
typedef struct misfit {
  double sum;
  size_t count, far; /* points; those that are more than half a cell apart */
} misfit;

/* The longer side of the cell from sample (i, j) on; NaN: none. */
static double cell_at(const lattice *of, size_t i, size_t j)
{
  double here[3], next[3], longest = (double)NAN;
  place_of(here, of, i, j);
  for (int k = 0; k < 2; ++k) {
    const size_t at[2] = {i + (k == 0), j + (k == 1)};
    if (at[k] >= of->size[k])
      continue;
    place_of(next, of, at[0], at[1]);
    longest = fmax(longest, fg__distance(here, next));
  }
  return longest;
}

static void add_distance(misfit *to, const double a[3], const double b[3], double cell)
{
  const double distance = fg__distance(a, b);
  to->sum += distance;
  ++to->count;
  to->far += distance > HALF_A_CELL * cell;
}

static double mean_of(const misfit *of)
{
  return of->count > 0 ? of->sum / (double)of->count : HUGE_VAL;
}

static bool is_far(const misfit *of)
{
  return 2 * of->far > of->count;
}

/* Of a component's samples and the mid-points of centre (i, j) and its neighbour on that
 * side. */
static misfit misfit_beside(const lattice *component, const lattice *centre, int k,
                            int side)
{
  misfit out = {0};
  for (size_t j = 0; j < component->size[1]; j += stride(component->size[1]))
    for (size_t i = 0; i < component->size[0]; i += stride(component->size[0])) {
      double between[3], own[3];
      place_of(own, component, i, j);
      if (half_way(between, centre, i, j, k, side) && isfinite(own[0]))
        add_distance(&out, own, between, cell_at(centre, i, j));
    }
  return out;
}

/* Of the two components' points at equal indices, each shifted half way to its neighbour
 * on the given side. */
static misfit misfit_between(const lattice *u, const lattice *v, const int side[2])
{
  misfit out = {0};
  for (size_t j = 0; j < u->size[1]; j += stride(u->size[1]))
    for (size_t i = 0; i < u->size[0]; i += stride(u->size[0])) {
      double a[3], b[3];
      if (half_way(a, u, i, j, 0, side[0]) && half_way(b, v, i, j, 1, side[1]))
        add_distance(&out, a, b, cell_at(u, i, j));
    }
  return out;
}

/* The mean distance of points at equal indices, in steps along i. */
static double apart(const lattice *u, const lattice *v)
{
  double sum = 0.0, steps = 0.0;
  for (size_t j = 0; j < u->size[1]; j += stride(u->size[1]))
    for (size_t i = 0; i + 1 < u->size[0]; i += stride(u->size[0])) {
      double of_u[3], of_v[3], next[3];
      place_of(of_u, u, i, j);
      place_of(of_v, v, i, j);
      place_of(next, u, i + 1, j);
      const double here = fg__distance(of_u, of_v), step = fg__distance(of_u, next);
      if (!isfinite(here) || !isfinite(step))
        continue;
      sum += here;
      steps += step;
    }
  return steps > 0.0 ? sum / steps : HUGE_VAL;
}

/* Without positions of centres: they are mid-points of u's samples and of v's. A
 * component that has one more than they along its own direction begins before them. */
static void shift_by_both(bool *found, fg__curvilinear *mesh, const lattice of[2])
{
  bool more[2]; /* faces on both sides of each centre */
  for (int k = 0; k < 2; ++k) {
    more[k] = of[k].size[k] > mesh->size[k];
    if (of[k].size[k] < mesh->size[k])
      return;
  }
  if (!more[0] && !more[1] && apart(&of[0], &of[1]) < SAME_PLACE) {
    mesh->shift[0] = mesh->shift[1] = 0;
    *found = true;
    return;
  }
  double least = HUGE_VAL;
  for (int n = 0; n < 4; ++n) {
    const int side[2] = {n & 1 ? 1 : -1, n & 2 ? 1 : -1};
    const misfit off = misfit_between(&of[0], &of[1], side);
    if (mean_of(&off) >= least || (more[0] && side[0] < 0) || (more[1] && side[1] < 0))
      continue;
    least = mean_of(&off);
    mesh->apart = is_far(&off);
    /* a sample before and one at the index: the component lies after the centre */
    mesh->shift[0] = -side[0];
    mesh->shift[1] = -side[1];
    *found = true;
  }
  *found = *found && !mesh->apart;
}

static void shift_by_centre(bool *found, fg__curvilinear *mesh, const lattice *component,
                            const lattice *centre, int k)
{
  if (component->size[0] == centre->size[0] && component->size[1] == centre->size[1] &&
      apart(centre, component) < SAME_PLACE) {
    mesh->shift[k] = 0;
    *found = true;
    return;
  }
  const misfit before = misfit_beside(component, centre, k, -1);
  const misfit after = misfit_beside(component, centre, k, 1);
  if (mean_of(&before) == mean_of(&after))
    return;
  mesh->shift[k] = mean_of(&before) < mean_of(&after) ? -1 : 1;
  mesh->apart = mesh->apart || is_far(mesh->shift[k] < 0 ? &before : &after);
  *found = true;
}

int fg__side_of_faces(const fg__dataset *data, const fg__variable *v, int position)
{
  static const struct {
    const char *name;
    int shift;
  } known[] = {{"xq", 1},   {"yq", 1},  {"xi_u", 1}, {"eta_v", 1}, {"i_g", -1},
               {"j_g", -1}, {"XG", -1}, {"YG", -1},  {"XU", -1},   {"YV", -1}};
  const fg__variable *along = fg__coordinate(data, v, position);
  double value;
  if (along && fg__attribute_numbers(along, "c_grid_axis_shift", &value, 1) == 1 &&
      fabs(value) == 0.5)
    return value < 0.0 ? -1 : 1;
  const char *name = data->dimensions[v->dimension[position]].name;
  for (size_t n = 0; n < sizeof known / sizeof *known; ++n)
    if (strcmp(name, known[n].name) == 0)
      return known[n].shift;
  return 0;
}

/* Whether the side of the centres on which a component lies may follow from positions:
 * nominal ones along its axes are not comparable with true ones. */
static bool may_be_compared(const fg__curvilinear *mesh, int k)
{
  const fg__variable *own = mesh->part[k].longitude;
  return mesh->part[k].grid.axis[k].size == mesh->size[k] && own &&
         (own->rank == 1) == (mesh->centre.longitude->rank == 1);
}

bool fg__shift_by_size(fg__curvilinear *mesh, const fg__dataset *data, int k)
{
  const size_t own = mesh->part[k].grid.axis[k].size, centres = mesh->size[k];
  bool found = own == centres + 1 || own + 1 == centres;
  mesh->shift[k] = own > centres ? -1 : 1; /* one more at both ends, or one less */
  if (own == centres) {
    const fg__curvilinear_part *part = &mesh->part[k];
    mesh->shift[k] = fg__side_of_faces(data, part->variable, part->grid.axis[k].position);
    found = mesh->shift[k] != 0;
  }
  return found;
}

static fg_status find_one(bool *found, fg__curvilinear *mesh, const fg__dataset *data,
                          const lattice *centre, int k)
{
  *found = false;
  lattice component = {0};
  fg_status status = FG_STATUS_OK;
  if (may_be_compared(mesh, k)) {
    status = read_lattice(&component, data, &mesh->part[k]);
    if (status == FG_STATUS_OK)
      shift_by_centre(found, mesh, &component, centre, k);
  }
  if (!*found && status == FG_STATUS_OK)
    *found = fg__shift_by_size(mesh, data, k);
  fg__positions_clear(&component.at);
  return status;
}

static fg_status find_from_centres(bool *found, fg__curvilinear *mesh,
                                   const fg__dataset *data)
{
  bool one[2] = {false, false};
  lattice centre = {0};
  fg_status status = may_be_compared(mesh, 0) || may_be_compared(mesh, 1)
                         ? read_lattice(&centre, data, &mesh->centre)
                         : FG_STATUS_OK;
  for (int k = 0; k < 2 && status == FG_STATUS_OK; ++k)
    status = find_one(&one[k], mesh, data, &centre, k);
  *found = one[0] && one[1] && !mesh->apart;
  fg__positions_clear(&centre.at);
  return status;
}

fg_status fg__shift_find(bool *found, fg__curvilinear *mesh, const fg__dataset *data)
{
  fg_status status = FG_STATUS_OK;
  *found = false;
  if (mesh->centre.variable)
    return find_from_centres(found, mesh, data);
  lattice of[2] = {{{0}, {0}}, {{0}, {0}}};
  for (int k = 0; k < 2 && status == FG_STATUS_OK; ++k)
    status = read_lattice(&of[k], data, &mesh->part[k]);
  if (status == FG_STATUS_OK)
    shift_by_both(found, mesh, of);
  fg__positions_clear(&of[0].at);
  fg__positions_clear(&of[1].at);
  return status;
}

/* The mid-point of sample i and the next on that side in a row of unit vectors,
 * extrapolated beyond the ends. */
static void half_way_in_row(double out[3], const double *row, size_t i, size_t columns,
                            int side)
{
  const double *here = row + 3 * i;
  const double *before = i > 0 ? here - 3 : NULL;
  const double *after = i + 1 < columns ? here + 3 : NULL;
  const double *next = side < 0 ? before : after, *last = side < 0 ? after : before;
  for (int c = 0; c < 3; ++c)
    out[c] = next && isfinite(next[0]) ? 0.5 * (here[c] + next[c])
             : last                    ? 1.5 * here[c] - 0.5 * last[c]
                                       : (double)NAN;
}

/* Mid-points of u's samples, of which there may be one more along each row. */
static fg_status centres_between(fg__positions *out, const fg__dataset *data,
                                 const fg__curvilinear *mesh)
{
  const size_t columns = mesh->size[0], faces = mesh->part[0].grid.axis[0].size;
  fg_status status = fg__positions_read(out, data, &mesh->part[0], 0);
  if (status != FG_STATUS_OK)
    return status;
  double *row = fg__allocate(faces, 3 * sizeof *row);
  if (!row)
    return fg__fail_memory(data->context, "a row's positions", faces * 3 * sizeof *row);
  for (size_t j = 0; j < mesh->size[1]; ++j) {
    for (size_t i = 0; i < faces; ++i)
      fg__unit_vector(row + 3 * i, out, j * faces + i);
    for (size_t i = 0; i < columns; ++i) {
      double at[3];
      half_way_in_row(at, row, i, faces, -mesh->shift[0]);
      out->longitude[j * columns + i] = atan2(at[1], at[0]) / FG__RADIANS;
      out->latitude[j * columns + i] = atan2(at[2], hypot(at[0], at[1])) / FG__RADIANS;
    }
  }
  free(row);
  return FG_STATUS_OK;
}

fg_status fg__centres_read(fg__positions *out, const fg__dataset *data,
                           const fg__curvilinear *mesh, size_t time)
{
  if (mesh->centre.variable)
    return fg__positions_read(out, data, &mesh->centre, time);
  if (mesh->shift[0] == 0)
    return fg__positions_read(out, data, &mesh->part[0], time);
  return centres_between(out, data, mesh);
}
