#include "read/image/image.h"

#include <png.h>
#include <setjmp.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "read/image/colors.h"
#include "read/image/exif.h"

static bool png_is_mine(const unsigned char *bytes, size_t size)
{
  return size >= 8 && memcmp(bytes, "\x89PNG\r\n\x1a\n", 8) == 0;
}

/* A file while it is read. What is made between two calls of libpng that may jump lives
 * here, so that it is freed whatever happens. */
typedef struct reading {
  const fg__source *source;
  fg_context *context;
  size_t at; /* bytes taken */
  fg_image *image;
  unsigned char *bytes;
  unsigned char **rows;
  float *components; /* of a row, without alpha */
  fg__colors *colors;
  jmp_buf out;
  char message[160];
} reading;

static void take(png_structp png, png_bytep to, size_t count)
{
  reading *r = png_get_io_ptr(png);
  if (count > r->source->size - r->at)
    png_error(png, "the file ends too early");
  memcpy(to, r->source->bytes + r->at, count);
  r->at += count;
}

static void fail(png_structp png, png_const_charp text)
{
  reading *r = png_get_error_ptr(png);
  size_t length = strlen(text);
  length = length < sizeof r->message ? length : sizeof r->message - 1;
  memcpy(r->message, text, length);
  r->message[length] = '\0';
  longjmp(r->out, 1);
}

/* Warnings are of chunks that do not touch the pixels. */
static void ignore(png_structp png, png_const_charp text)
{
  (void)png;
  (void)text;
}

/* Grey or colour, with or without alpha, of 8 or 16 bits. */
static void ask_for_plain_samples(png_structp png, png_infop info)
{
  if (png_get_color_type(png, info) == PNG_COLOR_TYPE_PALETTE)
    png_set_palette_to_rgb(png);
  if (png_get_color_type(png, info) == PNG_COLOR_TYPE_GRAY &&
      png_get_bit_depth(png, info) < 8)
    png_set_expand_gray_1_2_4_to_8(png);
  if (png_get_valid(png, info, PNG_INFO_tRNS))
    png_set_tRNS_to_alpha(png);
  png_set_interlace_handling(png);
  png_read_update_info(png, info);
}

static float value_at(const unsigned char *row, size_t n, int depth)
{
  if (depth == 16)
    return (float)(row[2 * n] * 256 + row[2 * n + 1]) / 65535.0F;
  return (float)row[n] / 255.0F;
}

static void unpack_row(const reading *r, int j, int depth)
{
  const fg_image *image = r->image;
  int channels = image->contents.channels;
  size_t width = (size_t)image->contents.width, first = (size_t)j * width;
  size_t values = (size_t)channels + (image->alpha ? 1 : 0);
  for (size_t i = 0; i < width; ++i) {
    for (size_t k = 0; k < (size_t)channels; ++k)
      r->components[i * (size_t)channels + k] =
          value_at(r->rows[j], i * values + k, depth);
    if (image->alpha)
      image->alpha[first + i] =
          value_at(r->rows[j], i * values + (size_t)channels, depth);
  }
  fg__colors_convert(r->colors, image->sample + first * (size_t)channels, r->components,
                     width, channels);
}

static fg_status open_colors(reading *r, png_structp png, png_infop info)
{
  png_charp name;
  int compression;
  png_bytep profile = NULL;
  png_uint_32 size = 0;
  if (!png_get_iCCP(png, info, &name, &compression, &profile, &size))
    return FG_STATUS_OK;
  return fg__colors_create(&r->colors, r->context, r->source->path, profile, size,
                           r->image->contents.channels);
}

static int orientation_of(png_structp png, png_infop info)
{
#ifdef PNG_eXIf_SUPPORTED
  png_bytep exif = NULL;
  png_uint_32 size = 0;
  if (png_get_eXIf_1(png, info, &size, &exif) && exif)
    return fg__exif_orientation(exif, size);
#else
  (void)png;
  (void)info;
#endif
  return 1;
}

static fg_status read_pixels(reading *r, png_structp png, png_infop info)
{
  png_set_read_fn(png, r, take);
  png_read_info(png, info);
  ask_for_plain_samples(png, info);
  size_t width = png_get_image_width(png, info), height = png_get_image_height(png, info);
  int type = png_get_color_type(png, info), depth = png_get_bit_depth(png, info);
  fg_status status = fg__image_begin(&r->image, r->context, r->source->path, width,
                                     height, type & PNG_COLOR_MASK_COLOR ? 3 : 1,
                                     (type & PNG_COLOR_MASK_ALPHA) != 0);
  if (!status)
    status = open_colors(r, png, info);
  if (status)
    return status;
  size_t row = png_get_rowbytes(png, info);
  r->bytes = fg__allocate(height, row);
  r->rows = fg__allocate(height, sizeof *r->rows);
  r->components = fg__allocate(width, 3 * sizeof *r->components);
  if (!r->bytes || !r->rows || !r->components)
    return fg__fail_memory(r->context, "an image", height * row);
  for (size_t j = 0; j < height; ++j)
    r->rows[j] = r->bytes + j * row;
  png_read_image(png, r->rows);
  png_read_end(png, info); /* Exif may lie behind the pixels */
  for (size_t j = 0; j < height; ++j)
    unpack_row(r, (int)j, depth);
  return fg__image_turn(&r->image, r->context, r->source->path,
                        orientation_of(png, info));
}

static fg_status png_read(fg_image **out, fg_context *context, const fg__source *source)
{
  reading *r = fg__allocate(1, sizeof *r);
  if (!r)
    return fg__fail_memory(context, "an image", sizeof *r);
  r->source = source;
  r->context = context;
  png_infop info = NULL;
  png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, r, fail, ignore);
  if (png)
    info = png_create_info_struct(png);
  fg_status status;
  if (!png || !info)
    status = fg__fail_memory(context, "an image", 0);
  else if (setjmp(r->out) == 0)
    status = read_pixels(r, png, info);
  else
    status = fg__fail(context, FG_STATUS_FILE_FORMAT, "%s: is no whole PNG image: %s",
                      source->path, r->message);
  png_destroy_read_struct(&png, &info, NULL);
  fg__colors_destroy(r->colors);
  free(r->bytes);
  free(r->rows);
  free(r->components);
  if (status)
    fg_image_destroy(r->image);
  else
    *out = r->image;
  free(r);
  return status;
}

const fg__image_format fg__image_png = {"PNG", png_is_mine, png_read};
