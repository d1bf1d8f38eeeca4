#!/usr/bin/env bash
# Packages, build, tests: scripts/test.sh [--all]
# --all adds the slow tests, the benchmarks (compiled, not run), the build of each source by itself, and the sanitizer build.
# Tests on real inputs look for them in $OSTIA_SHARED_DATA or ../shared/data and are skipped, by name, where there are none.
set -euo pipefail
cd "$(dirname "$0")/.."
all=no
[ "${1:-}" = --all ] && all=yes

scripts/build.sh release
export CTEST_OUTPUT_ON_FAILURE=1
if [ "$all" = yes ]; then
  ctest --test-dir build/release --parallel "$(nproc)"
  scripts/build.sh release benchmarks
  scripts/build.sh plain
  scripts/build.sh asan
  ctest --test-dir build/asan --parallel "$(nproc)" --label-regex '^unit$'
else
  ctest --test-dir build/release --parallel "$(($(nproc) + 2))" --label-exclude '^slow$'
fi
