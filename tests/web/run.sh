#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Runs a test of the page, or says what is missing for it and returns 77, which ctest counts as skipped.
#
#   run.sh TEST.mjs RISORIUS BUILD_FOLDER/web SOURCE_FOLDER NODE CHROMIUM
set -euo pipefail

test=$1 program=$2 web=$3 source=$4 node=${5:-} chromium=${6:-}
skip() {
    printf 'Skipped: %s\n' "$*"
    exit 77
}
[[ -x $node ]] || skip 'there is no Node.js here'
[[ -x $chromium ]] || skip 'there is no Chromium here'
[[ -f $web/page/index.html && -d $web/node_modules/playwright-core ]] || skip 'the page is not built; tools/web/build_page.sh builds it'
if [[ $test == hosted.mjs && ! -f $web/hosted/pack.json ]]; then skip 'the hosted page is not built; tools/web/build_hosted.sh builds it with Emscripten'; fi
exec "$node" "$source/tests/web/$test" "$program" "$web/node_modules" "$source"
