#!/usr/bin/env bash
# Times and levels by index, value, date and range; a run on several of them.
# shellcheck disable=SC2012 # names of our own
source "$(dirname "$0")/harness.sh"
need_ranks

# A classic NetCDF file: u and v on three times, two levels and a grid of 33 x 17; the
# speeds double from time to time; some have none, and a bare file has no x and y.
make_wind() { # [bare] TIMES WITHOUT A SPEED
  write_netcdf '
    my %dead = map { $_ => 1 } @ARGV;
    @dims = (["time", 3], ["lev", 2], ["y", 17], ["x", 33]);
    @vars = (
      ["time", [0], 6, [units => "hours since 1982-07-16 00:00"], [0, 6, 30]],
      ["lev", [1], 6, [units => "hPa"], [850, 300]],
      ["y", [2], 6, [units => "km"], [map { 10 * $_ } 0 .. 16]],
      ["x", [3], 6, [units => "km"], [map { 10 * $_ } 0 .. 32]]);
    splice @vars, 2 if $dead{bare};
    for my $c (0, 1) {
      my @v;
      for my $t (0 .. 2) { for my $l (0 .. 1) { for my $j (0 .. 16) { for my $i (0 .. 32) {
        my ($x, $y) = ($i / 16 - 1, $j / 16 - 0.5);
        my $s = $dead{$t} ? 0 : 2 ** $t * (1 + $l);
        push @v, $s * ($c ? 0.3 + $x : 1 - 2 * $y + 0.2 * $t * $x);
      } } } }
      push @vars, [("u", "v")[$c], [0, 1, 2, 3], 5, [units => "m s-1"], \@v];
    }' "$@"
}
make_wind >wind.nc
make_wind 2 >dead.nc

try info wind.nc
expect_code 0
grep -q '    2: 1982-07-17 06:00' out || fault "no third time: $(cat out)"
try info wind.nc --json
expect_json out '.vectors[0].level_values == [{value: 850, units: "hPa", words: "850 hPa"}, {value: 300, units: "hPa", words: "300 hPa"}]'
done_with "info tells times and levels by value"

# a child process reads what looks like GRIB first
as_child() {
  perl -pe "s/\\x00{3}\\x03lev\\x00/\\x00\\x00\\x00\\x04GRIB/"
}
make_wind 0 2 >middle.nc
make_wind 0 1 2 >none.nc
as_child <middle.nc >middle-child.nc
as_child <none.nc >none-child.nc
for file in middle middle-child none none-child; do
  try info $file.nc --scale plain
  expect_code 1
  expect_error "$file.nc: .*zero everywhere"
  expect_error '^Choose another with --time or --level, as --time 1'
  grep -q '    2: 1982-07-17 06:00' out || fault "$file: no times: $(cat out)"
done
done_with "info with options lists the times where run refuses the first"

small=(--arrows 8 --effort 0 --nodes 65 --formats svg)
chosen() { # PATTERN-OF-STDERR TIME LEVEL OPTIONS...: what run.json says was read
  local pattern=$1 time=$2 level=$3
  shift 3
  try run wind.nc -o one --force "${small[@]}" "$@"
  expect_code 0
  expect_json one/run.json ".input.time == $time and .input.level == $level"
  expect_error "$pattern"
}
chosen '^flowgrain: wind.nc: time 1 of 0 to 2: 1982-07-16 06:00$' 1 1 --time 1982-07-16T06:00 --level 300hPa
grep -q 'nearest' err && fault "nearest: $(cat err)"
try run wind.nc -o silent --quiet "${small[@]}" --time 1 --level 300hPa
expect_code 0
[ ! -s err ] || fault "--quiet: $(cat err)"
chosen '^flowgrain: wind.nc: level 1 of 0 to 1: 300 hPa$' 0 1 --level 300
chosen '^flowgrain: wind.nc: no time 1982-07-16T12:00: the nearest is 1982-07-16 06:00$' 1 0 --time 1982-07-16T12:00
chosen '^flowgrain: wind.nc: no level 800.: the nearest is 850 hPa$' 2 0 --time 2 --level 800.
# levels as ROMS has them, from the bottom up: the surface, unless another is asked for
perl -pe "s/\\x00{3}\\x03lev\\x00/\\x00\\x00\\x00\\x04sc_r/; s/hPa/xyz/" wind.nc >sea.nc
try run sea.nc -o sea "${small[@]}"
expect_code 0
expect_json sea/run.json '.input.level == 1'
try run sea.nc -o sea --force "${small[@]}" --level 0
expect_json sea/run.json '.input.level == 0'
try run wind.nc -o one --resume "${small[@]}" --time 1982-07-17 --level 85000Pa
expect_code 0
expect_error 'one: the run is finished'
done_with "a time and a level by index, value and date"

