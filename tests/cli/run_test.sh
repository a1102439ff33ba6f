#!/usr/bin/env bash
# What a run leaves in its folder, and that it is the same however it was made.
source "$(dirname "$0")/harness.sh"

small=(--nodes 97 --clusters "30,15,8" --width 200 --quiet)
one=(--nodes 97 --clusters 30 --formats svg --quiet) # the first of these scales

try run synth:vortex3 -o out1 "${small[@]}" --threads 1 --save-field --formats svg,png,pdf --no-page
expect_code 0
[ ! -s err ] || fault "standard error: $(head -c 200 err)"
done_with "a run succeeds without a message"

[ "$(ls -A out1 | sed 's/scale-..\./scale./' | sort -u | tr '\n' ' ')" = \
  "evolution.csv run.json scale.geojson scale.pdf scale.png scale.svg scale.vti " ] ||
  fault "$(ls -A out1)"
done_with "the folder holds what is promised and nothing else"

[ "$(wc -l <out)" = 3 ] || fault "not a line a scale: $(cat out)"
while read -r line; do
  expect_file "${line##* }"
done <out
done_with "standard output names a picture a scale"

try run synth:saddle -o small --nodes 65 --clusters 16,8 --quiet --formats svg
expect_code 0
expect_json small/run.json '[.scales[].dropped] | add > 0'
jq -r '.scales[] | "\(.clusters) clusters \(.icons) icons" + ({"0": "", "1": ", 1 cluster too small for one"}[
  .dropped | tostring] // ", \(.dropped) clusters too small for one") + " small/" + .svg' small/run.json >told
sed 's/  */ /g; s/^ //' out | cmp -s - told || fault "$(cat out)"
done_with "it also tells how many clusters are too small for an arrow"

report=out1/run.json
expect_json $report '.version | test("^[0-9.]+$")'
expect_json $report '.input.path == "synth:vortex3"'
expect_json $report '.parameters.anisotropy == 0.15 and .parameters.coverage == 0.3'
expect_json $report '.parameters.seed == 1 and .parameters.gamma > 0 and .parameters.noise == 1.5'
expect_json $report '.mesh.cells[0] >= 96 and .mesh.active_cells == .mesh.cells[0] * .mesh.cells[1]'
expect_json $report '.scales | length == 3'
expect_json $report '[.scales[].index] == [0, 1, 2]'
expect_json $report '[.scales[].wanted[]] == [30, 15, 8]'
expect_json $report '[.scales[] | .clusters <= .wanted[-1] and .icons + .dropped == .clusters] | all'
expect_json $report '[.scales[].clusters] | . == (sort | reverse)'
expect_json $report '[.scales[].time] | . == sort'
expect_json $report '[.scales[].energy] | . == (sort | reverse)'
expect_json $report '[.scales[] | .area_fraction > 0.2 and .area_fraction < 0.45] | all'
expect_json $report '.steps.accepted > 10 and .steps.rejected >= 0'
expect_json $report '.mass_drift >= 0 and .mass_drift < 1e-7'
expect_json $report '.energy_monotone and .energy_monotone_between_coarsenings'
expect_json $report '[.seconds | .read, .evolve, .icons, .pictures, .total] | map(type == "number") | all'
expect_json $report '.seconds.total >= .seconds.evolve'
done_with "run.json keeps its promises"

[ "$(head -1 out1/evolution.csv)" = "step,t,tau,energy,chemical_energy,gradient_energy,mass,area_fraction,clusters,cycles,cells,seconds" ] ||
  fault "$(head -1 out1/evolution.csv)"
