#!/usr/bin/env bash
# Ends before the end: signals, a full disk, limits on files and memory. One message, the
# right exit code, the last checkpoint good, and nothing else left.
source "$(dirname "$0")/harness.sh"

run=(run synth:vortex3 --nodes 129 --width 200 --quiet)
scales=(--clusters 25,12 --no-page)
try "${run[@]}" "${scales[@]}" -o whole
expect_code 0

expect_only_work() {
  [ "$(ls -A "$1")" = .flowgrain ] || fault "in $1: $(ls -A "$1")"
  local rest
  rest=$(ls -A "$1/.flowgrain" |
    grep -vE '^(scale-[0-9]{2}\.(geojson|svg|png)|evolution\.csv|run\.json|checkpoint(\.previous)?)$')
  [ -z "$rest" ] || fault "left in $1/.flowgrain: $rest"
}

# steps with a checkpoint each come before the first scale
early=(run synth:vortex3 --nodes 97 --clusters 12,8 --formats svg --no-page --quiet)
try "${early[@]}" -o whole1
expect_code 0
for signal in INT TERM HUP; do
  with_calls "$signal" 30 "${early[@]}" -o "early-$signal" --checkpoint 0
  expect_code 130
  expect_one_complaint
  expect_error 'interrupted at t = .*, before the first scale$'
  expect_error 'The same command with --resume goes on from step [1-9]'
  expect_only_work "early-$signal"
  done_with "SIG$signal before the first scale: a checkpoint"
done
try "${early[@]}" -o early-HUP --resume
expect_code 0
expect_same_results whole1 early-HUP
expect_only_results early-HUP
done_with "with which --resume goes on"

