#include "read/image/image.h"

#include <setjmp.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <jpeglib.h>

#include "base/memory.h"
#include "read/image/colors.h"
#include "read/image/exif.h"

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
  float *inks; /* or other components of a row */
  unsigned char *profile;
  fg__colors *colors;
  struct jpeg_progress_mgr progress;
  fg_status status; /* of what ended it, unless libjpeg did */
  jmp_buf out;
  char message[JMSG_LENGTH_MAX];
} reading;

/* A progressive image is stored in scans, each of which goes over all pixels, however few
 * bytes it has. Writers make about ten. */
enum { MOST_SCANS = 100 };

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

/* Called again and again; leaves what takes too long, or is not wanted any more. */
static void watch(j_common_ptr common)
{
  reading *r = (reading *)(void *)common->err;
  r->status = fg__check_stop(r->context);
  if (r->status == FG_STATUS_OK && r->jpeg.input_scan_number > MOST_SCANS)
    r->status =
        fg__fail(r->context, FG_STATUS_UNSUPPORTED,
                 "%s: a JPEG image of more than %d scans", r->source->path, MOST_SCANS);
  if (r->status != FG_STATUS_OK)
    longjmp(r->out, 1);
}

enum { EXIF_MARKER = JPEG_APP0 + 1, PROFILE_MARKER = JPEG_APP0 + 2, LONGEST = 0xffff };

static int orientation_of(j_decompress_ptr jpeg)
{
  for (jpeg_saved_marker_ptr m = jpeg->marker_list; m; m = m->next)
    if (m->marker == EXIF_MARKER && m->data_length > 6 &&
        memcmp(m->data, "Exif\0", 6) == 0)
      return fg__exif_orientation(m->data + 6, m->data_length - 6);
  return 1;
}

/* How many components a pixel has: grey 1, red, green, blue 3, inks 4. */
static int choose_components(j_decompress_ptr jpeg)
{
  switch (jpeg->jpeg_color_space) {
  case JCS_GRAYSCALE:
    jpeg->out_color_space = JCS_GRAYSCALE;
    return 1;
  case JCS_CMYK:
  case JCS_YCCK:
    jpeg->out_color_space = JCS_CMYK;
    return 4;
  default:
    jpeg->out_color_space = JCS_RGB;
    return 3;
  }
}

static fg_status open_colors(reading *r, int components)
{
  unsigned size = 0;
  jpeg_read_icc_profile(&r->jpeg, &r->profile, &size);
  if (r->jpeg.err->num_warnings)
    return fg__fail(r->context, FG_STATUS_FILE_FORMAT,
                    "%s: the colour profile in it is damaged", r->source->path);
  return fg__colors_create(&r->colors, r->context, r->source->path, r->profile, size,
                           components);
}

static void read_row(reading *r, float *to, int components)
{
  j_decompress_ptr jpeg = &r->jpeg;
  size_t values = (size_t)jpeg->image_width * (size_t)components;
  /* Adobe's programs store what the inks leave of the light */
  bool inverted = components == 4 && jpeg->saw_Adobe_marker;
  jpeg_read_scanlines(jpeg, &r->row, 1);
  for (size_t n = 0; n < values; ++n)
    r->inks[n] = (float)(inverted ? 255 - r->row[n] : r->row[n]) / 255.0F;
  fg__colors_convert(r->colors, to, r->inks, jpeg->image_width, components);
}

static fg_status read_pixels(reading *r)
{
  j_decompress_ptr jpeg = &r->jpeg;
  jpeg_create_decompress(jpeg);
  r->progress.progress_monitor = watch;
  jpeg->progress = &r->progress;
  jpeg_mem_src(jpeg, r->source->bytes, (unsigned long)r->source->size);
  jpeg_save_markers(jpeg, EXIF_MARKER, LONGEST);
  jpeg_save_markers(jpeg, PROFILE_MARKER, LONGEST);
  jpeg_read_header(jpeg, TRUE);
  int components = choose_components(jpeg), channels = components == 1 ? 1 : 3;
  jpeg->dct_method = JDCT_ISLOW; /* the same on every machine */
  fg_status status =
      fg__image_begin(&r->image, r->context, r->source->path, jpeg->image_width,
                      jpeg->image_height, channels, false);
  if (!status)
    status = open_colors(r, components);
  if (status)
    return status;
  int orientation = orientation_of(jpeg); /* markers end with the pixels */
  size_t values = (size_t)jpeg->image_width * (size_t)components;
  r->row = fg__allocate(values, 1);
  r->inks = fg__allocate(values, sizeof *r->inks);
  if (!r->row || !r->inks)
    return fg__fail_memory(r->context, "an image", values * 5);
  jpeg_start_decompress(jpeg);
  while (jpeg->output_scanline < jpeg->output_height && !jpeg->err->num_warnings)
    read_row(r,
             r->image->sample + (size_t)jpeg->output_scanline *
                                    (size_t)jpeg->image_width * (size_t)channels,
             components);
  if (!jpeg->err->num_warnings)
    jpeg_finish_decompress(jpeg);
  if (jpeg->err->num_warnings)
    return fg__fail(r->context, FG_STATUS_FILE_FORMAT, "%s: is no whole JPEG image: %s",
                    r->source->path, r->message);
  return fg__image_turn(&r->image, r->context, r->source->path, orientation);
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
    status = r->status
                 ? r->status
                 : fg__fail(context, FG_STATUS_FILE_FORMAT,
                            "%s: is no whole JPEG image: %s", source->path, r->message);
  jpeg_destroy_decompress(&r->jpeg);
  fg__colors_destroy(r->colors);
  free(r->profile);
  free(r->inks);
  free(r->row);
  if (status)
    fg_image_destroy(r->image);
  else
    *out = r->image;
  free(r);
  return status;
}

const fg__image_format fg__image_jpeg = {"JPEG", jpeg_is_mine, jpeg_read};
