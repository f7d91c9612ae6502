// SPDX-License-Identifier: MIT
// Lets each allocation of a reader fail in turn: the first, the second, and so on until the reader needs no more. Each time it must
// end in an exception or in the whole result, and give back what it has taken.
#include <dlfcn.h>
#include <execinfo.h>
#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <new>
#include <string>
#include <string_view>

#include "fuzz/targets.h"
#include "paths.h"

namespace {

std::atomic<long> left_to_give{-1};  // allocations before the one that fails; below 0: none fails
std::atomic<long> held{0};           // allocations that have not been given back

/// Whether the caller destroys a JSON value: nlohmann's destructor needs memory, and nothing can help where it gets none. The program
/// says then that the memory is not enough, and ends.
bool destroys_json() {
    std::array<void*, 12> callers{};
    const int count = ::backtrace(callers.data(), static_cast<int>(callers.size()));
    for (int i = 0; i < count; ++i) {
        ::Dl_info function{};
        if (::dladdr(callers[static_cast<std::size_t>(i)], &function) == 0 || !function.dli_sname)
            continue;
        const std::string_view name = function.dli_sname;
        if (name.find("nlohmann") != name.npos &&
            (name.find("destroy") != name.npos || name.ends_with("D1Ev") || name.ends_with("D2Ev")))
            return true;
    }
    return false;
}

void* give(std::size_t size, std::size_t alignment) {
    if (left_to_give >= 0 && left_to_give-- == 0) {
        if (!destroys_json()) return nullptr;
        left_to_give = 0;  // the next one
    }
    void* given = nullptr;
    if (alignment <= alignof(std::max_align_t))
        given = std::malloc(size > 0 ? size : 1);
    else if (::posix_memalign(&given, alignment, size) != 0)
        given = nullptr;
    if (given) ++held;
    return given;
}

void* give_or_throw(std::size_t size, std::size_t alignment = 0) {
    if (void* given = give(size, alignment)) return given;
    throw std::bad_alloc();
}

void take(void* given) noexcept {
    if (given) --held;
    std::free(given);
}

}  // namespace

// In place of those of the library, in the whole program of this test
void* operator new(std::size_t size) { return give_or_throw(size); }
void* operator new[](std::size_t size) { return give_or_throw(size); }
void* operator new(std::size_t size, std::align_val_t to) {
    return give_or_throw(size, static_cast<std::size_t>(to));
}
void* operator new[](std::size_t size, std::align_val_t to) {
    return give_or_throw(size, static_cast<std::size_t>(to));
}
void* operator new(std::size_t size, const std::nothrow_t&) noexcept { return give(size, 0); }
void* operator new[](std::size_t size, const std::nothrow_t&) noexcept { return give(size, 0); }
void operator delete(void* given) noexcept { take(given); }
void operator delete[](void* given) noexcept { take(given); }
void operator delete(void* given, std::size_t) noexcept { take(given); }
void operator delete[](void* given, std::size_t) noexcept { take(given); }
void operator delete(void* given, std::align_val_t) noexcept { take(given); }
void operator delete[](void* given, std::align_val_t) noexcept { take(given); }
void operator delete(void* given, std::size_t, std::align_val_t) noexcept { take(given); }
void operator delete[](void* given, std::size_t, std::align_val_t) noexcept { take(given); }

namespace risorius::fuzz {
namespace {

namespace fs = std::filesystem;

/// What becomes of one reading.
struct Outcome {
    bool threw = false;
    std::uint64_t digest = 0;
    long kept = 0;        ///< allocations that were not given back
    bool failed = false;  ///< whether an allocation did fail
};

/// Reads while the allocation after `given` others fails; below 0: none does.
Outcome read_with(const Target& target, const std::string& bytes, long given) {
    Outcome outcome;
    const long before = held;
    try {
        left_to_give = given;
        outcome.digest =
            run(target, reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
        outcome.threw = outcome.digest == 0;
    } catch (const std::bad_alloc&) {
        outcome.threw = true;
    }
    outcome.failed = given >= 0 && left_to_give < 0;
    left_to_give = -1;
    outcome.kept = held - before;
    return outcome;
}

TEST(Allocations, EachMayFailInEachReader) {
    for (const Target& target : targets()) {
        long failures = 0, accepted = 0;
        for (const auto& entry : fs::directory_iterator(fs::path(RISORIUS_SOURCE_DIR) /
                                                        "tests/fuzz/seeds" / target.name)) {
            SCOPED_TRACE(entry.path().string());
            std::ifstream file(entry.path(), std::ios::binary);
            const std::string bytes{std::istreambuf_iterator<char>(file), {}};
            // The first time, tables are read that stay for good.
            read_with(target, bytes, -1);
            const Outcome whole = read_with(target, bytes, -1);
            EXPECT_EQ(whole.kept, 0);
            if (!whole.threw) ++accepted;
            for (long given = 0;; ++given) {
                const Outcome outcome = read_with(target, bytes, given);
                EXPECT_EQ(outcome.kept, 0) << "after " << given << " allocations";
                // Some functions of the library do with less, such as stable_sort().
                if (!outcome.threw) {
                    EXPECT_EQ(outcome.digest, whole.digest) << "after " << given << " allocations";
                }
                if (!outcome.failed) break;
                ++failures;
            }
        }
        EXPECT_GT(accepted, 0) << target.name;
        std::printf("%-14s %6ld allocations failed\n", target.name.c_str(), failures);
    }
}

}  // namespace
}  // namespace risorius::fuzz
