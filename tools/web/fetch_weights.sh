#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Puts the weights of the networks for faces and for eyes, and their licences, into build/web/facemesh: `risorius landmarks` and
# the camera of the studio need them. They come from npm by the version and the hash of tools/web/weights/package-lock.json. Needs
# Node.js; tools/setup.sh studio installs it.
#
#   tools/web/fetch_weights.sh [BUILD_FOLDER]
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
web=$(mkdir -p "${1:-$root/build}/web" && cd "${1:-$root/build}/web" && pwd)
lock=$root/tools/web/weights/package-lock.json

if [[ -f $web/facemesh/LICENCES.txt && -f $web/facemesh/iris.bin ]] && cmp -s "$lock" "$web/facemesh/package-lock.json"; then
    exit 0
fi
if ! command -v npm >/dev/null; then
    printf 'fetch_weights: npm is missing; tools/setup.sh studio installs it\n' >&2
    exit 1
fi

fetched=$web/weights.new made=$web/facemesh.new
rm -rf "$fetched" "$made"
mkdir "$fetched" "$made"
cp "$root/tools/web/weights/package.json" "$lock" "$fetched/"
(cd "$fetched" && npm ci --ignore-scripts --no-audit --no-fund --loglevel=error)
package=$fetched/node_modules/@vladmandic/human
cp "$package/models/facemesh.json" "$package/models/facemesh.bin" "$package/models/iris.json" "$package/models/iris.bin" "$lock" "$made/"
{
    printf 'The files facemesh.* and iris.* are from the npm package @vladmandic/human:\n\n'
    cat "$package/LICENSE"
    printf '\nThe networks were made by Google for MediaPipe (https://github.com/google/mediapipe), Copyright The MediaPipe Authors,\n'
    printf 'under the Apache License:\n\n'
    cat /usr/share/common-licenses/Apache-2.0
} >"$made/LICENCES.txt"
# The program reads only the files with these hashes.
(cd "$made" && sha256sum --check --quiet) <<'HASHES'
b60ca26f404724f43bd2b1575761d8265180e1f053cc0731caa68462927309e7  facemesh.json
3826da640b0a3021161605369ee6af293f75d518040355b960ec71a3390c1c0b  facemesh.bin
49038ac9dcc09aa05474d91d98e9db5b47af4830929bcf102ed5a56bfbabb465  iris.json
d7f296d184274213d4642681ae186112cbbec77fd2ab066257d3c56a1940bc71  iris.bin
HASHES
rm -rf "$web/facemesh" "$fetched"
mv "$made" "$web/facemesh"
