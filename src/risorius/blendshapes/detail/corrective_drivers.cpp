// SPDX-License-Identifier: MIT
#include "risorius/blendshapes/detail/corrective_drivers.h"

#include <Eigen/LU>
#include <algorithm>

namespace risorius::blendshapes {

namespace {

// Fades with shapes that share more than this fraction of its motion
constexpr double kFadesWith = 0.05;

// Mean squares of drivers for uniformly distributed weights: of a part of a shape's path (the mean of 256 w^4 (1 - w)^4), and the
// ratio of w^2 (1 - w)^2 to w^2.
constexpr double kSquareOfPart = 256.0 / 630.0, kSquareOfFading = 0.1;

// Converts the errors of a shape at weights 1/4, 1/2 and 3/4 to fields of the parts of its path (blend_shape_rig.h).
std::array<Points, 3> parts_of_way(const std::array<const Points*, 3>& lacking) {
    Eigen::Matrix3d values;
    for (int at = 0; at < 3; ++at)
        for (int part = 1; part <= 3; ++part)
            values(at, part - 1) = blendshapes::Driver{"", {0}, part}.value(
                Eigen::VectorXd::Constant(1, 0.25 * (at + 1)));
    const Eigen::Matrix3d inverse = values.inverse();
    std::array<Points, 3> out;
    for (int part = 0; part < 3; ++part) {
        out[static_cast<std::size_t>(part)] = inverse(part, 0) * *lacking[0];
        for (std::size_t at : {std::size_t{1}, std::size_t{2}})
            out[static_cast<std::size_t>(part)] +=
                inverse(part, static_cast<int>(at)) * *lacking[at];
    }
    return out;
}

}  // namespace

track::Drive sum_of(const track::Drive& one, const track::Drive& other, double weight,
                    const track::ChannelTable& channels) {
    track::Drive out = one;
    out.excitation =
        (one.excitation + weight * other.excitation).cwiseMin(1.0).cwiseMax(channels.column_min());
    for (std::size_t k = 0; k < out.kinematic.size(); ++k) {
        const track::KinematicChannel& channel = track::kinematic_channels()[k];
        out.kinematic[k] =
            std::clamp(one.kinematic[k] + weight * other.kinematic[k], channel.min, channel.max);
    }
    return out;
}

track::Drive no_drive(const track::ChannelTable& channels) {
    track::Drive drive;
    drive.excitation = Eigen::VectorXd::Zero(channels.column_count());
    return drive;
}

std::vector<Unit> units_of(const MadeShapes& shapes, const track::ChannelTable& channels,
                           long vertices) {
    std::vector<Unit> out;
    for (std::size_t i = 0; i < shapes.list.size(); ++i) {
        const ShapeGoal& goal = shapes.list[i].goal;
        // A shape on top of another is solved together with it; a right half is added with its left half.
        if (goal.on_top_of >= 0 || (goal.sides == Sides::kHalves && !goal.left)) continue;
        Unit unit{
            goal.whole, {static_cast<int>(i)}, goal.drive, shapes.list[i].shape.dense(vertices)};
        if (goal.sides == Sides::kHalves) {
            const auto other = static_cast<std::size_t>(goal.partner);
            unit.parts.push_back(goal.partner);
            unit.drive = sum_of(goal.drive, shapes.list[other].goal.drive, 1, channels);
            shapes.list[other].shape.add_to(unit.field, 1);
        }
        if (!unit.field.isZero(0.0)) out.push_back(std::move(unit));
    }
    return out;
}

std::vector<OneSidedPair> one_sided_pairs(const Unit& a, const Unit& b) {
    std::vector<OneSidedPair> out;
    for (const std::size_t side : {std::size_t{0}, std::size_t{1}}) {
        if (a.parts.size() > 1) out.push_back({side, true, false});
        if (b.parts.size() > 1) out.push_back({side, false, true});
        if (a.parts.size() > 1 && b.parts.size() > 1) out.push_back({side, true, true});
    }
    return out;
}

DriverMaker::DriverMaker(const rig::Head& head, const MadeShapes& shapes,
                         const std::vector<Unit>& units, const Eigen::VectorXd& area)
    : head_(head), shapes_(shapes), units_(units), area_(area) {
    for (const Unit& unit : units) moved_.push_back(unit.field.rowwise().norm());
}

void DriverMaker::add_way(const Unit& unit, const Points& lacks, const SolvedPose& quarter,
                          const SolvedPose& three_quarters) {
    // For a pose that did not reach equilibrium: the error is interpolated, as if the path were a parabola.
    const auto lacking_at = [&](const SolvedPose& pose, double weight) {
        return pose.figures.converged ? Points(pose.moved - weight * unit.field)
                                      : Points(0.75 * lacks);
    };
    const Points first = lacking_at(quarter, 0.25), last = lacking_at(three_quarters, 0.75);
    const std::array<Points, 3> parts = parts_of_way({&first, &lacks, &last});
    const std::vector<std::size_t> others = sharing(unit);
    const bool of_two = unit.parts.size() > 1,
               sided = of_two || std::any_of(others.begin(), others.end(), [&](std::size_t other) {
                           return units_[other].parts.size() > 1;
                       });
    for (int part = 1; part <= 3; ++part)
        add(
            parts[static_cast<std::size_t>(part - 1)], sided,
            [&](std::size_t side) {
                blendshapes::Driver out{"", {unit.of_side(side)}, part};
                for (const std::size_t other : others)
                    out.fades_with.push_back(units_[other].of_side(side));
                return out;
            },
            sided && !of_two ? std::array<std::string, 2>{"left", "right"}
                             : std::array<std::string, 2>{});
}

void DriverMaker::add_pair(const Unit& a, const Unit& b, const Points& lacks,
                           const PairPoses& poses) {
    const std::size_t one_sided = terms_.size();
    if (poses.one_sided) add_one_sided(a, b, lacks, poses.one_sided);
    // Fields of the drivers a b, a b (1 - a), a b (1 - b) and a b (1 - a) (1 - b), less what the drivers of paths and one-sided
    // pairs give.
    std::array<Points, 4> field;
    field[0] = lacks;
    for (std::size_t k = 0; poses.on_its_way && k < kPairsOnTheirWay.size(); ++k) {
        if (!poses.on_its_way[k].figures.converged) continue;
        const PairOnItsWay& at = kPairsOnTheirWay[k];
        Points& missing = field[k + 1];
        missing = poses.on_its_way[k].moved - at.a * a.field - at.b * b.field - at.a * at.b * lacks;
        Eigen::VectorXd weights = Eigen::VectorXd::Zero(static_cast<long>(shapes_.list.size()));
        for (const int part : a.parts) weights[part] = at.a;
        for (const int part : b.parts) weights[part] = at.b;
        const auto take = [&](std::size_t from, std::size_t to) {
            for (std::size_t t = from; t < to; ++t)
                if (const double value = terms_[t].driver.value(weights); value != 0)
                    missing -= value * terms_[t].field;
        };
        take(0, of_shapes_);
        take(one_sided, terms_.size());
        if (k == 2)
            for (const std::size_t before : {std::size_t{1}, std::size_t{2}})
                if (field[before].size() > 0) missing -= 0.125 * field[before];
        missing *= k == 2 ? 16 : 4;
    }
    const bool sided = a.parts.size() > 1 || b.parts.size() > 1;
    for (std::size_t k = 0; k < field.size(); ++k) {
        if (field[k].size() == 0) continue;
        const std::string ending = k == 0 ? "" : "~" + std::to_string(k);
        add(field[k], sided,
            [&](std::size_t side) {
                blendshapes::Driver out{"", {a.of_side(side), b.of_side(side)}};
                if (k > 0 && kPairsOnTheirWay[k - 1].fades_with_a)
                    out.fades_with.push_back(a.of_side(side));
                if (k > 0 && kPairsOnTheirWay[k - 1].fades_with_b)
                    out.fades_with.push_back(b.of_side(side));
                return out;
            },
            {ending, ending});
    }
}

// Drivers for the error of a pair with one or both shapes on one side only, relative to that side's half of the symmetric pair.
// Each fades as the other side is added.
void DriverMaker::add_one_sided(const Unit& a, const Unit& b, const Points& lacks,
                                const SolvedPose* poses) {
    const auto halves =
        blendshapes::left_and_right(head_.vertices, lacks, head_.mm(kSharedStrip_mm));
    std::array<Points, 2> known;  // per side: known errors of the versions with one one-sided shape
    for (Points& one : known) one = Points::Zero(lacks.rows(), 3);
    const std::vector<OneSidedPair> pairs = one_sided_pairs(a, b);
    for (std::size_t k = 0; k < pairs.size(); ++k) {
        if (!poses[k].figures.converged) continue;
        const OneSidedPair& at = pairs[k];
        Points missing = poses[k].moved - (at.side == 0 ? halves.first : halves.second);
        blendshapes::Driver driver{"", {a.of_side(at.side), b.of_side(at.side)}};
        for (const auto& [unit, alone] : {std::pair(&a, at.a_alone), std::pair(&b, at.b_alone)}) {
            for (const int part : unit->parts)
                if (!alone || part == unit->of_side(at.side))
                    shapes_.list[static_cast<std::size_t>(part)].shape.add_to(missing, -1);
            if (alone) driver.fades_with.push_back(unit->of_side(1 - at.side));
        }
        if (at.a_alone && at.b_alone)
            missing -= known[at.side];
        else
            known[at.side] += missing;
        add(missing, std::move(driver),
            at.a_alone && at.b_alone ? "~alone" : (at.a_alone ? "~first" : "~second"));
    }
}

std::vector<std::size_t> DriverMaker::sharing(const Unit& unit) const {
    const Eigen::VectorXd& own = moved_[static_cast<std::size_t>(&unit - units_.data())];
    std::vector<std::size_t> others;
    for (std::size_t other = 0; other < units_.size(); ++other)
        if (&units_[other] != &unit &&
            area_.dot(own.cwiseMin(moved_[other])) > kFadesWith * area_.dot(own))
            others.push_back(other);
    return others;
}

template <class DriverOfSide>
void DriverMaker::add(const Points& field, bool sided, const DriverOfSide& driver,
                      const std::array<std::string, 2>& endings) {
    if (!sided) {
        add(field, driver(0), endings[0]);
        return;
    }
    const auto [left, right] =
        blendshapes::left_and_right(head_.vertices, field, head_.mm(kSharedStrip_mm));
    add(left, driver(0), endings[0]);
    add(right, driver(1), endings[1]);
}

void DriverMaker::add(const Points& field, blendshapes::Driver driver, const std::string& ending) {
    if (field.isZero(0.0)) return;
    std::sort(driver.shapes.begin(), driver.shapes.end());
    for (const int i : driver.shapes)
        driver.name +=
            (driver.name.empty() ? "" : "*") + shapes_.list[static_cast<std::size_t>(i)].goal.name;
    const bool single = driver.shapes.size() == 1;
    driver.name += (single ? "~" + std::to_string(driver.part) : "") + ending;
    double use = single ? kSquareOfPart : kPairIsMet * kSquareOfProduct;
    for (std::size_t k = 0; !single && k < driver.fades_with.size(); ++k) use *= kSquareOfFading;
    terms_.push_back({std::move(driver), field, use});
}

std::string weight_rule(const blendshapes::Driver& driver) {
    if (driver.shapes.size() > 1) return "product";
    static const std::array<const char*, 3> kRules{"256 / 27 w (1 - w)^3", "16 w^2 (1 - w)^2",
                                                   "256 / 27 w^3 (1 - w)"};
    return kRules.at(static_cast<std::size_t>(driver.part - 1));
}

}  // namespace risorius::blendshapes
