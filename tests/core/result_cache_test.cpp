// SPDX-License-Identifier: MIT
// Results are found again by what they depend on, and nothing that is damaged is believed.
#include "risorius/core/result_cache.h"

#include <gtest/gtest.h>

#include <chrono>
#include <fstream>
#include <set>

#include "cache_setting.h"
#include "risorius/core/types.h"
#include "temporary_folder.h"

namespace risorius {
namespace {

namespace fs = std::filesystem;

struct Numbers {
    std::vector<double> values;
    Triangles triangles;
    bool operator==(const Numbers& other) const {
        return values == other.values && triangles == other.triangles;
    }
};

/// A folder of results for each test.
class ResultCache : public testing::Test {
  protected:
    Numbers numbers(const std::string& key) {
        return cached_result(
            key,
            [&] {
                ++computed_;
                Triangles triangles(2, 3);
                triangles << 0, 1, 2, 2, 1, 3;
                return Numbers{{0.1, -2, 1e-300}, triangles};
            },
            [](Numbers& of, const auto& visit) {
                visit(of.values);
                visit(of.triangles);
            });
    }
    static std::string key() { return CacheKey("test").add(1.5).finish(); }
    fs::path only_file() const {
        fs::path file;
        for (const auto& entry : fs::directory_iterator(folder_ / "results")) {
            EXPECT_TRUE(file.empty());
            file = entry.path();
        }
        return file;
    }

    TemporaryFolder folder_;
    CacheSetting here_{folder_.path().string()};
    int computed_ = 0;
};

TEST_F(ResultCache, ComputesOnce) {
    const Numbers first = numbers(key());
    EXPECT_EQ(numbers(key()), first);
    EXPECT_EQ(computed_, 1);
    EXPECT_EQ(only_file().filename(), key());
}

TEST_F(ResultCache, KeysDifferWithAllThatWasAdded) {
    const auto of = [](auto... parts) {
        CacheKey key("test");
        (key.add(parts), ...);
        return key.finish();
    };
    using Ints = std::vector<int>;
    const std::set<std::string> keys = {of(),
                                        CacheKey("other").finish(),
                                        of(1),
                                        of(2),
                                        of(1.0),
                                        of(Ints{1}, Ints{2}),
                                        of(Ints{1, 2}, Ints{}),
                                        of(Ints{1, 2}),
                                        of(std::string("ab"), std::string("c")),
                                        of(std::string("a"), std::string("bc")),
                                        of(Points(Points::Zero(2, 3))),
                                        of(Vec3(0, 0, 0)),
                                        of(Vec3(0, 0, -0.0))};
    EXPECT_EQ(keys.size(), 13u);
    EXPECT_EQ(of(1, Ints{3}), of(1, Ints{3}));
}

TEST_F(ResultCache, DoesNotBelieveADamagedFile) {
    const Numbers right = numbers(key());
    const std::string whole = bytes_of(only_file());
    int expected = 1;
    // One byte after the other, and each length
    for (std::size_t at = 0; at < whole.size(); at += 7) {
        std::string changed = whole;
        changed[at] = static_cast<char>(changed[at] ^ 1);
        for (const std::string& damaged : {changed, whole.substr(0, at)}) {
            std::ofstream(folder_ / "results" / key(), std::ios::binary) << damaged;
            EXPECT_EQ(numbers(key()), right) << at;
            EXPECT_EQ(computed_, ++expected) << at;
            EXPECT_EQ(bytes_of(only_file()), whole) << at;
        }
    }
    // A whole file of another result
    const std::string other = CacheKey("test").add(2.5).finish();
    fs::rename(folder_ / "results" / key(), folder_ / "results" / other);
    EXPECT_EQ(numbers(other), right);
    EXPECT_EQ(computed_, expected + 1);
}

TEST_F(ResultCache, ComputesWhereNothingCanBeKept) {
    {
        const CacheSetting off("off");
        numbers(key());
        numbers(key());
        EXPECT_EQ(computed_, 2);
    }
    use_result_cache(false);
    numbers(key());
    use_result_cache(true);
    EXPECT_EQ(computed_, 3);
    EXPECT_TRUE(folder_.listing().empty());
    std::ofstream(folder_ / "file") << "no folder";
    const CacheSetting no_folder((folder_ / "file").string());
    numbers(key());
    EXPECT_EQ(computed_, 4);
}

TEST_F(ResultCache, RemovesWhatWasNotUsedForLongest) {
    numbers(key());
    const auto make = [&](const std::string& name, std::uintmax_t bytes, int hours_ago) {
        const fs::path file = folder_ / "results" / name;
        std::ofstream(file).close();
        fs::resize_file(file, bytes);  // without blocks on the disk
        fs::last_write_time(file, fs::file_time_type::clock::now() - std::chrono::hours(hours_ago));
        return file;
    };
    const fs::path oldest = make("oldest", kMaxCacheBytes / 2, 30),
                   old = make("old", kMaxCacheBytes / 2, 20), part = make("a.part-bcdefg", 5, 1);
    numbers(CacheKey("test").add(2.5).finish());
    EXPECT_FALSE(fs::exists(oldest));
    EXPECT_FALSE(fs::exists(part));
    EXPECT_TRUE(fs::exists(old));
    EXPECT_TRUE(fs::exists(folder_ / "results" / key()));
}

}  // namespace
}  // namespace risorius
