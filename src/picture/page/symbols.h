/* Signs of critical points. */
#ifndef FG__SYMBOLS_H
#define FG__SYMBOLS_H

#include "picture/page/page.h"

/* Draws a sign: dark on a pale rim of `rim` points. A saddle has an arrow along which it
 * flows out, crossed by a line; what turns an arrow round; a plus or minus in the ring
 * tells that it flows out or in. */
void fg__symbol_draw(cairo_t *cairo, const fg__symbol *symbol, double rim);

/* Draws the signs of a frame that lie in it whole. low: its lower left corner, in the
 * points' coordinates; points: NULL for none. */
void fg__symbols_draw(cairo_t *cairo, const fg__page *page, const double low[2],
                      const fg_critical_points *points);

/* Adds the kinds of points to those that the plan's key names. */
void fg__symbols_plan(fg__page_plan *plan, const fg_critical_points *points);

/* Adds the plan's key below all else, in rows. */
void fg__page_place_symbols(fg__page *page, fg__margins *room, const fg__page_plan *plan,
                            cairo_t *ruler);

#endif
