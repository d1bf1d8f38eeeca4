#!/usr/bin/env bash
# Tries the packages of scripts/package.sh in a clean Debian 12: scripts/try_packages.sh [PACKAGE_FOLDER] [OUTPUT_FOLDER]
# Installs them, makes the first model, opens a case in the workstation (a picture of its window), builds the example
# with libostia-dev, reads the model with python3-ostia, purges all of it and looks for what is left.
# Needs root and the network; some 5 GB of disk. Ends with 1 where something is not as it must be.
# Nothing of this machine is mounted into the clean Debian; its /proc is mounted in a namespace of its own.
set -euo pipefail
cd "$(dirname "$0")/.."
packages=$(realpath "${1:-out/packages}")
out=$(realpath -m "${2:-out/packages-tried}")
most_s=180  # from apt install to the first model

[ "$(id -u)" = 0 ] || { echo "try_packages.sh: a clean Debian needs root; run it by sudo" >&2; exit 2; }
ls "$packages"/ostia_*.deb > /dev/null 2>&1 || { echo "try_packages.sh: no packages in $packages; run scripts/package.sh" >&2; exit 2; }
scripts/install_packages.sh scripts/packages-packaging.txt
mkdir -p "$out"

base=$(mktemp -d)
root=$base/root
clean_up() {
  if grep -q " $base/" /proc/mounts; then
    echo "try_packages.sh: something is mounted below $base; it is left there" >&2
  else
    rm -rf --one-file-system "$base"
  fi
}
trap clean_up EXIT
failed=0
complain() {
  echo "FAILED: $1" >&2
  failed=1
}

# Runs a line of shell in the clean Debian.
inside() {
  unshare --mount --pid --fork bash -c 'mount -t proc proc "$1/proc" && exec chroot "$1" env -i HOME=/root \
    PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin DEBIAN_FRONTEND=noninteractive LC_ALL=C.UTF-8 bash -ec "$2"' _ "$root" "$1"
}
# All but what we put there and what the runs of the programs make.
files() {
  (cd "$root" && find . -xdev \( -path ./proc -o -path ./tmp -o -path ./root -o -path ./packages \) -prune -o -print) | sort
}

echo "A clean Debian 12 ..."
mmdebstrap --quiet --variant=minbase bookworm "$root" \
  "deb http://deb.debian.org/debian bookworm main" "deb http://deb.debian.org/debian-security bookworm-security main"
cp -L /etc/resolv.conf "$root/etc/resolv.conf"
files > "$base/before"
mkdir "$root/packages"
cp "$packages"/*.deb "$root/packages"

echo "apt install ..."
start=$(date +%s)
inside 'apt-get update -q; apt-get install -q -y /packages/ostia*.deb' > "$out/install.log" 2>&1 || { tail -5 "$out/install.log" >&2; complain "apt install"; exit 1; }
installed=$(date +%s)
inside 'cd /root && ostia model --builtin -o model --progress none' > "$out/model.log" 2>&1 || { tail -5 "$out/model.log" >&2; complain "ostia model --builtin"; }
modelled=$(date +%s)
echo "apt install: $((installed - start)) s; the first model: $((modelled - installed)) s; together $((modelled - start)) s (at most $most_s)"
[ $((modelled - start)) -le "$most_s" ] || complain "more than $most_s s from apt install to the first model"
[ -s "$root/root/model/mesh.vtu" ] || complain "no model/mesh.vtu"

echo "The manual pages, the completions ..."
inside 'for page in ostia ostia-model ostia-live ostia-workstation; do [ -s /usr/share/man/man1/$page.1.gz ]; done
        source /usr/share/bash-completion/completions/ostia; COMP_WORDS=(ostia mod) COMP_CWORD=1; _ostia; [ "${COMPREPLY[*]}" = model ]' ||
  complain "manual pages or completions"

echo "The workstation ..."
inside 'cd /root && ostia lumen model/centerlines.vtp -o lumen.vtp --case first.ostia --quiet > /dev/null'
grep -q "application/x-ostia-case:\*.ostia" "$root/usr/share/mime/globs2" || complain "the type of *.ostia is not known"
inside 'apt-get install -q -y --no-install-recommends xvfb' >> "$out/install.log" 2>&1
inside 'mkdir /tmp/screen; Xvfb :7 -screen 0 1600x1000x24 -fbdir /tmp/screen -noreset > /tmp/xvfb.log 2>&1 & sleep 3
        export DISPLAY=:7 LIBGL_ALWAYS_SOFTWARE=1; ostia-workstation --no-tour /root/first.ostia > /tmp/workstation.log 2>&1 & program=$!
        sleep 20; kill -0 $program; cp /tmp/screen/Xvfb_screen0 /tmp/picture.xwd; kill $program' || complain "the workstation: $(cat "$root/tmp/workstation.log")"
if [ -s "$root/tmp/picture.xwd" ]; then
  python3 scripts/screen_to_png.py "$root/tmp/picture.xwd" "$out/workstation.png"
  [ "$(stat -c %s "$out/workstation.png")" -gt 10000 ] || complain "the workstation's window is empty ($out/workstation.png)"
fi

echo "The libraries ..."
inside 'apt-get install -q -y --no-install-recommends /packages/libostia-dev_*.deb cmake g++ make' >> "$out/install.log" 2>&1 || complain "apt install libostia-dev"
inside 'cmake -S /usr/share/doc/libostia-dev/examples/consumer -B /tmp/example && cmake --build /tmp/example &&
        /tmp/example/layered_mesh /root/model/lumen.vtp /tmp/layered.vtu && ostia mesh --check /tmp/layered.vtu' > "$out/example.log" 2>&1 || complain "the example: $(tail -3 "$out/example.log")"

echo "Python ..."
inside 'apt-get install -q -y --no-install-recommends /packages/python3-ostia_*.deb' >> "$out/install.log" 2>&1 || complain "apt install python3-ostia"
inside 'cd /root && python3 -c "import ostia; print(ostia.read_surface(\"model/lumen.vtp\"))"' > "$out/python.log" 2>&1 || complain "Python: $(tail -3 "$out/python.log")"
[ -s "$root/usr/share/doc/ostia/python/index.html" ] || complain "no reference of the Python package"

echo "apt purge ..."
for package in "$packages"/*.deb; do dpkg-deb --fsys-tarfile "$package" | tar -t | grep -v '/$' | sed 's#/$##'; done | sort > "$base/ours"
inside 'apt-get purge -q -y "ostia*" libostia-dev python3-ostia xvfb && apt-get autoremove -q -y --purge' > "$out/purge.log" 2>&1 || complain "apt purge"
files > "$base/after"
comm -23 "$base/before" "$base/after" > "$base/gone"
[ ! -s "$base/gone" ] || complain "the purge took what was there before: $(head -3 "$base/gone")"
# Debian's own packages leave some of their files; of ours nothing may be left, nor be known to dpkg.
comm -13 "$base/before" "$base/after" > "$base/left"
{ comm -12 "$base/left" "$base/ours"; grep -i ostia "$base/left" || true; grep -A1 -i '^Package: .*ostia' "$root/var/lib/dpkg/status" || true; } | sort -u > "$out/left.txt"
[ ! -s "$out/left.txt" ] || complain "this is left after the purge: $(head -5 "$out/left.txt")"
[ "$failed" = 0 ] && echo "All is well; logs and the picture are in $out"
exit "$failed"
