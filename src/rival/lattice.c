#include "rival/lattice.h"

#include <math.h>
#include <stdlib.h>

/* A grid looks regular while one spacing is at most this many of the other; in 3D, where
 * fewer numbers of points can be had, a little less regular ones are taken. */
static const double SKEWEST = 1.25, SKEWEST_IN_SPACE = 1.4;

/* Numbers of points in the box that are looked at, in what the domain's share of the box
 * lets one expect; where masks are odd, the wider ranges. */
static const double RANGES[] = {1.3, 2, 8};

static void lay(fg__lattice *lattice, const fg__domain *domain, const int size[3])
{
  *lattice = (fg__lattice){.size = {size[0], size[1], size[2]}};
  for (int k = 0; k < domain->dimension; k++)
    lattice->spacing[k] = domain->cells[k] * domain->spacing[k] / size[k];
}

void fg__lattice_point(const fg__lattice *lattice, const fg__domain *domain, int index,
                       double point[])
{
  for (int k = 0; k < domain->dimension; k++) {
    int at = index % lattice->size[k];
    index /= lattice->size[k];
    point[k] = domain->origin[k] + (at + 0.5) * lattice->spacing[k];
  }
}

int fg__lattice_count(const fg__lattice *lattice)
{
  return lattice->size[0] * lattice->size[1] * lattice->size[2];
}

double fg__lattice_spacing(const fg__lattice *lattice, const fg__domain *domain)
{
  double least = lattice->spacing[0];
  for (int k = 1; k < domain->dimension; k++)
    least = fmin(least, lattice->spacing[k]);
  return least;
}

static int count_inside(const fg__lattice *lattice, const fg__domain *domain)
{
  int inside = 0;
  for (int i = 0; i < fg__lattice_count(lattice); i++) {
    double point[3];
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

/* What is looked for. */
typedef struct search {
  fg__lattice *best;
  fg_context *context;
  const fg__domain *domain;
  int count;
  double box[3];      /* its sides */
  int order[3];       /* axes as they are looked at: the first rules the spacing */
  double least, most; /* points in the box */
} search;

/* In 3D the longest axis comes first: along a thin side there is one layer. */
static void order_axes(search *wanted)
{
  for (int k = 0; k < 3; k++)
    wanted->order[k] = k;
  for (int n = 1; n < wanted->domain->dimension && wanted->domain->dimension == 3; n++)
    for (int m = n; m > 0; m--) {
      int a = wanted->order[m - 1], b = wanted->order[m];
      if (wanted->box[b] <= wanted->box[a])
        break;
      wanted->order[m - 1] = b;
      wanted->order[m] = a;
    }
}

/* Whether the spacings of the axes that are not the first differ too much. */
static bool is_skew(const search *wanted, const fg__lattice *tried)
{
  const int y = wanted->order[1], z = wanted->order[2];
  if (wanted->domain->dimension == 2 || tried->size[y] == 1 || tried->size[z] == 1)
    return false;
  double a = tried->spacing[y], b = tried->spacing[z];
  return a > SKEWEST_IN_SPACE * b || b > SKEWEST_IN_SPACE * a;
}

/* Tries a grid, unless its spacings differ too much. */
static fg_status consider(const search *wanted, const int size[3])
{
  const fg__domain *domain = wanted->domain;
  fg__lattice tried;
  lay(&tried, domain, size);
  if (is_skew(wanted, &tried))
    return FG_STATUS_OK;
  tried.inside = count_inside(&tried, domain);
  if (is_better(&tried, wanted->best, wanted->count))
    *wanted->best = tried;
  return fg__check_stop(wanted->context);
}

/* Tries all sizes along the axes from the `turn`th on; `before`: points along those
 * before it. */
static fg_status search_axis(const search *wanted, int turn, int size[3], double before)
{
  int dimension = wanted->domain->dimension;
  if (turn == dimension || turn == 3)
    return consider(wanted, size);
  int axis = wanted->order[turn], ruling = wanted->order[0];
  int first = 1, last = (int)wanted->most;
  if (turn > 0) {
    /* what makes this spacing that of the ruling axis */
    double square = size[ruling] * wanted->box[axis] / wanted->box[ruling];
    double least = turn + 1 == dimension ? ceil(wanted->least / before) : 1;
    double skewest = dimension == 2 ? SKEWEST : SKEWEST_IN_SPACE;
    last = (int)fmin(fmax(square * skewest, 1), wanted->most / before);
    first = (int)fmax(fmax(ceil(square / skewest), 1), least);
  }
  fg_status status = FG_STATUS_OK;
  for (int n = first;
       n <= last && status == FG_STATUS_OK && wanted->best->inside != wanted->count;
       n++) {
    size[axis] = n;
    status = search_axis(wanted, turn + 1, size, before * n);
  }
  return status;
}

fg_status fg__lattice_choose(fg__lattice *out, fg_context *context,
                             const fg__domain *domain, int count)
{
  search wanted = {.best = out, .context = context, .domain = domain, .count = count};
  double volume = 1;
  *out = (fg__lattice){0};
  for (int k = 0; k < domain->dimension; k++) {
    wanted.box[k] = domain->cells[k] * domain->spacing[k];
    volume *= wanted.box[k];
  }
  order_axes(&wanted);
  double expected = count * volume / fmax(domain->area, 1e-3 * volume);
  fg_status status = FG_STATUS_OK;
  for (size_t r = 0; r < sizeof RANGES / sizeof *RANGES && out->inside == 0; r++) {
    int size[3] = {1, 1, 1};
    wanted.most = ceil(expected * RANGES[r]);
    wanted.least = floor(expected / RANGES[r]);
    status = search_axis(&wanted, 0, size, 1);
    if (status != FG_STATUS_OK)
      return status;
  }
  if (out->inside == 0)
    lay(out, domain, domain->cells);
  return FG_STATUS_OK;
}
