/* Analytic fields: closed formulas sampled on the unit square. */
#include "base/context.h"
#include "base/memory.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const double PI = 3.14159265358979323846;

/* Samples a side above which their number no longer fits an int. */
enum { NODES_MIN = 2, NODES_MAX = 46340 };

typedef void analytic_velocity(double x, double y, double velocity[2]);

/* sin(pi t) that is exactly 0 at whole t, so that a wall lets nothing through. */
static double sin_pi(double t)
{
  double rest = fmod(t, 2.0); /* exact */
  if (rest > 1.0)
    rest -= 2.0;
  else if (rest < -1.0)
    rest += 2.0;
  if (rest > 0.5)
    rest = 1.0 - rest;
  else if (rest < -0.5)
    rest = -1.0 - rest;
  return sin(PI * rest);
}

static double cos_pi(double t)
{
  return sin_pi(t + 0.5);
}

static void uniform(double x, double y, double velocity[2])
{
  (void)x;
  (void)y;
  double angle = 25.0 / 180.0 * PI;
  velocity[0] = cos(angle);
  velocity[1] = sin(angle);
}

static void vortex(double x, double y, double velocity[2])
{
  velocity[0] = -(y - 0.5);
  velocity[1] = x - 0.5;
}

static void saddle(double x, double y, double velocity[2])
{
  velocity[0] = x - 0.5;
  velocity[1] = -(y - 0.5);
}

/* Three vortices with smooth cores of radius 0.08, one of them turning the other way. */
static void vortex3(double x, double y, double velocity[2])
{
  static const struct {
    double x, y, circulation;
  } cores[] = {{0.28, 0.30, 1.0}, {0.74, 0.34, -1.0}, {0.48, 0.74, 1.0}};
  const double radius = 0.08;
  velocity[0] = velocity[1] = 0.0;
  for (size_t i = 0; i < sizeof cores / sizeof cores[0]; ++i) {
    double dx = x - cores[i].x, dy = y - cores[i].y;
    double strength = cores[i].circulation / (dx * dx + dy * dy + radius * radius);
    velocity[0] -= strength * dy;
    velocity[1] += strength * dx;
  }
}

/* Convection rolls: psi = sin 3 pi x sin pi y + sin 2 pi x sin 2 pi y / 4,
 * v = (d psi / d y, -d psi / d x). */
static void benard(double x, double y, double velocity[2])
{
  velocity[0] =
      PI * (sin_pi(3.0 * x) * cos_pi(y) + 0.5 * sin_pi(2.0 * x) * cos_pi(2.0 * y));
  velocity[1] =
      -PI * (3.0 * cos_pi(3.0 * x) * sin_pi(y) + 0.5 * cos_pi(2.0 * x) * sin_pi(2.0 * y));
}

static const char *const NAMES[] = {"uniform", "vortex", "saddle",
                                    "vortex3", "benard", NULL};
static analytic_velocity *const VELOCITIES[] = {uniform, vortex, saddle, vortex3, benard};
static const char *const NAMES_3D[] = {"vortex3d", "abc", NULL};

const char *const *fg_field_analytic_names(void)
{
  return NAMES;
}

static int index_of(const char *const *names, const char *name)
{
  for (int i = 0; names[i]; ++i)
    if (strcmp(names[i], name) == 0)
      return i;
  return -1;
}

static fg_status find(analytic_velocity **velocity, fg_context *context, const char *name)
{
  int index = index_of(NAMES, name);
  if (index >= 0) {
    *velocity = VELOCITIES[index];
    return FG_STATUS_OK;
  }
  if (index_of(NAMES_3D, name) >= 0)
    return fg__fail(context, FG_STATUS_UNSUPPORTED,
                    "synth:%s: a field in 3D; only fields in 2D can be used so far",
                    name);
  fg_status status =
      fg__fail(context, FG_STATUS_ARGUMENT,
               "synth:%.100s: there is no analytic field of this name", name);
  char known[256] = "";
  for (int i = 0; NAMES[i]; ++i) {
    size_t used = strlen(known);
    snprintf(known + used, sizeof known - used, "%s%s", i ? ", " : "", NAMES[i]);
  }
  fg__hint(context, "the names are: %s", known);
  return status;
}

static void sample(float *u, float *v, const double *axis, size_t nodes,
                   analytic_velocity *velocity_at)
{
  for (size_t j = 0; j < nodes; ++j)
    for (size_t i = 0; i < nodes; ++i) {
      double velocity[2];
      velocity_at(axis[i], axis[j], velocity);
      u[j * nodes + i] = (float)velocity[0];
      v[j * nodes + i] = (float)velocity[1];
    }
}

fg_status fg_field_create_analytic(fg_field **out, fg_context *context, const char *name,
                                   int nodes)
{
  if (out)
    *out = NULL;
  if (!out || !name)
    return fg__fail(context, FG_STATUS_ARGUMENT, "analytic field: %s is missing",
                    out ? "the name" : "the place for the result");
  analytic_velocity *velocity_at = NULL;
  fg_status status = find(&velocity_at, context, name);
  if (status != FG_STATUS_OK)
    return status;
  if (nodes < NODES_MIN || nodes > NODES_MAX)
    return fg__fail(context, FG_STATUS_ARGUMENT,
                    "synth:%s: %d nodes a side; %d to %d are possible", name, nodes,
                    NODES_MIN, NODES_MAX);

  size_t side = (size_t)nodes;
  double *axis = fg__allocate(side, sizeof *axis);
  float *u = fg__allocate(side * side, sizeof *u);
  float *v = fg__allocate(side * side, sizeof *v);
  if (!axis || !u || !v) {
    status = fg__fail_memory(context, "an analytic field",
                             side * sizeof *axis + 2 * side * side * sizeof *u);
    goto cleanup;
  }
  for (size_t i = 0; i < side; ++i)
    axis[i] = (double)i / (double)(side - 1);
  sample(u, v, axis, side, velocity_at);

  char title[64];
  snprintf(title, sizeof title, "%s (analytic)", name);
  status = fg_field_create(out, context,
                           &(fg_field_arrays){.dimension = 2,
                                              .size = {nodes, nodes},
                                              .axis = {axis, axis},
                                              .velocity = {u, v},
                                              .scale = FG_SCALE_PLAIN,
                                              .title = title});

cleanup:
  free(v);
  free(u);
  free(axis);
  return status;
}
