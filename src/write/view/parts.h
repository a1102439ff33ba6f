/* The parts of the page for browsers, in the order in which they are written. */
#ifndef FG__VIEW_PARTS_H
#define FG__VIEW_PARTS_H

#include <stdint.h>
#include <stdio.h>

#include "flowgrain/flowgrain.h"
#include "picture/contour.h"

/* The page without a field, made by viewer/build and embedded by CMake; the field's JSON
 * takes the place of fg__view_mark. */
extern const unsigned char fg__view_page[];
extern const size_t fg__view_page_size;
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

/* Writes "map":{...}, land, lakes, coasts and degrees on the field's plane; null for a
 * field on none. MEMORY, ARGUMENT (PROJ refuses the projection). */
fg_status fg__view_map(FILE *stream, fg_context *context, const fg_field *field);

#endif
