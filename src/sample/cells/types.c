/* Cells of VTK's types in linear parts (VTK File Formats, Kitware, figures 2 and 3;
 * vtkCellType.h). */
#include <limits.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "sample/cells/set.h"

enum { MOST_NODES = 27, MOST_MIDDLES = 7, MOST_PARTS = 10, LAGRANGE_HEXAHEDRON = 72 };

typedef struct part {
  fg__cell_shape shape;
  signed char node[FG__CELL_CORNERS]; /* from `nodes` on they are middles */
} part;

/* Nodes round a middle: corners, then those between two. */
typedef struct middle_of {
  int corners, betweens;
  signed char node[20];
} middle_of;

typedef struct cell_type {
  int number;
  const char *name;
  int nodes;
  int parts; /* 0: cannot be read */
  const part *part;
  int middles;
  const middle_of *middle;
} cell_type;

#define T FG__CELL_TRIANGLE
#define Q FG__CELL_QUAD
#define TET FG__CELL_TETRAHEDRON
#define PYR FG__CELL_PYRAMID
#define WDG FG__CELL_WEDGE
#define HEX FG__CELL_HEXAHEDRON

static const part TRIANGLE[] = {{T, {0, 1, 2}}};
static const part PIXEL[] = {{Q, {0, 1, 3, 2}}};
static const part QUAD[] = {{Q, {0, 1, 2, 3}}};
static const part TETRAHEDRON[] = {{TET, {0, 1, 2, 3}}};
static const part VOXEL[] = {{HEX, {0, 1, 3, 2, 4, 5, 7, 6}}};
static const part HEXAHEDRON[] = {{HEX, {0, 1, 2, 3, 4, 5, 6, 7}}};
static const part WEDGE[] = {{WDG, {0, 1, 2, 3, 4, 5}}};
static const part PYRAMID[] = {{PYR, {0, 1, 2, 3, 4}}};
static const part PRISM_5[] = {
    {WDG, {0, 1, 2, 5, 6, 7}}, {WDG, {0, 2, 3, 5, 7, 8}}, {WDG, {0, 3, 4, 5, 8, 9}}};
static const part PRISM_6[] = {{WDG, {0, 1, 2, 6, 7, 8}},
                               {WDG, {0, 2, 3, 6, 8, 9}},
                               {WDG, {0, 3, 4, 6, 9, 10}},
                               {WDG, {0, 4, 5, 6, 10, 11}}};
static const part TRIANGLE_6[] = {
    {T, {0, 3, 5}}, {T, {3, 1, 4}}, {T, {5, 4, 2}}, {T, {3, 4, 5}}};
static const part TRIANGLE_7[] = {{T, {0, 3, 6}}, {T, {3, 1, 6}}, {T, {1, 4, 6}},
                                  {T, {4, 2, 6}}, {T, {2, 5, 6}}, {T, {5, 0, 6}}};
static const part QUAD_6[] = {{Q, {0, 4, 5, 3}}, {Q, {4, 1, 2, 5}}};
static const part QUAD_9[] = {
    {Q, {0, 4, 8, 7}}, {Q, {4, 1, 5, 8}}, {Q, {8, 5, 2, 6}}, {Q, {7, 8, 6, 3}}};
static const part TETRAHEDRON_10[] = {
    {TET, {0, 4, 6, 7}}, {TET, {4, 1, 5, 8}}, {TET, {6, 5, 2, 9}}, {TET, {7, 8, 9, 3}},
    {TET, {4, 9, 5, 6}}, {TET, {4, 9, 6, 7}}, {TET, {4, 9, 7, 8}}, {TET, {4, 9, 8, 5}}};
static const part HEXAHEDRON_27[] = {
    {HEX, {0, 8, 24, 11, 16, 22, 26, 20}},  {HEX, {8, 1, 9, 24, 22, 17, 21, 26}},
    {HEX, {24, 9, 2, 10, 26, 21, 18, 23}},  {HEX, {11, 24, 10, 3, 20, 26, 23, 19}},
    {HEX, {16, 22, 26, 20, 4, 12, 25, 15}}, {HEX, {22, 17, 21, 26, 12, 5, 13, 25}},
    {HEX, {26, 21, 18, 23, 25, 13, 6, 14}}, {HEX, {20, 26, 23, 19, 15, 25, 14, 7}}};
