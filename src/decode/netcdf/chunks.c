/* Reads numbers of variables after a check of their chunks' sizes. libhdf5 inflates a
 * chunk completely, up to 1032 times its stored bytes (RFC 1951), before it compares the
 * result with the declared size. Chunks of which that could be too much are therefore
 * inflated here first, into a buffer of fixed size. */
#define H5_USE_110_API
#include <hdf5.h>

#include "base/memory.h"
#include "decode/netcdf/netcdf.h"

#include <netcdf.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <zlib.h>

enum {
  CHUNKS_AT_ONCE = 1024, /* HDF5 takes 7 kB of memory for each, and its time */
  CHECKSUM_BYTES = 4,
  WINDOW_BYTES = 1 << 16,
  GROUP_BYTES = 16 * NC_MAX_NAME /* of a group's name with those it is in */
};

/* A chunked data set, and the part of it that is read. */
typedef struct chunked {
  const fg__variable *variable;
  fg__nc_storage *storage;
  hid_t set;
  int rank;
  hsize_t length[H5S_MAX_RANK]; /* of a chunk */
  hsize_t bytes;                /* of a chunk in memory */
  int deflate;                  /* index of the filter, or -1 */
  bool checksum;                /* a checksum filter follows deflate */
  unsigned char *stored;        /* the chunk that was checked last */
  size_t capacity;
} chunked;

static fg_status fail_overlong(const chunked *c, hsize_t stored)
{
  return fg__fail(c->variable->owner->context, FG_STATUS_FILE_FORMAT,
                  "%s: damaged: a chunk of '%.200s', stored in %llu bytes, is more than "
                  "the %llu that it should be",
                  c->variable->path, c->variable->name, (unsigned long long)stored,
                  (unsigned long long)c->bytes);
}

/* Whether a deflate stream inflates to more than `most` bytes. Damaged and truncated
 * streams are left to libhdf5 (false). */
static bool inflates_beyond(unsigned char *bytes, size_t size, hsize_t most)
{
  unsigned char window[WINDOW_BYTES];
  z_stream z = {.next_in = bytes, .avail_in = (uInt)size};
  if (inflateInit(&z) != Z_OK)
    return false;
  hsize_t made = 0;
  int state = Z_OK;
  while (state == Z_OK && made <= most) {
    z.next_out = window;
    z.avail_out = WINDOW_BYTES;
    state = inflate(&z, Z_NO_FLUSH);
    made += WINDOW_BYTES - z.avail_out;
  }
  inflateEnd(&z);
  return made > most;
}

/* Checks one chunk by inflating it. */
static fg_status check_content(chunked *c, const hsize_t *place, hsize_t stored)
{
  fg_context *context = c->variable->owner->context;
  void *grown = c->stored;
  uint32_t skipped = 0;
  if (!fg__grow(&grown, &c->capacity, (size_t)stored, 1))
    return fg__fail_memory(context, "a chunk", (size_t)stored);
  c->stored = grown;
  if (H5Dread_chunk(c->set, H5P_DEFAULT, place, &skipped, c->stored) < 0 ||
      (skipped >> c->deflate & 1U))
    return FG_STATUS_OK;
  const size_t size = (size_t)stored - (c->checksum ? CHECKSUM_BYTES : 0);
  /* filters before deflate add checksums and headers of their own */
  return inflates_beyond(c->stored, size, c->bytes + c->bytes / 8 + WINDOW_BYTES)
             ? fail_overlong(c, stored)
             : FG_STATUS_OK;
}

/* Levels and rows of one chunk are read one after the other; each chunk is checked
 * once. */
static bool is_checked(const chunked *c, const hsize_t *place)
{
  const fg__nc_storage *s = c->storage;
  for (size_t n = 0; n < FG__NC_CHECKED_CHUNKS; ++n) {
    bool same = s->checked[n].variable == c->variable;
    for (int k = 0; k < c->rank && same; ++k)
      same = s->checked[n].place[k] == place[k];
    if (same)
      return true;
  }
  return false;
}

static void mark_checked(const chunked *c, const hsize_t *place)
{
  fg__nc_storage *s = c->storage;
  fg__nc_checked_chunk *chunk = &s->checked[s->next];
  s->next = (s->next + 1) % FG__NC_CHECKED_CHUNKS;
  chunk->variable = c->variable;
  for (int k = 0; k < c->rank; ++k)
    chunk->place[k] = place[k];
}

static fg_status check_chunk(chunked *c, const hsize_t *place)
{
  hsize_t stored = 0;
  if (is_checked(c, place))
    return FG_STATUS_OK;
  if (H5Dget_chunk_storage_size(c->set, place, &stored) < 0 ||
      stored <= FG__NC_HARMLESS_BYTES)
    return FG_STATUS_OK;
  if (fg__nc_is_overlong(stored, c->bytes))
    return fail_overlong(c, stored);
  const fg_status status =
      c->deflate < 0 ? FG_STATUS_OK : check_content(c, place, stored);
  if (status == FG_STATUS_OK)
    mark_checked(c, place);
  return status;
}

static bool describe_filters(chunked *c, hid_t creation)
{
  const int filters = H5Pget_nfilters(creation);
  c->deflate = -1;
  for (int n = 0; n < filters; ++n) {
    unsigned flags;
    size_t values = 0;
    const H5Z_filter_t id =
        H5Pget_filter2(creation, (unsigned)n, &flags, &values, NULL, 0, NULL, NULL);
    if (id == H5Z_FILTER_DEFLATE)
      c->deflate = n;
    c->checksum = id == H5Z_FILTER_FLETCHER32 && c->deflate >= 0;
  }
  return filters > 0;
}

