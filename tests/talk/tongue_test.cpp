// SPDX-License-Identifier: MIT
// What the body of the tongue does in speech: in k and g it touches the palate from closure to release, in vowels it leaves a passage.
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "paths.h"
#include "risorius/face/face.h"
#include "risorius/scene/rig_files.h"
#include "risorius/talk/say_event.h"
#include "risorius/track/script.h"
#include "risorius/track/timeline.h"

namespace risorius::talk {
namespace {

using track::Kinematic;

const scene::RigFiles& tongue_rig() {
    static const scene::RigFiles files =
        scene::read_rig_files(std::filesystem::path(RISORIUS_SOURCE_DIR) / "rigs/adult/rig.json");
    return files;
}

/// The drives of phones, given as symbols and lengths in s. The sound begins at 0.4 s.
constexpr double kSaidFrom_s = 0.4;
track::Timeline said_phones(const std::vector<std::pair<std::string, double>>& phones) {
    const track::ChannelTable channels = tongue_rig().rig.channels();
    const Json json{
        {"format", "risorius-script"},
        {"version", 1},
        {"rig", tongue_rig().file.generic_string()},
        {"duration_s", 2.5},
        {"events", {{{"say", {{"phones", phones}}}, {"start_s", kSaidFrom_s}, {"sound", "none"}}}}};
    track::ScriptDescription script =
        track::read_script(JsonCursor::from_json(json, "script"), channels, tongue_rig().rig.facs,
                           tongue_rig().rig.expressions);
    add_to_script(plan_speech(script.says, script.header, tongue_rig()), script);
    return track::Timeline(script, channels);
}

/// "a k a" with a stop of 0.12 s from 0.6 to 0.72 s, which is released at 0.696 s.
track::Timeline vcv(const char* before, const char* stop, const char* after) {
    return said_phones({{before, 0.2}, {stop, 0.12}, {after, 0.25}});
}
constexpr double kBodyClosure_s = kSaidFrom_s + 0.2, kBodyRelease_s = kBodyClosure_s + 0.12 - 0.024;

/// The mouth with the jaw and the tongue of a drive, without its muscles.
class TongueInMouth {
  public:
    Points at(const track::Timeline& timeline, double t_s) {
        track::Drive drive = timeline.at(t_s);
        drive.excitation.setZero();
        track::Drive rest = drive;
        rest.kinematic = {};
        face_.start([&](double) { return rest; });
        face_.solve_equilibrium(drive.excitation, drive,
                                {.iterations = 60, .tolerance_m = 1e-4, .planes_m = 1e-4});
        return face_.pose().vertices;
    }
    bool is_tongue(long v) const {
        return face_.head().carrier[static_cast<std::size_t>(v)] == rig::Carrier::kTongue;
    }
    const rig::Head& head() const { return face_.head(); }
    /// From the tongue up to the lining, mm; below 0 a point is in it.
    double gap_mm(const Points& at) const {
        double least = 1e300;
        for (long v = 0; v < at.rows(); ++v)
            if (is_tongue(v)) least = std::min(least, above(at, at.row(v).transpose()));
        return 1e3 * least;
    }
    /// From the tip of the tongue to the nearest point of the upper gums, mm.
    double ridge_gap_mm(const Points& at) const {
        const geom::PolygonMesh& mesh = tongue_rig().mesh;
        const Triangles gums = geom::triangulate(mesh, {mesh.group_index("gums_upper")});
        double foremost = -1, best = 1e300;
        for (long v = 0; v < at.rows(); ++v)
            if (is_tongue(v)) foremost = std::max(foremost, head().vertices(v, 2));
        for (long v = 0; v < at.rows(); ++v) {
            if (!is_tongue(v) || head().vertices(v, 2) < foremost - 1e-3) continue;
            for (long f = 0; f < gums.rows(); ++f)
                best = std::min(best, (at.row(v) - at.row(gums(f, 0))).norm());
        }
        return 1e3 * best;
    }
    /// Where the back of the tongue is within 4 mm of its highest point, along the head, m.
    double middle_of_top(const Points& at) const {
        double top = -1e300, sum = 0, count = 0;
        for (long v = 0; v < at.rows(); ++v)
            if (is_tongue(v)) top = std::max(top, at(v, 1));
        for (long v = 0; v < at.rows(); ++v)
            if (is_tongue(v) && at(v, 1) > top - 4e-3) {
                sum += at(v, 2);
                ++count;
            }
        return sum / count;
    }

