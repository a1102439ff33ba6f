#include "base/feature.h"
#include "decode/signature.h"
#include "read/foreign.h"
#include "read/format.h"

#include <ctype.h>
#include <stdio.h>
#include <string.h>

/* FG__NETCDF and so on are 1 or 0: CMakeLists.txt. Without the library a format is known,
 * and refused. */
#define IF(feature, opener) ((feature) ? (opener) : NULL)
#define HDF (FG__NETCDF && FG__VTK)
#define HDF_FEATURE (FG__NETCDF ? FG_FEATURE_VTK : FG_FEATURE_NETCDF)

static bool is_netcdf(const unsigned char *bytes, size_t size)
{
  return fg__nc_kind_of(bytes, size) != FG__NC_NONE;
}

const fg__format fg__format_exodus = {.name = "Exodus",
                                      .files = "Exodus II (.exo, .e)",
                                      .is_mine = fg__is_exodus,
                                      .open = IF(FG__NETCDF, fg__exodus_open),
                                      .feature = FG_FEATURE_NETCDF,
                                      .is_chosen = true,
                                      .alone = "Exodus files"};
const fg__format fg__format_vtkhdf = {
    .name = "VTKHDF",
    .files = "VTKHDF images, unstructured grids and polygons (.vtkhdf, .hdf)",
    .is_mine = fg__is_vtkhdf,
    .open = IF(HDF, fg__vtkhdf_open),
    .feature = HDF_FEATURE,
    .is_chosen = true,
    .alone = "VTKHDF files"};
const fg__format fg__format_netcdf = {
    .name = "NetCDF",
    .files = "NetCDF (classic, 64-bit offset, CDF-5, NetCDF-4)",
    .is_mine = is_netcdf,
    .open = IF(FG__NETCDF, fg__nc_open),
    .feature = FG_FEATURE_NETCDF,
    .has_dimensions = true};
const fg__format fg__format_grib = {.name = "GRIB",
                                    .files = "GRIB (editions 1 and 2)",
                                    .is_mine = fg__is_grib,
                                    .open = IF(FG__GRIB, fg__grib_open),
                                    .feature = FG_FEATURE_GRIB,
                                    .has_dimensions = true};
const fg__format fg__format_vti = {
    .name = "VTK XML",
    .files =
        "VTK XML images, rectilinear, curvilinear and unstructured grids and planes "
        "(.vti, .vtr, .vts, .vtu, .vtp), legacy files of them (.vtk), and files that "
        "name such in parallel, as blocks or over time (.pvti, ..., .vtm, .pvd, .series)",
    .is_mine = fg__is_vtk_xml,
    .open = IF(FG__VTK, fg__vtk_open),
    .feature = FG_FEATURE_VTK,
    .is_chosen = true,
    .has_tensors = true,
    .alone = "VTK files"};
const fg__format fg__format_vtk_legacy = {.name = "VTK legacy",
                                          .is_mine = fg__is_vtk_legacy,
                                          .open = IF(FG__VTK, fg__vtk_open_legacy),
                                          .feature = FG_FEATURE_VTK,
                                          .is_chosen = true,
                                          .has_tensors = true,
                                          .alone = "VTK files"};
const fg__format fg__format_vtk_series = {.name = "VTK series",
                                          .is_mine = fg__is_vtk_series,
                                          .open = IF(FG__VTK, fg__vtk_open),
                                          .feature = FG_FEATURE_VTK,
                                          .is_chosen = true,
                                          .alone = "VTK files"};
const fg__format fg__format_xdmf = {.name = "XDMF",
                                    .files = "XDMF grids and meshes (.xdmf, .xmf)",
                                    .is_mine = fg__is_xdmf,
                                    .open = IF(HDF, fg__xdmf_open),
                                    .feature = HDF_FEATURE,
                                    .is_chosen = true,
                                    .alone = "XDMF files"};
const fg__format fg__format_npy = {.name = "NumPy array",
                                   .files = "NumPy's arrays (.npy, .npz)",
                                   .is_mine = fg__is_npy,
                                   .open = fg__numpy_open};
const fg__format fg__format_npz = {
    .name = "NumPy archive", .is_mine = fg__is_npz, .open = fg__numpy_open};
const fg__format fg__format_table = {
    .name = "table",
    .files = "tables of points in text (.csv, .txt, .dat, .vec)",
    .is_mine = fg__is_table,
    .open = fg__table_open};

static const fg__format *const FORMATS[] = {
    &fg__format_exodus, &fg__format_vtkhdf,     &fg__format_netcdf,     &fg__format_grib,
    &fg__format_vti,    &fg__format_vtk_legacy, &fg__format_vtk_series, &fg__format_xdmf,
    &fg__format_npy,    &fg__format_npz,        &fg__format_table};
enum { KNOWN_BYTES = 512 };

