/* Icons: a curved arrow for every cluster. */
#ifndef FLOWGRAIN_ICONS_H
#define FLOWGRAIN_ICONS_H

#include "flowgrain/critical.h"
#include "flowgrain/density.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef enum fg_icon_kind {
  FG_ICON_ARROW = 0, /* a curved arrow along one streamline */
  FG_ICON_RING,      /* an arrow round a vortex, an arc of at most about 330 degrees */
  FG_ICON_SPIRAL     /* the same where the streamline does not close */
} fg_icon_kind;

/* A curved arrow: a tapering body round the centreline and a triangular head; in 3D a
 * tube and a cone. Lengths, widths and areas are in the coordinates of the field's axes,
 * speeds in the field's units. All pointers are the list's. */
typedef struct fg_icon {
  int cluster; /* label in the density, from 1; 0: none; of placed icons `id` until
                  fg_placement_find_clusters */
  fg_icon_kind kind;
  int point_count;           /* of the centreline, at least 2 */
  const double (*points)[3]; /* from tail to the tip of the head; z = 0 in 2D; in 3D, and
                                from files, the coordinate may go on past a periodic
                                boundary */
  double width;              /* body's full width where the head begins */
  double tail_width;         /* body's full width at the tail */
  double head_length;        /* along the centreline */
  double head_width;         /* full width of the head's base */
  double center[3];          /* centre of the cluster's spine, on the centreline */
  double area;               /* of the cluster (volume in 3D), or of the icon's part */
  double speed;              /* mean |v| along the centreline, or in the icon's part */
  /* Of placed icons (placement.h), else 0: */
  int id;         /* from 1, the same in all scales */
  int parent;     /* id of the icon that it goes into in the next scale; 0: not known */
  double seed[3]; /* the point from which its line was traced, */
  double way[2];  /* and the greatest length against the flow and along it */
  /* Of icons of clusters, unless read from a file, else 0 and NULL: the cluster's spine
   * from end to end, of a ring back to where it begins; and in 3D the whole streamline in
   * the cluster, of which the centreline is a part. */
  int spine_count, streamline_count;
  const double (*spine)[3], (*streamline)[3];
} fg_icon;

/* Where an icon's arrow may reach. */
typedef enum fg_extent {
  FG_EXTENT_BEST = 0, /* in its cluster, where it is seen best */
  FG_EXTENT_CLUSTER,  /* the same; of a thin cluster in 2D to both ends of its line */
  FG_EXTENT_TERRITORY /* through the points that are nearer to its cluster than to any
                         other: for three mean extents of a territory at most */
} fg_extent;

/* A zero field means its default, in brackets. */
typedef struct fg_icon_options {
  fg_extent extent; /* [BEST] */
  int threads;      /* the result does not depend on it [1] */
} fg_icon_options;

typedef struct fg_icons fg_icons;

/* Makes the icons of a density, one arrow in each cluster (Garcke, Preusser, Rumpf,
 * Telea, Weikard and van Wijk 2000): label, march, spine, streamline, arrow. Clusters too
 * small for a readable arrow give none; fg_icons_dropped counts them. No arrow crosses a
 * periodic boundary: a cluster with a quarter of itself, or of the mean cluster, on
 * either side gives an icon on each, with the same `cluster`. Of a distributed density
 * the call is collective: each rank makes the icons of some clusters from a window round
 * each, and rank 0 gets all, the same as of the whole density; on other ranks *out
 * becomes NULL. A territory's arrow passes through its cluster, which it has the number
 * of; area is the territory's. Where none does the arrow is the cluster's. ARGUMENT (a
 * density and a field of different dimensions, territories of a distributed density),
 * MEMORY, STOPPED, MPI. */
FG_API fg_status fg_icons_create(fg_icons **out, fg_context *context,
                                 const fg_field *field, const fg_density *density,
                                 const fg_icon_options *options);
FG_API void fg_icons_destroy(fg_icons *icons);

/* How many icons there are. */
FG_API int fg_icons_count(const fg_icons *icons);

/* Icon `index`, from 0 to count - 1, borrowed. */
FG_API const fg_icon *fg_icons_at(const fg_icons *icons, int index);

/* How many clusters the density had, and how many of them gave no icon. */
FG_API int fg_icons_clusters(const fg_icons *icons);
FG_API int fg_icons_dropped(const fg_icons *icons);

/* The plane of the icons' coordinates: a PROJ string (fg_field_arrays), degrees
 * as "+proj=longlat"; NULL: of no map. */
FG_API const char *fg_icons_projection(const fg_icons *icons);

/* Least and largest speed, the ends of a colour key, in the field's units; 0, 0 without
 * icons, and the largest for both where they differ by less than a ten-thousandth. Of 8
 * icons or more, outliers do not count, which would leave the others a small part of the
 * colours: those faster than the upper quartile by more than 3 times the distance between
 * the quartiles (Tukey 1977). */
FG_API void fg_icons_speed_range(double range[2], const fg_icons *icons);

/* Outline of an icon as a closed polygon, the first vertex not repeated; of placed icons
 * (`id` above 0) without kinks of the centreline that a body of this width cannot follow.
 * *vertices is allocated with malloc: free it. 2D. ARGUMENT, MEMORY. */
FG_API fg_status fg_icon_outline(const fg_icon *icon, double (**vertices)[2], int *count);

/* Stores critical points with icons, which own them from then on; their file and pictures
 * then show them. NULL: none. */
FG_API void fg_icons_keep_critical(fg_icons *icons, fg_critical_points *points);

/* The critical points stored with icons, borrowed; NULL: none. */
FG_API const fg_critical_points *fg_icons_kept_critical(const fg_icons *icons);

/* Writes icons as GeoJSON (RFC 7946), or reads them back, bit for bit. Icons of a map or
 * of a longitude-latitude grid are lines in longitude and latitude within 180 degrees,
 * cut at the antimeridian, with the plane's coordinates as a property; their areas are
 * those on the globe. Others are LineStrings in the input's coordinates. Critical points
 * that are stored with them follow as Points, and are not read back. FILE_ACCESS,
 * FILE_FORMAT, MEMORY. */
FG_API fg_status fg_icons_write(fg_context *context, const char *path,
                                const fg_icons *icons);
FG_API fg_status fg_icons_read(fg_icons **out, fg_context *context, const char *path);

#ifdef __cplusplus
}
#endif

#endif
