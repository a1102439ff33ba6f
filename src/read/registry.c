#include "base/feature.h"
#include "base/memory.h"
#include "base/mix.h"
#include "decode/signature.h"
#include "field/slab.h"
#include "map/project.h"
#include "read/foreign.h"
#include "read/format.h"
#include "read/mapped.h"
#include "read/title.h"

#include <ctype.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

static const fg__format *const FORMATS[] = {
    &fg__format_exodus,     &fg__format_netcdf, &fg__format_grib, &fg__format_vti,
    &fg__format_vtk_legacy, &fg__format_npy,    &fg__format_npz,  &fg__format_table};
static const char SYNTHETIC[] = "synth:";
enum { MESSAGE_BYTES = 2048, KNOWN_BYTES = 512 };

const fg__format *fg__format_find(const unsigned char *bytes, size_t size)
{
  for (size_t i = 0; i < sizeof FORMATS / sizeof *FORMATS; ++i)
    if (FORMATS[i]->is_mine(bytes, size))
      return FORMATS[i];
  return NULL;
}

static int plain_letter(char letter)
{
  return letter == ' ' ? '-' : tolower((unsigned char)letter);
}

/* Whether a format's name is `word`, or begins so, whichever the size of letters and with
 * dashes or blanks; or whether its files' names end so, as csv. */
static bool is_called(const fg__format *format, const char *word)
{
  const char *name = format->name;
  const size_t length = strlen(word);
  size_t same = 0;
  while (same < length && name[same] &&
         plain_letter(name[same]) == plain_letter(word[same]))
    ++same;
  if (same == length && (name[same] == '\0' || name[same] == ' '))
    return true;
  for (const char *at = length ? format->files : NULL;
       at && (at = strchr(at, '.')) != NULL; ++at)
    if (strncmp(at + 1, word, length) == 0 && strchr(",)", at[1 + length]))
      return true;
  return false;
}

/* The format of a name; of two of that name the one that knows the bytes. */
static fg_status find_named(const fg__format **out, fg_context *context, const char *word,
                            const fg__source *source)
{
  char known[KNOWN_BYTES] = "";
  size_t used = 0;
  *out = NULL;
  for (size_t i = 0; i < sizeof FORMATS / sizeof *FORMATS; ++i) {
    if (used < sizeof known)
      used += (size_t)snprintf(known + used, sizeof known - used, "%s%s",
                               used ? ", " : "", FORMATS[i]->name);
    if (is_called(FORMATS[i], word) &&
        (!*out || FORMATS[i]->is_mine(source->bytes, source->size)))
      *out = FORMATS[i];
  }
  if (*out)
    return FG_STATUS_OK;
  for (char *letter = known; *letter; ++letter)
    *letter =
        *letter == ' ' && letter[-1] != ',' ? '-' : (char)tolower((unsigned char)*letter);
  fg__fail(context, FG_STATUS_ARGUMENT, "%s: no format is called \"%.100s\"",
           source->path, word);
  fg__hint(context, "formats: %s", known);
  return FG_STATUS_ARGUMENT;
}

static void hint_at_known(fg_context *context)
{
  char known[KNOWN_BYTES] = "";
  size_t used = 0;
  for (size_t i = 0; i < sizeof FORMATS / sizeof *FORMATS; ++i)
    if (FORMATS[i]->files && used < sizeof known)
      used += (size_t)snprintf(known + used, sizeof known - used, "%s%s",
                               used ? ", " : "", FORMATS[i]->files);
  fg__hint(context, "formats known: %s; or synth:NAME", used ? known : "none");
}

static fg_status find_format(const fg__format **out, fg_context *context,
                             const fg__source *source)
{
  const char *wanted = fg__context_input(context)->format;
  if (wanted)
    return find_named(out, context, wanted, source);
  *out = fg__format_find(source->bytes, source->size);
  const fg__foreign *foreign = NULL;
  if (!*out || *out == &fg__format_table)
    foreign = fg__foreign_find(source->bytes, source->size);
  else if (*out == &fg__format_netcdf &&
           fg__nc_kind_of(source->bytes, source->size) == FG__NC_HDF5)
    foreign = fg__foreign_hdf5(source->bytes, source->size);
  if (foreign) {
    fg__fail(context, FG_STATUS_FILE_FORMAT, "%s: is %s, which cannot be read",
             source->path, foreign->name);
    fg__hint(context, "%s", foreign->advice);
    return FG_STATUS_FILE_FORMAT;
  }
  if (*out)
    return FG_STATUS_OK;
  char start[3 * 4 + 1] = "";
  for (size_t i = 0; i < 4 && i < source->size; ++i) {
    static const char digit[] = "0123456789abcdef";
    start[3 * i] = digit[source->bytes[i] >> 4];
    start[3 * i + 1] = digit[source->bytes[i] & 15];
    start[3 * i + 2] = ' ';
    start[3 * i + 3] = '\0';
  }
  if (start[0])
    start[strlen(start) - 1] = '\0';
  fg_status status = fg__fail(context, FG_STATUS_FILE_FORMAT,
                              "%s: unknown format (%zu bytes, starting with %s)",
                              source->path, source->size, start);
  hint_at_known(context);
  return status;
}

