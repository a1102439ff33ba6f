/* The main job: read, evolve, take scales, draw them, and leave a folder of results. */
#include <errno.h>
#include <math.h>
#include <signal.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "drawing.h"
#include "json_report.h"
#include "output.h"
#include "progress.h"
#include "rehearse.h"
#include "scales.h"

typedef struct cli_run {
  const cli_settings *settings;
  fg_context *context;
  fg_field *field;
  fg_evolution *evolution;
  cli_drawing *drawing;
  cli_output output;
  FILE *table; /* evolution.csv */
  cli_progress progress;
  scale_plan plan;
  run_facts facts;
  fg_step step;          /* the last accepted one */
  fg_step first_counted; /* the first with a number of clusters; step 0: none yet */
  int last_scale_clusters;
  double start;
} cli_run;

/* What a signal has to stop: the evolution first; at the second signal also the drawing.
 * A handler can not be given an argument, hence the two globals. */
static _Atomic(fg_context *) stop_first;
static _Atomic(fg_context *) stop_second;
static volatile sig_atomic_t interrupts;

static void handle_signal(int number)
{
  (void)number;
  ++interrupts;
  fg_context *first = atomic_load(&stop_first);
  fg_context *second = atomic_load(&stop_second);
  if (first)
    fg_context_stop(first);
  if (interrupts > 1 && second)
    fg_context_stop(second);
}

static void install_signals(const cli_run *run)
{
  atomic_store(&stop_first, run->context);
  struct sigaction action = {.sa_handler = handle_signal, .sa_flags = SA_RESTART};
  sigemptyset(&action.sa_mask);
  const int numbers[] = {SIGINT, SIGTERM, SIGHUP};
  for (int k = 0; k < 3; ++k) {
    struct sigaction before;
    /* nohup and shells that run jobs in the background ignore signals for us */
    if (sigaction(numbers[k], NULL, &before) == 0 && before.sa_handler != SIG_IGN)
      sigaction(numbers[k], &action, NULL);
  }
}

static void release_signals(void)
{
  atomic_store(&stop_first, NULL);
  atomic_store(&stop_second, NULL);
}

