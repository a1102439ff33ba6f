/* Opening of files whose decoders fill a dataset. */
#include "interpret/projector.h"
#include "map/map.h"
#include "read/format.h"
#include "read/mapped.h"
#include "sample/space/space.h"

/* Fails for a second file or a level, where the format has neither. */
static fg_status check_one_file(fg_context *context, const fg__source *source,
                                const fg_read_options *options, const char *files)
{
  if (options->vars_from)
    return fg__fail(context, FG_STATUS_UNSUPPORTED,
                    "%s: a second file with the other component cannot be used with %s",
                    source->path, files);
  if (options->level != 0)
    return fg__fail(context, FG_STATUS_ARGUMENT,
                    "%s: level %d is asked for, but the file holds one only, number 0",
                    source->path, options->level);
  return FG_STATUS_OK;
}

/* What files of that kind, or this one, leave to choose from. */
static fg_status check_options(const fg__dataset *data, fg_context *context,
                               const fg__format *format, const fg__source *source,
                               const fg_read_options *options)
{
  const bool opened = data->files > 0;
  if (!opened && format->alone)
    return check_one_file(context, source, options, format->alone);
  if (opened && format->alone && options->block && !data->has_blocks)
    return fg__fail(context, FG_STATUS_ARGUMENT,
                    "%s: block \"%.100s\" is asked for, but the file has no blocks",
                    source->path, options->block);
  return FG_STATUS_OK;
}

fg_status fg__dataset_open(fg__dataset *data, fg_context *context,
                           const fg__format *format, const fg__source *source,
                           const fg_read_options *options)
{
  static const fg__projector by_proj = {
      fg__map_create,  fg__map_destroy, fg__map_projection, fg__map_center,
      fg__map_forward, fg__map_inverse, fg__map_turn};
  fg_status status = FG_STATUS_OK;
  if (fg_has_feature(FG_FEATURE_MAPS))
    data->projector = &by_proj;
  if (options)
    status = check_options(data, context, format, source, options);
  if (status == FG_STATUS_OK)
    status = format->open(data, context, source, options);
  if (options && status == FG_STATUS_OK)
    status = check_options(data, context, format, source, options);
  if (status == FG_STATUS_OK)
    status = fg__settle_names(data);
  if (options && options->scale != FG_SCALE_GEO)
    data->region = fg__region_asked(options);
  return status == FG_STATUS_OK && data->space.is_there ? fg__space_domain_open(data)
                                                        : status;
}

/* Files but the first, which the caller has opened, may have become shorter. */
fg_status fg__dataset_check(const fg__dataset *data, fg_status status)
{
  for (int n = 0; n < data->files; ++n) {
    const fg__dataset_file *file = &data->file[n];
    if (n > 0)
      status = fg__source_check(data->context, status, file->path, file->size);
    if (file->state && file->decoder->check)
      status = file->decoder->check(file->state, status);
  }
  return status;
}

fg_status fg__dataset_end(fg__dataset *data, fg_status status)
{
  status = fg__dataset_check(data, status);
  fg__space_domain_close(data);
  fg__dataset_close(data);
  return status;
}
