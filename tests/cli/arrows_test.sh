#!/usr/bin/env bash
# Placed arrows: exactly as many as asked for, the same however the run went, and the error
# that readers make of them.
source "$(dirname "$0")/harness.sh"

wind=$root/data/gfs_20140131.nc
run=(run "$wind" --projection none --nodes 129 --arrows 20,10,5 --effort 0 --formats svg --quiet)

# expect_counts FOLDER NUMBER...: a scale each.
expect_counts() {
  local folder=$1 index=0 count
  shift
  expect_json "$folder/run.json" ".scales | length == $#"
  for count in "$@"; do
    expect_json "$folder/run.json" ".scales[$index] | .wanted == [$count] and .icons == $count"
    expect_json "$folder/scale-0$index.geojson" ".features | length == $count"
    index=$((index + 1))
  done
}

try "${run[@]}" -o whole
expect_code 0
[ ! -s err ] || fault "standard error: $(head -c 200 err)"
expect_only_results whole
expect_counts whole 20 10 5
[ "$(awk '{print $1, $2}' out | tr '\n' ' ')" = "20 arrows 10 arrows 5 arrows " ] || fault "$(cat out)"
expect_json whole/run.json '[.scales[].error.mean] | . == sort and .[0] > 0'
expect_json whole/run.json '.ended == "scales"'
done_with "as many arrows as asked for"

for scale in 0 1 2; do
  file=whole/scale-0$scale.geojson
  expect_json $file '[.features[].properties | .id > 0 and (.seed | length) == 2 and (.way | length) == 2 and .area > 0] | all'
  expect_json $file '([.features[].properties.id] | unique | length) == (.features | length)'
  expect_json $file ".next_id > ([.features[].properties.id] | max)"
  expect_json $file "[.features[].properties.cluster] | . == map(floor) and min >= 1 and max <= $(jq ".scales[$scale].clusters" whole/run.json)"
done
for scale in 0 1; do
  jq '[.features[].properties.id]' whole/scale-0$((scale + 1)).geojson >ids
  expect_json whole/scale-0$scale.geojson "$(tr -d '\n' <ids) as \$ids | [.features[].properties |
    (.parent as \$parent | \$ids | index(\$parent) != null) and
    (.parent == .id or (.id as \$id | \$ids | index(\$id) == null))] | all"
done
expect_json whole/scale-02.geojson '[.features[].properties | has("parent")] | any | not'
# half of ten were among the twenty, at least
jq '[.features[].properties.id]' whole/scale-01.geojson >ids
expect_json whole/scale-00.geojson "$(tr -d '\n' <ids) - [.features[].properties.id] | length <= 5"
done_with "arrows keep their ids, and go into parents of the next scale"

try score "$wind" --projection none whole/scale-0{0,1,2}.geojson --class free --json
expect_code 0
for scale in 0 1 2; do
  jq --argjson run "$(jq ".scales[$scale].error" whole/run.json)" --argjson file "$(jq .error whole/scale-0$scale.geojson)" \
    ".[$scale]"' as $score | [$run, $file] | map(
      ([paths(type == "number")] | length == 11) and
      . as $error | [paths(type == "number")] | map(. as $p | ($error | getpath($p)) - ($score | getpath($p)) | fabs < 1e-6) | all) | all' out >agrees
  [ "$(cat agrees)" = true ] || fault "scale $scale: $(cat agrees) $(jq -c ".scales[$scale].error" whole/run.json)"
done
done_with "the error in run.json and in the file is that of flowgrain score"

# letters are outlines in SVG
if command -v gs >/dev/null; then
  try "${run[@]}" --formats pdf -o drawn
  expect_code 0
  for scale in 0 1 2; do
    degrees=$(jq ".scales[$scale].error.mean | ceil" drawn/run.json)
    count=$(jq ".scales[$scale].icons" drawn/run.json)
    gs -q -sDEVICE=txtwrite -o words "drawn/scale-0$scale.pdf" >/dev/null 2>&1
    grep -qE "$count arrows .*mean direction error $degrees" words || fault "scale $scale: $(head -c 200 words)"
  done
fi
done_with "pictures say what readers get wrong"

# below 20 clusters, and above 10 and 5
try "${run[@]}" -o part --max-steps 30
expect_code 0
expect_json part/run.json '.ended == "steps" and .steps.accepted == 30'
expect_counts part 20 10 5
cmp -s part/scale-00.geojson whole/scale-00.geojson || fault "the first scale differs"
expect_json part/run.json '.scales[2].clusters > 10'
try "${run[@]}" -o part --resume
expect_code 0
expect_same_results whole part
expect_only_results part
done_with "a run that ends early gives all scales, and goes on to the same results"

with_calls kill 0 "${run[@]}" --checkpoint 0 -o counted
expect_code 0
expect_same_results whole counted
all=$(cat calls)
[ "$all" -gt 200 ] || fault "only $all calls"
# the last scales are placed at the end
rm -rf part
with_calls kill $((all - 45)) "${run[@]}" --checkpoint 0 -o part
[ "$code" = 137 ] || fault "not killed: code $code"
try "${run[@]}" -o part --resume
[ "$code" = 0 ] || fault "resumed: code $code: $(head -c 300 err)"
expect_same_results whole part
expect_only_results part
done_with "killed, it goes on to the same results"

