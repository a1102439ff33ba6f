/* Numbers of variables, read only where their chunks become no larger than they should.
 * libhdf5 inflates a chunk to whatever comes out of it, up to 1032 times its stored bytes
 * (RFC 1951), before it compares that with the chunk's declared size. So the chunks of a
 * variable that could become far too large are inflated here first, into a buffer that is
 * thrown away. */
#define H5_USE_110_API
#include <hdf5.h>

#include "base/memory.h"
#include "read/netcdf/netcdf.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <zlib.h>

enum { CHECKSUM_BYTES = 4, WINDOW_BYTES = 1 << 16 };

/* A data set in chunks, and the part of it that is to be read. */
typedef struct chunked {
  const fg__nc_variable *variable;
  fg__nc_storage *storage;
  hid_t set;
  int rank;
  hsize_t length[H5S_MAX_RANK]; /* of a chunk */
  hsize_t bytes;                /* of a chunk in memory */
  int deflate;                  /* place of the filter, or -1 */
  bool checksum;                /* behind it */
  unsigned char *stored;        /* the last chunk that was looked at */
  size_t capacity;
} chunked;

static fg_status fail_swollen(const chunked *c, hsize_t stored)
{
  return fg__fail(c->variable->owner->context, FG_STATUS_FILE_FORMAT,
                  "%s: damaged: a chunk of '%.200s', stored in %llu bytes, is more than "
                  "the %llu that it should be",
                  c->variable->path, c->variable->name, (unsigned long long)stored,
                  (unsigned long long)c->bytes);
}

/* Whether deflated bytes become more than `most`. What is no such stream, or ends early,
 * is left to libhdf5. */
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

/* A chunk's content, when it could become too large. */
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
  /* what filters before deflate add: checksums, their own headers */
  return inflates_beyond(c->stored, size, c->bytes + c->bytes / 8 + WINDOW_BYTES)
             ? fail_swollen(c, stored)
             : FG_STATUS_OK;
}

/* Levels and rows of one chunk are read one after another: it is looked at once. */
static bool was_seen(const chunked *c, const hsize_t *place)
{
  const fg__nc_storage *s = c->storage;
  for (size_t n = 0; n < FG__NC_SEEN; ++n) {
    bool same = s->seen[n].variable == c->variable;
    for (int k = 0; k < c->rank && same; ++k)
      same = s->seen[n].place[k] == place[k];
    if (same)
      return true;
  }
  return false;
}

static void keep_seen(const chunked *c, const hsize_t *place)
{
  fg__nc_storage *s = c->storage;
  fg__nc_seen *seen = &s->seen[s->next];
  s->next = (s->next + 1) % FG__NC_SEEN;
  seen->variable = c->variable;
  for (int k = 0; k < c->rank; ++k)
    seen->place[k] = place[k];
}

static fg_status check_chunk(chunked *c, const hsize_t *place)
{
  hsize_t stored = 0;
  if (was_seen(c, place))
    return FG_STATUS_OK;
  if (H5Dget_chunk_storage_size(c->set, place, &stored) < 0 ||
      stored <= FG__NC_HARMLESS_BYTES)
    return FG_STATUS_OK;
  if (fg__nc_is_swollen(stored, c->bytes))
    return fail_swollen(c, stored);
  const fg_status status =
      c->deflate < 0 ? FG_STATUS_OK : check_content(c, place, stored);
  if (status == FG_STATUS_OK)
    keep_seen(c, place);
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

/* False: there are no chunks that filters could make larger. */
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
    c->bytes *= c->length[k]; /* fits: the file's chunks were looked at before */
  return filtered && c->rank == c->variable->rank;
}

/* The next chunk of the part, in places of its first sample; false: there is none. */
static bool go_on(hsize_t *place, const chunked *c, const size_t *start,
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
  while (status == FG_STATUS_OK && go_on(place, c, start, count));
  return status;
}

/* libnetcdf writes a variable that is named like a dimension, but is no coordinate of
 * it, under another name. */
static hid_t open_set(hid_t file, const fg__nc_variable *v)
{
  static const char *const before[] = {"", "_nc4_non_coord_"};
  char name[2 * FG__NC_NAME];
  const char *plain = v->plain_name;
  for (size_t n = 0; n < sizeof before / sizeof *before; ++n) {
    snprintf(name, sizeof name, "/%.*s%s%s", (int)(plain - v->name), v->name, before[n],
             plain);
    const hid_t set = H5Dopen2(file, name, H5P_DEFAULT);
    if (set >= 0)
      return set;
  }
  return -1;
}

int fg__nc_check_chunks(const fg__nc_variable *v, const size_t *start,
                        const size_t *count)
{
  fg__nc_storage *storage = &v->owner->storage[v->file];
  if (!storage->is_open || v->rank > FG__NC_RANK)
    return NC_NOERR;
  H5E_auto2_t print;
  void *print_data;
  H5Eget_auto2(H5E_DEFAULT, &print, &print_data);
  H5Eset_auto2(H5E_DEFAULT, NULL, NULL);
  chunked c = {
      .variable = v, .storage = storage, .set = open_set((hid_t)storage->file, v)};
  fg_status status = FG_STATUS_OK;
  if (c.set >= 0) {
    if (describe(&c))
      status = check_part(&c, start, count);
    H5Dclose(c.set);
  }
  free(c.stored);
  H5Eset_auto2(H5E_DEFAULT, print, print_data);
  return status == FG_STATUS_OK       ? NC_NOERR
         : status == FG_STATUS_MEMORY ? NC_ENOMEM
                                      : NC_EFILTER;
}

int fg__nc_fetch(const fg__nc_variable *v, const size_t *start, const size_t *count,
                 double *out)
{
  const int error = fg__nc_check_chunks(v, start, count);
  return error ? error : nc_get_vara_double(v->group, v->id, start, count, out);
}

int fg__nc_fetch_one(const fg__nc_variable *v, const size_t *index, double *out)
{
  size_t one[FG__NC_RANK];
  for (int k = 0; k < FG__NC_RANK; ++k)
    one[k] = 1;
  return fg__nc_fetch(v, index, one, out);
}
