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

#define WORK_NAME ".flowgrain"
#define LOCK_NAME "lock"
#define PREVIOUS_NAME CHECKPOINT_NAME ".previous"
/* There from the first change to DIR on: until DIR/run.json is there, too, every result
 * in DIR is one of the run that was killed in publishing it. */
#define MARK_NAME "publishing"

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

/* What is not of the program's making may lead anywhere, or to nothing. */
static int check_work(const char *work, const char *lock)
{
  struct stat found;
  if (lstat(work, &found) == 0 && !is_plain_folder(work))
    return refuse_kind(work, "folder");
  if (lstat(lock, &found) == 0 && !is_plain_file(lock))
    return refuse_kind(lock, "file");
  return EXIT_DONE;
}

/* A run that is killed loses its lock. A file system without locks lets all pass. */
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

/* Whether a run had published its report, and was killed in tidying up. */
static bool report_is_published(const char *folder, const char *work)
{
  bool same = false;
  if (file_is_there(folder, REPORT_NAME) && file_is_there(work, REPORT_NAME)) {
    char *one_path = join_path(folder, REPORT_NAME);
    char *other_path = join_path(work, REPORT_NAME);
    char *one = one_path ? read_text(one_path) : NULL;
    char *other = other_path ? read_text(other_path) : NULL;
    same = one && other && strcmp(one, other) == 0;
    free(one);
    free(other);
    free(one_path);
    free(other_path);
  }
  return same;
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

static bool is_half_published(const char *folder, const char *work)
{
  return file_is_there(work, MARK_NAME) && !file_is_there(folder, REPORT_NAME);
}

int output_look(output_contents *out, const char *folder)
{
  *out = (output_contents){.state = OUTPUT_EMPTY};
  output_state *state = &out->state;
  char *work = join_path(folder, WORK_NAME);
  if (!work)
    return complain_of_memory("a file's name");
  if (!is_half_published(folder, work)) {
    int code = made_find_foreign(out->foreign, folder);
    if (code || out->foreign[0]) {
      free(work);
      return code;
    }
  }
  run_ending ending = report_ending(folder);
  bool complete = ending == ENDING_COMPLETE && report_is_published(folder, work);
  if (has_checkpoint(work) && !complete)
    *state = OUTPUT_UNFINISHED;
  else if (ending == ENDING_INTERRUPTED)
    *state = OUTPUT_INTERRUPTED;
  else if (ending != ENDING_NONE)
    *state = OUTPUT_FINISHED;
  free(work);
  return EXIT_DONE;
}

/* Takes the lock of the folder of the work. Its last owner may be about to remove file
 * and folder: a lock on what has no name any more is none, and *again says so. */
static int take_lock(cli_output *out, bool *again)
{
  *again = false;
  char *path = join_path(out->work, LOCK_NAME);
  if (!path)
    return complain_of_memory("a file's name");
  int code = check_work(out->work, path);
  if (code) {
    free(path);
    return code;
  }
  out->lock = open(path, O_RDWR | O_CREAT | O_NOFOLLOW | O_CLOEXEC, 0666);
  struct flock lock = {.l_type = F_WRLCK, .l_whence = SEEK_SET};
  struct stat held, named;
  if (out->lock < 0 && errno == ENOENT)
    *again = true;
  else if (out->lock < 0)
    code = complain_of_file(out->folder, "cannot be written to");
  else if (fcntl(out->lock, F_SETLK, &lock) != 0 && (errno == EACCES || errno == EAGAIN))
    code = fcntl(out->lock, F_GETLK, &lock) == 0 && lock.l_type != F_UNLCK
               ? complain_of_rival(out->folder, &lock)
               : complain_of_file(out->folder, "another run is writing to it");
  else
    *again = fstat(out->lock, &held) != 0 || stat(path, &named) != 0 ||
             held.st_ino != named.st_ino || held.st_dev != named.st_dev;
  free(path);
  if ((code || *again) && out->lock >= 0) {
    close(out->lock);
    out->lock = -1;
  }
  return code;
}

/* For a lock: each is lost to another run that ends. */
enum { MOST_TRIES = 1000 };

int output_open(cli_output *out, const char *folder)
{
  *out = (cli_output){.lock = -1};
  out->folder = join_texts(folder, "");
  out->work = join_path(folder, WORK_NAME);
  if (!out->folder || !out->work)
    return complain_of_memory("a file's name");
  int code, tries = 0;
  bool again;
  do {
    code = make_folders(folder, &out->made_from);
    if (!code && mkdir(out->work, 0777) != 0 && errno != EEXIST && errno != ENOENT)
      code = complain_of_file(folder, "cannot be written to");
    again = false;
    if (!code)
      code = take_lock(out, &again);
  } while (again && ++tries < MOST_TRIES);
  if (again) {
    complain("%s: the lock of its runs does not stay where it was put", folder);
    code = EXIT_FAILED;
  }
  return code;
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
    code = remove_file(out->work, MARK_NAME);
  return code;
}

int output_start_anew(const cli_output *out)
{
  int code = EXIT_DONE;
  if (is_half_published(out->folder, out->work))
    code = for_names(out->folder, is_result_or_partial, remove_one, NULL);
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
  return for_names(out->work, is_result_or_partial, remove_later, &scales);
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

static int make_mark(const cli_output *out)
{
  char *path = join_path(out->work, MARK_NAME);
  if (!path)
    return complain_of_memory("a file's name");
  int code = EXIT_DONE,
      file = open(path, O_WRONLY | O_CREAT | O_NOFOLLOW | O_CLOEXEC, 0666);
  if (file < 0 || close(file) != 0)
    code = complain_of_file(path, "cannot be written");
  free(path);
  return code;
}

/* Nothing but results of runs may be there to be replaced. */
static int begin_to_publish(const cli_output *out)
{
  if (is_half_published(out->folder, out->work))
    return EXIT_DONE;
  char foreign[SCALE_NAME_BYTES];
  int code = made_find_foreign(foreign, out->folder);
  if (!code && foreign[0])
    code = made_complain(out->folder, foreign);
  return code ? code : make_mark(out);
}

int output_publish(const cli_output *out)
{
  int code = begin_to_publish(out);
  if (code)
    return code;
  code = remove_file(out->folder, REPORT_NAME);
  if (!code)
    code = for_names(out->folder, is_result_or_partial, remove_one, NULL);
  if (!code)
    code = for_names(out->work, is_result_but_report, duplicate_one, out->folder);
  if (!code)
    code = duplicate_file(out->folder, REPORT_NAME, out->work);
  if (code)
    /* a failed run leaves no picture, not even half of its own */
    for_names(out->folder, is_result_or_partial, remove_one, NULL);
  return code;
}

bool output_close(cli_output *out, bool finished)
{
  bool can_go_on = false;
  if (out->lock >= 0) {
    can_go_on = !finished && has_checkpoint(out->work);
    if (can_go_on)
      for_names(out->work, is_partial, remove_one, NULL);
    else {
      /* results must be on the disk before what they could be made from goes */
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
