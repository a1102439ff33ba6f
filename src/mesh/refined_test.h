/* Meshes of some scenes refined round by round, and which cells and nodes they have. */
#ifndef FG__REFINED_TEST_H
#define FG__REFINED_TEST_H

#include <math.h>
#include <string.h>

#include "mesh/refinement.h"
#include "mesh/together_test.h"

typedef struct scene {
  fg__mesh_description description;
  double center[3]; /* of the sphere that is resolved, in cells of the finest level */
} scene;

static const scene SCENES[] = {
    {{.dimension = 2,
      .side = {1.0, 1.0},
      .nodes = 65,
      .patch_cells = 4,
      .refinements = 3},
     {20.0, 50.0, 0.0}},
    {{.dimension = 2,
      .side = {2.0, 1.0},
      .periodic = {true, false},
      .nodes = 120,
      .patch_cells = 8,
      .refinements = 2},
     {5.0, 30.0, 0.0}},
    {{.dimension = 3,
      .side = {1.0, 1.0, 1.0},
      .periodic = {false, true, false},
      .nodes = 33,
      .patch_cells = 4,
      .refinements = 2},
     {32.0, 3.0, 10.0}},
};
enum { SCENE_COUNT = sizeof SCENES / sizeof *SCENES, ROUNDS = 3 };

/* Fine where a sphere, growing round by round, passes through a leaf or near it. */
static inline signed char wanted_level(const scene *s, const fg__mesh *mesh,
                                       const fg__leaf *leaf, int round)
{
  double square = 0.0, side = leaf->side * mesh->patch_cells;
  for (int k = 0; k < mesh->dimension; ++k) {
    double d = fabs(leaf->first[k] * mesh->patch_cells + 0.5 * side - s->center[k]);
    if (mesh->periodic[k])
      d = fmin(d, mesh->cells[k] - d);
    square += d * d;
  }
  double from_sphere = fabs(sqrt(square) - (4.0 + 8.0 * round));
  double level = (from_sphere - side) / 4.0;
  return (signed char)(level < 0.0                     ? 0
                       : level > mesh->level_count - 1 ? mesh->level_count - 1
                                                       : (int)level);
}

/* The mesh after some rounds, of all ranks or of this one alone. */
static inline fg__mesh mesh_after(const scene *s, int rounds, const fg__ranks *ranks)
{
  fg__mesh mesh;
  fg__mesh_description description = s->description;
  description.ranks = ranks;
  if (fg__mesh_create(&mesh, us.context, &description) != FG_STATUS_OK)
    abort();
  for (int round = 0; round < rounds; ++round) {
    signed char *wanted = allocate_or_end((size_t)mesh.leaf_count, 1);
    for (int n = 0; n < mesh.leaf_count; ++n)
      wanted[n] = wanted_level(s, &mesh, &mesh.leaf[n], round);
    fg__mesh adapted;
    if (fg__mesh_adapt(&adapted, us.context, &mesh, wanted) != FG_STATUS_OK)
      abort();
    free(wanted);
    fg__mesh_clear(&mesh);
    mesh = adapted;
  }
  return mesh;
}

static inline size_t count_nodes(const fg__partition *level)
{
  return (size_t)level->nodes[0] * (size_t)level->nodes[1] * (size_t)level->nodes[2];
}

static inline size_t place_of(const fg__partition *level, int i, int j, int k)
{
  return ((size_t)k * (size_t)level->nodes[1] + (size_t)j) * (size_t)level->nodes[0] +
         (size_t)i;
}

/* How many boxes own each node of a level. */
static inline unsigned char *owners_of(const fg__partition *level)
{
  unsigned char *owners = allocate_or_end(count_nodes(level), 1);
  for (int n = 0; n < level->count; ++n) {
    const fg__box *b = &level->box[n];
    for (int k = b->first[2]; k < b->first[2] + b->nodes[2]; ++k)
      for (int j = b->first[1]; j < b->first[1] + b->nodes[1]; ++j)
        for (int i = b->first[0]; i < b->first[0] + b->nodes[0]; ++i)
          ++owners[place_of(level, i, j, k)];
  }
  return owners;
}

typedef void check(const fg__mesh *mesh, const scene *s, int round);

static inline void for_all_meshes(check *holds)
{
  for (int n = 0; n < SCENE_COUNT; ++n)
    for (int round = 0; round <= ROUNDS; ++round) {
      fg__mesh mesh = mesh_after(&SCENES[n], round, NULL);
      holds(&mesh, &SCENES[n], round);
      fg__mesh_clear(&mesh);
    }
}

/* The index of the cell that cell `index` is or mirrors. */
static inline int cell_image(const fg__partition *level, int k, int index)
{
  int cells = level->cells[k];
  if (level->periodic[k])
    return (index + cells) % cells;
  return index < 0 ? -1 - index : index >= cells ? 2 * cells - 1 - index : index;
}

/* owners: of the lower corners of cells, mesh->cover. */
static inline bool has_cell(const fg__partition *level, const unsigned char *owners,
                            const int cell[3])
{
  int image[3];
  for (int k = 0; k < 3; ++k)
    image[k] = k < level->dimension ? cell_image(level, k, cell[k]) : 0;
  return owners[place_of(level, image[0], image[1], image[2])] > 0;
}

static inline bool is_on_border(const fg__partition *level, const unsigned char *owners,
                                const int node[3])
{
  for (int corner = 0; corner < 1 << level->dimension; ++corner) {
    int cell[3] = {node[0], node[1], node[2]};
    for (int k = 0; k < 3; ++k)
      cell[k] -= corner >> k & 1; /* in 2D corner has no bit 2 */
    if (!has_cell(level, owners, cell))
      return true;
  }
  return false;
}

/* Whether a node of the grid has a cell of the level beside it. */
static inline bool is_of_level(const fg__partition *level, const unsigned char *cover,
                               const int node[3])
{
  for (int corner = 0; corner < 1 << level->dimension; ++corner) {
    int cell[3] = {node[0], node[1], node[2]};
    for (int k = 0; k < 3; ++k)
      cell[k] -= corner >> k & 1;
    if (has_cell(level, cover, cell))
      return true;
  }
  return false;
}

#endif
