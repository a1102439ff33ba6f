/* Units as files spell them, written as journals print them. */
#ifndef FG__UNITS_H
#define FG__UNITS_H

#include <stddef.h>

enum { FG__UNITS_BYTES = 96 };

/* "m s-1", "m/s", "m s**-1", "meters per second" become m s^-1 with the exponent between
 * the marks of text.h; what is no product of powers is copied as it is, cleaned. Without
 * a dimension ("", "1") the result is empty. */
void fg__units_write(char out[FG__UNITS_BYTES], const char *units);

/* For a unit of length: metres in one of them; else 0. */
double fg__units_metres(const char *units);

#endif
