#!/usr/bin/env bash
# The results' folder: what is refused, what is replaced, what is never touched.
source "$(dirname "$0")/harness.sh"

quick=(--nodes 65 --clusters 12 --quiet)

try run synth:vortex -o a/b/c "${quick[@]}"
expect_code 0
expect_file a/b/c/run.json
done_with "parents of the folder are made"

before=$(cat a/b/c/* | cksum)
try run synth:vortex -o a/b/c "${quick[@]}" --seed 3
expect_code 1
expect_one_complaint
expect_error 'holds the results of a run'
expect_error -- '--force'
[ "$(cat a/b/c/* | cksum)" = "$before" ] || fault "its files have changed"
done_with "a finished run is not replaced"

echo mine >a/b/c/notes.txt
echo mine >a/b/c/scale-notes.svg
echo old >a/b/c/scale-07.svg
try run synth:vortex -o a/b/c "${quick[@]}" --seed 3 --force
expect_code 0
[ "$(cat a/b/c/notes.txt a/b/c/scale-notes.svg)" = "mine
mine" ] || fault "foreign files have changed"
expect_nothing_at a/b/c/scale-07.svg
expect_json a/b/c/run.json '.parameters.seed == 3'
done_with "--force replaces our files and no others"

before=$(cat a/b/c/* | cksum)
try run no-such.nc -o a/b/c --force
expect_code 1
[ "$(cat a/b/c/* | cksum)" = "$before" ] || fault "its files have changed"
done_with "a forced run that fails leaves the old results"

echo text >plain
try run synth:vortex -o plain "${quick[@]}"
expect_code 1
expect_one_complaint
expect_error 'plain.*file'
[ "$(cat plain)" = text ] || fault "it was overwritten"
done_with "a file is no folder"
try run synth:vortex -o plain/sub "${quick[@]}"
expect_code 1
expect_one_complaint
done_with "nor is a folder inside a file"

# root may write anywhere but below /proc
try run synth:vortex -o /proc/flowgrain-test "${quick[@]}"
expect_code 1
expect_one_complaint
done_with "a folder that cannot be made"

# a limit on the size of files makes writes fail as a full disk does
(
  trap '' XFSZ
  ulimit -f 4
  try run synth:vortex -o full/run "${quick[@]}"
  echo "$code" >code
)
code=$(cat code)
expect_code 1
expect_one_complaint
expect_nothing_at full
done_with "a write that fails leaves nothing"

printf 'CDF\001 rubbish' >broken.nc
for input in no-such.nc broken.nc plain . /dev/null; do
  try run "$input" -o x
  expect_code 1
  expect_one_complaint
  expect_error "$input"
  expect_nothing_at x
  done_with "unreadable input: $input"
done

finish
