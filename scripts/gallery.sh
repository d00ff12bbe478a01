#!/bin/sh
# Makes the pictures in the README by the program itself: docs/gallery.png, all examples; docs/views.png, contact sheets of some;
# docs/creatures.png, of the twelve in docs/gallery.md; and docs/parse.svg, how it reads the cat. Usage: scripts/gallery.sh [PROGRAM]
set -eu
cd "$(dirname "$0")/.."

program=${1:-build/release/bin/lascaux}
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

"$program" build examples/*.svg -o "$folder/{}.vdb" --quiet
"$program" render "$folder"/*.vdb -o docs/gallery.png --contact-sheet --view three-quarter --columns 6 --size 240 --quiet
"$program" render "$folder/cat.vdb" "$folder/giraffe.vdb" "$folder/rabbit.vdb" -o docs/views.png --contact-sheet --size 240 --quiet
set --
for name in cat crocodile dinosaur dog elephant frog giraffe horse kangaroo penguin rabbit tortoise; do
  set -- "$@" "$folder/$name.vdb"
done
"$program" render "$@" -o docs/creatures.png --contact-sheet --columns 8 --size 220 --quiet
"$program" inspect examples/cat.svg -o docs/parse.svg --quiet
