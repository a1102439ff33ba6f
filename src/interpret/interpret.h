/* What a dataset means: its vectors, their grids, times and levels, in the order in which
 * they are found: pairs, grid, words. It sees names, attributes and coordinates,
 * of any format. */
#ifndef FG__INTERPRET_H
#define FG__INTERPRET_H

#include "dataset/dataset.h"
#include "flowgrain/field.h"
#include "interpret/inventory.h"
#include "terms/polar.h"
#include "terms/units.h"

/* chosen.c. Chooses samples of dimensions, "number=2,expver=0": the dimensions become
 * ones of that sample alone. ARGUMENT, UNSUPPORTED, MEMORY. */
fg_status fg__choose_samples(fg__dataset *data, const char *text);

/* Adds to `words` those of the samples that are chosen of a variable's dimensions: of
 * time, or of all others. */
fg_status fg__chosen_words(const fg__dataset *data, const fg__variable *variable,
                           bool of_time, char *words, size_t size);

/* Writes how one sample of a dimension that is neither time nor level is chosen, and of
 * which. MEMORY, FILE_FORMAT. */
fg_status fg__offer_samples(char *out, size_t size, const fg__dataset *data,
                            int dimension);

/* texts.c. Names that the file has for the samples of a dimension as texts, perhaps none:
 * of the chosen one ("": none), and of all (*out is NULL: none; *out and *text are for
 * free(), also after a failure). MEMORY, FILE_FORMAT. */
fg_status fg__dimension_label(char out[FG__TEXT_BYTES], const fg__dataset *data,
                              int dimension);
fg_status fg__dimension_labels(fg_axis_value **out, char **text, const fg__dataset *data,
                               int dimension);

typedef struct fg__pair {
  const fg__variable *component[3]; /* the third NULL when there is none */
  bool volume;                      /* the options name all three */
  const fg__variable *position[3];  /* that the options name; or NULL */
  int across; /* of two components of a plane upright in space: 1 + the axis of the one
                 that is missing; 0: they are the first two */
  fg__polar polar; /* they are a speed and a direction */
  const char *found_by;
  int rank;         /* the smallest is the best */
  bool is_velocity; /* units of a speed, unlike a stress or a flux */
} fg__pair;

/* nameless.c. Finds longitudes and latitudes, and names what has no names in the file
 * that was added last: the dimensions of arrays by the coordinates whose lengths fit, and
 * four or six columns, x, y(, z), u, v(, w). MEMORY. */
fg_status fg__settle_names(fg__dataset *data);

/* chosen.c. Refuses choices by a dimension that neither component has. ARGUMENT. */
fg_status fg__check_choices(const fg__dataset *data, const fg__pair *pair);

/* Lists the pairs, best rank first, then in the order of the file. *out is for free(). */
fg_status fg__pairs_find(fg__pair **out, size_t *count, const fg__dataset *data);

/* space/vectors.c. The pair of the elements of a vector variable in space, from its
 * first; and whether a variable is that and may be the vector that is meant. */
fg__pair fg__pair_of_elements(const fg__variable *first);
bool fg__pair_of_vector(fg__pair *out, const fg__variable *v);

/* The name of a variable, or what its place calls it where it has a number only. */
const char *fg__called(const fg__variable *v);

/* What a variable is called and says of itself; texts are borrowed. */
fg__term fg__term_of(const fg__variable *v);

/* polar.c. Makes a named pair of a length and its direction, in either order, polar.
 * ARGUMENT (a speed beside what is no direction). */
fg_status fg__settle_polar(fg__pair *pair, const fg__dataset *data);

/* The third element of a vector variable whose first is v; NULL: it has two. */
const fg__variable *fg__third_element(const fg__variable *v);

/* The name of a component; NULL: a speed and a direction, and the elements of a vector
 * variable, become components without. */
const char *fg__component_name(const fg__pair *pair, int k);