awk -F, 'NR == 1 { next }
  NF != 12 { print "line " NR ": " NF " columns"; exit }
  $1 != NR - 1 { print "line " NR ": step " $1; exit }
  NR > 2 && $2 <= t { print "line " NR ": time " $2; exit }
  NR > 2 && $4 > energy { print "line " NR ": energy rises to " $4; exit }
  ($5 + $6 - $4) ^ 2 > 1e-22 || $5 < 0 || $6 < 0 { print "line " NR ": energies " $5 " and " $6; exit }
  NR > 2 && ($7 - mass > 1e-7 || mass - $7 > 1e-7) { print "line " NR ": mass " $7; exit }
  $3 <= 0 || $8 < 0 || $8 > 1 || $10 < 1 || $11 < 1 { print "line " NR ": " $0; exit }
  { t = $2; energy = $4; if (NR == 2) mass = $7 }' out1/evolution.csv >fault.txt
[ ! -s fault.txt ] || fault "$(cat fault.txt)"
[ "$(($(wc -l <out1/evolution.csv) - 1))" = "$(jq .steps.accepted $report)" ] || fault "rows and steps differ"
done_with "evolution.csv: a row a step, energy never up, the sum of its parts, mass held"

for scale in 0 1 2; do
  file=out1/scale-0$scale.geojson
  expect_json $file '.type == "FeatureCollection"'
  expect_json $file "(.features | length) == $(jq ".scales[$scale].icons" $report)"
  expect_json $file '[.features[] | .geometry.type == "LineString" and (.geometry.coordinates | length) >= 2] | all'
  expect_json $file '[.features[].properties | .speed > 0 and .width > 0 and .area > 0 and (.center | length) == 2 and (.kind | length) > 0] | all'
  expect_json $file '[.features[].geometry.coordinates[][] | . >= 0 and . <= 1] | all'
  expect_json $file "([.features[].properties.cluster] | unique | length) == $(jq ".scales[$scale] | .clusters - .dropped" $report)"
done
done_with "GeoJSON: a line an icon, in the unit square, with its properties"

for scale in 0 1 2; do
  xmllint --noout "out1/scale-0$scale.svg" 2>fault.txt || fault "$(head -1 fault.txt)"
  [ "$(head -c 4 "out1/scale-0$scale.png" | tail -c 3)" = PNG ] || fault "no PNG"
  [ "$(head -c 5 "out1/scale-0$scale.pdf")" = %PDF- ] || fault "no PDF"
done
done_with "pictures are of their formats"

try run synth:vortex3 -o out2 "${small[@]}" --threads 2 --formats svg,png,pdf
expect_code 0
for scale in 0 1 2; do
  cmp -s "out1/scale-0$scale.geojson" "out2/scale-0$scale.geojson" || fault "scale $scale differs"
  cmp -s "out1/scale-0$scale.svg" "out2/scale-0$scale.svg" || fault "picture $scale differs"
done
done_with "one and two threads give identical icons and pictures"

try run synth:vortex3 -o out3 "${one[@]}" --seed 2
expect_code 0
cmp -s out1/scale-00.geojson out3/scale-00.geojson && fault "the seed changes nothing"
done_with "another seed gives other icons"

try run synth:vortex3 --formats svg -o out4 --nodes 97 --clusters 30,29,28 --quiet
expect_code 0
expect_json out4/run.json '[.scales[].wanted[]] == [30, 29, 28]'
expect_json out4/run.json '[.scales[] | .clusters <= .wanted[-1]] | all'
done_with "numbers passed in one step are answered by one scale"

try run synth:vortex3 -o out5 --nodes 97 --no-arrows --quiet --formats svg
expect_code 0
expect_json out5/run.json '.scales[-1].clusters <= 12 and .ended == "scales"'
expect_json out5/run.json '[.scales[].wanted[]] | .[-1] == 12 and (. == (sort | reverse))'
expect_json out5/run.json '.scales[0].clusters == .scales[0].wanted[0]'
done_with "without arrows the default scales halve down to 12 clusters"

