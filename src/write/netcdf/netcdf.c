#include "write/netcdf/netcdf.h"

#include "base/memory.h"
#include "field/field.h"
#include "file/whole_file.h"
#include "write/field_close.h"

#include <stdlib.h>
#include <string.h>

#include <netcdf.h>

enum { NAME_BYTES = 128 };

typedef struct writing {
  int file;
  int error; /* libnetcdf's first, 0: none */
} writing;

static void keep(writing *w, int error)
{
  if (w->error == NC_NOERR)
    w->error = error;
}

static void put_text(writing *w, int variable, const char *attribute, const char *text)
{
  if (w->error == NC_NOERR && text && text[0])
    keep(w, nc_put_att_text(w->file, variable, attribute, strlen(text), text));
}

/* Names of figures, letters and underscores, which every program can use. */
static void make_name(char name[NAME_BYTES], const char *wanted, const char *otherwise)
{
  static const char figures[] = "0123456789";
  static const char usable[] =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ_0123456789";
  size_t length = strlen(wanted);
  bool good = length > 0 && length < NAME_BYTES && !strchr(figures, wanted[0]) &&
              strspn(wanted, usable) == length;
  strcpy(name, good ? wanted : otherwise);
}

typedef struct axis_words {
  const char *name, *standard_name, *units, *letter;
} axis_words;

static axis_words words_of_axis(const fg_field_arrays *field, int k)
{
  static const axis_words geo[3] = {{"lon", "longitude", "degrees_east", "X"},
                                    {"lat", "latitude", "degrees_north", "Y"},
                                    {"height", "height", NULL, "Z"}};
  static const axis_words map[3] = {{"x", "projection_x_coordinate", NULL, "X"},
                                    {"y", "projection_y_coordinate", NULL, "Y"},
                                    {"z", NULL, NULL, "Z"}};
  static const axis_words plain[3] = {
      {"x", NULL, NULL, "X"}, {"y", NULL, NULL, "Y"}, {"z", NULL, NULL, "Z"}};
  axis_words words = plain[k];
  if (field->scale == FG_SCALE_GEO)
    words = geo[k];
  else if (field->scale == FG_SCALE_MAP)
    words = map[k];
  if (!words.units)
    words.units = field->axis_units[k];
  return words;
}

static void define_axis(writing *w, int *dimension, int *variable,
                        const fg_field_arrays *field, int k)
{
  axis_words words = words_of_axis(field, k);
  if (w->error == NC_NOERR)
    keep(w, nc_def_dim(w->file, words.name, (size_t)field->size[k], dimension));
  if (w->error == NC_NOERR)
    keep(w, nc_def_var(w->file, words.name, NC_DOUBLE, 1, dimension, variable));
  put_text(w, *variable, "standard_name", words.standard_name);
  put_text(w, *variable, "long_name", field->axis_name[k]);
  put_text(w, *variable, "units", words.units);
  put_text(w, *variable, "axis", words.letter);
}

/* Conventional names are kept, so that a reader finds them; two of one name could not be.
 */
static void name_components(char name[3][NAME_BYTES], const fg_field_arrays *field)
{
  static const char *const taken[] = {"lon", "lat", "x", "y", "z"};
  static const char *const otherwise[3] = {"u", "v", "w"};
  bool clash = false;
  for (int k = 0; k < field->dimension; ++k) {
    make_name(name[k], field->velocity_name[k], "");
    clash = clash || !name[k][0] ||
            strcmp(field->velocity_name[k],
                   field->velocity_name[(k + 1) % field->dimension]) == 0;
    for (size_t i = 0; i < sizeof taken / sizeof taken[0]; ++i)
      clash = clash || strcmp(name[k], taken[i]) == 0;
  }
  for (int k = 0; clash && k < field->dimension; ++k)
    strcpy(name[k], otherwise[k]);
}

static void define(writing *w, int axis[3], int component[3],
                   const fg_field_arrays *field)
{
  const int rank = field->dimension == 3 ? 3 : 2;
  int dimensions[3] = {0, 0, 0}; /* (z,) y, x */
  for (int k = 0; k < rank; ++k)
    define_axis(w, &dimensions[rank - 1 - k], &axis[k], field, k);
  char name[3][NAME_BYTES];
  name_components(name, field);
  const float fill = NC_FILL_FLOAT;
  for (int k = 0; k < rank; ++k) {
    if (w->error == NC_NOERR)
      keep(w, nc_def_var(w->file, name[k], NC_FLOAT, rank, dimensions, &component[k]));
    put_text(w, component[k], "long_name", field->velocity_name[k]);
    put_text(w, component[k], "units", field->velocity_units);
    if (w->error == NC_NOERR)
      keep(w, nc_put_att_float(w->file, component[k], "_FillValue", NC_FLOAT, 1, &fill));
  }
  put_text(w, NC_GLOBAL, "Conventions", "CF-1.8");
  put_text(w, NC_GLOBAL, "title", field->title);
  put_text(w, NC_GLOBAL, "source", "flowgrain");
  put_text(w, NC_GLOBAL, "time_of_field", field->time);
  put_text(w, NC_GLOBAL, "level_of_field", field->level);
  if (w->error == NC_NOERR)
    keep(w, nc_enddef(w->file));
}

static void put_component(writing *w, int variable, const fg_field_arrays *field, int k,
                          float *samples)
{
  size_t count = fg__field_samples(field);
  for (size_t i = 0; i < count; ++i)
    samples[i] = fg__field_is_missing(field, i) ? NC_FILL_FLOAT : field->velocity[k][i];
  if (w->error == NC_NOERR)
    keep(w, nc_put_var_float(w->file, variable, samples));
}

static void write_file(writing *w, const char *name, const fg_field_arrays *field,
                       float *samples)
{
  int axis[3] = {0, 0, 0}, component[3] = {0, 0, 0};
  w->error = nc_create(name, NC_CLOBBER | NC_64BIT_OFFSET, &w->file);
  if (w->error != NC_NOERR)
    return;
  define(w, axis, component, field);
  for (int k = 0; k < field->dimension; ++k) {
    if (w->error == NC_NOERR)
      keep(w, nc_put_var_double(w->file, axis[k], field->axis[k]));
    put_component(w, component[k], field, k, samples);
  }
  keep(w, nc_close(w->file));
}

fg_status fg__netcdf_write(fg_context *context, const char *path,
                           const fg_field_arrays *field)
{
  size_t count = fg__field_samples(field);
  float *samples = fg__allocate(count, sizeof *samples);
  if (!samples)
    return fg__fail_memory(context, "a field to write", count * sizeof *samples);
  char *name = NULL;
  fg_status status = fg__whole_file_name(&name, context, path);
  if (status == FG_STATUS_OK) {
    writing w = {0};
    write_file(&w, name, field, samples);
    if (w.error != NC_NOERR)
      status = fg__fail(context, FG_STATUS_FILE_ACCESS, "%s: cannot be written: %s", path,
                        nc_strerror(w.error));
    status = fg__whole_file_rename(name, context, path, status);
  }
  free(samples);
  return status;
}
