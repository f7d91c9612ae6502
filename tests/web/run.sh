#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Runs browser.mjs, or says what is missing for it and returns 77, which ctest counts as skipped.
set -euo pipefail

program=$1 web=$2 source=$3 node=${4:-} chromium=${5:-}
skip() {
    printf 'Skipped: %s\n' "$*"
    exit 77
}
[[ -x $node ]] || skip 'there is no Node.js here'
[[ -x $chromium ]] || skip 'there is no Chromium here'
[[ -f $web/page/index.html && -d $web/node_modules/playwright-core ]] || skip 'the page is not built; tools/web/build_page.sh builds it'
exec "$node" "$source/tests/web/browser.mjs" "$program" "$web/node_modules" "$source"
