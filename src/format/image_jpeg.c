#include "format/image.h"

#include <setjmp.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <jpeglib.h>

#include "base/memory.h"

static bool jpeg_is_mine(const unsigned char *bytes, size_t size)
{
  return size >= 3 && bytes[0] == 0xff && bytes[1] == 0xd8 && bytes[2] == 0xff;
}

/* A file while it is read; libjpeg's calls may jump out of it. */
typedef struct reading {
  struct jpeg_error_mgr errors; /* first: libjpeg hands out a pointer to it */
  struct jpeg_decompress_struct jpeg;
  fg_context *context;
  const fg__source *source;
  fg_image *image;
  unsigned char *row;
  jmp_buf out;
  char message[JMSG_LENGTH_MAX];
} reading;

static void keep_message(reading *r)
{
  if (!r->message[0])
    r->errors.format_message((j_common_ptr)&r->jpeg, r->message);
}

static void fail(j_common_ptr jpeg)
{
  reading *r = (reading *)(void *)jpeg->err;
  r->message[0] = '\0';
  keep_message(r);
  longjmp(r->out, 1);
}

/* A warning means pixels that were made up: of a truncated or damaged file. */
static void note(j_common_ptr jpeg, int level)
{
  if (level < 0) {
    keep_message((reading *)(void *)jpeg->err);
    ++jpeg->err->num_warnings;
  }
}

static fg_status read_pixels(reading *r)
{
  j_decompress_ptr jpeg = &r->jpeg;
  jpeg_create_decompress(jpeg);
  jpeg_mem_src(jpeg, r->source->bytes, (unsigned long)r->source->size);
  jpeg_read_header(jpeg, TRUE);
  if (jpeg->jpeg_color_space == JCS_CMYK || jpeg->jpeg_color_space == JCS_YCCK)
    return fg__fail(r->context, FG_STATUS_UNSUPPORTED,
                    "%s: has the four inks of print for colours; grey and red, green, "
                    "blue can be read",
                    r->source->path);
  jpeg->out_color_space =
      jpeg->jpeg_color_space == JCS_GRAYSCALE ? JCS_GRAYSCALE : JCS_RGB;
  jpeg->dct_method = JDCT_ISLOW; /* the same on every machine */
  int channels = jpeg->out_color_space == JCS_GRAYSCALE ? 1 : 3;
  fg_status status =
      fg__image_begin(&r->image, r->context, r->source->path, jpeg->image_width,
                      jpeg->image_height, channels, false);
  if (status)
    return status;
  size_t values = (size_t)jpeg->image_width * (size_t)channels;
  r->row = fg__allocate(values, 1);
  if (!r->row)
    return fg__fail_memory(r->context, "an image", values);
  jpeg_start_decompress(jpeg);
  while (jpeg->output_scanline < jpeg->output_height && !jpeg->err->num_warnings) {
    float *sample = r->image->sample + (size_t)jpeg->output_scanline * values;
    jpeg_read_scanlines(jpeg, &r->row, 1);
    for (size_t n = 0; n < values; ++n)
      sample[n] = (float)r->row[n] / 255.0F;
  }
  if (!jpeg->err->num_warnings)
    jpeg_finish_decompress(jpeg);
  if (jpeg->err->num_warnings)
    return fg__fail(r->context, FG_STATUS_FILE_FORMAT, "%s: is no whole JPEG image: %s",
                    r->source->path, r->message);
  return FG_STATUS_OK;
}

static fg_status jpeg_read(fg_image **out, fg_context *context, const fg__source *source)
{
  reading *r = fg__allocate(1, sizeof *r);
  if (!r)
    return fg__fail_memory(context, "an image", sizeof *r);
  r->source = source;
  r->context = context;
  r->jpeg.err = jpeg_std_error(&r->errors);
  r->errors.error_exit = fail;
  r->errors.emit_message = note;
  fg_status status;
  if (setjmp(r->out) == 0)
    status = read_pixels(r);
  else
    status = fg__fail(context, FG_STATUS_FILE_FORMAT, "%s: is no whole JPEG image: %s",
                      source->path, r->message);
  jpeg_destroy_decompress(&r->jpeg);
  free(r->row);
  if (status)
    fg_image_destroy(r->image);
  else
    *out = r->image;
  free(r);
  return status;
}

const fg__image_format fg__image_jpeg = {"JPEG", jpeg_is_mine, jpeg_read};
