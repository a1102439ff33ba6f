#!/usr/bin/env bash
# draw, info and synth.
source "$(dirname "$0")/harness.sh"

try run synth:saddle -o run --nodes 65 --clusters 16,8 --quiet
expect_code 0
try draw run -o coarse.pdf
expect_code 0
[ "$(head -c 5 coarse.pdf)" = %PDF- ] || fault "no PDF"
try draw run -o fine.svg --scale-index 0 --width 300 --no-frame
expect_code 0
grep -q 'width="300' fine.svg || fault "the width is not 300: $(grep -m1 '<svg' fine.svg)"
try draw run -o narrow.svg --width 3cm
expect_code 0
grep -q '<linearGradient' narrow.svg || fault "no colour key"
try draw run -o narrower.svg --width 36
expect_code 0
expect_error '^flowgrain: narrower.svg: no room for the colour key; a picture of this shape has it from a width of 4[0-9] points'
done_with "draw: a scale again"

try draw run -o by-clusters.svg --clusters 9 --no-frame --width 300
expect_code 0
try draw run -o last.svg --scale-index 1 --no-frame --width 300
cmp -s by-clusters.svg last.svg || fault "--clusters 9 and --scale-index 1 differ"
cmp -s by-clusters.svg fine.svg && fault "the scales do not differ"
done_with "draw: a scale chosen by its clusters"

placed=(run synth:saddle --nodes 33 --arrows 12,5 --effort 0 --quiet --formats svg)
try "${placed[@]}" -o placed --tint
expect_code 0
for arrows in 12 11; do # the second takes the next coarser scale
  try draw placed -o again.svg --tint --arrows $arrows
  expect_code 0
  scale=$((12 - arrows))
  cmp -s <(without_numbers again.svg) <(without_numbers placed/scale-0$scale.svg) ||
    fault "--arrows $arrows is not scale $scale of the run"
done
try draw placed -o plain.svg
expect_code 0
"$program" "${placed[@]}" -o untinted >/dev/null
cmp -s <(without_numbers plain.svg) <(without_numbers untinted/scale-01.svg) || fault "without --tint"
cmp -s <(without_numbers plain.svg) <(without_numbers placed/scale-01.svg) && fault "--tint changes nothing"
done_with "draw: a scale of placed arrows, chosen by their number, and what they stand for"
try draw placed -o x.svg --arrows 4
expect_code 1
expect_one_complaint
expect_error 'placed: its coarsest scale has 5 arrows, and at most 4 were asked for'
try draw placed -o x.svg --arrows 9 --clusters 9
expect_code 2
expect_one_complaint
expect_error '--arrows and --clusters each choose'
try draw run -o x.svg --tint
expect_code 1
expect_one_complaint
expect_error '--tint needs the density of scale 1, which was not saved'
expect_nothing_at x.svg
done_with "draw: numbers of arrows and tints that there are not"

try draw placed --arrows 12,5 -o panels.svg --panel-label '{letter}: {arrows}' --columns 1
expect_code 0
for text in 'a: 12' 'b: 5' 'mean speed'; do
  [ "$(grep -c "<text.*>$text" panels.svg)" = 1 ] || fault "not once: '$text'"
done
[ "$(grep -c '<linearGradient' panels.svg)" = 1 ] || fault "not one key"
try draw placed --all-scales -o all.svg
expect_code 0
grep -q '<text.*>(b) 5 arrows</text>' all.svg || fault "no label that tells the scales apart"
try draw run placed/scale-00.geojson -o two.png --panel-label 'x|y'
expect_code 0
try draw placed/scale-00.geojson -o one.svg
expect_code 0
try draw placed --scale-index 0 -o same.svg
cmp -s <(without_numbers one.svg) <(without_numbers same.svg) || fault "a scale by its file is another"
cp placed/scale-00.geojson foreign.geojson
try draw placed foreign.geojson -o two.svg --scale-index 0
expect_code 0
grep -q '<text.*>(b)</text>' two.svg || fault "no panel of a file of icons"
done_with "draw: panels"
"$program" synth saddle -o faster.vti --nodes 33
sed -i 's/Name="velocity"/Name="current"/' faster.vti
"$program" run faster.vti -o other --arrows 8 --effort 0 --nodes 65 --quiet >/dev/null 2>&1
refused() { # CODE PATTERN ARGUMENTS...
  try draw "${@:3}"
  expect_code "$1"
  expect_one_complaint
  expect_error "$2"
  expect_nothing_at x.svg
}
refused 1 'x.svg: other shows .*, and placed .*: panels show the same components' placed other -o x.svg
refused 1 'foreign.geojson: is of no run' foreign.geojson placed -o x.svg
refused 2 '--panel-label a|b|c: 3 labels, and there are 2 panels' placed run -o x.svg --panel-label 'a|b|c'
refused 2 '--columns: of several panels, and x.svg is one picture' placed -o x.svg --columns 2
refused 2 '--all-scales and --arrows each choose' placed -o x.svg --all-scales --arrows 5
refused 2 'are drawn as panels of a picture' placed run -o x.glb
refused 2 '--region: not with --projection none' placed -o x.svg --projection none --region 0,1,0,1
done_with "draw: panels that cannot be"

