#!/usr/bin/env bash
# What `flowgrain rival` writes, and what it refuses.
source "$(dirname "$0")/harness.sh"

for method in hedgehog grid-curved discrete top-down streamlines voronoi k-means farthest random; do
  try rival synth:vortex3 -o $method.geojson --method $method --icons 25 --width 200
  expect_code 0
  [ ! -s err ] || fault "standard error: $(head -c 200 err)"
  expect_json $method.geojson '(.features | length) as $n | $n >= 24 and $n <= 26'
  expect_json $method.geojson '[.features[].properties | .speed > 0 and .width > 0 and .area > 0 and (.center | length) == 2 and (.kind | length) > 0 and .cluster > 0] | all'
  expect_json $method.geojson '[.features[].geometry.coordinates[][] | . >= 0 and . <= 1] | all'
  xmllint --noout $method.svg 2>fault.txt || fault "$(head -1 fault.txt)"
  expect_file $method.png
  [ "$(ls -A | grep -c "$method")" = 3 ] || fault "$(ls -A)"
  try rival synth:vortex3 -o again.geojson --method $method --icons 25 --formats pdf
  expect_code 0
  cmp -s $method.geojson again.geojson || fault "two runs differ"
  expect_file again.pdf
  expect_nothing_at again.svg
  rm -f again.*
  done_with "rival: $method"
done

for method in voronoi k-means farthest random; do
  try rival "$root/data/gfs_20140131.nc" -o exact.geojson --method $method --icons 19,7 --formats svg
  expect_code 0
  expect_json exact-19.geojson '.features | length == 19'
  expect_json exact-7.geojson '.features | length == 7'
  done_with "rival: exactly so many arrows of $method, round the Earth"
done

for method in hedgehog grid-curved voronoi k-means random; do
  for length in 0.5 1; do
    try rival synth:vortex3 -o long-$length.geojson --method $method --icons 25 --length $length --formats svg
    expect_code 0
  done
  # a fair share of the unit square is a fifth of its side
  expect_json long-0.5.geojson '[.features[].geometry.coordinates | [., .[1:]] | transpose[:-1] | map((.[0][0] - .[1][0]) * (.[0][0] - .[1][0]) + (.[0][1] - .[1][1]) * (.[0][1] - .[1][1]) | sqrt) | add] | max * 10 | . > 0.99 and . < 1.01'
  cmp -s long-0.5.geojson long-1.geojson && fault "the length changes nothing"
  done_with "rival: lengths of $method"
done

try rival "$root/data/gfs_20140131.nc" -o many.geojson --icons 100,25 --formats svg
expect_code 0
[ "$(ls many* | tr '\n' ' ')" = "many-100.geojson many-100.svg many-25.geojson many-25.svg " ] ||
  fault "$(ls)"
[ "$(wc -l <out)" = 2 ] || fault "not a line a picture: $(cat out)"
while read -r line; do
  expect_file "${line##* }"
done <out
done_with "rival: several counts from one call"

try rival synth:vortex3 -o parts.geojson --method discrete --icons 40,10 --tint --save-field --formats svg --nodes 65
expect_code 0
expect_file parts-10.vti
grep -q cluster parts-10.vti || fault "no labels in parts-10.vti"
expect_json parts-10.geojson '(.features | length) == 10'
expect_json parts-10.geojson '([.features[].properties.area] | add) as $sum | $sum > 0.999 and $sum < 1.001'
try rival synth:vortex3 -o other.geojson --method discrete --icons 10 --position-weight 0.5 --nodes 65 --formats svg
expect_code 0
cmp -s parts-10.geojson other.geojson && fault "the weight changes nothing"
done_with "rival: clusters behind the arrows, and in a file"

for method in hedgehog grid-curved streamlines voronoi k-means farthest random; do
  rm -f $method.*
  try rival synth:vortex3d -o $method.geojson --method $method --icons 12 --width 72
  expect_code 0
  [ ! -s err ] || fault "standard error: $(head -c 200 err)"
  expect_json $method.geojson '(.features | length) as $n | $n >= 8 and $n <= 14'
  case $method in voronoi | k-means | farthest | random)
    expect_json $method.geojson '.features | length == 12' ;;
  esac
  expect_json $method.geojson '[.features[].geometry.coordinates[] | length == 3 and (map(. >= 0 and . <= 1) | all)] | all'
  expect_json $method.geojson '[.features[].properties | .speed > 0 and .width > 0 and .volume > 0] | all'
  xmllint --noout $method.vtp 2>fault.txt || fault "$(head -1 fault.txt)"
  expect_file $method.glb
  expect_nothing_at $method.svg
  if [ $method = hedgehog ]; then
    cp $method.geojson first.geojson
    try rival synth:vortex3d -o $method.geojson --method $method --icons 12 --width 72 --view 10,70
    expect_code 0
    cmp -s $method.geojson first.geojson || fault "two runs differ"
  fi
  rm -f $method.* first.geojson
  done_with "rival: $method in 3D"
done

for method in discrete top-down; do
  try rival synth:vortex3d -o x.geojson --method $method
  expect_code 1
  expect_one_complaint
  expect_error "3 dimensions, and the method $method is made for 2"
done
for wrong in "--tint" "--view 10,20"; do
  field=synth:vortex3
  [ "$wrong" = --tint ] && field="synth:vortex3d --method discrete"
  # shellcheck disable=SC2086
  try rival $field -o x.geojson $wrong
  expect_code 2
  expect_one_complaint
done
try rival synth:vortex3d -o x.geojson --view 10,20 --view 20,30
expect_code 2
expect_one_complaint
expect_nothing_at x.geojson
done_with "rival: what 2D and 3D do not have is refused"

for wrong in "--tint" "--save-field" "--elongation 3" "--method top-down --position-weight 0" \
 "--method discrete --lengths speed" "--method discrete --length 1" "--method streamlines --length 1" "--method farthest --length 0.5" "--length -1" "--method k-means --lengths speed" \
  "--method streamlines --lengths speed" "--method discrete --elongation 0.5" "--method discrete --position-weight 2"; do
  # shellcheck disable=SC2086
  try rival synth:vortex3 -o x.geojson $wrong
  expect_code 2
  expect_one_complaint
done
done_with "rival: options that do not fit are refused"

try rival synth:vortex3 -o x.svg
expect_code 2
expect_one_complaint
try rival synth:vortex3 -o x.geojson --method telepathy
expect_code 2
expect_one_complaint
try rival synth:vortex3 -o x.geojson --icons 25,60
expect_code 2
expect_one_complaint
try rival no-such-file.nc -o x.geojson
expect_code 1
expect_one_complaint
try rival synth:vortex3 -o no-such-folder/x.geojson
expect_code 1
expect_one_complaint
expect_error '^flowgrain: no-such-folder/x.geojson: .*No such file'
printf '%s\n' x,y,u,v 0,0,1,0 40000,0,1,0 0,1,1,0 40000,1,1,0 >strip.csv
try rival strip.csv -o x.geojson --method hedgehog
expect_code 1
expect_one_complaint
expect_error '^flowgrain: strip.csv: the method hedgehog has no icon in it'
[ -z "$(ls -A | grep -E '^x|flowgrain-')" ] || fault "left: $(ls -A)"
done_with "rival: what is refused leaves nothing"
finish
