/* Situations of NetCDF files (notation_example.h) as rows of a table. */
#ifndef FG__NETCDF_SITUATION_TEST_H
#define FG__NETCDF_SITUATION_TEST_H

#include "read/netcdf/notation_example.h"
#include "read/situation_test.h"

static inline void check_reading(sample_file *f, const situation *s,
                                 const fg_read_options *options)
{
  fg_field *field = NULL;
  const fg_status status = fg_field_read(&field, f->context, f->path, options);
  const char *const message = fg_context_message(f->context);
  const bool named = strncmp(message, f->folder, strlen(f->folder)) == 0 || s->path ||
                     options->vars_from;
  if (s->refused && *message != '\'' && !named)
    fail_msg("%s: no file in \"%s\"", s->what, message);
  assert_slabs_of_file(f, options, field);
  check_read(f->context, s, status, field);
}

static inline void check_inventory(sample_file *f, const situation *s,
                                   const fg_read_options *options)
{
  static const fg_read_options none = {0};
  fg_inventory *inventory = NULL;
  fg_read_defaults d;
  const bool all = memcmp(&s->options, &none, sizeof none) == 0 && !s->second && !s->mesh;
  const fg_status status =
      all ? fg_inventory_read(&inventory, f->context, f->path)
          : fg_inventory_read_chosen(&inventory, f->context, f->path, options);
  const fg_inventory_vector *v = inventory ? fg_inventory_vector_at(inventory, 0) : NULL;
  if (v && !v->unusable && fg_inventory_vector_count(inventory) == 1) {
    assert_int_equal(fg_read_defaults_find(&d, f->context, f->path, options),
                     FG_STATUS_OK);
    if (d.level != v->usual_level || strcmp(d.absent, v->absent ? v->absent : "") != 0)
      fail_msg("%s: defaults are level %d, '%s' absent", s->what, d.level, d.absent);
  }
  check_listed(f->context, s, status, inventory);
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
