#!/usr/bin/env bash
# Wrong usage exits 2 and writes nothing; help and version exit 0.
source "$(dirname "$0")/harness.sh"

wrong() {
  local pattern=$1
  shift
  try "$@"
  expect_code 2
  expect_error "$pattern"
  expect_one_complaint
  [ ! -s out ] || fault "standard output is not empty"
  expect_nothing_at x
}

wrong 'command is missing'
done_with "no command"
wrong "unknown command 'paint'" paint a
done_with "unknown command"
wrong "unknown option '--frobnicate'" --frobnicate
done_with "unknown option before the command"
wrong 'INPUT is missing' run -o x
done_with "no operand"
wrong '-o is missing' run synth:vortex
done_with "no output"
wrong "one INPUT.*'b'" run a b -o x
done_with "two operands"
wrong 'unknown option --no-such' run a -o x --no-such
wrong 'unknown option --arows; is --arrows meant' run a -o x --arows 20
wrong '--no may be --no-page, --noise, --nodes, --no-arrows, --no-keys, --no-coast, --no-frame$' run a -o x --no
wrong "unknown command 'rum'; is 'run' meant" rum a
done_with "unknown long option"
wrong 'unknown option -z' run a -o x -z
done_with "unknown short option"
wrong 'scheme thta: not known; the choice is: bdf2, euler, theta' run a -o x --scheme thta
done_with "a word that is no choice"
wrong '--theta 0.5: a number in .0, 0.5. is needed' run a -o x --scheme theta --theta 0.5
wrong '--alpha 0.5: a number in .0.5, 1. is needed' run a -o x --scheme theta --alpha 0.5
wrong '--residual 1: a number in .0, 1. is needed' run a -o x --residual 1
wrong '--theta 0.2: only with --scheme theta' run a -o x --theta 0.2
wrong '--alpha 1: only with --scheme theta' run a -o x --scheme euler --alpha 1
done_with "a splitting or a residual out of range, or of another scheme"
wrong '--title: \{tiem\} stands for nothing; known: \{title\}, \{time\}, \{level\}, \{names\}, \{arrows\}$' run a -o x --title 'At {tiem}, {time}'
wrong '--subtitle: \{units\} stands for nothing' texture a -o x.png --subtitle '{units}'
wrong '--label: \{unit\} stands for nothing; known: \{units\}$' rival a -o x.geojson --label '{unit}'
wrong '--panel-label: \{a\} stands for nothing; known: \{letter\}, ' draw a -o x.svg --panel-label '{letter}|{a}'
done_with "words in braces that stand for nothing"
try run synth:vortex -o braces --title '10^{-2} {arrows} {} { }' --arrows 9 --formats svg --no-page
expect_code 0
grep -qF '10^{-2} 9 {} { }' braces/scale-00.svg || fault "other braces are not drawn as they are"
done_with "other braces are text"
wrong '--region: not with --projection none, which draws all of the degrees' run a -o x --projection none --region 0,9,0,9
wrong 'say one' run a -o x --resume --force
done_with "--resume and --force exclude each other"
wrong 'checkpoint -1: a number in .0, 1e.09.' run a -o x --checkpoint -1
done_with "seconds between checkpoints are not negative"
FLOWGRAIN_KERNEL=bogus try run synth:vortex -o x
expect_code 1
expect_error 'FLOWGRAIN_KERNEL=bogus: generic, avx2 and avx512 are known'
expect_nothing_at x
done_with "vector instructions that nobody knows"
wrong '--nodes.*missing' run a -o x --nodes
done_with "missing argument"
wrong '^flowgrain: -o: its DIR is missing$' run a -o
wrong '^flowgrain: --output: its PICTURE is missing$' draw a --output
wrong '^flowgrain: -o: its FILE is empty$' synth vortex -o ''
wrong '^flowgrain: --output: its DIR is empty$' run a --output=
done_with "an option is named as it was typed"
wrong '--force.*no argument' run a -o x --force=yes
done_with "argument that is not taken"
wrong 'mesh adapted: not known; .*: auto, adaptive, uniform$' run a -o x --mesh adapted
done_with "a mesh of another kind is refused with those that there are"
for bad in "--nodes 3" "--nodes 100000" "--nodes 1e2" "--nodes= 65" "--anisotropy 0" \
  "--anisotropy 1.5" "--anisotropy nan" "--coverage 1" "--coverage 0" "--gamma -1" \
  "--gamma inf" "--noise 0" "--isotropic-below 0" "--isotropic-below -1" "--noise -1" "--noise 5.5" "--noise nan" "--seed 0" "--seed -1" "--seed 99999999999999999999" "--max-time 0" \
  "--max-steps 0" "--threads 0" "--clusters 10,20" "--clusters 20,,10" "--clusters 5,5" \
  "--clusters 0" "--clusters abc" "--formats gif" "--formats svg," "--scale polar" \
  "--mesh adapted" "--energy uphill" "--time -1" "--width 3" "--palette no-such-map" \
  "--palette #12345" "--vars=" "--width 89furlong" "--height 1mm" "--dpi 5" "--font-size -1" \
  "--speed-range 5" "--speed-range 5,5" "--speed-range 1,nan" "--mask-color red" "--tint-color #000000" \
  "--background-fade 0.5" "--no-frame --title x"; do
  # shellcheck disable=SC2086
  wrong "^flowgrain: --" run synth:vortex -o x $bad
  done_with "run $bad"
