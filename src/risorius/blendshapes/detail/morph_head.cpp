// SPDX-License-Identifier: MIT
#include "risorius/blendshapes/detail/morph_head.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "risorius/core/error.h"
#include "risorius/core/known_names.h"
#include "risorius/core/read_file.h"
#include "risorius/core/rotations.h"
#include "risorius/core/version.h"
#include "risorius/face/surfaces.h"
#include "risorius/media/image_file.h"
#include "risorius/media/jpeg_file.h"
#include "risorius/render/lash_picture.h"
#include "risorius/render/offscreen_view.h"
#include "risorius/scene/scene_from_rig.h"
#include "risorius/scene/texture_picture.h"

namespace risorius::blendshapes {

namespace {

using render::Material;
using rig::Carrier;

const Vec3 kScleraColour(0.93, 0.91, 0.89), kTeethColour(0.90, 0.87, 0.78),
    kGumsColour(0.78, 0.45, 0.44), kTongueColour(0.76, 0.44, 0.42), kMouthColour(0.55, 0.26, 0.25),
    kPupilColour(0.02, 0.02, 0.02);

constexpr const char *kFace = "Face", *kHead = "Head", *kNeck = "Neck", *kShoulders = "Shoulders";
constexpr const char* kPivots[] = {"LeftEye", "RightEye"};
constexpr double kNeckShare = 0.5;  ///< of the head's turn
constexpr double kDegrees = 180 / 3.14159265358979323846;

int node_named(const io::MorphModel& model, const std::string& name) {
    for (std::size_t n = 0; n < model.nodes.size(); ++n)
        if (model.nodes[n].name == name) return static_cast<int>(n);
    return -1;
}

// The node that shows what moves with a carrier.
const char* node_of(Carrier carrier) {
    switch (carrier) {
        case Carrier::kSkull:
            return "TeethUpper";
        case Carrier::kMandible:
            return "TeethLower";
        case Carrier::kTongue:
            return "Tongue";
        case Carrier::kEyeLeft:
            return "EyeLeft";
        case Carrier::kEyeRight:
            return "EyeRight";
        case Carrier::kLashes:
            return "Lashes";
        case Carrier::kSkin:
        case Carrier::kNone:
            break;
    }
    return kFace;
}

void add_nodes(const scene::RigFiles& files, const face::Face& face, EyesBy eyes,
               io::MorphModel& model) {
    const rig::Head& head = face.head();
    const Vec3 pivot = face.surfaces().head_pivot();
    const auto add = [&](const char* name, const char* parent, const Vec3& place) {
        model.nodes.push_back(
            {.name = name, .parent = parent ? node_named(model, parent) : -1, .place = place});
        return static_cast<int>(model.nodes.size()) - 1;
    };
    model.skin.node = add(kFace, nullptr, Vec3::Zero());
    const char* const root = files.rig.name.c_str();
    const int top = add(root, nullptr, Vec3::Zero());
    model.nodes[static_cast<std::size_t>(top)].extras = {
        {"unit", "m"},
        {"up", "+Y"},
        {"front", "+Z"},
        {"generator", std::string("Risorius ") + kVersion}};
    model.skin.joints = {add(kShoulders, root, Vec3::Zero()), add(kNeck, root, pivot),
                         add(kHead, root, pivot)};
    for (std::size_t side = 0; side < 2; ++side) {
        const rig::EyeGeometry& eye = head.eyes[side];
        const char* const ball = node_of(side == 0 ? Carrier::kEyeLeft : Carrier::kEyeRight);
        const Vec3 centre = eye.present ? eye.centre : pivot;
        if (eye.present) add(kPivots[side], kHead, centre);
        const int node = add(ball, eye.present ? kPivots[side] : kHead, centre);
        // Turned by their pivots, so their shapes rest: never both
        io::MorphNode& made = model.nodes[static_cast<std::size_t>(node)];
        made.animate_shapes = !eye.present || eyes == EyesBy::kMorph;
        made.has_shapes = !eye.present || eyes != EyesBy::kBone;
    }
    for (const Carrier carrier :
         {Carrier::kSkull, Carrier::kMandible, Carrier::kTongue, Carrier::kLashes})
        add(node_of(carrier), kHead, pivot);

    const std::vector<double>& fraction = face.surfaces().head_fractions();
    model.skin.weights = Eigen::MatrixXd::Zero(static_cast<long>(fraction.size()), 3);
    for (std::size_t v = 0; v < fraction.size(); ++v) {
        const double f = fraction[v];
        auto row = model.skin.weights.row(static_cast<long>(v));
        if (f < kNeckShare)
            row << 1 - f / kNeckShare, f / kNeckShare, 0;
        else
            row << 0, (1 - f) / (1 - kNeckShare), (f - kNeckShare) / (1 - kNeckShare);
    }
}

// Colours the iris, found around the optical axis.
void tint_eye(const rig::EyeGeometry& eye, const rig::EyesDescription& sizes,
              const rig::AppearanceDescription& appearance, double size, const Points& vertices,
              Points& tint) {
    const double iris = 1e-3 * sizes.iris_radius_mm * size,
                 pupil = 1e-3 * sizes.pupil_radius_mm * size;
    for (long v = 0; v < vertices.rows(); ++v) {
        const Vec3 from = vertices.row(v).transpose() - eye.centre;
        const double along = from.dot(eye.forward), aside = (from - along * eye.forward).norm();
        if (from.norm() > 1.5 * eye.radius_m || along <= 0 || aside > iris) continue;
        const Vec3 colour = aside < pupil ? kPupilColour : appearance.iris_tone;
        tint.row(v) = colour.cwiseQuotient(kScleraColour).transpose();
    }
}

/// What a part is made of.
struct Substance {
    Material material;
    const char* name;
    Vec3 colour;
    double roughness;
    bool see_both_sides = false;
    double opacity = 1;
};

/// The substance of a triangle by the role of its group and what moves it; none for a role that is not shown.
std::optional<Substance> substance_of(const std::string& role, Carrier carrier,
                                      const rig::AppearanceDescription& look) {
    const Substance gums{Material::kGums, "Gums", kGumsColour, 0.35},
        tongue{Material::kTongue, "Tongue", kTongueColour, 0.5};
    if (role == "skin") return Substance{Material::kSkin, "Skin", look.skin_tone, 0.55};
    if (role == "mouth" || role == "eye_socket")
        return Substance{Material::kMouth, "Mouth", kMouthColour, 0.4, true};
    if (role.starts_with("eye_")) return Substance{Material::kEye, "Eyes", kScleraColour, 0.1};
    if (role.starts_with("cornea"))
        return Substance{Material::kCornea, "Corneas", Vec3::Ones(), 0.02, false, 0.08};
    if (role.starts_with("teeth")) return Substance{Material::kTeeth, "Teeth", kTeethColour, 0.25};
    if (role == "gums_tongue") return carrier == Carrier::kTongue ? tongue : gums;
    if (role.starts_with("gums")) return gums;
    if (role == "tongue") return tongue;
    if (role.starts_with("lashes"))
        return Substance{Material::kLashes, "Lashes", look.hair_tone, 0.6, true};
    return {};
}

// The pictures of a model: those of the mesh, and those that are drawn of the look.
class Pictures {
  public:
    Pictures(const scene::RigFiles& files, const rig::Head& head, int texture_px,
             std::vector<io::MorphPicture>& list)
        : mesh_(files.mesh),
          texture_px_(files.mesh.corner_texcoord.rows() > 0 ? texture_px : 0),
          scene_(scene::scene_from_rig(head, files.rig, files.mesh)),
          list_(list) {}

