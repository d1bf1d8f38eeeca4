#!/usr/bin/env bash
# The golden suite: `ostia model` on tiny synthetic cases with known truth, judged, and held against the figures that were accepted.
#
#   scripts/golden_suite.sh [--bin DIR] [--out DIR] [--update] [--docs]
#
#   --bin DIR   where the programs are (default build/release/bin); nothing is built
#   --out DIR   keeps models, figures and the report there (default: a folder that is removed at the end)
#   --update    takes the new figures as the expected ones, data/golden/expected
#   --docs      renews the tables and pictures of docs/experiments/accuracy.md
#
# Exit codes are those of `ostia evaluate suite`: 0 as good as expected, 4 something is worse or missing.
set -euo pipefail
cd "$(dirname "$0")/.."
golden=data/golden
bin=build/release/bin
out=
update=no
docs=no
while [ $# -gt 0 ]; do
  case "$1" in
    --bin) bin=$2; shift 2 ;;
    --out) out=$2; shift 2 ;;
    --update) update=yes; shift ;;
    --docs) docs=yes; shift ;;
    *) echo "golden_suite.sh: unknown option $1" >&2; exit 2 ;;
  esac
done
ostia=$bin/ostia
[ -x "$ostia" ] || { echo "golden_suite.sh: no program $ostia; build it first or name its folder with --bin" >&2; exit 2; }
pages=yes # reports and pictures of each case, where somebody will look at them
if [ -z "$out" ]; then
  out=$(mktemp -d)
  trap 'rm -rf "$out"' EXIT
  pages=$docs
fi
mkdir -p "$out/model" "$out/figures"

# Point of a share of the way along a reference line: "x,y,z".
point_at() {
  awk -v share="$2" 'NF >= 3 { x[n + 0] = $1; y[n + 0] = $2; z[n + 0] = $3; ++n }
    END { i = int(share * (n - 1) + 0.5); printf "%.4f,%.4f,%.4f\n", x[i], y[i], z[i] }' "$1"
}

# A person's three clicks: at the ostium, half way, and at the end of what the image holds.
branch_of() {
  echo "$(point_at "$1" 0):$(point_at "$1" 0.5):$(point_at "$1" 1)"
}

# Models some vessels of a case: the left coronary artery (vessel1 and on) or the right one (vessel0).
model() {
  local case=$1 part=$2 name code=0 arguments=()
  shift 2
  name=$(basename "$case")
  for vessel in "$@"; do
    arguments+=(--branch "$(branch_of "$vessel/reference.txt")")
  done
  "$ostia" model "$case"/image*.nrrd -o "$out/model/$name/$part" --quiet --inset 0.3 "${arguments[@]}" > "$out/$name-$part.log" 2>&1 || code=$?
  if [ "$code" != 0 ] && [ "$code" != 4 ]; then
    echo "golden_suite.sh: ostia model ended with $code on $name, $part:" >&2
    cat "$out/$name-$part.log" >&2
    exit "$code"
  fi
  mkdir -p "$out/figures/$name"
  cp "$out/model/$name/$part/report.json" "$out/figures/$name/model-$part.json"
  cp "$out/model/$name/$part/centerlines.vtp" "$out/figures/$name/centerlines-$part.vtp"
}

for case in "$golden"/dataset*; do
  name=$(basename "$case")
  mkdir -p "$out/model/$name"
  [ ! -d "$case/vessel0" ] || model "$case" right "$case/vessel0"
  left=()
  for vessel in "$case"/vessel[1-9]; do
    [ ! -d "$vessel" ] || left+=("$vessel")
  done
  [ ${#left[@]} = 0 ] || model "$case" left "${left[@]}"
  figures=$out/figures/$name
  for of in centerline lumen surface; do
    more=()
    [ $of != surface ] || more+=(--covered)
    [ $pages = no ] || more+=(-o "$out/$name-$of.html")
    [ $pages = no ] || [ $of != surface ] || more+=(--picture "$out/$name-surface.png")
    "$ostia" evaluate $of "$case" "$out/model/$name" --json --quiet "${more[@]}" > "$figures/$of.json"
  done
done

if [ "$update" = yes ]; then
  rm -rf "$golden/expected"
  cp -r "$out/figures" "$golden/expected"
fi
if [ "$docs" = yes ]; then
  python3 scripts/accuracy_tables.py "$out/figures" docs/experiments/accuracy.md
  mkdir -p docs/pictures
  for picture in "$out"/dataset*-surface.png; do
    cp "$picture" "docs/pictures/accuracy-$(basename "$picture" -surface.png).png"
  done
fi
"$ostia" evaluate suite "$golden/expected" "$out/figures" --tolerance "$golden/tolerance.json" -o "$out/report"
