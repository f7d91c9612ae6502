// SPDX-License-Identifier: MIT
#include "risorius/core/read_observer.h"

#include <utility>

namespace risorius {

namespace {

thread_local ReadObserver* observer = nullptr;

}  // namespace

ReadObserver::ReadObserver(Seen seen) : seen_(std::move(seen)), before_(observer) {
    observer = this;
}

ReadObserver::~ReadObserver() { observer = before_; }

void show_to_observer(const std::filesystem::path& file, const void* bytes, std::size_t size) {
    if (observer) observer->seen_(file, bytes, size);
}

}  // namespace risorius
