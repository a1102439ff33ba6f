#include "base/decimal.h"

#include <float.h>
#include <locale.h>
#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Powers of ten that are exact. */
static const double POWER[] = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                               1e8,  1e9,  1e10, 1e11, 1e12, 1e13, 1e14, 1e15,
                               1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};

/* Sizes that "%.15g" writes without an exponent, whose 15 digits are a whole number over
 * one of these powers. */
static const double SMALLEST = 1e-4, LARGEST = 1e15;

enum { DIGITS = 15, ALL_DIGITS = 17 };
static const int64_t MOST_WHOLE = 100000000000000000; /* of all digits */

/* The decimal places of a number of significant digits between these sizes. */
static int places_of(double size, int digits)
{
  int places = digits - 1;
  for (; places > 0 && size >= POWER[digits - places]; --places)
    ;
  for (double shifted = size; shifted < 1.0; shifted *= 10.0)
    ++places;
  return places;
}

/* Writes whole / 10^places without needless zeros. */
static void write_decimal(char *text, bool is_negative, long long whole, int places)
{
  char digit[FG__NUMBER_BYTES] = "";
  int count = 0;
  for (; places > 0 && whole % 10 == 0; --places)
    whole /= 10;
  for (; whole > 0 || count <= places; whole /= 10)
    digit[count++] = (char)('0' + whole % 10);
  if (is_negative)
    *text++ = '-';
  while (count > places)
    *text++ = digit[--count];
  if (places > 0)
    *text++ = '.';
  while (count > 0)
    *text++ = digit[--count];
  *text = '\0';
}

/* The 15 digits as a whole number over a power of ten: both are exact, and so their
 * quotient is the number nearest to the decimal. False: another number, or it is to be
 * written with an exponent. */
static bool write_short(char text[FG__NUMBER_BYTES], double number)
{
  const double size = fabs(number);
  if (!(size >= SMALLEST && size < LARGEST))
    return false;
  const int places = places_of(size, DIGITS);
  const double whole = nearbyint(size * POWER[places]);
  if (whole / POWER[places] != size)
    return false;
  write_decimal(text, number < 0.0, (long long)whole, places);
  return true;
}

/* Of a number between these sizes: its 53 bits are a whole number over a power of two,
 * and 10^20 times as much has less than 128 bits. */
__extension__ typedef unsigned __int128 wide;

/* The number of 10^-places in a size, the nearest, of two the even one; exact. */
static int64_t count_units(double size, int places)
{
  int exponent;
  const double fraction = frexp(size, &exponent);
  const int shift = DBL_MANT_DIG - exponent;
  wide all = (wide)(uint64_t)ldexp(fraction, DBL_MANT_DIG);
  for (int n = 0; n < places; ++n)
    all *= 10;
  const wide half = (wide)1 << (shift - 1), rest = all & ((half << 1) - 1);
  const int64_t whole = (int64_t)(all >> shift);
  return whole + (rest > half || (rest == half && whole % 2 != 0));
}

static void write_all_digits(char text[FG__NUMBER_BYTES], double number)
{
  const double size = fabs(number);
  int places = places_of(size, ALL_DIGITS);
  int64_t whole = count_units(size, places);
  if (whole < MOST_WHOLE / 10) /* places_of takes 0.1 less an ulp for 0.1 */
    whole = count_units(size, ++places);
  write_decimal(text, number < 0.0, whole, places);
}

/* Whatever the locale has between the first two digits becomes a point. */
static void put_point(char *text)
{
  char *behind = text + (*text == '-') + 1;
  const size_t other = strcspn(behind, "0123456789e");
  if (other > 0 && behind[other] != '\0') {
    *behind = '.';
    memmove(behind + 1, behind + other, strlen(behind + other) + 1);
  }
}

void fg__number_write(char text[FG__NUMBER_BYTES], double number)
{
  /* 15 digits survive text to double to text, 17 double to text to double (IEEE 754) */
  if (write_short(text, number))
    return;
  const double size = fabs(number);
  if (size >= SMALLEST && size < LARGEST) {
    write_all_digits(text, number);
    return;
  }
  snprintf(text, FG__NUMBER_BYTES, "%.15g", number);
  if (strtod(text, NULL) != number)
    snprintf(text, FG__NUMBER_BYTES, "%.17g", number);
  put_point(text);
}

void fg__number_round(char text[FG__NUMBER_BYTES], double number, int digits)
{
  snprintf(text, FG__NUMBER_BYTES, "%.*g", digits, number);
  put_point(text);
}

double fg__number_read(const char *text, const char **end)
{
  enum { LONGEST = 400 };
  char copy[LONGEST + 16], *behind;
  const char *point = localeconv()->decimal_point;
  const size_t whole = strcspn(text, "."), more = strlen(point) - 1;
  if (text[whole] != '.' || whole > LONGEST)
    point = NULL;
  snprintf(copy, sizeof copy, "%.*s%s%s", (int)(whole < LONGEST ? whole : LONGEST), text,
           point ? point : "", point ? text + whole + 1 : "");
  const double number = strtod(copy, &behind);
  const size_t used = (size_t)(behind - copy);
  *end = text + (point && used > whole ? used - more : used);
  return number;
}
