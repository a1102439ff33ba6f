/* VTK XML files that name others: pieces in parallel, blocks, and collections over time.
 * A file may name only files of a lower kind than its own, in its own folder or below,
 * and each once. */
#include "base/memory.h"
#include "base/mix.h"
#include "decode/composite/names.h"

#include <stdlib.h>
#include <string.h>

enum { MOST_FILES = 32768 };

/* What kinds of files there are; one names those before it. */
typedef enum file_kind { GRID, PIECES, BLOCKS, COLLECTION } file_kind;

static const struct {
  const char *type;
  file_kind kind;
  bool along_axes, uneven;
} TYPES[] = {{"PImageData", PIECES, true, false},
             {"PRectilinearGrid", PIECES, true, true},
             {"PStructuredGrid", PIECES, false, false},
             {"PUnstructuredGrid", PIECES, false, false},
             {"PPolyData", PIECES, false, false},
             {"vtkMultiBlockDataSet", BLOCKS, false, false},
             {"vtkMultiPieceDataSet", BLOCKS, false, false},
             {"vtkPartitionedDataSet", BLOCKS, false, false},
             {"vtkPartitionedDataSetCollection", BLOCKS, false, false},
             {"Collection", COLLECTION, false, false}};

/* Instead of a place in TYPES: a grid, or a list in JSON. */
enum { NO_TYPE = -1, SERIES = -2 };

/* The reading of a file and all that it names. */
typedef struct composite {
  fg__dataset *data;
  fg__vtk *whole; /* whose files are those that hold grids */
  const fg_read_options *options;
  uint64_t *seen; /* hashes of the names of files that were opened */
  size_t seen_count, seen_capacity;
  bool several;   /* more than one is named somewhere */
  fg__vtk *along; /* of pieces along axes: extent, origin and spacing of the whole */
} composite;

static fg_status choose_time(composite *c, fg__vtk_names *list, const char *path)
{
  return fg__vtk_names_choose_time(c->data, list, path,
                                   c->options ? c->options->time : 0);
}

static fg_status choose_block(composite *c, fg__vtk_names *list, const char *path)
{
  c->data->has_blocks = true;
  return fg__vtk_names_choose_block(list, c->whole->context, path,
                                    c->options ? c->options->block : NULL);
}

/* Each file once, and not too many. */
static fg_status check_seen(composite *c, const char *path, const char *by)
{
  uint64_t hash = 0;
  void *seen = c->seen;
  for (const char *at = path; *at; ++at)
    hash = fg__mix(hash ^ (unsigned char)*at);
  for (size_t i = 0; i < c->seen_count; ++i)
    if (c->seen[i] == hash)
      return fg__fail(c->whole->context, FG_STATUS_FILE_FORMAT,
                      "%s: the file \"%.200s\" is named twice", by, path);
  if (c->seen_count == MOST_FILES)
    return fg__fail(c->whole->context, FG_STATUS_UNSUPPORTED,
                    "%s: more than %d files are named", by, MOST_FILES);
  if (!fg__grow(&seen, &c->seen_capacity, c->seen_count + 1, sizeof *c->seen))
    return fg__fail_memory(c->whole->context, "names of files", c->seen_count * 8);
  c->seen = seen;
  c->seen[c->seen_count++] = hash;
  return FG_STATUS_OK;
}

/* Which kind of file has been parsed: its place in TYPES. */
static int find_type(fg__vtk *vtk)
{
  const xmlNode *root = xmlDocGetRootElement(vtk->document);
  for (int i = 0; root && i < (int)(sizeof TYPES / sizeof TYPES[0]); ++i)
    if (fg__vtk_attribute_is(vtk, root, "type", TYPES[i].type))
      return i;
  return NO_TYPE;
}

static fg_status read_named(composite *c, fg__vtk *vtk, int type);

