// What a run was made of and how it went: enough to make the same frames again and to tell whether they are the same.
// Written as OUT.json. All that may differ between two runs of one script is under "timing".
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "risorius/core/json_cursor.h"
#include "risorius/face/face.h"

namespace risorius::animate {

/// How the solver did over a run.
struct SolverStats {
    int steps = 0;
    double mean_iterations = 0;
    int max_iterations = 0;
    double converged_share = 0;           ///< of the steps that reached their tolerance, ratio
    double largest_last_step_rms_mm = 0;  ///< movement of the nodes in the last iteration of a step
    double deepest_contact_mm = 0;        ///< penetration left
    double largest_muscle_volume_error = 0;  ///< of the volume muscles, ratio
    int most_inverted_tets = 0;              ///< in any frame
};
SolverStats solver_figures(const std::vector<face::StepStats>& history, int most_inverted_tets);

struct RunTiming {
    int threads = 1;
    double build_s = 0, simulate_s = 0, draw_s = 0, encode_s = 0, total_s = 0;
};

struct RunRecord {
    struct File {
        std::filesystem::path path;
        std::string sha256;
    };
    File script, rig, mesh;
    std::optional<File> shapes;    ///< that have played the script in place of the simulation
    std::vector<File> tables;      ///< files that the rig names
    std::vector<File> recordings;  ///< and that the script does
    std::filesystem::path out;
    int seed = 1;
    int fps = 60, frames = 0, width_px = 0, height_px = 0;
    double first_frame_s = 0;  ///< 0 but for a still
    std::string camera, show, background;
    std::optional<double> scale_to;  ///< where the colours of strain (ratio) or error (mm) end
    double shutter_deg = 0;
    int shutter_moments = 1;  ///< averaged in a frame
    std::string graphics;     ///< render::gl_in_use()
    std::string quality;
    int antialiasing = 2;        ///< samples per pixel and side
    std::string jaw;             ///< what moves it
    double widest_jaw_mm = 0;    ///< at the incisors, of any frame
    double greatest_bite_n = 0;  ///< of all teeth, when muscles move the jaw
    int nodes = 0, tets = 0, dropped_tets = 0, fibres = 0;
    SolverStats solver;
    std::string frames_sha256;  ///< over the RGBA bytes of all frames, before encoding
    std::vector<std::string> warnings;
    RunTiming timing;

    Json json() const;
};

}  // namespace risorius::animate
