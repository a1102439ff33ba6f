#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/context_test.h"
#include "picture/page/page_plan_test.h"

/* No two things on the page touch; all lie on it; one unit is as long along x and y. */
static void check_page(const fg__page *page, const fg__page_plan *plan)
{
  fg__page_box things[FG__PAGE_TEXTS + 3 + FG__SYMBOL_KINDS];
  int count = 0;
  for (int k = 0; k < page->text_count; ++k)
    things[count++] = page->text[k].box;
  things[count++] = page->frame;
  if (page->has_color_key)
    things[count++] = color_key_box(page);
  if (page->has_size_key)
    things[count++] = size_key_box(page);
  for (int k = 0; k < page->symbol_count; ++k) {
    const fg__symbol *sign = &page->symbol[k];
    things[count++] = (fg__page_box){sign->x - sign->radius, sign->y - sign->radius,
                                     sign->x + sign->radius, sign->y + sign->radius};
  }
  for (int a = 0; a < count; ++a) {
    check_inside(page, &things[a]);
    for (int b = 0; b < a; ++b) {
      if (boxes_meet(&things[a], &things[b]))
        print_error("page %g x %g: %s meets %s\n", page->width, page->height,
                    a < page->text_count ? page->text[a].text : "a box",
                    b < page->text_count ? page->text[b].text : "a box");
      assert_false(boxes_meet(&things[a], &things[b]));
    }
  }
  double wide = page->frame.x1 - page->frame.x0, high = page->frame.y1 - page->frame.y0;
  double x = plan->axis[0].high - plan->axis[0].low;
  double y = plan->axis[1].high - plan->axis[1].low;
  assert_true(page->scale > 0.0);
  assert_true(fabs(wide / x / page->scale - 1.0) < 1e-6);
  assert_true(fabs(high / y / page->scale - 1.0) < 1e-6);
}

static void nothing_collides_on_any_page(void **state)
{
  (void)state;
  static const double widths[] = {0, 20, 60, 110, 170, 252, 480, 700, 1600, 20000};
  static const double heights[] = {0, 30, 90, 200, 500, 1500, 20000};
  static const double shapes[][2] = {{360, 180}, {1, 1},    {20, 1}, {1, 20},
                                     {1000, 1},  {1, 1000}, {3, 4},  {1.6, 1}};
  cairo_t *ruler = fg__text_ruler();
  fg__page *page = malloc(sizeof *page);
  assert_non_null(page);
  int pages = 0, complete = 0, with_signs = 0;
  for (size_t w = 0; w < sizeof widths / sizeof *widths; ++w)
    for (size_t h = 0; h < sizeof heights / sizeof *heights; ++h)
      for (size_t s = 0; s < sizeof shapes / sizeof *shapes; ++s)
        for (int style = 0; style < 4; ++style) {
          const char *title = titles[(w + h + s + (size_t)style) % 5];
          double unit = style == 1 ? 1e5 : style >= 2 ? 1e-4 : 1.0;
          double x = unit * shapes[s][0], y = unit * shapes[s][1];
          /* of the squares of a chessboard one colour */
          if ((w + h + s + (size_t)style) % 2 || (style == 0 && (x > 360 || y > 180)))
            continue;
          fg__page_plan plan = plan_of(widths[w], heights[h], x, y, style, title);
          fg__page_layout(page, &plan, ruler);
          check_page(page, &plan);
          if (widths[w] > 0.0)
            assert_true(page->width == widths[w]);
          if (heights[h] > 0.0)
            assert_true(page->height == heights[h]);
          ++pages;
          complete += page->has_color_key && page->has_size_key;
          assert_in_range(page->symbol_count, 0, style == 1 ? 6 : style == 3 ? 3 : 0);
          with_signs += page->symbol_count > 0;
        }
  assert_true(complete > pages / 4);
  assert_true(with_signs > pages / 4);
  assert_int_equal(cairo_status(ruler), CAIRO_STATUS_SUCCESS);
  free(page);
  cairo_destroy(ruler);
}

