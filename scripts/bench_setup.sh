#!/bin/sh
# Installs what scripts/bench.py compares with, beyond what scripts/setup.sh installs, as root or with sudo. Not needed for
# building or testing.
set -eu
root=''
[ "$(id -u)" = 0 ] || root=sudo
$root env DEBIAN_FRONTEND=noninteractive apt-get install -q -y --no-install-recommends python3-vtk9 python3-numpy
