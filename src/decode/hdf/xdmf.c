/* XDMF files: which grid is meant, at which time. Format: XDMF Model and Format, versions
 * 2 and 3. */
#include "decode/hdf/xdmf.h"

#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include <libxml/xpath.h>

#include "base/memory.h"
#include "base/names.h"
#include "file/number_text.h"

enum {
  MOST_STEPS = 1 << 20, /* of the search for what a path means */
  MOST_LINKS = 8,
  MOST_GRIDS = 1 << 16,
  TIMES_LARGER = 4096 /* numbers than bytes of the markup */
};

bool fg__xdmf_word(char out[FG__XDMF_WORD], fg__vtk *vtk, const xmlNode *node,
                   const char *name, const char *before, const char *otherwise)
{
  char *value = fg__vtk_attribute(vtk, node, name);
  if (!value && before)
    value = fg__vtk_attribute(vtk, node, before);
  const char *word = value ? value + strspn(value, " \t\r\n") : otherwise;
  snprintf(out, FG__XDMF_WORD, "%s", word);
  for (size_t length = strlen(out); length > 0 && strchr(" \t\r\n", out[length - 1]);)
    out[--length] = '\0';
  free(value);
  return word != otherwise;
}

int fg__xdmf_lengths(size_t *out, int capacity, fg__vtk *vtk, const xmlNode *node,
                     const char *name)
{
  char word[FG__XDMF_WORD];
  int count = 0;
  fg__xdmf_word(word, vtk, node, name, NULL, "");
  for (char *at = word, *end; *at; at = end + strspn(end, " \t\r\n")) {
    const unsigned long long number = strtoull(at, &end, 10);
    if (end == at || *at == '-' || count == capacity || number > SIZE_MAX)
      return 0;
    out[count++] = (size_t)number;
  }
  return count;
}

static void ignore_error(void *data, xmlErrorPtr error)
{
  (void)data;
  (void)error;
}

/* What a path leads to; end with xmlXPathFreeObject. NULL: it is none. */
static xmlXPathObject *find_path(fg__vtk *vtk, const char *path)
{
  xmlXPathContext *search = xmlXPathNewContext(vtk->document);
  if (!search)
    return NULL;
  search->opLimit = MOST_STEPS;
  search->error = ignore_error;
  xmlXPathObject *found = xmlXPathEval((const xmlChar *)path, search);
  xmlXPathFreeContext(search);
  if (found && found->type == XPATH_NODESET && found->nodesetval)
    return found;
  xmlXPathFreeObject(found);
  return NULL;
}

/* Element `number` of those that an include names; what is over is taken from *number. */
static const xmlNode *find_included(fg__vtk *vtk, const xmlNode *include,
                                    const char *name, int *number)
{
  static const char scheme[] = "xpointer(";
  const xmlNode *out = NULL;
  char *path = fg__vtk_attribute(vtk, include, "xpointer");
  char *end = path ? strrchr(path, ')') : NULL;
  if (end && strncmp(path, scheme, sizeof scheme - 1) == 0) {
    *end = '\0';
    xmlXPathObject *found = find_path(vtk, path + sizeof scheme - 1);
    for (int n = 0; found && !out && n < found->nodesetval->nodeNr; ++n)
      if (fg__vtk_is_element(found->nodesetval->nodeTab[n], name) && (*number)-- == 0)
        out = found->nodesetval->nodeTab[n];
    xmlXPathFreeObject(found);
  }
  free(path);
  return out;
}

/* What an element refers to: by its attribute Reference, or that is "XML", and the path
 * is what it holds. */
static fg_status follow(const xmlNode **node, fg__vtk *vtk)
{
  for (int links = 0; *node; ++links) {
    char *path = fg__vtk_attribute(vtk, *node, "Reference");
    if (!path)
      return FG_STATUS_OK;
    if (strcasecmp(path, "XML") == 0) {
      free(path);
      path = fg__vtk_copy_of(vtk, xmlNodeGetContent(*node));
    }
    xmlXPathObject *found = path && links < MOST_LINKS ? find_path(vtk, path) : NULL;
    free(path);
    const xmlNode *to =
        found && found->nodesetval->nodeNr > 0 ? found->nodesetval->nodeTab[0] : NULL;
    xmlXPathFreeObject(found);
    if (!to || to->type != XML_ELEMENT_NODE)
      return fg__fail(vtk->context, FG_STATUS_FILE_FORMAT,
                      "%s: line %ld: a %s that refers to nothing", vtk->path,
                      xmlGetLineNo(*node), (const char *)(*node)->name);
    *node = to;
  }
  return FG_STATUS_OK;
}

fg_status fg__xdmf_child(const xmlNode **out, fg__vtk *vtk, const xmlNode *parent,
                         const char *name, int number)
{
  *out = NULL;
  for (const xmlNode *node = parent->children; node && !*out; node = node->next)
    if (fg__vtk_is_element(node, name) && number-- == 0)
      *out = node;
    else if (fg__vtk_is_element(node, "include"))
      *out = find_included(vtk, node, name, &number);
  return follow(out, vtk);
}

