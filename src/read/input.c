/* Opens inputs, and answers for them. */
#include "read/input.h"

#include "base/memory.h"
#include "base/mix.h"
#include "field/slab.h"
#include "map/project.h"
#include "read/isolate/isolate.h"
#include "read/mapped.h"
#include "read/title.h"

#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char SYNTHETIC[] = "synth:";
enum { MESSAGE_BYTES = 2048 };

/* Refuses a file with the mesh and named dimensions where the format has neither. */
static fg_status check_choice(fg_context *context, const fg_input *input)
{
  const fg_read_options *options = &input->options;
  if (input->format->has_dimensions || (!options->mesh_from && !options->at))
    return FG_STATUS_OK;
  return fg__fail(context, FG_STATUS_UNSUPPORTED, "%s: %s cannot be used with %s",
                  input->source.path,
                  options->at ? "a sample of a named dimension (--at)"
                              : "a file with the mesh (--mesh-from)",
                  input->format->name);
}

/* What fg_field_create finds wrong with a file's samples is said of the file. */
static fg_status name_the_file(fg_context *context, fg_status status,
                               const fg_input *input)
{
  static const char prefix[] = "field: ";
  const char *message = fg_context_message(context);
  if (status == FG_STATUS_OK || strncmp(message, prefix, sizeof prefix - 1) != 0)
    return status;
  char words[MESSAGE_BYTES];
  char hint[MESSAGE_BYTES];
  strncpy(words, message + sizeof prefix - 1, sizeof words - 1);
  strncpy(hint, fg_context_hint(context), sizeof hint - 1);
  words[sizeof words - 1] = hint[sizeof hint - 1] = '\0';
  fg_context_clear(context);
  if (status == FG_STATUS_ARGUMENT)
    status = FG_STATUS_FILE_FORMAT;
  fg__fail(context, status, "%s: %s", fg__input_name(context, input->name), words);
  if (hint[0])
    fg__hint(context, "%s", hint);
  return status;
}

/* An analytic field has one vector and no axes to choose from. */
static fg_status read_analytic(fg_field **out, fg_context *context, const char *input,
                               const fg_read_options *options)
{
  if (options->vars || options->vars_from || options->mesh_from || options->at ||
      options->mask || options->time || options->level)
    return fg__fail(context, FG_STATUS_ARGUMENT,
                    "%s: an analytic field has no variables, masks, times or levels to "
                    "choose from",
                    input);
  if (options->scale == FG_SCALE_GEO || options->scale == FG_SCALE_MAP)
    return fg__fail(context, FG_STATUS_ARGUMENT,
                    "%s: an analytic field is neither on the globe nor on a map", input);
  const fg_map_options *map = options->map;
  if (fg__map_is_asked(map) &&
      (map->has_center || (map->projection && strcmp(map->projection, "auto") != 0)))
    return fg__fail(context, FG_STATUS_ARGUMENT, "%s: an analytic field is on no map",
                    input);
  const fg_status status =
      fg_field_create_analytic(out, context, input + sizeof SYNTHETIC - 1, 0);
  const fg__field_region region = fg__region_asked(options);
  return status == FG_STATUS_OK ? fg__region_cut(out, context, input, &region) : status;
}

static fg_status read_file(fg_field **out, fg_context *context, const fg_input *input,
                           const fg_read_options *options, fg__slab_index slab)
{
  fg__file_field samples;
  fg_status status = fg__file_field_read(&samples, context, input->format, &input->source,
                                         options, slab);
  if (status == FG_STATUS_OK)
    status =
        fg__file_field_place(out, context, &samples, input->source.path, options, slab);
  fg__file_field_clear(&samples);
  status = name_the_file(context, status, input);
  if (status == FG_STATUS_OK)
    status = fg__title_from_file(*out, context, &input->source, options);
  return status;
}

static fg_status read_slab(fg_field **out, fg_context *context, const fg_input *input,
                           const fg_read_options *options, fg__slab_index slab)
{
  return input->format ? read_file(out, context, input, options, slab)
                       : read_analytic(out, context, input->name, options);
}

