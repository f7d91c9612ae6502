#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Builds the page of `risorius view` from src/web into build/web/page. What others wrote comes from npm by the versions and
# hashes of src/web/package-lock.json, into the build folder. Needs Node.js; tools/setup.sh studio installs it.
#
#   tools/web/build_page.sh [BUILD_FOLDER]
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
web=$(mkdir -p "${1:-$root/build}/web" && cd "${1:-$root/build}/web" && pwd)

if ! command -v npm >/dev/null; then
    printf 'build_page: npm is missing; tools/setup.sh studio installs it\n' >&2
    exit 1
fi

# Packages are fetched anew only when the list has changed.
if ! cmp -s "$root/src/web/package-lock.json" "$web/package-lock.json" || [[ ! -f $web/node_modules/.complete ]]; then
    cp "$root/src/web/package.json" "$root/src/web/package-lock.json" "$web/"
    rm -f "$web/node_modules/.complete"
    (cd "$web" && npm ci --ignore-scripts --no-audit --no-fund --loglevel=error)
    touch "$web/node_modules/.complete"
fi

# The sources lie where there are no packages: the compiler is told where they are.
cat >"$web/tsconfig.json" <<JSON
{
  "compilerOptions": {
    "strict": true, "noEmit": true, "target": "es2022", "module": "esnext", "moduleResolution": "bundler",
    "lib": ["es2022", "dom", "dom.iterable"], "types": [], "skipLibCheck": true, "resolveJsonModule": true,
    "paths": {"three": ["$web/node_modules/@types/three"], "three/*": ["$web/node_modules/@types/three/*"]}
  },
  "include": ["$root/src/web/*.ts"]
}
JSON
"$web/node_modules/.bin/tsc" --project "$web/tsconfig.json"

rm -rf "$web/page.new"
mkdir "$web/page.new"
NODE_PATH=$web/node_modules "$web/node_modules/.bin/esbuild" "$root/src/web/main.ts" --bundle --minify --format=esm \
    --target=es2022 --legal-comments=none --log-level=warning --outfile="$web/page.new/studio.js"
cp "$root/src/web/index.html" "$root/src/web/studio.css" "$root/src/web/icon.svg" "$web/page.new/"
{
    printf 'The page contains three.js:\n\n'
    cat "$web/node_modules/three/LICENSE"
} >"$web/page.new/LICENCES.txt"
rm -rf "$web/page"
mv "$web/page.new" "$web/page"
