/* The options. */
#include "option/table.h"

#include <limits.h>
#include <string.h>

/* An option's place: in the settings of a command, or in a group of several. */
#define OWN(command, member) GROUP_OWN, offsetof(command##_settings, member)
#define READING(member) GROUP_READING, offsetof(reading_settings, member)
#define EVOLUTION(member) GROUP_EVOLUTION, offsetof(evolution_settings, member)
#define WORK(member) GROUP_WORK, offsetof(work_settings, member)
#define PICTURE(member) GROUP_PICTURE, offsetof(picture_settings, member)
#define INPUT(member) GROUP_INPUTS, offsetof(input_settings, member)
#define NOWHERE GROUP_OWN, 0

const char *const scale_words[] = {"auto", "geo", "map", "plain", NULL};
const char *const frame_words[] = {"auto", "east", "grid", NULL};
const char *const mesh_words[] = {"auto", "adaptive", "uniform", NULL};
const char *const energy_words[] = {"flow", "isotropic", "gradient", NULL};
const char *const scheme_words[] = {"bdf2", "euler", "theta", NULL};
static const char *const method_words[] = {
    "hedgehog", "grid-curved", "discrete", "top-down", "streamlines",
    "voronoi",  "k-means",     "farthest", "random",   NULL};
static const char *const lengths_words[] = {"equal", "speed", NULL};
static const char *const kind_words[] = {"lic",     "spots",     "clusters",
                                         "stripes", "diffusion", NULL};
static const char *const background_words[] = {
    "none", "lic", "spots", "clusters", "stripes", "diffusion", NULL};
static const char *const arrow_lengths_words[] = {"free", "fair", NULL};
static const char *const start_words[] = {"clusters", "even", NULL};
const char *const effort_words[] = {"1", "0", "2", NULL};
static const char *const class_words[] = {"arrows", "free", NULL};
const char *const extent_words[] = {"cluster", NULL};

const char *const format_words[FORMAT_KINDS] = {"svg", "png", "pdf"};

enum {
  EVERY = COMMAND_RUN | COMMAND_DRAW | COMMAND_INFO | COMMAND_SYNTH | COMMAND_RIVAL |
          COMMAND_TEXTURE | COMMAND_GALLERY | COMMAND_BRUSH | COMMAND_SCORE,
  READERS = COMMAND_RUN | COMMAND_RIVAL | COMMAND_TEXTURE | COMMAND_SCORE,
  INPUTS = READERS | COMMAND_INFO | COMMAND_DRAW,
  SEEDED = COMMAND_RUN | COMMAND_TEXTURE | COMMAND_BRUSH,
  PICTURES = COMMAND_RUN | COMMAND_DRAW | COMMAND_RIVAL,
};

/* Ranges are those that no input can make sensible beyond; what depends on the input, the
 * library refuses. 16385 nodes a side is 2^14 cells: 270 million nodes, several GB. */
