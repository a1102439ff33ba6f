#include "run/finish.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "folder/files.h"
#include "folder/scale_files.h"
#include "ranks.h"
#include "run/page.h"

/* Interval of checks of the drawing's progress. */
static const double seconds_between_looks = 0.2;

bool finish_can_go_on(const cli_run *run)
{
  fg_run_outcome ended = run->facts.ended;
  return ended != FG_RUN_ALL && ended != FG_RUN_STATIONARY;
}

static int complain_of_no_scale(const cli_run *run)
{
  const char *operand = input_name(run->settings->reading.input);
  const fg_step *step = &run->step;
  if (run->facts.ended == FG_RUN_STOPPED) {
    complain("%s: interrupted at t = %.3g, before the first scale%s", operand, step->time,
             step->step ? "" : ": nothing was written");
    return EXIT_INTERRUPTED;
  }
  bool settled = run->facts.ended == FG_RUN_STATIONARY;
  complain("%s: no clusters after %" PRId64 " steps, at t = %.3g: %s", operand,
           step->step, step->time,
           settled ? "the pattern no longer changes" : "they are still forming");
  advise("%s",
         settled ? "Raise --nodes or --coverage." : "Raise --max-steps or --max-time.");
  return EXIT_FAILED;
}

int finish_drawing(cli_run *run)
{
  if (run->facts.ended != FG_RUN_STOPPED)
    drawing_heed_interrupts(run->drawing);
  int count = drawing_count(run->drawing);
  do
    progress_drawing(&run->progress, drawing_ready(run->drawing), count);
  while (!drawing_wait_for(run->drawing, seconds_between_looks));
  fg_status status = drawing_finish(run->drawing);
  progress_wipe(&run->progress);
  if (status == FG_STATUS_STOPPED && drawing_ready(run->drawing) <= 1) {
    run->facts.ended = FG_RUN_STOPPED; /* while the first scale was being drawn */
    return complain_of_no_scale(run);
  }
  if (status)
    return complain_of(drawing_context(run->drawing), status,
                       run->settings->reading.input);
  return drawing_count(run->drawing) ? EXIT_DONE : complain_of_no_scale(run);
}

static int write_results(cli_run *run)
{
  if (!table_flush(&run->table, false))
    return complain_of_file(run->settings->output, "evolution.csv cannot be written");
  char *path = output_path(&run->output, REPORT_NAME);
  if (!path)
    return EXIT_FAILED;
  int code = page_write(run);
  if (code) {
    free(path);
    return code;
  }
  run->facts.seconds_total = run->earlier_total + clock_seconds() - run->start;
  code = report_write(path, &run->facts);
  free(path);
  return code ? code : output_publish(&run->output);
}

/* Writes the number of clusters without an icon; "" for none. */
enum { ASIDE_BYTES = 64 };
static const char *format_dropped(char out[ASIDE_BYTES], int dropped)
{
  out[0] = '\0';
  if (dropped > 0)
    snprintf(out, ASIDE_BYTES, ", %d cluster%s too small for one", dropped,
             dropped == 1 ? "" : "s");
  return out;
}

static void print_summary(const cli_run *run)
{
  char ends[SCALE_FILES][SCALE_END_BYTES];
  int count = scale_file_ends(ends, run->settings, run->field);
  for (int k = 0; k < drawing_count(run->drawing); ++k) {
    const scale_result *result = drawing_result(run->drawing, k);
    char name[SCALE_NAME_BYTES], aside[ASIDE_BYTES];
    scale_name(name, k, ends[count > 1 ? 1 : 0]); /* its first picture, if there is one */
    char *path = join_path(run->settings->output, name);
    if (settings_place(run->settings))
      printf("%4d arrows  %s\n", result->icons, path ? path : name);
    else {
      if (run->settings->times.count)
        printf("t = %-9.3g ", result->time);
      printf("%4d clusters %4d icons%s  %s\n", result->clusters, result->icons,
             format_dropped(aside, result->dropped), path ? path : name);
    }
    free(path);
  }
}

/* Warns that a coarse mesh began with few clusters. */
static void warn_of_few_clusters(const cli_run *run)
{
  const run_settings *settings = run->settings;
  if (settings->clusters.count < 1 || drawing_count(run->drawing) < 1)
    return;
  int wanted = settings->clusters.number[0],
      first = drawing_result(run->drawing, 0)->clusters;
  if (first > wanted / 2)
    return;
  complain("%s: no scale of about %d clusters: the first that could be counted were %d",
           input_name(settings->reading.input), wanted, first);
  advise("More --nodes begin with more clusters.");
}

/* Says which times have no arrows, and which are later than the last change. */
static void report_times(const cli_run *run)
{
  const time_list *times = &run->settings->times;
  const char *operand = input_name(run->settings->reading.input);
  int empty = 0, count = drawing_count(run->drawing);
  for (int k = 0; k < count; ++k)
    empty += drawing_result(run->drawing, k)->icons == 0;
  if (empty)
    complain("%s: %d of %d scales have no arrows: no cluster is large enough for one",
             operand, empty, count);
  if (run->facts.ended == FG_RUN_STATIONARY)
    complain(
        "%s: the pattern came to rest at t = %.3g: it stands for all times from there "
        "to %g",
        operand, run->step.time, times->time[times->count - 1]);
}

/* Prints why a run ended early, or has fewer scales than requested. */
static int report_outcome(const cli_run *run)
{
  const run_settings *settings = run->settings;
  const int *wanted = run->record.wanted, next = run->record.next;
  if (settings->times.count && !settings->picture.no_arrows)
    report_times(run);
  if (run->facts.ended == FG_RUN_STATIONARY && next < run->record.count)
    complain("%s: no scale of %d or fewer clusters: the pattern came to rest with %d",
             input_name(settings->reading.input), wanted[next], run->step.clusters);
  if (run->facts.ended != FG_RUN_STOPPED) {
    warn_of_few_clusters(run);
    return EXIT_DONE;
  }
  int count = drawing_count(run->drawing);
  char reached[64];
  if (settings_place(settings))
    snprintf(reached, sizeof reached, "before the scale of %d arrows", wanted[count]);
  else
    snprintf(reached, sizeof reached, "with %d clusters", run->step.clusters);
  complain("%s: interrupted at t = %.3g %s; the %d scale%s until then %s in %s",
           input_name(settings->reading.input), run->step.time, reached, count,
           count == 1 ? "" : "s", count == 1 ? "is" : "are", settings->output);
  return EXIT_INTERRUPTED;
}

int finish_run(cli_run *run)
{
  int code = finish_drawing(run);
  if (!code && drawing_was_cut(run->drawing))
    run->facts.ended = FG_RUN_STOPPED;
  if (!code)
    code = write_results(run);
  if (code)
    return code;
  run->finished = !finish_can_go_on(run);
  print_summary(run);
  return report_outcome(run);
}

/* Keeps earlier advice; the drawing's context is gone, but its failures have no
 * advice. */
void finish_advise(const cli_run *run, int code, bool resumable)
{
  bool ended_here = run->saved_step && (code == EXIT_FAILED || code == EXIT_INTERRUPTED);
  if (!resumable || !ended_here || *fg_context_hint(run->context))
    return;
  advise("The same command with --resume goes on from step %" PRId64 ".",
         run->saved_step);
}
