/* What FieldData tells of an image's axes, time and level. */
#include "read/vtk/vtk.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_TEXTS = 3, MOST_BYTES = MOST_TEXTS * FG__VTK_TEXT };

/* The bytes of texts that are written as numbers; false: they are none, or too many. */
static bool read_codes(char out[MOST_BYTES], size_t *bytes, const char *text)
{
  char *end = NULL;
  for (*bytes = 0; *bytes < MOST_BYTES; text = end) {
    const long code = strtol(text, &end, 10);
    if (end == text)
      return text[strspn(text, " \t\r\n")] == '\0';
    if (code < -128 || code > 255) /* of a char, signed or not */
      return false;
    out[(*bytes)++] = (char)code;
  }
  return false;
}

static fg_status read_bytes(char out[MOST_BYTES], size_t *bytes, bool *good,
                            const fg__vtk *vtk, const fg__vtk_array *array)
{
  fg__vtk_array numbers = *array;
  fg__vtk_values values = {0};
  numbers.type = FG__VTK_UINT8;
  numbers.components = 1;
  fg_status status = fg__vtk_values_count(bytes, vtk, &numbers);
  *good = status == FG_STATUS_OK && *bytes <= MOST_BYTES;
  if (!*good)
    return status;
  status = fg__vtk_values_create(&values, vtk, &numbers, *bytes);
  if (status == FG_STATUS_OK && *bytes > 0)
    memcpy(out, values.bytes, *bytes);
  fg__vtk_values_clear(&values);
  return status;
}

static bool is_printable(const char *text)
{
  for (; *text; ++text)
    if ((unsigned char)*text < ' ' || *text == 0x7f)
      return false;
  return true;
}

/* Reads up to `count` texts of a name; those that are not there stay "". */
static fg_status read_texts(char out[][FG__VTK_TEXT], int count, const fg__vtk *vtk,
                            const char *name)
{
  const fg__vtk_array *array = fg__vtk_find(vtk, 0, FG__VTK_FIELD, name);
  char raw[MOST_BYTES];
  size_t bytes = 0, at = 0;
  bool good = true;
  if (!array || array->type != FG__VTK_STRING)
    return FG_STATUS_OK;
  fg_status status = FG_STATUS_OK;
  if (array->storage == FG__VTK_ASCII)
    good = read_codes(raw, &bytes, array->text);
  else
    status = read_bytes(raw, &bytes, &good, vtk, array);
  for (int k = 0; k < count && at < bytes && good && status == FG_STATUS_OK; ++k) {
    const size_t length = strnlen(raw + at, bytes - at);
    good = length < FG__VTK_TEXT;
    memcpy(out[k], raw + at, good ? length : 0);
    good = good && is_printable(out[k]);
    at += length + 1;
  }
  return status == FG_STATUS_OK && !good
             ? fg__fail(vtk->context, FG_STATUS_FILE_FORMAT,
                        "%s: array \"%.100s\" holds no texts of up to %d bytes",
                        vtk->path, name, FG__VTK_TEXT - 1)
             : status;
}

static fg_status read_period(double *out, const fg__vtk *vtk)
{
  const fg__vtk_array *array = fg__vtk_find(vtk, 0, FG__VTK_FIELD, "AxisPeriod");
  fg__vtk_values values;
  if (!array || array->components != 1)
    return FG_STATUS_OK;
  fg_status status = fg__vtk_values_create(&values, vtk, array, 1);
  if (status != FG_STATUS_OK)
    return status;
  *out = fg__vtk_value(&values, 0);
  fg__vtk_values_clear(&values);
  return *out >= 0.0 && isfinite(*out)
             ? FG_STATUS_OK
             : fg__fail(vtk->context, FG_STATUS_FILE_FORMAT, "%s: AxisPeriod is %g",
                        vtk->path, *out);
}

fg_status fg__vtk_words_find(fg__vtk_words *out, const fg__vtk *vtk)
{
  const fg__vtk *file = vtk->file_count == 1 ? vtk->files[0].vtk : vtk;
  char scale[1][FG__VTK_TEXT] = {""};
  *out = (fg__vtk_words){.scale = FG_SCALE_AUTO};
  if (vtk->kind != FG__VTK_ALONG_AXES || vtk->cells.count > 0)
    return FG_STATUS_OK;
  struct {
    const char *name;
    char (*text)[FG__VTK_TEXT];
    int count;
  } const wanted[] = {{"Scale", scale, 1},
                      {"AxisNames", out->axis_name, 3},
                      {"AxisUnits", out->axis_units, 3},
                      {"Projection", &out->projection, 1},
                      {"TimeWords", &out->time, 1},
                      {"LevelWords", &out->level, 1}};
  fg_status status = read_period(&out->period, file);
  for (size_t i = 0; i < sizeof wanted / sizeof *wanted && status == FG_STATUS_OK; ++i)
    status = read_texts(wanted[i].text, wanted[i].count, file, wanted[i].name);
  out->scale = strcmp(scale[0], "geo") == 0   ? FG_SCALE_GEO
               : strcmp(scale[0], "map") == 0 ? FG_SCALE_MAP
                                              : FG_SCALE_AUTO;
  return status;
}