fg_status fg__source_open_known(fg__source *out, const fg__format **format,
                                fg_context *context, const char *path)
{
  fg_status status = fg__source_open(out, context, path);
  if (status == FG_STATUS_OK)
    status = find_format(format, context, out);
  if (status == FG_STATUS_OK && (*format)->is_absent)
    status = fg__fail_absent(context, out->path, (*format)->feature);
  return status;
}

fg_status fg__check_one_file(fg_context *context, const fg__source *source,
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

/* Refuses a file with the mesh and named dimensions where the format has neither. */
static fg_status check_choice(fg_context *context, const fg__format *format,
                              const fg__source *source, const fg_read_options *options)
{
  if (!options || format->has_dimensions || (!options->mesh_from && !options->at))
    return FG_STATUS_OK;
  return fg__fail(context, FG_STATUS_UNSUPPORTED, "%s: %s cannot be used with %s",
                  source->path,
                  options->at ? "a sample of a named dimension (--at)"
                              : "a file with the mesh (--mesh-from)",
                  format->name);
}

static fg_status open_for(fg__source *out, const fg__format **format, fg_context *context,
                          const char *path, const fg_read_options *options)
{
  fg_status status = fg__source_open_known(out, format, context, path);
  return status == FG_STATUS_OK ? check_choice(context, *format, out, options) : status;
}

static bool is_synthetic(const char *input)
{
  return strncmp(input, SYNTHETIC, sizeof SYNTHETIC - 1) == 0;
}

/* What fg_field_create finds wrong with a file's samples is said of the file. */
static fg_status name_the_file(fg_context *context, fg_status status, const char *input)
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
  fg__fail(context, status, "%s: %s", fg__input_name(context, input), words);
  if (hint[0])
    fg__hint(context, "%s", hint);
  return status;
}

/* An analytic field has one vector and no axes to choose from. */
static fg_status read_analytic(fg_field **out, fg_context *context, const char *input,
                               const fg_read_options *options)
{
  if (options && (options->vars || options->vars_from || options->mesh_from ||
                  options->at || options->mask || options->time || options->level))
    return fg__fail(context, FG_STATUS_ARGUMENT,
                    "%s: an analytic field has no variables, masks, times or levels to "
                    "choose from",
                    input);
  if (options && (options->scale == FG_SCALE_GEO || options->scale == FG_SCALE_MAP))
    return fg__fail(context, FG_STATUS_ARGUMENT,
                    "%s: an analytic field is neither on the globe nor on a map", input);
  if (options && fg__map_is_named(options->map))
    return fg__fail(context, FG_STATUS_ARGUMENT, "%s: an analytic field is on no map",
                    input);
  return fg_field_create_analytic(out, context, input + sizeof SYNTHETIC - 1, 0);
}

static fg_status read_slab(fg_field **out, fg_context *context, const char *input,
                           const fg_read_options *options, fg__slab_index slab)
{
  if (!out || !input)
    return fg__fail(context, FG_STATUS_ARGUMENT, "no input to read a field from");
  *out = NULL;
  if (is_synthetic(input))
    return read_analytic(out, context, input, options);
  static const fg_read_options defaults = {0};
  fg__source source;
  const fg__format *format;
  if (!options)
    options = &defaults;
  fg_status status = open_for(&source, &format, context, input, options);
  if (status == FG_STATUS_OK)
    status = name_the_file(
        context, fg__field_read_known(out, context, format, &source, options, slab),
        input);
  if (status == FG_STATUS_OK)
    status = fg__title_from_file(*out, context, &source, options);
  status = fg__source_close(&source, context, status);
  if (status != FG_STATUS_OK) {
    fg_field_destroy(*out);
    *out = NULL;
  }
  return status;
}

/* Each rank cuts the whole field, and keeps its rows of the cut. */
static fg_status read_slice(fg_field **out, fg_context *context, const char *input,
                            const fg_read_options *options, fg__slab_index slab)
{
  fg_field *volume = NULL, *whole = NULL;
  fg_plane plane;
  *out = NULL;
  fg_status status = read_slab(&volume, context, input, options, (fg__slab_index){0, 1});
  if (status == FG_STATUS_OK)
    status = fg_plane_parse(&plane, context, options->slice, volume);
  if (status == FG_STATUS_OK)
    status = fg_field_slice(&whole, context, volume, &plane);
  fg_field_destroy(volume);
  if (status == FG_STATUS_OK && slab.count > 1) {
    status = fg__field_slab_of(out, context, whole, slab);
    fg_field_destroy(whole);
  } else {
    *out = whole;
  }
  return name_the_file(context, status, input);
}

static fg_status read_part(fg_field **out, fg_context *context, const char *input,
                           const fg_read_options *options, fg__slab_index slab)
{
  return (options && out && options->slice ? read_slice : read_slab)(out, context, input,
                                                                     options, slab);
}

