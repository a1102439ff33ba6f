#include "icon/icons_make.h"

#include "base/context.h"

static fg_status create_whole(fg_icons **out, fg_context *context, const fg_field *field,
                              const fg_density *density, const fg_icon_options *options)
{
  fg__labels labels = {0};
  const fg_density_arrays *arrays = fg_density_contents(density);
  fg_status status = fg__labels_create(&labels, context, arrays);
  if (status != FG_STATUS_OK)
    return status;
  fg__patch whole = fg__patch_of(arrays, &labels);
  fg__icon_source source = {.field = field,
                            .density = arrays,
                            .labels = &labels,
                            .patch = &whole,
                            .count = labels.count};
  fg_icon *icon = fg__icons_allocate(labels.count);
  status =
      icon ? fg__icons_make(icon, context, &source, options ? options->threads : 1)
           : fg__fail_memory(context, "the icons", (size_t)labels.count * sizeof *icon);
  if (status == FG_STATUS_OK)
    status = fg__icons_collect(out, context, icon, labels.count);
  fg__icons_free(icon, labels.count);
  fg__labels_clear(&labels);
  return status;
}

fg_status fg_icons_create(fg_icons **out, fg_context *context, const fg_field *field,
                          const fg_density *density, const fg_icon_options *options)
{
  if (!out || !field || !density)
    return fg__fail(context, FG_STATUS_ARGUMENT, "icons: no %s given",
                    !out     ? "place for the result"
                    : !field ? "field"
                             : "density");
  *out = NULL;
  int dimension = fg_density_contents(density)->dimension;
  if (fg_field_contents(field)->dimension != dimension)
    return fg__fail(context, FG_STATUS_ARGUMENT,
                    "icons: a density in %d dimensions of a field in %d", dimension,
                    fg_field_contents(field)->dimension);
  if (fg_field_is_part(field, NULL, NULL) && !fg_density_is_shared(density))
    return fg__fail(context, FG_STATUS_ARGUMENT,
                    "icons: a field that ranks share, of a density that they do not");
  if (fg_density_is_shared(density))
    return fg__icons_create_shared(out, context, field, density, options);
  return create_whole(out, context, field, density, options);
}
