#!/usr/bin/env bash
# Installs packages and builds: scripts/build.sh [PRESET [TARGET ...]]
# PRESET is release unless told (cmake --list-presets). TARGETs: `programs` what a user runs, `python` the Python package,
# `benchmarks`, or any other; without one, programs and tests.
set -euo pipefail
cd "$(dirname "$0")/.."
preset=${1:-release}
[ $# -eq 0 ] || shift
case "$*" in
  programs) lists=(scripts/packages.txt) needed_gb=2 ;;
  python) lists=(scripts/packages.txt scripts/packages-python.txt) needed_gb=2 ;;
  *) lists=(scripts/packages.txt scripts/packages-test.txt) needed_gb=6 ;;
esac
scripts/install_packages.sh "${lists[@]}"
fresh=$(scripts/check_build.sh before "$preset" $needed_gb)
options=()
if [ "$*" != programs ] && [ "$*" != python ]; then
  options=(-DOSTIA_TESTS=ON -DOSTIA_BENCHMARKS=ON)
elif [ -n "$fresh" ] || [ ! -e "build/$preset/CMakeCache.txt" ]; then
  options=(-DOSTIA_TESTS=OFF -DOSTIA_BENCHMARKS=OFF)
fi
if [ "$*" = python ]; then
  options+=(-DOSTIA_PYTHON=ON)
  set -- ostia_python
fi
cmake --preset "$preset" $fresh "${options[@]}"
cmake --build --preset "$preset" ${*:+--target "$@"} || { scripts/check_build.sh after "$preset"; exit 1; }
