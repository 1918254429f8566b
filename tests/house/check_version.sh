#!/usr/bin/env bash
# check_version.sh ROOT: the version stands in CMakeLists.txt and in no other file of the tree (the
# changelog names those that were released).
set -euo pipefail
cd "$1"
version=$(sed -nE 's/^project\(keyline VERSION ([0-9]+\.[0-9]+\.[0-9]+).*/\1/p' CMakeLists.txt)
[ -n "$version" ] || { echo "CMakeLists.txt gives the project no version"; exit 1; }
found=$(grep -rnIwF --exclude-dir={build,node_modules,.git} --exclude={CHANGELOG.md,package-lock.json} \
  "$version" . | grep -v '^./CMakeLists.txt:') || exit 0
echo "the version is stated once more:"
echo "$found"
exit 1
