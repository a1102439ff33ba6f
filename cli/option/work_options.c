/* Options of results and of the work. */
#include "option/families.h"

const char *const format_words[FORMAT_KINDS] = {"svg", "png", "pdf"};

static const option_entry output_entries[] = {
    {"output", 'o', "DIR", COMMAND_RUN, OPTION_TEXT, OWN(run, output),
     .help = "folder for the results; made when it is missing"},
    {"output", 'o', "DIR", COMMAND_VIEW, OPTION_TEXT, OWN(view, run.output),
     .help = "folder that keeps the results [one that is removed at the end]"},
    {"output", 'o', "DIR", COMMAND_GALLERY, OPTION_TEXT, OWN(gallery, output),
     .help = "folder for the page and its pictures; made when it is missing"},
    {"output", 'o', "PICTURE", COMMAND_DRAW, OPTION_TEXT, OWN(draw, output),
     .help = "picture to write, .svg, .pdf or .png; in 3D also solids, .vtp or .glb"},
    {"output", 'o', "PICTURE", COMMAND_TEXTURE, OPTION_TEXT, OWN(texture, output),
     .help = "picture to write, .png, .svg or .pdf"},
    {"output", 'o', "PICTURE", COMMAND_BRUSH, OPTION_TEXT, OWN(brush, output),
     .help = "picture to write, .png, .svg or .pdf"},
    {"output", 'o', "FILE", COMMAND_SYNTH, OPTION_TEXT, OWN(synth, output),
     .help = "file to write, .vti or .nc"},
    {"output", 'o', "FILE", COMMAND_RIVAL, OPTION_TEXT, OWN(rival, output),
     .help = "arrows to write, .geojson; their pictures are written beside"},
    {"formats", 0, "LIST", RUNS, OPTION_FORMATS, OWN(run, formats),
     .help = "picture formats, of svg, png and pdf [svg,png; in 3D png]"},
    {"formats", 0, "LIST", COMMAND_RIVAL, OPTION_FORMATS, OWN(rival, formats),
     .help = "picture formats, of svg, png and pdf [svg,png; in 3D png]"},
    {"save-field", 0, NULL, COMMAND_RIVAL, OPTION_FLAG, OWN(rival, save_field),
     .help = "also write the clusters: FILE.vti, with a number a cluster on two nodes a "
             "cell"},
    {"save-field", 0, NULL, RUNS, OPTION_FLAG, OWN(run, save_field),
     .help = "also write the density u and the clusters of every scale (scale-NN.vti); "
             "always done in 3D"},
    {"no-page", 0, NULL, COMMAND_RUN, OPTION_FLAG, OWN(run, no_page),
     .help = "without index.html, the page for browsers"},
    {"no-browser", 0, NULL, COMMAND_VIEW, OPTION_FLAG, OWN(view, no_browser),
     .help = "only print the address"},
    {"json", 0, NULL, COMMAND_INFO, OPTION_FLAG, OWN(info, json), .help = "as JSON"},
    {"json", 0, NULL, COMMAND_SCORE, OPTION_FLAG, OWN(score, json), .help = "as JSON"},
    {"force", 'f', NULL, COMMAND_GALLERY, OPTION_FLAG, OWN(gallery, force),
     .help = "replace the gallery in DIR; other files in it stay"},
    {"force", 'f', NULL, RUNS, OPTION_FLAG, OWN(run, force),
     .help = "replace the results of a finished run in DIR; other files in it stay"},
    /* 1e9 seconds are 32 years: no checkpoint */
    {"checkpoint", 0, "S", RUNS, OPTION_NUMBER, OWN(run, checkpoint), 0, 1e9,
     .help = "seconds between checkpoints, from which the run can go on when it is "
             "killed; 0: after every step [60]"},
    {"resume", 0, NULL, RUNS, OPTION_FLAG, OWN(run, resume),
     .help =
         "go on from the checkpoint in DIR with the same options, to the same results; "
         "--max-time, --max-steps, --threads and the number of ranks may differ; without "
         "a checkpoint start from the beginning, and leave a finished run as it is"},
};
const option_family output_options = {"Output", output_entries,
                                      sizeof output_entries / sizeof *output_entries};

static const option_entry general_entries[] = {
    {"threads", 0, "N", SEEDED, OPTION_WHOLE, WORK(threads), 1, 4096,
     .help = "threads to use; the result does not depend on it [all cores]"},
    {"quiet", 'q', NULL, COMMAND_GALLERY, OPTION_FLAG, OWN(gallery, quiet),
     .help = "do not say which figure is being made"},
    {"quiet", 'q', NULL, RUNS, OPTION_FLAG, OWN(run, quiet),
     .help = "no word on which time and level is read, and no progress bar (there is "
             "none when standard error is no terminal)"},
    {"verbose", 'v', NULL, RUNS, OPTION_FLAG, OWN(run, verbose),
     .help = "say on standard error what is being done"},
    {"verbose", 'v', NULL, COMMAND_BRUSH, OPTION_FLAG, OWN(brush, verbose),
     .help = "say on standard error what is being done"},
    {"help", 'h', NULL, EVERY, OPTION_HELP, NOWHERE, .help = "print this help"},
    {"version", 'V', NULL, EVERY, OPTION_VERSION, NOWHERE,
     .help = "print the version and what this build can do"},
};
const option_family general_options = {"General", general_entries,
                                       sizeof general_entries / sizeof *general_entries};
