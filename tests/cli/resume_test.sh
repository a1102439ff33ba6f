#!/usr/bin/env bash
# What --resume goes on from, and what it refuses.
source "$(dirname "$0")/harness.sh"

input=(run synth:vortex3)
options=(--nodes 65 --clusters 20,8 --width 100 --no-page --quiet --checkpoint 0)

# begin FOLDER ARGUMENTS...: a run that is killed a good way on, after a scale, and not
# while its last checkpoint takes the place of the one before.
begin() {
  local at
  for at in {380..384}; do
    rm -rf "$1"
    with_calls kill "$at" "${input[@]}" "${options[@]}" "${@:2}" -o "$1"
    [ "$code" = 137 ] || fault "not killed: code $code"
    [ ! -e "$1/.flowgrain/checkpoint" ] || break
  done
  expect_file "$1/.flowgrain/checkpoint"
  expect_file "$1/.flowgrain/scale-00.svg"
}
sum_of() {
  (cd "$1" && find . -type f ! -name lock ! -name '*.part' -exec cksum {} + | sort | cksum)
}

try "${input[@]}" "${options[@]}" -o whole
expect_code 0
try "${input[@]}" --nodes 65 --clusters 20,8 --width 100 --no-page -o none --resume
expect_code 0
expect_error 'none: no checkpoint: the run starts from the beginning'
expect_same_results whole none
done_with "without a checkpoint it starts from the beginning, with a note"

before=$(sum_of none)
try "${input[@]}" "${options[@]}" -o none --resume
expect_code 0
expect_error 'the run is finished'
[ "$(sum_of none)" = "$before" ] || fault "it has changed"
expect_only_results none
done_with "a finished run is left as it is"
try "${input[@]}" "${options[@]}" -o none --resume --seed 4
expect_code 1
expect_one_complaint
expect_error 'begun without --seed; this command goes with --seed 4'
try run synth:vortex "${options[@]}" -o none --resume
expect_code 1
expect_error 'results of a run on synth:vortex3'
[ "$(sum_of none)" = "$before" ] || fault "it has changed"
done_with "a finished run of another kind is refused"

begin part
before=$(sum_of part)
try "${input[@]}" "${options[@]}" -o part
expect_code 1
expect_one_complaint
expect_error 'holds a run that can go on'
expect_error '--resume'
[ "$(sum_of part)" = "$before" ] || fault "it has changed"
done_with "without --resume or --force it is not touched"

refused() {
  try "${input[@]}" "${options[@]}" -o part --resume "${@:2}"
  expect_code 1
  expect_one_complaint
  expect_error "$1"
  [ "$(sum_of part)" = "$before" ] || fault "$*: it has changed"
}
refused 'with --nodes 65; this command goes with --nodes 97' --nodes 97
refused 'with --clusters 20,8; this command goes with --clusters 20,6' --clusters 20,6
refused 'without --isotropic-below; this command goes with --isotropic-below 0.5' --isotropic-below 0.5
refused 'without --noise; this command goes with --noise 0.05' --noise 0.05
refused 'without --coverage; this command goes with --coverage 0.25' --coverage 0.25
refused 'without --energy; this command goes with --energy isotropic' --energy isotropic
refused 'without --scheme; this command goes with --scheme theta' --scheme theta
refused 'without --residual; this command goes with --residual 0.01' --residual 1e-2
refused 'without --palette' --palette '#102030'
refused 'without --tint; this command goes with --tint$' --tint
refused 'without --save-field' --save-field
refused 'without --formats; this command goes with --formats png,pdf' --formats pdf,png
done_with "other options are refused, with both values"

try run synth:vortex "${options[@]}" -o part --resume
expect_code 1
expect_one_complaint
expect_error 'another field'
[ "$(sum_of part)" = "$before" ] || fault "it has changed"
done_with "another field is refused"

try "${input[@]}" --nodes 65 --clusters 20,8 --width 100 --no-page --threads 1 --max-steps 5000 -o part --resume
expect_code 0
expect_error 'part: goes on from step [0-9]+, t = '
expect_only_results part
for name in scale-00.geojson scale-01.geojson scale-01.png; do
  cmp -s "whole/$name" "part/$name" || fault "$name differs"
done
done_with "threads, limits and seconds between checkpoints may differ"

begin part
try "${input[@]}" "${options[@]}" -o part --force --seed 3
expect_code 0
expect_json part/run.json '.parameters.seed == 3'
expect_only_results part
done_with "--force starts anew"

