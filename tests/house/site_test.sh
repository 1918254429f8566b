#!/usr/bin/env bash
# site_test.sh ROOT KEYLINE: the guide as a site in build/site/html; every link and page of it is sound, every
# header's contracts are found, and nothing is asked of the network. Skipped (77) without mkdocs.
set -euo pipefail
root=$1
command -v mkdocs >/dev/null || { echo "skipped: mkdocs is not installed"; exit 77; }
python3 -B "$root/docs/site/pages.py" "$root" "$2"
mkdocs build --quiet --strict -f "$root/docs/site/mkdocs.yml"
python3 -B "$root/docs/site/pages.py" "$root" "$2" "$root/build/site/html"
for known in 'headers/lac.html to_beziers' 'lac.segment.html alpha' 'operations.html fit.curvature'; do
  grep -q "${known#* }" "$root/build/site/html/reference/${known% *}" || { echo "not in the reference: $known"; exit 1; }
done
