#!/usr/bin/env bash
# Installs Debian packages that are missing: scripts/install_packages.sh [LIST ...]
# A list is a file of names, one a line; without one, what building and running need (scripts/packages.txt).
set -euo pipefail
cd "$(dirname "$0")/.."
[ $# -gt 0 ] || set -- scripts/packages.txt

missing=()
while read -r package; do
  [ -n "$package" ] || continue
  [ "$(dpkg-query -W -f='${db:Status-Status}' "$package" 2>/dev/null || true)" = installed ] || missing+=("$package")
done < <(cat "$@")
[ ${#missing[@]} -gt 0 ] || exit 0

as_root=()
if [ "$(id -u)" -ne 0 ]; then
  command -v sudo >/dev/null || {
    echo "install_packages.sh: packages are missing and there is no sudo; install these as root and run the same again: apt install ${missing[*]}" >&2
    exit 1
  }
  as_root=(sudo)
fi
echo "Installing ${#missing[@]} packages: ${missing[*]}"
export DEBIAN_FRONTEND=noninteractive
if ! { "${as_root[@]}" apt-get update -q && "${as_root[@]}" apt-get install -q -y --no-install-recommends "${missing[@]}"; }; then
  echo "install_packages.sh: apt-get failed (see above); see to the network and to /etc/apt/sources.list, then run it again" >&2
  exit 1
fi
