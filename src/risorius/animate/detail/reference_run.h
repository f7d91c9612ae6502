// Another script played beside the one that is shown, on the same head or one of the same mesh: where every vertex is there.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "risorius/core/types.h"
#include "risorius/rig/rig_description.h"

namespace risorius::animate {

class ReferenceRun {
  public:
    /// Throws Error when the script cannot be read or its mesh has another number of vertices than the one shown.
    ReferenceRun(const std::filesystem::path& script, const std::filesystem::path& rig,
                 const std::string& quality, Eigen::Index vertices);
    ~ReferenceRun();

    /// V x 3, m; times ascending.
    Points at(double t_s);

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace risorius::animate
