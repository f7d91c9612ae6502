// SPDX-License-Identifier: MIT
#include "risorius/animate/detail/osim_text.h"

#include <algorithm>
#include <map>

#include "risorius/core/json_cursor.h"
#include "risorius/io/xml_writer.h"

namespace risorius::animate {

namespace {

constexpr double kBallRadius_m = 0.04;  // inertia of the mandible is that of a ball of this radius
constexpr double kHyoid_kg = 0.05;      // it does not move, so its mass has no effect

std::string vector_text(const Vec3& v) {
    return format_number(v[0] + 0.0) + " " + format_number(v[1] + 0.0) + " " +
           format_number(v[2] + 0.0);
}

/// Axes of OpenSim from those of the head.
Vec3 osim_axes(const Vec3& v) { return {v[2], v[1], -v[0]}; }

std::string_view frame_of(rig::PathPoint::Body body) {
    return body == rig::PathPoint::Body::kMandible ? "/bodyset/mandible"
           : body == rig::PathPoint::Body::kHyoid  ? "/bodyset/hyoid"
                                                   : "/ground";
}

void write_body(const std::string& name, double mass_kg, const Vec3& centre, io::XmlWriter& xml) {
    const double inertia = 0.4 * mass_kg * kBallRadius_m * kBallRadius_m;
    xml.open("Body", io::xml_attribute("name", name));
    xml.value("mass", mass_kg);
    xml.value("mass_center", vector_text(centre));
    xml.value("inertia", vector_text(Vec3::Constant(inertia)) + " 0 0 0");
    xml.close();
}

void write_frame(const std::string& name, const std::string& parent, const Vec3& place,
                 io::XmlWriter& xml) {
    xml.open("PhysicalOffsetFrame", io::xml_attribute("name", name));
    xml.value("socket_parent", parent);
    xml.value("translation", vector_text(place));
    xml.value("orientation", "0 0 0");
    xml.close();
}

/// A joint between the ground and a body, at the same place in both.
void write_joint(const std::string& kind, const std::string& name, const std::string& body,
                 const Vec3& place, double open_rad, io::XmlWriter& xml) {
    xml.open(kind, io::xml_attribute("name", name));
    xml.value("socket_parent_frame", "ground_offset");
    xml.value("socket_child_frame", body + "_offset");
    if (kind == "PinJoint") {
        xml.open("coordinates");
        xml.open("Coordinate", io::xml_attribute("name", "jaw_angle"));
        xml.value("default_value", 0.0);
        xml.value("range", format_number(-open_rad) + " 0");
        xml.value("clamped", "true");
        xml.close();
        xml.close();
    }
    xml.open("frames");
    write_frame("ground_offset", "/ground", place, xml);
    write_frame(body + "_offset", "/bodyset/" + body, place, xml);
    xml.close();
    xml.close();
}

void write_muscle(const std::string& name, const face::MuscleLine& line, io::XmlWriter& xml) {
    xml.open("Millard2012EquilibriumMuscle", io::xml_attribute("name", name));
    xml.value("min_control", 0.0);
    xml.value("max_control", 1.0);
    xml.open("GeometryPath", io::xml_attribute("name", "geometrypath"));
    xml.open("PathPointSet");
    xml.open("objects");
    for (std::size_t p = 0; p < line.path.size(); ++p) {
        xml.open("PathPoint", io::xml_attribute("name", name + "-P" + std::to_string(p + 1)));
        xml.value("socket_parent_frame", std::string(frame_of(line.path[p].body)));
        xml.value("location", vector_text(osim_axes(line.path[p].rest)));
        xml.close();
    }
    xml.close();
    xml.line("<groups />");
    xml.close();
    xml.close();
    xml.value("max_isometric_force", line.f0_n);
    xml.value("optimal_fiber_length", line.optimal_m);
    xml.value("tendon_slack_length", line.slack_m);
    xml.value("pennation_angle_at_optimal", line.pennation_rad);
    xml.value("max_contraction_velocity", line.max_speed_hz);
    xml.value("ignore_tendon_compliance", "true");
    xml.value("activation_time_constant", line.activation_s);
    xml.value("deactivation_time_constant", line.deactivation_s);
    xml.close();
}

/// A group of the lines of each muscle and side.
void write_groups(const std::vector<face::MuscleLine>& lines, const std::vector<std::string>& names,
                  io::XmlWriter& xml) {
    std::map<std::string, std::string> members;
    for (std::size_t i = 0; i < lines.size(); ++i) {
        std::string& of = members[lines[i].muscle];
        of += (of.empty() ? "" : " ") + names[i];
    }
    xml.open("groups");
    for (const auto& [muscle, list] : members) {
        xml.open("ObjectGroup", io::xml_attribute("name", muscle));
        xml.value("members", list);
        xml.close();
    }
    xml.close();
}

}  // namespace

std::vector<std::string> osim_names(const std::vector<face::MuscleLine>& lines) {
    std::vector<std::string> out;
    for (const face::MuscleLine& line : lines) {
        const bool several = std::any_of(lines.begin(), lines.end(), [&](const auto& other) {
            return other.column == line.column && other.side == line.side && other.part > 1;
        });
        out.push_back(line.muscle + (several ? "_" + std::to_string(line.part) : "") +
                      (line.side ? *line.side == Side::kLeft ? "_l" : "_r" : ""));
    }
    return out;
}

std::string osim_text(const std::string& name, const std::vector<face::MuscleLine>& lines,
                      const face::JawHinge& hinge) {
    const std::vector<std::string> names = osim_names(lines);
    const Vec3 centre = osim_axes(hinge.centre);
    io::XmlWriter xml;
    xml.line("<?xml version=\"1.0\" encoding=\"UTF-8\" ?>");
    xml.line("<OpenSimDocument Version=\"40000\">");
    xml.open("Model", io::xml_attribute("name", name));
    xml.line("<ground name=\"ground\" />");
    xml.value("gravity", "0 -9.81 0");
    xml.value("length_units", "meters");
    xml.value("force_units", "N");
    xml.open("BodySet", io::xml_attribute("name", "bodyset"));
    xml.open("objects");
    write_body("mandible", hinge.mandible_kg, centre + Vec3(kBallRadius_m, -kBallRadius_m, 0), xml);
    write_body("hyoid", kHyoid_kg, Vec3::Zero(), xml);
    xml.close();
    xml.line("<groups />");
    xml.close();
    xml.open("JointSet", io::xml_attribute("name", "jointset"));
    xml.open("objects");
    write_joint("PinJoint", "jaw", "mandible", centre, hinge.open_rad, xml);
    write_joint("WeldJoint", "hyoid_held", "hyoid", Vec3::Zero(), 0, xml);
    xml.close();
    xml.line("<groups />");
    xml.close();
    xml.open("ForceSet", io::xml_attribute("name", "forceset"));
    xml.open("objects");
    for (std::size_t i = 0; i < lines.size(); ++i) write_muscle(names[i], lines[i], xml);
    xml.close();
    write_groups(lines, names, xml);
    xml.close();
    xml.close();
    xml.line("</OpenSimDocument>");
    return xml.text();
}

std::string storage_text(const std::string& name, const std::vector<std::string>& names,
                         const std::vector<double>& times_s,
                         const std::vector<std::vector<double>>& rows) {
    std::string out = name + "\nversion=1\nnRows=" + std::to_string(times_s.size()) +
                      "\nnColumns=" + std::to_string(names.size() + 1) +
                      "\ninDegrees=no\nendheader\ntime";
    for (const std::string& column : names) out += "\t" + column;
    out += "\n";
    for (std::size_t row = 0; row < times_s.size(); ++row) {
        out += format_number(times_s[row]);
        for (const double value : rows[row]) out += "\t" + format_number(value);
        out += "\n";
    }
    return out;
}

}  // namespace risorius::animate
