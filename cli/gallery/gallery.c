/* Makes every figure of the paper, and a page that shows them. Commands run in processes
 * of their own, in the gallery's folder, as a user would run them. */
#include "gallery/gallery.h"

#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include "build_features.h"
#include "command/command.h"
#include "folder/file.h"
#include "folder/files.h"
#include "folder/made.h"
#include "folder/results.h"
#include "ranks.h"

#define PAGE_NAME "index.html"

enum { MOST_WORDS = 32 };

static int out_of_memory(void)
{
  complain("out of memory");
  return EXIT_FAILED;
}

/* The folder of the program's data: $FLOWGRAIN_DATA, or the one installed or built beside
 * the program. NULL: not found. To be freed. */
static char *find_data(void)
{
  static const char *const beside[] = {"/../share/flowgrain", "/../data"};
  const char *given = getenv("FLOWGRAIN_DATA");
  if (given && *given)
    return join_texts(given, "");
  char *program = realpath("/proc/self/exe", NULL);
  char *found = NULL;
  if (program && strrchr(program, '/'))
    *strrchr(program, '/') = '\0';
  for (size_t n = 0; program && n < sizeof beside / sizeof beside[0] && !found; ++n) {
    found = join_texts(program, beside[n]);
    if (found && !file_is_there(found, gallery_data[0])) {
      free(found);
      found = NULL;
    }
  }
  free(program);
  return found;
}

static int copy_bytes(const char *from, const char *to)
{
  FILE *in = fopen(from, "rb");
  if (!in)
    return complain_of_file(from, "cannot be read");
  FILE *out = fopen(to, "wb");
  if (!out) {
    int code = complain_of_file(to, "cannot be written");
    fclose(in);
    return code;
  }
  char bytes[65536];
  size_t count;
  bool written = true;
  while (written && (count = fread(bytes, 1, sizeof bytes, in)) > 0)
    written = fwrite(bytes, 1, count, out) == count;
  bool read = !ferror(in);
  fclose(in);
  written = fclose(out) == 0 && written;
  if (!read)
    return complain_of_file(from, "cannot be read");
  return written ? EXIT_DONE : complain_of_file(to, "cannot be written");
}

static int copy_data(const char *folder)
{
  char *data = find_data();
  if (!data) {
    complain("gallery: the program's data (%s ...) are not where it looks for them",
             gallery_data[0]);
    advise("Say their folder by the environment's FLOWGRAIN_DATA.");
    return EXIT_FAILED;
  }
  int code = EXIT_DONE;
  for (int n = 0; n < gallery_data_count && !code; ++n) {
    char *from = join_path(data, gallery_data[n]),
         *to = join_path(folder, gallery_data[n]);
    code = from && to ? copy_bytes(from, to) : out_of_memory();
    free(from);
    free(to);
  }
  free(data);
  return code;
}

/* Splits a command at spaces; `text` holds the words. Returns their number, at most
 * `most`. */
static int split_words(char *text, char *words[], int most)
{
  int count = 0;
  for (char *at = text; *at && count < most;) {
    words[count++] = at;
    at += strcspn(at, " ");
    if (*at)
      *at++ = '\0';
  }
  return count;
}

/* Performs a command in `folder`, without standard output, in a process of its own. */
static int do_command(const char *folder, const char *command, bool force)
{
  static char program[] = "flowgrain", quiet[] = "--quiet", replace[] = "--force";
  char *text = join_texts(command, ""), *words[MOST_WORDS] = {program};
  int nowhere = open("/dev/null", O_WRONLY);
  if (!text || nowhere == -1 || dup2(nowhere, STDOUT_FILENO) == -1)
    return out_of_memory();
  if (chdir(folder) != 0)
    return complain_of_file(folder, "cannot be entered");
  int count = 1 + split_words(text, words + 1, MOST_WORDS - 4);
  if (strncmp(command, "run ", 4) == 0) {
    words[count++] = quiet;
    if (force)
      words[count++] = replace;
  }
  words[count] = NULL;
  return program_perform(count, words);
}

