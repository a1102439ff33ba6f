/* Suggestions for words that are not known. */
#ifndef FLOWGRAIN_WORDS_H
#define FLOWGRAIN_WORDS_H

#include "flowgrain/context.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Whether `typed` may be a misspelling of `known`: it is at most one edit from it, two
 * for words of more than four bytes. An edit inserts, deletes or replaces a byte, or
 * exchanges two neighbours (optimal string alignment; Damerau 1964). False for NULL, and
 * for words of more than 31 bytes. */
FG_API bool fg_word_is_near(const char *typed, const char *known);

#ifdef __cplusplus
}
#endif

#endif
