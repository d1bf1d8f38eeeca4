#!/usr/bin/env bash
# Checks that our sources are formatted as .clang-format has it: scripts/check_format.sh [--fix]
# Names each file that is not, and exits with 1; --fix formats them.
set -euo pipefail
cd "$(dirname "$0")/.."
sources() { find libs apps bindings tests bench \( -name '*.h' -o -name '*.cpp' \) -print0 | sort -z; }
if [ "${1:-}" = --fix ]; then
  sources | xargs -0 clang-format -i
  exit 0
fi
wrong=$(sources | xargs -0 -n 100 -P "$(nproc)" clang-format --dry-run 2>&1 | sed -n 's/^\([^:]*\):.*clang-format-violations.*/\1/p' | sort -u)
[ -z "$wrong" ] && exit 0
echo "$wrong"
echo "These files are not formatted as .clang-format has it; scripts/check_format.sh --fix does it." >&2
exit 1
