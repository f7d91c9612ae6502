// SPDX-License-Identifier: MIT
/// \file
/// Keeps the results of long computations in files, so that the next run of a program reads them. A result is found again by its
/// key: a hash of everything that it depends on.
///
/// Results lie in the folder "results" of
///   1. the environment variable RISORIUS_CACHE, where "off" means that nothing is kept,
///   2. `$XDG_CACHE_HOME/risorius`,
///   3. `$HOME/.cache/risorius`.
/// The folder never holds more than kMaxCacheBytes: the results that were not used for longest go first. A file that is damaged, or
/// was written by another build, is never used. No error of the cache ends a run; it costs time only.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "risorius/core/sha256.h"

namespace risorius {

inline constexpr std::uint64_t kMaxCacheBytes = 1'000'000'000;

/// Whether T is kept as its bytes: a number or an enumerator.
template <class T>
concept PlainNumber = std::is_arithmetic_v<T> || std::is_enum_v<T>;

/// The key of a result. It contains the name of the computation, the build of the program and of the libraries that it uses, and the
/// kind of processor, because each of them can change the last bit.
class CacheKey {
  public:
    explicit CacheKey(std::string_view computation);

    template <PlainNumber T>
    CacheKey& add(T value) {
        return add_bytes(&value, sizeof value);
    }
    CacheKey& add(std::string_view text) { return add_list(text.data(), text.size(), 1); }
    CacheKey& add(const std::string& text) { return add(std::string_view(text)); }
    template <PlainNumber T>
    CacheKey& add(const std::vector<T>& values) {
        return add_list(values.data(), values.size(), sizeof(T));
    }
    template <class T, std::size_t N>
    CacheKey& add(const std::array<T, N>& values) {
        for (const T& value : values) add(value);
        return *this;
    }
    template <class T, int R, int C, int O>
    CacheKey& add(const Eigen::Matrix<T, R, C, O>& values) {
        add(values.rows());
        return add_list(values.data(), static_cast<std::size_t>(values.size()), sizeof(T));
    }

    /// Returns the key, 64 hexadecimal digits. Nothing can be added afterwards.
    std::string finish() { return hash_.finish(); }

  private:
    CacheKey& add_bytes(const void* bytes, std::size_t count);
    CacheKey& add_list(const void* values, std::size_t count, std::size_t bytes_of_one);

    Sha256 hash_;
};

/// A result as bytes. Put its parts in one after the other, and take them in the same order.
class ResultBytes {
  public:
    ResultBytes() = default;
    explicit ResultBytes(std::string bytes) : bytes_(std::move(bytes)) {}

    template <PlainNumber T>
    void put(const std::vector<T>& values) {
        put_list(values.data(), values.size(), sizeof(T));
    }
    template <class T, int C, int O>
    void put(const Eigen::Matrix<T, Eigen::Dynamic, C, O>& values) {
        put_list(values.data(), static_cast<std::size_t>(values.size()), sizeof(T));
    }

    /// Throws std::out_of_range when the bytes are not what was put in.
    template <PlainNumber T>
    void take(std::vector<T>& values) {
        values.resize(take_count(1, sizeof(T)));
        take_list(values.data(), values.size() * sizeof(T));
    }
    template <class T, int C, int O>
    void take(Eigen::Matrix<T, Eigen::Dynamic, C, O>& values) {
        values.resize(static_cast<Eigen::Index>(take_count(C, sizeof(T))), C);
        take_list(values.data(), static_cast<std::size_t>(values.size()) * sizeof(T));
    }

    const std::string& bytes() const { return bytes_; }

  private:
    void put_list(const void* values, std::size_t count, std::size_t bytes_of_one);
    std::size_t take_count(std::size_t columns, std::size_t bytes_of_one);
    void take_list(void* values, std::size_t bytes);

    std::string bytes_;
    std::size_t next_ = 0;
};

/// Returns the result that was kept under a key; none when there is none, or its file is damaged. Damaged files are removed.
std::optional<ResultBytes> find_result(const std::string& key);

/// Keeps a result.
void keep_result(const std::string& key, const ResultBytes& result);

/// Whether this process uses the cache. The default is yes. A program calls it before its first computation.
void use_result_cache(bool wanted);

/// The folder of the cache, above the results; empty when nothing is kept.
std::filesystem::path cache_folder();

/// Returns the result of `compute`, from the cache where it is known. `each_field(result, visit)` calls `visit` with each vector and
/// matrix of a result, in one order.
template <class Compute, class EachField>
auto cached_result(const std::string& key, const Compute& compute, const EachField& each_field) {
    using Result = std::invoke_result_t<Compute>;
    if (cache_folder().empty()) return compute();
    if (std::optional<ResultBytes> kept = find_result(key)) try {
            Result result{};
            each_field(result, [&](auto& field) { kept->take(field); });
            return result;
        } catch (const std::out_of_range&) {
            // The fields of the result are not those of the build that kept it.
        }
    Result result = compute();
    ResultBytes bytes;
    each_field(result, [&](auto& field) { bytes.put(field); });
    keep_result(key, bytes);
    return result;
}

}  // namespace risorius