/* What a polar pair is, and which rule says so. */
void fg__pair_polar_words(char *out, size_t size, const fg__pair *pair);

/* The one-dimensional coordinate of a variable's dimension number k, or NULL. */
const fg__variable *fg__coordinate(const fg__dataset *data, const fg__variable *variable,
                                   int k);

/* The same of a dimension, and the variable that lies along it, or NULL. */
const fg__variable *fg__coordinate_along(const fg__dataset *data, int dimension,
                                         const fg__variable *variable);

/* A coordinate of one value of that role which is along none of the variable's
 * dimensions (CF conventions, section 5.7): the variable names it, or the file does. Of
 * time it has dates. NULL: none. */
const fg__variable *fg__single_coordinate(const fg__dataset *data,
                                          const fg__variable *variable, fg__role role);

/* Whether dimension number k of a variable is one of time, be a sample chosen or not. */
bool fg__is_time(const fg__dataset *data, const fg__variable *variable, int k);

/* The role of a variable's dimension number k by its coordinate's attributes, else by
 * names. */
fg__role fg__claimed_role(const fg__dataset *data, const fg__variable *variable, int k);

/* axes.c. What a variable's units are of, and their label (NULL: it is not wanted). */
fg__quantity fg__units_of(const fg__variable *v, char *label, size_t size);

/* Whether a coordinate may be a mere index: it has neither units nor a standard name. */
bool fg__may_be_index(const fg__variable *coordinate);

/* Finds the position among a variable's dimensions of each role, -1 where there is none.
 * Returns the position of a dimension longer than 1 that fits no role, or -1. */
int fg__roles_find(int position[FG__ROLES], const fg__dataset *data,
                   const fg__variable *variable);

/* The same for a variable with one dimension in space, number `along`, which gets role
 * X. */
int fg__roles_find_beside(int position[FG__ROLES], const fg__dataset *data,
                          const fg__variable *variable, int along);

typedef struct fg__grid_axis {
  int dimension;                 /* index into the file's dimensions */
  int position;                  /* among the variable's dimensions */
  size_t first;                  /* first sample in the file */
  size_t size;                   /* samples that are used */
  bool reversed;                 /* the file's order is descending */
  double *coordinate;            /* [size], ascending */
  const fg__variable *read_from; /* the coordinate, of one dimension or two; NULL: samples
                                    are counted */
  double period;
  fg__quantity quantity;
  char name[FG__TEXT_BYTES];
  char units[FG__TEXT_BYTES];
} fg__grid_axis;

typedef struct fg__curvilinear fg__curvilinear; /* mesh/mesh.h */
typedef struct fg__unstructured fg__unstructured;

/* Components on the faces of cells whose centres lie on the axes. */
typedef struct fg__staggered {
  bool used;
  int position[2][FG__ROLES]; /* of each component's own dimensions, or -1 */
  size_t before[2]; /* component k along axis k: centre n lies between the faces n -
                       before[k] and the next, in the file's order */
} fg__staggered;

typedef struct fg__grid {
  fg__curvilinear *mesh; /* of a curvilinear grid; NULL: points lie on axes, or */
  fg__unstructured *unstructured;        /* unstructured/; NULL: no such mesh */
  const struct fg__space_domain *domain; /* space/: points in space; NULL: they are not */
  int component[3]; /* in space: which of the pair's is along each axis */
  bool off_axes;    /* points do not lie on axes: a mesh, faces, or unusable */
  fg__staggered faces;
  int dimension;         /* 2: a plane at one level; 3 */
  fg__grid_axis axis[3]; /* x, y; the levels as z in 3D */
  int time, level;       /* positions among the dimensions, or -1 */
  size_t times, levels;  /* 1 when there is none */
  const fg__variable *time_variable, *level_variable; /* or NULL; time may be text */
  char time_name[FG__DIMENSION_BYTES], level_name[FG__DIMENSION_BYTES];
  fg_scale scale;
  char projection[2 * FG__TEXT_BYTES]; /* PROJ string of scale MAP; "": not known */
  double *rate; /* of a vertical section: what the vertical component is multiplied by in
                   each of its rows; NULL: it is none */
  char section[FG__TEXT_BYTES]; /* where it lies, and how its component is drawn */
  bool points_east;             /* components along east and north, not along the axes */
  size_t samples;               /* product of the axes' sizes */
  const struct fg__grid *whole; /* of which it is the part in a region; or NULL */
  const fg__variable
      *hidden; /* true where a sample is not to be used (numpy.ma), or NULL */
  char unusable[FG__REASON_BYTES]; /* "" or why the pair cannot be read */
  char hint[FG__TEXT_BYTES];
  char doubts[FG__REASON_BYTES]; /* lines: what is unsure of all this */
} fg__grid;

