#include "series/places.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "sandbox.h"

/* A wish that needs no file to be understood: none, or an index. */
static bool is_plain(const char *wish)
{
  return !wish || !wish[strspn(wish, "0123456789")];
}

static int take_index(fg_selection *out, const char *wish)
{
  *out = (fg_selection){.index = calloc(1, sizeof *out->index), .count = 1};
  if (!out->index)
    return complain_of_memory("an index");
  out->index[0] = wish ? atoi(wish) : 0;
  return EXIT_DONE;
}

static void say_nearest(const reading_settings *settings, const char *what,
                        const char *wish, const fg_axis_value *value)
{
  char words[CLEAN_BYTES];
  fprintf(stderr, "flowgrain: %s: no %s %s: the nearest is %s\n", settings->input, what,
          wish, clean_text(words, value->words));
}

static int find_one(fg_selection *out, fg_context *context,
                    const reading_settings *settings, const char *what, const char *wish,
                    const fg_axis_value *values, int count, bool quiet)
{
  if (is_plain(wish))
    return take_index(out, wish);
  fg_status status = fg_selection_find(out, context, what, wish, values, count);
  if (status)
    return complain_of(context, status, settings->input);
  if (out->nearest && values && !quiet)
    say_nearest(settings, what, wish, &values[out->index[0]]);
  return EXIT_DONE;
}

static int read_vector(chosen_places *out, fg_context *context,
                       const reading_settings *settings)
{
  const fg_read_options options = settings_reading(settings);
  if (sandbox_inventory(settings->input, &options))
    return EXIT_FAILED;
  fg_status status =
      fg_inventory_read_chosen(&out->inventory, context, settings->input, &options);
  if (status)
    return complain_of(context, status, settings->input);
  out->vector = fg_inventory_vector_at(out->inventory, 0);
  if (out->vector && !out->vector->unusable)
    return EXIT_DONE;
  complain("%s: its times and levels are not known: %s", settings->input,
           out->vector ? out->vector->unusable : "it holds no such vector field");
  return EXIT_FAILED;
}

int places_find(chosen_places *out, const reading_settings *settings, bool quiet)
{
  *out = (chosen_places){.inventory = NULL};
  fg_context *context;
  int code = create_context(&context);
  if (code)
    return code;
  if (!is_plain(settings->time_wish) || !is_plain(settings->level_wish))
    code = read_vector(out, context, settings);
  const fg_inventory_vector *vector = out->vector;
  if (!code)
    code =
        find_one(&out->time, context, settings, "time", settings->time_wish,
                 vector ? vector->time_value : NULL, vector ? vector->times : 0, quiet);
  if (!code)
    code =
        find_one(&out->level, context, settings, "level", settings->level_wish,
                 vector ? vector->level_value : NULL, vector ? vector->levels : 0, quiet);
  fg_context_destroy(context);
  return code;
}

void places_clear(chosen_places *places)
{
  fg_selection_clear(&places->time);
  fg_selection_clear(&places->level);
  fg_inventory_destroy(places->inventory);
  *places = (chosen_places){.inventory = NULL};
}

int places_reading(fg_read_options *out, const reading_settings *settings)
{
  chosen_places places;
  *out = settings_reading(settings);
  int code = places_find(&places, settings, false);
  if (!code) {
    out->time = places.time.index[0];
    out->level = places.level.index[0];
  }
  places_clear(&places);
  return code;
}
