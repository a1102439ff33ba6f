#!/usr/bin/env bash
# What a run of a field in 3D leaves: icons as solids, the density and its clusters.
source "$(dirname "$0")/harness.sh"

small=(--nodes 33 --clusters "10,5" --quiet --width 96)
files=evolution.csv
pictures= page=
# a program without that feature draws no pictures in 3D
if "$program" --version | grep '^with ' | grep -qw render; then
  pictures=yes
fi
if "$program" --version | grep '^with ' | grep -qw viewer; then
  page=yes
  files="$files index.html"
fi
files="$files run.json"
for scale in 00 01; do
  files="$files scale-$scale.geojson scale-$scale.glb"
  [ -z "$pictures" ] || files="$files scale-$scale.png"
  files="$files scale-$scale.vti scale-$scale.vtp"
done

try run synth:vortex3d -o out1 "${small[@]}" --threads 1
expect_code 0
[ ! -s err ] || fault "$(cat err)"
[ "$(ls -A out1 | tr '\n' ' ')" = "$files " ] ||
  fault "$(ls -A out1)"
done_with "a run in 3D leaves its scales"

[ "$(wc -l <out)" = 2 ] || fault "not a line a scale: $(cat out)"
while read -r line; do
  [[ $line =~ ^\ *[0-9]+\ clusters\ +[0-9]+\ icons ]] || fault "$line"
  expect_file "${line##* }"
done <out
done_with "standard output names a file a scale"

report=out1/run.json
expect_json $report '.mesh.dimension == 3 and .mesh.cells == [32, 32, 32] and .mesh.active_cells == 32768'
expect_json $report '(.mesh.spacing | length) == 3 and .mesh.domain_measure > 0.999 and .mesh.domain_measure < 1.001'
expect_json $report '(.field.size | length) == 3 and (.field.bounds | length) == 6 and (.field.velocity | length) == 3'
expect_json $report '[.scales[].wanted[]] == [10, 5] and ([.scales[] | .clusters <= .wanted[-1]] | all)'
expect_json $report '[.scales[].vti] == ["scale-00.vti", "scale-01.vti"]'
expect_json $report '[.scales[] | .vtp, .glb] == ["scale-00.vtp", "scale-00.glb", "scale-01.vtp", "scale-01.glb"] and ([.scales[] | has("svg")] | any | not)'
expect_json $report '[.scales[] | .icons + .dropped == .clusters and .icons > .clusters / 2] | all'
expect_json $report '.mass_drift >= 0 and .mass_drift < 1e-7 and .energy_monotone == true'
done_with "run.json: the mesh in 3D, the files of its scales"

for scale in 0 1; do
  file=out1/scale-0$scale.geojson
  expect_json $file '[.features[].geometry.coordinates[] | length == 3 and min >= 0 and max <= 1] | all'
  expect_json $file '[.features[].properties | .volume > 0 and .volume < 0.3 and .width > 0 and .speed > 0 and (.center | length) == 3 and (has("area") | not)] | all'
  expect_json $file "(.features | length) == $(jq ".scales[$scale].icons" $report)"
done
done_with "GeoJSON has z and volumes"

for scale in 0 1; do
  file=out1/scale-0$scale.vtp
  xmllint --noout $file 2>fault.txt || fault "$(head -1 fault.txt)"
  icons=$(jq ".scales[$scale].icons" $report)
  verts=$(xmllint --xpath 'string(/VTKFile/PolyData/Piece/@NumberOfVerts)' $file)
  lines=$(xmllint --xpath 'string(/VTKFile/PolyData/Piece/@NumberOfLines)' $file)
  [ "$verts $lines" = "$icons $((2 * icons))" ] || fault "$icons icons, $verts points, $lines lines"
done
done_with "a scale is VTK polydata with centre, spine, streamline and arrow of each icon"

awk -F, 'NR == 1 { next }
  NF != 12 || $1 != NR - 1 || $11 != 32768 { print "line " NR ": " $0; exit }
  NR > 2 && ($2 <= t || $4 > energy) { print "line " NR ": " $0; exit }
  NR > 2 && ($7 - mass > 1e-7 || mass - $7 > 1e-7) { print "line " NR ": mass " $7; exit }
  { t = $2; energy = $4; if (NR == 2) mass = $7 }' out1/evolution.csv >fault.txt
[ ! -s fault.txt ] || fault "$(cat fault.txt)"
done_with "evolution.csv: energy never up, mass held"

for scale in 0 1; do
  file=out1/scale-0$scale.vti
  xmllint --noout $file 2>fault.txt || fault "$(head -1 fault.txt)"
  [ "$(xmllint --xpath 'string(/VTKFile/ImageData/@WholeExtent)' $file)" = "0 32 0 32 0 32" ] ||
    fault "extent $(xmllint --xpath 'string(/VTKFile/ImageData/@WholeExtent)' $file)"
  for name in u cluster; do
    xmllint --xpath "//PointData/DataArray[@Name='$name']/@type" $file >/dev/null 2>&1 || fault "no $name"
  done
done
done_with "a scale is VTK image data with u and cluster"

# a reader of its own, where there is one: every cluster is where u is positive
cat >check.py <<'END'
import sys
import vtk
from vtk.util.numpy_support import vtk_to_numpy
reader = vtk.vtkXMLImageDataReader()
reader.SetFileName(sys.argv[1])
reader.Update()
points = reader.GetOutput().GetPointData()
u, cluster = (vtk_to_numpy(points.GetArray(name)) for name in ("u", "cluster"))
assert u.size == 33 ** 3 and ((cluster != 0) == (u > 0)).all()
assert set(range(1, int(sys.argv[2]) + 1)) == set(cluster[cluster > 0])
END
if /usr/bin/python3 -c 'import vtk' 2>/dev/null; then
  for scale in 0 1; do
    /usr/bin/python3 check.py out1/scale-0$scale.vti "$(jq ".scales[$scale].clusters" $report)" 2>fault.txt ||
      fault "$(tail -1 fault.txt)"
  done
  done_with "VTK reads the scales, and their clusters are those counted"
