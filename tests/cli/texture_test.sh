#!/usr/bin/env bash
# texture: pictures of every kind and format, and what is refused.
source "$(dirname "$0")/harness.sh"

# The width and height in a PNG's header.
png_size() {
  od -An -tu1 -j16 -N8 "$1" | awk '{print $1 * 16777216 + $2 * 65536 + $3 * 256 + $4,
    $5 * 16777216 + $6 * 65536 + $7 * 256 + $8}'
}

for kind in lic spots clusters stripes diffusion; do
  try texture synth:benard -o $kind.png --kind $kind --pixels 100
  expect_code 0
  [ "$(png_size $kind.png)" = "100 100" ] || fault "size $(png_size $kind.png)"
  try texture synth:benard -o again.png --kind $kind --pixels 100 --threads 1 --seed 1
  expect_code 0
  cmp -s $kind.png again.png || fault "another picture on one thread"
  try texture synth:benard -o again.png --kind $kind --pixels 100 --seed 2
  expect_code 0
  cmp -s $kind.png again.png && fault "the same picture with another seed"
  done_with "texture: $kind"
done

# a scale's moment by its clusters, and by the time that run.json has for it
try run synth:benard -o timed --nodes 101 --clusters 20 --formats svg --quiet
expect_code 0
moment=$(sed -n '/"scales"/,$s/^.*"time":[[:space:]]*\([0-9.e-]*\).*$/\1/p' timed/run.json | head -n 1)
try texture synth:benard -o counted.png --kind clusters --pixels 100 --nodes 101 --clusters 20
expect_code 0
try texture synth:benard -o timed.png --kind clusters --pixels 100 --nodes 101 --max-time "$moment"
expect_code 0
cmp -s counted.png timed.png || fault "other clusters at t = $moment"
try texture synth:benard -o early.png --kind clusters --pixels 100 --nodes 101 --max-time 1e-3
expect_code 0
cmp -s early.png timed.png && fault "the same clusters at t = 1e-3 and $moment"
done_with "texture: clusters at a time"

try texture "$root/data/gfs_20140131.nc" -o wind.png --projection none --pixels 300 --palette deep
expect_code 0
[ "$(png_size wind.png)" = "300 150" ] || fault "size $(png_size wind.png)"
done_with "texture: the domain's shape"

# of pixels, width and pixels an inch two tell the third
try texture synth:benard -o wide.png --width 17cm --dpi 60
expect_code 0
[ "$(png_size wide.png)" = "402 402" ] || fault "17 cm at 60 dpi: $(png_size wide.png)"
try texture "$root/data/gfs_20140131.nc" -o wide.svg --projection none --pixels 150 --dpi 75
expect_code 0
grep -q 'width="144[^0-9]' wide.svg || fault "$(grep -m1 '<svg' wide.svg)"
try texture synth:benard -o none.png --width 17cm --dpi 60 --pixels 500
expect_code 2
expect_error '^flowgrain: --pixels: not with both --width and --dpi, from which they follow$'
expect_nothing_at none.png
try texture synth:benard -o none.png --width 200in --dpi 2400
expect_code 1
expect_error 'texture: 480000 x 480000 pixels, 1 to 16384 are possible'
expect_nothing_at none.png
done_with "texture: pixels an inch"

try texture "$root/data/gfs_20140131.nc" -o key.png --pixels 300 --palette deep --key
expect_code 0
[ "$(png_size key.png)" != "300 150" ] || fault "no key"
try texture "$root/data/gfs_20140131.nc" -o key.svg --pixels 300 --palette deep --key
expect_code 0
xmllint --noout key.svg 2>/dev/null || fault "no XML"
done_with "texture: a colour key"
try texture "$root/data/gfs_20140131.nc" -o key.svg --pixels 300 --palette deep --key --title 'Wind: {names}' \
  --label 'knots' --speed-range 2,12 --width 89mm --font-size 6
expect_code 0
for words in 'Wind: u10, v10' '>knots<' 'width="252' '>12<'; do
  grep -q -- "$words" key.svg || fault "no $words in the picture"
done
for wrong in '--speed-range 2,12' '--label knots' '--palette gale --label knots' '--palette #aabbcc --speed-range 2,12'; do
  # shellcheck disable=SC2086
  try texture synth:saddle -o wrong.png --pixels 50 $wrong
  expect_code 2
  expect_nothing_at wrong.png
