/* Whether a NetCDF file is as long as its header implies. libnetcdf reads zeros from a
 * truncated classic file and shifted values from one with inserted bytes, without an
 * error; so the header is parsed here first ("NetCDF Classic Format Specification",
 * Unidata: CDF-1, CDF-2 and CDF-5). That also keeps damaged headers from the library. */
#include "decode/netcdf/netcdf.h"

#include <inttypes.h>
#include <string.h>

enum {
  TAG_DIMENSION = 10,
  TAG_VARIABLE = 11,
  TAG_ATTRIBUTE = 12,
  LARGEST_NAME = 256, /* NC_MAX_NAME */
  LARGEST_RANK = 1024 /* NC_MAX_VAR_DIMS */
};

static const uint64_t NO_RECORD_DIMENSION = UINT64_MAX;

typedef struct cursor {
  const unsigned char *bytes;
  uint64_t size;
  uint64_t at;
  int version;
  bool ended;   /* reached the end of the file */
  bool damaged; /* found an invalid value */
} cursor;

typedef struct variable_extent {
  uint64_t begin; /* first byte of its data */
  uint64_t bytes; /* of all its data, or of one record, without padding */
  bool by_record;
} variable_extent;

static uint64_t read_big_endian(cursor *c, unsigned count)
{
  if (c->ended || c->size - c->at < count) {
    c->ended = true;
    return 0;
  }
  uint64_t value = 0;
  for (unsigned i = 0; i < count; ++i)
    value = value << 8 | c->bytes[c->at + i];
  c->at += count;
  return value;
}

static uint64_t read_tag(cursor *c)
{
  return read_big_endian(c, 4);
}

/* NON_NEG of the specification: 8 bytes in CDF-5, else 4. */
static uint64_t read_count(cursor *c)
{
  return read_big_endian(c, c->version == 5 ? 8 : 4);
}

static bool good(const cursor *c)
{
  return !c->ended && !c->damaged;
}

static void skip_padded(cursor *c, uint64_t count)
{
  if (!good(c))
    return;
  const uint64_t left = c->size - c->at;
  if (count > left || (4 - count % 4) % 4 > left - count) {
    c->ended = true;
    return;
  }
  c->at += count + (4 - count % 4) % 4;
}

/* A name, in place; it is not terminated. */
static const char *read_name(cursor *c, int *length)
{
  const uint64_t count = read_count(c);
  const uint64_t at = c->at;
  if (count == 0 || count > LARGEST_NAME)
    c->damaged = c->damaged || !c->ended;
  skip_padded(c, count);
  *length = good(c) ? (int)count : 0;
  return (const char *)c->bytes + at;
}

static uint64_t type_size(uint64_t type, int version)
{
  static const unsigned char size[] = {0, 1, 1, 2, 4, 4, 8, 1, 2, 4, 8, 8};
  const uint64_t types = version == 5 ? sizeof size : 7;
  return type < types ? size[type] : 0;
}

/* Number of elements of the list at the cursor; each takes `least` bytes or more. */
static uint64_t read_list(cursor *c, uint64_t wanted_tag, uint64_t least)
{
  const uint64_t tag = read_tag(c);
  const uint64_t count = read_count(c);
  if (!good(c))
    return 0;
  if (tag != wanted_tag && !(tag == 0 && count == 0))
    c->damaged = true;
  else if (count > (c->size - c->at) / least)
    c->ended = true;
  return good(c) ? count : 0;
}

static void skip_attributes(cursor *c)
{
  const uint64_t count = read_list(c, TAG_ATTRIBUTE, 12);
  for (uint64_t i = 0; i < count && good(c); ++i) {
    int length;
    read_name(c, &length);
    const uint64_t size = type_size(read_tag(c), c->version);
    const uint64_t values = read_count(c);
    if (!good(c))
      return;
    if (size == 0)
      c->damaged = true;
    else if (values > (c->size - c->at) / size)
      c->ended = true;
    else
      skip_padded(c, values * size);
  }
}

typedef struct dimension_list {
  uint64_t count;
  uint64_t record;
} dimension_list;

