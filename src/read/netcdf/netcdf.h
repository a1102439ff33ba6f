/* The parts of the NetCDF reader, in the order a file passes through them: size, file,
 * pairs, grid, values. */
#ifndef FG__NETCDF_H
#define FG__NETCDF_H

#include "read/format.h"
#include "read/polar.h"
#include "read/signature.h"

#include <netcdf.h>
#include <stdint.h>

/* Compares the size of a file with what its header promises. FILE_FORMAT. */
fg_status fg__nc_check_size(fg_context *context, const fg__source *source);

enum {
  FG__NC_FILES = 3,                 /* the input and two more with what it lacks */
  FG__NC_RANK = 8,                  /* more dimensions than any field has */
  FG__NC_TEXT = 256,                /* bytes kept of a text attribute */
  FG__NC_NAME = 2 * NC_MAX_NAME + 2 /* group/variable */
};

/* A chunk whose content has been checked: the index of its first sample. */
typedef struct fg__nc_checked_chunk {
  const struct fg__nc_variable *variable;
  uint64_t place[FG__NC_RANK];
} fg__nc_checked_chunk;

/* A NetCDF-4 file as HDF5 sees it, open where chunks have to be checked before they are
 * read (chunks.c). */
enum { FG__NC_CHECKED_CHUNKS = 64 };
typedef struct fg__nc_storage {
  bool is_open;
  int64_t file; /* hid_t */
  fg__nc_checked_chunk checked[FG__NC_CHECKED_CHUNKS];
  size_t next;
} fg__nc_storage;

/* Deflate makes at most 1032 bytes of one (RFC 1951), so that a chunk of at most so many
 * stored bytes inflates to a gigabyte at most. */
#define FG__NC_HARMLESS_BYTES ((uint64_t)1 << 20)

/* Whether a chunk takes far more bytes in the file than in memory. */
bool fg__nc_is_overlong(uint64_t stored, uint64_t bytes);

/* Refuses a NetCDF-4 file whose links form a cycle, that refers to data in other files,
 * or whose chunks take more than 256 MiB each. *out has to be closed, also after a
 * failure. UNSUPPORTED, MEMORY. */
fg_status fg__nc_check_objects(fg__nc_storage *out, fg_context *context,
                               const fg__source *source);
void fg__nc_storage_close(fg__nc_storage *storage);

typedef struct fg__nc_dimension {
  int id;
  int root; /* ncid of the file it belongs to */
  char name[NC_MAX_NAME + 1];
  size_t length; /* 1 where one sample is chosen */
  size_t chosen; /* the first sample that is read: 0, or the chosen one */
  bool is_chosen;
  bool unlimited;
} fg__nc_dimension;

typedef enum fg__nc_role {
  FG__NC_NO_ROLE = -1,
  FG__NC_X = 0,
  FG__NC_Y,
  FG__NC_TIME,
  FG__NC_LEVEL
} fg__nc_role;

enum { FG__NC_ROLES = 4 };

typedef struct fg__nc_variable {
  struct fg__nc_file *owner;
  int file;  /* below FG__NC_FILES */
  int group; /* ncid */
  int id;
  char name[FG__NC_NAME]; /* with the names of its groups: "ocean/u" */
  const char *plain_name; /* the last part */
  const char *path;       /* of its file */
  nc_type type;
  int rank;                   /* FG__NC_RANK + 1 when it has more */
  int dimension[FG__NC_RANK]; /* indices into the file's dimensions */
  int element; /* 1 or 2: of a vector variable, whose last dimension (of length 2) is not
                  counted in `rank`; 0: it is a whole variable */
  /* From its attributes, which are slow to read; by fg__nc_classify. */
  fg__nc_role geographic; /* longitude (X), latitude (Y), or neither */
  bool upward;            /* a velocity, by its standard name */
} fg__nc_variable;

