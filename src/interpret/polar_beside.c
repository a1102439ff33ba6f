/* Components beside speeds and directions of the same flow: whether they say the same. */
#include "base/memory.h"
#include "interpret/curvilinear/curvilinear.h"
#include "interpret/unstructured/unstructured.h"
#include "terms/text.h"
#include "terms/units.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { MOST_ROWS = 8, MOST_SAMPLES = 4096, FEWEST = 20 };

/* Words of names by which flows are told apart, and of what is no vector of the flow. */
static const char *const FLOWS[] = {"wind|air|wdir|wspd", "water|current|ocean"};
static const char OTHERS[] = "wave|swell|stress|gust|std|dev|err|var|flag|quality|qc|max|"
                             "sound|platform|relative";
static const char SPEEDS[] = "speed|spd|sknt"; /* a "velocity" may be a component */

/* 1 + the flow of FLOWS that a variable is called after; 0: none; -1: something else. */
static int flow_of(const fg__variable *v)
{
  const fg__term term = fg__term_of(v);
  const char *const texts[] = {term.name, term.standard_name, term.long_name};
  int flow = 0;
  for (size_t n = 0; n < sizeof texts / sizeof *texts; ++n) {
    if (texts[n] && fg__contains_any(texts[n], OTHERS))
      return -1;
    for (int k = 0; texts[n] && k < 2 && flow == 0; ++k)
      flow = fg__contains_any(texts[n], FLOWS[k]) ? 1 + k : 0;
  }
  return flow;
}

static bool lies_at(const fg__variable *v, const fg__variable *component)
{
  bool same = v->rank == component->rank && v->file == component->file &&
              v->location == component->location && fg__is_array(v) && !v->element;
  for (int k = 0; same && k < v->rank; ++k)
    same = v->dimension[k] == component->dimension[k];
  return same;
}

/* Reads the same few rows of any variable of the components' dimensions, at the time and
 * level of the options; returns how many samples there are, 0 where it fails. */
static size_t read_rows(double out[MOST_SAMPLES], const fg__dataset *data,
                        const fg__variable *v, const fg__grid *grid,
                        const fg_read_options *options)
{
  size_t start[FG__RANK] = {0}, count[FG__RANK], read = 0;
  const fg__packing packing = fg__packing_of(v);
  fg__missing_counts ignored = {0};
  const int last = v->rank - 1, across = v->rank - 2;
  const bool has_rows = across >= 0 && across != grid->time && across != grid->level;
  for (int k = 0; k < v->rank; ++k)
    count[k] = 1;
  if (grid->time >= 0)
    start[grid->time] = (size_t)options->time;
  if (grid->level >= 0)
    start[grid->level] = (size_t)options->level;
  for (int k = 0; k < v->rank; ++k)
    if (start[k] >= data->dimensions[v->dimension[k]].length)
      return 0;
  const size_t length = data->dimensions[v->dimension[last]].length;
  const size_t rows = has_rows ? data->dimensions[v->dimension[across]].length : 1;
  const size_t wanted = rows < MOST_ROWS ? rows : MOST_ROWS;
  if (wanted == 0)
    return 0;
  count[last] = length < MOST_SAMPLES / wanted ? length : MOST_SAMPLES / wanted;
  for (size_t n = 0; n < wanted && last != grid->time && last != grid->level; ++n) {
    if (has_rows)
      start[across] = (2 * n + 1) * rows / (2 * wanted);
    if (fg__variable_fetch(v, start, count, out + read) != FG_STATUS_OK) {
      fg_context_clear(data->context);
      return 0;
    }
    read += count[last];
  }
  for (size_t n = 0; n < read; ++n)
    out[n] = fg__unpack(&packing, out[n], &ignored);
  return read;
}

/* Metres per second in a variable's unit; 0: it is not known. */
static double unit_of(const fg__variable *v)
{
  fg__unit unit = {.factor = 0.0};
  const fg__term term = fg__term_of(v);
  if (term.units)
    fg__unit_read(&unit, term.units);
  return unit.quantity == FG__QUANTITY_SPEED ? unit.factor : 0.0;
}

typedef struct samples {
  size_t count;
  double component[2][MOST_SAMPLES], other[MOST_SAMPLES];
} samples;

/* Of the samples that can be compared those whose direction is more than 45 degrees off;
 * or whose components are more than half as fast again as the speed, or less than half as
 * fast, as means of winds that turn are. */
