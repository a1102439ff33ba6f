/* Times and levels that are chosen by index, value, date, range or `all`, found in the
 * input. */
#ifndef SERIES_PLACES_H
#define SERIES_PLACES_H

#include "option/settings.h"

typedef struct chosen_places {
  fg_inventory *inventory;           /* NULL: only indices, or nothing, were given */
  const fg_inventory_vector *vector; /* of it, the one that is read */
  fg_selection time, level;
} chosen_places;

/* Finds them, in the input's metadata unless all are plain indices. Prints which value
 * was taken where the one given is not there, and complains where none is near.
 * Returns an exit code. */
int places_find(chosen_places *out, const reading_settings *settings, bool quiet);
void places_clear(chosen_places *places);

/* What a command reads that takes one field: settings_reading with the time and level
 * that are asked for. Returns an exit code. */
int places_reading(fg_read_options *out, const reading_settings *settings);

#endif
