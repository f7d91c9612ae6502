// SPDX-License-Identifier: MIT
#include "risorius/face/solver/detail/face_terms.h"

#include <cmath>
#include <utility>

#include "risorius/face/solver/detail/face_tissue.h"

namespace risorius::face {

namespace {

constexpr double kEquilibriumContactFraction = 0.5;  // the same in long steps towards equilibrium

bool in_equilibrium(const solve::ImplicitStep& step) { return std::isinf(step.step_s); }

/// The terms below refer to objects of FaceTissue: bones, lids and activations act on those objects.
class TissueTerm : public solve::EnergyTerm {
  public:
    TissueTerm(tissue::TetSolid& tets, double damping_s, const TermInputs& inputs)
        : tets_(tets), damping_s_(damping_s), inputs_(inputs) {}
    void begin_step(double, double step_s, const Points& x, const Points&) override {
        tets_.begin_step(x, damping_s_ / step_s, inputs_.precision);
    }
    double add_potential(const solve::ImplicitStep& step, const Points& x,
                         Points& gradient) const override {
        return in_equilibrium(step) ? tets_.add_energy(x, gradient)
                                    : tets_.add_step_energy(x, gradient, inputs_.precision);
    }
    void add_hessian(const solve::ImplicitStep&, const Points& x, solve::Curvature curvature,
                     solve::HessianBuilder& hessian) const override {
        tets_.add_hessian(x, curvature, hessian);
    }
    void add_metric(double step_s, solve::MetricBuilder& metric) const override {
        tets_.add_metric(metric);
        tets_.add_laplacian(metric, damping_s_ / step_s);
    }

  private:
    tissue::TetSolid& tets_;
    double damping_s_;
    const TermInputs& inputs_;
};

class SkinTerm : public solve::EnergyTerm {
  public:
    SkinTerm(const tissue::SkinSheet& skin, const TermInputs& inputs)
        : skin_(skin), inputs_(inputs) {}
    double add_potential(const solve::ImplicitStep& step, const Points& x,
                         Points& gradient) const override {
        return skin_.add_energy(
            x, gradient, in_equilibrium(step) ? solve::Precision::kDouble : inputs_.precision);
    }
    void add_hessian(const solve::ImplicitStep&, const Points& x, solve::Curvature curvature,
                     solve::HessianBuilder& hessian) const override {
        skin_.add_hessian(x, curvature, hessian);
    }
    void add_metric(double, solve::MetricBuilder& metric) const override {
        skin_.add_metric(metric);
    }

  private:
    const tissue::SkinSheet& skin_;
    const TermInputs& inputs_;
};

class AttachmentTerm : public solve::EnergyTerm {
  public:
    explicit AttachmentTerm(const tissue::ZeroLengthSprings& springs) : springs_(springs) {}
    double add_potential(const solve::ImplicitStep&, const Points& x,
                         Points& gradient) const override {
        return springs_.add_energy(x, gradient);
    }
    void add_hessian(const solve::ImplicitStep&, const Points&, solve::Curvature,
                     solve::HessianBuilder& hessian) const override {
        springs_.add_hessian(hessian);
    }
    void add_metric(double, solve::MetricBuilder& metric) const override {
        springs_.add_metric(metric);
    }

  private:
    const tissue::ZeroLengthSprings& springs_;
};

class FibreTerm : public solve::EnergyTerm {
  public:
    FibreTerm(const muscle::FibreSet& fibres, const TermInputs& inputs)
        : fibres_(fibres), inputs_(inputs) {}
    double add_potential(const solve::ImplicitStep&, const Points& x,
                         Points& gradient) const override {
        return fibres_.add_energy(x, *inputs_.activation, gradient);
    }
    void add_hessian(const solve::ImplicitStep&, const Points& x, solve::Curvature curvature,
                     solve::HessianBuilder& hessian) const override {
        fibres_.add_hessian(x, *inputs_.activation, curvature, hessian);
    }
    void add_metric(double step_s, solve::MetricBuilder& metric) const override {
        fibres_.add_metric(metric, step_s < kSettling_s ? step_s : 0);
    }

  private:
    const muscle::FibreSet& fibres_;
    const TermInputs& inputs_;
};

class VolumeMuscleTerm : public solve::EnergyTerm {
  public:
    VolumeMuscleTerm(MuscleSolids& solids, Wrenches& pull, const TermInputs& inputs)
        : solids_(solids), pull_(pull), inputs_(inputs) {}
    void begin_step(double, double step_s, const Points& x, const Points&) override {
        solids_.begin_step(step_s, x, *inputs_.activation);
    }
    double add_potential(const solve::ImplicitStep&, const Points& x,
                         Points& gradient) const override {
        pull_ = {};
        return inputs_.solids_relaxed
                   ? 0.0
                   : solids_.add_energy(x, *inputs_.activation, gradient, &pull_);
    }
    void add_hessian(const solve::ImplicitStep&, const Points& x, solve::Curvature curvature,
                     solve::HessianBuilder& hessian) const override {
        solids_.add_hessian(x, *inputs_.activation, curvature, hessian);
    }
    void add_metric(double, solve::MetricBuilder& metric) const override {
        solids_.add_metric(metric);
    }

