#include <math.h>

#include "tensor/eigenvalues.h"
#include "tensor/length.h"
#include "tensor/tensor.h"

/* in the order of fg_energy */
static const fg_energy_law *const laws[] = {&fg__law_flow, &fg__law_isotropic,
                                            &fg__law_gradient};

/* By how much eigenvalues may leave their range: entries are kept in float, and equal
 * eigenvalues in 3D are found to 3e-8 of the largest entry. */
static const double eigenvalue_slack = 1e-5;

const fg_energy_law *fg__energy(fg_energy energy)
{
  return (size_t)energy < sizeof laws / sizeof laws[0] ? laws[energy] : NULL;
}

int fg__layers(const fg__cells *cells)
{
  return cells->dimension == 3 ? cells->count[2] : 1;
}

size_t fg__cell_count(const fg__cells *cells)
{
  return (size_t)cells->count[0] * (size_t)cells->count[1] * (size_t)fg__layers(cells);
}

int fg__domain_count(const fg__cells *cells, int k)
{
  return cells->domain_count[k] > 0 ? cells->domain_count[k] : cells->count[k];
}

/* Centre of the box's n-th cell along axis k; beyond the ends, which a box only is on a
 * periodic axis, the cell it repeats. */
static double center_of(const fg__cells *cells, int k, int n)
{
  int all = fg__domain_count(cells, k), index = (cells->first[k] + n) % all;
  return cells->origin[k] + ((index < 0 ? index + all : index) + 0.5) * cells->spacing[k];
}

/* Fills one row of cells along x, from cell on; returns how many are active. */
static int64_t fill_row(fg__tensor *tensor, const fg_energy_law *law,
                        fg_energy_place *place, const fg__cells *cells, size_t cell)
{
  int64_t active = 0;
  for (int i = 0; i < cells->count[0]; ++i, ++cell) {
    double a[6] = {0.0};
    place->position[0] = center_of(cells, 0, i);
    tensor->active[cell] =
        fg_field_tangent(place->field, place->position, place->direction);
    if (tensor->active[cell])
      law->tensor(a, place, law->data);
    active += tensor->active[cell];
    tensor->xx[cell] = (float)a[0];
    tensor->xy[cell] = (float)a[1];
    tensor->yy[cell] = (float)a[2];
    if (cells->dimension == 3) {
      tensor->zz[cell] = (float)a[3];
      tensor->xz[cell] = (float)a[4];
      tensor->yz[cell] = (float)a[5];
    }
  }
  return active;
}

static bool is_whole(const fg__cells *cells)
{
  for (int k = 0; k < cells->dimension; ++k)
    if (cells->count[k] < fg__domain_count(cells, k))
      return false;
  return true;
}

/* A tensor to be filled, of which threads take rows. */
typedef struct filling {
  fg__tensor *tensor;
  const fg_field *field;
  const fg_energy_law *law;
  double anisotropy;
  const fg__cells *cells;
  int64_t active[FG__MOST_THREADS];
} filling;

static void fill_part(void *argument, const fg__thread *thread)
{
  filling *f = argument;
  const fg__cells *cells = f->cells;
  int begin, end, height = cells->count[1];
  int64_t active = 0;
  fg__threads_range(thread, height * fg__layers(cells), 1, &begin, &end);
  for (int row = begin; row < end; ++row) {
    fg_energy_place place = {.field = f->field,
                             .position = {0.0, center_of(cells, 1, row % height), 0.0},
                             .spacing = {cells->spacing[0], cells->spacing[1], 0.0},
                             .anisotropy = f->anisotropy};
    if (cells->dimension == 3) {
      place.position[2] = center_of(cells, 2, row / height);
      place.spacing[2] = cells->spacing[2];
    }
    active +=
        fill_row(f->tensor, f->law, &place, cells, (size_t)row * (size_t)cells->count[0]);
  }
  f->active[thread->index] = active;
}

