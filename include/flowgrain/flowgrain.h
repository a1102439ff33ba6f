/* flowgrain: simple pictures of complicated vector fields, at every scale.
 *
 * A field is read (fg_field), a density evolves on it by an anisotropic Cahn-Hilliard
 * equation (fg_evolution), the set {u > 0} of a moment (fg_density) falls into clusters,
 * each cluster becomes one curved arrow (fg_icons), and arrows become pictures and
 * tables. Method: Garcke, Preusser, Rumpf, Telea, Weikard and van Wijk, "A Continuous
 * Clustering Method for Vector Fields", IEEE Visualization 2000.
 *
 *     fg_context *ctx;  fg_field *field;  fg_evolution *evolution;
 *     fg_density *density;  fg_icons *icons;
 *     fg_context_create(&ctx);
 *     fg_field_read(&field, ctx, "wind.nc", NULL);
 *     fg_evolution_create(&evolution, ctx, field, NULL);
 *     do
 *       fg_evolution_step(evolution, &step);
 *     while (step.clusters > 40 || !step.clusters);
 *     fg_density_create(&density, evolution);
 *     fg_icons_create(&icons, ctx, field, density, NULL);
 *     fg_picture_write(ctx, "wind.svg", field, density, icons, NULL);
 *
 * Conventions
 * - A function that can fail returns fg_status; its result comes first, through `out`,
 *   and belongs to the caller, who ends it with the matching destroy. Destroys accept
 *   NULL.
 * - Pointers returned to const are borrowed: they live as long as what they came from.
 * - Option structs: a zero field means the default; a NULL pointer means all defaults.
 * - On failure the context keeps one message (the first), with the numbers that show it.
 * - Arrays of samples run x fastest, then y, then z. Coordinates are the input's own.
 * - A context, and what was made with it, is used by one thread at a time; a finished
 *   fg_field or fg_density may be read by several threads that hold a context each.
 *   Files are read by one thread at a time: the NetCDF and HDF5 libraries are not made
 * for more.
 */
#ifndef FLOWGRAIN_H
#define FLOWGRAIN_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#define FG_VERSION_MAJOR 0
#define FG_VERSION_MINOR 1
#define FG_VERSION_PATCH 0

#if defined(__GNUC__)
#define FG_API __attribute__((visibility("default")))
#else
#define FG_API
#endif

/* Statuses and the context. */

typedef enum fg_status {
  FG_STATUS_OK = 0,
  FG_STATUS_MEMORY,         /* an allocation failed */
  FG_STATUS_ARGUMENT,       /* the caller asked for something impossible */
  FG_STATUS_FILE_ACCESS,    /* a file cannot be opened, read or written */
  FG_STATUS_FILE_FORMAT,    /* a file is damaged or not what it claims to be */
  FG_STATUS_UNSUPPORTED,    /* well-formed, but nothing here can handle it */
  FG_STATUS_NO_CONVERGENCE, /* the evolution broke one of its promises */
  FG_STATUS_STOPPED,        /* fg_context_stop was called */
  FG_STATUS_MPI             /* the message-passing layer failed */
} fg_status;

typedef struct fg_context fg_context;

/* Returns the version of the library in use, "0.1.0". */
FG_API const char *fg_version(void);

/* Returns the standard word for a status, "malformed file" for example. */
FG_API const char *fg_status_name(fg_status status);

/* Makes a context: the place of messages and of the stop flag. MEMORY. */
FG_API fg_status fg_context_create(fg_context **out);
FG_API void fg_context_destroy(fg_context *context);

/* The first failure's message, one line without a line end, "" when there was none:
 * "FILE: what is wrong, with the numbers that show it". */
FG_API const char *fg_context_message(const fg_context *context);

/* A second line that says what to do about the failure, or "". */
FG_API const char *fg_context_hint(const fg_context *context);

/* Forgets the failure, so that the context can be used again. */
FG_API void fg_context_clear(fg_context *context);

/* Asks the work going on with this context to end with FG_STATUS_STOPPED at its next safe
 * point. The only function that may be called from a signal handler or another thread. */
FG_API void fg_context_stop(fg_context *context);