    /// The index of a picture of the mesh; -1 where it cannot be read.
    int of_mesh(int texture) {
        const auto [entry, is_new] = of_mesh_.try_emplace(texture, -1);
        if (!is_new) return entry->second;
        const geom::Texture& from = mesh_.textures[static_cast<std::size_t>(texture)];
        try {
            std::string bytes(from.embedded.begin(), from.embedded.end());
            if (bytes.empty()) bytes = read_file(from.file, {"a picture", 500 * kMegabyte});
            const std::string name = from.file.stem().string();
            if (bytes.starts_with("\x89PNG"))
                add({name, "image/png", std::move(bytes)});
            else if (bytes.starts_with("\xff\xd8\xff"))
                add({name, "image/jpeg", std::move(bytes)});
            else  // glTF knows no other kinds
                add({name, "image/png", media::png_bytes(scene::read_texture(from), name)});
            entry->second = static_cast<int>(list_.size()) - 1;
        } catch (const Error&) {
            // scene::picture_problems() says so; the part has a colour.
        }
        return entry->second;
    }

    /// The index of a picture of the look; -1 where parts have plain colours.
    int of_look(Material material) {
        if (material == Material::kMouth) material = Material::kSkin;  // which shows both
        const bool lashes = material == Material::kLashes;
        if (material == Material::kCornea || (texture_px_ == 0 && !lashes)) return -1;
        const auto [entry, is_new] = of_look_.try_emplace(material, -1);
        if (is_new) {
            const char* const name = name_of(material);
            const Image image = drawn(material);
            if (media::has_transparency(image))
                add({name, "image/png", media::png_bytes(image, name)});
            else
                add({name, "image/jpeg", media::jpeg_bytes(image, name)});
            entry->second = static_cast<int>(list_.size()) - 1;
        }
        return entry->second;
    }

