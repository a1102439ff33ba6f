/* Times and levels of tables: columns that set rows apart. */
#include <stdio.h>
#include <string.h>

#include "read/situation_test.h"
#include "read/table/tables_test.h"

/* A grid of 3 x 2: x 1.5 2.5 3.5, y 10 20; u = x + y, v = -0.25; and another flow there.
 */
#define SMALL                                                                            \
  " 3 x 2\n|x = 1.5 2.5 3.5\n|y = 10 20\n|u = 11.5 12.5 13.5 21.5 22.5 23.5\n|v = "      \
  "-0.25 "                                                                               \
  "-0.25 -0.25 -0.25 -0.25 -0.25\n"
#define OTHER " 3 x 2\n|u = 1 2 3 4 5 6\n"

static const situation SITUATIONS[] = {
    {.what = "the first time",
     .text = "t,x,y,u,v\n2,1.5,10,1,-1\n0.5,1.5,10,11.5,-.25\n0.5,2.5,10,12.5,-.25\n"
             "0.5,3.5,10,13.5,-.25\n0.5,1.5,20,21.5,-.25\n0.5,2.5,20,22.5,-.25\n"
             "0.5,3.5,20,23.5,-.25\n2,2.5,10,2,-1\n2,3.5,10,3,-1\n2,1.5,20,4,-1\n"
             "2,2.5,20,5,-1\n2,3.5,20,6,-1\n",
     .field = "time 't 0.5'|" SMALL},
    {.what = "the second time", .options = {.time = 1}, .field = "time 't 2'|" OTHER},
    {.what = "no third time",
     .options = {.time = 2},
     .status = FG_STATUS_ARGUMENT,
     .refused = "'t' has 2: 0 to 1"},
    {.what = "a time that is a text is no time",
     .text = "time,x,y,u,v\n09:00,1.5,10,11.5,-.25\n09:01,2.5,10,12.5,-.25\n"
             "09:02,3.5,10,13.5,-.25\n09:03,1.5,20,21.5,-.25\n09:04,2.5,20,22.5,-.25\n"
             "09:05,3.5,20,23.5,-.25\n",
     .field = SMALL},
    {.what = "points that move are all read",
     .text = "time,x,y,u,v\n1,1.5,10,11.5,-.25\n2,2.5,10,12.5,-.25\n3,3.5,10,13.5,-.25\n"
             "4,1.5,20,21.5,-.25\n5,2.5,20,22.5,-.25\n6,3.5,20,23.5,-.25\n",
     .field = SMALL},
    {.what = "dates as ERDDAP writes them",
     .text =
         "time,longitude,latitude,u,v\nUTC,degrees_east,degrees_north,m s-1,m s-1\n"
         "2014-01-31T12:30:00Z,1.5,10,1,-1\n2014-01-31T12:30:00Z,2.5,10,2,-1\n"
         "2014-01-31T12:30:00Z,3.5,10,3,-1\n2014-01-31T12:30:00Z,1.5,20,4,-1\n"
         "2014-01-31T12:30:00Z,2.5,20,5,-1\n2014-01-31T12:30:00Z,3.5,20,6,-1\n"
         "2014-01-31T00:00:00Z,1.5,10,11.5,-.25\n2014-01-31T00:00:00Z,2.5,10,12.5,-."
         "25\n2014-01-31T00:00:00Z,3.5,10,13.5,-.25\n2014-01-31T00:00:00Z,1.5,20,21.5,"
         "-.25\n2014-01-31T00:00:00Z,2.5,20,22.5,-.25\n2014-01-31T00:00:00Z,3.5,20,23."
         "5,-.25\n",
     .field = "time '2014-01-31'|" SMALL},
    {.what = "the second date",
     .options = {.time = 1},
     .field = "time '2014-01-31 12:30'|" OTHER},
    /* planes one above another with two components are levels */
    {.what = "the first level",
     .text = "x,y,u,v,depth [m]\n1.5,10,1,0,50\n2.5,10,2,0,50\n3.5,10,3,0,50\n"
             "1.5,20,4,0,50\n2.5,20,5,0,50\n3.5,20,6,0,50\n1.5,10,11.5,-.25,5\n2.5,10,12."
             "5,-.25,5\n3.5,10,13.5,-.25,5\n1.5,20,21.5,-.25,5\n2.5,20,22.5,-.25,5\n3.5,"
             "20,23.5,-.25,5\n",
     .field = "level 'depth 5 m'|" SMALL,
     .inventory = "levels 2\n|' 5 'm'|' 50 'm'"},
    {.what = "the second level",
     .options = {.level = 1},
     .field = "level 'depth 50 m'|" OTHER},
    {.what = "no third level",
     .options = {.level = 2},
     .status = FG_STATUS_ARGUMENT,
     .refused = "level 2 asked for"},
};

