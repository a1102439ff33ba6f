/* A pair of a mesh as a field on the sphere, and its entry in an inventory. */
#include "flowgrain/map.h"
#include "sample/curvilinear/points.h"

#include <math.h>

fg_status fg__sphere_read(fg__sphere **out, const fg__dataset *data, const fg__pair *pair,
                          fg__grid *grid, const fg_read_options *options)
{
  fg__vector_words words;
  fg__sphere_cells cells = {0};
  fg_status status = fg__vector_words_find(&words, data, pair, grid, options);
  if (status == FG_STATUS_OK)
    status = fg__curvilinear_read(&cells, grid->mesh, data, (size_t)options->time,
                                  (size_t)options->level, options->mask);
  if (status != FG_STATUS_OK)
    return status;
  fg__model_plane(grid->mesh, pair->component[0], &cells);
  if (grid->mesh->left_out > 0)
    fg__doubt(
        grid->doubts,
        "%zu of its %zu cells are missing: they lie over gaps more than 4.5 times as "
        "wide as the cells beside",
        grid->mesh->left_out, cells.count + grid->mesh->left_out);
  fg_field_arrays of_field = fg__vector_texts(&words, pair, grid);
  of_field.projection = grid->mesh->plane[0] ? grid->mesh->plane : NULL;
  cells.words = &of_field;
  cells.threads = options->map ? options->map->threads : 0;
  return fg__sphere_of_cells(out, data->context, &cells);
}

fg_status fg__curvilinear_describe(fg_inventory_vector *vector, const fg__dataset *data,
                                   const fg__pair *pair, fg__grid *grid)
{
  static const fg_read_options first = {0};
  fg__sphere *sphere = NULL;
  fg__sphere_extent extent;
  const fg_status status = fg__sphere_read(&sphere, data, pair, grid, &first);
  vector->frame = grid->mesh->rule;
  vector->missing_share = 1.0;
  vector->plane = grid->mesh->plane[0] ? grid->mesh->plane : NULL;
  if (status == FG_STATUS_FILE_FORMAT) { /* all samples of the first time are missing;
                                            other times may have some */
    fg_context_clear(data->context);
    return FG_STATUS_OK;
  }
  if (status != FG_STATUS_OK)
    return status;
  fg__sphere_extent_of(&extent, sphere);
  fg__globe_describe(vector, &extent);
  vector->missing_share = 1.0 - (double)extent.points / (double)grid->samples;
  vector->cells = grid->samples;
  fg__sphere_destroy(sphere);
  return status;
}