static dimension_list read_dimensions(cursor *c, uint64_t *lengths, uint64_t capacity)
{
  dimension_list list = {.record = NO_RECORD_DIMENSION};
  list.count = read_list(c, TAG_DIMENSION, 8);
  if (list.count > capacity)
    c->damaged = true;
  for (uint64_t i = 0; i < list.count && good(c); ++i) {
    int length;
    read_name(c, &length);
    lengths[i] = read_count(c);
    if (lengths[i] != 0)
      continue;
    if (list.record != NO_RECORD_DIMENSION)
      c->damaged = true;
    list.record = i;
  }
  return list;
}

/* False on overflow of the product of lengths. */
static bool read_extent(cursor *c, const dimension_list *dimensions,
                        const uint64_t *lengths, variable_extent *out)
{
  const uint64_t rank = read_count(c);
  if (rank > LARGEST_RANK)
    c->damaged = c->damaged || !c->ended;
  uint64_t elements = 1;
  bool fits = true;
  out->by_record = false;
  for (uint64_t k = 0; k < rank && good(c); ++k) {
    const uint64_t id = read_count(c);
    if (!good(c))
      return true;
    if (id >= dimensions->count || (id == dimensions->record && k > 0)) {
      c->damaged = true;
      return true;
    }
    if (id == dimensions->record) {
      out->by_record = true;
      continue;
    }
    fits = fits && elements <= UINT64_MAX / lengths[id];
    elements = fits ? elements * lengths[id] : 0;
  }
  skip_attributes(c);
  const uint64_t size = type_size(read_tag(c), c->version);
  read_count(c); /* vsize is too small for large variables, so it is ignored */
  out->begin = read_big_endian(c, c->version == 1 ? 4 : 8);
  if (good(c) && size == 0)
    c->damaged = true;
  if (!good(c))
    return true;
  fits = fits && elements <= UINT64_MAX / size;
  out->bytes = fits ? elements * size : 0;
  return fits;
}

/* a * b + c, UINT64_MAX when that overflows */
static uint64_t multiply_add(uint64_t a, uint64_t b, uint64_t c)
{
  if (b != 0 && a > (UINT64_MAX - c) / b)
    return UINT64_MAX;
  return a * b + c;
}

static fg_status fail_damaged(fg_context *context, const fg__source *source,
                              const cursor *c)
{
  if (c->ended)
    return fg__fail(context, FG_STATUS_FILE_FORMAT,
                    "%s: truncated: its header goes on beyond the %zu bytes of the file",
                    source->path, source->size);
  return fg__fail(context, FG_STATUS_FILE_FORMAT,
                  "%s: damaged NetCDF header before byte %" PRIu64, source->path, c->at);
}

typedef struct record_layout {
  uint64_t bytes;     /* from one record to the next */
  uint64_t variables; /* with a record dimension */
  uint64_t only;      /* size of the only one, which has no padding */
} record_layout;

static void add_to_records(record_layout *records, const variable_extent *extent)
{
  const uint64_t padding = (4 - extent->bytes % 4) % 4;
  records->bytes = multiply_add(1, records->bytes, extent->bytes);
  records->bytes = multiply_add(1, records->bytes, padding);
  records->only = extent->bytes;
  ++records->variables;
}

/* libnetcdf moves data by blocks when a header grows, and leaves old bytes in the
 * last. */
static bool is_zero(const unsigned char *bytes, size_t size)
{
  for (size_t i = 0; i < size; ++i)
    if (bytes[i])
      return false;
  return true;
}

/* Data beyond the last variable mean that the header is wrong, except for padding, and
 * for whole records of a file that was not closed. end: of the last variable. */
static fg_status check_rest(fg_context *context, const fg__source *source,
                            const record_layout *records, uint64_t end)
{
  const uint64_t step = records->variables == 1 ? records->only : records->bytes;
  const uint64_t rest = end > 0 && end < source->size ? source->size - end : 0;
  const uint64_t padding = (4 - end % 4) % 4;
  if (rest < 4 || (step > 0 && (rest % step < 4 || step - rest % step < 4)) ||
      is_zero(source->bytes + end + padding, (size_t)(rest - padding)))
    return FG_STATUS_OK;
  fg_status status = fg__fail(context, FG_STATUS_FILE_FORMAT,
                              "%s: damaged: its data end at byte %" PRIu64
                              " by the header, the file has %zu bytes",
                              source->path, end, source->size);
  fg__hint(context, "where bytes were added in the middle, values are not where they "
                    "should be; if they were at the end, nccopy leaves them out");
  return status;
}