/* Ranks: processes that a launcher such as mpirun started together share one evolution.
 *
 * fg_evolution_create, fg_checkpoint_open and the calls that take an evolution are
 * collective: every rank makes them in the same order, with the same field (each has it
 * whole, or all their parts of it: parts.h), options and path, and all get the same
 * status; when one fails, every context holds its message. Densities are shared likewise
 * (fg_density_create). All else is the business of the rank that calls it. A program that
 * MPI does not know of has one rank and need not care. */

/* This rank's number, from 0, and how many there are. Starts MPI when a launcher started
 * this process, and ends it when the process exits; a program that uses MPI itself starts
 * and ends it itself. Collective in the first call. MPI. */
FG_API fg_status fg_ranks(fg_context *context, int *rank, int *count);

/* Makes one failure of many, for what ranks do each on its own: when `status` is one on
 * some rank, all return that of the lowest such rank, and every context holds that rank's
 * message and hint in place of its own. FG_STATUS_STOPPED gives way to other failures.
 * message: what to tell of this rank's failure instead of what the context holds (hint:
 * NULL, none), or NULL. Collective. */
FG_API fg_status fg_ranks_agree(fg_context *context, fg_status status,
                                const char *message, const char *hint);

/* Fields. */

typedef struct fg_field fg_field;

typedef enum fg_scale {
  FG_SCALE_AUTO = 0, /* from units and axes */
  FG_SCALE_GEO,      /* axes in degrees, velocity along east and north */
  FG_SCALE_MAP,      /* projected plane: axes in a length, velocity along the axes */
  FG_SCALE_PLAIN     /* axes without a known unit */
} fg_scale;

typedef struct fg_read_options {
  const char *vars;      /* "U,V", "U,V,W" or one vector variable; NULL: found */
  const char *vars_from; /* second file with the other component(s) */
  int time;              /* index along time, from 0 */
  int level;             /* index along level, from 0 */
  const char *mask; /* variable that is zero (negative, missing) outside the domain */
  fg_scale scale;
} fg_read_options;

/* Reads a field from a file, or makes an analytic one from "synth:NAME" (sampled at 257
 * nodes a side in 2D, at 65 in 3D). The format is found from the content, not the name.
 * options may be NULL. FILE_ACCESS, FILE_FORMAT, UNSUPPORTED, ARGUMENT (names, indices),
 * MEMORY. */
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
                                 fastest; NaN: missing */
  const unsigned char *valid; /* a byte a sample, 0 = missing; NULL: all but NaN */
  fg_scale scale;             /* AUTO means PLAIN */
  const char *velocity_name[3]; /* NULL: "u", "v", "w" */
  const char *velocity_units;   /* NULL: "" */
  const char *axis_name[3];     /* NULL: "x", "y", "z" */
  const char *axis_units[3];    /* NULL: "" */
  const char *title;            /* what it is, for captions; NULL: "" */
  const char *time;             /* the chosen time in words; NULL: none */
  const char *level;            /* the chosen level in words; NULL: none */
} fg_field_arrays;

/* Copies arrays into a new field. ARGUMENT (sizes, order of axes, no valid cell, infinite
 * values, a field that is zero everywhere), UNSUPPORTED (3D with scale GEO), MEMORY. */
FG_API fg_status fg_field_create(fg_field **out, fg_context *context,
                                 const fg_field_arrays *arrays);
FG_API void fg_field_destroy(fg_field *field);

/* The field's own arrays and words, borrowed; no pointer in it is NULL but `valid` (then
 * every sample counts), in 2D `axis[2]`, `velocity[2]`, and `time`, `level` (not chosen).
 */
FG_API const fg_field_arrays *fg_field_contents(const fg_field *field);

/* Velocity at a point in the input's units, bilinear or trilinear; false outside the
 * domain: beyond the border, or in a data cell with a missing corner. position and
 * velocity: dimension numbers. */
FG_API bool fg_field_velocity(const fg_field *field, const double position[],
                              double velocity[]);

/* The direction of the streamline in the axes' coordinates, not normalised: (u, v(, w)),
 * but (u / cos latitude, v) on a longitude-latitude grid. False as above. */
