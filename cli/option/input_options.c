/* Options of the input and of its map. */
#include "option/families.h"

const char *const scale_words[] = {"auto", "geo", "map", "plain", "log", NULL};
const char *const frame_words[] = {"auto", "east", "grid", NULL};

static const option_entry input_entries[] = {
    {"scale-index", 0, "I", COMMAND_DRAW, OPTION_WHOLE, OWN(draw, scale_index), 0,
     MAX_SCALES - 1, .help = "which scale, 0 being the finest [the coarsest]"},
    {"arrows", 0, "LIST", COMMAND_DRAW, OPTION_NUMBERS, OWN(draw, arrows), 1, 1000000,
     .help = "the finest scale with at most so many arrows; of several numbers, as "
             "200,60,20, a panel each"},
    {"clusters", 0, "LIST", COMMAND_DRAW, OPTION_NUMBERS, OWN(draw, clusters), 1, 1000000,
     .help = "the finest scale with at most so many clusters, likewise"},
    {"all-scales", 0, NULL, COMMAND_DRAW, OPTION_FLAG, OWN(draw, all_scales),
     .help = "every scale, a panel each"},
    {"input", 0, "FILE", COMMAND_DRAW, OPTION_TEXT, OWN(draw, input),
     .help = "where the field is now, if it is no longer where run.json says"},
    {"vars-from", 0, "FILE", COMMAND_DRAW, OPTION_TEXT, OWN(draw, vars_from),
     .help = "likewise, the file with the other component"},
    {"mesh-from", 0, "FILE", COMMAND_DRAW, OPTION_TEXT, OWN(draw, mesh_from),
     .help = "likewise, the file with the mesh"},
    {"vars", 0, "U,V[,W]", READERS, OPTION_TEXT, READING(vars),
     .help =
         "the two or three variables, a speed and its direction, or one vector variable "
         "[found by their standard or usual names; an ambiguous choice is an error that "
         "lists the choices]"},
    {"vars-from", 0, "FILE", READERS, OPTION_TEXT, READING(vars_from),
     .help = "second file, which holds the other component, the positions, or the mesh"},
    {"mesh-from", 0, "FILE", READERS, OPTION_TEXT, READING(mesh_from),
     .help = "file with the positions or the mesh, where both components have a file of "
             "their own (NetCDF)"},
    {"time", 0, "TIME", READERS, OPTION_PLACES, READING(time_text),
     .help = "which time: a whole number is an index, from 0; a number with a unit or a "
             "point is a value, 3.5h; a date is the first time within it, 1982, "
             "1982-07, 1982-07-16, 1982-07-16T12:00. Of one value or date that is not "
             "there the nearest is taken, unless it lies farther beyond the first or the "
             "last than that is from the next. run takes several, a folder each and up "
             "to 12 as panels of one figure, too: 0:11, 1982-01:1982-06, 0,6, all [0]"},
    {"level", 0, "LEVEL", READERS, OPTION_PLACES, READING(level_text),
     .help =
         "which level, likewise: 2 is an index, 850hPa or 850. a value, and 850, "
         "too, where there are fewer levels and one has that value; words that info "
         "prints, as surface in GRIB; without levels, where one other dimension is left, "
         "of that: the members of an ensemble, 0:3 [that at the surface of an ocean, "
         "else 0]"},
    {"at", 0, "NAME=WHICH", READERS, OPTION_TEXT, READING(at), .once = true,
     .help = "of a dimension that is neither time nor level, as the members of an "
             "ensemble, the one to read: number=2 by its value or, where none has that, "
             "its index, from 0; scenario=ssp585 by its name; of several, with commas "
             "between (NetCDF)"},
    {"mask", 0, "VAR", READERS, OPTION_TEXT, READING(mask),
     .help = "variable that is zero (or negative, or missing) outside the domain"},
    {"missing", 0, "VALUES", READERS, OPTION_TEXT, READING(missing),
     .help = "numbers that stand for missing values, besides those that the file "
             "declares: -9999,1e20; or none: every number is a value [a number that "
             "recurs apart from all others is refused]"},
    {"format", 0, "NAME", INPUTS, OPTION_TEXT, INPUT(format),
     .help = "read INPUT as netcdf, vtk, table or another format by its name [found from "
             "the content]"},
    {"max-memory", 0, "SIZE", INPUTS, OPTION_TEXT, INPUT(max_memory),
     .help =
         "bytes that the samples of a field, and standard input, may take, as 500M or "
         "2G; what has more is refused [three quarters of the machine's; for standard "
         "input 1G]"},
    {"block", 0, "NAME", READERS, OPTION_TEXT, READING(block),
     .help = "of a file of several blocks (.vtm), the one of this name or those in it "
             "[all together]"},
    {"slice", 0, "PLANE", READERS, OPTION_TEXT, READING(slice),
     .help =
         "cut a field in 3D: NAME=VALUE, as z=0.5, across an axis, or NX,NY,NZ@X,Y,Z, a "
         "normal and a point; the components in the plane become a field in 2D"},
    {"scale", 0, "KIND", READERS, OPTION_CHOICE, READING(scale), .words = scale_words,
     .help = "what the axes are: `geo` (degrees, velocity along east and north), `map` "
             "(a projected plane), `plain`, or `log` (a vertical section, by the "
             "logarithm of its "
             "pressures) [auto: from units and axes]"},
    {"frame", 0, "KIND", READERS, OPTION_CHOICE, READING(frame), .words = frame_words,
     .help = "what the components on a model's grid are along: `east` (and north) or "
             "`grid` (the directions of its indices) [auto: from names, attributes and "
             "the grid, as `info` says]"},
    {"projection", 0, "MAP", READERS, OPTION_TEXT, READING(map.projection),
     .help =
         "plane that a field in longitude and latitude is laid on: `auto`, by what it "
         "covers (the globe on Equal Earth, a polar cap on Lambert's azimuthal, others "
         "on a conformal one); `none`, degrees as they are; a name, as robinson, "
         "mercator or polar; \"+proj=...\", a PROJ string; or EPSG:N [auto]"},
    {"center", 0, "LON[,LAT]", READERS, OPTION_CENTER, READING(map),
     .help = "middle of the map, degrees [from what the field or --region covers]"},
    {"region", 0, "W,E,S,N", READERS, OPTION_REGION, READING(map),
     .help = "part to show: of the globe west, east, south, north in degrees; of another "
             "plane X0,X1,Y0,Y1 and of a volume X0,X1,Y0,Y1,Z0,Z1, in units of its axes, "
             "read at the part's own resolution [all that the field covers]"},
    {"projection", 0, "MAP", COMMAND_DRAW, OPTION_TEXT, OWN(draw, map.projection),
     .help = "draw on another map, as `flowgrain run` has them; arrows keep their lines "
             "on the globe [the run's]"},
    {"center", 0, "LON[,LAT]", COMMAND_DRAW, OPTION_CENTER, OWN(draw, map),
     .help = "middle of another map, degrees [from what it shows]"},
    {"region", 0, "W,E,S,N", COMMAND_DRAW, OPTION_REGION, OWN(draw, map),
     .help = "part of the globe that another map shows, degrees; all of it is "
             "-180,180,-90,90 [the run's]"},
};
const option_family input_options = {"Input", input_entries,
                                     sizeof input_entries / sizeof *input_entries};
