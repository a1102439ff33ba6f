#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/context_test.h"
#include "picture/map/graticule.h"
#include "picture/page/page_plan_test.h"

/* What lies on the page of a figure: its own things but the frame, the panels' frames and
 * texts. */
static int collect_things(fg__page_box *things, const fg__page *page,
                          const fg__page *panel, int panels)
{
  int count = 0;
  for (int k = 0; k < page->text_count; ++k)
    things[count++] = page->text[k].box;
  if (page->has_color_key)
    things[count++] = color_key_box(page);
  if (page->has_size_key)
    things[count++] = size_key_box(page);
  for (int n = 0; n < panels; ++n) {
    things[count++] = panel[n].frame;
    for (int k = 0; k < panel[n].text_count; ++k)
      things[count++] = panel[n].text[k].box;
  }
  return count;
}

/* No two things touch, all lie on the page, and all frames have one size. Returns how
 * many panels have a label, which is the last of their texts. */
static int check_figure(const fg__page *page, const fg__page *panel,
                        const fg__page_plan *plan)
{
  static fg__page_box things[13 * FG__PAGE_TEXTS];
  const int count = collect_things(things, page, panel, plan->panels);
  for (int a = 0; a < count; ++a) {
    check_inside(page, &things[a]);
    for (int b = 0; b < a; ++b)
      assert_false(boxes_meet(&things[a], &things[b]));
  }
  int labels = 0;
  for (int n = 0; n < plan->panels; ++n) {
    const double x = plan->axis[0].high - plan->axis[0].low;
    const double y = plan->axis[1].high - plan->axis[1].low;
    const fg__page_box *frame = &panel[n].frame;
    assert_true(page->scale > 0.0 && panel[n].scale == page->scale);
    assert_true(fabs((frame->x1 - frame->x0) / x / page->scale - 1.0) < 1e-6);
    assert_true(fabs((frame->y1 - frame->y0) / y / page->scale - 1.0) < 1e-6);
    const int last = panel[n].text_count - 1;
    labels += last >= 0 && strncmp(panel[n].text[last].text, "(", 1) == 0;
  }
  return labels;
}

static bool has_number_at(const fg__page *page, bool left)
{
  for (int k = 0; k < page->text_count; ++k)
    if (left ? page->text[k].box.x1 < page->frame.x0
             : page->text[k].box.y0 > page->frame.y1)
      return true;
  return false;
}

static void panels_lie_side_by_side_with_numbers_outside(void **state)
{
  (void)state;
  static const double widths[] = {0, 40, 252, 480, 1600}, heights[] = {0, 90, 500};
  static const double shapes[][2] = {{360, 170}, {1, 1}, {1, 12}, {30, 1}};
  static const char labels[12][FG__PAGE_TEXT_BYTES] = {
      "(a) 1982-01-16",
      "(b) a level of 300 hPa and a long word to say it",
      "(c)",
      "(d)",
      "(e)",
      "(f)",
      "(g)",
      "(h)",
      "(i)",
      "(j)",
      "(k)",
      "(l)"};
  fg__page *page = malloc(13 * sizeof *page);
  assert_non_null(page);
  fg__page *panel = page + 1;
  cairo_t *ruler = fg__text_ruler();
  int labelled = 0, panels = 0, keys = 0, figures = 0;
  for (size_t w = 0; w < sizeof widths / sizeof *widths; ++w)
    for (size_t h = 0; h < sizeof heights / sizeof *heights; ++h)
      for (size_t s = 0; s < sizeof shapes / sizeof *shapes; ++s)
        for (int count = 1; count <= 12; count = 2 * count + 1) {
          fg__page_plan plan = plan_of(widths[w], heights[h], shapes[s][0], shapes[s][1],
                                       s == 0 ? 0 : 2, titles[w % 3]);
          plan.panels = count;
          plan.panel_label = labels;
          plan.columns = count == 7 ? 3 : fg__page_choose_columns(&plan);
          fg__page_layout_panels(page, panel, &plan, ruler);
          labelled += check_figure(page, panel, &plan);
          panels += count;
          keys += page->has_color_key;
          ++figures;
          for (int n = 0; n < count; ++n) {
            const bool has_axes = has_number_at(&panel[0], true);
            assert_int_equal(has_number_at(&panel[n], true),
                             has_axes && n % plan.columns == 0);
          }
        }
  assert_true(labelled > panels / 2);
  assert_true(keys > figures / 2);
  cairo_destroy(ruler);
  free(page);
}

/* Degrees and numbers below a panel stand where no other is below it. */
static void a_last_row_that_is_not_full_leaves_no_column_without_numbers(void **state)
{
  (void)state;
  static const char labels[5][FG__PAGE_TEXT_BYTES] = {"(a)", "(b)", "(c)", "(d)", "(e)"};
  fg__page_plan plan = plan_of(480, 0, 40, 30, 0, "Wind");
  plan.panels = 5;
  plan.panel_label = labels;
  plan.columns = fg__page_choose_columns(&plan);
  assert_int_equal(plan.columns, 3);
  fg__page *page = malloc(6 * sizeof *page);
  assert_non_null(page);
  cairo_t *ruler = fg__text_ruler();
  fg__page_layout_panels(page, page + 1, &plan, ruler);
  cairo_destroy(ruler);
  for (int n = 0; n < 5; ++n)
    assert_int_equal(has_number_at(&page[1 + n], false), n >= 2);
  free(page);
}

