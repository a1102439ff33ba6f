/* A title for fields whose file has none, or but a name that tells nothing. */
#include "read/title.h"
#include "base/utf8.h"
#include "field/field.h"
#include "terms/text.h"

#include <ctype.h>
#include <stdio.h>
#include <string.h>

static const char PARTING[] = "_-. ";
enum { STEM_BYTES = 256, LONGEST_ENDING = 8, LEAST_LETTERS = 3 };

/* u, V, uvw, xy: letters of components. */
static bool is_letters(const char *title)
{
  return title[strspn(title, "uvwxyzUVWXYZ")] == '\0';
}

static bool is_generic(const char *title)
{
  return fg__is_one_of("vector|vectors|vec|field|data|unknown|untitled|none", title,
                       strlen(title));
}

/* Names of the components, with commas between. */
static bool is_names(const char *title, const fg_field_arrays *field)
{
  for (int k = 0; k < field->dimension; ++k) {
    const size_t length = strlen(field->velocity_name[k]);
    if (strncmp(title, field->velocity_name[k], length) != 0)
      return false;
    title += length;
    title += strspn(title, ", ");
  }
  return *title == '\0';
}

bool fg__title_tells(const char *title, const fg_field_arrays *field)
{
  return strlen(title) >= LEAST_LETTERS && !is_letters(title) && !is_generic(title) &&
         !is_names(title, field);
}

/* The name of a file without folders and ending: "cavity_t2.5" has none. */
static void copy_stem(char out[STEM_BYTES], const char *path)
{
  const char *slash = strrchr(path, '/');
  const char *name = slash ? slash + 1 : path;
  fg__utf8_take(out, STEM_BYTES, name, strlen(name));
  char *dot = strrchr(out, '.');
  if (dot && dot != out && isalpha((unsigned char)dot[1]) &&
      strlen(dot) <= LONGEST_ENDING)
    *dot = '\0';
}

/* Leaves out the one letter in which the files of two components differ, and what parts
 * it from the rest: Ustorm and Vstorm are "storm", as storm_u and storm_v. */
static void cut_component(char stem[STEM_BYTES], const char *other)
{
  size_t n = 0;
  while (stem[n] && stem[n] == other[n])
    ++n;
  if (!isascii(stem[n]) || !stem[n] || !other[n] ||
      strcmp(stem + n + 1, other + n + 1) != 0 || strlen(stem) <= LEAST_LETTERS)
    return;
  size_t end = n + 1;
  end += n == 0 ? strspn(stem + end, PARTING) : 0;
  while (!stem[end] && n > 0 && strchr(PARTING, stem[n - 1]))
    --n;
  memmove(stem + n, stem + end, strlen(stem + end) + 1);
}

fg_status fg__title_from_file(fg_field *field, fg_context *context,
                              const fg__source *source, const fg_read_options *options)
{
  char stem[STEM_BYTES], other[STEM_BYTES];
  const fg_field_arrays *about = fg_field_contents(field);
  if (fg__title_tells(about->title, about) || !source->on_disk)
    return FG_STATUS_OK;
  copy_stem(stem, source->path);
  if (options->vars_from) {
    copy_stem(other, options->vars_from);
    cut_component(stem, other);
  }
  return stem[0] ? fg__field_set_title(field, context, stem) : FG_STATUS_OK;
}
