#include "ending.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "folder.h"
#include "ranks.h"

/* At the drawing's progress. */
static const double seconds_between_looks = 0.2;

bool ending_can_go_on(const cli_run *run)
{
  const char *ended = run->facts.ended;
  return strcmp(ended, "scales") != 0 && strcmp(ended, "stationary") != 0;
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

int ending_draw(cli_run *run)
{
  if (strcmp(run->facts.ended, "interrupted") != 0)
    drawing_heed_interrupts(run->drawing);
  int count = drawing_count(run->drawing);
  do
    progress_drawing(&run->progress, drawing_ready(run->drawing), count);
  while (!drawing_wait_for(run->drawing, seconds_between_looks));
  fg_status status = drawing_finish(run->drawing);
  progress_wipe(&run->progress);
  if (status == FG_STATUS_STOPPED && drawing_ready(run->drawing) <= 1) {
    run->facts.ended = "interrupted"; /* while the first scale was drawn */
    return complain_of_no_scale(run);
  }
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

/* What else is to be said of a scale's arrows; "" for nothing. */
enum { ASIDE_BYTES = 64 };
static const char *say_dropped(char out[ASIDE_BYTES], int dropped)
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
    scale_name(name, k, ends[count > 1 ? 1 : 0]); /* its first picture, if any */
    char *path = join_path(run->settings->output, name);
    if (settings_place(run->settings))
      printf("%4d arrows  %s\n", result->icons, path ? path : name);
    else
      printf("%4d clusters %4d icons%s  %s\n", result->clusters, result->icons,
             say_dropped(aside, result->dropped), path ? path : name);
    free(path);
  }
}

/* A coarse mesh begins with few clusters. */
static void say_first_scale(const cli_run *run)
{
  const cli_settings *said = run->settings;
  if (said->cluster_count < 1 || drawing_count(run->drawing) < 1)
    return;
  int wanted = said->clusters[0], first = drawing_result(run->drawing, 0)->clusters;
  if (first > wanted / 2)
    return;
  complain("%s: no scale of about %d clusters: the first that could be counted were %d",
           said->operand, wanted, first);
  advise("More --nodes begin with more clusters.");
}

/* What is said where a run ends early, or reached less than was wanted. */
static int say_ending(const cli_run *run)
{
  const cli_settings *said = run->settings;
  if (strcmp(run->facts.ended, "stationary") == 0 && !scale_plan_done(&run->plan))
    complain("%s: no scale of %d or fewer clusters: the pattern came to rest with %d",
             said->operand, run->plan.wanted[run->plan.next], run->step.clusters);
  if (strcmp(run->facts.ended, "interrupted") != 0) {
    say_first_scale(run);
    return EXIT_DONE;
  }
  int count = drawing_count(run->drawing);
  char reached[64];
  if (run->plan.placed)
    snprintf(reached, sizeof reached, "before the scale of %d arrows",
             run->plan.wanted[count]);
  else
    snprintf(reached, sizeof reached, "with %d clusters", run->step.clusters);
  complain("%s: interrupted at t = %.3g %s; the %d scale%s until then %s in %s",
           said->operand, run->step.time, reached, count, count == 1 ? "" : "s",
           count == 1 ? "is" : "are", said->output);
  return EXIT_INTERRUPTED;
}

int ending_finish(cli_run *run)
{
  int code = ending_draw(run);
  if (!code && drawing_was_cut(run->drawing))
    run->facts.ended = "interrupted";
  if (!code)
    code = write_results(run);
  if (code)
    return code;
  run->finished = !ending_can_go_on(run);
  print_summary(run);
  return say_ending(run);
}

/* Unless something else was advised. The drawing's own context is gone; its failures
 * advise nothing. */
void ending_advise(const cli_run *run, int code, bool resumable)
{
  bool ended_here = run->saved_step && (code == EXIT_FAILED || code == EXIT_INTERRUPTED);
  if (!resumable || !ended_here || *fg_context_hint(run->context))
    return;
  advise("The same command with --resume goes on from step %ld.", run->saved_step);
}
