#!/usr/bin/env bash
# What is found, and what is refused, in real images, pictured on one page: scripts/real_images.sh [DATA [OUTPUT_FOLDER]]
# DATA has the folders cta/ and ct/ of the shared data (default: $OSTIA_SHARED_DATA, else ../shared/data); what it lacks is named
# and left out. The page is index.html (default folder: out/real-images). Its pictures show patients: look at the images' licences
# before passing them on. docs/experiments/real-images.md tells what it showed.
set -euo pipefail
cd "$(dirname "$0")/.."
data=${1:-${OSTIA_SHARED_DATA:-../shared/data}}
out=${2:-out/real-images}
ostia=$PWD/build/release/bin/ostia
[ -x "$ostia" ] || scripts/build.sh release programs
[ -d "$data" ] || { echo "real_images.sh: there is no folder $data; name the one with cta/ and ct/" >&2; exit 2; }
[ ! -e "$out" ] || { echo "real_images.sh: $out is there already; name another folder, or move it away" >&2; exit 2; }
mkdir -p "$out"
page=$out/index.html

escaped() { sed 's/&/\&amp;/g; s/</\&lt;/g; s/>/\&gt;/g'; }
part() { printf '<h2>%s</h2>\n<p>%s</p>\n' "$1" "$2" >> "$page"; }
said() { { echo '<pre>'; escaped < "$1"; echo '</pre>'; } >> "$page"; }
pictures() { for picture in "$@"; do echo "<img src=\"${picture#"$out"/}\" alt=\"\">" >> "$page"; done; }
# Is it there? What is not is named on the page, too.
there() {
  [ -e "$data/$1" ] && return
  echo "not there: $data/$1"
  part "$1" "Not there."
  return 1
}
# The coronary tree without a click: what was found and told, or why not, with the image's planes.
search() {
  local name=$1 file=$2 what=$3
  there "$file" || return 0
  local start=$EPOCHREALTIME code=0
  "$ostia" --progress none extract "$data/$file" -o "$out/$name.ostia" > "$out/$name.txt" 2>&1 || code=$?
  local seconds; seconds=$(awk -v a="$start" -v b="$EPOCHREALTIME" 'BEGIN { printf "%.1f", b - a }')
  part "$file" "$what. ostia extract: exit code $code, $seconds s."
  echo "$file: exit code $code, $seconds s"
  said "$out/$name.txt"
  if [ "$code" = 0 ]; then
    "$ostia" report "$out/$name.ostia" --image "$data/$file" -o "$out/$name-report" > /dev/null 2>&1
    pictures "$out/$name-report/images"/*.png
  else
    "$ostia" info "$data/$file" --preview "$out/$name-slices" --preview-slices 0 > /dev/null 2>&1
    pictures "$out/$name-slices/planes.png"
  fi
}
# One vessel between two clicks.
guided() {
  local name=$1 file=$2 what=$3 branch=$4
  there "$file" || return 0
  local code=0
  "$ostia" --progress none model "$data/$file" -o "$out/$name" --branch="$branch" > "$out/$name.txt" 2>&1 || code=$?
  part "$file" "$what, from $branch. ostia model: exit code $code."
  echo "$file, $what: exit code $code"
  said "$out/$name.txt"
  [ ! -d "$out/$name/pictures" ] || pictures "$out/$name/pictures"/*.png
}

cat > "$page" << 'END'
<!doctype html><meta charset="utf-8"><title>Ostia on real images</title>
<style>body{font:15px sans-serif;max-width:70em;margin:2em auto}img{max-width:100%;border:1px solid #999;margin:4px}pre{white-space:pre-wrap;background:#f2f2f2;padding:1em}</style>
<h1>Ostia on real images</h1>
END
search aorta cta/totalsegmentator-aorta-cta/ct_cropped.nii.gz "Arterial chest CT of a dissected, partly stented aorta, whole heart, 1.5 mm"
search slab cta/coronary-cta-slab/slab.nrrd "25 slices of a gated coronary CTA, above the ostia"
search heart cta/rider-pilot-chest-pe-cta/heart-crop.nrrd "Heart of a chest CT angiogram, not gated, without the aortic root"
search chest cta/rider-pilot-chest-pe-cta/dicom-series-95.zip "The whole series, DICOM in a zip"
search slices cta/totalsegmentator-ct-dicom-20 "20 slices of a CT of the trunk, JPEG 2000"
search calcium ct/calcium-score/calcium-score.nrrd "CT for calcium scoring, without contrast, slices of 3 mm"
guided lung-artery cta/rider-pilot-chest-pe-cta/dicom-series-95.zip "An artery of the lung" 60.0,-1.4,-211.6:91.0,-1.1,-240.0
guided descending-aorta cta/rider-pilot-chest-pe-cta/dicom-series-95.zip "The descending aorta" -4.3,-12.3,-273.0:-0.2,8.7,-210.4
echo "$page"
