/* Evenly spaced streamlines, after Jobard and Lefer, "Creating Evenly-Spaced Streamlines
 * of Arbitrary Density", Visualization in Scientific Computing 1997. */
#ifndef FG__RIVAL_EVENLY_H
#define FG__RIVAL_EVENLY_H

#include "rival/streamline/lines.h"

/* d_test in separations: how near a line may come to others while it goes on. */
#define FG__EVENLY_TEST 0.5

/* Places lines, in the order in which they are found, each beside one before it, as long
 * as there is room. `out` is all zero, or lines to use again. MEMORY, STOPPED. */
fg_status fg__evenly_place(fg__lines *out, fg_context *context, const fg__domain *domain,
                           double separation);

/* Finds a separation that gives about `count` lines, and places them. As above. */
fg_status fg__evenly_search(fg__lines *out, fg_context *context, const fg__domain *domain,
                            int count);

#endif
