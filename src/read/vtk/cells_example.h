/* Small files of curvilinear and unstructured grids for the tests, in each way of
 * writing. */
#ifndef FG__VTK_CELLS_EXAMPLE_H
#define FG__VTK_CELLS_EXAMPLE_H

#include <math.h>

#include "read/vtk/legacy_example.h"

/* Nine points in the plane y = 3, the middle one moved: a quad, a pixel, two triangles, a
 * polygon; and, to be left out, a vertex and a line. */
enum { POINTS_OF = 9, CELLS_OF = 7, CORNERS_OF = 21, TYPE_INT64 = 6, TYPE_UINT8 = 1 };
static const double PLACE[3 * POINTS_OF] = {0, 3, 0, 2, 3, 0, 4, 3, 0, 0, 3, 1, 2.5, 3,
                                            1, 4, 3, 1, 0, 3, 3, 2, 3, 3, 4, 3, 3};
static const double CORNERS[CORNERS_OF] = {0, 1, 4, 3, 8, 1, 2, 4, 2, 5, 4,
                                           3, 4, 6, 7, 6, 7, 4, 5, 8, 7};
static const double ENDS[CELLS_OF] = {4, 5, 8, 11, 15, 17, 21};
static const double TYPES[CELLS_OF] = {9, 1, 5, 5, 8, 3, 7};

/* Linear in x and z. */
static inline double cells_velocity(size_t point, int component)
{
  const double *p = PLACE + 3 * point;
  return component == 0   ? 1.0 + 2.0 * p[0] - p[2]
         : component == 1 ? 50.0
                          : 3.0 - 0.5 * p[0] + 4.0 * p[2];
}

static inline void velocities(double out[3 * POINTS_OF])
{
  for (size_t n = 0; n < POINTS_OF; ++n)
    for (int c = 0; c < 3; ++c)
      out[3 * n + (size_t)c] = cells_velocity(n, c);
}

static inline void add_as(example_text *file, example_text *appended,
                          const example_encoding *encoding, int type, const char *name,
                          const double *numbers, size_t count)
{
  example_encoding other = *encoding;
  other.type = type;
  example_array(file, appended, &other, name, 1, numbers, count);
}

/* Points of a curvilinear or unstructured grid, and the latter's cells: not in the order
 * that programs write them in, which must not matter. */
static inline void add_points(example_text *file, example_text *appended,
                              const example_encoding *encoding, const double *place,
                              size_t count)
{
  example_words(file, "<Points>\n");
  example_array(file, appended, encoding, "Points", 3, place, 3 * count);
  example_words(file, "</Points>\n");
}

static inline void add_cells(example_text *file, example_text *appended,
                             const example_encoding *encoding, const double *corners,
                             size_t corner_count, const double *ends, const double *types,
                             size_t count)
{
  example_words(file, "<Cells>\n");
  add_as(file, appended, encoding, TYPE_UINT8, "types", types, count);
  add_as(file, appended, encoding, TYPE_INT64, "offsets", ends, count);
  add_as(file, appended, encoding, TYPE_INT64, "connectivity", corners, corner_count);
  example_words(file, "</Cells>");
}

static inline example_text vtu(const example_encoding *encoding, const char *more)
{
  example_text file = {0}, appended = {0};
  double numbers[3 * POINTS_OF];
  velocities(numbers);
  example_begin_kind(&file, encoding, "UnstructuredGrid", "");
  example_words(&file, "<Piece NumberOfPoints=\"9\" NumberOfCells=\"7\"><PointData>\n");
  example_array(&file, &appended, encoding, "U", 3, numbers, 3 * POINTS_OF);
  example_words(&file, more);
  example_words(&file, "</PointData>\n");
  add_points(&file, &appended, encoding, PLACE, POINTS_OF);
  add_cells(&file, &appended, encoding, CORNERS, CORNERS_OF, ENDS, TYPES, CELLS_OF);
  example_words(&file, "</Piece>\n");
  example_end_kind(&file, &appended, encoding, "UnstructuredGrid");
  return file;
}

