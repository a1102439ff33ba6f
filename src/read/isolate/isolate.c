#include "read/isolate/isolate.h"

#include "decode/signature.h"
#include "read/isolate/wire.h"

#include <limits.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

/* Bound of CPU time, as damaged files can cause an endless loop. Valid files take time in
 * proportion to their bytes, and their arrays are at most a thousand times as large
 * (deflate). The bound is one second, plus one for each 25 kB, but at most a minute plus
 * one for each 20 MB, as large files are less compressed. Valid files need half of it, or
 * less: GRIB of 20 million points, 1 MB by CCSDS, takes 18 s. What an HDF5 file holds is
 * found in less: one second, plus one for each 250 kB.
 */
enum {
  SMALL_BYTES_A_SECOND = 25000,
  LISTED_BYTES_A_SECOND = 250000,
  BYTES_A_SECOND = 20000000,
  MOST_SECONDS = 60,
  TIMES_LARGER = 4096,
  MOST_FILES = 4096 /* that are named */
};
static const size_t MOST_BYTES = (size_t)1 << 30;
static const char HDF5[] = "HDF5";

static const char *library_of(const fg__source *source)
{
  if (fg__nc_kind_of(source->bytes, source->size) == FG__NC_HDF5 ||
      fg__is_xdmf(source->bytes, source->size))
    return HDF5;
  return fg__is_grib(source->bytes, source->size) ? "ecCodes" : NULL;
}

static void add_source(fg__isolation *out, const fg__source *source)
{
  const char *library = library_of(source);
  if (library) {
    out->library = library;
    out->bytes += source->size;
  }
}

static void add_file(fg__isolation *out, const char *path)
{
  fg__source source;
  if (path && fg__source_open(&source, NULL, path) == FG_STATUS_OK)
    add_source(out, &source);
  if (path)
    fg__source_close(&source, NULL, FG_STATUS_OK);
}

/* The files that markup names as "file:array", in its folder: those that follow one
 * another once. */
static void add_named(fg__isolation *out, const fg__source *source)
{
  char before[PATH_MAX] = "", path[PATH_MAX];
  const char *text = (const char *)source->bytes;
  if (!source->on_disk || !fg__is_xdmf(source->bytes, source->size))
    return;
  const char *slash = strrchr(source->path, '/');
  const int folder = slash ? (int)(slash - source->path) + 1 : 0;
  for (size_t at = 0, start = 0, files = 0; at < source->size && files < MOST_FILES; ++at)
    if (text[at] && strchr("> \t\r\n\"", text[at])) {
      start = at + 1;
    } else if (text[at] == ':' && at > start && at - start < NAME_MAX) {
      snprintf(path, sizeof path, "%.*s%.*s", folder, source->path, (int)(at - start),
               text + start);
      if (strcmp(path, before) != 0) {
        add_file(out, path);
        ++files;
      }
      memcpy(before, path, sizeof path);
    }
}

void fg__isolation_find(fg__isolation *out, const fg_input *input)
{
  *out = (fg__isolation){.library = NULL};
  add_source(out, &input->source);
  add_named(out, &input->source);
  add_file(out, input->options.vars_from);
  add_file(out, input->options.mesh_from);
}

static unsigned seconds_for(const fg__isolation *isolation, fg__question_kind kind)
{
  const bool lists = kind != FG__ASK_FIELD && isolation->library == HDF5;
  const size_t size = isolation->bytes;
  const size_t small = 1 + size / (lists ? LISTED_BYTES_A_SECOND : SMALL_BYTES_A_SECOND);
  const size_t large = MOST_SECONDS + size / BYTES_A_SECOND;
  return (unsigned)(small < large ? small : large);
}

static size_t bytes_for(const fg__isolation *isolation)
{
  const size_t most = (SIZE_MAX / 4 - MOST_BYTES) / TIMES_LARGER;
  return MOST_BYTES + TIMES_LARGER * (isolation->bytes < most ? isolation->bytes : most);
}

/* An answer, or why there is none. */
static void pass_answer(fg__wire *wire, fg__answer *answer, fg_status *status,
                        fg__question_kind kind, const char *texts[2])
{
  fg__wire_bytes(wire, status, sizeof *status);
  if (wire->status != FG_STATUS_OK)
    return;
  if (*status != FG_STATUS_OK) {
    fg__wire_text(wire, &texts[0]);
    fg__wire_text(wire, &texts[1]);
  } else if (kind == FG__ASK_FIELD) {
    fg__wire_field(wire, &answer->field);
  } else {
    fg__wire_inventory(wire, &answer->inventory);
  }
}

