#include "critical/raster.h"

#include "base/memory.h"
#include "field/still.h"

#include <math.h>
#include <stdlib.h>

/* Cells along a side of the square or cube as large as the domain. */
enum { CELLS_2D = 256, CELLS_3D = 64 };

/* A domain that fills little of its box gets wider cells, or time and memory would be
 * those of the box: at so many they are half a second and 0.25 GB. Where it fills less of
 * it than the second allows, cells would be wider than the domain. */
enum { AMPLE_CELLS = 3 << 19, MOST_CELLS = 1 << 24 };

/* By which they become wider until there are few enough. */
static const double WIDENING = 1.05;

/* Sets the cells along each axis, of about the wanted side; returns how many it takes. */
static double set_size(fg__domain_raster *raster, const fg__field_box *bounds)
{
  double cells = 1.0;
  for (int k = 0; k < 3; ++k) {
    raster->size[k] = 1;
    raster->cell[k] = 1.0;
  }
  for (int k = 0; k < raster->dimension; ++k) {
    const double length = bounds->high[k] - bounds->low[k];
    const double count = fmax(1.0, round(length / raster->spacing));
    cells *= count;
    if (cells > MOST_CELLS)
      break;
    raster->size[k] = (int)count;
    raster->cell[k] = length / count;
    raster->origin[k] = bounds->low[k];
  }
  return cells;
}

static fg_status choose_size(fg__domain_raster *raster, fg_context *context,
                             const fg__field_box *bounds)
{
  double cells = set_size(raster, bounds);
  if (cells > MOST_CELLS)
    return fg__fail(
        context, FG_STATUS_UNSUPPORTED,
        "the domain, %g of %g in its box, takes more than %d cells", raster->measure,
        (bounds->high[0] - bounds->low[0]) * (bounds->high[1] - bounds->low[1]) *
            (raster->dimension == 3 ? bounds->high[2] - bounds->low[2] : 1.0),
        MOST_CELLS);
  for (; cells > AMPLE_CELLS; cells = set_size(raster, bounds))
    raster->spacing *= WIDENING;
  raster->cells = (size_t)cells;
  return FG_STATUS_OK;
}

static fg_status allocate(fg__domain_raster *raster, fg_context *context)
{
  const size_t cells = raster->cells;
  bool all = true;
  raster->inside = fg__allocate(cells, 1);
  raster->counts = fg__allocate(cells, 1);
  raster->speed = fg__allocate(cells, sizeof(float));
  for (int k = 0; k < raster->dimension; ++k) {
    raster->direction[k] = fg__allocate(cells, sizeof(float));
    all = all && raster->direction[k];
  }
  if (all && raster->inside && raster->counts && raster->speed)
    return FG_STATUS_OK;
  return fg__fail_memory(context, "a raster of directions",
                         cells * (2 + 4 * (1 + (size_t)raster->dimension)));
}

static void fill_cell(fg__domain_raster *raster, size_t place, const double position[3])
{
  double velocity[3], tangent[3], speed = 0.0, length = 0.0;
  if (!fg_field_velocity(raster->field, position, velocity))
    return;
  raster->inside[place] = 1;
  for (int k = 0; k < raster->dimension; ++k)
    speed += velocity[k] * velocity[k];
  speed = sqrt(speed);
  raster->speed[place] = (float)speed;
  if (raster->field->contents.scale != FG_SCALE_GEO) {
    for (int k = 0; k < raster->dimension; ++k)
      tangent[k] = velocity[k];
    length = speed;
  } else if (fg_field_tangent(raster->field, position, tangent))
    length = hypot(tangent[0], tangent[1]);
  for (int k = 0; length > 0.0 && k < raster->dimension; ++k)
    raster->direction[k][place] = (float)(tangent[k] / length);
}

static void fill_rows(void *argument, const fg__thread *thread)
{
  fg__domain_raster *raster = argument;
  int row, end;
  fg__threads_range(thread, (int)fg__domain_raster_rows(raster), 1, &row, &end);
  for (; row < end; ++row) {
    int at[3] = {0, row % raster->size[1], row / raster->size[1]};
    for (; at[0] < raster->size[0]; ++at[0]) {
      double position[3];
      fg__domain_raster_centre(raster, at, position);
      fill_cell(raster, (size_t)row * (size_t)raster->size[0] + (size_t)at[0], position);
    }
  }
}

static void count_cells(fg__domain_raster *raster)
{
  const double top = fg__top_speed(raster->speed, raster->cells);
  for (size_t n = 0; n < raster->cells; ++n)
    raster->counts[n] = raster->inside[n] && fg__moves((double)raster->speed[n], top);
}

fg_status fg__domain_raster_create(fg__domain_raster *out, fg_context *context,
                                   const fg_field *field, fg__threads *threads)
{
  *out = (fg__domain_raster){.field = field, .dimension = field->contents.dimension};
  if (!fg__field_is_whole(field))
    return fg__fail(context, FG_STATUS_UNSUPPORTED,
                    "a part of a field has no raster, only all of it");
  const fg__field_box bounds = fg__field_box_of(field);
  out->measure = bounds.measure;
  out->side = out->dimension == 3 ? cbrt(bounds.measure) : sqrt(bounds.measure);
  out->spacing = out->side / (out->dimension == 3 ? CELLS_3D : CELLS_2D);
  fg_status status = choose_size(out, context, &bounds);
  if (status == FG_STATUS_OK)
    status = allocate(out, context);
  if (status != FG_STATUS_OK)
    return status;
  fg__threads_run(threads, fill_rows, out);
  count_cells(out);
  return fg__check_stop(context);
}

void fg__domain_raster_clear(fg__domain_raster *raster)
{
  free(raster->inside);
  free(raster->counts);
  free(raster->speed);
  for (int k = 0; k < 3; ++k)
    free(raster->direction[k]);
  *raster = (fg__domain_raster){0};
}

bool fg__domain_raster_find(const fg__domain_raster *raster, const double position[3],
                            size_t *place)
{
  size_t found = 0;
  for (int k = raster->dimension - 1; k >= 0; --k) {
    const double at = floor((position[k] - raster->origin[k]) / raster->cell[k]);
    if (!(at >= 0.0 && at < raster->size[k]))
      return false;
    found = found * (size_t)raster->size[k] + (size_t)at;
  }
  *place = found;
  return true;
}