fg_status fg_field_read(fg_field **out, fg_context *context, const char *input,
                        const fg_read_options *options)
{
  return read_part(out, context, input, options, (fg__slab_index){0, 1});
}

static uint64_t mix_text(uint64_t key, const char *text)
{
  for (; text && *text; ++text)
    key = fg__mix(key ^ (unsigned char)*text);
  return fg__mix(key);
}

/* Parts that were read otherwise do not belong together. */
static uint64_t key_of_reading(const char *input, const fg_read_options *options)
{
  uint64_t key = mix_text(0, input);
  if (!options)
    return key;
  key =
      mix_text(mix_text(mix_text(key, options->vars), options->vars_from), options->mask);
  key = mix_text(key, options->missing);
  key =
      mix_text(mix_text(mix_text(key, options->mesh_from), options->at), options->slice);
  key = mix_text(key, fg__map_is_asked(options->map) ? options->map->projection : NULL);
  key = fg__mix(key ^ (uint64_t)options->frame);
  return fg__mix(fg__mix(key ^ (uint64_t)options->time) ^ (uint64_t)options->level);
}

fg_status fg_field_read_slab(fg_field **out, fg_context *context, const char *input,
                             const fg_read_options *options, int slab, int slabs)
{
  if (slab < 0 || slab >= slabs)
    return fg__fail(context, FG_STATUS_ARGUMENT, "no slab %d of %d of a field", slab,
                    slabs);
  fg_status status =
      read_part(out, context, input, options, (fg__slab_index){slab, slabs});
  if (status != FG_STATUS_OK || !(*out)->slab)
    return status;
  fg__field_slab *own = (*out)->slab;
  own->key ^= key_of_reading(input, options);
  own->input = fg__copy_text(input);
  if (own->input)
    return FG_STATUS_OK;
  fg_field_destroy(*out);
  *out = NULL;
  return fg__fail_memory(context, "a name", strlen(input) + 1);
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
    vector.size[k] = arrays->size[k];
    vector.bounds[2 * k] = arrays->axis[k][0];
    vector.bounds[2 * k + 1] = arrays->axis[k][arrays->size[k] - 1];
    vector.periodic[k] = arrays->period[k] > 0.0;
  }
  status = fg__inventory_add(inventory, context, &vector);
  fg_field_destroy(field);
  return status;
}

/* options: NULL for all vectors, else those of the one to be read. */
static fg_status describe_file(fg_inventory **out, fg_context *context, const char *path,
                               const fg_read_options *options)
{
  fg__source source;
  const fg__format *format;
  fg_status status = open_for(&source, &format, context, path, options);
  if (status == FG_STATUS_OK)
    status = fg__inventory_create(out, context, format->name);
  if (status == FG_STATUS_OK && options && format->inventory_chosen)
    status = format->inventory_chosen(*out, context, &source, options);
  else if (status == FG_STATUS_OK)
    status = format->inventory(*out, context, &source);
  if (status == FG_STATUS_OK && options && !format->inventory_chosen)
    fg__inventory_choose(*out, options);
  status = fg__source_close(&source, context, status);
  return name_the_file(context, status, path);
}

static fg_status read_inventory(fg_inventory **out, fg_context *context,
                                const char *input, const fg_read_options *options)
{
  if (!out || !input)
    return fg__fail(context, FG_STATUS_ARGUMENT, "no input to describe");
  *out = NULL;
  fg_inventory *inventory = NULL;
  fg_status status;
  if (is_synthetic(input)) {
    status = fg__inventory_create(&inventory, context, "analytic");
    if (status == FG_STATUS_OK)
      status = describe_analytic(inventory, context, input + sizeof SYNTHETIC - 1);
  } else {
    status = describe_file(&inventory, context, input, options);
  }
  if (status == FG_STATUS_OK)
    *out = inventory;
  else
    fg_inventory_destroy(inventory);
  return status;
}

fg_status fg_inventory_read(fg_inventory **out, fg_context *context, const char *input)
{
  return read_inventory(out, context, input, NULL);
}

fg_status fg_inventory_read_chosen(fg_inventory **out, fg_context *context,
                                   const char *input, const fg_read_options *options)
{
  static const fg_read_options defaults = {0};
  return read_inventory(out, context, input, options ? options : &defaults);
}

fg_status fg_read_defaults_find(fg_read_defaults *out, fg_context *context,
                                const char *input, const fg_read_options *options)
{
  static const fg_read_options defaults = {0};
  if (!out || !input)
    return fg__fail(context, FG_STATUS_ARGUMENT, "no input to look at");
  *out = (fg_read_defaults){0};
  if (is_synthetic(input))
    return FG_STATUS_OK;
  fg__source source;
  const fg__format *format;
  fg_status status = open_for(&source, &format, context, input, options);
  if (status == FG_STATUS_OK && format->defaults)
    status = format->defaults(out, context, &source, options ? options : &defaults);
  status = fg__source_close(&source, context, status);
  return name_the_file(context, status, input);
}