static void times_and_levels_are_chosen(void **state)
{
  check_texts(*state, SITUATIONS, sizeof SITUATIONS / sizeof *SITUATIONS);
}

/* Rows at two heights, which lie over each other or side by side. */
static void write_soundings(char *text, size_t size, int rows, bool side_by_side)
{
  size_t used = (size_t)snprintf(text, size, "x,y,height,u,v\n");
  for (int n = 0; n < 2 * rows; ++n) {
    const int high = n / rows;
    const double x = n % rows + 0.3 * high + (side_by_side ? rows * high : 0.0);
    used += (size_t)snprintf(text + used, size - used, "%.3f,%.3f,%d,%d,1\n", x,
                             n * n % 7 + 0.1 * high, 100 * high, high);
  }
}

static void levels_are_found_by_their_scatter(void **state)
{
  static const char ONE_FIELD[] =
      "levels 1\n|doubts 'rows of every height, 0 to 100, are one field'";
  char text[1024];
  write_soundings(text, sizeof text, 8, false);
  check_text(*state, &(situation){.what = "eight over each other",
                                  .text = text,
                                  .inventory = "levels 2\n|!doubts"});
  write_soundings(text, sizeof text, 7, false);
  check_text(*state, &(situation){.what = "seven", .text = text, .inventory = ONE_FIELD});
  write_soundings(text, sizeof text, 8, true);
  check_text(*state,
             &(situation){.what = "side by side", .text = text, .inventory = ONE_FIELD});
}

/* What is kept of one time is not taken for another, whose levels differ. */
static void each_time_has_its_own_levels(void **state)
{
  enum { TIMES = 2, LEVELS = 2, NX = 3, NY = 2 };
  static const char *const words[TIMES][LEVELS] = {{"level 10", "level 20"},
                                                   {"level 15", "level 25"}};
  char text[2048];
  size_t used = (size_t)snprintf(text, sizeof text, "time,level,x,y,u,v\n");
  for (int n = 0; n < TIMES * LEVELS * NX * NY; ++n) {
    const int place = n % (NX * NY), level = n / (NX * NY) % LEVELS,
              time = n / (NX * NY * LEVELS);
    used += (size_t)snprintf(text + used, sizeof text - used, "%d,%d,%d,%d,%d,1\n", time,
                             10 + 10 * level + 5 * time, place % NX, place / NX, n + 1);
  }
  fg__kept kept = {NULL, NULL};
  fg__source source = source_of(text);
  source.kept = &kept;
  for (int turn = 0; turn < 2; ++turn)
    for (int n = 0; n < TIMES * LEVELS; ++n) {
      fg_field *field = NULL;
      const fg_read_options options = {.time = n / LEVELS, .level = n % LEVELS};
      assert_int_equal(fg__dataset_read(&field, *state, &fg__format_table, &source,
                                        &options, (fg__slab_index){0, 1}),
                       FG_STATUS_OK);
      assert_string_equal(fg_field_contents(field)->level,
                          words[options.time][options.level]);
      assert_true(fg_field_contents(field)->velocity[0][0] == (float)(1 + n * NX * NY));
      fg_field_destroy(field);
    }
  kept.close(kept.data);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(times_and_levels_are_chosen),
      cmocka_unit_test(levels_are_found_by_their_scatter),
      cmocka_unit_test(each_time_has_its_own_levels),
  };
  return cmocka_run_group_tests(tests, context_set_up, context_tear_down);
}
