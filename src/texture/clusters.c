/* The clusters themselves, and the stripes that grow from weak noise: both are densities
 * of the evolution, on a mesh of their own that follows the picture's pixels. */
#include "texture/evolved.h"

#include <math.h>
#include <stdlib.h>

#include "base/memory.h"
#include "evolution/evolution.h"
#include "field/field.h"
#include "field/noise.h"
#include "texture/contrast.h"

enum { DEFAULT_CLUSTERS = 300, LEAST_NODES = 65, MOST_NODES = 1025 };

/* A mesh cell to two pixels: cubics between nodes show no cells. */
static const double pixels_a_cell = 2.0;

/* Linear growth is fastest at the wavelength 2 pi sqrt(gamma a), which is 2 pi 1.1 cells
 * by default. A streak as long as `length` shall be four stripes wide. */
static const double cells_a_stripe = 6.9, stripes_a_length = 4.0;

static const float crisp = 0.6F;

/* Of the initial noise: small, so that the linear regime lasts and the field sorts it. */
static const double weak_noise = 0.05;

static int node_count(double nodes)
{
  return (int)fmin(fmax(ceil(nodes), LEAST_NODES), MOST_NODES);
}

/* Steps until `enough` says so, or nothing changes any more. */
static fg_status evolve(fg_density **out, fg_context *context, const fg__canvas *canvas,
                        const fg_evolution_options *options,
                        bool (*enough)(const fg_step *step, const fg_mesh_info *mesh,
                                       const fg__canvas *canvas))
{
  fg_evolution *evolution = NULL;
  fg_step step;
  *out = NULL;
  fg_evolution_options uniform = *options; /* as fine as the pixels to the end */
  uniform.mesh = FG_MESH_UNIFORM;
  fg_status status = fg__evolution_create(&evolution, context, &fg__single_rank,
                                          canvas->field, &uniform);
  do {
    if (!status)
      status = fg_evolution_step(evolution, &step);
  } while (!status && !step.stationary &&
           !enough(&step, fg_evolution_mesh(evolution), canvas));
  if (!status)
    status = fg_density_create(out, evolution);
  fg_evolution_destroy(evolution);
  return status;
}

static fg_status paint(float *value, fg_context *context, const fg__canvas *canvas,
                       const fg_density *density)
{
  return fg__density_paint(value, context, &canvas->raster, fg_density_contents(density),
                           canvas->threads);
}

/* Clusters are dark. Densities of 0.6 and more are as dark as those at the minimum:
 * interfaces get crisp, and places on their way between the minima do not look dull. */
static void bend(float *value, const fg__canvas *canvas)
{
  const size_t count = (size_t)canvas->raster.size[0] * (size_t)canvas->raster.size[1];
  for (size_t n = 0; n < count; ++n)
    value[n] = fg__contrast_bend(-value[n] / crisp);
}

static int longest_of(const fg__canvas *canvas)
{
  const int *size = canvas->raster.size;
  return size[0] > size[1] ? size[0] : size[1];
}

static bool few_clusters(const fg_step *step, const fg_mesh_info *mesh,
                         const fg__canvas *canvas)
{
  (void)mesh;
  const bool timed = canvas->max_time > 0.0;
  const int wanted = canvas->clusters || timed ? canvas->clusters : DEFAULT_CLUSTERS;
  return (timed && step->time >= canvas->max_time) ||
         (step->clusters && step->clusters <= wanted);
}

fg_status fg__clusters_paint(float *value, fg_context *context, const fg__canvas *canvas)
{
  fg_evolution_options options = {0};
  if (canvas->evolution)
    options = *canvas->evolution;
  if (options.nodes == 0)
    options.nodes = node_count(longest_of(canvas) / pixels_a_cell + 1.0);
  options.seed = canvas->seed;
  options.threads = fg__threads_count(canvas->threads);
  fg_density *density = NULL;
  fg_status status = FG_STATUS_OK;
  if (!canvas->density)
    status = evolve(&density, context, canvas, &options, few_clusters);
  if (!status)
    status = paint(value, context, canvas, density ? density : canvas->density);
  if (!status)
    bend(value, canvas);
  fg_density_destroy(density);
  return status;
}

