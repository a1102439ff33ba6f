/* Times and levels chosen by index, value, date, range or `all`, found in the input. */
#ifndef SERIES_PLACES_H
#define SERIES_PLACES_H

#include "option/settings.h"

typedef struct chosen_places {
  fg_inventory *inventory;           /* NULL: all choices are indices, or none is given */
  const fg_inventory_vector *vector; /* the vector that is read, owned by the inventory */
  fg_selection time, level;
} chosen_places;

/* Finds the chosen times and levels, in the input's metadata unless all are plain
 * indices. Prints the nearest value where the given one does not exist, and an error if
 * none is near. Returns an exit code. */
int places_find(chosen_places *out, const reading_settings *settings, bool quiet);
void places_clear(chosen_places *places);

/* The reading options of a command that takes one field: settings_reading with the chosen
 * time and level. Returns an exit code. */
int places_reading(fg_read_options *out, const reading_settings *settings);

#endif