FG_API bool fg_field_tangent(const fg_field *field, const double position[],
                             double tangent[]);

/* Writes a field as .vti (VTK XML image data; axes must be evenly spaced) or .nc
 * (NetCDF, CF). UNSUPPORTED for other names' ends, FILE_ACCESS, MEMORY. */
FG_API fg_status fg_field_write(fg_context *context, const char *path,
                                const fg_field *field);

/* What a file holds. */

typedef struct fg_inventory fg_inventory;

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
} fg_inventory_vector;

/* Says what a file holds, without reading a whole field where that can be avoided.
 * Statuses as fg_field_read. */
FG_API fg_status fg_inventory_read(fg_inventory **out, fg_context *context,
                                   const char *input);
FG_API void fg_inventory_destroy(fg_inventory *inventory);
FG_API const char *fg_inventory_format(const fg_inventory *inventory);
FG_API int fg_inventory_vector_count(const fg_inventory *inventory);
FG_API const fg_inventory_vector *fg_inventory_vector_at(const fg_inventory *inventory,
                                                         int index);

/* The evolution. */

typedef struct fg_evolution fg_evolution;

typedef enum fg_energy {
  FG_ENERGY_FLOW = 0,  /* interfaces along streamlines are cheap */
  FG_ENERGY_ISOTROPIC, /* the original Cahn-Hilliard model */
  FG_ENERGY_GRADIENT,  /* interfaces along level sets of the speed are cheap */
  FG_ENERGY_LAW        /* of the caller's own: `law` in the options says which */
} fg_energy;

typedef struct fg_energy_law fg_energy_law; /* flowgrain/energy.h */

/* All solve the same equation, docs/method/schemes.md compares them. */
typedef enum fg_scheme {
  FG_SCHEME_BDF2 = 0, /* backward differences of second order: steps as large as the
                         change of u allows */
  FG_SCHEME_EULER,    /* implicit Euler: the same of first order */
  FG_SCHEME_THETA     /* theta-splitting in three substeps: second order, small steps */
} fg_scheme;

typedef struct fg_evolution_options {
  int nodes;                /* nodes along the longest side of the mesh [257] */
  fg_energy energy;         /* [flow] */
  const fg_energy_law *law; /* NULL: none; else in place of `energy` */
  double anisotropy;        /* a, in (0, 1] [0.15] */
  double coverage;          /* share of the area clusters shall cover, in (0, 1) [0.3] */
  double gamma;             /* interface energy, in units of the longest side squared
                               [(1.1 h)^2 / a; isotropic (1.5 h)^2] */
  uint64_t seed;            /* of the initial noise [1] */
  double accuracy;          /* eta: rms change of u allowed in a step [0.08; else 0.05] */
  int cycles;               /* multigrid cycles a step, or a substep [3] */
  fg_scheme scheme;         /* of the time steps [BDF2] */
  int threads;              /* [all cores] */
  const float *initial; /* NULL: noise; else u at the nodes of the mesh, as fg_density has
                           it: copied, then shifted nowhere: its mean is kept */
} fg_evolution_options;

typedef struct fg_step {
  long step;            /* accepted steps so far */
  double time;          /* t, in units of (longest side)^2 */
  double tau;           /* size of this step */
  double energy;        /* E(u) */
  double mass;          /* integral of u over the domain, in double */
  double area_fraction; /* share of the domain where u > 0 */
  int clusters;         /* components of {u > 0} above the size of debris; 0 while the
                           covered area is below 0.8 of the coverage */
  int cycles;           /* multigrid cycles spent on this step, rejects included */
  int rejected;         /* attempts rejected before this step was accepted */
  long cells;           /* active cells of the mesh */
  double increment;     /* rms of the change of u */
  double seconds;       /* wall time since the evolution was created */
  bool stationary;      /* the pattern no longer changes */
} fg_step;

/* Builds mesh, tensor and initial density. nodes is rounded up so that the mesh can be
 * coarsened; fg_evolution_mesh says what it became. ARGUMENT (options out of range, a
 * field in 3D, ranks that disagree on field or options), MEMORY, MPI. */
