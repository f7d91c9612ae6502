#include "sim/jaw.h"

#include <algorithm>
#include <cmath>

#include "sim/polyline.h"

namespace risorius::sim {

Jaw::Jaw(const rig::Head& head, const rig::JawDescription& d) : size_(head.size) {
    hinge_ = head.mm(1.0) * d.hinge_mm;
    slide_ = head.mm(1.0) * d.open_slide_mm;
    forward_ = head.mm(1.0) * d.forward_mm;
    open_rad_ = d.open_deg * 3.14159265358979323846 / 180.0;
    side_m_ = head.mm(d.side_mm);
    stomion_ = head.landmark("sto");
    corner_l_ = head.landmark("ch_l");
    corner_r_ = head.landmark("ch_r");
    for (const char* id : {"me", "gn", "pjm_l", "pjm_r", "mmb_l", "mmb_r", "ant_l", "ant_r", "go_l", "go_r"})
        border_.push_back(head.landmark(id));
}

Rigid Jaw::motion(double open, double forward, double side) const {
    // Condyles slide forward and down as the jaw opens; a sideways jaw also turns about the working condyle.
    Rigid motion = Rigid::Identity();
    const double yaw = side * side_m_ / (size_ * 0.1);  // the chin is about 100 mm ahead of the condyles
    motion.translate(Vec3(hinge_ + open * slide_ + forward * forward_ + Vec3(0.15 * side * side_m_, 0, 0)));
    motion.rotate(Eigen::AngleAxisd(0.85 * yaw, Vec3::UnitY()));
    motion.rotate(Eigen::AngleAxisd(open * open_rad_, Vec3::UnitX()));
    motion.translate(-hinge_);
    return motion;
}

double Jaw::height_over_bite(const Vec3& p) const {
    const double mm = 1e-3 * size_;
    // In front the lip line, from corner to corner through stomion.
    const Vec3& corner = p.x() >= 0 ? corner_l_ : corner_r_;
    const double across = std::clamp(std::abs(p.x()) / std::abs(corner.x()), 0.0, 1.0);
    double bite = stomion_.y() + (corner.y() - stomion_.y()) * across * across;
    // Behind the corners the occlusal plane rises, gently to the last molar and steeply to the condyle.
    const double lip_z = std::min(stomion_.z() - 6 * mm, corner.z() + 4 * mm);
    const double molar_z = 45 * mm;
    const double behind = std::max(0.0, lip_z - p.z());
    const double to_molar = std::max(1e-6, lip_z - molar_z);
    if (behind <= to_molar) {
        bite += 0.30 * behind;
    } else {
        const double at_molar = bite + 0.30 * to_molar;
        const double to_hinge = std::max(1e-6, molar_z - hinge_.z());
        bite = at_molar + (hinge_.y() - at_molar) * std::min(1.5, (behind - to_molar) / to_hinge);
    }
    return p.y() - bite;
}

double Jaw::border_height(const Vec3& p) const {
    double sum = 0, weights = 0;
    for (const Vec3& b : border_) {
        const double dx = p.x() - b.x(), dz = p.z() - b.z();
        const double w = 1.0 / (std::pow(dx * dx + dz * dz, 1.5) + 1e-9);
        sum += w * b.y();
        weights += w;
    }
    return sum / weights;
}

double Jaw::weight(const Vec3& p) const {
    const double mm = 1e-3 * size_;
    const double lateral = std::abs(p.x());
    const double corner = 0.5 * (corner_l_.x() - corner_r_.x());
    // The change from skull to mandible is sharp between the lips and wide over cheek and ramus.
    double half = (1.5 + 10.5 * smoothstep(0.6 * corner, corner + 12 * mm, lateral)) * mm;
    half += 2.0 * mm * smoothstep(50 * mm, 62 * mm, lateral);
    double w = 1.0 - smoothstep(-half, half, height_over_bite(p));
    w *= 1.0 - smoothstep(0.0, 48 * mm, border_height(p) - p.y());
    w *= smoothstep(2 * mm, 25 * mm, p.z());
    return w;
}

}  // namespace risorius::sim
