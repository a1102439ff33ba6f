#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "evolve/checkpoint_file.h"
#include "evolve/evolution.h"
#include "evolve/stepper_state.h"

enum { DAMAGE_BYTES = 2048 };

struct fg_checkpoint {
  fg__checkpoint_file file;
  const char *note; /* within the file's text */
  char damage[DAMAGE_BYTES];
};

/* What has to agree between an evolution and a checkpoint. */
typedef struct parameters {
  uint64_t field, initial, seed;
  int energy, nodes, cells[3], cycles, scheme;
  double anisotropy, coverage, gamma, accuracy;
} parameters;

/* In the order in which a difference is reported: first what follows from nothing else.
 */
static const fg__named_value parameter_values[] = {
    {"nodes", FG__VALUE_INTEGER, offsetof(parameters, nodes)},
    {"energy", FG__VALUE_INTEGER, offsetof(parameters, energy)},
    {"anisotropy", FG__VALUE_REAL, offsetof(parameters, anisotropy)},
    {"coverage", FG__VALUE_REAL, offsetof(parameters, coverage)},
    {"seed", FG__VALUE_COUNT, offsetof(parameters, seed)},
    {"accuracy", FG__VALUE_REAL, offsetof(parameters, accuracy)},
    {"cycles", FG__VALUE_INTEGER, offsetof(parameters, cycles)},
    {"scheme", FG__VALUE_INTEGER, offsetof(parameters, scheme)},
    {"field", FG__VALUE_BITS, offsetof(parameters, field)},
    {"initial", FG__VALUE_BITS, offsetof(parameters, initial)},
    {"gamma", FG__VALUE_REAL, offsetof(parameters, gamma)},
    {"cells-x", FG__VALUE_INTEGER, offsetof(parameters, cells[0])},
    {"cells-y", FG__VALUE_INTEGER, offsetof(parameters, cells[1])},
    {"cells-z", FG__VALUE_INTEGER, offsetof(parameters, cells[2])},
};
enum { PARAMETERS = sizeof parameter_values / sizeof parameter_values[0] };

/* The evolution's own state, beside the stepper's. */
typedef struct counts {
  double area_fraction, seconds;
  int clusters;
  bool counting;
} counts;

static const fg__named_value count_values[] = {
    {"evolution.area_fraction", FG__VALUE_REAL, offsetof(counts, area_fraction)},
    {"evolution.clusters", FG__VALUE_INTEGER, offsetof(counts, clusters)},
    {"evolution.counting", FG__VALUE_FLAG, offsetof(counts, counting)},
    {"evolution.seconds", FG__VALUE_REAL, offsetof(counts, seconds)},
};
enum { COUNTS = sizeof count_values / sizeof count_values[0] };

static parameters parameters_of(const fg_evolution *e)
{
  return (parameters){.field = e->field_fingerprint,
                      .initial = e->initial_fingerprint,
                      .seed = e->options.seed,
                      .energy = (int)e->options.energy,
                      .nodes = e->options.nodes,
                      .cells = {e->info.cells[0], e->info.cells[1], e->info.cells[2]},
                      .cycles = e->options.cycles,
                      .scheme = (int)e->options.scheme,
                      .anisotropy = e->options.anisotropy,
                      .coverage = e->options.coverage,
                      .gamma = e->info.gamma,
                      .accuracy = e->options.accuracy};
}

/* Lines "NAME VALUE", an empty line, and the note. End with free; NULL without memory. */
static char *describe(const fg_evolution *e, const char *note)
{
  char *text = NULL;
  size_t bytes;
  FILE *stream = open_memstream(&text, &bytes);
  if (!stream)
    return NULL;
  parameters agreed = parameters_of(e);
  counts counted = {.area_fraction = e->area_fraction,
                    .seconds = fg__evolution_seconds(e),
                    .clusters = e->clusters,
                    .counting = e->counting};
  fprintf(stream, "version %s\n", fg_version());
  fg__values_print(stream, parameter_values, PARAMETERS, &agreed);
  fg__values_print(stream, fg__stepper_values, fg__stepper_value_count, &e->stepper);
  fg__values_print(stream, count_values, COUNTS, &counted);
  fprintf(stream, "\n%s", note ? note : "");
  bool failed = ferror(stream) != 0;
  if (fclose(stream) != 0 || failed) {
    free(text);
    return NULL;
  }
  return text;
}

