#!/usr/bin/env bash
# Renders the pictures of examples/gallery from the job files: make_gallery.sh path/to/blendwright
set -euo pipefail
program=$(realpath "$1")
cd "$(dirname "$0")"
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir -p gallery
for job in specs/*.json; do
  name=$(basename "$job" .json)
  if [[ $name == fit-* ]]; then   # shown as fitted
    "$program" fit "$job" -o "$work/fitted/$name.json" --quiet
    job=$work/fitted/$name.json
  fi
  "$program" blend "$job" -o "$work" --force --quiet || [ $? -eq 1 ]   # 1: the printed figures are not tangent, and shown
  cp "$work/$name.png" gallery/
done
cp "$work/branch-to-main.errors.png" gallery/

# The viewer's window: events are replayed in it.
cat >"$work/view.txt" <<EOF
key 2
click 700 600
screenshot $PWD/gallery/view.png
EOF
"$program" view specs/branch-to-main.json --script "$work/view.txt" --width 1000 --height 750 >"$work/view.states"
