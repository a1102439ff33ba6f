/* Vector fields: read, made or copied, asked and written; and what a file holds. */
#ifndef FLOWGRAIN_FIELD_H
#define FLOWGRAIN_FIELD_H

#include "flowgrain/context.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct fg_field fg_field;

typedef enum fg_scale {
  FG_SCALE_AUTO = 0, /* from units and axes */
  FG_SCALE_GEO,      /* axes in degrees, velocity along east and north */
  FG_SCALE_MAP,      /* projected plane: axes in a length, velocity along the axes */
  FG_SCALE_PLAIN     /* axes without a known unit */
} fg_scale;

typedef struct fg_map_options fg_map_options; /* map.h */

/* What the components of a vector on a model's grid are along. */
typedef enum fg_frame {
  FG_FRAME_AUTO =
      0,         /* from names, attributes and the grid (docs/method/model-grids.md) */
  FG_FRAME_EAST, /* east and north */
  FG_FRAME_GRID  /* the directions of the grid's indices or axes */
} fg_frame;

/* A zero field means its default, in brackets. */
typedef struct fg_read_options {
  const char *vars;      /* "U,V", "U,V,W" or one vector variable; NULL: found */
  const char *vars_from; /* second file with the other component(s) */
  int time;              /* index along time, from 0 */
  int level;             /* index along level, from 0 */
  const char *mask; /* variable that is zero (negative, missing) outside the domain */
  fg_scale scale;
  const char *block; /* of several in a file the one, or those within it, of this name;
                        NULL: all together */
  fg_frame frame;
  const char *slice; /* a plane to cut a field in 3D by (fg_plane_parse); NULL: none */
  const fg_map_options *map; /* what is in longitude and latitude is laid on this map;
                                NULL: it stays so */
} fg_read_options;

/* Reads a field from a file, or makes an analytic one from "synth:NAME" (sampled at 257
 * nodes a side in 2D, at 65 in 3D). The format is found from the content, not the name.
 * options may be NULL. FILE_ACCESS, FILE_FORMAT, UNSUPPORTED, ARGUMENT (names, indices),
 * MEMORY.
 *
 * Of a file by a stranger: no other file is read than the named ones and, of VTK's
 * composite files, what they name beside themselves. Sizes are checked before memory is
 * taken; fg_input_options (context.h) limits what the field's samples take. A chunk of a
 * NetCDF-4 file takes 256 MiB at most, once it is inflated, too. But libhdf5, under
 * NetCDF-4, and ecCodes, under GRIB, can crash or go on for ever where a file's structure
 * is damaged, in the process that calls them: such files are best read first by a child
 * process with limits of time and memory, as the program does (cli/sandbox.c). */
FG_API fg_status fg_field_read(fg_field **out, fg_context *context, const char *input,
                               const fg_read_options *options);

/* Makes the analytic field NAME on the unit square or cube, with `nodes` samples a side,
 * both ends included (0: 257 in 2D, 65 in 3D; at least 2; 3 for the periodic field abc,
 * which leaves the repeated end out). ARGUMENT, MEMORY. */
FG_API fg_status fg_field_create_analytic(fg_field **out, fg_context *context,
                                          const char *name, int nodes);

/* Names of the analytic fields, ended by NULL. */
FG_API const char *const *fg_field_analytic_names(void);

typedef struct fg_field_arrays {
  int dimension;              /* 2 or 3 */
  int size[3];                /* samples along x, y(, z); at least 2 each */
  const double *axis[3];      /* size[k] ascending coordinates each */
  double period[3];           /* 0, or the length after which that axis repeats; then the
                                 last sample must lie before axis[0] + period */
  const float *velocity[3];   /* size[0] * size[1] (* size[2]) samples a component, x
                                 fastest; NaN, infinite: missing */
  const unsigned char *valid; /* a byte a sample, 0 = missing; NULL: all but NaN */
  fg_scale scale;             /* AUTO means PLAIN */
  const char *velocity_name[3]; /* NULL: "u", "v", "w" */
  const char *velocity_units;   /* NULL: "" */
  const char *axis_name[3];     /* NULL: "x", "y", "z" */
  const char *axis_units[3];    /* NULL: "" */
  const char *title;            /* what it is, for captions; NULL: "" */
  const char *time;             /* the chosen time in words; NULL: none */
  const char *level;            /* the chosen level in words; NULL: none */
  const char *projection; /* scale MAP: a PROJ string that takes longitude and latitude to
                             the axes' coordinates; NULL: not known */
} fg_field_arrays;

