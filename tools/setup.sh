#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Installs the Debian packages of tools/packages.txt that are missing; says nothing when none is.
#
#   tools/setup.sh          what building needs
#   tools/setup.sh test     what testing needs too
#   tools/setup.sh speech   what building needs, and a voice that speaks texts
#   tools/setup.sh studio   what building needs, and Node.js for the page of the studio
#   tools/setup.sh web      what building needs, and what the hosted page of the studio is built with
#   tools/setup.sh docs     what tools/docs.sh needs, and nothing else
#
# RISORIUS_SKIP_SETUP=1 leaves the machine as it is, for systems whose packages have other names.
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
purpose=${1:-build}

say() { printf 'setup: %s\n' "$*" >&2; }
die() {
    say "$@"
    exit 1
}

case $purpose in
    build | test | speech | docs | studio | web) ;;
    *) die "expected build, test, speech, docs, studio or web, found \"$purpose\"" ;;
esac
if [[ ${RISORIUS_SKIP_SETUP:-0} == 1 ]]; then exit 0; fi

# The sections that are asked for, and their packages without the comments.
sections=" build $purpose "
if [[ $purpose == docs ]]; then sections=" docs "; fi
if [[ $purpose == web ]]; then sections=" build studio web "; fi
packages=()
section=build
while read -r line; do
    line=${line%%#*}
    line=${line%"${line##*[![:space:]]}"}
    case $line in
        '') ;;
        '['*']') section=${line:1:-1} ;;
        *) if [[ $sections == *" $section "* ]]; then packages+=("$line"); fi ;;
    esac
done <"$root/tools/packages.txt"

if ! command -v dpkg-query >/dev/null || ! command -v apt-get >/dev/null; then
    say "this system has no apt, so nothing can be installed here. Needed, by their names in Debian 12:"
    say "${packages[*]}"
    die "install the like of them, then run again with RISORIUS_SKIP_SETUP=1"
fi

# dpkg-query fails when it does not know one of the names, and still answers for the others.
missing_packages() {
    local package status installed=" "
    while read -r package status; do
        if [[ $status == installed ]]; then installed+="$package "; fi
    done < <(dpkg-query -W -f='${Package} ${db:Status-Status}\n' "${packages[@]}" 2>/dev/null || true)
    # A Node.js from elsewhere brings its own npm, and conflicts with Debian's.
    if command -v npm >/dev/null && command -v node >/dev/null; then installed+="nodejs npm "; fi
    missing=()
    for package in "${packages[@]}"; do
        if [[ $installed != *" $package "* ]]; then missing+=("$package"); fi
    done
}

# jsPsych, which is in no Debian package, into a cache beside all projects, where there is npm; the test that plays a page with
# it is skipped without.
fetch_jspsych() {
    local from=$root/tests/data/experiment/package.json
    local to=${XDG_CACHE_HOME:-${HOME:-/root}/.cache}/risorius/jspsych
    if [[ $purpose != test ]] || ! command -v npm >/dev/null; then return 0; fi
    if [[ -d $to/node_modules ]] && cmp -s "$from" "$to/package.json"; then return 0; fi
    mkdir -p "$to" && cp "$from" "$to/package.json"
    if ! timeout 120 npm install --prefix "$to" --ignore-scripts --no-audit --no-fund --no-package-lock >/dev/null 2>&1; then
        say "npm could not fetch jsPsych; its test is skipped"
        rm -rf "$to"
    fi
}
fetch_jspsych

missing_packages
if [[ ${#missing[@]} == 0 ]]; then exit 0; fi

as_root=()
if [[ $(id -u) != 0 ]]; then
    if ! command -v sudo >/dev/null; then
        say "${#missing[@]} Debian packages are missing, and installing them needs root, but there is no sudo. As root, run:"
        die "apt-get install --no-install-recommends ${missing[*]}"
    fi
    as_root=(sudo)
fi

log=$(mktemp)
trap 'rm -f "$log"' EXIT
apt() {
    "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -q -y -o DPkg::Lock::Timeout=300 \
        -o Dpkg::Use-Pty=0 "$@" >"$log" 2>&1
}

# Which of the missing packages the lists on this machine do not offer.
unknown_packages() {
    local package
    unknown=()
    for package in "${missing[@]}"; do
        if ! apt-cache show "$package" >/dev/null 2>&1; then unknown+=("$package"); fi
    done
}

updated=no
update() {
    say "fetching the list of packages"
    updated=yes
    apt update || say "apt-get update failed: $(tail -n 1 "$log")"
}

say "installing ${#missing[@]} Debian packages (a few minutes at most): ${missing[*]}"
unknown_packages
if [[ ${#unknown[@]} != 0 ]]; then
    update
    unknown_packages
    if [[ ${#unknown[@]} != 0 ]]; then
        die "no such package in this machine's apt sources: ${unknown[*]} (Debian 12, section main, has them)"
    fi
fi

# An old list may name versions that the mirror no longer has; a fresh one is worth one more try.
if ! apt install --no-install-recommends "${missing[@]}"; then
    if [[ $updated == no ]]; then
        update
        apt install --no-install-recommends "${missing[@]}" || true
    fi
fi
missing_packages
if [[ ${#missing[@]} != 0 ]]; then
    tail -n 20 "$log" >&2
    die "could not be installed: ${missing[*]}"
fi
