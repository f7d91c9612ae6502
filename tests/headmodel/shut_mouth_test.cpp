// SPDX-License-Identifier: MIT
// The shut mouth of a person with full lips, which roll in: nothing behind the head shows between them.
#include <gtest/gtest.h>

#include "risorius/headmodel/sculpt_head.h"
#include "risorius/render/offscreen_view.h"
#include "risorius/rig/head.h"
#include "risorius/scene/rig_files.h"
#include "risorius/scene/scene_from_rig.h"
#include "temporary_folder.h"

namespace risorius::headmodel {
namespace {

TEST(ShutMouth, NothingBehindTheHeadShowsBetweenTheLips) {
    const TemporaryFolder folder;
    sculpt_head({.out = folder / "imani", .identity = chosen_identity({.identity = "imani"})});
    const scene::RigFiles files = scene::read_rig_files(folder / "imani/rig.json");
    const render::Scene scene = scene::scene_from_rig(
        rig::place_head(files.rig, files.mesh, files.place()), files.rig, files.mesh);
    render::Pose pose;
    pose.positions = scene.rest;
    const Vec3 left = scene.landmarks.at("ch_l"), right = scene.landmarks.at("ch_r"),
               middle = scene.landmarks.at("sto");
    // At 512 pixels the skin is shaded once per pixel, and cracks of the lips are narrower than that.
    for (const char* camera : {"front", "three_quarter"})
        for (const int side : {256, 512}) {
            render::OffscreenView view(scene, {.width_px = side,
                                               .height_px = side,
                                               .camera = camera,
                                               .background = {.transparent = true}});
            const Image picture = view.draw(pose);
            int seen = 0, open = 0;
            // The far corner may lie on the outline of the head, so the line ends before both.
            for (const Vec3& corner : {left, right})
                for (int i = 0; i <= 200; ++i) {
                    const Vec2 at = view.project(middle + 0.004 * i * (corner - middle));
                    for (int dy = -side / 128; dy <= side / 128; ++dy) {
                        const auto x = static_cast<int>(at.x()), y = static_cast<int>(at.y()) + dy;
                        ++seen;
                        if (picture.pixel(x, y)[3] < 255) ++open;
                    }
                }
            EXPECT_GT(seen, 1000);
            EXPECT_EQ(open, 0) << camera << " " << side;
        }
}

}  // namespace
}  // namespace risorius::headmodel
