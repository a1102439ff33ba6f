#include "read/foreign.h"

#include <stdbool.h>
#include <string.h>
#include <strings.h>

/* A dictionary of OpenFOAM has its first word this early, behind a banner. */
enum { WORD_WITHIN = 2048 };

#define UNPACK "unpack it first"
#define OTHER_TABLE "export it as text, a line a point, or as VTK"

static const struct signature {
  const char *bytes;
  size_t size;
  fg__foreign foreign;
} SIGNATURES[] = {
#define BYTES(text) text, sizeof(text) - 1
    {BYTES("\x1f\x8b"), {"compressed by gzip", UNPACK ", as by gunzip"}},
    {BYTES("BZh"), {"compressed by bzip2", UNPACK ", as by bunzip2"}},
    {BYTES("\xfd\x37zXZ"), {"compressed by xz", UNPACK ", as by unxz"}},
    {BYTES("\x28\xb5\x2f\xfd"), {"compressed by Zstandard", UNPACK ", as by unzstd"}},
    {BYTES("PK\003\004"),
     {"a ZIP archive, and not NumPy's", UNPACK "; of a spreadsheet save a sheet as CSV"}},
    {BYTES("\xff\xfe"), {"text in UTF-16", "save it as UTF-8"}},
    {BYTES("\xfe\xff"), {"text in UTF-16", "save it as UTF-8"}},
    {BYTES("MATLAB 5.0 MAT-file"),
     {"a .mat file of MATLAB", "save the arrays u, v, x, y by numpy.savez, or as text"}},
    {BYTES("MATLAB 7.3 MAT-file"),
     {"a .mat file of MATLAB", "save the arrays u, v, x, y by numpy.savez, or as text"}},
    {BYTES("\x0e\x03\x13\x01"), {"HDF4", "convert it to NetCDF"}},
    {BYTES("#!TDV"), {"a binary file of Tecplot", OTHER_TABLE}},
    {BYTES("FORMAT\n"), {"a case of EnSight", "save it as VTK, as ParaView does"}},
    {BYTES("FORMAT\r\n"), {"a case of EnSight", "save it as VTK, as ParaView does"}},
    {BYTES("\x89PNG"), {"an image", "images are painted by flowgrain brush"}},
    {BYTES("\xff\xd8\xff"), {"an image", "images are painted by flowgrain brush"}},
};

/* Web pages stand where a download had no success. */
static const fg__foreign PAGE = {"a web page",
                                 "it may tell why what was to be loaded is not there"};
static const fg__foreign FOAM = {"a file of OpenFOAM",
                                 "write the case as VTK, by foamToVTK or ParaView"};

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
    if (size >= SIGNATURES[i].size &&
        memcmp(bytes, SIGNATURES[i].bytes, SIGNATURES[i].size) == 0)
      return &SIGNATURES[i].foreign;
  if (has_line(bytes, size, "<!doctype html") || has_line(bytes, size, "<html"))
    return &PAGE;
  return has_line(bytes, size, "FoamFile") ? &FOAM : NULL;
}
