// SPDX-License-Identifier: MIT
// Bellies of muscles that are meshes: isometric force and free shortening against closed forms, the same muscle in cells, where fibres
// come from, and what is said of mistakes.
#include "risorius/softbody/detail/mesh_muscle.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "message_of.h"
#include "risorius/muscle/muscle_curves.h"
#include "risorius/softbody/mesh_body.h"
#include "risorius/softbody/muscle_body.h"
#include "risorius/solve/integrator.h"
#include "temporary_folder.h"
#include "tet_blocks.h"

namespace risorius::softbody {
namespace {

constexpr double kBellyShear_pa = 20e3, kBellyBulk_pa = 500e3, kBellyTension_pa = 3e5;

class MeshMuscles : public testing::Test {
  protected:
    /// A block of 40 x 10 x 10 mm as a legacy file of VTK, with `data` behind it.
    void write_belly(const std::array<int, 3>& cells, const std::string& data = "") {
        block_ = testing_of::tet_block(cells, {0.04, 0.01, 0.01});
        std::ofstream out(folder_ / "belly.vtk");
        out.precision(17);
        out << "# vtk DataFile Version 3.0\nbelly\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS "
            << block_.rest.rows() << " double\n"
            << block_.rest << "\nCELLS " << block_.tets.rows() << " " << 5 * block_.tets.rows()
            << "\n";
        for (Eigen::Index t = 0; t < block_.tets.rows(); ++t)
            out << "4 " << block_.tets.row(t) << "\n";
        out << "CELL_TYPES " << block_.tets.rows() << "\n";
        for (Eigen::Index t = 0; t < block_.tets.rows(); ++t) out << "10\n";
        out << data;
    }
    /// The same vector for each of `count` rows.
    static std::string vectors(const std::string& head, Eigen::Index count,
                               const std::string& vector) {
        std::string out = head + " " + std::to_string(count) + "\nVECTORS fibre double\n";
        for (Eigen::Index i = 0; i < count; ++i) out += vector + "\n";
        return out;
    }
    Json belly(const std::string& more = "{}", const std::string& muscle = "{}") const {
        Json json = Json::parse(R"({"kind": "mesh", "gravity_m_per_s2": [0, 0, 0],
            "materials": [{"law": "neo-hookean", "c10_pa": 10000, "bulk_pa": 500000,
                           "density_kg_per_m3": 1060,
                           "muscle": {"tension_pa": 300000, "fibres": {"along": [2, 0, 0]}}}]})");
        json["mesh"] = Json{{"file", (folder_ / "belly.vtk").string()}};
        json["materials"][0]["muscle"].merge_patch(Json::parse(muscle));
        json.merge_patch(Json::parse(more));
        return json;
    }
    SoftBody build(const Json& json) const {
        return build_mesh_body(read_mesh_body(JsonCursor::from_json(json, "body")));
    }
    static Points settled(const SoftBody& body) {
        solve::MotionState state = body.start();
        solve::make_integrator({.method = solve::Method::kQuasiStatic,
                                .length_scale_m = body.length_scale_m,
                                .newton_iterations = 200})
            ->advance(body.system, state, 1);
        return state.x;
    }
    std::string complaint(const Json& json) const {
        std::string text = message_of([&] { build(json); });
        const std::string here = folder_.path().string() + "/";
        for (std::size_t at; (at = text.find(here)) != std::string::npos;)
            text.erase(at, here.size());
        return text;
    }

    TemporaryFolder folder_;
    testing_of::TetBlock block_;
};

const char* const kHeldEnds =
    R"("fixed": [{"low_m": [-1, -1, -1], "high_m": [0.0001, 1, 1]},
                 {"low_m": [0.0399, -1, -1], "high_m": [1, 1, 1]}])";
/// Three planes along which the block slides.
const char* const kSliding =
    R"("fixed": [{"low_m": [-1, -1, -1], "high_m": [0.0001, 1, 1], "axes": "x"},
                 {"low_m": [-1, -1, -1], "high_m": [1, 0.0001, 1], "axes": "y"},
                 {"low_m": [-1, -1, -1], "high_m": [1, 1, 0.0001], "axes": "z"}])";

// Specific tension x area x activation x fl + fp: at the length at which it is held, the sides of the belly have nothing to do.
TEST_F(MeshMuscles, PullAsTheClosedFormBetweenHeldEnds) {
    write_belly({6, 2, 2});
    const muscle::MuscleCurves curves = muscle::zajac_curves();
    for (const double a : {0.5, 1.0})
        for (const double l0 : {1.0, 1.25, 0.85}) {
            const SoftBody body =
                build(belly("{\"activation\": " + std::to_string(a) + ", " + kHeldEnds + "}",
                            "{\"optimal_stretch\": " + std::to_string(l0) + "}"));
            const Points x = settled(body);
            const double expected =
                1e-4 * kBellyTension_pa *
                (a * curves.active.value(1 / l0) + curves.passive.value(1 / l0));
            EXPECT_NEAR(body.holding_n(body.supports[0], x).x(), -expected, 1e-6) << l0;
            EXPECT_NEAR(body.holding_n(body.supports[1], x).x(), expected, 1e-6) << l0;
            EXPECT_LT((x - body.rest).cwiseAbs().maxCoeff(), 1e-9);
        }
}