if [ -z "$sanitized" ]; then # four hundred arrows
# the clusters of this mesh are fewer than the arrows of its first scale
try run synth:vortex3 -o usual --nodes 33 --effort 0 --formats svg --quiet
expect_code 0
expect_json usual/run.json '[.scales[].icons] == [200, 100, 50, 25, 12] and .ended == "scales"'
expect_json usual/run.json '[.scales[].wanted[]] == [200, 100, 50, 25, 12] and .scales[0].clusters < 200'
expect_json usual/run.json '[.scales[].error.mean] | . == sort and .[0] > 0 and .[4] < 40'
[ "$(awk '{print $1, $2}' out | tr '\n' ' ')" = "200 arrows 100 arrows 50 arrows 25 arrows 12 arrows " ] ||
  fault "$(cat out)"
[ ! -s err ] || fault "standard error: $(head -c 200 err)"
done_with "the usual scales have 200 to 12 arrows, and the summary tells"
fi

steps=$(jq .steps.accepted out5/run.json)
try run synth:vortex3 --formats svg -o out6 --nodes 97 --max-steps $((steps - 5)) --clusters 2 --quiet
expect_code 0
expect_json out6/run.json '.ended == "steps" and (.scales | length) == 1 and .scales[0].wanted == []'
expect_json out6/run.json ".steps.accepted == $((steps - 5))"
done_with "--max-steps ends the run, its last state is a scale"

limit=$(jq '.scales[0].time * 1.5' out5/run.json)
try run synth:vortex3 --formats svg -o out7 --nodes 97 --max-time "$limit" --clusters 2 --quiet
expect_code 0
expect_json out7/run.json ".ended == \"time\" and .scales[-1].time >= $limit"
done_with "--max-time ends the run"

try run synth:vortex3 -o out8 --nodes 97 --max-steps 1 --quiet
expect_code 1
expect_one_complaint
expect_error 'no clusters after 1 steps'
expect_nothing_at out8
done_with "a run that ends before there are clusters says so and leaves nothing"

try run synth:vortex3 --formats svg -o out9n --nodes 97 --noise 0.05 --clusters 12 --quiet
expect_code 0
expect_json out9n/run.json '.parameters.noise == 0.05 and .energy_monotone'
done_with "weak noise"

# no direction counts where all is slower by far
try run synth:vortex3 --formats svg -o out9split --nodes 97 --isotropic-below 1e9 --clusters 12 --quiet
expect_code 0
expect_json out9split/run.json '.parameters.isotropic_below == 1e9 and .parameters.anisotropy == 0.15'
expect_json out1/run.json '.parameters.isotropic_below == 0'
try run synth:vortex3 --formats svg -o out9d --nodes 97 --clusters 12 --quiet
cmp -s out9s/scale-00.geojson out9d/scale-00.geojson && fault "the speed does not count"
done_with "slow flow has no direction"

try run synth:vortex3 --formats svg -o out9 --nodes 97 --energy isotropic --clusters 12 --quiet
expect_code 0
expect_json out9/run.json '.parameters.energy == "isotropic"'
done_with "isotropic energy"

# round a vortex the speed's level sets are the streamlines
try run synth:vortex --formats svg -o out9g --nodes 97 --energy gradient --clusters 12 --quiet
expect_code 0
expect_json out9g/run.json '.parameters.energy == "gradient"'
done_with "gradient energy"

if [ -z "$sanitized" ]; then # meshes of 513 nodes
for kind in auto uniform; do
  try run synth:vortex3 --formats svg -o "out9$kind" --nodes 513 --mesh "$kind" --clusters 80,50 --quiet
  expect_code 0
done
expect_json out9uniform/run.json '.parameters.mesh == "uniform" and .mesh.coarser == []'
expect_json out9auto/run.json '.parameters.mesh == "adaptive" and .mesh.cells == [512, 512]
  and (.mesh.coarser | length) == 1 and .mesh.coarser[0].cells == [256, 256]
  and .mesh.coarser[0].clusters <= 64 and .energy_monotone_between_coarsenings and .mass_drift < 1e-7'
