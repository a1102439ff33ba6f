/* The surface that a picture is drawn on, and the file that it becomes. */
#ifndef FG__SURFACE_H
#define FG__SURFACE_H

#include <cairo.h>

#include "file/whole_file.h"
#include "picture/surface/svg_text.h"

typedef enum fg__surface_file_format {
  FG__SURFACE_SVG,
  FG__SURFACE_PDF,
  FG__SURFACE_PNG,
  FG__SURFACE_UNKNOWN
} fg__surface_file_format;

/* The format that a path's end names; UNKNOWN is reported by fg__surface_file_open. */
fg__surface_file_format fg__surface_file_format_of(const char *path);

/* A0 paper is 3370 points high; a page six times that is a mistake. */
#define FG__LARGEST_PAGE 20000.0

/* Refuses options of pictures that cannot be: pixels a point and the font's size, 0 where
 * they follow, and the speeds at the ends of the colour key. ARGUMENT. */
fg_status fg__surface_options_check(fg_context *context, double pixels_per_point,
                                    double font_size, double speed_min, double speed_max);

typedef struct fg__surface_file {
  fg__surface_file_format format;
  fg__whole_file file;
  cairo_surface_t *target;
  cairo_t *cairo; /* draws in points */
  char *svg;      /* the file as Cairo writes it */
  size_t svg_length, svg_capacity;
  fg__svg_texts texts; /* that follow it */
  double pixels_per_point;
  size_t png_length; /* of PNG, as Cairo writes it, so far */
} fg__surface_file;

/* Opens a surface of width x height points, which in PNG has pixels_per_point, and says
 * so. title: for
 * PDF, or NULL. FILE_ACCESS, UNSUPPORTED (the path's end), MEMORY; after a failure there
 * is nothing to close. */
fg_status fg__surface_file_open(fg__surface_file *out, fg_context *context,
                                const char *path, double width, double height,
                                double pixels_per_point, const char *title);

/* Fails for formats that are not known, as fg__surface_file_open would. UNSUPPORTED. */
fg_status fg__surface_file_format_check(fg_context *context, const char *path);

/* Finishes the drawing; with status OK the file takes its name when it is whole,
 * otherwise nothing is left. Returns `status`, or what went wrong now. FILE_ACCESS,
 * UNSUPPORTED, MEMORY. */
fg_status fg__surface_file_close(fg__surface_file *page_surface, fg_context *context,
                                 fg_status status);

#endif
