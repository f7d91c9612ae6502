// SPDX-License-Identifier: MIT
#include "risorius/blendshapes/detail/shape_maps.h"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <set>

#include "risorius/core/error.h"
#include "risorius/core/json_object.h"
#include "risorius/face/fold_profile.h"
#include "risorius/face/surfaces.h"
#include "risorius/media/image_file.h"
#include "risorius/render/texture_square.h"
#include "risorius/report/folder_name.h"
#include "risorius/scene/scene_from_rig.h"
#include "risorius/scene/visualization.h"

namespace risorius::blendshapes {

namespace {

constexpr double kFull = 0.4;         // strain at white
constexpr double kSeen = 0.02;        // less strain than this is no map
constexpr double kSeenFold_m = 1e-5;  // nor is a shallower fold
// Wrinkles fade out between these numbers of texels per wavelength, which would show as noise.
constexpr double kFewTexels = 2, kEnoughTexels = 4;
constexpr const char* kMapsFolder = "maps";

/// What a shape does to the skin, at the vertices.
struct SkinState {
    std::vector<double> compression, stretch;
    Points positions;
    Points fold;  ///< depth of the wrinkles, m, or no rows
};

class MapMaker {
  public:
    MapMaker(const scene::RigFiles& files, const face::Face& face, int side_px)
        : face_(face),
          side_px_(side_px),
          scene_(scene::scene_from_rig(face.head(), files.rig, files.mesh)) {
        Vec3 low = Vec3::Constant(1e9), high = -low;
        for (const render::Surface& surface : scene_.surfaces) {
            if (surface.material != render::Material::kSkin) continue;
            const long before = skin_.rows();
            skin_.conservativeResize(before + surface.triangles.rows(), 3);
            skin_.bottomRows(surface.triangles.rows()) = surface.triangles;
            for (const int v : surface.triangles.reshaped()) {
                low = low.cwiseMin(Vec3(scene_.rest.row(v).transpose()));
                high = high.cwiseMax(Vec3(scene_.rest.row(v).transpose()));
            }
        }
        texels_ = render::skin_texels(scene_, 0.5 * (low + high), side_px);
        if (std::all_of(texels_.begin(), texels_.end(),
                        [](const render::SkinTexel& texel) { return texel.surface < 0; }))
            throw Error(files.place(), "a skin with texture coordinates, for maps", "none");
        rest_ = state_of(scene_.rest, track::Drive{});
    }

    const SkinState& rest() const { return rest_; }

    /// Not for several threads at once.
    SkinState state_of(const Points& vertices, const track::Drive& drive) const {
        SkinState out;
        const scene::StrainRange strain = scene::strain_range(skin_, scene_.rest, vertices);
        for (std::size_t v = 0; v < strain.least.size(); ++v) {
            out.compression.push_back(std::isnan(strain.least[v]) ? 0 : -strain.least[v]);
            out.stretch.push_back(std::isnan(strain.greatest[v]) ? 0 : strain.greatest[v]);
        }
        face::FacePose pose;
        pose.vertices = vertices;
        face_.surfaces().fold(pose, drive);
        out.fold = pose.fold_depth;
        out.positions = vertices;
        return out;
    }

    /// The changes from one state to another, floored at 0 for strains.
    static SkinState change(SkinState from, SkinState to) {
        for (std::size_t v = 0; v < to.compression.size(); ++v) {
            to.compression[v] =
                std::max(0.0, to.compression[v]) - std::max(0.0, from.compression[v]);
            to.stretch[v] = std::max(0.0, to.stretch[v]) - std::max(0.0, from.stretch[v]);
        }
        if (to.fold.rows() > 0 && from.fold.rows() == to.fold.rows()) to.fold -= from.fold;
        return to;
    }

    Image grey(const std::vector<double>& values) const {
        return drawn(Vec3::Zero(), [&](const render::SkinTexel& texel) {
            double value = 0;
            for (int k = 0; k < 3; ++k)
                value += texel.share[k] * values[static_cast<std::size_t>(vertex(texel, k))];
            return Vec3(Vec3::Constant(std::clamp(value / kFull, 0.0, 1.0)));
        });
    }

    Image normals(const SkinState& state) const {
        const Points& phase = face_.surfaces().wrinkle_lines().phase;
        const Vec3 flat(128.0 / 255, 128.0 / 255, 1);
        return drawn(flat, [&](const render::SkinTexel& texel) {
            return Vec3(127.5 / 255 * (normal(texel, state, phase) + Vec3::Ones()) +
                        Vec3(0.5 / 255, 0.5 / 255, 0));
        });
    }

