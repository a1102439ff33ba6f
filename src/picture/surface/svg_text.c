#include "picture/surface/svg_text.h"

#include <cairo-ft.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"

enum { FAMILY_BYTES = 96 };

static void add_bytes(fg__svg_texts *texts, const char *bytes, size_t length)
{
  if (!fg__grow((void **)&texts->bytes, &texts->capacity, texts->length + length, 1)) {
    texts->lacks_memory = true;
    return;
  }
  memcpy(texts->bytes + texts->length, bytes, length);
  texts->length += length;
}

static void add_words(fg__svg_texts *texts, const char *words)
{
  add_bytes(texts, words, strlen(words));
}

enum { NUMBER_BYTES = 40 };

/* A length in points, to a thousandth, with a point whatever the locale. */
static const char *write_number(char out[NUMBER_BYTES], double number)
{
  const long thousandths = lround(1000.0 * number), size = labs(thousandths);
  snprintf(out, NUMBER_BYTES, "%s%ld.%03ld", thousandths < 0 ? "-" : "", size / 1000,
           size % 1000);
  return out;
}

static void add_number(fg__svg_texts *texts, const char *name, double number)
{
  char words[NUMBER_BYTES];
  add_words(texts, " ");
  add_words(texts, name);
  add_words(texts, "=\"");
  add_words(texts, write_number(words, number));
  add_words(texts, "\"");
}

/* Text of an element: what XML would take for its own is escaped, and what it must not
 * hold is left out. */
static void add_escaped(fg__svg_texts *texts, const char *text)
{
  char clean[FG__TEXT_PIECE_BYTES];
  fg__text_clean(clean, sizeof clean, text);
  for (const char *at = clean; *at; ++at) {
    if (*at == '&')
      add_words(texts, "&amp;");
    else if (*at == '<')
      add_words(texts, "&lt;");
    else if (*at == '>')
      add_words(texts, "&gt;");
    else if (*at == '"')
      add_words(texts, "&quot;");
    else if (strncmp(at, "\xEF\xBF\xBE", 3) == 0 || strncmp(at, "\xEF\xBF\xBF", 3) == 0)
      at += 2; /* no characters */
    else
      add_bytes(texts, at, 1);
  }
}

/* The name of the font that "sans-serif" is here; "" where it is not known. */
static void find_family(char out[FAMILY_BYTES], cairo_t *ruler)
{
  out[0] = '\0';
  fg__text_width(ruler, "x", 10.0, false); /* chooses the font */
  cairo_scaled_font_t *font = cairo_get_scaled_font(ruler);
  if (cairo_scaled_font_get_type(font) != CAIRO_FONT_TYPE_FT)
    return;
  FT_Face face = cairo_ft_scaled_font_lock_face(font);
  if (face && face->family_name)
    snprintf(out, FAMILY_BYTES, "%s", face->family_name);
  if (face)
    cairo_ft_scaled_font_unlock_face(font);
}

/* Fonts like it come next. */
static void add_families(fg__svg_texts *texts, cairo_t *ruler)
{
  char family[FAMILY_BYTES];
  find_family(family, ruler);
  add_words(texts, " font-family=\"");
  if (family[0]) {
    add_words(texts, "'");
    for (char *at = family; *at; ++at)
      *at = *at == '\'' ? ' ' : *at;
    add_escaped(texts, family);
    add_words(texts, "', ");
  }
  const bool wide =
      strncmp(family, "DejaVu", 6) == 0 || strncmp(family, "Bitstream", 9) == 0;
  add_words(texts, wide ? "Verdana, 'Bitstream Vera Sans', sans-serif\""
                        : "'Liberation Sans', Arial, Helvetica, sans-serif\"");
}

static void add_color(fg__svg_texts *texts, fg__color color)
{
  char words[32];
  snprintf(words, sizeof words, " fill=\"#%02lx%02lx%02lx\"", lround(255.0 * color.red),
           lround(255.0 * color.green), lround(255.0 * color.blue));
  add_words(texts, words);
}

/* The text itself, with its exponents. */
static void add_pieces(fg__svg_texts *texts, const char *text, double size)
{
  bool raised = false, was_raised = false;
  while (*text) {
    char piece[FG__TEXT_PIECE_BYTES];
    text = fg__text_next_piece(text, piece, &raised);
    if (!*piece)
      continue;
    const bool apart = raised || was_raised;
    if (apart) {
      add_words(texts, "<tspan");
      add_number(texts, "dy", (was_raised - raised) * FG__TEXT_RAISED_HEIGHT * size);
      add_number(texts, "font-size", raised ? FG__TEXT_RAISED_SIZE * size : size);
      add_words(texts, ">");
    }
    add_escaped(texts, piece);
    if (apart)
      add_words(texts, "</tspan>");
    was_raised = raised;
  }
}

static void add_place(fg__svg_texts *texts, const fg__page_text *text, const double at[2])
{
  char words[2][NUMBER_BYTES];
  add_number(texts, "x", at[0]);
  add_number(texts, "y", at[1]);
  if (!text->upwards)
    return;
  add_words(texts, " transform=\"rotate(-90 ");
  add_words(texts, write_number(words[0], at[0]));
  add_words(texts, " ");
  add_words(texts, write_number(words[1], at[1]));
  add_words(texts, ")\"");
}

void fg__svg_texts_add(fg__svg_texts *texts, cairo_t *cairo, const fg__page_text *text,
                       fg__color color)
{
  static const char *const anchors[] = {NULL, " text-anchor=\"middle\"",
                                        " text-anchor=\"end\""};
  static const double shares[] = {0.0, 0.5, 1.0};
  const double width = fg__text_width(cairo, text->text, text->size, text->bold);
  if (!(width > 0.0))
    return;
  const double along = shares[text->align] * width;
  double at[2] = {text->x + (text->upwards ? 0.0 : along),
                  text->y - (text->upwards ? along : 0.0)};
  double unit = 1.0, none = 0.0;
  cairo_user_to_device(cairo, &at[0], &at[1]);
  cairo_user_to_device_distance(cairo, &unit, &none);
  add_words(texts, "<text");
  add_place(texts, text, at);
  add_families(texts, cairo);
  add_number(texts, "font-size", unit * text->size);
  if (text->bold)
    add_words(texts, " font-weight=\"bold\"");
  if (anchors[text->align])
    add_words(texts, anchors[text->align]);
  add_color(texts, color);
  add_number(texts, "textLength", unit * width);
  add_words(texts, " lengthAdjust=\"spacingAndGlyphs\" xml:space=\"preserve\">");
  add_pieces(texts, text->text, unit * text->size);
  add_words(texts, "</text>\n");
}

void fg__svg_texts_clear(fg__svg_texts *texts)
{
  free(texts->bytes);
  *texts = (fg__svg_texts){.bytes = NULL};
}
