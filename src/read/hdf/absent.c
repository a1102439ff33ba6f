/* In builds without HDF5 or without VTK's grids: files of both are known, and refused. */
#include "decode/signature.h"
#include "read/format.h"

#define MISSING (FG__NETCDF ? FG_FEATURE_VTK : FG_FEATURE_NETCDF)

const fg__format fg__format_vtkhdf = {
    .name = "VTKHDF", .is_absent = true, .feature = MISSING, .is_mine = fg__is_vtkhdf};
const fg__format fg__format_xdmf = {
    .name = "XDMF", .is_absent = true, .feature = MISSING, .is_mine = fg__is_xdmf};
