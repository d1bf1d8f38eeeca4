#!/usr/bin/env bash
# Takes what the workstation shows in each of its states as the accepted pictures, data/golden/workstation:
# scripts/accept_screenshots.sh [BUILD_FOLDER] [STATE ...]. A minute and a half for all states, which are those of
# tests/workstation/window_states.cpp. Look at the pictures before they are committed.
set -euo pipefail
cd "$(dirname "$0")/.."
build=${1:-build/release}
[ $# = 0 ] || shift
test=$build/bin/screenshot_test
[ -x "$test" ] || { echo "accept_screenshots.sh: no program $test; build it first or name the build folder" >&2; exit 2; }
filter='*'
if [ $# -gt 0 ]; then
  filter=$(printf '*/%s:' "$@")
fi
mkdir -p data/golden/workstation
OSTIA_WRITE_GOLDEN=1 xvfb-run -a -s '-screen 0 1600x1200x24 -noreset' "$test" "--gtest_filter=$filter"
ls -l data/golden/workstation
