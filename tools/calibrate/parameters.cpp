// SPDX-License-Identifier: MIT
#include "tools/calibrate/parameters.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace risorius::calibrate {

namespace {

void add_attachments(const rig::RigDescription& rig, std::vector<Parameter>& out) {
    for (const rig::AttachmentSample& sample : rig.atlas.attachments) {
        const std::string id = sample.landmark, mirror = rig::mirrored_landmark(id);
        if (id > mirror) continue;  // one entry for both sides
        for (const bool along : {false, true})
            out.push_back({(along ? "slide " : "lift ") + id, 1.0, 0.1, 3.5,
                           [id, mirror, along](rig::RigDescription& changed, double value) {
                               for (rig::AttachmentSample& one : changed.atlas.attachments)
                                   if (one.landmark == id || one.landmark == mirror)
                                       (along ? one.tangential_pa_per_m : one.normal_pa_per_m) *=
                                           std::exp(value);
                           }});
    }
}

void add_bands(const rig::RigDescription& rig, std::vector<Parameter>& out) {
    std::set<std::string> muscles;
    for (std::size_t b = 0; b < rig.atlas.bands.size(); ++b) {
        const rig::MuscleBand& band = rig.atlas.bands[b];
        if (muscles.insert(band.muscle).second)
            out.push_back({"strength " + band.muscle, 0.5, 0.05, 2.0,
                           [muscle = band.muscle](rig::RigDescription& changed, double value) {
                               for (rig::MuscleBand& one : changed.atlas.bands)
                                   if (one.muscle == muscle) one.strength *= std::exp(value);
                           }});
        // A band across the midline must stay symmetric.
        const std::size_t count = band.points.size();
        const bool crosses = band.crosses_midline();
        for (std::size_t i = 0; i < (crosses ? (count + 1) / 2 : count); ++i) {
            const std::size_t mirror = crosses ? count - 1 - i : i;
            const bool bone = (i == 0 && band.origin_attach == "bone") ||
                              (i + 1 == count && band.insertion_attach == "bone");
            const std::string name =
                band.muscle + " " + std::to_string(b) + "." + std::to_string(i);
            for (int k = 0; k < 3; ++k) {
                if (crosses && mirror == i && k == 0) continue;
                out.push_back({name + " " + "xyz"[k] + std::string(" mm"), bone ? 1.5 : 2.5, 0.7,
                               bone ? 4.0 : 7.0,
                               [b, i, mirror, k](rig::RigDescription& changed, double value) {
                                   rig::MuscleBand& one = changed.atlas.bands[b];
                                   one.points[i].offset[k] += 1e-3 * value;
                                   if (mirror != i)
                                       one.points[mirror].offset[k] +=
                                           (k == 0 ? -1e-3 : 1e-3) * value;
                               }});
            }
            if (band.points[i].depth >= 0 && !bone)
                out.push_back({name + " depth", 0.12, 0.03, 0.4,
                               [b, i, mirror](rig::RigDescription& changed, double value) {
                                   rig::MuscleBand& one = changed.atlas.bands[b];
                                   double& depth = one.points[i].depth;
                                   depth = std::clamp(depth + value, 0.08, 0.95);
                                   if (mirror != i) one.points[mirror].depth = one.points[i].depth;
                               }});
        }
    }
}

void add_tissue(std::vector<Parameter>& out) {
    const auto log_of = [&](const char* name, auto member, double spread) {
        out.push_back(
            {name, spread, 0.05, 1.5, [member](rig::RigDescription& changed, double value) {
                 changed.tissue.*member *= std::exp(value);
             }});
    };
    using T = rig::TissueDescription;
    log_of("deep shear", &T::deep_shear_pa, 0.4);
    log_of("superficial shear", &T::superficial_shear_pa, 0.4);
    log_of("bulk", &T::bulk_pa, 0.3);
    log_of("lid shear ratio", &T::lid_shear_ratio, 0.5);
    log_of("lip shear ratio", &T::lip_shear_ratio, 0.5);
    log_of("modiolus shear ratio", &T::modiolus_shear_ratio, 0.5);
    log_of("passive strain", &T::fibre_passive_strain, 0.2);
    const auto skin = [&](const char* name, auto member, double spread) {
        out.push_back(
            {name, spread, 0.05, 1.5, [member](rig::RigDescription& changed, double value) {
                 changed.skin.*member *= std::exp(value);
             }});
    };
    using S = rig::SkinDescription;
    skin("membrane", &S::membrane_n_per_m, 0.4);
    skin("bending", &S::bending_n_m, 0.4);
    skin("lid membrane ratio", &S::lid_membrane_ratio, 0.5);
}

}  // namespace

std::vector<Parameter> anatomy_parameters(const rig::RigDescription& rig) {
    std::vector<Parameter> out;
    add_attachments(rig, out);
    add_bands(rig, out);
    add_tissue(out);
    return out;
}

rig::RigDescription changed(const rig::RigDescription& rig,
                            const std::vector<Parameter>& parameters,
                            const Eigen::VectorXd& values) {
    rig::RigDescription out = rig;
    for (std::size_t p = 0; p < parameters.size(); ++p)
        if (values[static_cast<long>(p)] != 0) parameters[p].add(out, values[static_cast<long>(p)]);
    return out;
}

}  // namespace risorius::calibrate
