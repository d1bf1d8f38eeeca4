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

# expect_one_line TEXT COMMAND ...: the command fails, and one line with TEXT in it on standard error is all that it says.
expect_one_line() {
  local text=$1
  shift
  if "$@" > "$work/out" 2> "$work/err"; then fail "this should have been refused: $*"; fi
  [ ! -s "$work/out" ] || fail "\"$text\" is not all that was said; on standard output: $(cat "$work/out")"
  [ "$(wc -l < "$work/err")" = 1 ] && [ -z "$(tail -c 1 "$work/err")" ] || fail "\"$text\" is no single line: $(cat "$work/err")"
  [[ $(cat "$work/err") == *"$text"* ]] || fail "\"$text\" was not said but: $(cat "$work/err")"
}
