/* What FieldData tells of a grid's axes, time and level, as fg_field_write has it. */
#include "decode/vtk/vtk.h"

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
  numbers.type = FG__TYPE_UINT8;
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
  if (!array || array->type != FG__TYPE_TEXTS)
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

/* Makes a text an attribute; without one of that name, or an empty one, there is none. */
static fg_status add_text(fg__variable *v, const char *name, const char *text)
{
  return text[0] ? fg__variable_add_text(v, name, text, strlen(text)) : FG_STATUS_OK;
}

/* Makes a number, of one component, an attribute. */
static fg_status add_number(fg__variable *v, const fg__vtk *vtk, const char *name,
                            const char *array_name)
{
  const fg__vtk_array *array = fg__vtk_find(vtk, 0, FG__VTK_FIELD, array_name);
  double number;
  if (!array || array->components != 1)
    return FG_STATUS_OK;
  const fg_status status = fg__vtk_read_numbers(&number, vtk, array, 1);
  if (status != FG_STATUS_OK)
    return status;
  if (strcmp(name, "AxisPeriod") == 0 && !(number >= 0.0 && isfinite(number)))
    return fg__fail(vtk->context, FG_STATUS_FILE_FORMAT, "%s: AxisPeriod is %g",
                    vtk->path, number);
  return fg__variable_add_numbers(v, name, &number, 1, true);
}

static fg_status add_words_of_axes(fg__dataset *data, const fg__vtk *vtk)
{
  static const char *const arrays[2][2] = {{"AxisNames", "long_name"},
                                           {"AxisUnits", "units"}};
  fg_status status = FG_STATUS_OK;
  for (int n = 0; n < 2 && status == FG_STATUS_OK; ++n) {
    char text[3][FG__VTK_TEXT] = {"", "", ""};
    status = read_texts(text, 3, vtk, arrays[n][0]);
    for (int k = 0; k < 3 && status == FG_STATUS_OK; ++k)
      status = add_text(&data->variables[data->space.axis[k]], arrays[n][1], text[k]);
  }
  return status;
}

fg_status fg__vtk_add_words(fg__dataset *data, const fg__vtk *vtk)
{
  static const char *const numbers[] = {"AxisPeriod", "LeastClusterArea"};
  static const char *const texts[] = {"Scale", "Projection", "TimeWords", "LevelWords"};
  const fg__vtk *first = vtk->file_count > 0 ? vtk->files[0].vtk : vtk;
  fg__variable *group = &data->groups[data->group_count - 1];
  const bool legacy = !first->document; /* VisIt's name for it there */
  fg_status status = add_number(group, first, "TimeValue", "TimeValue");
  if (status == FG_STATUS_OK && legacy && group->attributes == 0)
    status = add_number(group, first, "TimeValue", "TIME");
  if (!data->space.on_axes || vtk->file_count > 1)
    return status;
  for (int n = 0; n < 2 && status == FG_STATUS_OK; ++n)
    status = add_number(group, first, numbers[n], numbers[n]);
  for (int n = 0; n < 4 && status == FG_STATUS_OK; ++n) {
    char text[1][FG__VTK_TEXT] = {""};
    status = read_texts(text, 1, first, texts[n]);
    if (status == FG_STATUS_OK)
      status = add_text(group, texts[n], text[0]);
  }
  return status == FG_STATUS_OK ? add_words_of_axes(data, first) : status;
}