static size_t node_count(const fg__level *level)
{
  const int *nodes = level->layout.nodes;
  return (size_t)nodes[0] * (size_t)nodes[1] * (size_t)nodes[2];
}

/* The part of a grid that a level covers. */
static void set_box(fg__box_record *record, const fg_evolution *e,
                    const fg__state_array *array)
{
  *record = (fg__box_record){.grid = array->grid, .nodes = {1, 1, 1}};
  snprintf(record->array, sizeof record->array, "%s", array->name);
  for (int k = 0; k < e->mesh.dimension; ++k) {
    record->first[k] = e->mesh.tile[0].first[k] >> array->grid;
    record->nodes[k] = array->level->layout.nodes[k];
  }
}

fg_status fg_evolution_save(const fg_evolution *evolution, const char *path,
                            const char *note)
{
  const fg_evolution *e = evolution;
  if (e->spread)
    return fg__fail(e->context, FG_STATUS_UNSUPPORTED,
                    "checkpoints are kept by a run on one rank only, not on %d",
                    e->mesh.ranks->count);
  fg__state_array arrays[FG__STATE_ARRAYS];
  fg__box_record records[FG__STATE_ARRAYS];
  fg__stepper stepper = e->stepper; /* its arrays are only read */
  fg__stepper_arrays(&stepper, arrays);
  for (int n = 0; n < FG__STATE_ARRAYS; ++n)
    set_box(&records[n], e, &arrays[n]);
  fg__checkpoint_place(records, FG__STATE_ARRAYS, FG__CHECKPOINT_FIRST_OFFSET);
  size_t count = node_count(arrays[0].level); /* no coarser level has more */
  float *plain = fg__allocate(count, sizeof *plain);
  char *text = describe(e, note);
  fg__checkpoint_writer writer;
  fg_status status = FG_STATUS_OK;
  if (!plain || !text)
    status = fg__fail_memory(e->context, "a checkpoint", count * sizeof *plain);
  if (!status)
    status = fg__checkpoint_begin(&writer, e->context, path, true);
  if (!status) {
    for (int n = 0; !status && n < FG__STATE_ARRAYS; ++n) {
      fg__level_export(arrays[n].level, arrays[n].values, plain);
      status = fg__checkpoint_write(&writer, e->context, &records[n], plain);
    }
    status = fg__checkpoint_commit(&writer, e->context, text, records, FG__STATE_ARRAYS,
                                   status);
  }
  free(plain);
  free(text);
  return status;
}

static fg_status open_checked(fg__checkpoint_file *out, fg_context *context,
                              const char *path)
{
  fg_status status = fg__checkpoint_read(out, context, path);
  if (!status)
    status = fg__checkpoint_verify(out, context, 0, out->record_count);
  if (status)
    fg__checkpoint_close(out);
  return status;
}

/* The newest that is whole. When neither is, the failure is the newest one's. */
static fg_status open_newest(fg_checkpoint *checkpoint, fg_context *context,
                             const char *path)
{
  size_t bytes = strlen(path) + sizeof ".previous";
  char *previous = fg__allocate(bytes, 1);
  fg_context *newest;
  if (!previous || fg_context_create(&newest)) {
    free(previous);
    return fg__fail_memory(context, "a checkpoint", bytes);
  }
  snprintf(previous, bytes, "%s.previous", path);
  fg_status status = open_checked(&checkpoint->file, newest, path);
  const char *fault = fg_context_message(newest);
  if (status && status != FG_STATUS_MEMORY &&
      !open_checked(&checkpoint->file, NULL, previous)) {
    snprintf(checkpoint->damage, sizeof checkpoint->damage, "%s", fault);
    status = FG_STATUS_OK;
  }
  if (status)
    fg__fail(context, status, "%s", fault);
  fg_context_destroy(newest);
  free(previous);
  return status;
}

fg_status fg_checkpoint_open(fg_checkpoint **out, fg_context *context, const char *path)
{
  if (!out || !path)
    return fg__fail(context, FG_STATUS_ARGUMENT, "checkpoint: a NULL argument");
  *out = NULL;
  fg_checkpoint *checkpoint = fg__allocate(1, sizeof *checkpoint);
  if (!checkpoint)
    return fg__fail_memory(context, "a checkpoint", sizeof *checkpoint);
  checkpoint->file.file = -1;
  fg_status status = open_newest(checkpoint, context, path);
  if (status) {
    fg_checkpoint_destroy(checkpoint);
    return status;
  }
  const char *end = strstr(checkpoint->file.text, "\n\n");
  checkpoint->note = end ? end + 2 : "";
  *out = checkpoint;
  return FG_STATUS_OK;
}

