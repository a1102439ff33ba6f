#include "terms/text.h"

#include <string.h>

bool fg__is_letter(char c)
{
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}

bool fg__is_digit(char c)
{
  return c >= '0' && c <= '9';
}

char fg__small(char c)
{
  return c >= 'A' && c <= 'Z' ? (char)(c - 'A' + 'a') : c;
}

/* Whether a text of at least `length` bytes, or with a NUL, begins as a word does. */
static bool begins(const char *text, const char *word, size_t length)
{
  size_t n = 0;
  while (n < length && text[n] && fg__small(text[n]) == fg__small(word[n]))
    ++n;
  return n == length;
}

bool fg__is_word(const char *text, size_t length, const char *word)
{
  return strlen(word) == length && begins(text, word, length);
}

bool fg__is_same(const char *a, const char *b)
{
  return fg__is_word(a, strlen(a), b);
}

bool fg__starts_with(const char *text, const char *start)
{
  return begins(text, start, strlen(start));
}

const char *fg__find_text(const char *text, const char *word)
{
  for (; *text; ++text)
    if (fg__starts_with(text, word))
      return text;
  return NULL;
}

typedef bool comparison(const char *text, size_t length, const char *word, size_t n);

static bool any_of(const char *list, const char *text, size_t length, comparison *fits)
{
  for (size_t n; *list; list += n + (list[n] == '|')) {
    n = strcspn(list, "|");
    if (fits(text, length, list, n))
      return true;
  }
  return false;
}

static bool is_equal(const char *text, size_t length, const char *word, size_t n)
{
  return n == length && begins(text, word, n);
}

static bool starts(const char *text, size_t length, const char *word, size_t n)
{
  return n <= length && begins(text, word, n);
}

static bool contains(const char *text, size_t length, const char *word, size_t n)
{
  for (size_t at = 0; at + n <= length; ++at)
    if (begins(text + at, word, n))
      return true;
  return false;
}

bool fg__is_one_of(const char *list, const char *text, size_t length)
{
  return any_of(list, text, length, is_equal);
}

bool fg__starts_with_one_of(const char *list, const char *text, size_t length)
{
  return any_of(list, text, length, starts);
}

bool fg__contains_any(const char *text, const char *list)
{
  return any_of(list, text, strlen(text), contains);
}

const char *fg__last_part(const char *name)
{
  const char *slash = strrchr(name, '/');
  return slash ? slash + 1 : name;
}

static bool is_of_token(char c)
{
  return fg__is_letter(c) || fg__is_digit(c);
}

int fg__split_name(fg__token out[FG__MOST_TOKENS], const char *name)
{
  int count = 0;
  for (size_t i = 0; name[i] && count < FG__MOST_TOKENS;) {
    while (name[i] && !is_of_token(name[i]))
      ++i;
    const size_t start = i;
    while (is_of_token(name[i]))
      ++i;
    if (i > start)
      out[count++] = (fg__token){start, i - start};
  }
  return count;
}

fg__token fg__without_digits(const char *name, fg__token token)
{
  for (; token.length > 0 && fg__is_digit(name[token.start]); --token.length)
    ++token.start;
  while (token.length > 0 && fg__is_digit(name[token.start + token.length - 1]))
    --token.length;
  return token;
}

void fg__plain_name(char *out, size_t size, const char *name)
{
  size_t n = 0;
  for (; *name && n + 1 < size; ++name)
    if (is_of_token(*name))
      out[n++] = fg__small(*name);
    else if (n > 0 && out[n - 1] != '_')
      out[n++] = '_';
  while (n > 0 && out[n - 1] == '_')
    --n;
  out[n] = '\0';
}
