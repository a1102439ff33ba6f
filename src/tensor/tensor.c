#include "tensor/tensor.h"

/* in the order of fg_energy */
static fg__energy_law *const laws[] = {fg__energy_flow, fg__energy_isotropic};

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
static long fill_row(fg__tensor *tensor, const fg_field *field, fg__energy_law *law,
                     double anisotropy, const fg__cells *cells, double center[3],
                     size_t cell)
{
  long active = 0;
  for (int i = 0; i < cells->count[0]; ++i, ++cell) {
    double tangent[3] = {0.0, 0.0, 0.0}, a[6] = {0.0};
    center[0] = center_of(cells, 0, i);
    tensor->active[cell] = fg_field_tangent(field, center, tangent);
    if (tensor->active[cell])
      law(a, tangent, anisotropy);
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

/* A tensor to be filled, of which members take rows. */
typedef struct filling {
  fg__tensor *tensor;
  const fg_field *field;
  fg__energy_law *law;
  double anisotropy;
  const fg__cells *cells;
  long active[FG__MOST_MEMBERS];
} filling;

static void fill_part(void *argument, const fg__share *share)
{
  filling *f = argument;
  const fg__cells *cells = f->cells;
  int begin, end, height = cells->count[1];
  long active = 0;
  fg__team_part(share, height * fg__layers(cells), 1, &begin, &end);
  for (int row = begin; row < end; ++row) {
    double center[3] = {0.0, center_of(cells, 1, row % height), 0.0};
    if (cells->dimension == 3)
      center[2] = center_of(cells, 2, row / height);
    active += fill_row(f->tensor, f->field, f->law, f->anisotropy, cells, center,
                       (size_t)row * (size_t)cells->count[0]);
  }
  f->active[share->member] = active;
}

fg_status fg__tensor_fill(fg__tensor *tensor, fg_context *context, const fg_field *field,
                          fg_energy energy, double anisotropy, const fg__cells *cells,
                          fg__team *team)
{
  if ((size_t)energy >= sizeof laws / sizeof laws[0])
    return fg__fail(context, FG_STATUS_ARGUMENT, "there is no energy number %d",
                    (int)energy);
  if (!(anisotropy > 0.0 && anisotropy <= 1.0))
    return fg__fail(context, FG_STATUS_ARGUMENT, "anisotropy %g is not in (0, 1]",
                    anisotropy);
  const int *count = cells->count;
  filling f = {.tensor = tensor,
               .field = field,
               .law = laws[energy],
               .anisotropy = anisotropy,
               .cells = cells};
  fg__team_run(team, fill_part, &f);
  long active = 0;
  for (int n = 0; n < FG__MOST_MEMBERS; ++n)
    active += f.active[n];
  if (active > 0 || !is_whole(cells))
    return FG_STATUS_OK;
  static const char what[] = "has its centre in the field's domain";
  if (cells->dimension == 3)
    return fg__fail(context, FG_STATUS_ARGUMENT, "no cell of the mesh, %d x %d x %d, %s",
                    count[0], count[1], count[2], what);
  return fg__fail(context, FG_STATUS_ARGUMENT, "no cell of the mesh, %d x %d, %s",
                  count[0], count[1], what);
}
