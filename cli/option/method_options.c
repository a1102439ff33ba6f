/* Options of the evolution and of placement, and of other commands' methods. */
#include <limits.h>
#include <string.h>

#include "option/families.h"

const char *const mesh_words[] = {"auto", "adaptive", "uniform", NULL};
const char *const energy_words[] = {"flow", "isotropic", "gradient", NULL};
const char *const scheme_words[] = {"bdf2", "euler", "theta", NULL};
static const char *const method_words[] = {
    "hedgehog", "grid-curved", "discrete", "top-down", "streamlines",
    "voronoi",  "k-means",     "farthest", "random",   NULL};
static const char *const lengths_words[] = {"equal", "speed", NULL};
static const char *const kind_words[] = {"lic",       "spots", "clusters", "stripes",
                                         "diffusion", "speed", NULL};
static const char *const arrow_lengths_words[] = {"free", "fair", NULL};
static const char *const start_words[] = {"clusters", "even", NULL};
const char *const effort_words[] = {"1", "0", "2", NULL};
static const char *const class_words[] = {"arrows", "free", NULL};
const char *const extent_words[] = {"cluster", "territory", NULL};

/* Ranges exclude values that make no sense for any input; the library refuses those that
 * do not fit the input. 16385 nodes a side is 2^14 cells: 270 million nodes, several
 * GB. */
