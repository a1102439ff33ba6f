/* Other methods to compare with, each after its paper (docs/method), drawn in the same
 * style. Included by flowgrain.h. */
#ifndef FLOWGRAIN_RIVAL_H
#define FLOWGRAIN_RIVAL_H

#include "flowgrain/icons.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef enum fg_rival_method {
  FG_RIVAL_HEDGEHOG = 0, /* straight arrows at the points of a grid */
  FG_RIVAL_GRID_CURVED,  /* pieces of streamlines through the points of a grid */
  FG_RIVAL_DISCRETE,     /* clusters merged from the bottom up (Telea, van Wijk 1999) */
  FG_RIVAL_TOP_DOWN,     /* clusters bisected from the top down (Heckel et al. 1999) */
  FG_RIVAL_STREAMLINES,  /* evenly spaced (Jobard, Lefer 1997) */
  FG_RIVAL_VORONOI,      /* pieces of streamlines through centroidal Voronoi seeds */
  FG_RIVAL_K_MEANS,      /* the same, one a cluster of place and direction */
  FG_RIVAL_FARTHEST, /* long streamlines from the farthest place each (Mebarki, Alliez,
                        Devillers 2005) */
  FG_RIVAL_RANDOM    /* pieces of streamlines through random points, always the same */
} fg_rival_method;

/* A zero field means its default, in brackets. */
typedef struct fg_rival_options {
  fg_rival_method method; /* [hedgehog] */
  int nodes; /* of the raster that the method works on, along the longest side [257, in 3D
                49] */
  bool length_by_speed; /* hedgehog, grid-curved: length proportional to |v| [equal] */
  double length; /* of an arrow (the longest), in fair-share lengths sqrt(area / count),
                    in 3D cbrt(volume / count); not of discrete, top-down, streamlines,
                    farthest [what the method has] */
  double position_weight; /* discrete: weight of position against direction, in (0, 1]
                             [0.95] */
  bool direction_only;    /* discrete: the weight of position is 0 */
  double elongation;      /* discrete: elongation of clusters along the flow, at least 1
                             [2] */
} fg_rival_options;

typedef struct fg_rival fg_rival;

/* Prepares a method for a field, which must outlive it. UNSUPPORTED (discrete and
 * top-down in 3D), ARGUMENT (options out of range), MEMORY, STOPPED. */
FG_API fg_status fg_rival_create(fg_rival **out, fg_context *context,
                                 const fg_field *field, const fg_rival_options *options);
FG_API void fg_rival_destroy(fg_rival *rival);

/* Makes about `count` arrows; can be called again with other counts. Grids and evenly
 * spaced streamlines come as near to `count` as their shape or spacing allows. Discrete
 * and top-down make `count` clusters, nested from count to count. Other methods give
 * exactly `count` where there is room. No centreline leaves the domain. Where the flow is
 * at rest there is no arrow; fg_icons_dropped counts those. ARGUMENT (count below 1),
 * MEMORY, STOPPED. */
FG_API fg_status fg_rival_icons(fg_icons **out, fg_rival *rival, int count);

/* The clusters that these arrows stand for, u > 0 inside each and below on the lines
 * between them, on two nodes a cell: to be drawn behind the arrows (fg_picture_write) or
 * written with labels (fg_density_write). UNSUPPORTED (a method without clusters),
 * ARGUMENT, MEMORY, STOPPED. */
FG_API fg_status fg_rival_clusters(fg_density **out, fg_rival *rival, int count);

/* Whether a method has clusters. */
FG_API bool fg_rival_divides(fg_rival_method method);

/* The word for a method, as the program takes it: "grid-curved"; NULL beyond the last. */
FG_API const char *fg_rival_name(fg_rival_method method);

#ifdef __cplusplus
}
#endif

#endif
