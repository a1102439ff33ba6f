/* Comparisons of names and attributes, which are ASCII, in either case and in any
 * locale. */
#ifndef FG__TERMS_TEXT_H
#define FG__TERMS_TEXT_H

#include <stdbool.h>
#include <stddef.h>

bool fg__is_letter(char c);
bool fg__is_digit(char c);
char fg__small(char c);

/* Whether `length` bytes are a word. */
bool fg__is_word(const char *text, size_t length, const char *word);

/* Whether two texts are equal. */
bool fg__is_same(const char *a, const char *b);

bool fg__starts_with(const char *text, const char *start);

/* Where a word first is in a text; NULL: nowhere. */
const char *fg__find_text(const char *text, const char *word);

/* Whether a text contains one of the words of a list, "stress|flux". */
bool fg__contains_any(const char *text, const char *list);

/* Whether `length` bytes are one of the words of a list, or begin with one. */
bool fg__is_one_of(const char *list, const char *text, size_t length);
bool fg__starts_with_one_of(const char *list, const char *text, size_t length);

/* What follows the last / of a name with groups, "ocean/u". */
const char *fg__last_part(const char *name);

/* Letters and digits of a name between other characters: "x", "wind" of "x-wind". */
typedef struct fg__token {
  size_t start, length;
} fg__token;

enum { FG__MOST_TOKENS = 24 };

/* Splits a name; returns how many tokens there are, of which the first are kept. */
int fg__split_name(fg__token out[FG__MOST_TOKENS], const char *name);

/* A token without the digits at its ends: "u" of "u10" and "10u". */
fg__token fg__without_digits(const char *name, fg__token token);

/* Writes a name in small letters and digits, with one _ for what is between: "wind_dir"
 * of "Wind Dir.", cut to the buffer. */
void fg__plain_name(char *out, size_t size, const char *name);

#endif