void fg_checkpoint_destroy(fg_checkpoint *checkpoint)
{
  if (!checkpoint)
    return;
  fg__checkpoint_close(&checkpoint->file);
  free(checkpoint);
}

const char *fg_checkpoint_note(const fg_checkpoint *checkpoint)
{
  return checkpoint->note;
}

const char *fg_checkpoint_damage(const fg_checkpoint *checkpoint)
{
  return checkpoint->damage;
}

static fg_status check_version(const fg__checkpoint_file *file, fg_context *context)
{
  size_t length = 0;
  const char *version = fg__value_find(file->text, "version", &length);
  const char *own = fg_version();
  if (version && length == strlen(own) && strncmp(version, own, length) == 0)
    return FG_STATUS_OK;
  return fg__fail(context, FG_STATUS_UNSUPPORTED,
                  "%s: was written by version %.*s; this is version %s", file->path,
                  (int)length, version ? version : "", own);
}

static fg_status check_parameters(const fg_evolution *e, const fg__checkpoint_file *file)
{
  parameters own = parameters_of(e), theirs;
  fg_status status = fg__values_scan(file->text, file->path, e->context, parameter_values,
                                     PARAMETERS, &theirs);
  if (status)
    return status;
  const fg__named_value *differs =
      fg__values_difference(parameter_values, PARAMETERS, &own, &theirs);
  if (!differs)
    return FG_STATUS_OK;
  char one[FG__VALUE_TEXT_BYTES], other[FG__VALUE_TEXT_BYTES];
  fg__value_describe(one, differs, &theirs);
  fg__value_describe(other, differs, &own);
  const char *kind = differs->kind == FG__VALUE_BITS ? "another " : "";
  fg__fail(e->context, FG_STATUS_ARGUMENT, "%s: belongs to a run with %s%s: %s, not %s",
           file->path, kind, differs->name, one, other);
  fg__hint(e->context, "Take the same field and options, or start anew.");
  return FG_STATUS_ARGUMENT;
}

static fg_status load_arrays(fg_evolution *e, const fg__checkpoint_file *file)
{
  fg__state_array arrays[FG__STATE_ARRAYS];
  fg__stepper_arrays(&e->stepper, arrays);
  size_t count = node_count(arrays[0].level);
  float *plain = fg__allocate(count, sizeof *plain);
  if (!plain)
    return fg__fail_memory(e->context, "a checkpoint", count * sizeof *plain);
  fg_status status = FG_STATUS_OK;
  for (int n = 0; !status && n < FG__STATE_ARRAYS; ++n) {
    fg__box_record box;
    set_box(&box, e, &arrays[n]);
    status = fg__checkpoint_read_box(file, e->context, box.array, box.grid, box.first,
                                     box.nodes, plain);
    if (!status)
      fg__level_import(arrays[n].level, arrays[n].values, plain);
  }
  free(plain);
  return status;
}

fg_status fg_evolution_resume(fg_evolution *evolution, fg_step *step,
                              const fg_checkpoint *checkpoint)
{
  fg_evolution *e = evolution;
  const fg__checkpoint_file *file = &checkpoint->file;
  counts counted;
  if (e->spread)
    return fg__fail(e->context, FG_STATUS_UNSUPPORTED,
                    "%s: a run is resumed on one rank only, not on %d", file->path,
                    e->mesh.ranks->count);
  fg_status status = check_version(file, e->context);
  if (!status)
    status = check_parameters(e, file);
  if (!status)
    status = fg__values_scan(file->text, file->path, e->context, fg__stepper_values,
                             fg__stepper_value_count, &e->stepper);
  if (!status)
    status = fg__values_scan(file->text, file->path, e->context, count_values, COUNTS,
                             &counted);
  if (!status)
    status = load_arrays(e, file);
  if (status)
    return status;
  e->area_fraction = counted.area_fraction;
  e->clusters = counted.clusters;
  e->counting = counted.counting;
  e->earlier_seconds = counted.seconds;
  *step = fg__evolution_describe(e, 0, 0);
  return FG_STATUS_OK;
}
