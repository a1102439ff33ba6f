/* Texts on a picture in 3D. */
#ifndef FG__WRITE_TEXT_H
#define FG__WRITE_TEXT_H

#include "picture/surface/surface.h"

/* Where texts go, and how. */
typedef struct fg__writer {
  fg__surface_file *surface;
  double em;   /* font size, in units of the drawing */
  bool shapes; /* as shapes; else they stay texts in SVG and PDF */
} fg__writer;

/* Writes from a point of the baseline on; grey: 0 black to 1 white. align: what keeps its
 * place in another font. */
void fg__write_text(const fg__writer *writer, const char *words, const double at[2],
                    bool bold, double grey, fg__align align);

#endif
