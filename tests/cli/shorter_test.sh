#!/usr/bin/env bash
# A file that becomes shorter while it is read ends the program with a message: beyond the page of
# its end, where access to mapped bytes is a signal, and within it, where they are zeros.
source "$(dirname "$0")/harness.sh"
: "${FILE_CALLS:?is to name libfile_calls.so, as ctest does}"

# cut FILE BYTES ARGUMENTS...: as try, and the file is cut while it is read.
cut() {
  local file=$1 bytes=$2
  shift 2
  cp "$file" whole
  # a sanitizer would insist on being loaded first
  { FILE_CALLS_SHORTEN="$file $bytes" LD_PRELOAD="$FILE_CALLS" \
    ASAN_OPTIONS="${ASAN_OPTIONS:+$ASAN_OPTIONS:}verify_asan_link_order=0" \
    "$program" "$@" >out 2>err; } 2>/dev/null
  code=$?
  mv whole "$file"
  expect_code 1
  expect_one_complaint
  expect_error "^flowgrain: .*$file: $message"
}

became='became shorter while it was read'
{
  echo x,y,u,v
  for y in $(seq 30); do for x in $(seq 40); do echo "$x,$y,$((x + y)),$((y - x))"; done; done
} >table.csv
try synth vortex -o image.vti
try synth vortex -o grid.nc
try synth vortex3 -o volume.nc
cat >series.pvd <<'XML'
<VTKFile type="Collection"><Collection><DataSet timestep="0" file="image.vti"/></Collection></VTKFile>
XML
cp "$root/tests/fuzz/corpus/grib/seed-simple.grb" wind.grb
for file in table.csv image.vti grid.nc wind.grb; do
  message=$became
  # a child process may have read it first, to its new end
  [ $file != wind.grb ] || message="($became|message 1 has 923 bytes from byte 0 on, the file 100)"
  for bytes in 0 100; do
    cut $file $bytes info $file
    # the second reading meets a short file, whatever that may be
    [ $bytes = 0 ] || message=
    cut $file $bytes run $file --arrows 9 -o results
    expect_nothing_at results
  done
  done_with "$file"
done
message=$became
cut image.vti 0 info series.pvd
cut image.vti 5000 run series.pvd --arrows 9 -o results
done_with "a file that another names"
for name in u v; do
  NAME=$name write_netcdf '
    @dims = (["y", 40], ["x", 50]);
    @vars = (["y", [0], 6, [], [0 .. 39]], ["x", [1], 6, [], [0 .. 49]],
      [$ENV{NAME}, [0, 1], 5, [], [1 .. 2000]]);' >$name.nc
done
cut v.nc 0 run u.nc --vars-from v.nc --vars u,v --arrows 9 -o results
cut v.nc 1200 info u.nc --vars-from v.nc --vars u,v
done_with "a second file"

# libraries that read the file themselves say what is wrong with it, or see zeros
message=
for bytes in 0 2000 30000; do
  cut volume.nc $bytes run volume.nc --arrows 9 -o results
  cut grid.nc $bytes run grid.nc --arrows 9 -o results
done
done_with "NetCDF at any length"

try run table.csv --arrows 9 -o results --formats svg
message=$became
cut results/scale-00.geojson 0 draw results/scale-00.geojson -o again.svg
cut results/scale-00.geojson 50 draw results/scale-00.geojson -o again.svg
expect_nothing_at again.svg
done_with "icons of a run"

finish
