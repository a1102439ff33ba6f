#include "read/foreign.h"

#include <stdbool.h>
#include <string.h>
#include <strings.h>

/* A dictionary of OpenFOAM has its first word this early, behind a banner. */
enum { WORD_WITHIN = 2048, NAME_WITHIN = 1 << 14 };

#define UNPACK "unpack it first"
#define SAVE_AS_VTK "save it as VTK, as ParaView does"
#define SAVE_ARRAYS "save the arrays u, v(, w), x, y(, z) by numpy.savez"
#define OTHER_TABLE "export it as text, a line a point, or as VTK"

static const struct signature {
  size_t offset;
  const char *bytes;
  size_t size;
  fg__foreign foreign;
} SIGNATURES[] = {
#define BYTES_AT(offset, text) offset, text, sizeof(text) - 1
#define BYTES(text) BYTES_AT(0, text)
    {BYTES("\x1f\x8b"), {"compressed by gzip", UNPACK ", as by gunzip"}},
    {BYTES("BZh"), {"compressed by bzip2", UNPACK ", as by bunzip2"}},
    {BYTES("\xfd\x37zXZ"), {"compressed by xz", UNPACK ", as by unxz"}},
    {BYTES("\x28\xb5\x2f\xfd"), {"compressed by Zstandard", UNPACK ", as by unzstd"}},
    {BYTES("PK\003\004"),
     {"a ZIP archive, and not NumPy's", UNPACK "; of a spreadsheet save a sheet as CSV"}},
    {BYTES("\xff\xfe"), {"text in UTF-16", "save it as UTF-8"}},
    {BYTES("\xfe\xff"), {"text in UTF-16", "save it as UTF-8"}},
    {BYTES("MATLAB 5.0 MAT-file"), {"a .mat file of MATLAB", SAVE_ARRAYS}},
    {BYTES("MATLAB 7.3 MAT-file"), {"a .mat file of MATLAB", SAVE_ARRAYS}},
    {BYTES("\x0e\x03\x13\x01"), {"HDF4", "convert it to NetCDF"}},
    {BYTES("#!TDV"), {"a binary file of Tecplot", OTHER_TABLE}},
    {BYTES("FORMAT\n"), {"a case of EnSight", SAVE_AS_VTK}},
    {BYTES("FORMAT\r\n"), {"a case of EnSight", SAVE_AS_VTK}},
    {BYTES("@(#)ADF Database"), {"CGNS in ADF", SAVE_AS_VTK}},
    {BYTES("NRRD"), {"an NRRD image", SAVE_ARRAYS}},
    {BYTES_AT(344, "n+1"), {"a NIfTI image", SAVE_ARRAYS}},
    {BYTES_AT(344, "ni1"), {"a NIfTI image", SAVE_ARRAYS}},
    {BYTES_AT(4, "n+2"), {"a NIfTI image", SAVE_ARRAYS}},
    {BYTES("ObjectType"), {"an image of MetaImage", SAVE_ARRAYS}},
    {BYTES("NDims ="), {"an image of MetaImage", SAVE_ARRAYS}},
    {BYTES("PIEH"), {"an optical flow of Middlebury", SAVE_ARRAYS}},
    {BYTES("\x89PNG"), {"an image", "images are painted by flowgrain brush"}},
    {BYTES("\xff\xd8\xff"), {"an image", "images are painted by flowgrain brush"}},
};

/* Words that a line begins with, early in a text. */
static const struct {
  const char *word;
  fg__foreign foreign;
} LINES[] = {
    /* web pages stand where a download had no success */
    {"<!doctype html",
     {"a web page", "it may tell why what was to be loaded is not there"}},
    {"<html", {"a web page", "it may tell why what was to be loaded is not there"}},
    {"FoamFile",
     {"a file of OpenFOAM", "write the case as VTK, by foamToVTK or ParaView"}},
    {"# OOMMF OVF", {"an OVF file of OOMMF", SAVE_ARRAYS}},
    {"$MeshFormat", {"a mesh of Gmsh", SAVE_AS_VTK}},
    {"filetemplate:", {"a case of Nek5000", SAVE_AS_VTK}},
};

/* Names that HDF5 files of other conventions have within their first bytes. */
static const struct {
  const char *name;
  fg__foreign foreign;
} GROUPS[] = {
    {"CGNSLibraryVersion", {"CGNS in HDF5", SAVE_AS_VTK}},
    {"FlowSolution", {"CGNS in HDF5", SAVE_AS_VTK}},
};

static bool begins_with(const unsigned char *bytes, size_t size, const char *word)
{
  const size_t length = strlen(word);
  return size >= length && strncasecmp((const char *)bytes, word, length) == 0;
}

/* Whether a line begins with the word, early in the text. */
static bool has_line(const unsigned char *bytes, size_t size, const char *word)
{
  for (size_t at = 0; at < size && at < WORD_WITHIN; ++at)
    if ((at == 0 || bytes[at - 1] == '\n') && begins_with(bytes + at, size - at, word))
      return true;
  return false;
}

const fg__foreign *fg__foreign_find(const unsigned char *bytes, size_t size)
{
  for (size_t i = 0; i < sizeof SIGNATURES / sizeof *SIGNATURES; ++i)
    if (size >= SIGNATURES[i].offset + SIGNATURES[i].size &&
        memcmp(bytes + SIGNATURES[i].offset, SIGNATURES[i].bytes, SIGNATURES[i].size) ==
            0)
      return &SIGNATURES[i].foreign;
  for (size_t i = 0; i < sizeof LINES / sizeof *LINES; ++i)
    if (has_line(bytes, size, LINES[i].word))
      return &LINES[i].foreign;
  return NULL;
}

const fg__foreign *fg__foreign_hdf5(const unsigned char *bytes, size_t size)
{
  const size_t within = size < NAME_WITHIN ? size : NAME_WITHIN;
  for (size_t i = 0; i < sizeof GROUPS / sizeof *GROUPS; ++i) {
    const size_t length = strlen(GROUPS[i].name);
    for (size_t at = 0; at + length <= within; ++at)
      if (memcmp(bytes + at, GROUPS[i].name, length) == 0)
        return &GROUPS[i].foreign;
  }
  return NULL;
}