/* Each rank cuts the whole field, and keeps its rows of the cut. */
static fg_status read_slice(fg_field **out, fg_context *context, const fg_input *input,
                            const fg_read_options *options, fg__slab_index slab)
{
  fg_field *volume = NULL, *whole = NULL;
  fg_plane plane;
  fg_status status = read_slab(&volume, context, input, options, (fg__slab_index){0, 1});
  if (status == FG_STATUS_OK)
    status = fg_plane_parse(&plane, context, options->slice, volume);
  if (status == FG_STATUS_OK)
    status = fg_field_slice(&whole, context, volume, &plane);
  fg_field_destroy(volume);
  if (status == FG_STATUS_OK)
    status = fg__region_cut(&whole, context, input->name, &input->of_cut);
  if (status == FG_STATUS_OK && slab.count > 1) {
    status = fg__field_slab_of(out, context, whole, slab);
    fg_field_destroy(whole);
  } else {
    *out = whole;
  }
  return name_the_file(context, status, input);
}

static uint64_t mix_text(uint64_t key, const char *text)
{
  for (; text && *text; ++text)
    key = fg__mix(key ^ (unsigned char)*text);
  return fg__mix(key);
}

static uint64_t bits_of(double number)
{
  uint64_t bits;
  memcpy(&bits, &number, sizeof bits);
  return bits;
}

/* Parts that were read otherwise do not belong together. */
static uint64_t key_of_reading(const fg_input *input, const fg_read_options *options)
{
  uint64_t key = mix_text(0, input->name);
  key =
      mix_text(mix_text(mix_text(key, options->vars), options->vars_from), options->mask);
  key = mix_text(key, options->missing);
  key =
      mix_text(mix_text(mix_text(key, options->mesh_from), options->at), options->slice);
  key = mix_text(key, fg__map_is_asked(options->map) ? options->map->projection : NULL);
  const fg__field_region asked = fg__region_asked(options);
  const fg__field_region *region = asked.axes > 0 ? &asked : &input->of_cut;
  for (int k = 0; k < region->axes; ++k)
    key = fg__mix(fg__mix(key ^ bits_of(region->low[k])) ^ bits_of(region->high[k]));
  key = fg__mix(key ^ (uint64_t)options->frame);
  return fg__mix(fg__mix(key ^ (uint64_t)options->time) ^ (uint64_t)options->level);
}

/* Notes in a slab what it was read from. */
static fg_status sign_slab(fg_field *field, fg_context *context, const fg_input *input,
                           const fg_read_options *options)
{
  fg__field_slab *slab = field ? field->slab : NULL;
  if (!slab)
    return FG_STATUS_OK;
  slab->key ^= key_of_reading(input, options);
  slab->input = fg__copy_text(input->name);
  return slab->input ? FG_STATUS_OK
                     : fg__fail_memory(context, "a name", strlen(input->name) + 1);
}

static fg_status answer_field(fg_field **out, fg_context *context, const fg_input *input,
                              const fg__question *question)
{
  const fg__slab_index slab = question->slab;
  fg_read_options options = input->options;
  options.time = question->time;
  options.level = question->level;
  if (slab.number < 0 || slab.number >= slab.count)
    return fg__fail(context, FG_STATUS_ARGUMENT, "no slab %d of %d of a field",
                    slab.number, slab.count);
  fg_status status =
      (options.slice ? read_slice : read_slab)(out, context, input, &options, slab);
  return status == FG_STATUS_OK ? sign_slab(*out, context, input, &options) : status;
}

static fg_status describe_analytic(fg_inventory *inventory, fg_context *context,
                                   const char *name)
{
  fg_field *field = NULL;
  fg_status status = fg_field_create_analytic(&field, context, name, 0);
  if (status != FG_STATUS_OK)
    return status;
  const fg_field_arrays *arrays = fg_field_contents(field);
  fg_inventory_vector vector = {.components = arrays->dimension,
                                .units = arrays->velocity_units,
                                .found_by = "formula",
                                .dimension = arrays->dimension,
                                .times = 1,
                                .levels = 1,
                                .scale = arrays->scale};
  for (int k = 0; k < arrays->dimension; ++k) {
    vector.name[k] = arrays->velocity_name[k];
    vector.axis_name[k] = arrays->axis_name[k];
    vector.size[k] = arrays->size[k];
    vector.bounds[2 * k] = arrays->axis[k][0];
    vector.bounds[2 * k + 1] = arrays->axis[k][arrays->size[k] - 1];
    vector.periodic[k] = arrays->period[k] > 0.0;
  }
  status = fg__inventory_add(inventory, context, &vector);
  fg_field_destroy(field);
  return status;
}

