// SPDX-License-Identifier: MIT
// Lets a volume-preserving cube hang from its ceiling and prints how its volume and its lowest node move.
//
//   soft_body
#include "risorius/softbody/soft_body.h"

#include <cstdio>
#include <nlohmann/json.hpp>

#include "risorius/core/error.h"
#include "risorius/solve/integrator.h"

using namespace risorius;

int main() try {
    // The format is that of "body" in an experiment file; it may come from a file as well
    const softbody::BodyDescription description =
        softbody::read_body(JsonCursor::from_json(Json::parse(R"({
            "kind": "solid", "discretisation": "cells", "grid": [7, 7, 7],
            "rest": {"block_m": [0.3, 0.3, 0.3]},
            "material": {"young_pa": 20000, "poisson_ratio": 0.45, "density_kg_per_m3": 1000,
                         "viscosity_pa_s": 20},
            "fixed": [{"a3": "last"}]
        })"),
                                                  "cube"));
    const softbody::SoftBody body = softbody::build_body(description);
    const auto integrator =
        solve::make_integrator({.method = solve::Method::kImplicitEuler, .step_s = 1.0 / 60});

    solve::MotionState state = body.start();
    const double volume = body.volume(state.x);
    std::printf("time_s\tlowest_mm\tvolume_percent\n");
    for (int frame = 0; frame <= 60; frame += 6) {
        if (frame > 0) integrator->advance(body.system, state, frame / 60.0);
        std::printf("%.1f\t%.2f\t%.2f\n", state.t_s, 1e3 * state.x.col(2).minCoeff(),
                    100 * body.volume(state.x) / volume);
    }
} catch (const Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
} catch (const RunError& error) {  // not the input: a full disk, no OpenGL
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
}
