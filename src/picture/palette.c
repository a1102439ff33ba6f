#include "picture/palette.h"

#include <math.h>
#include <string.h>

#include "flowgrain/flowgrain.h"

enum { NODES = 5, PUBLISHED = 17 };

/* WCAG 2.1, success criterion 1.4.11: graphics need 3 : 1 against what is beside them. */
static const double contrast_on_white = 3.0;

/* A map of our own: in Oklab's polar form, the lightness falls linearly from slow to fast
 * (on a light page readers take dark for more: Schloss et al. 2019), chroma and hue turn
 * evenly between nodes that lie inside the sRGB gamut. */
typedef struct formula {
  const char *name;
  double lightness[2];
  double chroma[NODES];
  double hue[NODES]; /* degrees */
} formula;

static const formula formulas[] = {
    {"gale",
     {0.655, 0.30},
     {0.105, 0.125, 0.165, 0.150, 0.105},
     {200.0, 244.0, 288.0, 332.0, 376.0}},
    {"ember",
     {0.675, 0.27},
     {0.140, 0.165, 0.172, 0.155, 0.120},
     {65.0, 28.0, -9.0, -46.0, -83.0}},
    {"deep",
     {0.655, 0.27},
     {0.100, 0.115, 0.126, 0.120, 0.085},
     {225.0, 237.0, 249.0, 261.0, 273.0}},
    {"grey", {0.66, 0.20}, {0.0, 0.0, 0.0, 0.0, 0.0}, {0.0, 0.0, 0.0, 0.0, 0.0}},
};

/* Every sixteenth entry of the maps that Nathaniel Smith, Stefan van der Walt and Eric
 * Firing gave to the public domain (CC0, 2015). They are cut where they grow too light
 * for a white page. */
typedef struct published {
  const char *name;
  unsigned rgb[PUBLISHED];
} published;

static const published publisheds[] = {
    {"viridis",
     {0x440154, 0x48186a, 0x472d7b, 0x424086, 0x3b528b, 0x33638d, 0x2c728e, 0x26828e,
      0x21918c, 0x1fa088, 0x28ae80, 0x3fbc73, 0x5ec962, 0x84d44b, 0xaddc30, 0xd8e219,
      0xfde725}},
    {"plasma",
     {0x0d0887, 0x310597, 0x4c02a1, 0x6600a7, 0x7e03a8, 0x9511a1, 0xaa2395, 0xbc3587,
      0xcc4778, 0xda5a6a, 0xe66c5c, 0xf0804e, 0xf89540, 0xfdac33, 0xfdc527, 0xf8df25,
      0xf0f921}},
    {"inferno",
     {0x000004, 0x0b0724, 0x210c4a, 0x3d0965, 0x57106e, 0x71196e, 0x8a226a, 0xa32c61,
      0xbc3754, 0xd24644, 0xe45a31, 0xf1731d, 0xf98e09, 0xfcac11, 0xf9cb35, 0xf2ea69,
      0xfcffa4}},
    {"magma",
     {0x000004, 0x0a0822, 0x1d1147, 0x36106b, 0x51127c, 0x6a1c81, 0x832681, 0x9c2e7f,
      0xb73779, 0xd0416f, 0xe75263, 0xf56b5c, 0xfc8961, 0xfea772, 0xfec488, 0xfde2a3,
      0xfcfdbf}},
};

const char *const *fg_picture_palettes(void)
{
  static const char *const names[] = {"gale",   "ember",   "deep",  "grey", "viridis",
                                      "plasma", "inferno", "magma", NULL};
  return names;
}

static double linear_of(double value)
{
  return value <= 0.04045 ? value / 12.92 : pow((value + 0.055) / 1.055, 2.4);
}

static double gamma_of(double value)
{
  double clipped = fmin(fmax(value, 0.0), 1.0);
  return clipped <= 0.0031308 ? 12.92 * clipped : 1.055 * pow(clipped, 1.0 / 2.4) - 0.055;
}

/* Björn Ottosson, "A perceptual color space for image processing", 2020. */
static fg__color from_oklab(double lightness, double a, double b)
{
  double l = lightness + 0.3963377774 * a + 0.2158037573 * b;
  double m = lightness - 0.1055613458 * a - 0.0638541728 * b;
  double s = lightness - 0.0894841775 * a - 1.2914855480 * b;
  l = l * l * l;
  m = m * m * m;
  s = s * s * s;
  return (fg__color){gamma_of(4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s),
                     gamma_of(-1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s),
                     gamma_of(-0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s)};
}

double fg__color_lightness(fg__color color)
{
  double r = linear_of(color.red), g = linear_of(color.green), b = linear_of(color.blue);
  double l = cbrt(0.4122214708 * r + 0.5363325363 * g + 0.0514459929 * b);
  double m = cbrt(0.2119034982 * r + 0.6806995451 * g + 0.1073969566 * b);
  double s = cbrt(0.0883024619 * r + 0.2817188376 * g + 0.6299787005 * b);
  return 0.2104542553 * l + 0.7936177850 * m - 0.0040720468 * s;
}

double fg__color_luminance(fg__color color)
{
  return 0.2126 * linear_of(color.red) + 0.7152 * linear_of(color.green) +
         0.0722 * linear_of(color.blue);
}

static fg__color mix(fg__color a, fg__color b, double share)
{
  return (fg__color){a.red + share * (b.red - a.red),
                     a.green + share * (b.green - a.green),
                     a.blue + share * (b.blue - a.blue)};
}

