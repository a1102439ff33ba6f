/* Vector fields: reading, creating, evaluating, cutting and writing them. */
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
  FG_SCALE_PLAIN,    /* axes without a known unit */
  FG_SCALE_LOG       /* of reading: a vertical section whose heights or pressures are
                        drawn by their logarithm; the field's is PLAIN */
} fg_scale;

typedef struct fg_map_options fg_map_options; /* map.h */

/* The directions of a vector's components on a model's grid; docs/method/model-grids.md
 * has the rules of AUTO. */
typedef enum fg_frame {
  FG_FRAME_AUTO = 0, /* by names, attributes and the grid */
  FG_FRAME_EAST,     /* east and north */
  FG_FRAME_GRID      /* the directions of the grid's indices or axes */
} fg_frame;

/* A zero field means its default, in brackets. */
typedef struct fg_read_options {
  const char *vars; /* "U,V", "U,V,W", a speed and its direction, or one vector variable;
                       NULL: found */
  const char *vars_from; /* second file, with the other component(s), the positions or
                            the mesh; NULL: none */
  const char *mesh_from; /* file with the positions or the mesh, beside vars_from; NULL:
                            none */
  const char *at;        /* "number=2,expver=5": of dimensions, as those that are neither
                            time nor level, the one sample of each to read: by a whole
                            number that is its value, else its index; or as
                            fg_selection_find has it; NULL: none */
  int time;              /* index along time, from 0 */
  int level;             /* index along level, from 0 */
  const char *mask;      /* variable that is zero, negative or missing outside the domain;
                            NULL:      none, or one that a model's file is known for */
  const char
      *missing; /* "-9999,1e20": numbers that stand for missing values besides those
                   that the file declares; "none": every number is a value, also
                   one that recurs apart from all others; NULL: none is given */
  fg_scale scale;
  const char *block; /* of a file in blocks, the block of this name and those within it;
                        NULL: all together */
  fg_frame frame;
  const char *slice; /* a plane to cut a field in 3D by (fg_plane_parse); NULL: none */
  const fg_map_options *map; /* projection of a field in longitude and latitude; NULL:
                                none */
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
 * NetCDF-4, and ecCodes, under GRIB, can crash, go on for ever, print or, ecCodes, take
 * any memory where a file's structure is damaged: fg_input_options.isolate keeps that
 * from the process that calls them. Files
 * are mapped: one that becomes shorter meanwhile is refused, FILE_ACCESS, but it can send
 * SIGBUS to the process before, which the program ends at (cli/interrupt.c). */
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
  const char *doubts;     /* what is unsure of how a file was read, a line each; NULL:
                             nothing */
} fg_field_arrays;

/* Copies arrays into a new field. ARGUMENT (sizes, order of axes, no valid cell, speeds
 * beyond 1e15, a field that is zero everywhere, a sample whose components are all -999 or
 * all another number that stands for missing data), UNSUPPORTED (3D with scale GEO),
 * MEMORY. */
FG_API fg_status fg_field_create(fg_field **out, fg_context *context,
                                 const fg_field_arrays *arrays);
FG_API void fg_field_destroy(fg_field *field);

/* Makes a field of vectors at scattered points, in any order. Of `points` size[0] is
 * their number, from 3 on; axis[k] and velocity[k] are each point's coordinate and
 * component along k, size[0] numbers each; valid has a byte a point; other sizes and
 * periods do not count. Points on a grid along the axes become its samples. Others are
 * interpolated onto an even raster, linearly in Delaunay's triangles, with scale GEO on
 * the sphere, or in space, from 64 points on, by local linear fits; it is missing beyond
 * them and in gaps (docs/design/points.md). Points in space that lie in a plane give a
 * field in 2D in that plane. Points at one place become their mean. Copies what it needs.
 * ARGUMENT (fewer than 3 points, a coordinate that is no number, more than a tenth of
 * them at places of others with other values; and as fg_field_create), UNSUPPORTED (all
 * on one line, too few in space), MEMORY, STOPPED. */
FG_API fg_status fg_field_create_scattered(fg_field **out, fg_context *context,
                                           const fg_field_arrays *points);

/* The field's own arrays and words, borrowed; no pointer in it is NULL but `valid` (then
 * every sample counts), in 2D `axis[2]`, `velocity[2]`, and `time`, `level` (not chosen),
 * `projection`. */
FG_API const fg_field_arrays *fg_field_contents(const fg_field *field);

/* The number of samples that are missing because a component is infinite: in a slab those
 * of its own rows, after fg_field_join those of all ranks. */
FG_API size_t fg_field_infinite(const fg_field *field);

/* The share of samples that are missing, likewise. */
FG_API double fg_field_missing_share(const fg_field *field);

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
 * two planes beside it. Any other plane becomes an even raster, with a sample or several
 * for one of the volume, interpolated (fg_field_velocity) and missing outside it. Its
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

/* Parses a plane: "NAME=VALUE" with the name of an axis or x, y, z; or "NX,NY,NZ@X,Y,Z",
 * normal and point. With a NULL volume only the syntax is checked. ARGUMENT. */
FG_API fg_status fg_plane_parse(fg_plane *out, fg_context *context, const char *text,
                                const fg_field *volume);

/* For a field that is a plane in space, cut or read with three components: the mean
 * square of the velocity's component normal to the plane over that of the velocity, 0 to
 * 1; 0 for other fields and for slabs. */
FG_API double fg_field_normal_share(const fg_field *field);

/* What is measured at a coordinate of an axis, and its units: of a vertical section a
 * height or a pressure, which is drawn on another scale (axis_units "-25 hPa": one of the
 * axis is 25 hPa downwards); else the coordinate. */
FG_API double fg_field_measured(const fg_field *field, int axis, double coordinate);
FG_API void fg_field_measured_units(char *out, size_t size, const fg_field *field,
                                    int axis);

/* The 5 % and the 95 % quantile of the speed by area (volume), input units: for the ends
 * of a colour key that several fields share. ARGUMENT (a slab), MEMORY. */
FG_API fg_status fg_field_speed_range(double range[2], fg_context *context,
                                      const fg_field *field);

/* Writes a field as .vti (VTK XML image data, with scale, projection, time and level as
 * FieldData) or .nc (NetCDF, CF). UNSUPPORTED (a name with another end, uneven axes in a
 * .vti, a build without FG_FEATURE_NETCDF), ARGUMENT (a slab), FILE_ACCESS, MEMORY. */
FG_API fg_status fg_field_write(fg_context *context, const char *path,
                                const fg_field *field);

#ifdef __cplusplus
}
#endif

#endif
