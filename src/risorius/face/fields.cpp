// SPDX-License-Identifier: MIT
#include "risorius/face/fields.h"

#include <algorithm>
#include <cmath>

#include "risorius/face/detail/face_impl.h"

namespace risorius::face {

namespace {

using TensorRow = Eigen::Matrix<double, 1, 6>;

TensorRow tensor_row(const Mat3& tensor) {
    return (TensorRow() << tensor(0, 0), tensor(1, 1), tensor(2, 2), tensor(0, 1), tensor(1, 2),
            tensor(0, 2))
        .finished();
}

/// The motion of the head at points of the face, which fades down the neck.
class Moved {
  public:
    Moved(const FaceImpl& face, const FaceImpl::State& state)
        : face_(face), head_(head_motion(face.head, state.drive)) {}

    Points at(const Points& rest, Points points) const {
        face_.poser->turn_with_head(head_, rest, points);
        return points;
    }
    /// The rotation at a point, by its position at rest.
    Mat3 turn(const Vec3& rest) const {
        return face_.neck.part(head_, face_.neck.fraction(rest)).linear();
    }
    Mat3 tensor(const Vec3& rest, const Mat3& in_head) const {
        const Mat3 r = turn(rest);
        return r * in_head * r.transpose();
    }

  private:
    const FaceImpl& face_;
    Rigid head_;
};

Eigen::VectorXd contact_pressure(const FaceImpl& face, const Points& x) {
    Eigen::VectorXd pressure = Eigen::VectorXd::Zero(face.tissue.nodes());
    for (const tissue::Contacts::Contact& contact : face.tissue.contacts().list()) {
        const std::size_t vertex = static_cast<std::size_t>(contact.node) / kLayers;
        if (contact.node >= pressure.size()) continue;
        const double push_n = std::max(0.0, -tissue::Contacts::pull_n(contact, x));
        pressure[contact.node] += push_n / face.mesh.area_m2[vertex];
    }
    return pressure;
}

TissueFields tissue_fields(const FaceImpl& face, const FaceImpl::State& state, const Moved& moved) {
    TissueFields out;
    const Points x = state.x.topRows(face.tissue.nodes());
    out.rest = face.mesh.nodes;
    out.nodes = moved.at(out.rest, x);
    out.tets = face.mesh.tets;
    out.contact_pa = contact_pressure(face, state.x);
    const tissue::TetSolid& tets = face.tissue.tets();
    out.volume_ratio.resize(tets.size());
    out.stress_pa.resize(tets.size(), 6);
    std::vector<Mat3> of_fibres(static_cast<std::size_t>(tets.size()), Mat3::Zero());
    if (const tissue::CollagenTets* fibres = face.tissue.collagen())
        for (std::size_t i = 0; i < fibres->list().size(); ++i)
            of_fibres[static_cast<std::size_t>(fibres->list()[i].tet)] +=
                fibres->cauchy_stress_pa(x, i);
    for (int t = 0; t < tets.size(); ++t) {
        Vec3 middle = Vec3::Zero();
        for (int k = 0; k < 4; ++k) middle += 0.25 * out.rest.row(out.tets(t, k)).transpose();
        out.volume_ratio[t] = tets.deformation_gradient(x, t).determinant();
        out.stress_pa.row(t) = tensor_row(moved.tensor(
            middle, tets.cauchy_stress_pa(x, t) + of_fibres[static_cast<std::size_t>(t)]));
        out.superficial.push_back(face.mesh.tet_layer[static_cast<std::size_t>(t)] == kSkin);
    }
    return out;
}

FibreFields fibre_fields(const FaceImpl& face, const FaceImpl::State& state, const Moved& moved) {
    FibreFields out;
    // A copy, since the bones are where they were at the last step
    muscle::FibreSet fibres = face.tissue.fibres();
    fibres.end_step();
    std::array<Rigid, kBodies> bodies;
    bodies.fill(Rigid::Identity());
    fibres.set_body_positions(bodies);
    out.rest = fibres.positions(face.tissue.rest());
    bodies[kMandibleBody] = face.driven_jaw.motion(state.jaw.q, state.drive);
    fibres.set_body_positions(bodies);
    out.nodes = moved.at(out.rest, fibres.positions(state.x));
    const std::vector<muscle::FibreSet::State> states =
        fibres.segment_states(state.x, state.activation);
    std::size_t segment = 0;
    for (const muscle::Fibre& fibre : fibres.fibres())
        for (int p = fibre.first_point; p + 1 < fibre.first_point + fibre.point_count; ++p) {
            const muscle::FibreSet::State& of = states[segment++];
            out.segments.push_back({p, p + 1});
            out.state.push_back(
                {.column = fibre.column,
                 .direction = (out.nodes.row(p + 1) - out.nodes.row(p)).normalized().transpose(),
                 .activation = state.activation[fibre.column],
                 .stretch = of.stretch,
                 .tension_n = of.force_n});
        }
    return out;
}

SolidFields solid_fields(const FaceImpl& face, const FaceImpl::State& state, const Moved& moved) {
    SolidFields out;
    const MuscleSolids& solids = face.tissue.solids();
    out.rest = solids.rest();
    const Points x = state.x.bottomRows(out.rest.rows());
    out.nodes = moved.at(out.rest, x);
    const std::vector<SolidCellState> cells = solids.cell_states(state.x, state.activation);
    const Eigen::Index count = static_cast<Eigen::Index>(cells.size());
    out.cells.resize(count, 8);
    out.volume_ratio.resize(count);
    out.stress_pa.resize(count, 6);
    for (Eigen::Index c = 0; c < count; ++c) {
        const SolidCellState& cell = cells[static_cast<std::size_t>(c)];
        Vec3 middle = Vec3::Zero();
        for (int k = 0; k < 8; ++k) {
            out.cells(c, k) = cell.node[static_cast<std::size_t>(k)];
            middle += 0.125 * out.rest.row(out.cells(c, k)).transpose();
        }
        out.volume_ratio[c] = cell.volume_ratio;
        out.stress_pa.row(c) = tensor_row(moved.tensor(middle, cell.stress_pa));
        out.state.push_back({.column = cell.column,
                             .direction = moved.turn(middle) * cell.direction,
                             .activation = state.activation[cell.column],
                             .stretch = cell.stretch,
                             .tension_n = cell.tension_n});
    }
    return out;
}

FaceFields fields_of(const FaceImpl& face, const FaceImpl::State& state) {
    const Moved moved(face, state);
    return {tissue_fields(face, state, moved), fibre_fields(face, state, moved),
            solid_fields(face, state, moved)};
}

}  // namespace

double von_mises(const Eigen::Matrix<double, 1, 6>& stress) {
    const double xx = stress[0], yy = stress[1], zz = stress[2];
    const double shear = stress.tail<3>().squaredNorm();
    return std::sqrt(0.5 * ((xx - yy) * (xx - yy) + (yy - zz) * (yy - zz) + (zz - xx) * (zz - xx)) +
                     3 * shear);
}

FaceFields Fields::at(double t_s) const {
    return fields_of(*face_, face_->between(face_->fraction_of_step(t_s)));
}

FaceFields Fields::now() const { return fields_of(*face_, face_->now); }

}  // namespace risorius::face
