#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <jpeglib.h>
#include <png.h>

#include "base/context_test.h"
#include "read/image/exif.h"
#include "read/image/image.h"

enum { SIZE = 2 + 4 + 2 + 2 * 12 + 4 + 6 };

static void put(unsigned char *to, unsigned value, int width, bool big_endian)
{
  for (int k = 0; k < width; ++k)
    to[big_endian ? width - 1 - k : k] = (unsigned char)(value >> 8 * k);
}

/* A camera's data: a directory behind a gap of four bytes, with the orientation in its
 * second entry. */
static void exif_of(unsigned char exif[SIZE], unsigned orientation, bool big_endian)
{
  memset(exif, 0, SIZE);
  exif[0] = exif[1] = big_endian ? 'M' : 'I';
  put(exif + 2, 42, 2, big_endian);
  put(exif + 4, 12, 4, big_endian);
  put(exif + 12, 2, 2, big_endian);
  put(exif + 14, 0x0100, 2, big_endian);
  put(exif + 26, 0x0112, 2, big_endian);
  put(exif + 28, 3, 2, big_endian);
  put(exif + 30, 1, 4, big_endian);
  put(exif + 34, orientation, 2, big_endian);
}

static int orientation_of(const unsigned char *exif, size_t size)
{
  /* in a block of its own length, so that a sanitizer sees what is read beyond it */
  unsigned char *bytes = malloc(size ? size : 1);
  assert_non_null(bytes);
  memcpy(bytes, exif, size);
  int orientation = fg__exif_orientation(bytes, size);
  free(bytes);
  return orientation;
}

static void orientations_are_found_in_both_orders_of_bytes(void **state)
{
  unsigned char exif[SIZE];
  (void)state;
  for (int big_endian = 0; big_endian <= 1; ++big_endian) {
    for (unsigned n = 1; n <= 8; ++n) {
      exif_of(exif, n, big_endian);
      assert_int_equal(orientation_of(exif, SIZE), n);
    }
    for (unsigned n = 9; n < 65536; n += 4091) {
      exif_of(exif, n, big_endian);
      assert_int_equal(orientation_of(exif, SIZE), 1);
    }
  }
}

static void damaged_data_are_upright(void **state)
{
  unsigned char exif[SIZE];
  (void)state;
  for (int big_endian = 0; big_endian <= 1; ++big_endian) {
    exif_of(exif, 6, big_endian);
    for (size_t size = 0; size < 38; ++size)
      assert_int_equal(orientation_of(exif, size), 1);
    for (size_t n = 0; n < SIZE; ++n)
      for (int change = 1; change < 256; change += 2) {
        exif[n] ^= (unsigned char)change;
        int found = orientation_of(exif, SIZE);
        assert_true(found >= 1 && found <= 8);
        exif[n] ^= (unsigned char)change;
      }
  }
}

enum { WIDTH = 24, HEIGHT = 16 }; /* of the upright image, even for JPEG's blocks */

/* Four patches of other lightness each, so that every turn and mirroring shows. */
static unsigned char patch(int i, int j)
{
  return (unsigned char)(30 + 60 * (i / 8) + (j / 8) * 40);
}

/* What a camera stores that was held so: the definition of each, by the standard's
 * picture of the letter F, in words "row 0 is ..., column 0 is ...". */
static unsigned char stored(int orientation, int x, int y)
{
  const int right = WIDTH - 1, bottom = HEIGHT - 1;
  switch (orientation) {
  case 2: /* top, right */
    return patch(right - x, y);
  case 3: /* bottom, right */
    return patch(right - x, bottom - y);
  case 4: /* bottom, left */
    return patch(x, bottom - y);
  case 5: /* left, top */
    return patch(y, x);
  case 6: /* right, top */
    return patch(right - y, x);
  case 7: /* right, bottom */
    return patch(right - y, bottom - x);
  case 8: /* left, bottom */
    return patch(y, bottom - x);
  default: /* top, left */
    return patch(x, y);
  }
}

typedef struct file {
  unsigned char *bytes;
  size_t size;
} file;

