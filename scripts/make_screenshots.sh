#!/usr/bin/env bash
# Makes the pictures of the user's manual anew, with the program itself on the sample case, by keys and mouse:
# scripts/make_screenshots.sh [BUILD_FOLDER [PART...]]. The parts: sample (most of what is on the sample case; five
# minutes on two cores, most of it for the case itself), heart (of the sample case), keys, calcium (of the scan in
# OSTIA_SHARED_DATA), fat (of the sample case), comparison (of a synthetic patient scanned twice), pacs (needs orthanc).
# All of them without a name.
set -euo pipefail
cd "$(dirname "$0")/.."
bin=${1:-build/release}/bin
shift || true
parts=${*:-sample heart keys calcium fat comparison pacs}
[ -x "$bin/ostia-workstation" ] || scripts/build.sh release
out=docs/images/manual
mkdir -p "$out"
work=$(mktemp -d)
export OSTIA_NO_TOUR=1 LANG=C.UTF-8 QT_SCALE_FACTOR=1 DISPLAY=:$((RANDOM % 400 + 500))
Xvfb "$DISPLAY" -screen 0 1280x800x24 -fbdir "$work" -nolisten tcp -noreset >/dev/null 2>&1 &
server=$!
program=
stop() {
  [ -z "$program" ] || kill "$program" 2>/dev/null || true
  kill "$server" 2>/dev/null || true
  rm -rf "$work"
}
trap stop EXIT
sleep 1