    const render::Scene& scene() const { return scene_; }

  private:
    static const char* name_of(Material material) {
        switch (material) {
            case Material::kSkin:
                return "skin";
            case Material::kEye:
                return "eyes";
            case Material::kTeeth:
                return "teeth";
            case Material::kGums:
                return "gums";
            case Material::kTongue:
                return "tongue";
            default:
                return "lashes";
        }
    }
    void add(io::MorphPicture picture) { list_.push_back(std::move(picture)); }

    Image drawn(Material material) {
        constexpr int kLash_px = 512;
        if (material == Material::kLashes) {
            // White; the colour is that of the material, and what is no hair is clear.
            Image image = render::lash_opacity(kLash_px);
            for (std::size_t i = 0; i < image.rgba.size(); i += 4) {
                image.rgba[i + 3] = image.rgba[i];
                image.rgba[i] = image.rgba[i + 1] = image.rgba[i + 2] = 255;
            }
            return image;
        }
        if (!view_)
            view_ = std::make_unique<render::OffscreenView>(
                scene_,
                render::ViewOptions{.width_px = texture_px_ / 2, .height_px = texture_px_ / 2});
        if (material == Material::kSkin) return view_->skin_texture(scene_, texture_px_);
        return view_->part_texture(scene_, material, texture_px_ / 2);
    }

    const geom::PolygonMesh& mesh_;
    int texture_px_;
    render::Scene scene_;
    std::vector<io::MorphPicture>& list_;
    std::map<int, int> of_mesh_;
    std::map<Material, int> of_look_;
    std::unique_ptr<render::OffscreenView> view_;  ///< made when it is needed
};

/// Puts the triangles of the mesh into parts: one for each node, substance and picture.
class PartMaker {
  public:
    PartMaker(const scene::RigFiles& files, const rig::Head& head, int texture_px,
              io::MorphModel& model)
        : files_(files),
          head_(head),
          model_(model),
          pictures_(files, head, texture_px, model.pictures) {}

    void add_all() {
        for (std::size_t g = 0; g < files_.mesh.group_names.size(); ++g) {
            Triangles corners;
            const Triangles triangles =
                geom::triangulate(files_.mesh, {static_cast<int>(g)}, &corners);
            for (long t = 0; t < triangles.rows(); ++t)
                add(head_.role_of_group[g], triangles.row(t), corners.row(t));
        }
        for (auto& [key, part] : parts_) model_.parts.push_back(finished(part));
    }

  private:
    struct Key {
        int node;
        std::string substance;
        int picture, eye;
        auto operator<=>(const Key&) const = default;
    };
    struct Part {
        io::MorphPart made;
        Material material;
        std::vector<int> vertices, corners;
    };

