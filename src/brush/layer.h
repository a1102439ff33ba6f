/* One layer of a painting: an evolution's clusters as lines for a brush. */
#ifndef FG__LAYER_H
#define FG__LAYER_H

#include "brush/line.h"
#include "brush/structure.h"

typedef struct fg__layer_plan {
  int clusters; /* wanted */
  double anisotropy;
  uint64_t seed;
  int threads;
} fg__layer_plan;

/* Full width of a cluster in pixels when `clusters` of them share an image. */
double fg__layer_brush(const fg_image_arrays *image, int clusters);

/* The structure of an image that is averaged as suits clusters of that size. MEMORY. */
fg_status fg__layer_structure(fg__structure *out, fg_context *context,
                              const fg_image_arrays *image, const fg__layer_plan *plan);

/* Clusters along the level sets of an image with that structure: the first snapshot with
 * at most so many. To be ended with fg_density_destroy. NO_CONVERGENCE, ARGUMENT, MEMORY,
 * STOPPED. */
fg_status fg__layer_density(fg_density **out, fg_context *context,
                            const fg_image_arrays *image, const fg__structure *structure,
                            const fg__layer_plan *plan);

/* The lines of a density's clusters, in their order, on several threads. *lines is to be
 * freed. MEMORY, STOPPED. */
fg_status fg__layer_lines(fg__brush_line **lines, int *count, fg_context *context,
                          const fg_density *density, const fg__brush_canvas *image,
                          const fg__line_rule *rule, int threads);

#endif
