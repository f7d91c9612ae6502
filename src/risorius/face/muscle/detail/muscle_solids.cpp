// SPDX-License-Identifier: MIT
#include "risorius/face/muscle/detail/muscle_solids.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace risorius::face {

namespace {

constexpr double kBinding_pa_per_m = 2e7;  // muscle to the tissue around it, by area of a node
constexpr double kEndBinding = 15;         // factor for the ends that pull on soft tissue
constexpr double kSupport_pa_per_m = 2e7;  // of the deep side of a jaw muscle on its bone, per area
constexpr double kInside_m = 0.2e-3;       // nodes farther outside of the tissue are not bound

Vec3 blended(const std::array<Rigid, kBodies>& bodies, double jaw_fraction, const Vec3& rest) {
    return (1 - jaw_fraction) * (bodies[kSkullBody] * rest) +
           jaw_fraction * (bodies[kMandibleBody] * rest);
}

}  // namespace

MuscleSolids::MuscleSolids(const rig::Head& head, const rig::RigDescription& rig, const Jaw& jaw,
                           const Shell& shell, const TissueMesh& mesh,
                           std::vector<Attachment>& attachments)
    : first_(static_cast<int>(mesh.nodes.rows())) {
    rest_.resize(0, 3);
    mass_.resize(0);
    if (rig.solids.empty()) return;
    const TissueLocator locator(head, shell, mesh);
    placement_ = place_solids(head, rig, jaw, locator);
    rest_.resize(static_cast<long>(placement_.nodes.size()), 3);
    for (long i = 0; i < rest_.rows(); ++i)
        rest_.row(i) = placement_.nodes[static_cast<std::size_t>(i)].rest.transpose();
    bone_ = rest_;
    build_parts(rig);
    bind(locator, mesh, attachments);
    for (std::size_t v = 0; v < shell.vertex.size(); ++v)
        if (shell.fixed[v])
            for (Layer layer : {kDeep, kMiddle, kSkin})
                held_tissue_.push_back(node_of(static_cast<int>(v), layer));
    build_groups();
}

void MuscleSolids::build_parts(const rig::RigDescription& rig) {
    mass_ = Eigen::VectorXd::Zero(nodes());
    for (const SolidPart& place : placement_.parts) {
        Part part;
        part.belly = make_belly(place, placement_, rig);
        const Eigen::VectorXd mass = part.belly->mass_kg();
        for (std::size_t i = 0; i < place.node.size(); ++i)
            mass_[place.node[i]] += mass[static_cast<long>(i)];
        parts_.push_back(std::move(part));
    }
}

void MuscleSolids::bind(const TissueLocator& locator, const TissueMesh& mesh,
                        std::vector<Attachment>& attachments) {
    const Eigen::VectorXd volume = mass_ / kMuscleDensity_kg_m3;
    const auto area = [&](int node) { return std::pow(volume[node], 2.0 / 3.0); };
    for (int i = 0; i < nodes(); ++i) {
        const SolidNode& node = placement_.nodes[static_cast<std::size_t>(i)];
        if (node.on_bone) continue;
        const muscle::FibrePoint in = locator.embed(node.rest);
        Vec3 found = Vec3::Zero();
        for (int k = 0; k < 4; ++k)
            found += in.weights[k] * mesh.nodes.row(in.nodes[k]).transpose();
        if ((found - node.rest).norm() > kInside_m) continue;
        Binding binding{};
        binding.tissue_count = 4;
        for (int k = 0; k < 4; ++k) {
            binding.tissue[k] = in.nodes[k];
            binding.tissue_weight[k] = in.weights[k];
        }
        binding.solid_count = 1;
        binding.solid[0] = i;
        binding.solid_weight[0] = 1;
        binding.stiffness_n_per_m =
            kBinding_pa_per_m * area(i) * (node.soft_end ? kEndBinding : 1.0);
        bindings_.push_back(binding);
    }

    // Deep tissue in or just above a jaw muscle is bound to the muscle instead of the bone
    for (Attachment& attachment : attachments) {
        const int tissue_node = node_of(attachment.shell_vertex, kDeep);
        const Vec3 p = mesh.nodes.row(tissue_node).transpose();
        double least_excess = 0.35;
        Binding best{};
        for (const Part& part : parts_) {
            if (part.place().muscle->group != "jaw") continue;
            BellyPoint point;
            part.belly->find(p, least_excess, point);
            if (point.count == 0) continue;
            best = {};
            best.tissue_count = 1;
            best.tissue[0] = tissue_node;
            best.tissue_weight[0] = 1;
            best.solid_count = point.count;
            for (std::size_t c = 0; c < static_cast<std::size_t>(point.count); ++c) {
                best.solid[c] = part.place().node[static_cast<std::size_t>(point.node[c])];
                best.solid_weight[c] = point.weight[c];
            }
        }
        if (best.solid_count == 0) continue;
        best.stiffness_n_per_m = std::max(attachment.normal_n_per_m, attachment.tangential_n_per_m);
        attachment.normal_n_per_m = attachment.tangential_n_per_m = 0;
        bindings_.push_back(best);
    }

    for (Binding& binding : bindings_) {
        binding.apart_at_rest.setZero();
        for (int k = 0; k < binding.tissue_count; ++k)
            binding.apart_at_rest +=
                binding.tissue_weight[k] * mesh.nodes.row(binding.tissue[k]).transpose();
        for (int k = 0; k < binding.solid_count; ++k)
            binding.apart_at_rest -=
                binding.solid_weight[k] * rest_.row(binding.solid[k]).transpose();
    }
    add_supports();
}