static const part WEDGE_12[] = {{WDG, {0, 6, 8, 3, 9, 11}},
                                {WDG, {6, 1, 7, 9, 4, 10}},
                                {WDG, {8, 7, 2, 11, 10, 5}},
                                {WDG, {6, 7, 8, 9, 10, 11}}};
static const part WEDGE_18[] = {
    {WDG, {0, 6, 8, 12, 15, 17}},   {WDG, {6, 1, 7, 15, 13, 16}},
    {WDG, {8, 7, 2, 17, 16, 14}},   {WDG, {6, 7, 8, 15, 16, 17}},
    {WDG, {12, 15, 17, 3, 9, 11}},  {WDG, {15, 13, 16, 9, 4, 10}},
    {WDG, {17, 16, 14, 11, 10, 5}}, {WDG, {15, 16, 17, 9, 10, 11}}};
static const part PYRAMID_14[] = {{PYR, {0, 5, 13, 8, 9}},   {PYR, {5, 1, 6, 13, 10}},
                                  {PYR, {13, 6, 2, 7, 11}},  {PYR, {8, 13, 7, 3, 12}},
                                  {PYR, {9, 10, 11, 12, 4}}, {PYR, {9, 12, 11, 10, 13}},
                                  {TET, {5, 9, 10, 13}},     {TET, {6, 10, 11, 13}},
                                  {TET, {7, 11, 12, 13}},    {TET, {8, 12, 9, 13}}};

static const middle_of MIDDLE_8[] = {{4, 4, {0, 1, 2, 3, 4, 5, 6, 7}}};
static const middle_of MIDDLE_13[] = {{4, 4, {0, 1, 2, 3, 5, 6, 7, 8}}};
static const middle_of MIDDLES_15[] = {{4, 4, {0, 1, 4, 3, 6, 13, 9, 12}},
                                       {4, 4, {1, 2, 5, 4, 7, 14, 10, 13}},
                                       {4, 4, {2, 0, 3, 5, 8, 12, 11, 14}}};
static const middle_of MIDDLES_20[] = {
    {4, 4, {0, 4, 7, 3, 16, 15, 19, 11}},
    {4, 4, {1, 2, 6, 5, 9, 18, 13, 17}},
    {4, 4, {0, 1, 5, 4, 8, 17, 12, 16}},
    {4, 4, {3, 7, 6, 2, 19, 14, 18, 10}},
    {4, 4, {0, 1, 2, 3, 8, 9, 10, 11}},
    {4, 4, {4, 5, 6, 7, 12, 13, 14, 15}},
    {8, 12, {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17, 18, 19}}};

#define PARTS(list) (int)(sizeof(list) / sizeof((list)[0])), (list)

