#include "series/places.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "alternatives.h"
#include "inputs.h"

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

/* Opens the input. A failure is left to the reading, unless there is more to find. */
static int open_input(chosen_places *out, fg_context *context,
                      const reading_settings *settings, bool has_more)
{
  const fg_read_options options = settings_reading(settings);
  const fg_status status = fg_input_open(&out->input, context, settings->input, &options);
  if (status && has_more)
    return complain_of(context, status, settings->input);
  fg_context_clear(context);
  return EXIT_DONE;
}

static int find_vector(chosen_places *out, fg_context *context,
                       const reading_settings *settings)
{
  const fg_inventory *inventory;
  const fg_status status = fg_input_inventory(&inventory, context, out->input);
  if (status)
    return complain_of(context, status, settings->input);
  out->vector = fg_inventory_vector_at(inventory, 0);
  if (out->vector && !out->vector->unusable)
    return EXIT_DONE;
  complain("%s: its times and levels are not known: %s", settings->input,
           out->vector ? out->vector->unusable : "it holds no such vector field");
  return EXIT_FAILED;
}

/* The default level where none is given; prints missing coordinates. Failures are left to
 * the reading. */
static int find_level(fg_context *context, fg_input *input,
                      const reading_settings *settings, bool quiet)
{
  char words[CLEAN_BYTES];
  fg_read_defaults defaults;
  if (!input || fg_input_defaults(&defaults, context, input)) {
    fg_context_clear(context);
    return 0;
  }
  if (defaults.absent[0] && !quiet)
    fprintf(stderr,
            "flowgrain: %s: its coordinates are not in the file: %s; "
            "--mesh-from names another that has them\n",
            input_name(settings->input), clean_text(words, defaults.absent));
  return settings->level_text ? 0 : defaults.level;
}

int places_find(chosen_places *out, const reading_settings *settings, bool quiet)
{
  const bool has_more = !is_plain(settings->time_text) || !is_plain(settings->level_text);
  *out = (chosen_places){.input = NULL};
  fg_context *context;
  int code = create_context(&context), level = 0;
  if (code)
    return code;
  code = open_input(out, context, settings, has_more);
  if (!code)
    level = find_level(context, out->input, settings, quiet);
  if (!code && has_more)
    code = find_vector(out, context, settings);
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
  fg_input_close(places->input);
  *places = (chosen_places){.input = NULL};
}

int places_field(fg_field **out, fg_context *context, chosen_places *places,
                 const reading_settings *settings)
{
  reading_settings of_one = *settings; /* time */
  const fg_read_options options = settings_reading(settings);
  fg_status status = FG_STATUS_OK;
  *out = NULL;
  of_one.time = places->time.index[0];
  of_one.level = places->level.index[0];
  if (!places->input)
    status = fg_input_open(&places->input, context, settings->input, &options);
  if (!status)
    status = fg_input_field(out, context, places->input, of_one.time, of_one.level, 0, 1);
  return status ? complain_of_field(context, status, places->input, &of_one) : EXIT_DONE;
}

int places_read(fg_field **out, fg_context *context, const reading_settings *settings)
{
  chosen_places places;
  int code = places_find(&places, settings, false);
  *out = NULL;
  if (!code)
    code = places_field(out, context, &places, settings);
  if (!code)
    report_doubts(settings->input, *out);
  places_clear(&places);
  return code;
}
