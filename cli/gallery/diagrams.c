/* The gallery's diagrams. */
#include <math.h>
#include <stddef.h>
#include <string.h>

#include "gallery/gallery.h"

static void begin(FILE *svg, int width, int height)
{
  fprintf(svg,
          "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"%d\" height=\"%d\" "
          "viewBox=\"0 0 %d %d\" font-family=\"DejaVu Sans, sans-serif\" "
          "font-size=\"15\" text-anchor=\"middle\" fill=\"#222\">\n"
          "<rect width=\"%d\" height=\"%d\" fill=\"white\"/>\n",
          width, height, width, height, width, height);
}

static void line(FILE *svg, double x1, double y1, double x2, double y2, const char *style)
{
  fprintf(svg,
          "<line x1=\"%.1f\" y1=\"%.1f\" x2=\"%.1f\" y2=\"%.1f\" stroke=\"#222\" %s/>\n",
          x1, y1, x2, y2, style);
}

static void text(FILE *svg, double x, double y, const char *words)
{
  fprintf(svg, "<text x=\"%.1f\" y=\"%.1f\">%s</text>\n", x, y, words);
}

/* The energies over time of Fig. 2's evolution. */
enum { MOST_STEPS = 200 };

typedef struct energies {
  fg_step step[MOST_STEPS];
  int count;
} energies;

static const double first_time = 1e-5, last_time = 3e-2;

static fg_status evolve(energies *out, fg_context *context)
{
  const fg_evolution_options options = {.mesh = FG_MESH_UNIFORM,
                                        .energy = FG_ENERGY_ISOTROPIC,
                                        .noise = 0.02,
                                        .threads = 1}; /* figures that follow fork */
  fg_field *field = NULL;
  fg_evolution *evolution = NULL;
  fg_status status = fg_field_read(&field, context, "synth:vortex3", NULL);
  if (!status)
    status = fg_evolution_create(&evolution, context, field, &options);
  for (out->count = 0; !status && out->count < MOST_STEPS;) {
    fg_step *step = &out->step[out->count];
    status = fg_evolution_step(evolution, step);
    if (status || step->time > last_time)
      break;
    out->count += step->time >= first_time;
  }
  fg_evolution_destroy(evolution);
  fg_field_destroy(field);
  return status;
}

/* left, base: the panel's origin; width: of last_time / first_time; unit: of energy. */
typedef struct panel {
  double left, base, width, unit;
} panel;

static double abscissa(const panel *p, double time)
{
  return p->left + p->width * log(time / first_time) / log(last_time / first_time);
}

static void curve(FILE *svg, const panel *p, const energies *e, size_t place,
                  const char *colour)
{
  fprintf(svg, "<polyline fill=\"none\" stroke=\"%s\" stroke-width=\"3\" points=\"",
          colour);
  for (int n = 0; n < e->count; ++n) {
    double value;
    memcpy(&value, (const char *)&e->step[n] + place, sizeof value);
    fprintf(svg, "%.2f,%.2f ", abscissa(p, e->step[n].time), p->base - p->unit * value);
  }
  fprintf(svg, "\"/>\n");
}

static void draw_energies(FILE *svg, const energies *e)
{
  static const panel p = {720.0, 330.0, 500.0, 780.0};
  static const struct {
    size_t place;
    double x, y;
    const char *colour, *words;
  } curves[] = {{offsetof(fg_step, energy), 1000.0, 46.0, "#999999", "E"},
                {offsetof(fg_step, chemical_energy), 850.0, 78.0, "#8a1c4a",
                 "chemical: \xE2\x88\xAB\xCE\xA8(u)"},
                {offsetof(fg_step, gradient_energy), 850.0, 312.0, "#1c5a8a",
                 "gradient: \xE2\x88\xAB\xC2\xBD\xCE\xB3|\xE2\x88\x87u|\xC2\xB2"}};
  static const char *const powers[] = {"\xE2\x81\xBB\xE2\x81\xB5",
                                       "\xE2\x81\xBB\xE2\x81\xB4", "\xE2\x81\xBB\xC2\xB3",
                                       "\xE2\x81\xBB\xC2\xB2"};
  line(svg, p.left, p.base, p.left + p.width + 20.0, p.base, "stroke-width=\"1\"");
  line(svg, p.left, p.base, p.left, 30.0, "stroke-width=\"1\"");
  for (int n = 0; n < 4; ++n) {
    double x = abscissa(&p, first_time * pow(10.0, n));
    char words[16];
    snprintf(words, sizeof words, "10%s", powers[n]);
    line(svg, x, p.base - 5.0, x, p.base + 5.0, "stroke-width=\"1\"");
    text(svg, x, p.base + 24.0, words);
  }
  text(svg, p.left + p.width + 12.0, p.base + 24.0, "t");
  for (int n = 0; n < 3; ++n) {
    curve(svg, &p, e, curves[n].place, curves[n].colour);
    fprintf(svg, "<g fill=\"%s\">", curves[n].colour);
    text(svg, curves[n].x, curves[n].y, curves[n].words);
    fprintf(svg, "</g>\n");
  }
}

