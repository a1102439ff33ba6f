/* Situations of NetCDF files as rows of a table: what a file has, in a short notation,
 * the options, and what must be read, listed or refused.
 *
 * Statements of the notation end with ';':
 *   lat[3] :units=degrees_north = -10 5 30    a dimension, and its coordinates if any
 *   time[*2]                                  an unlimited dimension with 2 records
 *   float u(lat,lon) :units=m/s = 1 2 3       a variable (double unless it says so)
 *   :title=all of it                          an attribute of the file
 *   u(lat,lon) :a=#-5 5 :_FillValue=@-9 :_Chunks=#2 2    attributes: two numbers, one of
 * the variable's type; sizes of chunks Numbers are repeated until the variable is full:
 * a:b:step is a range, _ the default fill value. `~ 1 lon 2 lat 0.5` is 1 plus 2 and 0.5
 * for each index along lon and lat.
 *
 * What is expected is a list with '|' between its items. Each must stand in the message,
 * or in the text that describes the field or the inventory below, or with '!' not; "at X
 * Y[ Z] = U V[ W]" is the field's velocity at a place, "at X Y = none" says that it has
 * none. */
#ifndef FG__NETCDF_SITUATION_TEST_H
#define FG__NETCDF_SITUATION_TEST_H

#include <math.h>
#include <stdarg.h>

#include "flowgrain/inventory.h"
#include "read/netcdf/sample_example.h"

typedef struct situation {
  const char *what;
  const char *file, *second, *mesh; /* second and mesh: the options' further files */
  int mode;                         /* of nc_create */
  fg_read_options options;
  const char *field, *inventory;
  const char *refused, *hint; /* words of the message and the hint */
  fg_status status;           /* of a refusal; OK stands for UNSUPPORTED */
} situation;

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

