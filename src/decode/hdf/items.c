/* DataItems of XDMF: numbers in the markup, in HDF5 or as bytes of a file, parts of
 * others, and several side by side. */
#include <limits.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "base/memory.h"
#include "decode/hdf/xdmf.h"

enum { MOST_DEPTH = 8, MOST_JOINED = 9 };

static fg_status fail(fg__vtk *vtk, const xmlNode *node, fg_status status,
                      const char *what, const char *word)
{
  return fg__fail(vtk->context, status, "%s: line %ld: a DataItem %s \"%.200s\"",
                  vtk->path, xmlGetLineNo(node), what, word);
}

typedef enum item_kind { IN_MARKUP, IN_HDF5, AS_BYTES, PART, JOINED } item_kind;

static fg_status find_kind(item_kind *out, fg__vtk *vtk, const xmlNode *item)
{
  char kind[FG__XDMF_WORD], format[FG__XDMF_WORD], function[FG__XDMF_WORD];
  fg__xdmf_word(kind, vtk, item, "ItemType", "Type", "Uniform");
  fg__xdmf_word(format, vtk, item, "Format", NULL, "XML");
  fg__xdmf_word(function, vtk, item, "Function", NULL, "");
  if (strcasecmp(kind, "HyperSlab") == 0)
    *out = PART;
  else if (strcasecmp(kind, "Function") == 0 && strncasecmp(function, "JOIN", 4) == 0)
    *out = JOINED;
  else if (strcasecmp(kind, "Uniform") != 0)
    return fail(vtk, item, FG_STATUS_UNSUPPORTED,
                "of a kind that cannot be read:", function[0] ? function : kind);
  else if (strcasecmp(format, "XML") == 0)
    *out = IN_MARKUP;
  else if (strncasecmp(format, "HDF", 3) == 0 || strcasecmp(format, "H5") == 0)
    *out = IN_HDF5;
  else if (strcasecmp(format, "Binary") == 0)
    *out = AS_BYTES;
  else
    return fail(vtk, item, FG_STATUS_UNSUPPORTED,
                "in a format that cannot be read:", format);
  return FG_STATUS_OK;
}

/* The variable of "file.h5:/group/name". */
static fg_status find_variable(const fg__variable **out, fg__vtk *vtk,
                               const xmlNode *item)
{
  char *text = fg__vtk_content(vtk, item);
  if (!text)
    return FG_STATUS_MEMORY;
  char *colon = strrchr(text, ':');
  fg__hdf_file *file = NULL;
  fg_status status =
      colon ? FG_STATUS_OK
            : fail(vtk, item, FG_STATUS_FILE_FORMAT, "names no file:/array but", text);
  *out = NULL;
  if (colon) {
    *colon = '\0';
    status = fg__hdf_open(&file, vtk, text, NULL);
  }
  if (status == FG_STATUS_OK && !file->data.files)
    status =
        fg__fail(vtk->context, FG_STATUS_FILE_FORMAT, "%s: is no HDF5 file", file->path);
  if (status == FG_STATUS_OK)
    *out = fg__hdf_find(&file->data, colon + 1 + strspn(colon + 1, "/"));
  if (status == FG_STATUS_OK && !*out)
    status = fg__fail(vtk->context, FG_STATUS_FILE_FORMAT, "%s: has no array \"%.200s\"",
                      file->path, colon + 1);
  free(text);
  return status;
}

static bool multiply(size_t *out, const size_t *length, int count)
{
  double all = 1.0;
  for (int k = 0; k < count; ++k)
    all *= (double)length[k];
  *out = count > 0 && all <= 9e15 ? (size_t)all : 0;
  return count > 0 && all <= 9e15;
}

