// SPDX-License-Identifier: MIT
// A suite of tests that share one adult.
#pragma once

#include <gtest/gtest.h>

#include <memory>

#include "paths.h"
#include "risorius/face/face.h"
#include "risorius/io/morph_model.h"
#include "risorius/scene/rig_files.h"

namespace risorius::blendshapes {

/// Builds the adult once for all tests of a suite.
class AdultSuite : public testing::Test {
  protected:
    static void SetUpTestSuite() {
        files_ = std::make_unique<scene::RigFiles>(scene::read_rig_files(
            std::filesystem::path(RISORIUS_SOURCE_DIR) / "rigs/adult/rig.json"));
        face_ = std::make_unique<face::Face>(files_->rig, files_->mesh,
                                             face::quality_named("preview"), files_->place());
    }
    static void TearDownTestSuite() {
        face_.reset();
        files_.reset();
    }
    /// The index of a node; -1 when the model has none of this name.
    static int node_of(const io::MorphModel& model, const std::string& name) {
        for (std::size_t n = 0; n < model.nodes.size(); ++n)
            if (model.nodes[n].name == name) return static_cast<int>(n);
        return -1;
    }
    inline static std::unique_ptr<scene::RigFiles> files_;
    inline static std::unique_ptr<face::Face> face_;
};

}  // namespace risorius::blendshapes
