#include "rival/cluster/bisect.h"

#include "base/memory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Streamlines whose error stands for the cluster's, and steps of each: a tenth (rms over
 * the clusters of vortex3 and of a wind) from the error of 1024 lines of 96 steps. */
enum { LINES = 64, STEPS = 12 };

/* The golden ratio's multiples fall evenly among the cells, whatever the rows' length. */
static const double GOLDEN = 0.6180339887498949;

/* Errors below this share of the way are rounding: the flow is uniform. */
static const double NO_ERROR = 1e-9;

/* Variances that differ by less have no principal axis: x is taken. */
static const double ROUND = 1e-9;

static bool find_direction(const fg__domain *domain, const double point[2],
                           double direction[2])
{
  double tangent[3] = {0};
  if (!fg_field_tangent(domain->field, point, tangent))
    return false;
  double size = sqrt(tangent[0] * tangent[0] + tangent[1] * tangent[1]);
  for (int k = 0; k < 2; k++)
    direction[k] = size > 0 ? tangent[k] / size : 0;
  return true;
}

/* Mean distance of a streamline (midpoint rule, unit speed) to the straight one of the
 * mean, at equal times, as far as it stays in the domain. */
static double stray(const fg__domain *domain, const double start[2], const double mean[2],
                    double length)
{
  double step = length / STEPS, at[2] = {start[0], start[1]}, sum = 0;
  int steps = 0;
  for (; steps < STEPS; steps++) {
    double direction[2], middle[2];
    if (!find_direction(domain, at, direction))
      break;
    for (int k = 0; k < 2; k++)
      middle[k] = at[k] + step / 2 * direction[k];
    if (!find_direction(domain, middle, direction))
      break;
    double apart[2];
    for (int k = 0; k < 2; k++) {
      at[k] += step * direction[k];
      apart[k] = at[k] - start[k] - (steps + 1) * step * mean[k];
    }
    sum += sqrt(apart[0] * apart[0] + apart[1] * apart[1]);
  }
  return steps > 0 ? sum / steps : 0;
}

double fg__part_error(const fg__domain *domain, const int *cell, int count)
{
  double mean[2] = {0, 0}, sum = 0;
  for (int i = 0; i < count; i++)
    for (int k = 0; k < 2; k++)
      mean[k] += fg__domain_direction(domain, cell[i])[k] / count;
  double length = sqrt(count * domain->spacing[0] * domain->spacing[1]);
  int lines = count < LINES ? count : LINES;
  for (int i = 0; i < lines; i++) {
    double turns = (i + 0.5) * GOLDEN, start[2];
    int chosen = count < LINES ? i : (int)((turns - floor(turns)) * count);
    fg__domain_center(domain, cell[chosen], start);
    sum += stray(domain, start, mean, length);
  }
  double error = sum / lines;
  return count > 1 && error > NO_ERROR * length ? error : 0;
}

/* Mean of the cells' centres, and the direction in which they are spread most. */
static void find_axis(const fg__domain *domain, const int *cell, int count,
                      double mean[2], double axis[2])
{
  double xx = 0, xy = 0, yy = 0, center[2];
  mean[0] = mean[1] = 0;
  for (int i = 0; i < count; i++) {
    fg__domain_center(domain, cell[i], center);
    for (int k = 0; k < 2; k++)
      mean[k] += center[k] / count;
  }
  for (int i = 0; i < count; i++) {
    fg__domain_center(domain, cell[i], center);
    double x = center[0] - mean[0], y = center[1] - mean[1];
    xx += x * x;
    xy += x * y;
    yy += y * y;
  }
  double angle = 0;
  if (hypot(xx - yy, 2 * xy) > ROUND * (xx + yy))
    angle = atan2(2 * xy, xx - yy) / 2;
  axis[0] = cos(angle);
  axis[1] = sin(angle);
}

/* Divides a cluster; both halves keep the order of their cells. */
static void divide(fg__bisection *work, const fg__domain *domain, int index, int *spare)
{
  fg__part *part = &work->part[index];
  int *cell = work->cell + part->first, low = 0, high = 0;
  double mean[2], axis[2];
  find_axis(domain, cell, part->count, mean, axis);
  for (int i = 0; i < part->count; i++) {
    double center[2];
    fg__domain_center(domain, cell[i], center);
    double along = (center[0] - mean[0]) * axis[0] + (center[1] - mean[1]) * axis[1];
    if (along < 0)
      cell[low++] = cell[i];
    else
      spare[high++] = cell[i];
  }
  memcpy(cell + low, spare, (size_t)high * sizeof *cell);
  fg__part *half = &work->part[work->parts++];
  *half = (fg__part){.first = part->first + low, .count = high};
  part->count = low;
  half->error = fg__part_error(domain, work->cell + half->first, half->count);
  part->error = fg__part_error(domain, cell, low);
}

static int worst_part(const fg__bisection *work)
{
  int worst = 0;
  for (int i = 1; i < work->parts; i++) {
    const fg__part *part = &work->part[i], *before = &work->part[worst];
    if (part->error > before->error ||
        (part->error == before->error && part->count > before->count))
      worst = i;
  }
  return worst;
}

fg_status fg__bisect(fg__bisection *out, fg_context *context, const fg__domain *domain,
                     int count)
{
  size_t cells = (size_t)domain->valid_count;
  size_t most = (size_t)count < cells ? (size_t)count : cells;
  *out = (fg__bisection){0};
  out->cell = fg__allocate(cells, sizeof *out->cell);
  out->part = fg__allocate(most, sizeof *out->part);
  int *spare = fg__allocate(cells, sizeof *spare);
  fg_status status = FG_STATUS_OK;
  if (!out->cell || !out->part || !spare) {
    status = fg__fail_memory(context, "clusters", cells * 2 * sizeof *spare);
    goto cleanup;
  }
  int used = 0;
  for (int i = 0; i < domain->cells[0] * domain->cells[1]; i++)
    if (domain->valid[i])
      out->cell[used++] = i;
  out->parts = 1;
  out->part[0] = (fg__part){.count = used};
  out->part[0].error = fg__part_error(domain, out->cell, used);
  while ((size_t)out->parts < most && status == FG_STATUS_OK) {
    int worst = worst_part(out);
    if (out->part[worst].count < 2)
      break;
    divide(out, domain, worst, spare);
    status = fg__check_stop(context);
  }
cleanup:
  free(spare);
  if (status != FG_STATUS_OK)
    fg__bisection_clear(out);
  return status;
}

void fg__bisection_clear(fg__bisection *bisection)
{
  free(bisection->cell);
  free(bisection->part);
  *bisection = (fg__bisection){0};
}
