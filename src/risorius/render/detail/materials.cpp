// SPDX-License-Identifier: MIT
#include "risorius/render/detail/materials.h"

#include <algorithm>
#include <cmath>

#include "risorius/render/detail/shaders.h"
#include "risorius/render/detail/skin_paint.h"

namespace risorius::render {
namespace {

std::string fragment_shader(Material material, Materials::Skin skin, const SkinRelief& relief,
                            bool own) {
    switch (material) {
        case Material::kSkin:
            return skin == Materials::Skin::kVeil    ? veil_shader(relief)
                   : skin == Materials::Skin::kLayer ? skin_layer_shader(relief)
                                                     : skin_shader(relief);
        case Material::kEye:
            return eye_shader(own);
        case Material::kCornea:
            return cornea_shader();
        case Material::kTeeth:
            return teeth_shader(own);
        case Material::kGums:
        case Material::kTongue:
        case Material::kMouth:
            return mucosa_shader(material == Material::kTongue, own);
        case Material::kLashes:
            return lash_shader();
        case Material::kMatte:
            return matte_shader();
    }
    return {};
}

bool inside_mouth(Material material) {
    return material == Material::kTeeth || material == Material::kGums ||
           material == Material::kTongue || material == Material::kMouth;
}

constexpr double kSkinRoughness = 0.52;
/// Width of a pore with its rim. Wider samples show the mean, which is flat
constexpr double kPore_m = 0.5e-3;

// Linear albedo of the mucosa
const Vec3 kGums(0.46, 0.18, 0.165), kTongue(0.46, 0.17, 0.155), kMouth(0.34, 0.10, 0.09);

void set(GLint location, const Vec3& v) {
    const Eigen::Vector3f f = v.cast<float>();
    glUniform3fv(location, 1, f.data());
}
void set(GLint location, const Mat3& m) {
    const Eigen::Matrix3f f = m.cast<float>();
    glUniformMatrix3fv(location, 1, GL_FALSE, f.data());
}

// Response of a material to soft light: see the uniforms of surface_vertex_shader().
struct Finish {
    double roughness, reflectance, fraction, mirror_layer;
    Vec3 scatter_m;
};

Finish finish_of(Material material, const Vec3& skin_scatter_m) {
    switch (material) {
        case Material::kSkin:
            return {kSkinRoughness, 0.028, 0.62, 2, skin_scatter_m};
        case Material::kTeeth:
            return {0.30, 0.045, 0.6, 1, {0.0009, 0.0008, 0.0007}};
        case Material::kEye:
        case Material::kCornea:
            return {0.20, 0.025, 0.0, 0, {0.0030, 0.0025, 0.0022}};
        case Material::kGums:
        case Material::kTongue:
        case Material::kMouth:
            return {0.30, 0.030, 0.6, 1, skin_scatter_m};
        case Material::kLashes:
        case Material::kMatte:
            break;
    }
    return {0.5, 0.0, 0.0, 3, Vec3::Zero()};
}

/// Mean free path of light in skin of an albedo before it leaves again, m. Values for Caucasian skin: diffuse distances 3.67,
/// 1.37 and 0.68 mm at albedos 0.44, 0.22 and 0.13 (Jensen 2001), scaled after Christensen and Burley 2015.
Vec3 skin_scatter(const Vec3& albedo) {
    const auto scaling = [](double a) { return 1.85 - a + 7 * std::pow(std::abs(a - 0.8), 3); };
    const Vec3 distance(3.67e-3, 1.37e-3, 0.68e-3), measured(0.44, 0.22, 0.13);
    Vec3 out;
    for (int k = 0; k < 3; ++k)
        out[k] = distance[k] * scaling(measured[k]) / scaling(std::clamp(albedo[k], 0.0, 1.0));
    return out;
}

double matte_reflectance(const Scene& scene) {
    for (const Surface& surface : scene.surfaces)
        if (surface.material == Material::kMatte) return surface.reflectance;
    return 0;
}

/// Rows are the axes of the eye: right, up, forward.
Mat3 eye_axes(const Eye& eye) {
    const Vec3 forward = eye.forward.normalized();
    const Vec3 across = Vec3::UnitY().cross(forward).normalized();
    Mat3 axes;
    axes << across.transpose(), forward.cross(across).transpose(), forward.transpose();
    return axes;
}

}  // namespace

ShaderConstants Materials::constants_of(const Scene& scene, Material material, int eye,
                                        ShaderConstants constants) const {
    constants.set("inside_mouth", inside_mouth(material));
    const Vec3 skin = linear_from_srgb(appearance_.skin_tone), scatter = skin_scatter(skin);
    const Finish finish = finish_of(material, scatter);
    constants.set("scatter", finish.scatter_m);
    constants.set("bounce", inside_mouth(material) ? kMouth : skin);
    constants.set("finish", Eigen::Vector4f(Eigen::Vector4d(finish.roughness, finish.reflectance,
                                                            finish.fraction, finish.mirror_layer)
                                                .cast<float>()));
    switch (material) {
        case Material::kSkin:
            // In proportion to the distance that each colour travels beyond the shortest one. The softness of the light itself,
            // half a millimetre, shows no colour.
            constants.set("bleed", Vec3(140 * (scatter.array() - scatter.minCoeff()).matrix()));
            constants.set("roughness", kSkinRoughness);
            constants.set("skin_gloss", appearance_.skin_gloss);
            constants.set("tone", skin.dot(Vec3(0.2126, 0.7152, 0.0722)));
            break;
        case Material::kEye:
        case Material::kCornea: {
            const auto index = static_cast<std::size_t>(eye);
            const Eye& ball = eyes_[index];
            constants.set("eye_from_rest", eye_axes(ball));
            constants.set("centre", ball.centre);
            constants.set("iris_radius", ball.iris_radius_m);
            constants.set("pupil_radius", ball.pupil_radius_m);
            constants.set("iris_depth", iris_depth_m_[index]);
            constants.set("iris_tone", linear_from_srgb(appearance_.iris_tone));
            constants.set("skin_green", skin.y());
            constants.set("age", appearance_.age);
            constants.set("separate_cornea", static_cast<bool>(separate_cornea_[index]));
            break;
        }
        case Material::kGums:
            constants.set("albedo", kGums);
            break;
        case Material::kTongue:
            constants.set("albedo", kTongue);
            break;
        case Material::kMouth:
            constants.set("albedo", kMouth);
            break;
        case Material::kMatte:
            constants.set("albedo", Vec3(Vec3::Constant(matte_reflectance(scene))));
            break;
        case Material::kLashes:
            constants.set("albedo", Vec3(0.45 * linear_from_srgb(appearance_.hair_tone)));
            break;
        case Material::kTeeth:
            break;
    }
    return constants;
}

std::unique_ptr<GlProgram> Materials::make_program(const Kind& kind, bool folds, Skin how,
                                                   const ShaderConstants& constants,
                                                   const MuscleLayer* muscles) const {
    const auto& [material, own, eye] = kind;
    const std::string name = "material " + std::to_string(static_cast<int>(material));
    const bool draft = draft_ && material == Material::kSkin;
    auto program = std::make_unique<GlProgram>(
        name, constants.in(surface_vertex_shader(folds, draft)),
        constants.in(draft
                         ? draft_skin_shader(how == Skin::kLayer)
                         : fragment_shader(material, how, {.folds = folds, .pores = pores_}, own)));
    if (muscles && material == Material::kSkin) {
        program->use();
        muscles->set_uniform(*program);
    }
    return program;
}

Materials::Materials(const Scene& scene, const SceneBuffers& buffers, Skin skin, bool draft,
                     double shaded_m, const ShaderConstants& constants, const MuscleLayer* muscles)
    : eyes_(scene.eyes),
      appearance_(scene.appearance),
      draft_(draft && skin != Skin::kVeil),
      pores_(shaded_m < kPore_m) {
    for (const Batch& batch : buffers.batches())
        if (batch.material == Material::kCornea)
            separate_cornea_[static_cast<std::size_t>(batch.eye)] = true;

    // The iris lies in the plane of the limbus, where the surface of the eye is as wide as the iris.
    for (std::size_t side = 0; side < 2; ++side) {
        const Eye& eye = eyes_[side];
        const Mat3 axes = eye_axes(eye);
        double nearest = 1e9;
        iris_depth_m_[side] = std::sqrt(
            std::max(eye.radius_m * eye.radius_m - eye.iris_radius_m * eye.iris_radius_m, 0.0));
        for (const Surface& surface : scene.surfaces) {
            if (surface.material != Material::kEye ||
                std::max(surface.eye, 0) != static_cast<int>(side))
                continue;
            for (Eigen::Index i = 0; i < surface.triangles.size(); ++i) {
                const Vec3 q =
                    axes * (scene.rest.row(surface.triangles.data()[i]).transpose() - eye.centre);
                const double off = std::abs(q.head<2>().norm() - eye.iris_radius_m);
                if (q.z() > 0 && off < nearest) {
                    nearest = off;
                    iris_depth_m_[side] = q.z();
                }
            }
        }
    }

    for (const Batch& batch : buffers.batches()) {
        const Kind kind = kind_of(batch);
        if (programs_.contains(kind)) continue;
        const ShaderConstants own = constants_of(scene, batch.material, batch.eye, constants);
        programs_.emplace(kind, make_program(kind, false, skin, own, muscles));
        if (batch.material == Material::kSkin && scene.fold_phase.rows() > 0 && !draft_)
            folded_skin_ = make_program(kind, true, skin, own, muscles);
    }
}

void Materials::tell_colours(const GlProgram& program, Material material, int eye) const {
    if (material == Material::kGums) set(program.location("albedo"), kGums);
    if (material == Material::kTongue) set(program.location("albedo"), kTongue);
    if (material == Material::kMouth) set(program.location("albedo"), kMouth);
    if (material != Material::kEye && material != Material::kCornea) return;
    const auto index = static_cast<std::size_t>(eye);
    const Eye& ball = eyes_[index];
    set(program.location("eye_from_rest"), eye_axes(ball));
    set(program.location("centre"), ball.centre);
    glUniform1f(program.location("iris_radius"), static_cast<float>(ball.iris_radius_m));
    glUniform1f(program.location("pupil_radius"), static_cast<float>(ball.pupil_radius_m));
    glUniform1f(program.location("iris_depth"), static_cast<float>(iris_depth_m_[index]));
    glUniform1f(program.location("skin_green"),
                static_cast<float>(linear_from_srgb(appearance_.skin_tone).y()));
    glUniform1f(program.location("age"), static_cast<float>(appearance_.age));
    set(program.location("iris_tone"), linear_from_srgb(appearance_.iris_tone));
}

void Materials::set_eye(const GlProgram& program, int side, const Pose& pose,
                        const PosedMarks& marks) const {
    const auto index = static_cast<std::size_t>(side);
    set(program.location("eye_from_world"),
        Mat3(eye_axes(eyes_[index]) * pose.eye_rotation[index].transpose()));
    const LidMarks lids = marks.lids(pose, side);
    set(program.location("lid_inner"), lids.inner);
    set(program.location("lid_outer"), lids.outer);
    set(program.location("lid_upper"), lids.upper);
    set(program.location("lid_lower"), lids.lower);
    glUniform1f(program.location("lids"), lids.known ? 1.0F : 0.0F);
}

void Materials::draw_skin(const Batch& batch, const SceneBuffers& buffers) const {
    programs_.at(kind_of(batch))->use();
    if (!folded_skin_) {
        buffers.draw(batch);
        return;
    }
    buffers.draw_smooth(batch);
    if (!buffers.has_wrinkled(batch)) return;
    folded_skin_->use();
    buffers.draw_wrinkled(batch);
}

void Materials::use(const Batch& batch, const Pose& pose, const PosedMarks& marks) const {
    if (batch.material == Material::kSkin && pose.values) {
        if (!values_)
            values_ =
                std::make_unique<GlProgram>("values", values_vertex_shader(), values_shader());
        values_->use();
        return;
    }
    const GlProgram& program = *programs_.at(kind_of(batch));
    program.use();
    if (batch.material == Material::kEye || batch.material == Material::kCornea)
        set_eye(program, batch.eye, pose, marks);
    if (batch.material == Material::kCornea) {
        glEnable(GL_BLEND);
        glBlendFuncSeparate(GL_ONE, GL_ONE_MINUS_SRC_ALPHA, GL_ZERO, GL_ONE);
        glDepthMask(GL_FALSE);
    }
}

void Materials::done() const {
    glDisable(GL_BLEND);
    glDepthMask(GL_TRUE);
}

}  // namespace risorius::render