/* The number at a sample's indices by "1 lon 2 lat 0.5". */
static inline double notation_linear(const sample_file *f, const char *text, int rank,
                                     const int *dimension, const size_t *index)
{
  char *end;
  double value = strtod(text, &end);
  while (*(end += strspn(end, " "))) {
    char name[NC_MAX_NAME + 1];
    const size_t bytes = strcspn(end, " ");
    const char *const begin = end;
    const double step = strtod(end + bytes, &end);
    for (int k = 0; k < rank; ++k) {
      nc_must(nc_inq_dimname(f->id, dimension[k], name));
      if (strlen(name) == bytes && strncmp(name, begin, bytes) == 0)
        value += step * (double)index[k];
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
  if (*part)
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
  const int id = sample_variable(n->file, text, type, rank, dimension);
  notation_rest(n, id, rank, dimension, rest);
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

/* A text that grows; what does not fit is cut. */
typedef struct text_of {
  size_t used;
  char text[TEXT_BYTES];
} text_of;

__attribute__((format(printf, 2, 3))) static inline void add_text(text_of *t,
                                                                  const char *format, ...)
{
  va_list list;
  va_start(list, format);
  const int bytes = vsnprintf(t->text + t->used, sizeof t->text - t->used, format, list);
  va_end(list);
  t->used += (size_t)bytes < sizeof t->text - t->used ? (size_t)bytes : 0;
}

static inline void add_line(text_of *t, const char *name, const char *value)
{
  if (value)
    add_text(t, "%s '%s'\n", name, value);
}

static inline void add_numbers(text_of *t, const char *name, const double *a,
                               const float *b, size_t count)
{
  add_text(t, "%s =", name);
  for (size_t n = 0; n < count; ++n)
    add_text(t, " %.6g", (a ? a[n] : (double)b[n]) + 0.0);
  add_text(t, "\n");
}

static inline const char *scale_name(fg_scale scale)
{
  return scale == FG_SCALE_GEO ? "geo" : scale == FG_SCALE_MAP ? "map" : "plain";
}

/* Lines such as "geo 4 x 3", "axis 0 'longitude' '°E'", "x = 1 2 3", "period 0 360",
 * "name 'u'", "u = 1 2 3", "units 'm/s'", "title '...'", "time", "level", "doubts". */
static inline void describe_field(text_of *t, const fg_field *field)
{
  const fg_field_arrays *a = fg_field_contents(field);
  size_t samples = 1;
  add_text(t, "%s %d x %d", scale_name(a->scale), a->size[0], a->size[1]);
  add_text(t, a->dimension == 3 ? " x %d\n" : "\n", a->size[2]);
  for (int k = 0; k < a->dimension; ++k) {
    samples *= (size_t)a->size[k];
    add_text(t, "axis %d '%s' '%s'\nname '%s'\n", k, a->axis_name[k], a->axis_units[k],
             a->velocity_name[k]);
    add_numbers(t, (const char *const[]){"x", "y", "z"}[k], a->axis[k], NULL,
                (size_t)a->size[k]);
    add_text(t, a->period[k] != 0.0 ? "period %d %g\n" : "open %d\n", k, a->period[k]);
  }
  for (int k = 0; k < a->dimension; ++k)
    add_numbers(t, (const char *const[]){"u", "v", "w"}[k], NULL, a->velocity[k],
                samples);
  add_line(t, "units", a->velocity_units);
  add_line(t, "title", a->title);
  add_line(t, "time", a->time ? a->time : "");
  add_line(t, "level", a->level ? a->level : "");
  add_line(t, "doubts", a->doubts ? a->doubts : "");
  add_text(t, "infinite %d\n", (int)fg_field_infinite(field));
}

/* For each vector "[u,v names]", a line for each fact that it has, and its times and
 * levels; before them "vectors 2". */
static inline void describe_inventory(text_of *t, const fg_inventory *inventory)
{
  add_text(t, "vectors %d\n", fg_inventory_vector_count(inventory));
  for (int i = 0; i < fg_inventory_vector_count(inventory); ++i) {
    const fg_inventory_vector *v = fg_inventory_vector_at(inventory, i);
    add_text(t, "[%s", v->name[0]);
    for (int k = 1; k < v->components && v->name[k]; ++k)
      add_text(t, ",%s", v->name[k]);
    add_text(t, " %s]\n%s %d x %d", v->found_by, scale_name(v->scale), v->size[0],
             v->size[1]);
    add_text(t, v->dimension == 3 ? " x %d\n" : "\n", v->size[2]);
    add_text(t, "missing %.6g\ntimes %d\nlevels %d\nusual level %d\n", v->missing_share,
             v->times, v->levels, v->usual_level);
    add_text(t, v->periodic[0] ? "periodic\n" : "open\n");
    add_numbers(t, "bounds", v->bounds, NULL, 2 * (size_t)v->dimension);
    add_line(t, "units", v->units);
    add_line(t, "unusable", v->unusable);
    add_line(t, "frame", v->frame);
    add_line(t, "absent", v->absent);
    add_line(t, "chosen", v->chosen);
    add_line(t, "doubts", v->doubts);
    for (int n = 0; n < v->times && v->time_value; ++n)
      add_line(t, "time", v->time_value[n].words);
    for (int n = 0; n < v->levels && v->level_value; ++n)
      add_line(t, "level", v->level_value[n].words);
  }
}

/* "at X Y = U V", "at X Y = none". */
static inline bool is_at(const fg_field *field, const char *text)
{
  const int dimension = fg_field_contents(field)->dimension;
  double place[3], velocity[3] = {NAN, NAN, NAN};
  char *end = NULL;
  for (int k = 0; k < dimension; ++k, text = end)
    place[k] = strtod(text, &end);
  const bool there = fg_field_velocity(field, place, velocity);
  text += strspn(text, " =");
  if (strncmp(text, "none", 4) == 0)
    return !there;
  for (int k = 0; k < dimension && there; ++k, text = end) {
    const double wanted = strtod(text, &end);
    if (end == text || !(fabs(velocity[k] - wanted) <= 1e-5 * fmax(1.0, fabs(wanted))))
      return false;
  }
  return there;
}

static inline void assert_items(const situation *s, const char *text, const char *items,
                                const fg_field *field)
{
  char item[1024];
  for (; *items; items += strcspn(items, "|"), items += *items == '|') {
    snprintf(item, sizeof item, "%.*s", (int)strcspn(items, "|"), items);
    const bool without = *item == '!';
    if (field && strncmp(item, "at ", 3) == 0 ? !is_at(field, item + 3)
                                              : !strstr(text, item + without) != without)
      fail_msg("%s: '%s' does not hold of\n%s", s->what, item, text);
  }
}

static inline void check_reading(sample_file *f, const situation *s,
                                 const fg_read_options *options)
{
  fg_field *field = NULL;
  const fg_status wanted = !s->refused  ? FG_STATUS_OK
                           : !s->status ? FG_STATUS_UNSUPPORTED
                                        : s->status;
  const fg_status status = fg_field_read(&field, f->context, f->path, options);
  const char *const message = fg_context_message(f->context);
  if (status != wanted || (status == FG_STATUS_OK) != (field != NULL))
    fail_msg("%s: status %d, \"%s\"", s->what, (int)status, message);
  if (s->refused && strncmp(message, f->folder, strlen(f->folder)) != 0)
    fail_msg("%s: no file in \"%s\"", s->what, message);
  assert_items(s, message, s->refused ? s->refused : "", NULL);
  if (s->hint && !strstr(fg_context_hint(f->context), s->hint))
    fail_msg("%s: hint \"%s\"", s->what, fg_context_hint(f->context));
  if (field) {
    static text_of t;
    t.used = 0;
    describe_field(&t, field);
    assert_items(s, t.text, s->field ? s->field : "", field);
  }
  assert_slabs_of_file(f, options, field);
  fg_field_destroy(field);
  fg_context_clear(f->context);
}

static inline void check_inventory(sample_file *f, const situation *s,
                                   const fg_read_options *options)
{
  static const fg_read_options none = {0};
  static text_of t;
  fg_inventory *inventory = NULL;
  const bool all = memcmp(&s->options, &none, sizeof none) == 0 && !s->second && !s->mesh;
  const fg_status status =
      all ? fg_inventory_read(&inventory, f->context, f->path)
          : fg_inventory_read_chosen(&inventory, f->context, f->path, options);
  if (status != FG_STATUS_OK)
    fail_msg("%s: \"%s\"", s->what, fg_context_message(f->context));
  t.used = 0;
  describe_inventory(&t, inventory);
  assert_items(s, t.text, s->inventory, NULL);
  fg_inventory_destroy(inventory);
}

static inline void check_situation(sample_file *f, const situation *s)
{
  fg_read_options options = s->options;
  sample_file second = *f, mesh = *f;
  snprintf(second.path, sizeof second.path, "%s/second.nc", f->folder);
  snprintf(mesh.path, sizeof mesh.path, "%s/mesh.nc", f->folder);
  if (s->second) {
    notation_write(&second, s->second, s->mode);
    options.vars_from = second.path;
  }
  if (s->mesh) {
    notation_write(&mesh, s->mesh, s->mode);
    options.mesh_from = mesh.path;
  }
  if (s->file)
    notation_write(f, s->file, s->mode);
  if (s->field || s->refused)
    check_reading(f, s, &options);
  if (s->inventory)
    check_inventory(f, s, &options);
  unlink(second.path);
  unlink(mesh.path);
}

/* Checks rows; one without a file is of the file of the row before. */
static inline void check_situations(void **state, const situation *rows, size_t count)
{
  for (size_t n = 0; n < count; ++n)
    check_situation(*state, &rows[n]);
}

/* A program that checks a table and nothing else. */
#define SITUATIONS_MAIN(name, rows)                                                      \
  static void situations_are_read_or_refused(void **state)                               \
  {                                                                                      \
    check_situations(state, rows, sizeof(rows) / sizeof *(rows));                        \
  }                                                                                      \
  int main(void)                                                                         \
  {                                                                                      \
    const struct CMUnitTest tests[] = {cmocka_unit_test_setup_teardown(                  \
        situations_are_read_or_refused, sample_set_up, sample_tear_down)};               \
    return cmocka_run_group_tests_name(name, tests, NULL, NULL);                         \
  }

#endif
