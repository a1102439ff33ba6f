/* Planes as words. */
#include "base/context.h"
#include "file/number_text.h"

#include <ctype.h>
#include <stdlib.h>
#include <string.h>

enum { LONGEST = 400 };

static fg_status fail_words(fg_context *context, const char *text)
{
  fg_status status =
      fg__fail(context, FG_STATUS_ARGUMENT, "field: no plane: \"%.100s\"", text);
  fg__hint(context, "say NAME=VALUE, as z=0.5, or NX,NY,NZ@X,Y,Z: a normal and a point");
  return status;
}

static bool is_same(const char *name, const char *words, size_t length)
{
  if (strlen(name) != length)
    return false;
  for (size_t n = 0; n < length; ++n)
    if (tolower((unsigned char)name[n]) != tolower((unsigned char)words[n]))
      return false;
  return true;
}

/* The axis of a name, else of a letter; -1 for none. */
static int find_axis(const fg_field_arrays *a, const char *name, size_t length)
{
  static const char *const letters[] = {"x", "y", "z"};
  for (int k = 0; a && k < 3 && k < a->dimension; ++k)
    if (is_same(a->axis_name[k], name, length))
      return k;
  for (int k = 0; k < 3; ++k)
    if (is_same(letters[k], name, length))
      return k;
  return -1;
}

static fg_status parse_axis(fg_plane *out, fg_context *context, const char *text,
                            size_t length, const fg_field_arrays *a)
{
  double value;
  if (length == 0 || !fg__number_read_list(&value, 1, text + length + 1))
    return fail_words(context, text);
  const int axis = find_axis(a, text, length);
  if (axis < 0 && a) {
    fg__fail(context, FG_STATUS_ARGUMENT, "field: there is no axis \"%.*s\" to cut by",
             (int)(length < 100 ? length : 100), text);
    fg__hint(context, "the axes are: %s, %s, %s", a->axis_name[0], a->axis_name[1],
             a->axis_name[2]);
    return FG_STATUS_ARGUMENT;
  }
  out->normal[axis > 0 ? axis : 0] = 1.0;
  out->point[axis > 0 ? axis : 0] = value;
  return FG_STATUS_OK;
}

/* Three numbers parted by commas. */
static bool parse_triple(double out[3], const char *text, size_t length)
{
  char words[LONGEST];
  if (length >= sizeof words)
    return false;
  size_t commas = 0;
  for (size_t n = 0; n < length; ++n) {
    commas += text[n] == ',';
    words[n] = text[n] == ',' ? ' ' : text[n];
  }
  words[length] = '\0';
  return commas == 2 && fg__number_read_list(out, 3, words);
}

fg_status fg_plane_parse(fg_plane *out, fg_context *context, const char *text,
                         const fg_field *volume)
{
  if (!out || !text)
    return fg__fail(context, FG_STATUS_ARGUMENT, "field: no words of a plane");
  *out = (fg_plane){{0.0}, {0.0}};
  const fg_field_arrays *a = fg_field_contents(volume);
  if (a && a->dimension != 3)
    return fg__fail(context, FG_STATUS_ARGUMENT,
                    "field: a cut through a field in %d dimensions; it needs 3",
                    a->dimension);
  const char *equals = strrchr(text, '='), *at = strchr(text, '@');
  if (equals && !at)
    return parse_axis(out, context, text, (size_t)(equals - text), a);
  if (!at || !parse_triple(out->normal, text, (size_t)(at - text)) ||
      !parse_triple(out->point, at + 1, strlen(at + 1)) ||
      (out->normal[0] * out->normal[0] + out->normal[1] * out->normal[1] +
           out->normal[2] * out->normal[2] <=
       0.0))
    return fail_words(context, text);
  return FG_STATUS_OK;
}
