#!/bin/sh
# Makes docs/gallery.png, the picture in the README: the program's own previews of all examples, side by side.
set -eu
cd "$(dirname "$0")/.."

columns=6
thumbnail=256x256
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

build/release/bin/lascaux build examples/*.svg -o "$folder/{}.png" --quiet
count=$(ls "$folder"/*.png | wc -l)
rows=$(((count + columns - 1) / columns))
oiiotool "$folder"/*.png --resize:all=1 $thumbnail --mosaic ${columns}x$rows \
  --ch R,G,B -d uint8 --attrib png:compressionLevel 9 -o docs/gallery.png
