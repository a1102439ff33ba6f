/* Lists of files in the markup of files, and what is chosen of them. */
#include "decode/composite/names.h"

#include "base/memory.h"
#include "base/names.h"
#include "base/weighted.h"
#include "file/number_text.h"

#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_DEPTH = 64 };

void fg__vtk_names_clear(fg__vtk_names *list)
{
  for (size_t i = 0; i < list->count; ++i) {
    free(list->entry[i].file);
    free(list->entry[i].block);
  }
  free(list->entry);
  *list = (fg__vtk_names){0};
}

/* Takes `file` over. */
fg_status fg__vtk_names_add(fg__vtk_names *list, fg__vtk *vtk, char *file,
                            const char *block, double time)
{
  void *entries = list->entry;
  char *copy = fg__copy_text(block);
  const bool grown =
      copy && fg__grow(&entries, &list->capacity, list->count + 1, sizeof *list->entry);
  list->entry = entries;
  if (grown) {
    list->entry[list->count++] = (fg__vtk_name){file, copy, time};
    return FG_STATUS_OK;
  }
  free(file);
  free(copy);
  return fg__fail_memory(vtk->context, "a file's name", 0);
}

/* A list of pieces: elements Piece with a Source. */
fg_status fg__vtk_names_of_pieces(fg__vtk_names *out, fg__vtk *vtk, const xmlNode *grid)
{
  fg_status status = FG_STATUS_OK;
  for (const xmlNode *node = grid->children; node && status == FG_STATUS_OK;
       node = node->next) {
    char *file =
        fg__vtk_is_element(node, "Piece") ? fg__vtk_attribute(vtk, node, "Source") : NULL;
    if (file)
      status = fg__vtk_names_add(out, vtk, file, "", 0.0);
  }
  return status;
}

/* DataSet elements of a collection, each with a time. */
fg_status fg__vtk_names_of_times(fg__vtk_names *out, fg__vtk *vtk,
                                 const xmlNode *collection)
{
  fg_status status = FG_STATUS_OK;
  for (const xmlNode *node = collection->children; node && status == FG_STATUS_OK;
       node = node->next) {
    if (!fg__vtk_is_element(node, "DataSet"))
      continue;
    double time = 0.0;
    char *words = fg__vtk_attribute(vtk, node, "timestep");
    const bool good = !words || fg__number_read_list(&time, 1, words);
    free(words);
    if (!good)
      return fg__vtk_bad_attribute(vtk, node, "timestep");
    char *file = fg__vtk_attribute(vtk, node, "file");
    char *group = fg__vtk_attribute(vtk, node, "group");
    if (file)
      status = fg__vtk_names_add(out, vtk, file, group ? group : "", time);
    free(group);
  }
  return status;
}

/* The name of an element below the blocks `above`. */
static char *name_block(fg__vtk *vtk, const xmlNode *node, const char *above)
{
  char *own = fg__vtk_attribute(vtk, node, "name");
  const char *name = own ? own : "";
  const size_t size = strlen(above) + strlen(name) + 2;
  char *out = fg__allocate(size, 1);
  if (out)
    snprintf(out, size, "%s%s%s", above, *above && *name ? "/" : "", name);
  else
    fg__fail_memory(vtk->context, "a block's name", size);
  free(own);
  return out;
}

static fg_status list_blocks(fg__vtk_names *out, fg__vtk *vtk, const xmlNode *parent,
                             const char *above, int depth)
{
  fg_status status = FG_STATUS_OK;
  if (depth > MOST_DEPTH)
    return fg__fail(vtk->context, FG_STATUS_UNSUPPORTED,
                    "%s: blocks in blocks, more than %d deep", vtk->path, MOST_DEPTH);
  for (const xmlNode *node = parent->children; node && status == FG_STATUS_OK;
       node = node->next) {
    const bool leaf = fg__vtk_is_element(node, "DataSet");
    if (node->type != XML_ELEMENT_NODE)
      continue;
    char *name = name_block(vtk, node, above);
    if (!name)
      return FG_STATUS_MEMORY;
    char *file = leaf ? fg__vtk_attribute(vtk, node, "file") : NULL;
    if (file)
      status = fg__vtk_names_add(out, vtk, file, name, 0.0);
    else if (!leaf)
      status = list_blocks(out, vtk, node, name, depth + 1);
    free(name);
  }
  return status;
}

fg_status fg__vtk_names_of_blocks(fg__vtk_names *out, fg__vtk *vtk, const xmlNode *blocks)
{
  return list_blocks(out, vtk, blocks, "", 0);
}

