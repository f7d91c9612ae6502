#!/usr/bin/env bash
# Installs what is missing, builds everything and runs every test; then the tests of the folders below once more
# with warnings as errors and the address and undefined-behaviour sanitizers.
#
#   tools/test.sh                   both
#   tools/test.sh --no-sanitizers   the release build only
#   tools/test.sh --all-sanitizers  every folder with sanitizers, which takes several times as long
set -euo pipefail

# Quick to build and to run under sanitizers, and where raw indices, parsers and C libraries are.
sanitized=(core geom signal track muscle solve tissue contact plot io media)
# Long runs of what the other suites of these folders run as well; ten times as long under sanitizers.
unsanitized=(contact.Cloth contact.StackedCubes tissue.AdaptiveSolid tissue.HangingCube)

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
trap 'rm -rf "$logs"' EXIT
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

cmake --preset release --log-level=WARNING
cmake --build --preset release
ctest --preset release --parallel "$jobs" --no-tests=error 2>&1 | tee "$logs/release" || failed=yes

if [[ $sanitizers != none ]]; then
    targets=()
    select=()
    if [[ $sanitizers == some ]]; then
        for folder in "${sanitized[@]}"; do
            if compgen -G "tests/$folder/*_test.cpp" >/dev/null; then targets+=("${folder}_test"); fi
        done
        select=(--label-regex "^($(any_of "${sanitized[@]}"))\$" --exclude-regex "^($(any_of "${unsanitized[@]}"))\$")
    else
        targets=(all)
    fi
    # A failure here must not hide the result above, so it is noted and told at the end.
    if cmake --preset check --log-level=WARNING && cmake --build --preset check --target "${targets[@]}"; then
        ctest --preset check --parallel "$jobs" --no-tests=error "${select[@]}" 2>&1 |
            tee "$logs/sanitizers" || failed=yes
        printf '\nwith sanitizers: %s\n' "$(closing_line "$logs/sanitizers")"
        skipped_tests build-check/Testing/Temporary/LastTest.log
    else
        failed=yes
        printf '\nwith sanitizers: the build failed\n'
    fi
fi
printf '\n%s\n' "$(closing_line "$logs/release")"
skipped_tests build/Testing/Temporary/LastTest.log
[[ $failed == no ]]
