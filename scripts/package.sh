#!/usr/bin/env bash
# Debian packages of what scripts/build.sh builds: scripts/package.sh [OUTPUT_FOLDER]   (default: out/packages)
# Builds the programs and the Python package where they are not up to date. lintian must find no error.
set -euo pipefail
cd "$(dirname "$0")/.."
out=${1:-out/packages}
source=$PWD build=$PWD/build/release
scripts/install_packages.sh scripts/packages-packaging.txt

fail() {
  echo "package.sh: $1" >&2
  exit 1
}

scripts/build.sh release programs
scripts/build.sh release python python_docs
if grep -q 'OSTIA_WITH_IMAGE_LIBRARIES:BOOL=OFF' "$build/CMakeCache.txt" || [ ! -x "$build/bin/ostia-live" ]; then
  fail "build/release lacks some of the programs; configure it anew: cmake --fresh --preset release"
fi

desktop-file-validate packaging/desktop/*.desktop
appstreamcli validate --no-net packaging/desktop/*.metainfo.xml
version=$(sed -n 's/^CMAKE_PROJECT_VERSION:[A-Z]*=//p' "$build/CMakeCache.txt")
mkdir -p "$out"
out=$(realpath "$out")

stage=$(mktemp -d)
trap 'rm -rf "$stage"' EXIT
free_mb() { df --output=avail -BM "$stage" | tail -1 | tr -dc 0-9; }
[ "$(free_mb)" -ge 1024 ] || fail "packing needs 1 GB in $stage; make room there or set TMPDIR to a larger disk"
mkdir "$stage/ostia"
cp -r packaging/debian "$stage/ostia/debian"
cat > "$stage/ostia/debian/changelog" <<END
ostia ($version-1) unstable; urgency=medium

  * Version $version. Its changes are in changelog.gz.

 -- $(sed -n 's/^Maintainer: //p' packaging/debian/control)  $(git log -1 --format=%cD 2>/dev/null || date -R)
END
(cd "$stage/ostia" &&
  DEB_BUILD_OPTIONS=noautodbgsym OSTIA_BUILD=$build OSTIA_SOURCE=$source dpkg-buildpackage --build=binary --no-sign -rfakeroot > "$stage/log" 2>&1) ||
  {
    [ "$(free_mb)" -ge 50 ] || fail "the disk that holds $stage is full; make room there or set TMPDIR to a larger disk"
    tail -20 "$stage/log" >&2
    fail "dpkg-buildpackage failed (its last lines are above)"
  }
rm -f "$out"/ostia_* "$out"/ostia-*.deb "$out"/libostia-dev_*.deb "$out"/python3-ostia_*.deb  # of an earlier version
mv "$stage"/*.deb "$stage"/*.changes "$stage"/*.buildinfo "$out"
lintian --fail-on error "$out/ostia_${version}-1_$(dpkg --print-architecture).changes"
echo
ls -l "$out"/*"_$version-1_"*.deb
echo "Install them: apt install $out/ostia*_$version-1_*.deb; for C++ also $out/libostia-dev_$version-1_*.deb, for Python $out/python3-ostia_$version-1_*.deb"
