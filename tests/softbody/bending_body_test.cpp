// SPDX-License-Identifier: MIT
// Bodies of bending cells from their description.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "message_of.h"
#include "risorius/softbody/soft_body.h"
#include "risorius/solve/integrator.h"

namespace risorius::softbody {
namespace {

Json beam(const std::string& more = "{}") {
    Json json =
        Json::parse(R"({"kind": "solid", "discretisation": "bending-cells", "grid": [11, 2, 2],
        "rest": {"block_m": [1, 0.1, 0.1]}, "fixed": [{"a1": "first"}], "gravity_m_per_s2": [0, 0, -1e-5],
        "material": {"young_pa": 1000, "poisson_ratio": 0.3, "density_kg_per_m3": 1000}})");
    json.update(Json::parse(more));
    return json;
}

SoftBody built(const Json& json) {
    return build_body(read_body(JsonCursor::from_json(json, "body")));
}

// Weights P on the nodes, which all have the same mass, at x: w = sum P (x^2 (3 L - x) / (6 E I) + x / (k G A)); one cell across
TEST(BendingBodies, SagAsABeamUnderItsWeight) {
    const SoftBody body = built(beam());
    solve::MotionState state = body.start();
    solve::make_integrator({.method = solve::Method::kQuasiStatic, .length_scale_m = 1})
        ->advance(body.system, state, 1);
    const double inertia = 1e-4 / 12, shear = 1000 / 2.6, shape = 13 / (12 + 11 * 0.3);
    double sag = 0;
    for (int i = 0; i <= 10; ++i) {
        const double x = 0.1 * i;
        sag += 1e-4 / 11 * (x * x * (3 - x) / (6 * 1000 * inertia) + x / (shape * shear * 0.01));
    }
    // The clamp takes a percent.
    EXPECT_NEAR((body.rest.bottomRows(4).col(2) - state.x.bottomRows(4).col(2)).mean(), sag,
                0.02 * sag);
}

TEST(BendingBodies, SayWhatTheyCannotHave) {
    const auto complaint = [](const std::string& more) {
        return message_of([&] { built(beam(more)); });
    };
    EXPECT_EQ(complaint(R"({"material": {"young_pa": 1000, "poisson_ratio": 0.3,
                                         "density_kg_per_m3": 1000, "viscosity_pa_s": 1}})"),
              "body:/material/viscosity_pa_s: expected 0 for bending cells, found 1");
    EXPECT_EQ(complaint(R"({"material": {"mass_kg": 4, "elastic_n_per_m3": 1.5,
                                         "incompressibility_n_per_m5": 10}})"),
              "body:/discretisation: expected moduli as material, and no regions, for bending "
              "cells, found \"bending-cells\"");
}

}  // namespace
}  // namespace risorius::softbody
