/* Convection in a porous layer, and its velocity as a file that flowgrain reads:
 *
 *     convection RAYLEIGH CELLS TIME FILE.nc
 *
 * The layer is 2 wide and 1 high, heated below, cooled above, with insulated sides and
 * tight walls; CELLS over the height, even. Lengths are heights of the layer, times
 * those in which buoyancy moves a height. Darcy's law with a stream function psi,
 * velocity (psi_y, -psi_x), and the temperature T:
 *
 *     -Laplace psi = T_x
 *     T_t + J(T, psi) = 1 / Ra Laplace T,     J(a, psi) = a_x psi_y - a_y psi_x
 *
 * Second differences; J by Arakawa (J. Comput. Phys. 1, 1966), which keeps the integrals
 * of T and T^2; steps of Adams and Bashforth; psi by sine series along x and elimination
 * along y. data/convection_*.nc were made by it (data/README.md).
 */
#include <flowgrain/flowgrain.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { ASPECT = 2 };

typedef struct flow {
  int nx, ny; /* cells */
  double h, diffusivity, step;
  double *temperature, *slope, *stream; /* nodes, x fastest; slope: T_x */
  double *change, *before;              /* of the temperature */
  double *sine;                         /* (nx - 1)^2: sin(pi i k / nx) */
  double *series, *pivot;
} flow;

static size_t at(const flow *f, int i, int j)
{
  return (size_t)j * (size_t)(f->nx + 1) + (size_t)i;
}

static double *zeros(size_t count)
{
  double *values = calloc(count, sizeof *values);
  if (!values) {
    fprintf(stderr, "convection: out of memory\n");
    exit(1);
  }
  return values;
}

static void clear(flow *f)
{
  double *all[] = {f->temperature, f->slope, f->stream, f->change,
                   f->before,      f->sine,  f->series, f->pivot};
  for (size_t n = 0; n < sizeof all / sizeof all[0]; ++n)
    free(all[n]);
}

static flow create(double rayleigh, int cells)
{
  const double pi = acos(-1.0), courant = 0.25;
  flow f = {.nx = ASPECT * cells, .ny = cells, .h = 1.0 / cells};
  size_t nodes = (size_t)(f.nx + 1) * (size_t)(f.ny + 1), modes = (size_t)(f.nx - 1);
  f.diffusivity = 1.0 / rayleigh;
  f.step = courant * fmin(f.h, 0.5 * f.h * f.h / f.diffusivity);
  double **arrays[] = {&f.temperature, &f.slope,  &f.stream,
                       &f.change,      &f.before, &f.series};
  for (size_t n = 0; n < sizeof arrays / sizeof arrays[0]; ++n)
    *arrays[n] = zeros(nodes);
  f.pivot = zeros((size_t)f.ny + 1);
  f.sine = zeros(modes * modes);
  for (int k = 1; k < f.nx; ++k)
    for (int i = 1; i < f.nx; ++i)
      f.sine[(size_t)(k - 1) * modes + (size_t)(i - 1)] = sin(pi * i * k / f.nx);
  /* still, with a disturbance of so many waves that no symmetry is kept */
  for (int j = 0; j <= f.ny; ++j)
    for (int i = 0; i <= f.nx; ++i) {
      double x = i * f.h, y = j * f.h, waves = 0.0;
      for (int k = 1; k <= 24; ++k)
        waves += cos(0.5 * pi * k * x + 1.7 * k * k);
      f.temperature[at(&f, i, j)] = 1.0 - y + 0.004 * sin(pi * y) * waves;
    }
  return f;
}

/* Sums of `from` in the rows 1 ... ny - 1 with the sines, times `scale`. */
static void transform(const flow *f, const double *from, double scale, double *to)
{
  size_t modes = (size_t)(f->nx - 1);
  for (int j = 1; j < f->ny; ++j) {
    double *out = to + at(f, 1, j);
    for (size_t i = 0; i < modes; ++i)
      out[i] = 0.0;
    for (size_t k = 0; k < modes; ++k) {
      double value = scale * from[at(f, 1, j) + k];
      const double *sine = f->sine + k * modes;
      for (size_t i = 0; i < modes; ++i)
        out[i] += value * sine[i];
    }
  }
}

/* -Laplace psi = T_x, psi = 0 on the walls. */
static void find_stream(flow *f)
{
  const double pi = acos(-1.0);
  for (int j = 1; j < f->ny; ++j)
    for (int i = 1; i < f->nx; ++i) {
      const double *t = f->temperature + at(f, i, j);
      f->slope[at(f, i, j)] = (t[1] - t[-1]) / (2.0 * f->h);
    }
  transform(f, f->slope, 2.0 / f->nx, f->series);
  for (int k = 1; k < f->nx; ++k) {
    double s = sin(0.5 * pi * k / f->nx), diagonal = 2.0 + 4.0 * s * s;
    double *x = f->series + k;
    size_t row = (size_t)(f->nx + 1);
    f->pivot[0] = 0.0;
    for (int j = 1; j < f->ny; ++j) {
      double below = j > 1 ? x[(size_t)(j - 1) * row] : 0.0;
      f->pivot[j] = 1.0 / (diagonal - f->pivot[j - 1]);
      x[(size_t)j * row] = (f->h * f->h * x[(size_t)j * row] + below) * f->pivot[j];
    }
    for (int j = f->ny - 2; j > 0; --j)
      x[(size_t)j * row] += f->pivot[j] * x[(size_t)(j + 1) * row];
  }
  transform(f, f->series, 1.0, f->stream);
}

