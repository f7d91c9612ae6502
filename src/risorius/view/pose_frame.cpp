// SPDX-License-Identifier: MIT
#include "risorius/view/pose_frame.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <stdexcept>

namespace risorius::view {

static_assert(std::endian::native == std::endian::little);

namespace {

constexpr double kRoom_m = 0.12;  // how far the head may move from its place at rest
constexpr std::uint8_t kPoseKind = 1, kHasStrain = 1, kHasMuscles = 2;
constexpr double kByte = 127;

class Writer {
  public:
    explicit Writer(std::size_t size) { bytes_.reserve(size); }
    template <class T>
    void put(T value) {
        char raw[sizeof(T)];
        std::memcpy(raw, &value, sizeof(T));
        bytes_.append(raw, sizeof(T));
    }
    void put_points(const Points& points, double unit_m) {
        for (long i = 0; i < points.rows(); ++i)
            for (int k = 0; k < 3; ++k)
                put(static_cast<std::int16_t>(
                    std::lround(std::clamp(points(i, k) / unit_m, -32767.0, 32767.0))));
    }
    void put_motion(const Rigid& motion) {
        const Eigen::Quaterniond turn(motion.linear());
        for (const double value : {turn.x(), turn.y(), turn.z(), turn.w()})
            put(static_cast<float>(value));
        for (int k = 0; k < 3; ++k) put(static_cast<float>(motion.translation()[k]));
    }
    void put_fractions(const Eigen::VectorXd& values) {
        for (const double value : values) put(byte_of(value));
    }
    static std::int8_t byte_of(double value) {
        return static_cast<std::int8_t>(std::lround(kByte * std::clamp(value, -1.0, 1.0)));
    }
    std::string take() { return std::move(bytes_); }

  private:
    std::string bytes_;
};

class Scanner {
  public:
    explicit Scanner(const std::string& bytes) : bytes_(bytes) {}
    template <class T>
    T get() {
        if (at_ + sizeof(T) > bytes_.size()) throw std::invalid_argument("a pose frame is cut");
        T value;
        std::memcpy(&value, bytes_.data() + at_, sizeof(T));
        at_ += sizeof(T);
        return value;
    }
    Rigid motion() {
        float values[7];
        for (float& value : values) value = get<float>();
        Rigid out = Rigid::Identity();
        out.linear() = Eigen::Quaterniond(values[3], values[0], values[1], values[2])
                           .normalized()
                           .toRotationMatrix();
        out.translation() = Vec3(values[4], values[5], values[6]);
        return out;
    }
    Points points(std::uint32_t count, double unit_m) {
        if (at_ + 6ull * count > bytes_.size()) throw std::invalid_argument("a pose frame is cut");
        Points out(static_cast<long>(count), 3);
        for (long i = 0; i < out.rows(); ++i)
            for (int k = 0; k < 3; ++k) out(i, k) = unit_m * get<std::int16_t>();
        return out;
    }
    Eigen::VectorXd fractions(std::uint16_t count) {
        Eigen::VectorXd out(count);
        for (double& value : out) value = get<std::int8_t>() / kByte;
        return out;
    }

  private:
    const std::string& bytes_;
    std::size_t at_ = 0;
};

}  // namespace

double unit_for(const Points& rest) {
    const double reach_m = rest.rows() > 0 ? rest.cwiseAbs().maxCoeff() + kRoom_m : 0.0;
    return std::max(kFinestUnit_m, reach_m / 32767);
}

std::string encode_pose(const PoseFrame& pose, double unit_m) {
    const auto vertices = static_cast<std::size_t>(pose.vertices.rows());
    Writer out(92 + 7 * vertices + 6 * static_cast<std::size_t>(pose.muscles.rows()));
    out.put(kPoseKind);
    out.put(static_cast<std::uint8_t>((pose.strain.empty() ? 0 : kHasStrain) |
                                      (pose.muscles.rows() > 0 ? kHasMuscles : 0)));
    out.put(static_cast<std::uint16_t>(pose.drive.size()));
    out.put(pose.step);
    out.put(pose.t_s);
    out.put_motion(pose.head);
    out.put_motion(pose.mandible);
    out.put(static_cast<std::uint32_t>(vertices));
    out.put_points(pose.vertices, unit_m);
    out.put_fractions(pose.drive);
    out.put_fractions(pose.activation);
    for (const double value : pose.strain)
        out.put(std::isnan(value) ? std::numeric_limits<std::int8_t>::min()
                                  : Writer::byte_of(value / kStrainScale));
    if (pose.muscles.rows() > 0) {
        out.put(static_cast<std::uint32_t>(pose.muscles.rows()));
        out.put_points(pose.muscles, unit_m);
    }
    return out.take();
}

PoseFrame decode_pose(const std::string& bytes, double unit_m) {
    Scanner in(bytes);
    if (in.get<std::uint8_t>() != kPoseKind) throw std::invalid_argument("not a pose frame");
    const auto flags = in.get<std::uint8_t>();
    const auto columns = in.get<std::uint16_t>();
    PoseFrame pose;
    pose.step = in.get<std::uint32_t>();
    pose.t_s = in.get<double>();
    pose.head = in.motion();
    pose.mandible = in.motion();
    const auto vertices = in.get<std::uint32_t>();
    pose.vertices = in.points(vertices, unit_m);
    pose.drive = in.fractions(columns);
    pose.activation = in.fractions(columns);
    if (flags & kHasStrain)
        for (std::uint32_t i = 0; i < vertices; ++i) {
            const auto value = in.get<std::int8_t>();
            pose.strain.push_back(value == std::numeric_limits<std::int8_t>::min()
                                      ? std::numeric_limits<double>::quiet_NaN()
                                      : kStrainScale * value / kByte);
        }
    if (flags & kHasMuscles) pose.muscles = in.points(in.get<std::uint32_t>(), unit_m);
    return pose;
}

}  // namespace risorius::view
