#!/usr/bin/env bash
# check_layers_test.sh CHECK: the check notices every kind of breach in a small made-up tree.
set -euo pipefail
check=$1
tree=$(mktemp -d)
trap 'rm -rf "$tree"' EXIT

# A correct tree of three rooms: high uses low.
fresh() {
  rm -rf "$tree/keyline"
  mkdir -p "$tree"/keyline/{low,sketch,high}
  echo 'foreach(room IN ITEMS low sketch high)' >"$tree/keyline/CMakeLists.txt"
  echo 'keyline_room(low LINK Eigen3::Eigen)' >"$tree/keyline/low/CMakeLists.txt"
  echo 'keyline_room(sketch PRIVATE_LINK cv)' >"$tree/keyline/sketch/CMakeLists.txt"
  echo 'keyline_room(high DEPENDS low PRIVATE_LINK x)' >"$tree/keyline/high/CMakeLists.txt"
  echo '#include <vector>' >"$tree/keyline/low/a.h"
  echo '#include <opencv2/core.hpp>' >"$tree/keyline/sketch/a.cpp"
  printf '#include "keyline/high/b.h"\n#include "keyline/low/a.h"\n' >"$tree/keyline/high/b.cpp"
}

expect() { # expect STATUS TEXT
  local status=0 output
  output=$(bash "$check" "$tree") || status=$?
  if [ "$status" != "$1" ] || [[ "$output" != *"$2"* ]]; then
    printf 'expected %s and "%s", got %s:\n%s\n' "$1" "$2" "$status" "$output"
    exit 1
  fi
}

fresh
expect 0 ""
fresh
echo '#include "keyline/high/b.h"' >>"$tree/keyline/low/a.h"
expect 1 "low includes high, a room below it"
fresh
echo '#include "keyline/attic/b.h"' >>"$tree/keyline/low/a.h"
expect 1 "does not list"
fresh
echo '#include "keyline/sketch/b.h"' >>"$tree/keyline/high/b.cpp"
expect 1 "DEPENDS lacks sketch"
fresh
echo 'keyline_room(high DEPENDS low sketch)' >"$tree/keyline/high/CMakeLists.txt"
expect 1 "DEPENDS names sketch"
fresh
echo '#include <opencv2/core.hpp>' >"$tree/keyline/high/c.cpp"
expect 1 "OpenCV belongs to: sketch"
fresh
mkdir -p "$tree/apps/keyline"
printf '#include "keyline/operations/b.h"\n#include "keyline/low/a.h"\n' >"$tree/apps/keyline/a.cpp"
expect 1 "apps/keyline/a.cpp:2: a door includes low"
rm -r "$tree/apps"
# Inner folders: high/far uses high/near, and b.cpp of the room itself uses both.
folders() {
  fresh
  mkdir -p "$tree"/keyline/high/{near,far}
  printf '| folder | promises | uses |\n|---|---|---|\n| `near` | little | |\n| `far` | much | near |\n' \
    >"$tree/keyline/high/README.md"
  echo '#include "keyline/high/near/n.h"' >"$tree/keyline/high/near/n.cpp"
  printf '#include "keyline/high/far/f.h"\n#include "keyline/high/near/n.h"\n' \
    >"$tree/keyline/high/far/f.cpp"
  printf '#include "keyline/high/far/f.h"\n#include "keyline/high/near/n.h"\n' \
    >>"$tree/keyline/high/b.cpp"
}
folders
expect 0 ""
folders
echo '#include "keyline/high/far/f.h"' >>"$tree/keyline/high/near/n.cpp"
expect 1 "keyline/high/near/n.cpp:2: near includes far, a folder below it"
expect 1 "the row of near lacks far"
folders
echo '#include "keyline/high/b.h"' >>"$tree/keyline/high/near/n.cpp"
expect 1 "near includes what stands above every folder of high"
folders
rm "$tree/keyline/high/far/f.cpp"
expect 1 "the row of far names near, which it never includes"
folders
mkdir "$tree/keyline/high/attic"
expect 1 "keyline/high/attic: keyline/high/README.md does not say what it holds"
folders
rm -r "$tree/keyline/high/near"
expect 1 "there is no folder near"
fresh
echo '#include <opencv2/core.hpp>' >"$tree/keyline/sketch/c.h"
expect 1 ".cpp files only"
