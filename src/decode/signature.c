#include "decode/signature.h"

#include <string.h>

/* A file's first tag begins this early, comments before it included; and the names of an
 * HDF5 file's first groups; and those of dimensions. */
enum { MARK_WITHIN = 4096, NAME_WITHIN = 1 << 14, DIMENSIONS_WITHIN = 1 << 18 };

fg__nc_kind fg__nc_kind_of(const unsigned char *bytes, size_t size)
{
  static const unsigned char hdf5[] = {0x89, 'H', 'D', 'F', '\r', '\n', 0x1a, '\n'};
  if (size >= sizeof hdf5 && memcmp(bytes, hdf5, sizeof hdf5) == 0)
    return FG__NC_HDF5;
  if (size >= 4 && memcmp(bytes, "CDF", 3) == 0) {
    if (bytes[3] == 1)
      return FG__NC_CLASSIC;
    if (bytes[3] == 2)
      return FG__NC_OFFSET64;
    if (bytes[3] == 5)
      return FG__NC_CDF5;
  }
  return FG__NC_NONE;
}

static bool has_text(const unsigned char *bytes, size_t size, size_t within,
                     const char *text)
{
  const size_t length = strlen(text);
  const unsigned char *end = bytes + (size < within ? size : within);
  for (const unsigned char *at = bytes;
       (size_t)(end - at) >= length && (at = memchr(at, text[0], (size_t)(end - at)));
       ++at)
    if ((size_t)(end - at) >= length && memcmp(at, text, length) == 0)
      return true;
  return false;
}

/* Whether a file is markup with a tag early in it. */
static bool has_tag(const unsigned char *bytes, size_t size, const char *tag)
{
  size_t at = 0;
  if (size >= 3 && memcmp(bytes, "\xEF\xBB\xBF", 3) == 0) /* a byte order mark */
    at = 3;
  while (at < size && strchr(" \t\r\n", bytes[at]) && bytes[at])
    ++at;
  return at < size && bytes[at] == '<' && has_text(bytes, size, MARK_WITHIN, tag);
}

bool fg__is_vtk_xml(const unsigned char *bytes, size_t size)
{
  return has_tag(bytes, size, "<VTKFile");
}

bool fg__is_xdmf(const unsigned char *bytes, size_t size)
{
  return has_tag(bytes, size, "<Xdmf");
}

bool fg__is_vtkhdf(const unsigned char *bytes, size_t size)
{
  return fg__nc_kind_of(bytes, size) == FG__NC_HDF5 &&
         has_text(bytes, size, NAME_WITHIN, "VTKHDF");
}

bool fg__is_exodus(const unsigned char *bytes, size_t size)
{
  return fg__nc_kind_of(bytes, size) != FG__NC_NONE &&
         has_text(bytes, size, DIMENSIONS_WITHIN, "num_el_blk") &&
         has_text(bytes, size, DIMENSIONS_WITHIN, "num_nodes");
}

bool fg__is_vtk_series(const unsigned char *bytes, size_t size)
{
  size_t at = 0;
  while (at < size && bytes[at] && strchr(" \t\r\n", bytes[at]))
    ++at;
  return at < size && bytes[at] == '{' &&
         has_text(bytes, size, size, "\"file-series-version\"");
}

bool fg__is_vtk_legacy(const unsigned char *bytes, size_t size)
{
  static const char mark[] = "# vtk DataFile Version";
  return size >= sizeof mark - 1 && memcmp(bytes, mark, sizeof mark - 1) == 0;
}

bool fg__is_grib_start(const unsigned char *bytes, size_t size)
{
  return size >= 8 && memcmp(bytes, "GRIB", 4) == 0;
}

/* Edition 1 has the length in 3 bytes, edition 2 in 8, of which none has used the first
 * two; the shortest messages have 51 bytes and 41. */
bool fg__is_grib_message(const unsigned char *bytes, size_t size)
{
  if (!fg__is_grib_start(bytes, size))
    return false;
  if (bytes[7] == 1)
    return (bytes[4] | bytes[5]) != 0 || bytes[6] >= 51;
  static const unsigned char least[8] = {[7] = 41};
  return bytes[7] == 2 && size >= 16 && (bytes[8] | bytes[9]) == 0 &&
         memcmp(bytes + 8, least, sizeof least) >= 0;
}

bool fg__is_grib(const unsigned char *bytes, size_t size)
{
  if (fg__is_grib_start(bytes, size))
    return true;
  for (size_t at = 0; at < size && at < FG__GRIB_WITHIN; ++at)
    if (fg__is_grib_message(bytes + at, size - at))
      return true;
  return false;
}
