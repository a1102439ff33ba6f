/* The header of a .npy file (NumPy Enhancement Proposal 1): a Python dictionary of
 * literals, {'descr': '<f8', 'fortran_order': False, 'shape': (2, 3), }. */
#include <string.h>

#include "decode/numpy/numpy.h"

enum { PREFIX = 10, LONG_PREFIX = 12, LONGEST = 1 << 16, WORD = 16 };

static const char MAGIC[] = "\x93NUMPY";

bool fg__is_npy(const unsigned char *bytes, size_t size)
{
  return size >= PREFIX && memcmp(bytes, MAGIC, 6) == 0;
}

typedef struct reader {
  const char *at, *end;
} reader;

static void skip_space(reader *r)
{
  while (r->at < r->end && (*r->at == ' ' || *r->at == '\n' || *r->at == '\t'))
    ++r->at;
}

static bool take(reader *r, char c)
{
  skip_space(r);
  if (r->at == r->end || *r->at != c)
    return false;
  ++r->at;
  return true;
}

/* A text in quotes of either kind, at most WORD - 1 bytes of it. */
static bool take_text(reader *r, char out[WORD])
{
  skip_space(r);
  if (r->at == r->end || (*r->at != '\'' && *r->at != '"'))
    return false;
  const char quote = *r->at++;
  size_t n = 0;
  for (; r->at < r->end && *r->at != quote; ++r->at)
    if (n + 1 < WORD)
      out[n++] = *r->at;
  out[n] = '\0';
  return take(r, quote);
}

static bool take_bool(reader *r, bool *out)
{
  static const char *const words[] = {"False", "True"};
  skip_space(r);
  for (int k = 0; k < 2; ++k) {
    const size_t length = strlen(words[k]);
    if ((size_t)(r->end - r->at) >= length && memcmp(r->at, words[k], length) == 0) {
      r->at += length;
      *out = k == 1;
      return true;
    }
  }
  return false;
}

static bool take_number(reader *r, size_t *out)
{
  skip_space(r);
  const char *start = r->at;
  *out = 0;
  for (; r->at < r->end && *r->at >= '0' && *r->at <= '9'; ++r->at) {
    if (*out > (SIZE_MAX - 9) / 10)
      return false;
    *out = 10 * *out + (size_t)(*r->at - '0');
  }
  return r->at > start;
}

/* (2, 3), (5,) or (); *rank counts on past the room there is. */
static bool take_shape(reader *r, size_t shape[FG__NPY_RANK], int *rank)
{
  *rank = 0;
  if (!take(r, '('))
    return false;
  while (!take(r, ')')) {
    size_t length;
    if (!take_number(r, &length))
      return false;
    if (*rank < FG__NPY_RANK)
      shape[*rank] = length;
    ++*rank;
    if (!take(r, ',') && (r->at == r->end || *r->at != ')'))
      return false;
  }
  return true;
}

/* "<f8": byte order, kind, bytes. */
static bool find_type(fg__npy_array *out, const char *descr)
{
  static const struct {
    const char *name;
    fg__type type;
    size_t item;
  } known[] = {{"f2", FG__TYPE_FLOAT32, 2}, {"f4", FG__TYPE_FLOAT32, 4},
               {"f8", FG__TYPE_FLOAT64, 8}, {"i1", FG__TYPE_INT8, 1},
               {"i2", FG__TYPE_INT16, 2},   {"i4", FG__TYPE_INT32, 4},
               {"i8", FG__TYPE_INT64, 8},   {"u1", FG__TYPE_UINT8, 1},
               {"u2", FG__TYPE_UINT16, 2},  {"u4", FG__TYPE_UINT32, 4},
               {"u8", FG__TYPE_UINT64, 8},  {"b1", FG__TYPE_UINT8, 1},
               {"c8", FG__TYPE_FLOAT32, 4}, {"c16", FG__TYPE_FLOAT64, 8}};
  const char order = *descr;
  if (!order || !strchr("<>|=", order))
    return false;
  out->swapped = order == (fg__is_little_endian() ? '>' : '<');
  for (size_t i = 0; i < sizeof known / sizeof *known; ++i)
    if (strcmp(known[i].name, descr + 1) == 0) {
      out->type = known[i].type;
      out->item = known[i].item;
      out->is_bool = descr[1] == 'b';
      out->is_complex = descr[1] == 'c';
      return true;
    }
  return false;
}