void MuscleSolids::add_supports() {
    const Eigen::VectorXd volume = mass_ / kMuscleDensity_kg_m3;
    const auto area = [&](int node) { return std::pow(volume[node], 2.0 / 3.0); };
    std::vector<tissue::ZeroLengthSprings::Spring> supports;
    for (int i = 0; i < nodes(); ++i) {
        const SolidNode& node = placement_.nodes[static_cast<std::size_t>(i)];
        if (!node.against_bone) continue;
        supports.push_back({first_ + i, node.rest, node.outward, kSupport_pa_per_m * area(i), 0.0});
        support_node_.push_back(i);
    }
    supports_ = std::make_unique<tissue::ZeroLengthSprings>(supports);
}

bool MuscleSolids::is_solid(const std::string& muscle) const {
    return std::any_of(parts_.begin(), parts_.end(),
                       [&](const Part& part) { return part.place().muscle->id == muscle; });
}

void MuscleSolids::move_bodies(const std::array<Rigid, kBodies>& bodies) {
    mandible_ = bodies[kMandibleBody];
    for (int i = 0; i < nodes(); ++i) {
        const SolidNode& node = placement_.nodes[static_cast<std::size_t>(i)];
        if (node.on_bone) bone_.row(i) = blended(bodies, node.jaw_fraction, node.rest).transpose();
    }
    for (std::size_t i = 0; i < support_node_.size(); ++i) {
        const SolidNode& node = placement_.nodes[static_cast<std::size_t>(support_node_[i])];
        supports_->list()[i].target = blended(bodies, node.jaw_fraction, node.rest);
    }
}

void MuscleSolids::set_bodies(const std::array<Rigid, kBodies>& bodies) {
    move_bodies(bodies);
    for (std::size_t i = 0; i < support_node_.size(); ++i) {
        const SolidNode& node = placement_.nodes[static_cast<std::size_t>(support_node_[i])];
        supports_->list()[i].normal =
            ((1 - node.jaw_fraction) * (bodies[kSkullBody].linear() * node.outward) +
             node.jaw_fraction * (bodies[kMandibleBody].linear() * node.outward))
                .normalized();
    }
}

void MuscleSolids::add_riding(const Rigid& mandible, const Points& gradient, Wrench& sum) const {
    for (int i = 0; i < nodes(); ++i) {
        const SolidNode& node = placement_.nodes[static_cast<std::size_t>(i)];
        if (!node.on_bone && node.jaw_fraction != 0)
            sum.add(node.jaw_fraction * gradient.row(first_ + i).transpose(), mandible * node.rest);
    }
}

void MuscleSolids::carry(Points& x, const Rigid& from, const Rigid& to) const {
    for (int i = 0; i < nodes(); ++i) {
        const SolidNode& node = placement_.nodes[static_cast<std::size_t>(i)];
        if (node.on_bone)
            x.row(first_ + i) =
                ((1 - node.jaw_fraction) * node.rest + node.jaw_fraction * (to * node.rest))
                    .transpose();
        else
            x.row(first_ + i) +=
                node.jaw_fraction * (to * node.rest - from * node.rest).transpose();
    }
}

