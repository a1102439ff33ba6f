/* The figures, in the paper's order. */
#include "gallery.h"

const char *const gallery_data[] = {"convection_cells.nc", "convection_plumes.nc"};
const int gallery_data_count = sizeof gallery_data / sizeof gallery_data[0];

const gallery_figure gallery_figures[] = {
    {.number = 1,
     .title = "Hedgehog and clustering side by side",
     .paper = "A field by straight arrows at the points of a grid, and by the curved "
              "arrows of its clusters.",
     .command = {"rival synth:vortex3 -o fig-01-hedgehog.geojson --method hedgehog "
                 "--icons 100",
                 "run synth:vortex3 -o fig-01 --clusters 100"},
     .picture = {{"fig-01-hedgehog.png", "100 straight arrows on a grid"},
                 {"fig-01/scale-00.png", "100 clusters"}}},
    {.number = 3,
     .title = "The double well",
     .paper = "The energy of the separation, with its two minima at the wells.",
     .draw = gallery_draw_wells,
     .picture = {{"fig-03.svg",
                  "\xCE\xA8(u) = (u\xC2\xB2 \xE2\x88\x92 \xCE\xB2\xC2\xB2)\xC2\xB2/2, "
                  "\xCE\xB2 = 1; where it is concave, phases separate"}}},
    {.number = 5,
     .title = "From a cluster to its arrow",
     .paper =
         "Figures 5 and 6: the density, its clusters, the points of their skeletons, "
         "and curved arrows through the clusters' centres.",
     .differs = "Skeleton points are joined to one line through the cluster, the spine "
                "(dots); its middle is the centre (ring). The arrow follows the "
                "streamline through the centre, or one near it that fits better, and "
                "stays in the cluster: docs/method/icons.md.",
     .command = {"run synth:benard -o fig-05/clusters --clusters 40 --tint",
                 "run synth:benard -o fig-05/skeletons --clusters 40 --tint --skeletons"},
     .picture = {{"fig-05/clusters/scale-00.png", "Clusters and their arrows"},
                 {"fig-05/skeletons/scale-00.png",
                  "Spines and centres of the clusters that the arrows come from"}}},
    {.number = 7,
     .title = "Two successive times with their icons",
     .paper = "Curved arrows at two moments of one evolution, the second coarser.",
     .command = {"run synth:vortex3 -o fig-07 --clusters 80,20 --tint"},
     .picture = {{"fig-07/scale-00.png", "80 clusters"},
                 {"fig-07/scale-01.png", "20 clusters: the same evolution, later"}}},
    {.number = 9,
     .title = "A circular flow",
     .paper = "The clustering of a circular flow; clusters become rings.",
     .command = {"run synth:vortex -o fig-09 --clusters 60,12 --tint"},
     .picture = {{"fig-09/scale-00.png", "60 clusters"},
                 {"fig-09/scale-01.png", "12 clusters"}}},
    {.number = 13,
     .title = "The time line of the \xCE\xB8-scheme",
     .paper = "The three substeps of a time step.",
     .differs = "docs/method/schemes.md compares this scheme, --scheme theta, with the "
                "ones that this program prefers.",
     .draw = gallery_draw_substeps,
     .picture = {{"fig-13.svg", "\xCE\xB8 = 1 \xE2\x88\x92 1/\xE2\x88\x9A"
                                "2, \xCE\xB2 = 1 \xE2\x88\x92 \xCE\xB1"}}},
};
const int gallery_figure_count = sizeof gallery_figures / sizeof gallery_figures[0];