/* a_x psi_y - a_y psi_x at an inner node, times 12 h^2. */
static double jacobian(const double *a, const double *p, ptrdiff_t row)
{
  double cross =
      (a[1] - a[-1]) * (p[row] - p[-row]) - (a[row] - a[-row]) * (p[1] - p[-1]);
  double sides = a[1] * (p[row + 1] - p[1 - row]) - a[-1] * (p[row - 1] - p[-1 - row]) -
                 a[row] * (p[row + 1] - p[row - 1]) +
                 a[-row] * (p[1 - row] - p[-1 - row]);
  double corners = a[row + 1] * (p[row] - p[1]) - a[-1 - row] * (p[-1] - p[-row]) -
                   a[row - 1] * (p[row] - p[-1]) + a[1 - row] * (p[1] - p[-row]);
  return cross + sides + corners;
}

static double laplacian(const double *a, ptrdiff_t row)
{
  return a[1] + a[-1] + a[row] + a[-row] - 4.0 * a[0];
}

static void find_changes(flow *f)
{
  ptrdiff_t row = f->nx + 1;
  double by_diffusion = f->diffusivity / (f->h * f->h),
         by_flow = 1.0 / (12.0 * f->h * f->h);
  for (int j = 1; j < f->ny; ++j)
    for (int i = 1; i < f->nx; ++i) {
      size_t n = at(f, i, j);
      const double *t = f->temperature + n, *p = f->stream + n;
      f->change[n] = by_diffusion * laplacian(t, row) - by_flow * jacobian(t, p, row);
    }
}

static void advance(flow *f, bool first)
{
  double now = first ? 1.0 : 1.5, past = first ? 0.0 : -0.5;
  find_stream(f);
  find_changes(f);
  for (int j = 1; j < f->ny; ++j)
    for (int i = 1; i < f->nx; ++i) {
      size_t n = at(f, i, j);
      f->temperature[n] += f->step * (now * f->change[n] + past * f->before[n]);
    }
  double *kept = f->change;
  f->change = f->before;
  f->before = kept;
  /* no heat through the sides, to second order */
  for (int j = 1; j < f->ny; ++j) {
    double *t = f->temperature + at(f, 0, j), *end = t + f->nx;
    t[0] = (4.0 * t[1] - t[2]) / 3.0;
    end[0] = (4.0 * end[-1] - end[-2]) / 3.0;
  }
}

/* A derivative by second differences, one-sided at the ends. */
static double slope(const double *a, ptrdiff_t step, int n, int last, double h)
{
  if (n == 0)
    return (-3.0 * a[0] + 4.0 * a[step] - a[2 * step]) / (2.0 * h);
  if (n == last)
    return (3.0 * a[0] - 4.0 * a[-step] + a[-2 * step]) / (2.0 * h);
  return (a[step] - a[-step]) / (2.0 * h);
}

static fg_status write(flow *f, fg_context *context, double rayleigh, double time,
                       const char *path)
{
  size_t nodes = (size_t)(f->nx + 1) * (size_t)(f->ny + 1);
  float *u = malloc(nodes * sizeof *u), *v = malloc(nodes * sizeof *v);
  double *axis = zeros((size_t)f->nx + 1);
  char title[120];
  snprintf(title, sizeof title, "Convection in a porous layer, Ra = %g, t = %g", rayleigh,
           time);
  find_stream(f);
  for (int j = 0; u && v && j <= f->ny; ++j)
    for (int i = 0; i <= f->nx; ++i) {
      size_t n = at(f, i, j);
      u[n] = (float)slope(f->stream + n, f->nx + 1, j, f->ny, f->h);
      v[n] = -(float)slope(f->stream + n, 1, i, f->nx, f->h);
    }
  for (int i = 0; i <= f->nx; ++i)
    axis[i] = i * f->h;
  fg_field_arrays arrays = {.dimension = 2,
                            .size = {f->nx + 1, f->ny + 1},
                            .axis = {axis, axis},
                            .velocity = {u, v},
                            .title = title};
  fg_field *field = NULL;
  fg_status status =
      u && v ? fg_field_create(&field, context, &arrays) : FG_STATUS_MEMORY;
  if (!status)
    status = fg_field_write(context, path, field);
  fg_field_destroy(field);
  free(axis);
  free(u);
  free(v);
  return status;
}

int main(int argc, char **argv)
{
  double rayleigh = argc == 5 ? atof(argv[1]) : 0.0,
         time = argc == 5 ? atof(argv[3]) : 0.0;
  int cells = argc == 5 ? atoi(argv[2]) : 0;
  if (!(rayleigh > 0.0) || !(time > 0.0) || cells < 8 || cells > 1024) {
    fprintf(stderr, "usage: convection RAYLEIGH CELLS TIME FILE.nc\n");
    return 2;
  }
  flow f = create(rayleigh, cells);
  long steps = lround(time / f.step);
  for (long n = 0; n < steps; ++n)
    advance(&f, n == 0);
  fg_context *context = NULL;
  fg_status status = fg_context_create(&context);
  if (!status)
    status = write(&f, context, rayleigh, time, argv[4]);
  if (status)
    fprintf(stderr, "convection: %s\n", fg_context_message(context));
  fg_context_destroy(context);
  clear(&f);
  return status ? 1 : 0;
}