FG_API fg_status fg_evolution_create(fg_evolution **out, fg_context *context,
                                     const fg_field *field,
                                     const fg_evolution_options *options);
FG_API void fg_evolution_destroy(fg_evolution *evolution);

/* Makes one accepted time step and describes it. NO_CONVERGENCE when no step small enough
 * is accepted, or mass or energy break their promise; STOPPED. */
FG_API fg_status fg_evolution_step(fg_evolution *evolution, fg_step *step);

typedef struct fg_mesh_info {
  int dimension;
  int cells[3];      /* along each axis */
  double spacing[3]; /* in the input's coordinates */
  double gamma;      /* as used, in units of the longest side squared */
  double anisotropy, coverage;
  double length;         /* the longest side in the input's coordinates */
  double domain_measure; /* area (volume) of the active cells, units of length squared */
  long active_cells;
  const char *kernel; /* which vector instructions run: "avx512", "avx2", "generic" */
} fg_mesh_info;

FG_API const fg_mesh_info *fg_evolution_mesh(const fg_evolution *evolution);

/* What ranks tell each other, by what it is for. */
typedef enum fg_activity {
  FG_ACTIVITY_OTHER = 0, /* agreements and whatever else is outside of these: */
  FG_ACTIVITY_SETUP,     /* fg_evolution_create */
  FG_ACTIVITY_STEPS,     /* fg_evolution_step, apart from its cycles and the counting */
  FG_ACTIVITY_CYCLES,    /* multigrid cycles */
  FG_ACTIVITY_COUNTING,  /* clusters and the area covered, at every step */
  FG_ACTIVITY_SNAPSHOTS  /* fg_density_create, and icons and files of shared densities */
} fg_activity;

enum { FG_ACTIVITIES = FG_ACTIVITY_SNAPSHOTS + 1 };

/* Numbers of one rank. An exchange is a round of messages, one to each neighbour that
 * needs anything, which wait for each other only at its end. */
typedef struct fg_traffic {
  double times; /* that the activity was begun; 0 for OTHER */
  double exchanges;
  double messages, bytes;     /* sent to single ranks */
  double gathers, gathered;   /* all ranks' pieces on each; bytes received from others */
  double reductions, reduced; /* sums and the like over all ranks; bytes given */
} fg_traffic;

/* What the ranks of an evolution told each other since the program began, exact: the mean
 * over ranks and the greatest of each number, all 0 with one rank. What p4est sends is
 * not in it. Collective. */
FG_API void fg_evolution_traffic(const fg_evolution *evolution, fg_traffic mean[],
                                 fg_traffic greatest[]);

/* Checkpoints: an evolution goes on in other processes, on any number of ranks, as if it
 * had never ended. All ranks need the file: a file system of their own will not do. */

typedef struct fg_checkpoint fg_checkpoint;

/* Writes the state of an evolution, and a text of the caller's own (NULL: ""), which
 * fg_checkpoint_note gives back (that of rank 0). The file takes its name when it is
 * whole and on the disk; what had the name before is then called PATH.previous. On
 * failure both stay as they were and the evolution can go on. FILE_ACCESS, MEMORY. */
FG_API fg_status fg_evolution_save(const fg_evolution *evolution, const char *path,
                                   const char *note);

/* Opens a checkpoint and checks every byte of it. When it is damaged or not there,
 * PATH.previous is opened instead, and fg_checkpoint_damage says why. FILE_ACCESS,
 * FILE_FORMAT (both are damaged), UNSUPPORTED (another format), MEMORY. */
FG_API fg_status fg_checkpoint_open(fg_checkpoint **out, fg_context *context,
                                    const char *path);
FG_API void fg_checkpoint_destroy(fg_checkpoint *checkpoint);
FG_API const char *fg_checkpoint_note(const fg_checkpoint *checkpoint);

/* Why the previous checkpoint was opened, "PATH: damaged: ...", or "". */
FG_API const char *fg_checkpoint_damage(const fg_checkpoint *checkpoint);