/* nameless.c. Makes a vector unusable whose dimensions have got no names, though the file
 * has coordinates; and finds an array of booleans called mask, as numpy.ma has them. */
void fg__check_nameless(fg__grid *grid, const fg__dataset *data, const fg__variable *v);

/* fitness.c. Refuses dimensions that are empty, too long, or there twice. */
void fg__check_dimensions(fg__grid *grid, const fg__dataset *data, const fg__variable *v);

/* Refuses two components of which names, standard names and long names say the
 * opposite, or that are counted to the west or south. MEMORY. */
fg_status fg__check_names(fg__grid *grid, const fg__dataset *data, const fg__pair *pair);

/* polar_beside.c. Compares components that point east and north with speeds and
 * directions of the same flow at the same points, in a few rows. Where most are more than
 * 45 degrees apart, or half as fast again, the pair is unusable if their names say that
 * they are of one flow, else doubted; so are components that are less than half as fast.
 * MEMORY. */
fg_status fg__check_polar_beside(fg__grid *grid, const fg__dataset *data,
                                 const fg__pair *pair, const fg_read_options *options);

/* counted.c. Doubts a grid whose axes count samples, where the file has places, or names
 * or faces that tell of some, or an attribute states their distance; and makes it
 * unusable where only one counts samples and the other is in degrees. */
void fg__tell_unused_places(fg__grid *grid, const fg__dataset *data, const fg__pair *pair,
                            const fg_read_options *options);

/* curvilinear/positions.c. On which side of the centres faces lie along a variable's
 * dimension, -1 or 1, by the attributes of its coordinate (ROMS, CROCO) or its name; 0:
 * nothing says. */
int fg__side_of_faces(const fg__dataset *data, const fg__variable *v, int position);

/* fitness.c. Compares the components' dimensions. A staggered grid (Arakawa's C grid) has
 * different ones for each: the grid is then off_axes, and unusable unless mesh/ can read
 * it. */
void fg__check_shapes(fg__grid *grid, const fg__dataset *data, const fg__variable *u,
                      const fg__variable *v);

/* Refuses a time and level that lack a component: not every time need have every level.
 * ARGUMENT. */
fg_status fg__check_samples(const fg__dataset *data, const fg__pair *pair,
                            const fg__grid *grid, const fg_read_options *options);

/* The first time and level that have both. */
fg_read_options fg__first_samples(const fg__pair *pair, const fg__grid *grid);

/* Makes a pair unusable whose components lie more than half a cell apart. */
void fg__refuse_apart(fg__grid *grid, const fg__pair *pair);

/* Makes the pair unusable where a variable is not numeric, or has more samples than a
 * file of this size can hold. */
void fg__check_variable(fg__grid *grid, const fg__variable *v);

/* Where a packing's attribute is no number, or only one of two components of whole
 * numbers is packed. */
void fg__check_packing(fg__grid *grid, const fg__pair *pair);
void fg__check_storage(fg__grid *grid, const fg__dataset *data, const fg__variable *v);

