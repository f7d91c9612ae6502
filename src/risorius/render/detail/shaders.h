// SPDX-License-Identifier: MIT
/// \file
/// Sources of the shader programs, one file per material; common parts are in shader_lighting.cpp.
#pragma once

#include <string>

namespace risorius::render {

/// What every frame tells all programs; the std140 block `Frame` of shader_lighting.cpp, field for field.
struct FrameUniforms {
    float clip_from_world[16];
    float mouth_centre[4];  ///< xyz m of the gap between the lips, w its area in m^2
    float mouth_axis[4];    ///< half its width, m
    // The same for all frames of a view; its programs may have them as constants instead
    float shadow_from_world[16];  ///< to texture coordinates and depth, 0..1
    float shadow_places[4];       ///< x: on each side of the map; y: m between them
    float camera[4];              ///< xyz m
    float key_direction[4];       ///< towards the lamp
    float key_card[4];  ///< as a white card that faces it shines: irradiance over pi, exposed
    float fill_direction[4];
    float fill_card[4];
    float rim_direction[4];
    float rim_card[4];
    float irradiance[9][4];  ///< of the surroundings, see Irradiance; exposed
};

/// Texture units and vertex attributes
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
    kHairLengthUnit = 10
};
enum VertexAttribute {
    kPosition = 0,
    kNormal = 1,
    kRest = 2,
    kPaintPlace = 3,  ///< where on the painted skin, see paint_place(); of lashes, lash_places()
    kFoldPhase = 5,
    kFoldDepth = 6,
    kOcclusion =
        4,  ///< x: share of the sky seen at rest, y: 1 inside the mouth, z: curvature at rest, 1/m; w: of pores
    kColour = 7  ///< of a value on the skin
};

/// Fraction of the skin's own light where the view is perpendicular to a muscle.
constexpr double kSkinOverMuscles = 0.16;

/// For every material; `key`: with the light of the key lamp, for draft_skin_shader.
std::string surface_vertex_shader(bool folds = false, bool key = false);
std::string depth_vertex_shader();  ///< shadow map and occlusion
/// What of the skin's relief is drawn that is finer than the mesh.
struct SkinRelief {
    bool folds = false;
    bool pores = true;
};
std::string skin_shader(const SkinRelief& relief);
std::string skin_layer_shader(const SkinRelief& relief);  ///< of the shaded skin, stored for lookup
std::string draft_skin_shader(bool layer);  ///< lit at its vertices, without pores and wrinkles
std::string clear_vertex_shader();
std::string clear_shader();
std::string lookup_vertex_shader();
std::string lookup_shader();  ///< and of those
std::string veil_shader(
    const SkinRelief& relief);  ///< of the skin over the muscles, which shine through
std::string values_vertex_shader();
std::string values_shader();  ///< of the skin when it shows a quantity
std::string muscle_vertex_shader();
std::string muscle_shader();
std::string bone_vertex_shader();
std::string bone_shader();  ///< of bone and teeth under skin of glass
std::string glass_vertex_shader();
std::string glass_shader();  ///< of that skin
// With `own` their colour is of the mesh's own picture.
std::string eye_shader(bool own);
std::string cornea_shader();
std::string teeth_shader(bool own);
std::string mucosa_shader(bool tongue,
                          bool own);  ///< of gums and the wall of the mouth, or the tongue
std::string matte_shader();
// Of what is laid out on texture coordinates without light, see part_texture.h; linear.
std::string part_texture_vertex_shader();
std::string eye_texture_shader();
std::string teeth_texture_shader();
std::string mucosa_texture_shader(bool tongue);
std::string lash_shader();
std::string strand_vertex_shader();
std::string strand_shader();
std::string shell_vertex_shader();
std::string shell_shader();
std::string socket_vertex_shader();
std::string socket_shader();
std::string tear_vertex_shader();
std::string tear_shader();
std::string object_vertex_shader();  ///< of ObjectView, which has its own lights
std::string object_shader();

std::string turns_chunk();   ///< kTurnsPerMetre: how often the distance in a skin layer begins anew
std::string frame_chunk();   ///< version, frame block
std::string lights_chunk();  ///< after it: lamps and surroundings
std::string lighting_chunk();  ///< both and the shadow
std::string noise_chunk();
std::string texture_inputs_chunk();  ///< version, and what part_texture_vertex_shader() hands on
std::string own_colour_chunk(bool own);  ///< own_colour(rest position, generated colour)

}  // namespace risorius::render
