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

# What `picture` shows: input, mode, further words.
mkdir -p gallery/pictures
pictures='
specs/branch-to-main zebra
specs/coaxial-cylinders isophotes
specs/branch-to-main comb
specs/branch-to-main curvature
specs/step-transition draft
scenes/s0-12ab field --plane z=0
'
while read -r input show words; do
  # shellcheck disable=SC2086
  "$program" picture "$input.json" --show "$show" $words --size 640x480 --force --quiet \
    -o "gallery/pictures/$(basename "$input").$show.png"
done <<<"$(sed '/^$/d' <<<"$pictures")"
"$program" picture specs/varying-magnitude.json --show trimlines --size 1280x760 --force --quiet \
  -o gallery/pictures/varying-magnitude.trimlines.png

# The viewer's window: events are replayed in it.
cat >"$work/view.txt" <<EOF
drag tension 10
key 5
click 700 600
screenshot $PWD/gallery/view.png
EOF
"$program" view specs/branch-to-main.json --script "$work/view.txt" --width 1000 --height 750 >"$work/view.states"
cat >"$work/view-scene.txt" <<EOF
drag bar/a 11
drag bar/n1 4
drag "soft bar/w1" 0.7
screenshot $PWD/gallery/view-scene.png
EOF
"$program" view scenes/s0-12ab.json --script "$work/view-scene.txt" --width 1000 --height 750 >"$work/view-scene.states"
