/* Units in which times and levels are asked for. */
#ifndef FG__AXIS_UNITS_H
#define FG__AXIS_UNITS_H

/* The factor from one unit to the other, in any case and number, "hPa" to "bar", "hours"
 * to "d"; from no unit 1. 0: they measure different things, or one is not known. */
double fg__unit_factor(const char *from, const char *to);

#endif
