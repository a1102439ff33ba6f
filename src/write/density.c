/* A density, its clusters and its mask as VTK XML image data. Each rank packs some blocks
 * of every array, and rank 0 writes them as they come: the same bytes on any ranks. */
#include "density/density.h"
#include "base/memory.h"
#include "file/number_text.h"
#include "write/vti.h"

#include <limits.h>
#include <stdlib.h>
#include <string.h>

enum { HIDDEN_CELL = 32 }; /* vtkDataSetAttributes::HIDDENCELL */

typedef struct writing {
  fg_context *context;
  const fg_density *density;
  const fg__partition *partition;
  const fg__ranks *ranks;
  int points[3]; /* of the image, 1 along z in 2D */
  FILE *stream;  /* of rank 0 */
} writing;

/* An array in the file: `along` elements an axis. */
typedef struct element_array {
  fg__vti_output about;
  fg__density_kind kind;
  size_t size; /* of an element */
  int along[3];
} element_array;

/* The bytes of an array that a rank packs, in whole blocks. */
static void find_range(const fg__ranks *ranks, int rank, size_t bytes, size_t range[2])
{
  size_t blocks = (bytes + FG__VTI_BLOCK - 1) / FG__VTI_BLOCK;
  for (int k = 0; k < 2; ++k) {
    size_t end = blocks * (size_t)(rank + k) / (size_t)ranks->count * FG__VTI_BLOCK;
    range[k] = end < bytes ? end : bytes;
  }
}

/* The rows (in 3D planes) in which a range lies. A periodic axis ends with the image of
 * its first node, as regions may. */
static fg__region region_of(const element_array *array, int dimension,
                            const size_t range[2], int rank)
{
  fg__region out = {.nodes = {{0, 0, 0}, {1, 1, 1}}, .rank = rank};
  size_t layer = array->size;
  for (int k = 0; k < dimension; ++k) {
    out.nodes.nodes[k] = array->along[k];
    layer *= k < dimension - 1 ? (size_t)array->along[k] : 1;
  }
  out.nodes.first[dimension - 1] = (int)(range[0] / layer);
  out.nodes.nodes[dimension - 1] =
      (int)((range[1] + layer - 1) / layer) - out.nodes.first[dimension - 1];
  return out;
}

/* This rank's rows; *skip: bytes before its range there. */
static fg_status fetch_rows(unsigned char **rows, size_t *skip, size_t *count,
                            const writing *w, const element_array *array)
{
  int dimension = w->partition->dimension;
  size_t all = (size_t)w->ranks->count, range[2];
  fg__region *region = fg__allocate(all, sizeof *region);
  void **out = fg__allocate(all, sizeof *out);
  fg_status status = FG_STATUS_OK;
  int regions = 0;
  *rows = NULL;
  *skip = *count = 0;
  for (int r = 0; r < w->ranks->count && region && out; ++r) {
    find_range(w->ranks, r, array->about.bytes, range);
    if (range[0] == range[1])
      continue;
    region[regions] = region_of(array, dimension, range, r);
    if (r == w->ranks->rank) {
      size_t elements = (size_t)fg__box_count(&region[regions].nodes);
      size_t layers = (size_t)region[regions].nodes.nodes[dimension - 1];
      size_t first = (size_t)region[regions].nodes.first[dimension - 1];
      *rows = fg__allocate(elements, array->size);
      *skip = range[0] - first * (elements / layers * array->size);
      *count = range[1] - range[0];
      out[regions] = *rows;
    }
    ++regions;
  }
  if (!region || !out || (*count && !*rows))
    status = fg__fail_memory(w->context, "a density to write", *count);
  status = fg__ranks_agree(w->ranks, w->context, status);
  if (!status)
    status = fg__density_fill(w->density, w->context, array->kind, region, regions, out);
  free(region);
  free(out);
  return status;
}

static void hide_masked_cells(unsigned char *active, size_t count)
{
  for (size_t n = 0; n < count; ++n)
    active[n] = active[n] ? 0 : HIDDEN_CELL;
}

typedef struct sizes_so_far {
  unsigned char *bytes;
  size_t count;
} sizes_so_far;

static void take_sizes(void *closure, const unsigned char *bytes, size_t count)
{
  sizes_so_far *sizes = closure;
  memcpy(sizes->bytes + sizes->count, bytes, count);
  sizes->count += count;
}

static void take_packed(void *closure, const unsigned char *bytes, size_t count)
{
  fg__vti_put(closure, bytes, count);
}

/* All ranks' blocks become the array's text on rank 0. */
static fg_status write_blocks(const writing *w, const element_array *array,
                              const fg__vti_blocks *blocks)
{
  size_t all = (array->about.bytes + FG__VTI_BLOCK - 1) / FG__VTI_BLOCK;
  uint64_t *sizes = w->stream ? fg__allocate(all, sizeof *sizes) : NULL;
  fg_status status = FG_STATUS_OK;
  if (w->stream && !sizes)
    status = fg__fail_memory(w->context, "a density to write", all * sizeof *sizes);
  status = fg__ranks_agree(w->ranks, w->context, status);
  if (!status) {
    sizes_so_far so_far = {.bytes = (unsigned char *)sizes};
    fg__vti_text text = {.stream = w->stream};
    fg__ranks_pass(w->ranks, blocks->sizes, blocks->count * sizeof *blocks->sizes,
                   take_sizes, &so_far);
    if (w->stream)
      fg__vti_begin_array(w->stream, &array->about, sizes);
    fg__ranks_pass(w->ranks, blocks->packed, blocks->used, take_packed, &text);
    if (w->stream) {
      fg__vti_put_end(&text);
      fg__vti_end_array(w->stream, &array->about);
    }
  }
  free(sizes);
  return status;
}

