/* The figures, in the paper's order. */
#include "gallery/gallery.h"

const char *const gallery_data[] = {"convection_cells.nc", "convection_plumes.nc",
                                    "monalisa.png"};
const int gallery_data_count = sizeof gallery_data / sizeof gallery_data[0];

/* A texture of the clusters of one snapshot of the evolution. */
#define CLUSTERS(picture, options)                                                       \
  "texture synth:vortex3 -o " picture " --kind clusters --nodes 257 --pixels "           \
  "768 " options

/* The original model, from weak noise on. */
#define SEPARATION(picture, time)                                                        \
  CLUSTERS(picture, "--energy isotropic --noise 0.02 --max-time " time)

/* Twice the paper's nodes a side, for interfaces half as wide. */
#define SHARP(picture, clusters)                                                         \
  "texture synth:vortex3 -o " picture " --kind clusters --nodes 513 --pixels "           \
  "768 --clusters " clusters

/* The same clusters at the same time with another anisotropy. */
#define ANISOTROPY(picture, a)                                                           \
  CLUSTERS(picture, "--gamma 2e-4 --max-time 0.02 --anisotropy " a)

const gallery_figure gallery_figures[] = {
    {.number = 1,
     .title = "Hedgehog and clustering side by side",
     .paper = "A field by straight arrows at the points of a grid, and by the curved "
              "arrows of its clusters.",
     .differs = "The paper does not say which field.",
     .command = {"rival synth:vortex3 -o fig-01-hedgehog.geojson --method hedgehog "
                 "--icons 100",
                 "run synth:vortex3 -o fig-01 --clusters 100"},
     .picture = {{"fig-01-hedgehog.png", "100 straight arrows on a grid"},
                 {"fig-01/scale-00.png", "100 clusters"}}},
    {.number = 2,
     .title = "Isotropic Cahn-Hilliard evolution",
     .paper = "The original model, without a field, at three times.",
     .differs = "The paper names no times. The first picture is the noise of amplitude "
                "0.02 from which the phases separate.",
     .command = {SEPARATION("fig-02-a.png", "1e-6"), SEPARATION("fig-02-b.png", "5.5e-4"),
                 SEPARATION("fig-02-c.png", "9e-4"), SEPARATION("fig-02-d.png", "3e-2")},
     .picture = {{"fig-02-a.png", "t = 1e-6: noise"},
                 {"fig-02-b.png", "t = 6e-4: phases separate"},
                 {"fig-02-c.png", "t = 9e-4: fine structure"},
                 {"fig-02-d.png", "t = 0.03: fewer and larger balls"}}},
    {.number = 3,
     .title = "The double well",
     .paper = "The energy of the separation, with its two minima.",
     .differs = "On the right the energies of Fig. 2's evolution: the chemical energy "
                "falls fast while the gradient energy rises, then clusters coarsen.",
     .draw = gallery_draw_energy,
     .picture = {{"fig-03.svg",
                  "\xCE\xA8(u) = (u\xC2\xB2 \xE2\x88\x92 \xCE\xB2\xC2\xB2)\xC2\xB2/2, "
                  "\xCE\xB2 = 1; where it is concave, phases separate"}}},
    {.number = 4,
     .title = "Clusters of a field, in time and by anisotropy",
     .paper = "The clustering of a field at successive times (upper row), and the effect "
              "of growing anisotropy (lower row); 257 nodes a side.",
     .differs =
         "The paper names neither the times nor the values of a. Above, 513 nodes a "
         "side make interfaces half as wide, and sharp. Below, all but a "
         "is the same: interface energy, noise and time. The interface is "
         "\xE2\x88\x9A(\xCE\xB3"
         "a) thick across the stream, so it grows sharper from left to right.",
     .command = {SHARP("fig-04-a.png", "150"), SHARP("fig-04-b.png", "60"),
                 SHARP("fig-04-c.png", "20"), ANISOTROPY("fig-04-d.png", "1"),
                 ANISOTROPY("fig-04-e.png", "0.5"), ANISOTROPY("fig-04-f.png", "0.2"),
                 ANISOTROPY("fig-04-g.png", "0.1")},
     .picture = {{"fig-04-a.png", "a = 0.15, 150 clusters"},
                 {"fig-04-b.png", "a = 0.15, 60 clusters"},
                 {"fig-04-c.png", "a = 0.15, 20 clusters"},
                 {"fig-04-d.png", "t = 0.02, a = 1: no anisotropy"},
                 {"fig-04-e.png", "t = 0.02, a = 0.5"},
                 {"fig-04-f.png", "t = 0.02, a = 0.2"},
                 {"fig-04-g.png", "t = 0.02, a = 0.1"}},
     .row = {3, 4}},
    {.number = 5,
     .last = 6,
     .title = "From the density to the arrows",
     .paper = "The pipeline: the density, its clusters, the points of their skeletons, "
              "and arrows along the streamlines through the skeletons' centres (balls), "
              "clipped by the clusters; three vortices, 257 nodes a side.",
     .differs = "The skeleton's points are joined to one line through the cluster, the "
                "spine. The streamline goes through its middle, or through a place near "
                "it from where it fits the cluster better (docs/method/icons.md): the "
                "rings. Of Fig. 5 our copy of the paper has not even the caption.",
     .command = {CLUSTERS("fig-06-density.png", "--clusters 40"),
                 "run synth:vortex3 -o fig-06/clusters --clusters 40 --tint --no-arrows "
                 "--no-frame",
                 "run synth:vortex3 -o fig-06/skeletons --clusters 40 --tint --no-arrows "
                 "--no-frame --skeletons",
                 "run synth:vortex3 -o fig-06/arrows --clusters 40 --tint --no-frame "
                 "--centers"},
     .picture = {{"fig-06-density.png", "The density u at 40 clusters"},
                 {"fig-06/clusters/scale-00.png", "The clusters: u > 0"},
                 {"fig-06/skeletons/scale-00.png", "Their spines and centres"},
                 {"fig-06/arrows/scale-00.png", "Their arrows"}},
     .row = {2, 2}},
    {.number = 7,
     .title = "Two successive times with their icons",
     .paper = "Curved arrows in two snapshots of one evolution, the second coarser.",
     .command = {"run synth:vortex3 -o fig-07 --clusters 80,20 --tint"},
     .picture = {{"fig-07/scale-00.png", "80 clusters"},
                 {"fig-07/scale-01.png", "20 clusters: the same evolution, later"}}},
    {.number = 8,
     .title = "Two convective flows over spot noise",
     .paper =
         "Two convective fields, each at a fine (left) and a coarse scale (right), over "
         "a spot-noise texture.",
     .differs = "The paper's fields were not published. These are convection in a porous "
                "layer at Rayleigh numbers 1000 and 3000, computed by "
                "examples/convection.c. Arrows go on from their clusters through the "
                "territories round them (--extent territory), so that no convection cell "
                "is left empty, and few arrows end in a hook.",
     .command =
         {"run convection_cells.nc -o fig-08-cells --clusters 150,40 --nodes 513 "
          "--extent territory --background spots",
          "run convection_plumes.nc -o fig-08-plumes --clusters 150,40 --nodes 513 "
          "--extent territory --background spots"},
     .picture = {{"fig-08-cells/scale-00.png", "Cells, 150 clusters"},
                 {"fig-08-cells/scale-01.png", "Cells, 40 clusters"},
                 {"fig-08-plumes/scale-00.png", "Plumes, 150 clusters"},
                 {"fig-08-plumes/scale-01.png", "Plumes, 40 clusters"}},
     .row = {2, 2}},
    {.number = 9,
     .title = "A circular flow",
     .paper = "The arrows of a circular flow's clusters.",
     .differs =
         "a = 0.06 instead of the usual 0.15, so that clusters reach farther round "
         "the middle.",
     .command = {"run synth:vortex -o fig-09 --clusters 60,20 --anisotropy 0.06 --tint"},
     .picture = {{"fig-09/scale-00.png", "60 clusters"},
                 {"fig-09/scale-01.png", "20 clusters"}}},
    {.number = 10,
     .title = "A circular vortex in three dimensions",
     .paper = "Curved arrows of a vortex in 3D, from two viewpoints: a swirl that rises "
              "in the middle, and turns level along the boundaries.",
     .differs = "The paper gives no formula of its field. Some clusters at the "
                "boundaries are too flat for a solid arrow.",
     .command =
         {"run synth:vortex3d -o fig-10 --clusters 40,12 --view 30,22 --view 75,50"},
     .picture = {{"fig-10/scale-00.png", "40 clusters"},
                 {"fig-10/scale-00-2.png", "The same from another side and above"},
                 {"fig-10/scale-01.png", "12 clusters"},
                 {"fig-10/scale-01-2.png", "The same from another side and above"}},
     .row = {2, 2}},
    {.number = 11,
     .title = "Discrete clustering",
     .paper =
         "The method of Telea and van Wijk (1999) on the field of three vortices (left) "
         "and on the circular one (right): the field's symmetry stays visible, but "
         "nothing holds the clusters' shapes.",
     .differs = "Below, for comparison, the same numbers of continuous clusters. Arrows "
                "are drawn alike for both methods, not as in the paper of 1999.",
     .command =
         {"rival synth:vortex3 -o fig-11-vortices.geojson --method discrete --icons "
          "40 --tint",
          "rival synth:vortex -o fig-11-circle.geojson --method discrete --icons 32 "
          "--tint",
          "run synth:vortex3 -o fig-11/vortices --clusters 40 --tint",
          "run synth:vortex -o fig-11/circle --clusters 32 --tint"},
     .picture = {{"fig-11-vortices.png", "Discrete, 40 clusters"},
                 {"fig-11-circle.png", "Discrete, 32 clusters"},
                 {"fig-11/vortices/scale-00.png", "Continuous, 40 clusters"},
                 {"fig-11/circle/scale-00.png", "Continuous, 32 clusters"}},
     .row = {2, 2}},
    {.number = 12,
     .title = "Brush strokes",
     .paper = "The Mona Lisa as a grey image, in brush strokes of several scales.",
     .differs = "In the painting's colours, and last with all scales on top of each "
                "other. A layer of strokes is three evolutions from different noise (the "
                "broadest four), so that strokes cover the canvas, where the clusters of "
                "one cover a third of it. Grey scales of one evolution are made by "
                "examples/image_scales.c.",
     .command = {"brush monalisa.png -o fig-12-coarse.png --clusters 100",
                 "brush monalisa.png -o fig-12-fine.png --clusters 1000",
                 "brush monalisa.png -o fig-12.png"},
     .picture = {{"fig-12-coarse.png", "100 clusters an evolution"},
                 {"fig-12-fine.png", "1000 clusters an evolution"},
                 {"fig-12.png", "Four scales, the finest last"}}},
    {.number = 13,
     .title = "The time line of the \xCE\xB8-scheme",
     .paper = "The three substeps of a time step.",
     .differs = "docs/method/schemes.md compares this scheme, --scheme theta, with the "
                "ones that this program prefers.",
     .draw = gallery_draw_substeps,
     .picture = {{"fig-13.svg",
                  "K = \xCE\xB3L M\xE2\x81\xBB\xC2\xB9L(A), \xCE\xB8 = 1 \xE2\x88\x92 "
                  "1/\xE2\x88\x9A"
                  "2, \xCE\xB2 = 1 \xE2\x88\x92 \xCE\xB1"}}},
};
const int gallery_figure_count = sizeof gallery_figures / sizeof gallery_figures[0];
