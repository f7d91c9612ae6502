// SPDX-License-Identifier: MIT
// Bodies whose shape is a mesh from a file: closed forms, regions, and what is said of mistakes.
#include "risorius/softbody/mesh_body.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "message_of.h"
#include "risorius/solve/integrator.h"
#include "risorius/tissue/hyperelastic_tets.h"
#include "temporary_folder.h"

namespace risorius::softbody {
namespace {

class MeshBodies : public testing::Test {
  protected:
    /// A column of 1 x 1 x `cells` cubes of six tetrahedra each, upright, as a file of Medit. The upper half has the tag 2.
    void write_column(int cells) const {
        std::ofstream out(folder_ / "column.mesh");
        out << "MeshVersionFormatted 2\nDimension 3\nVertices\n" << 4 * (cells + 1) << "\n";
        for (int k = 0; k <= cells; ++k)
            for (int i = 0; i < 4; ++i) out << i / 2 << " " << i % 2 << " " << k << " 0\n";
        out << "Tetrahedra\n" << 6 * cells << "\n";
        const int paths[6][3] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}};
        for (int cell = 0; cell < cells; ++cell)
            for (int p = 0; p < 6; ++p) {
                int at[3] = {0, 0, cell}, node[4];
                node[0] = 4 * cell + 1;
                for (int step = 0; step < 3; ++step) {
                    ++at[paths[p][step]];
                    node[step + 1] = 4 * at[2] + 2 * at[0] + at[1] + 1;
                }
                if (p >= 3) std::swap(node[2], node[3]);
                for (const int n : node) out << n << " ";
                out << (2 * cell >= cells ? 2 : 1) << "\n";
            }
    }
    /// The surface of 1 x 1 x `cells` cubes, facing outward.
    void write_box(int cells) const {
        std::ofstream out(folder_ / "box.obj");
        for (int i = 0; i < 8; ++i)
            out << "v " << (i & 1) << " " << (i >> 1 & 1) << " " << (i >> 2) * cells << "\n";
        out << "f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n";
    }
    Json column(const std::string& more = "{}") const {
        Json json = Json::parse(R"({"kind": "mesh", "gravity_m_per_s2": [0, 0, 0],
            "materials": [{"law": "mooney-rivlin", "c10_pa": 300, "c01_pa": 100, "bulk_pa": 40000,
                           "density_kg_per_m3": 1000}]})");
        json["mesh"] =
            Json{{"file", (folder_ / "column.mesh").string()}, {"metres_per_unit", 0.01}};
        json.update(Json::parse(more));
        Json& mesh = json["mesh"];
        if (mesh.contains("surface"))
            mesh["surface"] = (folder_ / mesh["surface"].get<std::string>()).string();
        return json;
    }
    SoftBody build(const Json& json) const {
        return build_mesh_body(read_mesh_body(JsonCursor::from_json(json, "body")));
    }
    std::string complaint(const std::string& more) const {
        std::string text = message_of([&] { build(column(more)); });
        const std::string here = folder_.path().string() + "/";
        for (std::size_t at; (at = text.find(here)) != std::string::npos;)
            text.erase(at, here.size());
        return text;
    }

    TemporaryFolder folder_;
};

TEST_F(MeshBodies, HaveTheVolumeMassAndSurfaceOfTheirMesh) {
    write_column(4);
    const SoftBody body = build(column(R"({"gravity_m_per_s2": [0, 0, -10]})"));
    EXPECT_NEAR(body.volume(body.rest), 4e-6, 1e-18);
    EXPECT_NEAR(body.system.mass_kg().sum(), 4e-3, 1e-15);
    EXPECT_NEAR(body.weight_n, 0.04, 1e-14);
    EXPECT_EQ(body.surface.rows(), 2 * (4 * 4 + 2));
    double enclosed = 0;  // by surfaces that face outward
    for (Eigen::Index f = 0; f < body.surface.rows(); ++f) {
        const auto at = [&](int k) { return Vec3(body.rest.row(body.surface(f, k)).transpose()); };
        enclosed += at(0).dot(at(1).cross(at(2))) / 6;
    }
    EXPECT_NEAR(enclosed, 4e-6, 1e-18);
    EXPECT_EQ(body.grid.size(), 0);
}

