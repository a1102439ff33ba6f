"""The extension flowgrain._core: flowgrain_core and what of its interface Python calls.

cffi compiles the declarations against the headers of include/flowgrain, so that they cannot differ
from them. The library is made by CMake, which alone knows its sources and their flags.
"""

import os
import pathlib
import subprocess

import cffi

HERE = pathlib.Path(__file__).resolve().parent
SOURCE = HERE.parent

CDEF = """
typedef int... fg_status;
typedef struct fg_context fg_context;
const char *fg_version(void);
fg_status fg_context_create(fg_context **out);
void fg_context_destroy(fg_context *context);
const char *fg_context_message(const fg_context *context);
const char *fg_context_hint(const fg_context *context);
void fg_context_clear(fg_context *context);
void fg_context_stop(fg_context *context);
#define FG_STATUS_OK ...
#define FG_STATUS_MEMORY ...
#define FG_STATUS_STOPPED ...

typedef struct fg_field fg_field;
typedef int... fg_scale;
#define FG_SCALE_GEO ...
#define FG_SCALE_PLAIN ...
typedef struct fg_field_arrays {
  int dimension;
  int size[3];
  const double *axis[3];
  double period[3];
  const float *velocity[3];
  const unsigned char *valid;
  fg_scale scale;
  ...;
} fg_field_arrays;
fg_status fg_field_create(fg_field **out, fg_context *context, const fg_field_arrays *arrays);
fg_status fg_field_create_scattered(fg_field **out, fg_context *context,
                                    const fg_field_arrays *points);
const fg_field_arrays *fg_field_contents(const fg_field *field);
void fg_field_destroy(fg_field *field);

typedef struct fg_density fg_density;
typedef struct fg_density_arrays {
  int dimension;
  int nodes[3];
  double origin[3];
  double spacing[3];
  bool periodic[3];
  const float *u;
  double time;
  int clusters;
  ...;
} fg_density_arrays;
const fg_density_arrays *fg_density_contents(const fg_density *density);
const int *fg_density_labels(const fg_density *density);
void fg_density_destroy(fg_density *density);

typedef struct fg_icon {
  int cluster;
  int kind;
  int point_count;
  double width, tail_width, head_length, head_width;
  double center[3];
  double area, speed;
  int id, parent;
  ...;
} fg_icon;
typedef struct fg_icons fg_icons;
void fg_icons_destroy(fg_icons *icons);
int fg_icons_count(const fg_icons *icons);
const fg_icon *fg_icons_at(const fg_icons *icons, int index);
int fg_icons_clusters(const fg_icons *icons);
int fg_icons_dropped(const fg_icons *icons);
void fg_icons_speed_range(double range[2], const fg_icons *icons);
const double *icon_points(const fg_icon *icon);
fg_status line_outline(double **vertices, int *count, const double *points, int point_count,
                       const double sizes[4], int id);

typedef struct fg_surface {
  int vertex_count, corner_count, triangle_count;
  int *corner;
  ...;
} fg_surface;
const double *surface_vertex(const fg_surface *surface);
const float *surface_normal(const fg_surface *surface);
const int *surface_triangle(const fg_surface *surface);
fg_status line_solid(fg_surface **out, fg_context *context, const double *points,
                     int point_count, const double sizes[4]);
void fg_surface_destroy(fg_surface *surface);

typedef int... fg_lengths;
typedef int... fg_effort;
typedef struct fg_placement_options {
  fg_lengths lengths;
  fg_effort effort;
  ...;
} fg_placement_options;
typedef struct fg_placement fg_placement;
fg_status fg_placement_create(fg_placement **out, fg_context *context, const fg_field *field,
                              const fg_placement_options *options);
void fg_placement_destroy(fg_placement *placement);
fg_status fg_placement_place(fg_placement *placement, int count, const fg_icons *clusters);
fg_status fg_placement_within(fg_placement *placement, double degrees, int most, int *count);
fg_status fg_placement_icons(fg_icons **out, const fg_placement *placement);
fg_status fg_placement_regions(fg_density **out, const fg_placement *placement);
fg_status fg_placement_find_clusters(fg_context *context, fg_icons *icons,
                                     const fg_density *density);

typedef int... fg_energy;
typedef struct fg_evolution_options {
  int nodes;
  double anisotropy, coverage;
  uint64_t seed;
  int threads;
  ...;
} fg_evolution_options;
typedef struct fg_step { int64_t step; double time; int clusters; ...; } fg_step;

typedef int... fg_run_kind;
typedef struct fg_run_options {
  fg_run_kind kind;
  const int *numbers;
  int count;
  fg_evolution_options evolution;
  fg_placement_options placement;
  bool even_start;
  ...;
} fg_run_options;
typedef struct fg_run_scale {
  int index;
  fg_step step;
  const fg_density *density;
  const fg_icons *icons;
  const fg_icons *finer;
  ...;
} fg_run_scale;
typedef struct fg_run fg_run;
fg_status fg_run_create(fg_run **out, fg_context *context, const fg_field *field,
                        const fg_run_options *options);
void fg_run_destroy(fg_run *run);
fg_status fg_run_next(const fg_run_scale **out, fg_run *run);

typedef struct fg_reader_error { double mean, percentile_95; ...; } fg_reader_error;
typedef int... fg_score_class;
#define FG_SCORE_FREE ...
typedef struct fg_score_options {
  fg_score_class lengths;
  bool readers_only;
  ...;
} fg_score_options;
typedef struct fg_score { double mean, percentile_95; ...; } fg_score;
fg_status fg_icons_score(fg_score *out, fg_context *context, const fg_field *field,
                         const fg_icons *icons, const fg_score_options *options);

void free(void *);

typedef int... fg_frame;
#define FG_FRAME_AUTO ...
#define FG_FRAME_EAST ...
#define FG_FRAME_GRID ...
typedef struct fg_read_options {
  const char *vars;
  fg_frame frame;
  ...;
} fg_read_options;
typedef struct fg_attribute {
  const char *name, *text;
  const double *number;
  size_t count;
} fg_attribute;
typedef struct fg_variable {
  const char *name;
  int rank;
  const char *dimension[8];
  size_t length[8];
  bool is_number;
  const fg_attribute *attribute;
  size_t attributes;
} fg_variable;
typedef struct fg_variables {
  const char *name;
  const fg_variable *variable;
  size_t count;
  bool (*fetch)(void *user, size_t variable, const size_t *start, const size_t *count,
                double *out);
  void *user;
} fg_variables;
typedef struct fg_vector_meaning {
  int component[3], coordinate[2], mask, side[2];
  bool is_polar, is_geographic, is_along_grid;
  char doubts[512];
  ...;
} fg_vector_meaning;
fg_status fg_vector_find(fg_vector_meaning *out, fg_context *context,
                         const fg_variables *variables, const fg_read_options *options);
extern "Python" bool fetch_numbers(void *, size_t, const size_t *, const size_t *, double *);
double fg__unit_factor(const char *from, const char *to);
"""

