// SPDX-License-Identifier: MIT
#include "risorius/perform/channel_columns.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

#include "risorius/core/error.h"
#include "risorius/core/json_object.h"
#include "risorius/face/face.h"
#include "risorius/face/quality.h"
#include "risorius/perform/detail/curve_fit.h"
#include "risorius/render/offscreen_view.h"
#include "risorius/scene/scene_from_rig.h"
#include "risorius/track/script.h"
#include "risorius/track/timeline.h"

namespace risorius::perform {

namespace {

constexpr int kPicture_px = 320;
constexpr double kShown = 0.75, kTurned_deg = 8, kTested_deg = 5;
// What the network is off by, of the distance between the eyes: the price of a channel
constexpr double kNoise = 0.001;

// Units that a camera can see at all. A jaw is a kinematic channel.
constexpr const char* kUnits[] = {"AU1",  "AU2",  "AU4",  "AU45", "AU9",     "AU10",
                                  "AU12", "AU15", "AU18", "AU20", "jaw_open"};
// These move both sides alike in most people, and one side of them is not told apart by the network.
constexpr const char* kBothSides[] = {"AU4", "AU9", "AU10", "AU15", "AU18", "AU20", "jaw_open"};

constexpr const char* kConfused[] = {"AU1", "AU15", "AU18", "AU20"};

/// Without its side.
std::string unit_of(const std::string& channel) { return channel.substr(0, channel.find('.')); }

void judge(std::vector<CameraChannel>& channels) {
    std::set<std::string> unreliable(std::begin(kConfused), std::end(kConfused));
    for (const CameraChannel& one : channels)
        if (one.error > kReliable || one.false_rms > kReliableElsewhere)
            unreliable.insert(unit_of(one.name));
    for (CameraChannel& one : channels) one.reliable = !unreliable.contains(unit_of(one.name));
}

std::vector<CameraChannel> channels_of(const scene::RigFiles& files) {
    std::vector<CameraChannel> out;
    for (const std::string name : kUnits) {
        const auto unit = std::find_if(files.rig.facs.units.begin(), files.rig.facs.units.end(),
                                       [&](const track::ActionUnit& u) { return u.id == name; });
        const bool known = unit != files.rig.facs.units.end() && unit->unsupported.empty();
        if (!known && name != "jaw_open") continue;
        const bool both =
            name == "jaw_open" || !unit->sided ||
            std::find(std::begin(kBothSides), std::end(kBothSides), name) != std::end(kBothSides);
        if (both)
            out.push_back({name});
        else
            for (const char* side : {".l", ".r"}) out.push_back({name + side});
    }
    return out;
}

/// Where the moving points have gone, as one column; depth is a guess of the network and left out.
Eigen::VectorXd stacked(const std::vector<Vec3>& moved) {
    const std::vector<int>& points = moving_points();
    Eigen::VectorXd out(static_cast<Eigen::Index>(2 * points.size()));
    for (std::size_t k = 0; k < points.size(); ++k)
        out.segment<2>(static_cast<Eigen::Index>(2 * k)) =
            moved[static_cast<std::size_t>(points[k])].head<2>();
    return out;
}

constexpr const char *kLeftLid = "AU45.l", *kRightLid = "AU45.r";

constexpr std::pair<const char*, double> kTurns[] = {{"head_yaw_deg", kTurned_deg},
                                                     {"head_yaw_deg", -kTurned_deg},
                                                     {"head_pitch_deg", kTurned_deg},
                                                     {"head_pitch_deg", -kTurned_deg}};

/// Shows pictures of a rig to the network.
class Looks {
  public:
    Looks(RigPictures& pictures, const landmarks::FaceNetwork& network)
        : pictures_(pictures), network_(network) {
        const Image picture = pictures.draw({});
        const auto seen = find_face(network, picture);
        if (!seen)
            throw Error("the face of the rig", "one that the face network sees",
                        "none in a picture from the front");
        near_ = seen->next;
        rest_ = look_closely(network, picture, near_).points;
    }
    const std::vector<Vec3>& rest() const { return rest_; }
    ShapeChange change(const std::vector<std::pair<std::string, double>>& values) {
        const Image picture = pictures_.draw(values);
        const Crop crop = look_at(network_, picture, near_).next;
        return change_of(rest_, look_closely(network_, picture, crop).points);
    }

  private:
    RigPictures& pictures_;
    const landmarks::FaceNetwork& network_;
    Crop near_;
    std::vector<Vec3> rest_;
};

}  // namespace

struct RigPictures::Impl {
    std::shared_ptr<const scene::RigFiles> files;
    track::ChannelTable channels;
    face::Face face;
    render::Scene scene;
    render::OffscreenView view;