    int picture_of(int corner, Material material) {
        const bool clear = material == Material::kCornea || material == Material::kLashes;
        if (!clear && !files_.mesh.face_texture.empty()) {
            const auto& begin = files_.mesh.face_begin;
            const auto face =
                std::upper_bound(begin.begin(), begin.end(), corner) - begin.begin() - 1;
            const int texture = files_.mesh.face_texture[static_cast<std::size_t>(face)];
            if (texture >= 0)
                if (const int own = pictures_.of_mesh(texture); own >= 0) return own;
        }
        return pictures_.of_look(material);
    }

    void add(const std::string& role, const Eigen::RowVector3i& triangle,
             const Eigen::RowVector3i& corners) {
        const Carrier carrier = head_.carrier[static_cast<std::size_t>(triangle[0])];
        const auto substance = substance_of(role, carrier, files_.rig.appearance);
        if (!substance) return;
        const int picture = picture_of(corners[0], substance->material),
                  node = node_named(model_, node_of(carrier));
        // Eyes without a picture have colours of their own.
        const int eye = role.starts_with("eye_") && picture < 0 ? (role == "eye_l" ? 0 : 1) : -1;
        const auto [entry, is_new] =
            parts_.try_emplace({node, substance->name, picture, eye}, Part{});
        Part& part = entry->second;
        if (is_new) {
            part.material = substance->material;
            part.made.name = substance->name;
            part.made.node = node;
            part.made.roughness = substance->roughness;
            part.made.see_both_sides = substance->see_both_sides;
            // In the dark, or thinner than a pixel
            part.made.normals_turn = part.material != Material::kMouth &&
                                     part.material != Material::kGums &&
                                     part.material != Material::kLashes;
            part.made.opacity = substance->opacity;
            part.made.picture = picture;
            part.made.picture_cuts = picture >= 0 && part.material == Material::kLashes;
            if (picture < 0 || part.made.picture_cuts) part.made.colour = substance->colour;
            if (eye >= 0) add_tint(static_cast<std::size_t>(eye), part.made);
        }
        for (int k = 0; k < 3; ++k) {
            part.vertices.push_back(triangle[k]);
            part.corners.push_back(corners[k]);
        }
    }

    void add_tint(std::size_t side, io::MorphPart& part) const {
        part.tint = Points::Ones(head_.vertices.rows(), 3);
        if (head_.eyes[side].present)
            tint_eye(head_.eyes[side], files_.rig.eyes, files_.rig.appearance, head_.size,
                     head_.vertices, part.tint);
    }

    io::MorphPart finished(Part& part) {
        io::MorphPart& out = part.made;
        const auto corners = static_cast<long>(part.vertices.size());
        out.triangles = Eigen::Map<Triangles>(part.vertices.data(), corners / 3, 3);
        const TexCoords& on_mesh = files_.mesh.corner_texcoord;
        if (part.material == Material::kLashes) {
            const TexCoords places = render::lash_coordinates(pictures_.scene());
            out.texcoords.resize(corners, 2);
            for (long c = 0; c < corners; ++c)
                out.texcoords.row(c) = places.row(part.vertices[static_cast<std::size_t>(c)]);
        } else if (on_mesh.rows() > 0) {
            out.texcoords.resize(corners, 2);
            for (long c = 0; c < corners; ++c)
                out.texcoords.row(c) = on_mesh.row(part.corners[static_cast<std::size_t>(c)]);
        }
        return std::move(out);
    }