static int read_field(cli_run *run)
{
  const cli_settings *said = run->settings;
  progress_stage(&run->progress, "reading");
  fg_read_options reading = settings_reading(said);
  if (rehearse_reading(said->operand, &reading))
    return EXIT_FAILED;
  fg_status status = fg_field_read(&run->field, run->context, said->operand, &reading);
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

static void print_mesh(const fg_mesh_info *mesh)
{
  fprintf(stderr, "flowgrain: mesh %d x %d", mesh->cells[0], mesh->cells[1]);
  if (mesh->dimension == 3)
    fprintf(stderr, " x %d", mesh->cells[2]);
  fprintf(stderr, " cells (%ld active), a = %g, coverage %g, gamma %g, %s kernel\n",
          mesh->active_cells, mesh->anisotropy, mesh->coverage, mesh->gamma,
          mesh->kernel);
}

/* What of this version's results a field in 3D does not get. */
static void say_what_is_left_out(const cli_run *run)
{
  if (fg_field_contents(run->field)->dimension == 3)
    fprintf(stderr,
            "flowgrain: %s: in 3D, so a scale is the density u and its clusters "
            "(scale-NN.vti), without icons and pictures\n",
            run->settings->operand);
}

static int create_evolution(cli_run *run)
{
  fg_evolution_options options = settings_evolution(run->settings);
  fg_status status =
      fg_evolution_create(&run->evolution, run->context, run->field, &options);
  if (status)
    return complain_of(run->context, status, run->settings->operand);
  const fg_mesh_info *mesh = fg_evolution_mesh(run->evolution);
  run->facts.mesh = mesh;
  if (run->settings->verbose)
    print_mesh(mesh);
  return EXIT_DONE;
}

static int open_results(cli_run *run)
{
  int code = output_open(&run->output, run->settings->output);
  if (code)
    return code;
  char *path = output_path(&run->output, "evolution.csv");
  if (!path)
    return EXIT_FAILED;
  run->table = fopen(path, "w");
  if (!run->table)
    code = complain_of_file(path, "cannot be written");
  else
    fputs("step,t,tau,energy,mass,area_fraction,clusters,newton,cycles,cells,seconds\n",
          run->table);
  free(path);
  if (code)
    return code;
  code = drawing_start(&run->drawing, run->settings, run->field, &run->output);
  run->facts.drawing = run->drawing;
  if (!code)
    atomic_store(&stop_second, drawing_context(run->drawing));
  return code;
}

/* A row per accepted step. The scheme smooths the nonlinear system directly, so there are
 * no Newton iterations to count: that column stays 0. */
static void record_step(cli_run *run, const fg_step *before)
{
  const fg_step *step = &run->step;
  const fg_mesh_info *mesh = run->facts.mesh;
  fprintf(run->table, "%ld,%.9g,%.9g,%.12g,%.12g,%.6g,%d,0,%d,%ld,%.6f\n", step->step,
          step->time, step->tau, step->energy, step->mass, step->area_fraction,
          step->clusters, step->cycles, step->cells, step->seconds);
  run->facts.accepted = step->step;
  run->facts.rejected += step->rejected;
  if (before->step && step->energy > before->energy)
    run->facts.energy_monotone = false;
  /* masses are in units of the longest side; the initial one is known by construction */
  double measure = mesh->domain_measure / pow(mesh->length, mesh->dimension);
  double drift = fabs(step->mass / measure - (2.0 * mesh->coverage - 1.0));
  if (drift > run->facts.mass_drift)
    run->facts.mass_drift = drift;
}

static int take_scale(cli_run *run, const int *wanted, int wanted_count)
{
  fg_density *density;
  fg_status status = fg_density_create(&density, run->evolution);
  if (status)
    return complain_of(run->context, status, run->settings->operand);
  run->last_scale_clusters = run->step.clusters;
  if (run->settings->verbose) {
    progress_wipe(&run->progress);
    fprintf(stderr, "flowgrain: scale %02d: step %ld, t = %.3e, %d clusters, %.2f s\n",
            drawing_count(run->drawing), run->step.step, run->step.time,
            run->step.clusters, run->step.seconds);
  }
  /* a failure of the drawing is complained of where the run ends */
  return drawing_add(run->drawing, density, wanted, wanted_count) ? EXIT_DONE
                                                                  : EXIT_FAILED;
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

static int evolve(cli_run *run)
{
  while (!run->facts.ended) {
    fg_step before = run->step;
    fg_status status = fg_evolution_step(run->evolution, &run->step);
    if (status == FG_STATUS_STOPPED) {
      run->step = before;
      run->facts.ended = "interrupted";
      return EXIT_DONE;
    }
    if (status) {
      progress_wipe(&run->progress);
      return complain_of(run->context, status, run->settings->operand);
    }
    record_step(run, &before);
    if (run->step.clusters && !run->first_counted.step)
      run->first_counted = run->step;
    int reached = scale_plan_reach(&run->plan, run->step.clusters);
    if (reached) {
      int code = take_scale(run, &run->plan.wanted[run->plan.next - reached], reached);
      if (code)
        return code;
    }
    run->facts.ended = reason_to_stop(run);
    show_progress(run);
  }
  /* a run that ends before its last scale still shows how far it came */
  bool shown = run->last_scale_clusters == run->step.clusters;
  if (!scale_plan_done(&run->plan) && run->step.clusters && !shown)
    return take_scale(run, NULL, 0);
  return EXIT_DONE;
}

static int finish_drawing(cli_run *run)
{
  if (drawing_ready(run->drawing) < drawing_count(run->drawing))
    progress_stage(&run->progress, "drawing");
  fg_status status = drawing_finish(run->drawing);
  progress_wipe(&run->progress);
  if (status)
    return complain_of(drawing_context(run->drawing), status, run->settings->operand);
  if (drawing_count(run->drawing))
    return EXIT_DONE;
  const fg_step *step = &run->step;
  if (strcmp(run->facts.ended, "interrupted") == 0) {
    complain("%s: interrupted at t = %.3g, before the first scale: nothing was written",
             run->settings->operand, step->time);
    return EXIT_INTERRUPTED;
  }
  bool settled = strcmp(run->facts.ended, "stationary") == 0;
  complain("%s: no clusters after %ld steps, at t = %.3g: %s", run->settings->operand,
           step->step, step->time,
           settled ? "the pattern no longer changes" : "they are still forming");
  fputs(settled ? "Raise --nodes or --coverage.\n" : "Raise --max-steps or --max-time.\n",
        stderr);
  return EXIT_FAILED;
}

static int write_results(cli_run *run)
{
  bool failed = ferror(run->table) != 0;
  failed = fclose(run->table) != 0 || failed;
  run->table = NULL;
  if (failed)
    return complain_of_file(run->settings->output, "evolution.csv cannot be written");
  char *path = output_path(&run->output, "run.json");
  if (!path)
    return EXIT_FAILED;
  run->facts.seconds_total = clock_seconds() - run->start;
  int code = report_write(path, &run->facts);
  free(path);
  return code ? code : output_commit(&run->output);
}

static void print_summary(const cli_run *run)
{
  static const char *const ends[FORMAT_KINDS] = {"svg", "png", "pdf"};
  bool icons = drawing_makes_icons(run->drawing);
  unsigned formats = run->settings->formats;
  int kind = 0;
  while (kind < FORMAT_KINDS - 1 && formats && !(formats & (1U << kind)))
    ++kind;
  for (int k = 0; k < drawing_count(run->drawing); ++k) {
    const scale_result *result = drawing_result(run->drawing, k);
    char name[32];
    snprintf(name, sizeof name, "scale-%02d.%s", k, icons ? ends[kind] : "vti");
    char *path = join_path(run->settings->output, name);
    if (icons)
      printf("%4d clusters %4d icons  %s\n", result->clusters, result->icons,
             path ? path : name);
    else
      printf("%4d clusters  %s\n", result->clusters, path ? path : name);
    free(path);
  }
}

static int work(cli_run *run)
{
  int code = output_check(run->settings->output, run->settings->force);
  if (!code)
    code = read_field(run);
  if (code)
    return code;
  count_choices(run);
  say_choices(run);
  say_what_is_left_out(run);
  run->facts.seconds_read = clock_seconds() - run->start;
  code = create_evolution(run);
  if (!code)
    code = open_results(run);
  if (code)
    return code;
  double before = clock_seconds();
  code = evolve(run);
  run->facts.seconds_evolve = clock_seconds() - before;
  if (code && run->drawing && drawing_failed(run->drawing))
    return finish_drawing(run);
  if (!code)
    code = finish_drawing(run);
  if (!code)
    code = write_results(run);
  if (code)
    return code;
  print_summary(run);
  if (strcmp(run->facts.ended, "stationary") == 0 && !scale_plan_done(&run->plan))
    complain("%s: no scale of %d or fewer clusters: the pattern came to rest with %d",
             run->settings->operand, run->plan.wanted[run->plan.next],
             run->step.clusters);
  if (strcmp(run->facts.ended, "interrupted") != 0)
    return EXIT_DONE;
  complain(
      "%s: interrupted at t = %.3g with %d clusters; the %d scale%s until then %s in "
      "%s",
      run->settings->operand, run->step.time, run->step.clusters,
      drawing_count(run->drawing), drawing_count(run->drawing) == 1 ? "" : "s",
      drawing_count(run->drawing) == 1 ? "is" : "are", run->settings->output);
  return EXIT_INTERRUPTED;
}

int command_run(const cli_settings *settings)
{
  cli_run run = {.settings = settings, .start = clock_seconds()};
  run.facts.settings = settings;
  run.facts.energy_monotone = true;
  scale_plan_start(&run.plan, settings->clusters, settings->cluster_count);
  progress_start(&run.progress, settings->quiet);
  if (fg_context_create(&run.context)) {
    complain("out of memory");
    return EXIT_FAILED;
  }
  install_signals(&run);
  int code = work(&run);
  release_signals();
  progress_wipe(&run.progress);
  if (run.table)
    fclose(run.table);
  drawing_destroy(run.drawing);
  output_close(&run.output);
  fg_evolution_destroy(run.evolution);
  fg_field_destroy(run.field);
  fg_context_destroy(run.context);
  return code;
}
