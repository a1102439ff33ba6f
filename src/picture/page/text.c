#include "picture/page/text.h"

#include <string.h>

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

const char *fg__text_next_piece(const char *text, char piece[FG__TEXT_PIECE_BYTES],
                                bool *raised)
{
  if (*text == FG__TEXT_RAISE[0] || *text == FG__TEXT_LOWER[0]) {
    *raised = *text == FG__TEXT_RAISE[0];
    ++text;
  }
  size_t length = strcspn(text, FG__TEXT_RAISE FG__TEXT_LOWER);
  size_t kept = length;
  if (kept > FG__TEXT_PIECE_BYTES - 1) {
    kept = FG__TEXT_PIECE_BYTES - 1;
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
    char piece[FG__TEXT_PIECE_BYTES];
    text = fg__text_next_piece(text, piece, &raised);
    choose_font(cairo, raised ? FG__TEXT_RAISED_SIZE * size : size, bold);
    cairo_text_extents_t extents;
    cairo_text_extents(cairo, piece, &extents);
    width += extents.x_advance;
  }
  return width;
}

typedef void draw_piece(cairo_t *cairo, const char *piece);

static void fill_piece(cairo_t *cairo, const char *piece)
{
  cairo_text_path(cairo, piece);
  cairo_fill(cairo);
}

static void stroke_piece(cairo_t *cairo, const char *piece)
{
  cairo_text_path(cairo, piece);
  cairo_stroke(cairo);
}

/* From the current point on. */
static void draw_pieces(cairo_t *cairo, const char *text, double size, bool bold,
                        draw_piece *draw)
{
  double x, y;
  cairo_get_current_point(cairo, &x, &y);
  bool raised = false;
  while (*text) {
    char piece[FG__TEXT_PIECE_BYTES];
    text = fg__text_next_piece(text, piece, &raised);
    choose_font(cairo, raised ? FG__TEXT_RAISED_SIZE * size : size, bold);
    cairo_move_to(cairo, x, raised ? y - FG__TEXT_RAISED_HEIGHT * size : y);
    draw(cairo, piece);
    cairo_text_extents_t extents;
    cairo_text_extents(cairo, piece, &extents);
    x += extents.x_advance;
  }
}

void fg__text_draw(cairo_t *cairo, const char *text, double size, bool bold, bool shapes)
{
  draw_pieces(cairo, text, size, bold, shapes ? fill_piece : cairo_show_text);
}

void fg__text_stroke(cairo_t *cairo, const char *text, double size, bool bold,
                     double line_width)
{
  cairo_set_line_width(cairo, line_width);
  cairo_set_line_join(cairo, CAIRO_LINE_JOIN_ROUND);
  draw_pieces(cairo, text, size, bold, stroke_piece);
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
