#!/usr/bin/env bash
# Checkpoints of several ranks: whatever ends a run, it goes on on any number of ranks to
# the results of one that was never ended; one message, and no rank is left waiting.
source "$(dirname "$0")/harness.sh"
need_ranks

run=(run synth:vortex3 --nodes 65 --clusters 15,10 --formats svg --quiet --checkpoint 0)
try "${run[@]}" -o whole
expect_code 0
most=$(($(jq .steps.accepted whole/run.json) - 3)) # after which it can go on

# goes_on FOLDER RANKS [WHOLE]: it is resumed, and ends as it should.
goes_on() {
  if [ "$2" = 1 ]; then
    try "${run[@]}" -o "$1" --resume
  else
    on "$2" "${run[@]}" -o "$1" --resume
  fi
  [ "$code" = 0 ] || fault "$1 on $2 ranks: code $code: $(head -c 300 err)"
  expect_same_results "${3:-whole}" "$1"
  expect_only_results "$1"
}

: "${FILE_CALLS:?is to name libfile_calls.so, as ctest does}"

# one_other RANK RANKS WRAPPER... -- ARGUMENTS...: as on, but that rank is begun by a wrapper.
one_other() {
  local which=$1 ranks=$2 rank command=() wrapper=()
  shift 2
  while [ "$1" != -- ]; do
    wrapper+=("$1")
    shift
  done
  shift
  for rank in $(seq 0 $((ranks - 1))); do
    [ "$rank" = 0 ] || command+=(:)
    command+=(-n 1)
    [ "$rank" != "$which" ] || command+=("${wrapper[@]}")
    command+=("$program" "$@")
  done
  timeout 300 mpirun "${command[@]}" >out 2>err
  code=$?
}

# values_of FOLDER: arrays and table of its checkpoint. The text tells times that passed.
values_of() {
  local file=$1/.flowgrain/checkpoint text length
  read -r text length < <(od -A n -t u8 -j 24 -N 16 "$file")
  head -c "$text" "$file" | tail -c +65
  tail -c +$((text + length + 1)) "$file"
}
try "${run[@]}" -o part-1 --max-steps "$most"
expect_code 0
for ranks in 2 3 4; do
  on $ranks "${run[@]}" -o "part-$ranks" --max-steps "$most"
  expect_code 0
done
[ "$(values_of part-1 | wc -c)" -gt 50000 ] || fault "no values"
for ranks in 2 3 4; do
  cmp -s <(values_of part-1) <(values_of part-$ranks) || fault "$ranks ranks write others"
done
goes_on part-1 4
goes_on part-4 1
goes_on part-3 2
goes_on part-2 3
done_with "1 to 4 ranks write one checkpoint, and each reads it"

"$program" synth vortex3 -o field.nc --nodes 20
gone=(run field.nc --nodes 33 --clusters 5 --formats svg --quiet -o gone)
try "${gone[@]}"
expect_code 0
rm field.nc
on 3 "${gone[@]}" --resume
expect_code 0
expect_one_message
expect_error 'gone: the run is finished'
done_with "a finished run does without its input on any number of ranks"

# killed FOLDER RANKS WHOM: started or resumed, and killed at a random moment.
small=("${run[@]}")
medium=(run synth:vortex3 --nodes 257 --clusters 30,4 --formats svg --quiet --checkpoint 0)
run=("${medium[@]}")
try "${run[@]}" -o whole2
killed() {
  mpirun -n "$2" "$program" "${run[@]}" -o "$1" --resume >out 2>err &
  local mpirun=$! rank
  until_there "$1/.flowgrain/checkpoint" $mpirun
  # a rank that begins once its launcher was killed would run on
  until [ "$(pgrep -c -P $mpirun)" -ge "$2" ] || ! kill -0 $mpirun 2>/dev/null; do
    sleep 0.02
  done
  sleep "$(printf '0.%02d' $((RANDOM % 15)))" # on idle cores it runs for 0.4 s
  local ranks
  ranks=$(pgrep -P $mpirun)
  # shellcheck disable=SC2086
  case $3 in
  all) kill -KILL $ranks $mpirun ;;
  launcher) kill -KILL $mpirun ;;
  one) for rank in $ranks; do kill -KILL "$rank" && break; done ;;
  esac 2>/dev/null
  wait_at_most 10 $mpirun
  for rank in $ranks; do # what is left of them still holds the lock
    for _ in $(seq 2400); do
      kill -0 "$rank" 2>/dev/null || break
      sleep 0.05
    done
    kill -0 "$rank" 2>/dev/null && fault "$3: rank $rank lives on"
  done
  forget_launchers
}
killed often 3 all
expect_file often/.flowgrain/checkpoint
killed often 2 one
killed often 4 launcher
goes_on often 1 whole2
run=("${small[@]}")
done_with "killed at random moments, and resumed on other numbers of ranks"

# at a call that changes files, of one rank alone
for turn in "0 3 300 2" "1 2 77 3" "2 3 100 1"; do
  read -r rank ranks call others <<<"$turn"
  rm -rf part
  one_other "$rank" "$ranks" env FILE_CALLS_DO=kill FILE_CALLS_AT="$call" LD_PRELOAD="$FILE_CALLS" \
    -- "${run[@]}" -o part
  case $code in
  0 | 124) fault "rank $rank at call $call: code $code" ;;
  esac
  forget_launchers
  goes_on part "$others"
