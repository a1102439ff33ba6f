/* A density, its clusters and its mask as VTK XML image data. */
#include "write/density.h"
#include "base/memory.h"
#include "component/components.h"
#include "density/share.h"
#include "file/number_text.h"

#include <limits.h>
#include <stdlib.h>
#include <string.h>

static size_t along(int points)
{
  return points > 0 ? (size_t)points : 1; /* an image in the plane has none along z */
}

static size_t point_count(const fg__vti_image *image)
{
  return along(image->points[0]) * along(image->points[1]) * along(image->points[2]);
}

/* The grid as VTK sees it: a periodic axis shows its first node again at its end. Copies
 * a number of 4 bytes a node to one a point. */
static void spread(const fg_density_arrays *density, const fg__vti_image *image,
                   const void *of_node, void *of_point)
{
  enum { BYTES = 4 };
  size_t columns = (size_t)density->nodes[0], rows = (size_t)density->nodes[1];
  size_t planes = (size_t)density->nodes[2];
  size_t width = along(image->points[0]);
  unsigned char *out = of_point;
  for (size_t z = 0; z < along(image->points[2]); ++z)
    for (size_t y = 0; y < along(image->points[1]); ++y) {
      const unsigned char *row = (const unsigned char *)of_node +
                                 (z % planes * rows + y % rows) * columns * BYTES;
      memcpy(out, row, columns * BYTES);
      if (width > columns)
        memcpy(out + columns * BYTES, row, BYTES);
      out += width * BYTES;
    }
}

static fg_status write_nodes(FILE *stream, fg_context *context,
                             const fg_density_arrays *density, const fg__vti_image *image,
                             const char *name, const char *type, const void *of_node)
{
  size_t bytes = point_count(image) * sizeof(float);
  fg__vti_output array = {
      .name = name, .type = type, .data = of_node, .bytes = bytes, .components = 1};
  void *of_point = NULL;
  if (density->periodic[0] || density->periodic[1] || density->periodic[2]) {
    of_point = fg__allocate(bytes, 1);
    if (!of_point)
      return fg__fail_memory(context, "a density to write", bytes);
    spread(density, image, of_node, of_point);
    array.data = of_point;
  }
  fg_status status = fg__vti_write_array(stream, context, &array);
  free(of_point);
  return status;
}

static fg_status write_mask(FILE *stream, fg_context *context,
                            const fg_density_arrays *density, const fg__vti_image *image)
{
  if (!density->active)
    return FG_STATUS_OK;
  size_t cells = 1;
  for (int k = 0; k < density->dimension; ++k)
    cells *= (size_t)image->points[k] - 1;
  unsigned char *ghost = fg__allocate(cells, 1);
  if (!ghost)
    return fg__fail_memory(context, "a mask to write", cells);
  for (size_t i = 0; i < cells; ++i)
    ghost[i] = density->active[i] ? 0 : FG__VTI_HIDDEN_CELL;
  fg_status status = fg__vti_write_array(stream, context,
                                         &(fg__vti_output){.name = "vtkGhostType",
                                                           .type = "UInt8",
                                                           .data = ghost,
                                                           .bytes = cells,
                                                           .components = 1});
  free(ghost);
  return status;
}

static fg_status write_image(FILE *stream, fg_context *context,
                             const fg_density_arrays *density, const fg__vti_image *image,
                             const int *label)
{
  fg__vti_write_open(stream, image, NULL, "u");
  fg_status status =
      write_nodes(stream, context, density, image, "u", "Float32", density->u);
  if (status == FG_STATUS_OK)
    status = write_nodes(stream, context, density, image, "cluster", "Int32", label);
  fg__vti_write_cells(stream);
  if (status == FG_STATUS_OK)
    status = write_mask(stream, context, density, image);
  fg__vti_write_close(stream);
  return status;
}

static bool ends_with(const char *path, const char *end)
{
  size_t length = strlen(path), wanted = strlen(end);
  return length > wanted && strcmp(path + length - wanted, end) == 0;
}

static fg_status describe(fg__vti_image *image, fg_context *context, const char *path,
                          const fg_density_arrays *density)
{
  image->time = &density->time;
  image->least_area = &density->debris_area;
  for (int k = 0; k < density->dimension; ++k) {
    if (density->nodes[k] == INT_MAX)
      return fg__fail(context, FG_STATUS_UNSUPPORTED, "%s: too many nodes", path);
    image->points[k] = density->nodes[k] + (density->periodic[k] ? 1 : 0);
    image->origin[k] = density->origin[k];
    image->spacing[k] = density->spacing[k];
  }
  return FG_STATUS_OK;
}

static fg_status label_nodes(fg__components *out, fg_context *context,
                             const fg_density_arrays *density)
{
  fg__component_grid grid = {.u = density->u, .active = density->active};
  double cell = 1.0;
  for (int k = 0; k < density->dimension; ++k) {
    grid.nodes[k] = density->nodes[k];
    grid.periodic[k] = density->periodic[k];
    cell *= density->spacing[k];
  }
  grid.debris_area = density->debris_area / cell;
  return fg__components_find(out, context, &grid);
}

static fg_status write_whole(fg_context *context, const char *path,
                             const fg_density_arrays *arrays, const fg__vti_image *image)
{
  fg__components components = {0};
  fg__number_locale locale;
  fg__whole_file file = {0};
  fg_status status = label_nodes(&components, context, arrays);
  if (status != FG_STATUS_OK)
    goto cleanup;
  if (!fg__number_locale_begin(&locale)) {
    status = fg__fail_memory(context, "a locale", sizeof locale);
    goto cleanup;
  }
  status = fg__whole_file_open(&file, context, path);
  if (status == FG_STATUS_OK)
    status = write_image(file.stream, context, arrays, image, components.label);
  status = fg__whole_file_close(&file, context, status);
  fg__number_locale_end(&locale);

cleanup:
  fg__components_clear(&components);
  return status;
}

fg_status fg_density_write(fg_context *context, const char *path,
                           const fg_density *density)
{
  if (!density)
    return fg__fail(context, FG_STATUS_ARGUMENT, "density: none to write");
  const fg_density_arrays *arrays = fg_density_contents(density);
  fg__density_share *share = fg__density_share_of(density);
  bool writes = !share || share->partition.ranks->rank == 0;
  fg__vti_image image = {0};
  fg_status status = FG_STATUS_OK;
  if (writes && !path)
    status = fg__fail(context, FG_STATUS_ARGUMENT, "density: no file name to write");
  else if (writes && !ends_with(path, ".vti"))
    status = fg__fail(context, FG_STATUS_UNSUPPORTED,
                      "%s: a density is written as .vti only", path);
  if (status == FG_STATUS_OK)
    status = describe(&image, context, writes ? path : "", arrays);
  if (share)
    return fg__density_write_shared(context, path, density, &image, status);
  return status ? status : write_whole(context, path, arrays, &image);
}
