// SPDX-License-Identifier: MIT
// The embedded head with a material library, as other programs open it.
#include "risorius/headmodel/detail/head_textures.h"

#include <gtest/gtest.h>

#include <fstream>

#include "message_of.h"
#include "risorius/headmodel/detail/head_model.h"
#include "risorius/io/read_mesh.h"
#include "temporary_folder.h"

namespace risorius::headmodel {
namespace {

TEST(HeadTextures, EveryGroupButTheLashesHasAPictureOnAMeshThatStaysTheSame) {
    const TemporaryFolder folder;
    const headmodel::HeadModel model = headmodel::make_head(
        headmodel::read_design_tables(headmodel::models_folder() / "adult/design"));
    headmodel::write_head(model, folder.path(), kTextureLibrary);
    std::ofstream(folder / kTextureLibrary) << texture_library(Vec3(0.25, 0.5, 0.75));
    const geom::PolygonMesh mesh = io::read_mesh(folder / "head.obj"),
                            plain = io::read_mesh(headmodel::models_folder() / "adult/head.obj");
    EXPECT_EQ(mesh.positions, plain.positions);
    EXPECT_EQ(mesh.corner_vertex, plain.corner_vertex);
    EXPECT_EQ(mesh.corner_texcoord, plain.corner_texcoord);
    EXPECT_EQ(mesh.group_names, plain.group_names);
    EXPECT_EQ(mesh.face_group, plain.face_group);
    EXPECT_TRUE(plain.textures.empty());

    ASSERT_EQ(mesh.textures.size(), 5u);
    const std::map<std::string, std::string> picture_of{{"skin", "skin.png"},
                                                        {"mouth", "skin.png"},
                                                        {"eye_l", "eyes.png"},
                                                        {"eye_r", "eyes.png"},
                                                        {"teeth_upper", "teeth.png"},
                                                        {"teeth_lower", "teeth.png"},
                                                        {"gums_upper", "gums.png"},
                                                        {"gums_lower", "gums.png"},
                                                        {"tongue", "tongue.png"},
                                                        {"lashes_l", ""},
                                                        {"lashes_r", ""}};
    for (int f = 0; f < mesh.face_count(); ++f) {
        const auto face = static_cast<std::size_t>(f);
        const int texture = mesh.face_texture[face];
        const std::string picture =
            texture < 0 ? ""
                        : mesh.textures[static_cast<std::size_t>(texture)].file.filename().string();
        ASSERT_EQ(picture,
                  picture_of.at(mesh.group_names[static_cast<std::size_t>(mesh.face_group[face])]));
    }
    EXPECT_NE(bytes_of(folder / kTextureLibrary).find("newmtl lashes_l\nKd 0.25 0.5 0.75\n"),
              std::string::npos);
}

TEST(HeadTextures, SizesBeyondWhatIsUsefulAreRefused) {
    const TemporaryFolder folder;
    for (const int side_px : {255, 4097})
        EXPECT_EQ(message_of([&] { write_head_textures({}, side_px, {}, folder.path()); }),
                  "texture_px: expected 256..4096, found " + std::to_string(side_px));
    EXPECT_EQ(folder.listing(), std::set<std::string>{});
}

}  // namespace
}  // namespace risorius::headmodel
