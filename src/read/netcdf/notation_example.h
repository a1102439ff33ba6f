/* NetCDF files in a short notation, for tables of tests.
 *
 * Statements of the notation end with ';':
 *   lat[3] :units=degrees_north = -10 5 30    a dimension, and its coordinates if any
 *   time[*2]                                  an unlimited dimension with 2 records
 *   float u(lat,lon) :units=m/s = 1 2 3       a variable (double unless it says so)
 *   char label(member,letters) = one & two    texts, of strings, too, which are padded
 *   ocean/u(lat,lon)                          a variable of a group
 *   :title=all of it                          an attribute of the file
 *   u() :a=#-5 5 :_FillValue=@-9             attributes: numbers, or of the variable's
 * type u(lat,lon) :_Chunks=#2 2                  sizes of chunks Numbers are repeated
 * until the variable is full: a:b:step is a range, 7*3 is 7 7 7, and _ the default fill
 * value. `~ 1 lon 2 lat 0.5`, alone or after numbers, adds 1, and 2 and 0.5 for each
 * index along lon and lat. */
#ifndef FG__NETCDF_NOTATION_EXAMPLE_H
#define FG__NETCDF_NOTATION_EXAMPLE_H

#include <math.h>

#include "read/netcdf/sample_example.h"

enum { MOST_DIMENSIONS = 32, MOST_RANK = 8, TEXT_BYTES = 65536, MOST_NUMBERS = 4096 };

/* A file while it is written: the lengths of its dimensions by their ids. */
typedef struct notation {
  sample_file *file;
  size_t length[MOST_DIMENSIONS];
} notation;

/* Ends the text at the next part that begins with " :", " = " or " ~ "; returns that. */
static inline char *notation_part(char *text)
{
  for (char *c = text; *c; ++c)
    if (*c == ' ' && (c[1] == ':' || (c[1] && strchr("=~", c[1]) && c[2] == ' '))) {
      *c = '\0';
      return c + 1;
    }
  return text + strlen(text);
}

static inline nc_type notation_type(char **name)
{
  static const struct {
    const char *name;
    nc_type type;
  } types[] = {{"float ", NC_FLOAT}, {"int ", NC_INT},   {"byte ", NC_BYTE},
               {"short ", NC_SHORT}, {"char ", NC_CHAR}, {"string ", NC_STRING}};
  for (size_t n = 0; n < sizeof types / sizeof *types; ++n)
    if (strncmp(*name, types[n].name, strlen(types[n].name)) == 0) {
      *name += strlen(types[n].name);
      return types[n].type;
    }
  return NC_DOUBLE;
}

static inline int notation_list(double *out, const char *text)
{
  int count = 0;
  while (*(text += strspn(text, " "))) {
    char *end;
    out[count++] = strtod(text, &end);
    if (*text == '_') {
      out[count - 1] = NC_FILL_DOUBLE;
      ++end;
    }
    if (*end == ':') {
      const double first = out[--count], last = strtod(end + 1, &end);
      const double step = strtod(end + 1, &end);
      const int steps = (int)lround((last - first) / step);
      for (int n = 0; n <= steps; ++n)
        out[count++] = first + step * n;
    }
    if (*end == '*')
      for (long n = strtol(end + 1, &end, 10); n > 1; --n, ++count)
        out[count] = out[count - 1];
    if (end == text || count >= MOST_NUMBERS)
      fail_msg("no numbers: %s", text);
    text = end;
  }
  return count;
}

/* A variable's number at the indices along `rank` dimensions, which have its own. */
static inline double notation_value(const sample_file *f, const char *name, int rank,
                                    const int *dimension, const size_t *index)
{
  int id, own, along[MOST_RANK];
  size_t at[MOST_RANK] = {0};
  double value;
  sample_write(f);
  nc_must(nc_inq_varid(f->id, name, &id));
  nc_must(nc_inq_varndims(f->id, id, &own));
  nc_must(nc_inq_vardimid(f->id, id, along));
  for (int k = 0; k < own; ++k)
    for (int n = 0; n < rank; ++n)
      at[k] = along[k] == dimension[n] ? index[n] : at[k];
  nc_must(nc_get_var1_double(f->id, id, at, &value));
  return value;
}

/* The number at a sample's indices by "1 lon 2 @lat 0.5". */
static inline double notation_linear(const sample_file *f, const char *text, int rank,
                                     const int *dimension, const size_t *index)
{
  char *end;
  double value = strtod(text, &end);
  while (*(end += strspn(end, " "))) {
    char name[NC_MAX_NAME + 1], own[NC_MAX_NAME + 1];
    snprintf(name, sizeof name, "%.*s", (int)strcspn(end, " "), end);
    const double step = strtod(end + strlen(name), &end);
    if (*name == '@')
      value += step * notation_value(f, name + 1, rank, dimension, index);
    for (int k = 0; k < rank; ++k) {
      nc_must(nc_inq_dimname(f->id, dimension[k], own));
      value += strcmp(name, own) == 0 ? step * (double)index[k] : 0.0;
    }
  }
  return value;
}