/* The input and up to two files with what it lacks: the other component, the mesh. */
typedef struct fg__nc_file {
  fg_context *context;
  int roots[FG__NC_FILES];
  char *paths[FG__NC_FILES];
  size_t sizes[FG__NC_FILES]; /* bytes */
  fg__nc_storage storage[FG__NC_FILES];
  int root_count;
  int component_files;         /* so many of them, from the first, may hold components */
  bool was_read[FG__NC_FILES]; /* numbers of it, since samples were chosen */
  fg__nc_dimension *dimensions;
  size_t dimension_count, dimension_capacity;
  fg__nc_variable *variables;
  size_t variable_count, variable_capacity;
  bool exhausted; /* memory for an attribute was lacking; the context has the message */
} fg__nc_file;

/* Opens a source and lists its dimensions and variables. FILE_FORMAT, MEMORY. */
fg_status fg__nc_file_open(fg__nc_file *file, fg_context *context,
                           const fg__source *source);

/* Adds those of a further file. ARGUMENT (one of the files); likewise. */
fg_status fg__nc_file_add(fg__nc_file *file, const char *path);
void fg__nc_file_close(fg__nc_file *file);

/* chosen.c. Chooses samples of dimensions, "number=2,expver=0": the dimensions become
 * ones of that sample alone. ARGUMENT, UNSUPPORTED, MEMORY. */
fg_status fg__nc_choose_samples(fg__nc_file *file, const char *text);

/* Adds to `words` those of the samples that are chosen of a variable's dimensions: of
 * time, or of all others. */
fg_status fg__nc_chosen_words(const fg__nc_file *file, const fg__nc_variable *variable,
                              bool of_time, char *words, size_t size);

/* Writes how one sample of a dimension that is neither time nor level is chosen, and of
 * which. MEMORY, FILE_FORMAT. */
fg_status fg__nc_offer_samples(char *out, size_t size, const fg__nc_file *file,
                               int dimension);

/* labels.c. Names that the file has for the samples of a dimension as texts, perhaps
 * none: of one sample ("": none), and of all (*out is NULL: none; *out and *text are for
 * free(), also after a failure). MEMORY, FILE_FORMAT. */
fg_status fg__nc_label(char out[FG__NC_TEXT], const fg__nc_file *file, int dimension,
                       size_t index);
fg_status fg__nc_labels(fg_axis_value **out, char **text, const fg__nc_file *file,
                        int dimension);

/* MEMORY where an attribute could not be read for lack of memory, else `status`. */
fg_status fg__nc_status(const fg__nc_file *file, fg_status status);

/* Records a failure of libnetcdf. */
fg_status fg__nc_fail(fg_context *context, const char *path, const char *what, int error);

/* The variable of that name (whole, or its last part), or NULL. */
const fg__nc_variable *fg__nc_find(const fg__nc_file *file, const char *name);

/* Reads numbers of a variable as nc_get_vara_double does, and one as nc_get_var1_double,
 * but indices along a dimension with a chosen sample count from that, and no chunk is
 * read that would become far larger in memory than the file says (NC_EFILTER, and a
 * message).
 */
int fg__nc_fetch(const fg__nc_variable *variable, const size_t *start,
                 const size_t *count, double *out);
int fg__nc_fetch_one(const fg__nc_variable *variable, const size_t *index, double *out);

/* Only checks the chunks of a part; indices are the file's. */
int fg__nc_check_chunks(const fg__nc_variable *variable, const size_t *start,
                        const size_t *count);

/* A text attribute without white space at its ends, cut to the buffer; "" when there is
 * none. Returns whether there is one. A lack of memory is reported by fg__nc_status. */
bool fg__nc_text(const fg__nc_variable *variable, const char *attribute, char *out,
                 size_t size);

/* The numbers of an attribute, at most `capacity`; returns how many. A lack of memory is
 * reported by fg__nc_status. */
int fg__nc_numbers(const fg__nc_variable *variable, const char *attribute, double *out,
                   int capacity, nc_type *type);

