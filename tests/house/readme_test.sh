#!/usr/bin/env bash
# readme_test.sh ROOT: the C++ in the README is examples/cpp/readme.cpp, and every link leads somewhere.
set -euo pipefail
cd "$1"
diff <(sed -n '/^```cpp$/,/^```$/p' README.md | sed '1d;$d') examples/cpp/readme.cpp

missing=0
while IFS=: read -r file link; do
  if [ ! -e "$(dirname "$file")/${link%%#*}" ]; then
    echo "$file links to $link, which is not there"
    missing=1
  fi
done < <(find . -name '*.md' -not -path './build/*' -not -path '*/node_modules/*' -print0 |
  xargs -0 grep -oHE '\]\([^)#][^) ]*\)' | sed -E 's/\]\(([^)]*)\)/\1/' | grep -v ':https\?:')
exit "$missing"