static inline void notation_numbers(const notation *n, int id, int rank,
                                    const int *dimension, const char *how)
{
  static double list[MOST_NUMBERS];
  size_t start[MOST_RANK] = {0}, length[MOST_RANK], all = 1;
  for (int k = 0; k < rank; ++k)
    all *= length[k] = n->length[dimension[k]];
  const char *const linear = strchr(how, '~');
  char numbers[TEXT_BYTES];
  snprintf(numbers, sizeof numbers, "%.*s", linear ? (int)(linear - how) : TEXT_BYTES - 1,
           how);
  const int count = *how == '=' ? notation_list(list, numbers + 1) : 0;
  double *values = calloc(all, sizeof *values);
  assert_non_null(values);
  for (size_t i = 0; i < all; ++i) {
    size_t index[MOST_RANK], rest = i;
    for (int k = rank - 1; k >= 0; --k) {
      index[k] = rest % length[k];
      rest /= length[k];
    }
    values[i] = count ? list[i % (size_t)count] : 0.0;
    if (linear)
      values[i] += notation_linear(n->file, linear + 1, rank, dimension, index);
  }
  sample_write(n->file);
  nc_must(nc_put_vara_double(n->file->id, id, start, length, values));
  free(values);
}

/* Texts with " & " between them, of a variable of strings or of letters. */
static inline void notation_texts(const notation *n, int id, nc_type type, int rank,
                                  const int *dimension, char *texts)
{
  size_t at[MOST_RANK] = {0}, one[MOST_RANK] = {1, 1};
  const size_t letters = type == NC_CHAR ? n->length[dimension[rank - 1]] : 0;
  one[rank - 1] = letters ? letters : 1;
  sample_write(n->file);
  for (char *next; texts; texts = next, ++at[0]) {
    char padded[256];
    next = strstr(texts, " & ");
    if (next) {
      *next = '\0';
      next += 3;
    }
    snprintf(padded, sizeof padded, "%-*s", (int)letters, texts);
    nc_must(letters
                ? nc_put_vara_text(n->file->id, id, at, one, padded)
                : nc_put_vara_string(n->file->id, id, at, one, (const char *[]){padded}));
  }
}

static inline void notation_attribute(const sample_file *f, int id, const char *name,
                                      const char *numbers)
{
  double list[MOST_RANK];
  size_t chunk[MOST_RANK];
  nc_type type = NC_DOUBLE;
  const int count = notation_list(list, numbers + 1);
  sample_define(f);
  if (*numbers == '@')
    nc_must(nc_inq_vartype(f->id, id, &type));
  for (int k = 0; k < count; ++k)
    chunk[k] = (size_t)list[k];
  if (strcmp(name, "_Chunks") == 0)
    nc_must(nc_def_var_chunking(f->id, id, NC_CHUNKED, chunk));
  else
    nc_must(nc_put_att_double(f->id, id, name, type, (size_t)count, list));
}

/* Attributes and numbers of a variable, from the first part of its statement on. */
static inline void notation_rest(const notation *n, int id, int rank,
                                 const int *dimension, char *part)
{
  while (*part == ':') {
    char *const next = notation_part(part + 1), *const value = strchr(part, '=') + 1;
    value[-1] = '\0';
    if (*value == '#' || *value == '@')
      notation_attribute(n->file, id, part + 1, value);
    else
      sample_text(n->file, id, part + 1, value);
    part = next;
  }
  nc_type type;
  if (!*part)
    return;
  nc_must(nc_inq_vartype(n->file->id, id, &type));
  if (type == NC_CHAR || type == NC_STRING)
    notation_texts(n, id, type, rank, dimension, part + 2);
  else
    notation_numbers(n, id, rank, dimension, part);
}

static inline void notation_statement(notation *n, char *text)
{
  int dimension[MOST_RANK], rank = 0;
  if (*text == ':') {
    notation_rest(n, NC_GLOBAL, 0, dimension, text);
    return;
  }
  char *const rest = notation_part(text);
  const nc_type type = notation_type(&text);
  char *const length = strchr(text, '['), *name = strchr(text, '(');
  if (length) {
    const bool unlimited = length[1] == '*';
    *length = '\0';
    const size_t samples = strtoul(length + 1 + unlimited, NULL, 10);
    dimension[rank++] =
        sample_dimension(n->file, text, unlimited ? NC_UNLIMITED : samples);
    n->length[dimension[0]] = samples;
    if (!*rest)
      return;
  } else {
    *name++ = '\0';
    for (name = strtok(name, ",)"); name; name = strtok(NULL, ",)"))
      nc_must(nc_inq_dimid(n->file->id, name, &dimension[rank++]));
  }
  notation in = *n;
  sample_file group = *n->file;
  char *const slash = strchr(text, '/');
  if (slash) {
    *slash = '\0';
    if (nc_inq_grp_ncid(group.id, text, &group.id))
      nc_must(nc_def_grp(group.id, text, &group.id));
    in.file = &group;
    text = slash + 1;
  }
  const int id = sample_variable(in.file, text, type, rank, dimension);
  notation_rest(&in, id, rank, dimension, rest);
}

static inline void notation_write(sample_file *f, const char *text, int mode)
{
  notation n = {.file = f};
  char statement[TEXT_BYTES];
  sample_begin(f, mode);
  while (*(text += strspn(text, " "))) {
    const size_t bytes = strcspn(text, ";");
    snprintf(statement, sizeof statement, "%.*s", (int)bytes, text);
    notation_statement(&n, statement);
    text += bytes + (text[bytes] == ';');
  }
  sample_end(f);
}

#endif