/* Takes the file over: as one that holds a grid, or for what it names. */
static fg_status read_file(composite *c, fg__vtk_file *file, file_kind above)
{
  fg__vtk *vtk = file->vtk;
  fg__vtk *whole = c->whole;
  fg_status status = fg__source_open(&file->source, whole->context, file->path);
  if (status != FG_STATUS_OK)
    return status;
  *vtk = (fg__vtk){
      .context = whole->context, .path = file->path, .file_size = file->source.size};
  if (fg__is_vtk_legacy(file->source.bytes, file->source.size))
    return fg__vtk_read_legacy(vtk, &file->source);
  if (!fg__is_vtk_xml(file->source.bytes, file->source.size))
    return fg__fail(whole->context, FG_STATUS_FILE_FORMAT, "%s: is no VTK file",
                    file->path);
  status = fg__vtk_parse(vtk, &file->source);
  if (status != FG_STATUS_OK)
    return status;
  const int type = find_type(vtk);
  if (type == NO_TYPE)
    return fg__vtk_read_document(vtk);
  if (TYPES[type].kind >= above)
    return fg__fail(whole->context, FG_STATUS_FILE_FORMAT,
                    "%s: a file of type %s, which no file like that which names it names",
                    file->path, TYPES[type].type);
  return read_named(c, vtk, type);
}

static bool has_grid(const fg__vtk *vtk)
{
  return vtk->piece_count > 0;
}

static fg_status open_file(composite *c, fg__vtk *by, const char *name, file_kind above)
{
  fg__vtk *whole = c->whole;
  fg__vtk_file file = {0};
  fg_status status = fg__vtk_names_path(&file.path, c->whole->context, by->path, name);
  if (status == FG_STATUS_OK)
    status = check_seen(c, file.path, by->path);
  if (status == FG_STATUS_OK) {
    file.vtk = fg__allocate(1, sizeof *file.vtk);
    if (!file.vtk)
      status = fg__fail_memory(whole->context, "a file", sizeof *file.vtk);
  }
  if (status == FG_STATUS_OK)
    status = read_file(c, &file, above);
  if (file.vtk && file.vtk->exhausted)
    status = FG_STATUS_MEMORY;
  if (status == FG_STATUS_OK && file.vtk && has_grid(file.vtk)) {
    void *files = whole->files; /* those that the file named may have moved it */
    if (fg__grow(&files, &whole->file_capacity, whole->file_count + 1, sizeof file)) {
      whole->files = files;
      whole->files[whole->file_count++] = file;
      return FG_STATUS_OK;
    }
    status = fg__fail_memory(whole->context, "files", whole->file_count * sizeof file);
  }
  if (file.vtk) {
    status = fg__vtk_check(file.vtk, status);
    fg__vtk_close(file.vtk);
  }
  free(file.vtk);
  status = fg__source_close(&file.source, whole->context, status);
  free(file.path);
  return status;
}

/* Pieces along the axes are parts of one grid. */
static fg_status keep_whole(composite *c, fg__vtk *vtk, int type, const xmlNode *grid)
{
  if (!TYPES[type].along_axes || c->several)
    return FG_STATUS_OK;
  fg__vtk *along = c->whole;
  fg_status status = fg__vtk_read_geometry(vtk, grid);
  if (status != FG_STATUS_OK || vtk->turned)
    return status;
  memcpy(along->extent, vtk->extent, sizeof along->extent);
  memcpy(along->origin, vtk->origin, sizeof along->origin);
  memcpy(along->spacing, vtk->spacing, sizeof along->spacing);
  along->uneven = TYPES[type].uneven;
  c->along = along;
  return FG_STATUS_OK;
}

static fg_status open_files(composite *c, fg__vtk *by, const fg__vtk_names *list,
                            file_kind above)
{
  fg_status status = FG_STATUS_OK;
  for (size_t i = 0; i < list->count && status == FG_STATUS_OK; ++i)
    status = open_file(c, by, list->entry[i].file, above);
  return status;
}