/* Copies arrays into a new field. ARGUMENT (sizes, order of axes, no valid cell, speeds
 * beyond 1e15, a field that is zero everywhere), UNSUPPORTED (3D with scale GEO), MEMORY.
 */
FG_API fg_status fg_field_create(fg_field **out, fg_context *context,
                                 const fg_field_arrays *arrays);
FG_API void fg_field_destroy(fg_field *field);

/* The field's own arrays and words, borrowed; no pointer in it is NULL but `valid` (then
 * every sample counts), in 2D `axis[2]`, `velocity[2]`, and `time`, `level` (not chosen),
 * `projection`. */
FG_API const fg_field_arrays *fg_field_contents(const fg_field *field);

/* How many of a field's samples are missing because a component is infinite: of a slab
 * those of its own rows, once it is joined those of all. */
FG_API size_t fg_field_infinite(const fg_field *field);

/* Velocity at a point in the input's units, bilinear or trilinear; false outside the
 * domain: beyond the boundary, or in a data cell with a missing corner. position and
 * velocity: dimension numbers. */
FG_API bool fg_field_velocity(const fg_field *field, const double position[],
                              double velocity[]);

/* The direction of the streamline in the axes' coordinates, not normalised: (u, v(, w)),
 * but (u / cos latitude, v) on a longitude-latitude grid. False as above. */
FG_API bool fg_field_tangent(const fg_field *field, const double position[],
                             double tangent[]);

/* A plane in space, in the coordinates of a field's axes. */
typedef struct fg_plane {
  double normal[3]; /* of any length */
  double point[3];  /* one that lies in it */
} fg_plane;

/* Cuts a field in 3D: the field in 2D of the velocity's components in the plane. A plane
 * along two axes keeps them, with all their samples, names, units and periods, and the
 * samples are the volume's own where the plane goes through them, else linear between the
 * two planes beside it. Any other plane becomes an even raster, about a sample wherever
 * an axis has one, interpolated (fg_field_velocity) and missing outside the volume. Its
 * axes: of the three the one nearest to the normal is left out; of the other two the one
 * nearer to the plane gives one direction, its projection; the other direction is
 * perpendicular to that; both are in the order of their axes, point their way, and
 * measure from the origin, so that a direction which is an axis has its coordinates. A
 * turned axis or component has the name of the nearest with a prime. level says where the
 * cut is. ARGUMENT (2D, a field that ranks share, a normal of no length, a plane that
 * misses the field, a tilted one where axes differ in units; and as fg_field_create),
 * MEMORY. */
FG_API fg_status fg_field_slice(fg_field **out, fg_context *context,
                                const fg_field *volume, const fg_plane *plane);

/* Reads a plane from "NAME=VALUE", the name of an axis or x, y, z, or from
 * "NX,NY,NZ@X,Y,Z", normal and point. With a NULL volume any name will do: the words
 * alone are checked. ARGUMENT. */
FG_API fg_status fg_plane_parse(fg_plane *out, fg_context *context, const char *text,
                                const fg_field *volume);

/* Of a field that is a plane in space, cut or read with three components: which share of
 * the mean square of the velocity its component normal to the plane has, from 0 to 1; 0
 * for other fields and for slabs. */
FG_API double fg_field_normal_share(const fg_field *field);

/* The speeds between which a whole field lies but for the slowest and the fastest
 * twentieth of its area (volume): what the ends of a colour key for several fields are
 * found from. Input units. ARGUMENT (a slab), MEMORY. */
FG_API fg_status fg_field_speed_range(double range[2], fg_context *context,
                                      const fg_field *field);

/* Writes a field as .vti (VTK XML image data; axes must be evenly spaced; scale,
 * projection, time and level as FieldData) or .nc (NetCDF, CF). UNSUPPORTED for other
 * names' ends, FILE_ACCESS, MEMORY. */
FG_API fg_status fg_field_write(fg_context *context, const char *path,
                                const fg_field *field);

/* What a file holds. */

typedef struct fg_inventory fg_inventory;

