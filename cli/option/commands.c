/* The commands. */
#include "command/command.h"
#include "option/table.h"

#include <string.h>

const cli_command command_table[] = {
    {.bit = COMMAND_RUN,
     .name = "run",
     .operand = "INPUT",
     .synopsis = "INPUT -o DIR [options]",
     .summary = "write a picture of every scale: the main job",
     .text =
         "Reads a vector field, lets clusters grow on it from fine to coarse, places "
         "for every wanted number exactly so many arrows, which start from the "
         "clusters, and writes each scale into DIR: the icons as GeoJSON and their "
         "picture. Its caption gives the mean direction error: the mean, over the area "
         "and three readers, of the angle between the field and what they "
         "reconstruct from the arrows alone (flowgrain score). DIR also gets run.json, "
         "which says all "
         "that was done, and "
         "evolution.csv, with a row for every time step. INPUT is a NetCDF or GRIB "
         "file; a VTK file of an image, a grid or a plane, or one that names others, "
         "in parallel, as blocks or over time; a table of points in text; NumPy's "
         ".npy or .npz; `-` for one of these on standard input; or synth:NAME for an "
         "analytic field (see flowgrain synth --help). In 3D a scale is the icons as "
         "GeoJSON, VTK polydata (.vtp) and glTF (.glb), a rendered picture for each "
         "--view, and the density u and its clusters (.vti).",
     .work = command_run,
     .group = {[GROUP_READING] = offsetof(run_settings, reading),
               [GROUP_INPUTS] = offsetof(run_settings, inputs),
               [GROUP_EVOLUTION] = offsetof(run_settings, evolution),
               [GROUP_WORK] = offsetof(run_settings, work),
               [GROUP_PICTURE] = offsetof(run_settings, picture)},
     .operand_place = offsetof(run_settings, reading.input),
     .output_place = offsetof(run_settings, output),
     .most_numbers = MAX_SCALES},
    {.bit = COMMAND_VIEW,
     .name = "view",
     .operand = "FILE or DIR",
     .synopsis = "FILE|DIR [options]",
     .summary = "show a run, or a field while it is run, in a browser",
     .text =
         "Shows the page that `flowgrain run` left in DIR, or runs FILE, an INPUT as in "
         "flowgrain run, whose options are taken too, and shows each scale as soon as "
         "it is made, and in the end the page. Prints the address, which only this "
         "machine can open and nobody guesses, opens it in a browser ($BROWSER, else "
         "the desktop's), and serves it until it is interrupted.",
     .work = command_view,
     .group = {[GROUP_READING] = offsetof(view_settings, run.reading),
               [GROUP_INPUTS] = offsetof(view_settings, run.inputs),
               [GROUP_EVOLUTION] = offsetof(view_settings, run.evolution),
               [GROUP_WORK] = offsetof(view_settings, run.work),
               [GROUP_PICTURE] = offsetof(view_settings, run.picture)},
     .operand_place = offsetof(view_settings, run.reading.input),
     .most_numbers = MAX_SCALES},
    {.bit = COMMAND_DRAW,
     .name = "draw",
     .operand = "DIR",
     .more = "DIR",
     .synopsis = "DIR... -o PICTURE [options]",
     .summary = "draw finished runs again, in another style or as panels of one figure",
     .text = "Draws a scale that `flowgrain run` left in DIR; the picture's format "
             "follows the end of its name: .svg, .pdf or .png, and in 3D .vtp or .glb. "
             "The field is read again from the input that run.json names. In 2D several "
             "DIR, a DIR with a series of runs, several numbers of --arrows or "
             "--clusters, or --all-scales become panels of one figure: of the same "
             "size, with one title, one colour key and one colour range, each with a "
             "letter and what tells it from the others, as its time. DIR may also be a "
             "file of icons, .geojson: a scale's in the folder of its run, or another "
             "program's or `flowgrain rival`'s after the run whose field it is of.",
     .work = command_draw,
     .group = {[GROUP_PICTURE] = offsetof(draw_settings, picture),
               [GROUP_INPUTS] = offsetof(draw_settings, inputs)},
     .operand_place = offsetof(draw_settings, folder),
     .more_place = offsetof(draw_settings, more),
     .output_place = offsetof(draw_settings, output),
     .most_numbers = MAX_SCALES},
    {.bit = COMMAND_TEXTURE,
     .name = "texture",
     .operand = "INPUT",
     .synopsis = "INPUT -o PICTURE [options]",
     .summary = "paint a texture that shows the field's direction at every pixel",
     .text = "Paints the field's whole box with streaks along the flow, at the "
             "resolution of the picture however coarse the field's grid; INPUT as for "
             "flowgrain run, the picture's format by the end of its name: .png (the "
             "pixels themselves), .svg or .pdf. --title and --key add a title above and "
             "a colour key below.",
     .work = command_texture,
     .group = {[GROUP_READING] = offsetof(texture_settings, reading),
               [GROUP_INPUTS] = offsetof(texture_settings, inputs),
               [GROUP_EVOLUTION] = offsetof(texture_settings, evolution),
               [GROUP_WORK] = offsetof(texture_settings, work),
               [GROUP_PICTURE] = offsetof(texture_settings, picture)},
     .operand_place = offsetof(texture_settings, reading.input),
     .output_place = offsetof(texture_settings, output),
     .most_numbers = 1},
    {.bit = COMMAND_BRUSH,
     .name = "brush",
     .operand = "IMAGE",
     .synopsis = "IMAGE -o PICTURE [options]",
     .summary = "paint an image in brush strokes",
     .text = "Lets clusters grow along the level sets of an image's grey values and "
             "paints each as a stroke of a brush, in the image's colours: a layer of few "
             "broad strokes first, then finer ones where the painting still differs from "
             "the image. IMAGE is a PNG, JPEG, PGM or PPM file; the picture's format "
             "follows the end of its name: .png, .svg or .pdf.",
     .work = command_brush,
     .group = {[GROUP_WORK] = offsetof(brush_settings, work)},
     .operand_place = offsetof(brush_settings, image),
     .output_place = offsetof(brush_settings, output),
     .most_numbers = FG_MOST_BRUSH_SCALES},
    {.bit = COMMAND_INFO,
     .name = "info",
     .operand = "FILE",
     .synopsis = "FILE [options]",
     .summary = "say what a file holds",
     .text =
         "Lists the vector fields that a file holds: a line `vectors:` for each, as "
         "--vars takes it, with its grid, share of missing values, times and levels, "
         "and the map that it is laid on unless --projection says otherwise; then what "
         "flowgrain run would read with the same options, or why it would refuse. With "
         "options that choose, only the vector that it would read.",
     .work = command_info,
     .group = {[GROUP_READING] = offsetof(info_settings, reading),
               [GROUP_INPUTS] = offsetof(info_settings, inputs)},
     .operand_place = offsetof(info_settings, reading.input)},
    {.bit = COMMAND_SYNTH,
     .name = "synth",
     .operand = "NAME",
     .synopsis = "NAME -o FILE [--nodes N]",
     .summary = "write an analytic field as .vti or .nc",
     .text = "Writes the analytic field NAME, sampled on the unit square or cube, as VTK "
             "image data (FILE ends in .vti) or NetCDF (.nc).",
     .work = command_synth,
     .operand_place = offsetof(synth_settings, name),
     .output_place = offsetof(synth_settings, output)},
    {.bit = COMMAND_RIVAL,
     .name = "rival",
     .operand = "INPUT",
     .synopsis = "INPUT -o FILE.geojson --method KIND [options]",
     .summary = "draw the field by a method to compare with",
     .text = "Draws the field by another method than `flowgrain run`, with about as many "
             "arrows as --icons says and in the same look, so that the pictures can be "
             "put side by side. Writes the arrows as GeoJSON, and their pictures beside: "
             "FILE.svg, FILE.png. With several numbers, the files of each are "
             "FILE-NUMBER.geojson and so on. The methods: `hedgehog` (straight arrows at "
             "the points of a grid), `grid-curved` (pieces of streamlines through them), "
             "`discrete` (clusters merged from the bottom up, Telea and van Wijk 1999), "
             "`top-down` (clusters bisected, Heckel et al. 1999), `streamlines` (evenly "
             "spaced, Jobard and Lefer 1997), `voronoi` (pieces of streamlines through "
             "the centres of a centroidal Voronoi tessellation), `k-means` (the same, "
             "one for each cluster of places and directions), `farthest` (long "
             "streamlines, each from the place farthest from those before, Mebarki et "
             "al. 2005). INPUT is as in flowgrain run, in two dimensions.",
     .work = command_rival,
     .group = {[GROUP_READING] = offsetof(rival_settings, reading),
               [GROUP_INPUTS] = offsetof(rival_settings, inputs),
               [GROUP_PICTURE] = offsetof(rival_settings, picture)},
     .operand_place = offsetof(rival_settings, reading.input),
     .output_place = offsetof(rival_settings, output),
     .most_numbers = MAX_SCALES},
    {.bit = COMMAND_SCORE,
     .name = "score",
     .operand = "INPUT",
     .more = "ICONS",
     .needs_more = true,
     .synopsis = "INPUT ICONS.geojson... [options]",
     .summary = "tell how well icons tell the field",
     .text = "Prints a row for every file of icons (GeoJSON LineStrings from tail to "
             "head, in the coordinates of INPUT, from any program): how many there are; "
             "E_ang, the mean angle in degrees between the field and what a reader makes "
             "of the icons, who continues them harmonically; the same of readers who "
             "take the nearest icon, and all by the inverse of their distance; the mean "
             "of the three, and the angle that 95 % of the area have at most; E_adv, how "
             "far apart particles end; F1 of critical points; mean and greatest void, "
             "and ink, in fair-share lengths; clutter; angle of the lines to the field; "
             "and what lies outside. INPUT is as in flowgrain run.",
     .work = command_score,
     .group = {[GROUP_READING] = offsetof(score_settings, reading),
               [GROUP_INPUTS] = offsetof(score_settings, inputs)},
     .operand_place = offsetof(score_settings, reading.input),
     .more_place = offsetof(score_settings, files),
     .most_numbers = 1},
    {.bit = COMMAND_GALLERY,
     .name = "gallery",
     .synopsis = "-o DIR [options]",
     .summary = "make every figure of the paper, with a page that shows them",
     .text = "Makes the figures of Garcke et al. (2000), each by commands of this "
             "program, and DIR/index.html, which shows each beside what the paper's "
             "shows and the commands that make it again.",
     .work = command_gallery,
     .output_place = offsetof(gallery_settings, output)},
};
const size_t command_count = sizeof command_table / sizeof command_table[0];

const cli_command *command_find(const char *name)
{
  for (size_t k = 0; k < command_count; ++k)
    if (strcmp(command_table[k].name, name) == 0)
      return &command_table[k];
  return NULL;
}

bool option_is_documented(const cli_command *command, const option_entry *option)
{
  const bool handed_on = command->bit == COMMAND_VIEW && (option->commands & COMMAND_RUN);
  const bool general = option->commands == EVERY;
  return (option->commands & command->bit) && (!handed_on || general);
}

size_t option_place(const cli_command *command, const option_entry *option)
{
  return command->group[option->group] + option->place;
}
