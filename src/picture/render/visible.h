/* Which triangles are seen at points of the picture. */
#ifndef FG__VISIBLE_H
#define FG__VISIBLE_H

#include "picture/render/bands.h"
#include "picture/render/faces.h"

/* Points within a pixel where edges are drawn: as many shades are between. */
enum { FG__SAMPLES = 16 };

/* Points of a pixel in turn that share transparent surfaces, which vary little. */
enum { FG__SHARING = 4, FG__SHARES = FG__SAMPLES / FG__SHARING };

/* Where a pixel is looked at, from its upper left corner: one point a row and a column of
 * 16, and one a quarter of each. */
extern const double fg__sample_place[FG__SAMPLES][2];

/* What is nearest at a point. */
typedef struct fg__face_at {
  float depth; /* along the view; infinite: nothing is there */
  int face;    /* -1: nothing is there */
} fg__face_at;

/* A transparent surface at a point. */
typedef struct fg__layer {
  float distance, normal[3];
  bool silhouette; /* else the clusters' */
} fg__layer;

/* Layers of points: those of point p are layer[first[p]] to layer[first[p + 1] - 1], the
 * nearest first. */
typedef struct fg__layers {
  fg__layer *found, *layer; /* as they were found, and sorted */
  int *point;               /* of each that was found */
  size_t count, found_capacity, layer_capacity, point_capacity;
  int *first;
  size_t first_capacity;
} fg__layers;

/* The pixels that a triangle may touch. */
typedef struct fg__face_extent {
  fg__band_rows rows, columns;
} fg__face_extent;

/* Triangles as the viewer sees them. */
typedef struct fg__view {
  const fg__rendering *about;
  const fg__geometry *geometry;
  fg__face_extent *solid_extent, *layer_extent;
  fg__bands solid, layer;
} fg__view;

/* Sorts the triangles into bands. `out` is to be cleared also after a failure. MEMORY. */
fg_status fg__view_make(fg__view *out, fg_context *context, const fg__rendering *about,
                        const fg__geometry *geometry);
void fg__view_clear(fg__view *view);

/* The nearest arrow or halo in the middle of each pixel of a band: out[row][column]. */
void fg__view_middles(const fg__view *view, int band, fg__face_at *out);

/* The same at the samples of some pixels: chosen[row][column] is a pixel's number, or -1;
 * `count` pixels are chosen. out[count][FG__SAMPLES]. */
void fg__view_samples(const fg__view *view, int band, const int *chosen, int count,
                      fg__face_at *out);

/* Transparent surfaces in the middle of each pixel of a band: point row * width + column.
 * MEMORY is reported as false. */
bool fg__view_layers(const fg__view *view, int band, fg__layers *out);

/* The same at the first of each FG__SHARING samples of the chosen pixels: point
 * FG__SHARES * number + sample / FG__SHARING. */
bool fg__view_sample_layers(const fg__view *view, int band, const int *chosen, int count,
                            fg__layers *out);
void fg__layers_clear(fg__layers *layers);

/* A point of an arrow. */
typedef struct fg__seen {
  double distance;
  double normal[3]; /* unit, towards the eye's side */
  double share;     /* of the way through the colours */
} fg__seen;

/* What is known of a triangle at pixel coordinates. */
void fg__view_seen(const fg__view *view, int face, double x, double y, fg__seen *out);

#endif
