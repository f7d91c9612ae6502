// SPDX-License-Identifier: MIT
#include "risorius/inverse/compare_heads.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "risorius/core/error.h"
#include "risorius/core/json_object.h"
#include "risorius/face/face.h"
#include "risorius/scene/landmark_displacements.h"
#include "risorius/scene/rig_files.h"

namespace risorius::inverse {

namespace {

// One head and the displacements of its landmarks.
struct Mover {
    Mover(const std::filesystem::path& file, const std::string& quality,
          const ProgressMonitor& monitor)
        : files(scene::read_rig_files(file, monitor.stopped)),
          face(files.rig, files.mesh, face::quality_named(quality), files.place()),
          ways(face, files.rig, files.place()) {}
    scene::RigFiles files;
    face::Face face;
    scene::LandmarkDisplacements ways;
};

}  // namespace

double HeadComparison::mean_difference() const {
    double sum = 0;
    for (const HeadDifference& one : expressions)
        sum += one.difference / static_cast<double>(expressions.size());
    return sum;
}

Json HeadComparison::json() const {
    Json list = Json::array();
    for (const HeadDifference& one : expressions)
        list.push_back(json_object({{"name", one.expression},
                                    {"difference", one.difference},
                                    {"cosine", one.cosine},
                                    {"length_ratio", one.length_ratio},
                                    {"landmark_mm", one.landmark_mm},
                                    {"worst_landmark", one.worst}}));
    return json_object({{"format", "risorius-head-comparison"},
                        {"version", 1},
                        {"rig", rig},
                        {"like", like},
                        {"mean_difference", mean_difference()},
                        {"expressions", list}});
}

HeadComparison compare_heads(const std::filesystem::path& rig, const std::filesystem::path& like,
                             const std::vector<std::string>& names, const std::string& quality,
                             const ProgressMonitor& monitor) {
    Mover own(rig, quality, monitor), other(like, quality, monitor);
    HeadComparison out{rig.generic_string(), like.generic_string(), {}};
    const std::vector<std::string>& ids = own.ways.landmarks();
    if (ids != other.ways.landmarks())
        throw Error(like.string(), "the same landmarks as " + rig.string(), "others");
    for (const std::string& name : names) {
        monitor.report(
            static_cast<double>(out.expressions.size()) / static_cast<double>(names.size()), name);
        const Points u = 1e3 * own.ways.solve_equilibrium(own.ways.drive(name)),
                     g = 1e3 * other.ways.solve_equilibrium(other.ways.drive(name));
        HeadDifference one;
        one.expression = name;
        const double uu = u.squaredNorm(), gg = g.squaredNorm();
        if (gg > 0 && uu > 0) {
            one.difference = std::sqrt((u - g).squaredNorm() / gg);
            one.cosine = u.cwiseProduct(g).sum() / std::sqrt(uu * gg);
            one.length_ratio = std::sqrt(uu / gg);
        }
        long worst = 0;
        (u - g).rowwise().squaredNorm().maxCoeff(&worst);
        one.landmark_mm = (u - g).rowwise().norm().mean();
        one.worst = ids[static_cast<std::size_t>(worst)];
        out.expressions.push_back(one);
    }
    return out;
}

}  // namespace risorius::inverse
