# Sourced by the tests of the program: runs it, checks what came, reports in TAP.
# shellcheck shell=bash
set -u
program=$1
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work" || exit 1
case_number=0
any_failed=0
complaint=

# try ARGUMENTS...: runs the program; sets code, out and err (files).
try() {
  "$program" "$@" >out 2>err
  code=$?
}

# Each check records the first fault of a case.
fault() {
  [ -n "$complaint" ] || complaint=$*
}

expect_code() {
  [ "$code" = "$1" ] || fault "exit code $code, not $1: $(head -c 300 err)"
}

expect_error() {
  grep -qE -- "$1" err || fault "standard error does not match '$1': $(head -c 300 err)"
}

# One line that begins with the program's name, and at most one more.
expect_one_complaint() {
  [ "$(grep -c '^flowgrain: ' err)" = 1 ] || fault "not one complaint: $(head -c 300 err)"
  [ "$(wc -l <err)" -le 2 ] || fault "more than two lines: $(head -c 300 err)"
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
