// SPDX-License-Identifier: MIT
// Steps a smiling face and prints what a biomechanist asks for; then writes the last pose as a mesh.
//
//   face_numbers smile.obj
#include <algorithm>
#include <cstdio>

#include "risorius/core/data_folder.h"
#include "risorius/core/error.h"
#include "risorius/face/diagnostics.h"
#include "risorius/face/face.h"
#include "risorius/io/read_mesh.h"
#include "risorius/rig/expression_drive.h"
#include "risorius/scene/rig_files.h"

using namespace risorius;

int main(int argc, char** argv) try {
    scene::RigFiles files = scene::read_rig_files(data_folder() / "rigs/adult/rig.json");
    face::Face face(files.rig, files.mesh, face::quality_named("video"), files.place());
    const track::ChannelTable channels = files.rig.channels();

    // The expression rises for half a second and is held
    const face::DriveAt drive = [&](double t_s) {
        const double intensity = std::clamp(t_s / 0.5, 0.0, 1.0);
        return rig::clamped_drive(rig::expansion_at(files.rig, "happiness", intensity).value(),
                                  channels);
    };

    std::puts("t_s\tcorner_y_mm\tlength_mm\tforce_n\tstress_kpa\tenergy_mj");
    face.start(drive);
    while (face.time_s() < 1.0) {
        face.step(drive);
        const face::Diagnostics measured = face.diagnostics();
        const auto muscle = measured.muscle_state("zygomaticus_major", Side::kLeft).value();
        std::printf("%.4f\t%.3f\t%.3f\t%.4f\t%.2f\t%.3f\n", face.time_s(),
                    1e3 * measured.landmark("ch_l").y(), 1e3 * muscle.length_m, muscle.force_n,
                    1e-3 * muscle.stress_pa.value(), 1e3 * measured.energy_j());
    }

    // The pose is in metres in the head frame; write_obj() converts to the unit of the rig's mesh
    files.mesh.positions = face.pose().vertices;
    io::write_obj(files.mesh, argc > 1 ? argv[1] : "smile.obj", files.rig.metres_per_unit);
} catch (const Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
} catch (const RunError& error) {  // not the input: a full disk, no OpenGL
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
}