  private:
    double above(const Points& at, const Vec3& p) const {
        double best = 1e300;
        const Triangles& roof = head().lining;
        for (long f = 0; f < roof.rows(); ++f) {
            const Vec3 a = Vec3(at.row(roof(f, 0))) - p, b = Vec3(at.row(roof(f, 1))) - p,
                       c = Vec3(at.row(roof(f, 2))) - p;
            const auto cross = [](const Vec3& u, const Vec3& v) {
                return u.x() * v.z() - u.z() * v.x();
            };
            const Vec3 part(cross(b, c), cross(c, a), cross(a, b));
            const double area = part.sum();
            if (area == 0 || (part / area).minCoeff() < 0) continue;
            const double y = part.dot(Vec3(a.y(), b.y(), c.y())) / area;
            if (p.y() + y > head().landmark("sto").y() + 5e-3) best = std::min(best, y);
        }
        return best;
    }
    face::Face face_{tongue_rig().rig, tongue_rig().mesh, face::quality_named("preview"),
                     tongue_rig().place()};
};

TongueInMouth& tongue_in_mouth() {
    static TongueInMouth one;
    return one;
}

double up_at(const track::Timeline& timeline, double t_s) {
    return timeline.at(t_s).at(Kinematic::kTongueBodyUp);
}

TEST(SpokenTongue, TouchesThePalateInKAndGAndLeavesItInTheVowels) {
    // In u the back of the tongue stays high.
    for (const auto& [before, stop, after, released_mm] :
         {std::tuple{"ɑ", "k", "ɑ", 1.0}, std::tuple{"ɑ", "ɡ", "u", 0.6}}) {
        const track::Timeline said = vcv(before, stop, after);
        for (const double t_s :
             {kBodyClosure_s + 0.01, kBodyClosure_s + 0.05, kBodyRelease_s - 0.012}) {
            const double gap = tongue_in_mouth().gap_mm(tongue_in_mouth().at(said, t_s));
            EXPECT_LT(gap, 0.5) << stop << " at " << t_s;
            EXPECT_GT(gap, 0) << stop << " at " << t_s;
        }
        EXPECT_GT(tongue_in_mouth().gap_mm(tongue_in_mouth().at(said, kBodyClosure_s - 0.1)), 10)
            << stop;
        EXPECT_GT(tongue_in_mouth().gap_mm(tongue_in_mouth().at(said, kBodyRelease_s + 0.03)),
                  released_mm)
            << stop;
        EXPECT_GT(
            tongue_in_mouth().gap_mm(tongue_in_mouth().at(said, kBodyClosure_s + 0.12 + 0.13)), 1.5)
            << stop;
        // Smooth: no step of the channels within 5 ms
        for (double t_s = 0; t_s < 2; t_s += 0.005)
            for (const Kinematic k : {Kinematic::kTongueBodyUp, Kinematic::kTongueBodyBack})
                EXPECT_LT(std::abs(said.at(t_s + 0.005).at(k) - said.at(t_s).at(k)), 0.15)
                    << stop << " at " << t_s;
    }
}

TEST(SpokenTongue, IsHighInFrontInIHighAtTheBackInUAndLowInA) {
    const track::Timeline said = said_phones({{"i", 0.3}, {"ɑ", 0.3}, {"u", 0.3}});
    const Points i = tongue_in_mouth().at(said, kSaidFrom_s + 0.15),
                 a = tongue_in_mouth().at(said, kSaidFrom_s + 0.45),
                 u = tongue_in_mouth().at(said, kSaidFrom_s + 0.75);
    EXPECT_GT(tongue_in_mouth().gap_mm(i), 1.5);
    EXPECT_LT(tongue_in_mouth().gap_mm(i), 5);
    EXPECT_GT(tongue_in_mouth().gap_mm(u), 1.5);
    EXPECT_LT(tongue_in_mouth().gap_mm(u), 5);
    EXPECT_GT(tongue_in_mouth().gap_mm(a), 18);
    EXPECT_GT(tongue_in_mouth().middle_of_top(i) - tongue_in_mouth().middle_of_top(u), 10e-3);
}

TEST(SpokenTongue, DoesNotTouchThePalateWithItsBodyInTDNAndL) {
    for (const char* consonant : {"t", "d", "n", "l"}) {
        const track::Timeline said = vcv("ɑ", consonant, "ɑ");
        const double t_s = kBodyClosure_s + 0.06;
        EXPECT_LT(up_at(said, t_s), 0.3) << consonant;
        EXPECT_GT(said.at(t_s).at(Kinematic::kTongueUp), 0.6) << consonant;
        EXPECT_GT(tongue_in_mouth().gap_mm(tongue_in_mouth().at(said, t_s)), 2) << consonant;
    }
}

TEST(SpokenTongue, TouchesTheRidgeWithItsTipInTDNAndL) {
    for (const char* consonant : {"t", "d", "n", "l"}) {
        const track::Timeline said = vcv("ɑ", consonant, "ɑ");
        for (const double t_s :
             {kBodyClosure_s + 0.015, kBodyClosure_s + 0.05, kBodyRelease_s - 0.015})
            EXPECT_LT(tongue_in_mouth().ridge_gap_mm(tongue_in_mouth().at(said, t_s)), 1)
                << consonant << " at " << t_s;
        EXPECT_GT(tongue_in_mouth().ridge_gap_mm(tongue_in_mouth().at(said, kBodyClosure_s - 0.1)),
                  10)
            << consonant;
    }
}

TEST(SpokenTongue, IsBetweenTheTeethInTh) {
    const auto foremost = [&](const Points& at, const auto& counts) {
        double z = -1;
        for (long v = 0; v < at.rows(); ++v)
            if (counts(v)) z = std::max(z, at(v, 2));
        return z;
    };
    const auto is_tongue = [](long v) { return tongue_in_mouth().is_tongue(v); };
    const rig::Head& head = tongue_in_mouth().head();
    const double teeth = foremost(head.vertices, [&](long v) {
        return head.carrier[static_cast<std::size_t>(v)] == rig::Carrier::kSkull;
    });
    // Between two i the teeth leave less room.
    const double t_s = kBodyClosure_s + 0.06;
    EXPECT_GT(foremost(tongue_in_mouth().at(vcv("ɑ", "θ", "ɑ"), t_s), is_tongue), teeth - 4e-3);
    EXPECT_LT(foremost(tongue_in_mouth().at(vcv("ɑ", "t", "ɑ"), t_s), is_tongue), teeth - 5e-3);
}

TEST(SpokenTongue, LiesStillBeforeAndAfterSpeechAndIsTheSameTwice) {
    const track::Timeline one = vcv("ɑ", "k", "i"), two = vcv("ɑ", "k", "i");
    for (double t_s = 0; t_s < 2; t_s += 0.01) {
        EXPECT_EQ(one.at(t_s).kinematic, two.at(t_s).kinematic) << t_s;
        for (const Kinematic k : {Kinematic::kTongueBodyUp, Kinematic::kTongueBodyBack}) {
            EXPECT_LE(std::abs(one.at(t_s).at(k)), 1) << t_s;
        }
    }
    EXPECT_LT(std::abs(up_at(one, 0.05)), 0.06);
    EXPECT_LT(std::abs(up_at(one, 1.6)), 0.06);
}

}  // namespace
}  // namespace risorius::talk
