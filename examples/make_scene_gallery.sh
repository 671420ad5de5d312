#!/usr/bin/env bash
# Renders the pictures of examples/gallery/scenes from the scene files: make_scene_gallery.sh path/to/blendwright
# [WORD ...]: only pictures whose name contains one of the words.
set -euo pipefail
program=$(realpath "$1")
shift
cd "$(dirname "$0")"
mkdir -p gallery/scenes

# Scene, the box that is shown (- for all of it), the solids.
pictures='
s0-1a - capsule
s0-1b - n1=0.6,n2=2 n1=1.2,n2=5 n1=2,n2=0.6 n1=20,n2=2
s0-1c - n=1.1 n=3 n=20
s0-2 - a b
s0-3 - die
s0-4 - cube
s0-5a - star-in-ball
s0-5b - ring
s0-6 - s=0
s0-7cd - c d
s0-8 -29.9,-29.9,-9.9,29.9,29.9,9.9 soft-blend scale-union hoffmann-union
s0-9 -10,-10,4,10,10,13 square prism
s0-10 -13,-13,4,13,13,13 n1=0.6 n1=1.1 n1=2 n1=20
s0-11 -14.5,-14.5,0,14.5,14.5,13 n=4 n=0.8
s0-12ab -10,-10,4,10,10,13 body
s0-12cn -10,-10,4,10,10,13 n1=0.6 n1=1.2 n1=1.5 n1=2 n1=3 n1=20
s0-13 -14,-14,4,14,14,13 b d
s0-14ab -13,-13,4,13,13,13 body
s0-14cn -13,-13,4,13,13,13 n1=1.5 n1=3
s1-2 - wheel
s1-3 - n=1 n=1.3 n=1.7 n=2.5
s1-4d - two-balls
s1-4e - four-balls
s1-5d - unequal
s1-5e - equal
s1-6 - n=1 n=1.8 n=5.2
s1-7 - round dilated eroded
s2-1b - die
s2-2 - s=0.5
s2-3 - p=2 p=8
s2-4 - p=3 p=10
s2-5 - n=1.5 n=3
s2-6 - ten-balls
s2-7 - p=1.1 p=1.7
s2-8 - p=1.2 p=1.8
s2-9b - p=3 p=7
s2-9c - n=-1.5 n=-2
s3-bumps - power=2 power=3 bump-on-bump
s3-offsets - ellipsoid+0.3 ellipsoid-0.3 normal+0.3 value+0.2 ring+0.3 box+0.3 box-0.3 rounded-box
s3-right-angle - u=1_3 u=1_5 u=0.9
s3-tee - w=1 w=2 w=4 unequal difference intersection
s3-blend-on-blend - ribbed
s3-corner - together one-after-another unequal constant-radius
s3-material - sharp added removed one-side
s3-bridge - super-elliptic material
'
while read -r scene box solids; do
  for solid in $solids; do
    name=$scene-$(tr '=,+' '_-_' <<<"$solid")
    [ $# -eq 0 ] || grep -qF -f <(printf '%s\n' "$@") <<<"$name" || continue
    part=()
    [ "$box" = - ] || part=(--box="$box")
    "$program" mesh "scenes/$scene.json" --solid "$solid" --cells 240 "${part[@]}" -o "gallery/scenes/$name.png" --force --quiet
  done
done <<<"$(sed '/^$/d' <<<"$pictures")"