start() {
  "$bin/ostia-workstation" --state-folder "$work/state" "$@" >"$work/log" 2>&1 &
  program=$!
}
shot() {
  sleep "${2:-1}"
  python3 scripts/screen_to_png.py "$work/Xvfb_screen0" "$out/$1.png"
}
keys() {
  for key in "$@"; do
    xdotool key "$key"
    sleep 0.3
  done
}
at() { xdotool mousemove "$1" "$2"; }
# Without a window manager a click alone gives the window the keyboard: on a title, where it does nothing.
front() {
  at 120 72
  xdotool click 1
  sleep 0.5
}
# drag X Y X Y ...: with the main button down from place to place
drag() {
  at "$1" "$2"
  sleep 0.2
  xdotool mousedown 1
  shift 2
  while [ $# -gt 0 ]; do
    at "$1" "$2"
    sleep 0.1
    shift 2
  done
  xdotool mouseup 1
  sleep 0.5
}

# What has no key of its own, by the palette.
command() {
  keys ctrl+k
  xdotool type --delay 20 "$1"
  sleep 0.5
  keys Return
}
done_with() {
  kill "$program"
  wait "$program" 2>/dev/null || true
  program=
}
# The window in front, with the sample case and its image.
sample() {
  rm -f "$work/frames"
  start --sample --frame-log "$work/frames"
  until grep -qs '"view":"cpr1".*"picture":[1-9]' "$work/frames"; do sleep 1; done # the image comes after the case
  sleep 5
  front
}

of_sample() {
  sample
  at 640 790
  keys l
  sleep 20 # plaque is looked for
  shot window 3

  # A stenosis between two places of reference.
  keys s
  drag 410 420 410 595
  shot measuring 2
  # Its stretch as one that the image does not show.
  keys ctrl+3
  shot evaluability 2
  keys ctrl+z

  keys Escape Escape alt+6 F11
  shot tree 3
  keys F11 alt+4 F11
  shot section 2
  keys F11

  keys ctrl+comma ctrl+Tab
  shot preferences 2
  keys Escape
  front
  keys alt+v q
  shot qa 3
  keys alt+v q
  keys ctrl+z # the measurement

  # The RCA's stenosis, large, with its calcified plaque on the left of the first CPR: there the model's wall takes
  # some of the calcium for lumen. It is drawn anew where the phantom has it, and pulled there.
  keys ctrl+Right ctrl+Right ctrl+Right ctrl+Right ctrl+Right ctrl+Right ctrl+Home l
  keys bracketleft bracketleft bracketleft bracketleft
  keys alt+2 plus plus plus plus plus alt+4 plus plus plus alt+9
  # On the profile, beyond the stenosis and then before it: so the CPRs have it in their middle.
  for x in 379 150; do
    at "$x" 680
    xdotool click 1
    sleep 1
  done
  keys l ctrl+Up ctrl+Up alt+2 w
  drag 383 244 386 255 389 267 391 278 394 289 396 301 398 312 399 323 399 334 399 357 399 380 399 391 398 402 \
    397 414 395 425 393 436 390 448
  at 330 500
  shot editing 2
  keys ctrl+z e
  drag 393 318 395 318 397 318 398 318
  shot pull 2

  keys Escape Escape
  front
  command "Three planes alone"
  shot planes 4
  command "All views"
  command "Set orientation"
  shot orientation 2
  keys Escape
  done_with
}

of_heart() {
  sample
  command "Look: coronary arteries"
  command "Box with handles"
  keys alt+6 F11
  shot heart 60
  done_with
}

of_keys() {
  start
  sleep 3
  front
  keys F1
  shot keys 2
  done_with
}

of_calcium() {
  start "${OSTIA_SHARED_DATA:?where the scans for tests are}/ct/calcium-score/calcium-score.nrrd"
  sleep 40 # the search for arteries, which finds none
  front
  keys alt+5 F11 ctrl+shift+a
  sleep 40
  at 1000 310 # the first lesion
  xdotool click 1
  shot calcium 3
  done_with
}

of_fat() {
  sample
  keys ctrl+alt+f
  sleep 30
  shot fat 5
  done_with
}

# A patient whose disease was half of today's, in a scan with less contrast and more noise.
of_comparison() {
  for scan in "before --disease 0.5 --contrast 380 --noise 30" now; do
    read -r name options <<<"$scan"
    # shellcheck disable=SC2086
    "$bin/ostia" phantom -o "$work/$name" --preset small --formats nrrd --no-report $options
    "$bin/ostia" lumen "$work/$name/dataset00/centerlines.vtp" -o "$work/$name.vtp" \
      --image "$work/$name/dataset00/image00.nrrd" --case "$work/$name.ostia"
  done
  mkdir -p "$work/state"
  python3 - "$work" <<'MACHINE'
import hashlib, json, pathlib, sys
work = pathlib.Path(sys.argv[1])
images = [work / name / "dataset00/image00.nrrd" for name in ("before", "now")]
seen = {hashlib.sha256(image.read_bytes()).hexdigest(): {"path": str(image), "seen": 1} for image in images}
(work / "state/machine.json").write_text(json.dumps({"v": 1, "images": seen, "recent": [], "settings": {}}))
MACHINE
  start "$work/now.ostia"
  sleep 15
  front
  keys ctrl+alt+b
  sleep 2
  xdotool type --delay 20 "$work/before.ostia"
  keys Return
  sleep 60
  front
  keys i i
  shot comparison 3
  keys z
  shot comparison-blink 3
  done_with
}

# An archive on this machine with a small series, and an object that waits for a server that is not there.
of_pacs() {
  python3 scripts/screenshot_archive.py "$bin" "$work" &
  archive=$!
  until [ -e "$work/archive-ready" ]; do sleep 1; done
  export XDG_CONFIG_HOME="$work/config"
  start
  sleep 3
  front
  command "From the PACS"
  sleep 2
  keys Return
  sleep 3
  keys Tab Tab Tab Tab Tab Tab Tab Tab Home Right # unfolds the study
  at 700 760
  shot archive 8
  keys Escape
  front
  command "Outbox"
  shot outbox 2
  done_with
  unset XDG_CONFIG_HOME
  kill "$archive" 2>/dev/null || true
}

for part in $parts; do "of_$part"; done
ls -l "$out"