  private:
    int vertex(const render::SkinTexel& texel, int corner) const {
        return scene_.surfaces[static_cast<std::size_t>(texel.surface)].triangles(texel.triangle,
                                                                                  corner);
    }

    template <class Colour>
    Image drawn(const Vec3& otherwise, const Colour& colour) const {
        Image out(side_px_, side_px_);
        for (std::size_t i = 0; i < texels_.size(); ++i) {
            if (texels_[i].surface < 0) continue;
            const Vec3 value = colour(texels_[i]);
            for (std::size_t k = 0; k < 3; ++k)
                out.rgba[4 * i + k] = static_cast<std::uint8_t>(
                    255 * std::clamp(value[static_cast<long>(k)], 0.0, 1.0) + 0.5);
            out.rgba[4 * i + 3] = 255;
        }
        render::fill_uncovered(out, otherwise);
        return out;
    }

    /// The normal of the folds in the triangle of a texel, in tangent space.
    Vec3 normal(const render::SkinTexel& texel, const SkinState& state, const Points& phase) const {
        const render::Surface& surface = scene_.surfaces[static_cast<std::size_t>(texel.surface)];
        std::array<Vec3, 3> at;
        std::array<Vec2, 3> place;
        double deepest = 0;
        for (int k = 0; k < 3; ++k) {
            const int v = vertex(texel, k);
            at[static_cast<std::size_t>(k)] = state.positions.row(v).transpose();
            place[static_cast<std::size_t>(k)] =
                surface.texcoords.row(3 * static_cast<long>(texel.triangle) + k).transpose();
            deepest = std::max(deepest, state.fold.row(v).cwiseAbs().maxCoeff());
        }
        const Vec3 e1 = at[1] - at[0], e2 = at[2] - at[0];
        const Vec2 t1 = place[1] - place[0], t2 = place[2] - place[0];
        const double flat = t1.x() * t2.y() - t1.y() * t2.x();
        const Vec3 twice = e1.cross(e2);
        if (deepest == 0 || flat == 0 || twice.squaredNorm() == 0) return Vec3::UnitZ();
        const Vec3 out = twice.normalized();
        // Gradients of the shares of the corners in the plane of the triangle
        const std::array<Vec3, 3> by{out.cross(at[2] - at[1]) / twice.norm(),
                                     out.cross(at[0] - at[2]) / twice.norm(),
                                     out.cross(at[1] - at[0]) / twice.norm()};
        const Vec3 slope = slope_of_folds(texel, state.fold, phase, by, flat, twice.norm());
        const Vec3 along_u = ((t2.y() * e1 - t1.y() * e2) / flat).normalized();
        const Vec3 along_v = (flat > 0 ? 1.0 : -1.0) * out.cross(along_u);
        return Vec3(-slope.dot(along_u), -slope.dot(along_v), 1).normalized();
    }

    Vec3 slope_of_folds(const render::SkinTexel& texel, const Points& fold, const Points& phase,
                        const std::array<Vec3, 3>& by, double texture_area, double area) const {
        Vec3 out = Vec3::Zero();
        const double texel_m = std::sqrt(area / std::abs(texture_area)) / side_px_;
        for (long slot = 0; slot < face::kWrinkleSlots; ++slot) {
            double f = 0, depth = 0;
            Vec3 of_phase = Vec3::Zero(), of_depth = Vec3::Zero();
            for (int k = 0; k < 3; ++k) {
                const int v = vertex(texel, k);
                const auto i = static_cast<std::size_t>(k);
                f += texel.share[k] * phase(v, slot);
                depth += texel.share[k] * fold(v, slot);
                of_phase += phase(v, slot) * by[i];
                of_depth += fold(v, slot) * by[i];
            }
            if (depth == 0) continue;
            const double texels = 1 / std::max(of_phase.norm() * texel_m, 1e-9);
            const double shown =
                std::clamp((texels - kFewTexels) / (kEnoughTexels - kFewTexels), 0.0, 1.0);
            constexpr double kStep = 1e-4;
            const double rise =
                (face::fold_height(f + kStep) - face::fold_height(f - kStep)) / (2 * kStep);
            out += shown * (depth * rise * of_phase + face::fold_height(f) * of_depth);
        }
        return out;
    }

