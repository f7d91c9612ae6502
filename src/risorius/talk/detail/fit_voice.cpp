// SPDX-License-Identifier: MIT
// Simulates the poses of RigVoice.
#include <algorithm>
#include <cmath>
#include <optional>

#include "risorius/core/counter_rng.h"
#include "risorius/face/surfaces.h"
#include "risorius/rig/expression_drive.h"
#include "risorius/speech/phone_table.h"
#include "risorius/talk/detail/rig_voice.h"

namespace risorius::talk {

namespace {

// Numbers of poses
constexpr int kAround = 60, kClosed = 30, kLabiodental = 12, kPursed = 36, kRounds = 4;
constexpr double kTouching_mm = 0.15;  // lips that touch
constexpr double kSealStep_mm = 1.5, kSealEnd_mm = 4.5;
constexpr int kIterations = 400;
// A pose is left out when the solver did not come near its equilibrium, or when it is no mouth of speech.
constexpr double kLargestGap_mm = 30;
constexpr double kCorrection = 0.8, kLargestCorrection_mm = 3;
constexpr double kRounded_mm = 1;  // protrusion of rounded lips

/// Phones whose targets the rounds are for: one of each kind of mouth.
constexpr const char* kTargets[] = {"i", "y", "e", "ø", "ɛ", "æ", "ɑ", "o", "u", "ə",
                                    "ɔ", "ɪ", "ʊ", "œ", "p", "f", "ʋ", "s", "ʃ", "t",
                                    "n", "l", "r", "ɹ", "w", "k", "θ", "j"};

const char* const kMuscles[] = {"orbicularis_oris_upper_peripheral",
                                "orbicularis_oris_lower_peripheral",
                                "orbicularis_oris_upper_marginal",
                                "orbicularis_oris_lower_marginal",
                                "incisivus_labii_superioris",
                                "incisivus_labii_inferioris",
                                "levator_labii_superioris",
                                "depressor_labii_inferioris",
                                "mentalis",
                                "risorius",
                                "zygomaticus_major",
                                "buccinator"};

class Fitter {
  public:
    Fitter(face::Face& face, const rig::RigDescription& rig,
           const std::function<void(double)>& report)
        : face_(face),
          rig_(rig),
          report_(report),
          channels_(rig.channels()),
          measures_(face.head(), rig) {}

    RigVoice fit() {
        find_jaw_travel();
        total_ = 16 + kAround + kClosed + kLabiodental + kPursed +
                 kRounds * static_cast<int>(std::size(kTargets));
        add_visemes();
        for (int i = 0; i < kClosed; ++i) add(closed(i));
        for (int i = 0; i < kLabiodental; ++i) add(labiodental(i));
        for (int i = 0; i < kPursed; ++i) add(pursed(i));
        for (int i = 0; i < kAround; ++i) add(around(i));
        // Each round aims beyond a target by what the rounds before have missed it.
        std::vector<WantedMouth> targets = wanted_of_phones(), aims = targets;
        for (int round = 0; round < kRounds; ++round) {
            const RigVoice so_far(poses_, jaw_travel_mm_, channels_.column_names());
            for (std::size_t i = 0; i < targets.size(); ++i) {
                Eigen::VectorXd state;
                const std::optional<MouthPose> pose =
                    add({so_far.activation_for(aims[i], state), so_far.jaw_open_of(aims[i].jaw)});
                // At the teeth it is the teeth that count.
                if (!pose || targets[i].labiodental > 0) continue;
                const auto correct = [](double& aim, double target, double got, double most) {
                    aim += kCorrection * std::clamp(target - got, -most, most);
                };
                if (targets[i].gap > 0)
                    correct(aims[i].gap, targets[i].gap, pose->virtual_gap, kLargestCorrection_mm);
                correct(aims[i].width, targets[i].width, pose->mouth.width, kLargestCorrection_mm);
                if (targets[i].protrusion > kRounded_mm)
                    correct(aims[i].protrusion, targets[i].protrusion,
                            (pose->mouth.upper_protrusion + pose->mouth.lower_protrusion) / 2,
                            kLargestCorrection_mm / 2);
            }
        }
        return {std::move(poses_), std::move(jaw_travel_mm_), channels_.column_names()};
    }

  private:
    static std::vector<WantedMouth> wanted_of_phones() {
        const speech::PhoneTable table = speech::PhoneTable::standard();
        std::vector<WantedMouth> out;
        for (const char* symbol : kTargets) {
            const speech::PhoneEntry phone = table.phone(symbol, symbol);
            WantedMouth wanted;
            wanted.jaw = value_of(phone.target, speech::Parameter::kJaw);
            wanted.gap = value_of(phone.target, speech::Parameter::kGap);
            wanted.width = value_of(phone.target, speech::Parameter::kWidth);
            wanted.protrusion = value_of(phone.target, speech::Parameter::kProtrusion);
            if (phone.kind == speech::PhoneClass::kLabiodental) wanted.labiodental = 1;
            if (phone.kind == speech::PhoneClass::kLabiodentalSoft) wanted.labiodental = 0.6;
            wanted.bounded = phone.kind == speech::PhoneClass::kClosure ? 1 : 0;
            out.push_back(wanted);
        }
        return out;
    }