static fg__page *lay_out(const fg__page_plan *plan)
{
  cairo_t *ruler = fg__text_ruler();
  fg__page *page = malloc(sizeof *page);
  assert_non_null(page);
  fg__page_layout(page, plan, ruler);
  cairo_destroy(ruler);
  return page;
}

static bool has_text(const fg__page *page, const char *text)
{
  for (int k = 0; k < page->text_count; ++k)
    if (strcmp(page->text[k].text, text) == 0)
      return true;
  return false;
}

static void a_usual_page_has_everything(void **state)
{
  (void)state;
  static const double shapes[][2] = {{360, 170}, {40, 40}, {30, 50}};
  for (int s = 0; s < 3; ++s) {
    fg__page_plan plan = plan_of(0, 0, shapes[s][0], shapes[s][1], 0, "Wind");
    fg__page *page = lay_out(&plan);
    assert_true(page->has_color_key && page->has_size_key);
    assert_true(page->color_key_upright == (s > 0));
    assert_true(has_text(page, "Wind") && has_text(page, plan.speed.label));
    assert_true(has_text(page, "0\xC2\xB0"));
    assert_true(page->line_count >= 9);
    assert_true(page->frame.x1 - page->frame.x0 > 0.55 * page->width);
    free(page);
  }
}

/* A short key of colours lies in the middle of its side, and a label that is longer than
 * it is on one line. */
static void a_short_key_is_in_the_middle(void **state)
{
  (void)state;
  static const double shapes[][2] = {{360, 170}, {40, 40}};
  static const char label[] = "speed of the current near the surface";
  for (int s = 0; s < 2; ++s) {
    fg__page_plan plan = plan_of(480, 0, shapes[s][0], shapes[s][1], 3, label);
    fg__page *page = lay_out(&plan);
    check_page(page, &plan);
    assert_true(page->has_color_key && page->has_size_key && has_text(page, label));
    const fg__page_box *f = &page->frame, key = color_key_box(page);
    const double side = s ? f->y1 - f->y0 : f->x1 - f->x0;
    const double length = s ? key.y1 - key.y0 : key.x1 - key.x0;
    const double off =
        s ? key.y0 + key.y1 - f->y0 - f->y1 : key.x0 + key.x1 - f->x0 - f->x1;
    assert_true(fabs(length / side - 0.5) < 1e-6);
    assert_true(fabs(off) < 1e-6 * side);
    free(page);
  }
}

/* Numbers at the colour key of a page without axes and size key. */
static int key_numbers(const fg__page *page)
{
  int count = 0;
  for (int k = 0; k < page->text_count; ++k) {
    char *end;
    strtod(page->text[k].text, &end);
    count += end > page->text[k].text && page->text[k].box.y0 > page->color_key.y1;
  }
  return count;
}

/* Below the frame it makes a page no wider; one number tells no scale. */
static void a_narrow_page_has_a_colour_key(void **state)
{
  (void)state;
  static const double shapes[][2] = {{360, 170}, {40, 40}, {30, 50}};
  static const double fastest[] = {8.0, 0.075, 4000.0};
  for (int s = 0; s < 3; ++s) {
    fg__page_plan plan = plan_of(70, 0, shapes[s][0], shapes[s][1], 0, "Wind");
    fg__axis_of_numbers(&plan.speed, 0.16 * fastest[s], fastest[s], fastest[s],
                        "mean speed", "");
    fg__page *page = lay_out(&plan);
    check_page(page, &plan);
    assert_true(page->has_color_key && !page->color_key_upright);
    assert_true(has_text(page, "Wind")); /* leaving it out makes no room beside */
    assert_true(key_numbers(page) >= 2);
    assert_true(fg__page_key_width(page, NULL, &plan) == 0.0);
    free(page);
  }
}

