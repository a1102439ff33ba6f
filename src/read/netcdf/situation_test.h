/* Situations of NetCDF files as rows of a table: what a file has, in a short notation,
 * the options, and what must be read, listed or refused.
 *
 * What is expected is a list with '|' between its items. Each must stand in the message,
 * or in the text that describes the field or the inventory below, or with '!' not; "at X
 * Y[ Z] = U V[ W]" is the field's velocity at a place, "at X Y = none" or "= there" says
 * whether it has one. */
#ifndef FG__NETCDF_SITUATION_TEST_H
#define FG__NETCDF_SITUATION_TEST_H

#include <stdarg.h>

#include "flowgrain/inventory.h"
#include "read/netcdf/notation_example.h"

typedef struct situation {
  const char *what;
  const char *file, *second, *mesh; /* second and mesh: the options' further files */
  const char *text, *path;          /* instead of file: its bytes; a file that exists */
  int mode;                         /* of nc_create */
  fg_read_options options;
  const char *field, *inventory;
  const char *refused, *hint; /* words of the message and the hint */
  fg_status status;           /* of a refusal; OK stands for UNSUPPORTED */
} situation;

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
  for (size_t n = 0; n < count && n < MOST_NUMBERS; ++n)
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
  size_t missing = 0;
  for (size_t n = 0; n < samples; ++n)
    missing += isnan(a->velocity[0][n]) || isnan(a->velocity[1][n]);
  add_text(t, "missing %zu\n", missing);
  add_line(t, "units", a->velocity_units);
  add_line(t, "title", a->title);
  add_line(t, "time", a->time ? a->time : "");
  add_line(t, "level", a->level ? a->level : "");
  add_line(t, "doubts", a->doubts ? a->doubts : "");
  add_text(t, "infinite %d\n", (int)fg_field_infinite(field));
}

static inline void add_value(text_of *t, const char *name, const fg_axis_value *value)
{
  add_text(t, "%s '%s' %.6g '%s'\n", name, value->words, value->value, value->units);
}

/* For each vector "[u,v names]", a line for each fact that it has, and its times and
 * levels; before them "vectors 2". */
static inline void describe_inventory(text_of *t, const fg_inventory *inventory)
{
  add_text(t, "%s\nvectors %d\n", fg_inventory_format(inventory),
           fg_inventory_vector_count(inventory));
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
      add_value(t, "time", &v->time_value[n]);
    for (int n = 0; n < v->levels && v->level_value; ++n)
      add_value(t, "level", &v->level_value[n]);
  }
}

static inline bool is_at(const fg_field *field, const char *text, bool tangent)
{
  const int dimension = fg_field_contents(field)->dimension;
  double place[3], velocity[3] = {NAN, NAN, NAN};
  char *end = NULL;
  for (int k = 0; k < dimension; ++k, text = end)
    place[k] = strtod(text, &end);
  const bool there = tangent ? fg_field_tangent(field, place, velocity)
                             : fg_field_velocity(field, place, velocity);
  text += strspn(text, " =");
  if (strcmp(text, "none") == 0 || strcmp(text, "there") == 0)
    return there == (*text == 't');
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
    const bool without = *item == '!', tangent = strncmp(item, "tangent ", 8) == 0;
    const bool at = tangent || strncmp(item, "at ", 3) == 0;
    if (field && at ? !is_at(field, item + (tangent ? 8 : 3), tangent)
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
  const bool named = strncmp(message, f->folder, strlen(f->folder)) == 0 || s->path;
  if (s->refused && *message != '\'' && !named)
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
  if (strcmp(s->inventory, "refused") == 0) {
    assert_int_not_equal(status, FG_STATUS_OK);
    assert_null(inventory);
    assert_items(s, fg_context_message(f->context), s->refused, NULL);
    fg_context_clear(f->context);
    return;
  }
  if (status != FG_STATUS_OK)
    fail_msg("%s: \"%s\"", s->what, fg_context_message(f->context));
  t.used = 0;
  describe_inventory(&t, inventory);
  assert_items(s, t.text, s->inventory, NULL);
  const fg_inventory_vector *v = fg_inventory_vector_at(inventory, 0);
  if (fg_inventory_vector_count(inventory) == 1 && !v->unusable) {
    fg_read_defaults d;
    assert_int_equal(fg_read_defaults_find(&d, f->context, f->path, options),
                     FG_STATUS_OK);
    if (d.level != v->usual_level || strcmp(d.absent, v->absent ? v->absent : ""))
      fail_msg("%s: defaults are level %d, '%s' absent", s->what, d.level, d.absent);
  }
  fg_inventory_destroy(inventory);
}

static inline void check_situation(const sample_file *of, const situation *s)
{
  fg_read_options options = s->options;
  sample_file here = *of, second = *of, mesh = *of, *const f = &here;
  snprintf(second.path, sizeof second.path, "%.63s/second.nc", f->folder);
  snprintf(mesh.path, sizeof mesh.path, "%.63s/mesh.nc", f->folder);
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
  if (s->path)
    snprintf(f->path, sizeof f->path, "%s", s->path);
  if (s->text) {
    FILE *file = fopen(f->path, "w");
    assert_non_null(file);
    fputs(s->text, file);
    assert_int_equal(fclose(file), 0);
  }
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
