/* Options of pictures. */
#include "option/families.h"

static const char *const background_words[] = {
    "none", "lic", "spots", "clusters", "stripes", "diffusion", "speed", NULL};

static const option_entry picture_entries[] = {
    {"pixels", 0, "N", COMMAND_TEXTURE, OPTION_WHOLE, OWN(texture, pixels), 16, 16384,
     .help = "pixels along the longest side [1024]"},
    {"fade", 0, "F", COMMAND_TEXTURE, OPTION_NUMBER, OWN(texture, fade), 0, 1,
     .help = "share of the way to white, from 0 to 1 [0]"},
    /* 14400 points is the largest page that PDF readers have to support */
    {"width", 0, "LENGTH", PICTURES | COMMAND_TEXTURE, OPTION_LENGTH, PICTURE(width), 36,
     14400,
     .help = "width of the picture, in points of 1/72 inch or with a unit: 252, 89mm, "
             "8.9cm, 3.5in [480, of a tall domain less; texture: half a point a pixel]"},
    {"width", 0, "LENGTH", COMMAND_BRUSH, OPTION_LENGTH, OWN(brush, width), 36, 14400,
     .help =
         "width of the picture, in points of 1/72 inch or with a unit: 252, 89mm, 8.9cm, "
         "3.5in; a .png has two pixels a point [a point for every pixel of the image]"},
    {"height", 0, "LENGTH", PICTURES, OPTION_LENGTH, PICTURE(height), 36, 14400,
     .help = "height of the picture, likewise [from the domain's shape]"},
    {"dpi", 0, "N", PICTURES | COMMAND_TEXTURE, OPTION_NUMBER, PICTURE(dpi), 10, 2400,
     .help =
         "pixels an inch of a .png [144; in 3D, whose pictures are all of pixels, 180; "
         "texture: its pixels are those of --width, or its width that of --pixels]"},
    {"title", 0, "TEXT", PICTURES | COMMAND_TEXTURE, OPTION_WORDS, PICTURE(title),
     .help = "title of the picture, '' for none; {title}, {time}, {level}, {names} and "
             "{arrows} stand for what the field says of itself and the number of arrows "
             "[from the field; texture: none]"},
    {"subtitle", 0, "TEXT", PICTURES | COMMAND_TEXTURE, OPTION_WORDS, PICTURE(subtitle),
     .help = "the line below the title, likewise [from the field; none with --title, or "
             "texture]"},
    {"label", 0, "TEXT", PICTURES | COMMAND_TEXTURE, OPTION_WORDS, PICTURE(label),
     .help = "label of the colour key, '' for none; {units} stands for its units "
             "[mean speed ({units}), in 3D and of a texture speed]"},
    {"columns", 0, "N", COMMAND_DRAW, OPTION_WHOLE, OWN(draw, columns), 1, FG_MOST_PANELS,
     .help = "of several panels: how many in a row [from their shape]"},
    {"panel-label", 0, "TEXT", COMMAND_DRAW, OPTION_WORDS, OWN(draw, panel_label),
     .help = "of several panels: what stands above each, '' for nothing, or one for each "
             "as 'now|then'; {letter} stands for a, b, ..., and {time}, {level}, "
             "{title}, {names} and {arrows} as in a title [({letter}) and what tells it "
             "from the others]"},
    {"font-size", 0, "LENGTH", PICTURES | COMMAND_TEXTURE, OPTION_LENGTH,
     PICTURE(font_size), 2, 200,
     .help = "size of the texts, in points or with a unit [9 at a width of 480 points, "
             "growing with its root]"},
    {"outline-text", 0, NULL, PICTURES | COMMAND_TEXTURE, OPTION_FLAG,
     PICTURE(outline_text),
     .help = "texts of .svg and .pdf as shapes, which look the same without their "
             "font, instead of texts, which can be searched and edited"},
    {"speed-range", 0, "A,B", PICTURES | COMMAND_TEXTURE, OPTION_RANGE,
     PICTURE(speed_range), 0, 1e30,
     .help = "speeds at the ends of the colour key; what is slower or faster has the "
             "end's colour [those of the arrows, but for few that are far above the "
             "others; texture: of the field, but for its fastest hundredth]"},
    {"surfaces", 0, NULL, RUNS | COMMAND_DRAW, OPTION_FLAG, PICTURE(surfaces),
     .help = "in 3D: show the clusters' surfaces round the arrows, transparent; in .vtp "
             "and .glb, too"},
    {"view", 0, "AZ,EL", PICTURES, OPTION_VIEW, GROUP_PICTURE, 0,
     .help = "in 3D: where the viewer stands, in degrees counter-clockwise from the "
             "front (the side of least y) and above the horizon; run takes several, a "
             "picture each [from where most of the finest scale's arrows is seen]"},
    {"palette", 0, "NAME", PICTURES, OPTION_PALETTE, PICTURE(palette),
     .help = "colour map of the speed, or #rrggbb for one colour [gale]"},
    {"palette", 0, "NAME", COMMAND_TEXTURE, OPTION_PALETTE, PICTURE(palette),
     .help = "colour map that shows the speed, or #rrggbb for one colour [greys]"},
    {"key", 0, NULL, COMMAND_TEXTURE, OPTION_FLAG, OWN(texture, key),
     .help = "with --palette: a key of the speeds' colours below the texture"},
    {"tint", 0, NULL, COMMAND_RIVAL, OPTION_FLAG, PICTURE(tint),
     .help = "discrete, top-down: tint the clusters behind their arrows"},
    {"tint", 0, NULL, RUNS, OPTION_FLAG, PICTURE(tint),
     .help = "in 2D: tint what each arrow stands for behind it: the points nearest to "
             "it, with --clusters its cluster"},
    {"tint", 0, NULL, COMMAND_DRAW, OPTION_FLAG, PICTURE(tint),
     .help = "in 2D: tint what each arrow stands for behind it; clusters only of a run "
             "with --save-field"},
    {"background", 0, "KIND", RUNS | COMMAND_DRAW, OPTION_CHOICE, PICTURE(background),
     .words = background_words,
     .help =
         "in 2D: behind the icons, which then have one dark colour, the `speed` in "
         "pale bands; or a pale texture, as flowgrain texture paints: `lic`, `spots`, "
         "`stripes`, `diffusion`, or the `clusters` of the scale (draw: of a run with "
         "--save-field) [none]"},
    {"skeletons", 0, NULL, RUNS, OPTION_FLAG, PICTURE(skeletons),
     .help = "in 2D, of clusters: mark each spine by dots, and each centre by a ring"},
    {"centers", 0, NULL, RUNS, OPTION_FLAG, PICTURE(centers),
     .help = "in 2D, of clusters: mark each centre by a ring"},
    {"features", 0, NULL, RUNS | COMMAND_DRAW, OPTION_FLAG, PICTURE(features),
     .help = "in 2D: mark saddles, centres, spirals, sources and sinks of the flow at "
             "the scale of as many arrows; run writes them into GeoJSON, too"},
    {"no-arrows", 0, NULL, RUNS, OPTION_FLAG, PICTURE(no_arrows),
     .help = "in 2D: show clusters, and leave the arrows out of the picture; --tint, "
             "--skeletons and the others remain"},
    {"no-keys", 0, NULL, PICTURES, OPTION_FLAG, PICTURE(no_keys),
     .help = "no colour key, and no arrow that tells lengths"},
    {"mask-color", 0, "#RRGGBB", PICTURES | COMMAND_TEXTURE, OPTION_COLOR,
     PICTURE(mask_color),
     .help = "in 2D: colour of where the field is missing [#dadad7,"
             " on a map #e4e7ec]"},
    {"tint-color", 0, "#RRGGBB", PICTURES, OPTION_COLOR, PICTURE(tint_color),
     .help = "in 2D, with --tint: its colour [#d7e4f2]"},
    {"background-fade", 0, "F", RUNS | COMMAND_DRAW, OPTION_NUMBER,
     PICTURE(background_fade), 0, 1, .open_below = true,
     .help = "with --background: share of its way to white, in (0,1] [0.7, stripes 0.85, "
             "speed 0.3]"},
    {"no-coast", 0, NULL, PICTURES, OPTION_FLAG, PICTURE(no_coast),
     .help = "of a field on the Earth: neither land nor coasts, lakes, borders; grey "
             "where the field is missing"},
    {"land", 0, "#RRGGBB", PICTURES, OPTION_COLOR, PICTURE(land),
     .help = "of a field on the Earth: colour of land, #rrggbb [#ececea]"},
    {"borders", 0, NULL, PICTURES, OPTION_FLAG, PICTURE(borders),
     .help = "of a field on the Earth: borders of countries, too"},
    {"no-coast", 0, NULL, COMMAND_TEXTURE, OPTION_FLAG, PICTURE(no_coast),
     .help = "of a field on the Earth: no coasts on it, and grey where it is missing"},
    {"land", 0, "#RRGGBB", COMMAND_TEXTURE, OPTION_COLOR, PICTURE(land),
     .help = "of a field on the Earth: colour of land where it is missing [#ececea]"},
    {"borders", 0, NULL, COMMAND_TEXTURE, OPTION_FLAG, PICTURE(borders),
     .help = "of a field on the Earth: borders of countries, too"},
    {"no-frame", 0, NULL, PICTURES, OPTION_FLAG, PICTURE(no_frame),
     .help = "only mask and arrows: no axes, no keys, no caption"},
    {"transparent", 0, NULL, COMMAND_TEXTURE, OPTION_FLAG, PICTURE(transparent),
     .help = "nothing where the field is missing, instead of grey"},
    {"transparent", 0, NULL, PICTURES, OPTION_FLAG, PICTURE(transparent),
     .help = "no background"},
    {"transparent", 0, NULL, COMMAND_BRUSH, OPTION_FLAG, OWN(brush, transparent),
     .help = "no ground of the image's mean colour under the strokes"},
};
const option_family picture_options = {"Picture", picture_entries,
                                       sizeof picture_entries / sizeof *picture_entries};