/* Reads what the file names. */
static fg_status read_named(composite *c, fg__vtk *vtk, int type)
{
  fg__vtk_names list = {0};
  const xmlNode *root = xmlDocGetRootElement(vtk->document);
  const xmlNode *grid = fg__vtk_child(root, TYPES[type].type);
  const file_kind kind = TYPES[type].kind;
  if (!grid)
    return fg__fail(vtk->context, FG_STATUS_FILE_FORMAT, "%s: no %s element", vtk->path,
                    TYPES[type].type);
  fg_status status = kind == PIECES   ? fg__vtk_names_of_pieces(&list, vtk, grid)
                     : kind == BLOCKS ? fg__vtk_names_of_blocks(&list, vtk, grid)
                                      : fg__vtk_names_of_times(&list, vtk, grid);
  if (status == FG_STATUS_OK && vtk->exhausted)
    status = FG_STATUS_MEMORY;
  if (status == FG_STATUS_OK && kind == COLLECTION)
    status = choose_time(c, &list, vtk->path);
  if (status == FG_STATUS_OK && kind == BLOCKS)
    status = choose_block(c, &list, vtk->path);
  if (status == FG_STATUS_OK && kind != PIECES)
    c->several = c->several || list.count > 1;
  if (status == FG_STATUS_OK && kind == PIECES)
    status = keep_whole(c, vtk, type, grid);
  if (status == FG_STATUS_OK)
    status = open_files(c, vtk, &list, kind);
  fg__vtk_names_clear(&list);
  return status;
}

/* The same of a list in JSON, which is a collection. */
static fg_status read_series(composite *c, const fg__source *source)
{
  fg__vtk_names list = {0};
  fg_status status = fg__vtk_names_of_series(&list, c->whole, source);
  if (status == FG_STATUS_OK)
    status = choose_time(c, &list, c->whole->path);
  c->several = list.count > 1;
  if (status == FG_STATUS_OK)
    status = open_files(c, c->whole, &list, COLLECTION);
  fg__vtk_names_clear(&list);
  return status;
}

/* Of pieces the one with the most cells speaks for all. */
static void put_largest_first(fg__vtk *whole)
{
  size_t most = 0, best = 0;
  for (size_t p = 0; p < whole->piece_count; ++p) {
    size_t cells;
    if (fg__vtk_tuples(&cells, whole, &whole->pieces[p], FG__VTK_CELLS) && cells > most) {
      most = cells;
      best = p;
    }
  }
  const fg__vtk_piece first = whole->pieces[0];
  whole->pieces[0] = whole->pieces[best];
  whole->pieces[best] = first;
}

/* VTK writes the whole of a curvilinear grid in every piece where its source cannot be
 * divided. */
static bool is_there(const fg__vtk *whole, const fg__vtk *file, const int extent[6])
{
  for (size_t p = 0; p < whole->piece_count; ++p)
    if (whole->pieces[p].file->kind == file->kind &&
        memcmp(whole->pieces[p].extent, extent, sizeof whole->pieces[p].extent) == 0)
      return true;
  return false;
}

/* `one`: they are all pieces of one grid. */
static fg_status take_pieces(fg__vtk *whole, fg__vtk *file, bool one)
{
  for (size_t p = 0; p < file->piece_count; ++p) {
    if (one && file->kind == FG__VTK_CURVILINEAR &&
        is_there(whole, file, file->pieces[p].extent))
      continue;
    fg_status status = fg__vtk_add_piece(whole, file->pieces[p].extent);
    if (status != FG_STATUS_OK)
      return status;
    fg__vtk_piece *piece = &whole->pieces[whole->piece_count - 1];
    *piece = file->pieces[p];
    piece->file = file;
  }
  return FG_STATUS_OK;
}

