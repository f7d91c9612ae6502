// SPDX-License-Identifier: MIT
#include "risorius/animate/detail/run_record.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "risorius/core/json_object.h"
#include "risorius/core/toolkit_record.h"

namespace risorius::animate {

SolverStats solver_stats(const std::vector<face::StepStats>& history, int max_inverted_tets) {
    SolverStats out;
    out.steps = static_cast<int>(history.size());
    out.max_inverted_tets = max_inverted_tets;
    int converged = 0;
    for (const face::StepStats& step : history) {
        out.mean_iterations += step.iterations;
        out.max_iterations = std::max(out.max_iterations, step.iterations);
        converged += step.converged;
        out.max_last_step_rms_mm = std::max(out.max_last_step_rms_mm, 1e3 * step.last_step_rms_m);
        out.max_muscle_volume_error =
            std::max(out.max_muscle_volume_error, step.muscle_volume_error);
        out.max_contact_depth_mm = std::max(out.max_contact_depth_mm, 1e3 * step.contact_depth_m);
    }
    if (out.steps > 0) {
        out.mean_iterations /= out.steps;
        out.converged_fraction = static_cast<double>(converged) / out.steps;
    }
    return out;
}

Json RunRecord::json() const {
    const auto file = [](const InputFile& f) {
        return json_object({{"file", f.path.generic_string()}, {"sha256", f.sha256}});
    };
    Json json;
    json["format"] = "risorius-run";
    json["version"] = 1;
    json["toolkit"] = toolkit_record();
    json["synthetic_face"] = true;
    json["out"] = out.generic_string();
    json["script"] = file(script);
    json["rig"] = file(rig);
    json["mesh"] = file(mesh);
    if (shapes) json["shapes"] = file(*shapes);
    json["tables"] = Json::array();
    for (const InputFile& table : tables) json["tables"].push_back(file(table));
    json["recordings"] = Json::array();
    for (const InputFile& recording : recordings) json["recordings"].push_back(file(recording));
    json["seed"] = seed;
    json["fps"] = fps;
    json["frames"] = frames;
    json["first_frame_s"] = first_frame_s;
    json["width_px"] = width_px;
    json["height_px"] = height_px;
    json["camera"] = camera;
    json["show"] = show;
    if (scale_to) json["scale_to"] = *scale_to;
    json["background"] = background;
    json["shutter"] = json_object({{"open_deg", shutter_deg}, {"moments", shutter_moments}});
    json["colour"] = "sRGB values, tagged BT.709 in video files";
    json["graphics"] = graphics;
    json["quality"] = quality;
    json["antialiasing"] = antialiasing;
    json["jaw"] = json_object({{"moved_by", jaw},
                               {"widest_opening_mm", max_jaw_opening_mm},
                               {"greatest_tooth_force_n", max_tooth_force_n}});
    json["step_s"] = step_s;
    json["face"] = json_object(
        {{"nodes", nodes}, {"tets", tets}, {"dropped_tets", dropped_tets}, {"fibres", fibres}});
    json["solver"] = json_object({{"steps", solver.steps},
                                  {"mean_iterations", solver.mean_iterations},
                                  {"max_iterations", solver.max_iterations},
                                  {"converged_share", solver.converged_fraction},
                                  {"largest_last_step_rms_mm", solver.max_last_step_rms_mm},
                                  {"deepest_contact_mm", solver.max_contact_depth_mm},
                                  {"largest_muscle_volume_error", solver.max_muscle_volume_error},
                                  {"most_inverted_tets", solver.max_inverted_tets}});
    json["frames_sha256"] = frames_sha256;
    if (!out_sha256.empty()) json["out_sha256"] = out_sha256;
    json["warnings"] = warnings;
    json["timing"] = json_object({{"threads", timing.threads},
                                  {"build_s", timing.build_s},
                                  {"simulate_s", timing.simulate_s},
                                  {"draw_s", timing.draw_s},
                                  {"encode_s", timing.encode_s},
                                  {"total_s", timing.total_s}});
    return json;
}

}  // namespace risorius::animate
