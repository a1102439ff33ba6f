#include "picture/render/write_text.h"

#include <stdio.h>

#include "picture/page/text.h"

void fg__write_text(const fg__writer *writer, const char *words, const double at[2],
                    bool bold, double grey, fg__align align)
{
  cairo_t *cairo = writer->surface->cairo;
  if (writer->surface->format == FG__SURFACE_SVG && !writer->shapes) {
    fg__page_text text = {
        .size = writer->em, .bold = bold, .align = align, .x = at[0], .y = at[1]};
    snprintf(text.text, sizeof text.text, "%s", words);
    fg__svg_texts_add(&writer->surface->texts, cairo, &text,
                      (fg__color){grey, grey, grey});
    return;
  }
  cairo_set_source_rgb(cairo, grey, grey, grey);
  cairo_move_to(cairo, at[0], at[1]);
  fg__text_draw(cairo, words, writer->em, bold, writer->shapes);
}
