#!/usr/bin/env bash
# --features: critical points in GeoJSON, run.json and pictures.
source "$(dirname "$0")/harness.sh"

small=(--nodes 65 --no-page --quiet --formats svg --width 200)
quick=("${small[@]}" --effort 0)
# points FILE: a word for each critical point of a file of icons, sorted.
points() {
  jq -r '.features[] | select(.geometry.type == "Point") | .properties |
    [.kind, .index, .sense // "-", .flow // "-"] | join(",")' "$1" | sort | xargs
}
three='centre,1,anticlockwise,- centre,1,anticlockwise,- centre,1,clockwise,- saddle,-1,-,-'

try run synth:vortex3 -o run "${quick[@]}" --arrows 60,12 --features
expect_code 0
for file in run/scale-00.geojson run/scale-01.geojson; do
  [ "$(points $file)" = "$three" ] || fault "$file: $(points $file)"
done
expect_json run/run.json '[.scales[].features] == ({saddle: 1, centre: 3, spiral: 0, source: 0, sink: 0} | [., .])'
expect_json run/scale-00.geojson '[.features[] | select(.geometry.type == "LineString")] | length == 60'
for word in saddle centre; do
  grep -q ">$word</text>" run/scale-01.svg || fault "the key lacks $word"
done
! grep -q ">sink</text>" run/scale-01.svg || fault "the key names a sink"
done_with "points of each scale, their numbers and a key of the kinds that occur"

try run synth:vortex3 -o plain "${quick[@]}" --arrows 60,12
expect_code 0
expect_json plain/run.json '[.scales[].features] == [null, null]'
jq 'del(.features[] | select(.geometry.type == "Point"))' run/scale-00.geojson >without.geojson
jq . plain/scale-00.geojson | cmp -s - without.geojson || fault "the arrows differ"
for folder in run plain; do
  try draw $folder -o $folder.svg --arrows 12 --width 200 --features
  expect_code 0
done
cmp -s run.svg plain.svg || fault "drawn pictures differ"
cmp -s run.svg run/scale-01.svg || fault "a drawn picture differs from that of the run"
try draw run -o bare.svg --arrows 12 --width 200
cmp -s bare.svg plain/scale-01.svg || fault "drawn without --features, and yet with signs"
try score synth:vortex3 run/scale-00.geojson plain/scale-00.geojson --json
expect_code 0
expect_json out '(.[0] | del(.file)) == (.[1] | del(.file))'
done_with "arrows are as without; draw adds them to any run, and score passes over them"

try run synth:vortex3 -o clusters "${small[@]}" --clusters 20 --features
expect_code 0
[ "$(points clusters/scale-00.geojson)" = "$three" ] || fault "$(points clusters/scale-00.geojson)"
done_with "at the scale of clusters"

# Beyond a pole a map has the vortex upside down; it turns there as elsewhere.
{
  echo lon,lat,u,v
  for y in $(seq 30 45); do
    for x in $(seq 0 2 40); do echo "$x,$y,$((38 - y)),$((x - 18))"; done
  done
} >vortex.csv
for projection in none '+proj=laea +lon_0=20 +lat_0=38' '+proj=laea +lon_0=-160 +lat_0=70'; do
  try run vortex.csv -o map "${quick[@]}" --arrows 12 --features --projection "$projection" --force
  expect_code 0
  expect_json map/scale-00.geojson '[.features[] | select(.geometry.type == "Point")] | length == 1 and
    (.[0] | .properties.sense == "anticlockwise" and (.geometry.coordinates | (.[0] - 18 | fabs) < 0.3 and (.[1] - 38 | fabs) < 0.3))'
done
done_with "the sense is that of the picture, the place that on the globe"

try run synth:abc -o space --features --arrows 9 --nodes 17 --quiet
expect_code 2
expect_one_complaint
expect_error '^flowgrain: --features: only in 2D, and synth:abc is in 3D$'
expect_nothing_at space
done_with "only in 2D"

for at in {380..384}; do
  rm -rf part
  with_calls kill "$at" run synth:vortex3 -o part "${small[@]}" --clusters 20,8 --checkpoint 0 --features
  [ ! -e part/.flowgrain/checkpoint ] || break
done
expect_file part/.flowgrain/scale-00.svg
try run synth:vortex3 -o part "${small[@]}" --clusters 20,8 --checkpoint 0 --features --resume
expect_code 0
try run synth:vortex3 -o whole "${small[@]}" --clusters 20,8 --checkpoint 0 --features
expect_same_results part whole
cmp -s <(jq '[.scales[].features]' part/run.json) <(jq '[.scales[].features]' whole/run.json) || fault "other numbers"
done_with "a resumed run has them, too"
finish