/* Two passes over the variables: the size of a record is known after the first. */
static fg_status check_variables(fg_context *context, const fg__source *source, cursor *c,
                                 const dimension_list *dimensions,
                                 const uint64_t *lengths, uint64_t record_count)
{
  const uint64_t count = read_list(c, TAG_VARIABLE, 20);
  const uint64_t start = c->at;
  uint64_t header_end = start, data_end = 0;
  record_layout records = {0};
  for (int pass = 0; pass < 2; ++pass) {
    c->at = start;
    for (uint64_t i = 0; i < count && good(c); ++i) {
      variable_extent extent = {0};
      int length;
      const char *name = read_name(c, &length);
      const bool fits = read_extent(c, dimensions, lengths, &extent);
      if (!good(c))
        break;
      if (!fits)
        return fg__fail(
            context, FG_STATUS_FILE_FORMAT,
            "%s: damaged: the dimensions of '%.*s' multiply to more than 2^64 "
            "bytes",
            source->path, length, name);
      if (pass == 0) {
        if (extent.by_record)
          add_to_records(&records, &extent);
        continue;
      }
      if (extent.bytes == 0 || (extent.by_record && record_count == 0))
        continue;
      const uint64_t step = records.variables == 1 ? records.only : records.bytes;
      const uint64_t first_end = multiply_add(1, extent.begin, extent.bytes);
      const uint64_t end = extent.by_record && first_end != UINT64_MAX
                               ? multiply_add(record_count - 1, step, first_end)
                               : first_end;
      if (extent.begin < header_end) {
        c->damaged = true;
        break;
      }
      if (end > source->size)
        return fg__fail(context, FG_STATUS_FILE_FORMAT,
                        "%s: truncated: '%.*s' ends at byte %" PRIu64
                        ", the file has %zu bytes",
                        source->path, length, name, end, source->size);
      data_end = end > data_end ? end : data_end;
    }
    if (!good(c))
      return fail_damaged(context, source, c);
    header_end = c->at;
  }
  return check_rest(context, source, &records, data_end);
}

static fg_status check_classic(fg_context *context, const fg__source *source)
{
  cursor c = {.bytes = source->bytes, .size = source->size, .at = 4};
  c.version = source->bytes[3];
  const uint64_t record_count = read_count(&c);
  if (good(&c) && record_count == (c.version == 5 ? UINT64_MAX : UINT32_MAX))
    return fg__fail(context, FG_STATUS_UNSUPPORTED,
                    "%s: a NetCDF stream that does not say how many records it holds",
                    source->path);
  uint64_t lengths[LARGEST_RANK];
  const dimension_list dimensions = read_dimensions(&c, lengths, LARGEST_RANK);
  skip_attributes(&c);
  if (!good(&c))
    return fail_damaged(context, source, &c);
  return check_variables(context, source, &c, &dimensions, lengths, record_count);
}

/* The superblock of HDF5 has the end of the file ("HDF5 File Format Specification" 3.0,
 * II.A). Unusual layouts of the superblock are left to the library. */
static fg_status check_hdf5(fg_context *context, const fg__source *source)
{
  enum { LEAST = 48 };
  if (source->size < LEAST)
    return fg__fail(context, FG_STATUS_FILE_FORMAT,
                    "%s: truncated: %zu bytes are too few for NetCDF-4", source->path,
                    source->size);
  const unsigned char *b = source->bytes;
  const int version = b[8];
  const int width = version < 2 ? b[13] : b[9];
  const size_t base_at = version == 0 ? 24 : version == 1 ? 28 : 12;
  if (version > 3 || width != 8 || base_at + 24 > source->size)
    return FG_STATUS_OK;
  uint64_t base = 0;
  uint64_t end = 0;
  for (unsigned i = 0; i < 8; ++i) {
    base |= (uint64_t)b[base_at + i] << (8 * i);
    end |= (uint64_t)b[base_at + 16 + i] << (8 * i);
  }
  end = multiply_add(1, base, end);
  if (end > source->size)
    return fg__fail(context, FG_STATUS_FILE_FORMAT,
                    "%s: truncated: its header promises %" PRIu64
                    " bytes, the file has %zu",
                    source->path, end, source->size);
  return FG_STATUS_OK;
}

fg_status fg__nc_check_size(fg_context *context, const fg__source *source)
{
  if (fg__nc_kind_of(source->bytes, source->size) == FG__NC_HDF5)
    return check_hdf5(context, source);
  return check_classic(context, source);
}
