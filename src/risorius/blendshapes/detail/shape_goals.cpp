// SPDX-License-Identifier: MIT
#include "risorius/blendshapes/detail/shape_goals.h"

#include <algorithm>
#include <tuple>

#include "risorius/core/error.h"
#include "risorius/core/known_names.h"
#include "risorius/rig/expression_drive.h"
#include "risorius/track/arkit_names.h"

namespace risorius::blendshapes {

namespace {

using track::Kinematic;

constexpr double kPuff_pa = 1500;     // pressure of a shape that puffs the cheeks
constexpr double kSideGaze_deg = 30;  // rotation of an eye in a gaze shape
constexpr double kUprightGaze_deg = 25;

double& channel(track::Expansion& drive, Kinematic k) {
    return drive.kinematic[static_cast<std::size_t>(k)];
}

bool turns_head(int k) {
    const auto channel = static_cast<Kinematic>(k);
    return channel >= Kinematic::kHeadYaw && channel <= Kinematic::kHeadSide;
}

// Names of a pair of sides, by the conventions of ARKit and of the rig's own channels.
struct Namesakes {
    std::string left, right, whole;
};
std::optional<Namesakes> namesakes(const std::string& name) {
    for (const auto& [left, right] : {std::pair{"Left", "Right"}, std::pair{".l", ".r"}})
        for (const char* ending : {left, right})
            if (name.size() > std::string(ending).size() && name.ends_with(ending)) {
                const std::string whole = name.substr(0, name.size() - std::string(ending).size());
                return Namesakes{whole + left, whole + right, whole};
            }
    return std::nullopt;
}

class Collector {
  public:
    Collector(const rig::RigDescription& rig, ShapeSet& set)
        : channels_(rig.channels()), set_(set) {}

    const track::ChannelTable& channels() const { return channels_; }

    void add(const std::string& name, const track::Expansion& expansion) {
        ShapeGoal goal;
        goal.name = goal.whole = name;
        goal.drive = rig::clamped_drive(expansion, channels_);
        set_.goals.push_back(std::move(goal));
    }
    void add_channel(const std::string& name, Kinematic k, double value) {
        track::Expansion drive = track::Expansion::none(channels_);
        channel(drive, k) = value;
        add(name, drive);
    }
    void leave_out(const std::string& name, const std::string& why) {
        set_.left_out.emplace_back(name, why);
    }

    /// Finds partners. Two namesakes are halves when neither drives muscles of the other side or moves the jaw sideways.
    void pair_up() {
        for (std::size_t i = 0; i < set_.goals.size(); ++i) {
            ShapeGoal& goal = set_.goals[i];
            const auto names = namesakes(goal.name);
            if (!names) continue;
            const auto other = set_.index(goal.name == names->left ? names->right : names->left);
            if (!other) continue;
            goal.partner = *other;
            goal.left = goal.name == names->left;
            const ShapeGoal& partner = set_.goals[static_cast<std::size_t>(*other)];
            const bool halves = keeps_to_its_side(goal.drive, goal.left) &&
                                keeps_to_its_side(partner.drive, !goal.left);
            goal.sides = halves ? Sides::kHalves : Sides::kOpposed;
            if (halves) goal.whole = names->whole;
        }
    }

  private:
    bool keeps_to_its_side(const track::Drive& drive, bool left) const {
        for (const track::MuscleChannel& muscle : channels_.muscles) {
            const int own = channels_.column(muscle.id, left ? Side::kLeft : Side::kRight),
                      other = channels_.column(muscle.id, left ? Side::kRight : Side::kLeft);
            if (own != other && drive.excitation[other] != 0) return false;
        }
        return drive.at(Kinematic::kJawSide) == 0;
    }

