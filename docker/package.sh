#!/bin/sh
# Inside the build: leaves the Debian package in $1, the one named by $PACKAGE, or else built from the sources here.
set -eu
if [ -n "$PACKAGE" ]; then
  cp "$PACKAGE" "$1"
  exit
fi
apt-get update -q
# The front door is written for bash, and installs everything else itself.
apt-get install -q -y --no-install-recommends bash ca-certificates procps
./coop install package
COOP_PRESET=release ./coop package
cp build/release/coop_*.deb "$1"
