#!/bin/sh
# Installs what building and testing need on Debian 12, as root or with sudo. Asks dpkg first: when all is there it costs
# nothing and touches no network.
set -eu

packages='
  g++ cmake ninja-build ccache clang-format pkg-config
  libopenvdb-dev libtbb-dev libeigen3-dev libcgal-dev libopenimageio-dev
  libboost-dev libboost-iostreams-dev libboost-system-dev zlib1g-dev libpng-dev libblosc-dev
  libminizip-dev libpugixml-dev libcli11-dev nlohmann-json3-dev libfmt-dev lib2geom-dev libjemalloc-dev
  libgtest-dev libbenchmark-dev
  libopenvdb-tools openimageio-tools python3 python3-numpy python3-opencv python3-openvdb admesh assimp-utils lib3mf1
'

# npm brings what scripts/outside_readers.sh installs; any npm will do.
command -v npm >/dev/null || packages="$packages nodejs npm"

missing=''
for package in $packages; do
  status=$(dpkg-query -W -f '${db:Status-Status}' "$package" 2>/dev/null || true)
  [ "$status" = installed ] || missing="$missing $package"
done

[ -n "$missing" ] || exit 0

if [ "$(id -u)" = 0 ]; then
  root=''
elif command -v sudo >/dev/null; then
  root=sudo
else
  echo "setup: these packages are missing and need root to install:$missing" >&2
  exit 1
fi

echo "setup: installing$missing"
$root env DEBIAN_FRONTEND=noninteractive apt-get update -q
# shellcheck disable=SC2086  # a list of names
$root env DEBIAN_FRONTEND=noninteractive apt-get install -q -y --no-install-recommends $missing
