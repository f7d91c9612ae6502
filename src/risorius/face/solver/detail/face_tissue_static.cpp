// SPDX-License-Identifier: MIT
// The static energy of the tissue: energy, gradient and second derivative without inertia and damping.
#include <limits>

#include "risorius/face/solver/detail/face_tissue.h"
#include "risorius/solve/energy_term.h"

namespace risorius::face {

namespace {

// Depth beyond which a contact in equilibrium is stiffer than one in a time step, which learns a shift instead.
constexpr double kHardens_m = 0.0025e-3;

solve::ImplicitStep equilibrium_at(const Points& x) {
    return {0.0, std::numeric_limits<double>::infinity(), x};
}

}  // namespace

double FaceTissue::static_energy(const Points& x, const Eigen::VectorXd& activation,
                                 Points& gradient) const {
    gradient.setZero(x.rows(), 3);
    inputs_.activation = &activation;
    const double energy = terms_.add_potential(equilibrium_at(x), x, gradient).sum();
    for (long i = 0; i < x.rows(); ++i)
        if (fixed_[static_cast<std::size_t>(i)]) gradient.row(i).setZero();
    return energy;
}

Points FaceTissue::static_gradient(const Points& x, const Eigen::VectorXd& activation) const {
    Points gradient;
    static_energy(x, activation, gradient);
    return gradient;
}

void FaceTissue::add_static_hessian(const Points& x, const Eigen::VectorXd& activation,
                                    solve::Curvature curvature,
                                    solve::HessianBuilder& hessian) const {
    inputs_.activation = &activation;
    terms_.add_hessian(equilibrium_at(x), x, curvature, hessian);
}

void FaceTissue::find_rest_contacts(const Points& x) {
    contacts_.set_firm(search_.find(x, mandible_, gaze_), kHardens_m);
    contact_term_->note(mandible_);
}

void FaceTissue::find_soft_contacts(const Points& x) {
    contacts_.forget();
    find_contacts(x);
}

StepStats FaceTissue::end_rest(const Points& x) {
    StepStats figures;
    put_depths(x, figures);
    figures.muscle_volume_error = solids_->max_volume_error(x);
    contacts_.remember_firm(x);
    return figures;
}

void FaceTissue::ride_contacts(const std::vector<tissue::Contacts::Contact>& found,
                               const Rigid& from) {
    contacts_.list() = found;
    const Rigid moved = mandible_ * from.inverse();
    for (tissue::Contacts::Contact& contact : contacts_.list())
        if (contact.body == kMandibleBody) {
            contact.point = moved * contact.point;
            contact.normal = moved.linear() * contact.normal;
        }
}

}  // namespace risorius::face
