// SPDX-License-Identifier: MIT
#include "risorius/core/result_cache.h"

#include <gnu/libc-version.h>
#include <link.h>
#if defined(__x86_64__)
#include <cpuid.h>
#endif

#include <atomic>
#include <cstdlib>
#include <cstring>
#include <stdexcept>

#include "risorius/core/detail/result_folder.h"
#include "risorius/core/input_log.h"
#include "risorius/core/read_file.h"

namespace risorius {

namespace fs = std::filesystem;

namespace {

/// A file: these words, the hash of all that follows, the key, the bytes of the result.
constexpr std::string_view kMagic = "risorius result 1\n";
constexpr std::size_t kHashDigits = 64;

std::atomic<bool> cache_wanted{true};

/// The build IDs of the program and of the libraries that it has loaded. The linker makes them: hashes of the code.
struct BuildIds {
    std::string all;
    bool of_this_code = false;  ///< the part that contains this code has one
};

int add_build_id(dl_phdr_info* object, std::size_t /*size*/, void* to) {
    BuildIds& ids = *static_cast<BuildIds*>(to);
    const auto here = reinterpret_cast<ElfW(Addr)>(&add_build_id);
    bool contains_this = false, has_id = false;
    for (int i = 0; i < object->dlpi_phnum; ++i) {
        const auto& segment = object->dlpi_phdr[i];
        const ElfW(Addr) begin = object->dlpi_addr + segment.p_vaddr;
        if (segment.p_type == PT_LOAD)
            contains_this |= here >= begin && here < begin + segment.p_memsz;
        if (segment.p_type != PT_NOTE) continue;
        const char* at = reinterpret_cast<const char*>(begin);
        const char* end = at + segment.p_memsz;
        while (at + sizeof(ElfW(Nhdr)) <= end) {
            const auto* note = reinterpret_cast<const ElfW(Nhdr)*>(at);
            const auto padded = [](std::size_t n) { return (n + 3) & ~std::size_t{3}; };
            const char* name = at + sizeof *note;
            const char* text = name + padded(note->n_namesz);
            if (note->n_type == NT_GNU_BUILD_ID && note->n_namesz == 4 &&
                std::memcmp(name, "GNU", 4) == 0) {
                ids.all.append(text, note->n_descsz);
                has_id = true;
            }
            at = text + padded(note->n_descsz);
        }
    }
    ids.of_this_code |= contains_this && has_id;
    return 0;
}

/// Returns what tells this build on this kind of processor from others. It is empty when the linker wrote no build ID, so that
/// nothing tells this build from the next.
std::string build_and_machine() {
    BuildIds ids;
    dl_iterate_phdr(&add_build_id, &ids);
    if (!ids.of_this_code) return {};
    std::string text = ids.all;
    text += gnu_get_libc_version();
#if defined(__x86_64__)
    // Family and model, and the instructions that libraries choose between
    for (const unsigned leaf : {1U, 7U}) {
        std::array<unsigned, 4> r{};
        if (!__get_cpuid_count(leaf, 0, r.data(), &r[1], &r[2], &r[3])) continue;
        if (leaf == 1) r[1] = 0;             // the number of the core that runs this
        if (leaf == 1) r[2] &= ~(1U << 27);  // whether the system saves the extended state
        text.append(reinterpret_cast<const char*>(r.data()), sizeof r);
    }
#endif
    return text;
}

const std::string& this_build() {
    static const std::string text = build_and_machine();
    return text;
}

fs::path results_folder() {
    const fs::path folder = cache_folder();
    return folder.empty() ? folder : folder / "results";
}

std::string hash_of(std::string_view bytes) {
    Sha256 hash;
    hash.add(bytes.data(), bytes.size());
    return hash.finish();
}

}  // namespace

CacheKey::CacheKey(std::string_view computation) {
    add(computation);
    add(this_build());
}

CacheKey& CacheKey::add_bytes(const void* bytes, std::size_t count) {
    hash_.add(bytes, count);
    return *this;
}

// The count goes in too, so that two lists cannot be taken for one.
CacheKey& CacheKey::add_list(const void* values, std::size_t count, std::size_t bytes_of_one) {
    add(count);
    return add_bytes(values, count * bytes_of_one);
}

void ResultBytes::put_list(const void* values, std::size_t count, std::size_t bytes_of_one) {
    const std::uint64_t bytes = count * bytes_of_one;
    bytes_.append(reinterpret_cast<const char*>(&bytes), sizeof bytes);
    bytes_.append(static_cast<const char*>(values), bytes);
}

std::size_t ResultBytes::take_count(std::size_t columns, std::size_t bytes_of_one) {
    std::uint64_t bytes = 0;
    take_list(&bytes, sizeof bytes);
    if (bytes > bytes_.size() - next_ || bytes % (columns * bytes_of_one) != 0)
        throw std::out_of_range("a result of the cache");
    return bytes / (columns * bytes_of_one);
}

void ResultBytes::take_list(void* values, std::size_t bytes) {
    if (bytes > bytes_.size() - next_) throw std::out_of_range("a result of the cache");
    if (bytes > 0) std::memcpy(values, bytes_.data() + next_, bytes);
    next_ += bytes;
}

void use_result_cache(bool wanted) { cache_wanted = wanted; }

fs::path cache_folder() {
    if (!cache_wanted) return {};
    const auto value = [](const char* name) -> std::string {
        const char* set = std::getenv(name);
        return set ? set : "";
    };
    if (const std::string own = value("RISORIUS_CACHE"); !own.empty())
        return own == "off" ? fs::path() : fs::path(own);
    if (const std::string all = value("XDG_CACHE_HOME"); !all.empty())
        return fs::path(all) / "risorius";
    const std::string home = value("HOME");
    return home.empty() ? fs::path() : fs::path(home) / ".cache/risorius";
}

std::optional<ResultBytes> find_result(const std::string& key) {
    const fs::path folder = results_folder();
    if (folder.empty() || this_build().empty()) return std::nullopt;
    const fs::path file = folder / key;
    std::error_code failed;
    if (!fs::is_regular_file(file, failed)) return std::nullopt;
    try {
        const ReadingFormerOutput no_input;
        std::string bytes = read_file(file, {"a result of the cache", kMaxCacheBytes});
        const std::size_t head = kMagic.size() + kHashDigits;
        const std::string_view all = bytes;
        if (bytes.size() >= head + key.size() && all.starts_with(kMagic) &&
            all.substr(head, key.size()) == key &&
            all.substr(kMagic.size(), kHashDigits) == hash_of(all.substr(head))) {
            fs::last_write_time(file, fs::file_time_type::clock::now(), failed);  // it was used
            return ResultBytes(bytes.substr(head + key.size()));
        }
    } catch (const std::exception&) {
        // As if it were damaged
    }
    fs::remove(file, failed);
    return std::nullopt;
}

void keep_result(const std::string& key, const ResultBytes& result) {
    const fs::path folder = results_folder();
    if (folder.empty() || this_build().empty()) return;
    const std::string body = key + result.bytes();
    put_into_folder(folder, key, std::string(kMagic) + hash_of(body) + body, kMaxCacheBytes);
}

}  // namespace risorius
