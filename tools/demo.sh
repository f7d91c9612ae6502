#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# From a bare Debian 12 to the first video: installs what is missing, builds, renders samples/hello to out/hello.mp4.
# Arguments go to `risorius render`, for instance: tools/demo.sh --size 512x512
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
cd "$root"

tools/setup.sh
cmake --preset release --log-level=WARNING
cmake --build --preset release --target risorius

script=samples/hello/script.json
video=out/hello.mp4
mkdir -p out
build/risorius render "$script" -o "$video" "$@"

if [[ ! -s $video ]]; then
    printf 'demo: %s was not written\n' "$video" >&2
    exit 1
fi
frames=
for table in "$video.frames.tsv" "${video%.mp4}.frames.tsv"; do
    if [[ -f $table ]]; then frames=", $(($(wc -l <"$table") - 1)) frames"; fi
done
printf '\nThe video is %s/%s%s, %d kB.\n' "$root" "$video" "$frames" $(($(wc -c <"$video") / 1000))
