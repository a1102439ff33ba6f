/* Text on a page: measured and drawn the same way on every surface. */
#ifndef FG__TEXT_H
#define FG__TEXT_H

#include <cairo.h>
#include <stdbool.h>
#include <stddef.h>

#include "picture/plain_text.h"

/* Above and below the baseline, in units of the font size: room for capitals with an
 * exponent, and for descenders, in the usual sans-serif fonts (DejaVu, Liberation, Noto).
 */
#define FG__TEXT_ASCENT 0.86
#define FG__TEXT_DESCENT 0.24

/* An exponent's size and height, in units of the font size: usual typography. */
#define FG__TEXT_RAISED_SIZE 0.7
#define FG__TEXT_RAISED_HEIGHT 0.36

/* Copies the text up to the next mark of an exponent's beginning or end; *raised follows
 * the marks. Returns what comes after. */
enum { FG__TEXT_PIECE_BYTES = 256 };
const char *fg__text_next_piece(const char *text, char piece[FG__TEXT_PIECE_BYTES],
                                bool *raised);

/* A drawing context to measure with, or one whose status says why there is none. End with
 * cairo_destroy. */
cairo_t *fg__text_ruler(void);

/* Width of a text in the units of the font size. */
double fg__text_width(cairo_t *cairo, const char *text, double size, bool bold);

/* Draws a text from the current point on, along the x axis of the current transform; or
 * its shapes. */
void fg__text_draw(cairo_t *cairo, const char *text, double size, bool bold, bool shapes);

/* Draws the outlines of a text's shapes, half the line's width round them. */
void fg__text_stroke(cairo_t *cairo, const char *text, double size, bool bold,
                     double line_width);

/* Cuts a text without marks and ends it with an ellipsis, so that it is at most `width`
 * wide; it may become empty. */
void fg__text_shorten(cairo_t *cairo, char *text, size_t capacity, double size, bool bold,
                      double width);

#endif
