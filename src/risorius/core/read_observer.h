// SPDX-License-Identifier: MIT
/// \file
/// Shows the bytes of files to somebody who does not read them himself. A record of a run has the checksum of each input. It must
/// belong to the bytes that were used, and a file can change between two readings.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>

namespace risorius {

/// While an object of this class exists, read_file() and read_bytes() of its thread show it what they have read. The latest object
/// of a thread is the one that is asked.
class ReadObserver {
  public:
    using Seen =
        std::function<void(const std::filesystem::path& file, const void* bytes, std::size_t size)>;

    explicit ReadObserver(Seen seen);
    ~ReadObserver();
    ReadObserver(const ReadObserver&) = delete;
    ReadObserver& operator=(const ReadObserver&) = delete;

  private:
    friend void show_to_observer(const std::filesystem::path&, const void*, std::size_t);
    Seen seen_;
    ReadObserver* before_;
};

/// Shows the bytes of a whole file to the observer of this thread, if there is one.
void show_to_observer(const std::filesystem::path& file, const void* bytes, std::size_t size);

}  // namespace risorius
