#include "folder/results.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "folder/files.h"
#include "folder/made.h"
#include "report/past_run.h"

#define LOCK_NAME "lock"
#define PREVIOUS_NAME CHECKPOINT_NAME ".previous"

static int complain_of_rival(const char *folder, const struct flock *rival)
{
  complain("%s: another run is writing to it, process %ld", folder, (long)rival->l_pid);
  return EXIT_FAILED;
}

static int check_folder(const char *folder)
{
  struct stat found;
  char *nearest = nearest_existing(folder);
  if (!nearest)
    return complain_of_memory("a file's name");
  int code = EXIT_DONE;
  if (stat(nearest, &found) != 0)
    code = complain_of_file(nearest, "is a symbolic link that cannot be followed");
  else if (!S_ISDIR(found.st_mode)) {
    complain("%s: is a file, a folder is needed for the results", nearest);
    code = EXIT_FAILED;
  } else if (access(nearest, W_OK | X_OK) != 0)
    code = complain_of_file(nearest, "cannot be written to");
  free(nearest);
  return code;
}

static int refuse_kind(const char *path, const char *wanted)
{
  complain("%s: is no %s, as the program makes it", path, wanted);
  advise("Choose another folder with -o, or move it away.");
  return EXIT_FAILED;
}

/* Refuses symbolic links and other kinds of files, which the program has not made. */
static int check_work(const char *work, const char *lock)
{
  struct stat found;
  if (lstat(work, &found) == 0 && !is_plain_folder(work))
    return refuse_kind(work, "folder");
  if (lstat(lock, &found) == 0 && !is_plain_file(lock))
    return refuse_kind(lock, "file");
  return EXIT_DONE;
}

/* A killed run loses its lock. On a file system without locks all runs may start. */
static int check_lock(const char *folder, const char *work)
{
  char *path = join_path(work, LOCK_NAME);
  if (!path)
    return complain_of_memory("a file's name");
  int code = check_work(work, path), file = -1;
  if (!code)
    file = open(path, O_RDWR | O_NOFOLLOW | O_CLOEXEC);
  free(path);
  if (file < 0)
    return code;
  struct flock lock = {.l_type = F_WRLCK, .l_whence = SEEK_SET};
  if (fcntl(file, F_GETLK, &lock) == 0 && lock.l_type != F_UNLCK)
    code = complain_of_rival(folder, &lock);
  close(file);
  return code;
}

static bool has_checkpoint(const char *work)
{
  return file_is_there(work, CHECKPOINT_NAME) || file_is_there(work, PREVIOUS_NAME);
}

int output_check(const char *folder)
{
  int code = check_folder(folder);
  char *work = join_path(folder, WORK_NAME);
  if (!work)
    return complain_of_memory("a file's name");
  if (!code)
    code = check_lock(folder, work);
  free(work);
  return code;
}

int output_inspect(output_contents *out, const char *folder)
{
  *out = (output_contents){.state = OUTPUT_EMPTY};
  char *work = join_path(folder, WORK_NAME);
  if (!work)
    return complain_of_memory("a file's name");
  int code = made_find_foreign(out->foreign, folder, work);
  bool has = has_checkpoint(work);
  free(work);
  if (code || out->foreign[0])
    return code;
  run_outcome outcome = report_outcome(folder);
  if (has)
    out->state = OUTPUT_UNFINISHED;
  else if (outcome == OUTCOME_INTERRUPTED)
    out->state = OUTPUT_INTERRUPTED;
  else if (outcome != OUTCOME_NONE)
    out->state = OUTPUT_FINISHED;
  return EXIT_DONE;
}

/* The last owner may have just removed the file; a lock on a removed file is void. */
static int set_lock(const cli_output *out)
{
  struct flock lock = {.l_type = F_WRLCK, .l_whence = SEEK_SET};
  struct stat about;
  if (fcntl(out->lock, F_SETLK, &lock) != 0 && (errno == EACCES || errno == EAGAIN))
    return fcntl(out->lock, F_GETLK, &lock) == 0 && lock.l_type != F_UNLCK
               ? complain_of_rival(out->folder, &lock)
               : complain_of_file(out->folder, "another run is writing to it");
  if (fstat(out->lock, &about) == 0 && about.st_nlink > 0)
    return EXIT_DONE;
  complain("%s: another run has ended there just now", out->folder);
  advise("Start this one again.");
  return EXIT_FAILED;
}

static int take_lock(cli_output *out)
{
  char *path = join_path(out->work, LOCK_NAME);
  if (!path)
    return complain_of_memory("a file's name");
  int code = check_work(out->work, path);
  if (!code) {
    out->lock = open(path, O_RDWR | O_CREAT | O_NOFOLLOW | O_CLOEXEC, 0666);
    code = out->lock < 0 ? complain_of_file(out->folder, "cannot be written to")
                         : set_lock(out);
  }
  free(path);
  if (code && out->lock >= 0) {
    close(out->lock);
    out->lock = -1;
  }
  return code;
}

