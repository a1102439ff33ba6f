#!/usr/bin/env bash
# Volumes: written, described, read from files of each format.
source "$(dirname "$0")/harness.sh"

# expect_info FILE WORDS...: what info says of a file has all of these.
expect_info() {
  local words
  try info "$1"
  expect_code 0
  for words in "${@:2}"; do
    grep -q "$words" out || fault "$(cat out)"
  done
}

for end in vti nc; do
  try synth abc -o abc.$end --nodes 17
  expect_code 0
  expect_info abc.$end 'grid: 17 x 17 x 17' 'z: 0 to 1'
  try info --json abc.$end
  cp out $end.json
  expect_json $end.json '.vectors[0].size == [17, 17, 17] and .vectors[0].components == 3'
  expect_json $end.json '.vectors[0].bounds == [0, 1, 0, 1, 0, 1] and .vectors[0].periodic == false'
done
done_with "synth writes volumes that info describes"

try info --json synth:abc
cp out synth.json
expect_json synth.json '.vectors[0].size == [64, 64, 64] and .vectors[0].periodic_axes == [true, true, true]'
expect_info synth:abc 'z: 0 to .*, periodic'
done_with "info tells the periods of an analytic volume"

try info --json --slice y=0.5 synth:abc
expect_code 0
cp out cut.json
expect_json cut.json '.vectors[0].size == [64, 64] and (.vectors[0].normal_share * 3 | round) == 1'
expect_json cut.json '.vectors[0].axes == ["x", "z"]'
try info --slice x=0.5 abc.vti
expect_code 0
grep -q '^  y: 0 to 1$' out && grep -q '^  z: 0 to 1$' out || fault "$(cat out)"
try info --vars u,v,w abc.nc
expect_code 0
grep -q '^vectors: u,v,w$' out || fault "$(cat out)"
try info --slice y=7 synth:vortex
expect_code 1
expect_error 'a cut through a field in 2 dimensions'
done_with "info tells what a cut has"

for end in vti nc; do
  try run abc.$end -o run-$end --nodes 17 --clusters 8 --width 60 --quiet
  expect_code 0
  expect_json run-$end/run.json '.field.size == [17, 17, 17] and .mesh.cells == [16, 16, 16]'
done
done_with "a volume of either format is run"

try run abc.vti -o skins --nodes 17 --clusters 8 --surfaces --width 60 --quiet
expect_code 0
cmp -s skins/scale-00.geojson run-vti/scale-00.geojson || fault "other icons with surfaces"
[ "$(wc -c <skins/scale-00.glb)" -gt "$(wc -c <run-vti/scale-00.glb)" ] || fault "no surfaces in the .glb"
for end in vtp glb; do
  try draw skins -o again.$end --scale-index 0 --surfaces
  expect_code 0
  expect_file again.$end
  try draw skins -o plain.$end --scale-index 0
  expect_code 0
  [ "$(wc -c <again.$end)" -gt "$(wc -c <plain.$end)" ] || fault "draw: no surfaces in the .$end"
done
done_with "surfaces of clusters in solids, drawn again"

{
  printf '# vtk DataFile Version 3.0\nsmall\nASCII\nDATASET RECTILINEAR_GRID\n'
  printf 'DIMENSIONS 4 3 5\nX_COORDINATES 4 float\n0 1 2 4\nY_COORDINATES 3 float\n0 2 3\n'
  printf 'Z_COORDINATES 5 double\n1 2 3 4 5\nPOINT_DATA 60\nVECTORS wind float\n'
  for ((n = 0; n < 60; ++n)); do echo "1 $((n % 7)) -2"; done
} >grid.vtk
expect_info grid.vtk 'vectors: wind' 'grid: 4 x 3 x 5' 'x: 0 to 4'
done_with "info describes a legacy file"

head -c 400 grid.vtk >short.vtk
try run short.vtk -o out-short
expect_code 1
expect_one_complaint
expect_error '^flowgrain: short.vtk: array "wind" is cut short'
expect_nothing_at out-short
sed 's/RECTILINEAR_GRID/POLYDATA/' grid.vtk >cells.vtk
try run cells.vtk -o out-cells
expect_code 1
expect_one_complaint
expect_error 'X_COORDINATES'
expect_nothing_at out-cells
done_with "a short file and one of a wrong kind are refused in a line and a hint"

# Hexahedra in two rows, one thick along x: a plane of y and z, where the flow is linear.
{
  printf '# vtk DataFile Version 3.0\nsmall\nASCII\nDATASET UNSTRUCTURED_GRID\n'
  printf 'POINTS 18 float\n'
  for x in 2 3; do
    for z in 0 1 3; do echo "$x 0 $z $x 2 $z $x 5 $z"; done
  done
  printf 'CELLS 4 36\n'
  for n in 0 1 3 4; do
    echo "8 $n $((n + 1)) $((n + 4)) $((n + 3)) $((n + 9)) $((n + 10)) $((n + 13)) $((n + 12))"
  done
  printf 'CELL_TYPES 4\n12 12 12 12\nPOINT_DATA 18\nVECTORS flow float\n'
  for x in 2 3; do
    for z in 0 1 3; do
      for y in 0 2 5; do echo "9 $((1 + z)) $((y - 2 * z))"; done
    done
  done
} >cells.vtk
expect_info cells.vtk 'interpolated from 4 cells' 'y: 0 to 5' 'z: 0 to 3' 'missing: 0.0 %'
try info --json cells.vtk
cp out cells.json
expect_json cells.json '.vectors[0].cells == 4 and .vectors[0].bounds == [0, 5, 0, 3]'
try run cells.vtk -o run-cells --nodes 33 --clusters 8 --quiet
expect_code 0
expect_file run-cells/scale-00.svg
sed 's/^12 12 12 12/12 12 12 25/' cells.vtk >curved.vtk
try info curved.vtk
expect_code 1
expect_one_complaint
expect_error 'cell 3 is a quadratic hexahedron'
done_with "cells that are not along the axes are interpolated, or refused by their kind"

# The first grid as a curvilinear one, whose lines are along the axes after all.
{
  printf '# vtk DataFile Version 3.0\nsmall\nASCII\nDATASET STRUCTURED_GRID\n'
  printf 'DIMENSIONS 4 3 5\nPOINTS 60 float\n'
  for z in 1 2 3 4 5; do
    for y in 0 2 3; do
      for x in 0 1 2 4; do echo "$x $y $z"; done
    done
  done
  sed -n '/POINT_DATA/,$p' grid.vtk
} >lines.vtk
for file in grid lines; do
  try info $file.vtk
  expect_code 0
  sed 1d out >$file.info
  try run $file.vtk -o run-$file --nodes 17 --clusters 4 --width 60 --quiet
  expect_code 0
done
cmp -s grid.info lines.info || fault "$(diff grid.info lines.info)"
cmp -s run-grid/scale-00.geojson run-lines/scale-00.geojson || fault "other arrows"
done_with "a curvilinear grid along the axes is a rectilinear one"

finish