/* Puts an evolution, just created from the same field with the same options (threads may
 * differ), into the state of a checkpoint: every later step is the same to the last bit
 * as without the interruption. `step` becomes the last accepted one; it counts no cycles
 * and rejections. After a failure the evolution is of no use. ARGUMENT (another field or
 * option: the message names it with both values), UNSUPPORTED (written by another
 * version), FILE_ACCESS, FILE_FORMAT, MEMORY. */
FG_API fg_status fg_evolution_resume(fg_evolution *evolution, fg_step *step,
                                     const fg_checkpoint *checkpoint);

/* A moment of the evolution. */

/* The density at the nodes of a uniform grid over the field's box; a snapshot that stays
 * as it is while the evolution goes on. */
typedef struct fg_density fg_density;

typedef struct fg_density_arrays {
  int dimension;     /* 2 or 3; without a third axis nodes[2] reads 1 */
  int nodes[3];      /* along a periodic axis the repeated last node is left out */
  double origin[3];  /* node (0, 0, 0), input coordinates */
  double spacing[3]; /* input coordinates */
  bool periodic[3];
  const float *u;              /* a value a node; inside a cluster u > 0; NULL: shared */
  const unsigned char *active; /* a byte a cell, 0 = masked; nodes[k] - 1 cells along an
                                  axis, nodes[k] when periodic; NULL: all active */
  double debris_area; /* components of less area (volume) than this are not clusters, in
                         input coordinates squared (cubed) */
  double time, energy, area_fraction;
  int clusters;
} fg_density_arrays;

/* Takes a snapshot. Where several ranks evolve, each gets its share: `u` and `active` of
 * its contents are NULL, and what takes a shared density is collective. MEMORY. */
FG_API fg_status fg_density_create(fg_density **out, const fg_evolution *evolution);

/* Whether a density is shared by several ranks. */
FG_API bool fg_density_is_shared(const fg_density *density);

/* Puts a shared density together on rank 0; on other ranks *out becomes NULL. Collective.
 * MEMORY, ARGUMENT (it is not shared). */
FG_API fg_status fg_density_gather(fg_density **out, fg_context *context,
                                   const fg_density *density);

/* Copies arrays into a density of its own, for icons from elsewhere. ARGUMENT, MEMORY. */
FG_API fg_status fg_density_create_from_arrays(fg_density **out, fg_context *context,
                                               const fg_density_arrays *arrays);
FG_API void fg_density_destroy(fg_density *density);
FG_API const fg_density_arrays *fg_density_contents(const fg_density *density);

/* Writes u, the number of each node's cluster (0 outside, -1 in components too small to
 * be clusters) and the mask as .vti. Of a shared density rank 0 writes what the others
 * send it, packed and part by part; `path` is not read elsewhere. FILE_ACCESS,
 * UNSUPPORTED, MEMORY. */
FG_API fg_status fg_density_write(fg_context *context, const char *path,
                                  const fg_density *density);

/* Icons. */

typedef enum fg_icon_kind {
  FG_ICON_ARROW = 0, /* a curved arrow along one streamline */
  FG_ICON_RING,      /* an arrow round a vortex, an arc of at most about 300 degrees */
} fg_icon_kind;

/* A curved arrow: a tapering body round the centreline and a triangular head; in 3D a
 * tube and a cone. */
typedef struct fg_icon {
  int cluster; /* label in the density, from 1 */
  fg_icon_kind kind;
  int point_count;           /* of the centreline, at least 2 */
  const double (*points)[3]; /* from tail to the tip of the head; z = 0 in 2D; across a
                                periodic border the coordinate goes on past it */
  double width;              /* body's full width where the head begins */
  double tail_width;         /* body's full width at the tail */
  double head_length;        /* along the centreline */
  double head_width;         /* full width of the head's base */
  double center[3];          /* centre of the cluster's spine, on the centreline */
  double area;               /* of the cluster (volume in 3D) */
  double speed;              /* mean |v| along the centreline, input units */
  /* Unless the icon was read from a file: the cluster's spine from end to end, a ring's
   * back to where it begins; and in 3D all of the streamline in the cluster, of which the
   * centreline is a part. */
  int spine_count, streamline_count;
  const double (*spine)[3], (*streamline)[3];
} fg_icon;