int output_open(cli_output *out, const char *folder)
{
  *out = (cli_output){.lock = -1};
  out->folder = join_texts(folder, "");
  out->work = join_path(folder, WORK_NAME);
  if (!out->folder || !out->work)
    return complain_of_memory("a file's name");
  int code = make_folders(folder, &out->made_from);
  if (!code && mkdir(out->work, 0777) != 0 && errno != EEXIST)
    code = complain_of_file(folder, "cannot be written to");
  return code ? code : take_lock(out);
}

char *output_path(const cli_output *out, const char *name)
{
  return join_path(out->work, name);
}

char *output_checkpoint_path(const char *folder)
{
  return join_path(folder, WORK_NAME "/" CHECKPOINT_NAME);
}

static int remove_one(const char *folder, const char *name, const void *data)
{
  (void)data;
  return remove_file(folder, name);
}

static bool is_result_or_partial(const char *name)
{
  return is_result(name) || is_partial(name);
}

static int clear_work(const cli_output *out)
{
  int code = remove_file(out->work, CHECKPOINT_NAME);
  if (!code)
    code = remove_file(out->work, PREVIOUS_NAME);
  if (!code)
    code = for_names(out->work, is_result_or_partial, remove_one, NULL);
  if (!code)
    code = remove_file(out->work, REPLACED_NAME);
  return code;
}

/* Removes what a killed run had published, while the reports that name it exist. */
static int remove_half_published(const cli_output *out)
{
  return file_is_there(out->folder, REPORT_NAME) ? EXIT_DONE
                                                 : made_remove(out->folder, out->work);
}

int output_start_anew(const cli_output *out)
{
  int code = remove_half_published(out);
  return code ? code : clear_work(out);
}

static int remove_later(const char *folder, const char *name, const void *data)
{
  const int *scales = data;
  bool kept = strcmp(name, TABLE_NAME) == 0;
  if (scale_of(name) >= 0)
    kept = scale_of(name) < *scales;
  return kept ? EXIT_DONE : remove_file(folder, name);
}

int output_go_on(const cli_output *out, int scales)
{
  int code = remove_half_published(out);
  return code ? code : for_names(out->work, is_result_or_partial, remove_later, &scales);
}

int output_use_previous(const cli_output *out)
{
  char *previous = join_path(out->work, PREVIOUS_NAME);
  char *newest = join_path(out->work, CHECKPOINT_NAME);
  int code = EXIT_DONE;
  if (!previous || !newest)
    code = complain_of_memory("a file's name");
  else if (rename(previous, newest) != 0)
    code = complain_of_file(newest, "cannot be replaced");
  free(previous);
  free(newest);
  return code;
}

static bool is_scale(const char *name)
{
  return scale_of(name) >= 0;
}

static int synchronise_one(const char *folder, const char *name, const void *data)
{
  (void)data;
  return synchronise_file(folder, name);
}

int output_synchronise(const cli_output *out)
{
  return for_names(out->work, is_scale, synchronise_one, NULL);
}

static bool is_result_but_report(const char *name)
{
  return is_result(name) && strcmp(name, REPORT_NAME) != 0;
}

static int duplicate_one(const char *work, const char *name, const void *data)
{
  return duplicate_file(data, name, work);
}

/* Moves the old report to the work folder, where it still names the old results. */
static int set_aside(const cli_output *out)
{
  char *report = join_path(out->folder, REPORT_NAME);
  char *replaced = join_path(out->work, REPLACED_NAME);
  int code = EXIT_DONE;
  if (!report || !replaced)
    code = complain_of_memory("a file's name");
  else if (rename(report, replaced) != 0 && errno != ENOENT)
    code = complain_of_file(report, "cannot be replaced");
  free(report);
  free(replaced);
  return code;
}

/* The new report is already in the work folder, and names the files linked to DIR. */
int output_publish(const cli_output *out)
{
  char foreign[SCALE_NAME_BYTES];
  int code = made_find_foreign(foreign, out->folder, NULL);
  if (!code && foreign[0])
    code = made_complain(out->folder, foreign);
  if (!code)
    code = set_aside(out);
  if (code)
    return code;
  code = made_remove(out->folder, out->work);
  if (!code)
    code = for_names(out->work, is_result_but_report, duplicate_one, out->folder);
  if (!code)
    code = duplicate_file(out->folder, REPORT_NAME, out->work);
  if (code)
    made_remove(out->folder, out->work); /* a failed run leaves no result */
  return code;
}

bool output_close(cli_output *out, bool finished)
{
  bool can_go_on = false;
  if (out->lock >= 0) {
    can_go_on = !finished && has_checkpoint(out->work);
    if (can_go_on) {
      for_names(out->work, is_partial, remove_one, NULL);
      remove_file(out->work, REPORT_NAME); /* names files of the interrupted run */
      remove_file(out->work, REPLACED_NAME);
    } else {
      /* results must be on disk before the checkpoint is removed */
      if (finished && has_checkpoint(out->work)) {
        for_names(out->folder, is_result, synchronise_one, NULL);
        synchronise_folder(out->folder);
      }
      clear_work(out);
    }
    remove_file(out->work, LOCK_NAME);
    if (!can_go_on)
      rmdir(out->work);
    close(out->lock);
  }
  if (out->made_from && out->folder)
    remove_empty_folders(out->folder, out->made_from);
  free(out->folder);
  free(out->work);
  free(out->made_from);
  *out = (cli_output){.lock = -1};
  return can_go_on;
}
