/* Seconds that pass. */
#ifndef FG__CLOCK_H
#define FG__CLOCK_H

/* Seconds since some time before; not set back where the system has such a clock. */
double fg__clock_seconds(void);

#endif