cmp -s out9uniform/scale-00.geojson out9auto/scale-00.geojson || fault "it is coarser too early"
cmp -s out9uniform/scale-01.geojson out9auto/scale-01.geojson && fault "the mesh has not changed"
[ "$(cut -d, -f11 out9auto/evolution.csv | sort -u | tr '\n' ' ')" = "262144 65536 cells " ] ||
  fault "evolution.csv: $(cut -d, -f11 out9auto/evolution.csv | sort -u | tr '\n' ' ')"
done_with "an adaptive mesh is halved as clusters grow"
# directions of measured wind change within the width of an interface
try run "$root/data/gfs_20140131.nc" -o out9wind --projection none --nodes 513 --clusters 60,24 --no-arrows --quiet
expect_code 0
expect_json out9wind/run.json '.energy_monotone and (.mesh.coarser | length) == 1
  and .mesh.coarser[0].energy_after <= .mesh.coarser[0].energy_before'
awk -F, -v "$(jq -r '.mesh.coarser[0] | "step=\(.step)"' out9wind/run.json)" \
  -v "$(jq -r '.mesh.coarser[0] | "before=\(.energy_before)"' out9wind/run.json)" \
  -v "$(jq -r '.mesh.coarser[0] | "after=\(.energy_after)"' out9wind/run.json)" '
  NR > 2 && $4 > energy { print "step " $1 ": energy rises to " $4; exit }
  $1 == step && ($4 / before - 1) ^ 2 > 1e-20 { print "step " $1 ": energy " $4 ", not " before; exit }
  $1 == step + 1 && !($4 <= after) { print "step " $1 ": energy " $4; exit }
  { energy = $4 }' out9wind/evolution.csv >fault.txt
[ ! -s fault.txt ] || fault "$(cat fault.txt)"
done_with "the energy does not grow where the mesh is coarsened over measured wind"
fi

# before clusters, while they form, when they can be counted, and two times in one step
times=(run synth:vortex3 --nodes 97 --noise 0.02 --times 1e-5,1.3e-3,4.9e-3,6e-3,6.001e-3,2e-2 --width 200 --no-page)
try "${times[@]}" -o times --save-field
expect_code 0
expect_json times/run.json '.ended == "scales" and .parameters.times == [1e-5, 1.3e-3, 4.9e-3, 6e-3, 6.001e-3, 2e-2]'
expect_json times/run.json '[.scales[].time] | . == sort and length == 5'
jq -r '.scales[].time' times/run.json | awk '
  FNR == NR { t[NR] = $1; n = NR; next }
  FNR > 1 { for (k = 1; k <= n; ++k) if ($2 > t[k] * (1 - 1e-8) && !seen[k]++) at[k] = $2 - $3 }
  END { split("1e-5 1.3e-3 4.9e-3 6e-3 2e-2", wanted, " ")
    for (k = 1; k <= n; ++k)
      if (!(at[k] < wanted[k] && t[k] >= wanted[k])) print "scale " k ": t = " t[k] " after " at[k]
  }' - FS=, times/evolution.csv >fault.txt
[ ! -s fault.txt ] || fault "$(cat fault.txt)"
expect_json times/run.json '[.scales[].icons > 0] == [false, false, true, true, true] and .scales[4].clusters > 4'
expect_error '2 of 5 scales have no arrows'
[ "$(awk '{print $1, $2}' out | sort -u)" = "t =" ] || fault "$(cat out)"
for scale in 0 1 2 3 4; do
  expect_file "times/scale-0$scale.png"
  expect_file "times/scale-0$scale.vti"
done
grep -q '<image' times/scale-00.svg || fault "no density in the picture"
grep -q '<image' times/scale-02.svg && fault "the density is behind the arrows"
done_with "scales at given times, from the noise on"

# first what does not grow of the noise smooths away
awk -F, 'NR == 1 { next }
  NR == 2 { first = $5; least = $6 }
  !$9 && $2 > 1e-3 && !($5 < chemical && $6 > gradient) { print "step " $1 ": " $5 ", " $6; exit }
  { chemical = $5; gradient = $6; least = $6 < least ? $6 : least }
  $9 { if (!($5 < 0.5 * first && $6 > 1000 * least)) print $5 ", " $6 " from " first ", " least; exit }
  ' times/evolution.csv >fault.txt
