/* The domain as a raster of cells, for scores and critical points. */
#ifndef FG__DOMAIN_RASTER_H
#define FG__DOMAIN_RASTER_H

#include "base/threads.h"
#include "field/field.h"

/* The bounding box of the domain in cells of about side / 256, in 3D side / 64, or up to
 * three times as wide where the domain fills less than 1/24 of its box, in 3D 1/6; x
 * fastest. A cell lies in the domain when its centre does. */
typedef struct fg__domain_raster {
  const fg_field *field;
  int dimension;
  int size[3]; /* cells; one along z in 2D */
  double origin[3], cell[3];
  double measure; /* area or volume of the valid data cells */
  double side;    /* of the square or cube of that measure */
  double spacing; /* the wanted side of cells */
  size_t cells;
  unsigned char *inside, *counts; /* a byte a cell: in the domain; and it moves there at
                                     more than a thousandth of the top speed */
  float *direction[3], *speed;    /* unit tangents (0 where it stands still) and |v| */
} fg__domain_raster;

/* Ends with fg__domain_raster_clear, also after a failure. UNSUPPORTED (a slab of a
 * field, a domain far smaller than its box), MEMORY, STOPPED. */
fg_status fg__domain_raster_create(fg__domain_raster *out, fg_context *context,
                                   const fg_field *field, fg__threads *threads);
void fg__domain_raster_clear(fg__domain_raster *raster);

static inline size_t fg__domain_raster_rows(const fg__domain_raster *raster)
{
  return (size_t)raster->size[1] * (size_t)raster->size[2];
}

/* Centre of the cell (i, j, k). */
static inline void fg__domain_raster_centre(const fg__domain_raster *raster,
                                            const int at[3], double position[3])
{
  for (int k = 0; k < 3; ++k)
    position[k] = raster->origin[k] + (at[k] + 0.5) * raster->cell[k];
}

/* The place of the cell that holds a point; false outside the box. */
bool fg__domain_raster_find(const fg__domain_raster *raster, const double position[3],
                            size_t *place);

#endif