typedef enum fg__nc_quantity {
  FG__NC_UNKNOWN = 0, /* no units, or unknown ones */
  FG__NC_SPEED,
  FG__NC_ANGULAR_SPEED,
  FG__NC_LENGTH,
  FG__NC_DEGREES,
  FG__NC_DEGREES_EAST,
  FG__NC_DEGREES_NORTH,
  FG__NC_PRESSURE,
  FG__NC_DATE /* "hours since ..." */
} fg__nc_quantity;

/* The other unit of dates, which CDI writes (ICON, ECHAM): the number 20200115.25. */
#define FG__NC_ABSOLUTE "day as %Y%m%d.%f"

/* Classifies units and writes them in the form of an axis label: "m s**-1" as "m/s". */
fg__nc_quantity fg__nc_units(const char *units, char *label, size_t size);

/* The seconds of a unit of time ("hours"); false for any other unit. */
bool fg__nc_seconds(const char *units, double *out);

typedef struct fg__nc_pair {
  const fg__nc_variable *component[3]; /* the third NULL when there is none */
  bool volume;                         /* the options name all three */
  fg__polar polar;                     /* they are a speed and a direction */
  const char *found_by;
  int rank;         /* the smallest is the best */
  bool is_velocity; /* units of a speed, unlike a stress or a flux */
} fg__nc_pair;

/* chosen.c. Refuses choices by a dimension that neither component has. ARGUMENT. */
fg_status fg__nc_check_choices(const fg__nc_file *file, const fg__nc_pair *pair);

/* Lists the pairs, best rank first, then in the order of the file. *out is for free(). */
fg_status fg__nc_pairs(fg__nc_pair **out, size_t *count, const fg__nc_file *file);

/* The third component of a pair: a variable of the same dimensions and units, with a
 * matching name; NULL: none. */
const fg__nc_variable *fg__nc_third(const fg__nc_file *file, const fg__nc_pair *pair);

/* polar.c. Whether a variable is a direction, and what it is measured in. */
bool fg__nc_direction(fg__polar *out, const fg__nc_variable *v);

/* Fills in components and polar where a variable is a direction and has a speed at its
 * places, by their standard names; else false. */
bool fg__nc_find_polar(fg__nc_pair *out, const fg__nc_file *file,
                       const fg__nc_variable *direction);

/* Makes a named pair of a speed and a direction, in either order, polar. ARGUMENT (a
 * direction beside what is no speed). */
fg_status fg__nc_settle_polar(fg__nc_pair *pair, const fg__nc_file *file);

/* The name of a component; NULL: a speed and a direction become components without. */
const char *fg__nc_component_name(const fg__nc_pair *pair, int k);

/* What a polar pair is, and which rule says so. */
void fg__nc_polar_words(char *out, size_t size, const fg__nc_pair *pair);

/* Sets what a variable's attributes tell of it. */
void fg__nc_classify(fg__nc_variable *variable);

/* The one-dimensional coordinate of a variable's dimension number k, or NULL. */
const fg__nc_variable *fg__nc_coordinate(const fg__nc_file *file,
                                         const fg__nc_variable *variable, int k);

/* A coordinate of one value of that role which is along none of the variable's
 * dimensions (CF conventions, section 5.7): the variable names it, or the file does. Of
 * time it has dates. NULL: none. */
const fg__nc_variable *fg__nc_single_coordinate(const fg__nc_file *file,
                                                const fg__nc_variable *variable,
                                                fg__nc_role role);

/* Whether dimension number k of a variable is one of time, be a sample chosen or not. */
bool fg__nc_is_time(const fg__nc_file *file, const fg__nc_variable *variable, int k);

/* Whether a coordinate may be a mere index: it has neither units nor a standard name. */
bool fg__nc_counts(const fg__nc_variable *coordinate);

/* Finds the position among a variable's dimensions of each role, -1 where there is none.
 * Returns the position of a dimension longer than 1 that fits no role, or -1. */
int fg__nc_roles(int position[FG__NC_ROLES], const fg__nc_file *file,
                 const fg__nc_variable *variable);

/* The same for a variable with one dimension in space, number `along`, which gets role
 * X. */