/// The length and width at which the stresses of the solid and the fibres cancel, by bisection.
std::pair<double, double> free_shortening(double a) {
    const muscle::MuscleCurves curves = muscle::zajac_curves();
    const auto slopes = [&](double l, double w) {
        const double j = l * w * w, i1 = l * l + 2 * w * w, c = 0.5 * kBellyShear_pa;
        const double volume = kBellyBulk_pa * (j - 1) - 2.0 / 3 * c * i1 * std::pow(j, -5.0 / 3);
        const double scale = 2 * c * std::pow(j, -2.0 / 3);
        const double fibres =
            kBellyTension_pa * (a * curves.active.value(l) + curves.passive.value(l));
        return std::pair(scale * l + volume * w * w + fibres, scale * w + volume * l * w);
    };
    const auto width = [&](double l) {
        double low = 0.5, high = 3;
        while (high - low > 1e-13) {
            const double middle = 0.5 * (low + high);
            (slopes(l, middle).second > 0 ? high : low) = middle;
        }
        return low;
    };
    double low = 0.35, high = 1.2;
    while (high - low > 1e-13) {
        const double middle = 0.5 * (low + high);
        (slopes(middle, width(middle)).first > 0 ? high : low) = middle;
    }
    return {low, width(low)};
}

TEST_F(MeshMuscles, ShortenFreelyAsTheEquilibriumOfOneFibre) {
    write_belly({4, 1, 1});
    for (const double a : {0.02, 0.1, 1.0}) {
        const SoftBody body =
            build(belly("{\"activation\": " + std::to_string(a) + ", " + kSliding + "}"));
        const Points x = settled(body);
        const auto [length, width] = free_shortening(a);
        EXPECT_LT(length, 0.995);
        EXPECT_NEAR(body.muscles[0]->mean_stretch(x), length, 1e-6) << a;
        const Points expected = body.rest * Vec3(length, width, width).asDiagonal().toDenseMatrix();
        EXPECT_LT((x - expected).cwiseAbs().maxCoeff(), 1e-7) << a;
        EXPECT_LT(body.holding_n(body.supports[0], x).norm(), 1e-5);
    }
}

// The same belly held at one end: as tetrahedra and as cells with a Musculotendon.
TEST_F(MeshMuscles, ShortenAsTheSameMuscleInCells) {
    write_belly({16, 4, 4});
    const SoftBody tets = build(belly(
        R"({"activation": 0.002, "fixed": [{"low_m": [-1, -1, -1], "high_m": [0.0001, 1, 1]}]})"));
    const Points x = settled(tets);
    const Json json = Json::parse(R"({"grid": [17, 5, 5], "section": "block", "length_m": 0.04,
        "width_m": 0.01, "thickness_m": 0.01, "insertion": "free",
        "moduli": {"shear_pa": 20000, "bulk_pa": 500000, "density_kg_per_m3": 1060},
        "musculotendon": {"f0_n": 30, "optimal_length_m": 0.04, "tendon": "rigid"}})");
    MuscleBody cells = build_muscle(read_muscle(JsonCursor::from_json(json, "muscle")),
                                    {.activation = [](double) { return 0.002; }});
    const Points y = settled(cells.body);
    /// Mean motion of a section, weighted by the area around its nodes.
    const auto section = [](const Points& rest, const Points& at, double x_m) {
        const Vec3 low = rest.colwise().minCoeff(), high = rest.colwise().maxCoeff();
        double sum = 0, area = 0;
        for (Eigen::Index i = 0; i < rest.rows(); ++i) {
            if (std::abs(rest(i, 0) - x_m) > 1e-4) continue;
            double weight = 1;
            for (int k = 1; k < 3; ++k)
                if (std::abs(rest(i, k) - low[k]) < 1e-6 || std::abs(rest(i, k) - high[k]) < 1e-6)
                    weight /= 2;
            sum += weight * (rest(i, 0) - at(i, 0));
            area += weight;
        }
        return sum / area;
    };
    const auto motion = [&](double x_m) {
        return std::pair(section(tets.rest, x, x_m), section(cells.body.rest, y, x_m));
    };
    // Small strains, for which the laws of tetrahedra and cells are the same. Linear tetrahedra are stiff beside the held end.
    const auto [tets_at_10, cells_at_10] = motion(0.01);
    const auto [tets_at_30, cells_at_30] = motion(0.03);
    const auto [tets_end, cells_end] = motion(0.04);
    EXPECT_NEAR(tets_at_30 - tets_at_10, cells_at_30 - cells_at_10, 2.5e-6);  // of 0.203 mm
    EXPECT_NEAR(tets_end, cells_end, 0.02e-3);                                // of 0.395 mm
    EXPECT_GT(cells_end, 0.35e-3);
}