/* The nodes that an evolution of so many would have. */
static fg_status find_mesh(fg__mesh *out, fg_context *context, const fg_field *field,
                           int nodes)
{
  fg__mesh_description description = {
      .dimension = 2, .nodes = nodes, .ranks = &fg__single_rank};
  for (int k = 0; k < 2; ++k) {
    const fg__axis *axis = &field->axis[k];
    description.origin[k] = axis->coordinate[0];
    description.side[k] = axis->coordinate[axis->cells] - axis->coordinate[0];
    description.periodic[k] = axis->period > 0.0;
  }
  return fg__mesh_create(out, context, &description);
}

/* Noise of weak_noise about 0, at every node. */
static float *make_noise(fg_context *context, const fg__mesh *mesh, uint64_t seed)
{
  const int columns = mesh->cells[0] + !mesh->periodic[0];
  const int rows = mesh->cells[1] + !mesh->periodic[1];
  const size_t count = (size_t)columns * (size_t)rows;
  const double width = fmax(mesh->spacing[0], mesh->spacing[1]);
  fg__noise noise =
      fg__noise_of(2, mesh->cells, mesh->spacing, mesh->periodic, 0.0, 1.5, width, seed);
  float *u = fg__allocate(count, sizeof *u);
  if (!u) {
    fg__fail_memory(context, "the noise", count * sizeof *u);
    return NULL;
  }
  double sum = 0.0, squares = 0.0;
  for (int j = 0; j < rows; ++j)
    fg__noise_row(&noise, j, 0, 0, columns, u + (size_t)j * (size_t)columns);
  for (size_t n = 0; n < count; ++n) {
    sum += (double)u[n];
    squares += (double)u[n] * (double)u[n];
  }
  const double mean = sum / (double)count;
  const double spread = sqrt(fmax(squares / (double)count - mean * mean, 1e-12));
  for (size_t n = 0; n < count; ++n)
    u[n] = (float)(weak_noise * (((double)u[n] - mean) / spread));
  return u;
}

/* In the middle of linear growth the energy a unit of area is 1/2; they are as black and
 * white as the minima, and still as narrow as they grew, when they have come down to this
 * (measured on vortex3 and benard: 0.36 at the end of fast growth, then slow coarsening).
 */
static const double ripe_energy = 0.37;

static bool ripe(const fg_step *step, const fg_mesh_info *mesh, const fg__canvas *canvas)
{
  (void)canvas;
  return step->energy / (mesh->domain_measure / (mesh->length * mesh->length)) <=
         ripe_energy;
}

fg_status fg__stripes_paint(float *value, fg_context *context, const fg__canvas *canvas)
{
  const double stripe = canvas->length / stripes_a_length;
  fg_evolution_options options = {
      .nodes = node_count(cells_a_stripe * longest_of(canvas) / stripe + 1.0),
      .coverage = 0.5,
      .seed = canvas->seed,
      .threads = fg__threads_count(canvas->threads)};
  fg__mesh mesh;
  fg_status status = find_mesh(&mesh, context, canvas->field, options.nodes);
  if (status)
    return status;
  float *u = make_noise(context, &mesh, canvas->seed);
  fg__mesh_clear(&mesh);
  if (!u)
    return FG_STATUS_MEMORY;
  options.initial = u;
  fg_density *density;
  status = evolve(&density, context, canvas, &options, ripe);
  if (!status)
    status = paint(value, context, canvas, density);
  fg_density_destroy(density);
  free(u);
  return status;
}

int fg__no_margin(double length)
{
  (void)length;
  return 0;
}