static int await(const char *command, pid_t process)
{
  int state;
  while (waitpid(process, &state, 0) == -1)
    if (errno != EINTR)
      return complain_of_file(command, "cannot be waited for");
  if (WIFEXITED(state) && WEXITSTATUS(state) == EXIT_DONE)
    return EXIT_DONE;
  if (WIFEXITED(state))
    complain("gallery: 'flowgrain %s' ended with code %d", command, WEXITSTATUS(state));
  else
    complain("gallery: 'flowgrain %s' was ended by signal %d", command, WTERMSIG(state));
  return WIFEXITED(state) && WEXITSTATUS(state) == EXIT_INTERRUPTED ? EXIT_INTERRUPTED
                                                                    : EXIT_FAILED;
}

static int run_command(const char *command, const gallery_settings *settings)
{
  fflush(NULL);
  pid_t process = fork();
  if (process == -1)
    return complain_of_file(command, "no process can be started");
  if (process == 0) {
    int code = do_command(settings->output, command, settings->force);
    fflush(NULL);
    _exit(code);
  }
  return await(command, process);
}

/* Writes DIR/name by `print`, completely or not at all. */
static int write_file(const gallery_settings *settings, const char *name,
                      void (*print)(FILE *stream, const gallery_settings *settings),
                      void (*draw)(FILE *stream))
{
  char *path = join_path(settings->output, name);
  char *partial = path ? temporary_name(path) : NULL;
  if (!partial) {
    int none = path ? EXIT_FAILED : out_of_memory();
    free(path);
    return none;
  }
  int code = EXIT_DONE;
  FILE *stream = fopen(partial, "w");
  if (!stream)
    code = complain_of_file(path, "cannot be written");
  else {
    if (print)
      print(stream, settings);
    else
      draw(stream);
    bool written = !ferror(stream);
    written = fclose(stream) == 0 && written;
    if (!written)
      code = complain_of_file(path, "cannot be written");
  }
  code = publish_file(partial, path, code);
  free(path);
  return code;
}

static int make_figure(const gallery_figure *figure, const gallery_settings *settings)
{
  if (!settings->quiet)
    fprintf(stderr, "flowgrain: figure %d: %s\n", figure->number, figure->title);
  if (figure->draw)
    return write_file(settings, figure->picture[0].path, NULL, figure->draw);
  int code = EXIT_DONE;
  for (int n = 0; n < GALLERY_COMMANDS && figure->command[n] && !code; ++n)
    code = run_command(figure->command[n], settings);
  return code;
}

static bool is_wanted(const gallery_figure *figure, const gallery_settings *settings)
{
  return gallery_shows(figure, settings->figure);
}

static int check(const gallery_settings *settings)
{
  bool known = false;
  for (int n = 0; n < gallery_figure_count; ++n)
    known = known || is_wanted(&gallery_figures[n], settings);
  if (!known) {
    complain("--figure %d: the paper has figures 1 to %d", settings->figure,
             gallery_figures[gallery_figure_count - 1].number);
    return EXIT_USAGE;
  }
  if (!settings->force && file_is_there(settings->output, PAGE_NAME)) {
    complain("%s: holds a gallery already", settings->output);
    advise("Choose another folder, or replace it with --force.");
    return EXIT_FAILED;
  }
  return output_check(settings->output);
}

int command_gallery(const void *given)
{
  const gallery_settings *settings = given;
  char *topmost = NULL;
  int code = check(settings);
  if (!code)
    code = require_feature("gallery", FG_FEATURE_PICTURES);
  if (!code)
    code = make_folders(settings->output, &topmost);
  if (!code)
    code = copy_data(settings->output);
  for (int n = 0; n < gallery_figure_count && !code; ++n)
    if (is_wanted(&gallery_figures[n], settings))
      code = make_figure(&gallery_figures[n], settings);
  if (!code)
    code = write_file(settings, PAGE_NAME, gallery_print_page, NULL);
  if (!code)
    printf("%s/%s\n", settings->output, PAGE_NAME);
  else if (topmost)
    remove_empty_folders(settings->output, topmost);
  free(topmost);
  return code;
}
