/* Numbers as decimals, with a point whatever the user's locale says. */
#ifndef FG__DECIMAL_H
#define FG__DECIMAL_H

enum { FG__NUMBER_BYTES = 32 };

/* Writes a decimal that reads back as the same number, of 15 digits or fewer if that will
 * do: 0.03, not 0.029999999999999999. */
void fg__number_write(char text[FG__NUMBER_BYTES], double number);

/* Writes a decimal of that many digits or fewer, at most 17. */
void fg__number_round(char text[FG__NUMBER_BYTES], double number, int digits);

/* Reads a number as strtod does, but with a point. */
double fg__number_read(const char *text, const char **end);

#endif
