// SPDX-License-Identifier: MIT
#include "risorius/face/muscle/detail/lip_drive.h"

#include <algorithm>
#include <cmath>

#include "risorius/geom/polyline.h"
#include "risorius/solve/hessian_builder.h"

namespace risorius::face {

namespace {

constexpr double kTurn_rad = 1.2;         // rotation of a red lip that is rolled in
constexpr double kFlattened = 0.45;       // fraction of its height over the teeth that it loses
constexpr double kTurn_pa_per_m = 1.5e6;  // per area, of the skin and of the middle layer
constexpr double kPush_pa_per_m = 1.5e6;  // a thickened muscle hardly yields to the lip
constexpr double kPush_mm = 10;           // all lengths here are those of the average adult
constexpr std::array<double, 2> kAxisInside_mm{11, 9};  // from the rim, upper and lower lip
constexpr double kTurnFades_mm = 9;                     // below the red lip
constexpr double kPushFades_mm = 12;

// Returns the push / its maximum at activation p. The muscle thickens most per activation while it is weak.
double filled(double p) { return 1 - (1 - p) * (1 - p) * (1 - p); }

}  // namespace

LipDrive::LipDrive(const rig::Head& head, const rig::RigDescription& rig, const Shell& shell,
                   const TissueMesh& mesh, const std::vector<Attachment>& attachments) {
    const track::ChannelTable channels = rig.channels();
    const std::array<std::string, 2> lip_names{"upper", "lower"};
    for (int lip : {kUpper, kLower}) {
        marginal_[lip] =
            channels.column("orbicularis_oris_" + lip_names[lip] + "_marginal", Side::kLeft);
        peripheral_[lip] =
            channels.column("orbicularis_oris_" + lip_names[lip] + "_peripheral", Side::kLeft);
    }
    scale(rig.lips);
    const std::vector<Vec3> line = lip_line(head);
    const double half_width = 0.5 * (line.back().x() - line.front().x());
    // Height of the lip line at x, interpolated between its points
    const auto line_height = [&](double x) {
        for (std::size_t i = 0; i + 1 < line.size(); ++i)
            if (x <= line[i + 1].x() || i + 2 == line.size()) {
                const double t = std::clamp(
                    (x - line[i].x()) / std::max(1e-9, line[i + 1].x() - line[i].x()), 0.0, 1.0);
                return (1 - t) * line[i].y() + t * line[i + 1].y();
            }
        return line.front().y();
    };
    const std::array<double, 2> red_m{(head.landmark("ls") - line[2]).norm(),
                                      (head.landmark("li") - line[2]).norm()};
    for (const Attachment& held : attachments) {
        const int v = held.shell_vertex;
        const Vec3 skin = mesh.nodes.row(node_of(v, kSkin)).transpose();
        const Vec3 deep = mesh.nodes.row(node_of(v, kDeep)).transpose();
        if (geom::distance_to_polyline(skin, line) > head.mm(22)) continue;
        const int lip = shell.over_bite_m[v] >= 0 ? kUpper : kLower;
        const double rim_y = line_height(skin.x());
        const double from_rim = std::abs(skin.y() - rim_y);
        const double across =
            std::abs(skin.x() - 0.5 * (line.front().x() + line.back().x())) / half_width;
        const double area = mesh.area_m2[v];

        const double turn =
            (1 - geom::smoothstep(red_m[lip], red_m[lip] + head.mm(kTurnFades_mm), from_rim)) *
            std::max(0.0, 1 - across * across);
        if (turn > 1e-3)
            for (Layer layer : {kMiddle, kSkin}) {
                Turned member;
                member.node = node_of(v, layer);
                member.lip = lip;
                member.jaw = held.jaw_weight;
                member.weight = turn;
                member.stiffness = turn * area * kTurn_pa_per_m;
                member.rest = mesh.nodes.row(member.node).transpose();
                const double inside = head.mm(kAxisInside_mm[lip]) * (lip == kUpper ? 1 : -1);
                member.axis = Vec3(member.rest.x(), rim_y + inside, deep.z());
                member.start = member.target = member.rest;
                turned_.push_back(member);
            }

        const double push =
            (1 - geom::smoothstep(red_m[lip], red_m[lip] + head.mm(kPushFades_mm), from_rim)) *
            (1 - geom::smoothstep(0.9, 1.4, across));
        if (push > 1e-3) {
            Pushed member;
            member.node = node_of(v, kDeep);
            member.lip = lip;
            member.jaw = held.jaw_weight;
            member.way = push * head.mm(kPush_mm);
            member.stiffness = push * area * kPush_pa_per_m;
            member.rest = member.target = deep;
            member.outward = member.normal = mesh.direction[v];
            pushed_.push_back(member);
        }
    }
}

void LipDrive::scale(const rig::LipsDescription& lips) {
    turn_scale_ = {lips.upper_turn, lips.lower_turn};
    push_scale_ = {lips.upper_push, lips.lower_push};
    turn_ = {-1, -1};  // drive() has not been called yet
}

void LipDrive::keep(const std::vector<int>& row, int rows) {
    const auto keep_of = [&](auto& members) {
        for (auto& member : members) member.node = row[static_cast<std::size_t>(member.node)];
        std::erase_if(members,
                      [&](const auto& member) { return member.node < 0 || member.node >= rows; });
    };
    keep_of(turned_);
    keep_of(pushed_);
}

void LipDrive::drive(const Eigen::VectorXd& activation) {
    const auto of = [&](int column) {
        return column < 0 ? 0.0 : std::clamp(activation[column], 0.0, 1.0);
    };
    const std::array<double, 2> turned = turn_;
    for (int lip : {kUpper, kLower}) {
        const double inwards = of(marginal_[lip]) - of(peripheral_[lip]);
        turn_[lip] = std::max(0.0, inwards);
        push_[lip] = std::max(0.0, -inwards);
    }
    if (turn_ == turned) return;
    for (Turned& member : turned_) {
        // The red lip moves towards the other lip, its rim moves back
        const double fraction = turn_scale_[member.lip] * turn_[member.lip] * member.weight;
        const double angle = (member.lip == kUpper ? 1 : -1) * fraction * kTurn_rad;
        Vec3 arm = Eigen::AngleAxisd(angle, Vec3::UnitX()) * (member.rest - member.axis);
        arm.z() *= 1 - fraction * kFlattened;
        member.start = member.axis + arm;
    }
    move_mandible(mandible_);
}

void LipDrive::set_mandible(const Rigid& mandible) {
    for (Pushed& member : pushed_)
        member.normal =
            ((1 - member.jaw) * member.outward + member.jaw * (mandible.linear() * member.outward))
                .normalized();
    move_mandible(mandible);
}

void LipDrive::move_mandible(const Rigid& mandible) {
    mandible_ = mandible;
    for (Turned& member : turned_)
        member.target = member.start + member.jaw * (mandible * member.start - member.start);
    for (Pushed& member : pushed_)
        member.target = member.rest + member.jaw * (mandible * member.rest - member.rest);
}

Vec3 LipDrive::pull(const Turned& member, const Points& x) const {
    Vec3 off = x.row(member.node).transpose() - member.target;
    off.x() = 0;
    return turn_[member.lip] * member.stiffness * off;
}

Vec3 LipDrive::pull(const Pushed& member, const Points& x) const {
    const double ahead = (x.row(member.node).transpose() - member.target).dot(member.normal) -
                         filled(push_[member.lip]) * push_scale_[member.lip] * member.way;
    return push_[member.lip] * member.stiffness * std::min(0.0, ahead) * member.normal;
}

double LipDrive::add_energy(const Points& x, Points& gradient) const {
    double energy = 0;
    const auto add = [&](const auto& member, double stiffness) {
        if (stiffness <= 0) return;
        const Vec3 force = pull(member, x);
        energy += 0.5 * force.squaredNorm() / stiffness;
        gradient.row(member.node) += force.transpose();
    };
    for (const Turned& member : turned_) add(member, turn_[member.lip] * member.stiffness);
    for (const Pushed& member : pushed_) add(member, push_[member.lip] * member.stiffness);
    return energy;
}

void LipDrive::add_mandible_gradient(const Points& x, Wrench& sum) const {
    for (const Turned& member : turned_)
        sum.add(-member.jaw * pull(member, x), mandible_ * member.start);
    for (const Pushed& member : pushed_)
        sum.add(-member.jaw * pull(member, x), mandible_ * member.rest);
}

void LipDrive::add_metric(solve::MetricBuilder& builder) const {
    for (const Turned& member : turned_) builder.add_diagonal(member.node, 0.5 * member.stiffness);
    for (const Pushed& member : pushed_) builder.add_diagonal(member.node, 0.5 * member.stiffness);
}

void LipDrive::add_hessian(const Points& x, solve::HessianBuilder& hessian) const {
    const Mat3 across = Vec3(0, 1, 1).asDiagonal();
    for (const Turned& member : turned_)
        hessian.add(member.node, member.node, turn_[member.lip] * member.stiffness * across);
    for (const Pushed& member : pushed_) {
        const bool pushes = !pull(member, x).isZero(0.0);
        hessian.add(member.node, member.node,
                    (pushes ? push_[member.lip] * member.stiffness : 0.0) * member.normal *
                        member.normal.transpose());
    }
}

}  // namespace risorius::face
