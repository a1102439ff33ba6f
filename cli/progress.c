#include "progress.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <time.h>
#include <unistd.h>

/* Interval of updates: visible progress at no cost. */
static const double seconds_between = 0.1;

double clock_seconds(void)
{
  struct timespec now;
  clock_gettime(CLOCK_MONOTONIC, &now);
  return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

enum { BAR_COLUMNS = 24 };

void progress_start(cli_progress *progress, bool quiet, int socket)
{
  const char *terminal = getenv("TERM");
  memset(progress, 0, sizeof *progress);
  progress->socket = socket;
  progress->shown =
      !quiet && isatty(STDERR_FILENO) && !(terminal && strcmp(terminal, "dumb") == 0);
}

/* Writes a bar, `share` of it filled. */
static void draw_bar(char bar[BAR_COLUMNS + 1], double share)
{
  int full = (int)(share * BAR_COLUMNS);
  for (int k = 0; k < BAR_COLUMNS; ++k)
    bar[k] = k < full ? '=' : ' ';
  bar[BAR_COLUMNS] = '\0';
}

static void draw(cli_progress *progress, const char *doing, double share,
                 const char *words)
{
  char text[160], bar[BAR_COLUMNS + 1];
  if (share >= 0.0) {
    draw_bar(bar, share);
    snprintf(text, sizeof text, "%-8s [%s] %s", doing, bar, words);
  } else
    snprintf(text, sizeof text, "%s", doing);
  /* a line of 80 columns would wrap, and could not be erased */
  fprintf(stderr, "\r\033[K%.79s", text);
  fflush(stderr);
  progress->drawn = true;
}

size_t progress_message_size(const progress_message *message)
{
  return offsetof(progress_message, u) +
         (size_t)message->nodes[0] * (size_t)message->nodes[1];
}

static void send_message(const cli_progress *progress, const progress_message *message)
{
  (void)send(progress->socket, message, progress_message_size(message),
             MSG_DONTWAIT | MSG_NOSIGNAL);
}

static void send_words(const cli_progress *progress, const char *doing, double share,
                       const char *words)
{
  progress_message message;
  memset(&message, 0, offsetof(progress_message, u));
  message.share = share;
  snprintf(message.words, sizeof message.words, "%s%s%s", doing, *words ? ": " : "",
           words);
  send_message(progress, &message);
}

void progress_density(const cli_progress *progress, const progress_message *message)
{
  if (progress->socket)
    send_message(progress, message);
}

static void show(cli_progress *progress, const char *doing, double share,
                 const char *words)
{
  if (progress->shown)
    draw(progress, doing, share, words);
  if (progress->socket)
    send_words(progress, doing, share, words);
  progress->last_drawn = clock_seconds();
}

void progress_stage(cli_progress *progress, const char *text)
{
  show(progress, text, -1.0, "");
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

void progress_drawing(cli_progress *progress, int ready, int count)
{
  char text[64];
  if (ready >= count)
    return;
  snprintf(text, sizeof text, "scale %d of %d", ready + 1, count);
  show(progress, "drawing", (double)ready / count, text);
}

void progress_evolution(cli_progress *progress, double share, double time, int clusters,
                        double seconds_left)
{
  if (clock_seconds() - progress->last_drawn < seconds_between)
    return;
  char text[96], left[32], count[32] = "clusters form";
  describe_seconds(left, sizeof left, seconds_left);
  if (clusters > 0)
    snprintf(count, sizeof count, "%d clusters", clusters);
  snprintf(text, sizeof text, "t = %.2e  %s  %s left", time, count, left);
  show(progress, "evolving", share, text);
}

void progress_wipe(cli_progress *progress)
{
  if (!progress->drawn)
    return;
  fputs("\r\033[K", stderr);
  fflush(stderr);
  progress->drawn = false;
}
