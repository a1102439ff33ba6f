#include "place/domain/domain.h"

#include "base/memory.h"
#include "base/vector.h"
#include "field/field.h"
#include "field/still.h"
#include "place/domain/distance.h"
#include "place/domain/gaps.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

/* Cells of the map along the longest side: two to a sample's distance, within these. */
enum { FEWEST_2D = 128, MOST_2D = 512, FEWEST_3D = 48, MOST_3D = 112 };

/* Of the root mean square, where more than half of the domain is slow: what is slower is
 * noise or a flank, and not in an arrow's mean speed. Noise whose median is a tenth of it
 * stays below. */
static const double NOISE = 1.0 / 3.0;

/* Less of the domain that is still is stagnation points, part of the flow. */
static const double RESTING = 0.01;

/* The least share of the box that arrows are made for, which bounds the rasters' size
 * where next to nothing is valid or moves. */
static const double LEAST_SHARE = 1.0 / 64.0;

/* A box of valid cells that is less than this share of the field's is the domain's. */
static const double SMALL_BOX = 0.5;

/* Narrow holes are filled where for them more than a share of the domain is too near to
 * a wall for a line of 25 arrows, a tenth of lambda. */
static const double TOO_NEAR = 0.02, LEAST_TAKEN = 0.25;

static size_t map_count(const fg__place_domain *domain)
{
  return (size_t)domain->cells[0] * (size_t)domain->cells[1] * (size_t)domain->cells[2];
}

bool fg__place_direction(const fg__place_domain *domain, const double position[3],
                         double direction[3])
{
  direction[2] = 0.0;
  if (!fg_field_tangent(domain->field, position, direction))
    return false;
  double square = direction[0] * direction[0] + direction[1] * direction[1] +
                  direction[2] * direction[2];
  if (!(square > 0.0))
    return false;
  double inverse = 1.0 / sqrt(square);
  for (int k = 0; k < 3; ++k)
    direction[k] *= inverse;
  return true;
}

