// SPDX-License-Identifier: MIT
// The entry of libFuzzer for the reader RISORIUS_FUZZ_TARGET; see tools/fuzz.sh.
#include <algorithm>
#include <cstdio>
#include <cstdlib>

#include "fuzz/targets.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using risorius::fuzz::Target;
    static const Target& target = [&]() -> const Target& {
        for (const Target& one : risorius::fuzz::targets())
            if (one.name == RISORIUS_FUZZ_TARGET) return one;
        std::fprintf(stderr, "fuzz: no target " RISORIUS_FUZZ_TARGET "\n");
        std::abort();
    }();
    risorius::fuzz::run(target, data, size);
    return 0;
}
