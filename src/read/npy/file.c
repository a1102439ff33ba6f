#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "read/npy/npy.h"

enum { HEADER = 1 << 16 };

bool fg__is_npz(const unsigned char *bytes, size_t size)
{
  /* the first entry's name is an array's */
  if (size < 30 || memcmp(bytes, "PK\003\004", 4) != 0)
    return false;
  const size_t name = (size_t)bytes[26] | (size_t)bytes[27] << 8;
  return name > 4 && name <= size - 30 && memcmp(bytes + 30 + name - 4, ".npy", 4) == 0;
}

static fg_status open_archive(fg__npy_file *file, const fg__source *source)
{
  fg_status status = fg__zip_list(&file->zip, file->context, source);
  unsigned char *header = fg__allocate(HEADER, 1);
  if (status == FG_STATUS_OK && !header)
    status = fg__fail_memory(file->context, "a header", HEADER);
  for (size_t i = 0; status == FG_STATUS_OK && i < file->zip.count; ++i) {
    const fg__zip_entry *entry = &file->zip.entry[i];
    fg__npy_array *array = &file->array[i];
    size_t got = 0, length;
    memcpy(array->name, entry->name, sizeof array->name);
    array->entry = i;
    status = fg__zip_extract(header, HEADER, &got, file->context, file->path, entry);
    if (status == FG_STATUS_OK)
      status = fg__npy_header(array, &length, file->context, file->path, header, got,
                              entry->size);
    if (status == FG_STATUS_UNSUPPORTED) { /* texts and records beside the numbers */
      fg_context_clear(file->context);
      *array = (fg__npy_array){0};
      status = FG_STATUS_OK;
    } else if (status == FG_STATUS_OK && !entry->deflated) {
      array->data = entry->bytes + length;
    }
    file->count = i + 1;
  }
  free(header);
  return status;
}

fg_status fg__npy_open(fg__npy_file **out, fg_context *context, const fg__source *source)
{
  size_t header;
  fg__npy_file *file = *out = fg__allocate(1, sizeof *file);
  if (!file)
    return fg__fail_memory(context, "a list of arrays", sizeof *file);
  file->context = context;
  file->path = source->path;
  if (fg__is_npz(source->bytes, source->size))
    return open_archive(file, source);
  file->count = 1;
  strcpy(file->array[0].name, "array");
  fg_status status = fg__npy_header(&file->array[0], &header, context, source->path,
                                    source->bytes, source->size, source->size);
  if (status == FG_STATUS_OK)
    file->array[0].data = source->bytes + header;
  return status;
}

void fg__npy_close(fg__npy_file *file)
{
  for (size_t i = 0; file && i < file->count; ++i)
    free(file->array[i].owned);
  free(file);
}

fg_status fg__npy_load(fg__npy_file *file, fg__npy_array *array)
{
  if (array->data)
    return FG_STATUS_OK;
  const fg__zip_entry *entry = &file->zip.entry[array->entry];
  size_t got, header;
  array->owned = fg__allocate(entry->size, 1);
  if (!array->owned)
    return fg__fail_memory(file->context, "an array", entry->size);
  fg_status status =
      fg__zip_extract(array->owned, entry->size, &got, file->context, file->path, entry);
  fg__npy_array again = {.name = ""};
  if (status == FG_STATUS_OK)
    status = fg__npy_header(&again, &header, file->context, file->path, array->owned, got,
                            entry->size);
  if (status == FG_STATUS_OK)
    array->data = array->owned + header;
  return status;
}

/* Moves the bytes of number `index` to *out, in this machine's order. */
static void take_bytes(void *out, const fg__npy_array *array, size_t index)
{
  unsigned char *to = out;
  const unsigned char *from = array->data + index * array->item;
  if (!array->swapped) {
    memcpy(to, from, array->item);
    return;
  }
  for (size_t i = 0; i < array->item; ++i)
    to[i] = from[array->item - 1 - i];
}

/* IEEE 754's binary16: a sign, 5 bits of exponent, 10 of the fraction. */
static double half_value(uint16_t bits)
{
  const int exponent = bits >> 10 & 31, fraction = bits & 1023;
  const double size = exponent == 31  ? fraction ? (double)NAN : HUGE_VAL
                      : exponent == 0 ? ldexp(fraction, -24)
                                      : ldexp(1024 + fraction, exponent - 25);
  return bits >> 15 ? -size : size;
}

static double take_float(const fg__npy_array *array, size_t index)
{
  uint16_t half = 0;
  float number = 0.0f;
  double precise = 0.0;
  if (array->item == sizeof half) {
    take_bytes(&half, array, index);
    return half_value(half);
  }
  if (array->item == sizeof number) {
    take_bytes(&number, array, index);
    return (double)number;
  }
  take_bytes(&precise, array, index);
  return precise;
}

double fg__npy_value(const fg__npy_array *array, size_t index)
{
  union {
    int8_t i1;
    int16_t i2;
    int32_t i4;
    int64_t i8;
    uint8_t u1;
    uint16_t u2;
    uint32_t u4;
    uint64_t u8;
  } n = {.u8 = 0};
  if (array->kind == FG__NPY_FLOAT || array->kind == FG__NPY_COMPLEX)
    return take_float(array, index);
  take_bytes(&n, array, index);
  const bool is_signed = array->kind == FG__NPY_SIGNED;
  switch (array->item) {
  case 1:
    return is_signed ? n.i1 : n.u1;
  case 2:
    return is_signed ? n.i2 : n.u2;
  case 4:
    return is_signed ? (double)n.i4 : (double)n.u4;
  default:
    return is_signed ? (double)n.i8 : (double)n.u8;
  }
}
