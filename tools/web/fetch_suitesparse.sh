#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Fetches Debian's source package of SuiteSparse into BUILD_FOLDER/web/suitesparse and unpacks the modules that the WebAssembly
# engine is built from, with their licences. apt verifies it by Debian's signature. Needs no root and changes nothing of the system:
# the list of source packages is in the build folder. tools/setup.sh web installs what it needs.
#
#   tools/web/fetch_suitesparse.sh [BUILD_FOLDER]
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
to=$(mkdir -p "${1:-$root/build}/web" && cd "${1:-$root/build}/web" && pwd)/suitesparse

# Version 5.12 of Debian 12; another one may need other files.
version=5.12.0
if [[ -f $to/.complete && $(<"$to/.complete") == "$version" ]]; then exit 0; fi

die() {
    printf 'fetch_suitesparse: %s\n' "$*" >&2
    exit 1
}
command -v apt-get >/dev/null || die "expected a Debian system with apt, found none; unpack SuiteSparse $version into $to by hand"

place=$(mktemp -d)
trap 'rm -rf "$place"' EXIT
mkdir -p "$place/lists/partial" "$place/cache/archives/partial"
# The archives of this system, for sources
cat /etc/apt/sources.list.d/*.sources 2>/dev/null | sed -nE '/^Types: /s/.*/Types: deb-src/; /^(Types|URIs|Suites|Components|Signed-By):|^$/p' >"$place/own.sources"
if [[ ! -s $place/own.sources ]]; then
    sed -nE 's/^deb /deb-src /p' /etc/apt/sources.list 2>/dev/null >"$place/own.list" || true
    [[ -s $place/own.list ]] || die "expected Debian's archives in /etc/apt, found none"
fi
list=$(find "$place" -maxdepth 1 -name 'own.*' -size +0)
apt() {
    (cd "$place" && apt-get -q -o Dir::Etc::sourcelist="$list" -o Dir::Etc::sourceparts=- -o Dir::State::lists="$place/lists" \
        -o Dir::Cache="$place/cache" -o APT::Sandbox::User= "$@" >"$place/log" 2>&1) || die "apt-get $1 failed: $(tail -n 1 "$place/log")"
}
printf 'fetch_suitesparse: fetching the source package (50 MB)\n' >&2
apt update
apt source --download-only suitesparse
archive=$(find "$place" -maxdepth 1 -name "suitesparse_$version*.orig.tar.*")
[[ -n $archive ]] || die "expected the sources of SuiteSparse $version, found $(cd "$place" && ls suitesparse_* 2>/dev/null | tr '\n' ' ')"

rm -rf "$to" "$to.new"
mkdir "$to.new"
parts=(SuiteSparse_config AMD CAMD COLAMD CCOLAMD CHOLMOD metis-5.1.0)
tar -xf "$archive" -C "$to.new" --strip-components=1 --wildcards "${parts[@]/#/*/}" --exclude='*/MATLAB' --exclude='*/graphs' --exclude='*/manual' \
    --exclude='*/Demo' --exclude='*/Tcov' --exclude='*/ssget' --exclude='*/Supernodal' --exclude='*/MatrixOps' --exclude='*/Modify' --exclude='*/Valgrind' --exclude='*/GPU' --exclude='*.pdf'
# Headers as an installed package has them
mkdir "$to.new/include" "$to.new/include/suitesparse" "$to.new/gaps"
cp "$to.new"/SuiteSparse_config/*.h "$to.new"/{AMD,CAMD,COLAMD,CCOLAMD,CHOLMOD}/Include/*.h "$to.new/include/suitesparse/"
: >"$to.new/gaps/execinfo.h"  # METIS includes it and uses nothing of it here
printf '%s' "$version" >"$to.new/.complete"
mv "$to.new" "$to"
