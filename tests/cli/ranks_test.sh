#!/usr/bin/env bash
# The program on several ranks: the results of one, and one message when something fails.
source "$(dirname "$0")/harness.sh"

need_ranks

# All but what a run took of time.
expect_same_results() {
  local name
  [ "$(ls -A "$1")" = "$(ls -A "$2")" ] || fault "$2 holds $(ls -A "$2" | tr '\n' ' ')"
  for name in $(ls -A "$1"); do
    case $name in
    evolution.csv) same_tables "$1/$name" "$2/$name" ;;
    run.json) same_reports "$1/$name" "$2/$name" ;;
    *) cmp -s "$1/$name" "$2/$name" ;;
    esac || fault "$2/$name differs"
  done
}

wind=$root/data/gfs_20140131.nc
# compare NAME RANKS ARGUMENTS...: one rank on its own, and each number in RANKS.
compare() {
  local name=$1 counts=$2
  shift 2
  try run "$@" -o "$name-1" --quiet --no-frame
  expect_code 0
  mv out out-1
  mv err err-1
  for ranks in $counts; do
    on $ranks run "$@" -o "$name-$ranks" --quiet --no-frame
    expect_code 0
    cmp -s err err-1 || fault "$ranks ranks say: $(head -c 200 err)"
    [ "$(wc -l <out)" = "$(wc -l <out-1)" ] || fault "standard output: $(head -c 200 out)"
    expect_same_results "$name-1" "$name-$ranks"
  done
  done_with "ranks agree, 1 $counts: $name"
}
compare wind "3" "$wind" --projection none --nodes 65 --clusters 20 --formats svg --save-field
# where the wind blows from the west: in many parts, and round the globe
compare masked "4" "$wind" --projection none --mask u10 --nodes 97 --clusters 60 --formats svg --save-field
expect_json masked-1/run.json '.mesh | .active_cells < 0.4 * .cells[0] * .cells[1]'
done_with "less than 40 % of the globe is in the mask"
compare vortex3 "2" synth:vortex3 --nodes 65 --clusters 20,10 --formats svg --save-field --tint
compare halved "3" synth:vortex3 --nodes 513 --clusters 60 --formats svg --save-field
expect_json halved-3/run.json '.mesh.coarser | length == 1'
done_with "the mesh of three ranks was halved"
compare vortex3d "4" synth:vortex3d --nodes 33 --clusters 15 --width 60
compare placed "2" "$wind" --nodes 65 --arrows 9,5 --effort 0 --formats svg --tint --save-field
compare placed3d "2" synth:vortex3d --nodes 17 --arrows 6 --effort 0 --width 60
compare background "2" synth:benard --nodes 65 --clusters 8 --formats svg --background lic --width 100
compare tiny "4" synth:vortex3 --nodes 17 --clusters 3 --max-steps 60 --formats svg

# files of which each rank reads its rows: packed blocks, and a volume
try synth vortex3 -o rolls.vti --nodes 113
expect_code 0
compare image "4" rolls.vti --nodes 65 --clusters 20,10 --formats svg --save-field
try synth abc -o space.nc --nodes 33
expect_code 0
compare space "3" space.nc --nodes 33 --clusters 30 --width 60

# damage where one rank alone reads
size=$(stat -c %s rolls.vti)
printf 'damage' | dd of=rolls.vti bs=1 seek=$((size - 4000)) conv=notrunc status=none
try run rolls.vti -o none --nodes 33 --quiet
expect_code 1
sed '/^flowgrain/!d' err >err-1
on 4 run rolls.vti -o none --nodes 33 --quiet
expect_code 1
expect_one_message
cmp -s <(sed '/^flowgrain/!d' err) err-1 || fault "ranks say: $(head -c 300 err)"
expect_nothing_at none
done_with "a file that is damaged in the rows of one rank"

expect_json vortex3-1/run.json '.traffic.ranks == 1 and .traffic.cycle.messages.most == 0'
expect_json vortex3-2/run.json '.traffic.ranks == 2 and
  .traffic.cycle.messages.mean > 1 and .traffic.cycle.bytes.most > 100 and
  .traffic.step.reductions.mean > 0 and .traffic.snapshot.times == (.scales | length)'
on 2 run synth:vortex3 --nodes 33 --clusters 8 --formats svg -o told -v
expect_code 0
grep -q '^flowgrain: cycle ([0-9]*): exchanges [0-9.]* ([0-9.]*) messages' err ||
  fault "nothing said of cycles: $(head -c 600 err)"
done_with "what ranks told each other is counted"