typedef struct tally {
  size_t compared, off, slow;
} tally;

static tally compare_samples(const samples *s, const fg__polar *polar, double factor)
{
  tally t = {0};
  for (size_t n = 0; n < s->count; ++n) {
    const double u = s->component[0][n], v = s->component[1][n];
    const double length = sqrt(u * u + v * v);
    double way[2] = {1.0, s->other[n]};
    if (polar)
      fg__polar_turn(way, polar);
    if (!(length > 0.0) || isnan(polar ? way[0] : s->other[n]))
      continue;
    ++t.compared;
    t.off += polar ? u * way[0] + v * way[1] < sqrt(0.5) * length
                   : length > 1.5 * factor * s->other[n];
    t.slow += !polar && length < 0.5 * factor * s->other[n];
  }
  return t;
}

/* Compares the components with one variable, a direction (`polar`) or a speed. */
static void compare(fg__grid *grid, samples *s, const fg__dataset *data,
                    const fg__pair *pair, const fg__variable *v, const fg__polar *polar,
                    const fg_read_options *options)
{
  const double of_component = unit_of(pair->component[0]), of_speed = unit_of(v);
  if (!polar && (of_component == 0.0 || of_speed == 0.0))
    return;
  for (int k = 0; k < 2 && s->count == 0; ++k)
    if (read_rows(s->component[k], data, pair->component[k], grid, options) == 0)
      return;
  s->count = read_rows(s->other, data, v, grid, options);
  const tally t = compare_samples(s, polar, of_speed / of_component);
  const bool slow = 2 * t.slow > t.compared;
  if (t.compared < FEWEST || (!slow && 2 * t.off <= t.compared))
    return;
  const fg__term term = fg__term_of(v);
  char text[FG__REASON_BYTES];
  snprintf(text, sizeof text,
           "'%.60s' and '%.60s' are %s '%.60s', at %zu of %zu samples compared",
           pair->component[0]->plain_name, pair->component[1]->plain_name,
           polar  ? "more than 45 degrees off the direction"
           : slow ? "less than half as fast as the speed"
                  : "more than half as fast again as the speed",
           v->plain_name, slow ? t.slow : t.off, t.compared);
  if (term.standard_name && !slow && flow_of(pair->component[0]) > 0) {
    fg__set_unusable(grid->unusable, "%s", text);
    snprintf(grid->hint, sizeof grid->hint, "--vars %.100s,%.100s takes the components",
             pair->component[0]->name, pair->component[1]->name);
  } else {
    fg__doubt(grid->doubts, "%s", text);
  }
}

/* Whether components point east and north in the numbers of the file. */
static bool points_east(const fg__grid *grid)
{
  if (grid->mesh)
    return grid->mesh->turn == FG__TURN_NONE && !grid->mesh->apart;
  if (grid->unstructured)
    return fg__points_north(grid->unstructured);
  return grid->points_east || grid->scale == FG_SCALE_GEO;
}

fg_status fg__check_polar_beside(fg__grid *grid, const fg__dataset *data,
                                 const fg__pair *pair, const fg_read_options *options)
{
  if (pair->polar.sense != 0 || !pair->is_velocity || grid->rate || grid->faces.used ||
      grid->domain || pair->across || pair->component[0]->element || !points_east(grid) ||
      !lies_at(pair->component[1], pair->component[0]))
    return FG_STATUS_OK;
  samples *s = NULL;
  const int flow = flow_of(pair->component[0]);
  for (size_t i = 0; i < data->variable_count && !grid->unusable[0]; ++i) {
    const fg__variable *v = &data->variables[i];
    fg__polar polar;
    if (v == pair->component[0] || v == pair->component[1] ||
        !lies_at(v, pair->component[0]))
      continue;
    const int of_v = flow_of(v);
    if (of_v <= 0 || (flow != 0 && of_v != flow))
      continue;
    const fg__term term = fg__term_of(v);
    const bool is_speed =
        fg__contains_any(term.standard_name ? term.standard_name : term.name, SPEEDS);
    const bool is_direction = fg__direction_read(&polar, &term) && polar.unit > 0.0;
    if (!is_direction && !is_speed)
      continue;
    s = s ? s : fg__allocate(1, sizeof *s);
    if (!s)
      return fg__fail_memory(data->context, "speeds and directions", sizeof *s);
    compare(grid, s, data, pair, v, is_direction ? &polar : NULL, options);
  }
  free(s);
  return FG_STATUS_OK;
}