static fg__color from_bytes(unsigned rgb)
{
  return (fg__color){(double)(rgb >> 16 & 255) / 255.0, (double)(rgb >> 8 & 255) / 255.0,
                     (double)(rgb & 255) / 255.0};
}

static double along_nodes(const double node[NODES], double share)
{
  double place = share * (NODES - 1);
  int k = (int)fmin(floor(place), NODES - 2);
  return node[k] + (place - k) * (node[k + 1] - node[k]);
}

static fg__color formula_color(const formula *map, double share)
{
  double lightness = map->lightness[0] + share * (map->lightness[1] - map->lightness[0]);
  double chroma = along_nodes(map->chroma, share);
  double hue = along_nodes(map->hue, share) * (acos(-1.0) / 180.0);
  return from_oklab(lightness, chroma * cos(hue), chroma * sin(hue));
}

static fg__color published_color(const published *map, double share)
{
  double place = share * (PUBLISHED - 1);
  int k = (int)fmin(floor(place), PUBLISHED - 2);
  return mix(from_bytes(map->rgb[k]), from_bytes(map->rgb[k + 1]), place - k);
}

/* Share of a published map up to which every colour stands out from white: these maps
 * grow lighter all along, so bisection finds it. */
static double usable_share(const published *map)
{
  double good = 0.0, bad = 1.0;
  for (int k = 0; k < 30; ++k) {
    double middle = 0.5 * (good + bad);
    double luminance = fg__color_luminance(published_color(map, middle));
    if (1.05 / (luminance + 0.05) >= contrast_on_white)
      good = middle;
    else
      bad = middle;
  }
  return good;
}

static int hex_digit(char c)
{
  if (c >= '0' && c <= '9')
    return c - '0';
  if (c >= 'a' && c <= 'f')
    return c - 'a' + 10;
  return c >= 'A' && c <= 'F' ? c - 'A' + 10 : -1;
}

bool fg__color_read(fg__color *out, const char *text)
{
  if (text[0] != '#' || strlen(text) != 7)
    return false;
  unsigned rgb = 0;
  for (int k = 1; k < 7; ++k) {
    int digit = hex_digit(text[k]);
    if (digit < 0)
      return false;
    rgb = rgb << 4 | (unsigned)digit;
  }
  *out = from_bytes(rgb);
  return true;
}

fg_status fg__color_choose(fg__color *out, fg_context *context, const char *text,
                           fg__color preset)
{
  *out = preset;
  if (!text || fg__color_read(out, text))
    return FG_STATUS_OK;
  return fg__fail(context, FG_STATUS_ARGUMENT, "picture: no colour '%.40s'; use #rrggbb",
                  text);
}

static fg_status fail_unknown(fg_context *context, const char *name)
{
  fg_status status =
      fg__fail(context, FG_STATUS_ARGUMENT, "picture: no colour map '%.40s'", name);
  fg__hint(context,
           "use gale, ember, deep, grey, viridis, plasma, inferno, magma, or one "
           "colour as #rrggbb");
  return status;
}

fg_status fg__palette_create(fg__palette *out, fg_context *context, const char *name)
{
  const char *wanted = name ? name : formulas[0].name;
  out->uniform = false;
  out->bands = 0;
  fg__color single;
  if (fg__color_read(&single, wanted)) {
    out->uniform = true;
    for (int k = 0; k < FG__PALETTE_SAMPLES; ++k)
      out->sample[k] = single;
    return FG_STATUS_OK;
  }
  for (size_t m = 0; m < sizeof formulas / sizeof *formulas; ++m) {
    if (strcmp(formulas[m].name, wanted) != 0)
      continue;
    for (int k = 0; k < FG__PALETTE_SAMPLES; ++k)
      out->sample[k] = formula_color(&formulas[m], (double)k / (FG__PALETTE_SAMPLES - 1));
    return FG_STATUS_OK;
  }
  for (size_t m = 0; m < sizeof publisheds / sizeof *publisheds; ++m) {
    if (strcmp(publisheds[m].name, wanted) != 0)
      continue;
    double end = usable_share(&publisheds[m]);
    for (int k = 0; k < FG__PALETTE_SAMPLES; ++k)
      out->sample[k] =
          published_color(&publisheds[m], end * k / (FG__PALETTE_SAMPLES - 1));
    return FG_STATUS_OK;
  }
  return fail_unknown(context, wanted);
}

void fg__palette_make_pale(fg__palette *palette, double fade, int bands)
{
  static const fg__color white = {1.0, 1.0, 1.0};
  for (int k = 0; k < FG__PALETTE_SAMPLES; ++k) {
    const double share = (double)k / (FG__PALETTE_SAMPLES - 1);
    palette->sample[k] = mix(white, palette->sample[k], share * (1.0 - fade));
  }
  palette->uniform = false;
  palette->bands = bands;
}

fg__color fg__palette_color(const fg__palette *palette, double share)
{
  if (palette->bands > 1) /* the first and the last have the colours of the ends */
    share = fmin(fmax(floor(share * palette->bands), 0.0), palette->bands - 1.0) /
            (palette->bands - 1.0);
  if (!(share > 0.0))
    return palette->sample[0];
  if (share >= 1.0)
    return palette->sample[FG__PALETTE_SAMPLES - 1];
  double place = share * (FG__PALETTE_SAMPLES - 1);
  int k = (int)place;
  return mix(palette->sample[k], palette->sample[k + 1], place - k);
}