begin part
cp -r part/.flowgrain kept
restore() {
  rm -rf part
  mkdir part
  cp -r kept part/.flowgrain
}
size=$(stat -c %s kept/checkpoint)
[ "$size" -gt 50000 ] || fault "$size bytes"
for at in 3 50 $((size / 2)) $((size - 1)); do
  restore
  old=$(od -An -tu1 -j "$at" -N 1 kept/checkpoint)
  printf "\\$(printf %o $((255 - old)))" | dd of=part/.flowgrain/checkpoint bs=1 seek="$at" conv=notrunc 2>/dev/null
  cmp -s kept/checkpoint part/.flowgrain/checkpoint && fault "byte $at is the same"
  try "${input[@]}" "${options[@]}" -o part --resume
  [ "$code" = 0 ] || fault "byte $at: code $code"
  expect_error 'checkpoint: (damaged|is no checkpoint).*the previous checkpoint is used'
  expect_same_results whole part
done
for length in 0 63 $((size - 1)); do
  restore
  truncate -s "$length" part/.flowgrain/checkpoint
  try "${input[@]}" "${options[@]}" -o part --resume
  [ "$code" = 0 ] || fault "length $length: code $code"
  expect_error 'checkpoint: damaged.*the previous checkpoint is used'
  expect_same_results whole part
done
done_with "a damaged checkpoint is refused, and the previous one used"

# the damaged one must not take the place of the whole one, not even for a moment
for at in {6..24..3}; do
  restore
  truncate -s 3000 part/.flowgrain/checkpoint
  with_calls kill "$at" "${input[@]}" "${options[@]}" -o part --resume
  [ "$code" = 137 ] || fault "call $at: not killed: code $code"
  try "${input[@]}" "${options[@]}" -o part --resume
  [ "$code" = 0 ] || fault "call $at: code $code: $(head -c 300 err)"
  expect_same_results whole part
done
done_with "killed after that, it still goes on"

restore
truncate -s 3000 part/.flowgrain/checkpoint part/.flowgrain/checkpoint.previous
before=$(sum_of part)
try "${input[@]}" "${options[@]}" -o part --resume
expect_code 1
expect_one_complaint
expect_error 'damaged: it has 3000 bytes, not'
expect_error -- '--force'
[ "$(sum_of part)" = "$before" ] || fault "it has changed"
done_with "when both are damaged, that is an error"

restore
rm part/.flowgrain/scale-00.png
try "${input[@]}" "${options[@]}" -o part --resume
expect_code 1
expect_one_complaint
expect_error 'scale-00.png, which its checkpoint counts on, is not there'
restore
truncate -s 100 part/.flowgrain/evolution.csv
try "${input[@]}" "${options[@]}" -o part --resume
expect_code 1
expect_one_complaint
expect_error 'evolution.csv: damaged'
restore
sed -i '1s/clusters,/clusters,newton,/' part/.flowgrain/evolution.csv
try "${input[@]}" "${options[@]}" -o part --resume
expect_code 1
expect_one_complaint
expect_error 'evolution.csv: has the columns of another version'
done_with "files that a checkpoint counts on must be there"

restore
before=$(sum_of part)
[ "$(stat -c %s part/.flowgrain/evolution.csv)" -gt 1024 ] || fault "a short table"
(
  ulimit -f 1
  try "${input[@]}" "${options[@]}" -o part --resume
  echo "$code" >code
)
code=$(cat code)
expect_code 1
expect_error 'evolution.csv: cannot be written: File too large'
[ "$(sum_of part)" = "$before" ] || fault "it has changed"
done_with "no room for the rows so far is an error that says so"

"$program" synth vortex3 -o field.nc --nodes 40
input=(run field.nc)
try "${input[@]}" "${options[@]}" -o whole2
begin part
cp field.nc same.nc
try run same.nc "${options[@]}" -o part --resume
expect_code 0
expect_only_results part
cmp -s whole2/scale-01.geojson part/scale-01.geojson || fault "icons differ"
done_with "the input may have moved"
begin part
"$program" synth vortex -o field.nc --nodes 40
before=$(sum_of part)
try "${input[@]}" "${options[@]}" -o part --resume
expect_code 1
expect_one_complaint
expect_error 'another field'
[ "$(sum_of part)" = "$before" ] || fault "it has changed"
done_with "but not changed"

input=(run synth:vortex3)
try "${input[@]}" "${options[@]}" -o old --seed 9
before=$(sum_of old)
with_calls kill 380 "${input[@]}" "${options[@]}" -o old --force
[ "$code" = 137 ] || fault "not killed: code $code"
mv old/.flowgrain aside
[ "$(sum_of old)" = "$before" ] || fault "the old results have changed"
mv aside old/.flowgrain
try "${input[@]}" "${options[@]}" -o old --resume
expect_code 0
expect_same_results whole old
expect_only_results old
done_with "a run killed while it replaces old results leaves them, and goes on"

