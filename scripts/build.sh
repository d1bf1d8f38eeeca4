#!/usr/bin/env bash
# Installs packages and builds: scripts/build.sh [PRESET [TARGET ...]]
# PRESET is release unless told (cmake --list-presets). TARGETs: `programs` what a user runs, `benchmarks`, or any other;
# without one, programs and tests.
set -euo pipefail
cd "$(dirname "$0")/.."
preset=${1:-release}
[ $# -eq 0 ] || shift
if [ "$*" = programs ]; then
  lists=(scripts/packages.txt) needed_gb=2
else
  lists=(scripts/packages.txt scripts/packages-test.txt) needed_gb=6
fi
scripts/install_packages.sh "${lists[@]}"
fresh=$(scripts/check_build.sh before "$preset" $needed_gb)
options=()
if [ "$*" != programs ]; then
  options=(-DOSTIA_TESTS=ON -DOSTIA_BENCHMARKS=ON)
elif [ -n "$fresh" ] || [ ! -e "build/$preset/CMakeCache.txt" ]; then
  options=(-DOSTIA_TESTS=OFF -DOSTIA_BENCHMARKS=OFF)
fi
cmake --preset "$preset" $fresh "${options[@]}"
cmake --build --preset "$preset" ${*:+--target "$@"} || { scripts/check_build.sh after "$preset"; exit 1; }