done
done_with "one rank is killed in writing"

# full RANK RANKS CALL ARGUMENTS...: from that call of the rank on its disk is full.
full() {
  local rank=$1 ranks=$2 call=$3
  shift 3
  one_other "$rank" "$ranks" env FILE_CALLS_DO=full FILE_CALLS_AT="$call" LD_PRELOAD="$FILE_CALLS" \
    -- "$@"
}
full 1 2 100 "${run[@]}" -o full
expect_code 0
expect_one_message
expect_error 'full/.flowgrain/checkpoint: cannot be written: No space left on device; the checkpoint of step [0-9]+ stays'
expect_same_results whole full
expect_only_results full
done_with "a rank whose disk is full is one warning, and the run goes on without"

full 1 2 40 "${run[@]}" -o full2 --max-steps "$most"
expect_code 0
last=$(grep -oE 'the checkpoint of step [0-9]+' err | grep -oE '[0-9]+$')
kept=$(grep -a -oP '^stepper.accepted \K[0-9]+' full2/.flowgrain/checkpoint)
[ "$kept" = "$last" ] || fault "step $kept is kept, step $last was said"
[ "$kept" -lt "$most" ] || fault "step $kept is kept"
expect_nothing_at full2/.flowgrain/checkpoint.part
goes_on full2 1
full 0 2 120 "${run[@]}" -o full3
expect_code 1
expect_error 'No space left on device'
[ "$(grep -c '^flowgrain: ' err)" -le 2 ] || fault "more than two lines: $(head -c 300 err)"
goes_on full3 3
done_with "the last checkpoint before a full disk stays good"

# refused WORDS: resuming fails with one message, and the checkpoints stay.
on 2 "${run[@]}" -o part --max-steps "$most" --force
expect_code 0
cp -r part start
before=$(cat part/.flowgrain/checkpoint* | cksum)
refused() {
  expect_code 1
  expect_one_message
  expect_error "$1"
  [ "$(cat part/.flowgrain/checkpoint* | cksum)" = "$before" ] || fault "checkpoints changed"
}
mkdir elsewhere
one_other 1 3 env -C elsewhere -- "${run[@]}" -o part --resume
refused 'part/.flowgrain/checkpoint: cannot be read: No such file'
done_with "a rank that can not read the checkpoint"

timeout 300 mpirun -n 1 "$program" "${run[@]}" -o part --resume : \
  -n 1 "$program" "${run[@]}" -o part --resume --palette '#102030' >out 2>err
code=$?
refused 'was begun without --palette; this command goes with --palette #102030'
done_with "a rank that is told another option"

# what a process takes before MPI starts, and less than that needs
one_other 1 2 bash -c 'ulimit -v 280000; exec "$@"' limited -- "${run[@]}" -o part --resume
refused 'out of memory: [0-9]+ bytes for the start of MPI'
goes_on part 1
done_with "a rank without the memory to start"

large=(run synth:vortex3 --nodes 1281 --quiet --checkpoint 0 -o large)
try "${large[@]}" --max-steps 2
rm -rf part
mv large part
before=$(cat part/.flowgrain/checkpoint* | cksum)
one_other 1 2 bash -c 'ulimit -v 310000; exec "$@"' limited -- \
  "${large[@]}" -o part --resume --max-steps 3
refused 'out of memory: [0-9]+ bytes for'
rm -rf part
done_with "a rank that is out of memory when it resumes"

# spoil FILE: a byte in the midst of the values.
spoil() {
  printf 'x' | dd of="$1" bs=1 seek=20001 conv=notrunc status=none
}
cp -r start part
spoil part/.flowgrain/checkpoint
on 2 "${run[@]}" -o part --resume
expect_code 0
expect_one_message
expect_error 'checkpoint: damaged: the checksum .*; the previous checkpoint is used$'
expect_same_results whole part
cp -r start part2
spoil part2/.flowgrain/checkpoint
spoil part2/.flowgrain/checkpoint.previous
on 2 "${run[@]}" -o part2 --resume
expect_code 1
expect_one_message
expect_error 'part2/.flowgrain/checkpoint: damaged: the checksum'
done_with "a damaged checkpoint is refused, and the previous one used"

one_other 0 3 env --default-signal=INT,TERM FILE_CALLS_DO=TERM FILE_CALLS_AT=90 \
  LD_PRELOAD="$FILE_CALLS" -- "${run[@]}" -o stopped
expect_code 130
expect_one_message
expect_error 'interrupted at t = '
grep -q '^The same command with --resume goes on from step' err || fault "no advice"
goes_on stopped 4
run=("${medium[@]}") # the small one may end before the signal comes
env --default-signal=INT,TERM mpirun -n 3 "$program" "${run[@]}" -o ended >out 2>err &
mpirun=$!
until_there ended/.flowgrain/checkpoint $mpirun
kill -INT $mpirun
wait_at_most 60 $mpirun
code=$?
[ "$code" != 0 ] || fault "mpirun: code 0"
goes_on ended 1 whole2
run=("${small[@]}")
done_with "a signal leaves a checkpoint"
finish
