#!/usr/bin/env bash
# The server of `flowgrain view`: what it answers, to whom, and how it ends. What a browser
# shows of it, viewer/test/view.test.mjs asks.
source "$(dirname "$0")/harness.sh"
mkdir temporary
export TMPDIR=$work/temporary
server=

# end_server SIGNAL...: as a terminal would; sets code.
end_server() {
  local signal
  for signal in "$@"; do
    kill -s "$signal" "$server"
  done
  wait "$server"
  code=$?
}
trap '[ -z "$server" ] || kill -KILL "$server" 2>/dev/null; rm -rf "$work"' EXIT

# view ARGUMENTS...: starts it; sets server, and address, port and token once it tells them.
# A shell's background jobs ignore the interrupt.
view() {
  rm -f out
  env --default-signal=INT "$program" view "$@" >out 2>err &
  server=$!
  until [ -s out ] || ! kill -0 "$server" 2>/dev/null; do
    sleep 0.05
  done
  address=$(head -n 1 out)
  port=${address#http://127.0.0.1:}
  token=${port#*/}
  token=${token%/}
  port=${port%%/*}
}

# ask REQUEST-LINE [HEADER...]: sets status and answer (a file) of what is sent so. The
# server may have refused before all of it is.
ask() {
  exec 3<>"/dev/tcp/127.0.0.1/$port" || { fault "nobody at port $port"; return; }
  (trap '' PIPE && printf '%s\r\n' "$@" '' >&3) 2>/dev/null
  cat <&3 >answer
  exec 3>&-
  read -r _ status _ <answer || fault "no answer to $1"
}

# get NAME
get() {
  ask "GET /$token/$1 HTTP/1.1" "Host: 127.0.0.1:$port"
}

# refused STATUS REQUEST-LINE [HEADER...]
refused() {
  local wanted=$1
  shift
  ask "$@"
  [ "$status" = "$wanted" ] || fault "$1: status $status, not $wanted"
  [ "$(wc -c <answer)" -lt 600 ] || fault "$1: told something: $(head -c 300 answer)"
}

small=(--arrows 20,9 --nodes 65 --quiet)
with_page=
! "$program" --version | grep '^with ' | grep -qw viewer || with_page=yes

if [ -n "$with_page" ]; then
  try run synth:saddle -o run "${small[@]}"
  expect_code 0
  echo secret >run/notes.txt
  ln -s notes.txt run/scale-07.svg
  view run --no-browser
  [[ $address =~ ^http://127\.0\.0\.1:[0-9]+/[0-9a-f]{32}/$ ]] || fault "address $address"
  get ""
  [ "$status" = 200 ] || fault "status $status"
  sed '1,/^\r$/d' answer | cmp -s - run/index.html || fault "not the page"
  grep -q '^Cache-Control: no-store' answer || fault "the page may be stored"
  get scale-01.svg
  sed '1,/^\r$/d' answer | cmp -s - run/scale-01.svg || fault "not the picture"
  ask "GET /$token/?a=b HTTP/1.1" "hOST:  localhost "
  [ "$status" = 200 ] || fault "by the name localhost status $status"
  done_with "the page of a run is served"

  refused 404 "GET / HTTP/1.1" "Host: 127.0.0.1:$port"
  refused 404 "GET /index.html HTTP/1.1" "Host: 127.0.0.1:$port"
  refused 404 "GET /$token HTTP/1.1" "Host: 127.0.0.1:$port"
  refused 404 "GET /${token%?}/ HTTP/1.1" "Host: 127.0.0.1:$port"
  refused 404 "GET /${token}0/ HTTP/1.1" "Host: 127.0.0.1:$port"
  refused 404 "GET /$(tr 0-9a-f 1-9a-f0 <<<"$token")/ HTTP/1.1" "Host: 127.0.0.1:$port"
  for name in notes.txt run.json scale-07.svg ../run/index.html %2e%2e/notes.txt /etc/passwd scale-99.svg; do
    refused 404 "GET /$token/$name HTTP/1.1" "Host: 127.0.0.1:$port"
  done
  done_with "without the token, and for other files, there is nothing"

  refused 403 "GET /$token/ HTTP/1.1" "Host: evil.example:$port"
  refused 403 "GET /$token/ HTTP/1.1" "Host: 127.0.0.1.evil.example"
  refused 403 "GET /$token/ HTTP/1.1" "Host: localhost:x"
  refused 403 "GET /$token/ HTTP/1.1" "Host: localhost" "Host: localhost"
  refused 403 "GET /$token/ HTTP/1.0"
  refused 405 "POST /$token/ HTTP/1.1" "Host: localhost"
  refused 405 "HEAD /$token/ HTTP/1.1" "Host: localhost"
  refused 400 "GET  HTTP/1.1" "Host: localhost"
  refused 400 "GET /$token/" "Host: localhost"
  refused 431 "GET /$token/ HTTP/1.1" "X: $(head -c 17000 /dev/zero | tr '\0' a)"
  done_with "other hosts, methods and what is no request are refused"

  # one that says nothing keeps no other waiting
  exec 4<>"/dev/tcp/127.0.0.1/$port"
  printf 'GET /' >&4
  get ""
  [ "$status" = 200 ] || fault "status $status"
  exec 4>&-
  ! ss -ltn 2>/dev/null | grep ":$port " | grep -vq '127\.0\.0\.1:' || fault "open to other machines"
  end_server INT
  expect_code 130
  [ ! -s err ] || fault "$(cat err)"
  [ "$(wc -l <out)" = 1 ] || fault "$(cat out)"
  done_with "an interrupt ends it"

  try run synth:saddle -o bare "${small[@]}" --no-page
  try view bare
  expect_code 1
  expect_error '^flowgrain: bare: its run has left no page: there is no index.html, or not by run.json$'
  cp run/index.html bare
  try view bare
  expect_code 1
  try view temporary
  expect_code 1
  expect_error '^flowgrain: temporary: holds no run of flowgrain: there is no run.json$'
  expect_one_complaint
  try view run --arrows 20
  expect_code 2
  expect_error '^flowgrain: --arrows: says nothing of run, which is a folder$'
  done_with "a folder without a page is refused, and options of run for a folder"
fi

printf '#!/bin/sh\necho noise\necho "$@" >%s/opened\n' "$work" >browse
chmod +x browse
BROWSER="$work/browse --new" view synth:saddle "${small[@]}"
until [ -s opened ] || ! kill -0 "$server" 2>/dev/null; do sleep 0.05; done
[ "$(cat opened)" = "--new $address" ] || fault "opened: $(cat opened)"
for _ in $(seq 200); do
  get state
  sed '1,/^\r$/d' answer >state.json
  [ "$(jq .ended state.json)" = false ] || break
  sleep 0.1
done
expect_json state.json '.ended and .input == "synth:saddle" and .pictures == ["scale-00.svg", "scale-01.svg"]'
get scale-01.geojson
sed '1,/^\r$/d' answer >icons.json
expect_json icons.json '.features | length == 9'
last=$(($(jq .densities state.json) - 1))
get "density-$last"
LC_ALL=C sed '1,/^\r$/d' answer >density
[ "$(od -An -tu2 -N4 density | xargs)" = "65 65" ] || fault "a density of $(od -An -tu2 -N4 density) nodes"
[ "$(wc -c <density)" = $((4 + 65 * 65)) ] || fault "$(wc -c <density) bytes of a density"
od -An -v -tu1 -w1 -j4 density | awk '$1 > 240 { ++inside } $1 < 16 { ++outside } !$1 { ++missing }
  END { exit !(inside / NR > 0.1 && outside / NR > 0.4 && !missing) }' || fault "no clusters in the last density"
for name in "density-$((last + 1))" density- density--1 density-0x density-99999999999; do
  refused 404 "GET /$token/$name HTTP/1.1" "Host: 127.0.0.1:$port"
done
get ""
[ -z "$with_page" ] || grep -q 'id="run"' answer || fault "not the page of the run"
[ "$(cat out)" = "$address" ] || fault "more than the address: $(cat out)"
[ "$(stat -c %a temporary/flowgrain-view-*)" = 700 ] || fault "others may read the folder"
end_server TERM
expect_code 130
[ -z "$(ls -A temporary)" ] || fault "left: $(ls -AR temporary)"
done_with "a field is run into a temporary folder, and opened in \$BROWSER"

BROWSER="$work/no such" view synth:saddle "${small[@]}"
until grep -q 'flowgrain: no browser' err || ! kill -0 "$server" 2>/dev/null; do sleep 0.05; done
end_server INT
expect_code 130
done_with "no browser: it says so, and goes on"

# a long run, and what is shown meanwhile
view synth:vortex3 --arrows 60,30 --nodes 513 --no-browser --quiet
get ""
grep -q 'id="scales"' answer || fault "not the page that follows: $(head -c 300 answer)"
get state
sed '1,/^\r$/d' answer >state.json
expect_json state.json '.ended == false and .page == false and (.doing | startswith("evolving")) and .share >= 0 and .share < 1'
end_server INT
expect_code 130
expect_error '^flowgrain: synth:vortex3: interrupted; nothing of its run is kept without -o DIR$'
expect_one_complaint
[ -z "$(ls -A temporary)" ] || fault "left: $(ls -AR temporary)"
done_with "an interrupt while it runs leaves nothing behind"

view synth:vortex3 --arrows 60,30 --nodes 513 -o kept --no-browser --quiet
end_server INT
expect_code 130
[ "$(grep -c '^flowgrain: synth:vortex3: interrupted' err)" = 1 ] || fault "$(cat err)"
[ ! -e kept ] || expect_error 'with --resume goes on'
[ -z "$(ls -A temporary)" ] || fault "left: $(ls -AR temporary)"
done_with "with -o it ends as a run does"

echo nothing >empty.nc
for bad in empty.nc none.nc "synth:none" "-"; do
  try view "$bad" </dev/null
  expect_code 1
  [ ! -s out ] || fault "an address for $bad: $(cat out)"
  expect_one_complaint
  [ -z "$(ls -A temporary)" ] || fault "left: $(ls -AR temporary)"
done
server=
done_with "what cannot be read is not shown"

finish
