#!/usr/bin/env bash
# --energy FILE: a tensor field steers the clusters, on one process and on two.
source "$(dirname "$0")/harness.sh"

# tensors NAME XX XY YX YY: the same everywhere on [0,1]^2
tensors() {
  {
    printf '# vtk DataFile Version 3.0\ntensors\nASCII\nDATASET STRUCTURED_POINTS\n'
    printf 'DIMENSIONS 3 3 1\nORIGIN %s 0 0\nSPACING 0.5 0.5 1\nPOINT_DATA 9\n' "${6:-0}"
    printf 'TENSORS a double\n'
    for _ in 1 2 3 4 5 6 7 8 9; do echo "$2 $3 0 $4 $5 0 0 0 1"; done
  } >"$1"
}
# as variables of their own
scalars() {
  printf '# vtk DataFile Version 3.0\ntensors\nASCII\nDATASET STRUCTURED_POINTS\n'
  printf 'DIMENSIONS 3 3 1\nORIGIN 0 0 0\nSPACING 0.5 0.5 1\nPOINT_DATA 9\n'
  while [ $# -gt 0 ]; do
    printf 'SCALARS %s double\nLOOKUP_TABLE default\n' "$1"
    for _ in 1 2 3 4 5 6 7 8 9; do echo "$2"; done
    shift 2
  done
}

# mostly along y, where the field would have x
tensors along.vtk 0.2 0 0 1
run() {
  try run synth:uniform -o "$1" --nodes 65 --clusters 12 --quiet "${@:2}"
}
run out1 --energy ./along.vtk
expect_code 0
expect_json out1/run.json '.parameters.energy == "./along.vtk"'
expect_json out1/run.json '.parameters.anisotropy | . > 0.1999 and . < 0.2001'
scalars xx 0.8 xy 0 yy 4 >parts.vtk
run out2 --energy parts.vtk
expect_code 0
cmp -s out1/scale-00.geojson out2/scale-00.geojson || fault "another result of parts, times 4"
run out3 --energy flow --anisotropy 0.2
expect_code 0
cmp -s out1/scale-00.geojson out3/scale-00.geojson && fault "the file changes nothing"
done_with "energy: from a file, in two ways"

if command -v mpirun >/dev/null; then
  need_ranks
  on 2 run synth:uniform -o out4 --nodes 65 --clusters 12 --quiet --energy along.vtk
  expect_code 0
  cmp -s out1/scale-00.geojson out4/scale-00.geojson || fault "two ranks see another energy"
  done_with "energy: two ranks"
fi

tensors skew.vtk 1 0.5 0.4 1
tensors indefinite.vtk 1 2 2 1
tensors steep.vtk 1 0 0 1e-4
tensors aside.vtk 1 0 0 1 0.25
scalars xx 1 yy 1 >lacking.vtk
while read -r file words; do
  run bad --energy "$file"
  expect_code 1
  expect_one_complaint
  expect_error "$words"
  expect_nothing_at bad
  done_with "energy: $file is refused"
done <<'END'
skew.vtk not symmetric: xy is 0.5, yx is 0.4
indefinite.vtk not positive definite: its eigenvalues go from -1 to 3
steep.vtk from 0.0001 to 1
aside.vtk from 0.25 to 1.25 along x
lacking.vtk xy
missing.vtk No such file
END
run bad --energy along.vtk --anisotropy 0.5
expect_code 2
expect_one_complaint
run bad --energy uphill
expect_code 2
expect_one_complaint
done_with "energy: wrong usage"
finish