static fg__type type_of(fg__vtk *vtk, const xmlNode *item)
{
  static const struct {
    const char *name;
    int bytes;      /* where no precision is said; 0: of no other */
    fg__type of[4]; /* of 1, 2, 4 and 8 bytes */
  } types[] = {
      {"Float", 4, {FG__TYPE_OTHER, FG__TYPE_OTHER, FG__TYPE_FLOAT32, FG__TYPE_FLOAT64}},
      {"Int", 4, {FG__TYPE_INT8, FG__TYPE_INT16, FG__TYPE_INT32, FG__TYPE_INT64}},
      {"UInt", 4, {FG__TYPE_UINT8, FG__TYPE_UINT16, FG__TYPE_UINT32, FG__TYPE_UINT64}},
      {"Char", 1, {FG__TYPE_INT8, FG__TYPE_OTHER, FG__TYPE_OTHER, FG__TYPE_OTHER}},
      {"UChar", 1, {FG__TYPE_UINT8, FG__TYPE_OTHER, FG__TYPE_OTHER, FG__TYPE_OTHER}},
      {"Short", 2, {FG__TYPE_OTHER, FG__TYPE_INT16, FG__TYPE_OTHER, FG__TYPE_OTHER}},
      {"UShort", 2, {FG__TYPE_OTHER, FG__TYPE_UINT16, FG__TYPE_OTHER, FG__TYPE_OTHER}}};
  char name[FG__XDMF_WORD];
  size_t bytes = 0;
  fg__xdmf_word(name, vtk, item, "NumberType", "DataType", "Float");
  for (size_t n = 0; n < sizeof types / sizeof *types; ++n)
    if (strcasecmp(name, types[n].name) == 0) {
      if (fg__xdmf_lengths(&bytes, 1, vtk, item, "Precision") != 1)
        bytes = (size_t)types[n].bytes;
      for (int k = 0; k < 4; ++k)
        if (bytes == (size_t)1 << k)
          return types[n].of[k];
    }
  return FG__TYPE_OTHER;
}

/* Opens the file of an item's bytes, which must have `count` numbers where it says. */
static fg_status find_bytes(const unsigned char **out, fg__vtk *vtk, const xmlNode *item,
                            size_t count)
{
  size_t seek = 0;
  fg__hdf_file *file;
  const size_t bytes = count * fg__type_bytes(type_of(vtk, item));
  char *name = fg__vtk_content(vtk, item);
  if (!name)
    return FG_STATUS_MEMORY;
  const fg_status status = fg__hdf_open(&file, vtk, name, NULL);
  free(name);
  if (status != FG_STATUS_OK)
    return status;
  fg__xdmf_lengths(&seek, 1, vtk, item, "Seek");
  if (type_of(vtk, item) == FG__TYPE_OTHER || seek > file->source.size ||
      bytes > file->source.size - seek)
    return fg__fail(vtk->context, FG_STATUS_FILE_FORMAT,
                    "%s: line %ld: %zu bytes from %zu on, of %s with %zu bytes",
                    vtk->path, xmlGetLineNo(item), bytes, seek, file->path,
                    file->source.size);
  *out = file->source.bytes + seek;
  return FG_STATUS_OK;
}

/* Whether an item states as many sides longer than 1 as an array has, and other ones. */
static bool has_other_sides(const size_t *length, int rank, const fg__variable *v)
{
  size_t stated[FG__RANK] = {0}, own[FG__RANK] = {0};
  int sides[2] = {0, 0};
  for (int k = 0; k < rank; ++k)
    if (length[k] > 1)
      stated[sides[0]++] = length[k];
  for (int k = 0; k < v->rank; ++k)
    if (v->owner->dimensions[v->dimension[k]].length > 1)
      own[sides[1]++] = v->owner->dimensions[v->dimension[k]].length;
  return sides[0] == sides[1] && memcmp(stated, own, (size_t)sides[0] * sizeof *own) != 0;
}

/* Compares what an item says with the file that it names. */
static fg_status count_in_file(size_t *out, fg__vtk *vtk, const xmlNode *item, bool said,
                               const size_t *length, int rank)
{
  const fg__variable *v;
  size_t there = 0;
  fg_status status = find_variable(&v, vtk, item);
  if (status == FG_STATUS_OK)
    status = fg__hdf_count(&there, v);
  if (status == FG_STATUS_OK && said && *out != there)
    status = fg__fail(vtk->context, FG_STATUS_FILE_FORMAT,
                      "%s: line %ld: Dimensions of %zu numbers, but '%.100s' of %s has "
                      "%zu",
                      vtk->path, xmlGetLineNo(item), *out, v->name, v->path, there);
  if (status == FG_STATUS_OK && said && has_other_sides(length, rank, v))
    status = fg__fail(vtk->context, FG_STATUS_FILE_FORMAT,
                      "%s: line %ld: Dimensions other than those of '%.100s' of %s",
                      vtk->path, xmlGetLineNo(item), v->name, v->path);
  *out = there;
  return status;
}

