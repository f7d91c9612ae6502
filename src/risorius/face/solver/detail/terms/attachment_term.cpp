// SPDX-License-Identifier: MIT
#include "risorius/face/solver/detail/terms/attachment_term.h"

#include <utility>

namespace risorius::face {

namespace {

using Spring = tissue::ZeroLengthSprings::Spring;

class LocalAttachments : public LocalTerm {
  public:
    LocalAttachments(const tissue::ZeroLengthSprings& whole, LocalNodes& nodes) : whole_(whole) {
        std::vector<Spring> springs;
        for (std::size_t i = 0; i < whole.list().size(); ++i) {
            Spring spring = whole.list()[i];
            if (!nodes.moves(spring.node)) continue;
            spring.node = nodes.row(spring.node);
            springs.push_back(spring);
            of_.push_back(i);
        }
        springs_ = tissue::ZeroLengthSprings(std::move(springs));
    }
    void add_metric(const LocalNodes&, double, solve::MetricBuilder& builder) const override {
        springs_.add_metric(builder);
    }
    void begin(const LocalNodes&, const LocalStep&, const Points&) override {
        for (std::size_t i = 0; i < of_.size(); ++i) {
            const Spring& from = whole_.list()[of_[i]];
            springs_.list()[i].target = from.target;
            springs_.list()[i].normal = from.normal;
        }
    }
    void add_energy(const Points& at, double& value, Points& gradient) const override {
        value += springs_.add_energy(at, gradient);
    }

  private:
    const tissue::ZeroLengthSprings& whole_;
    tissue::ZeroLengthSprings springs_{{}};
    std::vector<std::size_t> of_;  // per spring, its number in the whole
};

}  // namespace

AttachmentTerm::AttachmentTerm(std::vector<Spring> springs, std::vector<LidSpring> lid_springs,
                               const std::vector<Attachment>& attachments, const TissueMesh& mesh,
                               const Jaw& jaw, const std::array<EyeLids, 2>& lids)
    : springs_(std::move(springs)),
      lid_springs_(std::move(lid_springs)),
      attachments_(attachments),
      mesh_(mesh),
      jaw_(jaw),
      lids_(lids) {}

double AttachmentTerm::add_potential(const solve::ImplicitStep&, const Points& x,
                                     Points& gradient) const {
    return springs_.add_energy(x, gradient);
}

void AttachmentTerm::add_hessian(const solve::ImplicitStep&, const Points&, solve::Curvature,
                                 solve::HessianBuilder& hessian) const {
    springs_.add_hessian(hessian);
}

void AttachmentTerm::add_metric(double, solve::MetricBuilder& metric) const {
    springs_.add_metric(metric);
}

void AttachmentTerm::set_boundary_conditions(const BoundaryState& boundary) {
    move_mandible(boundary.mandible);
    for (std::size_t i = 0; i < attachments_.size(); ++i) {
        const Attachment& a = attachments_[i];
        springs_.list()[i].normal =
            ((1 - a.jaw_weight) * mesh_.direction[a.shell_vertex] +
             a.jaw_weight * (boundary.mandible.linear() * mesh_.direction[a.shell_vertex]))
                .normalized();
    }
    for (std::size_t i = 0; i < lid_springs_.size(); ++i) {
        const LidSpring& lid = lid_springs_[i];
        springs_.list()[attachments_.size() + i].target =
            lid.rest + lids_[lid.side].ride(lid.rest, lid.member, boundary.lid[lid.side]);
    }
}

void AttachmentTerm::move_mandible(const Rigid& mandible) {
    const double chin_back = jaw_.chin_back(mandible);
    for (std::size_t i = 0; i < attachments_.size(); ++i) {
        Spring& spring = springs_.list()[i];
        const Vec3 rest = mesh_.nodes.row(spring.node).transpose();
        spring.target = attachments_[i].target(rest, mandible, chin_back);
    }
}

void AttachmentTerm::carry(Points& x, const Rigid& from, const Rigid& to) const {
    if (from.isApprox(to, 0.0)) return;
    for (const Attachment& at : attachments_)
        for (Layer layer : {kDeep, kMiddle, kSkin}) {
            const int node = node_of(at.shell_vertex, layer);
            const Vec3 rest = mesh_.nodes.row(node).transpose();
            x.row(node) += at.jaw_weight * (to * rest - from * rest).transpose();
        }
}

void AttachmentTerm::add_mandible_gradient(const Rigid& mandible, const Points& x,
                                           const Points& gradient, Wrench& sum) const {
    for (std::size_t i = 0; i < attachments_.size(); ++i) {
        const double fraction = attachments_[i].jaw_weight;
        const Vec3& bulge = attachments_[i].floor_bulge;
        if (fraction == 0 && bulge.isZero(0.0)) continue;
        // The nodes that follow the mandible, then the spring that pulls at its target
        for (Layer layer : {kDeep, kMiddle, kSkin}) {
            const int node = node_of(attachments_[i].shell_vertex, layer);
            sum.add(fraction * gradient.row(node).transpose(),
                    mandible * Vec3(mesh_.nodes.row(node).transpose()));
        }
        const Spring& t = springs_.list()[i];
        const Vec3 off = x.row(t.node).transpose() - t.target;
        const Vec3 pull =
            t.kt_n_per_m * off + (t.kn_n_per_m - t.kt_n_per_m) * off.dot(t.normal) * t.normal;
        sum.add(-fraction * pull, mandible * Vec3(mesh_.nodes.row(t.node).transpose()));
        // The floor bulges as far as the chin moves back, along -z
        sum.add(bulge.dot(pull) * Vec3::UnitZ(), mandible * jaw_.chin());
    }
}

std::unique_ptr<LocalTerm> AttachmentTerm::restricted_to(LocalNodes& nodes) const {
    return std::make_unique<LocalAttachments>(springs_, nodes);
}

}  // namespace risorius::face
