/* The figures, in the paper's order. */
#include "gallery.h"

const char *const gallery_data[] = {"convection_cells.nc", "convection_plumes.nc",
                                    "monalisa.png"};
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
    {.number = 2,
     .title = "Isotropic Cahn-Hilliard evolution",
     .paper = "The original model, without a field, at three times.",
     .command = {"texture synth:vortex3 -o fig-02-a.png --kind clusters --nodes 257 "
                 "--pixels 768 --energy isotropic --clusters 150",
                 "texture synth:vortex3 -o fig-02-b.png --kind clusters --nodes 257 "
                 "--pixels 768 --energy isotropic --clusters 60",
                 "texture synth:vortex3 -o fig-02-c.png --kind clusters --nodes 257 "
                 "--pixels 768 --energy isotropic --clusters 20"},
     .picture = {{"fig-02-a.png", "150 clusters"},
                 {"fig-02-b.png", "60 clusters"},
                 {"fig-02-c.png", "20 clusters"}}},
    {.number = 3,
     .title = "The double well",
     .paper = "The energy of the separation, with its two minima at the wells.",
     .draw = gallery_draw_wells,
     .picture = {{"fig-03.svg",
                  "\xCE\xA8(u) = (u\xC2\xB2 \xE2\x88\x92 \xCE\xB2\xC2\xB2)\xC2\xB2/2, "
                  "\xCE\xB2 = 1; where it is concave, phases separate"}}},
    {.number = 4,
     .title = "Clusters of a field, in time and by anisotropy",
     .paper = "The clustering of a field at successive times, and the same with the "
              "anisotropy growing: a = 1, 0.5, 0.2, 0.1; 257 nodes a side.",
     .differs =
         "The last four have the same interface energy, and are shown when they have "
         "come down to 40 clusters, not at one time.",
     .command = {"texture synth:vortex3 -o fig-04-a.png --kind clusters --nodes 257 "
                 "--pixels 768 --clusters 150",
                 "texture synth:vortex3 -o fig-04-b.png --kind clusters --nodes 257 "
                 "--pixels 768 --clusters 60",
                 "texture synth:vortex3 -o fig-04-c.png --kind clusters --nodes 257 "
                 "--pixels 768 --clusters 20",
                 "texture synth:vortex3 -o fig-04-d.png --kind clusters --nodes 257 "
                 "--pixels 768 --gamma 2e-4 --clusters 40 --anisotropy 1",
                 "texture synth:vortex3 -o fig-04-e.png --kind clusters --nodes 257 "
                 "--pixels 768 --gamma 2e-4 --clusters 40 --anisotropy 0.5",
                 "texture synth:vortex3 -o fig-04-f.png --kind clusters --nodes 257 "
                 "--pixels 768 --gamma 2e-4 --clusters 40 --anisotropy 0.2",
                 "texture synth:vortex3 -o fig-04-g.png --kind clusters --nodes 257 "
                 "--pixels 768 --gamma 2e-4 --clusters 40 --anisotropy 0.1"},
     .picture = {{"fig-04-a.png", "a = 0.15, 150 clusters"},
                 {"fig-04-b.png", "a = 0.15, 60 clusters"},
                 {"fig-04-c.png", "a = 0.15, 20 clusters"},
                 {"fig-04-d.png", "a = 1"},
                 {"fig-04-e.png", "a = 0.5"},
                 {"fig-04-f.png", "a = 0.2"},
                 {"fig-04-g.png", "a = 0.1"}}},
    {.number = 5,
     .title = "From a cluster to its arrow",
     .paper =
         "Figures 5 and 6: the density, its clusters, the points of their skeletons, "
         "and curved arrows through the clusters' centres.",
     .differs = "Skeleton points are joined to one line through the cluster, the spine "
                "(dots); its middle is the centre (ring). The arrow follows the "
                "streamline through the centre, or one near it that fits better, and "
                "stays in the cluster: docs/method/icons.md.",
     .command = {"texture synth:benard -o fig-05-density.png --kind clusters --nodes 257 "
                 "--pixels 768 --clusters 40",
                 "run synth:benard -o fig-05/clusters --clusters 40 --tint",
                 "run synth:benard -o fig-05/skeletons --clusters 40 --tint --skeletons"},
     .picture = {{"fig-05-density.png", "The density"},
                 {"fig-05/clusters/scale-00.png", "Clusters and their arrows"},
                 {"fig-05/skeletons/scale-00.png",
                  "Spines and centres of the clusters that the arrows come from"}}},
    {.number = 7,
     .title = "Two successive times with their icons",
     .paper = "Curved arrows at two moments of one evolution, the second coarser.",
     .command = {"run synth:vortex3 -o fig-07 --clusters 80,20 --tint"},
     .picture = {{"fig-07/scale-00.png", "80 clusters"},
                 {"fig-07/scale-01.png", "20 clusters: the same evolution, later"}}},
    {.number = 8,
     .title = "Two convective flows over spot noise",
     .paper =
         "Two convective fields, each at a fine and a coarse scale, over a spot-noise "
         "texture.",
     .differs = "The paper's fields were not published. These are convection in a porous "
                "layer at Rayleigh numbers 1000 and 3000, computed by "
                "examples/convection.c.",
     .command =
         {"run convection_cells.nc -o fig-08-cells --clusters 150,40 --nodes 513 "
          "--background spots",
          "run convection_plumes.nc -o fig-08-plumes --clusters 150,40 --nodes 513 "
          "--background spots"},
     .picture = {{"fig-08-cells/scale-00.png", "Cells, 150 clusters"},
                 {"fig-08-cells/scale-01.png", "Cells, 40 clusters"},
                 {"fig-08-plumes/scale-00.png", "Plumes, 150 clusters"},
                 {"fig-08-plumes/scale-01.png", "Plumes, 40 clusters"}}},
    {.number = 9,
     .title = "A circular flow",
     .paper = "The clustering of a circular flow; clusters become rings.",
     .command = {"run synth:vortex -o fig-09 --clusters 60,12 --tint"},
     .picture = {{"fig-09/scale-00.png", "60 clusters"},
                 {"fig-09/scale-01.png", "12 clusters"}}},
    {.number = 10,
     .title = "A circular vortex in three dimensions",
     .paper = "Curved arrows of a vortex in 3D, from two viewpoints.",
     .command =
         {"run synth:vortex3d -o fig-10 --clusters 40,12 --view 30,22 --view 75,50"},
     .picture = {{"fig-10/scale-00.png", "40 clusters"},
                 {"fig-10/scale-00-2.png", "The same from above"},
                 {"fig-10/scale-01.png", "12 clusters"},
                 {"fig-10/scale-01-2.png", "The same from above"}}},
    {.number = 11,
     .title = "Discrete clustering",
     .paper =
         "The method of Telea and van Wijk (1999), which the paper compares with, on "
         "the field of three vortices and on the circular one.",
     .command =
         {"rival synth:vortex3 -o fig-11-vortices.geojson --method discrete --icons "
          "40 --tint",
          "rival synth:vortex -o fig-11-circle.geojson --method discrete --icons 20 "
          "--tint"},
     .picture = {{"fig-11-vortices.png", "Three vortices, 40 clusters"},
                 {"fig-11-circle.png", "Circular flow, 20 clusters"}}},
    {.number = 12,
     .title = "Brush strokes",
     .paper = "The Mona Lisa in brush strokes of several scales.",
     .differs = "In the painting's colours, and all scales on top of each other.",
     .command = {"brush monalisa.png -o fig-12-coarse.png --clusters 100",
                 "brush monalisa.png -o fig-12-fine.png --clusters 1000",
                 "brush monalisa.png -o fig-12.png"},
     .picture = {{"fig-12-coarse.png", "100 clusters, a stroke each"},
                 {"fig-12-fine.png", "1000 clusters"},
                 {"fig-12.png", "Four scales, the finest last"}}},
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