else
  done_with "VTK reads the scales # SKIP no Python package vtk"
fi

if [ -n "$page" ]; then
  sed -n '/<script type="application\/json" id="run">/,/<\/script>/p' out1/index.html |
    sed -e 's/.*id="run">//; s/<\/script>.*//' >page.json
  expect_json page.json '(.scales | length) == 2 and .low == [0, 0, 0] and .high == [1, 1, 1] and .field.nodes == [48, 48, 48]'
  expect_json page.json "[.scales[].icons | length] == $(jq -c '[.scales[].icons]' $report)"
  # every cluster's icon has a number of its own, and goes into one of the next scale
  expect_json page.json '[.scales[].icons[].id] == [range(1; 1 + ([.scales[].icons[]] | length))]'
  expect_json page.json '[.scales[0].icons[].parent] - [.scales[1].icons[].id] == []'
  expect_json page.json '[.scales[].clusters.vertices > 100] | all'
  [ "$(wc -c <out1/index.html)" -lt 3000000 ] || fault "$(wc -c <out1/index.html) bytes"
  ! grep -qE '(src|href)="(https?:)?//' out1/index.html || fault "the page loads something"
  expect_json $report '.page == "index.html"'
  done_with "its page for browsers holds the scales"
fi

try run synth:vortex3d -o out2 "${small[@]}" --threads 2
expect_code 0
for scale in 0 1; do
  for end in geojson glb vti vtp ${pictures:+png}; do
    cmp -s "out1/scale-0$scale.$end" "out2/scale-0$scale.$end" || fault "scale-0$scale.$end differs"
  done
done
[ -z "$page" ] || cmp -s out1/index.html out2/index.html || fault "another page"
done_with "one and two threads give identical scales"

try run synth:vortex3d -o out3 "${small[@]}" --clusters 10 --seed 2
expect_code 0
cmp -s out1/scale-00.vti out3/scale-00.vti && fault "the seed changes nothing"
done_with "another seed gives another pattern"

for option in --tint '--background lic' '--skeletons --clusters 4' '--centers --clusters 4' --no-arrows; do
  # shellcheck disable=SC2086
  try run synth:abc -o out4 $option --nodes 17 --clusters 8 --quiet
  expect_code 2
  expect_one_complaint
  expect_error "^flowgrain: $(cut -d ' ' -f 1 <<<"$option").*: only in 2D, and synth:abc is in 3D$"
  expect_nothing_at out4
done
for option in --tint '--background clusters'; do
  # shellcheck disable=SC2086
  try draw out1 -o x.png $option
  expect_code 2
  expect_one_complaint
  expect_nothing_at x.png
done
done_with "what a picture in 3D can not show is refused"

if [ -n "$pictures" ]; then
  try draw out1 -o again.png --scale-index 0 --width 96
  expect_code 0
  cmp -s out1/scale-00.png again.png || fault "drawn again, scale 0 differs"
  try draw out1 -o side.pdf --view 120,5 --width 96
  expect_code 0
  [ "$(head -c 5 side.pdf)" = "%PDF-" ] || fault "no PDF"
  done_with "draw draws a run in 3D again"

  for option in '--title A' '--subtitle below' '--label fast' '--font-size 4' --no-keys; do
    # shellcheck disable=SC2086
    try draw out1 -o other.png --scale-index 0 --width 96 $option
    expect_code 0
    cmp -s out1/scale-00.png other.png && fault "$option changes nothing"
  done
  done_with "draw takes words for a picture in 3D"

  try run synth:vortex3d -o views --nodes 17 --clusters 4 --quiet --width 40 --view 30,22 --view -75,60 --no-frame
  expect_code 0
  expect_json views/run.json '.scales[0] | .png == "scale-00.png" and .["png-2"] == "scale-00-2.png"'
  expect_file views/scale-00.png
  expect_file views/scale-00-2.png
  cmp -s views/scale-00.png views/scale-00-2.png && fault "two views are one"
  expect_only_results views
  done_with "each view has a picture"

  try run synth:vortex3d -o bare --nodes 17 --clusters 4 --quiet --width 40 --no-frame
  try run synth:vortex3d -o skins --nodes 17 --clusters 4 --quiet --width 40 --no-frame --surfaces
  expect_code 0
  # shellcheck disable=SC2046
  try draw views -o chosen.png --width 40 --no-frame --view $(jq -r '.view | map(tostring) | join(",")' views/run.json)
  cmp -s chosen.png bare/scale-00.png || fault "the view that was found is not the usual one"
  cmp -s skins/scale-00.png bare/scale-00.png && fault "no surfaces are seen"
  done_with "clusters' surfaces are shown on demand"
else
  try draw out1 -o again.png
  expect_code 1
  expect_one_complaint
  expect_error 'again.png: this build has no pictures in 3D \(FLOWGRAIN_RENDER=OFF\)'
  done_with "without rendering draw refuses a run in 3D"
fi

for view in 5 5,6,7 x,3 30,91 400,0; do
  try run synth:vortex3d -o out4 --view $view
  expect_code 2
  expect_one_complaint
done
expect_nothing_at out4
done_with "views are azimuth and elevation"

try run synth:vortex3d -o out4 --max-steps 1 --nodes 17 --quiet
expect_code 1
expect_error 'no clusters after 1 steps'
expect_nothing_at out4
done_with "a run that ends before there are clusters leaves nothing"
finish
