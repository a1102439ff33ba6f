/* Situations as rows of a table: what a file has, the options, and what must be read,
 * listed or refused.
 *
 * What is expected is a list with '|' between its items. Each must stand in the message
 * or its hint, or in the text that describes the field or the inventory below, or with
 * '!' not; "at X Y[ Z] = U V[ W]" is the field's velocity at a place, "at X Y = none" or
 * "= there" says whether it has one. */
#ifndef FG__SITUATION_TEST_H
#define FG__SITUATION_TEST_H

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>

#include "flowgrain/inventory.h"
#include "read/slabs_alike_test.h"

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
  char text[1 << 16];
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
  for (size_t n = 0; n < count && n < 4096; ++n)
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
  double place[3], velocity[3] = {(double)NAN, (double)NAN, (double)NAN};
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

/* "linear u0 ux uy v0 vx vy[ within 0.01]": of a field that is there for a quarter of its
 * samples at least, and everywhere that function of their place. */
static inline bool is_linear(const fg_field *field, const char *text)
{
  const fg_field_arrays *a = fg_field_contents(field);
  const int d = a->dimension;
  double factor[3][4] = {{0}}, tolerance = 1e-4;
  int found = 0, all = d == 3 ? a->size[2] : 1;
  char *end = NULL;
  for (int n = 0; n < d * (d + 1); ++n, text = end)
    factor[n / (d + 1)][n % (d + 1)] = strtod(text, &end);
  if (strncmp(text, " within ", 8) == 0)
    tolerance = strtod(text + 8, NULL);
  all *= a->size[0] * a->size[1];
  for (int n = 0; n < all; ++n) {
    const int at[3] = {n % a->size[0], n / a->size[0] % a->size[1],
                       n / a->size[0] / a->size[1]};
    if (isnan(a->velocity[0][n]) || isnan(a->velocity[1][n]))
      continue;
    ++found;
    for (int c = 0; c < d; ++c) {
      double wanted = factor[c][0];
      for (int k = 0; k < d; ++k)
        wanted += factor[c][k + 1] * a->axis[k][at[k]];
      if (!(fabs((double)a->velocity[c][n] - wanted) <= tolerance))
        return false;
    }
  }
  return 4 * found >= all;
}

static inline void assert_items(const situation *s, const char *text, const char *items,
                                const fg_field *field)
{
  char item[1024];
  for (; *items; items += strcspn(items, "|"), items += *items == '|') {
    snprintf(item, sizeof item, "%.*s", (int)strcspn(items, "|"), items);
    const bool without = *item == '!', tangent = strncmp(item, "tangent ", 8) == 0;
    const bool at = tangent || strncmp(item, "at ", 3) == 0;
    if (field && strncmp(item, "linear ", 7) == 0 ? !is_linear(field, item + 7)
        : field && at ? !is_at(field, item + (tangent ? 8 : 3), tangent)
                      : !strstr(text, item + without) != without)
      fail_msg("%s: '%s' does not hold of\n%s", s->what, item, text);
  }
}

/* What reading gave; frees the field. */
static inline void check_read(fg_context *context, const situation *s, fg_status status,
                              fg_field *field)
{
  const fg_status wanted = !s->refused  ? FG_STATUS_OK
                           : !s->status ? FG_STATUS_UNSUPPORTED
                                        : s->status;
  const char *const message = fg_context_message(context);
  if (status != wanted || (status == FG_STATUS_OK) != (field != NULL))
    fail_msg("%s: status %d, \"%s\"", s->what, (int)status, message);
  static text_of t;
  t.used = 0;
  add_text(&t, "%s\n%s", message, fg_context_hint(context));
  assert_items(s, t.text, s->refused ? s->refused : "", NULL);
  if (s->hint && !strstr(fg_context_hint(context), s->hint))
    fail_msg("%s: hint \"%s\"", s->what, fg_context_hint(context));
  if (field) {
    t.used = 0;
    describe_field(&t, field);
    assert_items(s, t.text, s->field ? s->field : "", field);
  }
  fg_field_destroy(field);
  fg_context_clear(context);
}

/* What listing gave; frees the inventory. */
static inline void check_listed(fg_context *context, const situation *s, fg_status status,
                                fg_inventory *inventory)
{
  static text_of t;
  const bool refused = strcmp(s->inventory, "refused") == 0;
  if ((status == FG_STATUS_OK) != !refused)
    fail_msg("%s: \"%s\"", s->what, fg_context_message(context));
  t.used = 0;
  if (refused)
    assert_items(s, fg_context_message(context), s->refused, NULL);
  else
    describe_inventory(&t, inventory);
  if (!refused)
    assert_items(s, t.text, s->inventory, NULL);
  fg_inventory_destroy(inventory);
  fg_context_clear(context);
}

/* A row's text as a file in memory, which ends where a sanitizer watches. */
static inline void check_text(fg_context *context, const situation *s)
{
  const size_t size = strlen(s->text);
  unsigned char *bytes = malloc(size + !size);
  assert_non_null(bytes);
  memcpy(bytes, s->text, size);
  const fg__source source = {.path = "example", .bytes = bytes, .size = size};
  const fg__format *format = fg__format_find(bytes, size);
  if (!format)
    fail_msg("%s: no format", s->what);
  if (s->field || s->refused) {
    fg_field *field = NULL;
    const fg_status status = fg__dataset_read(&field, context, format, &source,
                                              &s->options, (fg__slab_index){0, 1});
    assert_slabs_alike(format, &source, &s->options, field);
    check_read(context, s, status, field);
  }
  if (s->inventory) {
    static const fg_read_options none = {0};
    const bool all = memcmp(&s->options, &none, sizeof none) == 0;
    fg_inventory *inventory = NULL;
    assert_int_equal(fg__inventory_create(&inventory, context, format->name),
                     FG_STATUS_OK);
    check_listed(context, s,
                 fg__dataset_inventory(inventory, context, format, &source,
                                       all ? NULL : &s->options),
                 inventory);
  }
  free(bytes);
}

/* Checks rows of texts; one without a text is of the text of the row before. */
static inline void check_texts(fg_context *context, const situation *rows, size_t count)
{
  const char *text = NULL;
  for (size_t n = 0; n < count; ++n) {
    situation row = rows[n];
    text = row.text = row.text ? row.text : text;
    check_text(context, &row);
  }
}

#endif
