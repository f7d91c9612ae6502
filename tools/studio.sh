#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# From a bare Debian 12 to a face under your hands in a browser: installs what is missing, builds the page and the program, and
# starts `risorius view`. Arguments go to it, for instance: tools/studio.sh samples/hello/script.json
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)

# A Node.js that is there already, from wherever it comes, is good enough.
if command -v npm >/dev/null; then "$root/tools/setup.sh" build; else "$root/tools/setup.sh" studio; fi
(
    cd "$root"
    tools/web/build_page.sh
    tools/web/fetch_weights.sh
    cmake --preset release --log-level=WARNING
    cmake --build --preset release --target risorius
)
exec "$root/build/risorius" view "$@"
