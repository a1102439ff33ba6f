/* For tests of pages: plans of many kinds, and whether things on a page touch. */
#ifndef FG__PAGE_PLAN_TEST_H
#define FG__PAGE_PLAN_TEST_H

#include <math.h>
#include <stdio.h>

#include "base/context_test.h"
#include "picture/page/page.h"

static inline bool boxes_meet(const fg__page_box *a, const fg__page_box *b)
{
  return a->x0 < b->x1 && b->x0 < a->x1 && a->y0 < b->y1 && b->y0 < a->y1;
}

static inline fg__page_box size_key_box(const fg__page *page)
{
  return (fg__page_box){page->size_key[0], page->size_key[1] - 1.0,
                        page->size_key[0] + page->size_key_length,
                        page->size_key[1] + 1.0};
}

/* With the points at its ends. */
static inline fg__page_box color_key_box(const fg__page *page)
{
  fg__page_box box = page->color_key;
  if (page->color_key_upright) {
    box.y1 += page->color_key_point[0];
    box.y0 -= page->color_key_point[1];
  } else {
    box.x0 -= page->color_key_point[0];
    box.x1 += page->color_key_point[1];
  }
  return box;
}

static inline void check_inside(const fg__page *page, const fg__page_box *box)
{
  const double slack = 1e-6 * (page->width + page->height);
  assert_true(box->x0 >= -slack && box->y0 >= -slack);
  assert_true(box->x1 <= page->width + slack && box->y1 <= page->height + slack);
}

static const char *const titles[] = {
    "", "Wind", "Monthly mean of the sea surface wind over the oceans, from ships",
    ("An even longer title, which says where the data come from, who measured them with "
     "which instrument, and when, and which hence has no room on two lines of a page"),
    "Donaudampfschifffahrtselektrizitaetenhauptbetriebswerkbauunterbeamtengesellschaft"};

static inline fg__page_plan plan_of(double width, double height, double x, double y,
                                    int style, const char *title)
{
  fg__page_plan plan = {.width = width, .height = height};
  if (style == 0) {
    fg__axis_of_degrees(&plan.axis[0], 21.3, 21.3 + x, FG__TICKS_LONGITUDE);
    fg__axis_of_degrees(&plan.axis[1], -0.45 * y, 0.55 * y, FG__TICKS_LATITUDE);
  } else {
    const char *units = style == 1 ? "m" : "";
    double larger = fmax(x, y);
    fg__axis_of_numbers(&plan.axis[0], 5e5, 5e5 + x, larger, "projection_x", units);
    fg__axis_of_numbers(&plan.axis[1], 0.1 * y, 1.1 * y, larger, "y", units);
  }
  fg__axis_of_numbers(&plan.speed, 0.0, 13.7, 13.7, "mean speed", "m s-1");
  if (style >= 2) { /* a given label, without units */
    snprintf(plan.speed.label, sizeof plan.speed.label, "%s", title);
    plan.speed.units[0] = '\0';
  }
  plan.color_key = plan.size_key = true;
  for (int k = 0; k < FG__SYMBOL_KINDS; ++k)
    plan.has_symbol[k] = style == 1 || (style == 3 && k % 2);
  plan.short_key = style == 3;
  plan.speeds_beyond[0] = style == 1;
  plan.speeds_beyond[1] = style > 0;
  plan.arrow_length = 0.13 * sqrt(x * y);
  snprintf(plan.title, sizeof plan.title, "%s", title);
  snprintf(plan.subtitle, sizeof plan.subtitle, "%s",
           title[0] ? "UWND, VWND \xC2\xB7 January 1996 \xC2\xB7 150 arrows" : "");
  return plan;
}

#endif
