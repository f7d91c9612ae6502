// SPDX-License-Identifier: MIT
/// \file
/// What holds for every page of the studio, of a face and of a soft body.
#pragma once

#include <cstddef>

namespace risorius::cli {

inline constexpr long kTicksWithoutPage = 60 * 60;  ///< a minute; then the program ends
inline constexpr int kFirstCredit = 2;              ///< poses that a page is ready for at first
/// Messages that a page may leave unread; beyond them it gets no poses.
inline constexpr std::size_t kMostWaiting = 8;

}  // namespace risorius::cli
