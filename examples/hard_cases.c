/* Draws the shapes that are hard to turn into an arrow, one picture each: hard_cases
 * FOLDER.
 *
 * Each shape is given as a density on the unit square (a signed distance, positive
 * inside) and a velocity; docs/method/icons.md shows the pictures beside the rules.
 */
#include <flowgrain/flowgrain.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { NODES = 161, SAMPLES = 81 };

static const double PI = 3.14159265358979323846;

typedef struct point {
  double x, y;
} point;

typedef struct hard_case {
  const char *name;
  double (*inside)(point p); /* positive inside the cluster */
  point (*velocity)(point p);
  bool (*masked)(point p); /* NULL: no mask */
} hard_case;

static double disc(point p, double x, double y, double radius)
{
  return radius - hypot(p.x - x, p.y - y);
}

/* Distance to the capsule of a radius round the segment a b. */
static double capsule(point p, point a, point b, double radius)
{
  double dx = b.x - a.x, dy = b.y - a.y;
  double t = ((p.x - a.x) * dx + (p.y - a.y) * dy) / (dx * dx + dy * dy);
  t = fmin(fmax(t, 0.0), 1.0);
  return radius - hypot(p.x - a.x - t * dx, p.y - a.y - t * dy);
}

static double ring(point p)
{
  return 0.07 - fabs(hypot(p.x - 0.5, p.y - 0.5) - 0.28);
}

static double vortex_core(point p)
{
  return disc(p, 0.5, 0.5, 0.24);
}

static double horseshoe(point p)
{
  double arc = p.y > 0.45 ? 0.075 - fabs(hypot(p.x - 0.5, p.y - 0.45) - 0.26) : -1.0;
  double left = capsule(p, (point){0.24, 0.45}, (point){0.24, 0.15}, 0.075);
  double right = capsule(p, (point){0.76, 0.45}, (point){0.76, 0.15}, 0.075);
  return fmax(arc, fmax(left, right));
}

static double y_branch(point p)
{
  double stem = capsule(p, (point){0.12, 0.5}, (point){0.5, 0.5}, 0.07);
  double upper = capsule(p, (point){0.5, 0.5}, (point){0.85, 0.78}, 0.06);
  double lower = capsule(p, (point){0.5, 0.5}, (point){0.85, 0.27}, 0.06);
  return fmax(stem, fmax(upper, lower));
}

static double long_stripe(point p)
{
  return capsule(p, (point){0.08, 0.28}, (point){0.92, 0.72}, 0.055);
}

static double slivers(point p)
{
  double corner = disc(p, 0.0, 0.0, 0.022),
         boundary = capsule(p, (point){0.6, 1.003}, (point){0.9, 1.003}, 0.009);
  return fmax(corner,
              fmax(boundary, capsule(p, (point){0.3, 0.45}, (point){0.7, 0.55}, 0.05)));
}

static double masked_stripe(point p)
{
  return capsule(p, (point){0.1, 0.5}, (point){0.9, 0.5}, 0.09);
}

static double boundary_half(point p)
{
  return fmax(disc(p, 0.0, 0.55, 0.3),
              capsule(p, (point){0.75, 0.0}, (point){0.75, 0.45}, 0.08));
}

static point round_centre(point p)
{
  return (point){-(p.y - 0.5), p.x - 0.5};
}

static point over_the_arch(point p)
{
  if (p.y > 0.45)
    return (point){p.y - 0.45, -(p.x - 0.5)};
  return (point){0.0, p.x < 0.5 ? 0.26 : -0.26};
}

static point parting(point p)
{
  double share = fmin(fmax((p.x - 0.42) / 0.12, 0.0), 1.0);
  return (point){1.0, 0.72 * share * tanh((p.y - 0.497) / 0.03)};
}

static point across_the_stripe(point p)
{
  (void)p;
  return (point){1.0, 0.30}; /* the stripe rises by 0.52 */
}

static point eastward(point p)
{
  return (point){1.0, 0.4 * sin(PI * p.x) * (0.5 - p.x)};
}

static point past_the_boundary(point p)
{
  return (point){0.25 * (0.5 - p.y), 0.6};
}

static bool island(point p)
{
  return hypot(p.x - 0.52, p.y - 0.5) < 0.13;
}

