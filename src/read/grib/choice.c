/* Choosing the pair, time and level by the options. */
#include "base/names.h"
#include "read/grib/grib.h"

#include <stdio.h>
#include <string.h>

static fg__names list_pairs(const fg__grib_pairs *pairs)
{
  fg__names names = {0};
  for (size_t i = 0; i < pairs->count; ++i)
    fg__names_add(&names, "; ", "%s,%s", pairs->pair[i].name[0], pairs->pair[i].name[1]);
  return names;
}

static void hint_at_pairs(const fg__grib_file *file)
{
  fg__grib_pairs all;
  if (fg__grib_pairs_find(&all, file) != FG_STATUS_OK)
    return;
  const fg__names list = list_pairs(&all);
  if (list.count > 0)
    fg__hint(file->context, "pairs in it: %s", list.text);
  fg__grib_pairs_clear(&all);
}

/* "t, z", each name once. */
static fg__names list_kinds(const fg__grib_file *file)
{
  fg__names names = {0};
  for (size_t i = 0; i < file->kinds; ++i) {
    const char *name = file->kind[i].name;
    size_t before = 0;
    while (before < i && strcmp(file->kind[before].name, name) != 0)
      ++before;
    if (before == i)
      fg__names_add(&names, ", ", "%s", name);
  }
  return names;
}

static fg_status fail_none(const fg__grib_file *file, const char *vars)
{
  const fg__names names = list_kinds(file);
  if (vars)
    fg__fail(file->context, FG_STATUS_ARGUMENT,
             "%s: has no fields '%s' at a time and level that both have", file->path[0],
             vars);
  else if (file->without_grid > 0)
    fg__fail(file->context, FG_STATUS_UNSUPPORTED,
             "%s: no vectors found among its %zu kinds of fields%s%s; %zu messages more "
             "do not "
             "say their grids",
             file->path[0], file->kinds, names.count > 0 ? ": " : "", names.text,
             file->without_grid);
  else
    fg__fail(file->context, FG_STATUS_UNSUPPORTED,
             "%s: no vectors found among its %zu kind%s of fields: %s", file->path[0],
             file->kinds, file->kinds == 1 ? "" : "s", names.text);
  if (vars)
    hint_at_pairs(file);
  else
    fg__hint(file->context, "name the components with --vars U,V as grib_ls does; when "
                            "the other one is in a second file, add --vars-from FILE");
  return vars ? FG_STATUS_ARGUMENT : FG_STATUS_UNSUPPORTED;
}

static fg_status fail_ambiguous(const fg__grib_file *file, const fg__grib_pairs *pairs)
{
  const fg__names list = list_pairs(pairs);
  fg_status status =
      fg__fail(file->context, FG_STATUS_ARGUMENT,
               "%s: holds %zu vectors, and it is not clear which is meant: %s",
               file->path[0], pairs->count, list.text);
  fg__hint(file->context, "choose one with --vars U,V");
  return status;
}

static fg_status find_named(fg__grib_pairs *out, const fg__grib_file *file,
                            const char *vars)
{
  char u[FG__GRIB_TEXT], v[FG__GRIB_TEXT];
  const char *comma = strchr(vars, ',');
  *out = (fg__grib_pairs){0};
  if (!comma || comma == vars || !comma[1] || strchr(comma + 1, ',') ||
      strlen(vars) >= sizeof u) {
    fg__fail(file->context, FG_STATUS_ARGUMENT,
             comma ? "%s: '%.200s' is not two names with a comma between"
                   : "%s: '%.200s' is one field, and a velocity has two components",
             file->path[0], vars);
    hint_at_pairs(file);
    return FG_STATUS_ARGUMENT;
  }
  snprintf(u, sizeof u, "%.*s", (int)(comma - vars), vars);
  snprintf(v, sizeof v, "%s", comma + 1);
  return fg__grib_pairs_named(out, file, u, v);
}

/* Others than those of the first rank count where there is none of these. */
static void drop_others(fg__grib_pairs *pairs)
{
  while (pairs->count > 1 && pairs->pair[0].rank < pairs->pair[pairs->count - 1].rank)
    fg__grib_pair_clear(&pairs->pair[--pairs->count]);
}

fg_status fg__grib_choose(fg__grib_pairs *out, const fg__grib_file *file,
                          const fg_read_options *options)
{
  fg_status status = options->vars ? find_named(out, file, options->vars)
                                   : fg__grib_pairs_find(out, file);
  if (status != FG_STATUS_OK)
    return status;
  if (!options->vars)
    drop_others(out);
  if (out->count == 0)
    return fail_none(file, options->vars);
  return out->count > 1 ? fail_ambiguous(file, out) : FG_STATUS_OK;
}

static fg_status check_index(const fg__grib_file *file, const char *what, int index,
                             size_t count)
{
  if (index >= 0 && (size_t)index < count)
    return FG_STATUS_OK;
  return fg__fail(file->context, FG_STATUS_ARGUMENT,
                  "%s: %s %d asked for, but there are %zu: 0 to %zu", file->path[0], what,
                  index, count, count - 1);
}

fg_status fg__grib_find_place(const fg__grib_place **out, const fg__grib_file *file,
                              const fg__grib_pair *pair, const fg_read_options *options)
{
  char time[FG__GRIB_TEXT], level[FG__GRIB_TEXT];
  fg_status status = check_index(file, "time", options->time, pair->times);
  if (status == FG_STATUS_OK)
    status = check_index(file, "level", options->level, pair->levels);
  if (status != FG_STATUS_OK)
    return status;
  const fg__grib_date *date = &pair->time[options->time];
  for (size_t i = 0; i < pair->places; ++i) {
    const fg__grib_place *p = &pair->place[i];
    if (p->date.time == date->time && p->date.started == date->started &&
        p->level == pair->level[options->level]) {
      *out = p;
      return FG_STATUS_OK;
    }
  }
  fg__grib_time_words(pair, (size_t)options->time, time, sizeof time);
  fg__grib_level_words(pair, pair->level[options->level], level, sizeof level);
  return fg__fail(file->context, FG_STATUS_ARGUMENT,
                  "%s: has no %s and %s at time %d (%s) and level %d (%s)", file->path[0],
                  pair->name[0], pair->name[1], options->time, time, options->level,
                  level);
}
