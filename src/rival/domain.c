#include "rival/domain.h"

#include "base/memory.h"

#include <math.h>
#include <stdlib.h>

/* Streamlines may go on past a periodic boundary by so many periods either way. */
enum { SPARE_PERIODS = 2 };

static void place(fg__domain *domain, const fg_field_arrays *field, int nodes)
{
  double side[3], longest = 0;
  domain->dimension = field->dimension;
  domain->cells[2] = 1;
  for (int k = 0; k < domain->dimension; k++) {
    double first = field->axis[k][0], last = field->axis[k][field->size[k] - 1];
    domain->origin[k] = first;
    domain->period[k] = field->period[k];
    side[k] = field->period[k] > 0 ? field->period[k] : last - first;
    longest = fmax(longest, side[k]);
    double data_spacing = (last - first) / (field->size[k] - 1);
    domain->trace_step = k == 0 ? data_spacing : fmin(domain->trace_step, data_spacing);
  }
  double spacing = longest / (nodes - 1);
  for (int k = 0; k < domain->dimension; k++) {
    domain->cells[k] = (int)fmax(round(side[k] / spacing), 1);
    domain->spacing[k] = side[k] / domain->cells[k];
    domain->trace_step = fmin(domain->trace_step, domain->spacing[k]);
  }
}

fg_status fg__domain_create(fg__domain *out, fg_context *context, const fg_field *field,
                            int nodes)
{
  *out = (fg__domain){.field = field};
  place(out, fg_field_contents(field), nodes);
  size_t count = (size_t)fg__domain_cell_count(out), dimension = (size_t)out->dimension;
  out->valid = fg__allocate(count, 1);
  out->direction = fg__allocate(count, dimension * sizeof *out->direction);
  if (!out->valid || !out->direction) {
    fg__domain_clear(out);
    return fg__fail_memory(context, "a raster",
                           count * (1 + dimension * sizeof *out->direction));
  }
  for (size_t i = 0; i < count; i++) {
    double center[3], tangent[3] = {0};
    fg__domain_center(out, (int)i, center);
    if (!fg_field_tangent(field, center, tangent))
      continue;
    out->valid[i] = 1;
    out->valid_count++;
    double size = hypot(hypot(tangent[0], tangent[1]), tangent[2]);
    for (size_t k = 0; size > 0 && k < dimension; k++)
      out->direction[i * dimension + k] = tangent[k] / size;
  }
  out->area = out->valid_count;
  for (int k = 0; k < out->dimension; k++)
    out->area *= out->spacing[k];
  return FG_STATUS_OK;
}

void fg__domain_clear(fg__domain *domain)
{
  free(domain->valid);
  free(domain->direction);
  *domain = (fg__domain){0};
}

fg__extent fg__domain_all(const fg__domain *domain)
{
  fg__extent all = {0};
  for (int k = 0; k < domain->dimension; k++) {
    double spare = SPARE_PERIODS * domain->period[k];
    all.origin[k] = domain->origin[k] - spare;
    all.side[k] = domain->cells[k] * domain->spacing[k] + 2 * spare;
  }
  return all;
}

fg__extent fg__domain_room(const fg__domain *domain, const double middle[],
                           double half_width)
{
  fg__extent room = fg__domain_all(domain);
  for (int k = 0; k < domain->dimension; k++) {
    if (!(domain->period[k] > 0))
      continue;
    double low = domain->origin[k], high = low + domain->period[k];
    low += fmin(half_width, fmax(middle[k] - low, 0) / 2);
    high -= fmin(half_width, fmax(high - middle[k], 0) / 2);
    room.origin[k] = low;
    room.side[k] = high - low;
  }
  return room;
}

double fg__domain_cell_size(const fg__domain *domain)
{
  double size = domain->spacing[0];
  for (int k = 1; k < domain->dimension; k++)
    size = fmin(size, domain->spacing[k]);
  return size;
}

double fg__domain_fair_share(const fg__domain *domain, int count)
{
  double share = domain->area / count;
  return domain->dimension == 2 ? sqrt(share) : cbrt(share);
}

void fg__domain_center(const fg__domain *domain, int cell, double center[])
{
  for (int k = 0; k < domain->dimension; k++) {
    center[k] = domain->origin[k] + (cell % domain->cells[k] + 0.5) * domain->spacing[k];
    cell /= domain->cells[k];
  }
}

int fg__domain_cell(const fg__domain *domain, const double point[])
{
  int cell = 0;
  for (int k = domain->dimension - 1; k >= 0; k--) {
    double offset = point[k] - domain->origin[k];
    double side = domain->cells[k] * domain->spacing[k];
    if (domain->period[k] > 0)
      offset -= floor(offset / side) * side;
    if (!(offset >= 0 && offset <= side))
      return -1;
    int at = (int)(offset / domain->spacing[k]);
    cell = cell * domain->cells[k] + (at < domain->cells[k] ? at : domain->cells[k] - 1);
  }
  return cell;
}

bool fg__domain_flow(const fg__domain *domain, const double point[], double ahead[3])
{
  double tangent[3] = {0};
  if (!fg_field_tangent(domain->field, point, tangent))
    return false;
  double size = hypot(hypot(tangent[0], tangent[1]), tangent[2]);
  for (int k = 0; k < 3 && size > 0; k++)
    ahead[k] = tangent[k] / size;
  return size > 0;
}

bool fg__domain_moves(const fg__domain *domain, const double point[])
{
  double ahead[3];
  return fg__domain_flow(domain, point, ahead);
}

bool fg__domain_cell_moves(const fg__domain *domain, int cell)
{
  const double *direction = fg__domain_direction(domain, cell);
  bool moves = false;
  for (int k = 0; k < domain->dimension; k++)
    moves = moves || direction[k] != 0;
  return moves;
}

double fg__domain_speed(const fg__domain *domain, const double point[])
{
  double velocity[3] = {0};
  return fg_field_velocity(domain->field, point, velocity)
             ? hypot(hypot(velocity[0], velocity[1]), velocity[2])
             : 0;
}

void fg__domain_turns(const fg__domain *domain, const double point[], int turns[])
{
  for (int k = 0; k < domain->dimension; k++)
    turns[k] = domain->period[k] > 0
                   ? (int)floor((point[k] - domain->origin[k]) / domain->period[k])
                   : 0;
}

void fg__domain_wrap(const fg__domain *domain, double point[])
{
  int turns[3];
  fg__domain_turns(domain, point, turns);
  for (int k = 0; k < domain->dimension; k++)
    point[k] -= turns[k] * domain->period[k];
}

void fg__domain_shortest(const fg__domain *domain, double difference[])
{
  for (int k = 0; k < domain->dimension; k++)
    if (domain->period[k] > 0)
      difference[k] -= domain->period[k] * floor(difference[k] / domain->period[k] + 0.5);
}