done
done_with "texture: title and words of the key"
try texture synth:saddle -o page.pdf --pixels 100 --fade 0.5 --length 30
expect_code 0
[ "$(head -c 5 page.pdf)" = %PDF- ] || fault "no PDF"
try texture synth:saddle -o page.svg --pixels 100 --transparent
expect_code 0
grep -q 'width="50pt"' page.svg || fault "$(grep -m1 '<svg' page.svg)"
done_with "texture: PDF and SVG"

for kind in spots clusters; do
  try run synth:saddle -o "run-$kind" --nodes 65 --clusters 12 --width 200 --formats svg --background "$kind" --quiet
  expect_code 0
  [ "$(grep -c '<image' "run-$kind/scale-00.svg")" = 1 ] || fault "no image in the picture"
done
cmp -s run-spots/scale-00.geojson run-clusters/scale-00.geojson || fault "other icons"
done_with "run: a texture behind the icons"
try draw run-spots -o plain.svg
expect_code 0
grep -q '<image' plain.svg && fault "a background that was not asked for"
try draw run-spots -o stripes.svg --background stripes --width 200
expect_code 0
grep -q '<image' stripes.svg || fault "no image in the picture"
done_with "draw: a texture behind the icons"

# The arrows have one dark colour, or the one that is asked for; the key runs from 0.
try draw run-spots -o speed.svg --background speed
expect_code 0
[ "$(grep -c '<image' speed.svg)" = 1 ] || fault "no image in the picture"
grep -q '>speed<' speed.svg && grep -q '>0<\|>0.0<' speed.svg || fault "$(grep -o '>[^<]*<' speed.svg | sort -u | tr '\n' ' ')"
[ "$(grep -c "fill:rgb(7.843137%,12.54902%,22.745098%)" speed.svg)" = 12 ] || fault "other colours of arrows"
try draw run-spots -o red.svg --background speed --palette '#800000'
expect_code 0
[ "$(grep -c "fill:rgb(50.196078%,0%,0%)" red.svg)" = 12 ] || fault "no red arrows"
cmp -s <(grep '<image' speed.svg) <(grep '<image' red.svg) || fault "another background"
try texture synth:saddle -o speed.png --kind speed --pixels 100 --key
expect_code 0
done_with "a background of speeds"

# The density that a run has saved is what it drew itself.
try run synth:saddle -o saved --nodes 65 --clusters 12 --formats png --background clusters --tint --save-field --quiet
expect_code 0
try draw saved -o again.png --background clusters --tint
expect_code 0
cmp -s saved/scale-00.png again.png || fault "draw: another picture than the run's"
for option in "--background clusters" --tint; do
  # shellcheck disable=SC2086
  try draw run-spots -o clusters.svg $option
  expect_code 1
  expect_one_complaint
  expect_error "which was not saved"
  expect_nothing_at clusters.svg
done
echo junk >saved/scale-00.vti
try draw saved -o again.svg --tint
expect_code 1
expect_one_complaint
expect_nothing_at again.svg
done_with "draw: the clusters of a run that has saved them"

for bad in "--key" "--palette #102030 --key" "--kind clusters --length 30" "--kind spots --clusters 20" "--nodes 65" \
  "--kind stripes --max-time 1" "--energy flow" "--anisotropy 0.3" "--coverage 0.5" "--gamma 1e-3" "--noise 0.1" \
  "--kind clusters --energy isotropic --anisotropy 0.3" "--kind plaid" "--kind" "--pixels 3" "--pixels 99999" "--length 1" "--clusters 30,10" "--fade 2" \
  "--seed 0" "--palette nope" "--max-steps 3" "--energy ./tensors.vtk"; do
  # shellcheck disable=SC2086
  try texture synth:benard -o bad.png $bad
  expect_code 2
  expect_one_complaint
  expect_nothing_at bad.png
  done_with "texture: $bad is wrong usage"
done
try texture synth:benard -o bad.gif
expect_code 2
expect_one_complaint
try texture synth:benard
expect_code 2
expect_one_complaint
done_with "texture: no or an unknown picture"

try texture no-such-file.nc -o bad.png
expect_code 1
expect_one_complaint
try texture synth:abc -o bad.png
expect_code 1
expect_one_complaint
expect_error 'synth:abc: .*3 dimensions'
echo junk >junk.nc
try texture junk.nc -o bad.png
expect_code 1
expect_one_complaint
try texture synth:benard -o no-such-folder/bad.png
expect_code 1
expect_one_complaint
expect_nothing_at bad.png
done_with "texture: input and output that can not be"
finish