/* polar.c. Makes a polar pair unusable where its unit or north's direction is not known,
 * or where its words say the opposite of its name. */
void fg__check_polar(fg__grid *grid, const fg__pair *pair,
                     const fg_read_options *options);

/* axes.c. Reads a coordinate along an axis, makes it ascending, and finds its period. */
fg_status fg__grid_axis_read(fg__grid *grid, const fg__dataset *data, int k,
                             const fg__variable *coordinate);

/* grid.c. The coordinate of axis k, from the dimension of a variable on the grid; NULL:
 * none. */
const fg__variable *fg__grid_axis_coordinate(const fg__dataset *data,
                                             const fg__grid *grid, const fg__variable *v,
                                             int k);

/* extent.c. Refuses longitudes and latitudes, of axes or a curvilinear grid, most of
 * which lie outside the extent that the file states or the bounds of their cells, and
 * doubts those of which some do. MEMORY, FILE_FORMAT. */
fg_status fg__check_extents(fg__grid *grid, const fg__dataset *data,
                            const fg__pair *pair);
fg_status fg__check_mesh_extents(fg__grid *grid, const fg__dataset *data);

/* Doubts times of which the first is the end of its bounds, a day or more (a mean of
 * January that is dated 1 February, as CESM's are), or lies outside them. */
void fg__tell_time_bounds(fg__grid *grid, const fg__dataset *data);

/* axes.c. An axis that says nothing of itself is longitude or latitude where the options
 * say so. */
void fg__call_geographic(fg__grid_axis *axis, int k);
/* axes.c. Makes a pair unusable whose longitudes and latitudes are radians, or no
 * latitudes, by their numbers. */
void fg__check_axes_in_degrees(fg__grid *grid);

/* axes.c. Puts the coordinates of an axis, and its samples, in the opposite order. */
void fg__grid_axis_flip(fg__grid_axis *axis);

/* Whether an axis counts from 0 or 1, as sample numbers do. */
bool fg__counts_samples(const fg__grid_axis *axis);

/* axes.c. Uses the indices, from 0, as the coordinate. */
fg_status fg__grid_axis_count(fg__grid *grid, const fg__dataset *data, int k);

/* plane.c. Finds two-dimensional longitude and latitude. Where each varies along one
 * dimension only they become the axes, and *found is true; otherwise the pair is
 * unusable, unless the scale is plain. */
fg_status fg__plane_find(fg__grid *grid, const fg__dataset *data,
                         const fg__variable *variable, bool *found);

/* Whether two components on equal dimensions have two-dimensional longitudes or latitudes
 * of their own that are not at the same places: those of faces (Arakawa's C grid).
 * MEMORY, FILE_ACCESS. */
fg_status fg__plane_compare(bool *apart, const fg__grid *grid, const fg__dataset *data,
                            const fg__variable *u, const fg__variable *v);

/* Whether most longitudes or latitudes in two dimensions are others than those of the
 * coordinates along the grid's axes. MEMORY, FILE_ACCESS. */
fg_status fg__plane_contradicts(bool *out, const fg__grid *grid, const fg__dataset *data,
                                const fg__variable *variable,
                                const fg__variable *const coordinate[2]);

/* nameless.c. A first dimension that neither has a name nor makes a volume is time. */
void fg__nameless_time(fg__grid *grid, const fg__dataset *data, const fg__variable *v);

/* Whether two dimensions are one, or have the same name and length in two files. */
bool fg__alike_dimension(const fg__dataset *data, int a, int b);

/* Whether a name is one of those in a text with blanks between. */
bool fg__is_listed(const char *names, const char *name);

/* Whether names are equal, or differ in a u of one where the other has a v ("depthu" and
 * "depthv" of NEMO). */
bool fg__named_alike(const char *of_u, const char *of_v);

