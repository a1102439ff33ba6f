/* Distances inside a cluster's window in 3D. */
#ifndef FG__SOLID_MARCH_H
#define FG__SOLID_MARCH_H

#include "cluster/volume.h"

/* Fills distance[nodes] with |grad T| = 1, T = 0 on the cluster's zero set (met between
 * the nodes), on the borders of the mask and of the domain, and on cuts; 0 outside. Fast
 * marching as in skeleton/spine.h, along three axes. MEMORY. */
fg_status fg__march_volume(double *distance, fg_context *context,
                           const fg__volume *volume);

#endif
