/* Inventories: the vectors that a file holds. */
#ifndef FG__INVENTORY_H
#define FG__INVENTORY_H

#include "base/context.h"
#include "flowgrain/inventory.h"

enum { FG__REASON_BYTES = 512 };

/* Adds a line to what is unsure of a reading, where there is room. */
void fg__doubt(char doubts[FG__REASON_BYTES], const char *format, ...)
    __attribute__((format(printf, 2, 3)));

/* Sets the reason why a vector of a file cannot be read, unless one is set already. */
void fg__set_unusable(char reason[FG__REASON_BYTES], const char *format, ...)
    __attribute__((format(printf, 2, 3)));

/* The place of a vector's text, n below FG__VECTOR_TEXTS. */
enum { FG__VECTOR_TEXTS = 14 };
const char **fg__vector_text(fg_inventory_vector *vector, int n);

/* Makes an empty inventory of a file in a format of that name. MEMORY. */
fg_status fg__inventory_create(fg_inventory **out, fg_context *context,
                               const char *format);

/* Adds a copy of a vector (texts included) to an inventory. MEMORY. */
fg_status fg__inventory_add(fg_inventory *inventory, fg_context *context,
                            const fg_inventory_vector *vector);

#endif
