#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "evolution/checkpoint/file.h"
#include "evolution/checkpoint/stepper_state.h"
#include "evolution/evolution.h"

enum { DAMAGE_BYTES = 2048 };

struct fg_checkpoint {
  const fg__ranks *ranks; /* that have opened it */
  fg__checkpoint_file file;
  const char *note; /* within the file's text */
  char damage[DAMAGE_BYTES];
};

/* What has to agree between an evolution and a checkpoint. */
typedef struct parameters {
  uint64_t field, initial, law, seed;
  int energy, nodes, coarsenings, cells[3], cycles, scheme;
  double anisotropy, isotropic_below, coverage, noise, gamma, accuracy;
  double residual, theta, alpha;
} parameters;

/* In the order in which a difference is reported: first what follows from nothing else.
 */
static const fg__named_value parameter_values[] = {
    {"nodes", FG__VALUE_INTEGER, offsetof(parameters, nodes)},
    {"energy", FG__VALUE_INTEGER, offsetof(parameters, energy)},
    {"law", FG__VALUE_BITS, offsetof(parameters, law)},
    {"anisotropy", FG__VALUE_REAL, offsetof(parameters, anisotropy)},
    {"isotropic-below", FG__VALUE_REAL, offsetof(parameters, isotropic_below)},
    {"coverage", FG__VALUE_REAL, offsetof(parameters, coverage)},
    {"seed", FG__VALUE_COUNT, offsetof(parameters, seed)},
    {"noise", FG__VALUE_REAL, offsetof(parameters, noise)},
    {"accuracy", FG__VALUE_REAL, offsetof(parameters, accuracy)},
    {"cycles", FG__VALUE_INTEGER, offsetof(parameters, cycles)},
    {"residual", FG__VALUE_REAL, offsetof(parameters, residual)},
    {"scheme", FG__VALUE_INTEGER, offsetof(parameters, scheme)},
    {"theta", FG__VALUE_REAL, offsetof(parameters, theta)},
    {"alpha", FG__VALUE_REAL, offsetof(parameters, alpha)},
    {"field", FG__VALUE_BITS, offsetof(parameters, field)},
    {"initial", FG__VALUE_BITS, offsetof(parameters, initial)},
    {"halvings", FG__VALUE_INTEGER, offsetof(parameters, coarsenings)},
    {"gamma", FG__VALUE_REAL, offsetof(parameters, gamma)},
    {"cells-x", FG__VALUE_INTEGER, offsetof(parameters, cells[0])},
    {"cells-y", FG__VALUE_INTEGER, offsetof(parameters, cells[1])},
    {"cells-z", FG__VALUE_INTEGER, offsetof(parameters, cells[2])},
};
enum {
  PARAMETERS = sizeof parameter_values / sizeof parameter_values[0],
  MESH_PARAMETERS = 5 /* the last of them, which a halving changes */
};

/* The evolution's own state, beside the stepper's. */
typedef struct counts {
  double area_fraction, seconds;
  int64_t earlier_steps;
  int clusters;
  bool counting;
} counts;

static const fg__named_value count_values[] = {
    {"evolution.area_fraction", FG__VALUE_REAL, offsetof(counts, area_fraction)},
    {"evolution.clusters", FG__VALUE_INTEGER, offsetof(counts, clusters)},
    {"evolution.counting", FG__VALUE_FLAG, offsetof(counts, counting)},
    {"evolution.earlier_steps", FG__VALUE_INT64, offsetof(counts, earlier_steps)},
    {"evolution.seconds", FG__VALUE_REAL, offsetof(counts, seconds)},
};
enum { COUNTS = sizeof count_values / sizeof count_values[0] };