static const cell_type TYPES[] = {
    {5, "triangle", 3, PARTS(TRIANGLE), 0, NULL},
    {8, "pixel", 4, PARTS(PIXEL), 0, NULL},
    {9, "quad", 4, PARTS(QUAD), 0, NULL},
    {10, "tetrahedron", 4, PARTS(TETRAHEDRON), 0, NULL},
    {11, "voxel", 8, PARTS(VOXEL), 0, NULL},
    {12, "hexahedron", 8, PARTS(HEXAHEDRON), 0, NULL},
    {13, "wedge", 6, PARTS(WEDGE), 0, NULL},
    {14, "pyramid", 5, PARTS(PYRAMID), 0, NULL},
    {15, "pentagonal prism", 10, PARTS(PRISM_5), 0, NULL},
    {16, "hexagonal prism", 12, PARTS(PRISM_6), 0, NULL},
    {22, "quadratic triangle", 6, PARTS(TRIANGLE_6), 0, NULL},
    {23, "quadratic quad", 8, PARTS(QUAD_9), PARTS(MIDDLE_8)},
    {24, "quadratic tetrahedron", 10, PARTS(TETRAHEDRON_10), 0, NULL},
    {25, "quadratic hexahedron", 20, PARTS(HEXAHEDRON_27), PARTS(MIDDLES_20)},
    {26, "quadratic wedge", 15, PARTS(WEDGE_18), PARTS(MIDDLES_15)},
    {27, "quadratic pyramid", 13, PARTS(PYRAMID_14), PARTS(MIDDLE_13)},
    {28, "biquadratic quad", 9, PARTS(QUAD_9), 0, NULL},
    {29, "triquadratic hexahedron", 27, PARTS(HEXAHEDRON_27), 0, NULL},
    {30, "quadratic linear quad", 6, PARTS(QUAD_6), 0, NULL},
    {31, "quadratic linear wedge", 12, PARTS(WEDGE_12), 0, NULL},
    {32, "biquadratic quadratic wedge", 18, PARTS(WEDGE_18), 0, NULL},
    {33, "biquadratic quadratic hexahedron", 0, 0, NULL, 0, NULL},
    {34, "biquadratic triangle", 7, PARTS(TRIANGLE_7), 0, NULL},
    {36, "quadratic polygon", 0, 0, NULL, 0, NULL},
    {37, "triquadratic pyramid", 0, 0, NULL, 0, NULL},
    {41, "convex point set", 0, 0, NULL, 0, NULL},
    {42, "polyhedron", 0, 0, NULL, 0, NULL},
    /* of orders 1 and 2, whose nodes are those of linear and quadratic cells */
    {69, "Lagrange triangle", 3, PARTS(TRIANGLE), 0, NULL},
    {69, "Lagrange triangle", 6, PARTS(TRIANGLE_6), 0, NULL},
    {70, "Lagrange quadrilateral", 4, PARTS(QUAD), 0, NULL},
    {70, "Lagrange quadrilateral", 9, PARTS(QUAD_9), 0, NULL},
    {71, "Lagrange tetrahedron", 4, PARTS(TETRAHEDRON), 0, NULL},
    {71, "Lagrange tetrahedron", 10, PARTS(TETRAHEDRON_10), 0, NULL},
    {LAGRANGE_HEXAHEDRON, "Lagrange hexahedron", 8, PARTS(HEXAHEDRON), 0, NULL},
    {LAGRANGE_HEXAHEDRON, "Lagrange hexahedron", 27, PARTS(HEXAHEDRON_27), 0, NULL},
    {73, "Lagrange wedge", 6, PARTS(WEDGE), 0, NULL},
    {73, "Lagrange wedge", 18, PARTS(WEDGE_18), 0, NULL},
    {74, "Lagrange pyramid", 5, PARTS(PYRAMID), 0, NULL},
};

/* Vertices, lines, and lines of several corners or points. */
static bool is_line(int type)
{
  return (type >= 0 && type <= 4) || type == 21 || type == 35 || type == 68;
}

enum { STRIP = 6, POLYGON = 7 };

/* The type of that number (VTK's) and number of nodes, or else the number's first. */
static const cell_type *find(int type, size_t nodes)
{
  const cell_type *first = NULL;
  for (size_t i = 0; i < sizeof TYPES / sizeof TYPES[0]; ++i)
    if (TYPES[i].number == type && (!first || (size_t)TYPES[i].nodes == nodes))
      first = &TYPES[i];
  return first;
}

static fg_status fail_type(const fg__cell_set *set, int type, size_t nodes, int number)
{
  const cell_type *known = find(type, nodes);
  fg__fail(set->context, FG_STATUS_UNSUPPORTED,
           "%s: cell %d is a %s of %zu points (VTK's number %d); only linear and "
           "quadratic cells can be read",
           set->path, number, known ? known->name : "type that is not known", nodes,
           type);
  fg__hint(set->context, "%s", FG__RESAMPLE);
  return FG_STATUS_UNSUPPORTED;
}

static fg_status fail_nodes(const fg__cell_set *set, const char *name, size_t nodes,
                            int expected, int number)
{
  return fg__fail(set->context, FG_STATUS_FILE_FORMAT,
                  "%s: cell %d is a %s with %zu corners, not %d", set->path, number, name,
                  nodes, expected);
}

