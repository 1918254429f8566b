#!/usr/bin/env bash
# make_packages.sh BUILD: the .debs of what BUILD built, in BUILD/packages, each with its licence and its list
# of parts. Skipped (77) without what makes packages.
set -euo pipefail
for program in dpkg-shlibdeps fakeroot file; do
  command -v "$program" >/dev/null || { echo "skipped: $program is not installed; ./dev package installs it"; exit 77; }
done
cd "$1"
rm -rf packages
cpack >cpack.log 2>&1 || { cat cpack.log; exit 1; }
for name in keyline keyline-cad keyline-studio python3-keyline keyline-plugins libkeyline-dev; do
  listed=$(dpkg-deb --contents packages/"$name"_*.deb)
  for held in copyright keyline.spdx.json; do
    grep -q "/usr/share/doc/$name/$held" <<<"$listed" || { echo "$name holds no $held"; exit 1; }
  done
done
