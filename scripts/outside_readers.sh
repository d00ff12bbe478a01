#!/bin/sh
# Installs readers of glTF and USD that are not ours, which the tests ask and Debian has not, in build/outside. When they are there it
# costs nothing and touches no network. Where npm's registry can't be reached, it says so, and the tests go on without them.
set -eu
cd "$(dirname "$0")/.."

wanted=tests/outside
folder=build/outside
if cmp -s $wanted/package-lock.json $folder/done.json; then exit 0; fi

# The system's certificates, too: node brings its own, which don't know those of a company's proxy.
certificates=/etc/ssl/certs/ca-certificates.crt
if [ -z "${NODE_EXTRA_CA_CERTS:-}" ] && [ -e $certificates ]; then export NODE_EXTRA_CA_CERTS=$certificates; fi

mkdir -p $folder
cp $wanted/package.json $wanted/package-lock.json $folder
for wait in 2 10 0; do  # registries have their moments
  if npm ci --prefix $folder --no-audit --no-fund --ignore-scripts --fetch-retries 0; then
    # Its files are modules and its package does not say so, which Debian's node wants to know.
    (cd $folder/node_modules/tinyusdz && npm pkg set type=module)
    cp $wanted/package-lock.json $folder/done.json
    exit 0
  fi
  sleep $wait
done
rm -rf $folder/node_modules  # or half of it might be there
echo 'outside_readers: npm could not install tests/outside/package.json: the tests will have glTF read by assimp alone, and USD by nobody' >&2
