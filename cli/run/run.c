/* The command `run`: read, evolve, take snapshots, draw them, write a folder of
 * results. */
#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "command/command.h"
#include "drawn/background.h"
#include "folder/files.h"
#include "folder/made.h"
#include "inputs.h"
#include "interrupt.h"
#include "ranks.h"
#include "report/coarsening.h"
#include "report/communication.h"
#include "report/past_run.h"
#include "run/checkpoint.h"
#include "run/evolving.h"
#include "run/finish.h"
#include "run/input.h"
#include "run/placing.h"
#include "run/snapshot.h"
#include "series/series.h"

/* Whether the run may start. *done: --resume found a finished run, which stays as it
 * is. */
static int decide(const cli_run *run, const output_contents *there, bool *done)
{
  const run_settings *settings = run->settings;
  const output_state state = there->state;
  *done = false;
  if (there->foreign[0])
    return made_complain(settings->output, there->foreign);
  if (settings->force || state == OUTPUT_EMPTY)
    return EXIT_DONE;
  if (settings->resume && state == OUTPUT_FINISHED) {
    *done = true;
    return report_is_of(settings->output, settings) ? EXIT_DONE : EXIT_FAILED;
  }
  if (settings->resume)
    return EXIT_DONE;
  complain("%s: holds %s", settings->output,
           state == OUTPUT_UNFINISHED ? "a run that can go on" : "the results of a run");
  advise("Choose another folder with -o, or replace its results with --force%s.",
         state == OUTPUT_UNFINISHED ? ", or go on with --resume" : "");
  return EXIT_FAILED;
}

static int check_inputs(const run_settings *settings)
{
  const char *const inputs[] = {settings->reading.input, settings->reading.vars_from,
                                settings->reading.mesh_from, settings->evolution.energy};
  return made_check_inputs(settings->output, inputs, 4);
}

static int inspect_folder(const cli_run *run, output_contents *there, bool *done)
{
  int code = output_inspect(there, run->settings->output);
  if (!code)
    code = decide(run, there, done);
  return code || *done ? code : check_inputs(run->settings);
}

static int start_anew(cli_run *run)
{
  const run_settings *settings = run->settings;
  if (settings->resume && !settings->quiet && !settings->member)
    fprintf(stderr, "flowgrain: %s: no checkpoint: the run starts from the beginning\n",
            settings->output);
  int code = output_start_anew(&run->output);
  return code ? code : table_start(&run->table, output_path(&run->output, TABLE_NAME));
}

static int go_on(cli_run *run)
{
  int code = checkpoint_resume(run);
  if (code)
    return code;
  run->saved_step = run->step.step;
  if (!run->settings->quiet && ranks_leader())
    fprintf(stderr,
            "flowgrain: %s: goes on from step %" PRId64 ", t = %.3g, after %.0f s\n",
            run->settings->output, run->step.step, run->step.time, run->earlier_total);
  return EXIT_DONE;
}

/* On rank 0. *goes_on: resume from the checkpoint. */
static int open_results(cli_run *run, bool *done, bool *goes_on)
{
  int code = output_open(&run->output, run->settings->output);
  if (code)
    return code;
  /* again, under the lock */
  output_contents there;
  code = inspect_folder(run, &there, done);
  if (code || *done)
    return code;
  code = drawing_start(&run->drawing, run->settings, run->field, &run->output);
  run->facts.drawing = run->drawing;
  if (code)
    return code;
  interrupt_second(drawing_context(run->drawing));
  *goes_on = run->settings->resume && there.state == OUTPUT_UNFINISHED;
  return *goes_on ? EXIT_DONE : start_anew(run);
}

/* A coarsening before the step may have changed the energy, and with missing values the
 * domain's measure. */
static int record_step(cli_run *run, const fg_step *before)
{
  const fg_step *step = &run->step;
  const fg_mesh_info *mesh = fg_evolution_mesh(fg_run_evolution(run->scales));
  double energy = before->energy;
  if (step->coarsenings > before->coarsenings)
    energy = coarsening_record(run)->energy_after;
  run->facts.accepted = step->step;
  run->facts.rejected += step->rejected;
  if (before->step && step->energy > energy)
    run->facts.energy_monotone = false;
  /* masses are in units of the longest side; the mean is known exactly */
  double measure = mesh->domain_measure / pow(mesh->length, mesh->dimension);
  double drift = fabs(step->mass / measure - (2.0 * mesh->coverage - 1.0));
  if (drift > run->facts.mass_drift)
    run->facts.mass_drift = drift;
  if (step->residual > run->facts.largest_residual)
    run->facts.largest_residual = step->residual;
  return ranks_leader() ? table_add(&run->table, step) : EXIT_DONE;
}