const option_entry option_table[] = {
    {"output", 'o', "DIR", COMMAND_RUN, OPTION_TEXT, OWN(run, output), 0, 0, false, false,
     NULL, "folder for the results; made when it is missing"},
    {"output", 'o', "DIR", COMMAND_GALLERY, OPTION_TEXT, OWN(gallery, output), 0, 0,
     false, false, NULL, "folder for the page and its pictures; made when it is missing"},
    {"output", 'o', "PICTURE", COMMAND_DRAW, OPTION_TEXT, OWN(draw, output), 0, 0, false,
     false, NULL,
     "picture to write, .svg, .pdf or .png; in 3D also solids, .vtp or .glb"},
    {"output", 'o', "PICTURE", COMMAND_TEXTURE, OPTION_TEXT, OWN(texture, output), 0, 0,
     false, false, NULL, "picture to write, .png, .svg or .pdf"},
    {"output", 'o', "PICTURE", COMMAND_BRUSH, OPTION_TEXT, OWN(brush, output), 0, 0,
     false, false, NULL, "picture to write, .png, .svg or .pdf"},
    {"output", 'o', "FILE", COMMAND_SYNTH, OPTION_TEXT, OWN(synth, output), 0, 0, false,
     false, NULL, "file to write, .vti or .nc"},
    {"output", 'o', "FILE", COMMAND_RIVAL, OPTION_TEXT, OWN(rival, output), 0, 0, false,
     false, NULL, "arrows to write, .geojson; their pictures are written beside"},

    {"method", 0, "KIND", COMMAND_RIVAL, OPTION_CHOICE, OWN(rival, method), 0, 0, false,
     false, method_words,
     "hedgehog, grid-curved, discrete, top-down, streamlines, voronoi, k-means, farthest "
     "or random [hedgehog]"},
    {"icons", 0, "LIST", COMMAND_RIVAL, OPTION_NUMBERS, OWN(rival, icons), 1, 100000,
     false, false, NULL,
     "numbers of arrows to draw, descending, as 150,60,25; a grid comes as near as its "
     "shape allows [60]"},
    {"length", 0, "L", COMMAND_RIVAL, OPTION_NUMBER, OWN(rival, length), 0, 1000, false,
     false, NULL,
     "hedgehog, grid-curved, voronoi, k-means, random: length of an arrow (the longest) "
     "in sides of its fair share, the root of area over --icons, in 3D the cube root of "
     "volume [0: 1, on a grid in 2D 0.92 spacings]"},
    {"lengths", 0, "KIND", COMMAND_RIVAL, OPTION_CHOICE, OWN(rival, by_speed), 0, 0,
     false, false, lengths_words,
     "on a grid, `equal` lengths, or lengths in proportion to the `speed` [equal]"},
    {"position-weight", 0, "W", COMMAND_RIVAL, OPTION_NUMBER, OWN(rival, position_weight),
     0, 1, false, false, NULL,
     "discrete: share of the difference in position in the error, in [0,1]; direction "
     "has "
     "the rest [0.95]"},
    {"elongation", 0, "K", COMMAND_RIVAL, OPTION_NUMBER, OWN(rival, elongation), 1, 1e6,
     false, false, NULL,
     "discrete: differences along the flow count K times less than across it [2]"},
    {"nodes", 0, "N", COMMAND_RIVAL, OPTION_WHOLE, OWN(rival, nodes), 3, 16385, false,
     false, NULL,
     "nodes along the longest side of the raster whose cells are clustered, or are seeds "
     "[257, in 3D 49]"},

    {"class", 0, "KIND", COMMAND_SCORE, OPTION_CHOICE, OWN(score, length_class), 0, 0,
     false, false, class_words,
     "`arrows`: lines longer than the fair-share length sqrt(area / N), in 3D the cube "
     "root, count for their middle part of that length; `free`: as long as they are "
     "[arrows]"},
    {"icons", 0, "N", COMMAND_SCORE, OPTION_NUMBERS, OWN(score, icons), 1, 100000, false,
     false, NULL, "the nominal number N of icons [those of each file]"},
    {"ink", 0, "MAX", COMMAND_SCORE, OPTION_NUMBER, OWN(score, ink), 0, 1e6, true, false,
     NULL,
     "cut the longest lines to one length, so that all together are at most MAX N "
     "fair-share lengths [no limit]"},

    {"vars", 0, "U,V[,W]", READERS, OPTION_TEXT, READING(vars), 0, 0, false, false, NULL,
     "the two or three variables, or one vector variable [found by their standard or "
     "usual names; "
     "an ambiguous choice is an error that lists the choices]"},
    {"vars-from", 0, "FILE", READERS, OPTION_TEXT, READING(vars_from), 0, 0, false, false,
     NULL, "second file, which holds the other component"},
    {"time", 0, "TIME", READERS, OPTION_PLACES, READING(time_wish), 0, 0, false, false,
     NULL,
     "which time: a whole number is an index, from 0; a number with a unit or a point is "
     "a "
     "value, 3.5h; a date is the first time within it, 1982-07, 1982-07-16, "
     "1982-07-16T12:00. What is not there is the nearest. run takes several, a folder "
     "each: 0:11, 1982-01:1982-06, 0,6, all [0]"},
    {"level", 0, "LEVEL", READERS, OPTION_PLACES, READING(level_wish), 0, 0, false, false,
     NULL,
     "which level, likewise: 2 is an index, 850hPa or 850. a value; its words, too: "
     "surface [0]"},
    {"mask", 0, "VAR", READERS, OPTION_TEXT, READING(mask), 0, 0, false, false, NULL,
     "variable that is zero (or negative, or missing) outside the domain"},
    {"format", 0, "NAME", INPUTS, OPTION_TEXT, INPUT(format), 0, 0, false, false, NULL,
     "read INPUT as netcdf, vtk, table or another format by its name [found from the "
     "content]"},
    {"max-memory", 0, "SIZE", INPUTS, OPTION_TEXT, INPUT(max_memory), 0, 0, false, false,
     NULL,
     "bytes that the samples of a field may take, as 500M or 2G; what declares more is "
     "refused [three quarters of the machine's]"},
    {"block", 0, "NAME", READERS, OPTION_TEXT, READING(block), 0, 0, false, false, NULL,
     "of a file of several blocks (.vtm), the one of this name or those in it [all "
     "together]"},
    {"slice", 0, "PLANE", READERS, OPTION_TEXT, READING(slice), 0, 0, false, false, NULL,
     "cut a field in 3D: NAME=VALUE, as z=0.5, across an axis, or NX,NY,NZ@X,Y,Z, a "
     "normal and a point; the components in the plane become a field in 2D"},
    {"scale", 0, "KIND", READERS, OPTION_CHOICE, READING(scale), 0, 0, false, false,
     scale_words,
     "what the axes are: `geo` (degrees, velocity along east and north), `map` (a "
     "projected plane) or `plain` [auto: from units and axes]"},
    {"frame", 0, "KIND", READERS, OPTION_CHOICE, READING(frame), 0, 0, false, false,
     frame_words,
     "what the components on a model's grid are along: `east` (and north) or `grid` (the "
     "directions of its indices) [auto: from names, attributes and the grid, as `info` "
     "says]"},

    {"projection", 0, "MAP", READERS, OPTION_TEXT, READING(map.projection), 0, 0, false,
     false, NULL,
     "plane that a field in longitude and latitude is laid on: `auto`, by what it covers "
     "(the globe on Equal Earth, a polar cap on Lambert's azimuthal, others on a "
     "conformal one); `none`, degrees as they are; a name, as robinson, mercator or "
     "polar; \"+proj=...\", a PROJ string; or EPSG:N [auto]"},
    {"center", 0, "LON[,LAT]", READERS, OPTION_CENTER, READING(map), 0, 0, false, false,
     NULL, "middle of the map, degrees [from what the field or --region covers]"},
    {"region", 0, "W,E,S,N", READERS, OPTION_REGION, READING(map), 0, 0, false, false,
     NULL,
     "part of the globe to show: west, east, south, north in degrees [all that the field "
     "covers]"},

    {"projection", 0, "MAP", COMMAND_DRAW, OPTION_TEXT, OWN(draw, map.projection), 0, 0,
     false, false, NULL,
     "draw on another map, as `flowgrain run` has them; arrows keep their lines on the "
     "globe [the run's]"},
    {"center", 0, "LON[,LAT]", COMMAND_DRAW, OPTION_CENTER, OWN(draw, map), 0, 0, false,
     false, NULL, "middle of another map, degrees"},
    {"region", 0, "W,E,S,N", COMMAND_DRAW, OPTION_REGION, OWN(draw, map), 0, 0, false,
     false, NULL, "part of the globe that another map shows, degrees"},

    {"kind", 0, "KIND", COMMAND_TEXTURE, OPTION_CHOICE, OWN(texture, kind), 0, 0, false,
     false, kind_words,
     "kind of texture: `lic` (line integral convolution), `spots` (spot noise, which "
     "shows the speed, too), `clusters` (those of the evolution), `stripes` (which grow "
     "from weak noise) or `diffusion` (of noise along the flow) [lic]"},
    {"pixels", 0, "N", COMMAND_TEXTURE, OPTION_WHOLE, OWN(texture, pixels), 16, 16384,
     false, false, NULL, "pixels along the longest side [1024]"},
    {"length", 0, "L", COMMAND_TEXTURE, OPTION_NUMBER, OWN(texture, length), 2, 400,
     false, false, NULL,
     "length of the streaks, of the longest spots, or four stripes' width together, in "
     "pixels [a 25th of the longest side, of spots an 18th, of diffusion a 20th]"},
    {"clusters", 0, "N", COMMAND_TEXTURE, OPTION_NUMBERS, OWN(texture, number), 1,
     1000000, false, false, NULL,
     "--kind clusters: the first snapshot with at most N of them [300]"},
    {"nodes", 0, "N", COMMAND_TEXTURE, OPTION_WHOLE, EVOLUTION(nodes), 17, 16385, false,
     false, NULL,
     "--kind clusters: nodes of the mesh along its longest side [two pixels a cell]"},
    {"energy", 0, "KIND", COMMAND_TEXTURE, OPTION_TEXT, EVOLUTION(energy), 0, 0, false,
     false, NULL,
     "--kind clusters: `flow`, `gradient` or `isotropic`, as for flowgrain run [flow]"},
    {"anisotropy", 0, "A", COMMAND_TEXTURE, OPTION_NUMBER, EVOLUTION(anisotropy), 0, 1,
     true, false, NULL, "--kind clusters: as for flowgrain run [0.15]"},
    {"coverage", 0, "C", COMMAND_TEXTURE, OPTION_NUMBER, EVOLUTION(coverage), 0, 1, true,
     true, NULL, "--kind clusters: share of the area that they cover [0.3]"},
    {"gamma", 0, "G", COMMAND_TEXTURE, OPTION_NUMBER, EVOLUTION(gamma), 0, 1, true, false,
     NULL, "--kind clusters: interface energy, as for flowgrain run"},
    {"fade", 0, "F", COMMAND_TEXTURE, OPTION_NUMBER, OWN(texture, fade), 0, 1, false,
     false, NULL, "share of the way to white, from 0 to 1 [0]"},

    {"nodes", 0, "N", COMMAND_RUN, OPTION_WHOLE, EVOLUTION(nodes), 17, 16385, false,
     false, NULL,
     "nodes of the mesh along its longest side [from the number of arrows; with "
     "--clusters 257 in 2D, 65 in 3D]"},
    {"nodes", 0, "N", COMMAND_SYNTH, OPTION_WHOLE, OWN(synth, nodes), 2, 16385, false,
     false, NULL, "samples a side [257 in 2D, 65 in 3D]"},
    {"mesh", 0, "KIND", COMMAND_RUN, OPTION_CHOICE, EVOLUTION(mesh), 0, 0, false, false,
     mesh_words,
     "kind of mesh: `adaptive` is halved along each side, down to the default number of "
     "nodes, as clusters grow; `uniform` stays as it is; `auto` is adaptive unless "
     "--gamma is given [auto]"},
    {"scheme", 0, "KIND", COMMAND_RUN, OPTION_CHOICE, EVOLUTION(scheme), 0, 0, false,
     false, scheme_words,
     "time steps: backward differences of second order, implicit `euler`, or the `theta` "
     "splitting, stable in far shorter steps only [bdf2]"},
    {"energy", 0, "KIND", COMMAND_RUN, OPTION_TEXT, EVOLUTION(energy), 0, 0, false, false,
     NULL,
     "interfacial energy: `flow` draws clusters out along the streamlines, `gradient` "
     "along the level sets of the speed, `isotropic` ignores the field; or a file with a "
     "symmetric tensor field, of VTK tensors or variables xx, xy, yy (zz, xz, yz) "
     "[flow]"},
    {"anisotropy", 0, "A", COMMAND_RUN, OPTION_NUMBER, EVOLUTION(anisotropy), 0, 1, true,
     false, NULL,
     "cost of an interface along the flow against one across it, in (0,1]; clusters "
     "become about 1/sqrt(A) times as long as wide [0.15]"},
    {"anisotropy", 0, "A", COMMAND_BRUSH, OPTION_NUMBER, OWN(brush, anisotropy), 0, 1,
     true, true, NULL,
     "cost of an interface along the level sets against one across them; smaller makes "
     "longer strokes [0.15]"},
    {"isotropic-below", 0, "SPEED", COMMAND_RUN, OPTION_NUMBER,
     EVOLUTION(isotropic_below), 0, 1e300, true, false, NULL,
     "speed, in the input's units, below which the flow's direction counts the less the "
     "slower it is: A tends to 1 [A everywhere]"},
    {"coverage", 0, "C", COMMAND_RUN, OPTION_NUMBER, EVOLUTION(coverage), 0, 1, true,
     true, NULL, "share of the area (volume) that clusters shall cover, in (0,1) [0.3]"},
    {"gamma", 0, "G", COMMAND_RUN, OPTION_NUMBER, EVOLUTION(gamma), 0, 1, true, false,
     NULL,
     "interface energy, in units of the longest side squared [(1.1 h)^2 / A for cells of "
     "size h; isotropic (1.5 h)^2]"},
    {"arrows", 0, "LIST", COMMAND_RUN, OPTION_NUMBERS, OWN(run, arrows), 1, 100000, false,
     false, NULL,
     "numbers of arrows, descending: a scale of exactly so many each, placed so that "
     "readers get the field back [200,100,50,25,12; in 3D 60,25,12]"},
    {"tolerance", 0, "DEG", COMMAND_RUN, OPTION_NUMBER, OWN(run, tolerance), 0, 90, true,
     false, NULL,
     "one scale: the fewest arrows from which the field is read within DEG degrees, the "
     "mean error of three readers"},
    {"lengths", 0, "KIND", COMMAND_RUN, OPTION_CHOICE, OWN(run, lengths), 0, 0, false,
     false, arrow_lengths_words,
     "arrows of `free` length, up to twice the fair share (the root of area / arrows), "
     "or of the `fair` share at most [free]"},
    {"start", 0, "KIND", COMMAND_RUN, OPTION_CHOICE, OWN(run, start), 0, 0, false, false,
     start_words,
     "what the first scale's arrows start from: the `clusters` at that number, or an "
     "`even` distribution, which has no seed [clusters]"},
    {"effort", 0, "E", COMMAND_RUN, OPTION_CHOICE, OWN(run, effort), 0, 0, false, false,
     effort_words, "work that placing takes, 0 to 2: less error for more time [1]"},
    {"clusters", 0, "LIST", COMMAND_RUN, OPTION_NUMBERS, OWN(run, clusters), 1, 1000000,
     false, false, NULL,
     "instead of --arrows an arrow inside each cluster, as in the paper: numbers of "
     "clusters, descending, as 200,50,12; a scale is the first snapshot at or below the "
     "number"},
    {"clusters", 0, "LIST", COMMAND_BRUSH, OPTION_NUMBERS, OWN(brush, clusters), 1,
     1000000, false, false, NULL,
     "numbers of clusters, descending, as 2000,400,80: a layer of strokes each, painted "
     "from the last to the first [four layers, the finest of a cluster every 52 pixels]"},
    {"extent", 0, "KIND", COMMAND_RUN, OPTION_CHOICE, OWN(run, extent), 0, 0, false,
     false, extent_words,
     "where an arrow ends: inside its `cluster`, the only KIND [cluster]"},
    {"seed", 0, "S", SEEDED, OPTION_SEED, WORK(seed), 1, 0, false, false, NULL,
     "seed of the initial noise, from 1 [1]"},
    {"noise", 0, "A", COMMAND_RUN, OPTION_NUMBER, EVOLUTION(noise), 0, 5, true, false,
     NULL,
     "amplitude of the initial noise, in (0,5]; weak noise, as 0.05, begins with the "
     "separation of the phases and gives longer clusters [1.5]"},
    {"noise", 0, "A", COMMAND_TEXTURE, OPTION_NUMBER, EVOLUTION(noise), 0, 5, true, false,
     NULL, "--kind clusters: amplitude of the initial noise, as for flowgrain run [1.5]"},
    {"max-time", 0, "T", COMMAND_RUN, OPTION_NUMBER, OWN(run, max_time), 0, 1e300, true,
     false, NULL,
     "stop when the simulated scale t reaches T; its state is the last scale"},
    {"max-time", 0, "T", COMMAND_TEXTURE, OPTION_NUMBER, OWN(texture, max_time), 0, 1e300,
     true, false, NULL,
     "--kind clusters: the first snapshot from the simulated scale t = T on"},
    {"max-steps", 0, "K", COMMAND_RUN, OPTION_WHOLE, OWN(run, max_steps), 1, INT_MAX,
     false, false, NULL, "stop after K time steps; the state reached is the last scale"},
    {"threads", 0, "N", SEEDED, OPTION_WHOLE, WORK(threads), 1, 4096, false, false, NULL,
     "threads to use; the result does not depend on it [all cores]"},
    {"save-field", 0, NULL, COMMAND_RIVAL, OPTION_FLAG, OWN(rival, save_field), 0, 0,
     false, false, NULL,
     "also write the clusters: FILE.vti, with a number a cluster on two nodes a cell"},
    {"save-field", 0, NULL, COMMAND_RUN, OPTION_FLAG, OWN(run, save_field), 0, 0, false,
     false, NULL,
     "also write the density u and the clusters of every scale (scale-NN.vti); always "
     "done in 3D"},

    /* 1e9 seconds are 32 years: never */
    {"checkpoint", 0, "S", COMMAND_RUN, OPTION_NUMBER, OWN(run, checkpoint), 0, 1e9,
     false, false, NULL,
     "seconds between checkpoints, from which the run can go on when it is killed; 0: "
     "after every step [60]"},
    {"resume", 0, NULL, COMMAND_RUN, OPTION_FLAG, OWN(run, resume), 0, 0, false, false,
     NULL,
     "go on from the checkpoint in DIR with the same options, to the same results; "
     "--max-time, --max-steps, --threads and the number of ranks may differ; without a "
     "checkpoint start from the beginning, and leave a finished run as it is"},

    {"scale-index", 0, "I", COMMAND_DRAW, OPTION_WHOLE, OWN(draw, scale_index), 0,
     MAX_SCALES - 1, false, false, NULL,
     "which scale, 0 being the finest [the coarsest]"},
    {"arrows", 0, "N", COMMAND_DRAW, OPTION_NUMBERS, OWN(draw, arrows), 1, 1000000, false,
     false, NULL, "the finest scale with at most N arrows"},
    {"clusters", 0, "N", COMMAND_DRAW, OPTION_NUMBERS, OWN(draw, clusters), 1, 1000000,
     false, false, NULL, "the finest scale with at most N clusters"},
    {"input", 0, "FILE", COMMAND_DRAW, OPTION_TEXT, OWN(draw, input), 0, 0, false, false,
     NULL, "where the field is now, if it is no longer where run.json says"},

    {"formats", 0, "LIST", COMMAND_RUN, OPTION_FORMATS, OWN(run, formats), 0, 0, false,
     false, NULL, "picture formats, of svg, png and pdf [svg,png; in 3D png]"},
    {"formats", 0, "LIST", COMMAND_RIVAL, OPTION_FORMATS, OWN(rival, formats), 0, 0,
     false, false, NULL, "picture formats, of svg, png and pdf [svg,png; in 3D png]"},
    /* 14400 points are the largest page that PDF readers promise to show. */
    {"width", 0, "LENGTH", PICTURES, OPTION_LENGTH, PICTURE(width), 36, 14400, false,
     false, NULL,
     "width of the picture, in points of 1/72 inch or with a unit: 252, 89mm, 8.9cm, "
     "3.5in [480]"},
    {"width", 0, "LENGTH", COMMAND_BRUSH, OPTION_LENGTH, OWN(brush, width), 36, 14400,
     false, false, NULL,
     "width of the picture, in points of 1/72 inch or with a unit: 252, 89mm, 8.9cm, "
     "3.5in; a .png has two pixels a point [a point for every pixel of the image]"},
    {"height", 0, "LENGTH", PICTURES, OPTION_LENGTH, PICTURE(height), 36, 14400, false,
     false, NULL, "height of the picture, likewise [from the domain's shape]"},
    {"dpi", 0, "N", PICTURES, OPTION_NUMBER, PICTURE(dpi), 10, 2400, false, false, NULL,
     "pixels an inch of a .png [144; in 3D, whose pictures are all of pixels, 180]"},
    {"title", 0, "TEXT", PICTURES, OPTION_WORDS, PICTURE(title), 0, 0, false, false, NULL,
     "title of the picture, '' for none; {title}, {time}, {level}, {names} and {arrows} "
     "stand for what the field says of itself and the number of arrows [from the field]"},
    {"subtitle", 0, "TEXT", PICTURES, OPTION_WORDS, PICTURE(subtitle), 0, 0, false, false,
     NULL,
     "in 2D: the line below the title, likewise [from the field; none with --title]"},
    {"label", 0, "TEXT", PICTURES, OPTION_WORDS, PICTURE(label), 0, 0, false, false, NULL,
     "in 2D: label of the colour key, '' for none; {units} stands for its units [mean "
     "speed ({units})]"},
    {"font-size", 0, "LENGTH", PICTURES, OPTION_LENGTH, PICTURE(font_size), 2, 200, false,
     false, NULL,
     "in 2D: size of the texts, in points or with a unit [9 at a width of 480 points, "
     "growing with its root]"},
    {"outline-text", 0, NULL, PICTURES, OPTION_FLAG, PICTURE(outline_text), 0, 0, false,
     false, NULL,
     "in 2D: texts of .svg and .pdf as shapes, which look the same without their font, "
     "instead of texts, which can be searched and edited"},
    {"speed-range", 0, "A,B", PICTURES, OPTION_RANGE, PICTURE(speed_range), 0, 1e15,
     false, false, NULL,
     "speeds at the ends of the colour key; what is slower or faster has the end's "
     "colour "
     "[those of the arrows]"},
    {"surfaces", 0, NULL, COMMAND_RUN | COMMAND_DRAW, OPTION_FLAG, PICTURE(surfaces), 0,
     0, false, false, NULL,
     "in 3D: show the clusters' surfaces round the arrows, transparent; in .vtp and "
     ".glb, "
     "too"},
    {"view", 0, "AZ,EL", PICTURES, OPTION_VIEW, GROUP_PICTURE, 0, 0, 0, false, false,
     NULL,
     "in 3D: where the viewer stands, in degrees counter-clockwise from the front (the "
     "side of least y) and above the horizon; run takes several, a picture each [from "
     "where most of the finest scale's arrows is seen]"},
    {"palette", 0, "NAME", PICTURES, OPTION_PALETTE, PICTURE(palette), 0, 0, false, false,
     NULL, "colour map of the speed, or #rrggbb for one colour [gale]"},
    {"palette", 0, "NAME", COMMAND_TEXTURE, OPTION_PALETTE, OWN(texture, palette), 0, 0,
     false, false, NULL,
     "colour map that shows the speed, or #rrggbb for one colour [greys]"},
    {"key", 0, NULL, COMMAND_TEXTURE, OPTION_FLAG, OWN(texture, key), 0, 0, false, false,
     NULL, "with --palette: a key of the speeds' colours below the texture"},
    {"tint", 0, NULL, COMMAND_RIVAL, OPTION_FLAG, PICTURE(tint), 0, 0, false, false, NULL,
     "discrete, top-down: tint the clusters behind their arrows"},
    {"tint", 0, NULL, COMMAND_RUN, OPTION_FLAG, PICTURE(tint), 0, 0, false, false, NULL,
     "in 2D: tint what each arrow stands for behind it: the points nearest to it, with "
     "--clusters its cluster"},
    {"tint", 0, NULL, COMMAND_DRAW, OPTION_FLAG, PICTURE(tint), 0, 0, false, false, NULL,
     "in 2D: tint what each arrow stands for behind it; clusters only of a run with "
     "--save-field"},
    {"background", 0, "KIND", COMMAND_RUN | COMMAND_DRAW, OPTION_CHOICE,
     PICTURE(background), 0, 0, false, false, background_words,
     "in 2D: a pale texture behind the icons, as flowgrain texture paints: `lic`, "
     "`spots`, `stripes`, `diffusion`, or the `clusters` of the scale (draw: of a run "
     "with "
     "--save-field) [none]"},
    {"skeletons", 0, NULL, COMMAND_RUN, OPTION_FLAG, PICTURE(skeletons), 0, 0, false,
     false, NULL,
     "in 2D, of clusters: mark each spine by dots, and each centre by a ring"},
    {"centers", 0, NULL, COMMAND_RUN, OPTION_FLAG, PICTURE(centers), 0, 0, false, false,
     NULL, "in 2D, of clusters: mark each centre by a ring"},
    {"no-arrows", 0, NULL, COMMAND_RUN, OPTION_FLAG, PICTURE(no_arrows), 0, 0, false,
     false, NULL,
     "in 2D: show clusters, and leave the arrows out of the picture; --tint, --skeletons "
     "and the others remain"},
    {"no-keys", 0, NULL, PICTURES, OPTION_FLAG, PICTURE(no_keys), 0, 0, false, false,
     NULL, "in 2D: no colour key, and no arrow that tells lengths"},
    {"mask-color", 0, "#RRGGBB", PICTURES, OPTION_COLOR, PICTURE(mask_color), 0, 0, false,
     false, NULL, "in 2D: colour of where the field is missing [#dadad7]"},
    {"tint-color", 0, "#RRGGBB", PICTURES, OPTION_COLOR, PICTURE(tint_color), 0, 0, false,
     false, NULL, "in 2D, with --tint: its colour [#d7e4f2]"},
    {"background-fade", 0, "F", COMMAND_RUN | COMMAND_DRAW, OPTION_NUMBER,
     PICTURE(background_fade), 0, 1, true, false, NULL,
     "with --background: share of its way to white, in (0,1] [0.7, stripes 0.85]"},
    {"no-coast", 0, NULL, PICTURES, OPTION_FLAG, PICTURE(no_coast), 0, 0, false, false,
     NULL,
     "of a field on the Earth: neither land nor coasts, lakes, borders; grey where the "
     "field is missing"},
    {"land", 0, "#RRGGBB", PICTURES, OPTION_COLOR, PICTURE(land), 0, 0, false, false,
     NULL, "of a field on the Earth: colour of land, #rrggbb [#ececea]"},
    {"borders", 0, NULL, PICTURES, OPTION_FLAG, PICTURE(borders), 0, 0, false, false,
     NULL, "of a field on the Earth: borders of countries, too"},
    {"no-coast", 0, NULL, COMMAND_TEXTURE, OPTION_FLAG, OWN(texture, no_coast), 0, 0,
     false, false, NULL,
     "of a field on the Earth: no coasts on it, and grey where it is missing"},
    {"land", 0, "#RRGGBB", COMMAND_TEXTURE, OPTION_COLOR, OWN(texture, land), 0, 0, false,
     false, NULL,
     "of a field on the Earth: colour of land where it is missing [#ececea]"},
    {"borders", 0, NULL, COMMAND_TEXTURE, OPTION_FLAG, OWN(texture, borders), 0, 0, false,
     false, NULL, "of a field on the Earth: borders of countries, too"},
    {"no-frame", 0, NULL, PICTURES, OPTION_FLAG, PICTURE(no_frame), 0, 0, false, false,
     NULL, "only mask and arrows: no axes, no keys, no caption"},
    {"transparent", 0, NULL, COMMAND_TEXTURE, OPTION_FLAG, OWN(texture, transparent), 0,
     0, false, false, NULL, "nothing where the field is missing, instead of grey"},
    {"transparent", 0, NULL, PICTURES, OPTION_FLAG, PICTURE(transparent), 0, 0, false,
     false, NULL, "no background"},

    {"transparent", 0, NULL, COMMAND_BRUSH, OPTION_FLAG, OWN(brush, transparent), 0, 0,
     false, false, NULL, "no ground of the image's mean colour under the strokes"},

    {"figure", 0, "N", COMMAND_GALLERY, OPTION_WHOLE, OWN(gallery, figure), 1, 99, false,
     false, NULL, "only figure N of the paper"},

    {"force", 'f', NULL, COMMAND_GALLERY, OPTION_FLAG, OWN(gallery, force), 0, 0, false,
     false, NULL, "replace the gallery in DIR; other files in it stay"},
    {"quiet", 'q', NULL, COMMAND_GALLERY, OPTION_FLAG, OWN(gallery, quiet), 0, 0, false,
     false, NULL, "do not say which figure is being made"},
    {"force", 'f', NULL, COMMAND_RUN, OPTION_FLAG, OWN(run, force), 0, 0, false, false,
     NULL, "replace the results of a finished run in DIR; other files in it stay"},
    {"quiet", 'q', NULL, COMMAND_RUN, OPTION_FLAG, OWN(run, quiet), 0, 0, false, false,
     NULL, "no progress bar (there is none when standard error is no terminal)"},
    {"verbose", 'v', NULL, COMMAND_RUN, OPTION_FLAG, OWN(run, verbose), 0, 0, false,
     false, NULL, "say on standard error what is being done"},
    {"verbose", 'v', NULL, COMMAND_BRUSH, OPTION_FLAG, OWN(brush, verbose), 0, 0, false,
     false, NULL, "say on standard error what is being done"},
    {"json", 0, NULL, COMMAND_INFO, OPTION_FLAG, OWN(info, json), 0, 0, false, false,
     NULL, "as JSON"},
    {"json", 0, NULL, COMMAND_SCORE, OPTION_FLAG, OWN(score, json), 0, 0, false, false,
     NULL, "as JSON"},
    {"help", 'h', NULL, EVERY, OPTION_HELP, NOWHERE, 0, 0, false, false, NULL,
     "print this help"},
    {"version", 'V', NULL, EVERY, OPTION_VERSION, NOWHERE, 0, 0, false, false, NULL,
     "print the version and what this build can do"},
};
const size_t option_count = sizeof option_table / sizeof option_table[0];

int energy_place(const char *word)
{
  for (int k = 0; word && energy_words[k]; ++k)
    if (strcmp(energy_words[k], word) == 0)
      return k;
  return word ? -1 : 0;
}
