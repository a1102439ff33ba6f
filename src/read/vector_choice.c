#include "read/vector_choice.h"

#include "base/memory.h"
#include "sample/curvilinear/points.h"
#include "sample/missing.h"
#include "sample/unstructured/mesh.h"

#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

/* Whether two paths lead to one file. */
static bool is_one_file(const char *path, const char *other)
{
  struct stat a, b;
  return stat(path, &a) == 0 && stat(other, &b) == 0 && a.st_dev == b.st_dev &&
         a.st_ino == b.st_ino;
}

/* Whether a further file has the format of the first, or one with its decoder. */
static bool is_alike(const fg__format *format, const fg__source *source)
{
  const fg__format *own = fg__format_find(source->bytes, source->size);
  return format->is_mine(source->bytes, source->size) ||
         (own && own->open == format->open);
}

static fg_status add_file(fg__dataset *data, fg_context *context,
                          const fg__format *format, const char *path)
{
  fg__source source;
  for (int n = 0; n < data->files; ++n)
    if (is_one_file(path, data->file[n].path))
      return fg__fail(context, FG_STATUS_ARGUMENT, "%s: is given twice", path);
  fg_status status = fg__source_open(&source, context, path);
  if (status == FG_STATUS_OK && !is_alike(format, &source))
    status =
        fg__fail(context, FG_STATUS_FILE_FORMAT, "%s: is no %.*s file like the first one",
                 path, (int)strcspn(format->name, " "), format->name);
  if (status == FG_STATUS_OK)
    status = fg__dataset_open(data, context, format, &source, NULL);
  return fg__source_close(&source, context, status);
}

/* Whether positions of a curvilinear grid, its angle or its mask are in a file. */
static bool uses_file(const fg__curvilinear *mesh, int number)
{
  const fg__variable *all[] = {mesh->centre.variable, mesh->part[0].longitude,
                               mesh->part[1].longitude, mesh->angle[0], mesh->mask};
  for (size_t n = 0; n < sizeof all / sizeof *all; ++n)
    if (all[n] && all[n]->file == number)
      return true;
  return false;
}

/* A further file of which neither a component, the mesh nor the mask is used is refused
 * as the wrong one. */
static fg_status check_used(const fg__dataset *data, int number, const fg__pair *pair,
                            const fg__grid *grid, const char *mask)
{
  const fg__variable *masked = mask ? fg__dataset_find(data, mask) : NULL;
  const bool mesh = number >= data->component_files;
  bool used = (masked && masked->file == number) ||
              (mesh && data->file[number].was_read) ||
              (grid->mesh && uses_file(grid->mesh, number)) ||
              (grid->unstructured && fg__unstructured_file(grid->unstructured) == number);
  for (int k = 0; k < 2; ++k)
    used = used || pair->component[k]->file == number;
  used = used || (pair->component[2] && pair->component[2]->file == number);
  if (used)
    return FG_STATUS_OK;
  fg__fail(data->context, FG_STATUS_ARGUMENT,
           mesh ? "%s: gives no position: '%.200s' and '%.200s' lie on the grid of %s"
                : "%s: gives no component: '%.200s' and '%.200s' are both of %s",
           data->file[number].path, pair->component[0]->name, pair->component[1]->name,
           pair->component[0]->path);
  fg__hint(data->context,
           mesh ? "leave out --mesh-from"
                : "name one of its variables with --vars, or leave out --vars-from");
  return FG_STATUS_ARGUMENT;
}

static void close_choice(void *data)
{
  fg__vector_choice *c = data;
  c->data.context = NULL; /* that of an earlier question may be gone */
  fg__grid_clear(&c->grid);
  fg__dataset_end(&c->data, FG_STATUS_OK);
  free(c);
}

static fg_status choose(fg__vector_choice *c, fg_context *context,
                        const fg__format *format, const fg__source *source,
                        const fg_read_options *options)
{
  fg__dataset *data = &c->data;
  fg_status status = fg__dataset_open(data, context, format, source, options);
  if (status == FG_STATUS_OK)
    status = fg__missing_read(&data->missing, context, options->missing);
  if (status == FG_STATUS_OK && options->vars_from) {
    status = add_file(data, context, format, options->vars_from);
    data->component_files = 2;
  }
  if (status == FG_STATUS_OK && options->mesh_from)
    status = add_file(data, context, format, options->mesh_from);
  if (status == FG_STATUS_OK && options->at)
    status = fg__choose_samples(data, options->at);
  if (status == FG_STATUS_OK)
    status = fg__choose_vector(&c->pair, &c->grid, data, options);
  if (status == FG_STATUS_OK)
    status = fg__check_choices(data, &c->pair);
  for (int n = 1; n < data->files && status == FG_STATUS_OK; ++n)
    status = check_used(data, n, &c->pair, &c->grid, options->mask);
  memcpy(c->doubts, c->grid.doubts, sizeof c->doubts);
  return status;
}

/* Whether the choice holds for a question. Decoders that open but one time keep the
 * context. Where a table's rows have times and levels, each time has levels of its own.
 */
static bool holds(const fg__vector_choice *c, const fg_context *context,
                  const fg__format *format, int time)
{
  const fg__unstructured *mesh = c->grid.unstructured;
  const bool by_time =
      format->is_chosen || (mesh && mesh->rows_time.value && mesh->rows_level.variable);
  return (time == c->time || !by_time) &&
         (context == c->data.context || !format->is_chosen);
}

fg_status fg__vector_choice_enter(fg__vector_choice **out, fg_context *context,
                                  const fg__format *format, const fg__source *source,
                                  const fg_read_options *options)
{
  fg__kept *kept = source->kept;
  fg__vector_choice *c = kept ? kept->data : NULL;
  *out = NULL;
  if (c && !holds(c, context, format, options->time)) {
    close_choice(c);
    c = kept->data = NULL;
  }
  if (!c) {
    c = fg__allocate(1, sizeof *c);
    if (!c)
      return fg__fail_memory(context, "a choice", sizeof *c);
    const fg_status status = choose(c, context, format, source, options);
    if (status != FG_STATUS_OK) {
      close_choice(c);
      return status;
    }
    c->is_kept = kept != NULL;
    c->time = options->time;
    if (kept)
      *kept = (fg__kept){c, close_choice};
  }
  c->data.context = context;
  memcpy(c->grid.doubts, c->doubts, sizeof c->doubts);
  *out = c;
  return FG_STATUS_OK;
}

fg_status fg__vector_choice_leave(fg__vector_choice *c, fg_status status)
{
  if (c)
    status = fg__dataset_check(&c->data, status);
  if (c && !c->is_kept)
    close_choice(c);
  return status;
}
