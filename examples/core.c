/* Clusters and arrows of fields in memory by flowgrain_core, the part of the library that
 * needs nothing but a C compiler and libm: no files, no MPI. Prints numbers in full, so
 * that machines can be compared; tests/core/run builds and compares it.
 *
 *     cmake -B build -DFLOWGRAIN_FILES=OFF -DFLOWGRAIN_MPI=OFF
 *     cmake --build build --target example_core && build/example_core
 */
#include <flowgrain/flowgrain.h>
#include <inttypes.h>
#include <stdio.h>
#include <string.h>

enum {
  SIDE_2D = 81,
  SIDE_3D = 25,
  MOST = SIDE_2D * SIDE_2D > SIDE_3D *SIDE_3D *SIDE_3D ? SIDE_2D *SIDE_2D
                                                       : SIDE_3D *SIDE_3D *SIDE_3D
};

/* Two vortices that turn against each other and, in 3D, a rise between them. */
static void fill(float *velocity[3], double *axis, int dimension)
{
  static const double centre[2][2] = {{0.3, 0.35}, {0.72, 0.6}};
  int side = dimension == 3 ? SIDE_3D : SIDE_2D;
  int nodes = side * side * (dimension == 3 ? side : 1);
  for (int i = 0; i < side; ++i)
    axis[i] = (double)i / (side - 1);
  for (int n = 0; n < nodes; ++n) {
    double v[3] = {0.15, 0.05, 0.2 + 0.3 * axis[n / side % side]};
    for (int c = 0; c < 2; ++c) {
      double x = axis[n % side] - centre[c][0], y = axis[n / side % side] - centre[c][1];
      double strength = (c == 0 ? 1.0 : -1.3) / (0.02 + x * x + y * y);
      v[0] -= 0.1 * strength * y;
      v[1] += 0.1 * strength * x;
    }
    for (int k = 0; k < dimension; ++k)
      velocity[k][n] = (float)v[k];
  }
}

static fg_status make_field(fg_field **out, fg_context *context, int dimension)
{
  static float samples[3][MOST];
  static double axis[SIDE_2D];
  float *velocity[3] = {samples[0], samples[1], samples[2]};
  fill(velocity, axis, dimension);
  fg_field_arrays arrays = {.dimension = dimension};
  for (int k = 0; k < dimension; ++k) {
    arrays.size[k] = dimension == 3 ? SIDE_3D : SIDE_2D;
    arrays.axis[k] = axis;
    arrays.velocity[k] = velocity[k];
  }
  return fg_field_create(out, context, &arrays);
}

/* A hash of all bits of u (FNV-1a, Fowler, Noll and Vo). */
static void print_density(const fg_density *density)
{
  const fg_density_arrays *a = fg_density_contents(density);
  size_t nodes = (size_t)a->nodes[0] * (size_t)a->nodes[1] * (size_t)a->nodes[2];
  uint64_t hash = UINT64_C(0xcbf29ce484222325);
  for (size_t n = 0; n < nodes; ++n) {
    uint32_t bits;
    memcpy(&bits, &a->u[n], sizeof bits);
    for (int byte = 0; byte < 4; ++byte)
      hash = (hash ^ (bits >> 8 * byte & 0xffU)) * UINT64_C(0x100000001b3);
  }
  printf("density %zu nodes %d clusters %016" PRIx64 "\n", nodes, a->clusters, hash);
}

static void print_icons(const char *name, const fg_icons *icons)
{
  for (int n = 0; n < fg_icons_count(icons); ++n) {
    const fg_icon *icon = fg_icons_at(icons, n);
    for (int i = 0; i < icon->point_count; ++i)
      printf("%s %d %a %a %a\n", name, icon->id, icon->points[i][0], icon->points[i][1],
             icon->points[i][2]);
  }
}

static fg_status evolve(fg_evolution *evolution, int clusters)
{
  fg_step step;
  fg_status status;
  /* clusters is 0 until the first of them have formed */
  do
    status = fg_evolution_step(evolution, &step);
  while (!status && !step.stationary && (step.clusters == 0 || step.clusters > clusters));
  return status;
}

static fg_status show(fg_context *context, int dimension, int count)
{
  fg_field *field = NULL;
  fg_evolution *evolution = NULL;
  fg_density *density = NULL;
  fg_icons *icons = NULL, *arrows = NULL;
  fg_evolution_options options = {.nodes = dimension == 3 ? 33 : 129, .threads = 1};
  fg_status status = make_field(&field, context, dimension);
  if (!status)
    status = fg_evolution_create(&evolution, context, field, &options);
  if (!status)
    status = evolve(evolution, count);
  if (!status)
    status = fg_density_create(&density, evolution);
  if (!status)
    status = fg_icons_create(&icons, context, field, density, NULL);
  if (!status)
    status =
        fg_arrows_create(&arrows, context, field, &(fg_arrows_options){.count = count});
  if (!status) {
    print_density(density);
    print_icons("arrow", arrows);
    print_icons("cluster", icons);
  }
  fg_icons_destroy(arrows);
  fg_icons_destroy(icons);
  fg_density_destroy(density);
  fg_evolution_destroy(evolution);
  fg_field_destroy(field);
  return status;
}

int main(void)
{
  fg_context *context = NULL;
  fg_status status = fg_context_create(&context);
  if (!status)
    status = show(context, 2, 20);
  if (!status)
    status = show(context, 3, 12);
  if (status)
    fprintf(stderr, "%s: %s\n", fg_status_name(status), fg_context_message(context));
  fg_context_destroy(context);
  return status ? 1 : 0;
}