/* Moves an entry to the end of those kept so far, or drops it. */
static void keep_or_drop(fg__vtk_names *list, size_t *kept, size_t i, bool kept_too)
{
  const fg__vtk_name entry = list->entry[i];
  if (kept_too) {
    list->entry[(*kept)++] = entry;
    return;
  }
  free(entry.file);
  free(entry.block);
}

fg_status fg__vtk_names_choose_time(fg__dataset *data, fg__vtk_names *list,
                                    const char *path, int wanted)
{
  double *time = fg__allocate(list->count, sizeof *time);
  if (!time)
    return fg__fail_memory(data->context, "times", list->count * sizeof *time);
  for (size_t i = 0; i < list->count; ++i)
    time[i] = list->entry[i].time;
  qsort(time, list->count, sizeof *time, fg__by_size);
  size_t times = 0, kept = 0;
  for (size_t i = 0; i < list->count; ++i)
    if (times == 0 || time[i] > time[times - 1])
      time[times++] = time[i];
  const fg_status status = fg__dataset_choose_time(data, path, time, times, wanted);
  if (status != FG_STATUS_OK || times == 0)
    return status;
  for (size_t i = 0; i < list->count; ++i)
    keep_or_drop(list, &kept, i,
                 list->entry[i].time <= time[wanted] &&
                     list->entry[i].time >= time[wanted]);
  list->count = kept;
  return FG_STATUS_OK;
}

/* Whether `wanted` selects a block: by its own name, its path, or the name of a block
 * that contains it. */
static bool is_in(const char *block, const char *wanted)
{
  const size_t length = strlen(wanted);
  for (const char *at = strstr(block, wanted); at; at = strstr(at + 1, wanted))
    if ((at == block || at[-1] == '/') && (at[length] == '/' || at[length] == '\0'))
      return true;
  return false;
}

fg_status fg__vtk_names_choose_block(fg__vtk_names *list, fg_context *context,
                                     const char *path, const char *wanted)
{
  fg__names names = {0};
  if (!wanted)
    return FG_STATUS_OK;
  for (size_t i = 0; i < list->count; ++i)
    fg__names_add(&names, ", ", "%s", list->entry[i].block);
  size_t kept = 0;
  for (size_t i = 0; i < list->count; ++i)
    keep_or_drop(list, &kept, i, *wanted && is_in(list->entry[i].block, wanted));
  list->count = kept;
  if (list->count > 0)
    return FG_STATUS_OK;
  fg__fail(context, FG_STATUS_ARGUMENT, "%s: there is no block \"%.100s\"", path, wanted);
  fg__hint(context, "the blocks are: %s", names.text);
  return FG_STATUS_ARGUMENT;
}

/* In the folder of the file that names it, or below: by its words alone. */
static bool is_within(const char *name)
{
  int depth = 0;
  if (!*name || *name == '/')
    return false;
  while (*name) {
    const size_t length = strcspn(name, "/");
    if (length == 2 && strncmp(name, "..", 2) == 0)
      --depth;
    else if (length > 0 && !(length == 1 && *name == '.'))
      ++depth;
    if (depth < 0)
      return false;
    name += length + (name[length] == '/');
  }
  return depth > 0;
}

/* The same once links have been followed. A file that cannot be found is left to the
 * opening of it. */
static bool is_linked_within(char *path, size_t folder)
{
  char file[PATH_MAX], above[PATH_MAX];
  if (!realpath(path, file))
    return true;
  const char kept = path[folder];
  path[folder] = '\0';
  const bool found = realpath(folder > 0 ? path : ".", above) != NULL;
  path[folder] = kept;
  size_t length = found ? strlen(above) : 0;
  length -= length == 1; /* the root's own name ends with a slash */
  return found && strncmp(file, above, length) == 0 && file[length] == '/';
}

fg_status fg__vtk_names_path(char **out, fg_context *context, const char *path,
                             const char *name)
{
  const char *slash = strrchr(path, '/');
  const size_t folder = slash ? (size_t)(slash - path) + 1 : 0;
  *out = fg__allocate(folder + strlen(name) + 1, 1);
  if (!*out)
    return fg__fail_memory(context, "a file's name", folder + strlen(name));
  memcpy(*out, path, folder);
  memcpy(*out + folder, name, strlen(name) + 1);
  if (is_within(name) && is_linked_within(*out, folder))
    return FG_STATUS_OK;
  fg__fail(context, FG_STATUS_UNSUPPORTED,
           is_within(name)
               ? "%s: names the file \"%.200s\", which links lead out of its folder"
               : "%s: names the file \"%.200s\", which is not in its folder or below",
           path, name);
  fg__hint(context, "put the files that it names beside it, and name them so");
  return FG_STATUS_UNSUPPORTED;
}