# cffi does not know pointers to constant arrays.
SOURCE_TEXT = """
#include <flowgrain/flowgrain.h>
#include <stdlib.h>

#include "terms/units.h"

static const double *icon_points(const fg_icon *icon) { return icon->points[0]; }

/* sizes: width, tail_width, head_length, head_width */
static fg_icon icon_of(const double *points, int point_count, const double sizes[4])
{
  return (fg_icon){.point_count = point_count,
                   .points = (const double(*)[3])points,
                   .width = sizes[0],
                   .tail_width = sizes[1],
                   .head_length = sizes[2],
                   .head_width = sizes[3]};
}

static fg_status line_outline(double **vertices, int *count, const double *points,
                              int point_count, const double sizes[4], int id)
{
  fg_icon icon = icon_of(points, point_count, sizes);
  icon.id = id;
  double(*polygon)[2] = NULL;
  fg_status status = fg_icon_outline(&icon, &polygon, count);
  *vertices = status ? NULL : polygon[0];
  return status;
}

static fg_status line_solid(fg_surface **out, fg_context *context, const double *points,
                            int point_count, const double sizes[4])
{
  const fg_icon icon = icon_of(points, point_count, sizes);
  return fg_icon_solid(out, context, &icon);
}

static const double *surface_vertex(const fg_surface *surface) { return surface->vertex[0]; }
static const float *surface_normal(const fg_surface *surface) { return surface->normal[0]; }
static const int *surface_triangle(const fg_surface *surface) { return surface->triangle[0]; }
"""

LIBRARY = pathlib.Path(
    os.environ.get("FLOWGRAIN_CORE", SOURCE / "build-python" / "core" / "libflowgrain_core.a")
)


def make_library():
    """Builds flowgrain_core, unless FLOWGRAIN_CORE names one that is there."""
    if "FLOWGRAIN_CORE" in os.environ:
        return
    subprocess.run(
        ["cmake", "-S", SOURCE, "-B", LIBRARY.parent, "-DCMAKE_BUILD_TYPE=Release"]
        + ["-DFLOWGRAIN_FILES=OFF", "-DFLOWGRAIN_MPI=OFF"],
        check=True,
        stdout=subprocess.DEVNULL,
    )
    subprocess.run(
        ["cmake", "--build", LIBRARY.parent, "--target", "flowgrain_core"]
        + ["-j", os.environ.get("JOBS", str(os.cpu_count()))],
        check=True,
        stdout=subprocess.DEVNULL,
    )


ffibuilder = cffi.FFI()
ffibuilder.cdef(CDEF)
ffibuilder.set_source(
    "flowgrain._core",
    SOURCE_TEXT,
    include_dirs=[str(SOURCE / "include"), str(SOURCE / "src")],
    extra_objects=[str(LIBRARY)],
    libraries=["m", "pthread"],
    # nothing of the library is seen outside the module, and only what is called is kept
    extra_link_args=["-Wl,--exclude-libs,ALL", "-Wl,--gc-sections", "-Wl,-s"],
)
