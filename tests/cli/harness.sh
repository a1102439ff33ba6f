# Sourced by the tests of the program: runs it, checks what came, reports in TAP.
# shellcheck shell=bash
set -u
program=$1
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
# in memory where there is room: to bring results and checkpoints to a disk takes longer than the runs
if [ -w /dev/shm ] && [ "$(df --output=avail /dev/shm 2>/dev/null | tail -n 1)" -gt 1000000 ]; then
  export TMPDIR=/dev/shm
fi
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work" || exit 1
case_number=0
any_failed=0
complaint=
# sanitizers look for misuse of memory on each way through the program: one turn will do
sanitized=
! ldd "$program" | grep -q libasan || sanitized=yes

# try ARGUMENTS...: runs the program; sets code, out and err (files).
try() {
  "$program" "$@" >out 2>err
  code=$?
}

# write_netcdf CODE ARGUMENTS...: a classic NetCDF file on standard output. CODE is Perl and
# sets @dims, of [name, size], and @vars, of [name, [dimensions], type (5: float, 6: double),
# [attribute, text, ...], [values]].
write_netcdf() {
  perl -e '
    our (@dims, @vars);
    eval shift; die $@ if $@;
    sub name { my $n = shift; pack("N a*", length $n, $n) . "\0" x (-length($n) % 4) }
    my ($head, $data, $at) = ("", "", 0);
    for my $pass (0, 1) {
      my $begin = $pass * $at;
      ($head, $data) = ("CDF\1" . pack("N N N", 0, 10, scalar @dims), "");
      $head .= name($_->[0]) . pack("N", $_->[1]) for @dims;
      $head .= pack("N N N N", 0, 0, 11, scalar @vars);
      for (@vars) {
        my ($n, $d, $type, $attributes, $v) = @$_;
        my @attributes = @$attributes;
        my $bytes = pack($type == 5 ? "f>*" : "d>*", @$v);
        $head .= name($n) . pack("N*", scalar @$d, @$d) . pack("N N", @attributes ? 12 : 0, @attributes / 2);
        $head .= name(shift @attributes) . pack("N", 2) . name(shift @attributes) while @attributes;
        $head .= pack("N N N", $type, length $bytes, $begin + length $data);
        $data .= $bytes;
      }
      $at = length $head;
    }
    binmode STDOUT;
    print $head, $data;' "$@"
}

# Each check records the first fault of a case.
fault() {
  [ -n "$complaint" ] || complaint=$*
}

expect_code() {
  [ "$code" = "$1" ] || fault "exit code $code, not $1: $(head -c 2000 err)"
}

expect_error() {
  grep -qE -- "$1" err || fault "standard error does not match '$1': $(head -c 300 err)"
}

# One line that begins with the program's name, and at most one more.
expect_one_complaint() {
  local line lines=0 complaints=0
  while IFS= read -r line; do
    lines=$((lines + 1))
    [[ $line != 'flowgrain: '* ]] || complaints=$((complaints + 1))
  done <err
  [ "$complaints" = 1 ] || fault "not one complaint: $(head -c 300 err)"
  [ "$lines" -le 2 ] || fault "more than two lines: $(head -c 300 err)"
}

expect_nothing_at() {
  [ ! -e "$1" ] || fault "$1 is there: $(ls -A "$1")"
}

expect_file() {
  [ -s "$1" ] || fault "$1 is missing or empty"
}

# expect_json FILE FILTER: jq's filter is true of the file.
expect_json() {
  [ "$(jq -r "$2" "$1" 2>&1)" = true ] || fault "$1: not true: $2 ($(jq -c "$2" "$1" 2>&1 | head -c 200))"
}

# Cairo numbers the surfaces that a process has made.
without_numbers() {
  sed -E 's/surface[0-9]+/surface/g' "$1"
}

# same_tables FILE FILE: of evolution.csv, but for the time that steps took.
same_tables() {
  awk -F, '
    FNR == 1 { ++file }
    { row = $1; for (n = 2; n <= 11; ++n) row = row "," $n }
    file == 1 { first[rows = FNR] = row; next }
    first[FNR] != row { exit differs = 1 }
    END { exit differs || file != 2 || FNR != rows }' "$1" "$2"
}

# same_reports FILE FILE: of run.json, but for the time that the run took, and what ranks told
# each other.
same_reports() {
  jq -es 'map(del(.seconds, .traffic)) | length == 2 and .[0] == .[1]' "$1" "$2" >/dev/null 2>&1
}

