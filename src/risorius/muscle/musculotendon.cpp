// SPDX-License-Identifier: MIT
#include "risorius/muscle/musculotendon.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <utility>

#include "risorius/core/error.h"
#include "risorius/muscle/muscle_shape.h"

namespace risorius::muscle {

using solve::Curvature;
using solve::ImplicitStep;

namespace {

constexpr End kEnds[] = {End::kOrigin, End::kInsertion};

void require(bool holds, const std::string& place, const char* range, double found) {
    if (!holds) throw Error(place, range, format_number(found));
}

void check_positive(double value, const std::string& place) {
    require(std::isfinite(value) && value > 0, place, "(0, inf)", value);
}

/// d2/dx2 of U(l(s)) as a 3 x 3 block: `along` = d2U/ds2 in the direction, `across` = (dU/ds) / s perpendicular to it.
Mat3 line_block(const Vec3& direction, double along, double across, Curvature curvature) {
    if (curvature == Curvature::kPositive) {
        along = std::max(along, 0.0);
        across = std::max(across, 0.0);
    }
    return across * Mat3::Identity() + (along - across) * direction * direction.transpose();
}

void add_line_block(int i, int j, const Mat3& block, solve::HessianBuilder& hessian) {
    hessian.add(i, i, block);
    hessian.add(j, j, block);
    hessian.add(i, j, -block);
}

}  // namespace

void check(const MuscleParameters& p, const std::string& place) {
    check_positive(p.f0_n, place + "/f0_n");
    check_positive(p.optimal_length_m, place + "/optimal_length_m");
    require(std::isfinite(p.tendon_slack_m) && p.tendon_slack_m >= 0, place + "/tendon_slack_m",
            "[0, inf)", p.tendon_slack_m);
    check_positive(p.max_speed_hz, place + "/greatest_speed_hz");
    require(p.pennation_deg >= 0 && p.pennation_deg < 90, place + "/pennation_deg", "[0, 90)",
            p.pennation_deg);
    require(std::isfinite(p.damping) && p.damping >= 0, place + "/damping", "[0, inf)", p.damping);
}

MuscleParameters read_muscle_parameters(const JsonCursor& json) {
    json.allow_keys({"f0_n", "optimal_length_m", "tendon_slack_m", "greatest_speed_hz",
                     "pennation_deg", "damping", "curves", "tendon"});
    MuscleParameters p;
    p.f0_n = json.at("f0_n").number();
    p.optimal_length_m = json.at("optimal_length_m").number();
    if (const auto v = json.find("tendon_slack_m")) p.tendon_slack_m = v->number();
    if (const auto v = json.find("greatest_speed_hz")) p.max_speed_hz = v->number();
    if (const auto v = json.find("pennation_deg")) p.pennation_deg = v->number();
    if (const auto v = json.find("damping")) p.damping = v->number();
    if (const auto v = json.find("tendon"))
        p.tendon = v->one_of({"elastic", "rigid"}) == "rigid" ? TendonModel::kRigid
                                                              : TendonModel::kElastic;
    if (const auto v = json.find("curves")) p.curves = read_curve_shape(*v);
    check(p, json.place());
    return p;
}

Musculotendon::Musculotendon(const MuscleParameters& parameters, MuscleCurves curves,
                             const tissue::GridShape& grid, const Points& rest, Anchors anchors,
                             ActivationAt activation, const std::string& place)
    : parameters_(parameters),
      curves_(std::move(curves)),
      grid_(grid),
      anchors_(std::move(anchors)),
      activation_(std::move(activation)),
      chain_force_n_(parameters.f0_n / chains()) {
    check(parameters, place);
    if (grid.m < 2 || rest.rows() != grid.size())
        throw std::invalid_argument("Musculotendon: the rest shape is not that of the grid");
    set_slack();
    for (const End end : kEnds)
        if (elastic(end) && !(slack_m_[side(end)].minCoeff() > 0))
            throw Error(place + "/tendon_slack_m", "(0, inf) of elastic tendons",
                        format_number(slack_m_[side(end)].minCoeff()));
    for (const End end : kEnds) {
        if (!anchored(end) || !anchor(end).is_plane()) continue;
        if (!elastic(end))
            throw Error(place + "/tendon", "\"elastic\" between planes", "\"rigid\"");
        guide_[side(end)] = PlaneGuide(anchor(end).rest, anchor(end).normal,
                                       parameters.f0_n / parameters.optimal_length_m);
    }
    for (int c = 0; c < chains(); ++c)
        for (const int m : {0, grid.m - 1})
            tied_rest_[m == 0 ? 0 : 1].push_back(rest.row(node(m, c)).transpose());

    const Eigen::VectorXd lengths = fibre_lengths(grid, rest);
    optimal_m_ = lengths * (parameters.optimal_length_m / lengths.mean());
    const double sine = std::sin(parameters.pennation_deg * std::numbers::pi / 180);
    segments_.resize(static_cast<std::size_t>(segments_along() * chains()));
    for (int m = 0; m < segments_along(); ++m)
        for (int c = 0; c < chains(); ++c) {
            const double span = line(rest.row(node(m, c)), rest.row(next_node(m, c)), 0).span;
            if (!(span > 0)) throw std::invalid_argument("Musculotendon: a segment without length");
            const double l0 = span / lengths[c] * optimal_m_[c];
            segments_[static_cast<std::size_t>(node(m, c))] = {l0, l0 * sine};
        }
}

void Musculotendon::set_slack() {
    const int ends = (anchored(End::kOrigin) ? 1 : 0) + (anchored(End::kInsertion) ? 1 : 0);
    if (grid_.closed && ends > 0)
        throw std::invalid_argument("Musculotendon: a ring has no ends to anchor");
    for (const End end : kEnds) {
        if (!anchored(end)) continue;
        const Anchor& a = anchor(end);
        if (a.rest.rows() != chains() || (a.slack_m.size() > 0 && a.slack_m.size() != chains()))
            throw std::invalid_argument("Musculotendon: an anchor needs one point per chain");
        slack_m_[side(end)] =
            a.slack_m.size() > 0
                ? a.slack_m
                : Eigen::VectorXd::Constant(chains(), parameters_.tendon_slack_m / ends);
    }
}

std::vector<int> Musculotendon::tied_nodes() const {
    std::vector<int> nodes;
    if (parameters_.tendon == TendonModel::kElastic) return nodes;
    for (const End end : kEnds)
        for (int c = 0; anchored(end) && c < chains(); ++c) nodes.push_back(tendon_node(end, c));
    return nodes;
}

void Musculotendon::place_tied(double t_s, Points& x, Points& v) const {
    if (parameters_.tendon == TendonModel::kElastic) return;
    // s; the error of the rate is about 1e-9 times the motion's third derivative.
    constexpr double kRateStep = 1e-6;
    for (const End end : kEnds) {
        if (!anchored(end)) continue;
        const auto& motion = anchor(end).motion;
        for (int c = 0; c < chains(); ++c) {
            const Vec3& rest = tied_rest_[side(end)][static_cast<std::size_t>(c)];
            const int i = tendon_node(end, c);
            x.row(i) = (motion ? Vec3(motion(t_s) * rest) : rest).transpose();
            v.row(i).setZero();
            if (motion)
                v.row(i) = ((motion(t_s + kRateStep) * rest - motion(t_s - kRateStep) * rest) /
                            (2 * kRateStep))
                               .transpose();
        }
    }
}

Musculotendon::Line Musculotendon::line(const Vec3& from, const Vec3& to, double thickness_m) {
    Line line;
    const Vec3 d = to - from;
    line.span = d.norm();
    // Two nodes at the same place have no direction to pull along.
    if (line.span > 0) line.direction = d / line.span;
    line.length = line.span;
    line.slope = 1;
    if (thickness_m > 0) {
        line.length = std::hypot(line.span, thickness_m);
        line.slope = line.span / line.length;
        line.curvature = (1 - line.slope * line.slope) / line.length;
    }
    return line;
}

Musculotendon::Line Musculotendon::fibre(const Points& x, int m, int chain) const {
    return line(x.row(node(m, chain)), x.row(next_node(m, chain)), segment(m, chain).thickness_m);
}

Musculotendon::Line Musculotendon::tendon(const Points& x, const Plate& plate, End end,
                                          int chain) const {
    const Vec3 from = x.row(tendon_node(end, chain)), to = plate.points.row(chain);
    if (!anchor(end).is_plane()) return line(from, to, 0);
    const double distance = plate.normal.dot(to - from);
    return {.direction = plate.normal, .span = distance, .length = distance, .slope = 1};
}

Musculotendon::Plate Musculotendon::plate(End end, double t_s) const {
    const Anchor& a = anchor(end);
    if (!a.motion || !anchored(end)) return {a.rest, a.normal};
    const Rigid now = a.motion(t_s);
    return {(a.rest * now.linear().transpose()).rowwise() + now.translation().transpose(),
            now.linear() * a.normal};
}

Points Musculotendon::anchor_points(End end, double t_s) const { return plate(end, t_s).points; }

Points Musculotendon::tendon_feet(End end, double t_s, const Points& x) const {
    Plate now = plate(end, t_s);
    if (!anchored(end) || !anchor(end).is_plane()) return now.points;
    for (int c = 0; c < chains(); ++c) {
        const Line t = tendon(x, now, end, c);
        now.points.row(c) = x.row(tendon_node(end, c)) + t.span * t.direction.transpose();
    }
    return now.points;
}

double Musculotendon::mean_stretch(const Points& x, int chain) const {
    double length = 0;
    for (int m = 0; m < segments_along(); ++m) length += fibre(x, m, chain).length;
    return length / optimal_m_[chain];
}

void Musculotendon::add_force(double t_s, const Points& x, const Points& v, Points& force) const {
    const double a = activation_(t_s);
    for (int c = 0; c < chains(); ++c) {
        const double active = a == 0 ? 0 : a * curves_.active.value(mean_stretch(x, c));
        for (int m = 0; m < segments_along(); ++m) {
            const int i = node(m, c), j = next_node(m, c);
            const Segment& s = segment(m, c);
            const Line f = fibre(x, m, c);
            const double rate = f.slope * (v.row(j) - v.row(i)).dot(f.direction.transpose());
            const double vt = rate / (parameters_.max_speed_hz * s.optimal_m);
            double tension =
                curves_.passive.value(f.length / s.optimal_m) + parameters_.damping * vt;
            if (active != 0) tension += active * curves_.velocity.value(vt);
            const Vec3 pull = chain_force_n_ * tension * f.slope * f.direction;
            force.row(i) += pull.transpose();
            force.row(j) -= pull.transpose();
        }
    }
    add_tendon_force(t_s, x, 1, force);
}

void Musculotendon::add_tendon_force(double t_s, const Points& x, double sign,
                                     Points& force) const {
    for (const End end : kEnds) {
        if (!elastic(end)) continue;
        const Points pulled = anchor_forces(end, t_s, x);
        for (int c = 0; c < chains(); ++c) force.row(tendon_node(end, c)) -= sign * pulled.row(c);
    }
}

double Musculotendon::tendon_energy(double t_s, const Points& x) const {
    double energy = 0;
    for (const End end : kEnds) {
        if (!elastic(end)) continue;
        const Plate now = plate(end, t_s);
        if (anchor(end).is_plane())
            energy += guide_[side(end)].energy(anchor(end).at(t_s), x, tendon_node(end, 0));
        for (int c = 0; c < chains(); ++c) {
            const double slack = slack_m(end, c);
            energy += chain_force_n_ * slack *
                      curves_.tendon.at(tendon(x, now, end, c).span / slack - 1).integral;
        }
    }
    return energy;
}

double Musculotendon::energy(double t_s, const Points& x) const {
    const double a = activation_(t_s);
    double energy = 0;
    for (int c = 0; c < chains(); ++c) {
        energy +=
            chain_force_n_ * optimal_m_[c] * a * curves_.active.at(mean_stretch(x, c)).integral;
        for (int m = 0; m < segments_along(); ++m) {
            const double l0 = segment(m, c).optimal_m;
            energy += chain_force_n_ * l0 * curves_.passive.at(fibre(x, m, c).length / l0).integral;
        }
    }
    return energy + tendon_energy(t_s, x);
}

Musculotendon::Active Musculotendon::active(const ImplicitStep& step, const Points& x,
                                            int chain) const {
    const double a = activation_(step.end_s);
    if (a == 0) return {};
    if (step.rate_hz() > 0)
        return {.force = a * curves_.active.value(mean_stretch(step.start, chain))};
    const Curve::Value now = curves_.active.at(mean_stretch(x, chain));
    return {.force = a * now.value, .slope = a * now.slope, .integral = a * now.integral};
}

Musculotendon::Pull Musculotendon::fibre_pull(const ImplicitStep& step, const Line& now, int m,
                                              int chain, double active) const {
    const Segment& s = segment(m, chain);
    const Curve::Value passive = curves_.passive.at(now.length / s.optimal_m);
    Pull pull{.energy = s.optimal_m * passive.integral,
              .tension = passive.value,
              .slope = passive.slope / s.optimal_m};
    if (step.rate_hz() == 0) {
        pull.tension += active;  // the energy of the active force belongs to the chain
    } else {
        const double max = parameters_.max_speed_hz * s.optimal_m * step.step_s;
        const double vt = (now.length - fibre(step.start, m, chain).length) / max;
        const Curve::Value velocity = curves_.velocity.at(vt);
        const double b = parameters_.damping;
        pull.energy += max * (active * velocity.integral + b * vt * vt / 2);
        pull.tension += active * velocity.value + b * vt;
        pull.slope += (active * velocity.slope + b) / max;
    }
    pull.energy *= chain_force_n_;
    pull.tension *= chain_force_n_;
    pull.slope *= chain_force_n_;
    return pull;
}

double Musculotendon::add_potential(const ImplicitStep& step, const Points& x,
                                    Points& gradient) const {
    double potential = tendon_energy(step.end_s, x);
    add_tendon_force(step.end_s, x, -1, gradient);
    for (int c = 0; c < chains(); ++c) {
        const Active chain = active(step, x, c);
        potential += chain_force_n_ * optimal_m_[c] * chain.integral;
        for (int m = 0; m < segments_along(); ++m) {
            const int i = node(m, c), j = next_node(m, c);
            const Line f = fibre(x, m, c);
            const Pull pull = fibre_pull(step, f, m, c, chain.force);
            potential += pull.energy;
            const Vec3 along = pull.tension * f.slope * f.direction;
            gradient.row(i) -= along.transpose();
            gradient.row(j) += along.transpose();
        }
    }
    return potential;
}

void Musculotendon::add_hessian(const ImplicitStep& step, const Points& x, Curvature curvature,
                                solve::HessianBuilder& hessian) const {
    for (int c = 0; c < chains(); ++c) {
        const Active chain = active(step, x, c);
        for (int m = 0; m < segments_along(); ++m) {
            const Line f = fibre(x, m, c);
            if (!(f.span > 0)) continue;
            const Pull pull = fibre_pull(step, f, m, c, chain.force);
            const double along = pull.slope * f.slope * f.slope + pull.tension * f.curvature;
            const double across = pull.tension * f.slope / f.span;
            add_line_block(node(m, c), next_node(m, c),
                           line_block(f.direction, along, across, curvature), hessian);
        }
        if (chain.slope != 0 && (chain.slope > 0 || curvature == Curvature::kExact))
            add_chain_block(x, c, chain_force_n_ * chain.slope / optimal_m_[c], hessian);
    }
    for (const End end : kEnds) {
        if (!elastic(end)) continue;
        const Plate now = plate(end, step.end_s);
        const bool plane = anchor(end).is_plane();
        if (plane)
            guide_[side(end)].add_hessian(anchor(end).at(step.end_s), tendon_node(end, 0), hessian);
        for (int c = 0; c < chains(); ++c) {
            const Line t = tendon(x, now, end, c);
            const double slack = slack_m(end, c);
            const Curve::Value tension = curves_.tendon.at(t.span / slack - 1);
            if (tension.value == 0) continue;
            const int i = tendon_node(end, c);
            hessian.add(i, i,
                        line_block(t.direction, chain_force_n_ * tension.slope / slack,
                                   plane ? 0 : chain_force_n_ * tension.value / t.span, curvature));
        }
    }
}

void Musculotendon::add_chain_block(const Points& x, int chain, double stiffness,
                                    solve::HessianBuilder& hessian) const {
    const int count = grid_.m;
    std::vector<int> rows(static_cast<std::size_t>(count));
    Eigen::VectorXd g = Eigen::VectorXd::Zero(3 * count);  // gradient of the chain's length
    for (int m = 0; m < count; ++m) {
        rows[static_cast<std::size_t>(m)] = node(m, chain);
        if (m == segments_along()) break;
        const Line f = fibre(x, m, chain);
        g.segment<3>(3 * m) -= f.slope * f.direction;
        g.segment<3>(3 * grid_.next(m)) += f.slope * f.direction;
    }
    const Eigen::MatrixXd block = stiffness * g * g.transpose();
    hessian.add_dense(rows.data(), count, block.data());
}

void Musculotendon::add_metric(double step_s, solve::MetricBuilder& metric) const {
    const double steepest = curves_.velocity.at(0).slope + parameters_.damping;
    const double rate = steepest / (parameters_.max_speed_hz * step_s);  // 0 in an equilibrium
    const double c[2] = {-1, 1};
    for (int chain = 0; chain < chains(); ++chain) {
        for (int m = 0; m < segments_along(); ++m) {
            const int rows[2] = {node(m, chain), next_node(m, chain)};
            // At full force, a fibre resists rotation with F0 / l0.
            metric.add_outer(rows, c, 2, chain_force_n_ / segment(m, chain).optimal_m * (1 + rate));
        }
        const double stiffest = curves_.tendon.at(1).slope;  // far beyond its toe
        for (const End end : kEnds)
            if (elastic(end))
                metric.add_diagonal(
                    tendon_node(end, chain),
                    chain_force_n_ / slack_m(end, chain) * stiffest + guide_[side(end)].stiffest());
    }
}

double Musculotendon::isometric_tension(double t_s, const Points& x, int m, int chain) const {
    return chain_force_n_ *
           (activation_(t_s) * curves_.active.value(mean_stretch(x, chain)) +
            curves_.passive.value(fibre(x, m, chain).length / segment(m, chain).optimal_m));
}

Points Musculotendon::anchor_forces(End end, double t_s, const Points& x) const {
    if (!anchored(end)) return Points(0, 3);
    Points forces(chains(), 3);
    if (!elastic(end)) {
        const int m = end == End::kOrigin ? 0 : segments_along() - 1;
        const double inward = end == End::kOrigin ? 1 : -1;
        for (int c = 0; c < chains(); ++c) {
            const Line f = fibre(x, m, c);
            forces.row(c) =
                inward * isometric_tension(t_s, x, m, c) * f.slope * f.direction.transpose();
        }
        return forces;
    }
    const Plate now = plate(end, t_s);
    for (int c = 0; c < chains(); ++c) {
        const Line t = tendon(x, now, end, c);
        const double tension = chain_force_n_ * curves_.tendon.value(t.span / slack_m(end, c) - 1);
        forces.row(c) = -tension * t.direction.transpose();
    }
    if (anchor(end).is_plane())
        forces -= guide_[side(end)].forces(anchor(end).at(t_s), x, tendon_node(end, 0));
    return forces;
}

Vec3 Musculotendon::anchor_pull(End end, double t_s, const Points& x) const {
    return anchor_forces(end, t_s, x).colwise().sum().transpose();
}

Eigen::VectorXd Musculotendon::stretch(const Points& x) const {
    Eigen::VectorXd stretch(chains());
    for (int c = 0; c < chains(); ++c) stretch[c] = mean_stretch(x, c);
    return stretch;
}

double Musculotendon::segment_spread(const Points& x) const {
    double worst = 0;
    for (int c = 0; c < chains(); ++c) {
        double min = INFINITY, max = 0;
        for (int m = 0; m < segments_along(); ++m) {
            const double l = fibre(x, m, c).length / segment(m, c).optimal_m;
            min = std::min(min, l);
            max = std::max(max, l);
        }
        worst = std::max(worst, max - min);
    }
    return worst;
}

}  // namespace risorius::muscle
