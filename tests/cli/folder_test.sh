#!/usr/bin/env bash
# The results' folder: what is refused, what is replaced, what is never touched.
source "$(dirname "$0")/harness.sh"

quick=(--nodes 65 --clusters 12 --quiet)

try run synth:vortex -o a/b/c "${quick[@]}"
expect_code 0
expect_file a/b/c/run.json
done_with "parents of the folder are made"
try run synth:vortex -o a/b/c/run.json/d "${quick[@]}"
expect_code 1
expect_error '^flowgrain: a/b/c/run.json: is a file, a folder is needed'
done_with "a file is no folder's parent"

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
try run synth:vortex -o a/b/c "${quick[@]}" --seed 3 --force
expect_code 0
[ "$(cat a/b/c/notes.txt a/b/c/scale-notes.svg)" = "mine
mine" ] || fault "foreign files have changed"
expect_json a/b/c/run.json '.parameters.seed == 3'
done_with "--force replaces our files and no others"

# what has the name of a result may be the user's all the same
mkdir own
for name in scale-99.png evolution.csv run.json; do
  rm -rf own/*
  echo mine >own/$name
  for force in --quiet --force; do
    try run synth:vortex -o own "${quick[@]}" $force
    expect_code 1
    expect_one_complaint
    expect_error "holds $name, which no run of flowgrain"
    [ "$(ls -A own)" = $name ] || fault "it has more: $(ls -A own)"
    [ "$(cat own/$name)" = mine ] || fault "it was overwritten"
  done
done
echo mine >a/b/c/scale-77.svg
try run synth:vortex -o a/b/c "${quick[@]}" --seed 3 --force
expect_code 1
expect_error 'holds scale-77.svg'
rm a/b/c/scale-77.svg
done_with "a file that no run has made stays, --force or not"

# a picture that the program itself has drawn there is one of its own
try draw a/b/c -o a/b/c/scale-05.svg
expect_code 0
try draw a/b/c -o a/b/c/again.svg
expect_code 0
try draw a/b/c -o a/b/c/scale-00.png # one of the results, in another style
expect_code 0
expect_json a/b/c/run.json '.drawn == ["scale-05.svg"]'
try run synth:vortex -o a/b/c "${quick[@]}" --seed 4 --force
expect_code 0
[ ! -e a/b/c/scale-05.svg ] || fault "an old picture is left"
expect_file a/b/c/again.svg
expect_json a/b/c/run.json '.drawn == null'
done_with "a picture drawn into a run's folder does not keep --force from it"

try run synth:vortex -o in "${quick[@]}" --save-field
expect_code 0
mkdir other
for folder in in in/../in; do
  before=$(cat in/* | cksum)
  try run in/scale-00.vti -o $folder "${quick[@]}" --force
  expect_code 1
  expect_one_complaint
  expect_error 'scale-00.vti: is an input'
  [ "$(cat in/* | cksum)" = "$before" ] || fault "its files have changed"
done
printf 'P6 2 2 255\n123456789012' >photo.png
ln -s photo.png alias.png
for out in photo.png ./photo.png alias.png; do
  try brush photo.png -o $out
  expect_code 1
  expect_one_complaint
  expect_error 'is an input'
  try texture photo.png -o $out
  expect_error 'is an input'
  try draw in --input photo.png -o $out
  expect_error 'is an input'
done
[ "$(head -c 2 photo.png)" = P6 ] || fault "the image was overwritten"
try synth saddle -o field.vti --nodes 17
cp field.vti field.geojson
before=$(cksum field.geojson field.vti)
try rival field.geojson -o field.geojson --method hedgehog
expect_code 1
expect_error 'field.geojson: is an input'
try rival field.vti -o field.geojson --method discrete --save-field --icons 5
expect_code 1
expect_error 'field.vti: is an input'
[ "$(cksum field.geojson field.vti)" = "$before" ] || fault "the field was overwritten"
done_with "no command writes over its input"

# never: folder or lock lead nowhere, or to what is none
never() {
  timeout 20 "$program" run synth:vortex -o "$1" "${quick[@]}" >out 2>err
  code=$?
  expect_code 1
  expect_one_complaint
  expect_error "$2"
}
ln -s nowhere dangling
mkdir d1 d2 d3 d4
ln -s nowhere d1/.flowgrain
mkdir d2/.flowgrain
ln -s /nowhere/at/all d2/.flowgrain/lock
mkfifo d3/run.json
mkdir d4/.flowgrain
mkfifo d4/.flowgrain/lock
never dangling 'dangling: is a symbolic link'
never dangling/ 'dangling: is a symbolic link'
never dangling/sub 'dangling: is a symbolic link'
never d1 'd1/.flowgrain: is no folder'
never d2 'd2/.flowgrain/lock: is no file'
never d3 'holds run.json, which no run'
never d4 'd4/.flowgrain/lock: is no file'
[ "$(ls -A d1 d2 d3)" = "$(printf 'd1:\n.flowgrain\n\nd2:\n.flowgrain\n\nd3:\nrun.json')" ] ||
  fault "more than before: $(ls -A d1 d2 d3)"
timeout 20 "$program" draw d3 -o x.svg >out 2>err
code=$?
expect_code 1
expect_one_complaint
mkdir real
ln -s real alias
try run synth:vortex -o alias "${quick[@]}"
expect_code 0
expect_file real/run.json
done_with "links that lead nowhere and pipes end in a complaint"

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

# choice, field and the number of levels are asked for
cp "$root/tests/fuzz/corpus/netcdf/seed-members4.nc" members.nc
with_calls none 0 run members.nc -o once --nodes 65 --clusters 3 --level 1
expect_code 0
expect_error 'members.nc: level 1 of 0 to 1'
[ "$(cat forks)" = 1 ] || fault "$(cat forks) processes have read it"
done_with "one child process reads a file of HDF5"

# the size of an object in the heap of strings: HDF5 1.10 stays at one of no bytes for ever
cp "$root/tests/fuzz/corpus/netcdf/seed-netcdf4.nc" endless.nc
printf '\0' | dd of=endless.nc bs=1 seek=5347 conv=notrunc 2>dd.err
try run endless.nc -o x
expect_code 1
expect_one_complaint
expect_error '^flowgrain: endless.nc: (damaged: reading it takes more than 1 s$|.*a damaged one)'
expect_nothing_at x
done_with "a small file that takes for ever is given up after a second"

finish