static void a_page_without_key_tells_from_which_width_on_it_has_one(void **state)
{
  (void)state;
  static const double sizes[][2] = {{100, 0}, {100, 90}, {0, 0}};
  for (int s = 0; s < 3; ++s) {
    fg__page_plan plan = plan_of(sizes[s][0], sizes[s][1], 40, 40, 0, "Wind");
    plan.font_size = s == 2 ? 150.0 : 40.0;
    fg__page *page = lay_out(&plan);
    assert_false(page->has_color_key);
    const double before = page->width;
    const double width = fg__page_key_width(page, NULL, &plan);
    assert_true(page->has_color_key && page->width == width && width > before);
    plan.height *= width / before;
    plan.width = width;
    cairo_t *ruler = fg__text_ruler();
    fg__page_layout(page, &plan, ruler);
    assert_true(page->has_color_key);
    plan.height *= 0.9;
    plan.width *= 0.9;
    fg__page_layout(page, &plan, ruler);
    assert_false(page->has_color_key);
    plan.color_key = false;
    assert_true(fg__page_key_width(page, NULL, &plan) == 0.0);
    cairo_destroy(ruler);
    free(page);
  }
}

/* A line below the title that is too long is broken between its parts. */
static void captions_break_between_their_parts(void **state)
{
  (void)state;
  fg__page_plan plan = plan_of(190, 0, 40, 40, 0, "Wind");
  snprintf(plan.subtitle, sizeof plan.subtitle,
           "2022-02-21 12:00 \xC2\xB7 depth 0 m \xC2\xB7 80 arrows \xC2\xB7 "
           "mean direction error 15\xC2\xB0");
  fg__page *page = lay_out(&plan);
  check_page(page, &plan);
  assert_true(has_text(page, "2022-02-21 12:00 \xC2\xB7 depth 0 m \xC2\xB7 80 arrows"));
  assert_true(has_text(page, "mean direction error 15\xC2\xB0"));
  free(page);
}

/* A given label is written whole, in as many lines and as small as that takes. */
static void long_titles_and_labels_are_broken_or_shrink(void **state)
{
  (void)state;
  fg__page_plan plan = plan_of(300, 0, 30, 30, 2, titles[3]);
  fg__page *page = lay_out(&plan);
  const char *title = plan.title, *label = plan.title;
  double least = 100.0;
  /* a caption's last line comes first */
  for (int k = page->text_count - 1; k >= 0; --k) {
    const fg__page_text *text = &page->text[k];
    const size_t length = strlen(text->text);
    if (text->bold && strncmp(title, text->text, length) == 0)
      title += length + strspn(title + length, " ");
    least = fmin(least, text->size);
  }
  for (int k = 0; k < page->text_count; ++k) {
    const size_t length = strlen(page->text[k].text);
    if (page->text[k].upwards && strncmp(label, page->text[k].text, length) == 0)
      label += length + strspn(label + length, " ");
  }
  assert_string_equal(title, "");
  assert_string_equal(label, "");
  assert_true(least > 0.66 * page->font_size);
  free(page);
}

static double longer_side(const fg__page_box *box)
{
  return fmax(box->x1 - box->x0, box->y1 - box->y0);
}

/* Only an end beyond which there are speeds has a point, in the room of a plain bar. */
static void a_key_points_at_speeds_beyond(void **state)
{
  (void)state;
  for (int s = 0; s < 2; ++s)
    for (int ends = 1; ends < 4; ++ends) {
      fg__page_plan plan = plan_of(0, 0, s ? 40 : 360, 90, 0, "Wind");
      fg__page *plain = lay_out(&plan);
      plan.speeds_beyond[0] = ends & 1;
      plan.speeds_beyond[1] = ends & 2;
      fg__page *pointed = lay_out(&plan);
      assert_true(plain->has_color_key && pointed->has_color_key);
      fg__page_box without = color_key_box(plain), with = color_key_box(pointed);
      assert_true(fabs(longer_side(&with) - longer_side(&without)) < 1e-9);
      assert_true(longer_side(&pointed->color_key) < longer_side(&without) - 1.0);
      for (int k = 0; k < 2; ++k) {
        assert_true(plain->color_key_point[k] == 0.0);
        assert_true((pointed->color_key_point[k] > 1.0) == plan.speeds_beyond[k]);
      }
      free(plain);
      free(pointed);
    }
}

