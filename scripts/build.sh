#!/usr/bin/env bash
# Installs packages and builds: scripts/build.sh [PRESET [TARGET ...]]
# PRESET is release unless told (cmake --list-presets). TARGETs: `programs` what a user runs, `python` the Python package
# (with `python_docs` its reference, which needs Sphinx), `benchmarks`, or any other; without one, programs and tests.
set -euo pipefail
cd "$(dirname "$0")/.."
preset=${1:-release}
[ $# -eq 0 ] || shift
tests=OFF
case "$*" in
  programs) lists=(scripts/packages.txt) needed_gb=2 ;;
  python | "python python_docs") lists=(scripts/packages.txt scripts/packages-python.txt) needed_gb=2 ;;
  *) lists=(scripts/packages.txt scripts/packages-test.txt) needed_gb=6 tests=ON ;;
esac
scripts/install_packages.sh "${lists[@]}"
fresh=$(scripts/check_build.sh before "$preset" $needed_gb)
options=()
if [ $tests = ON ]; then
  options=(-DOSTIA_TESTS=ON -DOSTIA_BENCHMARKS=ON)
elif [ -n "$fresh" ] || [ ! -e "build/$preset/CMakeCache.txt" ]; then
  options=(-DOSTIA_TESTS=OFF -DOSTIA_BENCHMARKS=OFF)
fi
if [ "${1:-}" = python ]; then
  options+=(-DOSTIA_PYTHON=ON)
  set -- ostia_python "${@:2}"
fi
cmake --preset "$preset" $fresh "${options[@]}"
cmake --build --preset "$preset" ${*:+--target "$@"} || { scripts/check_build.sh after "$preset"; exit 1; }
