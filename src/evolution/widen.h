/* Interfaces of a density that comes from a mesh twice as fine. */
#ifndef FG__WIDEN_H
#define FG__WIDEN_H

#include "solver/multigrid.h"

/* Makes the finest level's density, whose ghosts are filled, as smooth as one of this
 * mesh: interfaces become about twice as wide. `gamma` is the interface energy, of which
 * the multigrid's K has `share`; `spacing` the least of the mesh. Keeps the sum of masses
 * times u up to rounding, fills ghosts, and spoils the potential. Collective. */
void fg__widen_interfaces(const fg__multigrid *multigrid, double gamma, double share,
                          double spacing);

#endif