int fg__nc_roles_beside(int position[FG__NC_ROLES], const fg__nc_file *file,
                        const fg__nc_variable *variable, int along);

typedef struct fg__nc_axis {
  int dimension;      /* index into the file's dimensions */
  int position;       /* among the variable's dimensions */
  size_t first;       /* first sample in the file */
  size_t size;        /* samples that are used */
  bool reversed;      /* the file's order is descending */
  double *coordinate; /* [size], ascending */
  double period;
  fg__nc_quantity quantity;
  char name[FG__NC_TEXT];
  char units[FG__NC_TEXT];
} fg__nc_axis;

typedef struct fg__nc_mesh fg__nc_mesh; /* mesh/mesh.h */
typedef struct fg__nc_unstructured fg__nc_unstructured;

/* Components on the faces of cells whose centres lie on the axes. */
typedef struct fg__nc_faces {
  bool used;
  int position[2][FG__NC_ROLES]; /* of each component's own dimensions, or -1 */
  size_t before[2]; /* component k along axis k: centre n lies between the faces n -
                       before[k] and the next, in the file's order */
} fg__nc_faces;

typedef struct fg__nc_grid {
  fg__nc_mesh *mesh; /* of a curvilinear grid; NULL: points lie on axes, or */
  fg__nc_unstructured *unstructured; /* unstructured/; NULL: no such mesh */
  bool off_axes; /* points do not lie on axes: a mesh, faces, or unusable */
  fg__nc_faces faces;
  int dimension;        /* 2: a plane at one level; 3 */
  fg__nc_axis axis[3];  /* x, y; the levels as z in 3D */
  int time, level;      /* positions among the dimensions, or -1 */
  size_t times, levels; /* 1 when there is none */
  const fg__nc_variable *time_variable, *level_variable; /* or NULL; time may be text */
  char time_name[NC_MAX_NAME + 1], level_name[NC_MAX_NAME + 1];
  fg_scale scale;
  char projection[2 * FG__NC_TEXT]; /* PROJ string of scale MAP; "": not known */
  bool points_east; /* components along east and north, not along the axes */
  size_t samples;   /* product of the axes' sizes */
  char unusable[FG__REASON_BYTES]; /* "" or why the pair cannot be read */
  char hint[FG__NC_TEXT];
} fg__nc_grid;

/* fitness.c. Compares the components' dimensions. A staggered grid (Arakawa's C grid) has
 * different ones for each: the grid is then off_axes, and unusable unless mesh/ can read
 * it. */
void fg__nc_check_shapes(fg__nc_grid *grid, const fg__nc_file *file,
                         const fg__nc_variable *u, const fg__nc_variable *v);

/* Makes a pair unusable whose components lie more than half a cell apart. */
void fg__nc_refuse_apart(fg__nc_grid *grid, const fg__nc_pair *pair);

/* Makes the pair unusable where a variable is not numeric, or has more samples than a
 * file of this size can hold. */
void fg__nc_check_variable(fg__nc_grid *grid, const fg__nc_variable *v);
void fg__nc_check_storage(fg__nc_grid *grid, const fg__nc_file *file,
                          const fg__nc_variable *v);

/* polar.c. Makes a polar pair unusable where its unit or north's direction is not
 * known. */
void fg__nc_check_polar(fg__nc_grid *grid, const fg__nc_pair *pair,
                        const fg_read_options *options);

/* axes.c. Reads a coordinate along an axis, makes it ascending, and finds its period. */
fg_status fg__nc_axis_read(fg__nc_grid *grid, const fg__nc_file *file, int k,
                           const fg__nc_variable *coordinate);

/* grid.c. The coordinate of axis k, from the dimension of a variable on the grid; NULL:
 * none. */
const fg__nc_variable *fg__nc_axis_coordinate(const fg__nc_file *file,
                                              const fg__nc_grid *grid,
                                              const fg__nc_variable *v, int k);

/* axes.c. Uses the indices, from 0, as the coordinate. */
fg_status fg__nc_axis_count(fg__nc_grid *grid, const fg__nc_file *file, int k);