/* What the child process does. */
typedef struct service {
  fg_input *input;
  fg_input_options options;
} service;

static void serve_one(fg_input *input, fg_context *context, fg__wire *wire,
                      const fg__question *question)
{
  fg__answer answer;
  fg__child_bound(seconds_for(&input->isolation, question->kind),
                  bytes_for(&input->isolation));
  fg_status status = input->answer(&answer, context, input, question);
  fg__child_unbound();
  const char *texts[2] = {fg_context_message(context), fg_context_hint(context)};
  pass_answer(wire, &answer, &status, question->kind, texts);
  fg_inventory_destroy(answer.inventory);
  fg_field_destroy(answer.field);
  fg_context_clear(context);
}

static void serve(void *data, int socket)
{
  service *s = data;
  fg_context *context;
  fg__question question;
  fg__wire in = {.socket = socket}, out = {.socket = socket, .sends = true};
  if (fg_context_create(&context) != FG_STATUS_OK)
    return;
  fg_context_set_input(context, &s->options);
  for (;;) {
    fg__wire_bytes(&in, &question, sizeof question);
    if (in.status != FG_STATUS_OK || out.status != FG_STATUS_OK)
      return;
    serve_one(s->input, context, &out, &question);
  }
}

static bool start(fg_input *input, fg_context *context)
{
  service s = {input, *fg__context_input(context)};
  return input->isolation.child.process ||
         fg__child_start(&input->isolation.child, serve, &s);
}

static fg_status complain(fg_context *context, const fg_input *input)
{
  const fg__isolation *isolation = &input->isolation;
  const char *name = fg__input_name(context, input->name);
  if (isolation->signal == SIGXCPU)
    return fg__fail(context, FG_STATUS_FILE_ACCESS,
                    "%s: damaged: reading it takes more than %u s", name,
                    isolation->seconds);
  if (isolation->signal == SIGBUS)
    return fg__fail(context, FG_STATUS_FILE_ACCESS,
                    "%s: became shorter while it was read, or its disk failed", name);
  return fg__fail(context, FG_STATUS_FILE_ACCESS,
                  "%s: damaged: the %s library does not survive reading it (signal %d)",
                  name, isolation->library, isolation->signal);
}

static fg_status ask(fg__answer *out, fg_context *context, fg_input *input,
                     const fg__question *question)
{
  fg__isolation *isolation = &input->isolation;
  fg__question asked = *question;
  fg_status status = FG_STATUS_OK;
  const char *texts[2] = {NULL, NULL};
  fg__wire to = {.socket = isolation->child.socket, .sends = true};
  fg__wire from = {.socket = isolation->child.socket, .context = context};
  fg__wire_bytes(&to, &asked, sizeof asked);
  pass_answer(&from, out, &status, question->kind, texts);
  if (from.status == FG_STATUS_OK && status != FG_STATUS_OK) {
    fg__fail(context, status, "%s", texts[0] ? texts[0] : "");
    if (texts[1] && texts[1][0])
      fg__hint(context, "%s", texts[1]);
  } else {
    status = from.status;
  }
  fg__wire_clear(&from);
  if (from.status == FG_STATUS_OK)
    return status;
  isolation->seconds = seconds_for(isolation, question->kind);
  isolation->signal = fg__child_end(&isolation->child);
  isolation->is_over = from.status == FG_STATUS_FILE_ACCESS;
  return isolation->is_over ? complain(context, input) : from.status;
}

fg_status fg__isolation_ask(fg__answer *out, fg_context *context, fg_input *input,
                            const fg__question *question)
{
  *out = (fg__answer){.field = NULL};
  if (input->isolation.is_over)
    return complain(context, input);
  if (!start(input, context))
    return input->answer(out, context, input, question);
  const struct sigaction before = fg__child_heed();
  const fg_status status = ask(out, context, input, question);
  sigaction(SIGCHLD, &before, NULL);
  return status;
}

void fg__isolation_end(fg__isolation *isolation)
{
  if (isolation->child.process)
    fg__child_end(&isolation->child);
}