// A bar pulled to the stretch l: the force on its ends is the area times the nominal stress, (s11 - s22) / l for a material that keeps its
// volume. Here it changes it by 0.04 %.
TEST_F(MeshBodies, PullAsTheirLawSays) {
    write_column(2);
    const std::pair<const char*, double (*)(double)> laws[] = {
        {R"("law": "neo-hookean", "c10_pa": 400)",
         [](double l) { return 800 * (l - 1 / (l * l)); }},
        {R"("law": "mooney-rivlin", "c10_pa": 300, "c01_pa": 100)",
         [](double l) { return 2 * (l - 1 / (l * l)) * (300 + 100 / l); }},
        {R"("law": "ogden", "terms": [[630, 1.3], [1.2, 5], [-10, -2]])",
         [](double l) {
             return 630 * (std::pow(l, 0.3) - std::pow(l, -1.65)) +
                    1.2 * (std::pow(l, 4) - std::pow(l, -3.5)) - 10 * (std::pow(l, -3) - 1);
         }},
        {R"("law": "fibres", "c10_pa": 400, "c3_pa": 150, "c4": 6.6, "c5_pa": 15000, "straight": 1.4,
            "along": [0, 0, 2])",
         [](double l) { return 800 * (l - 1 / (l * l)) + 150 * std::expm1(6.6 * (l - 1)) / l; }}};
    for (const auto& [law, nominal_pa] : laws) {
        SoftBody body = build(column(std::string(R"({"materials": [{)") + law +
                                     R"(, "bulk_pa": 1000000, "density_kg_per_m3": 1000}]})"));
        // The sides are free: the state of least energy at this stretch.
        const double l = 1.3;
        const auto stretched = [&](double across) {
            return Points(body.rest * Vec3(across, across, l).asDiagonal().toDenseMatrix());
        };
        double low = 0.85, high = 0.9;
        while (high - low > 1e-9) {
            const double one = low + (high - low) / 3, other = high - (high - low) / 3;
            if (body.system.energy(0, stretched(one)) < body.system.energy(0, stretched(other)))
                high = other;
            else
                low = one;
        }
        const Points x = stretched(low);
        Points force = Points::Zero(x.rows(), 3);
        body.system.force(0, x, Points::Zero(x.rows(), 3), force);
        double pull = 0;
        for (Eigen::Index i = 0; i < x.rows(); ++i)
            if (body.rest(i, 2) == 0) pull += force(i, 2);
        EXPECT_NEAR(pull, 1e-4 * nominal_pa(l), 0.003e-4 * nominal_pa(l)) << law;
    }
}

TEST_F(MeshBodies, HangFromTheirFixedNodesAndStretch) {
    write_column(4);
    const SoftBody body = build(column(R"({"gravity_m_per_s2": [0, 0, -9.81],
        "fixed": [{"low_m": [-1, -1, 0.0399], "high_m": [1, 1, 1]}]})"));
    EXPECT_EQ(body.fixed.size(), 4u);
    solve::MotionState state = body.start();
    solve::make_integrator(
        {.method = solve::Method::kQuasiStatic, .length_scale_m = body.length_scale_m})
        ->advance(body.system, state, 1);
    // w L^2 / (2 E) = 9810 * 0.04^2 / (2 * 2400) = 3.3 mm for a bar that keeps its volume; the clamped end holds some of it
    const double sag = -state.x.col(2).minCoeff();
    EXPECT_GT(sag, 2.2e-3);
    EXPECT_LT(sag, 3.6e-3);
}

TEST_F(MeshBodies, TakeTheMaterialOfTheirTag) {
    write_column(4);
    const SoftBody body = build(column(R"({"materials": [
        {"law": "neo-hookean", "c10_pa": 400, "bulk_pa": 4000, "density_kg_per_m3": 1000},
        {"tags": [2], "law": "neo-hookean", "c10_pa": 900, "bulk_pa": 4000, "density_kg_per_m3": 3000}]})"));
    EXPECT_NEAR(body.system.mass_kg().sum(), 2e-3 + 6e-3, 1e-15);
    const tissue::HyperelasticBody& matter = body.tets->body();
    for (Eigen::Index t = 0; t < matter.tets.rows(); ++t)
        EXPECT_EQ(matter
                      .materials[static_cast<std::size_t>(
                          matter.material_of[static_cast<std::size_t>(t)])]
                      .c10_pa,
                  t < 12 ? 400 : 900);
}

