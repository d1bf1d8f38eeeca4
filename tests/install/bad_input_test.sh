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
[ "$(wc -l < "$work/said")" = 1 ] && grep -q "was made by Ostia 0.0.9 and is configured anew for $version" "$work/said" || fail "the other version is not told"
cache /somewhere/else "$version"
expect_one_line "build/release was made from the sources in /somewhere/else; move it away (mv build/release build/release-old)" check before release 0
cache "$work/tree" "$version"

PATH=$work/bin:$PATH
fake cmake 'cmake version 3.18.4\n'
expect_one_line "CMake 3.18.4 is too old, 3.25 is needed" check before release 0
rm "$work/bin/cmake"
fake df ' Avail\n 1536M\n'
expect_one_line "build/release needs 3 GB and its disk has 1.5 GB free; make room" check before release 3
[ -z "$(check after release)" ] || fail "a failure with room on the disk is not the disk's"
fake df 'Avail\n   12M\n'
expect_one_line "the disk that holds build/release is full; make room and run the same again" check after release
rm "$work/bin/df"

# Packing on a full disk, before it begins and while it goes on.
cp "$source/scripts/package.sh" "$work/tree/scripts"
mkdir -p "$work/tree/build/release/bin" "$work/tree/packaging/desktop" "$work/tree/packaging/debian"
for program in tree/scripts/build.sh tree/scripts/install_packages.sh tree/build/release/bin/ostia-live bin/desktop-file-validate bin/appstreamcli; do
  printf '#!/bin/sh\n' > "$work/$program"
  chmod +x "$work/$program"
done
touch "$work/tree/packaging/desktop/a.desktop" "$work/tree/packaging/desktop/a.metainfo.xml"
echo 'Maintainer: nobody' > "$work/tree/packaging/debian/control"
pack() { "$work/tree/scripts/package.sh" "$work/packages"; }
fake df 'Avail\n  900M\n'
expect_one_line "make room there or set TMPDIR to a larger disk" pack
fake df 'Avail\n 5000M\n'
fake df-when-full 'Avail\n   12M\n'
printf '#!/bin/sh\nmv %s/df-when-full %s/df\nexit 1\n' "$work/bin" "$work/bin" > "$work/bin/dpkg-buildpackage"
chmod +x "$work/bin/dpkg-buildpackage"
expect_one_line "is full; make room there or set TMPDIR to a larger disk" pack
rm "$work/bin/df" "$work/bin/dpkg-buildpackage"

# Packages that are missing where nobody may install them; of all programs there are those that looking for them takes.
mkdir "$work/few"
for program in bash dirname cat; do ln -s "$(command -v $program)" "$work/few/$program"; done
cp "$source/scripts/install_packages.sh" "$work/tree/scripts"
fake dpkg-query ''
fake id '1000\n'
mv "$work/bin/dpkg-query" "$work/bin/id" "$work/few"
printf 'libone-dev\nlibtwo-dev\n' > "$work/tree/packages.txt"
expect_one_line "there is no sudo; install these as root and run the same again: apt install libone-dev libtwo-dev" \
  env PATH="$work/few" bash "$work/tree/scripts/install_packages.sh" packages.txt

# One that is missing where CMake is run by itself: its errors have lines around them, what to do is one of these.
if cmake -G Ninja -S "$source" -B "$work/missing" -DCMAKE_DISABLE_FIND_PACKAGE_spdlog=ON -DOSTIA_WITH_IMAGE_LIBRARIES=OFF \
  > "$work/out" 2> "$work/err"; then fail "a package is missing, and nothing was said"; fi
grep -q "^ *Packages are missing; scripts/build.sh installs what it needs, or install them by: apt install libspdlog-dev$" "$work/err" ||
  fail "what to do is not on one line: $(cat "$work/err")"