/* plane.c. Finds two-dimensional longitude and latitude. Where each varies along one
 * dimension only they become the axes, and *found is true; otherwise the pair is
 * unusable, unless the scale is plain. */
fg_status fg__nc_plane_find(fg__nc_grid *grid, const fg__nc_file *file,
                            const fg__nc_variable *variable, bool *found);

/* Whether two components on equal dimensions have two-dimensional longitudes or latitudes
 * of their own that are not at the same places: those of faces (Arakawa's C grid).
 * MEMORY, FILE_ACCESS. */
fg_status fg__nc_plane_compare(bool *apart, const fg__nc_grid *grid,
                               const fg__nc_file *file, const fg__nc_variable *u,
                               const fg__nc_variable *v);

/* Whether two dimensions are one, or have the same name and length in two files. */
bool fg__nc_alike_dimension(const fg__nc_file *file, int a, int b);

/* Whether a name is one of those in a text with blanks between. */
bool fg__nc_is_listed(const char *names, const char *name);

/* Whether names are equal, or differ in a u of one where the other has a v ("depthu" and
 * "depthv" of NEMO). */
bool fg__nc_named_alike(const char *of_u, const char *of_v);

/* The two-dimensional longitude (X) or latitude (Y) of a variable, on two of the grid's
 * dimensions and perhaps one for each time. One of the same file is preferred, then one
 * that the attribute `coordinates` names. NULL: there is none. */
const fg__nc_variable *fg__nc_plane_coordinate(const fg__nc_grid *grid,
                                               const fg__nc_file *file,
                                               const fg__nc_variable *variable,
                                               fg__nc_role role);

/* Whether the variable's attribute `coordinates` names both of them. */
bool fg__nc_names_plane(const fg__nc_grid *grid, const fg__nc_file *file,
                        const fg__nc_variable *variable);

/* projection.c. Finds the PROJ string of axes in a projection or about a rotated pole
 * from the variable's grid mapping. Where the file's longitudes and latitudes contradict
 * the projection, the grid is off_axes. MEMORY, FILE_ACCESS. */
fg_status fg__nc_projection_find(fg__nc_grid *grid, const fg__nc_file *file,
                                 const fg__nc_variable *u);

/* Rotates the components of some rows to the directions of the projection's plane. */
fg_status fg__nc_projection_turn(float *const velocity[2], const fg__nc_file *file,
                                 const fg__nc_grid *grid, const fg__rows *rows);

/* volume.c. Makes the grid of the first two components three-dimensional when there is a
 * third component, all levels form one axis in space, and the axes have one unit. Where
 * the options name the third component, whatever prevents that makes the pair
 * unusable. */
fg_status fg__nc_volume_find(fg__nc_grid *grid, const fg__nc_file *file,
                             const fg__nc_pair *pair);

/* Finds the grid of a pair. The reason why a pair cannot be read goes to `unusable`; a
 * status is returned only for failures of reading and lack of memory. */
fg_status fg__nc_grid_find(fg__nc_grid *grid, const fg__nc_file *file,
                           const fg__nc_pair *pair, const fg_read_options *options);
void fg__nc_grid_clear(fg__nc_grid *grid);

/* Sets counts, coordinates and names of the time and level axes from their positions. */
void fg__nc_set_index_axes(fg__nc_grid *grid, const fg__nc_file *file,
                           const fg__nc_variable *v);

/* choice.c. Finds the pair that the options name, or else the only readable pair of the
 * best rank, with its grid. The grid has to be cleared, also after a failure. ARGUMENT,
 * UNSUPPORTED, FILE_ACCESS, MEMORY. */
fg_status fg__nc_choose(fg__nc_pair *pair, fg__nc_grid *grid, const fg__nc_file *file,
                        const fg_read_options *options);

typedef struct fg__nc_missing {
  size_t fill, range, not_a_number; /* samples that are missing, by reason */
} fg__nc_missing;

