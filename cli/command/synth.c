/* Writes an analytic field to a file. */
#include <stdio.h>
#include <string.h>

#include "command/command.h"
#include "folder/file.h"
#include "folder/made.h"
#include "inputs.h"
#include "option/settings.h"

static bool name_is_known(const char *name)
{
  for (const char *const *known = fg_field_analytic_names(); *known; ++known)
    if (strcmp(*known, name) == 0)
      return true;
  return false;
}

static int check_name(const char *name)
{
  if (name_is_known(name))
    return EXIT_DONE;
  complain("synth %s: there is no such analytic field", name);
  fputs("The choice is:", stderr);
  for (const char *const *known = fg_field_analytic_names(); *known; ++known)
    fprintf(stderr, " %s", *known);
  fputc('\n', stderr);
  return EXIT_USAGE;
}

static int check_end(const char *path)
{
  const char *end = strrchr(path, '.');
  if (end && (strcmp(end, ".vti") == 0 || strcmp(end, ".nc") == 0))
    return check_place_of_file(path);
  complain("-o %s: the name's end must be .vti or .nc", path);
  advise("Try 'flowgrain synth --help'.");
  return EXIT_USAGE;
}

static int write_field(fg_context *context, const synth_settings *settings,
                       const fg_field *field)
{
  char *partial = temporary_name(settings->output);
  if (!partial)
    return EXIT_FAILED;
  fg_status status = fg_field_write(context, partial, field);
  int code = status ? complain_of_partial(context, status, partial, settings->output)
                    : EXIT_DONE;
  return publish_file(partial, settings->output, code);
}

int command_synth(const void *given)
{
  const synth_settings *settings = given;
  const char *name = settings->name;
  if (strncmp(name, "synth:", 6) == 0)
    name += 6;
  int code = check_name(name);
  if (!code)
    code = check_end(settings->output);
  if (code)
    return code;
  fg_context *context;
  if (create_context(&context))
    return EXIT_FAILED;
  fg_field *field = NULL;
  fg_status status = fg_field_create_analytic(&field, context, name, settings->nodes);
  code = status ? complain_of(context, status, settings->output)
                : write_field(context, settings, field);
  fg_field_destroy(field);
  fg_context_destroy(context);
  return code;
}
