#!/usr/bin/env bash
# Volumes: written, described, read from files of each format.
source "$(dirname "$0")/harness.sh"

for end in vti nc; do
  try synth abc -o abc.$end --nodes 17
  expect_code 0
  try info abc.$end
  expect_code 0
  grep -q 'grid: 17 x 17 x 17' out || fault "$(cat out)"
  grep -q 'z: 0 to 1' out || fault "$(cat out)"
  try info --json abc.$end
  cp out $end.json
  expect_json $end.json '.vectors[0].size == [17, 17, 17] and .vectors[0].components == 3'
  expect_json $end.json '.vectors[0].bounds == [0, 1, 0, 1, 0, 1] and .vectors[0].periodic == false'
done
done_with "synth writes volumes that info describes"

try info --json synth:abc
cp out synth.json
expect_json synth.json '.vectors[0].size == [64, 64, 64] and .vectors[0].periodic_axes == [true, true, true]'
try info synth:abc
grep -q 'z: 0 to .*, periodic' out || fault "$(cat out)"
done_with "info tells the periods of an analytic volume"

for end in vti nc; do
  try run abc.$end -o run-$end --nodes 33 --clusters 20 --quiet
  expect_code 0
  expect_json run-$end/run.json '.field.size == [17, 17, 17] and .mesh.cells == [32, 32, 32]'
done
done_with "a volume of either format is run"

{
  printf '# vtk DataFile Version 3.0\nsmall\nASCII\nDATASET RECTILINEAR_GRID\n'
  printf 'DIMENSIONS 4 3 5\nX_COORDINATES 4 float\n0 1 2 4\nY_COORDINATES 3 float\n0 2 3\n'
  printf 'Z_COORDINATES 5 double\n1 2 3 4 5\nPOINT_DATA 60\nVECTORS wind float\n'
  for ((n = 0; n < 60; ++n)); do echo "1 $((n % 7)) -2"; done
} >grid.vtk
try info grid.vtk
expect_code 0
grep -q 'vectors: wind' out || fault "$(cat out)"
grep -q 'grid: 4 x 3 x 5' out || fault "$(cat out)"
grep -q 'x: 0 to 4' out || fault "$(cat out)"
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
expect_error 'POLYDATA'
expect_error 'esample'
expect_nothing_at out-cells
done_with "a short file and one of surfaces are refused in a line and a hint"

finish