static const option_entry method_entries[] = {
    {"method", 0, "KIND", COMMAND_RIVAL, OPTION_CHOICE, OWN(rival, method),
     .words = method_words,
     .help = "hedgehog, grid-curved, discrete, top-down, streamlines, voronoi, k-means, "
             "farthest or random [hedgehog]"},
    {"icons", 0, "LIST", COMMAND_RIVAL, OPTION_NUMBERS, OWN(rival, icons), 1, 100000,
     .help = "numbers of arrows to draw, descending, as 150,60,25; a grid comes as near "
             "as its shape allows [60]"},
    {"length", 0, "L", COMMAND_RIVAL, OPTION_NUMBER, OWN(rival, length), 0, 1000,
     .help = "hedgehog, grid-curved, voronoi, k-means, random: length of an arrow (the "
             "longest) in sides of its fair share, the root of area over --icons, in 3D "
             "the cube root of volume [0: 1, on a grid in 2D 0.92 spacings]"},
    {"lengths", 0, "KIND", COMMAND_RIVAL, OPTION_CHOICE, OWN(rival, by_speed),
     .words = lengths_words,
     .help =
         "on a grid, `equal` lengths, or lengths in proportion to the `speed` [equal]"},
    {"position-weight", 0, "W", COMMAND_RIVAL, OPTION_NUMBER, OWN(rival, position_weight),
     0, 1,
     .help = "discrete: share of the difference in position in the error, in [0,1]; "
             "direction has the rest [0.95]"},
    {"elongation", 0, "K", COMMAND_RIVAL, OPTION_NUMBER, OWN(rival, elongation), 1, 1e6,
     .help =
         "discrete: differences along the flow count K times less than across it [2]"},
    {"nodes", 0, "N", COMMAND_RIVAL, OPTION_WHOLE, OWN(rival, nodes), 3, 16385,
     .help = "nodes along the longest side of the raster whose cells are clustered, or "
             "are seeds [257, in 3D 49]"},
    {"class", 0, "KIND", COMMAND_SCORE, OPTION_CHOICE, OWN(score, length_class),
     .words = class_words,
     .help = "`arrows`: lines longer than the fair-share length sqrt(area / N), in 3D "
             "the cube root, count for their middle part of that length; `free`: as long "
             "as they are [arrows]"},
    {"icons", 0, "N", COMMAND_SCORE, OPTION_NUMBERS, OWN(score, icons), 1, 100000,
     .help = "the nominal number N of icons [those of each file]"},
    {"ink", 0, "MAX", COMMAND_SCORE, OPTION_NUMBER, OWN(score, ink), 0, 1e6,
     .open_below = true,
     .help = "cut the longest lines to one length, so that all together are at most MAX "
             "N fair-share lengths [no limit]"},
    {"kind", 0, "KIND", COMMAND_TEXTURE, OPTION_CHOICE, OWN(texture, kind),
     .words = kind_words,
     .help =
         "kind of texture: `lic` (line integral convolution), `spots` (spot noise, which "
         "shows the speed, too), `clusters` (those of the evolution), `stripes` (which "
         "grow from weak noise), `diffusion` (of noise along the flow) or `speed` "
         "(without "
         "streaks) [lic]"},
    {"length", 0, "L", COMMAND_TEXTURE, OPTION_NUMBER, OWN(texture, length), 2, 400,
     .help =
         "length of the streaks, of the longest spots, or four stripes' width together, "
         "in pixels [a 25th of the longest side, of spots an 18th, of diffusion a 20th]"},
    {"clusters", 0, "N", COMMAND_TEXTURE, OPTION_NUMBERS, OWN(texture, number), 1,
     1000000, .help = "--kind clusters: the first snapshot with at most N of them [300]"},
    {"nodes", 0, "N", COMMAND_TEXTURE, OPTION_WHOLE, EVOLUTION(nodes), 17, 16385,
     .help =
         "--kind clusters: nodes of the mesh along its longest side [two pixels a cell]"},
    {"energy", 0, "KIND", COMMAND_TEXTURE, OPTION_TEXT, EVOLUTION(energy),
     .help = "--kind clusters: `flow`, `gradient` or `isotropic`, as for flowgrain run "
             "[flow]"},
    {"anisotropy", 0, "A", COMMAND_TEXTURE, OPTION_NUMBER, EVOLUTION(anisotropy), 0, 1,
     .open_below = true, .help = "--kind clusters: as for flowgrain run [0.15]"},
    {"coverage", 0, "C", COMMAND_TEXTURE, OPTION_NUMBER, EVOLUTION(coverage), 0, 1,
     .open_below = true, .open_above = true,
     .help = "--kind clusters: share of the area that they cover [0.3]"},
    {"gamma", 0, "G", COMMAND_TEXTURE, OPTION_NUMBER, EVOLUTION(gamma), 0, 1,
     .open_below = true,
     .help = "--kind clusters: interface energy, as for flowgrain run"},
    {"noise", 0, "A", COMMAND_TEXTURE, OPTION_NUMBER, EVOLUTION(noise), 0, 5,
     .open_below = true,
     .help =
         "--kind clusters: amplitude of the initial noise, as for flowgrain run [1.5]"},
    {"max-time", 0, "T", COMMAND_TEXTURE, OPTION_NUMBER, OWN(texture, max_time), 0, 1e300,
     .open_below = true,
     .help = "--kind clusters: the first snapshot from the simulated scale t = T on"},
    {"arrows", 0, "LIST", RUNS, OPTION_NUMBERS, OWN(run, arrows), 1, 20000,
     .help = "numbers of arrows, descending: a scale of exactly so many each, placed so "
             "that readers get the field back [200,100,50,25,12; in 3D 60,25,12]"},
    {"tolerance", 0, "DEG", RUNS, OPTION_NUMBER, OWN(run, tolerance), 0, 90,
     .open_below = true,
     .help = "one scale: the fewest arrows with a mean direction error of at most "
             "DEG degrees, averaged over three readers"},
    {"lengths", 0, "KIND", RUNS, OPTION_CHOICE, OWN(run, lengths),
     .words = arrow_lengths_words,
     .help = "arrows of `free` length, up to twice the fair share (the root of area / "
             "arrows), or of the `fair` share at most [free]"},
    {"start", 0, "KIND", RUNS, OPTION_CHOICE, OWN(run, start), .words = start_words,
     .help = "what the first scale's arrows start from: the `clusters` at that number, "
             "or an `even` distribution, which has no seed [clusters]"},
    {"effort", 0, "E", RUNS, OPTION_CHOICE, OWN(run, effort), .words = effort_words,
     .help = "work that placing takes, 0, 1 or 2: less error for more time [1]"},
    {"clusters", 0, "LIST", RUNS, OPTION_NUMBERS, OWN(run, clusters), 1, 1000000,
     .help = "instead of --arrows an arrow inside each cluster, as in the paper: numbers "
             "of clusters, descending, as 200,50,12; a scale is the first snapshot at or "
             "below the number"},
    {"times", 0, "LIST", RUNS, OPTION_TIMES, OWN(run, times),
     .help =
         "instead of --clusters the simulated times t of the scales, ascending, as "
         "3e-4,1e-3,1e-2: a scale is the first snapshot at or after its time, however "
         "many clusters it has"},
    {"extent", 0, "KIND", RUNS, OPTION_CHOICE, OWN(run, extent), .words = extent_words,
     .help = "of --clusters, where an arrow ends: inside its `cluster`, or in its "
             "`territory`, "
             "which is nearer to it than to other clusters [cluster]"},
    {"energy", 0, "KIND", RUNS, OPTION_TEXT, EVOLUTION(energy),
     .help = "interfacial energy: `flow` draws clusters out along the streamlines, "
             "`gradient` along the level sets of the speed, `isotropic` ignores the "
             "field; or a file with a symmetric tensor field, of VTK tensors or "
             "variables xx, xy, yy (zz, xz, yz) [flow]"},
    {"anisotropy", 0, "A", RUNS, OPTION_NUMBER, EVOLUTION(anisotropy), 0, 1,
     .open_below = true,
     .help = "cost of an interface along the flow against one across it, in (0,1]; "
             "clusters become about 1/sqrt(A) times as long as wide [0.15]"},
    {"isotropic-below", 0, "SPEED", RUNS, OPTION_NUMBER, EVOLUTION(isotropic_below), 0,
     1e300, .open_below = true,
     .help = "speed, in the input's units, below which the flow's direction counts the "
             "less the slower it is: A tends to 1 [A everywhere]"},
    {"coverage", 0, "C", RUNS, OPTION_NUMBER, EVOLUTION(coverage), 0, 1,
     .open_below = true, .open_above = true,
     .help = "share of the area (volume) that clusters shall cover, in (0,1) [0.3]"},
    {"gamma", 0, "G", RUNS, OPTION_NUMBER, EVOLUTION(gamma), 0, 1, .open_below = true,
     .help = "interface energy, in units of the longest side squared [(1.1 h)^2 / A for "
             "cells of size h; isotropic (1.5 h)^2]"},
    {"noise", 0, "A", RUNS, OPTION_NUMBER, EVOLUTION(noise), 0, 5, .open_below = true,
     .help = "amplitude of the initial noise, in (0,5]; weak noise, as 0.05, begins with "
             "the separation of the phases and gives longer clusters [1.5]"},
    {"seed", 0, "S", SEEDED, OPTION_SEED, WORK(seed), 1, 0,
     .help = "seed of the initial noise, from 1 [1]"},
    {"nodes", 0, "N", RUNS, OPTION_WHOLE, EVOLUTION(nodes), 17, 16385,
     .help = "nodes of the mesh along its longest side [from the number of arrows; with "
             "--clusters 257 in 2D, 65 in 3D]"},
    {"mesh", 0, "KIND", RUNS, OPTION_CHOICE, EVOLUTION(mesh), .words = mesh_words,
     .help = "kind of mesh: `adaptive` is coarsened, half the cells along each side, "
             "down to the default "
             "number of nodes, as clusters grow; `uniform` stays as it is; `auto` is "
             "adaptive unless --gamma is given [auto]"},
    {"scheme", 0, "KIND", RUNS, OPTION_CHOICE, EVOLUTION(scheme), .words = scheme_words,
     .help = "time steps: backward differences of second order, implicit `euler`, or the "
             "`theta` splitting, stable in far shorter steps only [bdf2]"},
    {"theta", 0, "T", RUNS, OPTION_NUMBER, EVOLUTION(theta), 0, 0.5, .open_below = true,
     .open_above = true,
     .help = "--scheme theta: share of a step that its first and its last substep take, "
             "in (0,0.5) [1 - 1/sqrt(2), the only one of second order]"},
    {"alpha", 0, "A", RUNS, OPTION_NUMBER, EVOLUTION(alpha), 0.5, 1, .open_below = true,
     .help = "--scheme theta: share of the gradient term that these substeps take "
             "implicitly, in (0.5,1] [2 - sqrt(2)]"},
    {"residual", 0, "R", RUNS, OPTION_NUMBER, EVOLUTION(residual), 0, 1,
     .open_below = true, .open_above = true,
     .help = "each step, or substep, takes multigrid cycles until the residual of its "
             "equation is at most R times that of its first guess: a reference for the "
             "fixed number of cycles [2 cycles a step, of other schemes than bdf2 3]"},
    {"max-time", 0, "T", RUNS, OPTION_NUMBER, OWN(run, max_time), 0, 1e300,
     .open_below = true,
     .help = "stop when the simulated scale t reaches T; its state is the last scale"},
    {"max-steps", 0, "K", RUNS, OPTION_WHOLE, OWN(run, max_steps), 1, INT_MAX,
     .help = "stop after K time steps; the state reached is the last scale"},
    {"anisotropy", 0, "A", COMMAND_BRUSH, OPTION_NUMBER, OWN(brush, anisotropy), 0, 1,
     .open_below = true, .open_above = true,
     .help = "cost of an interface along the level sets against one across them; smaller "
             "makes longer strokes [0.15]"},
    {"clusters", 0, "LIST", COMMAND_BRUSH, OPTION_NUMBERS, OWN(brush, clusters), 1,
     1000000,
     .help = "numbers of clusters, descending, as 2000,400,80: a layer of strokes each, "
             "painted from the last to the first [four layers, the finest of a cluster "
             "every 52 pixels]"},
    {"nodes", 0, "N", COMMAND_SYNTH, OPTION_WHOLE, OWN(synth, nodes), 2, 16385,
     .help = "samples a side [257 in 2D, 65 in 3D]"},
    {"figure", 0, "N", COMMAND_GALLERY, OPTION_WHOLE, OWN(gallery, figure), 1, 99,
     .help = "only figure N of the paper"},
};
const option_family method_options = {"Method", method_entries,
                                      sizeof method_entries / sizeof *method_entries};

int energy_place(const char *word)
{
  for (int k = 0; word && energy_words[k]; ++k)
    if (strcmp(energy_words[k], word) == 0)
      return k;
  return word ? -1 : 0;
}
