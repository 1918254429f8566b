#!/usr/bin/env bash
# examples_test.sh EXAMPLES: the committed inputs are byte for byte what their script makes.
set -euo pipefail
examples=$1
made=$(mktemp -d)
trap 'rm -rf "$made"' EXIT
python3 -B "$examples/make_examples.py" "$made"
for file in "$made"/*; do
  cmp "$file" "$examples/$(basename "$file")"
done
for file in "$examples"/*.{csv,tsv,xyz,dat,json,png}; do
  [ -f "$made/$(basename "$file")" ] || { echo "$file is made by nothing"; exit 1; }
done