# the globe's 8 rows of cells make two blocks of four
on 3 run "$wind" -o none --nodes 17 --quiet
expect_code 1
expect_one_message
expect_error '2 ranks fit'
expect_nothing_at none
done_with "more ranks than the mesh has blocks for"

on 2 run no-such.nc -o none
expect_code 1
expect_one_message
expect_error 'no-such.nc'
expect_nothing_at none
done_with "an input that no rank can read"

# one_differs RANK1_ARGUMENTS...: rank 1 of 2 has a command line of its own.
good=(synth:vortex3 -o none --nodes 33 --quiet)
one_differs() {
  timeout 300 mpirun -n 1 "$program" run "${good[@]}" : -n 1 "$program" "$@" >out 2>err
  code=$?
  expect_code "$expected"
  expect_one_message
  expect_nothing_at none
}
expected=1
one_differs run no-such.nc -o none
expect_error 'no-such.nc'
done_with "an input that one rank can not read"

one_differs run synth:vortex3 -o none --nodes 65
expect_error 'ranks have different'
one_differs run synth:vortex -o none --nodes 33
expect_error 'ranks have different'
done_with "ranks with different options or fields"

expected=2
one_differs run synth:vortex3 -o none --bogus
expect_error 'bogus'
done_with "an option that one rank does not know"

on 2 run synth:vortex3 -o none --nodes many
expect_code 2
expect_one_message
expect_error 'nodes many'
[ "$(grep -c "^Try " err)" = 1 ] || fault "advice: $(head -c 400 err)"
done_with "an option that none knows"

on 2 run --help
expect_code 0
"$program" run --help | cmp -s - out || fault "help differs"
on 2 synth vortex3 -o field.nc --nodes 17
expect_code 0
expect_file field.nc
done_with "what needs one rank is done by one"

# a limit on the size of files makes writes fail as a full disk does, and shared memory
timeout 300 mpirun -n 2 --mca btl self,tcp bash -c 'trap "" XFSZ; ulimit -f 4; exec "$@"' limited \
  "$program" run synth:vortex3 -o full/run --nodes 65 --clusters 12,11 --quiet >out 2>err
code=$?
expect_code 1
expect_one_message
expect_nothing_at full
done_with "rank 0 can not write"

mkdir held
echo '{}' >held/run.json
on 2 run synth:vortex3 -o held --nodes 33 --quiet
expect_code 1
expect_one_message
expect_error 'no run of flowgrain'
done_with "rank 0 must not write"

# Memory for the libraries and a small mesh, not for a large one.
timeout 300 mpirun -n 1 "$program" run synth:vortex3 -o none --nodes 2049 --max-steps 1 --quiet : \
  -n 1 bash -c 'ulimit -v 400000; exec "$@"' limited \
  "$program" run synth:vortex3 -o none --nodes 2049 --max-steps 1 --quiet >out 2>err
code=$?
expect_code 1
expect_one_message
expect_error 'memory'
expect_nothing_at none
done_with "one rank is out of memory"

# interrupt WHOM FOLDER GRACE: to a rank or to mpirun, once the first scale is on its way.
# mpirun passes on its end after GRACE seconds, and waits as long again before it kills.
interrupt() {
  env --default-signal=INT mpirun -n 2 --mca odls_base_sigkill_timeout "$3" \
    "$program" run synth:vortex3 -o "$2" --nodes 193 --scheme theta --clusters 1000,2 \
    --quiet >out 2>err &
  local mpirun=$! target=$! pid
  until_there "$2/.flowgrain/scale-00.geojson" $mpirun
  if [ "$1" = rank ]; then
    for pid in $(pgrep -P $mpirun); do
      tr '\0' '\n' <"/proc/$pid/environ" | grep -qx 'OMPI_COMM_WORLD_RANK=1' && target=$pid
    done
    [ "$target" != $mpirun ] || fault "rank 1 is not found"
  fi
  kill -INT "$target"
  wait_at_most 60 $mpirun
  code=$?
}
interrupt rank stopped 1
expect_code 130
expect_one_message
expect_error 'interrupted'
expect_json stopped/run.json '.ended == "interrupted" and (.scales | length) >= 1'
expect_file stopped/scale-00.svg
expect_file stopped/.flowgrain/checkpoint
done_with "an interrupt of one rank stops all"

# where much else is running, two ranks may need longer to end than mpirun usually waits
interrupt launcher ended 5
[ "$code" != 0 ] || fault "exit code 0"
expect_json ended/run.json '.ended == "interrupted" and (.scales | length) >= 1'
expect_file ended/.flowgrain/checkpoint
done_with "an interrupt of mpirun stops all"
finish
