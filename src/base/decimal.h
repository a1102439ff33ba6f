/* Numbers as decimals, with a point whatever the user's locale says. */
#ifndef FG__DECIMAL_H
#define FG__DECIMAL_H

enum { FG__NUMBER_BYTES = 32 };

/* Writes a decimal that reads back as the same number, of 15 digits or fewer if that will
 * do: 0.03, not 0.029999999999999999. */
void fg__number_write(char text[FG__NUMBER_BYTES], double number);

#endif