static fg_status write_array(const writing *w, const char *name, const char *type,
                             fg__density_kind kind)
{
  bool cells = kind == FG__DENSITY_ACTIVE;
  element_array array = {
      .about = {.name = name, .type = type, .components = 1},
      .kind = kind,
      .size = cells ? 1 : sizeof(float),
  };
  array.about.bytes = array.size;
  for (int k = 0; k < 3; ++k) {
    array.along[k] = w->points[k] - (cells && k < w->partition->dimension);
    array.about.bytes *= (size_t)array.along[k];
  }
  unsigned char *rows;
  size_t skip, count;
  fg__vti_blocks blocks = {0};
  fg_status status = fetch_rows(&rows, &skip, &count, w, &array);
  if (!status) {
    if (cells && rows)
      hide_masked_cells(rows + skip, count);
    status = fg__vti_pack(&blocks, w->context, rows ? rows + skip : NULL, count);
    status = fg__ranks_agree(w->ranks, w->context, status);
  }
  free(rows);
  if (!status)
    status = write_blocks(w, &array, &blocks);
  fg__vti_blocks_clear(&blocks);
  return status;
}

static fg_status write_arrays(const writing *w, const fg__vti_image *image)
{
  if (w->stream)
    fg__vti_write_open(w->stream, image, NULL, "u");
  fg_status status = write_array(w, "u", "Float32", FG__DENSITY_U);
  if (!status)
    status = write_array(w, "cluster", "Int32", FG__DENSITY_LABEL);
  if (w->stream)
    fg__vti_write_cells(w->stream);
  if (!status && fg__density_block_of(w->density)->masked)
    status = write_array(w, "vtkGhostType", "UInt8", FG__DENSITY_ACTIVE);
  if (w->stream)
    fg__vti_write_close(w->stream);
  return status;
}

static bool ends_with(const char *path, const char *end)
{
  size_t length = strlen(path), wanted = strlen(end);
  return length > wanted && strcmp(path + length - wanted, end) == 0;
}

static fg_status describe(fg__vti_image *image, fg_context *context, const char *path,
                          const fg_density_arrays *density)
{
  image->time = &density->time;
  image->least_area = &density->debris_area;
  for (int k = 0; k < density->dimension; ++k) {
    if (density->nodes[k] == INT_MAX)
      return fg__fail(context, FG_STATUS_UNSUPPORTED, "%s: too many nodes", path);
    image->points[k] = density->nodes[k] + (density->periodic[k] ? 1 : 0);
    image->origin[k] = density->origin[k];
    image->spacing[k] = density->spacing[k];
  }
  return FG_STATUS_OK;
}

static fg_status write_file(writing *w, const char *path, const fg__vti_image *image)
{
  bool writes = w->ranks->rank == 0, located = false;
  fg__number_locale locale;
  fg__whole_file file = {0};
  fg_status status = FG_STATUS_OK;
  if (writes) {
    located = fg__number_locale_begin(&locale);
    status = located ? fg__whole_file_open(&file, w->context, path)
                     : fg__fail_memory(w->context, "a locale", sizeof locale);
    w->stream = file.stream;
  }
  status = fg__ranks_agree(w->ranks, w->context, status);
  if (!status)
    status = write_arrays(w, image);
  if (writes)
    status = fg__whole_file_close(&file, w->context, status);
  if (located)
    fg__number_locale_end(&locale);
  return fg__ranks_agree(w->ranks, w->context, status);
}

static fg_status write_density(fg_context *context, const char *path,
                               const fg_density *density)
{
  const fg__partition *partition = &fg__density_block_of(density)->partition;
  writing w = {.context = context,
               .density = density,
               .partition = partition,
               .ranks = partition->ranks};
  bool writes = w.ranks->rank == 0;
  fg__vti_image image = {0};
  fg_status status = FG_STATUS_OK;
  if (writes && !path)
    status = fg__fail(context, FG_STATUS_ARGUMENT, "density: no file name to write");
  else if (writes && !ends_with(path, ".vti"))
    status = fg__fail(context, FG_STATUS_UNSUPPORTED,
                      "%s: a density is written as .vti only", path);
  if (status == FG_STATUS_OK)
    status = describe(&image, context, writes ? path : "", fg_density_contents(density));
  for (int k = 0; k < 3; ++k)
    w.points[k] = image.points[k] > 0 ? image.points[k] : 1;
  status = fg__ranks_agree(w.ranks, context, status);
  return status ? status : write_file(&w, path, &image);
}

fg_status fg_density_write(fg_context *context, const char *path,
                           const fg_density *density)
{
  if (!density)
    return fg__fail(context, FG_STATUS_ARGUMENT, "density: none to write");
  fg__counters *counters = fg__density_block_of(density)->partition.ranks->counters;
  fg_phase before = fg__phase_continue(counters, FG_PHASE_SNAPSHOTS);
  fg_status status = write_density(context, path, density);
  fg__phase_return(counters, before);
  return status;
}
