/* Vectors in space as fields: of a grid along axes, or through the raster that cells
 * between points are interpolated onto. */
#ifndef FG__SAMPLE_SPACE_H
#define FG__SAMPLE_SPACE_H

#include "interpret/space/space.h"
#include "sample/cells/set.h"
#include "sample/rows.h"

/* domain.c. Finds the plane or volume that a dataset's points fill, before vectors are
 * chosen, and ends it. UNSUPPORTED, FILE_FORMAT, MEMORY. */
fg_status fg__space_domain_open(fg__dataset *data);
void fg__space_domain_close(fg__dataset *data);

/* Coordinates [first, first + count) along axis k, ascending. */
fg_status fg__space_domain_coordinates(double *out, const fg__dataset *data, int k,
                                       size_t first, size_t count);

/* Rows along the last axis, in the field's order. */
typedef struct fg__row_range {
  size_t first, count;
} fg__row_range;

size_t fg__space_domain_row(const fg__space_domain *domain); /* samples of one */

/* samples.c. Brings the components along the grid's axes onto the points of some rows: in
 * 2D a mean over two layers of points; of cells a mean over those round a point (VTK's
 * CellDataToPointData); NaN where anything that goes into it is missing, hidden, or not
 * positive in the variable `mask` (a vector: zero), which may be NULL. With `normal`, of
 * three components in a plane that normal to it becomes out[2]. End them with free; those
 * beyond the dimension are NULL otherwise. *is_settled becomes whether all rows were
 * looked at for missing numbers that are not declared, so that calls for other rows need
 * not; NULL: there are none. ARGUMENT (the mask, such a number), FILE_FORMAT, MEMORY. */
fg_status fg__space_samples(float *out[3], const fg__dataset *data, const fg__pair *pair,
                            const fg__grid *grid, const fg__row_range *rows,
                            const char *mask, bool normal, bool *is_settled);

/* field.c. The field that options choose; and of a vector in an inventory components,
 * size, bounds, names of axes and cells, and the share of missing samples and of the
 * component normal to a plane. */
fg_status fg__space_field(fg_field **out, const fg__dataset *data, const fg__pair *pair,
                          const fg__grid *grid, const fg_read_options *options,
                          fg__slab_index slab);
fg_status fg__space_describe(fg_inventory_vector *vector, const fg__dataset *data,
                             const fg__pair *pair, const fg__grid *grid);
fg_status fg__space_count(fg_inventory_vector *vector, const fg__dataset *data,
                          const fg__pair *pair, const fg__grid *grid);

#endif
