#!/bin/sh
# Installs readers of glTF and USD that are not ours, which the tests ask and Debian has not, in build/outside. When they are there it
# costs nothing and touches no network.
set -eu
cd "$(dirname "$0")/.."

wanted=tests/outside
folder=build/outside
if cmp -s $wanted/package-lock.json $folder/done.json; then exit 0; fi

mkdir -p $folder
cp $wanted/package.json $wanted/package-lock.json $folder
for wait in 5 30 0; do  # registries have their moments
  if npm ci --prefix $folder --no-audit --no-fund --ignore-scripts; then
    cp $wanted/package-lock.json $folder/done.json
    exit 0
  fi
  sleep $wait
done
echo 'outside_readers: npm could not install tests/outside/package.json; see its messages above' >&2
exit 1
