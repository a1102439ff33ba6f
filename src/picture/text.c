#include "picture/text.h"

#include <string.h>

enum { PIECE_BYTES = 256 };

/* An exponent's size and height, in units of the font size: usual typography. */
static const double raised_size = 0.7;
static const double raised_height = 0.36;

static void choose_font(cairo_t *cairo, double size, bool bold)
{
  cairo_select_font_face(cairo, "sans-serif", CAIRO_FONT_SLANT_NORMAL,
                         bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(cairo, size);
  /* Hinted advances depend on the surface's resolution, so a text would outgrow the box
   * that it was measured for. */
  cairo_font_options_t *options = cairo_font_options_create();
  cairo_font_options_set_hint_metrics(options, CAIRO_HINT_METRICS_OFF);
  cairo_font_options_set_hint_style(options, CAIRO_HINT_STYLE_NONE);
  cairo_font_options_set_antialias(options, CAIRO_ANTIALIAS_GRAY);
  cairo_set_font_options(cairo, options);
  cairo_font_options_destroy(options);
}

cairo_t *fg__text_ruler(void)
{
  cairo_surface_t *surface = cairo_image_surface_create(CAIRO_FORMAT_A8, 1, 1);
  cairo_t *cairo = cairo_create(surface);
  cairo_surface_destroy(surface);
  return cairo;
}

/* Copies the text up to the next mark; returns what follows. */
static const char *next_piece(const char *text, char piece[PIECE_BYTES], bool *raised)
{
  if (*text == FG__TEXT_RAISE[0] || *text == FG__TEXT_LOWER[0]) {
    *raised = *text == FG__TEXT_RAISE[0];
    ++text;
  }
  size_t length = strcspn(text, FG__TEXT_RAISE FG__TEXT_LOWER);
  size_t kept = length;
  if (kept > PIECE_BYTES - 1) {
    kept = PIECE_BYTES - 1;
    while (kept > 0 && ((unsigned char)text[kept] & 0xC0) == 0x80)
      --kept;
    length = kept;
  }
  memcpy(piece, text, kept);
  piece[kept] = '\0';
  return text + length;
}

double fg__text_width(cairo_t *cairo, const char *text, double size, bool bold)
{
  double width = 0.0;
  bool raised = false;
  while (*text) {
    char piece[PIECE_BYTES];
    text = next_piece(text, piece, &raised);
    choose_font(cairo, raised ? raised_size * size : size, bold);
    cairo_text_extents_t extents;
    cairo_text_extents(cairo, piece, &extents);
    width += extents.x_advance;
  }
  return width;
}

void fg__text_draw(cairo_t *cairo, const char *text, double size, bool bold)
{
  double x, y;
  cairo_get_current_point(cairo, &x, &y);
  bool raised = false;
  while (*text) {
    char piece[PIECE_BYTES];
    text = next_piece(text, piece, &raised);
    choose_font(cairo, raised ? raised_size * size : size, bold);
    cairo_move_to(cairo, x, raised ? y - raised_height * size : y);
    cairo_show_text(cairo, piece);
    cairo_text_extents_t extents;
    cairo_text_extents(cairo, piece, &extents);
    x += extents.x_advance;
  }
}

/* Bytes of the UTF-8 character at `text`, 0 when it is none (RFC 3629: no overlong forms,
 * no surrogates, nothing past U+10FFFF). */
static size_t character_bytes(const unsigned char *text)
{
  unsigned char first = text[0];
  if (first < 0x80)
    return 1;
  size_t bytes = first >= 0xF0 ? 4 : first >= 0xE0 ? 3 : 2;
  if (first < 0xC2 || first > 0xF4)
    return 0;
  for (size_t k = 1; k < bytes; ++k)
    if ((text[k] & 0xC0) != 0x80)
      return 0;
  if ((first == 0xE0 && text[1] < 0xA0) || (first == 0xED && text[1] > 0x9F) ||
      (first == 0xF0 && text[1] < 0x90) || (first == 0xF4 && text[1] > 0x8F))
    return 0;
  return bytes;
}

void fg__text_clean(char *out, size_t capacity, const char *text)
{
  const unsigned char *in = (const unsigned char *)text;
  size_t used = 0;
  while (*in) {
    size_t bytes = character_bytes(in);
    size_t wanted = bytes ? bytes : 1;
    if (used + wanted >= capacity)
      break;
    if (bytes == 0)
      out[used] = '?';
    else if (bytes == 1 && (*in < 0x20 || *in == 0x7F))
      out[used] = ' ';
    else
      memcpy(out + used, in, bytes);
    used += wanted;
    in += wanted;
  }
  out[used] = '\0';
}

void fg__text_shorten(cairo_t *cairo, char *text, size_t capacity, double size, bool bold,
                      double width)
{
  static const char ellipsis[] = "\xE2\x80\xA6";
  if (fg__text_width(cairo, text, size, bold) <= width)
    return;
  size_t length = strlen(text);
  while (length > 0) {
    do
      --length;
    while (length > 0 && ((unsigned char)text[length] & 0xC0) == 0x80);
    while (length > 0 && text[length - 1] == ' ')
      --length;
    if (length == 0 || length + sizeof ellipsis > capacity)
      continue;
    memcpy(text + length, ellipsis, sizeof ellipsis);
    if (fg__text_width(cairo, text, size, bold) <= width)
      return;
  }
  text[0] = '\0';
}
