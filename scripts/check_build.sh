#!/usr/bin/env bash
# What keeps a preset from being built, in one line that says what to do.
#   scripts/check_build.sh before PRESET GIGABYTES   Ends with 2 where the build cannot go well. Prints what `cmake --preset` needs
#                                                    besides: --fresh where another version of Ostia has used the folder.
#   scripts/check_build.sh after PRESET              After a failure: says so where the disk is full.
set -euo pipefail
cd "$(dirname "$0")/.."
when=$1 preset=$2 needed_gb=${3:-0}
folder=build/$preset
cache=$folder/CMakeCache.txt

refuse() {
  echo "Cannot build: $1" >&2
  exit 2
}

free_mb() {
  local place=$folder
  while [ ! -d "$place" ]; do place=$(dirname "$place"); done
  df --output=avail -BM "$place" | tail -1 | tr -dc 0-9
}

cached() {
  [ ! -f "$cache" ] || sed -n "s/^$1:[A-Z]*=//p" "$cache"
}

if [ "$when" = after ]; then
  [ "$(free_mb)" -ge 100 ] || refuse "the disk that holds $folder is full; make room and run the same again, what is built is kept"
  exit 0
fi

needed=$(sed -n 's/^cmake_minimum_required(VERSION \([0-9.]*\)).*/\1/p' CMakeLists.txt)
has=$(cmake --version 2>/dev/null | sed -n 's/^cmake version \([0-9.]*\).*/\1/p') || true
[ -n "$has" ] || refuse "there is no cmake; install it: apt install cmake"
[ "$(printf '%s\n' "$needed" "$has" | sort -V | head -1)" = "$needed" ] ||
  refuse "CMake $has is too old, $needed is needed: use Debian 12's (apt install cmake) or pip's (pip install cmake)"

made_for=$(cached CMAKE_HOME_DIRECTORY)
[ -z "$made_for" ] || [ "$(realpath -m "$made_for")" = "$PWD" ] ||
  refuse "$folder was made from the sources in $made_for; move it away (mv $folder $folder-old) and run the same again"

free=$(free_mb)
[ "$free" -ge $((needed_gb * 1024)) ] ||
  refuse "$folder needs $needed_gb GB and its disk has $((free / 1024)).$((free % 1024 * 10 / 1024)) GB free; make room and run the same again"

version=$(sed -n 's/^project(ostia VERSION \([0-9.]*\).*/\1/p' CMakeLists.txt)
before=$(cached CMAKE_PROJECT_VERSION)
if [ -n "$before" ] && [ "$before" != "$version" ]; then
  echo "$folder was made by Ostia $before and is configured anew for $version" >&2
  echo --fresh
fi
