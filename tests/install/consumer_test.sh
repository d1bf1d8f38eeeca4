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
expect_refusal 'not compatible with requested version "0.1"' project core 0.1
expect_refusal 'install them by: apt install libsuitesparse-dev' project lumen "$version" -DOSTIA_CHOLMOD_LIBRARY_cholmod=OSTIA-NOTFOUND -DCMAKE_SYSTEM_LIBRARY_PATH=/nowhere -DCMAKE_LIBRARY_ARCHITECTURE= -DCMAKE_FIND_USE_CMAKE_SYSTEM_PATH=OFF
project "core geometry" "$version" > /dev/null

cmake -G Ninja -S "$source/examples/consumer" -B "$work/build" -DCMAKE_PREFIX_PATH="$work/prefix" -DCMAKE_BUILD_TYPE=Release > /dev/null
cmake --build "$work/build" > "$work/log" || { cat "$work/log"; fail "the example does not build"; }
python3 "$(dirname "$0")/ellipsoid.py" "$work/surface.stl"
"$work/build/layered_mesh" "$work/surface.stl" "$work/mesh.vtu" > "$work/said" || fail "the example's program"
read -r _ said prisms _ tetrahedra _ < "$work/said"
[ "$said" = "$version:" ] && [ "$prisms" -gt 1000 ] && [ "$tetrahedra" -gt 500 ] || fail "the program said: $(cat "$work/said")"
"$work/prefix/bin/ostia" info "$work/mesh.vtu" > /dev/null || fail "the mesh cannot be read"
OSTIA_WORKER=/nowhere/ostia-worker expect_refusal /nowhere/ostia-worker "$work/build/layered_mesh" "$work/surface.stl" "$work/mesh.vtu"
