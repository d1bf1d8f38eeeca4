#!/usr/bin/env bash
# bad_input_test.sh SOURCE: what keeps Ostia from being built is told in a line that says what to do.
source "$(dirname "$0")/common.sh"
source=$1
mkdir -p "$work/tree/scripts" "$work/bin"
cp "$source/scripts/check_build.sh" "$work/tree/scripts"
cp "$source/CMakeLists.txt" "$work/tree"
check() { "$work/tree/scripts/check_build.sh" "$@"; }
cache() {
  mkdir -p "$work/tree/build/release"
  printf 'CMAKE_HOME_DIRECTORY:INTERNAL=%s\nCMAKE_PROJECT_VERSION:STATIC=%s\n' "$1" "$2" > "$work/tree/build/release/CMakeCache.txt"
}
# fake NAME LINE: a program of this name that prints the line.
fake() {
  printf '#!/bin/sh\nprintf "%s"\n' "$2" > "$work/bin/$1"
  chmod +x "$work/bin/$1"
}
version=$(sed -n 's/^project(ostia VERSION \([0-9.]*\).*/\1/p' "$source/CMakeLists.txt")

[ -z "$(check before release 0)" ] || fail "a folder that is not there needs nothing"
cache "$work/tree" "$version"
[ -z "$(check before release 0)" ] || fail "a folder of this version needs nothing"
cache "$work/tree" 0.0.9
[ "$(check before release 0 2> "$work/said")" = --fresh ] || fail "a folder of another version is configured anew"
grep -q "was made by Ostia 0.0.9 and is configured anew for $version" "$work/said" || fail "the other version is not told"
cache /somewhere/else "$version"
expect_refusal "build/release was made from the sources in /somewhere/else; move it away (mv build/release build/release-old)" check before release 0
cache "$work/tree" "$version"

PATH=$work/bin:$PATH
fake cmake 'cmake version 3.18.4\n'
expect_refusal "CMake 3.18.4 is too old, 3.25 is needed" check before release 0
rm "$work/bin/cmake"
fake df ' Avail\n 1536M\n'
expect_refusal "build/release needs 3 GB and its disk has 1.5 GB free; make room" check before release 3
[ -z "$(check after release)" ] || fail "a failure with room on the disk is not the disk's"
fake df 'Avail\n   12M\n'
expect_refusal "the disk that holds build/release is full; make room and run the same again" check after release
rm "$work/bin/df"

# A package that is missing.
expect_refusal "scripts/build.sh installs what it needs, or install them by: apt install libspdlog-dev" \
  cmake -G Ninja -S "$source" -B "$work/missing" -DCMAKE_DISABLE_FIND_PACKAGE_spdlog=ON -DOSTIA_WITH_IMAGE_LIBRARIES=OFF