try run synth:vortex3 --nodes 65 --arrows 9,8 --start even --formats svg --quiet -o one
expect_code 0
expect_counts one 9 8
try run synth:vortex3 --nodes 65 --arrows 9,8 --start even --formats svg --quiet -o other --threads 1 --seed 5
expect_code 0
for name in scale-00.geojson scale-01.geojson; do
  cmp -s <(jq 'del(.clusters, .features[].properties.cluster)' one/$name) \
    <(jq 'del(.clusters, .features[].properties.cluster)' other/$name) || fault "$name differs"
done
# two scales of one state
try run synth:vortex3 --nodes 33 --arrows 20,18,15 --effort 0 --formats svg --quiet -o many
expect_code 0
expect_counts many 20 18 15
expect_json many/run.json '[.scales[].time] | .[0] == .[1] and .[1] == .[2]'
done_with "an even start has no seed, and one state has several scales"

try run synth:vortex3 --nodes 65 --arrows 9 --lengths fair --effort 0 --formats svg --quiet -o fair
expect_code 0
expect_counts fair 9
try score synth:vortex3 fair/scale-00.geojson --class free --json
expect_json out '.[0].longest < 1.01'
try run synth:vortex3 --nodes 65 --arrows 9 --effort 0 --formats svg --quiet -o tinted --tint
expect_code 0
try run synth:vortex3 --nodes 65 --arrows 9 --effort 0 --formats svg --quiet -o plain
[ "$(stat -c %s tinted/scale-00.svg)" -gt $(($(stat -c %s plain/scale-00.svg) + 2000)) ] || fault "--tint draws nothing"
cmp -s plain/scale-00.geojson tinted/scale-00.geojson || fault "--tint changes the arrows"
done_with "lengths, effort, and regions behind the arrows"

try run synth:vortex3 --tolerance 11 --nodes 65 --formats svg --quiet -o within
expect_code 0
expect_json within/run.json '.scales | length == 1 and .[0].error.mean <= 11 and .[0].icons == .[0].wanted[0] and .[0].icons > 3'
fewer=$(($(jq '.scales[0].icons' within/run.json) - 1))
try run synth:vortex3 --arrows "$fewer" --start even --nodes 65 --formats svg --quiet -o fewer
expect_json fewer/run.json '.scales[0].error.mean > 11'
done_with "--tolerance: the fewest arrows within an error"

space=(run synth:abc --arrows 6,4 --nodes 17 --effort 0 --width 40 --no-frame --quiet)
try "${space[@]}" -o space
expect_code 0
expect_counts space 6 4
expect_json space/scale-00.geojson '[.features[].properties | (.seed | length) == 3 and .volume > 0] | all'
done_with "in three dimensions"

refused() {
  try run "$wind" -o refused "${@:2}"
  expect_code 2
  expect_one_complaint
  expect_error "$1"
  expect_nothing_at refused
}
refused '--arrows and --clusters' --arrows 12 --clusters 3
refused '--arrows and --tolerance' --arrows 12 --tolerance 20
refused '--tolerance and --clusters' --clusters 12 --tolerance 20
refused '--clusters and --times' --clusters 12 --times 1e-3
refused '--arrows and --times' --arrows 12 --times 1e-3
refused '--tolerance and --times' --tolerance 20 --times 1e-3
refused '--start: .* --times' --times 1e-3 --start even
refused '1e-3 follows 0.002' --times 2e-3,1e-3
refused "'0' is no time above 0" --times 0
refused "'soon' is no time" --times soon
refused '--start: .* --clusters' --clusters 12 --start even
refused '--lengths: .* --clusters' --clusters 12 --lengths fair
refused '--effort: .* --clusters' --clusters 12 --effort 2
refused '--arrows and --no-arrows' --arrows 12 --no-arrows
refused '--tolerance and --no-arrows' --tolerance 12 --no-arrows
refused '--start: .* --no-arrows' --start even --no-arrows
refused '20 follows 7' --arrows 7,20
refused "'0' is no number of arrows" --arrows 5,0
refused 'a number in \(0, 90\]' --tolerance 0
refused 'clusters, even' --start middle
refused '--skeletons' --arrows 5 --skeletons
refused '--extent: of clusters' --arrows 5 --extent territory
done_with "what can not be asked for"

# the arrows are placed on one of them
if command -v mpirun >/dev/null; then
  need_ranks
  on 2 "${run[@]}" -o two
  expect_code 0
  expect_same_results whole two
  if [ -z "$sanitized" ]; then
    on 2 run synth:vortex3 --tolerance 11 --nodes 65 --formats svg --quiet -o two-within
    expect_code 0
    expect_same_results within two-within
    on 2 "${space[@]}" -o two-space
    expect_code 0
    for scale in 0 1; do
      cmp -s "space/scale-0$scale.geojson" "two-space/scale-0$scale.geojson" || fault "space: scale $scale differs"
    done
  fi
fi
done_with "two ranks have the results of one"
finish
