/* The main job: read, evolve, take scales, draw them, and leave a folder of results. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "background.h"
#include "checkpoint.h"
#include "coarser.h"
#include "ending.h"
#include "folder.h"
#include "input.h"
#include "interrupt.h"
#include "made.h"
#include "moment.h"
#include "past_run.h"
#include "placing.h"
#include "ranks.h"
#include "traffic.h"

/* Whether there is anything to do, and whether it may be done. *done: a finished run,
 * which --resume leaves as it is. */
static int decide(const cli_run *run, const output_contents *there, bool *done)
{
  const cli_settings *said = run->settings;
  const output_state state = there->state;
  *done = false;
  if (there->foreign[0])
    return made_complain(said->output, there->foreign);
  if (said->force || state == OUTPUT_EMPTY)
    return EXIT_DONE;
  if (said->resume && state == OUTPUT_FINISHED) {
    *done = true;
    return report_is_of(said->output, said) ? EXIT_DONE : EXIT_FAILED;
  }
  if (said->resume)
    return EXIT_DONE;
  complain("%s: holds %s", said->output,
           state == OUTPUT_UNFINISHED ? "a run that can go on" : "the results of a run");
  advise("Choose another folder with -o, or replace its results with --force%s.",
         state == OUTPUT_UNFINISHED ? ", or go on with --resume" : "");
  return EXIT_FAILED;
}

static int look(const cli_run *run, output_contents *there, bool *done)
{
  int code = output_look(there, run->settings->output);
  if (!code)
    code = decide(run, there, done);
  return code || *done ? code : made_check_inputs(run->settings, run->settings->output);
}

static int start_anew(cli_run *run)
{
  const cli_settings *said = run->settings;
  if (said->resume && !said->quiet)
    fprintf(stderr, "flowgrain: %s: no checkpoint: the run starts from the beginning\n",
            said->output);
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
    fprintf(stderr, "flowgrain: %s: goes on from step %ld, t = %.3g, after %.0f s\n",
            run->settings->output, run->step.step, run->step.time, run->earlier_total);
  return EXIT_DONE;
}

