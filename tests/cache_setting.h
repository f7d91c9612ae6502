// SPDX-License-Identifier: MIT
/// \file
/// Sets where results are kept, for the life of an object.
#pragma once

#include <cstdlib>
#include <string>

namespace risorius {

class CacheSetting {
  public:
    /// `place`: a folder, or "off".
    explicit CacheSetting(const std::string& place) {
        if (const char* set = std::getenv("RISORIUS_CACHE")) former_ = set;
        use(place);
    }
    ~CacheSetting() { use(former_); }
    CacheSetting(const CacheSetting&) = delete;
    CacheSetting& operator=(const CacheSetting&) = delete;

  private:
    static void use(const std::string& place) { ::setenv("RISORIUS_CACHE", place.c_str(), 1); }
    std::string former_;
};

}  // namespace risorius
