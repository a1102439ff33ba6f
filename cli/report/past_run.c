#include "report/past_run.h"

#include <errno.h>
#include <fcntl.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "folder/files.h"
#include "option/recorded.h"
#include "option/table.h"
#include "report/json.h"

/* Opening a pipe would block, and a device may have no end. */
static FILE *open_regular(const char *path)
{
  int file = open(path, O_RDONLY | O_NONBLOCK | O_CLOEXEC);
  struct stat about;
  FILE *stream = NULL;
  if (file >= 0 && fstat(file, &about) == 0 && !S_ISREG(about.st_mode))
    errno = S_ISDIR(about.st_mode) ? EISDIR : EINVAL;
  else if (file >= 0)
    stream = fdopen(file, "rb");
  if (!stream && file >= 0) {
    int error = errno;
    close(file);
    errno = error;
  }
  return stream;
}

char *read_text(const char *path)
{
  FILE *stream = open_regular(path);
  if (!stream) {
    complain_of_file(path, "cannot be read");
    return NULL;
  }
  char *text = NULL;
  size_t used = 0, capacity = 0, got = 0;
  do {
    used += got;
    if (capacity - used < 4096) {
      capacity = capacity ? 2 * capacity : 65536;
      char *larger = realloc(text, capacity);
      if (!larger) {
        complain("%s: out of memory: %zu bytes", path, capacity);
        free(text);
        fclose(stream);
        return NULL;
      }
      text = larger;
    }
    got = fread(text + used, 1, capacity - used - 1, stream);
  } while (got);
  text[used] = '\0';
  if (ferror(stream)) {
    complain_of_file(path, "cannot be read");
    free(text);
    text = NULL;
  }
  fclose(stream);
  return text;
}

static const char *text_of(const cJSON *object, const char *name)
{
  return cJSON_GetStringValue(cJSON_GetObjectItemCaseSensitive(object, name));
}

/* A number of run.json within [least, most]; `otherwise` if it is missing or NaN. */
static double number_of(const cJSON *object, const char *name, double least, double most,
                        double otherwise)
{
  const cJSON *item = cJSON_GetObjectItemCaseSensitive(object, name);
  if (!cJSON_IsNumber(item) || !(item->valuedouble >= least) ||
      !(item->valuedouble <= most))
    return otherwise;
  return item->valuedouble;
}

/* Parses a folder's run.json; NULL: missing or unreadable. */
static cJSON *read_tree(const char *folder)
{
  if (!file_is_there(folder, REPORT_NAME))
    return NULL;
  char *path = join_path(folder, REPORT_NAME);
  char *text = path ? read_text(path) : NULL;
  cJSON *tree = json_parse(text);
  free(text);
  free(path);
  return tree;
}

run_outcome report_outcome(const char *folder)
{
  if (!file_is_there(folder, REPORT_NAME))
    return OUTCOME_NONE;
  cJSON *tree = read_tree(folder);
  const char *ended = text_of(tree, "ended");
  run_outcome outcome = OUTCOME_COMPLETE;
  if (ended && strcmp(ended, "interrupted") == 0)
    outcome = OUTCOME_INTERRUPTED;
  if (ended && (strcmp(ended, "time") == 0 || strcmp(ended, "steps") == 0))
    outcome = OUTCOME_LIMIT;
  cJSON_Delete(tree);
  return outcome;
}

bool report_has_page(const char *folder)
{
  cJSON *tree = read_tree(folder);
  const char *program = text_of(tree, "program"), *page = text_of(tree, "page");
  const bool has = program && strcmp(program, "flowgrain") == 0 && page &&
                   strcmp(page, VIEW_NAME) == 0 && file_is_there(folder, VIEW_NAME);
  cJSON_Delete(tree);
  return has;
}

bool report_is_of(const char *folder, const run_settings *settings)
{
  cli_report report;
  bool same = !report_read(&report, folder);
  if (same) {
    const cJSON *input = cJSON_GetObjectItemCaseSensitive(report.tree, "input");
    same = files_match(input, &settings->reading, folder);
  }
  if (same)
    same =
        options_match(cJSON_GetObjectItemCaseSensitive(report.tree, "options"), settings);
  report_clear(&report);
  return same;
}

