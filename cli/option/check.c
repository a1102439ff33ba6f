#include "option/check.h"

#include <string.h>

#include "option/value.h"

/* A word that is unlikely to be a file's name is a misspelt energy. */
static bool check_energy(const evolution_settings *settings, const cli_command *command)
{
  if (settings->anisotropy > 0.0 && energy_place(settings->energy) == FG_ENERGY_ISOTROPIC)
    return usage_error(command,
                       "--anisotropy %g: not with --energy isotropic, which has none",
                       settings->anisotropy);
  if (settings->isotropic_below > 0.0 && energy_place(settings->energy) != FG_ENERGY_FLOW)
    return usage_error(command, "--isotropic-below %g: only with --energy flow",
                       settings->isotropic_below);
  if (energy_place(settings->energy) >= 0)
    return true;
  char words[128];
  list_words(words, sizeof words, energy_words);
  bool takes_file = (command->bit & RUNS) != 0;
  if (!takes_file || !strpbrk(settings->energy, "./"))
    return usage_error(command, "--energy %s: not known; the choice is: %s%s",
                       settings->energy, words, takes_file ? ", or a file" : "");
  if (settings->anisotropy > 0.0)
    return usage_error(command, "--anisotropy %g: that is for --energy to say, %s",
                       settings->anisotropy, settings->energy);
  return true;
}

static bool check_scheme(const evolution_settings *settings, const cli_command *command)
{
  const bool theta = settings->theta > 0.0;
  return settings->scheme == FG_SCHEME_THETA || (!theta && !(settings->alpha > 0.0)) ||
         usage_error(command, "--%s %g: only with --scheme theta",
                     theta ? "theta" : "alpha",
                     theta ? settings->theta : settings->alpha);
}

/* Options that choose scales exclude each other. */
static bool check_placement(const run_settings *settings, const cli_command *command)
{
  const struct {
    const char *name;
    bool given;
  } options[] = {{"arrows", settings->arrows.count > 0},
                 {"tolerance", settings->tolerance > 0.0},
                 {"clusters", settings->clusters.count > 0},
                 {"times", settings->times.count > 0}};
  const char *first = NULL;
  for (size_t n = 0; n < sizeof options / sizeof *options; ++n) {
    if (options[n].given && first)
      return usage_error(command,
                         "--%s and --%s: say one; --tolerance finds a number of arrows, "
                         "--clusters and --times draw one in each cluster",
                         first, options[n].name);
    first = options[n].given ? options[n].name : first;
  }
  if (settings->picture.no_arrows &&
      (settings->arrows.count || settings->tolerance > 0.0))
    return usage_error(command, "--%s and --no-arrows: say one",
                       settings->arrows.count ? "arrows" : "tolerance");
  const char *placed = settings->start     ? "start"
                       : settings->effort  ? "effort"
                       : settings->lengths ? "lengths"
                                           : NULL;
  if (placed && !settings_place(settings))
    return usage_error(command, "--%s: says nothing with --%s: no arrows are placed",
                       placed,
                       settings->clusters.count ? "clusters"
                       : settings->times.count  ? "times"
                                                : "no-arrows");
  const char *of_clusters = settings->picture.skeletons ? "skeletons"
                            : settings->picture.centers ? "centers"
                            : settings->extent          ? "extent"
                                                        : NULL;
  if (of_clusters && settings_place(settings))
    return usage_error(command, "--%s: of clusters; say how many with --clusters",
                       of_clusters);
  return true;
}

static bool check_slice(const reading_settings *settings, const cli_command *command)
{
  fg_plane plane;
  return !settings->slice || !fg_plane_parse(&plane, NULL, settings->slice, NULL) ||
         usage_error(command,
                     "--slice %s: no plane; say NAME=VALUE, as z=0.5, or NX,NY,NZ@X,Y,Z",
                     settings->slice);
}

static bool check_map(const fg_map_options *map, const cli_command *command)
{
  const bool none = map->projection && strcmp(map->projection, "none") == 0;
  if (none && (map->has_center || map->has_region))
    return usage_error(command,
                       "--%s: not with --projection none, which draws all of the degrees "
                       "that the field covers; --projection eqc keeps degrees on a map",
                       map->has_center ? "center" : "region");
  return true;
}

