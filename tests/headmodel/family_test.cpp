// SPDX-License-Identifier: MIT
// The embedded head and its relatives: how near they come to what was measured, and that one topology serves them all.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>

#include "message_of.h"
#include "risorius/geom/closest_point.h"
#include "risorius/geom/self_intersections.h"
#include "risorius/headmodel/detail/deform_head.h"
#include "risorius/headmodel/detail/layout.h"
#include "risorius/headmodel/detail/part_layout.h"
#include "temporary_folder.h"

namespace risorius::headmodel {
namespace {

const DesignTables& tables() {
    static const DesignTables read = read_design_tables(models_folder() / "adult/design");
    return read;
}

const HeadModel& average() {
    static const HeadModel made = make_head(tables());
    return made;
}

const HeadQuality& average_quality() {
    static const HeadQuality quality = head_quality(average(), tables());
    return quality;
}

std::vector<std::array<int, 2>> cuts(const HeadModel& model) {
    return geom::self_intersections(
        model.mesh.positions,
        geom::triangulate(average().mesh, {average().mesh.group_index("skin"),
                                           average().mesh.group_index("mouth")}));
}

TEST(AverageHead, IsTheShippedOneToTheByte) {
    const TemporaryFolder folder;
    write_head(average(), folder.path());
    EXPECT_TRUE(bytes_of(folder.path() / "head.obj") ==
                bytes_of(models_folder() / "adult/head.obj"));
    EXPECT_TRUE(bytes_of(folder.path() / "landmarks.json") ==
                bytes_of(models_folder() / "adult/landmarks.json"));
    EXPECT_TRUE(bytes_of(folder.path() / "regions.json") ==
                bytes_of(models_folder() / "adult/regions.json"));
}

TEST(AverageHead, LiesOnTheMeasuredRelief) {
    EXPECT_GT(average_quality().rays, 700);
    EXPECT_LE(average_quality().depth_rms_mm, 1.2);
    EXPECT_LE(average_quality().relief_rms_mm, 0.5);
    EXPECT_LE(average_quality().radius_rms_mm, 0.5);
}

TEST(AverageHead, StandsOnItsLandmarks) {
    EXPECT_LE(average_quality().landmark_rms_mm, 0.5);
    EXPECT_LE(average_quality().landmarks.front().distance_mm, 1.5)
        << average_quality().landmarks.front().landmark;
}

TEST(AverageHead, HasTheMeasuresOfAdults) {
    ASSERT_EQ(average_quality().measures.size(), 22u);
    for (const MeasureScore& m : average_quality().measures)
        EXPECT_LE(std::abs(m.deviation), 1.01) << m.measure;
}

TEST(AverageHead, HasTheTopologyOfAFace) {
    EXPECT_EQ(average_quality().triangles, 0);
    EXPECT_LE(average_quality().unusual_valence_fraction, 0.02);
    EXPECT_EQ(average_quality().mirror_error_mm, 0);
    EXPECT_EQ(average_quality().self_intersections, 0);
}

/// Where the lips touch the teeth in speech and smile: the labial faces stand some millimetres behind their lining.
TEST(AverageHead, HasTeethBehindItsLips) {
    const geom::PolygonMesh& mesh = average().mesh;
    const geom::SurfaceTree lining(
        mesh.positions,
        geom::triangulate(mesh, {mesh.group_index("mouth"), mesh.group_index("skin")}));
    for (const char* group : {"teeth_upper", "teeth_lower"})
        for (double x = 0; x < 18; x += 3) {
            double nearest = 1e9;
            const int own = mesh.group_index(group);
            for (int f = 0; f < mesh.face_count(); ++f) {
                if (mesh.face_group[f] != own) continue;
                const Vec3 p =
                    mesh.positions.row(mesh.corner_vertex[mesh.face_begin[f]]).transpose();
                if (p.x() >= x && p.x() < x + 3)
                    nearest = std::min(nearest, std::sqrt(lining.closest(p)->squared_distance));
            }
            EXPECT_GT(nearest, 1) << group << " at " << x;
            EXPECT_LT(nearest, 5.5) << group << " at " << x;
        }
}

TEST(AverageHead, LiesFlatWithLittleStretch) {
    EXPECT_GE(average_quality().stretch_low, 0.5);
    EXPECT_LE(average_quality().stretch_high, 2);
    EXPECT_EQ(average_quality().turned_over, 0);
    const TexCoords& at = average().mesh.corner_texcoord;
    ASSERT_EQ(at.rows(), static_cast<long>(average().mesh.corner_vertex.size()));
    EXPECT_GE(at.minCoeff(), 0);
    EXPECT_LE(at.maxCoeff(), 1);
}

/// Whose faces all look upwards and fill what their border holds lie nowhere upon each other.
TEST(AverageHead, HasEyesAndMouthLaidOutInIslandsOfTheirOwn) {
    const geom::PolygonMesh& mesh = average().mesh;
    constexpr int kFacesOfACrown = 200;
    const std::map<std::string, int> islands_of{
        {"eye_l", 1},      {"eye_r", 1},      {"teeth_upper", 14}, {"teeth_lower", 14},
        {"gums_upper", 1}, {"gums_lower", 1}, {"tongue", 1}};
    for (const auto& [group, islands] : islands_of) {
        const int own = mesh.group_index(group);
        std::vector<double> area(static_cast<std::size_t>(islands), 0);
        double expected = 0;
        int count = 0;
        for (int f = 0; f < mesh.face_count(); ++f) {
            if (mesh.face_group[f] != own) continue;
            const int island = islands > 1 ? count / kFacesOfACrown : 0;
            ++count;
            const bool upper = group.ends_with("upper");
            const Disc disc = islands > 1         ? crown_disc(upper, island)
                              : group == "tongue" ? tongue_disc()
                                                  : eye_disc(1);
            expected = group.starts_with("gums") ? 0.98 * 0.48 : M_PI * disc.radius * disc.radius;
            double twice = 0;
            for (int c = mesh.face_begin[f]; c < mesh.face_begin[f + 1]; ++c) {
                const int next = c + 1 < mesh.face_begin[f + 1] ? c + 1 : mesh.face_begin[f];
                const Vec2 p = mesh.corner_texcoord.row(c), q = mesh.corner_texcoord.row(next);
                twice += p.x() * q.y() - p.y() * q.x();
                if (!group.starts_with("gums"))
                    ASSERT_LE((p - disc.middle).norm(), disc.radius + 1e-9) << group << " " << c;
                else
                    ASSERT_EQ(p.y() > 0.5, upper) << group << " " << c;
            }
            ASSERT_GT(twice, 0) << group << ", face " << f;
            area[static_cast<std::size_t>(island)] += twice / 2;
        }
        EXPECT_EQ(islands > 1 ? count : kFacesOfACrown * islands, kFacesOfACrown * islands);
        for (const double a : area) {
            EXPECT_GT(a, 0.9 * expected) << group;
            EXPECT_LT(a, expected) << group;
        }
    }
}

/// In profile one sees the columella below the arch of the wing; a nostril leads back and up, longer than wide.
TEST(AverageHead, HasNostrilsBetweenArchedWingsAndColumella) {
    const geom::PolygonMesh& mesh = average().mesh;
    const auto of = [&](const char* region) {
        std::set<int> vertices;
        for (const int f : average().regions.at(region))
            for (int c = mesh.face_begin[f]; c < mesh.face_begin[f + 1]; ++c)
                if (mesh.positions(mesh.corner_vertex[c], 0) > 0)
                    vertices.insert(mesh.corner_vertex[c]);
        return vertices;
    };
    const std::set<int> wing = of("wing"), nostril = of("nostril");
    double columella_mm = 0, arch_mm = -100, sill_mm = 0;
    Vec3 opening = Vec3::Zero();
    double count = 0, deepest_mm = 0;
    for (const int v : wing) {
        const Vec3 p = mesh.positions.row(v).transpose();
        if (p.z() > 101 && p.z() < 108 && p.x() < 3.5) columella_mm = std::min(columella_mm, p.y());
        if (!nostril.count(v)) continue;
        opening += p;
        ++count;
        if (p.x() > 9 && p.z() > 99) arch_mm = std::max(arch_mm, p.y());
        if (p.z() < 98) sill_mm = std::min(sill_mm, p.y());
    }
    opening /= count;
    for (const int v : nostril)
        deepest_mm = std::max(deepest_mm, (mesh.positions.row(v).transpose() - opening).norm());
    EXPECT_GT(arch_mm - columella_mm, 4);
    EXPECT_LT(arch_mm - columella_mm, 9);
    EXPECT_GT(arch_mm - sill_mm, 2);
    EXPECT_GT(deepest_mm, 15);
    EXPECT_LT(deepest_mm, 30);
}

TEST(AverageHead, HasEveryFaceOfTheSkinInOneNamedRegion) {
    std::set<int> named;
    std::size_t count = 0;
    for (const auto& [name, faces] : average().regions) {
        EXPECT_FALSE(faces.empty()) << name;
        named.insert(faces.begin(), faces.end());
        count += faces.size();
    }
    EXPECT_EQ(average().regions.size(), region_names().size());
    EXPECT_EQ(named.size(), count);
    EXPECT_EQ(static_cast<int>(count), average_quality().faces);
    // What is named is where its name says.
    const auto middle = [&](const char* name) {
        Vec3 sum = Vec3::Zero();
        for (const int f : average().regions.at(name)) {
            const Vec3 p =
                average()
                    .mesh.positions.row(average().mesh.corner_vertex[average().mesh.face_begin[f]])
                    .transpose();
            sum += Vec3(std::abs(p.x()), p.y(), p.z());
        }
        return Vec3(sum / average().regions.at(name).size());
    };
    EXPECT_LT((middle("lips") - Vec3(12, -53, 94)).norm(), 8) << middle("lips").transpose();
    EXPECT_LT((middle("ear") - Vec3(73, -2, -11)).norm(), 10) << middle("ear").transpose();
    EXPECT_LT((middle("lid") - Vec3(31, 18, 83)).norm(), 8) << middle("lid").transpose();
}

TEST(Flatten, KeepsLengthsOfWhatCanBeLaidFlat) {
    // Half a cylinder of radius 20, 12 by 8 quads: a sheet of 62.7 by 40 mm
    constexpr int kAround = 12, kAlong = 8;
    std::vector<Vec3> points;
    std::vector<std::array<int, 4>> faces;
    for (int r = 0; r <= kAlong; ++r)
        for (int k = 0; k <= kAround; ++k) {
            const double a = M_PI * k / kAround;
            points.emplace_back(-20 * std::cos(a), 5.0 * r, 20 * std::sin(a));
        }
    for (int r = 0; r < kAlong; ++r)
        for (int k = 0; k < kAround; ++k) {
            const int a = r * (kAround + 1) + k;
            faces.push_back({a, a + 1, a + kAround + 2, a + kAround + 1});
        }
    const auto flat = flatten(points, faces, std::vector<bool>(points.size(), false));
    for (const auto& f : faces)
        for (std::size_t k = 0; k < 4; ++k) {
            const auto a = static_cast<std::size_t>(f[k]),
                       b = static_cast<std::size_t>(f[(k + 1) % 4]);
            EXPECT_NEAR((flat[a] - flat[b]).norm(), (points[a] - points[b]).norm(), 0.02);
        }
}

TEST(Identity, OfNobodyIsTheAverageHeadToTheBit) {
    EXPECT_TRUE(deform_head(average(), tables(), {}).mesh.positions == average().mesh.positions);
}

void expect_somebody(const HeadModel& model, const Identity& identity) {
    for (const MeasureScore& m : measure_head(model, tables(), identity.sex))
        EXPECT_LE(std::abs(m.deviation), kLargestDeviation) << identity.name << " " << m.measure;
    EXPECT_EQ(cuts(model), cuts(average())) << identity.name;
    EXPECT_EQ(model.mesh.corner_vertex, average().mesh.corner_vertex);
    EXPECT_EQ(model.landmarks, average().landmarks);
}

TEST(Identity, SixAreNamedOfTheFamilyAndAllArePeople) {
    for (const std::string name : {"ada", "bruno", "imani", "kenji", "marta", "oskar"}) {
        const Identity identity = read_identity(identity_file(name), tables());
        EXPECT_EQ(identity.name, name);
        const HeadModel model = deform_head(average(), tables(), identity);
        EXPECT_NO_THROW(check_spread(model, tables(), identity, name));
        expect_somebody(model, identity);
        EXPECT_GT((model.mesh.positions - average().mesh.positions).rowwise().norm().maxCoeff(), 3)
            << name;
    }
}

TEST(Identity, DrawnOnesArePeopleAndDifferFromEachOther) {
    std::set<std::string> drawn;
    for (const unsigned seed : {1u, 7u, 34u}) {
        Identity identity = random_identity(seed, tables());
        const HeadModel model = deform_within_spread(average(), tables(), identity);
        expect_somebody(model, identity);
        drawn.insert(identity_json(identity).dump());
        EXPECT_EQ(random_identity(seed, tables()).shape, random_identity(seed, tables()).shape);
    }
    EXPECT_EQ(drawn.size(), 3u);
}

TEST(Identity, MenLoseHairWithTheYearsAndWomenHardly) {
    double old_men = 0, young_men = 0, women = 0;
    int olds = 0, youngs = 0, others = 0;
    for (unsigned seed = 1; seed <= 300; ++seed) {
        const Identity one = random_identity(seed, tables());
        if (one.sex <= 0) {
            women += one.temples;
            ++others;
        } else if (one.age > 55) {
            old_men += one.temples;
            ++olds;
        } else if (one.age < 35) {
            young_men += one.temples;
            ++youngs;
        }
    }
    ASSERT_GT(std::min({olds, youngs, others}), 10);
    EXPECT_GT(old_men / olds, 3 * young_men / youngs);
    EXPECT_LT(women / others, 2);
}

TEST(Identity, ExtremesOfEveryParameterStayWholeAndSymmetric) {
    // All at once at their ends: the map still folds nothing, though nobody looks like it.
    for (const double end : {-2.0, 2.0}) {
        Identity identity;
        identity.age = end < 0 ? 20 : 80;
        for (const std::string& parameter : shape_parameters(tables()))
            identity.shape[parameter] = end;
        const HeadModel model = deform_head(average(), tables(), identity);
        const HeadQuality quality = head_quality(model, tables(), 0, false);
        EXPECT_EQ(quality.mirror_error_mm, 0);
        EXPECT_EQ(quality.self_intersections, 0) << "parameters at " << end;
    }
}

TEST(Identity, GlobesStayRoundAndLidsKeepTheirDistance) {
    const Identity identity = read_identity(identity_file("ada"), tables());
    const HeadModel model = deform_head(average(), tables(), identity);
    const int eye = average().mesh.group_index("eye_l");
    std::set<int> globe;
    for (int f = 0; f < average().mesh.face_count(); ++f)
        if (average().mesh.face_group[f] == eye)
            globe.insert(average().mesh.corner_vertex[average().mesh.face_begin[f]]);
    const Vec3 shift =
        (model.mesh.positions.row(*globe.begin()) - average().mesh.positions.row(*globe.begin()))
            .transpose();
    for (const int v : globe)
        EXPECT_LE(
            (model.mesh.positions.row(v) - average().mesh.positions.row(v) - shift.transpose())
                .norm(),
            1e-9);
    const Vec3 before(31.5, 18.2, 73.2), after = before + shift;
    for (const char* margin : {"ps_l", "pi_l", "ull_l", "lll_l", "llm_l"}) {
        const int v = average().landmarks.at(margin);
        const Vec3 was = average().mesh.positions.row(v).transpose() - before,
                   is = model.mesh.positions.row(v).transpose() - after;
        const Globe round;
        EXPECT_NEAR(is.norm() - round.radius_at(is.z() / is.norm()),
                    was.norm() - round.radius_at(was.z() / was.norm()), 0.02)
            << margin;
    }
}

TEST(Identity, MenAreLargerThanWomenByThePublishedDifferences) {
    Identity woman, man;
    woman.sex = -1;
    man.sex = 1;
    const auto hers = measure_head(deform_head(average(), tables(), woman), tables(), -1),
               his = measure_head(deform_head(average(), tables(), man), tables(), 1);
    for (std::size_t k = 0; k < hers.size(); ++k) {
        // One number for sex leaves up to a standard deviation.
        EXPECT_NEAR(his[k].length_mm - hers[k].length_mm, tables().measures[k].men_less_women_mm,
                    tables().measures[k].sd_mm)
            << hers[k].measure;
    }
}

TEST(Identity, ErrorsNamePlaceExpectedAndFound) {
    const TemporaryFolder folder;
    const auto message = [&](const std::string& text) {
        const auto file = folder.path() / "who.json";
        std::ofstream(file) << R"({"format": "risorius-identity", "version": 1, )" << text << "}";
        return message_of([&] { read_identity(file, tables()); });
    };
    EXPECT_NE(message(R"("age": 12)").find("/age: expected [20, 80], found 12"), std::string::npos)
        << message(R"("age": 12)");
    EXPECT_NE(message(R"("shape": {"lip": 1})").find("(did you mean \"lips\"?)"), std::string::npos)
        << message(R"("shape": {"lip": 1})");
    EXPECT_NE(message(R"("shape": {"lips": 2.5})").find("lips: expected [-2, 2], found 2.5"),
              std::string::npos);
    EXPECT_NE(message(R"("iris": "violet")").find("violet"), std::string::npos);
    Identity wide;
    wide.shape = {{"face_width", 2}, {"cheekbones", 2}, {"fat", 2}, {"jaw_width", 2}};
    wide.sex = -1;
    wide.age = 80;
    wide.shape["nose_width"] = 2;
    const HeadModel model = deform_head(average(), tables(), wide);
    EXPECT_NE(message_of([&] {
                  check_spread(model, tables(), wide, "wide");
              }).find("wide: expected measures within 2.5 standard deviations of the mean"),
              std::string::npos);
}

}  // namespace
}  // namespace risorius::headmodel
