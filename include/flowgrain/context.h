/* The version and its features, statuses, the context, and the ranks that share the work.
 */
#ifndef FLOWGRAIN_CONTEXT_H
#define FLOWGRAIN_CONTEXT_H

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

typedef enum fg_status {
  FG_STATUS_OK = 0,
  FG_STATUS_MEMORY,         /* an allocation failed */
  FG_STATUS_ARGUMENT,       /* an argument is out of range or contradicts another */
  FG_STATUS_FILE_ACCESS,    /* a file cannot be opened, read or written */
  FG_STATUS_FILE_FORMAT,    /* a file is damaged or not what it claims to be */
  FG_STATUS_UNSUPPORTED,    /* well-formed, but not supported */
  FG_STATUS_NO_CONVERGENCE, /* mass is not conserved, the energy grows, or no step
                               converges */
  FG_STATUS_STOPPED,        /* fg_context_stop was called */
  FG_STATUS_MPI             /* the message-passing layer failed */
} fg_status;

typedef struct fg_context fg_context;

/* Returns the version of the library in use, "0.1.0". */
FG_API const char *fg_version(void);

/* What a build of the library may leave out (CMake's FLOWGRAIN_NETCDF=OFF, ...).
 * Functions that need it are there all the same, and return UNSUPPORTED. */
typedef enum fg_feature {
  FG_FEATURE_NETCDF = 0, /* reading and writing NetCDF */
  FG_FEATURE_VTK,        /* reading VTK's files; writing them is always possible */
  FG_FEATURE_IMAGES,     /* reading PNG, JPEG, PGM and PPM */
  FG_FEATURE_PICTURES,   /* drawing SVG, PDF and PNG */
  FG_FEATURE_RENDER,     /* drawing fields in 3D */
  FG_FEATURE_MAPS,       /* map projections: flowgrain/map.h */
  FG_FEATURE_MPI,        /* several processes: flowgrain/mpi.h */
  FG_FEATURE_GRIB,       /* reading GRIB */
  FG_FEATURE_VIEWER,     /* the page for browsers: flowgrain/view.h */
  FG_FEATURES            /* how many there are */
} fg_feature;

/* Whether the library in use has a feature. */
FG_API bool fg_has_feature(fg_feature feature);

/* Returns a feature's name, "netcdf"; NULL from FG_FEATURES on. */
FG_API const char *fg_feature_name(fg_feature feature);

/* Refuses `what`, a file's name or a kind of work, where the library lacks a feature; the
 * message says how it was left out. UNSUPPORTED. */
FG_API fg_status fg_require_feature(fg_context *context, const char *what,
                                    fg_feature feature);

/* Returns the standard word for a status, "malformed file" for example. */
FG_API const char *fg_status_name(fg_status status);

/* Creates a context, which has the message of the first failure, the stop flag and the
 * ranks. MEMORY. */
FG_API fg_status fg_context_create(fg_context **out);
FG_API void fg_context_destroy(fg_context *context);

/* The first failure's message, one line without a line end, "" when there was none:
 * "FILE: what is wrong, with the numbers that show it". */
FG_API const char *fg_context_message(const fg_context *context);

/* A second line that says what to do about the failure, or "". */
FG_API const char *fg_context_hint(const fg_context *context);

/* Clears the failure, so that the context can be used again. A context that was asked to
 * stop remains stopped. */
FG_API void fg_context_clear(fg_context *context);

/* Asks the functions running with this context to return FG_STATUS_STOPPED soon. The only
 * function that may be called from a signal handler or another thread. */
FG_API void fg_context_stop(fg_context *context);

/* What reading files with a context may use. A zero field means its default, in brackets.
 */
typedef struct fg_input_options {
  const void *bytes;  /* content of the input "-", borrowed until the context ends; NULL:
                         "-" is a file's name like any other */
  size_t size;        /* number of these bytes */
  const char *format; /* of fields: a name of fg_inventory_format in lower case with
                         dashes for spaces, "vtk-legacy"; "vtk": any of VTK's [found from
                         the content] */
  double most_memory; /* bytes that the samples of a field may take; more: UNSUPPORTED
                         [any number] */
  bool isolate; /* files that libhdf5 (NetCDF-4) or ecCodes (GRIB) reads are read in a
                   child process, with bounds of time and memory, as these libraries may
                   crash or go on for ever where a file's structure is damaged:
                   FILE_ACCESS. To be set before threads start [read in this process] */
} fg_input_options;

/* Sets them; what they point to is borrowed. NULL: the defaults. */
FG_API void fg_context_set_input(fg_context *context, const fg_input_options *options);

/* Ranks: processes that share one evolution. A context has the ranks of the communicator
 * that it was given (mpi.h), and this process alone without one.
 *
 * fg_evolution_create, fg_checkpoint_open, fg_field_join and the calls that take an
 * evolution are collective: every rank makes them in the same order, with the same field
 * (each the whole field, or each its slab: slabs.h), options and path, and all get the
 * same status; when one fails, every context holds its message. Densities are distributed
 * likewise (fg_density_create). All other calls concern one rank. Distributed objects
 * must be destroyed before their context. */

/* This rank's number, from 0, and how many there are: 0 of 1 for a context without a
 * communicator, or NULL. */
FG_API void fg_ranks(const fg_context *context, int *rank, int *count);

/* Makes ranks agree on a failure: when `status` is a failure on some rank, all return
 * that of the lowest such rank, and every context holds that rank's message and hint in
 * place of its own. FG_STATUS_STOPPED gives way to other failures. message: what to tell
 * of this rank's failure instead of the context's message (hint: NULL, none), or NULL.
 * Collective. */
FG_API fg_status fg_ranks_agree(fg_context *context, fg_status status,
                                const char *message, const char *hint);

#ifdef __cplusplus
}
#endif

#endif
