// SPDX-License-Identifier: MIT
/// \file
/// The record of a run: its inputs with their checksums, its settings and statistics of the solver. From it, the same frames can
/// be made again and compared. It is written as OUT.json. Only "timing" may differ between two runs of one script.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "risorius/core/json_cursor.h"
#include "risorius/face/step_stats.h"

namespace risorius::animate {

/// A file that was read, and the SHA-256 of its bytes.
struct InputFile {
    std::filesystem::path path;
    std::string sha256;
};

/// Solver statistics of a run. Maxima are over all steps unless stated otherwise.
struct SolverStats {
    int steps = 0;
    double mean_iterations = 0;
    int max_iterations = 0;
    double converged_fraction = 0;    ///< fraction of the steps that reached their tolerance
    double max_last_step_rms_mm = 0;  ///< RMS motion of the nodes in the last iteration of a step
    double max_contact_depth_mm = 0;  ///< penetration that is left at the end of a step
    /// Relative error of the volume of a muscle that is simulated as a solid
    double max_muscle_volume_error = 0;
    int max_inverted_tets = 0;  ///< number of inverted tetrahedra, maximum over the frames
};
SolverStats solver_stats(const std::vector<face::StepStats>& history, int max_inverted_tets);

/// Wall-clock times.
struct RunTiming {
    int threads = 1;
    double build_s = 0, simulate_s = 0, draw_s = 0, encode_s = 0, total_s = 0;
};

/// The content of OUT.json.
struct RunRecord {
    InputFile script, rig, mesh;
    std::optional<InputFile> shapes;    ///< the blend shapes, when they played the script
    std::vector<InputFile> tables;      ///< other files that the rig names
    std::vector<InputFile> recordings;  ///< files that the script names
    std::filesystem::path out;
    int seed = 1;
    int fps = 60, frames = 0, width_px = 0, height_px = 0;
    double first_frame_s = 0;  ///< 0 except for a still, a turntable and given times
    std::string camera, show, background;
    std::optional<double> scale_to;  ///< where the colours of strain (ratio) or error (mm) end
    double shutter_deg = 0;
    int shutter_moments = 1;  ///< number of moments that are averaged per frame
    std::string graphics;     ///< render::gl_in_use()
    std::string quality;
    double step_s = 0;              ///< of the simulation, s
    int antialiasing = 2;           ///< samples per pixel and side
    std::string jaw;                ///< what moves the jaw: "channels" or "muscles"
    double max_jaw_opening_mm = 0;  ///< between the incisors, over all frames
    double max_tooth_force_n = 0;   ///< on all teeth together, when muscles move the jaw
    int nodes = 0, tets = 0, dropped_tets = 0, fibres = 0;
    SolverStats solver;
    std::string out_sha256;     ///< of the file OUT; empty for a folder of frames
    std::string frames_sha256;  ///< of the RGBA bytes of all frames, before encoding
    std::vector<std::string> warnings;
    RunTiming timing;

    Json json() const;
};

}  // namespace risorius::animate