"$program" run "$root/data/gfs_20140131.nc" -o indian --region 40,110,-30,20 --arrows 6 --effort 0 \
  --formats svg --quiet >/dev/null 2>&1
# MAP... -- a parallel of the region, and one of the globe
for map in '--projection robinson' '--center 70' '--projection mercator --region 30,120,-40,30'; do
  try draw indian -o map.svg $map
  expect_code 0
  grep -q '<text.*>20°S</text>' map.svg || fault "$map: no 20°S"
  grep -q '<text.*>60°N</text>' map.svg && fault "$map: all of the globe"
done
try draw indian -o globe.svg --projection robinson --region=-180,180,-90,90
expect_code 0
grep -q '<text.*>60°N</text>' globe.svg || fault "not all of the globe"
try draw indian -o x.svg --projection +proj=moll --center 70
expect_code 1
expect_error 'it has a centre of its own'
grep -q -e --input err && fault "advice about a file"
done_with "draw: another map shows the run's region"

# data from 0 to 22 E, 30 to 48 N
write_netcdf '@dims = (["lat", 10], ["lon", 12]); my @n = (0 .. 119);
  @vars = (["lat", [0], 6, ["units", "degrees_north"], [map { 30 + 2 * $_ } 0 .. 9]],
           ["lon", [1], 6, ["units", "degrees_east"], [map { 2 * $_ } 0 .. 11]],
           ["u", [0, 1], 6, ["units", "m/s"], [map { 5 + $_ / 50 } @n]],
           ["v", [0, 1], 6, ["units", "m/s"], [map { sin($_ / 12) } @n]]);' >part.nc
"$program" run part.nc -o part --region=-30,50,10,70 --arrows 4 --effort 0 --formats svg --quiet >/dev/null 2>&1
"$program" run part.nc -o data --arrows 4 --effort 0 --formats svg --quiet >/dev/null 2>&1
try draw part -o part.svg --projection mercator
expect_code 0
try draw data -o data.svg --region=-30,50,10,70
expect_code 0
for picture in part/scale-00.svg part.svg data.svg; do
  grep -q '<text.*>20°N</text>' $picture || fault "$picture: no 20°N, which is in the region"
done
try draw data -o data.svg --projection mercator
grep -q '<text.*>20°N</text>' data.svg && fault "without a region: 20°N, where there are no data"
done_with "draw and run: a region is shown whole, whatever part of it has data"

try draw placed -o texts.svg --title 'A <title> of {arrows} & {time}' --subtitle 'below' --label 'fast' \
  --width 89mm --height 3in --font-size 2.5mm --speed-range 11,13
expect_code 0
grep -q 'width="252.28[0-9]*pt" height="216pt"' texts.svg || fault "the size is not 89mm by 3in"
for text in 'A &lt;title&gt; of 5 &amp;' below fast 11.0 13.0; do
  grep -q "<text.*>$text</text>" texts.svg || fault "no text '$text'"
done
try draw placed -o texts.png --dpi 300 --width 1in
expect_code 0
od -An -tu1 -j18 -N2 texts.png | grep -q '1  *44' || fault "an inch has not 300 pixels"
try draw placed -o shapes.svg --outline-text --no-keys --title '' --mask-color '#ff0000'
expect_code 0
grep -q '<text' shapes.svg && fault "--outline-text leaves texts"
done_with "draw: texts, sizes in units, colours and the colour key's ends as they are asked for"

try draw run -o x.svg --scale-index 5
expect_code 1
expect_one_complaint
try draw run -o x.svg --clusters 1
expect_code 1
expect_one_complaint
expect_nothing_at x.svg
done_with "draw: a scale that is not there"
try draw . -o x.svg
expect_code 1
expect_one_complaint
expect_error 'Name the folder of a finished'
echo '{"scales": 3}' >run.json
try draw . -o x.svg
expect_code 1
expect_one_complaint
echo '{"input":{"path":"synth:saddle"},"scales":[{"geojson":"../../etc/passwd"}]}' >run.json
try draw . -o x.svg
expect_code 1
expect_one_complaint
expect_nothing_at x.svg
done_with "draw: not the folder of a finished run"
cp -r run moved
rm moved/scale-00.geojson
try draw moved -o x.svg --scale-index 0
expect_code 1
expect_one_complaint
expect_nothing_at x.svg
done_with "draw: icons are missing"
for said in 'draw run -o no-such-folder/x.svg' 'synth saddle -o no-such-folder/x.vti'; do
  read -ra words <<<"$said"
  try "${words[@]}"
  expect_code 1
  expect_one_complaint
  expect_error "^flowgrain: ${words[3]}: .*No such file"
