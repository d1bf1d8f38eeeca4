# What the tests of installing share: a folder of their own that goes with them, and how a failure is told.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
unset OSTIA_WORKER CMAKE_PREFIX_PATH DESTDIR

fail() {
  echo "FAILED: $*" >&2
  exit 1
}

# expect_refusal TEXT COMMAND ...: the command fails and says TEXT, in whichever lines.
expect_refusal() {
  local text=$1 said
  shift
  if said=$("$@" 2>&1); then fail "this should have been refused: $*"; fi
  said=$(tr -s ' \n' ' ' <<< "$said")
  [[ $said == *"$text"* ]] || fail "\"$text\" was not said but: $said"
}