/* Of rank 0. *goes_on: from the checkpoint that is there. */
static int open_results(cli_run *run, bool *done, bool *goes_on)
{
  int code = output_open(&run->output, run->settings->output);
  if (code)
    return code;
  /* once more, as another run may have ended here since */
  output_contents there;
  code = look(run, &there, done);
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

static int record_step(cli_run *run, const fg_step *before)
{
  const fg_step *step = &run->step;
  const fg_mesh_info *mesh = &run->facts.mesh;
  run->facts.accepted = step->step;
  run->facts.rejected += step->rejected;
  if (before->step && step->energy > before->energy)
    run->facts.energy_monotone = false;
  /* masses are in units of the longest side; the initial one is known by construction */
  double measure = mesh->domain_measure / pow(mesh->length, mesh->dimension);
  double drift = fabs(step->mass / measure - (2.0 * mesh->coverage - 1.0));
  if (drift > run->facts.mass_drift)
    run->facts.mass_drift = drift;
  if (step->clusters && !run->first_counted.step)
    run->first_counted = *step;
  return ranks_leader() ? table_add(&run->table, step) : EXIT_DONE;
}

/* Collective; rank 0 draws what all made of the density together. */
static int take_scale(cli_run *run, const int *wanted, int wanted_count)
{
  scale_moment moment;
  int code = moment_take(&moment, run);
  if (code)
    return code;
  run->last_scale_clusters = run->step.clusters;
  if (!ranks_leader())
    return ranks_agree(EXIT_DONE);
  if (run->settings->verbose) {
    progress_wipe(&run->progress);
    fprintf(stderr, "flowgrain: scale %02d: step %ld, t = %.3e, %d clusters, %.2f s\n",
            drawing_count(run->drawing), run->step.step, run->step.time,
            run->step.clusters, run->step.seconds);
  }
  /* a failure of the drawing is complained of where the run ends */
  bool added = drawing_add(run->drawing, &moment, wanted, wanted_count);
  return ranks_agree(added ? EXIT_DONE : EXIT_FAILED);
}

/* The scales that a state answers: one of all numbers, or where arrows are placed one of
 * each. Collective. */
static int take_scales(cli_run *run, int reached)
{
  const int *wanted = &run->plan.wanted[run->plan.next - reached];
  if (!run->plan.placed)
    return take_scale(run, wanted, reached);
  int code = EXIT_DONE;
  for (int k = 0; k < reached && !code; ++k)
    code = take_scale(run, &wanted[k], 1);
  return code;
}

/* Where a run ends before its last scale it still shows how far it came; placed arrows
 * can be as few as is wanted all the same, even where no cluster has room. Collective. */
static int take_last(cli_run *run)
{
  bool settled = strcmp(run->facts.ended, "stationary") == 0;
  if (scale_plan_done(&run->plan) ||
      (!run->step.clusters && !(run->plan.placed && settled)))
    return EXIT_DONE;
  if (run->plan.placed) {
    int left = run->plan.count - run->plan.next;
    if (strcmp(run->facts.ended, "interrupted") == 0)
      return EXIT_DONE;
    run->plan.next = run->plan.count;
    return take_scales(run, left);
  }
  return run->last_scale_clusters == run->step.clusters ? EXIT_DONE
                                                        : take_scale(run, NULL, 0);
}

static const char *reason_to_stop(const cli_run *run)
{
  const cli_settings *said = run->settings;
  if (scale_plan_done(&run->plan))
    return "scales";
  if (said->max_time > 0.0 && run->step.time >= said->max_time)
    return "time";
  if (said->max_steps && run->step.step >= said->max_steps)
    return "steps";
  if (run->step.stationary)
    return "stationary";
  return NULL;
}

static void show_progress(cli_run *run)
{
  const fg_step *step = &run->step, *first = &run->first_counted;
  double left = -1.0;
  if (first->step)
    left = scale_plan_seconds_left(&run->plan, step->clusters, step->time, step->seconds,
                                   first->time, first->seconds);
  double share = scale_plan_share(&run->plan, first->clusters, step->clusters);
  progress_evolution(&run->progress, share, step->time, step->clusters, left);
}

static int advance(cli_run *run)
{
  /* before a step, not after: a checkpoint holds what the next step begins with */
  int code = coarser_when_ample(run);
  if (code)
    return code;
  fg_step before = run->step;
  fg_status status = fg_evolution_step(run->evolution, &run->step);
  if (status == FG_STATUS_STOPPED) {
    fg_context_clear(run->context);
    run->step = before;
    run->facts.ended = "interrupted";
    return EXIT_DONE;
  }
  if (status) {
    progress_wipe(&run->progress);
    return complain_of(run->context, status, run->settings->operand);
  }
  code = ranks_agree(record_step(run, &before));
  int reached = scale_plan_reach(&run->plan, run->step.clusters);
  if (!code && reached)
    code = take_scales(run, reached);
  run->facts.ended = reason_to_stop(run);
  return code;
}

static int evolve(cli_run *run)
{
  int code = EXIT_DONE;
  run->evolving_since = run->save_tried = clock_seconds();
  if (run->step.step) /* resumed, perhaps at its end */
    run->facts.ended = reason_to_stop(run);
  while (!code && !run->facts.ended) {
    code = advance(run);
    if (!code && !run->facts.ended && checkpoint_is_due(run))
      code = checkpoint_save(run);
    show_progress(run);
  }
  bool interrupted = !code && strcmp(run->facts.ended, "interrupted") == 0;
  if (!code && run->step.step && ending_can_go_on(run) &&
      (interrupted || run->step.clusters))
    code = checkpoint_save(run);
  if (!code)
    code = take_last(run);
  run->facts.seconds_evolve = run->earlier_evolve + clock_seconds() - run->evolving_since;
  return code;
}

/* Every rank finds the same number of arrows. */
static int plan_scales(cli_run *run)
{
  const cli_settings *said = run->settings;
  int dimension = fg_field_contents(run->field)->dimension;
  if (said->tolerance > 0.0) {
    int count = 0;
    progress_stage(&run->progress, "counting arrows");
    int code = ranks_agree(placing_find_count(&count, run->context, said, run->field));
    progress_wipe(&run->progress);
    scale_plan_start_placed(&run->plan, &count, 1, dimension);
    return code;
  }
  if (settings_place(said))
    scale_plan_start_placed(&run->plan, said->arrows, said->arrow_count, dimension);
  return EXIT_DONE;
}

/* All ranks read; rank 0 sees to the results' folder. *done: nothing is left to do. */
static int prepare(cli_run *run, bool *done)
{
  output_contents there;
  int code = EXIT_DONE;
  run->checkpoint = output_checkpoint_path(run->settings->output);
  if (!run->checkpoint) {
    complain("out of memory for a file's name");
    code = EXIT_FAILED;
  }
  if (!code && ranks_leader()) {
    code = output_check(run->settings->output);
    if (!code)
      code = look(run, &there, done);
  }
  /* before the reading: a finished run does not need its input any more */
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
  code = plan_scales(run);
  if (code)
    return code;
  run->facts.seconds_read = clock_seconds() - run->start;
  return input_create_evolution(run);
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
    run->finished = true; /* what its end left undone is done where this one ends */
    if (ranks_leader())
      fprintf(stderr, "flowgrain: %s: the run is finished\n", run->settings->output);
    return EXIT_DONE;
  }
  if (!code && ranks_any(goes_on))
    code = go_on(run);
  if (code)
    return code;
  code = evolve(run);
  if (code && ranks_leader() && drawing_failed(run->drawing))
    return ending_draw(run);
  if (code)
    return code;
  traffic_collect(&run->facts, run->evolution);
  if (run->settings->verbose && ranks_leader()) {
    progress_wipe(&run->progress);
    traffic_print(&run->facts);
  }
  return ranks_agree(ranks_leader() ? ending_finish(run) : EXIT_DONE);
}

int command_run(const cli_settings *settings)
{
  cli_run run = {.settings = settings,
                 .start = clock_seconds(),
                 .output = {.lock = -1},
                 .table = {.file = -1}};
  run.facts.settings = settings;
  run.facts.energy_monotone = true;
  scale_plan_start(&run.plan, settings->clusters, settings->cluster_count);
  progress_start(&run.progress, settings->quiet || !ranks_leader());
  if (fg_context_create(&run.context)) {
    complain("out of memory");
    return EXIT_FAILED;
  }
  int code = ranks_share(run.context);
  interrupt_start(run.context);
  if (!code)
    code = background_check(settings, ranks_count());
  if (!code)
    code = work(&run);
  interrupt_end();
  progress_wipe(&run.progress);
  drawing_destroy(run.drawing);
  table_close(&run.table);
  bool resumable = output_close(&run.output, run.finished);
  ending_advise(&run, code, resumable);
  fg_evolution_destroy(run.evolution);
  fg_tensors_destroy(run.tensors);
  fg_field_destroy(run.field);
  fg_context_destroy(run.context);
  free(run.checkpoint);
  return code;
}
