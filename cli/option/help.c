#include "option/table.h"

#include <string.h>

/* Help is set for terminals of 80 columns; descriptions start at HELP_INDENT. */
enum { HELP_COLUMNS = 79, HELP_INDENT = 22 };

/* Prints words from column `at` on, broken at HELP_COLUMNS and indented. */
static void print_wrapped(FILE *stream, const char *text, int at, int indent)
{
  for (const char *word = text; *word;) {
    int length = (int)strcspn(word, " ");
    if (at > indent && at + 1 + length > HELP_COLUMNS) {
      fprintf(stream, "\n%*s", indent, "");
      at = indent;
    } else if (at > indent) {
      fputc(' ', stream);
      ++at;
    }
    fprintf(stream, "%.*s", length, word);
    at += length;
    word += length;
    word += strspn(word, " ");
  }
  fputc('\n', stream);
}

void print_program_help(FILE *stream)
{
  fputs("Usage: flowgrain COMMAND ...\n"
        "Simple pictures of complicated vector fields, at every scale.\n\n"
        "Commands:\n",
        stream);
  for (size_t k = 0; k < command_count; ++k)
    fprintf(stream, "  %-7s %s\n", command_table[k].name, command_table[k].summary);
  fputs("\n'flowgrain COMMAND --help' lists a command's options;\n"
        "'flowgrain --version' prints the version and what this build can do.\n",
        stream);
}

static void print_option(FILE *stream, const option_entry *option)
{
  int at = option->letter ? fprintf(stream, "  -%c, ", option->letter)
                          : fprintf(stream, "      ");
  at += fprintf(stream, "--%s%s%s", option->name, option->argument ? " " : "",
                option->argument ? option->argument : "");
  if (at > HELP_INDENT - 2) {
    fputc('\n', stream);
    at = 0;
  }
  fprintf(stream, "%*s", HELP_INDENT - at, "");
  print_wrapped(stream, option->help, HELP_INDENT, HELP_INDENT);
}

static void print_family(FILE *stream, const option_family *family,
                         const cli_command *command)
{
  bool begun = false;
  for (size_t k = 0; k < family->count; ++k) {
    if (!option_is_documented(command, &family->option[k]))
      continue;
    if (!begun)
      fprintf(stream, "\n%s:\n", family->heading);
    begun = true;
    print_option(stream, &family->option[k]);
  }
}

static void print_names(FILE *stream, const char *heading, const char *const *names)
{
  fprintf(stream, "\n%s:", heading);
  for (size_t k = 0; names[k]; ++k)
    fprintf(stream, " %s", names[k]);
  fputc('\n', stream);
}

void print_command_help(FILE *stream, const cli_command *command)
{
  fprintf(stream, "Usage: flowgrain %s %s\n", command->name, command->synopsis);
  print_wrapped(stream, command->text, 0, 0);
  for (size_t k = 0; option_families[k]; ++k)
    print_family(stream, option_families[k], command);
  if (command->bit == COMMAND_SYNTH)
    print_names(stream, "Analytic fields", fg_field_analytic_names());
  if (command->bit & (COMMAND_RUN | COMMAND_DRAW | COMMAND_RIVAL | COMMAND_TEXTURE))
    print_names(stream, "Palettes", fg_picture_palettes());
}