/* Collective; rank 0 draws what all have made of the density. */
static int draw_scale(cli_run *run, const fg_run_scale *scale)
{
  scale_snapshot snapshot;
  int code = snapshot_take(&snapshot, run);
  if (code)
    return code;
  if (!ranks_leader())
    return ranks_agree(EXIT_DONE);
  if (run->settings->verbose) {
    progress_wipe(&run->progress);
    fprintf(stderr,
            "flowgrain: scale %02d: step %" PRId64 ", t = %.3e, %d clusters, %.2f s\n",
            scale->index, run->step.step, run->step.time, run->step.clusters,
            run->step.seconds);
  }
  /* a failed drawing is reported at the end of the run; scales of the last state are
   * drawn after the evolution is freed */
  bool added = drawing_add(run->drawing, &snapshot, scale->wanted,
                           scale->wanted ? scale->wanted_count : 0) &&
               (fg_run_ended(run->scales) || drawing_keep_up(run->drawing));
  return ranks_agree(added ? EXIT_DONE : EXIT_FAILED);
}

/* Takes the scales that the current state provides. Collective. */
static int draw_scales(cli_run *run)
{
  int code = EXIT_DONE;
  fg_run_scale scale;
  while (!code && fg_run_take(&scale, run->scales))
    code = draw_scale(run, &scale);
  return code;
}

static void show_progress(cli_run *run)
{
  double share, left;
  fg_run_progress(&share, &left, run->scales);
  progress_evolution(&run->progress, share, run->step.time, run->step.clusters, left);
  evolving_show(run);
}

static int advance(cli_run *run)
{
  fg_step before = run->step;
  fg_status status = fg_run_step(&run->step, run->scales);
  if (status == FG_STATUS_STOPPED) {
    fg_context_clear(run->context);
    return EXIT_DONE;
  }
  if (status) {
    progress_wipe(&run->progress);
    return complain_of(run->context, status, run->settings->reading.input);
  }
  int code = ranks_agree(record_step(run, &before));
  return code ? code : draw_scales(run);
}

static int evolve(cli_run *run)
{
  int code = EXIT_DONE;
  run->evolving_since = run->save_tried = clock_seconds();
  while (!code && !fg_run_ended(run->scales)) {
    code = advance(run);
    if (!code && !fg_run_ended(run->scales) && checkpoint_is_due(run))
      code = checkpoint_save(run);
    show_progress(run);
  }
  run->facts.ended = fg_run_ended(run->scales);
  bool interrupted = run->facts.ended == FG_RUN_STOPPED;
  if (!code && run->step.step && finish_can_go_on(run) &&
      (interrupted || run->step.clusters || run->settings->times.count))
    code = checkpoint_save(run);
  if (!code) {
    fg_run_close(run->scales);
    code = draw_scales(run);
  }
  run->facts.seconds_evolve = run->earlier_evolve + clock_seconds() - run->evolving_since;
  return code;
}

/* Numbers of arrows or of clusters. For --tolerance every rank finds the same number of
 * arrows, and *found keeps it. */
static int choose_scales(cli_run *run, fg_run_options *out, int *found)
{
  const run_settings *settings = run->settings;
  int code = EXIT_DONE;
  *out = settings_run(settings);
  if (settings->tolerance > 0.0) {
    progress_stage(&run->progress, "counting arrows");
    code = ranks_agree(placing_find_count(found, run->context, settings, run->field));
    progress_wipe(&run->progress);
    out->numbers = found;
    out->count = 1;
  }
  return code;
}

/* All ranks read; rank 0 opens the results' folder. *done: there is nothing left to
 * do. */