    struct Asked {
        Eigen::VectorXd activation;
        double jaw_open = 0;
    };

    double random(int pose, int number) const {
        return CounterRng(7)
            .at(static_cast<std::uint64_t>(pose))
            .at(static_cast<std::uint64_t>(number))
            .uniform();
    }

    track::Drive drive_of(double jaw_open) const {
        track::Drive drive;
        drive.kinematic[static_cast<std::size_t>(track::Kinematic::kJawOpen)] = jaw_open;
        return drive;
    }

    void find_jaw_travel() {
        for (int i = 0; i <= 12; ++i)
            jaw_travel_mm_.push_back(
                1e3 *
                face_.surfaces().posed(face_.head().vertices, drive_of(kJawStep * i)).jaw.open_m);
    }
    double jaw_open_of(double jaw_mm) const {
        return RigVoice({}, jaw_travel_mm_, {}).jaw_open_of(jaw_mm);
    }

    void set(Eigen::VectorXd& activation, const std::string& muscle, double value) const {
        if (!channels_.find(muscle)) return;  // a rig without it
        for (const Side side : {Side::kLeft, Side::kRight})
            activation[channels_.column(muscle, side)] = std::clamp(value, 0.0, 1.0);
    }
    double get(const Eigen::VectorXd& activation, const std::string& muscle) const {
        return channels_.find(muscle) ? activation[channels_.column(muscle, Side::kLeft)] : 0;
    }

    std::vector<Asked> visemes() const {
        std::vector<Asked> out;
        for (const track::ArkitShape& shape : rig_.facs.visemes) {
            const track::Expansion expansion = track::expand(shape, rig_.facs, channels_);
            out.push_back(
                {expansion.excitation.cwiseMax(0.0),
                 expansion.kinematic[static_cast<std::size_t>(track::Kinematic::kJawOpen)]});
        }
        return out;
    }

    void add_visemes() {
        add({Eigen::VectorXd::Zero(channels_.column_count()), 0});
        for (const Asked& one : visemes()) add(one);
    }

    Asked none() const { return {Eigen::VectorXd::Zero(channels_.column_count()), 0}; }

    /// Between two visemes, with other muscles beside them.
    Asked around(int i) const {
        const std::vector<Asked> known = visemes();
        Asked out = none();
        if (!known.empty()) {
            const auto pick = [&](double chance) {
                return known[std::min(
                    known.size() - 1,
                    static_cast<std::size_t>(chance * static_cast<double>(known.size())))];
            };
            const Asked one = pick(random(i, 0)), two = pick(random(i, 1));
            const double mix = random(i, 2), scale = 0.4 + 0.9 * random(i, 3);
            out.activation = scale * (mix * one.activation + (1 - mix) * two.activation);
            out.jaw_open = std::clamp(
                mix * one.jaw_open + (1 - mix) * two.jaw_open + 0.08 * (random(i, 4) - 0.5), 0.0,
                0.4);
        }
        int number = 5;
        for (const char* muscle : kMuscles) {
            const bool more = random(i, number++) < 0.3;
            const double change = 0.5 * random(i, number++);
            if (more) set(out.activation, muscle, get(out.activation, muscle) + change);
        }
        out.activation = out.activation.cwiseMax(0.0).cwiseMin(1.0);
        return out;
    }

    /// Lips that press, from spread to rounded, at jaws from shut to 6 mm.
    Asked closed(int i) const {
        Asked out = none();
        const double round = std::max(0.0, 1.5 * random(1000 + i, 0) - 0.5),
                     jaw_mm = 0.5 + 5.5 * random(1000 + i, 1),
                     press = 0.3 + 0.7 * random(1000 + i, 2);
        out.jaw_open = jaw_open_of(jaw_mm);
        const double lift = jaw_mm / 6;
        set(out.activation, "orbicularis_oris_lower_peripheral",
            0.15 + 0.3 * press * lift + 0.6 * round);
        set(out.activation, "orbicularis_oris_upper_peripheral", 0.1 + 0.15 * press + 0.5 * round);
        set(out.activation, "mentalis", (0.2 + 0.6 * lift) * press);
        set(out.activation, "orbicularis_oris_lower_marginal",
            0.1 + 0.25 * press * random(1000 + i, 3));
        set(out.activation, "orbicularis_oris_upper_marginal",
            0.05 + 0.2 * press * random(1000 + i, 4));
        set(out.activation, "risorius", (1 - round) * 0.35 * random(1000 + i, 5));
        set(out.activation, "buccinator", (1 - round) * 0.2 * random(1000 + i, 6));
        return out;
    }

