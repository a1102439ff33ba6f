/* JSON of the program, as text. */
#ifndef JSON_H
#define JSON_H

#include <cjson/cJSON.h>

/* Writes a value as JSON, which is UTF-8. The bytes of a file's name or of an option that
 * are no UTF-8 become the characters U+EF80 to U+EFFF, of private use, as in MirBSD's
 * OPTU-8, from which json_parse makes the same bytes again. NULL without memory; to be
 * freed by cJSON_free. */
char *json_print(const cJSON *value);

/* NULL for NULL, for no JSON and without memory. To be freed by cJSON_Delete. */
cJSON *json_parse(const char *text);

/* Add a text (NULL: null), numbers or texts to an object. */
void json_add_text(cJSON *object, const char *name, const char *text);
void json_add_numbers(cJSON *object, const char *name, const double *numbers, int count);
void json_add_words(cJSON *object, const char *name, const char *const *words, int count);

#endif
