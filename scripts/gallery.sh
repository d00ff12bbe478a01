#!/bin/sh
# Makes the pictures in the README: docs/gallery.png, the program's own previews of all examples side by side, and
# docs/parse.svg, how it reads the cat. Usage: scripts/gallery.sh [PROGRAM]
set -eu
cd "$(dirname "$0")/.."

program=${1:-build/release/bin/lascaux}
columns=6
side=240  # pixels of a preview
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

"$program" build examples/*.svg -o "$folder/{}.png" --quiet
count=0
for preview in "$folder"/*.png; do
  oiiotool "$preview" --ch R,G,B --resize ${side}x$side -o "$folder/$count.tif"
  set -- "$@" "$folder/$count.tif"
  count=$((count + 1))
done
[ "$#" = "$count" ] || shift  # the program's name
rows=$(((count + columns - 1) / columns))
while [ $count -lt $((rows * columns)) ]; do
  set -- "$@" --pattern constant:color=0.89,0.89,0.88 ${side}x$side 3
  count=$((count + 1))
done
oiiotool "$@" --mosaic ${columns}x$rows -d uint8 --attrib png:compressionLevel 9 -o docs/gallery.png
"$program" inspect examples/cat.svg -o docs/parse.svg --quiet
