// SPDX-License-Identifier: MIT
// Simulates a smile and draws it: a rig and activations in, a PNG out.
//
//   face_to_picture smile.png
#include <cstdio>

#include "risorius/core/data_folder.h"
#include "risorius/core/error.h"
#include "risorius/face/face.h"
#include "risorius/face/surfaces.h"
#include "risorius/media/image_file.h"
#include "risorius/render/offscreen_view.h"
#include "risorius/scene/rig_files.h"
#include "risorius/scene/scene_from_rig.h"

using namespace risorius;

int main(int argc, char** argv) try {
    // The adult that comes with the library; a rig of your own is a path of your own
    const auto files = scene::read_rig_files(data_folder() / "rigs/adult/rig.json");
    face::Face face(files.rig, files.mesh, face::quality_named("preview"), files.place());

    // Both zygomatici at 70 %
    const track::ChannelTable channels = files.rig.channels();
    track::Drive drive;
    drive.excitation = Eigen::VectorXd::Zero(channels.column_count());
    for (const Side side : {Side::kLeft, Side::kRight})
        drive.excitation[channels.column("zygomaticus_major", side)] = 0.7;

    // One second in time steps, so that the face has nearly come to rest
    face.start([](double) { return track::Drive{}; });
    const face::FacePose pose = face.pose_at(1.0, [&](double) { return drive; });
    const Vec3 corner = pose.vertices.row(files.rig.landmarks.at("ch_l").vertex).transpose();
    std::printf("left corner of the mouth: %.1f %.1f %.1f mm\n", 1e3 * corner.x(), 1e3 * corner.y(),
                1e3 * corner.z());

    render::Scene scene = scene::scene_from_rig(face.head(), files.rig, files.mesh);
    scene::add_wrinkles(face.surfaces().wrinkle_lines(), scene);
    render::OffscreenView view(scene, {.width_px = 512, .height_px = 512});
    media::write_png(view.draw(scene::pose_for_view(pose)), argc > 1 ? argv[1] : "smile.png");
} catch (const Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
} catch (const RunError& error) {  // not the input: a full disk, no OpenGL
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
}