    track::ChannelTable channels_;
    ShapeSet& set_;
};

// Whether a muscle only moves the jaw. Its effect is given by the jaw channels.
bool moves_jaw_alone(const rig::RigDescription& rig, const std::string& id) {
    if (rig.solid(id)) return false;
    for (const rig::Muscle& muscle : rig.muscles.muscles)
        if (muscle.id == id) return muscle.group == "jaw" || muscle.group == "hyoid";
    return false;
}

void collect_named(const rig::RigDescription& rig, const std::vector<track::ArkitShape>& shapes,
                   Collector& out) {
    for (const track::ArkitShape& shape : shapes)
        out.add(shape.name, track::expand(shape, rig.facs, out.channels()));
}

void collect_units(const rig::RigDescription& rig, Collector& out) {
    for (const track::ActionUnit& unit : rig.facs.units) {
        if (!unit.unsupported.empty()) {
            out.leave_out(unit.id, "needs " + unit.unsupported);
            continue;
        }
        bool of_face = std::any_of(unit.muscles.begin(), unit.muscles.end(),
                                   [&](const track::MuscleFraction&fraction) {
                                       return !moves_jaw_alone(rig, fraction.muscle);
                                   }),
             of_head = false;
        for (int k = 0; k < track::kKinematicCount; ++k)
            if (unit.kinematic[static_cast<std::size_t>(k)] != 0)
                (turns_head(k) ? of_head : of_face) = true;
        if (of_head) {
            out.leave_out(unit.id, "moves the head as a whole");
            continue;
        }
        if (!of_face) {
            out.leave_out(unit.id, "moves nothing");
            continue;
        }
        if (!unit.sided) {
            out.add(unit.id, track::expand(unit, std::nullopt, out.channels()));
            continue;
        }
        for (const Side side : {Side::kLeft, Side::kRight})
            out.add(unit.id + (side == Side::kLeft ? ".l" : ".r"),
                    track::expand(unit, side, out.channels()));
    }
}

void collect_muscles(const rig::RigDescription& rig, Collector& out) {
    const track::ChannelTable& channels = out.channels();
    const auto collect = [&](double track::MuscleChannel::*limit, const std::string& ending) {
        for (const track::MuscleChannel& muscle : channels.muscles)
            for (const Side side : {Side::kLeft, Side::kRight}) {
                if (!muscle.paired && side == Side::kRight) continue;
                const double value = limit ? muscle.*limit : 1.0;
                if (value == 0) continue;
                track::Expansion drive = track::Expansion::none(channels);
                drive.excitation[channels.column(muscle.id, side)] = value;
                const std::string name =
                    muscle.id + ending + (muscle.paired ? (side == Side::kLeft ? ".l" : ".r") : "");
                // Jaw muscles have no effect while channels place the jaw.
                if (moves_jaw_alone(rig, muscle.id))
                    out.leave_out(name, "moves the jaw, which channels place");
                else
                    out.add(name, drive);
            }
    };
    collect(nullptr, "");
    collect(&track::MuscleChannel::min, "_relaxed");
    out.add_channel("jaw_open", Kinematic::kJawOpen, 1);
    out.add_channel("jaw_forward", Kinematic::kJawForward, 1);
    out.add_channel("jaw_side.l", Kinematic::kJawSide, 1);
    out.add_channel("jaw_side.r", Kinematic::kJawSide, -1);
    out.add_channel("mouth_pressure", Kinematic::kMouthPressure, kPuff_pa);
    out.add_channel("tongue_out", Kinematic::kTongueOut, 1);
    out.add_channel("tongue_up", Kinematic::kTongueUp, 1);
    out.add_channel("tongue_body_up", Kinematic::kTongueBodyUp, 1);
    out.add_channel("tongue_body_back", Kinematic::kTongueBodyBack, 1);
    for (const auto& [name, left, right, value] :
         {std::tuple{"gaze_up", Kinematic::kGazePitchLeft, Kinematic::kGazePitchRight,
                     kUprightGaze_deg},
          std::tuple{"gaze_down", Kinematic::kGazePitchLeft, Kinematic::kGazePitchRight,
                     -kUprightGaze_deg},
          std::tuple{"gaze_left", Kinematic::kGazeYawLeft, Kinematic::kGazeYawRight, kSideGaze_deg},
          std::tuple{"gaze_right", Kinematic::kGazeYawLeft, Kinematic::kGazeYawRight,
                     -kSideGaze_deg}}) {
        out.add_channel(std::string(name) + ".l", left, value);
        out.add_channel(std::string(name) + ".r", right, value);
    }
}

// For lips that are closed over an open jaw: marks the shape that closes them as lying on top of the open jaw.
void put_on_top(ShapeSet& set) {
    const auto shut = set.index("mouthClose"), open = set.index("jawOpen");
    if (shut && open) set.goals[static_cast<std::size_t>(*shut)].on_top_of = *open;
}

void keep_only(const std::vector<std::string>& only, ShapeSet& set, const std::string& place) {
    if (only.empty()) return;
    std::vector<std::string> known;
    for (const ShapeGoal& goal : set.goals) {
        known.push_back(goal.name);
        if (goal.whole != goal.name) known.push_back(goal.whole);
    }
    std::vector<char> wanted(set.goals.size(), 0);
    for (const std::string& name : only) {
        bool found = false;
        for (std::size_t i = 0; i < set.goals.size(); ++i) {
            const ShapeGoal& goal = set.goals[i];
            if (goal.name != name && goal.whole != name) continue;
            found = true;
            wanted[i] = 1;
            // A half needs its other half, and a corrective the shape that it corrects.
            if (goal.sides == Sides::kHalves) wanted[static_cast<std::size_t>(goal.partner)] = true;
            if (goal.on_top_of >= 0) wanted[static_cast<std::size_t>(goal.on_top_of)] = true;
        }
        if (!found)
            throw Error(
                place,
                "shapes of the set " + risorius::in_quotes(set.name) + did_you_mean(name, known),
                risorius::in_quotes(name));
    }
    std::vector<ShapeGoal> kept;
    for (std::size_t i = 0; i < set.goals.size(); ++i)
        if (wanted[i]) kept.push_back(std::move(set.goals[i]));
    set.goals = std::move(kept);
}

}  // namespace

std::optional<int> ShapeSet::index(const std::string& name_sought) const {
    for (std::size_t i = 0; i < goals.size(); ++i)
        if (goals[i].name == name_sought) return static_cast<int>(i);
    return std::nullopt;
}

const std::vector<std::string>& shape_set_names() {
    static const std::vector<std::string> kNames{"arkit52", "facs", "muscles", "visemes"};
    return kNames;
}

ShapeSet shape_set(const rig::RigDescription& rig, const std::string& name,
                   const std::vector<std::string>& only, const std::string& place,
                   const std::string& only_from) {
    index_of_name(option_name("set"), name, shape_set_names());
    ShapeSet set;
    set.name = name;
    Collector out(rig, set);
    if (name == "arkit52") {
        collect_named(rig, rig.facs.arkit, out);
        for (const std::string& wanted : track::arkit_names())
            if (!set.index(wanted))
                throw Error(place + ":/facs/arkit", "all 52 shapes of ARKit",
                            "no " + in_quotes(wanted));
    } else if (name == "visemes") {
        collect_named(rig, rig.facs.visemes, out);
        if (set.goals.empty())
            throw Error(place + ":/facs", "\"visemes\", as in rigs/standard/facs.json", "none");
    } else if (name == "facs") {
        collect_units(rig, out);
    } else {
        collect_muscles(rig, out);
    }
    // Partners are indices, which changed when shapes were removed, so they are found again.
    out.pair_up();
    put_on_top(set);
    keep_only(only, set, only_from);
    if (!only.empty()) {
        out.pair_up();
        put_on_top(set);
    }
    return set;
}

}  // namespace risorius::blendshapes
