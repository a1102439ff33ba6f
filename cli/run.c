/* The main job: read, evolve, take scales, draw them, and leave a folder of results. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "background.h"
#include "checkpoint.h"
#include "folder.h"
#include "interrupt.h"
#include "moment.h"
#include "options.h"
#include "ranks.h"
#include "rehearse.h"
#include "traffic.h"

/* Each rank reads its part, but where icons are made of the whole density (moment.c). */
static int read_field(cli_run *run)
{
  const cli_settings *said = run->settings;
  const bool whole =
      said->tint || said->background || said->extent == FG_ICON_EXTENT_TERRITORY;
  const int part = whole ? 0 : ranks_number(), parts = whole ? 1 : ranks_count();
  progress_stage(&run->progress, "reading");
  fg_read_options reading = settings_reading(said);
  if (rehearse_reading_part(said->operand, &reading, part, parts))
    return EXIT_FAILED;
  fg_status status =
      fg_field_read_part(&run->field, run->context, said->operand, &reading, part, parts);
  progress_wipe(&run->progress);
  if (status)
    return complain_of(run->context, status, run->settings->operand);
  run->facts.field = run->field;
  return EXIT_DONE;
}

/* How many times and levels there were to choose from; nothing when that can't be said.
 */
static void count_choices(cli_run *run)
{
  const fg_field_arrays *field = fg_field_contents(run->field);
  if (!field->time && !field->level)
    return;
  fg_context *context;
  fg_inventory *inventory = NULL;
  if (fg_context_create(&context))
    return;
  if (!fg_inventory_read(&inventory, context, run->settings->operand))
    for (int k = 0; k < fg_inventory_vector_count(inventory); ++k) {
      const fg_inventory_vector *vector = fg_inventory_vector_at(inventory, k);
      if (vector->name[0] && strcmp(vector->name[0], field->velocity_name[0]) == 0) {
        run->facts.time_count = vector->times;
        run->facts.level_count = vector->levels;
        break;
      }
    }
  fg_inventory_destroy(inventory);
  fg_context_destroy(context);
}

static void say_choice(const char *file, const char *kind, int index, int count,
                       const char *words)
{
  if (count > 1)
    fprintf(stderr, "flowgrain: %s: %s %d of 0 to %d%s%s\n", file, kind, index, count - 1,
            words ? ": " : "", words ? words : "");
}

static void say_choices(const cli_run *run)
{
  const cli_settings *said = run->settings;
  const fg_field_arrays *field = fg_field_contents(run->field);
  say_choice(said->operand, "time", said->time, run->facts.time_count, field->time);
  say_choice(said->operand, "level", said->level, run->facts.level_count, field->level);
}

static const char *const scheme_names[] = {"BDF2", "implicit Euler", "theta"};

static void print_mesh(const fg_mesh_info *mesh, int scheme)
{
  fprintf(stderr, "flowgrain: mesh %d x %d", mesh->cells[0], mesh->cells[1]);
  if (mesh->dimension == 3)
    fprintf(stderr, " x %d", mesh->cells[2]);
  fprintf(stderr,
          " cells (%ld active), a = %g, coverage %g, gamma %g, %s scheme, %s kernel\n",
          mesh->active_cells, mesh->anisotropy, mesh->coverage, mesh->gamma,
          scheme_names[scheme], mesh->kernel);
}

/* What is wrong with all parts together. Collective. */
static int join_field(cli_run *run)
{
  fg_status status = fg_field_join(run->context, run->field);
  return status ? complain_of(run->context, status, run->settings->operand) : EXIT_DONE;
}

/* Of a file that says the energy; complains and returns the exit code. All ranks. */
static int read_energy(fg_tensors **out, const cli_run *run)
{
  const char *path = run->settings->energy;
  *out = NULL;
  if (energy_place(path) >= 0)
    return EXIT_DONE;
  int code = rehearse_reading(path, NULL);
  if (!code) {
    fg_status status = fg_tensors_read(out, run->context, path, run->field);
    code = status ? complain_of(run->context, status, path) : EXIT_DONE;
  }
  return ranks_agree(code);
}