static fg_status count_item(size_t *out, fg__vtk *vtk, const xmlNode *item, int depth)
{
  size_t length[FG__RANK], some;
  const unsigned char *bytes;
  const xmlNode *of = NULL;
  item_kind kind = IN_MARKUP;
  fg_status status = find_kind(&kind, vtk, item);
  const int rank = fg__xdmf_lengths(length, FG__RANK, vtk, item, "Dimensions");
  const bool said = multiply(out, length, rank);
  if (status == FG_STATUS_OK && depth > MOST_DEPTH)
    status = fail(vtk, item, FG_STATUS_UNSUPPORTED, "too deep in others:", "");
  if (status == FG_STATUS_OK && !said && kind != IN_HDF5)
    status = fail(vtk, item, FG_STATUS_FILE_FORMAT, "without good Dimensions, but", "");
  if (status != FG_STATUS_OK)
    return status;
  if (kind == IN_HDF5)
    return count_in_file(out, vtk, item, said, length, rank);
  if (kind == AS_BYTES)
    return find_bytes(&bytes, vtk, item, *out);
  for (int k = 0; kind != IN_MARKUP && status == FG_STATUS_OK; ++k) {
    status = fg__xdmf_child(&of, vtk, item, "DataItem", k);
    if (status != FG_STATUS_OK || !of)
      break;
    status = count_item(&some, vtk, of, depth + 1);
  }
  return status;
}

/* Counts an item's numbers, of all that it consists of; those are there. */
static fg_status count_numbers(size_t *out, fg__vtk *vtk, const xmlNode *item)
{
  return count_item(out, vtk, item, 0);
}

/* Reads numbers of an array that is made for it. */
static fg_status read_array(double *out, const fg__vtk *vtk, fg__vtk_array *array,
                            size_t count)
{
  array->name = (char[]){"of a DataItem"};
  array->components = 1;
  return fg__vtk_read_numbers(out, vtk, array, count);
}

static fg_status read_markup(double *out, fg__vtk *vtk, const xmlNode *item, size_t count)
{
  char *text = fg__vtk_content(vtk, item);
  if (!text)
    return FG_STATUS_MEMORY;
  fg__vtk_array array = {.type = FG__TYPE_FLOAT64,
                         .storage = FG__VTK_ASCII,
                         .text = text,
                         .text_size = strlen(text)};
  const fg_status status = read_array(out, vtk, &array, count);
  free(text);
  return status;
}

static fg_status read_bytes(double *out, fg__vtk *vtk, const xmlNode *item, size_t count)
{
  char order[FG__XDMF_WORD], packed[FG__XDMF_WORD];
  const unsigned char *bytes;
  fg__vtk ordered = *vtk;
  fg__vtk_array array = {.type = type_of(vtk, item), .storage = FG__VTK_RAW};
  fg__xdmf_word(order, vtk, item, "Endian", NULL, "Native");
  fg__xdmf_word(packed, vtk, item, "Compression", NULL, "Raw");
  if (strcasecmp(packed, "Raw") != 0)
    return fail(vtk, item, FG_STATUS_UNSUPPORTED, "that is compressed by", packed);
  const fg_status status = find_bytes(&bytes, vtk, item, count);
  if (status != FG_STATUS_OK)
    return status;
  ordered.swap = strcasecmp(order, fg__is_little_endian() ? "Big" : "Little") == 0;
  array.text = (const char *)bytes;
  array.text_size = count * fg__type_bytes(array.type);
  return read_array(out, &ordered, &array, count);
}

/* Which indices a part has: first, step, count along each dimension. */
typedef struct selection {
  int rank;
  size_t first[FG__RANK], step[FG__RANK], count[FG__RANK];
  size_t length[FG__RANK]; /* of what it is a part of */
} selection;

static fg_status read_selection(selection *out, fg__vtk *vtk, const xmlNode *item,
                                const xmlNode *of, size_t count)
{
  const xmlNode *numbers = NULL;
  double *number = NULL;
  size_t some = 0, all = 1;
  out->rank = fg__xdmf_lengths(out->length, FG__RANK, vtk, of, "Dimensions");
  fg_status status = fg__xdmf_child(&numbers, vtk, item, "DataItem", 0);
  if (status == FG_STATUS_OK)
    status = fg__xdmf_create(&number, &some, vtk, numbers);
  bool good = status == FG_STATUS_OK && out->rank > 0 && some == 3 * (size_t)out->rank;
  for (int k = 0; k < out->rank && good; ++k) {
    const double first = number[k], step = number[out->rank + k],
                 wanted = number[2 * out->rank + k];
    good = first >= 0.0 && step >= 1.0 && wanted >= 1.0 &&
           first + (wanted - 1.0) * step + 1.0 <= (double)out->length[k];
    if (!good)
      break;
    out->first[k] = (size_t)first;
    out->step[k] = (size_t)step;
    out->count[k] = (size_t)wanted;
    all *= out->count[k];
  }
  free(number);
  if (status != FG_STATUS_OK || (good && all == count))
    return status;
  return fail(
      vtk, item, FG_STATUS_FILE_FORMAT,
      "whose part is not within the array, or not of its Dimensions:", "HyperSlab");
}

