#!/usr/bin/env bash
# Makes the pictures of README and docs anew, with the program itself: scripts/make_pictures.sh
set -euo pipefail
cd "$(dirname "$0")/.."
[ -x build/release/bin/ostia ] || scripts/build.sh release
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
build/release/bin/ostia model --builtin -o "$work/builtin"
mkdir -p docs/pictures
cp "$work"/builtin/pictures/*.png docs/pictures/
build/release/bin/ostia phantom -o "$work/phantom" --preset full --seed 3 --formats nrrd
for picture in axial mip tree; do
  cp "$work/phantom/dataset00/report/$picture.png" "docs/pictures/phantom-$picture.png"
done
