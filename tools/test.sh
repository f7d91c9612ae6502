#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Installs what is missing, builds everything and runs every test: those of the folders below with assertions, warnings as
# errors and the address and undefined-behaviour sanitizers, all others in the release build.
#
#   tools/test.sh                   every test once
#   tools/test.sh --no-sanitizers   every test in the release build
#   tools/test.sh --all-sanitizers  every test in both, which takes several times as long
set -euo pipefail

# Quick to build and to run under sanitizers, and where raw indices, parsers and C libraries are.
sanitized=(core geom signal track muscle solve tissue contact design plot io media fuzz)

case ${1:-} in
    '') sanitizers=some ;;
    --no-sanitizers) sanitizers=none ;;
    --all-sanitizers) sanitizers=all ;;
    *)
        printf 'test: expected --no-sanitizers, --all-sanitizers or nothing, found "%s"\n' "$1" >&2
        exit 2
        ;;
esac

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
cd "$root"
tools/setup.sh test

logs=$(mktemp -d)
check_build=
clean_up() {
    # The build in the background has a process group of its own.
    if [[ -n $check_build ]]; then kill -- "-$check_build" 2>/dev/null || true; fi
    rm -rf "$logs"
}
trap clean_up EXIT
jobs=$(nproc)
failed=no

# What ctest says at its end, to be repeated after everything else.
closing_line() { grep -E '^[0-9]+% tests passed|^No tests were found' "$1" || printf 'the tests did not run\n'; }

# Arguments as alternatives of a regular expression.
any_of() { (IFS='|' && printf '%s' "$*"); }

# How many tests were skipped and why: ctest tells of suites only.
skipped_tests() {
    [[ -f $1 ]] || return 0
    awk '/: Skipped$/ { getline; count[$0]++ }
         END { for (why in count) printf "skipped: %d test%s: %s\n", count[why], count[why] == 1 ? "" : "s", why }' "$1" | sort
}

# Folders with tests, in the order of their names.
folders() { (cd tests && printf '%s\n' */*_test.cpp | cut -d/ -f1 | uniq); }

# What is built and run in which build; an empty list of targets is everything.
release_targets=()
release_select=()
check_targets=()
check_select=()
case $sanitizers in
    some)
        # Programs that are no tests, then the tests of each folder in the one build or the other
        release_targets=(programs calibrate)
        kept=()
        for folder in $(folders); do
            if [[ " ${sanitized[*]} " == *" $folder "* ]]; then
                check_targets+=("${folder}_test")
            else
                release_targets+=("${folder}_test")
                kept+=("$folder")
            fi
        done
        release_select=(--label-regex "^($(any_of "${kept[@]}"))\$")
        check_select=(--label-regex "^($(any_of "${sanitized[@]}"))\$")
        ;;
    all) check_targets=(all) ;;
esac

cmake --preset release --log-level=WARNING
cmake --build --preset release ${release_targets:+--target "${release_targets[@]}"}

# The other build fills the time in which the tests leave a core idle.
if [[ $sanitizers != none ]]; then
    set -m
    (cmake --preset check --log-level=WARNING &&
        nice cmake --build --preset check --parallel "$jobs" --target "${check_targets[@]}") \
        >"$logs/check-build" 2>&1 </dev/null &
    check_build=$!
    set +m
fi
ctest --preset release --parallel "$jobs" --no-tests=error "${release_select[@]}" 2>&1 | tee "$logs/release" || failed=yes

if [[ $sanitizers != none ]]; then
    # A failure here must not hide the result above, so it is noted and told at the end.
    if wait "$check_build"; then
        cat "$logs/check-build"
        ctest --preset check --parallel "$jobs" --no-tests=error "${check_select[@]}" 2>&1 |
            tee "$logs/sanitizers" || failed=yes
        printf '\nwith sanitizers: %s\n' "$(closing_line "$logs/sanitizers")"
        skipped_tests build-check/Testing/Temporary/LastTest.log
    else
        failed=yes
        cat "$logs/check-build"
        printf '\nwith sanitizers: the build failed\n'
    fi
fi
printf '\n%s\n' "$(closing_line "$logs/release")"
skipped_tests build/Testing/Temporary/LastTest.log
[[ $failed == no ]]
