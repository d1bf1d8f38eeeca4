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
