#!/usr/bin/env bash
# try_packages.sh ROOT BUILD: in a bare Debian 12, as a stranger would: builds and uses room lac with its
# own libraries alone, installs the packages that `cpack` made of BUILD, uses each, removes them, and
# fails if one of their files stays behind. Prints what it does. 77 where no such root can be had.
set -euo pipefail
source_tree=$1
packages=$2/packages
mirror=${KEYLINE_MIRROR:-http://deb.debian.org/debian}
skip() { echo "skipped: $*"; exit 77; }
[ "$(id -u)" -eq 0 ] || skip "a bare root needs root"
command -v mmdebstrap >/dev/null || skip "mmdebstrap is not installed"
ls "$packages"/*.deb >/dev/null 2>&1 || skip "no packages yet: ./dev package"

base=$2/bare.tar
[ -f "$base" ] || mmdebstrap --mode=root --variant=apt bookworm "${base%.tar}.new.tar" "$mirror" >"$2/bare.log" 2>&1 ||
  skip "no bare root from $mirror: $(tail -1 "$2/bare.log")"
[ -f "$base" ] || mv "${base%.tar}.new.tar" "$base"
bare=$(mktemp -d)
trap 'umount -q "$bare/proc" 2>/dev/null || true; rm -rf --one-file-system "$bare"' EXIT
tar -xf "$base" -C "$bare" --exclude=./dev/*
chroot "$bare" /bin/true || skip "this machine lets no root be changed"
mkdir -p "$bare/debs" "$bare/dev" "$bare/work/source/web" "$bare/work/program"
cp "$packages"/*.deb "$bare/debs"
cp "$source_tree"/examples/{bonnet-scan.csv,panel-a.json} "$source_tree/examples/cpp/readme.cpp" "$bare/work"
cp -r "$source_tree"/{CMakeLists.txt,LICENSE,cmake,keyline} "$bare/work/source"
cp "$source_tree/web/package-lock.json" "$bare/work/source/web"
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
# What a network may fail at is asked for apart from what a package may be wrong in.
install_there() {
  quietly "apt-get install -y --no-install-recommends --simulate $*"
  quietly "apt-get install -y --no-install-recommends --download-only $*" || skip "not to be had from $mirror: $*"
  quietly "apt-get install -y --no-install-recommends $*"
}

quietly 'apt-get update' || skip "no answer from $mirror"
# A root that is thrown away need not survive a power cut.
echo force-unsafe-io >"$bare/etc/dpkg/dpkg.cfg.d/thrown-away"

# What the README says that room lac needs (Python only puts sources together, to save time), and its
# program built with it.
install_there 'g++ cmake ninja-build python3 libeigen3-dev libboost-dev libtbb-dev libxsimd-dev'
quietly 'cmake -S source -B build -G Ninja -DKEYLINE_ROOMS=lac -DKEYLINE_UNITY=ON'
quietly 'cmake --build build'
quietly 'cmake --install build --prefix /work/prefix'
cat >"$bare/work/program/CMakeLists.txt" <<'EOF'
cmake_minimum_required(VERSION 3.25)
project(program LANGUAGES CXX)
find_package(keyline REQUIRED COMPONENTS lac)
add_executable(program ../readme.cpp)
target_link_libraries(program PRIVATE keyline::lac)
EOF
quietly 'cmake -S program -B program/build -G Ninja -DCMAKE_PREFIX_PATH=/work/prefix'
inside 'cmake --build program/build >program/log && program/build/program | tail -1'

ours='keyline keyline-cad keyline-studio python3-keyline keyline-plugins libkeyline-dev'
install_there '/debs/*.deb g++ pkg-config'
inside "dpkg-query -W $ours"
inside 'keyline --version'
inside 'keyline fair bonnet-scan.csv --quiet -o faired.svg -o faired.step && ls -s faired.svg faired.step'
inside 'keyline list faired.step | head -2'
inside 'keyline studio --version && test -s /usr/share/keyline/studio/index.html'
inside "python3 -c 'import keyline; print(keyline.lac.segment([[0, 0], [2, 0], [3, 1.5]], -1).length)'"
inside 'test -s /usr/share/inkscape/extensions/keyline/keyline_fair.inx && test -s /usr/share/freecad/Mod/Keyline/InitGui.py'
inside 'g++ -std=c++23 readme.cpp $(pkg-config --cflags --libs keyline-lac) -o readme && ./readme | tail -1'
inside 'test -s /usr/share/man/man1/keyline-fair.1.gz -o -s /usr/share/man/man1/keyline-fair.1'
inside 'bash -c ". /usr/share/bash-completion/completions/keyline" && test -s /usr/share/zsh/vendor-completions/_keyline &&
  test -s /usr/share/fish/vendor_completions.d/keyline.fish'
inside "for p in $ours; do test -s /usr/share/doc/\$p/copyright && test -s /usr/share/doc/\$p/keyline.spdx.json; done"
inside "dpkg -L $ours | sort -u >/work/files"
quietly "apt-get purge -y $ours"
left=$(inside 'while read -r f; do [ ! -f "$f" ] || echo "$f"; done < /work/files' | sed 1d)
[ -z "$left" ] || { printf 'left behind: %s\n' "$left" >&2; exit 1; }
left=$(chroot "$bare" sh -c 'find / -xdev -path /work -prune -o -path /debs -prune -o -path /proc -prune -o -iname "*keyline*" -print')
[ -z "$left" ] || { printf 'left behind: %s\n' "$left" >&2; exit 1; }
echo "a room built, packages installed, used and removed: nothing of Keyline is left"
