#include "interpret/time_words.h"

#include "terms/dates.h"

#include <stdio.h>

fg_status fg__time_write(char out[FG__TIME_BYTES], fg_context *context, double time)
{
  char number[FG__NUMBER_BYTES];
  fg__number_locale locale;
  if (!fg__number_locale_begin(&locale))
    return fg__fail_memory(context, "a locale", sizeof locale);
  fg__number_write(number, time);
  fg__number_locale_end(&locale);
  snprintf(out, FG__TIME_BYTES, "t = %s", number);
  return FG_STATUS_OK;
}

fg_status fg__date_write(char out[FG__TIME_BYTES], fg_context *context, double seconds)
{
  return fg__date_of_seconds(seconds, out, FG__TIME_BYTES)
             ? FG_STATUS_OK
             : fg__time_write(out, context, seconds);
}