/* Returns false when no filter could enlarge chunks. */
static bool describe(chunked *c)
{
  const hid_t creation = H5Dget_create_plist(c->set);
  if (creation < 0)
    return false;
  const bool filtered =
      H5Pget_layout(creation) == H5D_CHUNKED && describe_filters(c, creation);
  if (filtered)
    c->rank = H5Pget_chunk(creation, H5S_MAX_RANK, c->length);
  H5Pclose(creation);
  const hid_t type = H5Dget_type(c->set);
  c->bytes = H5Tget_size(type);
  H5Tclose(type);
  for (int k = 0; k < c->rank; ++k)
    c->bytes *= c->length[k]; /* no overflow: objects.c has checked chunk sizes */
  return filtered && c->rank == c->variable->rank + (c->variable->element > 0);
}

/* Moves `place`, the index of a chunk's first sample, to the next chunk of the part;
 * false after the last. */
static bool next_chunk(hsize_t *place, const chunked *c, const size_t *start,
                       const size_t *count)
{
  for (int k = c->rank - 1; k >= 0; --k) {
    place[k] += c->length[k];
    if (place[k] < start[k] + count[k])
      return true;
    place[k] = start[k] - start[k] % c->length[k];
  }
  return false;
}

static fg_status check_part(chunked *c, const size_t *start, const size_t *count)
{
  hsize_t place[H5S_MAX_RANK] = {0};
  fg_status status = FG_STATUS_OK;
  for (int k = 0; k < c->rank; ++k) {
    if (count[k] == 0 || c->length[k] == 0)
      return FG_STATUS_OK;
    place[k] = start[k] - start[k] % c->length[k];
  }
  do
    status = check_chunk(c, place);
  while (status == FG_STATUS_OK && next_chunk(place, c, start, count));
  return status;
}

/* Opens a variable by the bytes of its name in the file. libnetcdf stores a variable with
 * the name of a dimension, which is no coordinate of it, under another name. */
static hid_t open_set(hid_t file, const fg__variable *v)
{
  static const char *const before[] = {"", "_nc4_non_coord_"};
  char group[GROUP_BYTES], own[NC_MAX_NAME + 1], name[GROUP_BYTES + 2 * NC_MAX_NAME];
  size_t length = 0;
  hid_t set = -1;
  if (nc_inq_grpname_full(v->place, &length, NULL) || length >= sizeof group ||
      nc_inq_grpname_full(v->place, &length, group) ||
      nc_inq_varname(v->place, v->id, own))
    return -1;
  for (size_t n = 0; n < sizeof before / sizeof *before && set < 0; ++n) {
    snprintf(name, sizeof name, "%s/%s%s", group, before[n], own);
    set = H5Dopen2(file, name, H5P_DEFAULT);
  }
  return set;
}

/* Along the first dimension of more than one sample the parts of `out` lie one behind the
 * other. */
static int get_part(const fg__variable *v, const size_t *length, size_t *start,
                    size_t *count, double *out)
{
  const int rank = v->rank + (v->element > 0);
  size_t chunks = 1, row = 1;
  int along = 0;
  while (along + 1 < rank && count[along] == 1)
    ++along;
  for (int k = 0; k < rank; ++k) {
    if (count[k] == 0)
      return NC_NOERR;
    chunks *= (start[k] + count[k] - 1) / length[k] - start[k] / length[k] + 1;
    row *= k > along ? count[k] : 1;
  }
  /* the first part ends with a chunk */
  const size_t middle = start[along] + count[along] / 2, all = count[along];
  const size_t first = middle - middle % length[along];
  if (chunks <= CHUNKS_AT_ONCE || first <= start[along])
    return nc_get_vara_double(v->place, v->id, start, count, out);
  const size_t before = first - start[along];
  count[along] = before;
  int error = get_part(v, length, start, count, out);
  start[along] += before;
  count[along] = all - before;
  if (!error)
    error = get_part(v, length, start, count, out + before * row);
  start[along] -= before;
  count[along] = all;
  return error;
}

int fg__nc_get_numbers(const fg__variable *v, const size_t *start, const size_t *count,
                       double *out)
{
  size_t length[NC_MAX_VAR_DIMS], from[FG__RANK + 1], counts[FG__RANK + 1];
  int storage = NC_CONTIGUOUS;
  if (v->rank > FG__RANK || nc_inq_var_chunking(v->place, v->id, &storage, length) ||
      storage != NC_CHUNKED)
    return nc_get_vara_double(v->place, v->id, start, count, out);
  memcpy(from, start, sizeof from);
  memcpy(counts, count, sizeof counts);
  return get_part(v, length, from, counts, out);
}

fg_status fg__nc_check_chunks(const fg__variable *v, const size_t *start,
                              const size_t *count)
{
  fg__nc_state *state = v->owner->file[v->file].state;
  fg__nc_storage *storage = &state->storage;
  if (!storage->is_open || v->rank > FG__RANK)
    return FG_STATUS_OK;
  H5E_auto2_t print;
  void *print_data;
  H5Eget_auto2(H5E_DEFAULT, &print, &print_data);
  H5Eset_auto2(H5E_DEFAULT, NULL, NULL);
  chunked c = {
      .variable = v, .storage = storage, .set = open_set((hid_t)storage->file, v)};
  const bool is_found = c.set >= 0;
  fg_status status = FG_STATUS_OK;
  if (is_found) {
    if (describe(&c))
      status = check_part(&c, start, count);
    H5Dclose(c.set);
  }
  free(c.stored);
  H5Eset_auto2(H5E_DEFAULT, print, print_data);
  if (!is_found)
    return fg__fail(v->owner->context, FG_STATUS_FILE_FORMAT,
                    "%s: damaged: HDF5 cannot find '%.200s'", v->path, v->name);
  return status;
}
