/* Images, and paintings of them: clusters that follow an image's level sets become brush
 * strokes (docs/method/brush.md).
 *
 *     fg_image *image;  fg_strokes *strokes;
 *     fg_image_read(&image, ctx, "photo.jpg");
 *     fg_strokes_create(&strokes, ctx, image, NULL);
 *     fg_painting_write(ctx, "painting.png", image, strokes, NULL);
 */
#ifndef FLOWGRAIN_BRUSH_H
#define FLOWGRAIN_BRUSH_H

#include "flowgrain/context.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct fg_image fg_image;

typedef struct fg_image_arrays {
  int width, height;   /* pixels, from 2 on */
  int channels;        /* 1: grey; 3: red, green, blue */
  const float *sample; /* 0 to 1, as screens take them (sRGB); a pixel's channels side by
                          side, rows from the top */
  const float *alpha;  /* a value a pixel, 0 to 1; NULL: opaque */
} fg_image_arrays;

/* Reads a PNG, JPEG or PNM (PGM, PPM; text or binary) image, of 8 or 16 bits; the format
 * is found from the content. It is turned upright as its Exif data say; ICC profiles and
 * the inks of print are converted to sRGB (docs/method/brush.md). A whole file only: a
 * truncated one is refused. FILE_ACCESS, FILE_FORMAT, UNSUPPORTED, MEMORY. */
FG_API fg_status fg_image_read(fg_image **out, fg_context *context, const char *path);

/* Copies arrays into a new image. ARGUMENT (sizes, values outside 0 to 1), MEMORY. */
FG_API fg_status fg_image_create(fg_image **out, fg_context *context,
                                 const fg_image_arrays *arrays);
FG_API void fg_image_destroy(fg_image *image);

/* The image's arrays, borrowed. */
FG_API const fg_image_arrays *fg_image_contents(const fg_image *image);

enum { FG_MOST_BRUSH_SCALES = 16 };

/* A zero field means its default, in brackets. */
typedef struct fg_brush_options {
  const int *clusters; /* numbers of clusters, descending or not: a layer of strokes each,
                          few and broad ones first [NULL: by the image's size] */
  int cluster_count;   /* at most FG_MOST_BRUSH_SCALES */
  double anisotropy;   /* a of the gradient energy, in (0, 1) [0.15] */
  uint64_t seed;       /* [1] */
  int threads;         /* of the evolutions [all cores] */
} fg_brush_options;

/* A stroke of the brush, in pixels from the image's upper left corner, y downwards. */
typedef struct fg_stroke {
  int layer;                 /* from 0, the broadest */
  int point_count;           /* at least 2 */
  const double (*points)[2]; /* of the line that the brush follows, evenly spaced */
  double width;              /* full width of the brush */
  double color[3];           /* red, green, blue, 0 to 1; alike for a grey image */
  uint64_t seed;             /* of its bristles */
} fg_stroke;

typedef struct fg_strokes fg_strokes;

/* Makes the strokes of an image, in the order in which they are to be painted. This rank
 * works on its own. ARGUMENT, NO_CONVERGENCE, MEMORY, STOPPED. */
FG_API fg_status fg_strokes_create(fg_strokes **out, fg_context *context,
                                   const fg_image *image,
                                   const fg_brush_options *options);
FG_API void fg_strokes_destroy(fg_strokes *strokes);

/* How many strokes there are; stroke `index`, from 0 in the order of painting, borrowed;
 * and how many layers they are in. */
FG_API int fg_strokes_count(const fg_strokes *strokes);
FG_API const fg_stroke *fg_strokes_at(const fg_strokes *strokes, int index);
FG_API int fg_strokes_layers(const fg_strokes *strokes);

/* A zero field means its default, in brackets. */
typedef struct fg_painting_options {
  double width;            /* in points of 1/72 inch [a point a pixel of the image] */
  double pixels_per_point; /* for PNG [2] */
  bool transparent;        /* no ground under the strokes */
} fg_painting_options;

/* Paints strokes; the format follows the name's end: .svg, .pdf or .png. options may be
 * NULL. FILE_ACCESS, UNSUPPORTED, ARGUMENT, MEMORY. */
FG_API fg_status fg_painting_write(fg_context *context, const char *path,
                                   const fg_image *image, const fg_strokes *strokes,
                                   const fg_painting_options *options);

#ifdef __cplusplus
}
#endif

#endif