/* Lays out four panels, two in a row; fails the test where there is no memory. */
static fg__page *lay_out_four(fg__page_plan *plan,
                              const char (*labels)[FG__PAGE_TEXT_BYTES])
{
  fg__page *page = malloc(5 * sizeof *page);
  assert_non_null(page);
  cairo_t *ruler = fg__text_ruler();
  plan->panels = 4;
  plan->columns = 2;
  plan->panel_label = labels;
  fg__page_layout_panels(page, page + 1, plan, ruler);
  cairo_destroy(ruler);
  return page;
}

/* The first line of a panel's label, the topmost of its texts; *lines: how many. */
static const fg__page_text *label_of(const fg__page *panel, int *lines)
{
  const fg__page_text *first = NULL;
  *lines = 0;
  for (int k = 0; k < panel->text_count; ++k) {
    const fg__page_text *text = &panel->text[k];
    if (text->box.y1 > panel->frame.y0 || text->box.x0 != panel->frame.x0)
      continue;
    first = !first || text->y < first->y ? text : first;
    ++*lines;
  }
  assert_non_null(first);
  return first;
}

/* One size for all; one line, smaller, where that is enough; else labels of a row begin
 * at one height, however many lines they have. */
static void labels_of_panels_are_alike(void **state)
{
  (void)state;
  static const struct {
    const char label[4][FG__PAGE_TEXT_BYTES];
    int lines[4];
    bool smaller;
  } cases[] = {
      {{"(a) short", "(b)", "(c)", "(d)"}, {1, 1, 1, 1}, false},
      {{"(a) 17 September 1982, monthly mean", "(b) 16 May", "(c)", "(d)"},
       {1, 1, 1, 1},
       true},
      {{"(a) a label that is too long to have room in one line", "(b) short", "(c)",
        "(d) short"},
       {2, 1, 1, 1},
       false},
  };
  for (size_t n = 0; n < sizeof cases / sizeof *cases; ++n) {
    fg__page_plan plan = plan_of(300, 0, 40, 30, 2, "Wind");
    fg__page *page = lay_out_four(&plan, cases[n].label);
    for (int k = 0; k < 4; ++k) {
      int lines;
      const fg__page_text *label = label_of(&page[1 + k], &lines);
      const fg__page_text *beside = label_of(&page[1 + k / 2 * 2], &(int){0});
      assert_int_equal(lines, cases[n].lines[k]);
      assert_true(label->y == beside->y && label->size == beside->size);
      assert_int_equal(label->size < page->font_size, cases[n].smaller);
    }
    free(page);
  }
}

/* Of four panels of equal labels, but for the longest in row `row`, with a degree above
 * the frame or none: the distance of the rows in font sizes. */
static double row_gap(int row, bool degree_above)
{
  static fg__graticule graticule;
  static fg__plane plane;
  char labels[4][FG__PAGE_TEXT_BYTES] = {"(a)", "(b)", "(c)", "(d)"};
  fg__page_plan plan = plan_of(300, 0, 40, 30, 0, "Wind");
  snprintf(labels[2 * row], sizeof labels[0],
           "(x) a label that is too long to have room in one line");
  graticule = (fg__graticule){.plane = &plane, .labels = degree_above ? 1 : 0};
  for (int k = 0; k < 2; ++k)
    plane.low[k] = plan.axis[k].low;
  graticule.label[0] = (fg__map_label){
      .text = "40", .at = {plan.axis[0].low + 20, plan.axis[1].high}, .out = {0.0, 1.0}};
  plan.graticule = &graticule;
  fg__page *page = lay_out_four(&plan, (const char(*)[FG__PAGE_TEXT_BYTES])labels);
  const double gap = (page[3].frame.y0 - page[1].frame.y1) / page->font_size;
  assert_int_equal(page[1].text_count - page[3].text_count,
                   (row == 0 ? 1 : -1) + degree_above);
  free(page);
  return gap;
}

/* What is above the first row alone takes no room above others. */
static void rows_are_as_far_apart_as_they_must(void **state)
{
  (void)state;
  assert_true(row_gap(0, false) > 1.5);
  assert_true(row_gap(1, false) > row_gap(0, false) + 0.8);
  for (int row = 0; row < 2; ++row)
    assert_true(fabs(row_gap(row, true) - row_gap(row, false)) < 1e-9);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(panels_lie_side_by_side_with_numbers_outside),
      cmocka_unit_test(a_last_row_that_is_not_full_leaves_no_column_without_numbers),
      cmocka_unit_test(labels_of_panels_are_alike),
      cmocka_unit_test(rows_are_as_far_apart_as_they_must),
  };
  return cmocka_run_group_tests_name("picture/page/panels", tests, NULL, NULL);
}
