#!/usr/bin/env bash
# The commands of the page for users of the program, docs/users/program.md, as they stand there.
source "$(dirname "$0")/harness.sh"

# Winds of twelve months on two levels by two members, round the globe in steps of 10 degrees.
write_netcdf '
  @dims = (["time", 12], ["level", 2], ["number", 2], ["lat", 17], ["lon", 36]);
  @vars = (
    ["time", [0], 6, [units => "days since 1982-01-15"], [map { 30.4 * $_ } 0 .. 11]],
    ["level", [1], 6, [units => "hPa"], [850, 300]],
    ["number", [2], 6, [], [1, 2]],
    ["lat", [3], 6, [units => "degrees_north"], [map { 10 * $_ - 80 } 0 .. 16]],
    ["lon", [4], 6, [units => "degrees_east"], [map { 10 * $_ } 0 .. 35]]);
  for my $c (0, 1) {
    my @v;
    for my $t (0 .. 11) { for my $l (0, 1) { for my $n (0, 1) { for my $j (0 .. 16) {
      for my $i (0 .. 35) {
        my ($x, $y) = ($i / 36 * 6.2832, ($j - 8) / 18 * 3.1416);
        push @v, (1 + $l) * ($c ? 6 * sin(3 * $x + $t / 2) * cos($y)
                                : 10 * cos(4 * $y) + $n * cos($x));
      } } } } }
    push @vars, [("u", "v")[$c], [0 .. 4], 5, [units => "m s-1"], \@v];
  }' >year.nc
perl -e 'print "lon,lat,speed,direction\n";
  for (0 .. 399) {
    my ($x, $y) = (($_ * 0.618034) - int($_ * 0.618034), $_ / 400);
    printf "%.4f,%.4f,%.2f,%.1f\n", 5 + 5 * $x, 45 + 4 * $y, 5 + 3 * $x, 360 * $y;
  }' >stations.csv
cp "$root/data/gfs_20140131.nc" wind.nc

flowgrain() {
  "$program" "$@" </dev/null
}
set -e
commands=$("$root/scripts/blocks" "$root/docs/users/program.md" sh)
set +e
while IFS= read -r command; do
  eval "$command" >out 2>err || fault "$command: $(head -c 300 err)"
done <<<"$commands"
for file in wind/scale-01.png figure.pdf both.svg atlantic/scale-00.svg pacific.png pole/scale-00.pdf \
  summer.pdf enough/scale-00.png stations/scale-00.png volume/index.html cut/scale-00.svg arrows.csv; do
  expect_file $file
done
expect_json july/run.json '.input.time == 6 and .scales[0].icons == 20'
done_with "the commands of the page for users are right"

finish
