/* Analytic fields: closed formulas sampled on the unit square or cube. */
#include "base/context.h"
#include "base/memory.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const double PI = 3.14159265358979323846;

/* Samples a side above which their number no longer fits an int. */
enum { NODES_MIN = 2, NODES_MAX_2D = 46340, NODES_MAX_3D = 1290 };

/* As many as the mesh has nodes by default. */
enum { NODES_DEFAULT_2D = 257, NODES_DEFAULT_3D = 65 };

typedef void analytic_velocity(const double position[], double velocity[]);

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

static void uniform(const double position[], double velocity[])
{
  (void)position;
  double angle = 25.0 / 180.0 * PI;
  velocity[0] = cos(angle);
  velocity[1] = sin(angle);
}

static void vortex(const double position[], double velocity[])
{
  velocity[0] = -(position[1] - 0.5);
  velocity[1] = position[0] - 0.5;
}

static void saddle(const double position[], double velocity[])
{
  velocity[0] = position[0] - 0.5;
  velocity[1] = -(position[1] - 0.5);
}

/* Three vortices with smooth cores of radius 0.08, one of them turning the other way. */
static void vortex3(const double position[], double velocity[])
{
  static const struct {
    double x, y, circulation;
  } cores[] = {{0.28, 0.30, 1.0}, {0.74, 0.34, -1.0}, {0.48, 0.74, 1.0}};
  const double radius = 0.08;
  velocity[0] = velocity[1] = 0.0;
  for (size_t i = 0; i < sizeof cores / sizeof cores[0]; ++i) {
    double dx = position[0] - cores[i].x, dy = position[1] - cores[i].y;
    double strength = cores[i].circulation / (dx * dx + dy * dy + radius * radius);
    velocity[0] -= strength * dy;
    velocity[1] += strength * dx;
  }
}

/* Convection rolls: psi = sin 3 pi x sin pi y + sin 2 pi x sin 2 pi y / 4,
 * v = (d psi / d y, -d psi / d x). */
static void benard(const double position[], double velocity[])
{
  double x = position[0], y = position[1];
  velocity[0] =
      PI * (sin_pi(3.0 * x) * cos_pi(y) + 0.5 * sin_pi(2.0 * x) * cos_pi(2.0 * y));
  velocity[1] =
      -PI * (3.0 * cos_pi(3.0 * x) * sin_pi(y) + 0.5 * cos_pi(2.0 * x) * sin_pi(2.0 * y));
}

/* A swirl about the vertical axis through the middle that rises in its core. */
static void vortex3d(const double position[], double velocity[])
{
  double x = position[0] - 0.5, y = position[1] - 0.5;
  velocity[0] = -y;
  velocity[1] = x;
  velocity[2] = 0.6 * exp(-12.0 * (x * x + y * y));
}

/* The flow of Arnold, Beltrami and Childress with A = B = C = 1. */
static void abc(const double position[], double velocity[])
{
  for (int k = 0; k < 3; ++k)
    velocity[k] =
        sin_pi(2.0 * position[(k + 2) % 3]) + cos_pi(2.0 * position[(k + 1) % 3]);
}

typedef struct analytic_field {
  const char *name;
  int dimension;
  bool periodic; /* along each axis, with period 1 */
  analytic_velocity *velocity;
} analytic_field;

static const analytic_field FIELDS[] = {
    {"uniform", 2, false, uniform}, {"vortex", 2, false, vortex},
    {"saddle", 2, false, saddle},   {"vortex3", 2, false, vortex3},
    {"benard", 2, false, benard},   {"vortex3d", 3, false, vortex3d},
    {"abc", 3, true, abc}};

enum { FIELD_COUNT = sizeof FIELDS / sizeof *FIELDS };

const char *const *fg_field_analytic_names(void)
{
  static const char *const names[] = {"uniform", "vortex",   "saddle", "vortex3",
                                      "benard",  "vortex3d", "abc",    NULL};
  return names;
}

