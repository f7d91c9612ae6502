// A folder of its own for one test, and pictures to fill it with.
#pragma once

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <string>

#include "core/image.h"

namespace risorius::media {

class TemporaryFolder {
  public:
    TemporaryFolder() {
        static int count = 0;
        path_ = std::filesystem::temp_directory_path() /
                ("risorius media " + std::to_string(::getpid()) + "-" + std::to_string(count++));
        std::filesystem::create_directories(path_);
    }
    ~TemporaryFolder() { std::filesystem::remove_all(path_); }
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;

    std::filesystem::path operator/(const std::string& name) const { return path_ / name; }
    const std::filesystem::path& path() const { return path_; }

    /// Every file and folder below, relative, in order of name.
    std::set<std::string> listing() const {
        std::set<std::string> names;
        for (const auto& entry : std::filesystem::recursive_directory_iterator(path_))
            names.insert(entry.path().lexically_relative(path_).string());
        return names;
    }

  private:
    std::filesystem::path path_;
};

inline std::string bytes_of(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

/// Noise that no codec can predict: pixel values of a linear congruential generator, opaque unless
/// asked otherwise.
inline Image noise(int width, int height, unsigned seed, bool opaque = true) {
    Image image(width, height);
    std::uint32_t state = seed * 2654435761u + 1;
    for (std::size_t i = 0; i < image.rgba.size(); ++i) {
        state = state * 1664525u + 1013904223u;
        image.rgba[i] = opaque && i % 4 == 3 ? 255 : static_cast<std::uint8_t>(state >> 24);
    }
    return image;
}

inline Image flat(int width, int height, int red, int green, int blue) {
    Image image(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            std::uint8_t* p = image.pixel(x, y);
            p[0] = static_cast<std::uint8_t>(red);
            p[1] = static_cast<std::uint8_t>(green);
            p[2] = static_cast<std::uint8_t>(blue);
            p[3] = 255;
        }
    return image;
}

}  // namespace risorius::media
