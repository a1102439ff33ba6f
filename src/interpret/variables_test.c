/* What variables in memory mean, without a file and without PROJ. */
#include <string.h>

#include "base/context_test.h"
#include "flowgrain/dataset.h"

enum { MOST = 8 };

/* Variables in words: "u(y,x)", attributes after it as "units=m/s". Coordinates count
 * from their first number in tenths of it along their last dimension. */
typedef struct situation {
  const char *variable[MOST], *attribute[MOST];
  const char *vars;
  int component[2], coordinate[2], side[2];
  bool is_geographic, is_along_grid, is_polar;
  const char *refusal; /* part of the message; NULL: it is understood */
} situation;

static size_t length_of(const char *dimension)
{
  return (strchr(dimension, 'y') ? 6U : 7U) + (strchr(dimension, '_') ? 1U : 0U);
}

/* Along a dimension with _, of faces, half a step lower. */
static bool fetch(void *user, size_t number, const size_t *start, const size_t *count,
                  double *out)
{
  const fg_variables *all = user;
  const fg_variable *v = &all->variable[number];
  const size_t rows = v->rank > 1 ? count[v->rank - 2] : 1;
  const size_t columns = count[v->rank - 1];
  for (size_t j = 0; j < rows; ++j)
    for (size_t i = 0; i < columns; ++i) {
      const double across = v->rank > 1 ? (double)(start[v->rank - 2] + j) : 0.0;
      const double along = (double)(start[v->rank - 1] + i);
      const bool is_latitude = strstr(v->name, "lat") != NULL;
      out[j * columns + i] =
          v->rank == 1  ? 2.0 * along - (strchr(v->dimension[0], '_') ? 1.0 : 0.0)
          : is_latitude ? 40.0 + across + 0.1 * along
                        : 10.0 + along - 0.1 * across;
    }
  return strcmp(v->name, "broken") != 0;
}

/* Reads "name(first,second)" into a variable, whose texts lie in `words`. */
static void parse(fg_variable *out, fg_attribute *attribute, char words[64],
                  const char *text, const char *said)
{
  strcpy(words, text);
  *out = (fg_variable){.name = words, .is_number = true};
  for (char *at = strpbrk(words, "(,)"); at && at[1]; at = strpbrk(at + 1, ",)")) {
    *at = '\0';
    out->dimension[out->rank++] = at + 1;
  }
  words[strlen(text) - 1] = '\0';
  for (int k = 0; k < out->rank; ++k)
    out->length[k] = length_of(out->dimension[k]);
  if (said) {
    *attribute = (fg_attribute){said, said + strlen(said) + 1, NULL, 0};
    out->attribute = attribute;
    out->attributes = 1;
  }
}

static fg_status find(fg_vector_meaning *out, fg_context *context, const situation *s)
{
  char words[MOST][64];
  fg_variable variable[MOST];
  fg_attribute attribute[MOST];
  fg_variables all = {.name = "memory", .variable = variable, .fetch = fetch};
  const fg_read_options options = {.vars = s->vars};
  all.user = &all;
  for (; all.count < MOST && s->variable[all.count]; ++all.count)
    parse(&variable[all.count], &attribute[all.count], words[all.count],
          s->variable[all.count], s->attribute[all.count]);
  return fg_vector_find(out, context, &all, &options);
}

static void variables_are_understood(void **state)
{
  static const situation situations[] = {
      {.variable = {"x(x)", "y(y)", "speed(y,x)", "u(y,x)", "v(y,x)"},
       .component = {3, 4},
       .coordinate = {0, 1}},
      {.variable = {"a(t,y,x)", "b(t,y,x)", "y(y)", "x(x)"},
       .attribute = {"standard_name\0eastward_wind", "standard_name\0northward_wind",
                     "units\0degrees_north", "units\0degrees_east"},
       .component = {0, 1},
       .coordinate = {3, 2},
       .is_geographic = true},
      {.variable = {"u(y,x_)", "v(y_,x)", "x(x)", "y(y)", "x_(x_)", "y_(y_)"},
       .component = {0, 1},
       .coordinate = {2, 3},
       .side = {-1, -1}},
      {.variable = {"u(y,x_)", "v(y,x)", "x(x)", "y(y)"}, .refusal = "a staggered grid"},
      {.variable = {"u(y,x)", "v(y,x)", "lon(y,x)", "lat(y,x)"},
       .attribute = {"standard_name\0x_wind", "standard_name\0y_wind",
                     "units\0degrees_east", "units\0degrees_north"},
       .component = {0, 1},
       .coordinate = {2, 3},
       .is_geographic = true,
       .is_along_grid = true},
      {.variable = {"u10(y,x)", "v10(y,x)", "u100(y,x)", "v100(y,x)", "x(x)", "y(y)"},
       .refusal = "memory: holds 2 vectors"},
      {.variable = {"u10(y,x)", "v10(y,x)", "u100(y,x)", "v100(y,x)", "x(x)", "y(y)"},
       .vars = "u100,v100",
       .component = {2, 3},
       .coordinate = {4, 5}},
      {.variable = {"u(member,t,y,x)", "v(member,t,y,x)", "x(x)", "y(y)"},
       .component = {0, 1},
       .coordinate = {2, 3}},
      {.variable = {"wspd(y,x)", "wdir(y,x)", "lon(x)", "lat(y)"},
       .component = {0, 1},
       .coordinate = {2, 3},
       .is_geographic = true,
       .is_polar = true},
      {.variable = {"u(z,x)", "w(z,x)", "x(x)", "z(z)"},
       .attribute = {NULL, NULL, "units\0m", "units\0m"},
       .refusal = "memory: 'u' lies in a vertical section"},
      {.variable = {"p(y,x)", "q(y,x)"}, .refusal = "memory: no vectors found"},
      {.variable = {"u(y,x)", "v(y,x)", "broken(x)", "y(y)"},
       .attribute = {NULL, NULL, "axis\0X", "axis\0Y"},
       .refusal = "memory: 'broken' cannot be read"},
  };
  for (size_t n = 0; n < sizeof situations / sizeof *situations; ++n) {
    const situation *s = &situations[n];
    fg_vector_meaning found;
    const fg_status status = find(&found, *state, s);
    if ((status != FG_STATUS_OK) != (s->refusal != NULL) ||
        (s->refusal && !strstr(fg_context_message(*state), s->refusal)))
      fail_msg("situation %zu: \"%s\"", n, fg_context_message(*state));
    for (int k = 0; k < 2 && !s->refusal; ++k)
      if (found.component[k] != s->component[k] ||
          found.coordinate[k] != s->coordinate[k] || found.side[k] != s->side[k])
        fail_msg("situation %zu, %d: component %d, coordinate %d, side %d", n, k,
                 found.component[k], found.coordinate[k], found.side[k]);
    if (!s->refusal && found.is_polar != s->is_polar)
      fail_msg("situation %zu: a speed and a direction %d", n, found.is_polar);
    if (!s->refusal && (found.is_geographic != s->is_geographic ||
                        found.is_along_grid != s->is_along_grid))
      fail_msg("situation %zu: geographic %d, along the grid %d", n, found.is_geographic,
               found.is_along_grid);
    fg_context_clear(*state);
  }
}

int main(void)
{
  const struct CMUnitTest tests[] = {cmocka_unit_test_setup_teardown(
      variables_are_understood, context_set_up, context_tear_down)};
  return cmocka_run_group_tests_name("interpret/variables", tests, NULL, NULL);
}