typedef enum fg_icon_extent {
  FG_ICON_EXTENT_CLUSTER = 0, /* an arrow stays in its cluster */
  FG_ICON_EXTENT_TERRITORY /* it goes on to the border with the next cluster's territory
                              (what lies nearest to it, round masks), and is at most
                              2 sqrt(domain area / clusters) long */
} fg_icon_extent;

typedef struct fg_icon_options {
  int threads;           /* [1] */
  fg_icon_extent extent; /* [cluster] */
} fg_icon_options;

typedef struct fg_icons fg_icons;

/* Makes the icons of a density: label, march, spine, streamline, arrow. Clusters too
 * small for a readable arrow give none; fg_icons_dropped counts them. Of a shared density
 * each rank makes the icons of some clusters, from what lies round them, and rank 0 gets
 * all, the same as of the whole; on other ranks *out becomes NULL. UNSUPPORTED
 * (FG_ICON_EXTENT_TERRITORY in 3D, or of a shared density: fg_density_gather), MEMORY,
 * STOPPED. */
FG_API fg_status fg_icons_create(fg_icons **out, fg_context *context,
                                 const fg_field *field, const fg_density *density,
                                 const fg_icon_options *options);
FG_API void fg_icons_destroy(fg_icons *icons);
FG_API int fg_icons_count(const fg_icons *icons);
FG_API const fg_icon *fg_icons_at(const fg_icons *icons, int index);
FG_API int fg_icons_clusters(const fg_icons *icons); /* clusters, drawn or dropped */
FG_API int fg_icons_dropped(const fg_icons *icons);

/* Outline of an icon as a closed polygon, the first vertex not repeated. *vertices is
 * allocated with malloc: free it. MEMORY. */
FG_API fg_status fg_icon_outline(const fg_icon *icon, double (**vertices)[2], int *count);

/* Writes icons as GeoJSON (a LineString each, coordinates of the input), or reads them
 * back. FILE_ACCESS, FILE_FORMAT, MEMORY. */
FG_API fg_status fg_icons_write(fg_context *context, const char *path,
                                const fg_icons *icons);
FG_API fg_status fg_icons_read(fg_icons **out, fg_context *context, const char *path);

/* Pictures. */

typedef struct fg_picture_options {
  double width;            /* of the whole picture, in points of 1/72 inch [480] */
  double height;           /* [0: follows from the domain's shape] */
  double pixels_per_point; /* for PNG [2] */
  const char *palette; /* name of a colour map, or "#rrggbb" for one colour ["gale"] */
  double speed_min, speed_max;         /* ends of the colour key; equal: from the icons */
  bool no_frame;                       /* only mask and arrows */
  bool transparent;                    /* no background */
  bool tint;                           /* tint the clusters (density needed) */
  const struct fg_texture *background; /* behind all, in pale greys (texture.h) [none] */
  double background_fade;              /* share of its way to white, 0 to 1 [0.7] */
  bool skeletons;    /* mark the clusters' spines and centres, where icons have
                        them */
  const char *title; /* caption; NULL: from the field; "" none */
  double font_size;  /* points [0: follows from the size; 9 at 480 points] */
  bool no_keys;      /* no colour key, no arrow for the size */
  const char *mask_color, *tint_color; /* "#rrggbb" [light grey, light blue] */
  double
      scale_time; /* t of the scale, for the caption [the density's; none without it] */
} fg_picture_options;

/* Names of the colour maps, ended by NULL. */
FG_API const char *const *fg_picture_palettes(void);

/* Draws icons; the format follows the name's end: .svg, .pdf or .png. density may be NULL
 * without tint, and must not be shared; options may be NULL. FILE_ACCESS, UNSUPPORTED,
 * ARGUMENT, MEMORY. */
FG_API fg_status fg_picture_write(fg_context *context, const char *path,
                                  const fg_field *field, const fg_density *density,
                                  const fg_icons *icons,
                                  const fg_picture_options *options);

#ifdef __cplusplus
}
#endif

#include "flowgrain/brush.h"
#include "flowgrain/energy.h"
#include "flowgrain/parts.h"
#include "flowgrain/rival.h"
#include "flowgrain/solid.h"
#include "flowgrain/texture.h"

#endif