double fg__place_speed(const fg__place_domain *domain, const double position[3])
{
  double v[3] = {0};
  if (!fg_field_velocity(domain->field, position, v))
    return 0.0;
  return sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

/* The cell of the map that holds a point, along axis k, within the map. */
static int cell_along(const fg__place_domain *domain, int k, double x)
{
  int cell = (int)floor((x - domain->low[k]) / domain->spacing);
  return cell < 0 ? 0 : cell < domain->cells[k] ? cell : domain->cells[k] - 1;
}

static bool is_in_box(const fg__place_domain *domain, const double position[3])
{
  for (int k = 0; k < domain->dimension; ++k)
    if (!(position[k] >= domain->low[k] && position[k] <= domain->high[k]))
      return false;
  return true;
}

const fg__place_subdomain *fg__place_subdomain_at(const fg__place_domain *domain,
                                                  const double position[3])
{
  if (!is_in_box(domain, position))
    return NULL;
  size_t cell = 0;
  for (int k = domain->dimension - 1; k >= 0; --k)
    cell = cell * (size_t)domain->cells[k] + (size_t)cell_along(domain, k, position[k]);
  int subdomain = domain->subdomain[cell];
  return subdomain ? &domain->subdomains[subdomain - 1] : NULL;
}

/* Between four cells of a plane. */
static double between(const float *at, size_t right, size_t up, const double inside[2])
{
  const double lower = (double)at[0] + inside[0] * ((double)at[right] - (double)at[0]);
  const double upper =
      (double)at[up] + inside[0] * ((double)at[up + right] - (double)at[up]);
  return lower + inside[1] * (upper - lower);
}

/* A cell of the map along axis k, between whose centre and the next one's a point lies,
 * and the point's place between them. */
static int cell_before(double *inside, const fg__place_domain *domain, int k, double x)
{
  const int last = domain->cells[k] - 1;
  double place = (x - domain->low[k]) / domain->spacing - 0.5;
  place = place < 0.0 ? 0.0 : place < last ? place : last;
  const int cell = (int)place < last ? (int)place : last > 0 ? last - 1 : 0;
  *inside = place - cell;
  return cell;
}

double fg__place_clearance(const fg__place_domain *domain, const double position[3])
{
  if (!is_in_box(domain, position))
    return 0.0;
  const int *cells = domain->cells;
  double inside[3] = {0}, frame = HUGE_VAL;
  int cell[3] = {0};
  for (int k = 0; k < domain->dimension; ++k) {
    cell[k] = cell_before(&inside[k], domain, k, position[k]);
    frame = fg__least(
        frame, fg__least(position[k] - domain->low[k], domain->high[k] - position[k]));
  }
  const size_t row = (size_t)cells[0], plane = row * (size_t)cells[1];
  const size_t right = cells[0] > 1, up = cells[1] > 1 ? row : 0;
  const float *at = domain->clearance + (size_t)cell[2] * plane + (size_t)cell[1] * row +
                    (size_t)cell[0];
  double value = between(at, right, up, inside);
  if (domain->dimension == 3 && cells[2] > 1)
    value += inside[2] * (between(at + plane, right, up, inside) - value);
  return fg__least(value, frame);
}

double fg__place_weight(const fg__place_domain *domain, double speed)
{
  double square = domain->root_mean_square * domain->root_mean_square;
  return domain->dead ? speed * speed / (speed * speed + square) : 1.0;
}

bool fg__place_has_speed(const fg__place_domain *domain, double speed)
{
  return domain->slow ? speed > NOISE * domain->root_mean_square
                      : !domain->rests || fg__place_moves(domain, speed);
}

bool fg__place_moves(const fg__place_domain *domain, double speed)
{
  return fg__moves(speed, domain->top);
}

/* Takes the box of what is valid in a field with wide margins. */
static void crop(fg__place_domain *domain)
{
  const fg_field_arrays *arrays = fg_field_contents(domain->field);
  const fg__field_box valid = fg__field_box_of(domain->field);
  double share = 1.0;
  for (int k = 0; k < domain->dimension; ++k)
    if (!(arrays->period[k] > 0.0))
      share *= (valid.high[k] - valid.low[k]) / (domain->high[k] - domain->low[k]);
  for (int k = 0; k < domain->dimension && share < SMALL_BOX; ++k)
    if (!(arrays->period[k] > 0.0)) {
      domain->low[k] = valid.low[k];
      domain->high[k] = valid.high[k];
    }
}

static void choose_map(fg__place_domain *domain)
{
  const fg_field_arrays *arrays = fg_field_contents(domain->field);
  double longest = 0.0;
  domain->data_step = HUGE_VAL;
  for (int k = 0; k < domain->dimension; ++k) {
    int size = arrays->size[k];
    domain->low[k] = arrays->axis[k][0];
    domain->high[k] = arrays->period[k] > 0.0 ? domain->low[k] + arrays->period[k]
                                              : arrays->axis[k][size - 1];
    const int intervals = arrays->period[k] > 0.0 ? size : size - 1;
    domain->data_step =
        fg__least(domain->data_step, (domain->high[k] - domain->low[k]) / intervals);
  }
  crop(domain);
  for (int k = 0; k < domain->dimension; ++k)
    longest = fg__most(longest, domain->high[k] - domain->low[k]);
  int fewest = domain->dimension == 2 ? FEWEST_2D : FEWEST_3D;
  int most = domain->dimension == 2 ? MOST_2D : MOST_3D;
  double wanted = fg__least(fg__most(2.0 * longest / domain->data_step, fewest), most);
  domain->spacing = longest / floor(wanted);
  for (int k = 0; k < 3; ++k) {
    double length = domain->high[k] - domain->low[k];
    int cells = k < domain->dimension ? (int)ceil(length / domain->spacing - 1e-9) : 1;
    domain->cells[k] = cells > 1 ? cells : 1;
  }
}

static void cell_center(const fg__place_domain *domain, const int at[3], double center[3])
{
  for (int k = 0; k < 3; ++k)
    center[k] = domain->low[k] + (at[k] + 0.5) * domain->spacing;
  for (int k = 0; k < domain->dimension; ++k) /* the last cells may stick out */
    center[k] = fg__least(center[k], domain->high[k]);
}

/* Of numbers that are not negative the one that `rank` others come before, found by
 * counting their bits' bytes, the highest first: such floats order as their bits do. */
static float value_of_rank(const float *value, size_t count, size_t rank)
{
  uint32_t found = 0, bits;
  for (int shift = 24; shift >= 0; shift -= 8) {
    size_t tally[256] = {0};
    uint32_t byte = 0;
    for (size_t n = 0; n < count; ++n) {
      memcpy(&bits, &value[n], sizeof bits);
      if ((uint64_t)bits >> (shift + 8) == found)
        ++tally[bits >> shift & 255];
    }
    while (byte < 255 && rank >= tally[byte])
      rank -= tally[byte++];
    found = found << 8 | byte;
  }
  float out;
  memcpy(&out, &found, sizeof out);
  return out;
}

/* Marks the domain's cells with subdomain 1, and keeps their speeds. */
static size_t mark_domain(fg__place_domain *domain, float *speed)
{
  size_t cell = 0, count = 0;
  for (int z = 0; z < domain->cells[2]; ++z)
    for (int y = 0; y < domain->cells[1]; ++y)
      for (int x = 0; x < domain->cells[0]; ++x, ++cell) {
        double center[3], v[3] = {0};
        cell_center(domain, (const int[3]){x, y, z}, center);
        if (!fg_field_velocity(domain->field, center, v))
          continue;
        domain->subdomain[cell] = 1;
        speed[count++] = (float)sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
      }
  return count;
}

static double box_measure(const fg__place_domain *domain)
{
  double box = 1.0;
  for (int k = 0; k < domain->dimension; ++k)
    box *= domain->high[k] - domain->low[k];
  return box;
}

static fg_status measure_speeds(fg__place_domain *domain, fg_context *context,
                                float *speed)
{
  size_t count = mark_domain(domain, speed);
  if (count == 0)
    return fg__fail(context, FG_STATUS_ARGUMENT,
                    "the field has no cell with a velocity on a raster of %zu cells",
                    map_count(domain));
  double weights = 0.0;
  size_t moving = 0;
  domain->top = fg__top_speed(speed, count);
  domain->fast = (double)value_of_rank(speed, count, count - 1 - count / 20);
  domain->root_mean_square = fg__usual_speed(speed, count, domain->top);
  domain->slow = fg__slow_share(speed, count, domain->root_mean_square) > 0.5;
  domain->dead = domain->dimension == 3 && domain->slow;
  for (size_t n = 0; n < count; ++n)
    moving += fg__place_moves(domain, (double)speed[n]);
  domain->rests = (double)moving < (1.0 - RESTING) * (double)count;
  const bool all = domain->dead || 2 * moving >= count;
  for (size_t n = 0; n < count; ++n)
    if (all || fg__place_moves(domain, (double)speed[n]))
      weights += fg__place_weight(domain, (double)speed[n]);
  double cell = pow(domain->spacing, domain->dimension);
  domain->whole = cell * (double)count;
  domain->measure = fg__most(LEAST_SHARE * box_measure(domain),
                             cell * weights / fg__place_weight(domain, domain->top));
  return FG_STATUS_OK;
}

/* Numbers the subdomain of a cell, by a stack of cells. */
static void fill_subdomain(fg__place_domain *domain, size_t first, int number,
                           size_t *stack)
{
  size_t stride[3] = {1, (size_t)domain->cells[0],
                      (size_t)domain->cells[0] * (size_t)domain->cells[1]};
  size_t depth = 0;
  fg__place_subdomain *subdomain = &domain->subdomains[number - 1];
  double cell_measure = pow(domain->spacing, domain->dimension);
  stack[depth++] = first;
  domain->subdomain[first] = number;
  while (depth > 0) {
    size_t cell = stack[--depth], rest = cell;
    subdomain->measure += cell_measure;
    subdomain->widest = fg__most(subdomain->widest, (double)domain->clearance[cell]);
    for (int k = 0; k < domain->dimension; ++k) {
      int at = (int)(rest % (size_t)domain->cells[k]);
      rest /= (size_t)domain->cells[k];
      for (int side = -1; side <= 1; side += 2) {
        if (at + side < 0 || at + side >= domain->cells[k])
          continue;
        size_t next = side < 0 ? cell - stride[k] : cell + stride[k];
        if (domain->subdomain[next] == -1) {
          domain->subdomain[next] = number;
          stack[depth++] = next;
        }
      }
    }
  }
}

static fg_status number_subdomains(fg__place_domain *domain, fg_context *context)
{
  size_t count = map_count(domain), capacity = 0;
  size_t *stack = fg__allocate(count, sizeof *stack);
  if (!stack)
    return fg__fail_memory(context, "a stack of cells", count * sizeof *stack);
  fg_status status = FG_STATUS_OK;
  for (size_t n = 0; n < count; ++n)
    domain->subdomain[n] = -domain->subdomain[n];
  for (size_t n = 0; n < count && status == FG_STATUS_OK; ++n) {
    if (domain->subdomain[n] != -1)
      continue;
    if (!fg__grow((void **)&domain->subdomains, &capacity,
                  (size_t)domain->subdomain_count + 1, sizeof *domain->subdomains)) {
      status = fg__fail_memory(context, "parts of the domain", capacity);
      break;
    }
    domain->subdomains[domain->subdomain_count++] = (fg__place_subdomain){0};
    fill_subdomain(domain, n, domain->subdomain_count, stack);
    fg__place_subdomain *last = &domain->subdomains[domain->subdomain_count - 1];
    for (int k = 0; k < domain->dimension; ++k) /* thinner than a cell */
      last->widest = fg__least(last->widest, 0.5 * (domain->high[k] - domain->low[k]));
  }
  free(stack);
  return status;
}

/* Maps the domain of a field, its subdomains not numbered yet. */
static fg_status map_domain(fg__place_domain *out, fg_context *context,
                            const fg_field *field)
{
  *out = (fg__place_domain){
      .field = field, .given = field, .dimension = fg_field_contents(field)->dimension};
  choose_map(out);
  const size_t count = map_count(out);
  out->subdomain = fg__allocate(count, sizeof *out->subdomain);
  out->clearance = fg__allocate(count, sizeof *out->clearance);
  if (!out->subdomain || !out->clearance)
    return fg__fail_memory(context, "the map of a domain",
                           count * (sizeof *out->subdomain + sizeof *out->clearance));
  /* the clearance's place holds speeds for a while */
  fg_status status = measure_speeds(out, context, out->clearance);
  if (status == FG_STATUS_OK)
    status = fg__place_distance(out->clearance, context, out->subdomain, out->cells,
                                out->dimension, out->spacing);
  return status;
}

/* The share of a domain without gaps, a plane, where only gaps are too near for lines.
 * The given domain's box may be smaller. */
static double taken_share(const fg__place_domain *given, const fg__place_domain *filled)
{
  const double near = TOO_NEAR * sqrt(filled->whole);
  size_t cell = 0, all = 0, taken = 0;
  for (int y = 0; y < filled->cells[1]; ++y)
    for (int x = 0; x < filled->cells[0]; ++x, ++cell) {
      double center[3] = {0};
      cell_center(filled, (const int[3]){x, y, 0}, center);
      all += filled->subdomain[cell] != 0;
      taken += (double)filled->clearance[cell] >= near &&
               fg__place_clearance(given, center) < near;
    }
  return (double)taken / (double)all;
}

/* Whether gaps may take much: then about half as much of the domain is near to walls. */
static bool may_have_gaps(const fg__place_domain *domain)
{
  const size_t cells = map_count(domain);
  const double near = TOO_NEAR * sqrt(box_measure(domain));
  size_t all = 0, close = 0;
  for (size_t n = 0; n < cells; ++n) {
    all += domain->subdomain[n] != 0;
    close += domain->subdomain[n] != 0 && (double)domain->clearance[n] < near;
  }
  return 2.0 * (double)close > LEAST_TAKEN * (double)all;
}

/* Takes the domain of the filled field instead, where gaps take much of the given one. */
static fg_status fill_gaps(fg__place_domain *domain, fg_context *context)
{
  fg__place_domain filled = {0};
  fg_field *field = NULL;
  fg_status status =
      may_have_gaps(domain) ? fg__place_fill_gaps(&field, context, domain) : FG_STATUS_OK;
  if (status != FG_STATUS_OK || !field)
    return status;
  status = map_domain(&filled, context, field);
  filled.given = domain->given;
  filled.filled = field;
  if (status == FG_STATUS_OK && taken_share(domain, &filled) > LEAST_TAKEN) {
    fg__place_domain other = *domain;
    *domain = filled;
    filled = other;
  }
  fg__place_domain_clear(&filled);
  return status;
}

fg_status fg__place_domain_create(fg__place_domain *out, fg_context *context,
                                  const fg_field *field)
{
  fg_status status = map_domain(out, context, field);
  if (status == FG_STATUS_OK)
    status = fill_gaps(out, context);
  if (status == FG_STATUS_OK)
    status = number_subdomains(out, context);
  if (status == FG_STATUS_OK)
    status = fg__check_stop(context);
  if (status != FG_STATUS_OK)
    fg__place_domain_clear(out);
  return status;
}

fg_status fg__place_without_gaps(fg_field **out, fg_context *context,
                                 const fg_field *field)
{
  fg__place_domain domain;
  *out = NULL;
  if (!field->valid_cell || field->contents.dimension != 2)
    return FG_STATUS_OK;
  fg_status status = map_domain(&domain, context, field);
  if (status == FG_STATUS_OK)
    status = fill_gaps(&domain, context);
  *out = domain.filled;
  domain.filled = NULL;
  fg__place_domain_clear(&domain);
  if (status == FG_STATUS_ARGUMENT) { /* too little for lines */
    fg_context_clear(context);
    status = FG_STATUS_OK;
  }
  return status;
}

void fg__place_domain_clear(fg__place_domain *domain)
{
  fg_field_destroy(domain->filled);
  free(domain->clearance);
  free(domain->subdomain);
  free(domain->subdomains);
  *domain = (fg__place_domain){0};
}