static parameters parameters_of(const fg_evolution *e)
{
  return (parameters){.field = e->field_fingerprint,
                      .initial = e->initial_fingerprint,
                      .law = e->law_identity,
                      .seed = e->options.seed,
                      .energy = (int)e->options.energy,
                      .nodes = e->options.nodes,
                      .coarsenings = e->coarsenings,
                      .cells = {e->info.cells[0], e->info.cells[1], e->info.cells[2]},
                      .cycles = e->options.cycles,
                      .scheme = (int)e->options.scheme,
                      .anisotropy = e->options.anisotropy,
                      .isotropic_below = e->options.isotropic_below,
                      .coverage = e->options.coverage,
                      .noise = e->options.noise,
                      .gamma = e->info.gamma,
                      .accuracy = e->options.accuracy,
                      .residual = e->options.residual,
                      .theta = e->options.theta,
                      .alpha = e->options.alpha};
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
                    .earlier_steps = e->earlier_steps,
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

/* Room for the values of this rank's block of any array. NULL without memory. */
static float *plain_block(const fg_evolution *e,
                          const fg__state_array arrays[FG__STATE_ARRAYS])
{
  size_t most = 0;
  for (int n = 0; n < FG__STATE_ARRAYS; ++n) {
    size_t count = (size_t)fg__box_count(&arrays[n].block);
    most = count > most ? count : most;
  }
  float *plain = fg__allocate(most, sizeof *plain);
  if (!plain)
    fg__fail_memory(e->context, "a checkpoint", most * sizeof *plain);
  return plain;
}

/* A checkpoint while it is written. */
typedef struct saving {
  const fg_evolution *e;
  fg__stepper stepper; /* its arrays are only read */
  fg__state_array array[FG__STATE_ARRAYS];
  fg__box_record record[FG__STATE_ARRAYS];
  float *plain;
  char *text; /* of rank 0 */
  fg__checkpoint_writer writer;
} saving;

static bool leads(const fg_evolution *e)
{
  return e->ranks->rank == 0;
}

static fg_status prepare(saving *s, const fg_evolution *e, const char *note)
{
  *s = (saving){.e = e, .stepper = e->stepper};
  fg__stepper_arrays(&s->stepper, s->array);
  for (int n = 0; n < FG__STATE_ARRAYS; ++n) {
    fg__box_record *record = &s->record[n];
    record->grid = s->array[n].grid;
    record->box = s->array[n].whole;
    snprintf(record->array, sizeof record->array, "%s", s->array[n].name);
  }
  fg__checkpoint_place(s->record, FG__STATE_ARRAYS);
  s->plain = plain_block(e, s->array);
  if (!s->plain)
    return FG_STATUS_MEMORY;
  if (!leads(e))
    return FG_STATUS_OK;
  s->text = describe(e, note);
  if (s->text)
    return FG_STATUS_OK;
  return fg__fail(e->context, FG_STATUS_MEMORY, "out of memory for a checkpoint's text");
}

/* The values of this rank's blocks. */
static fg_status write_values(saving *s)
{
  fg_status status = FG_STATUS_OK;
  for (int n = 0; n < FG__STATE_ARRAYS && !status; ++n) {
    fg__state_export(&s->array[n], s->plain);
    status = fg__checkpoint_write(&s->writer, s->e->context, &s->record[n],
                                  &s->array[n].block, s->plain);
  }
  return status;
}

/* Rank 0 creates the file, all write their parts of it, and rank 0 commits it when no
 * rank has failed. */
static fg_status write_together(saving *s, const char *path)
{
  const fg_evolution *e = s->e;
  fg_status status = FG_STATUS_OK;
  if (leads(e))
    status = fg__checkpoint_begin(&s->writer, e->context, path, true);
  status = fg__ranks_agree(e->ranks, e->context, status);
  if (status)
    return status;
  if (!leads(e))
    status = fg__checkpoint_begin(&s->writer, e->context, path, false);
  bool begun = !status;
  if (begun)
    status = write_values(s);
  if (begun && !leads(e))
    status = fg__checkpoint_end_share(&s->writer, e->context, status);
  status = fg__ranks_agree(e->ranks, e->context, status);
  fg__checkpoint_settle(s->record, FG__STATE_ARRAYS, e->ranks);
  if (leads(e))
    status = fg__checkpoint_commit(&s->writer, e->context, s->text, s->record,
                                   FG__STATE_ARRAYS, status);
  return fg__ranks_agree(e->ranks, e->context, status);
}

fg_status fg_evolution_save(const fg_evolution *evolution, const char *path,
                            const char *note)
{
  const fg_evolution *e = evolution;
  saving s;
  fg_status status = fg__ranks_agree(e->ranks, e->context, prepare(&s, e, note));
  if (!status)
    status = write_together(&s, path);
  free(s.plain);
  free(s.text);
  return status;
}

/* Ranks on machines of their own may find different files under one name. */
static fg_status check_same_file(const fg__checkpoint_file *file, fg_context *context,
                                 const fg__ranks *ranks)
{
  fg_status status = FG_STATUS_OK;
  if (!fg__ranks_alike(ranks, file->identity))
    status = fg__fail(context, FG_STATUS_FILE_ACCESS,
                      "%s: cannot be read: the %d ranks find different files", file->path,
                      ranks->count);
  return fg__ranks_agree(ranks, context, status);
}

static fg_status open_checked(fg__checkpoint_file *out, fg_context *context,
                              const char *path, const fg__ranks *ranks)
{
  fg_status status = fg__checkpoint_read(out, context, path);
  status = fg__ranks_agree(ranks, context, status);
  if (!status)
    status = check_same_file(out, context, ranks);
  if (!status)
    status = fg__checkpoint_verify(out, context, ranks);
  if (status)
    fg__checkpoint_close(out);
  return status;
}

/* The newest that is whole. When neither is, the failure is the newest one's; `newest`
 * and `older` take what is said of them. */
static fg_status open_newest(fg_checkpoint *checkpoint, const char *path,
                             const char *previous, fg_context *newest, fg_context *older)
{
  const fg__ranks *ranks = checkpoint->ranks;
  fg_status status = open_checked(&checkpoint->file, newest, path, ranks);
  if (!status || status == FG_STATUS_MEMORY)
    return status;
  if (open_checked(&checkpoint->file, older, previous, ranks))
    return status;
  snprintf(checkpoint->damage, sizeof checkpoint->damage, "%s",
           fg_context_message(newest));
  return FG_STATUS_OK;
}

/* What has to be had before the ranks open a file together. */
typedef struct opening {
  fg_checkpoint *checkpoint;
  char *previous;
  fg_context *newest, *older;
} opening;

static fg_status begin_opening(opening *o, fg_context *context, const char *path)
{
  size_t bytes = strlen(path) + sizeof ".previous";
  *o = (opening){.checkpoint = fg__allocate(1, sizeof *o->checkpoint),
                 .previous = fg__allocate(bytes, 1)};
  if (!o->checkpoint || !o->previous || fg_context_create(&o->newest) ||
      fg_context_create(&o->older))
    return fg__fail_memory(context, "a checkpoint", sizeof *o->checkpoint);
  o->checkpoint->file.file = -1;
  snprintf(o->previous, bytes, "%s.previous", path);
  return FG_STATUS_OK;
}

static void end_opening(opening *o)
{
  fg_context_destroy(o->newest);
  fg_context_destroy(o->older);
  free(o->previous);
}

fg_status fg_checkpoint_open(fg_checkpoint **out, fg_context *context, const char *path)
{
  if (!out || !path)
    return fg__fail(context, FG_STATUS_ARGUMENT, "checkpoint: a NULL argument");
  *out = NULL;
  return fg__checkpoint_open(out, context, path, fg__ranks_of(context));
}

fg_status fg__checkpoint_open(fg_checkpoint **out, fg_context *context, const char *path,
                              const fg__ranks *ranks)
{
  *out = NULL;
  opening o;
  fg_status status = fg__ranks_agree(ranks, context, begin_opening(&o, context, path));
  if (!status) {
    o.checkpoint->ranks = ranks;
    status = open_newest(o.checkpoint, path, o.previous, o.newest, o.older);
    if (status)
      fg__fail(context, status, "%s", fg_context_message(o.newest));
  }
  end_opening(&o);
  if (status) {
    free(o.checkpoint);
    return status;
  }
  const char *end = strstr(o.checkpoint->file.text, "\n\n");
  o.checkpoint->note = end ? end + 2 : "";
  *out = o.checkpoint;
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

/* How often the mesh has been coarsened. */
static int coarsenings_of(const fg_checkpoint *checkpoint)
{
  size_t length;
  const char *value = fg__value_find(checkpoint->file.text, "halvings", &length);
  int64_t number = value ? strtol(value, NULL, 10) : 0;
  return number > 0 && number < 32 ? (int)number : 0;
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

/* The first `count` parameters agree. */
static fg_status check_parameters(const fg_evolution *e, const fg__checkpoint_file *file,
                                  size_t count)
{
  parameters own = parameters_of(e), theirs;
  fg_status status = fg__values_scan(file->text, file->path, e->context, parameter_values,
                                     count, &theirs);
  if (status)
    return status;
  const fg__named_value *differs =
      fg__values_difference(parameter_values, count, &own, &theirs);
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

/* This rank's blocks, without ghosts. */
static fg_status load_blocks(const fg_evolution *e, const fg__checkpoint_file *file,
                             const fg__state_array arrays[FG__STATE_ARRAYS])
{
  float *plain = plain_block(e, arrays);
  if (!plain)
    return FG_STATUS_MEMORY;
  fg_status status = FG_STATUS_OK;
  for (int n = 0; n < FG__STATE_ARRAYS && !status; ++n) {
    status = fg__checkpoint_read_box(file, e->context, arrays[n].name, arrays[n].grid,
                                     &arrays[n].block, plain);
    if (!status)
      fg__state_import(&arrays[n], plain);
  }
  free(plain);
  return status;
}

static fg_status load(fg_evolution *e, counts *counted, const fg__checkpoint_file *file)
{
  fg_status status = check_version(file, e->context);
  if (!status)
    status = check_parameters(e, file, PARAMETERS);
  if (!status)
    status = fg__values_scan(file->text, file->path, e->context, fg__stepper_values,
                             fg__stepper_value_count, &e->stepper);
  if (!status)
    status = fg__values_scan(file->text, file->path, e->context, count_values, COUNTS,
                             counted);
  fg__state_array arrays[FG__STATE_ARRAYS];
  fg__stepper_arrays(&e->stepper, arrays);
  if (!status)
    status = load_blocks(e, file, arrays);
  status = fg__ranks_agree(e->ranks, e->context, status);
  if (!status)
    status = fg__checkpoint_check(file, e->context, e->ranks);
  for (int n = 0; !status && n < FG__STATE_ARRAYS; ++n)
    fg__state_fill_ghosts(&arrays[n]);
  if (!status && e->coarsenings > 0)
    fg__stepper_hold_means(&e->stepper);
  return status;
}

/* Whether it is of the same field and options, however often its mesh was coarsened. */
static fg_status check_origin(const fg_evolution *e, const fg_checkpoint *checkpoint)
{
  fg_status status = check_version(&checkpoint->file, e->context);
  if (!status)
    status = check_parameters(e, &checkpoint->file, PARAMETERS - MESH_PARAMETERS);
  return status;
}

fg_status fg_evolution_resume(fg_evolution *evolution, fg_step *step,
                              const fg_checkpoint *checkpoint)
{
  fg_evolution *e = evolution;
  counts counted;
  /* another field's mesh may not be one to be coarsened */
  fg_status status = fg__ranks_agree(e->ranks, e->context, check_origin(e, checkpoint));
  for (int n = coarsenings_of(checkpoint) - e->coarsenings; !status && n > 0; --n)
    status = fg__evolution_coarsen_mesh(e);
  e->has_coarsening = false;
  if (!status)
    status = load(e, &counted, &checkpoint->file);
  if (status)
    return status;
  e->area_fraction = counted.area_fraction;
  e->clusters = counted.clusters;
  e->counting = counted.counting;
  e->earlier_steps = counted.earlier_steps;
  e->earlier_seconds = counted.seconds;
  *step = fg__evolution_describe(e, 0, 0);
  return FG_STATUS_OK;
}
