/* Small NetCDF files for the tests of the reader, made with libnetcdf. */
#ifndef FG__NETCDF_SAMPLE_H
#define FG__NETCDF_SAMPLE_H

#include <netcdf.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "read/slabs_alike_test.h"

typedef struct sample_file {
  char folder[64];
  char path[96];
  int id;
  fg_context *context;
} sample_file;

static inline void nc_must(int error)
{
  if (error) {
    fprintf(stderr, "libnetcdf: %s\n", nc_strerror(error));
    abort();
  }
}

static inline int sample_set_up(void **state)
{
  sample_file *f = calloc(1, sizeof *f);
  if (!f)
    return 1;
  strcpy(f->folder, "/tmp/flowgrain-netcdf-XXXXXX");
  if (!mkdtemp(f->folder) || fg_context_create(&f->context) != FG_STATUS_OK)
    return 1;
  snprintf(f->path, sizeof f->path, "%s/sample.nc", f->folder);
  *state = f;
  return 0;
}

static inline int sample_tear_down(void **state)
{
  sample_file *f = *state;
  unlink(f->path);
  rmdir(f->folder);
  fg_context_destroy(f->context);
  free(f);
  return 0;
}

static inline void sample_begin(sample_file *f, int mode)
{
  nc_must(nc_create(f->path, mode | NC_CLOBBER, &f->id));
}

static inline void sample_end(sample_file *f)
{
  nc_must(nc_close(f->id));
}

/* Runs definitions; classic files forbid them while data are written. */
static inline void sample_define(const sample_file *f)
{
  const int error = nc_redef(f->id);
  if (error != NC_EINDEFINE)
    nc_must(error);
}

static inline void sample_write(const sample_file *f)
{
  const int error = nc_enddef(f->id);
  if (error != NC_ENOTINDEFINE)
    nc_must(error);
}

static inline int sample_dimension(const sample_file *f, const char *name, size_t length)
{
  int id;
  sample_define(f);
  nc_must(nc_def_dim(f->id, name, length, &id));
  return id;
}

static inline int sample_variable(const sample_file *f, const char *name, nc_type type,
                                  int rank, const int *dimensions)
{
  int id;
  sample_define(f);
  nc_must(nc_def_var(f->id, name, type, rank, dimensions, &id));
  return id;
}

static inline void sample_text(const sample_file *f, int variable, const char *name,
                               const char *value)
{
  sample_define(f);
  nc_must(nc_put_att_text(f->id, variable, name, strlen(value), value));
}

static inline void sample_number(const sample_file *f, int variable, const char *name,
                                 nc_type type, double value)
{
  sample_define(f);
  nc_must(nc_put_att_double(f->id, variable, name, type, 1, &value));
}

/* A dimension with its coordinate variable; units may be NULL. Returns the dimension. */
static inline int sample_axis(const sample_file *f, const char *name, size_t length,
                              const double *coordinate, const char *units)
{
  const int dimension = sample_dimension(f, name, length);
  const int variable = sample_variable(f, name, NC_DOUBLE, 1, &dimension);
  if (units)
    sample_text(f, variable, "units", units);
  sample_write(f);
  nc_must(nc_put_var_double(f->id, variable, coordinate));
  return dimension;
}

static inline void sample_put(const sample_file *f, int variable, const double *values)
{
  sample_write(f);
  nc_must(nc_put_var_double(f->id, variable, values));
}

static inline void assert_slabs_of_file(const sample_file *f,
                                        const fg_read_options *options,
                                        const fg_field *whole)
{
  static const fg_read_options none = {0};
  fg__source source;
  if (fg__source_open(&source, NULL, f->path) != FG_STATUS_OK)
    return;
  assert_slabs_alike(&fg__format_netcdf, &source, options ? options : &none, whole);
  fg__source_close(&source, NULL, FG_STATUS_OK);
}

static inline fg_field *read_with(sample_file *f, const fg_read_options *options)
{
  fg_field *field = NULL;
  const fg_status status = fg_field_read(&field, f->context, f->path, options);
  if (status != FG_STATUS_OK)
    fail_msg("%s", fg_context_message(f->context));
  assert_slabs_of_file(f, options, field);
  return field;
}

static inline void refuse_with(sample_file *f, const fg_read_options *options,
                               fg_status status, const char *words)
{
  fg_field *field = NULL;
  fg_context_clear(f->context);
  assert_int_equal(fg_field_read(&field, f->context, f->path, options), status);
  assert_null(field);
  assert_slabs_of_file(f, options, NULL);
  const char *message = fg_context_message(f->context);
  if (!strstr(message, words) || strncmp(message, f->path, strlen(f->path)) != 0)
    fail_msg("\"%s\" lacks \"%s\" or the file's name", message, words);
}

#endif
