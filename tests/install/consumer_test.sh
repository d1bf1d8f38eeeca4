#!/usr/bin/env bash
# consumer_test.sh SOURCE BUILD: another project is built against what is installed, and its program finds the worker.
source "$(dirname "$0")/common.sh"
source=$1 build=$2
for component in programs development; do
  cmake --install "$build" --prefix "$work/prefix" --component $component > /dev/null
done

# project COMPONENTS VERSION: a project that asks for them.
project() {
  mkdir -p "$work/asks"
  printf 'cmake_minimum_required(VERSION 3.25)\nproject(asks LANGUAGES C CXX)\nfind_package(Ostia %s REQUIRED COMPONENTS %s)\n' \
    "$2" "$1" > "$work/asks/CMakeLists.txt"
  rm -f "$work/asks-build/CMakeCache.txt"
  cmake -G Ninja -S "$work/asks" -B "$work/asks-build" -DCMAKE_PREFIX_PATH="$work/prefix" "${@:3}"
}
version=$(sed -n 's/^project(ostia VERSION \([0-9.]*\).*/\1/p' "$source/CMakeLists.txt")
expect_refusal 'there is no room "lumenn"; the rooms installed are: core geometry' project "core lumenn" "$version"
expect_refusal 'compatible with requested version "0.1"' project core 0.1
expect_refusal 'rooms need are missing (lumen); install them by: apt install libeigen3-dev' project lumen "$version" -DCMAKE_DISABLE_FIND_PACKAGE_Eigen3=ON
project core "$version" -DCMAKE_DISABLE_FIND_PACKAGE_Eigen3=ON > /dev/null 2>&1  # which needs none
project "core geometry" "$version" > /dev/null

# Ostia's volumes as ITK's images, by a header of its own component.
[ ! -e "$work/prefix/include/ostia/itk.h" ] || fail "the header for ITK belongs to its own component"
cmake --install "$build" --prefix "$work/prefix" --component itk > /dev/null
cmake -G Ninja -S "$source/examples/itk" -B "$work/itk" -DCMAKE_PREFIX_PATH="$work/prefix" > /dev/null
cmake --build "$work/itk" > "$work/log" || { cat "$work/log"; fail "the example with ITK does not build"; }
printf 'NRRD0004\ntype: uchar\ndimension: 3\nsizes: 3 3 3\nencoding: ascii\nspace: left-posterior-superior\nspace origin: (1,2,3)\nspace directions: (1,0,0) (0,1,0) (0,0,1)\n\n0 0 0 0 0 0 0 0 0 0 0 0 0 9 0 0 0 0 0 0 0 0 0 0 0 0 0\n' > "$work/spike.nrrd"
"$work/itk/itk_median" "$work/spike.nrrd" "$work/flat.nrrd" | grep -q "the same memory: yes" || fail "the example with ITK copies"
"$work/prefix/bin/ostia" info "$work/flat.nrrd" > "$work/said" 2>&1 || fail "what ITK made of a volume is no image: $(cat "$work/said")"

cmake -G Ninja -S "$source/examples/consumer" -B "$work/build" -DCMAKE_PREFIX_PATH="$work/prefix" -DCMAKE_BUILD_TYPE=Release > /dev/null
cmake --build "$work/build" > "$work/log" || { cat "$work/log"; fail "the example does not build"; }
"$work/prefix/bin/ostia" model --builtin -o "$work/model" --quiet > /dev/null

# meshed SURFACE: what the example makes of it, "PRISMS TETRAHEDRA".
meshed() {
  "$work/build/layered_mesh" "$1" "$work/mesh.vtu" > "$work/said" || fail "the example's program"
  "$work/prefix/bin/ostia" mesh --check "$work/mesh.vtu" > "$work/checked" || fail "the mesh is not sound: $(cat "$work/checked")"
  sed -n "s/^Ostia $version: \([0-9]*\) prisms, \([0-9]*\) tetrahedra$/\1 \2/p" "$work/said"
}
read -r prisms tetrahedra < <(meshed "$work/model/lumen.vtp")
[ "$prisms" -gt 1000 ] && [ "$tetrahedra" -gt 1000 ] || fail "layers were asked for: $(cat "$work/said")"
read -r prisms tetrahedra < <(meshed "$work/model/lumen.stl")
[ "$prisms" = 0 ] && [ "$tetrahedra" -gt 1000 ] || fail "a surface without caps has no layers: $(cat "$work/said")"
OSTIA_WORKER=/nowhere/ostia-worker expect_refusal "/nowhere/ostia-worker is not there" "$work/build/layered_mesh" "$work/model/lumen.stl" "$work/mesh.vtu"
