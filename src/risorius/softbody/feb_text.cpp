// SPDX-License-Identifier: MIT
#include "risorius/softbody/feb_text.h"

#include "risorius/core/error.h"
#include "risorius/io/xml_writer.h"
#include "risorius/tissue/hyperelastic_tets.h"

namespace risorius::softbody {

namespace {

constexpr std::size_t kMostTerms = 6;  // of an Ogden material of FEBio
constexpr int kSteps = 10;

std::string attributes(std::initializer_list<std::pair<const char*, std::string>> list) {
    std::string out;
    for (const auto& [name, value] : list) out += io::xml_attribute(name, value);
    return out;
}

std::string comma_text(const Vec3& v) {
    return format_number(v[0] + 0.0) + "," + format_number(v[1] + 0.0) + "," +
           format_number(v[2] + 0.0);
}

std::string part_name(std::size_t region) { return "part" + std::to_string(region + 1); }

void write_material(const MeshRegion& region, std::size_t index, io::XmlWriter& xml) {
    const tissue::Hyperelastic& law = region.material;
    const bool fibres = law.fibres.c3_pa > 0, ogden = !law.ogden.empty();
    const std::string type = fibres ? "trans iso Mooney-Rivlin" : ogden ? "Ogden" : "Mooney-Rivlin";
    xml.open("material", attributes({{"id", std::to_string(index + 1)},
                                     {"name", "material" + std::to_string(index + 1)},
                                     {"type", type}}));
    xml.value("density", region.density_kg_per_m3);
    xml.value("k", law.bulk_pa);
    xml.value("pressure_model", "2");
    if (ogden) {
        if (law.ogden.size() > kMostTerms)
            throw Error(region.place + "/terms", "at most 6 terms, as FEBio has",
                        std::to_string(law.ogden.size()));
        for (std::size_t t = 0; t < kMostTerms; ++t) {
            const bool used = t < law.ogden.size();
            const std::string number = std::to_string(t + 1);
            xml.value("c" + number, used ? law.ogden[t].modulus_pa * law.ogden[t].exponent : 0.0);
            xml.value("m" + number, used ? law.ogden[t].exponent : 1.0);
        }
    } else {
        xml.value("c1", law.c10_pa);
        xml.value("c2", law.c01_pa);
    }
    if (fibres) {
        xml.value("c3", law.fibres.c3_pa);
        xml.value("c4", law.fibres.c4);
        xml.value("c5", law.fibres.c5_pa);
        xml.value("lam_max", law.fibres.straight);
        xml.open("fiber", attributes({{"type", "vector"}}));
        xml.value("vector", comma_text(region.along));
        xml.close();
    }
    xml.close();
}

void write_mesh(const SoftBody& body, std::size_t regions, io::XmlWriter& xml) {
    const tissue::HyperelasticBody& matter = body.tets->body();
    xml.open("Mesh");
    xml.open("Nodes", attributes({{"name", "body"}}));
    for (Eigen::Index i = 0; i < matter.rest.rows(); ++i)
        xml.line("<node id=\"" + std::to_string(i + 1) + "\">" +
                 comma_text(matter.rest.row(i).transpose()) + "</node>");
    xml.close();
    int element = 0;
    for (std::size_t r = 0; r < regions; ++r) {
        xml.open("Elements", attributes({{"type", "tet4"}, {"name", part_name(r)}}));
        for (Eigen::Index t = 0; t < matter.tets.rows(); ++t) {
            if (matter.material_of[static_cast<std::size_t>(t)] != static_cast<int>(r)) continue;
            std::string corners;
            for (int k = 0; k < 4; ++k)
                corners += (k ? "," : "") + std::to_string(matter.tets(t, k) + 1);
            xml.line("<elem id=\"" + std::to_string(++element) + "\">" + corners + "</elem>");
        }
        xml.close();
    }
    if (!body.fixed.empty()) {
        std::string list;
        for (const int node : body.fixed)
            list += (list.empty() ? "" : ",") + std::to_string(node + 1);
        xml.line("<NodeSet name=\"fixed\">" + list + "</NodeSet>");
    }
    xml.close();
    xml.open("MeshDomains");
    for (std::size_t r = 0; r < regions; ++r)
        xml.line("<SolidDomain" +
                 attributes({{"name", part_name(r)}, {"mat", "material" + std::to_string(r + 1)}}) +
                 " />");
    xml.close();
}

void write_control(io::XmlWriter& xml) {
    xml.open("Control");
    xml.value("analysis", "STATIC");
    xml.value("time_steps", std::to_string(kSteps));
    xml.value("step_size", 1.0 / kSteps);
    xml.open("solver", attributes({{"type", "solid"}}));
    xml.value("symmetric_stiffness", "symmetric");
    xml.close();
    xml.close();
}

/// Supports, and the weight, which grows from nothing to its whole. FEBio's body force points against its vector.
void write_loads(const MeshBodyDescription& description, const SoftBody& body, io::XmlWriter& xml) {
    if (!body.fixed.empty()) {
        xml.open("Boundary");
        xml.open(
            "bc",
            attributes({{"name", "fixed"}, {"node_set", "fixed"}, {"type", "zero displacement"}}));
        for (const char* dof : {"x_dof", "y_dof", "z_dof"}) xml.value(dof, "1");
        xml.close();
        xml.close();
    }
    if (description.gravity_m_per_s2.isZero()) return;
    xml.open("Loads");
    xml.open("body_load", attributes({{"name", "weight"}, {"type", "body force"}}));
    xml.line("<force lc=\"1\" type=\"vector\">" + comma_text(-description.gravity_m_per_s2) +
             "</force>");
    xml.close();
    xml.close();
    xml.open("LoadData");
    xml.open("load_controller", attributes({{"id", "1"}, {"type", "loadcurve"}}));
    xml.value("interpolate", "LINEAR");
    xml.open("points");
    xml.line("<pt>0,0</pt>");
    xml.line("<pt>1,1</pt>");
    xml.close();
    xml.close();
    xml.close();
}

}  // namespace

std::string feb_text(const MeshBodyDescription& description) {
    for (const MeshRegion& region : description.regions)
        if (region.muscle)
            throw Error(region.place, "a material without \"muscle\"", "one with it");
    for (const FixedBox& fixed : description.fixed)
        if (!fixed.whole())
            throw Error(description.place + "/fixed", "boxes without \"axes\"", "one with them");
    const SoftBody body = build_mesh_body(description);
    io::XmlWriter xml;
    xml.line("<?xml version=\"1.0\" encoding=\"UTF-8\"?>");
    xml.open("febio_spec", attributes({{"version", "4.0"}}));
    xml.line("<Module type=\"solid\" />");
    write_control(xml);
    xml.open("Material");
    for (std::size_t r = 0; r < description.regions.size(); ++r)
        write_material(description.regions[r], r, xml);
    xml.close();
    write_mesh(body, description.regions.size(), xml);
    write_loads(description, body, xml);
    xml.open("Output");
    xml.open("plotfile", attributes({{"type", "febio"}}));
    for (const char* field : {"displacement", "stress"})
        xml.line("<var type=\"" + std::string(field) + "\" />");
    xml.close();
    xml.close();
    xml.close();
    return xml.text();
}

}  // namespace risorius::softbody
