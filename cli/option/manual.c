/* Completes the manual page: manual PAGE.in PAGE. A line `@options NAME@` of PAGE.in is
 * replaced by a command's options, `@fields@` and `@palettes@` by the library's names,
 * `@heading@` by the title with the version. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "option/table.h"

/* Text for troff: hyphens as minus signs, backslashes, `words` in bold. */
static void print_text(FILE *out, const char *text)
{
  bool bold = false;
  for (const char *c = text; *c; ++c) {
    if (*c == '`') {
      bold = !bold;
      fputs(bold ? "\\fB" : "\\fR", out);
    } else if (*c == '-')
      fputs("\\-", out);
    else if (*c == '\\')
      fputs("\\e", out);
    else
      fputc(*c, out);
  }
}

static void print_option(FILE *out, const option_entry *option)
{
  fputs(".TP\n\\fB", out);
  if (option->letter)
    fprintf(out, "\\-%c\\fR, \\fB", option->letter);
  fputs("\\-\\-", out);
  print_text(out, option->name);
  fputs("\\fR", out);
  if (option->argument) {
    fputs(" \\fI", out);
    print_text(out, option->argument);
    fputs("\\fR", out);
  }
  fputc('\n', out);
  print_text(out, option->help);
  fputs(".\n", out);
}

static void print_options(FILE *out, const cli_command *command)
{
  for (size_t n = 0; option_families[n]; ++n) {
    const option_family *family = option_families[n];
    bool begun = false;
    for (size_t k = 0; k < family->count; ++k) {
      if (!option_is_documented(command, &family->option[k]))
        continue;
      if (!begun)
        fprintf(out, ".PP\n%s:\n", family->heading);
      begun = true;
      print_option(out, &family->option[k]);
    }
  }
}

static void print_names(FILE *out, const char *const *names)
{
  for (size_t k = 0; names[k]; ++k)
    fprintf(out, "%s\\fB%s\\fR", k ? ", " : "", names[k]);
  fputs(".\n", out);
}

static bool fill_line(FILE *out, const char *line)
{
  char name[32];
  if (sscanf(line, "@options %31[a-z]@", name) == 1) {
    const cli_command *command = command_find(name);
    if (!command)
      return false;
    fprintf(out, ".SS flowgrain %s %s\n", command->name, command->synopsis);
    print_text(out, command->text);
    fputc('\n', out);
    print_options(out, command);
  } else if (strcmp(line, "@fields@\n") == 0)
    print_names(out, fg_field_analytic_names());
  else if (strcmp(line, "@palettes@\n") == 0)
    print_names(out, fg_picture_palettes());
  else if (strcmp(line, "@heading@\n") == 0)
    fprintf(out, ".TH FLOWGRAIN 1 \"\" \"flowgrain %s\" \"User Commands\"\n",
            fg_version());
  else if (line[0] == '@')
    return false;
  else
    fputs(line, out);
  return true;
}

int main(int argc, char **argv)
{
  if (argc != 3) {
    fputs("usage: manual PAGE.in PAGE\n", stderr);
    return EXIT_USAGE;
  }
  FILE *in = fopen(argv[1], "r");
  FILE *out = in ? fopen(argv[2], "w") : NULL;
  if (!in || !out) {
    perror(in ? argv[2] : argv[1]);
    return EXIT_FAILED;
  }
  char line[1024];
  while (fgets(line, sizeof line, in))
    if (!fill_line(out, line)) {
      fprintf(stderr, "%s: cannot be filled in: %s", argv[1], line);
      return EXIT_FAILED;
    }
  fclose(in);
  if (fclose(out) != 0) {
    perror(argv[2]);
    return EXIT_FAILED;
  }
  return EXIT_DONE;
}