/* The least and the greatest eigenvalue of a cell; false: some entry is no number. */
static bool ends_of(const fg__tensor *t, size_t n, int dimension, double *least,
                    double *greatest)
{
  double a[6] = {(double)t->xx[n], (double)t->xy[n], (double)t->yy[n], 0.0, 0.0, 0.0};
  if (dimension == 2) {
    double mean = 0.5 * (a[0] + a[2]), half = fg__length(0.5 * (a[0] - a[2]), a[1], 0.0);
    *least = mean - half;
    *greatest = mean + half;
  } else {
    a[3] = (double)t->zz[n];
    a[4] = (double)t->xz[n];
    a[5] = (double)t->yz[n];
    double e[3];
    fg__eigenvalues(e, a);
    *least = e[2];
    *greatest = e[0];
  }
  double sum = 0.0;
  for (int k = 0; k < 6; ++k)
    sum += a[k];
  return isfinite(sum);
}

/* Time steps and the width of interfaces count on the range of the eigenvalues. */
static fg_status check_law(const filling *f, fg_context *context)
{
  const fg__cells *cells = f->cells;
  size_t count = fg__cell_count(cells), width = (size_t)cells->count[0];
  for (size_t n = 0; n < count; ++n) {
    double least, greatest;
    if (!f->tensor->active[n] ||
        (ends_of(f->tensor, n, cells->dimension, &least, &greatest) &&
         least >= f->anisotropy - eigenvalue_slack && greatest <= 1.0 + eigenvalue_slack))
      continue;
    size_t height = (size_t)cells->count[1];
    if (isnan(f->tensor->xx[n]))
      return fg__fail(
          context, FG_STATUS_ARGUMENT, "energy %s: no tensor at (%g, %g, %g)",
          f->law->name, center_of(cells, 0, (int)(n % width)),
          center_of(cells, 1, (int)(n / width % height)),
          cells->dimension == 3 ? center_of(cells, 2, (int)(n / width / height)) : 0.0);
    return fg__fail(context, FG_STATUS_ARGUMENT,
                    "energy %s: the tensor's eigenvalues go from %g to %g at (%g, %g, "
                    "%g); %g to 1 is the range",
                    f->law->name, least, greatest, center_of(cells, 0, (int)(n % width)),
                    center_of(cells, 1, (int)(n / width % height)),
                    cells->dimension == 3 ? center_of(cells, 2, (int)(n / width / height))
                                          : 0.0,
                    f->anisotropy);
  }
  return FG_STATUS_OK;
}

fg_status fg__tensor_fill(fg__tensor *tensor, fg_context *context, const fg_field *field,
                          const fg_energy_law *law, double anisotropy,
                          const fg__cells *cells, fg__threads *threads)
{
  if (!law || !law->tensor)
    return fg__fail(context, FG_STATUS_ARGUMENT, "there is no such energy");
  if (!(anisotropy > 0.0 && anisotropy <= 1.0))
    return fg__fail(context, FG_STATUS_ARGUMENT, "anisotropy %g is not in (0, 1]",
                    anisotropy);
  const int *count = cells->count;
  filling f = {.tensor = tensor,
               .field = field,
               .law = law,
               .anisotropy = anisotropy,
               .cells = cells};
  fg__threads_run(threads, fill_part, &f);
  int64_t active = 0;
  for (int n = 0; n < FG__MOST_THREADS; ++n)
    active += f.active[n];
  if (active > 0 || !is_whole(cells))
    return check_law(&f, context);
  static const char what[] = "has its centre in the field's domain";
  if (cells->dimension == 3)
    return fg__fail(context, FG_STATUS_ARGUMENT, "no cell of the mesh, %d x %d x %d, %s",
                    count[0], count[1], count[2], what);
  return fg__fail(context, FG_STATUS_ARGUMENT, "no cell of the mesh, %d x %d, %s",
                  count[0], count[1], what);
}
