/* What a .glb holds: meshes of arrows, lines, centres and clusters. */
#ifndef FG__GLB_MODEL_H
#define FG__GLB_MODEL_H

#include <stdint.h>

#include "base/context.h"

/* glTF's modes of a mesh. */
enum { FG__GLB_POINTS = 0, FG__GLB_LINES = 1, FG__GLB_TRIANGLES = 4 };

/* What becomes a mesh, and a node. */
typedef struct fg__glb_part {
  const char *name;         /* NULL: of an arrow */
  const fg_icon *icon;      /* of an arrow */
  int mode;                 /* FG__GLB_POINTS ... */
  double color[3], opacity; /* linear light */
  size_t first, count;      /* places */
  size_t first_normal;      /* of triangles, as many as places */
  bool colored;             /* its vertices have colours, as many as places */
  size_t first_color;
  size_t first_index, index_count; /* indices count from `first` */
  float low[3], high[3];
  int accessor; /* the first of its own: places, indices, normals of triangles, colours */
} fg__glb_part;

typedef struct fg__glb_model {
  double center[3];
  float (*place)[3], (*normal)[3], (*color)[3]; /* linear light */
  uint32_t *index;
  fg__glb_part *part; /* those that hold something */
  size_t places, normals, colors, indices, parts;
  size_t place_capacity, normal_capacity, color_capacity, index_capacity, part_capacity;
} fg__glb_model;

/* Of the numbers of all parts. */
size_t fg__glb_bytes(const fg__glb_model *m);

/* Fills an empty model. MEMORY, UNSUPPORTED (too large), ARGUMENT. */
fg_status fg__glb_collect(fg__glb_model *m, fg_context *context, const fg_field *field,
                          const fg_icons *icons, const fg_solid_options *options);
void fg__glb_clear(fg__glb_model *m);

#endif
