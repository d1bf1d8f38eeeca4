#!/usr/bin/env bash
# Makes the pictures of the user's manual anew, with the program itself on the sample case, by keys and mouse:
# scripts/make_screenshots.sh [BUILD_FOLDER]. Five minutes on two cores, most of it for the sample case.
set -euo pipefail
cd "$(dirname "$0")/.."
bin=${1:-build/release}/bin
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

start --sample
until grep -qs '"open_case": "/' "$work/state/machine.json"; do sleep 1; done
sleep 20 # the image of the case comes after the case
front
at 640 790
keys l
shot window 3

# A stroke along the wall of the stenosis on the first CPR, then a pull.
keys w
drag 419 450 420 480 419 510 418 535 418 560 419 590
shot editing 2
keys ctrl+z e
drag 424 380 429 380
shot pull 2
keys ctrl+z

# A stenosis between two places of reference.
keys s
drag 410 420 410 595
shot measuring 2

keys Escape Escape alt+6 F11
shot tree 3
keys F11 alt+4 F11
shot section 2
keys F11

keys F1
shot keys 2
keys Escape
front
keys ctrl+comma ctrl+Tab
shot preferences 2
keys Escape
front
keys alt+v q
shot qa 3
keys alt+v q
keys alt+h t
keys Right Right
shot tour 2
ls -l "$out"
