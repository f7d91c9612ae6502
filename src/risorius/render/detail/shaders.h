// SPDX-License-Identifier: MIT
/// \file
/// Sources of the shader programs, one file per material. Shared parts are in shader_lighting.cpp.
#pragma once

#include <string>

namespace risorius::render {

/// Uniforms of each frame for all programs: the std140 block `Frame` of shader_lighting.cpp, field for field.
struct FrameUniforms {
    float clip_from_world[16];
    float mouth_centre[4];  ///< xyz: centre of the gap between the lips, m; w: its area, m^2
    float mouth_axis[4];    ///< xyz: vector from that centre to the left corner of the mouth, m
    // The following are the same in all frames of a view; programs may have them as constants instead.
    /// From world, m, to texture coordinates and depth of the shadow map, 0..1
    float shadow_from_world[16];
    float shadow_places[4];  ///< x: texels per side of the map; y: m per texel
    float camera[4];         ///< xyz: position, m, world
    float key_direction[4];  ///< xyz: unit vector towards the lamp
    /// rgb: radiance of a white card that faces the lamp (irradiance over pi) times the exposure
    float key_card[4];
    float fill_direction[4];
    float fill_card[4];
    float rim_direction[4];
    float rim_card[4];
    /// rgb: coefficients of the surroundings, see Irradiance, times the exposure
    float irradiance[9][4];
};

/// Texture units.
enum TextureUnit {
    kShadowUnit = 0,
    kPaintUnit = 1,
    kPoreUnit = 2,
    kMuscleColourUnit = 3,
    kMuscleDepthUnit = 4,
    kFibreUnit = 5,
    kMirrorUnit = 6,
    kSkinLayerUnit = 7,
    kOwnColourUnit = 8,
    kOwnPlaceUnit = 9,
    kHairLengthUnit = 10,
    kStrandUnit = 11
};
enum VertexAttribute {
    kPosition = 0,
    kNormal = 1,
    kRest = 2,
    kPaintPlace = 3,  ///< position on the paint map, see paint_place(); for lashes, lash_places()
    kFoldPhase = 5,
    kFoldDepth = 6,
    /// x: fraction of the sky seen at rest; y: 1 inside the mouth; z: curvature at rest, 1/m; w: strength of the pores
    kOcclusion = 4,
    kColour = 7  ///< colour of a value on the skin
};

/// Fraction of the skin in the colour of a pixel where the line of sight is perpendicular to the muscle below; the rest is the
/// muscle.
constexpr double kSkinOverMuscles = 0.16;

/// The vertex shader of every material. `folds`: passes the wrinkles on. `key`: computes the light of the key lamp at the
/// vertices, for draft_skin_shader().
std::string surface_vertex_shader(bool folds = false, bool key = false);
std::string depth_vertex_shader();  ///< shadow map and occlusion
/// Details of the skin that are finer than the mesh.
struct SkinRelief {
    bool folds = false;
    bool pores = true;
};
std::string skin_shader(const SkinRelief& relief);
std::string skin_layer_shader(const SkinRelief& relief);  ///< shaded skin, stored for lookup
std::string draft_skin_shader(bool layer);  ///< lit at its vertices, without pores and wrinkles
std::string clear_vertex_shader();
std::string clear_shader();
std::string lookup_vertex_shader();
std::string lookup_shader();  ///< looks up stored skin
/// Translucent skin over the muscles, which are read from MuscleLayer
std::string veil_shader(const SkinRelief& relief);
std::string values_vertex_shader();
std::string values_shader();  ///< skin that shows a quantity
std::string muscle_vertex_shader();
std::string muscle_shader();
std::string bone_vertex_shader();
std::string bone_shader();  ///< bone and teeth under glassy skin
std::string glass_vertex_shader();
std::string glass_shader();  ///< the glassy skin
// With `own`, the colour comes from the mesh's own texture.
std::string eye_shader(bool own);
std::string cornea_shader();
std::string teeth_shader(bool own);
/// The tongue, or gums and the wall of the mouth.
std::string mucosa_shader(bool tongue, bool own);
std::string matte_shader();
// Materials without light, drawn on their texture coordinates, see part_texture.h. Their colours are linear.
std::string part_texture_vertex_shader();
std::string eye_texture_shader();
std::string teeth_texture_shader();
std::string mucosa_texture_shader(bool tongue);
std::string lash_shader();
/// What is added to the distance of hair from the camera in the skin layer, m: half of what its distances wrap around at.
constexpr double kHairBeyond_m = 0.128;
std::string lock_vertex_shader();
std::string lock_shader(bool layer, bool gaps);  ///< `layer`: to be stored and looked up as skin is
std::string garment_vertex_shader();
std::string garment_shader(bool layer);  ///< the same
std::string strand_vertex_shader();
std::string strand_shader();
std::string shell_vertex_shader();
std::string shell_shader();
std::string socket_vertex_shader();
std::string socket_shader();
std::string tear_vertex_shader();
std::string tear_shader();
std::string object_vertex_shader();  ///< for ObjectView, which has its own lights
std::string object_shader();

/// Defines told(), the alpha of skin and locks in a picture, or in a layer; to be put after frame_chunk() and "in vec3 position;"
std::string told_chunk(bool layer);
/// Defines kTurnsPerMetre: how often the distance in a skin layer wraps around
std::string turns_chunk();
std::string frame_chunk();     ///< version and frame block
std::string lights_chunk();    ///< lamps and surroundings; to be put after frame_chunk()
std::string lighting_chunk();  ///< frame_chunk(), lights_chunk() and the shadow
std::string noise_chunk();
std::string texture_inputs_chunk();  ///< version and the outputs of part_texture_vertex_shader()
/// Defines own_colour(rest position, generated colour), which returns the generated colour unless `own`
std::string own_colour_chunk(bool own);

}  // namespace risorius::render
