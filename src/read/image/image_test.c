#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <jpeglib.h>
#include <png.h>

#include "base/context_test.h"
#include "read/image/image.h"

enum { WIDTH = 7, HEIGHT = 5, MOST_CHANNELS = 4 };

/* A file in memory. */
typedef struct file {
  unsigned char *bytes;
  size_t size;
} file;

/* 8-bit values without any symmetry. */
static unsigned sample_at(int i, int j, int k)
{
  return (unsigned)(31 * i + 57 * j + 83 * k + i * j * 11) % 256;
}

static void append(file *f, const void *bytes, size_t count)
{
  f->bytes = realloc(f->bytes, f->size + count + 1);
  assert_non_null(f->bytes);
  memcpy(f->bytes + f->size, bytes, count);
  f->size += count;
}

static void take_png(png_structp png, png_bytep bytes, size_t count)
{
  append(png_get_io_ptr(png), bytes, count);
}

static void flush_png(png_structp png)
{
  (void)png;
}

static file png_of(int type, int channels, int depth, int interlace)
{
  file f = {0};
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, NULL, NULL, NULL);
  png_infop info = png_create_info_struct(png);
  png_set_write_fn(png, &f, take_png, flush_png);
  png_set_IHDR(png, info, WIDTH, HEIGHT, depth, type, interlace,
               PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  unsigned char rows[HEIGHT][2 * MOST_CHANNELS * WIDTH];
  unsigned char *row[HEIGHT];
  for (int j = 0; j < HEIGHT; ++j) {
    row[j] = rows[j];
    for (int i = 0; i < WIDTH; ++i)
      for (int k = 0; k < channels; ++k)
        for (int byte = 0; byte < depth / 8; ++byte) /* 257 v: the same byte twice */
          rows[j][(i * channels + k) * depth / 8 + byte] =
              (unsigned char)sample_at(i, j, k);
  }
  png_write_info(png, info);
  png_write_image(png, row);
  png_write_end(png, info);
  png_destroy_write_struct(&png, &info);
  return f;
}

static file pnm_of(char kind, int channels, int most)
{
  file f = {0};
  char text[64];
  snprintf(text, sizeof text, "P%c\n# a comment\n%d %d\n%d\n", kind, WIDTH, HEIGHT, most);
  append(&f, text, strlen(text));
  for (int j = 0; j < HEIGHT; ++j)
    for (int i = 0; i < WIDTH; ++i)
      for (int k = 0; k < channels; ++k) {
        unsigned value = sample_at(i, j, k) * (most > 255 ? 257U : 1U);
        unsigned char bytes[2] = {(unsigned char)(value / 256),
                                  (unsigned char)(value % 256)};
        if (kind < '5')
          append(&f, text, (size_t)snprintf(text, sizeof text, "%u ", value));
        else if (most > 255)
          append(&f, bytes, 2);
        else
          append(&f, bytes + 1, 1);
      }
  return f;
}

static file jpeg_of(int channels, bool progressive)
{
  struct jpeg_compress_struct jpeg;
  struct jpeg_error_mgr errors;
  unsigned char *bytes = NULL;
  unsigned long size = 0;
  jpeg.err = jpeg_std_error(&errors);
  jpeg_create_compress(&jpeg);
  jpeg_mem_dest(&jpeg, &bytes, &size);
  jpeg.image_width = 8 * WIDTH;
  jpeg.image_height = 8 * HEIGHT;
  jpeg.input_components = channels;
  jpeg.in_color_space = channels == 1 ? JCS_GRAYSCALE : JCS_RGB;
  jpeg_set_defaults(&jpeg);
  jpeg_set_quality(&jpeg, 100, TRUE);
  if (progressive)
    jpeg_simple_progression(&jpeg);
  jpeg_start_compress(&jpeg, TRUE);
  for (int j = 0; j < 8 * HEIGHT; ++j) {
    unsigned char line[8 * WIDTH * 3], *row = line;
    for (int i = 0; i < 8 * WIDTH; ++i)
      for (int k = 0; k < channels; ++k)
        line[i * channels + k] = (unsigned char)sample_at(i / 8, j / 8, k);
    jpeg_write_scanlines(&jpeg, &row, 1);
  }
  jpeg_finish_compress(&jpeg);
  jpeg_destroy_compress(&jpeg);
  return (file){bytes, size};
}

static fg_status read(fg_image **out, fg_context *context, const file *f, size_t size)
{
  /* in a block of its own length, so that a sanitizer sees what is read beyond it */
  unsigned char *bytes = malloc(size ? size : 1);
  assert_non_null(bytes);
  memcpy(bytes, f->bytes, size);
  fg__source source = {.path = "made.img", .bytes = bytes, .size = size};
  fg_status status = fg__image_read(out, context, &source);
  free(bytes);
  return status;
}

