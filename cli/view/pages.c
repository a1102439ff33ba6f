#include "view/pages.h"

#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "folder/file.h"
#include "folder/results.h"
#include "report/json.h"

/* Larger files are not pages. */
enum { MOST_BYTES = 1 << 28 };

static char *read_bytes(size_t *size, int file)
{
  struct stat about;
  if (fstat(file, &about) != 0 || !S_ISREG(about.st_mode) || about.st_size > MOST_BYTES)
    return NULL;
  char *bytes = malloc((size_t)about.st_size + 1);
  size_t used = 0;
  while (bytes && used < (size_t)about.st_size) {
    const ssize_t got = read(file, bytes + used, (size_t)about.st_size - used);
    if (got <= 0)
      break;
    used += (size_t)got;
  }
  *size = used;
  return bytes;
}

/* Follows no symbolic link, which could lead out of the folder. */
static bool give_file(cli_answer *out, const char *folder, const char *name,
                      const char *kind)
{
  char *path = join_path(folder, name);
  int file = path ? open(path, O_RDONLY | O_NONBLOCK | O_NOFOLLOW | O_CLOEXEC) : -1;
  free(path);
  if (file < 0)
    return false;
  size_t size = 0;
  char *bytes = read_bytes(&size, file);
  close(file);
  if (bytes)
    *out = (cli_answer){.kind = kind, .bytes = bytes, .size = size, .owned = bytes};
  return bytes != NULL;
}

/* The folder with the run's files. NULL without memory; to be freed. */
static char *find_folder(const cli_child *child)
{
  return child->process ? join_path(child->folder, WORK_NAME)
                        : join_texts(child->folder, "");
}

static const char *kind_of(const char *name)
{
  return ends_with(name, ".svg")       ? "image/svg+xml"
         : ends_with(name, ".png")     ? "image/png"
         : ends_with(name, ".geojson") ? "application/geo+json"
                                       : NULL;
}

/* The file may be in the work folder or, when the run has ended, in DIR; at the end files
 * move one by one. */
static void give_result(cli_answer *out, const cli_child *child, const char *folder,
                        const char *name)
{
  if (!give_file(out, folder, name, kind_of(name)) && child->process)
    give_file(out, child->folder, name, kind_of(name));
}

/* Lists the pictures of scales whose icons exist, too, as the page counts them. */
static void add_pictures(cJSON *state, const char *folder)
{
  static const char *const ends[] = {".svg", ".png"};
  cJSON *pictures = cJSON_AddArrayToObject(state, "pictures");
  for (int index = 0; index < MAX_SCALES; ++index) {
    char name[SCALE_NAME_BYTES];
    bool found = false;
    scale_name(name, index, ".geojson");
    if (!file_is_there(folder, name))
      return;
    for (int k = 0; k < 2 && !found; ++k) {
      scale_name(name, index, ends[k]);
      found = file_is_there(folder, name);
    }
    if (!found)
      return;
    cJSON_AddItemToArray(pictures, cJSON_CreateString(name));
  }
}

static void give_state(cli_answer *out, const view_pages *pages, const char *folder)
{
  const cli_child *child = pages->child;
  char clean[CLEAN_BYTES];
  cJSON *state = cJSON_CreateObject();
  cJSON_AddStringToObject(state, "input", clean_text(clean, input_name(pages->input)));
  cJSON_AddBoolToObject(state, "ended", !child->process);
  cJSON_AddBoolToObject(state, "page",
                        !child->process && file_is_there(folder, VIEW_NAME));
  cJSON_AddStringToObject(state, "doing", child->doing);
  cJSON_AddNumberToObject(state, "share", child->share);
  cJSON_AddNumberToObject(state, "densities", child->densities.count);
  add_pictures(state, folder);
  char *text = json_print(state);
  cJSON_Delete(state);
  if (text)
    *out = (cli_answer){
        .kind = "application/json", .bytes = text, .size = strlen(text), .owned = text};
}

static void give_page(cli_answer *out, const cli_child *child, const char *folder)
{
  if (!child->process && give_file(out, folder, VIEW_NAME, "text/html"))
    return;
  *out = (cli_answer){.kind = "text/html",
                      .bytes = (const char *)view_live_page,
                      .size = view_live_page_size};
}

/* The number in "density-7"; negative: another name. */
static int density_of(const char *name)
{
  static const char begin[] = "density-";
  const size_t length = sizeof begin - 1;
  if (strncmp(name, begin, length) != 0 || !name[length] ||
      strspn(name + length, "0123456789") != strlen(name + length) ||
      strlen(name + length) > 4)
    return -1;
  return atoi(name + length);
}

static void give_density(cli_answer *out, const view_densities *densities, int index)
{
  if (index >= 0 && index < densities->count)
    *out = (cli_answer){.kind = "application/octet-stream",
                        .bytes = (const char *)densities->bytes[index],
                        .size = densities->size[index]};
}

void pages_give(cli_answer *out, const char *name, void *data)
{
  const view_pages *pages = data;
  char *folder = find_folder(pages->child);
  if (!folder)
    return;
  if (!*name)
    give_page(out, pages->child, folder);
  else if (strcmp(name, "state") == 0)
    give_state(out, pages, folder);
  else if (scale_of(name) >= 0 && kind_of(name))
    give_result(out, pages->child, folder, name);
  else
    give_density(out, &pages->child->densities, density_of(name));
  free(folder);
}
