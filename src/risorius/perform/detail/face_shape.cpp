// SPDX-License-Identifier: MIT
#include "risorius/perform/detail/face_shape.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "risorius/landmarks/similarity.h"

namespace risorius::perform {

namespace {

constexpr double kThereIsAFace = 0.5, kDegree = std::numbers::pi / 180;
// The square around a face over the longer side of the box of its points, as MediaPipe cuts pictures
constexpr double kAroundFace = 1.5;
// Squares in which a face is searched: their sides over the shorter side of the picture
constexpr std::array<double, 4> kSearched{1.0, 0.7, 0.5, 1.4};
constexpr double kSurely = 0.9;  // score at which the search ends
// Their middles, over width and height
const std::array<Vec2, 6> kSearchedAt{Vec2(0.5, 0.5), Vec2(0.5, 0.35), Vec2(0.3, 0.5),
                                      Vec2(0.7, 0.5), Vec2(0.3, 0.35), Vec2(0.7, 0.35)};

// Points of the network
constexpr int kLeftOuter = 263, kRightOuter = 33;
constexpr std::array kStable{10,  109, 338, 67,  297, 103, 332, 54,  284, 21,  251, 162,
                             389, 127, 356, 234, 454, 168, 6,   197, 195, 122, 351};
struct Corners {
    int outer, inner;
};
constexpr std::array<Corners, 2> kEyes{{{263, 362}, {33, 133}}};
constexpr double kAroundEye = 2.3;  // side of the square around an eye, as MediaPipe cuts it
constexpr double kEyeWidth = 0.35;  // of an eye, of the distance between the outer corners

/// The colour at a place between pixels; outside of the picture it is black.
void sample(const Image& picture, double x, double y, float* rgb) {
    const double left = std::floor(x), top = std::floor(y);
    for (int c = 0; c < 3; ++c) rgb[c] = 0;
    for (int dy = 0; dy < 2; ++dy)
        for (int dx = 0; dx < 2; ++dx) {
            const int px = static_cast<int>(left) + dx, py = static_cast<int>(top) + dy;
            if (px < 0 || py < 0 || px >= picture.width_px || py >= picture.height_px) continue;
            const double part = (dx ? x - left : 1 - (x - left)) * (dy ? y - top : 1 - (y - top));
            const std::uint8_t* pixel = picture.pixel(px, py);
            for (int c = 0; c < 3; ++c) rgb[c] += static_cast<float>(part * pixel[c] / 255);
        }
}

/// From a place in the square, -0.5..0.5, to px of the picture.
Vec2 in_picture(const Crop& crop, const Vec2& at) {
    const double c = std::cos(crop.roll), s = std::sin(crop.roll);
    return crop.centre + crop.side_px * Vec2(c * at.x() - s * at.y(), s * at.x() + c * at.y());
}

landmarks::Picture cut(const Image& picture, const Crop& crop, int side) {
    landmarks::Picture out(side, side, 3);
    // Of a large square, several places of the picture are the mean of a pixel.
    const int samples = std::clamp(static_cast<int>(crop.side_px / side + 0.5), 1, 4);
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) {
            float* to = out.at(y, x);
            for (int k = 0; k < 3; ++k) to[k] = 0;
            for (int i = 0; i < samples * samples; ++i) {
                const Vec2 place((x + (i % samples + 0.5) / samples) / side - 0.5,
                                 (y + (i / samples + 0.5) / samples) / side - 0.5);
                const Vec2 from = in_picture(crop, place);
                float rgb[3];
                sample(picture, from.x() - 0.5, from.y() - 0.5, rgb);
                for (int k = 0; k < 3; ++k) to[k] += rgb[k] / static_cast<float>(samples * samples);
            }
        }
    return out;
}

Crop around(const std::vector<Vec3>& points) {
    Vec2 low = Vec2::Constant(1e300), high = -low;
    const auto px = [&](int i) { return points[static_cast<std::size_t>(i)]; };
    const Vec3 across = px(kLeftOuter) - px(kRightOuter);
    Crop out;
    out.roll = std::atan2(-across.y(), across.x());  // y is up
    const double c = std::cos(out.roll), s = std::sin(out.roll);
    for (const Vec3& p : points) {
        const Vec2 upright(c * p.x() - s * p.y(), -s * p.x() - c * p.y());
        low = low.cwiseMin(upright);
        high = high.cwiseMax(upright);
    }
    const Vec2 middle = 0.5 * (low + high);
    out.centre = {c * middle.x() - s * middle.y(), s * middle.x() + c * middle.y()};
    out.side_px = kAroundFace * (high - low).maxCoeff();
    return out;
}

/// The square around an eye, upright along the line of its corners.
Crop around_eye(const std::vector<Vec3>& points, bool left) {
    const Corners& eye = kEyes[left ? 0 : 1];
    const Vec3 outer = points[static_cast<std::size_t>(eye.outer)],
               inner = points[static_cast<std::size_t>(eye.inner)];
    const Vec3 across = left ? outer - inner : inner - outer;
    Crop out;
    out.centre = {0.5 * (outer.x() + inner.x()), -0.5 * (outer.y() + inner.y())};
    out.side_px = kAroundEye * across.head<2>().norm();
    out.roll = std::atan2(-across.y(), across.x());
    return out;
}

landmarks::Picture mirrored(const landmarks::Picture& picture) {
    landmarks::Picture out(picture.height, picture.width, picture.channels);
    for (int y = 0; y < picture.height; ++y)
        for (int x = 0; x < picture.width; ++x)
            std::copy_n(picture.at(y, picture.width - 1 - x), picture.channels, out.at(y, x));
    return out;
}

/// R = Ry(yaw) Rx(-pitch) Rz(-roll)
HeadAngles angles_of(const Mat3& r) {
    return {std::atan2(r(0, 2), r(2, 2)) / kDegree,
            std::asin(std::clamp(r(1, 2), -1.0, 1.0)) / kDegree,
            std::atan2(-r(1, 0), r(1, 1)) / kDegree};
}

/// The points of the network at brows, nose and mouth, which channels move.
const std::vector<int>& moving_points() {
    static const std::vector<int> points{
        70,  63,  105, 66,  107, 55,  65,  52,  53,  46,  300, 293, 334, 296, 336, 285, 295, 282,
        283, 276, 9,   8,   108, 151, 337, 69,  299, 104, 333, 68,  298, 193, 417, 221, 441, 222,
        442, 223, 443, 224, 444, 225, 445, 189, 413, 1,   2,   4,   5,   19,  94,  98,  97,  99,
        129, 102, 49,  48,  64,  219, 218, 237, 44,  45,  275, 274, 457, 438, 439, 278, 279, 331,
        294, 327, 326, 328, 358, 114, 343, 128, 357, 217, 437, 198, 420, 131, 360, 203, 423, 165,
        391, 167, 393, 164, 61,  146, 91,  181, 84,  17,  314, 405, 321, 375, 291, 409, 270, 269,
        267, 0,   37,  39,  40,  185, 78,  95,  88,  178, 87,  14,  317, 402, 318, 324, 308, 415,
        310, 311, 312, 13,  82,  81,  80,  191, 152, 148, 377, 176, 400, 149, 378, 175, 199, 200,
        18,  83,  313, 57,  287, 212, 432, 216, 436, 206, 426, 92,  322, 43,  273};
    return points;
}

}  // namespace