/* Reads the box that a part lies in, and takes every step-th number of it. */
static fg_status read_box(double *out, fg__vtk *vtk, const selection *s,
                          const fg__variable *v, const double *whole, size_t count)
{
  size_t span[FG__RANK], all = 1;
  double *box = NULL;
  for (int k = 0; k < s->rank; ++k) {
    span[k] = v ? (s->count[k] - 1) * s->step[k] + 1 : s->length[k];
    all *= span[k];
  }
  if (v) {
    box = fg__allocate(all, sizeof *box);
    if (!box)
      return fg__fail_memory(vtk->context, "a part of an array", all * sizeof *box);
    const fg_status status = fg__variable_fetch(v, s->first, span, box);
    if (status != FG_STATUS_OK) {
      free(box);
      return status;
    }
    whole = box;
  }
  for (size_t n = 0; n < count; ++n) {
    size_t rest = n, at = 0, stride = 1;
    for (int k = s->rank; k-- > 0; rest /= s->count[k]) {
      at += stride * (rest % s->count[k] * s->step[k] + (v ? 0 : s->first[k]));
      stride *= span[k];
    }
    out[n] = whole[at];
  }
  free(box);
  return FG_STATUS_OK;
}

static fg_status read_item(double *out, fg__vtk *vtk, const xmlNode *item, size_t count);

static fg_status read_part(double *out, fg__vtk *vtk, const xmlNode *item, size_t count)
{
  selection s = {.rank = 0};
  item_kind kind = IN_MARKUP;
  size_t all = 0;
  double *whole = NULL;
  const fg__variable *v = NULL;
  const xmlNode *of = NULL;
  fg_status status = fg__xdmf_child(&of, vtk, item, "DataItem", 1);
  if (status == FG_STATUS_OK && !of)
    status = fail(vtk, item, FG_STATUS_FILE_FORMAT, "without an array:", "HyperSlab");
  if (status == FG_STATUS_OK)
    status = find_kind(&kind, vtk, of);
  if (status == FG_STATUS_OK)
    status = count_numbers(&all, vtk, of);
  if (status == FG_STATUS_OK)
    status = read_selection(&s, vtk, item, of, count);
  if (status == FG_STATUS_OK && kind == IN_HDF5)
    status = find_variable(&v, vtk, of);
  if (v && v->rank != s.rank)
    v = NULL;
  if (status == FG_STATUS_OK && !v) {
    whole = fg__allocate(all, sizeof *whole);
    status = whole ? read_item(whole, vtk, of, all)
                   : fg__fail_memory(vtk->context, "an array", all * sizeof *whole);
  }
  if (status == FG_STATUS_OK)
    status = read_box(out, vtk, &s, v, whole, count);
  free(whole);
  return status;
}

/* JOIN($0, $1, ...): the numbers of each side by side. */
static fg_status read_joined(double *out, fg__vtk *vtk, const xmlNode *item, size_t count)
{
  const xmlNode *of[MOST_JOINED + 1] = {NULL};
  char function[FG__XDMF_WORD], known[FG__XDMF_WORD] = "JOIN(";
  size_t joined = 0, each = 0, used = strlen(known), kept = 0;
  fg_status status = FG_STATUS_OK;
  do
    status = fg__xdmf_child(&of[joined], vtk, item, "DataItem", (int)joined);
  while (status == FG_STATUS_OK && of[joined] && ++joined <= MOST_JOINED);
  for (size_t k = 0; k < joined && k < MOST_JOINED; ++k)
    used += (size_t)snprintf(known + used, sizeof known - used, "$%zu%s", k,
                             k + 1 < joined ? "," : ")");
  fg__xdmf_word(function, vtk, item, "Function", NULL, "");
  for (const char *at = function; *at; ++at)
    if (*at != ' ')
      function[kept++] = *at;
  function[kept] = '\0';
  if (status == FG_STATUS_OK && (joined == 0 || joined > MOST_JOINED ||
                                 strcasecmp(function, known) != 0 || count % joined != 0))
    status = fail(vtk, item, FG_STATUS_UNSUPPORTED,
                  "whose function cannot be read:", function);
  if (status != FG_STATUS_OK)
    return status;
  double *one = fg__allocate(count / joined, sizeof *one);
  if (!one)
    return fg__fail_memory(vtk->context, "an array", count * sizeof *one);
  for (size_t k = 0; k < joined && status == FG_STATUS_OK; ++k) {
    status = count_numbers(&each, vtk, of[k]);
    if (status == FG_STATUS_OK && each != count / joined)
      status = fail(vtk, of[k], FG_STATUS_FILE_FORMAT,
                    "of another length than its share in", function);
    if (status == FG_STATUS_OK)
      status = read_item(one, vtk, of[k], each);
    for (size_t n = 0; n < each && status == FG_STATUS_OK; ++n)
      out[n * joined + k] = one[n];
  }
  free(one);
  return status;
}

