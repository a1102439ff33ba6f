#include "series/places.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "inputs.h"
#include "sandbox.h"

/* Whether a choice needs no file: none, or an index. */
static bool is_plain(const char *text)
{
  return !text || (strlen(text) == 1 && strchr("0123456789", text[0]));
}

static int take_index(fg_selection *out, const char *text)
{
  *out = (fg_selection){.index = calloc(1, sizeof *out->index), .count = 1};
  if (!out->index)
    return complain_of_memory("an index");
  out->index[0] = text ? atoi(text) : 0;
  return EXIT_DONE;
}

static void print_nearest(const reading_settings *settings, const char *what,
                          const char *text, const fg_axis_value *value)
{
  char words[CLEAN_BYTES];
  fprintf(stderr, "flowgrain: %s: no %s %s: the nearest is %s\n", settings->input, what,
          text, clean_text(words, value->words));
}

static int find_one(fg_selection *out, fg_context *context,
                    const reading_settings *settings, const char *what, const char *text,
                    const fg_axis_value *values, int count, bool quiet)
{
  if (is_plain(text))
    return take_index(out, text);
  fg_status status = fg_selection_find(out, context, what, text, values, count);
  if (status)
    return complain_of(context, status, settings->input);
  if (out->nearest && values && !quiet)
    print_nearest(settings, what, text, &values[out->index[0]]);
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

/* Finds the default level where none is given, and prints missing coordinates. Failures
 * are left to the reading. */
static int find_defaults(int *level, fg_context *context,
                         const reading_settings *settings, bool quiet)
{
  char words[CLEAN_BYTES];
  fg_read_defaults defaults;
  const fg_read_options options = settings_reading(settings);
  *level = 0;
  if (sandbox_defaults(settings->input, &options))
    return EXIT_FAILED;
  if (fg_read_defaults_find(&defaults, context, settings->input, &options)) {
    fg_context_clear(context);
    return EXIT_DONE;
  }
  *level = settings->level_text ? 0 : defaults.level;
  if (defaults.absent[0] && !quiet)
    fprintf(stderr,
            "flowgrain: %s: its coordinates are not in the file: %s; "
            "--mesh-from names another that has them\n",
            input_name(settings->input), clean_text(words, defaults.absent));
  return EXIT_DONE;
}

int places_find(chosen_places *out, const reading_settings *settings, bool quiet)
{
  *out = (chosen_places){.inventory = NULL};
  fg_context *context;
  int code = create_context(&context), level = 0;
  if (code)
    return code;
  code = find_defaults(&level, context, settings, quiet);
  if (!code && (!is_plain(settings->time_text) || !is_plain(settings->level_text)))
    code = read_vector(out, context, settings);
  const fg_inventory_vector *vector = out->vector;
  if (!code)
    code =
        find_one(&out->time, context, settings, "time", settings->time_text,
                 vector ? vector->time_value : NULL, vector ? vector->times : 0, quiet);
  if (!code)
    code =
        find_one(&out->level, context, settings, "level", settings->level_text,
                 vector ? vector->level_value : NULL, vector ? vector->levels : 0, quiet);
  if (!code && !settings->level_text)
    out->level.index[0] = level;
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