SeenFace look_at(const landmarks::FaceNetwork& network, const Image& picture, const Crop& crop) {
    const landmarks::FaceAnswer answer =
        network.look_at(cut(picture, crop, landmarks::kFacePicture_px));
    SeenFace out;
    out.score = answer.score;
    constexpr double kSide = landmarks::kFacePicture_px;
    for (std::size_t k = 0; k < answer.points.size(); ++k) {
        const Vec2 px = in_picture(crop, answer.points[k] / kSide - Vec2::Constant(0.5));
        out.points.emplace_back(px.x(), -px.y(), -answer.depth[k] * crop.side_px / kSide);
    }
    out.next = around(out.points);
    return out;
}

Crop crop_of_look(const Crop& crop, int look) {
    constexpr double kLarger = 1.06, kSmaller = 0.94, kShift = 0.03;
    Crop out = crop;
    switch (look % kLooks) {
        case 1:
            out.side_px *= kLarger;
            break;
        case 2:
            out.side_px *= kSmaller;
            break;
        case 3:
            out.centre.x() += kShift * crop.side_px;
            break;
        case 4:
            out.centre.y() += kShift * crop.side_px;
            break;
        default:
            break;
    }
    return out;
}

void look_at_eyes(const landmarks::EyeNetwork& network, const Image& picture, SeenFace& face) {
    constexpr double kSide = landmarks::kEyePicture_px;
    for (const bool left : {true, false}) {
        std::vector<Vec2>& eye = face.eyes[left ? 0 : 1];
        eye.assign(landmarks::kEyePoints, Vec2::Zero());
        const landmarks::Picture one =
            cut(picture, around_eye(face.points, left), landmarks::kEyePicture_px);
        // The network has learnt left eyes; the mean with the mirrored picture is calmer for either.
        for (const bool mirror : {false, true}) {
            const std::vector<Vec2> answer = network.look_at(mirror ? mirrored(one) : one);
            for (std::size_t k = 0; k < answer.size(); ++k) {
                Vec2 at = answer[k] / kSide - Vec2::Constant(0.5);
                if (mirror) at.x() = -at.x();
                eye[k] += 0.5 * kAroundEye * at;
            }
        }
    }
}

