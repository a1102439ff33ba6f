/* The values of a field, unpacked by ecCodes and put in the order of the axes. */
#include "base/memory.h"
#include "decode/grib/grib.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Stands for a missing value while ecCodes has them; no velocity is as large. */
static const double MISSING = 1e36;

typedef struct unpacking {
  double *value;
  size_t count;
  size_t found; /* how many there are */
  int error;
} unpacking;

static void unpack(codes_handle *handle, void *data)
{
  unpacking *u = data;
  u->error =
      handle ? codes_set_double(handle, "missingValue", MISSING) : CODES_INVALID_MESSAGE;
  if (u->error == CODES_SUCCESS)
    u->error = codes_get_size(handle, "values", &u->found);
  if (u->error != CODES_SUCCESS || u->found != u->count)
    return;
  u->error = codes_get_double_array(handle, "values", u->value, &u->found);
}

static size_t count_bits(const unsigned char *bytes, size_t bits)
{
  size_t count = 0;
  for (size_t i = 0; i < bits; ++i)
    count += bytes[i / 8] >> (7 - i % 8) & 1;
  return count;
}

/* Checks what the sections of values say of their sizes, which ecCodes does not. */
static const char *check_second_edition(const fg__grib_field *field, size_t points)
{
  size_t size, bitmap_size, data_size;
  const unsigned char *packing = fg__grib_section(field, 5, &size),
                      *bitmap = fg__grib_section(field, 6, &bitmap_size);
  const unsigned char *data = fg__grib_section(field, 7, &data_size);
  if (!packing || !bitmap || !data)
    return "it has no packed values";
  const uint64_t count = fg__grib_number(packing + 5, 4);
  const uint64_t template = fg__grib_number(packing + 9, 2);
  size_t expected = points;
  if (bitmap[5] == 0 || bitmap[5] == 254) {
    if (bitmap_size - 6 < points / 8 + (points % 8 > 0))
      return "its bitmap is shorter than its grid";
    expected = count_bits(bitmap + 6, points);
  } else if (bitmap[5] != 255) {
    return "its bitmap is one of a catalogue";
  }
  if (count != expected)
    return "it has another number of values than points";
  if (template == 0 && (size < 21 || packing[19] > 64 ||
                        (data_size - 5) * 8 < count * (uint64_t)packing[19]))
    return "its values are cut off";
  if (template == 4 && (size < 12 || (data_size - 5) / 4 < count))
    return "its values are cut off";
  if (template == 40 && size >= 21 && packing[19] > 0 && count > 0 &&
      !fg__grib_jpeg_has(data + 5, data_size - 5, count))
    return "its values are an image that is damaged, or of another size";
  if (template == 42 && count > 0 && !fg__grib_ccsds_is_sound(packing, size))
    return "the parameters of its CCSDS packing are out of range";
  if ((template == 2 || template == 3) && count > 0 &&
      !fg__grib_groups_fit(packing, size, data + 5, data_size - 5, count))
    return "its groups of values are not those of its grid, or cut off";
  return NULL;
}

static const char *check_first_edition(const fg__grib_field *field, size_t points)
{
  size_t size, bitmap_size;
  const unsigned char *data = fg__grib_section(field, 4, &size),
                      *bitmap = fg__grib_section(field, 3, &bitmap_size);
  size_t expected = points;
  if (bitmap && fg__grib_number(bitmap + 4, 2) != 0)
    return "its bitmap is one of a catalogue";
  if (bitmap && bitmap_size - 6 < points / 8 + (points % 8 > 0))
    return "its bitmap is shorter than its grid";
  if (bitmap)
    expected = count_bits(bitmap + 6, points);
  if (data[3] & 128)
    return "its values are coefficients of spherical harmonics";
  if (!(data[3] & 64) && (data[10] > 64 || (size - 11) * 8 < expected * (size_t)data[10]))
    return "its values are cut off";
  return NULL;
}

/* Where value n of the message stands among the axes' values. */
static size_t place_of(const fg__grib_grid *grid, size_t n)
{
  const size_t columns = grid->size[0], rows = grid->size[1];
  const size_t run = grid->along_y ? rows : columns;
  size_t slow = n / run, fast = n % run;
  if (grid->alternates && slow % 2 == 1)
    fast = run - 1 - fast;
  size_t i = grid->along_y ? slow : fast, j = grid->along_y ? fast : slow;
  if (grid->x_descends)
    i = columns - 1 - i;
  if (grid->y_descends)
    j = rows - 1 - j;
  return j * columns + i;
}

static fg_status fail(const fg__grib_file *file, const fg__grib_field *field,
                      const char *reason)
{
  return fg__fail(file->context, FG_STATUS_FILE_FORMAT, "%s: message %zu: %s", file->path,
                  field->number, reason);
}

static fg_status unpack_all(double *value, const fg__grib_file *file,
                            const fg__grib_field *field, const fg__grib_grid *grid)
{
  unpacking u = {.value = value, .count = grid->points};
  const fg_status status = fg__grib_guard(file, field, unpack, &u);
  if (status != FG_STATUS_OK)
    return status;
  if (u.error)
    return fail(file, field, codes_get_error_message(u.error));
  if (u.found != u.count)
    return fg__fail(file->context, FG_STATUS_FILE_FORMAT,
                    "%s: message %zu has %zu values, its grid %zu points", file->path,
                    field->number, u.found, u.count);
  return FG_STATUS_OK;
}

fg_status fg__grib_values(double *out, const fg__grib_file *file,
                          const fg__grib_field *field, const fg__grib_grid *grid)
{
  const char *fault = field->edition == 1 ? check_first_edition(field, grid->points)
                                          : check_second_edition(field, grid->points);
  if (fault)
    return fail(file, field, fault);
  double *value = fg__allocate(grid->points, sizeof *value);
  if (!value)
    return fg__fail_memory(file->context, "values", grid->points * sizeof *value);
  fg_status status = unpack_all(value, file, field, grid);
  for (size_t n = 0; n < grid->points && status == FG_STATUS_OK; ++n) {
    const bool missing = value[n] == MISSING || isnan(value[n]);
    out[grid->layout == FG__GRIB_REDUCED ? n : place_of(grid, n)] =
        missing ? (double)NAN : value[n];
  }
  free(value);
  return status;
}