    /// Lower lip to the upper incisors, teeth seen.
    Asked labiodental(int i) const {
        Asked out = none();
        out.jaw_open = jaw_open_of(2 + 3.5 * random(2000 + i, 0));
        set(out.activation, "orbicularis_oris_lower_marginal", 0.6 + 0.4 * random(2000 + i, 1));
        set(out.activation, "levator_labii_superioris", 0.15 + 0.3 * random(2000 + i, 2));
        set(out.activation, "risorius", 0.05 + 0.25 * random(2000 + i, 3));
        set(out.activation, "buccinator", 0.05 + 0.2 * random(2000 + i, 4));
        set(out.activation, "mentalis", 0.4 * random(2000 + i, 5));
        set(out.activation, "incisivus_labii_inferioris", 0.3 * random(2000 + i, 6));
        return out;
    }

    /// Pursed lips: two of three are turned outwards as well, which leaves a small round opening that neither makes alone; the
    /// others press, for closures beside rounded vowels.
    Asked pursed(int i) const {
        Asked out = none();
        const auto unit = [&](const char* name, double share) {
            if (const auto expansion = rig::expansion_at(rig_, name, 1))
                out.activation += share * expansion->excitation.cwiseMax(0.0);
        };
        unit("AU18", 0.4 + 0.6 * random(3000 + i, 0));
        if (i % 3 == 2) {
            unit("AU17", 0.3 * random(3000 + i, 1));
            unit("AU24", 0.6 * random(3000 + i, 3));
        } else {
            unit("AU22", 0.25 + 0.6 * random(3000 + i, 1));
        }
        out.activation = out.activation.cwiseMin(1.0);
        out.jaw_open = jaw_open_of(1 + (i % 3 == 2 ? 4 : 8) * random(3000 + i, 2));
        return out;
    }

    Mouth solve(const Asked& asked, double more_jaw_mm) {
        const double jaw_open =
            more_jaw_mm > 0 ? jaw_open_of(mm_of(asked.jaw_open) + more_jaw_mm) : asked.jaw_open;
        const track::Drive drive = drive_of(jaw_open);
        face_.solve_equilibrium(asked.activation, drive, {.iterations = kIterations});
        Mouth mouth = measures_.at(face_.pose());
        mouth.jaw = mm_of(jaw_open);
        return mouth;
    }
    double mm_of(double jaw_open) const {
        const double place =
            std::clamp(jaw_open / kJawStep, 0.0, static_cast<double>(jaw_travel_mm_.size() - 1));
        const auto i = std::min(static_cast<std::size_t>(place), jaw_travel_mm_.size() - 2);
        const double s = place - static_cast<double>(i);
        return (1 - s) * jaw_travel_mm_[i] + s * jaw_travel_mm_[i + 1];
    }

    std::optional<MouthPose> add(const Asked& asked) {
        report_(std::min(1.0, static_cast<double>(done_++) / total_));
        MouthPose pose;
        pose.activation = asked.activation;
        pose.jaw_open = asked.jaw_open;
        pose.mouth = solve(asked, 0);
        if (!(pose.mouth.gap < kLargestGap_mm)) return std::nullopt;
        pose.virtual_gap = pose.mouth.gap;
        if (pose.mouth.gap < kTouching_mm && asked.activation.sum() > 0) {
            // Lower the jaw until the lips part.
            double way = 0;
            while (way < kSealEnd_mm) {
                const double gap = solve(asked, way + kSealStep_mm).gap;
                if (gap >= kTouching_mm) {
                    // Where the gap passes the limit
                    way += kSealStep_mm *
                           (1 - std::clamp((gap - kTouching_mm) / (kGapOfJaw * kSealStep_mm), 0.0,
                                           1.0));
                    break;
                }
                way += kSealStep_mm;
            }
            pose.virtual_gap = -kGapOfJaw * way;
        }
        poses_.push_back(pose);
        return pose;
    }

    face::Face& face_;
    const rig::RigDescription& rig_;
    const std::function<void(double)>& report_;
    const track::ChannelTable channels_;
    const MouthMeasures measures_;
    std::vector<double> jaw_travel_mm_;
    std::vector<MouthPose> poses_;
    int done_ = 0, total_ = 1;
};

}  // namespace

RigVoice fit_voice(face::Face& face, const rig::RigDescription& rig,
                   const std::function<void(double)>& report) {
    face.drive_jaw_by(track::JawDrive::kChannels);
    return Fitter(face, rig, report).fit();
}

}  // namespace risorius::talk