static int create_evolution(cli_run *run)
{
  fg_evolution_options options = settings_evolution(run->settings);
  fg_tensors *tensors;
  int code = read_energy(&tensors, run);
  if (code) {
    fg_tensors_destroy(tensors);
    return code;
  }
  if (tensors)
    options.law = fg_tensors_law(tensors);
  fg_status status =
      fg_evolution_create(&run->evolution, run->context, run->field, &options);
  fg_tensors_destroy(tensors);
  if (status)
    return complain_of(run->context, status, run->settings->operand);
  const fg_mesh_info *mesh = fg_evolution_mesh(run->evolution);
  run->facts.mesh = mesh;
  if (run->settings->verbose && ranks_leader())
    print_mesh(mesh, run->settings->scheme);
  return EXIT_DONE;
}

/* Whether there is anything to do, and whether it may be done. `state` is what the
 * folder holds; *done: a finished run, which --resume leaves as it is. */
static int decide(const cli_run *run, output_state state, bool *done)
{
  const cli_settings *said = run->settings;
  *done = false;
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

static int look(const cli_run *run, output_state *state, bool *done)
{
  int code = output_look(state, run->settings->output);
  return code ? code : decide(run, *state, done);
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
  output_state state;
  code = look(run, &state, done);
  if (code || *done)
    return code;
  code = drawing_start(&run->drawing, run->settings, run->field, &run->output);
  run->facts.drawing = run->drawing;
  if (code)
    return code;
  interrupt_second(drawing_context(run->drawing));
  *goes_on = run->settings->resume && state == OUTPUT_UNFINISHED;
  return *goes_on ? EXIT_DONE : start_anew(run);
}

static int record_step(cli_run *run, const fg_step *before)
{
  const fg_step *step = &run->step;
  const fg_mesh_info *mesh = run->facts.mesh;
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
  int code = ranks_agree(record_step(run, &before));
  int reached = scale_plan_reach(&run->plan, run->step.clusters);
  if (!code && reached)
    code = take_scale(run, &run->plan.wanted[run->plan.next - reached], reached);
  run->facts.ended = reason_to_stop(run);
  return code;
}

/* A run that did not come to the end of its scales can go on later. */
static bool can_go_on(const cli_run *run)
{
  const char *ended = run->facts.ended;
  return strcmp(ended, "scales") != 0 && strcmp(ended, "stationary") != 0;
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
  if (!code && run->step.step && can_go_on(run) && (interrupted || run->step.clusters))
    code = checkpoint_save(run);
  /* a run that ends before its last scale still shows how far it came */
  bool shown = run->last_scale_clusters == run->step.clusters;
  if (!code && !scale_plan_done(&run->plan) && run->step.clusters && !shown)
    code = take_scale(run, NULL, 0);
  run->facts.seconds_evolve = run->earlier_evolve + clock_seconds() - run->evolving_since;
  return code;
}

static int complain_of_no_scale(const cli_run *run)
{
  const char *operand = run->settings->operand;
  const fg_step *step = &run->step;
  if (strcmp(run->facts.ended, "interrupted") == 0) {
    complain("%s: interrupted at t = %.3g, before the first scale%s", operand, step->time,
             step->step ? "" : ": nothing was written");
    return EXIT_INTERRUPTED;
  }
  bool settled = strcmp(run->facts.ended, "stationary") == 0;
  complain("%s: no clusters after %ld steps, at t = %.3g: %s", operand, step->step,
           step->time,
           settled ? "the pattern no longer changes" : "they are still forming");
  advise("%s",
         settled ? "Raise --nodes or --coverage." : "Raise --max-steps or --max-time.");
  return EXIT_FAILED;
}

static int finish_drawing(cli_run *run)
{
  if (drawing_ready(run->drawing) < drawing_count(run->drawing))
    progress_stage(&run->progress, "drawing");
  fg_status status = drawing_finish(run->drawing);
  progress_wipe(&run->progress);
  if (status)
    return complain_of(drawing_context(run->drawing), status, run->settings->operand);
  return drawing_count(run->drawing) ? EXIT_DONE : complain_of_no_scale(run);
}

static int write_results(cli_run *run)
{
  if (!table_flush(&run->table, false))
    return complain_of_file(run->settings->output, "evolution.csv cannot be written");
  char *path = output_path(&run->output, REPORT_NAME);
  if (!path)
    return EXIT_FAILED;
  run->facts.seconds_total = run->earlier_total + clock_seconds() - run->start;
  int code = report_write(path, &run->facts);
  free(path);
  return code ? code : output_publish(&run->output);
}

static void print_summary(const cli_run *run)
{
  char ends[SCALE_FILES][SCALE_END_BYTES];
  scale_file_ends(ends, run->settings, run->field);
  for (int k = 0; k < drawing_count(run->drawing); ++k) {
    const scale_result *result = drawing_result(run->drawing, k);
    char name[SCALE_NAME_BYTES];
    scale_name(name, k, ends[1]); /* its first picture */
    char *path = join_path(run->settings->output, name);
    printf("%4d clusters %4d icons  %s\n", result->clusters, result->icons,
           path ? path : name);
    free(path);
  }
}

/* What is said where a run ends early, or reached less than was wanted. */
static int say_ending(const cli_run *run)
{
  const cli_settings *said = run->settings;
  if (strcmp(run->facts.ended, "stationary") == 0 && !scale_plan_done(&run->plan))
    complain("%s: no scale of %d or fewer clusters: the pattern came to rest with %d",
             said->operand, run->plan.wanted[run->plan.next], run->step.clusters);
  if (strcmp(run->facts.ended, "interrupted") != 0)
    return EXIT_DONE;
  int count = drawing_count(run->drawing);
  complain("%s: interrupted at t = %.3g with %d clusters; the %d scale%s until then %s "
           "in %s",
           said->operand, run->step.time, run->step.clusters, count,
           count == 1 ? "" : "s", count == 1 ? "is" : "are", said->output);
  return EXIT_INTERRUPTED;
}

/* What is asked for, and is not there in 3D. */
static int check_dimension(const cli_run *run)
{
  if (!scales_are_solid(run->field) || run->settings->extent == FG_ICON_EXTENT_CLUSTER)
    return EXIT_DONE;
  complain("--extent territory: %s is in 3D, where arrows stay in their clusters",
           run->settings->operand);
  return EXIT_USAGE;
}

/* All ranks read; rank 0 sees to the results' folder. *done: nothing is left to do. */
static int prepare(cli_run *run, bool *done)
{
  output_state state;
  int code = EXIT_DONE;
  run->checkpoint = output_checkpoint_path(run->settings->output);
  if (!run->checkpoint) {
    complain("out of memory for a file's name");
    code = EXIT_FAILED;
  }
  if (!code && ranks_leader()) {
    code = output_check(run->settings->output);
    if (!code)
      code = look(run, &state, done);
  }
  if (!code && !*done)
    code = read_field(run);
  if (!code && !*done)
    code = check_dimension(run);
  code = ranks_agree(code);
  *done = ranks_any(*done);
  if (code || *done)
    return code;
  code = join_field(run);
  if (code)
    return code;
  if (ranks_leader()) {
    count_choices(run);
    say_choices(run);
  }
  run->facts.seconds_read = clock_seconds() - run->start;
  return create_evolution(run);
}

/* Of rank 0, after the evolution. */
static int finish(cli_run *run)
{
  int code = finish_drawing(run);
  if (!code)
    code = write_results(run);
  if (code)
    return code;
  run->finished = !can_go_on(run);
  print_summary(run);
  return say_ending(run);
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
    return finish_drawing(run);
  if (code)
    return code;
  traffic_collect(&run->facts, run->evolution);
  if (run->settings->verbose && ranks_leader()) {
    progress_wipe(&run->progress);
    traffic_print(&run->facts);
  }
  return ranks_agree(ranks_leader() ? finish(run) : EXIT_DONE);
}

/* The second line of a complaint, where a checkpoint makes it worth while and nothing
 * else was advised. The drawing's own context is gone; its failures advise nothing. */
static void say_how_to_go_on(const cli_run *run, int code, bool resumable)
{
  bool ended_here = run->saved_step && (code == EXIT_FAILED || code == EXIT_INTERRUPTED);
  if (!resumable || !ended_here || *fg_context_hint(run->context))
    return;
  advise("The same command with --resume goes on from step %ld.", run->saved_step);
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
  interrupt_start(run.context);
  int code = background_check(settings, true, ranks_count());
  if (!code)
    code = work(&run);
  interrupt_end();
  progress_wipe(&run.progress);
  drawing_destroy(run.drawing);
  table_close(&run.table);
  bool resumable = output_close(&run.output, run.finished);
  say_how_to_go_on(&run, code, resumable);
  fg_evolution_destroy(run.evolution);
  fg_field_destroy(run.field);
  fg_context_destroy(run.context);
  free(run.checkpoint);
  return code;
}