TEST_F(MeshMuscles, TakeTheirFibresFromTheFile) {
    write_belly({3, 1, 1});
    const SoftBody given = build(belly(R"({"activation": 1})"));
    const Points x = given.rest * Vec3(0.9, 1.2, 1).asDiagonal().toDenseMatrix();
    const auto energy = [&](const SoftBody& body) { return body.muscles[0]->energy(0, x); };
    const auto from_file = [&](const std::string& data) {
        write_belly({3, 1, 1}, data);
        return energy(build(belly(R"({"activation": 1})", R"({"fibres": null})")));
    };
    const Eigen::Index tets = block_.tets.rows(), nodes = block_.rest.rows();
    EXPECT_NEAR(from_file(vectors("CELL_DATA", tets, "-3 0 0")), energy(given), 1e-15);
    // Directions of points may point either way.
    std::string either = vectors("POINT_DATA", nodes, "-3 0 0");
    either.replace(either.rfind("-3 0 0"), 6, "3 0 0");
    EXPECT_NEAR(from_file(either), energy(given), 1e-15);
    EXPECT_GT(std::abs(from_file(vectors("CELL_DATA", tets, "0 1 0")) - energy(given)), 1e-3);
    const SoftBody computed = build(belly(R"({"activation": 1})", R"({"fibres": {"along": null,
        "from": {"low_m": [-1, -1, -1], "high_m": [0.0001, 1, 1]},
        "to": {"low_m": [0.0399, -1, -1], "high_m": [1, 1, 1]}}})"));
    EXPECT_NEAR(energy(computed), energy(given), 1e-12);
}

TEST_F(MeshMuscles, SayWhatIsWrong) {
    write_belly({2, 1, 1});
    const auto muscle = [&](const std::string& more) { return complaint(belly("{}", more)); };
    EXPECT_EQ(muscle(R"({"tension_pa": 0})"),
              "body:/materials/0/muscle/tension_pa: expected a number in (0, inf), found 0");
    EXPECT_EQ(muscle(R"({"fibres": null})"),
              "body:/materials/0/muscle: expected \"fibres\", or a mesh with a field \"fibre\", "
              "found neither");
    const std::string first = R"({"low_m": [-1, -1, -1], "high_m": [0.0001, 1, 1]})",
                      last = R"({"low_m": [0.0399, -1, -1], "high_m": [1, 1, 1]})",
                      all = R"({"low_m": [-1, -1, -1], "high_m": [1, 1, 1]})",
                      half = R"({"low_m": [-1, -1, -1], "high_m": [0.021, 1, 1]})",
                      nowhere = R"({"low_m": [1, 1, 1], "high_m": [2, 2, 2]})";
    const auto flow = [&](const std::string& from, const std::string& to) {
        return muscle("{\"fibres\": {\"along\": null, \"from\": " + from + ", \"to\": " + to +
                      "}}");
    };
    EXPECT_EQ(flow(first, last), "no error");
    EXPECT_EQ(
        flow(nowhere, last),
        "body:/materials/0/muscle/fibres/from: expected a box with nodes of the muscle in it, "
        "found none");
    EXPECT_EQ(flow(first, all),
              "body:/materials/0/muscle/fibres: expected boxes without a node of both, found one");
    EXPECT_EQ(
        flow(half, last),
        "body:/materials/0/muscle/fibres: expected a muscle whose tetrahedra are all joined to "
        "both boxes, and lie in none of them with all corners, found others");
    EXPECT_EQ(complaint(belly(R"({"activation": [0.1, 0.2]})")),
              "body:/activation: expected as many numbers as materials are muscles, 1, found 2");
    EXPECT_EQ(complaint(belly(R"({"activation": 2})")),
              "body:/activation: expected [0, 1], found 2");
    EXPECT_EQ(complaint(belly(R"({"fixed": [{"low_m": [0, 0, 0], "high_m": [1, 1, 1],
                                             "axes": "xx"}]})")),
              "body:/fixed/0/axes: expected some of the letters x, y and z, each once, found "
              "\"xx\"");
    write_belly({2, 1, 1}, vectors("CELL_DATA", 12, "0 0 0"));
    EXPECT_EQ(muscle(R"({"fibres": null})"),
              "body:/materials/0/muscle: expected a field with a direction in every tetrahedron of "
              "the muscle, found none in tetrahedron 1");
}

}  // namespace
}  // namespace risorius::softbody