try run wind.nc -o by-name "${small[@]}" --time 1 --at lev=300hPa --quiet
expect_code 0
expect_json by-name/run.json '.input.at == "lev=300hPa" and .input.level == 0 and .field.level == "300 hPa"'
try run wind.nc -o by-level "${small[@]}" --time 1 --level 300hPa --quiet
cmp -s by-name/scale-00.geojson by-level/scale-00.geojson || fault "--at lev is another level than --level"
cmp -s by-name/scale-00.svg by-level/scale-00.svg || fault "another picture"
try draw by-name -o drawn.svg
expect_code 0
cmp -s by-name/scale-00.svg drawn.svg || fault "draw reads another level"
try run wind.nc -o by-name --resume "${small[@]}" --time 1 --at lev=850hPa
expect_code 1
expect_error 'its run was begun with --at lev=300hPa'
refuse_at() { # PATTERN ARGUMENTS...
  try run wind.nc -o x "${@:2}"
  expect_error "$1"
  expect_one_complaint
  expect_nothing_at x
}
refuse_at '--at is given twice: name all in one, as lev=0,time=1' --at lev=0 --at time=1
refuse_at "wind.nc: has no dimension 'member'" --at member=0
refuse_at 'wind.nc: is given twice' --vars-from ./wind.nc
done_with "a sample of a dimension by its name"

cp wind.nc other.nc
try run wind.nc --vars u,v --vars-from other.nc -o parted "${small[@]}" --quiet
expect_code 0
resume_parted() { # CODE PATTERN OPTIONS...
  try run wind.nc --vars u,v -o parted "${small[@]}" --resume "${@:3}"
  expect_code "$1"
  expect_error "$2"
}
cp wind.nc third.nc
resume_parted 0 'the run is finished' --vars-from "$PWD/../${PWD##*/}/other.nc"
resume_parted 1 'begun with --vars-from .*/other.nc; this command goes with --vars-from .*/third.nc$' --vars-from third.nc
resume_parted 1 'begun with --vars-from .*/other.nc; this command goes without --vars-from$'
make_wind bare >bare.nc
meshed=(run bare.nc -o meshed "${small[@]}")
try "${meshed[@]}" --mesh-from wind.nc --quiet
expect_code 0
try "${meshed[@]}" --mesh-from ./wind.nc --resume
expect_code 0
try "${meshed[@]}" --mesh-from third.nc --resume
expect_code 1
expect_error 'meshed: its run was begun with --mesh-from .*/wind.nc; this command goes with --mesh-from .*/third.nc$'
try run bare.nc -o meshes "${small[@]}" --time 0,1 --mesh-from wind.nc --quiet
expect_code 0
try run bare.nc -o meshes "${small[@]}" --time 0,1 --mesh-from third.nc --resume
expect_code 1
expect_error 'meshes: its run was begun with --mesh-from .*/wind.nc; this command goes with --mesh-from .*/third.nc$'
done_with "a finished run, or a series, is not taken for one of other further files"
mv other.nc moved.nc
try draw parted -o x.svg
expect_code 1
expect_error 'other.nc'
expect_nothing_at x.svg
try draw parted -o found.svg --vars-from moved.nc
expect_code 0
cmp -s parted/scale-00.svg found.svg || fault "another picture"
done_with "draw: a component's file that has moved"

refuse() { # CODE PATTERN ARGUMENTS...
  local wanted=$1 pattern=$2
  shift 2
  try "$@"
  expect_code "$wanted"
  expect_error "$pattern"
  expect_one_complaint
  expect_nothing_at x
  expect_nothing_at x.svg
}
refuse 1 'no time 1990-01-01: 0 is 1982-07-16, 2 is 1982-07-17 06:00' run wind.nc -o x --time 1990-01-01
refuse 1 'no level 10m: none of them is in such a unit' run wind.nc -o x --level 10m
refuse 1 'level 700 asked for, and there are 2: 0 is 850 hPa, 1 is 300 hPa' run wind.nc -o x --level 700
grep -q 'a value has its unit or a point: 850hPa' err || fault "no hint: $(cat err)"
refuse 2 '--time noon:1: no index, value' run wind.nc -o x --time noon:1
refuse 2 '--time all: texture takes one time' texture wind.nc -o x.svg --time all
try texture wind.nc -o late.png --pixels 64 --time 1982-07-17 --level 300hPa
expect_code 0
try texture wind.nc -o same.png --pixels 64 --time 2 --level 1
cmp -s late.png same.png || fault "--time 2 is another than 1982-07-17"
done_with "what is not there is refused with what is; other commands take one"