/* Psi(u) = (u^2 - 1)^2 / 2 from u = -1.6 to 1.6, and where Psi'' < 0; and how energies
 * change. */
void gallery_draw_energy(FILE *svg)
{
  energies over_time = {.count = 0};
  fg_context *context;
  const double left = 60.0, right = 580.0, base = 330.0, unit = 300.0;
  const double most = 1.55, a_unit = (right - left) / (2.0 * most);
  const double middle = (left + right) / 2.0, spinodal = 1.0 / sqrt(3.0);
  begin(svg, 1280, 400);
  fprintf(svg,
          "<rect x=\"%.1f\" y=\"40\" width=\"%.1f\" height=\"%.1f\" fill=\"#dbe5f1\"/>\n",
          middle - spinodal * a_unit, 2.0 * spinodal * a_unit, base - 40.0);
  line(svg, left - 20.0, base, right + 20.0, base, "stroke-width=\"1\"");
  line(svg, middle, base, middle, 30.0, "stroke-width=\"1\"");
  fprintf(svg, "<polyline fill=\"none\" stroke=\"#8a1c4a\" stroke-width=\"3\" points=\"");
  for (int n = 0; n <= 200; ++n) {
    double u = most * (n / 100.0 - 1.0), well = u * u - 1.0;
    fprintf(svg, "%.2f,%.2f ", middle + u * a_unit, base - unit * 0.5 * well * well);
  }
  fprintf(svg, "\"/>\n");
  const struct {
    double u;
    const char *words;
  } ticks[] = {{-1.0, "\xE2\x88\x92\xCE\xB2"}, {0.0, "0"}, {1.0, "\xCE\xB2"}};
  for (int n = 0; n < 3; ++n) {
    double x = middle + ticks[n].u * a_unit;
    line(svg, x, base - 5.0, x, base + 5.0, "stroke-width=\"1\"");
    text(svg, x, base + 24.0, ticks[n].words);
  }
  text(svg, right + 12.0, base + 24.0, "u");
  text(svg, middle + 30.0, 38.0, "\xCE\xA8(u)");
  text(svg, middle, base + 52.0, "\xCE\xA8\xE2\x80\xB3 &lt; 0: phases separate");
  if (!fg_context_create(&context)) {
    if (!evolve(&over_time, context))
      draw_energies(svg, &over_time);
    fg_context_destroy(context);
  }
  fprintf(svg, "</svg>\n");
}

/* Not the letter for a subscript n: few fonts have it. */
#define T_N "t<tspan dy=\"4\" font-size=\"11\">n</tspan><tspan dy=\"-4\">&#8203;</tspan>"

void gallery_draw_substeps(FILE *svg)
{
  const double left = 70.0, right = 690.0, axis = 130.0;
  const double theta = 1.0 - 1.0 / sqrt(2.0), step = right - left;
  const double at[4] = {left, left + theta * step, right - theta * step, right};
  const char *const time[4] = {T_N, T_N " + \xCE\xB8\xCF\x84",
                               T_N " + (1 \xE2\x88\x92 \xCE\xB8)\xCF\x84",
                               T_N " + \xCF\x84"};
  const char *const implicit[3] = {"\xCE\xB1 K", "\xCE\xB2 K + \xCE\xA8\xE2\x80\xB2",
                                   "\xCE\xB1 K"};
  const char *const given[3] = {"\xCE\xB2 K + \xCE\xA8\xE2\x80\xB2", "\xCE\xB1 K",
                                "\xCE\xB2 K + \xCE\xA8\xE2\x80\xB2"};
  begin(svg, 760, 230);
  line(svg, left - 30.0, axis, right + 40.0, axis, "stroke-width=\"2\"");
  fprintf(svg, "<path d=\"M %.1f %.1f l -12 -5 l 0 10 z\"/>\n", right + 50.0, axis);
  for (int n = 0; n < 4; ++n) {
    line(svg, at[n], axis - 9.0, at[n], axis + 9.0, "stroke-width=\"2\"");
    text(svg, at[n], axis + 32.0, time[n]);
  }
  for (int n = 0; n < 3; ++n) {
    double a = at[n], b = at[n + 1];
    fprintf(svg,
            "<path d=\"M %.1f %.1f Q %.1f %.1f %.1f %.1f\" fill=\"none\" "
            "stroke=\"#8a1c4a\" stroke-width=\"2.5\"/>\n",
            a + 3.0, axis - 14.0, (a + b) / 2.0, axis - 66.0, b - 3.0, axis - 14.0);
    fprintf(svg, "<g fill=\"#8a1c4a\">");
    text(svg, (a + b) / 2.0, axis - 74.0, implicit[n]);
    fprintf(svg, "</g><g fill=\"#555\" font-size=\"13\">");
    text(svg, (a + b) / 2.0, axis - 14.0, given[n]);
    fprintf(svg, "</g>\n");
  }
  text(svg, (left + right) / 2.0, axis + 76.0,
       "above each arc what is taken implicitly, below it what explicitly");
  fprintf(svg, "</svg>\n");
}
