#include "flowgrain/words.h"

#include <stddef.h>
#include <string.h>

enum { LONGEST = 31, SHORT_WORD = 4 };

static int least(int a, int b)
{
  return a < b ? a : b;
}

/* Of two words, each letter of which takes part in one step at most: optimal string
 * alignment (Damerau 1964). cost[i][j] is that of their first i and j letters. */
static int distance(const char *one, size_t m, const char *other, size_t n)
{
  int cost[LONGEST + 1][LONGEST + 1];
  for (size_t i = 0; i <= m; ++i)
    cost[i][0] = (int)i;
  for (size_t j = 0; j <= n; ++j)
    cost[0][j] = (int)j;
  for (size_t i = 1; i <= m; ++i)
    for (size_t j = 1; j <= n; ++j) {
      const int kept = cost[i - 1][j - 1] + (one[i - 1] != other[j - 1]);
      cost[i][j] = least(kept, 1 + least(cost[i - 1][j], cost[i][j - 1]));
      if (i > 1 && j > 1 && one[i - 1] == other[j - 2] && one[i - 2] == other[j - 1])
        cost[i][j] = least(cost[i][j], cost[i - 2][j - 2] + 1);
    }
  return cost[m][n];
}

bool fg_word_is_near(const char *typed, const char *known)
{
  if (!typed || !known)
    return false;
  const size_t m = strlen(typed), n = strlen(known);
  if (m > LONGEST || n > LONGEST)
    return false;
  return distance(typed, m, known, n) <= (m > SHORT_WORD ? 2 : 1);
}