/* Of an item that was counted, which is then not too deep. */
static fg_status read_item(double *out, fg__vtk *vtk, const xmlNode *item, size_t count)
{
  const fg__variable *v;
  item_kind kind = IN_MARKUP;
  fg_status status = find_kind(&kind, vtk, item);
  if (status != FG_STATUS_OK)
    return status;
  switch (kind) {
  case IN_HDF5:
    status = find_variable(&v, vtk, item);
    return status == FG_STATUS_OK ? fg__hdf_read(out, v, 0, count) : status;
  case AS_BYTES:
    return read_bytes(out, vtk, item, count);
  case PART:
    return read_part(out, vtk, item, count);
  case JOINED:
    return read_joined(out, vtk, item, count);
  default:
    return read_markup(out, vtk, item, count);
  }
}

fg_status fg__xdmf_create(double **out, size_t *count, fg__vtk *vtk, const xmlNode *item)
{
  fg__hdf *hdf = vtk->held;
  *out = NULL;
  *count = 0;
  if (!item)
    return fg__fail(vtk->context, FG_STATUS_FILE_FORMAT,
                    "%s: a grid lacks a DataItem of its mesh", vtk->path);
  fg_status status = count_numbers(count, vtk, item);
  if (status == FG_STATUS_OK && (double)*count > hdf->room)
    status = fg__fail(vtk->context, FG_STATUS_FILE_FORMAT,
                      "%s: line %ld: %zu numbers are more than its files can hold",
                      vtk->path, xmlGetLineNo(item), *count);
  if (status != FG_STATUS_OK)
    return status;
  hdf->room -= (double)*count;
  *out = fg__allocate(*count, sizeof **out);
  status = *out ? read_item(*out, vtk, item, *count)
                : fg__fail_memory(vtk->context, "an array", *count * sizeof **out);
  if (status != FG_STATUS_OK) {
    free(*out);
    *out = NULL;
  }
  return status;
}

/* Of an array that is read whole. */
static fg_status read_later(double *out, const fg__vtk *vtk, const fg__vtk_array *array,
                            size_t first, size_t count)
{
  (void)first; /* 0 */
  return read_item(out, (fg__vtk *)(uintptr_t)vtk, array->item, count);
}

fg_status fg__xdmf_add_array(fg__vtk *vtk, const xmlNode *item, const char *name,
                             fg__vtk_place place, size_t tuples)
{
  const fg__variable *v;
  size_t count = 0;
  item_kind kind = IN_MARKUP;
  fg__vtk_array *array;
  fg_status status = find_kind(&kind, vtk, item);
  if (status == FG_STATUS_OK)
    status = count_numbers(&count, vtk, item);
  const fg__hdf *hdf = vtk->held;
  const size_t components = tuples > 0 ? count / tuples : 0;
  if (status == FG_STATUS_OK &&
      (components == 0 || components > INT_MAX || components * tuples != count ||
       (double)count > hdf->room))
    status = fg__fail(vtk->context, FG_STATUS_FILE_FORMAT,
                      "%s: attribute \"%.100s\" has %zu numbers for %zu %s", vtk->path,
                      name, count, tuples, place == FG__VTK_POINTS ? "points" : "cells");
  if (status == FG_STATUS_OK && kind == IN_HDF5) {
    status = find_variable(&v, vtk, item);
    return status == FG_STATUS_OK
               ? fg__hdf_add_array(vtk, v, name, place, (int)components, 0)
               : status;
  }
  if (status == FG_STATUS_OK)
    status = fg__vtk_add_array(&array, vtk, name, place);
  if (status != FG_STATUS_OK)
    return status;
  array->type = FG__TYPE_FLOAT64;
  array->components = (int)components;
  array->storage = FG__VTK_HELD;
  array->item = item;
  array->text_size = count;
  array->read = read_later;
  array->is_read_whole = true;
  return FG_STATUS_OK;
}
