/* An image in grey as the clusters of one evolution along its level sets, at scale after
 * scale, as in the last figure of the paper: image_scales IMAGE NAME writes NAME-1.pgm,
 * NAME-2.pgm and NAME-3.pgm.
 *
 *     cc image_scales.c $(pkg-config --cflags --libs flowgrain) -o image_scales
 *     ./image_scales photo.jpg strokes
 *
 * The image's grey is a field's speed, whose level sets the energy `gradient` follows.
 * Each cluster is filled with the image's mean grey in it; the rest is white.
 */
#include <flowgrain/flowgrain.h>
#include <stdio.h>
#include <stdlib.h>

static const int CLUSTERS[] = {1000, 400, 150};
enum { SCALES = 3, NODES = 1025, SMOOTHINGS = 18 };

typedef struct grey {
  int width, height;
  float *value; /* 0 to 1, rows from below */
} grey;

static int create_grey(grey *out, const fg_image_arrays *image)
{
  static const float weight[] = {0.2126F, 0.7152F, 0.0722F}; /* Rec. 709 */
  *out = (grey){image->width, image->height, NULL};
  out->value = malloc((size_t)out->width * (size_t)out->height * sizeof(float));
  for (int j = 0; out->value && j < out->height; ++j)
    for (int i = 0; i < out->width; ++i) {
      size_t from = (size_t)(out->height - 1 - j) * (size_t)out->width + (size_t)i;
      const float *sample = image->sample + from * (size_t)image->channels;
      float sum = sample[0];
      if (image->channels == 3)
        sum = weight[0] * sample[0] + weight[1] * sample[1] + weight[2] * sample[2];
      out->value[(size_t)j * (size_t)out->width + (size_t)i] = sum;
    }
  return out->value != NULL;
}

static void smooth_line(float *value, int count, size_t stride)
{
  float before = value[0];
  for (int n = 0; n < count; ++n) {
    float here = value[(size_t)n * stride];
    float after = value[(size_t)(n + 1 < count ? n + 1 : n) * stride];
    value[(size_t)n * stride] = 0.25F * (before + after) + 0.5F * here;
    before = here;
  }
}

/* The sums are of variance SMOOTHINGS / 2: 3 pixels wide. Without it the grain of paint
 * and paper directs the clusters where the image is flat. */
static void smooth(grey *g)
{
  size_t width = (size_t)g->width;
  for (int n = 0; n < SMOOTHINGS; ++n) {
    for (int j = 0; j < g->height; ++j)
      smooth_line(g->value + (size_t)j * width, g->width, 1);
    for (int i = 0; i < g->width; ++i)
      smooth_line(g->value + i, g->height, width);
  }
}

static fg_status create_field(fg_field **out, fg_context *context, const grey *g)
{
  int most = g->width > g->height ? g->width : g->height;
  double *axis = malloc((size_t)most * sizeof *axis);
  float *zero = calloc((size_t)g->width * (size_t)g->height, sizeof *zero);
  fg_status status = FG_STATUS_MEMORY;
  for (int n = 0; axis && n < most; ++n)
    axis[n] = n;
  if (axis && zero)
    status = fg_field_create(out, context,
                             &(fg_field_arrays){.dimension = 2,
                                                .size = {g->width, g->height, 1},
                                                .axis = {axis, axis},
                                                .velocity = {g->value, zero}});
  free(axis);
  free(zero);
  return status;
}

static float at_node(const fg_density_arrays *d, const grey *g, int i, int j)
{
  int x = (int)(d->origin[0] + i * d->spacing[0] + 0.5);
  int y = (int)(d->origin[1] + j * d->spacing[1] + 0.5);
  return g->value[(size_t)y * (size_t)g->width + (size_t)x];
}

