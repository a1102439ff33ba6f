/* Any dataset, in lines of text: what a file of any format may say, whose numbers are
 * made up. A line is a dimension, a variable, or an attribute of the variable before it:
 *
 *     d NAME LENGTH
 *     v NAME TYPE DIMENSIONS FIRST STEP ROW [WAVE]     v u f 10 2 0.5 0
 *     a NAME=TEXT
 *     n NAME=NUMBER
 *
 * TYPE is a letter of TYPES, DIMENSIONS has the number of each as a digit ("-": none). A
 * number is FIRST, and STEP for each sample along the last dimension, ROW along the one
 * before it, and the sine of its place times WAVE. */
#include "fuzz.h"

#include "dataset/dataset.h"
#include "fields.h"
#include "read/format.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

bool fg__fuzz_was_read;

enum { MOST_VARIABLES = 40, MOST_DIMENSIONS = 10, LONGEST = 64, LINE = 256, WORD = 120 };

static const char TYPES[] = "otlbBhHiIqQfd"; /* of fg__type, in its order */

typedef struct made_up {
  double first, step, row, wave;
} made_up;

typedef struct script {
  made_up of[MOST_VARIABLES];
} script;

static double number_at(const made_up *m, const size_t *index, int rank)
{
  const double column = rank > 0 ? (double)index[rank - 1] : 0.0,
               row = rank > 1 ? (double)index[rank - 2] : 0.0;
  double sum = 0.0;
  for (int k = 0; k < rank; ++k)
    sum = 3.0 * sum + (double)index[k];
  return m->first + m->step * column + m->row * row + m->wave * sin(sum);
}

static fg_status fetch(const fg__variable *v, const size_t *start, const size_t *count,
                       double *out)
{
  const script *s = v->owner->file[v->file].state;
  size_t index[FG__RANK], samples = 1;
  for (int k = 0; k < v->rank; ++k) {
    const fg__dimension *d = &v->owner->dimensions[v->dimension[k]];
    assert(start[k] + count[k] <= d->chosen + d->length); /* indices are the file's */
    samples *= count[k];
  }
  for (size_t n = 0; n < samples; ++n) {
    size_t rest = n;
    for (int k = v->rank - 1; k >= 0; --k) {
      index[k] = start[k] + rest % count[k];
      rest /= count[k];
    }
    out[n] = number_at(&s->of[v->id], index, v->rank);
  }
  return FG_STATUS_OK;
}

static fg_status fetch_texts(const fg__variable *v, size_t first, size_t count, char *out,
                             size_t size)
{
  const script *s = v->owner->file[v->file].state;
  for (size_t n = 0; n < count; ++n)
    snprintf(out + n * size, size, "2001-%02d-%02d", (int)(n + first) % 13,
             (int)fmin(99.0, fabs(s->of[v->id].first)));
  return FG_STATUS_OK;
}

static const fg__decoder DECODER = {
    .fetch = fetch, .fetch_texts = fetch_texts, .state_bytes = sizeof(script)};

static fg_status add_dimension(fg__dataset *data, const char *line)
{
  char name[WORD];
  int length;
  if (data->dimension_count == MOST_DIMENSIONS ||
      sscanf(line, "%119s %d", name, &length) != 2 || length < 0 || length > LONGEST)
    return FG_STATUS_OK;
  fg__dimension *d = fg__dataset_add_dimension(data, name, (size_t)length);
  if (!d)
    return FG_STATUS_MEMORY;
  d->unlimited = strstr(line, "unlimited") != NULL;
  d->is_nameless = strstr(line, "nameless") != NULL;
  return FG_STATUS_OK;
}

static fg_status add_variable(fg__dataset *data, script *s, const char *line)
{
  char name[WORD], along[WORD], type;
  made_up m = {0};
  if (data->variable_count == MOST_VARIABLES ||
      sscanf(line, "%119s %c %119s %lf %lf %lf %lf", name, &type, along, &m.first,
             &m.step, &m.row, &m.wave) < 3)
    return FG_STATUS_OK;
  const char *known = strchr(TYPES, type);
  fg__variable *v = fg__dataset_add_variable(data, "", name);
  if (!v)
    return FG_STATUS_MEMORY;
  v->type = known && *known ? (fg__type)(known - TYPES) : FG__TYPE_FLOAT64;
  v->id = (int)data->variable_count - 1;
  v->fits_file = true;
  v->fill = (double)NAN;
  s->of[v->id] = m;
  for (const char *c = along; *c >= '0' && *c <= '9' && v->rank < FG__RANK; ++c)
    if ((size_t)(*c - '0') < data->dimension_count)
      v->dimension[v->rank++] = *c - '0';
  return FG_STATUS_OK;
}

