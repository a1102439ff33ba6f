/* Times as words. */
#ifndef FG__TIME_WORDS_H
#define FG__TIME_WORDS_H

#include "base/context.h"
#include "file/number_text.h"

enum { FG__TIME_BYTES = FG__NUMBER_BYTES + 8 };

/* Writes a time that is a number as "t = 2.5". MEMORY (no locale). */
fg_status fg__time_write(char out[FG__TIME_BYTES], fg_context *context, double time);

/* Writes seconds from 1970 on as a date, "1982-07-16", with a clock where it is not
 * midnight, "1982-07-16 12:00[:30[.500]]"; as fg__time_write where no calendar goes. */
fg_status fg__date_write(char out[FG__TIME_BYTES], fg_context *context, double seconds);

#endif
