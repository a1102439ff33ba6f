/* Tables as programs of simulation and data analysis export them. */
#include <stdio.h>

#include "read/table/tables_test.h"

static void exports_of_simulations_are_known(void **state)
{
  static const char *const same[] = {
      /* STAR-CCM+ */
      "\"Velocity[i] (m/s)\",\"Velocity[j] (m/s)\",\"Velocity[k] (m/s)\",\"X (m)\",\"Y "
      "(m)\",\"Z (m)\"\n11.5,-0.25,0,1.5,10,0\n12.5,-0.25,0,2.5,10,0\n"
      "13.5,-0.25,0,3.5,10,0\n21.5,-0.25,0,1.5,20,0\n22.5,-0.25,0,2.5,20,0\n"
      "23.5,-0.25,0,3.5,20,0\n",
      /* CFD-Post, with the faces of a surface */
      "\n[Name]\nPlane 1\n\n[Data]\nX [ m ], Y [ m ], Z [ m ], Velocity u [ m/s ], "
      "Velocity v [ m/s ], Velocity w [ m/s ]\n1.5, 10, 0, 11.5, -0.25, 0\n"
      "2.5, 10, 0, 12.5, -0.25, 0\n3.5, 10, 0, 13.5, -0.25, 0\n"
      "1.5, 20, 0, 21.5, -0.25, 0\n2.5, 20, 0, 22.5, -0.25, 0\n"
      "3.5, 20, 0, 23.5, -0.25, 0\n\n[Faces]\n0, 1, 4, 3\n1, 2, 5, 4\n",
  };
  for (size_t i = 0; i < sizeof same / sizeof *same; ++i) {
    fg_field *field = read_text(*state, same[i]);
    const fg_field_arrays *f = fg_field_contents(field);
    assert_string_equal(f->velocity_units, "m/s");
    assert_string_equal(f->axis_units[1], "m");
    check_small(field, -1);
  }
}

/* Names of data frames: with units, of indices beside them. */
static void units_may_stand_in_names(void **state)
{
  static const char *const heads[] = {
      "x_mm,y_mm,u_ms,v_ms,p,q", "xpos,ypos,xvel,yvel,p,q", "x_px,y_px,vel_x,vel_y,i,j"};
  for (size_t i = 0; i < sizeof heads / sizeof *heads; ++i) {
    char text[512];
    snprintf(text, sizeof text,
             "%s\n1.5,10,11.5,-0.25,1,1\n2.5,10,12.5,-0.25,2,1\n3.5,10,13.5,-0.25,3,1\n"
             "1.5,20,21.5,-0.25,1,2\n2.5,20,22.5,-0.25,2,2\n3.5,20,23.5,-0.25,3,2\n",
             heads[i]);
    check_small(read_text(*state, text), -1);
  }
}

/* Of spreadsheets and of Microsoft's C library. */
static void words_for_missing_numbers_are_known(void **state)
{
  static const char *const words[] = {"#N/A", "-nan(ind)", "-1.#IND", "1.#QNAN"};
  for (size_t i = 0; i < sizeof words / sizeof *words; ++i) {
    char text[512];
    snprintf(text, sizeof text,
             "x,y,u,v\n1.5,10,%s,%s\n2.5,10,12.5,-0.25\n3.5,10,13.5,-0.25\n"
             "1.5,20,21.5,-0.25\n2.5,20,22.5,-0.25\n3.5,20,23.5,-0.25\n",
             words[i], words[i]);
    check_small(read_text(*state, text), 0);
  }
}

static void json_is_no_table(void **state)
{
  static const char *const others[] = {"[[1, 2, 3, 4]]", "[1, 2]", "[\"x\", 1]", "["};
  for (size_t i = 0; i < sizeof others / sizeof *others; ++i)
    assert_false(
        fg__format_table.is_mine((const unsigned char *)others[i], strlen(others[i])));
  (void)state;
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(exports_of_simulations_are_known),
      cmocka_unit_test(units_may_stand_in_names),
      cmocka_unit_test(words_for_missing_numbers_are_known),
      cmocka_unit_test(json_is_no_table),
  };
  return cmocka_run_group_tests(tests, context_set_up, context_tear_down);
}