static fg_status add_attribute(fg__dataset *data, const char *line, bool is_text)
{
  char name[WORD];
  const char *equals = strchr(line, '=');
  double number[2];
  if (!equals || equals == line || equals - line >= WORD)
    return FG_STATUS_OK;
  fg__variable *v = data->variable_count > 0 ? &data->variables[data->variable_count - 1]
                                             : &data->groups[0];
  snprintf(name, sizeof name, "%.*s", (int)(equals - line), line);
  if (is_text)
    return fg__variable_add_text(v, name, equals + 1, strlen(equals + 1));
  const int count = sscanf(equals + 1, "%lf,%lf", &number[0], &number[1]);
  return count < 1 ? FG_STATUS_OK
                   : fg__variable_add_numbers(v, name, number, (size_t)count, true);
}

static fg_status add_line(fg__dataset *data, script *s, const char *line)
{
  if (!line[0] || line[1] != ' ')
    return FG_STATUS_OK;
  switch (line[0]) {
  case 'd':
    return add_dimension(data, line + 2);
  case 'v':
    return add_variable(data, s, line + 2);
  default:
    return add_attribute(data, line + 2, line[0] == 'a');
  }
}

static fg_status open_script(fg__dataset *data, fg_context *context,
                             const fg__source *source, const fg_read_options *options)
{
  (void)options;
  fg_status status =
      fg__dataset_begin(data, context, source->path, source->size, &DECODER);
  if (status == FG_STATUS_OK && !fg__dataset_add_group(data))
    status = FG_STATUS_MEMORY;
  if (status != FG_STATUS_OK)
    return status;
  script *s = data->file[data->files - 1].state;
  const char *text = (const char *)source->bytes;
  for (size_t at = 0, next; at < source->size && status == FG_STATUS_OK; at = next + 1) {
    char line[LINE];
    for (next = at; next < source->size && text[next] != '\n';)
      ++next;
    snprintf(line, sizeof line, "%.*s", (int)fmin((double)(next - at), LINE - 1.0),
             text + at);
    status = add_line(data, s, line);
  }
  return status;
}

static bool is_script(const unsigned char *bytes, size_t size)
{
  return size > 1 && bytes[1] == ' ';
}

static const fg__format fg__format_script = {
    .name = "script", .files = "scripts", .is_mine = is_script, .open = open_script};

/* The same with options: what is chosen by the size, so that each corpus has all. */
static void try_options(const uint8_t *bytes, size_t size)
{
  static const fg_read_options options[] = {
      {.frame = FG_FRAME_GRID},    {.frame = FG_FRAME_EAST}, {.scale = FG_SCALE_PLAIN},
      {.scale = FG_SCALE_GEO},     {.scale = FG_SCALE_MAP},  {.time = 1, .level = 1},
      {.missing = "none"},         {.vars = "u,v"},          {.vars = "u,v,w"},
      {.vars = "speed,direction"}, {.at = "member=1"},       {.mask = "mask"}};
  fg_context *context;
  fg__sphere *sphere = NULL;
  if (!is_script(bytes, size) || fg_context_create(&context))
    return;
  const fg__source source = {.path = "fuzz.script", .bytes = bytes, .size = size};
  const fg_read_options *chosen = &options[size % (sizeof options / sizeof *options)];
  read_part(&fg__format_script, context, &source, chosen, (fg__slab_index){0, 1});
  if (fg__dataset_sphere(&sphere, context, &fg__format_script, &source, chosen) ==
      FG_STATUS_OK)
    fg__sphere_destroy(sphere);
  fg_context_destroy(context);
}

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size)
{
  fg__fuzz_was_read = try_format(&fg__format_script, "fuzz.script", bytes, size);
  try_options(bytes, size);
  return 0;
}
