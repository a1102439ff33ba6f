#include "view/request.h"

#include <string.h>
#include <strings.h>

static const char end_of_line[] = "\r\n";

bool request_is_whole(const char *text)
{
  return strstr(text, "\r\n\r\n") != NULL;
}

/* The value of a header without surrounding blanks; NULL: missing or repeated. */
static const char *find_header(size_t *length, const char *text, const char *name)
{
  const size_t name_length = strlen(name);
  const char *found = NULL;
  for (const char *line = strstr(text, end_of_line); line;
       line = strstr(line, end_of_line)) {
    line += strlen(end_of_line);
    if (strncasecmp(line, name, name_length) != 0 || line[name_length] != ':')
      continue;
    if (found)
      return NULL;
    found = line + name_length + 1;
    found += strspn(found, " \t");
    *length = strcspn(found, "\r\n");
    while (*length && (found[*length - 1] == ' ' || found[*length - 1] == '\t'))
      --*length;
  }
  return found;
}

/* Any port is accepted, as a forwarded address has another one (ssh -L). */
static bool is_this_host(const char *text)
{
  static const char *const names[] = {"127.0.0.1", "localhost"};
  size_t length = 0;
  const char *host = find_header(&length, text, "Host");
  for (size_t k = 0; host && k < sizeof names / sizeof *names; ++k) {
    const size_t bytes = strlen(names[k]);
    if (length < bytes || strncasecmp(host, names[k], bytes) != 0)
      continue;
    if (length == bytes)
      return true;
    if (host[bytes] == ':' && length > bytes + 1 &&
        strspn(host + bytes + 1, "0123456789") == length - bytes - 1)
      return true;
  }
  return false;
}

/* Compares in constant time. */
static bool is_token(const char *text, size_t length, const char *token)
{
  unsigned differences = length != TOKEN_DIGITS;
  for (size_t k = 0; k < length && k < TOKEN_DIGITS; ++k)
    differences |= (unsigned)(text[k] ^ token[k]);
  return differences == 0;
}

/* Extracts NAME from "/TOKEN/NAME". */
static bool read_path(char name[REQUEST_NAME_BYTES], const char *path, size_t length,
                      const char *token)
{
  const char *question = memchr(path, '?', length);
  if (question)
    length = (size_t)(question - path);
  const char *slash = length > 1 ? memchr(path + 1, '/', length - 1) : NULL;
  if (!slash || !is_token(path + 1, (size_t)(slash - path) - 1, token))
    return false;
  const char *begin = slash + 1;
  const size_t bytes = length - (size_t)(begin - path);
  if (bytes >= REQUEST_NAME_BYTES || memchr(begin, '/', bytes))
    return false;
  memcpy(name, begin, bytes);
  name[bytes] = '\0';
  return true;
}

int request_read(char name[REQUEST_NAME_BYTES], const char *text, const char *token)
{
  const size_t line = strcspn(text, "\r\n");
  const size_t method = strcspn(text, " \r\n");
  const char *path = text + method + 1;
  const size_t length = method < line ? strcspn(path, " \r\n") : 0;
  const char *version = path + length;
  if (!method || !length || *path != '/' || strncmp(version, " HTTP/1.", 8) != 0)
    return 400;
  if (!is_this_host(text))
    return 403;
  if (method != 3 || memcmp(text, "GET", 3) != 0)
    return 405;
  return read_path(name, path, length, token) ? 200 : 404;
}
