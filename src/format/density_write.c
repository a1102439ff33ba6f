/* A density, its clusters and its mask as VTK XML image data. */
#include "base/memory.h"
#include "cluster/raster.h"
#include "format/number_text.h"
#include "format/vti_write.h"

#include <limits.h>
#include <stdlib.h>
#include <string.h>

/* vtkDataSetAttributes::HIDDENCELL */
enum { HIDDEN_CELL = 32 };

/* The grid as VTK sees it: a periodic axis shows its first node again at its end. */
typedef struct drawn_grid {
  const fg_density_arrays *density;
  const fg__labels *labels;
  fg__vti_image image;
} drawn_grid;

static size_t node_of_point(const drawn_grid *grid, size_t x, size_t y)
{
  size_t columns = (size_t)grid->density->nodes[0],
         rows = (size_t)grid->density->nodes[1];
  return y % rows * columns + x % columns;
}

static fg_status write_points(FILE *stream, fg_context *context, const drawn_grid *grid)
{
  size_t columns = (size_t)grid->image.points[0], rows = (size_t)grid->image.points[1];
  float *u = fg__allocate(columns * rows, sizeof *u);
  int32_t *cluster = fg__allocate(columns * rows, sizeof *cluster);
  fg_status status;
  if (!u || !cluster) {
    status = fg__fail_memory(context, "a density to write", columns * rows * sizeof *u);
    goto cleanup;
  }
  for (size_t y = 0; y < rows; ++y)
    for (size_t x = 0; x < columns; ++x) {
      size_t node = node_of_point(grid, x, y);
      u[y * columns + x] = grid->density->u[node];
      cluster[y * columns + x] = grid->labels->label[node];
    }
  status = fg__vti_write_array(stream, context,
                               &(fg__vti_output){.name = "u",
                                                 .type = "Float32",
                                                 .data = u,
                                                 .bytes = columns * rows * sizeof *u,
                                                 .components = 1});
  if (status == FG_STATUS_OK)
    status =
        fg__vti_write_array(stream, context,
                            &(fg__vti_output){.name = "cluster",
                                              .type = "Int32",
                                              .data = cluster,
                                              .bytes = columns * rows * sizeof *cluster,
                                              .components = 1});

cleanup:
  free(cluster);
  free(u);
  return status;
}

static fg_status write_cells(FILE *stream, fg_context *context, const drawn_grid *grid)
{
  const unsigned char *active = grid->density->active;
  if (!active)
    return FG_STATUS_OK;
  size_t cells =
      ((size_t)grid->image.points[0] - 1) * ((size_t)grid->image.points[1] - 1);
  unsigned char *ghost = fg__allocate(cells, 1);
  if (!ghost)
    return fg__fail_memory(context, "a mask to write", cells);
  for (size_t i = 0; i < cells; ++i)
    ghost[i] = active[i] ? 0 : HIDDEN_CELL;
  fg_status status = fg__vti_write_array(stream, context,
                                         &(fg__vti_output){.name = "vtkGhostType",
                                                           .type = "UInt8",
                                                           .data = ghost,
                                                           .bytes = cells,
                                                           .components = 1});
  free(ghost);
  return status;
}

static fg_status write_image(FILE *stream, fg_context *context, const drawn_grid *grid)
{
  fg__vti_write_open(stream, &grid->image, NULL, "u");
  fg_status status = write_points(stream, context, grid);
  fg__vti_write_cells(stream);
  if (status == FG_STATUS_OK)
    status = write_cells(stream, context, grid);
  fg__vti_write_close(stream);
  return status;
}

static bool ends_with(const char *path, const char *end)
{
  size_t length = strlen(path), wanted = strlen(end);
  return length > wanted && strcmp(path + length - wanted, end) == 0;
}

fg_status fg_density_write(fg_context *context, const char *path,
                           const fg_density *density)
{
  if (!path || !density)
    return fg__fail(context, FG_STATUS_ARGUMENT, "density: %s to write",
                    path ? "none" : "no file name");
  if (!ends_with(path, ".vti"))
    return fg__fail(context, FG_STATUS_UNSUPPORTED,
                    "%s: a density is written as .vti only", path);
  const fg_density_arrays *arrays = fg_density_contents(density);
  fg__labels labels = {0};
  drawn_grid grid = {
      .density = arrays, .labels = &labels, .image = {.time = &arrays->time}};
  for (int k = 0; k < 2; ++k) {
    if (arrays->nodes[k] == INT_MAX)
      return fg__fail(context, FG_STATUS_UNSUPPORTED, "%s: too many nodes", path);
    grid.image.points[k] = arrays->nodes[k] + (arrays->periodic[k] ? 1 : 0);
    grid.image.origin[k] = arrays->origin[k];
    grid.image.spacing[k] = arrays->spacing[k];
  }
  fg__number_locale locale;
  fg_status status = fg__labels_create(&labels, context, arrays);
  if (status != FG_STATUS_OK)
    return status;
  fg__whole_file file = {0};
  if (!fg__number_locale_begin(&locale)) {
    fg__labels_clear(&labels);
    return fg__fail_memory(context, "a locale", sizeof locale);
  }
  status = fg__whole_file_open(&file, context, path);
  if (status == FG_STATUS_OK)
    status = write_image(file.stream, context, &grid);
  status = fg__whole_file_close(&file, context, status);
  fg__number_locale_end(&locale);
  fg__labels_clear(&labels);
  return status;
}
