/* Symmetric tensors on a grid as the law of an energy. */
#ifndef FG__TENSOR_FIELD_H
#define FG__TENSOR_FIELD_H

#include "base/context.h"
#include "flowgrain/energy.h"

struct fg_tensors {
  fg_field *row[2]; /* in 2D (xx, xy) and (xy, yy); in 3D (xx, xy, xz), (yy, yz, zz) */
  double greatest;  /* eigenvalue of any sample; the law divides by it */
  fg_energy_law law;
};

/* Makes the law of two fields as above, which it takes over, also when it fails. `name`
 * goes before messages. ARGUMENT (another dimension than the field's or less than its
 * box, a tensor that is not positive definite, eigenvalues too far apart), MEMORY. */
fg_status fg__tensors_create(fg_tensors **out, fg_context *context, fg_field *row[2],
                             const char *name, const fg_field *field);

#endif