/* Reads it whole; no shorter part of it, nor an empty one, is taken for an image. `tail`
 * bytes at the end may be missing without harm. */
static fg_image *read_and_truncate(fg_context *context, const file *f, size_t tail)
{
  fg_image *image = NULL;
  for (size_t size = 0; size + tail < f->size; ++size) {
    fg_status status = read(&image, context, f, size);
    assert_true(status == FG_STATUS_FILE_FORMAT || status == FG_STATUS_UNSUPPORTED);
    assert_null(image);
    assert_non_null(strstr(fg_context_message(context), "made.img: "));
    assert_null(strchr(fg_context_message(context), '\n'));
    fg_context_clear(context);
  }
  assert_int_equal(read(&image, context, f, f->size), FG_STATUS_OK);
  free(f->bytes);
  return image;
}

static void assert_samples(fg_image *image, int channels, bool has_alpha)
{
  const fg_image_arrays *a = fg_image_contents(image);
  assert_int_equal(a->width, WIDTH);
  assert_int_equal(a->height, HEIGHT);
  assert_int_equal(a->channels, channels);
  assert_int_equal(a->alpha != NULL, has_alpha);
  for (int j = 0; j < HEIGHT; ++j)
    for (int i = 0; i < WIDTH; ++i) {
      size_t n = (size_t)(j * WIDTH + i);
      for (int k = 0; k < channels; ++k)
        assert_true(a->sample[n * (size_t)channels + (size_t)k] ==
                    (float)sample_at(i, j, k) / 255.0F);
      if (has_alpha)
        assert_true(a->alpha[n] == (float)sample_at(i, j, channels) / 255.0F);
    }
  fg_image_destroy(image);
}

static void png_images_of_every_kind_are_read(void **state)
{
  static const struct {
    int type, channels;
  } kinds[] = {{PNG_COLOR_TYPE_GRAY, 1},
               {PNG_COLOR_TYPE_GRAY_ALPHA, 2},
               {PNG_COLOR_TYPE_RGB, 3},
               {PNG_COLOR_TYPE_RGB_ALPHA, 4}};
  for (size_t n = 0; n < sizeof kinds / sizeof *kinds; ++n)
    for (int depth = 8; depth <= 16; depth += 8)
      for (int interlace = 0; interlace <= 1; ++interlace) {
        file f = png_of(kinds[n].type, kinds[n].channels, depth, interlace);
        fg_image *image = read_and_truncate(*state, &f, 0);
        assert_samples(image, kinds[n].channels > 2 ? 3 : 1, kinds[n].channels % 2 == 0);
      }
}

static void pnm_images_of_every_kind_are_read(void **state)
{
  for (int deep = 0; deep <= 1; ++deep)
    for (int kind = '2'; kind <= '6'; ++kind) {
      if (kind == '4')
        continue;
      int channels = kind % 3 == 0 ? 3 : 1; /* '3' and '6' are 51 and 54 */
      file f = pnm_of((char)kind, channels, deep ? 65535 : 255);
      /* of text, the last number may lose digits */
      fg_image *image = read_and_truncate(*state, &f, kind < '5' ? 6 : 0);
      assert_samples(image, channels, false);
    }
}

/* Even blocks of 8 x 8 pixels, at full quality: within rounding of the colours. */
static void jpeg_images_are_read(void **state)
{
  for (int progressive = 0; progressive <= 1; ++progressive) {
    file f = jpeg_of(1, progressive);
    fg_image *image = read_and_truncate(*state, &f, 2); /* without the mark of its end */
    const fg_image_arrays *a = fg_image_contents(image);
    assert_int_equal(a->channels, 1);
    for (int j = 0; j < a->height; ++j)
      for (int i = 0; i < a->width; ++i)
        assert_true(fabs((double)a->sample[j * a->width + i] * 255.0 -
                         sample_at(i / 8, j / 8, 0)) <= 2.0);
    fg_image_destroy(image);
    f = jpeg_of(3, progressive);
    assert_int_equal(read(&image, *state, &f, f.size), FG_STATUS_OK);
    assert_int_equal(fg_image_contents(image)->channels, 3);
    fg_image_destroy(image);
    free(f.bytes);
  }
}

