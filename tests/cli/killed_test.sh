#!/usr/bin/env bash
# A run that is killed, at whatever moment, goes on to the results of one that was not.
source "$(dirname "$0")/harness.sh"

run=(run synth:vortex3 --nodes 33 --clusters 20,8 --formats svg --no-page --quiet --threads 1 --checkpoint 0)
try "${run[@]}" -o whole
expect_code 0
expect_only_results whole
with_calls kill 0 "${run[@]}" -o counted
expect_code 0
expect_same_results whole counted
all=$(cat calls)
[ "$all" -gt 250 ] || fault "only $all calls"
done_with "a run with a checkpoint after every step is one without"

# killed_at CALL: a new run is killed at this call, and then goes on.
killed_at() {
  rm -rf part
  with_calls kill "$1" "${run[@]}" -o part
  [ "$code" = 137 ] || fault "call $1: not killed: code $code"
  try "${run[@]}" -o part --resume
  [ "$code" = 0 ] || fault "call $1: resumed: code $code: $(head -c 300 err)"
  expect_same_results whole part
  expect_only_results part
}

# two checkpoints take less than 32 calls
for at in {1..36}; do
  killed_at "$at"
done
done_with "killed at each of its first calls"
for at in $(seq 50 71 $((all - 50))); do
  killed_at "$at"
done
done_with "killed on the way"

# the end is the same from a late checkpoint on
rm -rf late
with_calls kill $((all - 45)) "${run[@]}" -o late
cp -r late part
with_calls kill 0 "${run[@]}" -o part --resume
rest=$(cat calls)
for at in $(seq "$rest"); do
  rm -rf part
  cp -r late part
  with_calls kill "$at" "${run[@]}" -o part --resume
  [ "$code" = 137 ] || fault "call $at: not killed: code $code"
  try "${run[@]}" -o part --resume
  [ "$code" = 0 ] || fault "call $at: resumed: code $code: $(head -c 300 err)"
  expect_same_results whole part
  expect_only_results part
done
done_with "killed at each call of its end"

rm -rf part
code=137
kills=0
while [ "$code" = 137 ] && [ "$kills" -lt 200 ]; do
  with_calls kill $((25 + kills % 41)) "${run[@]}" -o part --resume
  kills=$((kills + 1))
done
expect_code 0
[ "$kills" -gt 10 ] || fault "killed only $kills times"
expect_same_results whole part
expect_only_results part
done_with "killed again and again"

# placed arrows go on from the file of the scale before, which each scale writes again
run=(run synth:vortex3 --nodes 33 --arrows 6,3 --effort 0 --formats svg --quiet --threads 1 --checkpoint 0)
try "${run[@]}" -o placed
expect_code 0
with_calls kill 0 "${run[@]}" -o placed-counted
all=$(cat calls)
for at in $(seq $((all - 70)) 6 "$all"); do
  rm -rf part
  with_calls kill "$at" "${run[@]}" -o part
  [ "$code" = 137 ] || fault "call $at: not killed: code $code"
  try "${run[@]}" -o part --resume
  [ "$code" = 0 ] || fault "call $at: resumed: code $code: $(head -c 300 err)"
  expect_same_results placed part
  expect_only_results part
done
done_with "placed arrows go on to the same"

run=(run synth:vortex3 --nodes 193 --clusters 60,12 --formats svg --no-page --quiet --checkpoint 0.05)
try "${run[@]}" -o whole2
expect_code 0
for turn in 1 2; do
  rm -rf part
  "$program" "${run[@]}" -o part >out 2>err &
  pid=$!
  sleep "0.$((RANDOM % 60 + 10))"
  kill -KILL "$pid" 2>/dev/null
  wait "$pid" 2>/dev/null
  try "${run[@]}" -o part --resume
  [ "$code" = 0 ] || fault "turn $turn: code $code: $(head -c 300 err)"
  expect_same_results whole2 part
  expect_only_results part
done
done_with "killed at random moments, with threads"
finish
