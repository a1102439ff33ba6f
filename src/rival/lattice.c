#include "rival/lattice.h"

#include <math.h>
#include <stdlib.h>

/* A grid looks regular while one spacing is at most this many of the other. */
static const double SKEWEST = 1.25;

/* Numbers of points in the box that are looked at, in what the domain's share of the box
 * lets one expect; where masks are odd, the wider ranges. */
static const double RANGES[] = {1.3, 2, 8};

static void lay(fg__lattice *lattice, const fg__domain *domain, int columns, int rows)
{
  lattice->size[0] = columns;
  lattice->size[1] = rows;
  for (int k = 0; k < 2; k++)
    lattice->spacing[k] = domain->cells[k] * domain->spacing[k] / lattice->size[k];
}

void fg__lattice_point(const fg__lattice *lattice, const fg__domain *domain, int index,
                       double point[2])
{
  int at[2] = {index % lattice->size[0], index / lattice->size[0]};
  for (int k = 0; k < 2; k++)
    point[k] = domain->origin[k] + (at[k] + 0.5) * lattice->spacing[k];
}

static int count_inside(const fg__lattice *lattice, const fg__domain *domain)
{
  int inside = 0;
  for (int i = 0; i < lattice->size[0] * lattice->size[1]; i++) {
    double point[2];
    fg__lattice_point(lattice, domain, i, point);
    inside += fg__domain_moves(domain, point);
  }
  return inside;
}

static bool is_better(const fg__lattice *tried, const fg__lattice *best, int count)
{
  int miss = abs(tried->inside - count), least = abs(best->inside - count);
  return tried->inside > 0 && (best->inside == 0 || miss < least ||
                               (miss == least && tried->inside < best->inside));
}

fg_status fg__lattice_choose(fg__lattice *out, fg_context *context,
                             const fg__domain *domain, int count)
{
  *out = (fg__lattice){0};
  double box[2] = {domain->cells[0] * domain->spacing[0],
                   domain->cells[1] * domain->spacing[1]};
  double expected = count * box[0] * box[1] / fmax(domain->area, 1e-3 * box[0] * box[1]);
  for (size_t r = 0; r < sizeof RANGES / sizeof *RANGES && out->inside == 0; r++) {
    double most = ceil(expected * RANGES[r]), least = floor(expected / RANGES[r]);
    for (int columns = 1; columns <= most && out->inside != count; columns++) {
      double square = columns * box[1] / box[0]; /* rows that make the spacings equal */
      int last = (int)fmin(fmax(square * SKEWEST, 1), most / columns);
      int first = (int)fmax(fmax(ceil(square / SKEWEST), 1), ceil(least / columns));
      for (int rows = first; rows <= last && out->inside != count; rows++) {
        fg_status status = fg__check_stop(context);
        if (status != FG_STATUS_OK)
          return status;
        fg__lattice tried;
        lay(&tried, domain, columns, rows);
        tried.inside = count_inside(&tried, domain);
        if (is_better(&tried, out, count))
          *out = tried;
      }
    }
  }
  if (out->inside == 0)
    lay(out, domain, domain->cells[0], domain->cells[1]);
  return FG_STATUS_OK;
}
