// SPDX-License-Identifier: MIT
/// \file
/// A graph model of TensorFlow.js as steps in the order of their results, for the few kinds of layer in detail/layers.h.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "risorius/landmarks/detail/layers.h"

namespace risorius::landmarks {

/// The files of a network, and the SHA-256 that they are known by.
struct NetworkFiles {
    const char *graph, *weights;
    const char *graph_sha256, *weights_sha256;
};

class NetworkGraph {
  public:
    /// Reads both files in a folder. `results`: names of the nodes whose results are wanted. Throws Error when a file is missing or
    /// is not the known one.
    NetworkGraph(const std::filesystem::path& folder, const NetworkFiles& files,
                 const std::vector<std::string>& results);
    ~NetworkGraph();
    NetworkGraph(const NetworkGraph&) = delete;
    NetworkGraph& operator=(const NetworkGraph&) = delete;

    /// The results in the order of their names. A sigmoid is left out: its result is that of the node before. Several threads may
    /// call it.
    std::vector<Picture> run(const Picture& picture) const;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace risorius::landmarks
