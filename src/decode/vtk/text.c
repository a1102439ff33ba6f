/* The numbers of one array that are written as text. */
#include "decode/vtk/vtk.h"
#include "file/number_text.h"

#include <stdlib.h>
#include <string.h>

/* A number written out takes 309 figures at most (DBL_MAX), and may have some behind the
 * point; a longer word is no number. */
enum { LONGEST_NUMBER = 511 };

/* Keeps a number of text if it is wanted. */
static void keep(fg__vtk_values *out, size_t index, double number)
{
  if (index >= out->first && index - out->first < out->count)
    memcpy(out->bytes + (index - out->first) * sizeof number, &number, sizeof number);
}

static fg_status fail_found(const fg__vtk *vtk, const fg__vtk_array *array, size_t all,
                            size_t found, const char *text)
{
  return fg__fail(vtk->context, FG_STATUS_FILE_FORMAT,
                  "%s: array \"%.100s\": %zu numbers promised, %zu found, then \"%.20s\"",
                  vtk->path, array->name, all, found, text);
}

/* Ended by a NUL. */
static fg_status read_ascii(fg__vtk_values *out, const fg__vtk *vtk,
                            const fg__vtk_array *array, size_t all)
{
  fg__number_locale locale;
  if (!fg__number_locale_begin(&locale))
    return fg__fail_memory(vtk->context, "a locale", sizeof locale);
  const char *text = array->text;
  size_t found = 0;
  for (; found < all; ++found) {
    char *end = NULL;
    double number = strtod(text, &end);
    if (end == text)
      break;
    keep(out, found, number);
    text = end;
  }
  fg__number_locale_end(&locale);
  text += strspn(text, " \t\r\n");
  if (found < all)
    return fail_found(vtk, array, all, found, text);
  if (*text)
    return fg__fail(vtk->context, FG_STATUS_FILE_FORMAT,
                    "%s: array \"%.100s\": after its %zu numbers comes \"%.20s\"",
                    vtk->path, array->name, all, text);
  return FG_STATUS_OK;
}

static bool is_space(char c)
{
  return c == ' ' || (c >= '\t' && c <= '\r');
}

/* Ended by nothing: a word at a time. */
static fg_status read_tokens(fg__vtk_values *out, const fg__vtk *vtk,
                             const fg__vtk_array *array, size_t all)
{
  fg__number_locale locale;
  if (!fg__number_locale_begin(&locale))
    return fg__fail_memory(vtk->context, "a locale", sizeof locale);
  size_t at = 0, found = 0;
  char word[LONGEST_NUMBER + 1] = "";
  for (bool good = true; found < all && good; found += good) {
    size_t length = 0;
    while (at < array->text_size && is_space(array->text[at]))
      ++at;
    const size_t start = at;
    for (; at < array->text_size && !is_space(array->text[at]); ++at)
      if (length < LONGEST_NUMBER)
        word[length++] = array->text[at];
    word[length] = '\0';
    char *end = word;
    double number = strtod(word, &end);
    good = length > 0 && (size_t)(end - word) == at - start;
    if (good)
      keep(out, found, number);
  }
  fg__number_locale_end(&locale);
  return found < all ? fail_found(vtk, array, all, found, word) : FG_STATUS_OK;
}

fg_status fg__vtk_values_from_text(fg__vtk_values *out, const fg__vtk *vtk,
                                   const fg__vtk_array *array, size_t all)
{
  return (array->storage == FG__VTK_TOKENS ? read_tokens : read_ascii)(out, vtk, array,
                                                                       all);
}
