/* How formats are told from each other by their first bytes, known also to builds that
 * lack their readers. */
#ifndef FG__SIGNATURE_H
#define FG__SIGNATURE_H

#include <stdbool.h>
#include <stddef.h>

typedef enum fg__nc_kind {
  FG__NC_NONE = 0,
  FG__NC_CLASSIC,
  FG__NC_OFFSET64,
  FG__NC_CDF5,
  FG__NC_HDF5
} fg__nc_kind;

/* Which kind of NetCDF file bytes begin. */
fg__nc_kind fg__nc_kind_of(const unsigned char *bytes, size_t size);

bool fg__is_vtk_xml(const unsigned char *bytes, size_t size);
bool fg__is_vtk_legacy(const unsigned char *bytes, size_t size);

/* Whether a GRIB message begins at these bytes; and whether they are a file of such: a
 * heading of telecommunication may stand before the first. */
bool fg__is_grib_start(const unsigned char *bytes, size_t size);
bool fg__is_grib(const unsigned char *bytes, size_t size);

#endif
