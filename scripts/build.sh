#!/usr/bin/env bash
# Installs packages and builds: scripts/build.sh [PRESET [TARGET ...]]
# PRESET is release unless told (cmake --list-presets). TARGETs: `programs` what a user runs, `benchmarks`, or any other;
# without one, programs and tests.
set -euo pipefail
cd "$(dirname "$0")/.."
preset=${1:-release}
[ $# -eq 0 ] || shift
lists=(scripts/packages.txt)
options=()
if [ "$*" != programs ]; then
  lists+=(scripts/packages-test.txt)
  options=(-DOSTIA_TESTS=ON -DOSTIA_BENCHMARKS=ON)
elif [ ! -e "build/$preset/CMakeCache.txt" ]; then
  options=(-DOSTIA_TESTS=OFF -DOSTIA_BENCHMARKS=OFF)
fi
scripts/install_packages.sh "${lists[@]}"
cmake --preset "$preset" "${options[@]}"
cmake --build --preset "$preset" ${*:+--target "$@"}
