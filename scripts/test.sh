#!/usr/bin/env bash
# Packages, build, tests: scripts/test.sh [--all]
# --all adds the slow tests, the benchmarks (compiled, not run), the build of each source by itself, and the sanitizer build.
# Tests on real inputs look for them in $OSTIA_SHARED_DATA or ../shared/data and are skipped, by name, where there are none.
set -euo pipefail
cd "$(dirname "$0")/.."
all=no
[ "${1:-}" = --all ] && all=yes

# A window beside other programs may lose the keyboard or miss its moment: a few tests of windows that failed are run once
# more, alone, and stay named in what is printed. All others have another reason.
tests() {
  ctest --test-dir "$@" && return
  local failed="$1/Testing/Temporary/LastTestsFailed.log"
  [ -e "$failed" ] && [ "$(wc -l < "$failed")" -le 3 ] && ! grep -qv '^[0-9]*:workstation\.' "$failed" || return 1
  echo "Failed beside others, and run once more alone:"
  sed 's/^[0-9]*:/  /' "$failed"
  ctest --test-dir "$1" --rerun-failed
}

scripts/build.sh release
export CTEST_OUTPUT_ON_FAILURE=1
if [ "$all" = yes ]; then
  scripts/install_packages.sh scripts/packages-slow.txt  # what slow tests alone need, a gigabyte
  tests build/release --parallel "$(nproc)"
  scripts/build.sh release benchmarks
  scripts/build.sh plain
  scripts/build.sh asan
  tests build/asan --parallel "$(nproc)" --label-regex '^unit$'
else
  tests build/release --parallel "$(($(nproc) + 2))" --label-exclude '^slow$'
fi