try run wind.nc -o series "${small[@]}" --time all --level 300hPa:1000hPa --quiet
expect_code 0
[ "$(ls -A series | xargs)" = "panels-00.svg series.json time-0000-level-000 time-0000-level-001 time-0001-level-000 \
time-0001-level-001 time-0002-level-000 time-0002-level-001" ] || fault "it holds $(ls -A series | xargs)"
expect_json series/series.json '.members[3] == {folder: "time-0001-level-001", time: 1, time_words: "1982-07-16 06:00", level: 1, level_words: "300 hPa"}'
for member in series/time*; do
  expect_only_results "$member"
  expect_json "$member/run.json" ".speed_range == $(jq -c .speed_range series/series.json)"
done
expect_json series/series.json '.speed_range[0] < 0.5 and .speed_range[1] > 8'
try run wind.nc -o alone "${small[@]}" --time 1 --level 1 --quiet --speed-range "$(jq -r '.speed_range | join(",")' series/series.json)"
expect_same_results alone series/time-0001-level-001
done_with "a series is a folder each, as a run by itself leaves it, with one colour range"

[ "$(grep -c '<text.*>([a-f]) 1982.* hPa</text>' series/panels-00.svg)" = 6 ] || fault "not six labels"
expect_json series/series.json '.panels == ["panels-00.svg"]'
try draw series -o again.svg
expect_code 0
cmp -s again.svg series/panels-00.svg || fault "draw makes other panels"
done_with "the scale of all members is one figure of panels"

series=(run wind.nc "${small[@]}" --time 0:2 --quiet)
mkdir -p mine
echo mine >mine/panels-00.svg
refuse 1 'mine: holds panels-00.svg, which no run' "${series[@]}" -o mine --force
[ "$(cat mine/panels-00.svg)" = mine ] || fault "a file of others is replaced"
refuse 1 'series: holds a series of runs' "${series[@]}" -o series
refuse 1 'series: holds a series of other times or levels' "${series[@]}" -o series --resume
refuse 1 'series: holds a series of runs' run wind.nc "${small[@]}" -o series --quiet
refuse 1 'one: holds the results of a run' "${series[@]}" -o one --force
try "${series[@]}" -o series --force
expect_code 0
[ "$(ls -A series | xargs)" = "panels-00.svg series.json time-0000 time-0001 time-0002" ] || fault "left: $(ls -A series | xargs)"
touch -d 2001-01-01 series/*/scale-00.svg
try "${series[@]}" -o series --resume
expect_code 0
[ -z "$(find series -name 'scale-00.svg' -newermt 2002-01-01)" ] || fault "finished runs were done again"
done_with "a series is not replaced unasked, and finished runs are not done again"

with_calls kill 0 "${series[@]}" -o counted --threads 1
all=$(cat calls)
for at in 1 4 $((all / 2)) $((all - 2)); do
  rm -rf part
  with_calls kill "$at" "${series[@]}" -o part --threads 1
  [ "$code" = 137 ] || fault "call $at: not killed: code $code"
  try "${series[@]}" -o part --threads 1 --resume
  [ "$code" = 0 ] || fault "call $at: resumed: code $code: $(head -c 300 err)"
  [ "$(ls -A part | xargs)" = "panels-00.svg series.json time-0000 time-0001 time-0002" ] || fault "call $at: $(ls -A part | xargs)"
  for member in time-0000 time-0001 time-0002; do
    expect_same_results "counted/$member" "part/$member"
    expect_only_results "part/$member"
  done
done
done_with "a series that was killed goes on"

try run dead.nc -o dead "${small[@]}" --time 2
expect_code 1
expect_error 'zero everywhere'
expect_error '^Choose another with --time or --level, as --time 0; flowgrain info lists them'
expect_one_complaint
as_child <dead.nc >child.nc # says the same
try run child.nc -o dead "${small[@]}" --time 2
expect_code 1
expect_error '^Choose another with --time or --level, as --time 0; flowgrain info lists them'
expect_one_complaint
done_with "a time without flow: others are named"
try run dead.nc -o dead "${small[@]}" --time all --quiet
expect_code 1
expect_error 'dead: 1 of 3 fields could not be done'
expect_file dead/time-0001/run.json
grep -q '<text.*>(b) [01][0-9]:00<' dead/panels-00.svg || fault "no panels of those that are done"
expect_nothing_at dead/time-0002
done_with "a time without wind does not keep the others from being drawn"

on 2 "${series[@]}" -o ranks --threads 1
expect_code 0
for member in time-0000 time-0001 time-0002; do
  expect_same_results "counted/$member" "ranks/$member"
done
cmp -s ranks/series.json counted/series.json || fault "another index"
cmp -s ranks/panels-00.svg counted/panels-00.svg || fault "other panels"
done_with "ranks make the same series"
finish