/* Pieces of a grid along axes must be that, and in it. */
static fg_status check_along(const composite *c, const fg__vtk *file)
{
  const fg__vtk *whole = c->along;
  bool good = file->kind == FG__VTK_ALONG_AXES && file->uneven == whole->uneven;
  for (size_t p = 0; p < file->piece_count && good; ++p)
    good = fg__vtk_is_within(file->pieces[p].extent, whole->extent);
  return good ? FG_STATUS_OK
              : fg__fail(whole->context, FG_STATUS_FILE_FORMAT,
                         "%s: is no piece of the grid that %s names it for", file->path,
                         whole->path);
}

/* One file is as if it had been named alone. */
static void become(fg__vtk *whole, const fg__vtk *file)
{
  whole->kind = file->kind;
  whole->polygons = file->polygons;
  whole->turned = file->turned;
  whole->uneven = file->uneven;
  memcpy(whole->direction, file->direction, sizeof whole->direction);
  memcpy(whole->extent, file->extent, sizeof whole->extent);
  memcpy(whole->origin, file->origin, sizeof whole->origin);
  memcpy(whole->spacing, file->spacing, sizeof whole->spacing);
}

/* Makes one of the files that hold grids. */
static fg_status join(composite *c)
{
  fg__vtk *whole = c->whole;
  fg_status status = FG_STATUS_OK;
  whole->file_size = 0;
  if (whole->file_count == 0)
    return fg__fail(whole->context, FG_STATUS_FILE_FORMAT,
                    "%s: names no file that holds a grid", whole->path);
  for (size_t i = 0; i < whole->file_count && status == FG_STATUS_OK; ++i) {
    fg__vtk *file = whole->files[i].vtk;
    whole->file_size += file->file_size;
    if (c->along)
      status = check_along(c, file);
    else if (whole->file_count > 1 && file->kind == FG__VTK_ALONG_AXES)
      status = fg__vtk_read_coordinates(file);
    if (status == FG_STATUS_OK)
      status = take_pieces(whole, file, !c->several);
  }
  if (status != FG_STATUS_OK)
    return status;
  if (c->along)
    return fg__vtk_check_pieces(whole);
  if (whole->file_count == 1) {
    become(whole, whole->files[0].vtk);
    return FG_STATUS_OK;
  }
  whole->kind = FG__VTK_UNSTRUCTURED;
  whole->merged = c->several;
  put_largest_first(whole);
  return FG_STATUS_OK;
}

static fg_status read_composite(composite *c, const fg__source *source, int type)
{
  if (!source->on_disk) {
    fg__fail(c->whole->context, FG_STATUS_UNSUPPORTED,
             "%s: names other files, which can be found only where it is a file itself",
             source->path);
    return FG_STATUS_UNSUPPORTED;
  }
  fg_status status = check_seen(c, source->path, source->path);
  if (status == FG_STATUS_OK)
    status = type == SERIES ? read_series(c, source) : read_named(c, c->whole, type);
  return status == FG_STATUS_OK ? join(c) : status;
}

static fg_status read_any(composite *c, const fg__source *source)
{
  int type = SERIES;
  if (!fg__is_vtk_series(source->bytes, source->size)) {
    const fg_status status = fg__vtk_parse(c->whole, source);
    if (status != FG_STATUS_OK)
      return status;
    type = find_type(c->whole);
  }
  return type == NO_TYPE ? fg__vtk_read_document(c->whole)
                         : read_composite(c, source, type);
}

fg_status fg__vtk_open(fg__dataset *data, fg_context *context, const fg__source *source,
                       const fg_read_options *options)
{
  composite c = {.data = data, .options = options};
  fg_status status = fg__vtk_begin(&c.whole, data, context, source);
  if (status == FG_STATUS_OK)
    status = read_any(&c, source);
  free(c.seen);
  if (c.whole && c.whole->exhausted)
    return FG_STATUS_MEMORY;
  return status == FG_STATUS_OK ? fg__vtk_fill(data, c.whole) : status;
}
