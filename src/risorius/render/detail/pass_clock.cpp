// SPDX-License-Identifier: MIT
#include "risorius/render/detail/pass_clock.h"

#include <algorithm>
#include <ctime>

#include "risorius/render/detail/gl_context.h"

namespace risorius::render {

double processor_s() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

void PassClock::begin() {
    if (!on_) return;
    finish_drawing();
    since_s_ = processor_s();
}

void PassClock::passed(const char* name) {
    if (!on_) return;
    finish_drawing();
    const double now_s = processor_s();
    auto found = std::find_if(times_.begin(), times_.end(),
                              [&](const auto& pass) { return pass.first == name; });
    if (found == times_.end()) found = times_.insert(times_.end(), {name, 0.0});
    found->second += now_s - since_s_;
    since_s_ = now_s;
}

}  // namespace risorius::render