static fg_status answer_inventory(fg_inventory **out, fg_context *context,
                                  const fg_input *input, bool all)
{
  const fg__format *format = input->format;
  fg_status status =
      fg__inventory_create(out, context, format ? format->name : "analytic");
  if (status != FG_STATUS_OK)
    return status;
  status = format ? fg__dataset_inventory(*out, context, format, &input->source,
                                          all ? NULL : &input->options)
                  : describe_analytic(*out, context, input->name + sizeof SYNTHETIC - 1);
  return name_the_file(context, status, input);
}

static fg_status answer_here(fg__answer *out, fg_context *context, fg_input *input,
                             const fg__question *question)
{
  const fg__source *source = &input->source;
  *out = (fg__answer){.field = NULL};
  fg_status status = question->kind == FG__ASK_FIELD
                         ? answer_field(&out->field, context, input, question)
                         : answer_inventory(&out->inventory, context, input,
                                            question->kind == FG__ASK_ALL_VECTORS);
  if (source->on_disk)
    status = fg__source_check(context, status, source->path, source->size);
  if (status != FG_STATUS_OK) {
    fg_field_destroy(out->field);
    fg_inventory_destroy(out->inventory);
    *out = (fg__answer){.field = NULL};
  }
  return status;
}

/* A region of two axes is one of a cut, and the volume is read whole. */
static void take_options(fg_input *input, const fg_read_options *options)
{
  input->options = *options;
  const fg__field_region region = fg__region_asked(options);
  if (!options->slice || region.axes != 2)
    return;
  input->of_cut = region;
  input->volume_map = *options->map;
  input->volume_map.has_region = false;
  input->options.map = &input->volume_map;
}

fg_status fg_input_open(fg_input **out, fg_context *context, const char *input,
                        const fg_read_options *options)
{
  if (!input)
    return fg__fail(context, FG_STATUS_ARGUMENT, "no input to read");
  fg_input *opened = *out = fg__allocate(1, sizeof *opened);
  if (!opened)
    return fg__fail_memory(context, "an input", sizeof *opened);
  opened->name = input;
  opened->answer = answer_here;
  if (options)
    take_options(opened, options);
  if (strncmp(input, SYNTHETIC, sizeof SYNTHETIC - 1) == 0)
    return FG_STATUS_OK;
  fg_status status =
      fg__source_open_known(&opened->source, &opened->format, context, input);
  opened->source.kept = &opened->kept;
  if (status == FG_STATUS_OK)
    status = check_choice(context, opened);
  if (status == FG_STATUS_OK) {
    if (fg__context_input(context)->isolate)
      fg__isolation_find(&opened->isolation, opened);
    return FG_STATUS_OK;
  }
  fg_input_close(opened);
  *out = NULL;
  return status;
}

void fg_input_close(fg_input *input)
{
  if (!input)
    return;
  fg__isolation_end(&input->isolation);
  if (input->kept.data)
    input->kept.close(input->kept.data);
  fg__source_close(&input->source, NULL, FG_STATUS_OK);
  fg_inventory_destroy(input->inventory);
  fg_inventory_destroy(input->all);
  free(input);
}

static fg_status ask(fg__answer *out, fg_context *context, fg_input *input,
                     const fg__question *question)
{
  return (input->isolation.library ? fg__isolation_ask : input->answer)(out, context,
                                                                        input, question);
}

