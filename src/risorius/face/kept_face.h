// SPDX-License-Identifier: MIT
/// \file
/// A moment of a simulated face, to which it can go back. Tissue has a memory: it depends on all that the face did before.
#pragma once

#include <cstddef>
#include <memory>
#include <utility>

#include "risorius/face/face.h"

namespace risorius::face {

class KeptFace {
  public:
    struct Content;
    explicit KeptFace(std::shared_ptr<const Content> content) : content_(std::move(content)) {}
    double time_s() const;      ///< since Face::start(), s
    std::size_t bytes() const;  ///< that it takes in memory, nearly
    const Content& content() const { return *content_; }

  private:
    std::shared_ptr<const Content> content_;
};

}  // namespace risorius::face