/* A word in braces must be a known placeholder; other braces are text. */
static bool check_braces(const char *option, const char *text, const char *const *known,
                         const cli_command *command)
{
  for (const char *at = text; at && (at = strchr(at, '{')); ++at) {
    const size_t length = strspn(at + 1, "abcdefghijklmnopqrstuvwxyz_-"
                                         "ABCDEFGHIJKLMNOPQRSTUVWXYZ");
    size_t k = 0;
    if (length == 0 || at[length + 1] != '}')
      continue;
    while (known[k] &&
           (strlen(known[k]) != length || strncmp(known[k], at + 1, length) != 0))
      ++k;
    if (known[k])
      continue;
    char words[128] = "";
    for (size_t n = 0, used = 0; known[n] && used < sizeof words; ++n)
      used += (size_t)snprintf(words + used, sizeof words - used, "%s{%s}", n ? ", " : "",
                               known[n]);
    return usage_error(command, "--%s: {%.*s} stands for nothing; known: %s", option,
                       (int)length, at + 1, words);
  }
  return true;
}

static bool check_texts(const picture_settings *settings, const cli_command *command)
{
  static const char *const titles[] = {"title", "time", "level", "names", "arrows", NULL};
  static const char *const labels[] = {"units", NULL};
  return check_braces("title", settings->title, titles, command) &&
         check_braces("subtitle", settings->subtitle, titles, command) &&
         check_braces("label", settings->label, labels, command);
}

static bool check_panels(const draw_settings *settings, const cli_command *command)
{
  static const char *const labels[] = {"letter", "title",  "time", "level",
                                       "names",  "arrows", NULL};
  return check_braces("panel-label", settings->panel_label, labels, command);
}

/* Refuses options that have no effect. */
static bool check_picture(const picture_settings *settings, const cli_command *command)
{
  const char *framed = settings->title      ? "title"
                       : settings->subtitle ? "subtitle"
                       : settings->label    ? "label"
                                            : NULL;
  if (settings->no_frame && framed)
    return usage_error(command, "--%s: not with --no-frame, which has no texts", framed);
  if (settings->tint_color && !settings->tint)
    return usage_error(command, "--tint-color %s: only with --tint",
                       settings->tint_color);
  if (settings->background_fade > 0.0 && !settings->background)
    return usage_error(command, "--background-fade %g: only with --background",
                       settings->background_fade);
  return true;
}

static bool check_inputs(const input_settings *settings, const cli_command *command)
{
  double size;
  return !settings->max_memory || value_read_size(&size, settings->max_memory) ||
         usage_error(command,
                     "--max-memory %s: no number of bytes; say 500M or 2G, for example",
                     settings->max_memory);
}

static const void *group_of(const any_settings *settings, const cli_command *command,
                            option_group group)
{
  return (const char *)settings + command->group[group];
}

bool options_check(const any_settings *settings, const cli_command *command)
{
  const run_settings *run = &settings->run;
  const void *inputs = group_of(settings, command, GROUP_INPUTS);
  const void *reading = group_of(settings, command, GROUP_READING);
  const void *picture = group_of(settings, command, GROUP_PICTURE);
  if ((command->bit & INPUTS) && !check_inputs(inputs, command))
    return false;
  if ((command->bit & READERS) &&
      (!check_slice(reading, command) ||
       !check_map(&((const reading_settings *)reading)->map, command)))
    return false;
  if ((command->bit & (PICTURES | COMMAND_TEXTURE)) && !check_texts(picture, command))
    return false;
  if ((command->bit & PICTURES) && !check_picture(picture, command))
    return false;
  if (command->bit == COMMAND_DRAW)
    return check_map(&settings->draw.map, command) &&
           check_panels(&settings->draw, command);
  if (command->bit == COMMAND_TEXTURE)
    return check_energy(&settings->texture.evolution, command);
  if (!(command->bit & RUNS))
    return true;
  if (run->resume && run->force)
    return usage_error(command,
                       "--resume goes on with what --force would replace: say one");
  return check_placement(run, command) && check_energy(&run->evolution, command) &&
         check_scheme(&run->evolution, command);
}
