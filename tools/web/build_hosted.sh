#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Makes a folder of static files that any web server can host: the studio with its engine as WebAssembly, the adult and samples.
# Nothing runs on the server. Needs what tools/setup.sh web installs; docs/howto/hosted-page.md says more.
#
#   tools/web/build_hosted.sh [OUT [BUILD_FOLDER]]      OUT: build/web/hosted
#
# Where BUILD_FOLDER/risorius is built, it paints the pictures of skin and eyes and estimates the bones. Without it, parts have plain
# colours, and the page estimates the bones itself.
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
die() {
    printf 'build_hosted: %s\n' "$*" >&2
    exit 1
}
build=$(mkdir -p "${2:-$root/build}" && cd "${2:-$root/build}" && pwd)
out=${1:-$build/web/hosted}
if [[ -e $out && ! -f $out/pack.json ]] && [[ -n $(ls -A "$out" 2>/dev/null) ]]; then
    die "$out: expected a new folder, an empty one or a page of before, found other files"
fi
command -v em++ >/dev/null || die 'expected Emscripten, found none; tools/setup.sh web installs it'

"$root/tools/web/fetch_suitesparse.sh" "$build"
"$root/tools/web/build_page.sh" "$build"
(
    cd "$root"
    cmake --preset web --log-level=WARNING -D RISORIUS_SUITESPARSE="$build/web/suitesparse" >/dev/null
    cmake --build --preset web
)
program=${RISORIUS_PROGRAM:-$build/risorius}
painted=$build/web/pictures/adult
if [[ -x $program ]] && [[ ! -d $painted || $program -nt $painted || $root/rigs/adult/rig.json -nt $painted ]]; then
    node "$root/tools/web/paint_pictures.mjs" "$program" "$root/rigs/adult/rig.json" "$painted"
fi
mkdir -p "$out"
node "$root/tools/web/pack_page.mjs" "$root" "$build" "$root/build-web" "$out"