  private:
    MuscleSolids& solids_;
    Wrenches& pull_;  // on skull and mandible, at the last evaluation
    const TermInputs& inputs_;
};

class ContactTerm : public solve::EnergyTerm {
  public:
    ContactTerm(const tissue::Contacts& contacts, const ContactSearch& search)
        : contacts_(contacts), search_(search) {}
    double add_potential(const solve::ImplicitStep&, const Points& x,
                         Points& gradient) const override {
        return contacts_.add_energy(x, gradient);
    }
    void add_hessian(const solve::ImplicitStep&, const Points& x, solve::Curvature,
                     solve::HessianBuilder& hessian) const override {
        contacts_.add_hessian(x, hessian);
    }
    void add_metric(double step_s, solve::MetricBuilder& metric) const override {
        const double fraction =
            step_s < kSettling_s ? kContactFraction : kEquilibriumContactFraction;
        for (std::size_t i = 0; i < search_.nodes().size(); ++i)
            metric.add_diagonal(search_.nodes()[i], fraction * search_.node_stiffness()[i]);
    }

  private:
    const tissue::Contacts& contacts_;
    const ContactSearch& search_;
};

class LoadTerm : public solve::EnergyTerm {
  public:
    explicit LoadTerm(const tissue::DeadLoads& loads) : loads_(loads) {}
    double add_potential(const solve::ImplicitStep&, const Points& x,
                         Points& gradient) const override {
        return loads_.add_energy(x, gradient);
    }
    void add_hessian(const solve::ImplicitStep&, const Points&, solve::Curvature,
                     solve::HessianBuilder&) const override {}
    void add_metric(double, solve::MetricBuilder&) const override {}

  private:
    const tissue::DeadLoads& loads_;
};

class LipTerm : public solve::EnergyTerm {
  public:
    LipTerm(LipDrive& lips, const TermInputs& inputs) : lips_(lips), inputs_(inputs) {}
    double add_potential(const solve::ImplicitStep&, const Points& x,
                         Points& gradient) const override {
        lips_.drive(*inputs_.activation);
        return lips_.add_energy(x, gradient);
    }
    void add_hessian(const solve::ImplicitStep&, const Points& x, solve::Curvature,
                     solve::HessianBuilder& hessian) const override {
        lips_.drive(*inputs_.activation);
        lips_.add_hessian(x, hessian);
    }
    void add_metric(double, solve::MetricBuilder& metric) const override {
        lips_.add_metric(metric);
    }

  private:
    LipDrive& lips_;
    const TermInputs& inputs_;
};

template <class Visit>
void in_order_of_matrices(const FaceTerms& terms, const Visit& visit) {
    for (const bool changing : {false, true})
        for (const FaceTerm& entry : terms)
            if (entry.changing_pairs == changing) visit(*entry.term);
}

}  // namespace

// A new force is one line here. The order of the lines is the order of summation.
void FaceTissue::build_terms() {
    const auto add = [&](auto term, bool changing_pairs = false) {
        terms_.push_back({std::make_shared<decltype(term)>(std::move(term)), changing_pairs, true});
    };
    add(TissueTerm(*tets_, rig_.tissue.damping_s, inputs_));
    add(SkinTerm(*skin_, inputs_));
    add(AttachmentTerm(*tethers_));
    add(FibreTerm(*fibres_, inputs_));
    add(VolumeMuscleTerm(*solids_, solids_pull_, inputs_));
    add(ContactTerm(contacts_, search_), true);
    add(LoadTerm(air_));
    add(LipTerm(*lip_drive_, inputs_));
}

void FaceTissue::add_term(std::shared_ptr<solve::EnergyTerm> term) {
    terms_.push_back({std::move(term), false, false});
    metrics_.clear();
    forget_mouth();
}

TermEnergy add_potential(const FaceTerms& terms, const solve::ImplicitStep& step, const Points& x,
                         Points& gradient) {
    TermEnergy sum;
    sum.first = terms[0].term->add_potential(step, x, gradient);
    sum.others = terms[1].term->add_potential(step, x, gradient);
    for (std::size_t i = 2; i < terms.size(); ++i)
        sum.others += terms[i].term->add_potential(step, x, gradient);
    return sum;
}

void add_hessian(const FaceTerms& terms, const solve::ImplicitStep& step, const Points& x,
                 solve::Curvature curvature, solve::HessianBuilder& hessian) {
    in_order_of_matrices(terms, [&](const solve::EnergyTerm& term) {
        term.add_hessian(step, x, curvature, hessian);
    });
}

void add_metric(const FaceTerms& terms, double step_s, solve::MetricBuilder& metric) {
    in_order_of_matrices(terms,
                         [&](const solve::EnergyTerm& term) { term.add_metric(step_s, metric); });
}

}  // namespace risorius::face