static inline void begin_legacy(example_text *file, bool binary, const char *dataset)
{
  example_words(file, "# vtk DataFile Version 5.1\nsmall\n");
  example_words(file, binary ? "BINARY\nDATASET " : "ASCII\nDATASET ");
  example_words(file, dataset);
}

static inline example_text legacy(bool binary, bool with_offsets)
{
  enum { INT32 = 4, COUNTED = CORNERS_OF + CELLS_OF };
  example_text file = {0};
  double numbers[3 * POINTS_OF], counted[COUNTED], begins[CELLS_OF + 1] = {0};
  size_t count = 0;
  for (size_t c = 0, i = 0; c < CELLS_OF; ++c) {
    begins[c + 1] = ENDS[c];
    counted[count++] = ENDS[c] - begins[c];
    for (; i < (size_t)ENDS[c]; ++i)
      counted[count++] = CORNERS[i];
  }
  begin_legacy(&file, binary, "UNSTRUCTURED_GRID\nFIELD FieldData 1\nTIME 1 1 double\n");
  example_legacy_numbers(&file, binary, EXAMPLE_FLOAT64, (const double[]){2.5}, 1);
  example_words(&file, "POINTS 9 double\n");
  example_legacy_numbers(&file, binary, EXAMPLE_FLOAT64, PLACE, 3 * POINTS_OF);
  if (with_offsets) {
    example_words(&file, "METADATA\nINFORMATION 0\n\nCELLS 8 21\nOFFSETS vtktypeint64\n");
    example_legacy_numbers(&file, binary, TYPE_INT64, begins, CELLS_OF + 1);
    example_words(&file, "METADATA\nINFORMATION 0\n\nCONNECTIVITY vtktypeint64\n");
    example_legacy_numbers(&file, binary, TYPE_INT64, CORNERS, CORNERS_OF);
  } else {
    example_words(&file, "CELLS 7 28\n");
    example_legacy_numbers(&file, binary, INT32, counted, COUNTED);
  }
  example_words(&file, "CELL_TYPES 7\n");
  example_legacy_numbers(&file, binary, INT32, TYPES, CELLS_OF);
  example_words(&file, "POINT_DATA 9\nVECTORS U double\n");
  velocities(numbers);
  example_legacy_numbers(&file, binary, EXAMPLE_FLOAT64, numbers, 3 * POINTS_OF);
  return file;
}

static const example_encoding RAW = {.storage = EXAMPLE_APPENDED_RAW,
                                     .type = EXAMPLE_FLOAT64};

/* A curvilinear grid. */
enum { NX = 5, NY = 4, NZ = 3, COUNT = NX * NY * NZ };

static const double EDGES[3][NX] = {{-1, 0, 1.25, 2.75, 4}, {2, 3, 4, 5.5}, {0, 2, 4.5}};

/* Points of a grid, and what U is there; sheared by so much. */
static inline void grid_points(double place[3 * COUNT], double vector[3 * COUNT],
                               double shear)
{
  for (size_t n = 0; n < COUNT; ++n) {
    const double x = EDGES[0][n % NX], y = EDGES[1][n / NX % NY],
                 z = EDGES[2][n / NX / NY];
    place[3 * n] = x + shear * y * z;
    place[3 * n + 1] = y + shear * x;
    place[3 * n + 2] = z - shear * x;
    for (size_t c = 0; c < 3; ++c)
      vector[3 * n + c] = sin(3.0 * (double)n + (double)c);
  }
}

static inline example_text vts(const example_encoding *encoding, double shear)
{
  example_text file = {0}, appended = {0};
  double place[3 * COUNT], vector[3 * COUNT];
  grid_points(place, vector, shear);
  example_begin_kind(&file, encoding, "StructuredGrid", "WholeExtent=\"1 5 0 3 -1 1\"");
  example_words(&file, "<Piece Extent=\"1 5 0 3 -1 1\"><PointData Vectors=\"U\">\n");
  example_array(&file, &appended, encoding, "U", 3, vector, 3 * COUNT);
  example_words(&file, "</PointData>");
  add_points(&file, &appended, encoding, place, COUNT);
  example_words(&file, "</Piece>\n");
  example_end_kind(&file, &appended, encoding, "StructuredGrid");
  return file;
}

#endif
