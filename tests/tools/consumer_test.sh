#!/bin/sh
# Installs the library and builds a project against it that knows it by find_package alone.
# Usage: consumer_test.sh BUILD_FOLDER SOURCE_FOLDER
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

cmake --install "$1" --prefix "$folder/prefix" >"$folder/install.log"
cmake -S "$2/tests/consumer" -B "$folder/build" -G Ninja -DCMAKE_BUILD_TYPE=Release \
  -DCMAKE_PREFIX_PATH="$folder/prefix" >"$folder/configure.log" 2>&1 || { cat "$folder/configure.log"; exit 1; }
cmake --build "$folder/build"
"$folder/build/consumer" "$2/examples/cat.svg"
# The installed program finds its plugin, too.
"$folder/prefix/bin/lascaux" build "$2/examples/cat.svg" -o "$folder/cat.png" --resolution 48
test -s "$folder/cat.png"
test -s "$folder/prefix/share/thumbnailers/lascaux.thumbnailer"
