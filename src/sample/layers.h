/* Volumes of two layers that are alike, as a plane has that a program extruded. */
#ifndef FG__LAYERS_H
#define FG__LAYERS_H

#include "dataset/dataset.h"
#include "flowgrain/inventory.h"

/* Replaces a whole field in 3D, of which two layers across an axis have the same vectors,
 * by one in 2D; others stay. MEMORY. */
fg_status fg__drop_layer(fg_field **field, fg_context *context);

/* Size, bounds and scale of a field, as an inventory has them. */
void fg__describe_field(fg_inventory_vector *vector, char name[3][FG__TEXT_BYTES],
                        const fg_field *field);

#endif