static int prepare(cli_run *run, bool *done)
{
  output_contents there;
  int code = EXIT_DONE;
  run->checkpoint = output_checkpoint_path(run->settings->output);
  if (!run->checkpoint)
    code = complain_of_memory("a file's name");
  if (!code && ranks_leader()) {
    code = output_check(run->settings->output);
    if (!code)
      code = inspect_folder(run, &there, done);
  }
  /* before reading, as a finished run needs its input no more */
  code = ranks_agree(code);
  *done = ranks_any(*done);
  if (code || *done)
    return code;
  code = ranks_agree(input_read(run));
  if (code)
    return code;
  code = input_join(run);
  if (code)
    return code;
  fg_run_options scales;
  int found = 0;
  code = choose_scales(run, &scales, &found);
  if (code)
    return code;
  run->facts.seconds_read = clock_seconds() - run->start;
  return input_create_scales(run, &scales);
}

/* Frees the evolution, as drawing and writing can use its memory. */
static void end_evolution(cli_run *run)
{
  communication_collect(&run->facts, fg_run_evolution(run->scales));
  fg_run_describe(&run->record, run->scales);
  fg_run_destroy(run->scales);
  run->scales = NULL;
  fg_tensors_destroy(run->tensors);
  run->tensors = NULL;
}

static int work(cli_run *run)
{
  bool done = false, goes_on = false;
  int code = prepare(run, &done);
  if (code)
    return code;
  if (ranks_leader())
    code = done ? output_open(&run->output, run->settings->output)
                : open_results(run, &done, &goes_on);
  code = ranks_agree(code);
  done = ranks_any(done);
  if (!code && done) {
    run->finished = true; /* an earlier process may have missed clean-up */
    if (ranks_leader() && !run->settings->member)
      fprintf(stderr, "flowgrain: %s: the run is finished\n", run->settings->output);
    return EXIT_DONE;
  }
  if (!code && ranks_any(goes_on))
    code = go_on(run);
  if (code)
    return code;
  code = evolve(run);
  if (code && ranks_leader() && drawing_failed(run->drawing))
    return finish_drawing(run);
  if (code)
    return code;
  end_evolution(run);
  if (run->settings->verbose && ranks_leader()) {
    progress_wipe(&run->progress);
    communication_print(&run->facts);
  }
  return ranks_agree(ranks_leader() ? finish_run(run) : EXIT_DONE);
}

/* A run on one time and level. input: NULL, or the opened one, which is closed. */
static int run_once(const run_settings *settings, fg_input *input)
{
  cli_run run = {.settings = settings,
                 .input = input,
                 .start = clock_seconds(),
                 .output = {.lock = -1},
                 .table = {.file = -1}};
  run.facts.settings = settings;
  run.facts.energy_monotone = true;
  progress_start(&run.progress, settings->quiet || !ranks_leader(),
                 settings->progress_socket);
  if (fg_context_create(&run.context)) {
    complain("out of memory");
    return EXIT_FAILED;
  }
  inputs_give(run.context);
  int code = ranks_share(run.context);
  interrupt_start(run.context);
  if (!code)
    code = background_check(&settings->picture, ranks_count());
  if (!code)
    code = work(&run);
  interrupt_end();
  progress_wipe(&run.progress);
  drawing_destroy(run.drawing);
  table_close(&run.table);
  bool resumable = output_close(&run.output, run.finished);
  finish_advise(&run, code, resumable);
  fg_run_destroy(run.scales);
  fg_tensors_destroy(run.tensors);
  fg_field_destroy(run.field);
  fg_input_close(run.input);
  fg_context_destroy(run.context);
  free(run.checkpoint);
  return code;
}

static int run_member(const run_settings *settings)
{
  return run_once(settings, NULL);
}

int command_run(const void *given)
{
  run_settings settings = *(const run_settings *)given;
  chosen_places places;
  int code = ranks_agree(places_find(&places, &settings.reading, !ranks_leader()));
  if (!code && (places.time.several || places.level.several)) {
    code = series_run(&settings, &places, run_member);
  } else if (!code) {
    settings.reading.time = places.time.index[0];
    settings.reading.level = places.level.index[0];
    code = ranks_agree(ranks_leader() ? series_refuse(settings.output) : EXIT_DONE);
    if (!code) {
      code = run_once(&settings, places.input);
      places.input = NULL;
    }
  }
  places_clear(&places);
  return code;
}