static bool is_collection(fg__vtk *vtk, const xmlNode *grid, const char *kind)
{
  char type[FG__XDMF_WORD], collection[FG__XDMF_WORD];
  fg__xdmf_word(type, vtk, grid, "GridType", "Type", "Uniform");
  fg__xdmf_word(collection, vtk, grid, "CollectionType", NULL, "Spatial");
  if (strcasecmp(type, "Tree") == 0)
    return strcmp(kind, "Spatial") == 0;
  return strcasecmp(type, "Collection") == 0 && strcasecmp(collection, kind) == 0;
}

/* The times of a collection: each grid's own, or a list of all, or numbers from 0 on. */
static fg_status read_times(double *time, size_t count, fg__vtk *vtk,
                            const xmlNode *collection)
{
  const xmlNode *said = NULL, *item = NULL, *grid = NULL;
  double *number = NULL;
  size_t numbers = 0;
  char word[FG__XDMF_WORD] = "";
  fg_status status = fg__xdmf_child(&said, vtk, collection, "Time", 0);
  if (said) {
    fg__xdmf_word(word, vtk, said, "TimeType", "Type", "Single");
    status = fg__xdmf_child(&item, vtk, said, "DataItem", 0);
  }
  if (status == FG_STATUS_OK && item)
    status = fg__xdmf_create(&number, &numbers, vtk, item);
  const bool steps = strcasecmp(word, "HyperSlab") == 0;
  if (status == FG_STATUS_OK && item && numbers != (steps ? 3 : count))
    status = fg__fail(vtk->context, FG_STATUS_FILE_FORMAT,
                      "%s: line %ld: %zu numbers for %zu times", vtk->path,
                      xmlGetLineNo(said), numbers, count);
  for (size_t n = 0; n < count && status == FG_STATUS_OK; ++n) {
    time[n] = !item ? (double)n : steps ? number[0] + (double)n * number[1] : number[n];
    status = fg__xdmf_child(&grid, vtk, collection, "Grid", (int)n);
    if (status == FG_STATUS_OK)
      status = fg__xdmf_child(&said, vtk, grid, "Time", 0);
    if (status == FG_STATUS_OK && said &&
        fg__xdmf_word(word, vtk, said, "Value", NULL, "") &&
        !fg__number_read_list(&time[n], 1, word))
      status = fg__vtk_bad_attribute(vtk, said, "Value");
  }
  free(number);
  return status;
}

/* How many grids an element has. */
static fg_status count_grids(size_t *out, fg__vtk *vtk, const xmlNode *parent)
{
  const xmlNode *grid = NULL;
  fg_status status = FG_STATUS_OK;
  *out = 0;
  do
    status = fg__xdmf_child(&grid, vtk, parent, "Grid", (int)*out);
  while (status == FG_STATUS_OK && grid && ++*out < MOST_GRIDS);
  return status;
}

/* The grid of the wanted time instead of a collection over time; a single grid has one
 * time where it says so. */
static fg_status choose_time(const xmlNode **grid, fg__dataset *data, fg__vtk *vtk,
                             const fg_read_options *options)
{
  const int wanted = options ? options->time : 0;
  size_t count = 1;
  const xmlNode *said = NULL;
  const bool several = is_collection(vtk, *grid, "Temporal");
  fg_status status = several ? count_grids(&count, vtk, *grid)
                             : fg__xdmf_child(&said, vtk, *grid, "Time", 0);
  if (status != FG_STATUS_OK || (!several && !said))
    return status;
  double *time = fg__allocate(count, sizeof *time);
  if (!time)
    return fg__fail_memory(vtk->context, "times", count * sizeof *time);
  if (several) {
    status = read_times(time, count, vtk, *grid);
  } else {
    char word[FG__XDMF_WORD];
    fg__xdmf_word(word, vtk, said, "Value", NULL, "0");
    if (!fg__number_read_list(time, 1, word))
      status = fg__vtk_bad_attribute(vtk, said, "Value");
  }
  if (status != FG_STATUS_OK) {
    free(time);
    return status;
  }
  status = fg__dataset_choose_time(data, vtk->path, time, count, wanted);
  return status == FG_STATUS_OK && several
             ? fg__xdmf_child(grid, vtk, *grid, "Grid", wanted)
             : status;
}

/* Whether a grid, or one in it, has an attribute of a type; "": of any. */
static bool has_attribute(fg__vtk *vtk, const xmlNode *grid, const char *type)
{
  for (const xmlNode *node = grid ? grid->children : NULL; node; node = node->next) {
    char word[FG__XDMF_WORD];
    if (fg__vtk_is_element(node, "Attribute")) {
      fg__xdmf_word(word, vtk, node, "AttributeType", "Type", "Scalar");
      if (!*type || strcasecmp(word, type) == 0)
        return true;
    } else if (fg__vtk_is_element(node, "Grid")) {
      return has_attribute(vtk, node, type); /* others of a collection are alike */
    }
  }
  return false;
}