# one thread draws a scale before the evolution goes on: the interrupt comes between the two
wide=(run synth:vortex3 --nodes 193 --clusters 60,12 --width 200 --no-page --quiet)
try "${wide[@]}" -o whole2
expect_code 0
with_calls INT scale-00.png "${wide[@]}" -o stopped --checkpoint 0 --threads 1
expect_code 130
expect_one_complaint
expect_error 'interrupted at t = .* with [0-9]+ clusters; the 1 scale until then'
expect_error '--resume goes on from step'
expect_json stopped/run.json '.ended == "interrupted" and (.scales | length) >= 1'
expect_file stopped/scale-00.svg
cmp -s whole2/scale-00.geojson stopped/scale-00.geojson || fault "scale 0 differs"
before=$(cat stopped/* | cksum)
with_calls kill 60 "${wide[@]}" -o stopped --resume --checkpoint 0
[ "$code" = 137 ] || fault "not killed: code $code"
[ "$(cat stopped/* | cksum)" = "$before" ] || fault "what it had is not kept while it goes on"
try "${wide[@]}" -o stopped --resume
expect_code 0
expect_same_results whole2 stopped
expect_only_results stopped
done_with "an interrupted run writes the scales it has, and goes on from there"

plain=(run synth:vortex3 --nodes 129 --clusters 40,12 --formats svg --no-page --quiet)
try "${plain[@]}" -o whole3
expect_code 0
with_calls TERM scale-00.svg "${plain[@]}" -o never --threads 1
expect_code 130
expect_file never/.flowgrain/checkpoint
try "${plain[@]}" -o never --resume
expect_code 0
expect_same_results whole3 never
done_with "its first checkpoint may be that of the interruption"

placed=(run synth:vortex3 --nodes 129 --arrows 40,12 --effort 0 --formats svg --no-page --quiet)
try "${placed[@]}" -o whole4
expect_code 0
with_calls INT scale-00.svg "${placed[@]}" -o between --checkpoint 0 --threads 1
expect_code 130
expect_one_complaint
expect_error 'interrupted at t = .* before the scale of 12 arrows; the 1 scale until then is in between$'
expect_json between/run.json '.ended == "interrupted" and [.scales[].icons] == [40]'
try "${placed[@]}" -o between --resume
expect_code 0
expect_same_results whole4 between
expect_only_results between
done_with "an interrupted run of placed arrows says which are missing, and goes on"

# the evolution is short, the placing of so many is long
with_calls INT scale-00.svg run synth:vortex3 --nodes 65 --arrows 60,59,58,57,56,55 --formats svg --quiet -o placing
expect_code 130
expect_one_complaint
expect_json placing/run.json '.ended == "interrupted" and (.scales | length) >= 1 and (.scales | length) < 6'
expect_json placing/run.json '[.scales[].icons] == [60,59,58,57,56,55][:(.scales | length)]'
done_with "an interrupt while arrows are placed keeps the scales that are there"

if "$program" --version | grep -q '[ ,]render'; then
  with_calls INT scale-01.glb run synth:vortex3d --nodes 33 --clusters 8,4,2 --width 300 --quiet -o drawing
  expect_code 130
  expect_one_complaint
  expect_error 'interrupted at t = .* with [0-9]+ clusters; the 1 scale until then is in drawing$'
  expect_json drawing/run.json '.ended == "interrupted" and (.scales | length) == 1'
  expect_file drawing/scale-00.png
  [ -z "$(find drawing -name 'scale-0[12]*')" ] || fault "of interrupted scales: $(ls drawing)"
  with_calls TERM scale-00.glb run synth:vortex3d --nodes 33 --clusters 8 --width 300 --quiet -o first
  expect_code 130
  expect_one_complaint
  [ -z "$(find first -name 'scale-*' 2>/dev/null)" ] || fault "of an interrupted scale: $(find first)"
  env --default-signal=INT "$program" draw drawing -o large.png --width 2400 >out 2>err &
  pid=$!
  until_heeded TERM "$pid"
  kill -TERM "$pid"
  wait "$pid"
  code=$?
  expect_code 130
  expect_one_complaint
  [ -z "$(find . -maxdepth 1 -name '*large.png*')" ] || fault "left: $(find . -name '*large.png*')"
  done_with "an interrupt while pictures in 3D are drawn keeps the scales that are there"
fi

# checkpoints have 3 arrays of 129 x 129 floats and more; results are smaller
limit_kib=150
[ -z "$(find whole -size +${limit_kib}k)" ] || fault "too large: $(find whole -size +${limit_kib}k)"
(
  ulimit -f "$limit_kib"
  try "${run[@]}" "${scales[@]}" -o limited --checkpoint 0
  echo "$code" >code
)
code=$(cat code)
expect_code 0
expect_one_complaint
expect_error 'limited/.flowgrain/checkpoint: cannot be written: File too large; the run goes on without'
expect_same_results whole limited
expect_only_results limited
done_with "a checkpoint that can not be written is one warning"

with_calls kill 600 "${run[@]}" "${scales[@]}" -o kept --checkpoint 0
[ "$code" = 137 ] || fault "not killed: code $code"
step=$(grep -a -oP '^stepper.accepted \K[0-9]+' kept/.flowgrain/checkpoint)
(
  ulimit -f "$limit_kib"
  try "${run[@]}" "${scales[@]}" -o kept --checkpoint 0 --resume --max-steps $((step + 20))
  echo "$code" >code
)
code=$(cat code)
expect_code 0
expect_error "the checkpoint of step $step stays, and the run goes on"
expect_json kept/run.json ".ended == \"steps\" and .steps.accepted == $((step + 20))"
try "${run[@]}" "${scales[@]}" -o kept --resume
expect_code 0
expect_same_results whole kept
done_with "the last one stays good, and serves"

for at in 1 2 5 40 200; do
  rm -rf full
  with_calls full "$at" "${run[@]}" "${scales[@]}" -o full --checkpoint 0
  [ "$code" = 1 ] || fault "full at $at: code $code"
  tail -2 err | grep -q 'No space left on device' || fault "full at $at: $(head -c 300 err)"
  [ "$(grep -c '^flowgrain: ' err)" -le 2 ] || fault "full at $at: $(head -c 300 err)"
  [ ! -e full ] || expect_only_work full
  try "${run[@]}" "${scales[@]}" -o full --resume
  [ "$code" = 0 ] || fault "full at $at: resumed: code $code: $(head -c 300 err)"
  expect_same_results whole full
  expect_only_results full
done
done_with "on a disk that is full from some moment on, nothing is lost"

# Address space: the least in which a tiny run works is what libraries take.
least=50000
most=1000000
while [ $((most - least)) -gt 4000 ]; do
  middle=$(((least + most) / 2))
  if (ulimit -v "$middle" && "$program" run synth:vortex -o tiny --nodes 33 \
    --clusters 9 --quiet --force --threads 1) >/dev/null 2>&1; then
    most=$middle
  else
    least=$middle
  fi
done
# for the mesh, its levels, or what is made of it
for more in 0 4 16 48; do
  rm -rf small
  (
    ulimit -v $((most + 1024 * more))
    try run synth:vortex3 -o small --nodes 1025 --clusters 800 --quiet
    echo "$code" >code
  )
  code=$(cat code)
  expect_code 1
  expect_one_complaint
  expect_error 'out of memory: [0-9]+ bytes'
  expect_nothing_at small
done
done_with "out of memory: one message, and nothing is left"

(
  ulimit -v 300000
  try run synth:vortex3d --nodes 17 --clusters 3 -o solid --quiet --threads 1
  echo "$code" >code
)
code=$(cat code)
if [ "$code" != 0 ]; then
  expect_code 1
  expect_error '^flowgrain: synth:vortex3d: out of memory: '
fi
done_with "nor is there another for pictures in 3D"

with_calls kill 60 "${wide[@]}" -o tight --checkpoint 0
[ "$code" = 137 ] || fault "not killed: code $code"
for more in 4 8 12; do
  (
    ulimit -v $((most + 1024 * more))
    try "${wide[@]}" -o tight --resume
    echo "$code" >code
  )
  code=$(cat code)
  [ "$code" = 0 ] && break
  expect_code 1
  expect_one_complaint
  expect_error 'out of memory'
done
try "${wide[@]}" -o tight --resume
expect_code 0
expect_same_results whole2 tight
expect_only_results tight
done_with "out of memory when resumed: the checkpoint stays good"
finish