void MuscleSolids::take(const Part& part, const Points& x, Points& local) const {
    local.resize(static_cast<long>(part.place().node.size()), 3);
    for (std::size_t i = 0; i < part.place().node.size(); ++i) {
        const int node = part.place().node[i];
        local.row(static_cast<long>(i)) = placement_.nodes[static_cast<std::size_t>(node)].on_bone
                                              ? bone_.row(node)
                                              : x.row(first_ + node);
    }
}

double MuscleSolids::add_energy(const Points& x, const Eigen::VectorXd& activation,
                                Points& gradient, Wrenches* on_bodies) const {
    if (empty()) return 0;
    solid_b_.setZero(nodes(), 3);  // gradient by the nodes of the muscles
    double energy = 0;
    for (const Part& part : parts_) {
        take(part, x, part.x);
        part.gradient.setZero(part.x.rows(), 3);
        part.belly->add_energy(part.x, activation[part.place().column], energy, part.gradient);
        for (std::size_t i = 0; i < part.place().node.size(); ++i)
            solid_b_.row(part.place().node[i]) += part.gradient.row(static_cast<long>(i));
    }
    for (const Binding& binding : bindings_) {
        Vec3 apart = -binding.apart_at_rest;
        for (int k = 0; k < binding.tissue_count; ++k)
            apart += binding.tissue_weight[k] * x.row(binding.tissue[k]).transpose();
        for (int k = 0; k < binding.solid_count; ++k) {
            const int node = binding.solid[k];
            apart -=
                binding.solid_weight[k] * (placement_.nodes[static_cast<std::size_t>(node)].on_bone
                                               ? bone_.row(node)
                                               : x.row(first_ + node))
                                              .transpose();
        }
        const Vec3 pull = binding.stiffness_n_per_m * apart;
        energy += 0.5 * apart.dot(pull);
        for (int k = 0; k < binding.tissue_count; ++k)
            gradient.row(binding.tissue[k]) += binding.tissue_weight[k] * pull.transpose();
        for (int k = 0; k < binding.solid_count; ++k)
            solid_b_.row(binding.solid[k]) -= binding.solid_weight[k] * pull.transpose();
    }
    energy += supports_->add_energy(x, gradient);
    for (int i = 0; i < nodes(); ++i)
        if (!placement_.nodes[static_cast<std::size_t>(i)].on_bone)
            gradient.row(first_ + i) += solid_b_.row(i);
    if (on_bodies == nullptr) return energy;

    // A node between both bones pulls each with its fraction, at the point where it would be on that bone alone
    const auto give = [&](const SolidNode& node, const Vec3& force) {
        (*on_bodies)[kSkullBody].add((1 - node.jaw_fraction) * force, node.rest);
        (*on_bodies)[kMandibleBody].add(node.jaw_fraction * force, mandible_ * node.rest);
    };
    for (int i = 0; i < nodes(); ++i)
        if (on_bone(i))
            give(placement_.nodes[static_cast<std::size_t>(i)], -solid_b_.row(i).transpose());
    for (std::size_t i = 0; i < support_node_.size(); ++i) {
        const tissue::ZeroLengthSprings::Spring& support = supports_->list()[i];
        const Vec3 off = x.row(support.node).transpose() - support.target;
        give(placement_.nodes[static_cast<std::size_t>(support_node_[i])],
             support.kn_n_per_m * off.dot(support.normal) * support.normal);
    }
    return energy;
}

void MuscleSolids::add_springs(const Points& x, std::vector<Spring>& springs) const {
    for (const Binding& binding : bindings_) {
        Spring spring{.count = binding.tissue_count,
                      .target = binding.apart_at_rest,
                      .stiffness_n_per_m = binding.stiffness_n_per_m};
        std::copy_n(binding.tissue, 4, spring.nodes);
        std::copy_n(binding.tissue_weight, 4, spring.weights);
        for (int k = 0; k < binding.solid_count; ++k) {
            const int node = binding.solid[k];
            spring.target +=
                binding.solid_weight[k] * (placement_.nodes[static_cast<std::size_t>(node)].on_bone
                                               ? bone_.row(node)
                                               : x.row(first_ + node))
                                              .transpose();
        }
        springs.push_back(spring);
    }
}

void MuscleSolids::add_metric(solve::MetricBuilder& builder) const {
    // Tissue that is released from the bone is held by a muscle that is itself held. A muscle inside the tissue is not stiffer than the
    // tissue; counting it would cost iterations.
    for (const Binding& binding : bindings_)
        if (binding.tissue_count == 1)
            builder.add_diagonal(binding.tissue[0], binding.stiffness_n_per_m);
}

