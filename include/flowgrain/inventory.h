/* What a file holds: its vectors, times and levels; and which of these a text selects. */
#ifndef FLOWGRAIN_INVENTORY_H
#define FLOWGRAIN_INVENTORY_H

#include "flowgrain/field.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct fg_inventory fg_inventory;

/* A time or a level of a file. */
typedef struct fg_axis_value {
  double value;      /* in `units`; NaN: it has an index only */
  const char *units; /* "hPa", "m", "hours since 1900-01-01"; "" none */
  const char *words; /* as captions show it: "850 hPa"; a date begins as ISO 8601,
                        "1982-07-16" or "1982-07-16 12:00[:30]", in the file's calendar */
} fg_axis_value;

/* A vector of a file. Lengths and bounds are in the coordinates' units. */
typedef struct fg_inventory_vector {
  int components;       /* 2 or 3 */
  const char *name[3];  /* variables; for one vector variable name[0] only */
  const char *units;    /* "" unknown */
  const char *found_by; /* "standard_name", "names", "vector variable", ... */
  int dimension;        /* of the field that fg_field_read makes of it */
  int size[3];          /* samples along x, y(, z) */
  int times, levels;    /* 1 where there is no such axis */
  double missing_share; /* share of missing samples at the first time and level */
  fg_scale scale;       /* what AUTO would choose */
  double bounds[6];     /* xmin, xmax, ymin, ymax, zmin, zmax */
  bool periodic[3];     /* along each axis, as longitude round the globe */
  const char *unusable; /* why it can not be read; NULL: it can */
  double normal_share;  /* of a plane in space: fg_field_normal_share at the first time */
  const char *frame; /* of a model's grid, of a speed and a direction: what components are
                        along, and which rule says so; NULL: along the axes */
  const char *plane; /* PROJ string of the plane in which a model's grid is even; NULL:
                        not known */
  size_t cells;  /* of an unstructured mesh that is interpolated onto the grid of `size`,
                    missing outside its cells; 0: the file has a grid */
  size_t points; /* scattered in space, interpolated likewise; 0: none */
  const fg_axis_value *time_value, *level_value; /* [times], [levels]; NULL: not known */
  int usual_level;                               /* fg_read_defaults.level */
  const char *absent;                            /* fg_read_defaults.absent; NULL: none */
  const char *chosen;       /* the samples of fg_read_options.at; NULL: none */
  const char *doubts;       /* fg_field_arrays.doubts of reading it; NULL: none */
  const char *axis_name[3]; /* of the field's; NULL: not known yet */
} fg_inventory_vector;

/* Lists the vectors of a file; where the format allows, without reading all samples.
 * Statuses as fg_field_read. */
FG_API fg_status fg_inventory_read(fg_inventory **out, fg_context *context,
                                   const char *input);

/* Lists the one vector that fg_field_read would read with these options, whose time and
 * level do not count. Samples and meshes are not read: missing_share stays 0, and of
 * meshes size, bounds and cells, too. options may be NULL. Statuses as fg_field_read. */
FG_API fg_status fg_inventory_read_chosen(fg_inventory **out, fg_context *context,
                                          const char *input,
                                          const fg_read_options *options);

FG_API void fg_inventory_destroy(fg_inventory *inventory);

/* The name of the file's format, "NetCDF"; fg_input_options.format takes it in small
 * letters. */
FG_API const char *fg_inventory_format(const fg_inventory *inventory);

/* The vectors, in the file's order; index from 0. */
FG_API int fg_inventory_vector_count(const fg_inventory *inventory);
FG_API const fg_inventory_vector *fg_inventory_vector_at(const fg_inventory *inventory,
                                                         int index);

/* The defaults of reading a vector: its level; and which coordinates the file lacks, in
 * place of which the indices of the grid are used. */
typedef struct fg_read_defaults {
  int level;        /* index; of an ocean's levels the one at the surface, which has the
                       greatest height or the least depth; else 0 */
  char absent[256]; /* "lat, lon": coordinates that the components name and the file
                       lacks; "" none */
} fg_read_defaults;

/* Finds these for the vector that fg_field_read would read with these options, whose
 * level does not count. Reads no samples. Of other files than NetCDF the level is 0 and
 * `absent` empty. Statuses as fg_field_read; options may be NULL. */
FG_API fg_status fg_read_defaults_find(fg_read_defaults *out, fg_context *context,
                                       const char *input, const fg_read_options *options);

/* Times or levels that a text selects. */
typedef struct fg_selection {
  int *index;   /* [count] ascending */
  int count;    /* at least 1 */
  bool several; /* the text is a range, a list or "all", also where that comes to one */
  bool nearest; /* no value is the text's; it is the nearest one */
} fg_selection;

/* Finds which of `count` times (what: "time") or levels ("level") a text selects, items
 * with commas between them:
 *   7            a plain whole number is an index, from 0; beyond the last one it is a
 *                value that is there
 *   300hPa 2.5h 0.995 850.   a number with a unit or a decimal point or exponent is a
 *                value, without a unit in the file's; pressures, lengths and times are
 *                converted
 *   1982-07 1982-07-16 1982-07-16T12:00[:30]   a date is the first time within that
 *                month, day, hour, minute or second; of dates 1982, too, where it is
 *                beyond the last index
 *   0:11 1982-01:1982-06 100hPa:850hPa 1982-07-16T12:00/1982-07-17   a range, both ends
 *                with all of their month or day; one end may be left out
 *   surface July words that the file has for it, or a part of them that it has only once;
 *                any case, spaces perhaps as _
 *   all          every one
 * Of a single value or date that is not there the nearest is taken, unless it lies beyond
 * the first or the last by more than their distance to the next. values may be NULL: then
 * they have indices only. With count 0 only the spelling is checked. ARGUMENT (spelling),
 * UNSUPPORTED (not there), MEMORY. End with fg_selection_clear. */
FG_API fg_status fg_selection_find(fg_selection *out, fg_context *context,
                                   const char *what, const char *text,
                                   const fg_axis_value *values, int count);
FG_API void fg_selection_clear(fg_selection *selection);

#ifdef __cplusplus
}
#endif

#endif