/* A time or a level of a file. */
typedef struct fg_axis_value {
  double value;      /* in its units; NaN: it has none, only its place */
  const char *units; /* "hPa", "m", "hours since 1900-01-01"; "" none */
  const char *words; /* as captions have it: "850 hPa"; of a date they begin as ISO 8601,
                        "1982-07-16" or "1982-07-16 12:00[:30]", in the file's calendar */
} fg_axis_value;

typedef struct fg_inventory_vector {
  int components;       /* 2 or 3 */
  const char *name[3];  /* variables; for one vector variable name[0] only */
  const char *units;    /* "" unknown */
  const char *found_by; /* "standard_name", "names", "vector variable", ... */
  int dimension;        /* of the field it would give */
  int size[3];          /* samples along x, y(, z) */
  int times, levels;    /* 1 when there is no such axis */
  double missing_share; /* share of missing samples at the first time and level */
  fg_scale scale;       /* what AUTO would choose */
  double bounds[6];     /* xmin, xmax, ymin, ymax, zmin, zmax */
  bool periodic[3];     /* whether each axis closes (longitude, say) */
  const char *unusable; /* NULL, or why this pair can not be read yet */
  double normal_share;  /* of a plane in space: fg_field_normal_share at the first time */
  const char *frame; /* of a model's grid: what the components are along, and which rule
                        says so; NULL: along the axes */
  const char *plane; /* PROJ string of the plane in which a model's grid is even; NULL:
                        not known */
  size_t cells;      /* 0, or how many cells, which are not along the axes, are
                        interpolated onto that grid; outside them is missing */
  size_t points;     /* 0, or how many points in space, which lie on no grid, are */
  const fg_axis_value *time_value, *level_value; /* [times], [levels]; NULL: not known */
  int usual_level;                               /* fg_usual.level */
  const char *absent;                            /* fg_usual.absent; NULL: none */
  const char *axis_name[3];                      /* of a plane in space; NULL: x, y, z */
} fg_inventory_vector;

/* Lists the vectors in a file, without reading whole fields where possible. Statuses as
 * fg_field_read. */
FG_API fg_status fg_inventory_read(fg_inventory **out, fg_context *context,
                                   const char *input);
/* The same of the one vector that fg_field_read would read with these options, whose time
 * and level do not count; what takes the reading of samples or of a mesh is not found:
 * missing_share, and of meshes size, bounds and cells. options may be NULL. */
FG_API fg_status fg_inventory_read_chosen(fg_inventory **out, fg_context *context,
                                          const char *input,
                                          const fg_read_options *options);

/* The default level of a vector, and what its file lacks, found before it is read. */
typedef struct fg_usual {
  int level;        /* of an ocean's levels the one at the surface, which has the greatest
                       height or the least depth; else 0 */
  char absent[256]; /* "lat, lon": coordinates that the components name and the file
                       lacks, so that the grid is read on its indices; "" none */
} fg_usual;

/* Finds these for the vector that fg_field_read would read with these options, whose
 * level does not count. Reads no samples. Of other files than NetCDF the level is 0 and
 * `absent` empty. Statuses as fg_field_read; options may be NULL. */
FG_API fg_status fg_usual_find(fg_usual *out, fg_context *context, const char *input,
                               const fg_read_options *options);

FG_API void fg_inventory_destroy(fg_inventory *inventory);
FG_API const char *fg_inventory_format(const fg_inventory *inventory);
FG_API int fg_inventory_vector_count(const fg_inventory *inventory);
FG_API const fg_inventory_vector *fg_inventory_vector_at(const fg_inventory *inventory,
                                                         int index);

/* Times or levels that a text selects. */
typedef struct fg_selection {
  int *index;   /* [count] ascending */
  int count;    /* at least 1 */
  bool several; /* the text is a range, a list or "all", also where that comes to one */
  bool nearest; /* what was asked for is not there, and the nearest to it was taken */
} fg_selection;

/* Finds which of `count` times (what: "time") or levels ("level") a text selects, items
 * with commas between them:
 *   7            a plain whole number is an index, from 0
 *   300hPa 2.5h 0.995 850.   a number with a unit or a decimal point or exponent is a
 *                value, without a unit in the file's; pressures, lengths and times are
 *                converted
 *   1982-07 1982-07-16 1982-07-16T12:00[:30]   a date is the first time within that
 *                month, day, hour, minute or second
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
