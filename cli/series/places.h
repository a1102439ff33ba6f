/* Times and levels chosen by index, value, date, range or `all`, found in the input. */
#ifndef SERIES_PLACES_H
#define SERIES_PLACES_H

#include "option/settings.h"

typedef struct chosen_places {
  fg_input *input; /* NULL: it cannot be opened, and all choices are indices */
  const fg_inventory_vector *vector; /* the input's own; NULL: all choices are indices, or
                                        none is given */
  fg_selection time, level;
} chosen_places;

/* Opens the input and finds the chosen times and levels, in its metadata unless all are
 * plain indices. Prints the nearest value where the given one does not exist, and an
 * error if none is near. Returns an exit code. The settings are borrowed until
 * places_clear. */
int places_find(chosen_places *out, const reading_settings *settings, bool quiet);
void places_clear(chosen_places *places);

/* Reads the field of the first time and level that are chosen. Returns an exit code. */
int places_field(fg_field **out, fg_context *context, chosen_places *places,
                 const reading_settings *settings);

/* Reads the field of a command that takes one. Returns an exit code. */
int places_read(fg_field **out, fg_context *context, const reading_settings *settings);

#endif
