/* The list of critical points, as the module that stores it sees it. */
#ifndef FG__CRITICAL_LIST_H
#define FG__CRITICAL_LIST_H

#include "flowgrain/critical.h"

struct fg_critical_points {
  fg_critical_point *point;
  int count;
  double length; /* lambda */
};

/* MEMORY. */
fg_status fg__critical_points_copy(fg_critical_points **out, fg_context *context,
                                   const fg_critical_points *points);

#endif
