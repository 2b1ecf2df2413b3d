#!/bin/sh
# check_capture.sh FOLDER CAPTURE [VALUES]: runs check_capture.js, with its packages installed into FOLDER (once).
# Exit code 77: cannot be run here, and why.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
folder=$1
shift
command -v node > /dev/null || { echo 'node is not installed'; exit 77; }
command -v npm > /dev/null || { echo 'npm is not installed'; exit 77; }
[ "$(node -p 'process.versions.node.split(".")[0]')" -ge 16 ] || { echo 'node is older than 16'; exit 77; }
mkdir -p "$folder"
if ! cmp -s "$here/package-lock.json" "$folder/installed.json"; then
  cp "$here/package.json" "$here/package-lock.json" "$folder/"
  (cd "$folder" && timeout 120 npm ci --ignore-scripts --no-audit --no-fund > npm.log 2>&1) ||
    { echo "the packages cannot be installed: $(tail -n 1 "$folder/npm.log")"; exit 77; }
  cp "$here/package-lock.json" "$folder/installed.json"
fi
cp "$here/check_capture.js" "$folder/"
exec node "$folder/check_capture.js" "$@"