/* The two-dimensional longitude (X) or latitude (Y) of a variable, on two of the grid's
 * dimensions and perhaps one for each time. One of the same file is preferred, then one
 * that the attribute `coordinates` names. NULL: there is none. */
const fg__variable *fg__plane_coordinate(const fg__grid *grid, const fg__dataset *data,
                                         const fg__variable *variable, fg__role role);

/* Compares the longitudes and latitudes that are taken for a variable with others on the
 * same dimensions, between which nothing decides: doubts those within a cell, and refuses
 * others. The library's status otherwise. */
fg_status fg__check_other_places(fg__grid *grid, const fg__dataset *data,
                                 const fg__variable *variable,
                                 const fg__variable *const taken[2]);

/* Whether the variable's attribute `coordinates` names both of them. */
bool fg__names_plane(const fg__grid *grid, const fg__dataset *data,
                     const fg__variable *variable);

/* projection.c. The variable that describes the projection of another one's grid, named
 * by its attribute grid_mapping, also as "crs: x y"; NULL: none. */
const fg__variable *fg__grid_mapping_of(const fg__dataset *data,
                                        const fg__variable *variable);

/* Finds the PROJ string of axes in a projection or about a rotated pole
 * from the variable's grid mapping. Where the file's longitudes and latitudes contradict
 * the projection, the grid is off_axes. MEMORY, FILE_ACCESS. */
fg_status fg__projection_find(fg__grid *grid, const fg__dataset *data,
                              const fg__variable *u);

/* section.c. Whether a variable lies in a vertical plane: along levels and longitude or x
 * (0), or latitude or y (1); -1: it does not. Sets the positions of its roles. */
int fg__section_along(int position[FG__ROLES], const fg__dataset *data,
                      const fg__variable *v);

/* Replaces the components of a pair in such a plane by the one along it and the only one
 * along the vertical, where there is one. */
void fg__section_settle(fg__pair *pair, const fg__dataset *data);

/* Finds the grid of such a pair, by what fg__section_along has found of its first
 * component. Its levels become coordinates that grow upwards, on the scale of the other
 * axis (terms/measure.h). MEMORY, FILE_ACCESS. */
fg_status fg__section_find(fg__grid *grid, const fg__dataset *data, const fg__pair *pair,
                           const fg_read_options *options, int along,
                           const int position[FG__ROLES]);

/* volume.c. Makes the grid of the first two components three-dimensional when there is a
 * third component, all levels form one axis in space, and the axes have one unit. Where
 * the options name the third component, whatever prevents that makes the pair
 * unusable. */
fg_status fg__volume_find(fg__grid *grid, const fg__dataset *data, const fg__pair *pair);

/* Finds the grid of a pair. The reason why a pair cannot be read goes to `unusable`; a
 * status is returned only for failures of reading and lack of memory. */
fg_status fg__grid_find(fg__grid *grid, const fg__dataset *data, const fg__pair *pair,
                        const fg_read_options *options);
void fg__grid_clear(fg__grid *grid);

/* Sets counts, coordinates and names of the time and level axes from their positions. */
void fg__set_index_axes(fg__grid *grid, const fg__dataset *data, const fg__variable *v);

/* choice.c. Finds the pair that the options name, or else the only readable pair of the
 * best rank, with its grid. The grid has to be cleared, also after a failure. ARGUMENT,
 * UNSUPPORTED, FILE_ACCESS, MEMORY. */
fg_status fg__choose_vector(fg__pair *pair, fg__grid *grid, const fg__dataset *data,
                            const fg_read_options *options);

/* Fails for a name that no variable has; the hint lists those there are. ARGUMENT. */
fg_status fg__fail_unknown(const fg__dataset *data, const char *name);

/* Reads a component at one time and level into out, x fastest, both axes ascending; NaN
 * where a value is missing. Adds to `missing`. */
fg_status fg__read_values(float *out, fg__missing_counts *missing,
                          const fg__dataset *data, const fg__variable *variable,
                          const fg__grid *grid, size_t time, size_t level);

