#!/usr/bin/env bash
# `info` tells what `run` does with the same options: what it reads of a file, or why it refuses.
# INFO_FILES: a list of further files, a line each.
source "$(dirname "$0")/harness.sh"

few=(--arrows 1 --effort 0 --start even --nodes 33 --formats svg --no-page --width 40 --quiet)

# lists_what_is_read FILE: where a file has one vector, and no map is drawn, the list has the grid that is read.
lists_what_is_read() {
  [ "$(jq -c '[.vectors[] | select(has("size"))] as $v | .field as $f |
    if ($v | length) != 1 or $f == null or $f.projection != null then [] else $v[0] |
      [.size, .bounds, .axes, .scale, .doubts] - [$f.size, $f.bounds, $f.axes, $f.scale, $f.doubts] +
        if .cells or .points then [] else [.missing_share] - [$f.missing_share] end end' told)" = "[]" ] ||
    fault "$1: listed: $(jq -c '.vectors[0] | del(.time_values)' told | head -c 500), read: $(jq -c .field told | head -c 500)"
}

# alike FILE OPTIONS...: run.json and info's JSON have the same input and field, or both refuse with the same words.
alike() {
  local refused
  "$program" info --json "$@" >told 2>told.err
  [ $# -gt 1 ] || [ ! -s told ] || lists_what_is_read "$1"
  rm -rf done
  try run "$@" -o done "${few[@]}"
  if [ -e done/run.json ]; then
    [ "$(jq -cS '[.input, .field]' told)" = "$(jq -cS '[.input, .field]' done/run.json)" ] ||
      fault "$*: $(diff <(jq -S '[.input, .field]' told) <(jq -S '[.input, .field]' done/run.json) | head -c 600)"
  elif ! grep -q 'arrows do not fit' err; then # the field was read
    refused=$(cat told.err)
    [ ! -s told ] || refused=$(jq -r '"flowgrain: \(.refused)", .hint // empty' told)
    [ "$(head -n 2 err)" = "$refused" ] || fault "$*: run: $(head -c 300 err), info: $(head -c 300 <<<"$refused")"
  fi
}

for file in "$root"/data/*.nc synth:vortex synth:abc; do
  alike "$file"
done
done_with "fields of our own"
number=0
for file in "$root"/tests/fuzz/corpus/{grib,grid,netcdf,points}/*; do
  if [ $((number++ % 6)) = 0 ]; then
    alike "$file"
  fi
done
done_with "a part of the corpus of damaged and sound files"
while read -r file; do
  [ -z "$file" ] || alike "$file"
done <<<"${INFO_FILES:-}"
done_with "files that are named"

# u and v of two times, the first at rest, on two levels, with a mask, and a pair in other units
write_netcdf '
  @dims = (["time", 2], ["lev", 2], ["lat", 21], ["lon", 41]);
  @vars = (
    ["time", [0], 6, [units => "hours since 1982-07-16 00:00"], [0, 6]],
    ["lev", [1], 6, [units => "hPa"], [850, 300]],
    ["lat", [2], 6, [units => "degrees_north"], [map { 2 * $_ } 0 .. 20]],
    ["lon", [3], 6, [units => "degrees_east"], [map { 2 * $_ } 0 .. 40]],
    ["sea", [2, 3], 5, [], [map { $_ % 41 > 5 } 0 .. 860]],
    ["k", [2, 3], 5, [units => "K"], [1 .. 861]]);
  for my $c (0, 1) {
    my @v = map { my $i = $_ % 41; my $t = int($_ / 1722); $i == 0 && $t ? 999 : $t * (1 + 0.1 * ($c ? $i : int($_ / 41) % 21)) } 0 .. 3443;
    push @vars, [("u", "v")[$c], [0, 1, 2, 3], 5, [units => "m s-1"], \@v];
  }' >wind.nc
while read -r -a options; do
  alike wind.nc "${options[@]}"
done <<'OPTIONS'
--time 1
--time 1 --missing 999
--time 1 --missing 999 --level 300hPa
--time 1982-07-16T06 --missing 999 --mask sea
--time 1 --missing 999 --region 10,60,5,35
--time 1 --missing 999 --projection robinson --center 20
--time 1 --missing none --scale plain
--time 1 --missing 999 --projection none
--time 1 --missing 999 --vars u,k
--time 1 --missing 999 --vars u,w
--time 1 --missing 999 --mask w
--time 1 --missing 999 --region 200,210,5,35
--time 7
--level 500m
--at member=2
--block a
--slice z=0
OPTIONS
done_with "each option of the input"
alike synth:abc --slice y=0.5
alike synth:abc --slice q=0.5
done_with "cuts"
try info wind.nc --time 1 --missing 999 --region 10,60,5,35
expect_code 0
for line in 'time: 1982-07-16 06:00 (1 of 0 to 1)' 'level: 850 hPa (0 of 0 to 1)' 'region: 10 to 60 east, 5 to 35 north' \
  'longitude: 0 to 80' 'projection: +proj=lcc'; do
  grep -qF "$line" out || fault "no $line: $(cat out)"
done
try info wind.nc
expect_code 0
grep -q '^run refuses: wind.nc: the velocity is zero everywhere' out || fault "$(cat out)"
grep -q '^vectors: u,v$' out || fault "$(cat out)"
try info wind.nc --time 0
expect_code 1
expect_one_complaint
expect_error 'zero everywhere'
grep -q '^    1: 1982-07-16 06:00$' out || fault "no times: $(cat out)"
done_with "what info prints of it"
finish
