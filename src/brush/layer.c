#include "brush/layer.h"

#include <math.h>
#include <stdlib.h>

#include "base/memory.h"
#include "evolution/evolution.h"

/* Share of the picture that clusters cover; more makes stripes of them. */
static const double coverage = 0.34;
/* Length by width of a cluster soon after nucleation. */
static const double aspect = 2.6;
/* Once nucleation is over there is a cluster every 344 cells (measured: 763 on 512 x 512
 * cells at a = 0.15); they have grown together a little when these are left. */
static const double cells_per_cluster = 450.0;
/* More cells than that take longer than a painting should. */
static const double most_cells = 7.3e6;
/* Structure is averaged over that share of a cluster's width. */
static const double structure_share = 0.8, presmoothing_share = 0.25;
/* Strokes need no better steps: eta and cycles of the evolution. */
static const double accuracy = 0.12;
enum { CYCLES = 2 };

enum { LEAST_CELLS = 48, SIDE_STEP = 16, MOST_POWER = 64, MOST_STEPS = 400 };

double fg__layer_brush(const fg_image_arrays *image, int clusters)
{
  double area = (double)image->width * (double)image->height * coverage / clusters;
  return sqrt(area / aspect);
}

static int power_of_two_in(long a, long b)
{
  int power = 1;
  while (power < MOST_POWER && a % (2L * power) == 0 && b % (2L * power) == 0)
    power *= 2;
  return power;
}

/* Of the meshes with up to so many cells the one whose sides can be coarsened most often:
 * coarse levels that can not be coarsened cost more than all the rest. */
static int nodes_for(const fg_image_arrays *image, int clusters)
{
  double longest = fmax(image->width, image->height);
  double ratio = fmin(image->width, image->height) / longest;
  double cells = fmin(cells_per_cluster * clusters, most_cells);
  int most = (int)fmax(sqrt(cells / ratio), LEAST_CELLS), best = 0, best_power = 0;
  for (int n = most / SIDE_STEP * SIDE_STEP; n >= LEAST_CELLS && n > 3 * most / 4;
       n -= SIDE_STEP) {
    /* the mesh takes a multiple of 8 along the short side */
    int power = power_of_two_in(n, 8L * lround(ratio * n / 8.0));
    if (power > best_power) {
      best = n;
      best_power = power;
    }
  }
  return (best ? best : LEAST_CELLS) + 1;
}

fg_status fg__layer_structure(fg__structure *out, fg_context *context,
                              const fg_image_arrays *image, const fg__layer_plan *plan)
{
  double brush = fg__layer_brush(image, plan->clusters);
  float *grey = fg__image_grey(image);
  if (!grey ||
      !fg__image_blur(grey, image->width, image->height, presmoothing_share * brush)) {
    free(grey);
    return fg__fail_memory(context, "a grey image", 0);
  }
  fg_status status =
      fg__structure_create(out, context, grey, image->width, image->height,
                           fmax(structure_share * brush, 1.0), plan->anisotropy);
  free(grey);
  return status;
}

/* A field to evolve on: the image's rectangle in pixels, y upwards, without what is
 * transparent. Its velocity is not used. */
static fg_status field_of(fg_field **out, fg_context *context,
                          const fg_image_arrays *image)
{
  int columns = image->alpha ? image->width + 1 : 2;
  int rows = image->alpha ? image->height + 1 : 2;
  size_t count = (size_t)columns * (size_t)rows;
  double *axis = fg__allocate((size_t)columns + (size_t)rows, sizeof *axis);
  float *velocity = fg__allocate(2 * count, sizeof *velocity);
  unsigned char *valid = fg__allocate(count, 1);
  fg_status status = FG_STATUS_OK;
  if (!axis || !velocity || !valid) {
    status = fg__fail_memory(context, "an image's rectangle", count * 9);
    goto cleanup;
  }
  for (int i = 0; i < columns; ++i)
    axis[i] = (double)image->width * i / (columns - 1);
  for (int j = 0; j < rows; ++j)
    axis[columns + j] = (double)image->height * j / (rows - 1);
  for (size_t n = 0; n < count; ++n) {
    velocity[n] = 1.0F;
    valid[n] = !image->alpha;
  }
  /* a corner of a pixel that is to be seen */
  for (int j = 0; image->alpha && j < image->height; ++j)
    for (int i = 0; i < image->width; ++i) {
      if (image->alpha[(size_t)j * (size_t)image->width + (size_t)i] < 0.5F)
        continue;
      size_t low = (size_t)(image->height - 1 - j) * (size_t)columns + (size_t)i;
      valid[low] = valid[low + 1] = 1;
      valid[low + (size_t)columns] = valid[low + (size_t)columns + 1] = 1;
    }
  fg_field_arrays arrays = {.dimension = 2,
                            .size = {columns, rows, 1},
                            .axis = {axis, axis + columns},
                            .velocity = {velocity, velocity + count},
                            .valid = valid};
  status = fg_field_create(out, context, &arrays);
cleanup:
  free(axis);
  free(velocity);
  free(valid);
  return status;
}

static fg_status evolve(fg_density **out, fg_evolution *evolution, int clusters)
{
  fg_step step = {0};
  while (step.step < MOST_STEPS && !step.stationary &&
         (step.clusters == 0 || step.clusters > clusters)) {
    fg_status status = fg_evolution_step(evolution, &step);
    if (status)
      return status;
  }
  return fg_density_create(out, evolution);
}

fg_status fg__layer_density(fg_density **out, fg_context *context,
                            const fg_image_arrays *image, const fg__structure *structure,
                            const fg__layer_plan *plan)
{
  fg_field *field = NULL;
  fg_evolution *evolution = NULL;
  *out = NULL;
  fg_status status = field_of(&field, context, image);
  if (!status) {
    fg_energy_law law = {.name = "gradient of the image",
                         .tensor = fg__structure_tensor,
                         .data = structure};
    fg_evolution_options options = {.nodes = nodes_for(image, plan->clusters),
                                    .mesh = FG_MESH_UNIFORM,
                                    .law = &law,
                                    .anisotropy = plan->anisotropy,
                                    .coverage = coverage,
                                    .accuracy = accuracy,
                                    .cycles = CYCLES,
                                    .seed = plan->seed,
                                    .threads = plan->threads};
    status = fg__evolution_create(&evolution, context, &fg__single_rank, field, &options);
  }
  if (!status)
    status = evolve(out, evolution, plan->clusters);
  fg_evolution_destroy(evolution);
  fg_field_destroy(field);
  return status;
}
