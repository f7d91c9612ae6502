// SPDX-License-Identifier: MIT
#include "risorius/face/diagnostics.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "risorius/core/error.h"
#include "risorius/core/known_names.h"
#include "risorius/face/detail/face_impl.h"

namespace risorius::face {

namespace {

const rig::Muscle& muscle_named(const rig::RigDescription& rig, const std::string& muscle) {
    const std::vector<rig::Muscle>& muscles = rig.muscles.muscles;
    const auto known = std::find_if(muscles.begin(), muscles.end(),
                                    [&](const rig::Muscle& one) { return one.id == muscle; });
    if (known == muscles.end()) {
        std::vector<std::string> names;
        for (const rig::Muscle& one : muscles) names.push_back(one.id);
        throw Error("muscle", "one of the rig's muscles" + did_you_mean(muscle, names),
                    in_quotes(muscle));
    }
    return *known;
}

}  // namespace

track::Drive Diagnostics::driven(track::Drive drive) const {
    drive = face_->complete(std::move(drive));
    drive.excitation = face_->driven_jaw.excitation(drive.excitation, drive);
    return drive;
}

std::vector<HeldPull> Diagnostics::pulls() const { return face_->held_pulls(); }

std::vector<char> Diagnostics::soft_vertices() const {
    std::vector<char> out;
    for (int v = 0; v < static_cast<int>(face_->head.vertices.rows()); ++v)
        out.push_back(face_->is_soft(v));
    return out;
}

double Diagnostics::energy_j() const {
    Points unused;
    face_->tissue.begin_rest(face_->now.x);
    return face_->tissue.static_energy(face_->now.x, face_->now.activation, unused);
}

std::vector<BesideSolid> Diagnostics::beside_solids() const {
    return face_->tissue.solids().beside(face_->mesh.nodes, face_->tissue.tets());
}

std::vector<SolidFigures> Diagnostics::solid_figures() const {
    return face_->tissue.solids().figures(face_->now.x, face_->now.activation);
}

std::optional<MuscleState> Diagnostics::muscle_state(const std::string& muscle, Side side) const {
    const rig::Muscle& known = muscle_named(face_->rig, muscle);
    const int column = face_->channels.column(muscle, side);
    const FaceImpl::State& now = face_->now;
    std::vector<muscle::ChainSet::State> fibres =
        face_->tissue.solids().chain_states(muscle, side, now.x, now.activation);
    const std::vector<muscle::FibreSet::State> bundles =
        face_->tissue.fibres().states(now.x, now.activation);
    for (std::size_t f = 0; f < bundles.size(); ++f)
        if (face_->tissue.fibres().fibres()[f].column == column)
            fibres.push_back({bundles[f].length_m, bundles[f].stretch, bundles[f].force_n});
    if (fibres.empty() && column >= 0)
        if (const auto jaw =
                face_->driven_jaw.muscle_state(column, now.jaw.q, now.activation[column]))
            fibres.push_back(*jaw);
    if (fibres.empty()) return std::nullopt;

    MuscleState out{.length_m = 0, .stretch = 0, .force_n = 0, .stress_pa = {}};
    for (const muscle::ChainSet::State& fibre : fibres) {
        out.length_m += fibre.length_m / static_cast<double>(fibres.size());
        out.stretch += fibre.stretch / static_cast<double>(fibres.size());
        out.force_n += fibre.force_n;
    }
    const double size = face_->head.size;
    if (known.area_m2 > 0) out.stress_pa = out.force_n / (known.area_m2 * size * size);
    return out;
}

std::optional<double> Diagnostics::greatest_force_n(const std::string& muscle, Side side) const {
    const int column = face_->channels.column(muscle_named(face_->rig, muscle).id, side);
    if (const auto solid = face_->tissue.solids().greatest_force_n(column)) return solid;
    std::optional<double> bundles;
    for (const muscle::Fibre& fibre : face_->tissue.fibres().fibres())
        if (fibre.column == column) bundles = bundles.value_or(0) + fibre.f0_n;
    return bundles ? bundles : face_->driven_jaw.greatest_force_n(column);
}

Vec3 Diagnostics::landmark(const std::string& id) const {
    const rig::Head& head = face_->head;
    if (!head.landmarks.count(id)) {
        std::vector<std::string> names;
        for (const auto& [name, place] : head.landmarks) names.push_back(name);
        throw Error("landmark", "one of the head's landmarks" + did_you_mean(id, names),
                    in_quotes(id));
    }
    const Vec3 rest = head.landmark(id);
    const auto given = face_->rig.landmarks.find(id);
    int vertex = given != face_->rig.landmarks.end() ? given->second.vertex : -1;
    Vec3 offset = Vec3::Zero();
    if (vertex < 0) {
        double min_squared = std::numeric_limits<double>::infinity();
        for (const int v : head.skin.reshaped()) {
            const double squared = (head.vertices.row(v).transpose() - rest).squaredNorm();
            if (squared >= min_squared) continue;
            min_squared = squared;
            vertex = v;
        }
        offset = rest - head.vertices.row(vertex).transpose();
    }
    const FacePose pose = face_->pose(1.0);
    return pose.vertices.row(vertex).transpose() + pose.head.linear() * offset;
}

double Diagnostics::mean_stretch(const std::string& muscle) const {
    if (face_->tissue.solids().is_solid(muscle))
        return face_->tissue.solids().mean_stretch(muscle, face_->now.x, face_->now.activation);
    const Eigen::VectorXd stretch = face_->tissue.fibres().mean_stretch(face_->now.x);
    double sum = 0;
    int count = 0;
    for (std::size_t f = 0; f < face_->tissue.fibres().fibres().size(); ++f)
        for (Side side : {Side::kLeft, Side::kRight})
            if (face_->tissue.fibres().fibres()[f].column == face_->channels.column(muscle, side)) {
                sum += stretch[static_cast<long>(f)];
                ++count;
            }
    return count ? sum / count : 1.0;
}

Points Diagnostics::skin_nodes() const {
    Points out(static_cast<long>(face_->shell.vertex.size()), 3);
    for (long v = 0; v < out.rows(); ++v)
        out.row(v) = face_->now.x.row(node_of(static_cast<int>(v), kSkin));
    return out;
}

Points Diagnostics::rest_skin_nodes() const {
    Points out(static_cast<long>(face_->shell.vertex.size()), 3);
    for (long v = 0; v < out.rows(); ++v)
        out.row(v) = face_->mesh.nodes.row(node_of(static_cast<int>(v), kSkin));
    return out;
}

double Diagnostics::tissue_volume_m3() const {
    const Points& x = face_->now.x;
    double six = 0;
    for (long t = 0; t < face_->mesh.tets.rows(); ++t) {
        const auto edge = [&](int k) -> Vec3 {
            return (x.row(face_->mesh.tets(t, k)) - x.row(face_->mesh.tets(t, 0))).transpose();
        };
        six += edge(1).dot(edge(2).cross(edge(3)));
    }
    return six / 6;
}

double Diagnostics::kinetic_energy_j() const {
    const Points velocity = face_->motion.velocity();
    double sum = 0;
    for (long i = 0; i < velocity.rows(); ++i)
        sum += 0.5 * face_->tissue.mass()[i] * velocity.row(i).squaredNorm();
    return sum;
}

Penetration Diagnostics::penetration() const {
    return face_->tissue.penetration(face_->shown(face_->now));
}

const Tets& Diagnostics::tets() const { return face_->mesh.tets; }
int Diagnostics::node_count() const { return face_->tissue.nodes(); }
int Diagnostics::tet_count() const { return static_cast<int>(face_->mesh.tets.rows()); }
int Diagnostics::inverted_tets() const { return face_->tissue.tets().inverted_count(face_->now.x); }
int Diagnostics::dropped_tets() const { return face_->mesh.dropped_tets; }
int Diagnostics::fibre_count() const {
    return static_cast<int>(face_->tissue.fibres().fibres().size());
}
const Shell& Diagnostics::shell() const { return face_->shell; }
const std::vector<StepStats>& Diagnostics::history() const { return face_->history; }
double Diagnostics::build_s() const { return face_->build_s; }

}  // namespace risorius::face
