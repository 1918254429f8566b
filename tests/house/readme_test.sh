#!/usr/bin/env bash
# readme_test.sh ROOT: the C++ in the README and the guide is that of examples/cpp, and every link leads somewhere.
set -euo pipefail
cd "$1"
program_of() { sed -n '/^```cpp$/,/^```$/p' "$1" | sed '1d;$d'; }
diff <(program_of README.md) examples/cpp/readme.cpp
diff <(program_of docs/log-aesthetic-curves.md) examples/cpp/segment.cpp

missing=0
while IFS=: read -r file link; do
  if [ ! -e "$(dirname "$file")/${link%%#*}" ]; then
    echo "$file links to $link, which is not there"
    missing=1
  fi
done < <(find . -name '*.md' -not -path './build/*' -not -path '*/node_modules/*' -print0 |
  xargs -0 grep -oHE '\]\([^)#][^) ]*\)' | sed -E 's/\]\(([^)]*)\)/\1/' | grep -v ':https\?:')
exit "$missing"