static const cJSON *scale_at(const cli_report *report, int index)
{
  return cJSON_GetArrayItem(cJSON_GetObjectItemCaseSensitive(report->tree, "scales"),
                            index);
}

/* Copies up to `most` numbers; returns how many there are. */
static int fill_numbers(double *out, int most, const cJSON *list)
{
  const int count = cJSON_GetArraySize(list);
  for (int k = 0; k < count && k < most; ++k) {
    const cJSON *item = cJSON_GetArrayItem(list, k);
    if (!cJSON_IsNumber(item))
      return 0;
    out[k] = item->valuedouble;
  }
  return count <= most ? count : 0;
}

/* Earlier versions had no maps. */
static void fill_map(cli_report *out, const cJSON *map)
{
  const char *projection = text_of(map, "projection");
  out->map.projection = projection ? projection : map ? "auto" : "none";
  const int numbers =
      fill_numbers(out->map.center, 2, cJSON_GetObjectItemCaseSensitive(map, "center"));
  out->map.has_center = numbers > 0;
  out->map.has_center_latitude = numbers == 2;
  const int bounds =
      fill_numbers(out->map.region, 6, cJSON_GetObjectItemCaseSensitive(map, "region"));
  out->map.has_region = bounds == 4 || bounds == 6;
  out->map.region_is_box = bounds == 6;
  out->map.samples = (int)number_of(map, "samples", 0.0, 1e9, 0.0);
  out->reading.map = &out->map;
}

static void fill_reading(cli_report *out, const cJSON *input)
{
  out->reading.vars = text_of(input, "vars");
  out->reading.vars_from = text_of(input, "vars_from");
  out->reading.mesh_from = text_of(input, "mesh_from");
  out->reading.at = text_of(input, "at");
  out->reading.mask = text_of(input, "mask");
  out->reading.missing = text_of(input, "missing");
  out->reading.block = text_of(input, "block");
  out->reading.slice = text_of(input, "slice");
  out->reading.time = (int)number_of(input, "time", 0.0, 1e9, 0.0);
  out->reading.level = (int)number_of(input, "level", 0.0, 1e9, 0.0);
  const char *scale = text_of(input, "scale");
  for (int k = 0; scale && scale_words[k]; ++k)
    if (strcmp(scale, scale_words[k]) == 0)
      out->reading.scale = (fg_scale)k;
  const char *frame = text_of(input, "frame");
  for (int k = 0; frame && frame_words[k]; ++k)
    if (strcmp(frame, frame_words[k]) == 0)
      out->reading.frame = (fg_frame)k;
  fill_map(out, cJSON_GetObjectItemCaseSensitive(input, "map"));
  out->input = text_of(input, "path");
  out->input_absolute = text_of(input, "absolute");
}

/* Only placed arrows have lengths to choose. */
static void fill_placement(cli_report *out, const cJSON *parameters)
{
  const char *lengths = text_of(parameters, "lengths");
  out->placed = lengths != NULL;
  out->lengths =
      lengths && strcmp(lengths, "fair") == 0 ? FG_LENGTHS_FAIR : FG_LENGTHS_FREE;
}

