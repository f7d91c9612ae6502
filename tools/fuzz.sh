#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Gives changed files to every reader, with the address and undefined-behaviour sanitizers, and looks for crashes, foreign
# exceptions, and work or memory without end. Needs clang-14.
#
#   tools/fuzz.sh MINUTES            all readers, each for its share of the time
#   tools/fuzz.sh MINUTES obj glb    these readers
#
# What was tried stays in build-fuzz/corpus and is the start of the next run. A file that does harm is written to
# build-fuzz/findings; put it into tests/fuzz/seeds with the mend, so that each test run tries it again.
set -euo pipefail

minutes=${1:-}
if [[ ! $minutes =~ ^[0-9]+$ || $minutes == 0 ]]; then
    printf 'fuzz: expected a number of minutes, found "%s"\n' "$minutes" >&2
    exit 2
fi
shift
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
cd "$root"
readers=("$@")
if [[ ${#readers[@]} == 0 ]]; then readers=($(ls tests/fuzz/seeds)); fi
for reader in "${readers[@]}"; do
    if [[ ! -d tests/fuzz/seeds/$reader ]]; then
        printf 'fuzz: expected one of %s, found "%s"\n' "$(ls tests/fuzz/seeds | paste -sd' ')" "$reader" >&2
        exit 2
    fi
done

cmake --preset fuzz --log-level=WARNING
cmake --build --preset fuzz

jobs=$(nproc)
seconds=$((minutes * 60 * jobs / ${#readers[@]} + 1))
mkdir -p build-fuzz/findings
# The seeds have at most 1.6 kB. Longer inputs only take time, as do stacks of allocations, memory that is kept for long after it was
# given back, and memory that is filled.
export ASAN_OPTIONS=malloc_context_size=0:quarantine_size_mb=4:thread_local_quarantine_size_kb=64:max_malloc_fill_size=0
# Files in memory: a reader gets each input as a file.
scratch=$(mktemp -d -p "$([[ -w /dev/shm ]] && printf /dev/shm || printf /tmp)")
trap 'rm -rf "$scratch"' EXIT
export TMPDIR=$scratch

fuzz_one() {
    local reader=$1 log=build-fuzz/$1.log
    mkdir -p "build-fuzz/corpus/$reader"
    local state=clean
    "build-fuzz/fuzz/fuzz_$reader" -max_total_time="$2" -timeout=10 -rss_limit_mb=1500 -max_len=4096 -entropic=0 -print_funcs=0 -print_final_stats=1 \
        -artifact_prefix="build-fuzz/findings/$reader-" "build-fuzz/corpus/$reader" "tests/fuzz/seeds/$reader" \
        >"$log" 2>&1 || state="FINDING, see $log"
    printf '%-14s %12s executions  %s\n' "$reader" "$(sed -n 's/^stat::number_of_executed_units: *//p' "$log")" "$state"
    [[ $state == clean ]]
}
export -f fuzz_one
printf '%s\n' "${readers[@]}" | xargs -P "$jobs" -I{} bash -c "fuzz_one {} $seconds"
