/* Texts of a page as texts of an SVG file, to be searched, selected and edited. */
#ifndef FG__SVG_TEXT_H
#define FG__SVG_TEXT_H

#include "picture/page/page.h"
#include "picture/palette.h"

typedef struct fg__svg_texts {
  char *bytes;
  size_t length, capacity;
  bool lacks_memory;
} fg__svg_texts;

/* Adds a text as an element: in the font that the drawing has, or others where a viewer
 * has not got it, squeezed or stretched to the width that was measured. The page lies
 * where the drawing's transform has it, which may scale it. */
void fg__svg_texts_add(fg__svg_texts *texts, cairo_t *cairo, const fg__page_text *text,
                       fg__color color);
void fg__svg_texts_clear(fg__svg_texts *texts);

#endif
