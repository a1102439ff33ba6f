#include "progress.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

/* Often enough to look alive, seldom enough to cost nothing. */
static const double seconds_between = 0.1;

double clock_seconds(void)
{
  struct timespec now;
  clock_gettime(CLOCK_MONOTONIC, &now);
  return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

enum { BAR_COLUMNS = 24 };

void progress_start(cli_progress *progress, bool quiet)
{
  const char *terminal = getenv("TERM");
  memset(progress, 0, sizeof *progress);
  progress->shown =
      !quiet && isatty(STDERR_FILENO) && !(terminal && strcmp(terminal, "dumb") == 0);
}

static void draw(cli_progress *progress, const char *text)
{
  /* a longer line would wrap on 80 columns and could not be wiped */
  fprintf(stderr, "\r\033[K%.79s", text);
  fflush(stderr);
  progress->drawn = true;
  progress->last_drawn = clock_seconds();
}

void progress_stage(cli_progress *progress, const char *text)
{
  if (progress->shown)
    draw(progress, text);
}

static void describe_seconds(char *text, size_t size, double seconds)
{
  if (seconds < 0.0)
    snprintf(text, size, "--:--");
  else if (seconds < 3600.0)
    snprintf(text, size, "%d:%02d", (int)seconds / 60, (int)seconds % 60);
  else
    snprintf(text, size, "%.1f h", seconds / 3600.0);
}

/* Writes a bar that is full by a share. */
static void draw_bar(char bar[BAR_COLUMNS + 1], double share)
{
  int full = (int)(share * BAR_COLUMNS);
  for (int k = 0; k < BAR_COLUMNS; ++k)
    bar[k] = k < full ? '=' : ' ';
  bar[BAR_COLUMNS] = '\0';
}

void progress_drawing(cli_progress *progress, int ready, int count)
{
  char text[160], bar[BAR_COLUMNS + 1];
  if (!progress->shown || ready >= count)
    return;
  draw_bar(bar, (double)ready / count);
  snprintf(text, sizeof text, "drawing  [%s] scale %d of %d", bar, ready + 1, count);
  draw(progress, text);
}

void progress_evolution(cli_progress *progress, double share, double time, int clusters,
                        double seconds_left)
{
  if (!progress->shown || clock_seconds() - progress->last_drawn < seconds_between)
    return;
  char text[160], left[32], count[32] = "clusters form", bar[BAR_COLUMNS + 1];
  describe_seconds(left, sizeof left, seconds_left);
  if (clusters > 0)
    snprintf(count, sizeof count, "%d clusters", clusters);
  draw_bar(bar, share);
  snprintf(text, sizeof text, "evolving [%s] t = %.2e  %s  %s left", bar, time, count,
           left);
  draw(progress, text);
}

void progress_wipe(cli_progress *progress)
{
  if (!progress->drawn)
    return;
  fputs("\r\033[K", stderr);
  fflush(stderr);
  progress->drawn = false;
}