/* Reads a mask into out: 0 where the variable is zero or missing. The variable has the
 * grid's two dimensions, and perhaps its time and level. */
fg_status fg__read_mask(unsigned char *out, const fg__dataset *data,
                        const fg__variable *variable, const fg__grid *grid,
                        const fg__variable *component, size_t time, size_t level);

/* Whether a variable is numeric and has 1 to FG__RANK dimensions. */
bool fg__is_array(const fg__variable *v);

/* Whether a variable has both dimensions of a grid, and no others but the component's
 * time and level and those of length 1. */
bool fg__lies_on(const fg__dataset *data, const fg__variable *v, const fg__grid *grid,
                 const fg__variable *component);

/* Reads such a variable into out, x fastest; NaN where a value is missing. FILE_FORMAT
 * (not on the grid), FILE_ACCESS, MEMORY. */
fg_status fg__read_doubles(double *out, const fg__dataset *data,
                           const fg__variable *variable, const fg__grid *grid,
                           const fg__variable *component, size_t time, size_t level);

/* The same of all numbers of a variable with one dimension or more. */
fg_status fg__read_all(double *out, const fg__dataset *data,
                       const fg__variable *variable);

/* A title of the vector: what the components' long names, descriptions (WRF) or standard
 * names share, else the title of their file or group, else their names. */
void fg__vector_title(const fg__pair *pair, int components, char *out, size_t size);

/* Writes the date of a number in the unit of times; false: it is none. */
bool fg__write_date(char *out, size_t size, const fg__variable *times, double value);

/* Describes the time or level of an index; `name` is the dimension's. */
fg_status fg__index_words(const fg__variable *coordinate, const char *name, size_t index,
                          char *out, size_t size);

/* defaults.c. fg_read_defaults_find for a pair and its grid. */
fg_status fg__defaults_find(fg_read_defaults *out, const fg__dataset *data,
                            const fg__pair *pair, const fg__grid *grid,
                            const fg_read_options *options);

/* texts.c. The variable with a date as text for each index of a dimension, or
 * NULL. */
const fg__variable *fg__date_texts(const fg__dataset *data, int dimension);

/* The date at one index, "" where the text is no date. Then fg__grid_axis_values of all
 * dates, whose numbers are NaN; NULL where one of the texts is no date. */
fg_status fg__date_text(char *out, size_t size, const fg__variable *texts, size_t index);
fg_status fg__date_values(fg_axis_value **out, char **text, const fg__variable *texts,
                          size_t count);

/* The values of a time or level axis; their texts point into *text. Both are for free().
 * NULL where there is no coordinate, or too many values to choose from. */
fg_status fg__grid_axis_values(fg_axis_value **out, char **text, const fg__dataset *data,
                               const fg__variable *coordinate, size_t count);

/* The same of a vector's times or levels, which may be those of a table's rows. */
fg_status fg__index_values(fg_axis_value **out, char **text, const fg__dataset *data,
                           const fg__grid *grid, bool of_time);

/* The texts of a picture's caption. */
typedef struct fg__vector_words {
  char title[FG__TEXT_BYTES], units[FG__TEXT_BYTES];
  char time[FG__TEXT_BYTES], level[FG__TEXT_BYTES]; /* "": none */
} fg__vector_words;

/* The units of a vector as on an axis label: those of a component that has some. */
void fg__velocity_units(char *out, size_t size, const fg__pair *pair);

/* These words, the components' names and the grid's doubts as those of a field, which
 * borrows them. */
fg_field_arrays fg__vector_texts(const fg__vector_words *words, const fg__pair *pair,
                                 const fg__grid *grid);

fg_status fg__vector_words_find(fg__vector_words *out, const fg__dataset *data,
                                const fg__pair *pair, const fg__grid *grid,
                                const fg_read_options *options);

#endif
