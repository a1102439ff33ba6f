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
/* A list of VTK files over time in JSON, as ParaView writes it. */
bool fg__is_vtk_series(const unsigned char *bytes, size_t size);
bool fg__is_vtk_legacy(const unsigned char *bytes, size_t size);
/* A NetCDF file with dimensions of nodes and of blocks of elements. */
bool fg__is_exodus(const unsigned char *bytes, size_t size);
/* An HDF5 file with a group VTKHDF; and markup that names arrays, in such files mostly.
 */
bool fg__is_vtkhdf(const unsigned char *bytes, size_t size);
bool fg__is_xdmf(const unsigned char *bytes, size_t size);

/* A heading, of telecommunication or of an archive and in any code, may stand before the
 * first GRIB message, which begins before this byte. (ecCodes has no bound, NetCDF-Java
 * 16,000 bytes, GDAL 1,024.) */
enum { FG__GRIB_WITHIN = 16384 };

/* Whether "GRIB" stands at these bytes; whether a message begins there, by its edition
 * and length; and whether they are a file of such. */
bool fg__is_grib_start(const unsigned char *bytes, size_t size);
bool fg__is_grib_message(const unsigned char *bytes, size_t size);
bool fg__is_grib(const unsigned char *bytes, size_t size);

#endif
