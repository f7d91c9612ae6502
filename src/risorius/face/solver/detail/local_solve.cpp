// SPDX-License-Identifier: MIT
#include "risorius/face/solver/detail/local_solve.h"

#include <algorithm>
#include <utility>

#include "risorius/solve/metric_builder.h"

namespace risorius::face {

LocalSolve::LocalSolve(const Whole& whole, const std::vector<char>& moves, double h,
                       std::span<const std::pair<int, double>> touching)
    : whole_(whole), h_(h), own_(moves.size(), -1), lip_drive_(whole.lip_drive) {
    for (std::size_t i = 0; i < moves.size(); ++i)
        if (moves[i]) row_of(static_cast<int>(i));
    moving_ = static_cast<int>(node_.size());
    choose_elements();
    choose_fibres();
    std::vector<tissue::ZeroLengthSprings::Tether> held;
    for (std::size_t i = 0; i < whole_.tethers.list().size(); ++i) {
        tissue::ZeroLengthSprings::Tether tether = whole_.tethers.list()[i];
        if (!this->moves(tether.node)) continue;
        tether.node = row_of(tether.node);
        held.push_back(tether);
        tether_of_.push_back(static_cast<int>(i));
    }
    tethers_ = tissue::ZeroLengthSprings(std::move(held));
    lip_drive_.keep(own_, moving_);
    const auto count = static_cast<int>(node_.size());
    mass_kg_.resize(count);
    for (int i = 0; i < count; ++i)
        mass_kg_[i] = whole_.mass_kg[node_[static_cast<std::size_t>(i)]];

    solve::MetricBuilder builder(count);
    tets_->add_metric(builder);
    tets_->add_laplacian(builder, whole_.damping_s / h_);
    skin_->add_metric(builder);
    tethers_.add_metric(builder);
    fibres_->add_metric(builder, h_);
    lip_drive_.add_metric(builder);
    for (const FaceTerm& entry : whole_.terms)
        if (!entry.local_form) whole_terms_.push_back(entry.term.get());
    for (const solve::EnergyTerm* term : whole_terms_) add_whole_metric(*term, builder);
    for (const auto& [node, stiffness] : touching)
        if (this->moves(node)) builder.add_diagonal(row_of(node), stiffness);
    for (int i = 0; i < count; ++i) builder.add_diagonal(i, mass_kg_[i] / (h_ * h_) + 1e-9);
    std::vector<char> held_rows(node_.size(), 1);
    std::fill_n(held_rows.begin(), moving_, 0);
    metric_.emplace(builder.build(held_rows), solve::Precision::kSingle);
}

void LocalSolve::add_whole_metric(const solve::EnergyTerm& term,
                                  solve::MetricBuilder& builder) const {
    solve::MetricBuilder whole(static_cast<int>(own_.size()));
    term.add_metric(h_, whole);
    const Eigen::SparseMatrix<double> matrix = whole.build({});
    for (int column = 0; column < matrix.outerSize(); ++column)
        for (Eigen::SparseMatrix<double>::InnerIterator it(matrix, column); it; ++it) {
            const auto row = static_cast<int>(it.row());
            if (!moves(row) || !moves(column)) continue;
            const int nodes[2] = {own_[static_cast<std::size_t>(row)],
                                  own_[static_cast<std::size_t>(column)]};
            const double block[4] = {0, 0, it.value(), 0};
            if (row == column)
                builder.add_diagonal(nodes[0], it.value());
            else
                builder.add_block(nodes, block, 2);
        }
}

double LocalSolve::add_whole_potential(const Points& at, Points& gradient) const {
    for (int i = 0; i < moving_; ++i) whole_x_.row(node_[static_cast<std::size_t>(i)]) = at.row(i);
    whole_gradient_.setZero(whole_x_.rows(), 3);
    double sum = 0;
    for (const solve::EnergyTerm* term : whole_terms_)
        sum += term->add_potential({0.0, h_, whole_start_}, whole_x_, whole_gradient_);
    for (int i = 0; i < moving_; ++i)
        gradient.row(i) += whole_gradient_.row(node_[static_cast<std::size_t>(i)]);
    return sum;
}

int LocalSolve::row_of(int node) {
    int& own = own_[static_cast<std::size_t>(node)];
    if (own < 0) {
        own = static_cast<int>(node_.size());
        node_.push_back(node);
    }
    return own;
}

// Tets and triangles with a node that moves; and the triangles beside those, whose hinges reach across.
void LocalSolve::choose_elements() {
    const auto any_moves = [&](const auto& nodes) {
        for (long k = 0; k < nodes.size(); ++k)
            if (moves(nodes[k])) return true;
        return false;
    };
    const Tets& all = whole_.tets.tets();
    std::vector<int> rows;
    for (int t = 0; t < static_cast<int>(all.rows()); ++t)
        if (any_moves(all.row(t))) rows.push_back(t);
    Tets tets(static_cast<long>(rows.size()), 4);
    Eigen::VectorXd mu(tets.rows()), bulk(tets.rows());
    for (long t = 0; t < tets.rows(); ++t) {
        const int of = rows[static_cast<std::size_t>(t)];
        for (int k = 0; k < 4; ++k) tets(t, k) = row_of(all(of, k));
        mu[t] = whole_.tets.mu_pa()[of];
        bulk[t] = whole_.tets.bulk_pa()[of];
    }

    const Triangles& sheet = whole_.sheet;
    std::vector<char> near(own_.size(), 0);
    for (int f = 0; f < static_cast<int>(sheet.rows()); ++f)
        if (any_moves(sheet.row(f)))
            for (int k = 0; k < 3; ++k) near[static_cast<std::size_t>(sheet(f, k))] = 1;
    rows.clear();
    for (int f = 0; f < static_cast<int>(sheet.rows()); ++f) {
        int count = 0;
        for (int k = 0; k < 3; ++k) count += near[static_cast<std::size_t>(sheet(f, k))];
        if (count >= 2) rows.push_back(f);
    }
    Triangles triangles(static_cast<long>(rows.size()), 3);
    Eigen::VectorXd membrane(triangles.rows()), bending(triangles.rows());
    for (long f = 0; f < triangles.rows(); ++f) {
        const int of = rows[static_cast<std::size_t>(f)];
        for (int k = 0; k < 3; ++k) triangles(f, k) = row_of(sheet(of, k));
        membrane[f] = whole_.membrane_n_per_m[of];
        bending[f] = whole_.bending_n_m[of];
    }

    // Before its nodes are read: fibres may still add some that are held
    const muscle::FibreSet& fibres = whole_.fibres;
    for (const muscle::Fibre& fibre : fibres.fibres()) {
        const auto moved_by = [&](int p) {
            const muscle::FibrePoint& point = fibres.points()[static_cast<std::size_t>(p)];
            for (int i = 0; i < point.count; ++i)
                if (moves(point.nodes[i])) return true;
            return false;
        };
        const int f = static_cast<int>(&fibre - fibres.fibres().data());
        const int end = fibre.first_point + fibre.point_count - 1;
        for (int p = fibre.first_point; p < end; ++p) {
            if (!moved_by(p) && !moved_by(p + 1)) continue;
            if (point_of_.empty() || point_of_.back() != p || fibre_of_.back() != f) {
                fibre_of_.push_back(f);
                point_of_.push_back(p);
                first_point_.push_back(static_cast<int>(point_of_.size()) - 1);
            }
            point_of_.push_back(p + 1);
        }
    }
    for (const int p : point_of_) {
        const muscle::FibrePoint& point = fibres.points()[static_cast<std::size_t>(p)];
        for (int i = 0; i < point.count; ++i) row_of(point.nodes[i]);
    }
    const Points rest = taken(whole_.rest);
    tets_.emplace(tets, rest, mu, bulk);
    skin_.emplace(triangles, rest, membrane, bending);
}

// Runs of segments with an end that moves.
void LocalSolve::choose_fibres() {
    std::vector<muscle::FibrePoint> points;
    for (const int p : point_of_) {
        muscle::FibrePoint point = whole_.fibres.points()[static_cast<std::size_t>(p)];
        for (int i = 0; i < point.count; ++i) point.nodes[i] = row_of(point.nodes[i]);
        points.push_back(point);
    }
    std::vector<muscle::Fibre> fibres;
    for (std::size_t f = 0; f < fibre_of_.size(); ++f) {
        muscle::Fibre fibre = whole_.fibres.fibres()[static_cast<std::size_t>(fibre_of_[f])];
        const int end =
            f + 1 < first_point_.size() ? first_point_[f + 1] : static_cast<int>(point_of_.size());
        fibre.first_point = first_point_[f];
        fibre.point_count = end - first_point_[f];
        fibres.push_back(fibre);
    }
    fibres_.emplace(std::move(points), std::move(fibres), taken(whole_.rest), whole_.hill);
}

Points LocalSolve::taken(const Points& x) const {
    Points out(static_cast<long>(node_.size()), 3);
    for (long i = 0; i < out.rows(); ++i) out.row(i) = x.row(node_[static_cast<std::size_t>(i)]);
    return out;
}

void LocalSolve::begin(const Step& step, const Points& x) {
    tets_->begin_step(taken(step.start), whole_.damping_s / h_, step.precision);
    aim_ = taken(step.aim);
    if (!whole_terms_.empty()) {
        whole_start_ = step.start;
        whole_x_ = x;
    }
    activation_ = step.activation;
    precision_ = step.precision;
    fibres_->go_on(whole_.fibres, fibre_of_, point_of_);
    for (std::size_t i = 0; i < tether_of_.size(); ++i) {
        const tissue::ZeroLengthSprings::Tether& from =
            whole_.tethers.list()[static_cast<std::size_t>(tether_of_[i])];
        tethers_.list()[i].target = from.target;
        tethers_.list()[i].normal = from.normal;
    }
    lip_drive_ = whole_.lip_drive;
    lip_drive_.keep(own_, moving_);

    // What is held and not among the nodes here is part of a plane's or a spring's fixed place
    std::vector<tissue::Contacts::Contact>& contacts = contacts_.list();
    contacts.clear();
    for (const tissue::Contacts::Contact& found : whole_.contacts.list()) {
        tissue::Contacts::Contact contact = found;
        contact.count = 0;
        bool moved = moves(found.node);
        for (int i = 0; i < found.count; ++i) {
            if (moves(found.others[i])) {
                contact.others[contact.count] = own_[static_cast<std::size_t>(found.others[i])];
                contact.weights[contact.count++] = found.weights[i];
                moved = true;
            } else {
                contact.point += found.weights[i] * x.row(found.others[i]).transpose();
            }
        }
        contact.node = own_[static_cast<std::size_t>(found.node)];
        if (moved && contact.node >= 0) contacts.push_back(contact);
    }
    std::vector<tissue::DeadLoads::Load> loads;
    for (const tissue::DeadLoads::Load& load : whole_.loads.list())
        if (moves(load.node))
            loads.push_back({own_[static_cast<std::size_t>(load.node)], load.force_n});
    loads_.set(std::move(loads));
    springs_.clear();
    whole_.solids.add_springs(x, springs_);
    std::size_t kept = 0;
    for (const MuscleSolids::Spring& found : springs_) {
        MuscleSolids::Spring spring = found;
        spring.count = 0;
        for (int i = 0; i < found.count; ++i) {
            if (moves(found.nodes[i])) {
                spring.nodes[spring.count] = own_[static_cast<std::size_t>(found.nodes[i])];
                spring.weights[spring.count++] = found.weights[i];
            } else {
                spring.target -= found.weights[i] * x.row(found.nodes[i]).transpose();
            }
        }
        if (spring.count > 0) springs_[kept++] = spring;
    }
    springs_.resize(kept);
}

double LocalSolve::energy(const Points& at, Points& gradient) const {
    const double inertia = 1.0 / (h_ * h_);
    double value = 0;
    gradient.setZero(at.rows(), 3);
    for (long i = 0; i < moving_; ++i) {
        const Vec3 off = (at.row(i) - aim_.row(i)).transpose();
        value += 0.5 * inertia * mass_kg_[i] * off.squaredNorm();
        gradient.row(i) = inertia * mass_kg_[i] * off.transpose();
    }
    value += tets_->add_step_energy(at, gradient, precision_);
    value += skin_->add_energy(at, gradient, precision_);
    value += tethers_.add_energy(at, gradient);
    value += fibres_->add_energy(at, activation_, gradient);
    for (const MuscleSolids::Spring& spring : springs_) {
        Vec3 off = -spring.target;
        for (int i = 0; i < spring.count; ++i)
            off += spring.weights[i] * at.row(spring.nodes[i]).transpose();
        value += 0.5 * spring.stiffness_n_per_m * off.squaredNorm();
        for (int i = 0; i < spring.count; ++i)
            gradient.row(spring.nodes[i]) +=
                spring.stiffness_n_per_m * spring.weights[i] * off.transpose();
    }
    value += contacts_.add_energy(at, gradient);
    value += loads_.add_energy(at, gradient);
    value += lip_drive_.add_energy(at, gradient);
    if (!whole_terms_.empty()) value += add_whole_potential(at, gradient);
    gradient.bottomRows(gradient.rows() - moving_).setZero();
    return value;
}

solve::StepReport LocalSolve::advance(const Step& step, const solve::QuasiNewtonOptions& options,
                                      Points& x) {
    begin(step, x);
    x_ = taken(x);
    const solve::StepReport report =
        newton_.minimise([&](const Points& at, Points& gradient) { return energy(at, gradient); },
                         *metric_, x_, options);
    for (int i = 0; i < moving_; ++i) x.row(node_[static_cast<std::size_t>(i)]) = x_.row(i);
    return report;
}

}  // namespace risorius::face