static const hard_case CASES[] = {
    {"ring", ring, round_centre, NULL},
    {"vortex-core", vortex_core, round_centre, NULL},
    {"horseshoe", horseshoe, over_the_arch, NULL},
    {"y-branch", y_branch, parting, NULL},
    {"long-stripe", long_stripe, across_the_stripe, NULL},
    {"slivers", slivers, eastward, NULL},
    {"mask", masked_stripe, eastward, island},
    {"boundary", boundary_half, past_the_boundary, NULL},
};

static fg_status make_field(fg_field **out, fg_context *context, const hard_case *c)
{
  static double axis[SAMPLES];
  static float u[SAMPLES * SAMPLES], v[SAMPLES * SAMPLES];
  static unsigned char valid[SAMPLES * SAMPLES];
  for (int j = 0; j < SAMPLES; ++j) {
    axis[j] = (double)j / (SAMPLES - 1);
    for (int i = 0; i < SAMPLES; ++i) {
      point p = {(double)i / (SAMPLES - 1), axis[j]};
      point velocity = c->velocity(p);
      u[j * SAMPLES + i] = (float)velocity.x;
      v[j * SAMPLES + i] = (float)velocity.y;
      valid[j * SAMPLES + i] = !c->masked || !c->masked(p);
    }
  }
  fg_field_arrays arrays = {.dimension = 2,
                            .size = {SAMPLES, SAMPLES},
                            .axis = {axis, axis},
                            .velocity = {u, v},
                            .valid = valid};
  return fg_field_create(out, context, &arrays);
}

static fg_status make_density(fg_density **out, fg_context *context,
                              const fg_field *field, const hard_case *c)
{
  static float u[NODES * NODES];
  static unsigned char active[(NODES - 1) * (NODES - 1)];
  const double spacing = 1.0 / (NODES - 1);
  for (int j = 0; j < NODES; ++j)
    for (int i = 0; i < NODES; ++i) {
      double distance = c->inside((point){i * spacing, j * spacing});
      u[j * NODES + i] = (float)tanh(distance / (1.1 * spacing));
    }
  for (int j = 0; j < NODES - 1; ++j)
    for (int i = 0; i < NODES - 1; ++i) {
      double center[2] = {(i + 0.5) * spacing, (j + 0.5) * spacing}, velocity[2];
      active[j * (NODES - 1) + i] = fg_field_velocity(field, center, velocity);
    }
  fg_density_arrays arrays = {.dimension = 2,
                              .nodes = {NODES, NODES},
                              .spacing = {spacing, spacing},
                              .u = u,
                              .active = active,
                              .debris_area = 12.0 * spacing * spacing};
  return fg_density_create_from_arrays(out, context, &arrays);
}

static fg_status draw(fg_context *context, const char *folder, const hard_case *c)
{
  fg_field *field = NULL;
  fg_density *density = NULL;
  fg_icons *icons = NULL;
  char path[4096];
  snprintf(path, sizeof path, "%s/%s.png", folder, c->name);
  fg_status status = make_field(&field, context, c);
  if (!status)
    status = make_density(&density, context, field, c);
  if (!status)
    status = fg_icons_create(&icons, context, field, density, NULL);
  if (!status) {
    fg_picture_options options = {.width = 170.0,
                                  .pixels_per_point = 2.0,
                                  .palette = "#1f4e8c",
                                  .no_frame = true,
                                  .tint = true};
    status = fg_picture_write(context, path, field, density, icons, &options);
  }
  if (!status)
    printf("%s: %d clusters, %d arrows, %d dropped\n", path, fg_icons_clusters(icons),
           fg_icons_count(icons), fg_icons_dropped(icons));
  fg_icons_destroy(icons);
  fg_density_destroy(density);
  fg_field_destroy(field);
  return status;
}

int main(int argc, char **argv)
{
  if (argc != 2) {
    fprintf(stderr, "usage: %s FOLDER\n", argv[0]);
    return 2;
  }
  fg_context *context = NULL;
  fg_status status = fg_context_create(&context);
  for (size_t n = 0; !status && n < sizeof CASES / sizeof CASES[0]; ++n)
    status = draw(context, argv[1], &CASES[n]);
  if (status)
    fprintf(stderr, "%s: %s\n", fg_status_name(status), fg_context_message(context));
  fg_context_destroy(context);
  return status ? 1 : 0;
}
