// SPDX-License-Identifier: MIT
/// \file
/// Several equal faces that share work, as a fit or blend shapes: each task gets a face that no other task uses meanwhile.
///
/// A task has to start its face from rest (Face::start), and to leave the strengths of the muscles as it found them. Then its result
/// does not depend on which face it gets, and is the same for any number of threads.
#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <vector>

#include "risorius/core/parallel.h"
#include "risorius/face/face.h"

namespace risorius::face {

/// More faces than this take more memory than they save time.
inline constexpr int kMaxTeam = 16;

class FaceTeam {
  public:
    /// One face does all the work. It must outlive the team.
    explicit FaceTeam(Face& only) : faces_{&only}, free_(faces_) {}
    /// `build` makes faces that equal `first`. There are as many faces as threads, kMaxTeam at most.
    FaceTeam(Face& first, const std::function<Face()>& build, const ThreadLimit& threads);

    Face& first() const { return *faces_.front(); }

    /// Calls task(i, face) for i in [0, count), on several threads. Of several exceptions, that with the lowest i is thrown.
    void each(int count, const std::function<void(int i, Face& face)>& task);
    /// Makes the same change to all faces.
    void all(const std::function<void(Face& face)>& change) const {
        for (Face* one : faces_) change(*one);
    }

  private:
    std::vector<std::unique_ptr<Face>> own_;
    std::vector<Face*> faces_, free_;
    std::mutex mutex_;
};

}  // namespace risorius::face
