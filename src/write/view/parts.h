/* The parts of the page for browsers, in the order in which they are written. */
#ifndef FG__VIEW_PARTS_H
#define FG__VIEW_PARTS_H

#include <stdint.h>
#include <stdio.h>

#include "flowgrain/flowgrain.h"
#include "picture/contour.h"

/* The pages without a field, of 2D and of 3D, made by viewer/build and embedded by CMake;
 * the field's JSON takes the place of fg__view_mark. */
extern const unsigned char fg__view_page[], fg__space_page[];
extern const size_t fg__view_page_size, fg__space_page_size;
extern const char fg__view_mark[];

/* The field as the page has it: at most `most` samples, means of those about them where
 * there are more. */
typedef struct fg__view_samples {
  int size[2];
  double *axis[2];
  uint16_t *velocity[2]; /* IEEE 754 halves of v / unit; NaN: missing */
  double unit;
} fg__view_samples;

/* ARGUMENT (a part of a field), MEMORY. */
fg_status fg__view_samples_create(fg__view_samples *out, fg_context *context,
                                  const fg_field *field, size_t most);
void fg__view_samples_clear(fg__view_samples *samples);

/* The greatest component of a field's velocities. */
double fg__view_fastest(const fg_field *field);

/* The half nearest to x; ties go to the even one. */
uint16_t fg__view_half(float x);

/* Text as a string of JSON that may stand in HTML; NULL: null. */
void fg__view_text(FILE *stream, const char *text);

/* Bytes as a string of Base64. False: no memory. */
bool fg__view_bytes(FILE *stream, const void *bytes, size_t size);

/* Writes "name":[lines], each a string of Base64 of 16-bit places x, y, x, y, ... from 0
 * to 65535 between low and high; what lies beyond is at the end. False: no memory. */
bool fg__view_lines(FILE *stream, const char *name, const fg__polygons *lines,
                    const double low[2], const double high[2]);

/* Whole numbers as a string of Base64, in few bytes where neighbours are alike: their
 * differences, zigzag, in planes of bytes, by deflate (RFC 1950). False: no memory. */
bool fg__view_packed(FILE *stream, const int32_t *values, size_t count);

/* A share of so many steps, 0 to 1, as the nearest one. */
int32_t fg__view_step(double share, int steps);

/* Writes "low":[...],"high":[...],"x":,"y":(,"z":) of all points of all icons' lines, one
 * after the other, packed, places from 0 to 65535 between low and high. MEMORY. */
fg_status fg__view_paths(FILE *stream, fg_context *context, const fg_icons *icons,
                         int dimension);

/* Writes "arrows":{"rows":, paths} of placed icons in 2D. MEMORY. */
fg_status fg__view_arrows(FILE *stream, fg_context *context, const fg_icons *icons);

/* Writes {"vertices":N,"corners":N,"x":,"y":,"z":,"triangles":} of a surface in a box,
 * packed, places from 0 to FG__VIEW_STEPS; null for NULL or no triangle.
 * Vertices in the same one of `cells` cells along the box's longest side become one
 * (Rossignac and Borrel 1993). MEMORY. */
enum { FG__VIEW_STEPS = 4095 };
fg_status fg__view_surface(FILE *stream, fg_context *context, const fg_surface *surface,
                           const double low[3], const double high[3], int cells);

/* What of a run in 3D the page holds, as members that follow others: ,"box":... to the
 * last scale. MEMORY, ARGUMENT. */
fg_status fg__view_space(FILE *stream, fg_context *context, const fg_field *field,
                         const fg_view_options *options);

/* Writes "map":{...}, land, lakes, coasts and degrees on the field's plane; null for a
 * field on none. MEMORY, ARGUMENT (PROJ refuses the projection). */
fg_status fg__view_map(FILE *stream, fg_context *context, const fg_field *field);

#endif
