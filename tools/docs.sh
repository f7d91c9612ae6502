#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Builds the manual as a site with search, and the C++ reference, into build/site; checks every link. A warning is an error.
#
#   tools/docs.sh             the site, its links, the C++ reference
#   tools/docs.sh --no-api    without the C++ reference
#   tools/docs.sh --links     checks the links of the Markdown pages only; needs python3 alone
#
# To read it with search working: python3 -m http.server --directory build/site
set -euo pipefail

api=yes
case ${1:-} in
    '') ;;
    --no-api) api=no ;;
    --links) api=links ;;
    *)
        printf 'docs: expected --no-api, --links or nothing, found "%s"\n' "$1" >&2
        exit 2
        ;;
esac

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
cd "$root"

python3 tools/docs/check_links.py
if [[ $api == links ]]; then exit 0; fi

tools/setup.sh docs
python3 tools/docs/stage.py build/docs-source
rm -rf build/site
mkdocs build --quiet --config-file tools/docs/mkdocs.yml
python3 tools/docs/check_links.py build/site

# The studio to try, where tools/web/build_hosted.sh has built it
if [[ -f build/web/hosted/pack.json ]]; then cp -r build/web/hosted build/site/try; fi

if [[ $api == yes ]]; then
    rm -rf build/api
    mkdir -p build/api
    doxygen tools/docs/Doxyfile
    rm -rf build/site/api
    mv build/api/html build/site/api
    cp tools/docs/math_api.js build/site/api/MathJax.js
fi
printf 'docs: build/site/index.html\n'