static void ticks_mark_their_coordinates(void **state)
{
  (void)state;
  fg__page_plan plan = plan_of(480, 0, 80, 60, 0, "");
  fg__page *page = lay_out(&plan);
  int found = 0;
  for (int k = 0; k < page->text_count; ++k) {
    double degrees = atof(page->text[k].text);
    size_t digits = strspn(page->text[k].text, "0123456789");
    const char *side = page->text[k].text + digits;
    const fg__page_box *box = &page->text[k].box;
    if (strcmp(side, "\xC2\xB0"
                     "E") == 0) {
      double x = page->frame.x0 + page->scale * (degrees - plan.axis[0].low);
      assert_true(fabs(0.5 * (box->x0 + box->x1) - x) < 0.01);
      ++found;
    } else if (strcmp(side, "\xC2\xB0"
                            "S") == 0) {
      double y = page->frame.y1 - page->scale * (-degrees - plan.axis[1].low);
      assert_true(box->y0 < y && y < box->y1);
      ++found;
    }
  }
  assert_true(found >= 5);
  free(page);
}

static void the_reference_arrow_has_its_length(void **state)
{
  (void)state;
  for (int s = 0; s < 2; ++s) {
    fg__page_plan plan = plan_of(480, 0, s ? 41 : 360, 80, 0, "");
    fg__page *page = lay_out(&plan);
    assert_true(page->has_size_key);
    double degrees = 0.0;
    for (int k = 0; k < page->text_count; ++k) {
      size_t digits = strspn(page->text[k].text, "0123456789.");
      if (strcmp(page->text[k].text + digits, "\xC2\xB0") == 0 &&
          page->text[k].box.y0 > page->size_key[1])
        degrees = fmax(degrees, atof(page->text[k].text));
    }
    assert_true(fabs(page->size_key_length - degrees * page->scale) < 1e-6);
    assert_true(degrees > 0.5 * plan.arrow_length && degrees < 2.0 * plan.arrow_length);
    free(page);
  }
}

static void no_frame_is_the_domain_alone(void **state)
{
  (void)state;
  fg__page_plan plan = plan_of(300, 0, 25, 40, 0, "Wind");
  plan.no_frame = true;
  fg__page *page = lay_out(&plan);
  assert_int_equal(page->text_count, 0);
  assert_int_equal(page->line_count, 0);
  assert_false(page->framed || page->has_color_key || page->has_size_key);
  assert_true(fabs(page->height - 480.0) < 1e-9 && page->width == 300.0);
  assert_true(page->frame.x0 == 0.0 && page->frame.y0 == 0.0);
  assert_true(fabs(page->frame.x1 - 300.0) < 1e-9);
  assert_true(fabs(page->frame.y1 - 480.0) < 1e-9);
  free(page);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(nothing_collides_on_any_page),
      cmocka_unit_test(a_usual_page_has_everything),
      cmocka_unit_test(a_narrow_page_has_a_colour_key),
      cmocka_unit_test(a_page_without_key_tells_from_which_width_on_it_has_one),
      cmocka_unit_test(captions_break_between_their_parts),
      cmocka_unit_test(a_short_key_is_in_the_middle),
      cmocka_unit_test(long_titles_and_labels_are_broken_or_shrink),
      cmocka_unit_test(a_key_points_at_speeds_beyond),
      cmocka_unit_test(ticks_mark_their_coordinates),
      cmocka_unit_test(the_reference_arrow_has_its_length),
      cmocka_unit_test(no_frame_is_the_domain_alone),
  };
  return cmocka_run_group_tests_name("picture/page/page", tests, NULL, NULL);
}