    const face::Face& face_;
    int side_px_;
    render::Scene scene_;
    Triangles skin_{0, 3};
    std::vector<render::SkinTexel> texels_;
    SkinState rest_;
};

double most(const std::vector<double>& values) {
    return values.empty() ? 0 : *std::max_element(values.begin(), values.end());
}
double deepest_m(const SkinState& state) {
    return state.fold.rows() > 0 ? state.fold.cwiseAbs().maxCoeff() : 0;
}
std::vector<std::uint16_t> first_channel(const Image& image) {
    std::vector<std::uint16_t> out;
    for (std::size_t i = 0; i < image.rgba.size(); i += 4) out.push_back(image.rgba[i]);
    return out;
}

}  // namespace

std::vector<std::string> MapsReport::files() const {
    std::vector<std::string> out;
    const auto add = [&](const std::string& file) {
        if (!file.empty()) out.push_back(file);
    };
    add(neutral_normal);
    for (const ShapeMaps& one : shapes)
        for (const std::string& file : {one.compression, one.stretch, one.normal}) add(file);
    return out;
}

Json MapsReport::json() const {
    const auto or_null = [](const std::string& file) { return file.empty() ? Json() : Json(file); };
    Json list = Json::array();
    for (const ShapeMaps& one : shapes)
        list.push_back(json_object({{"name", one.name},
                                    {"compression", or_null(one.compression)},
                                    {"stretch", or_null(one.stretch)},
                                    {"normal", or_null(one.normal)},
                                    {"deepest_mm", 1e3 * one.deepest_m}}));
    return json_object({{"side_px", side_px},
                        {"strain_at_white", kFull},
                        {"neutral_normal", or_null(neutral_normal)},
                        {"shapes", list}});
}

MapsReport write_shape_maps(const scene::RigFiles& files, const face::Face& face,
                            const MadeShapes& shapes, int side_px,
                            const std::filesystem::path& folder, const ThreadLimit& threads,
                            const ProgressMonitor& monitor) {
    const MapMaker maker(files, face, side_px);
    std::filesystem::create_directories(folder / kMapsFolder);
    MapsReport out{.side_px = side_px, .neutral_normal = {}, .shapes = {}};
    std::set<std::string> taken;
    const auto file_of = [&](const std::string& name, const char* kind) {
        return std::string(kMapsFolder) + "/" + name + "_" + kind + ".png";
    };
    const std::string neutral = report::folder_name("neutral", taken);
    if (deepest_m(maker.rest()) > kSeenFold_m) {
        out.neutral_normal = file_of(neutral, "normal");
        media::write_png(maker.normals(maker.rest()), folder / out.neutral_normal);
    }
    std::vector<std::string> names;
    for (const MadeShape& made : shapes.list)
        names.push_back(report::folder_name(made.goal.name, taken));
    out.shapes.resize(shapes.list.size());
    std::mutex folding;
    TaskProgress progress(monitor, static_cast<int>(shapes.list.size()));
    parallel_for(static_cast<int>(shapes.list.size()), threads, [&](int index) {
        const auto i = static_cast<std::size_t>(index);
        const MadeShape& made = shapes.list[i];
        monitor.throw_if_stopped();
        SkinState state;
        {
            const std::lock_guard<std::mutex> one_at_a_time(folding);
            progress.begin("maps of " + made.goal.name);
            const Points& rest = face.head().vertices;
            SkinState from = maker.rest();
            if (made.goal.on_top_of >= 0) {
                const auto below = static_cast<std::size_t>(made.goal.on_top_of);
                from =
                    maker.state_of(shown_pose(shapes, below, rest), shapes.list[below].goal.drive);
            }
            state = MapMaker::change(std::move(from),
                                     maker.state_of(shown_pose(shapes, i, rest), made.goal.drive));
        }
        ShapeMaps& maps = out.shapes[i];
        maps.name = made.goal.name;
        const auto write_grey = [&](const std::vector<double>& values, const char* kind,
                                    std::string& file) {
            if (most(values) < kSeen) return;
            file = file_of(names[i], kind);
            media::write_grey_png(side_px, side_px, 8, first_channel(maker.grey(values)),
                                  folder / file);
        };
        write_grey(state.compression, "compression", maps.compression);
        write_grey(state.stretch, "stretch", maps.stretch);
        if (!(deepest_m(state) > kSeenFold_m)) return;
        maps.deepest_m = deepest_m(state);
        maps.normal = file_of(names[i], "normal");
        media::write_png(maker.normals(state), folder / maps.normal);
    });
    return out;
}

}  // namespace risorius::blendshapes