static fg_status find(const analytic_field **out, fg_context *context, const char *name)
{
  for (int i = 0; i < FIELD_COUNT; ++i)
    if (strcmp(FIELDS[i].name, name) == 0) {
      *out = &FIELDS[i];
      return FG_STATUS_OK;
    }
  fg_status status =
      fg__fail(context, FG_STATUS_ARGUMENT,
               "synth:%.100s: there is no analytic field of this name", name);
  char known[256] = "";
  for (int i = 0; i < FIELD_COUNT; ++i) {
    size_t used = strlen(known);
    snprintf(known + used, sizeof known - used, "%s%s", i ? ", " : "", FIELDS[i].name);
  }
  fg__hint(context, "the names are: %s", known);
  return status;
}

static void sample(float *const component[3], const double *axis, size_t side,
                   const analytic_field *field)
{
  const int dimension = field->dimension;
  size_t layers = dimension == 3 ? side : 1, n = 0;
  for (size_t k = 0; k < layers; ++k)
    for (size_t j = 0; j < side; ++j)
      for (size_t i = 0; i < side; ++i, ++n) {
        double velocity[3];
        field->velocity((const double[]){axis[i], axis[j], axis[k]}, velocity);
        for (int c = 0; c < dimension; ++c)
          component[c][n] = (float)velocity[c];
      }
}

static fg_status check_nodes(fg_context *context, const analytic_field *field, int nodes)
{
  int least = field->periodic ? NODES_MIN + 1 : NODES_MIN;
  int most = field->dimension == 3 ? NODES_MAX_3D : NODES_MAX_2D;
  if (nodes >= least && nodes <= most)
    return FG_STATUS_OK;
  return fg__fail(context, FG_STATUS_ARGUMENT,
                  "synth:%s: %d nodes a side; %d to %d are possible", field->name, nodes,
                  least, most);
}

fg_status fg_field_create_analytic(fg_field **out, fg_context *context, const char *name,
                                   int nodes)
{
  if (out)
    *out = NULL;
  if (!out || !name)
    return fg__fail(context, FG_STATUS_ARGUMENT, "analytic field: %s is missing",
                    out ? "the name" : "the place for the result");
  const analytic_field *field = NULL;
  fg_status status = find(&field, context, name);
  if (status == FG_STATUS_OK && nodes == 0)
    nodes = field->dimension == 3 ? NODES_DEFAULT_3D : NODES_DEFAULT_2D;
  if (status == FG_STATUS_OK)
    status = check_nodes(context, field, nodes);
  if (status != FG_STATUS_OK)
    return status;

  size_t side = (size_t)nodes - (field->periodic ? 1 : 0), count = 1;
  for (int k = 0; k < field->dimension; ++k)
    count *= side;
  double *axis = fg__allocate(side, sizeof *axis);
  float *velocity[3] = {NULL};
  bool allocated = axis != NULL;
  for (int k = 0; k < field->dimension; ++k) {
    velocity[k] = fg__allocate(count, sizeof(float));
    allocated = allocated && velocity[k];
  }
  if (!allocated) {
    status = fg__fail_memory(context, "an analytic field",
                             side * sizeof *axis +
                                 (size_t)field->dimension * count * sizeof *velocity[0]);
    goto cleanup;
  }
  for (size_t i = 0; i < side; ++i)
    axis[i] = (double)i / (double)(nodes - 1);
  sample(velocity, axis, side, field);

  char title[64];
  snprintf(title, sizeof title, "%s (analytic)", name);
  fg_field_arrays arrays = {
      .dimension = field->dimension, .scale = FG_SCALE_PLAIN, .title = title};
  for (int k = 0; k < field->dimension; ++k) {
    arrays.size[k] = (int)side;
    arrays.axis[k] = axis;
    arrays.period[k] = field->periodic ? 1.0 : 0.0;
    arrays.velocity[k] = velocity[k];
  }
  status = fg_field_create(out, context, &arrays);

cleanup:
  for (int k = 0; k < 3; ++k)
    free(velocity[k]);
  free(axis);
  return status;
}
