/* flowgrain: simple pictures of complicated vector fields, at every scale.
 *
 *     fg_context *context = NULL;  fg_field *field = NULL;  fg_icons *icons = NULL;
 *     fg_status status = fg_context_create(&context);
 *     if (!status)
 *       status = fg_field_read(&field, context, "wind.nc", NULL);
 *     if (!status)
 *       status = fg_arrows_create(&icons, context, field, NULL);   // 40 arrows
 *     if (!status)
 *       status = fg_picture_write(context, "wind.svg", field, NULL, icons, NULL);
 *     if (status)
 *       fprintf(stderr, "%s\n", fg_context_message(context));
 *
 * fg_field_create takes arrays in memory instead of a file. A run of scales goes from
 * many arrows to few: a density evolves on the field by an anisotropic Cahn-Hilliard
 * equation (fg_evolution), the set {u > 0} (fg_density) falls into ever fewer clusters,
 * and the first scale's arrows start from these (fg_placement); or each cluster becomes
 * one curved arrow (fg_icons). Method: Garcke, Preusser, Rumpf, Telea, Weikard and van
 * Wijk, "A Continuous Clustering Method for Vector Fields", IEEE Visualization 2000.
 *
 *     fg_run *run = NULL;
 *     const fg_run_scale *scale = NULL;
 *     status = fg_run_create(&run, context, field, NULL);  // 200, 100, 50, 25, 12
 *     if (!status)
 *       status = fg_run_next(&scale, run);
 *     while (!status && scale) {                           // NULL after the last
 *       status = show(scale->icons);
 *       if (!status)
 *         status = fg_run_next(&scale, run);
 *     }
 *
 * All of this is made of parts that can be called alone; examples/ has programs.
 *
 * The manual is the headers that this one includes: context.h (statuses, messages,
 * ranks), field.h, dataset.h, inventory.h, input.h, map.h and slabs.h (in), evolution.h,
 * energy.h and checkpoint.h (the work), density.h and icons.h (its results),
 * critical.h (what a field turns round or parts at),
 * placement.h (exactly N arrows), run.h (scales), picture.h, view.h, solid.h, texture.h
 * and brush.h (out), rival.h (what to compare with), score.h (how good it is), words.h
 * (suggestions for misspelt words); and mpi.h (several processes), which it does not
 * include. Each can be included alone.
 *
 * The library flowgrain_core is this one without files: what reads or writes them,
 * checkpoints and all of picture.h, texture.h, brush.h and rival.h are not in it.
 *
 * Conventions
 * - A function that can fail returns fg_status; its result comes first, through `out`,
 *   and belongs to the caller, who frees it with the matching destroy function. NULL is
 *   accepted there.
 * - Pointers must not be NULL unless the function allows it. A context may be: what
 *   fails is then reported by the status alone.
 * - Returned pointers to const are borrowed: they are valid as long as the object that
 *   they come from.
 * - Option structs: a zero field means the default; a NULL pointer means all defaults.
 * - On failure the context keeps the first message, with the numbers that show the cause.
 * - Arrays of samples run x fastest, then y, then z. Coordinates are the input's own.
 * - A context, and what was made with it, is used by one thread at a time; a finished
 *   fg_field or fg_density may be read by several threads that hold a context each.
 *   Files are read by one thread at a time: the NetCDF and HDF5 libraries are not made
 *   for more.
 */
#ifndef FLOWGRAIN_H
#define FLOWGRAIN_H

#include "flowgrain/brush.h"
#include "flowgrain/checkpoint.h"
#include "flowgrain/context.h"
#include "flowgrain/critical.h"
#include "flowgrain/dataset.h"
#include "flowgrain/density.h"
#include "flowgrain/energy.h"
#include "flowgrain/evolution.h"
#include "flowgrain/field.h"
#include "flowgrain/icons.h"
#include "flowgrain/input.h"
#include "flowgrain/inventory.h"
#include "flowgrain/map.h"
#include "flowgrain/picture.h"
#include "flowgrain/placement.h"
#include "flowgrain/rival.h"
#include "flowgrain/run.h"
#include "flowgrain/score.h"
#include "flowgrain/slabs.h"
#include "flowgrain/solid.h"
#include "flowgrain/texture.h"
#include "flowgrain/view.h"
#include "flowgrain/words.h"

#endif
