#!/usr/bin/env bash
# The method has no scale: numbers of any size give the same arrows.
source "$(dirname "$0")/harness.sh"

# table NAME DIMENSION LENGTH SPEED: a flow whose coordinates and speeds are so many powers of two.
table() {
  awk -v d="$2" -v length_of="$3" -v speed="$4" 'BEGIN {
    l = 2 ^ length_of; s = 2 ^ speed
    print d == 3 ? "x,y,z,u,v,w" : "x,y,u,v"
    for (k = 0; k <= (d == 3 ? 8 : 0); ++k)
      for (j = 0; j <= 12; ++j)
        for (i = 0; i <= 16; ++i) {
          x = i / 4; y = j / 4 - 2; z = k / 4
          u = int(4096 * (sin(x) * cos(y) + 0.3)) / 4096; v = int(4096 * (0.1 * x - cos(x) * sin(y))) / 4096
          if (d == 3) printf "%.17g,%.17g,%.17g,%.17g,%.17g,%.17g\n", x * l, y * l, z * l, u * s, v * s, s * int(4096 * cos(z) / 5) / 4096
          else printf "%.17g,%.17g,%.17g,%.17g\n", x * l, y * l, u * s, v * s
        }
  }' >"$1"
}

# lines NAME LENGTH: the arrows' centrelines, in coordinates of before.
lines() {
  jq -c --argjson l "$2" '[.features[].geometry.coordinates | .. | numbers | . / pow(2; $l) * 1e9 | round]' "$1/scale-00.geojson"
}

for dimension in 2 3; do
  for powers in '0 0' '73 66' '73 -66' '-73 -66'; do
    read -r length speed <<<"$powers"
    name=of$dimension$length$speed
    table $name.csv $dimension "$length" "$speed"
    try run $name.csv -o $name --arrows 5 --effort 0 --quiet --formats png
    expect_code 0
    lines $name "$length" >$name.lines
    [ -s $name.lines ] && cmp -s of${dimension}00.lines $name.lines || fault "$dimension dimensions, 2^$length, 2^$speed: other arrows"
  done
done
done_with "lengths of 1e22 and 1e-22, speeds of 1e20 and 1e-20"

table one.csv 2 0 0
for number in 1e20 9.96921e36; do
  sed "40s/[^,]*\$/$number/" one.csv >odd.csv
  try run odd.csv -o odd --arrows 5 --effort 0 --quiet
  expect_one_complaint
  expect_error "$number|1e\\+20|speeds up to"
  expect_nothing_at odd
done
done_with "one number far beyond all others is no speed"
finish
