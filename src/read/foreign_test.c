#include "read/foreign.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <string.h>

enum { BYTES = 1024 };

typedef struct row {
  size_t offset;
  const char *bytes, *name; /* NULL: none */
} row;

static const fg__foreign *find(const row *r,
                               const fg__foreign *(*look)(const unsigned char *, size_t))
{
  static unsigned char bytes[BYTES];
  memset(bytes, 0, sizeof bytes);
  memcpy(bytes + r->offset, r->bytes, strlen(r->bytes));
  return look(bytes, sizeof bytes);
}

static void files_of_other_programs_have_names(void **state)
{
  static const row rows[] = {
      {0, "NRRD0005\ntype: float\n", "an NRRD image"},
      {344, "n+1", "a NIfTI image"},
      {344, "ni1", "a NIfTI image"},
      {4, "n+2", "a NIfTI image"},
      {0, "ObjectType = Image\nNDims = 3\n", "an image of MetaImage"},
      {0, "PIEH", "an optical flow of Middlebury"},
      {0, "@(#)ADF Database Version", "CGNS in ADF"},
      {0, "$MeshFormat\n4.1 0 8\n", "a mesh of Gmsh"},
      {0, "# OOMMF OVF 2.0\n", "an OVF file of OOMMF"},
      {0, "filetemplate: a%01d.f%05d\n", "a case of Nek5000"},
      {0, "MATLAB 7.3 MAT-file", "a .mat file of MATLAB"},
      {0, "/* a case */\nFoamFile\n{\n", "a file of OpenFOAM"},
      {0, "x,y,u,v\n0,0,1,1\n", NULL},
      {40, "NRRD", NULL},
  };
  (void)state;
  for (size_t n = 0; n < sizeof rows / sizeof *rows; ++n) {
    const fg__foreign *found = find(&rows[n], fg__foreign_find);
    assert_true((found != NULL) == (rows[n].name != NULL));
    if (found)
      assert_string_equal(found->name, rows[n].name);
  }
}

static void hdf5_files_of_other_conventions_have_names(void **state)
{
  static const row rows[] = {{800, "CGNSLibraryVersion", "CGNS in HDF5"},
                             {100, "eastward_wind", NULL}};
  (void)state;
  for (size_t n = 0; n < sizeof rows / sizeof *rows; ++n) {
    const fg__foreign *found = find(&rows[n], fg__foreign_hdf5);
    assert_true((found != NULL) == (rows[n].name != NULL));
    if (found)
      assert_string_equal(found->name, rows[n].name);
  }
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(files_of_other_programs_have_names),
      cmocka_unit_test(hdf5_files_of_other_conventions_have_names),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