try "${input[@]}" --nodes 65 --clusters 20,8 --width 100 --no-page --quiet -o limit --max-steps 26
expect_code 0
expect_json limit/run.json '.ended == "steps" and .steps.accepted == 26'
try "${input[@]}" --nodes 65 --clusters 20,8 --width 100 --no-page --quiet -o limit --resume
expect_code 0
expect_same_results whole limit
expect_only_results limit
done_with "a run that ended at its limit goes on without it"

fine=(run synth:vortex3 --nodes 513 --clusters 60 --formats svg --no-page --quiet)
try "${fine[@]}" -o fine
expect_code 0
halved=$(jq '.mesh.coarser[0].step' fine/run.json)
for more in 0 4; do
  try "${fine[@]}" -o "fine-$more" --max-steps $((halved + more))
  expect_code 0
  expect_json "fine-$more/run.json" ".mesh.coarser | length == ($more > 0 | if . then 1 else 0 end)"
  try "${fine[@]}" -o "fine-$more" --resume
  expect_code 0
  expect_same_results fine "fine-$more"
  expect_only_results "fine-$more"
done
done_with "a run whose mesh is halved goes on, before and after"

# stretched HEIGHT: a file with a field on a domain of that height.
stretched() {
  printf '%s\n' '# vtk DataFile Version 3.0' flow ASCII 'DATASET STRUCTURED_POINTS' \
    'DIMENSIONS 3 3 1' 'ORIGIN 0 0 0' "SPACING 0.5 $1 1" 'POINT_DATA 9' 'VECTORS v float' \
    '1 0 0  1 1 0  0 1 0' '1 1 0  2 1 0  1 1 0' '0 1 0  1 1 0  1 0 0' >field.vtk
}
stretched 0.5
fine=(run field.vtk --nodes 513 --clusters 58,40 --formats svg --no-page --quiet)
try "${fine[@]}" -o stretched --max-steps 96
expect_code 0
expect_json stretched/run.json '.mesh.coarser | length == 1'
stretched 0.26 # 264 cells high: their half is no number of cells that a mesh can have
try "${fine[@]}" -o stretched --resume
expect_code 1
expect_one_complaint
expect_error 'another field'
done_with "nor where the mesh of the changed input can not be halved"

cube=(run synth:vortex3d --nodes 33 --clusters 9,5 --width 40 --no-frame --no-page --quiet --checkpoint 0)
try "${cube[@]}" -o cube
expect_code 0
for at in 100 400; do
  rm -rf part
  with_calls kill "$at" "${cube[@]}" -o part
  [ "$code" = 137 ] || fault "not killed: code $code"
  try "${cube[@]}" -o part --resume
  expect_code 0
  expect_same_results cube part
  expect_only_results part
done
done_with "a run in 3D goes on"

# of standard input the same bytes, given again, make the same field
try synth vortex3 -o field.vti --nodes 65
try run - "${options[@]}" -o read <field.vti
expect_code 0
with_calls kill 300 run - "${options[@]}" -o piped <field.vti
[ "$code" = 137 ] || fault "not killed: code $code"
expect_file piped/.flowgrain/checkpoint
sed 's/<VTKFile/<VTKFile /; s/Spacing="[0-9.]*/Spacing="0.125/' field.vti >other.vti
try run - "${options[@]}" -o piped --resume <other.vti
expect_code 1
expect_error 'belongs to a run with another field'
try run - "${options[@]}" -o piped --resume </dev/null
expect_code 1
expect_error 'standard input: is empty'
try run - "${options[@]}" -o piped --resume <field.vti
expect_code 0
expect_same_results read piped
try run synth:vortex3 "${options[@]}" -o piped --resume
expect_code 1
expect_error 'piped: holds the results of a run on standard input$'
done_with "a run of standard input goes on with the same input, and refuses another"

"$program" run synth:vortex3 -o busy --nodes 1025 --quiet --checkpoint 0 >/dev/null 2>&1 &
pid=$!
until_there busy/.flowgrain/checkpoint "$pid"
for how in --resume --force --quiet; do
  try run synth:vortex3 -o busy --nodes 1025 "$how"
  expect_code 1
  expect_one_complaint
  expect_error "busy: another run is writing to it, process $pid"
done
kill -KILL "$pid"
wait "$pid" 2>/dev/null
try run synth:vortex3 -o busy --nodes 65 --clusters 8 --quiet --force
expect_code 0
expect_only_results busy
done_with "two runs in one folder at the same time are refused"
finish
