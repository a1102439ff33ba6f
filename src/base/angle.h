/* Units of angles. */
#ifndef FG__ANGLE_H
#define FG__ANGLE_H

#define FG__RADIANS 0.017453292519943295 /* in a degree */

#endif