# The results of two runs are the same but for that. Hundreds of them are compared, and each
# process that is started takes its time.
expect_same_results() {
  local path name
  for path in "$1"/scale-*; do
    name=${path##*/}
    cmp -s "$path" "$2/$name" || cmp -s <(without_numbers "$path") <(without_numbers "$2/$name") ||
      fault "$name differs between $1 and $2"
  done
  for path in "$2"/scale-*; do
    [ -e "$1/${path##*/}" ] || fault "$path is in $2 alone"
  done
  same_tables "$1/evolution.csv" "$2/evolution.csv" || fault "evolution.csv differs between $1 and $2"
  same_reports "$1/run.json" "$2/run.json" || fault "run.json differs between $1 and $2"
}

# Nothing is left in a folder but results.
expect_only_results() {
  local path results='^(scale-[0-9]{2}(-[0-9])?\.(geojson|svg|png|pdf|vti|vtp|glb)|run\.json|evolution\.csv|index\.html)$'
  for path in "$1"/* "$1"/.[!.]*; do
    [[ ${path##*/} =~ $results || ! -e $path ]] || fault "left in $1: ${path##*/}"
  done
}

# with_calls WHAT AT ARGUMENTS...: as try, and at that call of those that change files, of a
# number or on a path with a name, the program is killed or gets a signal, or from it on the
# disk is full (file_calls.c); the files calls and forks get their numbers. A shell's
# background jobs ignore the interrupt.
with_calls() {
  local what=$1 at=$2
  shift 2
  : "${FILE_CALLS:?is to name libfile_calls.so, as ctest does}"
  # a sanitizer would insist on being loaded first
  { env --default-signal=INT FILE_CALLS_DO="$what" FILE_CALLS_AT="$at" FILE_CALLS_LOG="$PWD/calls" \
    FILE_CALLS_FORKS="$PWD/forks" \
    ASAN_OPTIONS="${ASAN_OPTIONS:+$ASAN_OPTIONS:}verify_asan_link_order=0" \
    LD_PRELOAD="$FILE_CALLS" "$program" "$@" >out 2>err; } 2>/dev/null
  code=$?
}

# Ends the test where there is no mpirun. Else: tests may run as root (a container), on
# fewer cores than ranks, without ptrace.
need_ranks() {
  if ! command -v mpirun >/dev/null; then
    echo "1..0 # SKIP there is no mpirun"
    exit 0
  fi
  export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
  export OMPI_MCA_rmaps_base_oversubscribe=1 OMPI_MCA_mpi_yield_when_idle=1
  export OMPI_MCA_btl_vader_single_copy_mechanism=none
  # what a killed mpirun leaves behind (session folders by process number, which come
  # again, and segments of shared memory) must not meet a later one, or another test's
  TMPDIR=$work/.mpi
  export TMPDIR
  case $work in
  /dev/shm/*) export OMPI_MCA_btl_vader_backing_directory=$TMPDIR ;;
  esac
  forget_launchers
  # two ranks would be bound to the first two cores, whatever else runs there
  export OMPI_MCA_hwloc_base_binding_policy=none
}

# until_there FILE PID: waits until it is there, or the process has ended; however slow the
# machine, for ctest ends what hangs.
until_there() {
  until [ -e "$1" ] || ! kill -0 "$2" 2>/dev/null; do
    sleep 0.02
  done
}

# until_heeded SIGNAL PID: waits until the process has a handler of a signal, or has ended.
until_heeded() {
  local caught bit=$(($(kill -l "$1") - 1))
  while caught=$(sed -n 's/^SigCgt:[[:space:]]*//p' "/proc/$2/status" 2>/dev/null) &&
    [ -n "$caught" ] && [ $((0x$caught >> bit & 1)) = 0 ]; do
    sleep 0.02
  done
}

# Once what was killed has ended.
forget_launchers() {
  rm -rf "$TMPDIR"
  mkdir "$TMPDIR"
}

# on RANKS ARGUMENTS...: as try, on several ranks; what hangs ends with code 124 (under a
# load of 20 on two cores, a run of 513 nodes on three ranks took more than a minute).
on() {
  local ranks=$1
  shift
  timeout 300 mpirun -n "$ranks" "$program" "$@" >out 2>err
  code=$?
}

# wait_at_most SECONDS PID: wait, which kills what does not end by itself. mpirun can lock
# itself up in its own end (PMIx_server_finalize, Open MPI 4.1.4) once a rank was killed.
# No subshell watches: a signal that meets one just forked has it run our trap, and the
# folder of the test is gone.
wait_at_most() {
  local left=$(($1 * 20))
  {
    while kill -0 "$2"; do
      [ "$((left--))" -gt 0 ] || kill -KILL "$2"
      sleep 0.05
    done
    wait "$2"
  } 2>/dev/null
}

# mpirun says more when a rank fails; ours are the lines from the program's name on.
expect_one_message() {
  [ "$(grep -c '^flowgrain: ' err)" = 1 ] || fault "not one message: $(head -c 400 err)"
}

# done_with NAME: ends a case.
done_with() {
  case_number=$((case_number + 1))
  if [ -z "$complaint" ]; then
    echo "ok $case_number - $1"
  else
    echo "not ok $case_number - $1"
    echo "# $complaint"
    any_failed=1
  fi
  complaint=
}

finish() {
  echo "1..$case_number"
  exit "$any_failed"
}
