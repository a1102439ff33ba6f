#!/usr/bin/env bash
# Parts of planes and volumes that are on no map: --region.
source "$(dirname "$0")/harness.sh"

# table NAME DIMENSION: points of a grid along axes with steps of a quarter.
table() {
  awk -v dimension="$2" 'BEGIN {
    print dimension == 3 ? "x,y,z,u,v,w" : "x,y,u,v"
    for (k = 0; k <= (dimension == 3 ? 12 : 0); ++k)
      for (j = 0; j <= 16; ++j)
        for (i = 0; i <= 40; ++i) {
          x = i / 4; y = j / 4 - 2; z = k / 4
          u = sin(x) * cos(y) + 0.3; v = 0.1 * x - cos(x) * sin(y)
          if (dimension == 3) print x "," y "," z "," u "," v "," 0.2 * cos(z)
          else print x "," y "," u "," v
        }
  }' >"$1"
}

# mesh NAME: rings round a cylinder, from r = 0.5 to 50, as a structured grid of VTK.
mesh() {
  awk 'BEGIN {
    print "# vtk DataFile Version 3.0\nrings\nASCII\nDATASET STRUCTURED_GRID\nDIMENSIONS 65 45 1\nPOINTS 2925 double"
    for (j = 0; j < 45; ++j)
      for (i = 0; i < 65; ++i) {
        r = 0.5 * 100 ^ (j / 44); t = 6.283185307179586 * i / 64
        print r * cos(t), r * sin(t), 0
        values = values sprintf("%.9g %.9g 0\n", 1 - 0.25 * cos(2 * t) / r ^ 2, -0.25 * sin(2 * t) / r ^ 2)
      }
    printf "POINT_DATA 2925\nVECTORS U double\n%s", values
  }' >"$1"
}

table plane.csv 2
table volume.csv 3
mesh rings.vtk
run=(--arrows 6 --effort 0 --formats svg --quiet)

# cut NAME SIZE BOUNDS ARGUMENTS...: a run's field has that size and these bounds.
cut() {
  try run "${@:4}" -o "$1" "${run[@]}"
  expect_code 0
  expect_json "$1/run.json" ".field.size == $2 and .field.bounds == $3"
}

cut plane '[23, 15]' '[1.1, 6.3, -1.5, 1.9]' plane.csv --region=1.1,6.3,-1.5,1.9
expect_json plane/run.json '.input.map.region == [1.1, 6.3, -1.5, 1.9]'
cut wide '[4, 17]' '[0, 0.6, -2, 2]' plane.csv --region=-5,0.6,-9,9
cut box '[23, 15, 9]' '[1.1, 6.3, -1.5, 1.9, 0.3, 2.1]' volume.csv --region=1.1,6.3,-1.5,1.9,0.3,2.1
expect_json box/run.json '.input.map.region == [1.1, 6.3, -1.5, 1.9, 0.3, 2.1]'
cut column '[23, 15, 13]' '[1.1, 6.3, -1.5, 1.9, 0, 3]' volume.csv --region=1.1,6.3,-1.5,1.9
cut slice '[23, 9]' '[1.1, 6.3, 0.3, 2.1]' volume.csv --slice y=0.1 --region=1.1,6.3,0.3,2.1
cut sliced '[23, 9]' '[1.1, 6.3, 0.3, 2.1]' volume.csv --slice y=0.1 --region=1.1,6.3,-1,1,0.3,2.1
cmp -s slice/scale-00.geojson sliced/scale-00.geojson || fault "a box that is cut, and a cut that is bounded, differ"
try synth abc -o abc.nc --nodes 17
cut netcdf '[8, 7]' '[0.2, 0.6, 0.6, 0.9]' abc.nc --slice y=0.5 --region=0.2,0.6,0.6,0.9
cut whole '[41, 17]' '[0, 10, -2, 2]' plane.csv --region=0,10,-2,2
try run plane.csv -o all "${run[@]}"
cmp -s <(grep -v region whole/scale-00.geojson) <(grep -v region all/scale-00.geojson) || fault "a region that is all changes arrows"
done_with "a region of planes, volumes and cuts"

# finer than the 1/9 that a raster of all has at 1024 samples
try run rings.vtk -o rings --region=-2,4,-2,2 "${run[@]}"
expect_code 0
expect_json rings/run.json '.field.bounds == [-2, 4, -2, 2] and .field.size[0] > 300'
expect_json rings/scale-00.geojson '[.features[].geometry | .. | numbers] | all(. >= -2 and . <= 4)'
done_with "a mesh is sampled at the part's own resolution"

try draw plane -o again.svg
expect_code 0
done_with "draw reads the part again"

# no WORDS ARGUMENTS...: a run is refused with these words.
no() {
  try run "${@:2}" -o no "${run[@]}"
  [ "$code" != 0 ] || fault "$*: is read"
  grep -qF -- "$1" err || fault "$(cat err)"
  expect_nothing_at no
}

no 'nothing lies in the region: it goes from x = 20 to 30, and the field from 0 to 10' plane.csv --region=20,30,-1,1
no 'from z = 4 to 5, and the field from 0 to 3' volume.csv --region=1,3,-1,1,4,5
no 'from y = 60 to 70, and the field from -50 to 50' rings.vtk --region=-2,4,60,70
no 'samples lie at 1 and 1.25 (of 0 to 10)' plane.csv --region=1.1,1.2,-1,1
no 'no cell lies in the region' rings.vtk --region=-0.1,0.1,-0.1,0.1
no 'six numbers, and the field is a plane along x and y' plane.csv --region=1,3,-1,1,0,1
no 'six numbers, and the field goes on a map' "$root/data/gfs_20140131.nc" --region=10,30,10,30,0,1
no '30,10,100,120: WEST,EAST,SOUTH,NORTH' plane.csv --region=30,10,100,120
no 'X0,X1,Y0,Y1,Z0,Z1' plane.csv --region=1,3,-1,1,0
no 'no map can be made' plane.csv --region=1,3,-1,1 --center 5
done_with "regions that are refused"
finish