    const scene::RigFiles& files_;
    const rig::Head& head_;
    io::MorphModel& model_;
    Pictures pictures_;
    std::map<Key, Part> parts_;  ///< in the order of nodes
};

}  // namespace

EyesBy eyes_named(const std::string& name) {
    constexpr std::array kAll{EyesBy::kMorph, EyesBy::kBone, EyesBy::kBoth};
    return kAll.at(static_cast<std::size_t>(
        index_of_name(option_name("eyes"), name, {"morph", "bone", "both"})));
}

io::MorphModel morph_head(const scene::RigFiles& files, const face::Face& face, int texture_px,
                          EyesBy eyes) {
    io::MorphModel model;
    model.name = files.rig.name;
    model.vertices = face.head().vertices;
    model.stands_for = face.head().welded;
    add_nodes(files, face, eyes, model);
    PartMaker(files, face.head(), texture_px, model).add_all();
    return model;
}

void describe_jaw(io::MorphModel& model) {
    const char *const shape = "jawOpen", *const teeth = node_of(Carrier::kMandible);
    const auto target = std::find_if(model.targets.begin(), model.targets.end(),
                                     [&](const io::MorphTarget& one) { return one.name == shape; });
    std::vector<int> vertices;
    for (const io::MorphPart& part : model.parts)
        if (part.node == node_named(model, teeth) && part.name == "Teeth")
            vertices.insert(vertices.end(), part.triangles.data(),
                            part.triangles.data() + part.triangles.size());
    if (target == model.targets.end() || vertices.empty()) return;
    std::sort(vertices.begin(), vertices.end());
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    Points moved = model.vertices;
    for (std::size_t i = 0; i < target->vertex.size(); ++i)
        moved.row(target->vertex[i]) += target->delta.row(static_cast<long>(i));
    const Rigid motion = nearest_motion(model.vertices(vertices, Eigen::indexing::all),
                                        moved(vertices, Eigen::indexing::all));
    const Eigen::AngleAxisd turn(motion.linear());
    constexpr double kNoTurn = 1e-3;
    if (turn.angle() < kNoTurn) return;
    // The point p of the axis nearest to the origin: what is left of the motion there is a slide along the axis.
    const Vec3 axis = turn.axis(), shift = motion.translation();
    const double slide = axis.dot(shift);
    const Vec3 across = shift - slide * axis;
    const Vec3 pivot = 0.5 * (across + axis.cross(across) / std::tan(0.5 * turn.angle()));
    const auto list = [](const Vec3& of) { return Json{of.x(), of.y(), of.z()}; };
    model.nodes[static_cast<std::size_t>(node_named(model, teeth))].extras["jaw"] = {
        {"shape", shape},
        {"pivot_m", list(pivot)},
        {"axis", list(axis)},
        {"angle_deg", kDegrees * turn.angle()},
        {"slide_m", slide}};
}

std::vector<io::NodeMotion> node_motions(const io::MorphModel& model, const face::Face& face,
                                         const std::vector<track::Drive>& drives) {
    const Vec3 pivot = face.surfaces().head_pivot();
    const auto moving = [&](const std::string& name) {
        return io::NodeMotion{node_named(model, name), {}, {}};
    };
    io::NodeMotion neck = moving(kNeck), head = moving(kHead);
    std::array<io::NodeMotion, 2> eyes{moving(kPivots[0]), moving(kPivots[1])};
    for (const track::Drive& drive : drives) {
        const face::FacePose pose = face.surfaces().posed(face.head().vertices, drive);
        const Eigen::Quaterniond turn(pose.head.linear());
        const Vec3 shift = pose.head * pivot - pivot;
        head.turn.push_back(turn);
        head.shift.push_back(shift);
        neck.turn.push_back(Eigen::Quaterniond::Identity().slerp(kNeckShare, turn));
        neck.shift.push_back(kNeckShare * shift);
        for (std::size_t side = 0; side < 2; ++side)
            eyes[side].turn.emplace_back(
                Mat3(pose.head.linear().transpose() * pose.eye_rotation[side]));
    }
    std::vector<io::NodeMotion> out;
    std::vector<io::NodeMotion*> motions{&neck, &head};
    for (const std::size_t side : {0u, 1u}) {
        const int ball =
            node_named(model, node_of(side == 0 ? Carrier::kEyeLeft : Carrier::kEyeRight));
        if (!model.nodes[static_cast<std::size_t>(ball)].animate_shapes)
            motions.push_back(&eyes[side]);
    }
    for (io::NodeMotion* motion : motions) {
        const bool turns = std::any_of(motion->turn.begin(), motion->turn.end(), [](const auto& q) {
            return q.angularDistance(Eigen::Quaterniond::Identity()) > 0;
        });
        const bool shifts = std::any_of(motion->shift.begin(), motion->shift.end(),
                                        [](const Vec3& by) { return !by.isZero(0.0); });
        if (!shifts) motion->shift.clear();
        if (motion->node >= 0 && (turns || shifts)) out.push_back(std::move(*motion));
    }
    return out;
}

}  // namespace risorius::blendshapes