int report_read(cli_report *out, const char *folder)
{
  memset(out, 0, sizeof *out);
  char *path = join_path(folder, REPORT_NAME);
  char *text = path ? read_text(path) : NULL;
  int code = EXIT_FAILED;
  if (path && !text && access(path, F_OK) != 0)
    advise("Name the folder of a finished `flowgrain run`.");
  if (!text)
    goto cleanup;
  out->tree = json_parse(text);
  fill_reading(out, cJSON_GetObjectItemCaseSensitive(out->tree, "input"));
  fill_placement(out, cJSON_GetObjectItemCaseSensitive(out->tree, "parameters"));
  const cJSON *mesh = cJSON_GetObjectItemCaseSensitive(out->tree, "mesh");
  out->dimension = (int)number_of(mesh, "dimension", 2.0, 3.0, 2.0);
  const cJSON *scales = cJSON_GetObjectItemCaseSensitive(out->tree, "scales");
  out->scale_count = cJSON_GetArraySize(scales);
  const cJSON *range = cJSON_GetObjectItemCaseSensitive(out->tree, "speed_range");
  for (int k = 0; k < 2; ++k) {
    const cJSON *end = cJSON_GetArrayItem(range, k);
    out->speeds[k] = cJSON_IsNumber(end) ? end->valuedouble : 0.0;
  }
  const cJSON *view = cJSON_GetObjectItemCaseSensitive(out->tree, "view");
  out->has_view = cJSON_GetArraySize(view) == 2;
  for (int k = 0; k < 2; ++k) {
    const cJSON *angle = cJSON_GetArrayItem(view, k);
    out->has_view = out->has_view && cJSON_IsNumber(angle);
    out->view[k] = out->has_view ? angle->valuedouble : 0.0;
  }
  if (!out->input || out->scale_count < 1)
    complain("%s: is not the report of a finished run (%s)", path,
             out->tree ? "it names no input or no scales" : "it is not JSON");
  else
    code = EXIT_DONE;
cleanup:
  free(text);
  free(path);
  return code;
}

int report_scale_clusters(const cli_report *report, int index)
{
  return (int)number_of(scale_at(report, index), "clusters", 0.0, 1e9, 0.0);
}

int report_scale_arrows(const cli_report *report, int index)
{
  return (int)number_of(scale_at(report, index), "icons", 0.0, 1e9, 0.0);
}

const char *report_scale_icons(const cli_report *report, int index)
{
  return text_of(scale_at(report, index), "geojson");
}

const char *report_scale_density(const cli_report *report, int index)
{
  return text_of(scale_at(report, index), "vti");
}

double report_scale_time(const cli_report *report, int index)
{
  return number_of(scale_at(report, index), "time", 0.0, 1e300, 0.0);
}

/* Ends of axes are rounded as text and by unit conversion; smaller relative differences
 * count as equal. */
static const double same_share = 1e-6;

static double number_at(const cJSON *list, int index)
{
  const cJSON *item = cJSON_GetArrayItem(list, index);
  return cJSON_IsNumber(item) ? item->valuedouble : (double)NAN;
}

bool report_is_of_field(const cli_report *report, const char *folder, const char *input,
                        const fg_field *field)
{
  const cJSON *recorded = cJSON_GetObjectItemCaseSensitive(report->tree, "field");
  const cJSON *size = cJSON_GetObjectItemCaseSensitive(recorded, "size");
  const cJSON *bounds = cJSON_GetObjectItemCaseSensitive(recorded, "bounds");
  const char *scale = text_of(recorded, "scale");
  const fg_field_arrays *got = fg_field_contents(field);
  if (!cJSON_IsArray(size) || !cJSON_IsArray(bounds))
    return true; /* not recorded */
  int dimension = cJSON_GetArraySize(size);
  if (dimension != got->dimension) {
    complain("%s: %s is a field in %d dimensions, and the run's is in %d", folder, input,
             got->dimension, dimension);
    return false;
  }
  for (int k = 0; k < dimension; ++k) {
    double samples = number_at(size, k);
    double low = number_at(bounds, 2 * k), high = number_at(bounds, 2 * k + 1);
    double first = got->axis[k][0], last = got->axis[k][got->size[k] - 1];
    double slack = same_share * fabs(high - low);
    if (samples == got->size[k] && fabs(first - low) <= slack &&
        fabs(last - high) <= slack)
      continue;
    complain("%s: %s has %d samples from %g to %g along axis %d, and the run's field has "
             "%g from %g to %g",
             folder, input, got->size[k], first, last, k + 1, samples, low, high);
    return false;
  }
  if (!scale || strcmp(scale, scale_words[got->scale]) == 0)
    return true;
  complain("%s: the scale of %s is %s, and the run's is %s", folder, input,
           scale_words[got->scale], scale);
  return false;
}

void report_clear(cli_report *report)
{
  cJSON_Delete(report->tree);
  memset(report, 0, sizeof *report);
}
