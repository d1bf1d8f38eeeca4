#!/usr/bin/env bash
# What clang-tidy says of our sources (.clang-tidy): scripts/check_tidy.sh [SOURCE ...]
# All of libs and apps unless told; hours on two cores. Exits with 1 where it says anything.
set -euo pipefail
cd "$(dirname "$0")/.."
scripts/install_packages.sh scripts/packages-tidy.txt
# Each source by itself: no batches, no precompiled headers of another compiler.
[ -e build/plain/compile_commands.json ] || cmake --preset plain > /dev/null
[ $# -gt 0 ] || mapfile -t sources < <(git ls-files 'libs/*/src/*.cpp' 'apps/*.cpp')
printf '%s\0' "${@:-${sources[@]}}" |
  xargs -0 -n 4 -P "$(nproc)" clang-tidy -p build/plain --quiet --warnings-as-errors='*' \
    --extra-arg=-Wno-unknown-warning-option 2> >(grep -v 'warnings\? \(generated\|treated\)\|Suppressed' >&2)