// A column of 1 x 1 x 10 cm as a surface, with nu = 0: it hangs by rho g L^2 / (2 E), with E = 2 mu.
TEST_F(MeshBodies, FillASurfaceAndHangAsTheClosedForm) {
    write_box(10);
    const SoftBody body = build(column(R"({"mesh": {"surface": "box.obj", "spacing_m": 0.005,
        "metres_per_unit": 0.01}, "gravity_m_per_s2": [0, 0, -9.81],
        "materials": [{"law": "neo-hookean", "c10_pa": 50000, "bulk_pa": 66666.67,
                       "density_kg_per_m3": 1000}],
        "fixed": [{"low_m": [-1, -1, 0.0999], "high_m": [1, 1, 1]}]})"));
    EXPECT_NEAR(body.volume(body.rest), 1e-5, 1e-17);
    EXPECT_EQ(body.rest.rows(), 3 * 3 * 21);
    solve::MotionState state = body.start();
    solve::make_integrator(
        {.method = solve::Method::kQuasiStatic, .step_s = 1, .length_scale_m = body.length_scale_m})
        ->advance(body.system, state, 1);
    double lower = 0;
    int count = 0;
    for (Eigen::Index i = 0; i < body.rest.rows(); ++i)
        if (body.rest(i, 2) == 0) {
            lower += body.rest(i, 2) - state.x(i, 2);
            ++count;
        }
    EXPECT_EQ(count, 9);
    EXPECT_NEAR(lower / count, 1000 * 9.81 * 0.01 / (2 * 200000), 0.01 * 2.4525e-4);
}

TEST_F(MeshBodies, SayWhatIsWrongWithASurface) {
    write_box(1);
    const auto with = [&](const std::string& mesh) {
        return complaint(R"({"mesh": {"metres_per_unit": 1, )" + mesh + "}}");
    };
    EXPECT_EQ(
        with(R"("surface": "box.obj", "spacing_m": 0.001)"),
        "body:/mesh/spacing_m: expected at most 400000 cubes around the surface, found 0.001");
    EXPECT_EQ(with(R"("surface": "box.obj")"),
              "body:/mesh: expected the key \"spacing_m\", found none");
    std::ofstream(folder_ / "open.obj") << "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\n";
    EXPECT_EQ(
        with(R"("surface": "open.obj", "spacing_m": 0.1)"),
        "body:/mesh/surface: expected a closed surface with two polygons at every edge, found "
        "\"open.obj\"");
    std::ofstream(folder_ / "turned.obj")
        << "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 4 2\nf 2 4 3\nf 1 3 4\n";
    EXPECT_EQ(with(R"("surface": "turned.obj", "spacing_m": 0.1)"),
              "body:/mesh/surface: expected a surface that faces outward, found \"turned.obj\"");
}

TEST_F(MeshBodies, SayWhatIsWrong) {
    write_column(2);
    const std::string law =
        R"("law": "neo-hookean", "c10_pa": 1, "bulk_pa": 9, "density_kg_per_m3": 1)";
    EXPECT_EQ(complaint(R"({"materials": [{"tags": [1], )" + law + "}]}"),
              "body:/materials: expected a material for every tag, found none for 2");
    EXPECT_EQ(complaint(R"({"materials": [{"tags": [1, 3], )" + law + "}]}"),
              "body:/materials/0: expected tags of column.mesh, found 3");
    EXPECT_EQ(complaint(R"({"materials": [{"tags": [1], )" + law + R"(}, {"tags": [2, 1], )" + law +
                        "}]}"),
              "body:/materials/1: expected tags that no other material has, found 1");
    EXPECT_EQ(complaint(R"({"materials": [{)" + law + "}, {" + law + "}]}"),
              "body:/materials/1: expected \"tags\" or \"names\" in all materials but one, found "
              "neither");
    EXPECT_EQ(complaint(R"({"materials": [{"law": "neo-hookean", "c10": 1}]})"),
              "body:/materials/0: expected the key \"c10_pa\", found none");
    EXPECT_EQ(complaint(R"({"materials": [{"law": "ogden", "terms": [[1, -2]], "bulk_pa": 1}]})"),
              "body:/materials/0/terms/0: expected a modulus and an exponent with the same sign, "
              "neither 0, found [1,-2]");
    EXPECT_EQ(complaint(R"({"fixed": [{"low_m": [1, 1, 1], "high_m": [2, 2, 2]}]})"),
              "body:/fixed/0: expected a box with nodes in it, found none");
    EXPECT_EQ(complaint(R"({"mesh": {"file": "no_such.msh"}})"),
              "body:/mesh/file: expected an existing file, found \"no_such.msh\"");
}

}  // namespace
}  // namespace risorius::softbody
