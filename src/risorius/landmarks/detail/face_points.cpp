// SPDX-License-Identifier: MIT
#include "risorius/landmarks/detail/face_points.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "risorius/core/json_cursor.h"
#include "risorius/core/parallel.h"

namespace risorius::landmarks {

namespace {

constexpr double kLikely = 0.5;  // score of a picture in which there may be a face
// Median spread of the views, of the distance from the eyes to the mouth: on heads 0.03, on other things 0.2 and more
constexpr double kAgreed = 0.08;
constexpr double kGrazing = 0.3;  // cosine below which a surface says nothing
constexpr int kRounds = 3, kMedianRounds = 40;
// Widths of the first pictures, of the longer side of the mesh: from a mask to a whole body
constexpr std::array<double, 7> kWidths{0.75, 1.0, 0.55, 0.4, 0.28, 0.2, 0.14};
constexpr double kAboveHead = 0.06;  // of the width of the picture

// Points of the network: the subject's left and right corners of the eyes and of the mouth
constexpr std::array<int, 2> kLeftEye{263, 362}, kRightEye{33, 133};
constexpr int kLeftMouth = 291, kRightMouth = 61;
// Of the face model of MediaPipe, cm: distance from the eyes to the mouth and between the outer corners of the eyes
constexpr double kEyesToMouth = 7.0, kEyeToEye = 8.9;

struct Angles {
    double yaw_deg, pitch_deg;
};
constexpr std::array<Angles, 13> kViews{{{0, 0},
                                         {-13, 0},
                                         {13, 0},
                                         {-26, 0},
                                         {26, 0},
                                         {-40, 0},
                                         {40, 0},
                                         {0, 12},
                                         {0, -12},
                                         {-20, 12},
                                         {20, 12},
                                         {-20, -12},
                                         {20, -12}}};

ViewFrame turned(const ViewFrame& frame, const Angles& angles) {
    const double degree = std::numbers::pi / 180;
    ViewFrame out = frame;
    out.axes = frame.axes * Eigen::AngleAxisd(angles.yaw_deg * degree, Vec3::UnitY()) *
               Eigen::AngleAxisd(-angles.pitch_deg * degree, Vec3::UnitX());
    return out;
}

/// Casts the points of a picture onto the surface; a weight of 0 where there is none or it is seen too flat.
std::vector<Sighting> lifted(const ShownHead& head, const ViewFrame& frame,
                             const FaceAnswer& answer) {
    std::vector<Sighting> out;
    std::vector<double> cosines;
    double sum = 0;
    const Vec3 viewer = frame.viewer();
    for (const Vec2& px : answer.points) {
        const Vec3 plane = frame.on_plane(px);
        const auto hit = head.tree.cast(viewer, plane - viewer);
        if (!hit) {
            cosines.push_back(0);
            out.push_back({plane, 0});
            continue;
        }
        Vec3 normal = Vec3::Zero();
        for (int k = 0; k < 3; ++k)
            normal += hit->barycentric[k] *
                      head.normals.row(head.triangles(hit->triangle, k)).transpose();
        cosines.push_back(normal.normalized().dot((viewer - plane).normalized()));
        sum += cosines.back();
        out.push_back({hit->point, 0});
    }
    // Through an open lid, a ray meets the inside of the head. Which side is the outside, most of the points say.
    const double outside = sum < 0 ? -1 : 1;
    for (std::size_t k = 0; k < out.size(); ++k) {
        const double above = std::max(0.0, outside * cosines[k] - kGrazing);
        out[k].weight = above * above;
    }
    return out;
}

/// The frame that the corners of eyes and mouth say; nothing when they do not lie as in a face.
std::optional<ViewFrame> frame_of(const std::vector<Sighting>& points) {
    const auto at = [&](int i) { return points[static_cast<std::size_t>(i)].at; };
    const Vec3 left = 0.5 * (at(kLeftEye[0]) + at(kLeftEye[1])),
               right = 0.5 * (at(kRightEye[0]) + at(kRightEye[1])), eyes = 0.5 * (left + right),
               mouth = 0.5 * (at(kLeftMouth) + at(kRightMouth));
    const double eye_to_eye = (at(kLeftEye[0]) - at(kRightEye[0])).norm(),
                 down = (eyes - mouth).norm();
    const Vec3 across = left - right + at(kLeftMouth) - at(kRightMouth);
    if (!(eye_to_eye > 0.3 * kEyeToEye / kEyesToMouth * down) ||
        !(down > 0.3 * kEyesToMouth / kEyeToEye * eye_to_eye))
        return std::nullopt;
    ViewFrame out;
    out.axes.col(0) = across.normalized();
    const Vec3 up = eyes - mouth;
    out.axes.col(1) = (up - up.dot(out.axes.col(0)) * out.axes.col(0)).normalized();
    out.axes.col(2) = out.axes.col(0).cross(out.axes.col(1));
    out.centre = 0.5 * (eyes + mouth);
    out.width =
        kPictureOfFace * kEyesToMouth * 0.5 * (eye_to_eye / kEyeToEye + down / kEyesToMouth);
    return out;
}

struct Glance {
    ViewFrame frame;
    double score = -1;
};

/// A small picture of the upper part of the mesh in one orientation, `share` of its longer side wide.
Glance glance(const ShownHead& head, const FaceNetwork& network, const Mat3& axes, double share) {
    Vec3 low = Vec3::Constant(1e300), high = -low;
    for (Eigen::Index v = 0; v < head.positions.rows(); ++v) {
        if (head.normals.row(v).isZero(0)) continue;  // not shown
        const Vec3 p = axes.transpose() * head.positions.row(v).transpose();
        low = low.cwiseMin(p);
        high = high.cwiseMax(p);
    }
    const double longest = std::max(high.x() - low.x(), high.y() - low.y());
    if (!(longest > 0)) return {};
    ViewFrame frame;
    frame.axes = axes;
    frame.width = share * longest * (1 + 2 * kAboveHead);
    const double middle = 0.5 * (low.y() + high.y()),
                 below_top = high.y() - (0.5 - kAboveHead) * frame.width;
    frame.centre = axes * Vec3(0.5 * (low.x() + high.x()), std::max(middle, below_top),
                               high.z() - 0.3 * frame.width);
    return {frame, network.look_at(face_picture(head, frame, 1)).score};
}

/// The 24 orientations of a cube; first the upright ones of most files.
std::vector<Mat3> orientations() {
    std::vector<Mat3> out;
    for (const int up : {1, 2, 0})
        for (const double up_sign : {1.0, -1.0})
            for (const int forward : {2, 0, 1})
                for (const double sign : {1.0, -1.0}) {
                    if (forward == up) continue;
                    Mat3 axes;
                    axes.col(1) = up_sign * Vec3::Unit(up);
                    axes.col(2) = sign * Vec3::Unit(forward);
                    axes.col(0) = axes.col(1).cross(axes.col(2));
                    out.push_back(axes);
                }
    return out;
}

}  // namespace

SeenPoint median_point(const std::vector<Sighting>& sightings) {
    SeenPoint out;
    for (const Sighting& seen : sightings) {
        out.at += seen.weight * seen.at;
        out.weight += seen.weight;
    }
    if (!(out.weight > 0)) return out;
    out.at /= out.weight;
    for (int round = 0; round < kMedianRounds; ++round) {
        Vec3 sum = Vec3::Zero();
        double all = 0, spread = 0;
        for (const Sighting& seen : sightings) spread += seen.weight * (seen.at - out.at).norm();
        out.spread = spread / out.weight;
        for (const Sighting& seen : sightings) {
            const double share =
                seen.weight / ((seen.at - out.at).norm() + 1e-3 * out.spread + 1e-300);
            sum += share * seen.at;
            all += share;
        }
        out.at = sum / all;
    }
    return out;
}

std::optional<FacePoints> look_around(const ShownHead& head, const FaceNetwork& network,
                                      const ViewFrame& near) {
    FacePoints out;
    out.frame = near;
    for (int round = 0; round < kRounds; ++round) {
        const FaceAnswer answer = network.look_at(face_picture(head, out.frame, 2));
        const auto next = frame_of(lifted(head, out.frame, answer));
        if (!next) return std::nullopt;
        out.frame = *next;
    }
    std::array<std::vector<Sighting>, kViews.size()> lifts;
    std::array<double, kViews.size()> scores{};
    parallel_for(static_cast<int>(kViews.size()), {}, [&](int i) {
        const auto at = static_cast<std::size_t>(i);
        const ViewFrame frame = turned(out.frame, kViews[at]);
        const FaceAnswer answer = network.look_at(face_picture(head, frame, 2));
        scores[at] = answer.score;
        lifts[at] = lifted(head, frame, answer);
    });
    for (const double score : scores) out.score += score / static_cast<double>(kViews.size());
    std::vector<double> spreads;
    for (std::size_t k = 0; k < kFacePoints; ++k) {
        std::vector<Sighting> sightings;
        for (const std::vector<Sighting>& lift : lifts) sightings.push_back(lift[k]);
        out.points.push_back(median_point(sightings));
        spreads.push_back(out.points.back().weight > 0 ? out.points.back().spread : kInfinity);
    }
    std::nth_element(spreads.begin(), spreads.begin() + kFacePoints / 2, spreads.end());
    out.spread = spreads[kFacePoints / 2];
    if (out.score < kLikely || out.spread > kAgreed * out.frame.width / kPictureOfFace)
        return std::nullopt;
    return out;
}

std::optional<FacePoints> find_face_points(const ShownHead& head, const FaceNetwork& network) {
    const std::vector<Mat3> all = orientations();
    for (const double width : kWidths) {
        std::vector<Glance> glances(all.size());
        parallel_for(static_cast<int>(all.size()), {}, [&](int i) {
            const auto at = static_cast<std::size_t>(i);
            glances[at] = glance(head, network, all[at], width);
        });
        const auto best =
            std::max_element(glances.begin(), glances.end(),
                             [](const Glance& a, const Glance& b) { return a.score < b.score; });
        if (best->score < kLikely) continue;
        if (auto found = look_around(head, network, best->frame)) return found;
    }
    return std::nullopt;
}

}  // namespace risorius::landmarks