/* Adds the middle of corners and points between them; *out is its place. */
static fg_status add_middle(int *out, fg__cell_set *set, int corners, int betweens,
                            const int *parent)
{
  const int count = corners + betweens;
  void *middles = set->middle, *parents = set->parent;
  if (set->middles >= INT_MAX / 2)
    return fg__fail(set->context, FG_STATUS_UNSUPPORTED, "%s: more than %d points",
                    set->path, INT_MAX / 2);
  const bool grown =
      fg__grow(&middles, &set->middles_capacity, set->middles + 1, sizeof *set->middle);
  set->middle = middles;
  if (!grown || !fg__grow(&parents, &set->parents_capacity, set->parents + (size_t)count,
                          sizeof *set->parent))
    return fg__fail_memory(set->context, "middles of cells", set->parents * sizeof(int));
  set->parent = parents;
  *out = -1 - (int)set->middles;
  set->middle[set->middles++] = (fg__cell_middle){set->parents, corners, betweens};
  for (int i = 0; i < count; ++i)
    set->parent[set->parents++] = parent[i];
  return FG_STATUS_OK;
}

static fg_status add_parts(fg__cell_set *set, const cell_type *type, int *point,
                           int number)
{
  fg_status status = FG_STATUS_OK;
  for (int m = 0; m < type->middles && status == FG_STATUS_OK; ++m) {
    const middle_of *middle = &type->middle[m];
    int parent[MOST_NODES];
    for (int i = 0; i < middle->corners + middle->betweens; ++i)
      parent[i] = point[middle->node[i]];
    status = add_middle(&point[type->nodes + m], set, middle->corners, middle->betweens,
                        parent);
  }
  for (int p = 0; p < type->parts && status == FG_STATUS_OK; ++p) {
    const part *one = &type->part[p];
    int corner[FG__CELL_CORNERS] = {0};
    for (int i = 0; i < fg__cell_corners(one->shape); ++i)
      corner[i] = point[one->node[i]];
    status = fg__cell_set_add_points(set, one->shape, corner, number);
  }
  return status;
}

static void cross_at(double out[3], const fg__cell_set *set, int a, int b, int c)
{
  const double *p = set->position + 3 * (size_t)a, *q = set->position + 3 * (size_t)b,
               *r = set->position + 3 * (size_t)c;
  for (int k = 0; k < 3; ++k) {
    const int i = (k + 1) % 3, j = (k + 2) % 3;
    out[k] = (q[i] - p[i]) * (r[j] - q[j]) - (q[j] - p[j]) * (r[i] - q[i]);
  }
}

/* Whether a polygon bends one way at all corners. */
static bool is_convex(const fg__cell_set *set, const int *point, size_t corners)
{
  double normal[3] = {0.0, 0.0, 0.0}, bend[3], most = 0.0, least = 0.0;
  for (size_t i = 1; i + 1 < corners; ++i) {
    cross_at(bend, set, point[0], point[i], point[i + 1]);
    for (int k = 0; k < 3; ++k)
      normal[k] += bend[k];
  }
  for (size_t i = 0; i < corners; ++i) {
    cross_at(bend, set, point[i], point[(i + 1) % corners], point[(i + 2) % corners]);
    const double turn = fg__dot(bend, normal);
    most = fmax(most, turn);
    least = fmin(least, turn);
  }
  return least >= -1e-6 * most;
}

static fg_status add_polygon(fg__cell_set *set, const int *point, size_t corners,
                             int number)
{
  if (corners < 3)
    return FG_STATUS_OK;
  if (corners == 4)
    return fg__cell_set_add_points(set, FG__CELL_QUAD, point, number);
  if (corners > 4 && !is_convex(set, point, corners)) {
    fg__fail(set->context, FG_STATUS_UNSUPPORTED,
             "%s: cell %d is a polygon of %zu corners that is not convex", set->path,
             number, corners);
    fg__hint(set->context, "divide it with ParaView's filter Triangulate, and save that");
    return FG_STATUS_UNSUPPORTED;
  }
  fg_status status = FG_STATUS_OK;
  for (size_t i = 1; i + 1 < corners && status == FG_STATUS_OK; ++i)
    status = fg__cell_set_add_points(set, FG__CELL_TRIANGLE,
                                     (int[3]){point[0], point[i], point[i + 1]}, number);
  return status;
}