void MuscleSolids::set_strength(const std::string& muscle, double factor) {
    for (Part& part : parts_)
        if (part.place().muscle->id == muscle) part.belly->set_strength(factor);
    forget();
}

double MuscleSolids::mean_stretch(const std::string& muscle, const Points& x,
                                  const Eigen::VectorXd& activation) const {
    double sum = 0;
    int count = 0;
    Points local;
    for (const Part& part : parts_) {
        if (part.place().muscle->id != muscle) continue;
        take(part, x, local);
        sum += part.belly->mean_stretch(local, activation[part.place().column]);
        ++count;
    }
    return count > 0 ? sum / count : 1.0;
}

std::vector<muscle::ChainSet::State> MuscleSolids::chain_states(
    const std::string& muscle, Side side, const Points& x,
    const Eigen::VectorXd& activation) const {
    Points local;
    for (const Part& part : parts_) {
        if (part.place().muscle->id != muscle || part.place().side != side) continue;
        take(part, x, local);
        return part.belly->chain_states(local, activation[part.place().column]);
    }
    return {};
}

std::optional<double> MuscleSolids::greatest_force_n(int column) const {
    for (const Part& part : parts_)
        if (part.place().column == column) return part.belly->f0_n();
    return std::nullopt;
}

std::vector<MuscleSolids::Line> MuscleSolids::lines() const {
    using Body = rig::PathPoint::Body;
    std::vector<Line> out;
    for (const Part& part : parts_) {
        Line line{.muscle = part.place().muscle->id,
                  .column = part.place().column,
                  .path = {},
                  .body = {},
                  .chain = {}};
        line.chain = part.belly->chain();
        line.f0_n = part.belly->f0_n();
        for (const std::vector<int>& section : part.belly->sections()) {
            const auto count = static_cast<double>(section.size());
            Vec3 sum = Vec3::Zero();
            double jaw = 0;
            bool bone = false;
            for (const int of_belly : section) {
                const SolidNode& node = placement_.nodes[static_cast<std::size_t>(
                    part.place().node[static_cast<std::size_t>(of_belly)])];
                sum += node.rest / count;
                jaw += node.jaw_fraction / count;
                bone |= node.on_bone;
            }
            line.path.push_back(sum);
            line.body.push_back(!bone ? Body::kSoft : jaw > 0.5 ? Body::kMandible : Body::kSkull);
        }
        out.push_back(std::move(line));
    }
    return out;
}

std::vector<SolidFigures> MuscleSolids::figures(const Points& x,
                                                const Eigen::VectorXd& activation) const {
    std::vector<SolidFigures> out;
    Points local;
    for (const Part& part : parts_) {
        take(part, x, local);
        out.push_back(part.belly->figures(local, activation[part.place().column]));
    }
    return out;
}

std::vector<SolidCellState> MuscleSolids::cell_states(const Points& x,
                                                      const Eigen::VectorXd& activation) const {
    std::vector<SolidCellState> out;
    Points local;
    for (const Part& part : parts_) {
        take(part, x, local);
        part.belly->add_cell_states(local, activation[part.place().column], out);
    }
    return out;
}

double MuscleSolids::max_volume_error(const Points& x) const {
    double worst = 0;
    Points local;
    for (const Part& part : parts_) {
        take(part, x, local);
        worst =
            std::max(worst, std::abs(part.belly->volume(local) / part.belly->rest_volume() - 1));
    }
    return worst;
}

void MuscleSolids::add_surfaces(MuscleSurfaces& surfaces) {
    for (Part& part : parts_) {
        const SolidPart& place = part.place();
        BellySurface made =
            part.belly->surface({on_bone(place.node.front()), on_bone(place.node.back())});
        part.first_vertex = surfaces.rest.rows();
        surfaces.add(surfaces.of(place.muscle->id,
                                 place.muscle->paired ? std::optional(place.side) : std::nullopt,
                                 place.column),
                     made.weights * part.belly->rest(), made.fibre, made.tendon, made.triangles);
        part.surface = std::move(made.weights);
    }
}

void MuscleSolids::place_surfaces(const Points& x, Points& vertices) const {
    Points local;
    for (const Part& part : parts_) {
        take(part, x, local);
        vertices.middleRows(part.first_vertex, part.surface.rows()) = part.surface * local;
    }
}

}  // namespace risorius::face
