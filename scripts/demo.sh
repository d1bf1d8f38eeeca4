#!/usr/bin/env bash
# Packages, build, and the main job on the built-in case: scripts/demo.sh [OUTPUT_FOLDER]
set -euo pipefail
cd "$(dirname "$0")/.."
out=${1:-out/demo}
scripts/build.sh release programs
mkdir -p "$(dirname "$out")"
build/release/bin/ostia model --builtin -o "$out"
echo
echo "The model is in $out:"
ls -l "$out"
echo "Open $out/report.html in a browser, $out/mesh.vtu in ParaView."
if [ -n "${DISPLAY:-}" ]; then
  echo "The workstation opens with the sample case; the first time it is computed, which takes about two minutes."
  build/release/bin/ostia-workstation --sample
fi