static fg_status add_strip(fg__cell_set *set, const int *point, size_t corners,
                           int number)
{
  fg_status status = FG_STATUS_OK;
  for (size_t i = 0; i + 2 < corners && status == FG_STATUS_OK; ++i)
    status = fg__cell_set_add_points(set, FG__CELL_TRIANGLE, point + i, number);
  return status;
}

static bool is_of_any_order(int type)
{
  return type >= 69 && type <= 74;
}

/* The square of the distance of a point from the middle between two. */
static double off_middle(const fg__cell_set *set, int point, int a, int b)
{
  double sum = 0.0;
  for (size_t k = 0; k < 3; ++k) {
    const double off =
        set->position[3 * (size_t)point + k] -
        0.5 * (set->position[3 * (size_t)a + k] + set->position[3 * (size_t)b + k]);
    sum += off * off;
  }
  return sum;
}

/* VTK before 9 has the nodes of the last two edges of a Lagrange hexahedron in the other
 * order; where they lie tells which it is. */
static void order_edges(const fg__cell_set *set, int *point)
{
  const double as_now = off_middle(set, point[18], point[2], point[6]) +
                        off_middle(set, point[19], point[3], point[7]);
  const double as_before = off_middle(set, point[19], point[2], point[6]) +
                           off_middle(set, point[18], point[3], point[7]);
  if (as_before < as_now) {
    const int kept = point[18];
    point[18] = point[19];
    point[19] = kept;
  }
}

/* The pyramids between a face and the middle, in tetrahedra: from the face's first point
 * in the file's order, so that it is divided alike from both its sides. */
static fg_status add_face(fg__cell_set *set, const int *point, int corners, int middle,
                          int number)
{
  int first = 0;
  fg_status status = FG_STATUS_OK;
  for (int i = 1; i < corners; ++i)
    first = point[i] < point[first] ? i : first;
  for (int i = 1; i + 1 < corners && status == FG_STATUS_OK; ++i)
    status = fg__cell_set_add_points(set, FG__CELL_TETRAHEDRON,
                                     (int[4]){point[first], point[(first + i) % corners],
                                              point[(first + i + 1) % corners], middle},
                                     number);
  return status;
}

/* Between its faces and the mean of its points lie pyramids; so it should be convex. */
static fg_status add_polyhedron(fg__cell_set *set, const int *corner, size_t count,
                                int number)
{
  const int nodes = corner[0], *face = corner + 1 + nodes;
  int middle = 0;
  if ((size_t)nodes + 1 == count)
    return fail_type(set, FG__POLYHEDRON, (size_t)nodes, number);
  if (nodes < 4)
    return fg__fail(set->context, FG_STATUS_FILE_FORMAT,
                    "%s: cell %d is a polyhedron with %d corners", set->path, number,
                    nodes);
  fg_status status = add_middle(&middle, set, 0, nodes, corner + 1);
  int faces = *face++;
  for (; faces > 0 && status == FG_STATUS_OK; --faces) {
    status = add_face(set, face + 1, face[0], middle, number);
    face += 1 + face[0];
  }
  return status;
}

fg_status fg__cell_set_add_as(fg__cell_set *set, int type, const int *corner,
                              size_t count, int number)
{
  int point[MOST_NODES + MOST_MIDDLES];
  if (is_line(type))
    return FG_STATUS_OK;
  if (type == STRIP || type == POLYGON)
    return (type == STRIP ? add_strip : add_polygon)(set, corner, count, number);
  if (type == FG__POLYHEDRON)
    return add_polyhedron(set, corner, count, number);
  const cell_type *known = find(type, count);
  const bool fits = known && count == (size_t)known->nodes;
  if (!known || known->parts == 0 || (!fits && is_of_any_order(type)))
    return fail_type(set, type, count, number);
  if (!fits)
    return fail_nodes(set, known->name, count, known->nodes, number);
  memcpy(point, corner, count * sizeof *point);
  if (type == LAGRANGE_HEXAHEDRON && count == MOST_NODES)
    order_edges(set, point);
  return add_parts(set, known, point, number);
}
