#!/usr/bin/env bash
# installed_tree_test.sh SOURCE BUILD: what is installed works where it is moved to, knows nothing of the folders that it was built
# from, and has the public headers.
source "$(dirname "$0")/common.sh"
source=$1 build=$2
for component in programs workstation development; do
  cmake --install "$build" --prefix "$work/first" --component $component > /dev/null
done

found=$(grep -rlF -e "$source" -e "$build" "$work/first" || true)
[ -z "$found" ] || fail "these name the folder of the sources or of the build: $found"

(cd "$source" && for room in libs/*/include; do (cd "$room" && find . -name '*.h'); done) | sort > "$work/public"
(cd "$work/first/include" && find . -type f) | sort > "$work/installed"
diff "$work/public" "$work/installed" || fail "the headers installed are not those of libs/*/include"

mv "$work/first" "$work/moved"
PATH=$work/moved/bin:$PATH
[ ! -e "$work/moved/bin/ostia-worker" ] || fail "the worker is no command"
(cd "$work" && ostia model --builtin -o model --quiet > /dev/null) || fail "ostia model --builtin in an installed tree"
[ -s "$work/model/mesh.vtu" ] || fail "no mesh"

share=$work/moved/share
for page in ostia ostia-model ostia-evaluate ostia-evaluate-lumen ostia-live ostia-workstation; do
  [ -s "$share/man/man1/$page.1" ] || fail "no manual page $page(1)"
done
# The pages say what --help says.
grep -q 'From an image, a mask or a surface to a mesh with named faces' "$share/man/man1/ostia-model.1" || fail "ostia-model(1) does not say what it does"
grep -q '\\fB\\-\\-builtin\\fR' "$share/man/man1/ostia-model.1" || fail "ostia-model(1) has no --builtin"
for picture in $(grep -oh '](\.\./[^)]*\.png)' "$share"/ostia/manual/*.md | tr -d '()' | sed 's/^\]//' | sort -u); do
  [ -s "$share/ostia/manual/$picture" ] || fail "the installed manual lacks its picture $picture"
done

# complete WORDS ...: what bash offers for the last of them.
complete_words() {
  COMP_WORDS=("$@") COMP_CWORD=$(($# - 1)) COMPREPLY=()
  _ostia
  echo "${COMPREPLY[*]}"
}
compopt() { :; }  # it works within a completion of the shell alone
source "$share/bash-completion/completions/ostia"
[ "$(complete_words ostia evaluate lum)" = lumen ] || fail "bash: the command below evaluate"
[ "$(complete_words ostia info --log '')" = "text json" ] || fail "bash: the words of --log"
[ "$(complete_words ostia model --built)" = --builtin ] || fail "bash: an option of model"
[ "$(complete_words ostia model --thre)" = --threads ] || fail "bash: an option of all commands"
[ -z "$(complete_words ostia model -o '')" ] || fail "bash: a folder is the shell's own to complete"
[ -z "$(complete_words ostia info --built)" ] || fail "bash: an option of another command"
if command -v zsh > /dev/null; then zsh -n "$share/zsh/site-functions/_ostia" || fail "zsh cannot read the completion"; fi