/* Reads a component at one time and level into out, x fastest, both axes ascending; NaN
 * where a value is missing. Adds to `missing`. */
fg_status fg__nc_values(float *out, fg__nc_missing *missing, const fg__nc_file *file,
                        const fg__nc_variable *variable, const fg__nc_grid *grid,
                        size_t time, size_t level);

/* Reads a mask into out: 0 where the variable is zero or missing. The variable has the
 * grid's two dimensions, and perhaps its time and level. */
fg_status fg__nc_mask(unsigned char *out, const fg__nc_file *file,
                      const fg__nc_variable *variable, const fg__nc_grid *grid,
                      const fg__nc_variable *component, size_t time, size_t level);

/* Whether a variable is numeric and has 1 to FG__NC_RANK dimensions. */
bool fg__nc_is_array(const fg__nc_variable *v);

/* Whether a variable has both dimensions of a grid, and no others but the component's
 * time and level and those of length 1. */
bool fg__nc_lies_on(const fg__nc_file *file, const fg__nc_variable *v,
                    const fg__nc_grid *grid, const fg__nc_variable *component);

/* Reads such a variable into out, x fastest; NaN where a value is missing. FILE_FORMAT
 * (not on the grid), FILE_ACCESS, MEMORY. */
fg_status fg__nc_doubles(double *out, const fg__nc_file *file,
                         const fg__nc_variable *variable, const fg__nc_grid *grid,
                         const fg__nc_variable *component, size_t time, size_t level);

/* The same of all numbers of a variable with one dimension or more. */
fg_status fg__nc_line(double *out, const fg__nc_file *file,
                      const fg__nc_variable *variable);

/* The samples of some rows of a field. */
typedef struct fg__nc_samples {
  float *velocity[3];
  fg__nc_missing missing[3]; /* in these rows */
  unsigned char *valid;      /* NULL: all */
} fg__nc_samples;

/* Reads a pair's rows at one time and, in 2D, one level; mask may be NULL. *out has to be
 * cleared, also after a failure. FILE_ACCESS, ARGUMENT (mask), MEMORY. */
fg_status fg__nc_samples_read(fg__nc_samples *out, const fg__nc_file *file,
                              const fg__nc_pair *pair, const fg__nc_grid *grid,
                              const fg__rows *rows, size_t time, size_t level,
                              const char *mask);
void fg__nc_samples_clear(fg__nc_samples *samples);

/* A title of the vector: what the components' long names, descriptions (WRF) or standard
 * names share, else the title of their file or group, else their names. */
void fg__nc_title(const fg__nc_pair *pair, int components, char *out, size_t size);

/* Describes the time or level of an index; `name` is the dimension's. */
fg_status fg__nc_index_words(const fg__nc_file *file, const fg__nc_variable *coordinate,
                             const char *name, size_t index, char *out, size_t size);

/* defaults.c. fg_read_defaults_find for a pair and its grid. */
fg_status fg__nc_defaults(fg_read_defaults *out, const fg__nc_file *file,
                          const fg__nc_pair *pair, const fg__nc_grid *grid,
                          const fg_read_options *options);

/* The values of a time or level axis; their texts point into *text. Both are for free().
 * NULL where there is no coordinate, or too many values to choose from. */
fg_status fg__nc_axis_values(fg_axis_value **out, char **text, const fg__nc_file *file,
                             const fg__nc_variable *coordinate, size_t count);

/* The texts of a picture's caption. */
typedef struct fg__nc_words {
  char title[FG__NC_TEXT], units[FG__NC_TEXT];
  char time[FG__NC_TEXT], level[FG__NC_TEXT]; /* "": none */
} fg__nc_words;

/* The units of a vector as on an axis label: those of a component that has some. */
void fg__nc_velocity_units(char *out, size_t size, const fg__nc_pair *pair);

fg_status fg__nc_words_find(fg__nc_words *out, const fg__nc_file *file,
                            const fg__nc_pair *pair, const fg__nc_grid *grid,
                            const fg_read_options *options);

#endif
