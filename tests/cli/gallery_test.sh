#!/usr/bin/env bash
# The gallery: every figure is made, and the page shows what is there.
source "$(dirname "$0")/harness.sh"

# the data of this program, but a small picture to be painted
mkdir data
cp "$root"/data/*.nc data
try texture synth:vortex3 -o data/monalisa.png --pixels 64
FLOWGRAIN_DATA=$PWD/data try gallery -o all --quiet
expect_code 0
[ ! -s err ] || fault "it said: $(head -c 300 err)"
expect_file all/index.html
shown=$(grep -o 'src="[^"]*"' all/index.html | sed 's/src="//; s/"//' | sort -u)
[ "$(wc -l <<<"$shown")" -ge 4 ] || fault "few pictures: $shown"
for picture in $shown; do
  expect_file "all/$picture"
done
for number in {1..13}; do
  grep -Eq "<h2[^>]*>Figures? ($number|[0-9]+ and $number|$number and [0-9]+)\\. " all/index.html ||
    fault "figure $number of the paper is missing"
done
! grep -q "$work" all/index.html || fault "the page names a folder of this machine"
done_with "all figures are made and shown"

try gallery -o all --quiet
expect_code 1
expect_one_complaint
expect_error 'holds a gallery already'
echo mine >all/notes.txt
echo old >all/index.html
cp all/fig-06/arrows/scale-00.geojson before
touch -d 2001-01-01 all/fig-*.png all/monalisa.png
try gallery -o all --quiet --force --figure 6
expect_code 0
[ "$(cat all/notes.txt)" = mine ] || fault "a foreign file has changed"
grep -q '<h2[^>]*>Figures 5 and 6' all/index.html || fault "the page does not show figure 6"
! grep -q 'Figure 3' all/index.html || fault "the page shows another figure"
[ -z "$(find all -name 'fig-0[124]*.png' -newermt 2002-01-01)" ] || fault "another figure was made"
cmp -s before all/fig-06/arrows/scale-00.geojson || fault "other arrows"
# without that folder the program's own data are found
cmp -s "$root/data/monalisa.png" all/monalisa.png || fault "the data are not the program's"
done_with "a gallery is replaced only when asked for, and figures one by one"

for picture in $(grep -o 'src="[^"]*"' all/index.html | sed 's/src="//; s/"//'); do
  expect_file "all/$picture"
done
cmp -s all/fig-06/clusters/scale-00.geojson all/fig-06/arrows/scale-00.geojson ||
  fault "clusters and arrows of different moments"
rows=$(grep -c '<div class="row' all/index.html)
[ "$rows" = 2 ] || fault "$rows rows of pictures instead of 2"
done_with "figures that the paper has apart are made together"

# the commands on the page make the pictures again
sed -n '/<pre>/,/<\/pre>/p' all/index.html | sed 's/<[^>]*>//g' | grep '^flowgrain ' >commands
mkdir again
(cd again && while read -r _ words; do
  # shellcheck disable=SC2086
  "$program" $words >/dev/null 2>&1 || exit 1
done <../commands) || fault "a command of the page failed: $(cat commands)"
for picture in $(grep -o 'src="[^"]*png"' all/index.html | sed 's/src="//; s/"//'); do
  cmp -s "all/$picture" "again/$picture" || fault "$picture differs"
done
done_with "the commands that the page names make the same pictures"

try gallery -o none --figure 5000
expect_code 2
try gallery -o none --figure 55
expect_code 2
expect_one_complaint
expect_nothing_at none
FLOWGRAIN_DATA=/no/such/folder try gallery -o none --quiet
expect_code 1
expect_one_complaint
expect_error '/no/such/folder'
expect_nothing_at none
: >file
try gallery -o file --quiet
expect_code 1
expect_one_complaint
expect_error '^flowgrain: file: is a file, a folder is needed'
try gallery anything -o none
expect_code 2
expect_one_complaint
done_with "wrong usage and missing data are told"

finish
