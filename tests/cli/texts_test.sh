#!/usr/bin/env bash
# Texts that are not UTF-8, of a file or its name: what is written is UTF-8, and the file is found
# again. Lists of names in messages are short.
source "$(dirname "$0")/harness.sh"

deg=$(printf '\260') # ° of Latin-1

table() { # SEPARATOR NAME NAME UNIT
  printf 'x [m]%sy [m]%s%s [%s]%s%s [%s]\n' "$1" "$1" "$2" "$4" "$1" "$3" "$4"
  for y in 0 1 2 3; do
    for x in 0 1 2 3 4; do
      printf '%s%s%s%s%s%s%s\n' $x "$1" $y "$1" $((x + 1)) "$1" $((y + 2))
    done
  done
}

legacy() { # NAME
  printf '# vtk DataFile Version 3.0\nS%stroem\nASCII\nDATASET STRUCTURED_POINTS\n' "$deg"
  printf 'DIMENSIONS 5 4 1\nORIGIN 0 0 0\nSPACING 1 1 1\nPOINT_DATA 20\nVECTORS %s float\n' "$1"
  for k in $(seq 20); do echo "$k 3 0"; done
}

netcdf() { # NAME NAME UNITS
  NAME_U=$1 NAME_V=$2 UNITS=$3 write_netcdf '
    my @about = ("units", $ENV{UNITS}, "long_name", "flow $ENV{UNITS} " . "\303\266" x 200);
    @dims = (["y", 4], ["x", 5]);
    @vars = (["y", [0], 6, ["units", $ENV{UNITS}], [0 .. 3]], ["x", [1], 6, ["units", "m"], [0 .. 4]],
      [$ENV{NAME_U}, [0, 1], 5, \@about, [1 .. 20]], [$ENV{NAME_V}, [0, 1], 5, \@about, [(3) x 20]]);'
}

expect_utf8() {
  local name
  for name in "$@"; do
    # a build without the page for browsers makes none
    if [[ $name == */index.html && ! -e $name ]]; then
      expect_json "${name%/*}/run.json" 'has("page") | not'
      continue
    fi
    iconv -f UTF-8 -t UTF-16 <"$name" >/dev/null 2>&1 || fault "$name is not UTF-8"
  done
}

# Names as `info` shows them choose the vector.
check() { # FILE NAMES
  try info --json "$1"
  expect_code 0
  cp out "$1.json"
  expect_utf8 "$1.json"
  expect_json "$1.json" ".vectors[0].vars | join(\",\") == \"$2\""
  try info "$1" --vars "$2"
  expect_code 0
  expect_utf8 out
}

table ',' "u$deg" "v$deg" "m/s$deg" >a.csv
check a.csv 'u°,v°'
expect_json a.csv.json '.vectors[0].units == "m/s°"'
done_with "names and units of a table"
legacy "Feld$deg" >a.vtk
check a.vtk 'Feld°'
done_with "a name of VTK's legacy format"
netcdf "u$deg" "v$deg" "m s-1 $deg" >a.nc
check a.nc 'u°,v°'
expect_json a.nc.json '.vectors[0].units == "m s-1 °"'
done_with "names and units of NetCDF"

file=$(printf 'str\366mung.csv')
table ',' u v "m/s$deg" >"$file"
try info --json "$file"
expect_code 0
expect_utf8 out
done_with "info on a file of such a name"
try run "$file" --arrows 9 --formats svg -o results --title "A$deg"
expect_code 0
expect_utf8 results/run.json results/index.html results/scale-00.geojson results/scale-00.svg
expect_json results/run.json '.field.title == "strömung" and .field.velocity_units == "m/s°"'
done_with "a run on it"
try draw results/scale-00.geojson -o again.svg
expect_code 0
expect_file again.svg
done_with "draw finds the file by run.json"
try run "$file" --arrows 9 --formats svg -o results --title "A$deg" --resume
expect_code 0
mv "$file" strömung.csv
try run strömung.csv --arrows 9 --formats svg -o results --title "A$deg" --resume
expect_code 1
expect_error 'holds the results of a run on'
done_with "a name in UTF-8 is another file"

# Names are 24 letters long; a message names a dozen of 300, and how many there are besides.
long_names() { # BEFORE BETWEEN
  for k in $(seq 300); do printf '%s%s_%020d' "$([ "$k" = 1 ] || printf '%s' "$2")" "$1" "$k"; done
}
lists_few() { # ARGUMENTS...
  try info "$@"
  expect_code 1
  expect_one_complaint
  expect_error 'and 28[0-9] more'
  [ "$(wc -c <err)" -lt 700 ] || fault "$(wc -c <err) bytes"
}
{
  long_names col , && echo
  for row in 1 2 3 4; do seq -s , "$row" $((row + 299)); done
} >many.csv
lists_few many.csv
lists_few many.csv --vars a,b
{
  printf '# vtk DataFile Version 3.0\nmany\nASCII\nDATASET STRUCTURED_POINTS\nDIMENSIONS 2 2 1\n'
  printf 'ORIGIN 0 0 0\nSPACING 1 1 1\nPOINT_DATA 4\nFIELD all 300\n'
  for name in $(long_names arr ' '); do printf '%s 1 4 float\n1 2 3 4\n' "$name"; done
} >many.vtk
lists_few many.vtk
lists_few many.vtk --vars a,b
write_netcdf '
  @dims = (["y", 2], ["x", 2]);
  @vars = map { [sprintf("var_%020d", $_), [0, 1], 5, [], [1 .. 4]] } 1 .. 300;' >many.nc
lists_few many.nc
done_with "hundreds of names"

finish