static file jpeg_of(int orientation, int width, int height)
{
  struct jpeg_compress_struct jpeg;
  struct jpeg_error_mgr errors;
  unsigned char *bytes = NULL, marker[6 + SIZE] = "Exif";
  unsigned long size = 0;
  jpeg.err = jpeg_std_error(&errors);
  jpeg_create_compress(&jpeg);
  jpeg_mem_dest(&jpeg, &bytes, &size);
  jpeg.image_width = (JDIMENSION)width;
  jpeg.image_height = (JDIMENSION)height;
  jpeg.input_components = 1;
  jpeg.in_color_space = JCS_GRAYSCALE;
  jpeg_set_defaults(&jpeg);
  jpeg_set_quality(&jpeg, 100, TRUE);
  jpeg_start_compress(&jpeg, TRUE);
  exif_of(marker + 6, (unsigned)orientation, orientation % 2 == 0);
  jpeg_write_marker(&jpeg, JPEG_APP0 + 1, marker, sizeof marker);
  for (int y = 0; y < height; ++y) {
    unsigned char line[WIDTH], *row = line;
    for (int x = 0; x < width; ++x)
      line[x] = stored(orientation, x, y);
    jpeg_write_scanlines(&jpeg, &row, 1);
  }
  jpeg_finish_compress(&jpeg);
  jpeg_destroy_compress(&jpeg);
  return (file){bytes, size};
}

static void take(png_structp png, png_bytep bytes, size_t count)
{
  file *f = png_get_io_ptr(png);
  f->bytes = realloc(f->bytes, f->size + count);
  assert_non_null(f->bytes);
  memcpy(f->bytes + f->size, bytes, count);
  f->size += count;
}

static void flush(png_structp png)
{
  (void)png;
}

static file png_of(int orientation, int width, int height)
{
  file f = {0};
  unsigned char exif[SIZE], line[2 * WIDTH];
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, NULL, NULL, NULL);
  png_infop info = png_create_info_struct(png);
  png_set_write_fn(png, &f, take, flush);
  png_set_IHDR(png, info, (unsigned)width, (unsigned)height, 8, PNG_COLOR_TYPE_GRAY_ALPHA,
               PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  exif_of(exif, (unsigned)orientation, orientation % 2 == 1);
  png_set_eXIf_1(png, info, SIZE, exif);
  png_write_info(png, info);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      line[2 * x] = stored(orientation, x, y);
      line[2 * x + 1] = (unsigned char)(255 - line[2 * x]);
    }
    png_write_row(png, line);
  }
  png_write_end(png, info);
  png_destroy_write_struct(&png, &info);
  return f;
}

static void assert_upright(fg_context *context, const file *f, double tolerance)
{
  fg_image *image = NULL;
  fg__source source = {.path = "made.img", .bytes = f->bytes, .size = f->size};
  assert_int_equal(fg__image_read(&image, context, &source), FG_STATUS_OK);
  const fg_image_arrays *a = fg_image_contents(image);
  assert_int_equal(a->width, WIDTH);
  assert_int_equal(a->height, HEIGHT);
  for (int j = 0; j < HEIGHT; ++j)
    for (int i = 0; i < WIDTH; ++i) {
      double error = 255.0 * (double)a->sample[j * WIDTH + i] - patch(i, j);
      assert_true(error <= tolerance && error >= -tolerance);
      if (a->alpha)
        assert_true(a->alpha[j * WIDTH + i] == (float)(255 - patch(i, j)) / 255.0F);
    }
  fg_image_destroy(image);
  free(f->bytes);
}

static void images_are_upright_however_they_are_stored(void **state)
{
  for (int orientation = 1; orientation <= 8; ++orientation) {
    int width = orientation >= 5 ? HEIGHT : WIDTH;
    int height = orientation >= 5 ? WIDTH : HEIGHT;
    file f = jpeg_of(orientation, width, height);
    assert_upright(*state, &f, 2.0);
    f = png_of(orientation, width, height);
    assert_upright(*state, &f, 1e-4);
  }
}

int main(void)
{
#define CASE(name)                                                                       \
  cmocka_unit_test_setup_teardown(name, context_set_up, context_tear_down)
  const struct CMUnitTest tests[] = {
      CASE(orientations_are_found_in_both_orders_of_bytes),
      CASE(damaged_data_are_upright),
      CASE(images_are_upright_however_they_are_stored),
  };
  return cmocka_run_group_tests_name("read/image/exif", tests, NULL, NULL);
}
