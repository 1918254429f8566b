#!/usr/bin/env bash
# try_packages.sh ROOT: installs the packages that `./dev package` built in a bare Debian 12, uses each
# as a stranger would, removes them, and fails if one of their files stays behind. Prints what it does.
set -euo pipefail
source_tree=$1
packages=$source_tree/build/package/packages
mirror=${KEYLINE_MIRROR:-http://deb.debian.org/debian}
[ "$(id -u)" -eq 0 ] || { echo "a bare root needs root" >&2; exit 2; }
ls "$packages"/*.deb >/dev/null 2>&1 || { echo "no packages yet: ./dev package" >&2; exit 2; }

base=$source_tree/build/package/bare.tar
[ -f "$base" ] || mmdebstrap --mode=root --variant=apt bookworm "$base" "$mirror"
bare=$(mktemp -d)
trap 'umount -q "$bare/proc" 2>/dev/null || true; rm -rf --one-file-system "$bare"' EXIT
tar -xf "$base" -C "$bare" --exclude=./dev/*
mkdir -p "$bare/debs" "$bare/dev" "$bare/work"
cp "$packages"/*.deb "$bare/debs"
cp "$source_tree"/examples/{bonnet-scan.csv,panel-a.json} "$source_tree/examples/cpp/readme.cpp" "$bare/work"
for device in null zero urandom; do
  [ -e "$bare/dev/$device" ] || cp -a "/dev/$device" "$bare/dev/" 2>/dev/null || touch "$bare/dev/$device"
done
cp /etc/resolv.conf "$bare/etc/resolv.conf" 2>/dev/null || true
mount -t proc proc "$bare/proc" 2>/dev/null || mount --bind /proc "$bare/proc" 2>/dev/null ||
  echo "no /proc in the bare root: keyline looks for its helpers in /usr/bin"

inside() {
  printf '+ %s\n' "$*"
  chroot "$bare" /usr/bin/env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root DEBIAN_FRONTEND=noninteractive \
    LC_ALL=C.UTF-8 sh -ec "cd /work; $*"
}
quietly() { inside "$*" >"$bare/log" 2>&1 || { tail -20 "$bare/log" >&2; return 1; }; head -1 "$bare/log"; }

quietly 'apt-get update'
# A root that is thrown away need not survive a power cut.
echo force-unsafe-io >"$bare/etc/dpkg/dpkg.cfg.d/thrown-away"
quietly 'apt-get install -y --no-install-recommends /debs/*.deb g++ pkg-config'
inside 'dpkg-query -W keyline keyline-cad keyline-studio python3-keyline keyline-plugins libkeyline-dev'
inside 'keyline --version'
inside 'keyline fair bonnet-scan.csv --quiet -o faired.svg -o faired.step && ls -s faired.svg faired.step'
inside 'keyline list faired.step | head -2'
inside 'keyline studio --version && test -s /usr/share/keyline/studio/index.html'
inside "python3 -c 'import keyline; print(keyline.lac.segment([[0, 0], [2, 0], [3, 1.5]], -1).length)'"
inside 'test -s /usr/share/inkscape/extensions/keyline/keyline_fair.inx && test -s /usr/share/freecad/Mod/Keyline/InitGui.py'
inside 'g++ -std=c++23 readme.cpp $(pkg-config --cflags --libs keyline-lac) -o readme && ./readme | tail -1'
inside 'test -s /usr/share/man/man1/keyline-fair.1.gz -o -s /usr/share/man/man1/keyline-fair.1'
inside 'dpkg -L keyline keyline-cad keyline-studio python3-keyline keyline-plugins libkeyline-dev | sort -u > /work/files'
quietly 'apt-get purge -y keyline keyline-cad keyline-studio python3-keyline keyline-plugins libkeyline-dev'
left=$(inside 'while read -r f; do [ ! -f "$f" ] || echo "$f"; done < /work/files' | sed 1d)
[ -z "$left" ] || { printf 'left behind: %s\n' "$left" >&2; exit 1; }
left=$(chroot "$bare" sh -c 'find / -xdev -path /work -prune -o -path /debs -prune -o -path /proc -prune -o -iname "*keyline*" -print')
[ -z "$left" ] || { printf 'left behind: %s\n' "$left" >&2; exit 1; }
echo "installed, used and removed: nothing of Keyline is left"
