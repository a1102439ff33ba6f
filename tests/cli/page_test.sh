#!/usr/bin/env bash
# The page for browsers in a run's folder. What it does there, viewer/test/page.test.mjs asks.
source "$(dirname "$0")/harness.sh"

small=(--arrows 20,9 --nodes 65 --formats svg --quiet)

if ! "$program" --version | grep '^with ' | grep -qw viewer; then
  try run synth:saddle -o one "${small[@]}"
  expect_code 0
  [ ! -e one/index.html ] && expect_json one/run.json 'has("page") | not'
  done_with "without the viewer a run writes no page"
  finish
fi

# field PAGE: the JSON in it
field() {
  sed -n 's/.*<script type="application\/json" id="run">\(.*\)<\/script>.*/\1/p' "$1"
}

try run synth:saddle -o one "${small[@]}" --seed 3
expect_code 0
expect_json one/run.json '.page == "index.html"'
field one/index.html >page.json
expect_json page.json '.most == 60 and .fewest == 9 and .seed == 3 and .map == null'
expect_json page.json '.width == 257 and .height == 257 and (.palette | length) == 17'
expect_json page.json '.arrows | keys == ["high", "low", "rows", "x", "y"]'
jq -e --slurpfile run one/run.json '.speeds[1] - $run[0].speed_range[1] | fabs < 1e-6' page.json >/dev/null ||
  fault "other ends of the colour key: $(jq -c .speeds page.json)"
[ "$(wc -c <one/index.html)" -lt 1500000 ] || fault "$(wc -c <one/index.html) bytes"
! grep -qE '(src|href)="(https?:)?//' one/index.html || fault "the page loads something"
done_with "a run of arrows has a page that holds the field"

try run synth:saddle -o clusters --clusters 20,9 --anisotropy 0.3 --formats svg --quiet
expect_code 0
expect_json clusters/run.json '.page == "index.html"'
field clusters/index.html >page.json
expect_json page.json '.kind == "clusters" and .anisotropy == 0.3 and .coverage == 0.3 and .arrows == null'
try run synth:saddle -o energy --clusters 9 --energy isotropic --formats svg --quiet
expect_code 0
[ ! -e energy/index.html ] || fault "a page of another energy"
done_with "so has one of clusters, of the energy that the page knows"

cp one/index.html before
try run synth:saddle -o one "${small[@]}" --seed 3 --force --threads 1
expect_code 0
cmp -s one/index.html before || fault "another page"
done_with "it is the same on any number of threads"

try run synth:saddle -o one "${small[@]}" --force --no-page
expect_code 0
[ ! -e one/index.html ] || fault "the page is there"
echo mine >one/index.html
try run synth:saddle -o one "${small[@]}" --force
expect_code 1
grep -q 'one: holds index.html' err || fault "$(cat err)"
[ "$(cat one/index.html)" = mine ] || fault "a page of somebody else is gone"
done_with "--no-page leaves it out, and a page of others stays"

finish
