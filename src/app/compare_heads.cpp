#include "app/compare_heads.h"

#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

#include "app/expression_drive.h"
#include "app/landmark_points.h"
#include "app/rig_files.h"
#include "core/error.h"
#include "sim/face.h"

namespace risorius::app {

namespace {

// One head and how its landmarks move, in atlas mm.
class Mover {
  public:
    Mover(const std::filesystem::path& file, const std::string& quality)
        : files_(read_rig_files(file)),
          face_(files_.rig, files_.mesh, sim::quality_named(quality), files_.place()),
          points_(face_.head(), files_.rig) {
        at_rest_.excitation = Eigen::VectorXd::Zero(files_.rig.channels().column_count());
    }
    std::vector<std::string> landmarks() const {
        static const std::set<std::string> kInner{"brow", "eye", "nose", "lip"};
        std::vector<std::string> out;
        for (const rig::AtlasLandmark& landmark : files_.rig.atlas.landmarks)
            if (kInner.count(landmark.region)) out.push_back(landmark.id);
        return out;
    }
    Points displacements(const std::string& expression) {
        const auto expansion = expansion_named(files_.rig, expression);
        if (!expansion)
            throw Error(files_.place(), "an expression of its tables", "\"" + expression + "\"");
        const track::Drive drive = clamped_drive(*expansion, files_.rig.channels());
        face_.start([&](double) { return at_rest_; });
        face_.settle(drive.excitation, drive);
        const Points vertices = face_.pose().vertices;
        const std::vector<std::string> ids = landmarks();
        Points out(static_cast<long>(ids.size()), 3);
        for (std::size_t i = 0; i < ids.size(); ++i)
            out.row(static_cast<long>(i)) =
                (points_.at(ids[i], vertices) - points_.at(ids[i], face_.head().vertices))
                    .transpose() *
                (1e3 / face_.head().size);
        return out;
    }

  private:
    RigFiles files_;
    sim::Face face_;
    LandmarkPoints points_;
    track::Drive at_rest_;
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
        list.push_back({{"name", one.expression},
                        {"difference", one.difference},
                        {"cosine", one.cosine},
                        {"length_ratio", one.length_ratio},
                        {"landmark_mm", one.landmark_mm},
                        {"worst_landmark", one.worst}});
    return {
        {"format", "risorius-head-comparison"}, {"version", 1},       {"rig", rig}, {"like", like},
        {"mean_difference", mean_difference()}, {"expressions", list}};
}

HeadComparison compare_heads(const std::filesystem::path& rig, const std::filesystem::path& like,
                             const std::vector<std::string>& names, const std::string& quality,
                             const Watch& watch) {
    Mover own(rig, quality), other(like, quality);
    HeadComparison out{rig.generic_string(), like.generic_string(), {}};
    const std::vector<std::string> ids = own.landmarks();
    if (ids != other.landmarks())
        throw Error(like.string(), "the same landmarks as " + rig.string(), "others");
    for (const std::string& name : names) {
        watch.tell(static_cast<double>(out.expressions.size()) / static_cast<double>(names.size()),
                   name);
        const Points u = own.displacements(name), g = other.displacements(name);
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

}  // namespace risorius::app