/* Axes of one sample are no axes; and how far apart in memory neighbours are. */
static void find_strides(fg__npy_array *a, bool fortran)
{
  int rank = 0;
  for (int k = 0; k < a->rank && k < FG__NPY_RANK; ++k)
    if (a->shape[k] != 1)
      a->shape[rank++] = a->shape[k];
  a->rank = rank;
  size_t step = a->is_complex ? 2 : 1;
  for (int n = 0; n < rank && n < FG__NPY_RANK; ++n) {
    const int k = fortran ? n : rank - 1 - n;
    a->stride[k] = step;
    step *= a->shape[k];
  }
}

/* Finds where the dictionary lies; false where it is not all there. */
static bool find_dictionary(reader *out, size_t *header, const unsigned char *bytes,
                            size_t size)
{
  const size_t prefix = size >= PREFIX && bytes[6] >= 2 ? LONG_PREFIX : PREFIX;
  if (size < prefix || memcmp(bytes, MAGIC, 6) != 0)
    return false;
  size_t length = (size_t)bytes[8] | (size_t)bytes[9] << 8;
  if (prefix == LONG_PREFIX)
    length |= (size_t)bytes[10] << 16 | (size_t)bytes[11] << 24;
  if (length > LONGEST || length > size - prefix)
    return false;
  *header = prefix + length;
  *out = (reader){(const char *)bytes + prefix, (const char *)bytes + *header};
  return true;
}

typedef struct facts {
  char descr[WORD];
  bool structured, fortran;
} facts;

static bool read_dictionary(fg__npy_array *out, facts *f, reader *r)
{
  bool has_shape = false;
  if (!take(r, '{'))
    return false;
  while (!take(r, '}')) {
    char key[WORD];
    if (!take_text(r, key) || !take(r, ':'))
      return false;
    bool good = false;
    if (strcmp(key, "descr") == 0) {
      skip_space(r);
      f->structured = r->at < r->end && *r->at == '[';
      if (f->structured)
        return true;
      good = take_text(r, f->descr);
    } else if (strcmp(key, "fortran_order") == 0) {
      good = take_bool(r, &f->fortran);
    } else if (strcmp(key, "shape") == 0) {
      good = has_shape = take_shape(r, out->shape, &out->rank);
    }
    if (!good)
      return false;
    take(r, ',');
  }
  return has_shape && f->descr[0];
}

static fg_status check_size(const fg__npy_array *a, fg_context *context, const char *path,
                            size_t all)
{
  const size_t per = a->is_complex ? 2 * a->item : a->item;
  const size_t bytes = all > a->header ? all - a->header : 0, there = bytes / per;
  size_t room = there, count = 1;
  bool fits = true;
  for (int k = 0; k < a->rank && k < FG__NPY_RANK && fits; ++k) {
    if (a->shape[k] == 0)
      return fg__fail(context, FG_STATUS_FILE_FORMAT, "%s: array \"%s\" has no numbers",
                      path, a->name);
    fits = a->shape[k] <= room;
    room /= a->shape[k];
    count *= fits ? a->shape[k] : 1;
  }
  if (!fits || room == 0)
    return fg__fail(context, FG_STATUS_FILE_FORMAT,
                    "%s: array \"%s\" claims more numbers than the %zu that are there",
                    path, a->name, there);
  if (count * per != bytes)
    return fg__fail(context, FG_STATUS_FILE_FORMAT,
                    "%s: after the %zu numbers of array \"%s\" come %zu bytes more", path,
                    count, a->name, bytes - count * per);
  return FG_STATUS_OK;
}

fg_status fg__npy_header(fg__npy_array *out, fg_context *context, const char *path,
                         const unsigned char *bytes, size_t size, size_t all)
{
  reader r;
  facts f = {{0}, false, false};
  if (!find_dictionary(&r, &out->header, bytes, size) || !read_dictionary(out, &f, &r))
    return fg__fail(context, FG_STATUS_FILE_FORMAT,
                    "%s: array \"%s\" has a damaged header", path, out->name);
  if (f.structured || !find_type(out, f.descr))
    return fg__fail(context, FG_STATUS_UNSUPPORTED,
                    "%s: array \"%s\" has elements of type %.20s; only numbers can be "
                    "read",
                    path, out->name, f.structured ? "record" : f.descr);
  if (out->rank > FG__NPY_RANK)
    return fg__fail(context, FG_STATUS_UNSUPPORTED,
                    "%s: array \"%s\" has %d dimensions; at most %d can be read", path,
                    out->name, out->rank, FG__NPY_RANK);
  fg_status status = check_size(out, context, path, all);
  if (status == FG_STATUS_OK)
    find_strides(out, f.fortran);
  return status;
}
