/* The command `view`: shows in a browser a finished run, or one that it starts. */
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "command/command.h"
#include "folder/files.h"
#include "inputs.h"
#include "interrupt.h"
#include "option/value.h"
#include "ranks.h"
#include "report/past_run.h"
#include "report/series_index.h"
#include "view/browser.h"
#include "view/child.h"
#include "view/pages.h"
#include "view/server.h"

static bool is_folder(const char *path)
{
  struct stat found;
  return stat(path, &found) == 0 && S_ISDIR(found.st_mode);
}

static int refuse_folder(const char *folder)
{
  if (file_is_there(folder, SERIES_NAME)) {
    complain("%s: holds a series of runs, and a page shows one", folder);
    advise("Name the folder of one of them; %s/%s lists them.", folder, SERIES_NAME);
  } else if (report_outcome(folder) == OUTCOME_NONE) {
    complain("%s: holds no run of flowgrain: there is no %s", folder, REPORT_NAME);
    advise("flowgrain view FILE runs a file and shows that.");
  } else {
    complain("%s: its run has left no page: there is no %s, or not by %s", folder,
             VIEW_NAME, REPORT_NAME);
    advise("Runs with --no-page, and of some kinds, have none; their pictures are "
           "scale-NN.png.");
  }
  return EXIT_FAILED;
}

/* State of the command. */
typedef struct cli_view {
  const view_settings *settings;
  cli_server *server;
  cli_child child;
  view_pages pages;
  bool announced;
  pid_t browser;
  int interrupts; /* number of them passed on to the child */
} cli_view;

/* Prints the address and opens the browser, once there is something to show. */
static int announce(cli_view *view)
{
  view->announced = true;
  printf("%s\n", server_address(view->server));
  if (fflush(stdout) != 0)
    return complain_of_file("standard output", "cannot be written");
  if (!view->settings->no_browser)
    view->browser = browser_start(server_address(view->server));
  return EXIT_DONE;
}

/* Passes interrupts on to the run, whose end ends this command. Returns whether it is
 * over. */
static bool is_over(cli_view *view)
{
  cli_child *child = &view->child;
  if (!child->process)
    return child->code || interrupt_came();
  while (view->interrupts < interrupt_count()) {
    ++view->interrupts;
    child_interrupt(child);
  }
  return child->temporary && view->interrupts;
}

static int serve(cli_view *view)
{
  int code = EXIT_DONE;
  while (!code && !is_over(view)) {
    child_receive(&view->child);
    const bool has_something =
        view->child.process ? view->child.began : !view->child.code;
    if (has_something && !view->announced)
      code = announce(view);
    if (browser_failed(&view->browser))
      complain("no browser could be started; open the address above in one");
    server_turn(view->server, view->child.socket, pages_give, &view->pages);
  }
  return code;
}

/* Prints that nothing is kept of an interrupted run in a temporary folder; about other
 * ends the run has printed. Returns the exit code. */
static int report_end(const cli_view *view)
{
  const char *input = view->settings->run.reading.input;
  if (view->child.process && view->child.temporary) {
    cli_progress line;
    progress_start(&line, view->settings->run.quiet, 0);
    line.drawn = line.shown; /* drawn by the run */
    progress_wipe(&line);
    complain("%s: interrupted; nothing of its run is kept without -o DIR",
             input_name(input));
  }
  return view->child.code ? view->child.code : EXIT_INTERRUPTED;
}

static void end_server(void *server)
{
  server_end(server);
}

static int prepare(cli_view *view)
{
  run_settings run = view->settings->run;
  const char *input = run.reading.input;
  if (is_folder(input)) {
    view->child = (cli_child){.socket = -1, .folder = input};
    return report_has_page(input) ? EXIT_DONE : refuse_folder(input);
  }
  int code = inputs_prepare(&run.inputs, &input, 1, ranks_count());
  if (run.formats && !(run.formats & (FORMAT_SVG | FORMAT_PNG)))
    run.formats |= FORMAT_PNG; /* a page cannot show PDF */
  return code ? code : child_start(&view->child, &run, end_server, view->server);
}

/* Refuses options of `run` unless the operand is a FILE. */
static bool fits(const view_settings *settings)
{
  const char *input = settings->run.reading.input;
  return !is_folder(input) || (!settings->first_option && !settings->run.output) ||
         usage_error(command_find("view"), "--%s: says nothing of %s, which is a folder",
                     settings->first_option ? settings->first_option : "output", input);
}

int command_view(const void *given)
{
  cli_view view = {.settings = given, .browser = -1, .child = {.socket = -1}};
  view.pages =
      (view_pages){.child = &view.child, .input = view.settings->run.reading.input};
  if (!fits(given))
    return EXIT_USAGE;
  if (ranks_count() > 1 && !is_folder(view.pages.input)) {
    complain("%s: view runs it in one process, and here are %d", view.pages.input,
             ranks_count());
    advise("Give them flowgrain run, and then its folder to flowgrain view.");
    return EXIT_FAILED;
  }
  interrupt_start(NULL);
  int code = server_start(&view.server);
  if (!code)
    code = prepare(&view);
  if (!code)
    code = serve(&view);
  if (!code)
    code = report_end(&view);
  child_end(&view.child);
  server_end(view.server);
  interrupt_end();
  return code;
}
