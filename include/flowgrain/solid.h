/* Icons in 3D as solids: their geometry, files of it, and rendered pictures. */
#ifndef FLOWGRAIN_SOLID_H
#define FLOWGRAIN_SOLID_H

#include "flowgrain/icons.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Triangles. A place where the surface has a crease is one vertex with several corners,
 * each with the normal of its side. */
typedef struct fg_surface {
  int vertex_count, corner_count, triangle_count;
  double (*vertex)[3]; /* input coordinates; no two are the same place */
  int *corner;         /* [corner_count] the vertex that a corner lies at */
  float (*normal)[3];  /* [corner_count] outwards, of length 1 */
  int (*triangle)[3];  /* corners, counter-clockwise as seen from outside */
} fg_surface;

/* The solid of an icon: a tapering tube round the centreline with a cone for a head, in a
 * frame that does not twist (double reflection: Wang, Juettler, Zheng and Liu, ACM
 * Transactions on Graphics 27, 2008); closed, with Euler characteristic 2. An icon
 * without width has no triangles. MEMORY, ARGUMENT. */
FG_API fg_status fg_icon_solid(fg_surface **out, fg_context *context,
                               const fg_icon *icon);
FG_API void fg_surface_destroy(fg_surface *surface);

/* The surface {u = 0} of all clusters of a density in 3D, open where they end at the
 * boundary of the domain or of a mask. MEMORY, ARGUMENT (2D, a distributed density). */
FG_API fg_status fg_density_surface(fg_surface **out, fg_context *context,
                                    const fg_density *density);

/* A zero field means its default, in brackets. */
typedef struct fg_solid_options {
  const char *palette; /* name of a colour map, or "#rrggbb" for one colour ["gale"] */
  double speed_min, speed_max; /* ends of the colours; equal: those of
                                  fg_solid_speed_range */
  const fg_surface *surface;   /* of the clusters, shown round the arrows, transparent
                                  [none] */
  /* Of pictures: */
  int width, height;       /* pixels [at most 480 points, and as large as needed; as high
                              as needed, at most as wide] */
  double pixels_per_point; /* of a point of 1/72 inch [2.5] */
  bool has_view;           /* the next two count [those of fg_solid_best_view] */
  double azimuth, elevation; /* degrees: where the viewer stands, counter-clockwise from
                                the front (the side of least y), and above the horizon,
                                -90 to 90 */
  bool no_frame;             /* only arrows, and the outline of where the flow is */
  bool transparent;          /* no background */
  const char *title;         /* caption; NULL: from the field; "" none */
  const char *subtitle;      /* below it, likewise; NULL under a wanted title: none */
  const char *label;         /* of the colour key; NULL: speed and its units; "" none */
  double font_size;          /* points [from the picture's size] */
  bool no_keys;              /* no colour key */
  bool outline_text; /* texts are drawn as shapes [in SVG and PDF they stay texts] */
  double scale_time; /* t of the scale, for the caption [none] */
  int threads;       /* [all cores] */
} fg_solid_options;

/* The viewpoint from which a picture of icons in 3D shows most of them. Views are the
 * azimuths 0, 10, ... 350 with the elevations 10, 14, ... 50 degrees. The merit of a view
 * is the visible length of the arrows, heads counted three times, weighted by s (2 - s)
 * with s the sine of the angle to the line of sight. Of the views with at least 95 % of
 * the largest merit the one nearest to azimuth 30, elevation 22 is taken; without icons
 * that one itself. MEMORY, ARGUMENT (2D), STOPPED. */
FG_API fg_status fg_solid_best_view(double *azimuth, double *elevation,
                                    fg_context *context, const fg_field *field,
                                    const fg_icons *icons);

/* The speeds along the arrows of icons in 3D, the ends of a colour key: of all their
 * length 2 % is slower than range[0] and 2 % is faster than range[1], input units;
 * the faster for both where they differ by less than a ten-thousandth. Of a field that
 * ranks share, or NULL, each arrow has its mean speed. 0, 0 without icons. MEMORY,
 * ARGUMENT. */
FG_API fg_status fg_solid_speed_range(double range[2], fg_context *context,
                                      const fg_field *field, const fg_icons *icons);

/* Writes icons in 3D; the format follows the name's end. .vtp: VTK polydata in input
 * coordinates, with the cells' array `part` (0 a centre, 1 a spine, 2 a streamline, 3 an
 * arrow, 4 the clusters' surface) and those of their cluster; the points' array
 * `local_speed` is the speed along each line and arrow; the clusters' surface belongs to
 * none: there `cluster`, `speed`, `volume` and `local_speed` are 0. .glb: glTF 2.0 in one
 * file: a node with a mesh for each arrow, whose vertices have the colours of the speed
 * along it, and for all spines, streamlines, centres and clusters' surfaces; z is turned
 * upwards as glTF has y. .png, .svg, .pdf: a rendered picture, the same to the bit on any
 * number of threads; colours follow the speed along each arrow, and the surface of where
 * the field is valid, or of what moves in a field that hardly does, is seen as a faint
 * outline, unless ranks share the field. Pictures need the field; without it (NULL), or
 * where ranks share it, an arrow has its mean speed all along. options may be NULL.
 * FILE_ACCESS, UNSUPPORTED (another end; a picture without
 * FG_FEATURE_RENDER), ARGUMENT, MEMORY, STOPPED. */
FG_API fg_status fg_solid_write(fg_context *context, const char *path,
                                const fg_field *field, const fg_icons *icons,
                                const fg_solid_options *options);

#ifdef __cplusplus
}
#endif

#endif