[ ! -s fault.txt ] || fault "$(cat fault.txt)"
done_with "as phases separate the chemical energy falls and the gradient energy rises"

try "${times[@]}" -o cut --save-field --max-time 2e-3
expect_code 0
expect_json cut/run.json '.ended == "time" and (.scales | length) == 3 and .scales[2].time >= 2e-3'
try "${times[@]}" -o cut --save-field --resume
expect_code 0
expect_same_results cut times
done_with "a run by times goes on"

try run synth:vortex3 -o settled --nodes 33 --times 1e-3,1e8,1e9 --no-page --formats svg --quiet
expect_code 0
expect_json settled/run.json '.ended == "stationary" and (.scales | length) == 2'
expect_error 'came to rest at t = .* all times from there to 1e\+09'
done_with "a pattern at rest stands for all later times"

gamma=(run synth:vortex3 --nodes 65 --gamma 2e-3 --max-steps 40 --clusters 30 --quiet --formats svg)
try "${gamma[@]}" -o out9gamma
expect_code 0
expect_json out9gamma/run.json '.parameters.mesh == "uniform"'
try "${gamma[@]}" -o out9both --mesh adaptive
expect_code 0
expect_json out9both/run.json '.parameters.mesh == "adaptive"'
done_with "with a given gamma the mesh stays as it is"

try run synth:vortex3 --formats svg -o out9t --nodes 65 --scheme theta --clusters 12 --verbose
expect_code 0
expect_error ', theta scheme, '
expect_json out9t/run.json '.parameters.scheme == "theta" and .energy_monotone == true'
expect_json out1/run.json '.parameters.scheme == "bdf2"'
[ "$(awk -F, 'NR > 1 && $10 % 9' out9t/evolution.csv)" = "" ] || fault "cycles are not those of three substeps"
expect_json out9t/run.json '.parameters | (.theta - 0.2928932 | fabs) < 1e-6 and (.alpha - 0.5857864 | fabs) < 1e-6'
expect_json out1/run.json '(.parameters | has("theta") or has("alpha") or has("residual")) or has("largest_residual") | not'
done_with "the theta scheme"

try run synth:vortex3 --formats svg -o out9residual --nodes 65 --scheme theta --theta 0.4 --alpha 1 --residual 1e-2 --clusters 10 --max-steps 60
expect_code 0
expect_json out9residual/run.json '.parameters.theta == 0.4 and .parameters.alpha == 1 and .parameters.residual == 0.01'
expect_json out9residual/run.json '.largest_residual > 1e-4 and .largest_residual <= 0.01 and .energy_monotone'
done_with "another splitting, solved to a residual"

try run synth:vortex3 -o out10 "${one[@]}" --extent cluster
expect_code 0
cmp -s out10/scale-00.geojson out1/scale-00.geojson || fault "scale-00.geojson differs"
for folder in out1 out10; do
  expect_json $folder/run.json '.parameters.extent == "cluster"'
done
try run synth:vortex3 -o out10t "${one[@]}" --extent territory
expect_code 0
expect_json out10t/run.json '.parameters.extent == "territory"'
cmp -s out10/scale-00.geojson out10t/scale-00.geojson && fault "the same arrows"
done_with "--extent cluster is the default, and territory makes other arrows"

: >file
TMPDIR=$PWD/file try run synth:vortex3 -o out11 "${one[@]}"
expect_code 0
[ ! -s err ] || fault "standard error: $(head -c 200 err)"
done_with "a run on its own needs no folder for temporary files"