done
done_with "draw and synth: a folder that is not there"

for option in '--view 30,20' --surfaces; do
  for words in 'draw run -o x.svg' 'run synth:saddle -o x --nodes 65 --clusters 8'; do
    # shellcheck disable=SC2086
    try $words $option
    expect_code 2
    expect_one_complaint
    expect_error "^flowgrain: ${option%% *}: only in 3D, and (run|synth:saddle) is in 2D$"
    expect_nothing_at x.svg
    expect_nothing_at x
  done
done
try draw run -o x.glb
expect_code 2
expect_one_complaint
expect_error '^flowgrain: -o x.glb: only in 3D, and run is in 2D$'
expect_nothing_at x.glb
done_with "draw and run: what a picture in 2D can not show is refused"

for other in 'synth:vortex3d' 'other.vti' 'finer.vti'; do
  try synth saddle -o finer.vti --nodes 77
  printf '%s\n' '<VTKFile type="ImageData" version="1.0" byte_order="LittleEndian"><ImageData' \
    'WholeExtent="0 1 0 1 0 0" Origin="0 0 0" Spacing="1.5 1 1"><Piece Extent="0 1 0 1 0 0">' \
    '<PointData><DataArray type="Float32" Name="v" NumberOfComponents="3" format="ascii">' \
    '1 0 0 1 0 0 1 0 0 1 0 0</DataArray></PointData></Piece></ImageData></VTKFile>' >other.vti
  try draw run -o x.svg --input "$other"
  expect_code 1
  expect_one_complaint
  expect_error "$other"
  expect_nothing_at x.svg
done
try draw run -o x.svg --input synth:vortex --no-frame
expect_code 0
done_with "draw: an input with another grid is refused"

for end in vti nc; do
  try synth benard -o field.$end --nodes 33
  expect_code 0
  try info field.$end
  expect_code 0
  [ "$(grep -c '^vectors: ' out)" = 1 ] || fault "not one line vectors: $(cat out)"
  grep -q 'grid: 33 x 33' out || fault "$(cat out)"
  try info field.$end --json
  expect_code 0
  expect_json out '(.vectors | length) == 1 and .vectors[0].size == [33, 33]'
  expect_json out '.vectors[0].bounds == [0, 1, 0, 1]'
  done_with "synth and info: .$end"
  try run field.$end -o from-$end --nodes 65 --clusters 12 --quiet
  expect_code 0
  expect_json from-$end/run.json '.scales[0].icons > 0'
  done_with "run: .$end"
done
cmp -s from-vti/scale-00.geojson from-nc/scale-00.geojson || fault "icons differ"
done_with "the same field from two formats gives the same icons"

try info "$root/data/gfs_20140131.nc"
expect_code 0
grep -q '^vectors: u10,v10$' out || fault "$(cat out)"
grep -q 'scale: geo' out || fault "$(cat out)"
done_with "info: a global wind field"
printf '%s\n' '<VTKFile type="ImageData"><ImageData WholeExtent="0 1 0 1 0 0"><Piece' \
  'Extent="0 1 0 1 0 0"></Piece></ImageData></VTKFile>' >bare.vti
try info bare.vti
expect_code 1
expect_one_complaint
expect_error 'bare.vti: no vectors found'
done_with "info: no vectors"

# standard input, the format that is forced, and a bound of memory
cells=$root/data/convection_cells.nc
try info - < "$cells"
expect_code 0
sed -n '2,$p' out > given
try info "$cells"
sed -n '2,$p' out | cmp -s - given || fault "standard input is another file"
try rival - -o given.geojson --icons 20 < "$cells"
expect_code 0
try rival "$cells" -o named.geojson --icons 20
cmp -s given.geojson named.geojson || fault "other arrows from standard input"
try info - < /dev/null
expect_error "standard input: is empty"
try info - --format vtk-xml < "$cells"
expect_error "standard input: line 1: not XML"
try info "$cells" --format speech
expect_error "no format is called \"speech\""
try rival - -o no.geojson --max-memory 100K < "$cells"
expect_error "standard input: more than 102400 bytes"
if [ -z "$sanitized" ]; then # without an end, and a gigabyte of memory
  try info - < /dev/zero
  expect_code 1
  expect_one_complaint
  expect_error "standard input: more than 1073741824 bytes"
fi
try rival "$cells" -o no.geojson --max-memory 100K
expect_error "a field of 18721 samples takes 0.14"
expect_nothing_at no.geojson
try run - -o piped --arrows 5 --effort 0 --nodes 65 --formats svg --quiet < "$cells"
expect_code 0
try draw piped -o again.svg
expect_error "its input was standard input, which is gone"
try draw piped -o again.svg --input - < "$cells"
expect_code 0
done_with "standard input, format and memory"
try info no-such-file.nc
expect_code 1
expect_one_complaint
expect_error 'no-such-file.nc'
done_with "info: no such file"
finish