done
wrong 'isotropic-below 2: only with --energy flow' run a -o x --energy gradient --isotropic-below 2
wrong 'anisotropy 0.5: not with --energy isotropic' run a -o x --energy isotropic --anisotropy 0.5
wrong '--scale-index and --clusters' draw a -o x.svg --scale-index 0 --clusters 9
for words in "--view 30,20" "--width 60" --no-frame --transparent; do
  # shellcheck disable=SC2086
  wrong "^flowgrain: ${words%% *}: only in a picture, and x.glb is none$" draw a -o x.glb $words
done
wrong '^flowgrain: --palette: only in a picture, and x.vtp is none$' draw a -o x.vtp --palette deep
done_with "options that do not fit others are refused"
wrong '\.svg, \.pdf or \.png' draw a -o picture.gif
done_with "draw: unknown picture format"
wrong 'analytic field' synth nosuch -o x.vti
done_with "synth: unknown name"
wrong '\.vti or \.nc' synth vortex -o x.dat
done_with "synth: unknown format"

# before anything is read: what the inputs lack is not what is said
mkdir folder.png
for words in "draw a -o no/x.png" "draw a -o no/x.glb" "texture a -o no/x.png" \
  "brush a -o no/x.svg" "synth vortex -o no/x.vti" "rival a -o no/x.geojson"; do
  # shellcheck disable=SC2086
  try $words
  expect_code 1
  expect_error "^flowgrain: ${words##* }: cannot be written: No such file"
  expect_error "Make the folder no first"
  expect_one_complaint
  done_with "$words: a folder that is not there is said at once"
done
try texture a -o folder.png
expect_code 1
expect_error '^flowgrain: folder.png: cannot be written: Is a directory$'
done_with "a folder is no place for a picture"
try info folder.png
expect_code 1
expect_error '^Name one file in it\.$'
done_with "the library's hints are sentences"
try draw folder.png -o x.png
expect_code 1
expect_error "^Name the folder of a finished"
expect_one_complaint
done_with "draw: a folder that holds no run"

try --help
expect_code 0
[ "$(grep -c '^  run  ' out)" -ge 1 ] || fault "run is not listed"
done_with "--help"
try help draw
expect_code 0
cmp -s out <("$program" draw --help) || fault "not draw's help: $(head -1 out)"
done_with "help COMMAND"
wrong "unknown command 'drew'" help drew
done_with "help of an unknown command"
wrong "one COMMAND is expected, and 'run' is one more" help draw run
done_with "help of two commands"
try --version
expect_code 0
grep -qE '^flowgrain [0-9]+\.[0-9]+\.[0-9]+$' out || fault "$(cat out)"
grep -qE '^with(out)? [a-z]+(, [a-z]+)*$' out || fault "no features: $(cat out)"
done_with "--version"
for command in run view draw info synth; do
  try "$command" --help
  expect_code 0
  grep -q "^Usage: flowgrain $command" out || fault "no usage line"
  [ "$(awk 'length > 80' out)" = "" ] || fault "a line is longer than 80 columns"
  done_with "$command --help"
done

"$program" --help >/dev/full 2>err
code=$?
expect_code 1
expect_error 'standard output'
done_with "a full disk under standard output is noticed"
"$program" info --help >&- 2>err
code=$?
expect_code 1
done_with "a closed standard output is noticed"
# names with ESC, the 8-bit CSI as UTF-8 and alone, and a letter that stays
escape=$'\033[31m' csi=$'\302\2331m' byte=$'\2331m'
cat >names.vtk <<END
# vtk DataFile Version 3.0
x
ASCII
DATASET STRUCTURED_POINTS
DIMENSIONS 3 2 1
ORIGIN 0 0 0
SPACING 1 1 1
POINT_DATA 6
VECTORS é${escape}${csi}${byte} float
1 2 0 1 3 0 1 4 0 1 5 0 2 1 0 2 2 0
END
try info names.vtk
expect_code 0
LC_ALL=C grep -q $'[\001-\010\016-\037\177]\|\2331' out && fault "control characters: $(cat -v out)"
grep -q '^vectors: é?\[31m??1m??1m$' out || fault "$(cat -v out)"
try run names.vtk -o x --vars "a$escape,b"
expect_code 1
expect_error 'a\?\[31m'
LC_ALL=C grep -q $'[\001-\010\016-\037\177]' err && fault "control characters: $(cat -v err)"
done_with "control characters of names stay off the terminal"

finish
