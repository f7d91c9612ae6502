// SPDX-License-Identifier: MIT
// The entry of libFuzzer, of one program for all readers: it is called by the name fuzz_READER; see tools/fuzz.sh.
#include <cstdio>
#include <cstdlib>
#include <filesystem>

#include "fuzz/targets.h"

namespace {

const risorius::fuzz::Target* chosen = nullptr;

}  // namespace

extern "C" int LLVMFuzzerInitialize(int*, char*** arguments) {
    const std::string name = std::filesystem::path((*arguments)[0]).filename().string();
    for (const risorius::fuzz::Target& one : risorius::fuzz::targets())
        if (name == "fuzz_" + one.name) chosen = &one;
    if (chosen) return 0;
    std::fprintf(stderr, "fuzz: no reader for the name %s\n", name.c_str());
    std::exit(2);
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    risorius::fuzz::run(*chosen, data, size);
    return 0;
}
