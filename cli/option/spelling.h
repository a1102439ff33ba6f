/* Words that are nearly right. */
#ifndef OPTION_SPELLING_H
#define OPTION_SPELLING_H

#include <stdbool.h>

/* Whether a word may be a slip for another that is known: by at most two letters
 * inserted, deleted, replaced or swapped with their neighbour, by one in words of up to
 * four. */
bool spelling_is_near(const char *typed, const char *known);

#endif