/* The mean grey of each cluster, from number 1 on. NULL without memory. */
static double *mean_tones(const fg_density *density, const grey *g)
{
  const fg_density_arrays *d = fg_density_contents(density);
  const int *label = fg_density_labels(density);
  double *tone = calloc(2 * ((size_t)d->clusters + 1), sizeof *tone);
  double *count = tone ? tone + d->clusters + 1 : NULL;
  for (int j = 0; tone && j < d->nodes[1]; ++j)
    for (int i = 0; i < d->nodes[0]; ++i) {
      int n = label[j * d->nodes[0] + i];
      if (n > 0) {
        tone[n] += (double)at_node(d, g, i, j);
        count[n] += 1.0;
      }
    }
  for (int n = 1; tone && n <= d->clusters; ++n)
    tone[n] /= count[n] > 0.0 ? count[n] : 1.0;
  return tone;
}

/* A node of a cluster is as dark as its number's tone, and paler at the interface. */
static int shade(float u, int label, const double *tone)
{
  const double share = label > 0 && u < 0.4F ? (double)u / 0.4 : 1.0;
  return label > 0 ? (int)(255.5 - 255.0 * share * (1.0 - tone[label])) : 255;
}

/* A pixel a node. */
static bool write_scale(const char *path, const fg_density *density, const double *tone)
{
  const fg_density_arrays *d = fg_density_contents(density);
  const int *label = fg_density_labels(density);
  FILE *file = fopen(path, "wb");
  if (!file)
    return false;
  fprintf(file, "P5\n%d %d\n255\n", d->nodes[0], d->nodes[1]);
  for (int j = d->nodes[1] - 1; j >= 0; --j)
    for (int i = 0; i < d->nodes[0]; ++i) {
      int n = j * d->nodes[0] + i;
      fputc(shade(d->u[n], label[n], tone), file);
    }
  bool written = !ferror(file);
  return fclose(file) == 0 && written;
}

/* Steps until at most `clusters` are left, and writes them. */
static fg_status make_scale(fg_evolution *evolution, const grey *g, int clusters,
                            const char *path)
{
  fg_step step = {0};
  fg_status status = FG_STATUS_OK;
  fg_density *density = NULL;
  while (!status && (step.clusters == 0 || step.clusters > clusters) && !step.stationary)
    status = fg_evolution_step(evolution, &step);
  if (!status)
    status = fg_density_create(&density, evolution);
  if (status)
    return status;
  double *tone = mean_tones(density, g);
  if (!tone)
    status = FG_STATUS_MEMORY;
  else if (!write_scale(path, density, tone))
    status = FG_STATUS_FILE_ACCESS;
  else
    printf("%s: t = %.3g, %d clusters\n", path, step.time, step.clusters);
  free(tone);
  fg_density_destroy(density);
  return status;
}

int main(int argc, char **argv)
{
  if (argc != 3) {
    fprintf(stderr, "usage: %s IMAGE NAME\n", argv[0]);
    return 2;
  }
  const fg_evolution_options options = {.nodes = NODES,
                                        .mesh = FG_MESH_UNIFORM,
                                        .energy = FG_ENERGY_GRADIENT,
                                        .anisotropy = 0.05,
                                        .coverage = 0.4};
  fg_context *context = NULL;
  fg_image *image = NULL;
  fg_field *field = NULL;
  fg_evolution *evolution = NULL;
  grey sharp = {0}, smoothed = {0};
  fg_status status = fg_context_create(&context);
  if (!status)
    status = fg_image_read(&image, context, argv[1]);
  if (!status && !(create_grey(&sharp, fg_image_contents(image)) &&
                   create_grey(&smoothed, fg_image_contents(image))))
    status = FG_STATUS_MEMORY;
  if (!status) {
    smooth(&smoothed);
    status = create_field(&field, context, &smoothed);
  }
  if (!status)
    status = fg_evolution_create(&evolution, context, field, &options);
  for (int n = 0; n < SCALES && !status; ++n) {
    char path[4096];
    snprintf(path, sizeof path, "%s-%d.pgm", argv[2], n + 1);
    status = make_scale(evolution, &sharp, CLUSTERS[n], path);
  }
  if (status)
    fprintf(stderr, "%s: %s\n", fg_status_name(status), fg_context_message(context));
  fg_evolution_destroy(evolution);
  fg_field_destroy(field);
  fg_image_destroy(image);
  fg_context_destroy(context);
  free(sharp.value);
  free(smoothed.value);
  return status ? 1 : 0;
}