    explicit Impl(std::shared_ptr<const scene::RigFiles> rig)
        : files(std::move(rig)),
          channels(files->rig.channels()),
          face(files->rig, files->mesh, face::quality_named("draft"), files->place()),
          scene(scene::scene_from_rig(face.head(), files->rig, files->mesh)),
          view(scene, {.width_px = kPicture_px, .height_px = kPicture_px, .supersampling = 1}) {}
};

RigPictures::RigPictures(std::shared_ptr<const scene::RigFiles> rig)
    : impl_(std::make_unique<Impl>(std::move(rig))) {}
RigPictures::~RigPictures() = default;
const scene::RigFiles& RigPictures::rig() const { return *impl_->files; }

Image RigPictures::draw(const std::vector<std::pair<std::string, double>>& values) {
    Json script = json_object({{"format", "risorius-script"},
                               {"version", 1},
                               {"rig", "rig.json"},
                               {"duration_s", 1},
                               {"channels", Json::object()}});
    for (const auto& [name, value] : values)
        script["channels"][name] = json_object({{"keys", Json::array({Json::array({0, value})})}});
    const rig::RigDescription& rig = impl_->files->rig;
    const track::Timeline timeline(track::read_script(JsonCursor::from_json(script, "camera"),
                                                      impl_->channels, rig.facs, rig.expressions),
                                   impl_->channels);
    impl_->face.start([&](double t_s) { return timeline.at(t_s); });
    return impl_->view.draw(scene::pose_for_view(impl_->face.pose()));
}

Columns channel_columns(RigPictures& pictures, const landmarks::FaceNetwork& network,
                        const ProgressMonitor& monitor) {
    Columns out;
    out.channels = channels_of(pictures.rig());
    const auto count = static_cast<Eigen::Index>(out.channels.size()),
               turns = static_cast<Eigen::Index>(std::size(kTurns));
    TaskProgress progress(monitor, static_cast<int>(3 * count + turns + 1));
    progress.begin("the face at rest");
    Looks looks(pictures, network);
    out.rest = looks.rest();
    out.moved.resize(static_cast<Eigen::Index>(2 * moving_points().size()), 2 * (count + turns));
    for (Eigen::Index c = 0; c < count; ++c)
        for (const int level : {0, 1}) {
            const std::string& name = out.channels[static_cast<std::size_t>(c)].name;
            progress.begin(name);
            const ShapeChange change = looks.change({{name, 0.5 * (level + 1)}});
            out.moved.col(2 * c + level) = stacked(change.moved);
            if (name == kLeftLid) out.closed = std::min(out.closed, change.left_open);
            if (name == kRightLid) out.closed = std::min(out.closed, change.right_open);
        }
    for (Eigen::Index t = 0; t < turns; ++t) {
        const auto& [name, angle_deg] = kTurns[t];
        progress.begin(name);
        out.moved.col(2 * (count + t) + 1) = stacked(looks.change({{name, angle_deg}}).moved);
        out.moved.col(2 * (count + t)) = 0.5 * out.moved.col(2 * (count + t) + 1);
    }
    for (std::size_t shown = 0; shown < out.channels.size(); ++shown) {
        const std::string& name = out.channels[shown].name;
        progress.begin(name);
        const std::vector<double> found =
            fitted_channels(out, looks.change({{name, kShown}, {"head_yaw_deg", kTested_deg}}));
        for (std::size_t c = 0; c < found.size(); ++c)
            if (c == shown)
                out.channels[c].error = std::abs(found[c] - kShown);
            else
                out.channels[c].false_rms += found[c] * found[c];
    }
    for (CameraChannel& one : out.channels)
        one.false_rms = std::sqrt(one.false_rms / std::max(1.0, static_cast<double>(count - 1)));
    judge(out.channels);
    return out;
}

std::vector<double> fitted_channels(const Columns& columns, const ShapeChange& change) {
    const auto count = columns.channels.size();
    const auto lid = [&](std::size_t c) {
        const std::string& name = columns.channels[c].name;
        return name == kLeftLid || name == kRightLid;
    };
    std::vector<Eigen::Index> cols;
    std::vector<double> weights;
    for (std::size_t c = 0; 2 * c < static_cast<std::size_t>(columns.moved.cols()); ++c) {
        if (c < count && lid(c)) continue;
        for (const int level : {0, 1}) cols.push_back(2 * static_cast<Eigen::Index>(c) + level);
        // Turns of the head cost nothing.
        weights.push_back(c < count ? kNoise * kNoise * static_cast<double>(columns.moved.rows())
                                    : 0);
    }
    const Eigen::MatrixXd moved = columns.moved(Eigen::all, cols);
    const Eigen::VectorXd values = curve_fit(moved, stacked(change.moved), weights);
    std::vector<double> out(count, 0);
    Eigen::Index next = 0;
    for (std::size_t c = 0; c < count; ++c) {
        if (!lid(c)) {
            out[c] = values[next++];
            continue;
        }
        const double open =
            columns.channels[c].name == kLeftLid ? change.left_open : change.right_open;
        out[c] = std::clamp((1 - open) / std::max(1 - columns.closed, 1e-3), 0.0, 1.0);
    }
    return out;
}

}  // namespace risorius::perform