/* The grid of the domain that the option --block names, or the only one that has what
 * could be a vector. */
static fg_status choose_grid(const xmlNode **out, fg__vtk *vtk, const xmlNode *domain,
                             const char *wanted)
{
  static const char *const types[] = {"Vector", ""};
  fg__names names = {0};
  const xmlNode *grid = NULL;
  char name[FG__XDMF_WORD];
  size_t count = 0, found[2] = {0, 0};
  const xmlNode *of[2] = {NULL, NULL}, *named = NULL;
  fg_status status = count_grids(&count, vtk, domain);
  for (size_t n = 0; n < count && status == FG_STATUS_OK; ++n) {
    status = fg__xdmf_child(&grid, vtk, domain, "Grid", (int)n);
    if (status != FG_STATUS_OK)
      break;
    fg__xdmf_word(name, vtk, grid, "Name", NULL, "");
    fg__names_add(&names, ", ", "%s", name);
    if (wanted && strcmp(name, wanted) == 0)
      named = grid;
    for (int k = 0; k < 2; ++k)
      if (has_attribute(vtk, grid, types[k])) {
        of[k] = grid;
        ++found[k];
      }
  }
  if (status != FG_STATUS_OK)
    return status;
  *out = wanted ? named : count == 1 ? grid : found[0] == 1 ? of[0] : of[1];
  if (*out && (wanted || count == 1 || found[0] == 1 || (found[0] == 0 && found[1] == 1)))
    return FG_STATUS_OK;
  if (wanted)
    fg__fail(vtk->context, FG_STATUS_ARGUMENT, "%s: there is no block \"%.100s\"",
             vtk->path, wanted);
  else
    fg__fail(vtk->context, count ? FG_STATUS_ARGUMENT : FG_STATUS_FILE_FORMAT,
             count ? "%s: %zu grids, of which several may be meant: name one by --block"
                   : "%s: has no Grid in a Domain (%zu)",
             vtk->path, count);
  if (count > 0)
    fg__hint(vtk->context, "the blocks are: %s", names.text);
  return count > 0 ? FG_STATUS_ARGUMENT : FG_STATUS_FILE_FORMAT;
}

static fg_status read_grid(fg__vtk *vtk, const xmlNode *grid)
{
  size_t count = 0;
  if (is_collection(vtk, grid, "Temporal"))
    return fg__fail(vtk->context, FG_STATUS_UNSUPPORTED,
                    "%s: line %ld: a collection over time in another collection",
                    vtk->path, xmlGetLineNo(grid));
  if (!is_collection(vtk, grid, "Spatial"))
    return fg__xdmf_read_uniform(vtk, grid);
  fg_status status = count_grids(&count, vtk, grid);
  for (size_t n = 0; n < count && status == FG_STATUS_OK; ++n) {
    const xmlNode *one = NULL;
    status = fg__xdmf_child(&one, vtk, grid, "Grid", (int)n);
    if (status == FG_STATUS_OK && is_collection(vtk, one, "Spatial"))
      status = fg__fail(vtk->context, FG_STATUS_UNSUPPORTED,
                        "%s: line %ld: a collection in another collection", vtk->path,
                        xmlGetLineNo(one));
    if (status == FG_STATUS_OK)
      status = read_grid(vtk, one);
  }
  return status;
}

fg_status fg__xdmf_open(fg__dataset *data, fg_context *context, const fg__source *source,
                        const fg_read_options *options)
{
  fg__vtk *vtk;
  fg__hdf *hdf;
  const xmlNode *grid = NULL, *domain = NULL;
  fg_status status = fg__vtk_begin(&vtk, data, context, source);
  if (status == FG_STATUS_OK)
    status = fg__hdf_begin(&hdf, vtk);
  if (status != FG_STATUS_OK)
    return status;
  hdf->room = TIMES_LARGER * (double)source->size;
  vtk->may_have_document_type = true;
  vtk->file_size = SIZE_MAX / 2; /* its arrays are elsewhere */
  data->has_blocks = true;
  status = fg__vtk_parse(vtk, source);
  const xmlNode *root =
      status == FG_STATUS_OK ? xmlDocGetRootElement(vtk->document) : NULL;
  if (root)
    domain = fg__vtk_child(root, "Domain");
  if (status == FG_STATUS_OK && !domain)
    status = fg__fail(context, FG_STATUS_FILE_FORMAT, "%s: an Xdmf without a Domain",
                      vtk->path);
  if (status == FG_STATUS_OK)
    status = choose_grid(&grid, vtk, domain, options ? options->block : NULL);
  if (status == FG_STATUS_OK)
    status = choose_time(&grid, data, vtk, options);
  if (status == FG_STATUS_OK)
    status = read_grid(vtk, grid);
  if (vtk->exhausted)
    return FG_STATUS_MEMORY;
  return status == FG_STATUS_OK ? fg__vtk_fill(data, vtk) : status;
}
