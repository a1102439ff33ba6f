#include <ctype.h>
#include <errno.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "program.h"

enum { TEXT_BYTES = 2048 }; /* longest message of a context */
static char complaint[TEXT_BYTES], advice[TEXT_BYTES];
static bool silent;

void keep_complaints(bool keep)
{
  silent = keep;
}

size_t character_bytes(const unsigned char *text)
{
  const unsigned char first = text[0];
  const size_t bytes = first < 0x80    ? 1
                       : first < 0xc2  ? 0
                       : first < 0xe0  ? 2
                       : first < 0xf0  ? 3
                       : first <= 0xf4 ? 4
                                       : 0;
  /* no overlong forms, no surrogates, nothing past U+10FFFF */
  const unsigned char least = first == 0xe0 ? 0xa0 : first == 0xf0 ? 0x90 : 0x80;
  const unsigned char most = first == 0xed ? 0x9f : first == 0xf4 ? 0x8f : 0xbf;
  if (bytes > 1 && (text[1] < least || text[1] > most))
    return 0;
  for (size_t k = 2; k < bytes; ++k)
    if ((text[k] & 0xc0) != 0x80)
      return 0;
  return bytes;
}

/* Control characters of ASCII, and of Unicode from 0x80 to 0x9f, also as single bytes. */
static bool is_control(const unsigned char *text, size_t bytes)
{
  unsigned char last = text[bytes - 1];
  if (bytes == 1)
    return last < 0x20 || last == 0x7f || (last >= 0x80 && last < 0xa0);
  return bytes == 2 && text[0] == 0xc2 && last < 0xa0;
}

static void blank_controls(char *text)
{
  for (unsigned char *at = (unsigned char *)text; *at;) {
    size_t bytes = character_bytes(at);
    bytes += bytes == 0;
    if (is_control(at, bytes))
      memset(at, '?', bytes);
    at += bytes;
  }
}

const char *clean_text(char out[CLEAN_BYTES], const char *text)
{
  snprintf(out, CLEAN_BYTES, "%s", text);
  blank_controls(out);
  return out;
}

void tell_key_width(const char *picture, double width)
{
  if (width > 0.0 && !silent)
    fprintf(stderr,
            "flowgrain: %s: no room for the colour key; a picture of this shape has it "
            "from a width of %.0f points (%.1f cm) on\n",
            picture, ceil(width), ceil(width / 7.2 * 2.54) / 10.0);
}

void complain(const char *format, ...)
{
  va_list arguments;
  va_start(arguments, format);
  vsnprintf(complaint, sizeof complaint, format, arguments);
  va_end(arguments);
  blank_controls(complaint);
  advice[0] = '\0';
  if (!silent)
    fprintf(stderr, "flowgrain: %s\n", complaint);
}

void advise(const char *format, ...)
{
  va_list arguments;
  va_start(arguments, format);
  vsnprintf(advice, sizeof advice, format, arguments);
  va_end(arguments);
  blank_controls(advice);
  if (!silent)
    fprintf(stderr, "%s\n", advice);
}

void repeat_complaint(void)
{
  fprintf(stderr, "flowgrain: %s\n", complaint);
  if (*advice)
    fprintf(stderr, "%s\n", advice);
}

const char *last_complaint(void)
{
  return complaint;
}

const char *last_advice(void)
{
  return advice;
}

static bool begins_with(const char *text, const char *start)
{
  return strncmp(text, start, strlen(start)) == 0;
}

/* Hints of the library are clauses; prints them as a sentence. */
static void advise_in_a_sentence(const char *hint)
{
  const size_t length = strlen(hint);
  const bool is_word = islower((unsigned char)hint[0]) && islower((unsigned char)hint[1]);
  const bool is_ended = strchr(".?!", hint[length - 1]) != NULL;
  advise("%c%s%s", is_word ? toupper((unsigned char)hint[0]) : hint[0], hint + 1,
         is_ended ? "" : ".");
}

bool input_is_standard(const char *input)
{
  return input && strcmp(input, "-") == 0;
}

const char *input_name(const char *input)
{
  return input_is_standard(input) ? "standard input" : input;
}

int complain_of(const fg_context *context, fg_status status, const char *file)
{
  return complain_of_partial(context, status, file, file);
}

int complain_of_partial(const fg_context *context, fg_status status, const char *partial,
                        const char *file)
{
  file = input_name(file);
  const char *message = fg_context_message(context);
  const char *hint = fg_context_hint(context);
  if (!*message)
    message = fg_status_name(status);
  if (begins_with(message, partial))
    complain("%s%s", file, message + strlen(partial));
  else if (begins_with(message, file) || status == FG_STATUS_FILE_ACCESS ||
           status == FG_STATUS_FILE_FORMAT)
    complain("%s", message);
  else
    complain("%s: %s", file, message);
  if (*hint)
    advise_in_a_sentence(hint);
  return status == FG_STATUS_STOPPED ? EXIT_INTERRUPTED : EXIT_FAILED;
}

int complain_of_file(const char *path, const char *what)
{
  complain("%s: %s: %s", path, what, strerror(errno));
  return EXIT_FAILED;
}

int complain_of_memory(const char *what)
{
  complain("out of memory for %s", what);
  return EXIT_FAILED;
}

void report_doubts(const char *file, const fg_field *field)
{
  const char *name = input_name(file) ? input_name(file) : "";
  for (const char *line = fg_field_contents(field)->doubts; line && *line;) {
    const size_t length = strcspn(line, "\n");
    complain("%s: %.*s", name, (int)length, line);
    line += length + (line[length] == '\n');
  }
  const size_t count = fg_field_infinite(field);
  if (count > 0)
    complain("%s: %zu %s infinite and count%s as missing", input_name(file), count,
             count == 1 ? "sample is" : "samples are", count == 1 ? "s" : "");
}

static char *join(const char *first, const char *between, const char *second)
{
  size_t size = strlen(first) + strlen(between) + strlen(second) + 1;
  char *text = malloc(size);
  if (text)
    snprintf(text, size, "%s%s%s", first, between, second);
  return text;
}

char *join_texts(const char *first, const char *second)
{
  return join(first, "", second);
}

char *join_path(const char *folder, const char *name)
{
  size_t length = strlen(folder);
  return join(folder, length && folder[length - 1] == '/' ? "" : "/", name);
}