try run "$root/data/gfs_20140131.nc" --formats svg -o gfs --projection none --nodes 129 --clusters 40 --quiet
expect_code 0
expect_json gfs/run.json '.field.scale == "geo" and .field.period[0] == 360 and .field.velocity == ["u10", "v10"]'
expect_json gfs/scale-00.geojson '.projection == "+proj=longlat" and ([.features[].geometry
  | if .type == "LineString" then .coordinates[] else .coordinates[][] end
  | (.[0] | fabs) <= 180 and (.[1] | fabs) <= 90] | all)'
expect_json gfs/run.json '.mass_drift >= 0 and .mass_drift < 1e-7'
done_with "a global wind field, periodic in longitude"

try run synth:vortex3 --formats svg -o rest --nodes 65 --clusters 1 --quiet
expect_code 0
if [ "$(jq -r .ended rest/run.json)" = stationary ]; then
  expect_error 'no scale of 1 or fewer clusters: the pattern came to rest with'
else
  [ "$(jq -r .ended rest/run.json)" = scales ] || fault "ended: $(jq -c .ended rest/run.json)"
fi
done_with "what the pattern does not reach is said"

# a diagonal channel, three samples wide
awk 'BEGIN {
  n = 24
  printf "# vtk DataFile Version 3.0\nchannel\nASCII\nDATASET STRUCTURED_POINTS\n"
  printf "DIMENSIONS %d %d 1\nORIGIN 0 0 0\nSPACING 1 1 1\nPOINT_DATA %d\nVECTORS v float\n", n, n, n * n
  for (j = 0; j < n; ++j)
    for (i = 0; i < n; ++i)
      print (i - j < 2 && j - i < 2) ? "1 1 0" : "nan nan 0"
}' >channel.vtk
try run channel.vtk -o narrow --nodes 33 --arrows 4,2 --quiet --tint
expect_code 0
expect_json narrow/run.json '[.scales[] | .icons, .clusters] == [4, 0, 2, 0] and .ended == "stationary"'
expect_json narrow/scale-01.geojson '[.features[].geometry.coordinates[] | .[0] - .[1] | fabs <= 2] | all'
try run channel.vtk -o none --nodes 33 --clusters 10 --quiet
expect_code 1
expect_error 'no clusters after [0-9]+ steps, .*: the pattern no longer changes'
done_with "a channel too narrow for clusters has arrows all the same"

try run synth:vortex3 --formats svg -o few --nodes 65 --clusters 400,8 --quiet
expect_code 0
expect_json few/run.json '.scales[0].clusters <= 200'
expect_error "no scale of about 400 clusters: .* $(jq '.scales[0].clusters' few/run.json)$"
expect_one_complaint
try run synth:vortex3 --formats svg -o enough --nodes 65 --clusters 8 --quiet
expect_code 0
[ ! -s err ] || fault "standard error: $(head -c 200 err)"
done_with "a mesh that begins with fewer clusters than were asked for is named"
{
  echo "<VTKFile type='ImageData'><ImageData WholeExtent='0 19 0 14 0 0'>"
  echo "<Piece Extent='0 19 0 14 0 0'><PointData>"
  echo "<DataArray type='Float64' Name='U' NumberOfComponents='2' format='ascii'>"
  for n in {1..300}; do
    case $n in 1 | 299) echo "inf 1" ;; 20) echo "nan 1" ;; *) echo "1 0.$n" ;; esac
  done
  echo "</DataArray></PointData></Piece></ImageData></VTKFile>"
} >infinite.vti
try run infinite.vti -o infinite --nodes 33 --clusters 3 --quiet --formats svg
expect_code 0
expect_error 'infinite.vti: 2 samples are infinite and count as missing'
[ "$(wc -l <err)" -le 2 ] || fault "more is said: $(cat err)"
try texture infinite.vti -o infinite.png --pixels 100
expect_code 0
expect_one_complaint
sed -i 's/^1 0\.44$/1 1e30/' infinite.vti
try texture infinite.vti -o infinite.png
expect_code 1
expect_error 'speeds up to 1e\+30 are taken'
done_with "infinite samples are missing, with a warning"

finish