const fg__format *fg__format_find(const unsigned char *bytes, size_t size)
{
  for (size_t i = 0; i < sizeof FORMATS / sizeof *FORMATS; ++i)
    if (FORMATS[i]->is_mine(bytes, size))
      return FORMATS[i];
  return NULL;
}

static int plain_letter(char letter)
{
  return letter == ' ' ? '-' : tolower((unsigned char)letter);
}

/* Whether a format's name is `word`, or begins so, whichever the size of letters and with
 * dashes or blanks; or whether its files' names end so, as csv. */
static bool is_called(const fg__format *format, const char *word)
{
  const char *name = format->name;
  const size_t length = strlen(word);
  size_t same = 0;
  while (same < length && name[same] &&
         plain_letter(name[same]) == plain_letter(word[same]))
    ++same;
  if (same == length && (name[same] == '\0' || name[same] == ' '))
    return true;
  for (const char *at = length ? format->files : NULL;
       at && (at = strchr(at, '.')) != NULL; ++at)
    if (strncmp(at + 1, word, length) == 0 && strchr(",)", at[1 + length]))
      return true;
  return false;
}

/* The format of a name; of two of that name the one that knows the bytes. */
static fg_status find_named(const fg__format **out, fg_context *context, const char *word,
                            const fg__source *source)
{
  char known[KNOWN_BYTES] = "";
  size_t used = 0;
  *out = NULL;
  for (size_t i = 0; i < sizeof FORMATS / sizeof *FORMATS; ++i) {
    if (used < sizeof known)
      used += (size_t)snprintf(known + used, sizeof known - used, "%s%s",
                               used ? ", " : "", FORMATS[i]->name);
    if (is_called(FORMATS[i], word) &&
        (!*out || FORMATS[i]->is_mine(source->bytes, source->size)))
      *out = FORMATS[i];
  }
  if (*out)
    return FG_STATUS_OK;
  for (char *letter = known; *letter; ++letter)
    *letter =
        *letter == ' ' && letter[-1] != ',' ? '-' : (char)tolower((unsigned char)*letter);
  fg__fail(context, FG_STATUS_ARGUMENT, "%s: no format is called \"%.100s\"",
           source->path, word);
  fg__hint(context, "formats: %s", known);
  return FG_STATUS_ARGUMENT;
}

static void hint_at_known(fg_context *context)
{
  char known[KNOWN_BYTES] = "";
  size_t used = 0;
  for (size_t i = 0; i < sizeof FORMATS / sizeof *FORMATS; ++i)
    if (FORMATS[i]->files && used < sizeof known)
      used += (size_t)snprintf(known + used, sizeof known - used, "%s%s",
                               used ? ", " : "", FORMATS[i]->files);
  fg__hint(context, "formats known: %s; or synth:NAME", used ? known : "none");
}

static fg_status find_format(const fg__format **out, fg_context *context,
                             const fg__source *source)
{
  const char *wanted = fg__context_input(context)->format;
  if (wanted)
    return find_named(out, context, wanted, source);
  *out = fg__format_find(source->bytes, source->size);
  const fg__foreign *foreign = NULL;
  if (!*out || *out == &fg__format_table)
    foreign = fg__foreign_find(source->bytes, source->size);
  else if (*out == &fg__format_netcdf &&
           fg__nc_kind_of(source->bytes, source->size) == FG__NC_HDF5)
    foreign = fg__foreign_hdf5(source->bytes, source->size);
  if (foreign) {
    fg__fail(context, FG_STATUS_FILE_FORMAT, "%s: is %s, which cannot be read",
             source->path, foreign->name);
    fg__hint(context, "%s", foreign->advice);
    return FG_STATUS_FILE_FORMAT;
  }
  if (*out)
    return FG_STATUS_OK;
  char start[3 * 4 + 1] = "";
  for (size_t i = 0; i < 4 && i < source->size; ++i) {
    static const char digit[] = "0123456789abcdef";
    start[3 * i] = digit[source->bytes[i] >> 4];
    start[3 * i + 1] = digit[source->bytes[i] & 15];
    start[3 * i + 2] = ' ';
    start[3 * i + 3] = '\0';
  }
  if (start[0])
    start[strlen(start) - 1] = '\0';
  fg_status status = fg__fail(context, FG_STATUS_FILE_FORMAT,
                              "%s: unknown format (%zu bytes, starting with %s)",
                              source->path, source->size, start);
  hint_at_known(context);
  return status;
}

fg_status fg__source_open_known(fg__source *out, const fg__format **format,
                                fg_context *context, const char *path)
{
  fg_status status = fg__source_open(out, context, path);
  if (status == FG_STATUS_OK)
    status = find_format(format, context, out);
  if (status == FG_STATUS_OK && !(*format)->open)
    status = fg__fail_absent(context, out->path, (*format)->feature);
  return status;
}
