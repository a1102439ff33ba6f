#include "option/check.h"

#include <string.h>

#include "option/value.h"

/* A word that no file is likely to be called is a wrong one. */
static bool check_energy(const evolution_settings *said, const cli_command *command)
{
  if (said->anisotropy > 0.0 && energy_place(said->energy) == FG_ENERGY_ISOTROPIC)
    return usage_error(command,
                       "--anisotropy %g: not with --energy isotropic, which has none",
                       said->anisotropy);
  if (said->isotropic_below > 0.0 && energy_place(said->energy) != FG_ENERGY_FLOW)
    return usage_error(command, "--isotropic-below %g: only with --energy flow",
                       said->isotropic_below);
  if (energy_place(said->energy) >= 0)
    return true;
  char words[128];
  list_words(words, sizeof words, energy_words);
  bool takes_file = command->bit == COMMAND_RUN;
  if (!takes_file || !strpbrk(said->energy, "./"))
    return usage_error(command, "--energy %s: not known; the choice is: %s%s",
                       said->energy, words, takes_file ? ", or a file" : "");
  if (said->anisotropy > 0.0)
    return usage_error(command, "--anisotropy %g: that is for --energy to say, %s",
                       said->anisotropy, said->energy);
  return true;
}

/* Arrows are counted, or clusters, or found by their error. */
static bool check_placement(const run_settings *said, const cli_command *command)
{
  if (said->arrows.count && said->clusters.count)
    return usage_error(command,
                       "--arrows and --clusters: say one; --clusters draws an arrow in "
                       "each cluster, however many they are");
  if (said->tolerance > 0.0 && (said->arrows.count || said->clusters.count))
    return usage_error(command,
                       "--tolerance %g: finds the number of arrows; not with --%s",
                       said->tolerance, said->arrows.count ? "arrows" : "clusters");
  if (said->picture.no_arrows && (said->arrows.count || said->tolerance > 0.0))
    return usage_error(command, "--%s and --no-arrows: say one",
                       said->arrows.count ? "arrows" : "tolerance");
  const char *placed = said->start     ? "start"
                       : said->effort  ? "effort"
                       : said->lengths ? "lengths"
                                       : NULL;
  if (placed && !settings_place(said))
    return usage_error(command, "--%s: says nothing with --%s: no arrows are placed",
                       placed, said->clusters.count ? "clusters" : "no-arrows");
  if (settings_place(said) && (said->picture.skeletons || said->picture.centers))
    return usage_error(command, "--%s: of clusters; say how many with --clusters",
                       said->picture.skeletons ? "skeletons" : "centers");
  return true;
}

bool options_check(const any_settings *settings, const cli_command *command)
{
  const run_settings *run = &settings->run;
  if (command->bit == COMMAND_TEXTURE)
    return check_energy(&settings->texture.evolution, command);
  if (command->bit != COMMAND_RUN)
    return true;
  if (run->resume && run->force)
    return usage_error(command,
                       "--resume goes on with what --force would replace: say one");
  return check_placement(run, command) && check_energy(&run->evolution, command);
}