std::vector<SeenFace> looks_at(const landmarks::FaceNetwork& network, const Image& picture,
                               const Crop& crop) {
    std::vector<SeenFace> out;
    for (int look = 0; look < kLooks; ++look)
        out.push_back(look_at(network, picture, crop_of_look(crop, look)));
    return out;
}

SeenFace mean_look(const Networks& networks, const Image& picture,
                   const std::vector<SeenFace>& looks) {
    SeenFace out = looks.front();
    const double count = static_cast<double>(looks.size());
    for (std::size_t k = 0; k < out.points.size(); ++k) {
        out.points[k].setZero();
        for (const SeenFace& look : looks) out.points[k] += look.points[k] / count;
    }
    out.score = 0;
    for (const SeenFace& look : looks) out.score += look.score / count;
    out.next = around(out.points);
    look_at_eyes(networks.eye, picture, out);
    return out;
}

std::optional<SeenFace> find_face(const landmarks::FaceNetwork& network, const Image& picture) {
    const double side = std::min(picture.width_px, picture.height_px);
    SeenFace best;
    for (const double share : kSearched)
        for (const Vec2& at : kSearchedAt) {
            if (best.score > kSurely) break;
            const Crop crop{at.cwiseProduct(Vec2(picture.width_px, picture.height_px)),
                            share * side, 0};
            SeenFace seen = look_at(network, picture, crop);
            if (seen.score > best.score) best = std::move(seen);
        }
    if (best.score < kThereIsAFace) return std::nullopt;
    for (int round = 0; round < 2; ++round) best = look_at(network, picture, best.next);
    if (best.score < kThereIsAFace) return std::nullopt;
    return best;
}

ShapeChange change_of(const SeenFace& rest, const SeenFace& now) {
    std::vector<Vec3> from, to;
    for (const int i : kStable) {
        from.push_back(rest.points[static_cast<std::size_t>(i)]);
        to.push_back(now.points[static_cast<std::size_t>(i)]);
    }
    const landmarks::Similarity motion = landmarks::nearest_similarity(from, to),
                                back = motion.inverse();
    const double unit = eye_distance(rest.points);
    ShapeChange out;
    out.head = angles_of(motion.rotation);
    for (std::size_t k = 0; k < rest.points.size(); ++k)
        out.moved.push_back((back(now.points[k]) - rest.points[k]) / unit);
    for (std::size_t side = 0; side < 2; ++side)
        for (std::size_t k = 0; k < std::min(rest.eyes[side].size(), now.eyes[side].size()); ++k)
            out.eyes[side].push_back(kEyeWidth * (now.eyes[side][k] - rest.eyes[side][k]));
    return out;
}

Eigen::VectorXd numbers_of(const ShapeChange& change) {
    std::vector<double> out;
    const auto add = [&](const Vec2& p) { out.insert(out.end(), {p.x(), p.y()}); };
    for (const int i : moving_points()) add(change.moved[static_cast<std::size_t>(i)].head<2>());
    for (const std::vector<Vec2>& eye : change.eyes)
        for (const Vec2& p : eye) add(p);
    return Eigen::Map<const Eigen::VectorXd>(out.data(), static_cast<Eigen::Index>(out.size()));
}

double eye_distance(const std::vector<Vec3>& points) {
    return (points[kLeftOuter] - points[kRightOuter]).norm();
}

}  // namespace risorius::perform
