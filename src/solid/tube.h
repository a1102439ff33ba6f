/* Building surfaces. */
#ifndef FG__TUBE_H
#define FG__TUBE_H

#include "base/context.h"

/* Makes a surface with room for so much, all counts 0. MEMORY. */
fg_status fg__surface_create(fg_surface **out, fg_context *context, size_t vertices,
                             size_t corners, size_t triangles);

#endif
