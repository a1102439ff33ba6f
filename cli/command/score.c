/* Prints the error with which icons represent a field. */
#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "command/command.h"
#include "inputs.h"
#include "option/table.h"
#include "report/json.h"
#include "series/places.h"

typedef struct score_work {
  const score_settings *settings;
  fg_context *context;
  fg_field *field;
  fg_score *scores; /* one for each file */
} score_work;

static int score_file(score_work *work, int number)
{
  const score_settings *settings = work->settings;
  const char *path = settings->files.operand[number];
  const fg_score_options options = {
      .lengths = (fg_score_class)settings->length_class,
      .count = settings->icons.count ? settings->icons.number[0] : 0,
      .ink = settings->ink,
  };
  fg_icons *icons = NULL;
  fg_status status = fg_icons_read(&icons, work->context, path);
  if (!status)
    status = fg_icons_project(&icons, work->context, work->field);
  if (!status)
    status = fg_icons_score(&work->scores[number], work->context, work->field, icons,
                            &options);
  if (!status && fg_icons_count(icons) > 0 && work->scores[number].outside >= 1.0)
    complain("%s: all its icons lie outside the field", path);
  fg_icons_destroy(icons);
  return status ? complain_of(work->context, status, path) : EXIT_DONE;
}

static int prepare(score_work *work)
{
  const score_settings *settings = work->settings;
  int code = create_context(&work->context);
  if (!code)
    code = places_read(&work->field, work->context, &settings->reading);
  if (code)
    return code;
  work->scores = calloc((size_t)settings->files.count, sizeof *work->scores);
  if (work->scores)
    return EXIT_DONE;
  complain("out of memory for %d scores", settings->files.count);
  return EXIT_FAILED;
}

/* Prints a number in a column of this width, NAN as a dash. */
static void print_number(double number, int columns, int decimals)
{
  if (isfinite(number))
    printf(" %*.*f", columns, decimals, number);
  else
    printf(" %*s", columns, "-");
}

static void print_row(const fg_score *score, const char *path)
{
  printf("%6d", score->icons);
  print_number(score->diffusion.mean, 6, 2);
  print_number(score->nearest.mean, 7, 2);
  print_number(score->inverse_distance.mean, 9, 2);
  print_number(score->mean, 6, 2);
  print_number(score->percentile_95, 6, 1);
  print_number(score->advection, 6, 3);
  print_number(score->critical_f1, 5, 2);
  print_number(score->void_mean, 6, 3);
  print_number(score->void_max, 7, 2);
  print_number(score->ink, 5, 2);
  print_number(100.0 * score->clutter, 8, 1);
  print_number(score->tangency, 8, 2);
  print_number(100.0 * score->outside, 8, 1);
  fputs("  ", stdout);
  for (; *path; ++path)
    putchar(iscntrl((unsigned char)*path) ? '?' : *path);
  putchar('\n');
}

static void print_table(const score_work *work)
{
  puts(" icons  E_ang nearest inv.dist.  mean   95 %  E_adv    F1   void largest   ink "
       "clutter% tangency outside%  file");
  for (int n = 0; n < work->settings->files.count; ++n)
    print_row(&work->scores[n], work->settings->files.operand[n]);
  /* name the class, as errors of the two classes differ */
  puts(work->settings->length_class == FG_SCORE_FREE
           ? "--class free: lines count as long as they are, as in the captions of "
             "pictures. --class arrows\ncompares methods whose lines differ in length."
           : "--class arrows: longer lines count for their middle fair-share length, so "
             "that methods whose\nlines differ in length compare. --class free: as they "
             "are, as in the captions of pictures.");
}

static void add_reader(cJSON *object, const char *name, const fg_reader_error *error)
{
  cJSON *reader = cJSON_AddObjectToObject(object, name);
  cJSON_AddNumberToObject(reader, "mean", error->mean);
  cJSON_AddNumberToObject(reader, "percentile_95", error->percentile_95);
  cJSON_AddNumberToObject(reader, "speed_weighted", error->speed_weighted);
}

/* NAN becomes null. */
static cJSON *describe(const fg_score *score, const char *path)
{
  const struct {
    const char *name;
    double number;
  } members[] = {{"mean", score->mean},
                 {"percentile_95", score->percentile_95},
                 {"advection", score->advection},
                 {"critical_f1", score->critical_f1},
                 {"void_mean", score->void_mean},
                 {"void_max", score->void_max},
                 {"ink", score->ink},
                 {"clutter", score->clutter},
                 {"tangency", score->tangency},
                 {"outside", score->outside},
                 {"shortest", score->shortest},
                 {"longest", score->longest}};
  cJSON *object = cJSON_CreateObject();
  cJSON_AddStringToObject(object, "file", path);
  cJSON_AddNumberToObject(object, "icons", score->icons);
  cJSON_AddNumberToObject(object, "count_length", score->count_length);
  add_reader(object, "diffusion", &score->diffusion);
  add_reader(object, "nearest", &score->nearest);
  add_reader(object, "inverse_distance", &score->inverse_distance);
  for (size_t n = 0; n < sizeof members / sizeof members[0]; ++n)
    cJSON_AddNumberToObject(object, members[n].name, members[n].number);
  return object;
}

static int print_json(const score_work *work)
{
  cJSON *root = cJSON_CreateArray();
  for (int n = 0; n < work->settings->files.count; ++n)
    cJSON_AddItemToArray(root,
                         describe(&work->scores[n], work->settings->files.operand[n]));
  char *text = json_print(root);
  if (text)
    puts(text);
  else
    complain("out of memory for the JSON text");
  const int code = text ? EXIT_DONE : EXIT_FAILED;
  cJSON_free(text);
  cJSON_Delete(root);
  return code;
}

/* Prints nothing unless all files can be scored. */
int command_score(const void *given)
{
  const score_settings *settings = given;
  score_work work = {.settings = settings};
  int code = prepare(&work);
  for (int n = 0; !code && n < settings->files.count; ++n)
    code = score_file(&work, n);
  if (!code && settings->json)
    code = print_json(&work);
  else if (!code)
    print_table(&work);
  free(work.scores);
  fg_field_destroy(work.field);
  fg_context_destroy(work.context);
  return code;
}
