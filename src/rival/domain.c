#include "rival/domain.h"

#include "base/memory.h"

#include <math.h>
#include <stdlib.h>

/* Streamlines may go on past a periodic border by so many periods either way. */
enum { SPARE_PERIODS = 2 };

static void place(fg__domain *domain, const fg_field_arrays *field, int nodes)
{
  double side[2];
  for (int k = 0; k < 2; k++) {
    double first = field->axis[k][0], last = field->axis[k][field->size[k] - 1];
    domain->origin[k] = first;
    domain->period[k] = field->period[k];
    side[k] = field->period[k] > 0 ? field->period[k] : last - first;
    double data_spacing = (last - first) / (field->size[k] - 1);
    domain->trace_step = k == 0 ? data_spacing : fmin(domain->trace_step, data_spacing);
  }
  double spacing = fmax(side[0], side[1]) / (nodes - 1);
  for (int k = 0; k < 2; k++) {
    domain->cells[k] = (int)fmax(round(side[k] / spacing), 1);
    domain->spacing[k] = side[k] / domain->cells[k];
    domain->trace_step = fmin(domain->trace_step, domain->spacing[k]);
  }
}

static void open_window(fg__domain *domain)
{
  fg__window *all = &domain->all;
  *all = (fg__window){
      .nodes = {2, 2}, .level = domain->all_level, .active = &domain->all_active};
  for (int i = 0; i < 4; i++)
    domain->all_level[i] = 1;
  domain->all_active = 1;
  for (int k = 0; k < 2; k++) {
    double spare = SPARE_PERIODS * domain->period[k];
    all->origin[k] = domain->origin[k] - spare;
    all->spacing[k] = domain->cells[k] * domain->spacing[k] + 2 * spare;
  }
}

fg_status fg__domain_create(fg__domain *out, fg_context *context, const fg_field *field,
                            int nodes)
{
  *out = (fg__domain){.field = field};
  place(out, fg_field_contents(field), nodes);
  open_window(out);
  size_t count = (size_t)out->cells[0] * (size_t)out->cells[1];
  out->valid = fg__allocate(count, 1);
  out->direction = fg__allocate(count, sizeof *out->direction);
  if (!out->valid || !out->direction) {
    fg__domain_clear(out);
    return fg__fail_memory(context, "a raster", count * (1 + sizeof *out->direction));
  }
  for (size_t i = 0; i < count; i++) {
    double center[2], tangent[3] = {0};
    fg__domain_center(out, (int)i, center);
    if (!fg_field_tangent(field, center, tangent))
      continue;
    out->valid[i] = 1;
    out->valid_count++;
    double size = hypot(tangent[0], tangent[1]);
    for (int k = 0; size > 0 && k < 2; k++)
      out->direction[i][k] = tangent[k] / size;
  }
  out->area = out->valid_count * out->spacing[0] * out->spacing[1];
  return FG_STATUS_OK;
}

void fg__domain_clear(fg__domain *domain)
{
  free(domain->valid);
  free(domain->direction);
  *domain = (fg__domain){0};
}

fg__window fg__domain_room(const fg__domain *domain, const double middle[2],
                           double half_width)
{
  fg__window room = domain->all;
  for (int k = 0; k < 2; k++) {
    if (!(domain->period[k] > 0))
      continue;
    double low = domain->origin[k], high = low + domain->period[k];
    low += fmin(half_width, fmax(middle[k] - low, 0) / 2);
    high -= fmin(half_width, fmax(high - middle[k], 0) / 2);
    room.origin[k] = low;
    room.spacing[k] = high - low;
  }
  return room;
}

void fg__domain_center(const fg__domain *domain, int cell, double center[2])
{
  int at[2] = {cell % domain->cells[0], cell / domain->cells[0]};
  for (int k = 0; k < 2; k++)
    center[k] = domain->origin[k] + (at[k] + 0.5) * domain->spacing[k];
}

int fg__domain_cell(const fg__domain *domain, const double point[2])
{
  int at[2];
  for (int k = 0; k < 2; k++) {
    double offset = point[k] - domain->origin[k];
    double side = domain->cells[k] * domain->spacing[k];
    if (domain->period[k] > 0)
      offset -= floor(offset / side) * side;
    if (!(offset >= 0 && offset <= side))
      return -1;
    at[k] = (int)(offset / domain->spacing[k]);
    at[k] = at[k] < domain->cells[k] ? at[k] : domain->cells[k] - 1;
  }
  return at[1] * domain->cells[0] + at[0];
}

bool fg__domain_moves(const fg__domain *domain, const double point[2])
{
  double tangent[3] = {0};
  return fg_field_tangent(domain->field, point, tangent) &&
         hypot(tangent[0], tangent[1]) > 0;
}

void fg__domain_turns(const fg__domain *domain, const double point[2], int turns[2])
{
  for (int k = 0; k < 2; k++)
    turns[k] = domain->period[k] > 0
                   ? (int)floor((point[k] - domain->origin[k]) / domain->period[k])
                   : 0;
}

void fg__domain_shortest(const fg__domain *domain, double difference[2])
{
  for (int k = 0; k < 2; k++)
    if (domain->period[k] > 0)
      difference[k] -= domain->period[k] * floor(difference[k] / domain->period[k] + 0.5);
}
