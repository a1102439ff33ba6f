#!/usr/bin/env bash
# What `flowgrain score` prints, and what it refuses.
source "$(dirname "$0")/harness.sh"

for method in hedgehog grid-curved; do
  try rival synth:vortex3 -o $method.geojson --method $method --icons 49 --formats svg
done
try score synth:vortex3 hedgehog.geojson grid-curved.geojson
expect_code 0
[ ! -s err ] || fault "standard error: $(head -c 200 err)"
[ "$(grep -c geojson out)" = 2 ] || fault "not a row a file: $(cat out)"
[ "$(awk '/geojson/ {print $1, $NF}' out | tr '\n' ' ')" = "49 hedgehog.geojson 49 grid-curved.geojson " ] ||
  fault "$(cat out)"
# a curved arrow tells more than a straight one, to every reader
awk 'NR == 2 {for (k = 2; k <= 7; k++) a[k] = $k}
  NR == 3 {for (k = 2; k <= 7; k++) if (!($k < a[k])) exit 1}' out || fault "$(cat out)"
done_with "score: a row a file"
grep -q '^--class arrows: longer lines count for their middle' out || fault "$(cat out)"
try score synth:vortex3 hedgehog.geojson --class free
grep -q '^--class free: lines count as long as they are' out || fault "$(cat out)"
done_with "score: the table says of which class it is"

try score synth:vortex3 hedgehog.geojson grid-curved.geojson --json
expect_code 0
expect_json out 'length == 2 and .[1].file == "grid-curved.geojson" and .[0].icons == 49'
expect_json out '.[0] | keys == ["advection", "clutter", "count_length", "critical_f1", "diffusion", "file", "icons", "ink", "inverse_distance", "longest", "mean", "nearest", "outside", "percentile_95", "shortest", "tangency", "void_max", "void_mean"]'
expect_json out '[.[] | .diffusion, .nearest, .inverse_distance | keys == ["mean", "percentile_95", "speed_weighted"]] | all'
expect_json out '.[0] | .mean - (.diffusion.mean + .nearest.mean + .inverse_distance.mean) / 3 | fabs < 1e-9'
expect_json out '.[0].count_length - 1 / 7 | fabs < 1e-12'
done_with "score: as JSON"

try score synth:vortex3 grid-curved.geojson --json --icons 196 --class arrows
expect_json out '.[0] | (.count_length - 1 / 14 | fabs < 1e-12) and (.longest - 1 | fabs < 1e-9)'
try score synth:vortex3 grid-curved.geojson --json --icons 196 --class free
expect_json out '.[0].longest > 1.5'
try score synth:vortex3 grid-curved.geojson --json --icons 196 --class free --ink 0.2
expect_json out '.[0].ink - 0.2 | fabs < 1e-9'
done_with "score: classes and ink"

# two lines of another program, and none
cat >lines.geojson <<'END'
{"type": "FeatureCollection", "features": [
  {"type": "Feature", "properties": null, "geometry": {"type": "LineString", "coordinates": [[0.1, 0.2], [0.3, 0.2]]}},
  {"type": "Feature", "properties": {"name": "b"}, "geometry": {"type": "LineString", "coordinates": [[0.5, 0.7], [0.8, 0.7]]}}]}
END
echo '{"type": "FeatureCollection", "features": []}' >none.geojson
try score synth:uniform lines.geojson none.geojson --class free --json
expect_code 0
expect_json out '.[0] | .icons == 2 and (.diffusion.mean - 25 | fabs < 1e-3) and (.tangency - 25 | fabs < 1e-3)'
expect_json out '.[1] | .icons == 0 and .mean == 90 and .void_max == null'
try score synth:uniform lines.geojson none.geojson
awk 'NR == 3 && $9 == "-" && $2 == "90.00" {found = 1} END {exit !found}' out || fault "$(cat out)"
try score synth:abc lines.geojson --json
expect_code 0
expect_json out '.[0] | .critical_f1 == null and .mean > 0'
cp lines.geojson "$(printf 'a\tb.geojson')"
sed 's/\[0\./[7./g' hedgehog.geojson >elsewhere.geojson
try score synth:vortex3 elsewhere.geojson
expect_code 0
expect_error '^flowgrain: elsewhere.geojson: all its icons lie outside the field'
try score synth:uniform "$(printf 'a\tb.geojson')"
expect_code 0
grep -q 'a?b.geojson$' out || fault "$(cat out)"
done_with "score: lines of other programs, none, and three dimensions"

for wrong in "" "synth:vortex3" "synth:vortex3 a --icons 0" "synth:vortex3 a --icons 60,25" \
  "synth:vortex3 a --ink 0" "synth:vortex3 a --class long" "synth:vortex3 a -o x"; do
  # shellcheck disable=SC2086
  try score $wrong
  expect_code 2
  expect_one_complaint
done
try score synth:vortex3 lines.geojson ""
expect_code 2
expect_error 'ICONS is empty'
done_with "score: wrong usage"

try score synth:vortex3 lines.geojson no-such.geojson
expect_code 1
expect_one_complaint
expect_error '^flowgrain: no-such.geojson: .*No such file'
[ ! -s out ] || fault "a part was printed: $(cat out)"
try score no-such.nc lines.geojson
expect_code 1
expect_error '^flowgrain: no-such.nc: '
sed 's/LineString/MultiLineString/' lines.geojson >multi.geojson
try score synth:vortex3 multi.geojson
expect_code 1
expect_one_complaint
expect_error '^flowgrain: multi.geojson: feature 0: .*LineString'
expect_error "ogr2ogr -explodecollections"
echo '{"type": "FeatureCollection", "features": [{"type": "Feature", "geometry": {"type": "LineString", "coordinates": [[-1e300, 0], [1e300, 0]]}}]}' >long.geojson
try score synth:vortex3 long.geojson --class free
expect_code 1
expect_one_complaint
expect_error '^flowgrain: long.geojson: score: '
done_with "score: what cannot be read"
finish