/* Asks for an inventory unless it is there. */
static fg_status keep_inventory(const fg_inventory **out, fg_inventory **kept,
                                fg_context *context, fg_input *input,
                                fg__question_kind kind)
{
  fg__answer answer = {.inventory = *kept};
  fg_status status = FG_STATUS_OK;
  if (!*kept)
    status = ask(&answer, context, input, &(fg__question){.kind = kind});
  *out = *kept = answer.inventory;
  return status;
}

fg_status fg_input_inventory(const fg_inventory **out, fg_context *context,
                             fg_input *input)
{
  return keep_inventory(out, &input->inventory, context, input, FG__ASK_VECTOR);
}

fg_status fg_input_vectors(const fg_inventory **out, fg_context *context, fg_input *input)
{
  return keep_inventory(out, &input->all, context, input, FG__ASK_ALL_VECTORS);
}

static fg_read_defaults defaults_of(const fg_inventory *inventory)
{
  fg_read_defaults out = {0};
  const fg_inventory_vector *vector = fg_inventory_vector_at(inventory, 0);
  if (vector && !vector->unusable) {
    out.level = vector->usual_level;
    snprintf(out.absent, sizeof out.absent, "%s", vector->absent ? vector->absent : "");
  }
  return out;
}

fg_status fg_input_defaults(fg_read_defaults *out, fg_context *context, fg_input *input)
{
  const fg_inventory *inventory;
  const fg_status status = fg_input_inventory(&inventory, context, input);
  *out = defaults_of(inventory);
  return status;
}

fg_status fg_input_field(fg_field **out, fg_context *context, fg_input *input, int time,
                         int level, int slab, int slabs)
{
  const fg__question question = {FG__ASK_FIELD, time, level, {slab, slabs}};
  fg__answer answer;
  const fg_status status = ask(&answer, context, input, &question);
  *out = answer.field;
  return status;
}

/* Opens an input for one question. place: where the answer is to go. */
static fg_status ask_once(fg__answer *out, const void *place, fg_context *context,
                          const char *input, const fg_read_options *options,
                          const fg__question *question)
{
  fg_input *opened = NULL;
  *out = (fg__answer){.field = NULL};
  if (!place)
    return fg__fail(context, FG_STATUS_ARGUMENT, "no place for what is read");
  fg_status status = fg_input_open(&opened, context, input, options);
  if (status == FG_STATUS_OK)
    status = ask(out, context, opened, question);
  fg_input_close(opened);
  return status;
}

fg_status fg_field_read_slab(fg_field **out, fg_context *context, const char *input,
                             const fg_read_options *options, int slab, int slabs)
{
  const fg__question question = {FG__ASK_FIELD,
                                 options ? options->time : 0,
                                 options ? options->level : 0,
                                 {slab, slabs}};
  fg__answer answer;
  const fg_status status = ask_once(&answer, out, context, input, options, &question);
  if (out)
    *out = answer.field;
  return status;
}

fg_status fg_field_read(fg_field **out, fg_context *context, const char *input,
                        const fg_read_options *options)
{
  return fg_field_read_slab(out, context, input, options, 0, 1);
}

fg_status fg_inventory_read(fg_inventory **out, fg_context *context, const char *input)
{
  fg__answer answer;
  const fg_status status = ask_once(&answer, out, context, input, NULL,
                                    &(fg__question){.kind = FG__ASK_ALL_VECTORS});
  if (out)
    *out = answer.inventory;
  return status;
}

fg_status fg_inventory_read_chosen(fg_inventory **out, fg_context *context,
                                   const char *input, const fg_read_options *options)
{
  fg__answer answer;
  const fg_status status = ask_once(&answer, out, context, input, options,
                                    &(fg__question){.kind = FG__ASK_VECTOR});
  if (out)
    *out = answer.inventory;
  return status;
}

fg_status fg_read_defaults_find(fg_read_defaults *out, fg_context *context,
                                const char *input, const fg_read_options *options)
{
  fg_inventory *inventory;
  if (!out)
    return fg__fail(context, FG_STATUS_ARGUMENT, "no place for what is read");
  const fg_status status = fg_inventory_read_chosen(&inventory, context, input, options);
  *out = defaults_of(inventory);
  fg_inventory_destroy(inventory);
  return status;
}