/* One for each frequency of each component. */
static void use_many_scans(struct jpeg_compress_struct *jpeg, jpeg_scan_info scans[])
{
  jpeg->num_scans = 1;
  scans[0] = (jpeg_scan_info){.comps_in_scan = 3, .component_index = {0, 1, 2}};
  for (int k = 0; k < 3; ++k)
    for (int n = 1; n < 64; ++n)
      scans[jpeg->num_scans++] =
          (jpeg_scan_info){.comps_in_scan = 1, .component_index = {k}, .Ss = n, .Se = n};
  jpeg->scan_info = scans;
}

static file jpeg_of_many_scans(void)
{
  struct jpeg_compress_struct jpeg;
  struct jpeg_error_mgr errors;
  jpeg_scan_info scans[1 + 3 * 63];
  unsigned char *bytes = NULL, line[16 * 3], *row = line;
  unsigned long size = 0;
  jpeg.err = jpeg_std_error(&errors);
  jpeg_create_compress(&jpeg);
  jpeg_mem_dest(&jpeg, &bytes, &size);
  jpeg.image_width = jpeg.image_height = 16;
  jpeg.input_components = 3;
  jpeg.in_color_space = JCS_RGB;
  jpeg_set_defaults(&jpeg);
  use_many_scans(&jpeg, scans);
  jpeg_start_compress(&jpeg, TRUE);
  for (int j = 0; j < 16; ++j) {
    for (int i = 0; i < 16 * 3; ++i)
      line[i] = (unsigned char)(i * (j + 3) % 251);
    jpeg_write_scanlines(&jpeg, &row, 1);
  }
  jpeg_finish_compress(&jpeg);
  jpeg_destroy_compress(&jpeg);
  return (file){bytes, size};
}

static void a_jpeg_of_many_scans_is_refused(void **state)
{
  file f = jpeg_of_many_scans();
  fg_image *image = NULL;
  assert_int_equal(read(&image, *state, &f, f.size), FG_STATUS_UNSUPPORTED);
  assert_null(image);
  assert_non_null(strstr(fg_context_message(*state), "more than 100 scans"));
  free(f.bytes);
}

static void reading_a_jpeg_can_be_stopped(void **state)
{
  for (int progressive = 0; progressive <= 1; ++progressive) {
    file f = jpeg_of(3, progressive);
    fg_image *image = NULL;
    fg_context_stop(*state);
    assert_int_equal(read(&image, *state, &f, f.size), FG_STATUS_STOPPED);
    assert_null(image);
    free(f.bytes);
  }
}

static void refused(fg_context *context, const char *text, const char *part_of_message)
{
  file f = {0};
  fg_image *image = NULL;
  append(&f, text, strlen(text));
  assert_int_not_equal(read(&image, context, &f, f.size), FG_STATUS_OK);
  assert_null(image);
  assert_non_null(strstr(fg_context_message(context), part_of_message));
  fg_context_clear(context);
  free(f.bytes);
}

static void what_is_no_image_is_refused(void **state)
{
  refused(*state, "GIF89a....", "is no image");
  refused(*state, "P5 4 4 70000\n................", "70000");
  refused(*state, "P5 4 4 0\n................", "largest sample is 0");
  refused(*state, "P2 2 2 9\n1 2 3 10", "a sample is 10, beyond 9");
  refused(*state, "P2 2 2 9\n1 2 x 4", "sample 3 of 4 is no number");
  refused(*state, "P5 1 9 255\n.........", "1 x 9 pixels");
  refused(*state, "P5 99999999 99999999 255\n.", "99999999 x 99999999 pixels");
  refused(*state, "P5 9999 5000 255\n.", "ends after 1 of 49995000 samples");
}

/* A byte changed anywhere in compressed data is found, or does no harm. */
static void damage_does_no_harm(void **state)
{
  file f = png_of(PNG_COLOR_TYPE_RGB, 3, 8, 0);
  for (size_t n = 33; n < f.size; ++n) { /* behind the header */
    fg_image *image = NULL;
    f.bytes[n] ^= 0x15;
    read(&image, *state, &f, f.size);
    fg_image_destroy(image);
    fg_context_clear(*state);
    f.bytes[n] ^= 0x15;
  }
  free(f.bytes);
}

int main(void)
{
#define CASE(name)                                                                       \
  cmocka_unit_test_setup_teardown(name, context_set_up, context_tear_down)
  const struct CMUnitTest tests[] = {
      CASE(png_images_of_every_kind_are_read),
      CASE(pnm_images_of_every_kind_are_read),
      CASE(jpeg_images_are_read),
      CASE(a_jpeg_of_many_scans_is_refused),
      CASE(reading_a_jpeg_can_be_stopped),
      CASE(what_is_no_image_is_refused),
      CASE(damage_does_no_harm),
  };
  return cmocka_run_group_tests_name("read/image/image", tests, NULL, NULL);
}
