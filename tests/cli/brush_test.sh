#!/usr/bin/env bash
# brush: paintings of every format, the same every time, and what is refused.
source "$(dirname "$0")/harness.sh"

# a bright disc on a dark slope, 90 x 60, of 8 or of 16 bits a sample
disc() {
  awk -v factor="$1" 'BEGIN {
    print "P2\n90 60\n" 255 * factor
    for (j = 0; j < 60; ++j)
      for (i = 0; i < 90; ++i)
        print factor * ((i - 40) ^ 2 + (j - 25) ^ 2 < 300 ? 220 : 40 + i)
  }'
}
disc 1 >disc.pgm
disc 257 >deep.pgm

try brush disc.pgm -o one.png --clusters 100,30
expect_code 0
expect_file one.png
try brush disc.pgm -o two.png --clusters 100,30 --threads 1 --seed 1
expect_code 0
cmp -s one.png two.png || fault "another painting on one thread"
try brush deep.pgm -o two.png --clusters 100,30
expect_code 0
cmp -s one.png two.png || fault "another painting of 16 bits"
try brush disc.pgm -o two.png --clusters 100,30 --seed 2
expect_code 0
cmp -s one.png two.png && fault "the same painting with another seed"
try brush one.png -o two.png --clusters 40 --verbose
expect_code 0
expect_error '[0-9]+ strokes in 1 layers'
done_with "brush: a painting, and one of it"

try brush disc.pgm -o page.svg --clusters 40 --width 300
expect_code 0
xmllint --noout page.svg 2>/dev/null || fault "no XML"
grep -q 'width="300pt" height="200pt"' page.svg || fault "$(grep -m1 '<svg' page.svg)"
try brush disc.pgm -o page.pdf --clusters 40
expect_code 0
[ "$(head -c 5 page.pdf)" = %PDF- ] || fault "no PDF"
done_with "brush: SVG and PDF"

head -c 200 disc.pgm >short.pgm
head -c 300 one.png >short.png
echo GIF89a >image.gif
for bad in short.pgm short.png image.gif none.png .; do
  try brush $bad -o bad.png
  expect_code 1
  expect_one_complaint
  expect_nothing_at bad.png
  done_with "brush: $bad is refused"
done
for bad in "--clusters 40,300" "--clusters 0" "--anisotropy 1" "--kind lic" "--width 1"; do
  # shellcheck disable=SC2086
  try brush disc.pgm -o bad.png $bad
  expect_code 2
  expect_one_complaint
  expect_nothing_at bad.png
  done_with "brush: $bad is wrong usage"
done
try brush disc.pgm -o bad.gif
expect_code 2
expect_one_complaint
try brush disc.pgm
expect_code 2
expect_one_complaint
done_with "brush: no picture to write"
finish
