// SPDX-License-Identifier: MIT
#include "risorius/softbody/action_description.h"

#include <numbers>

#include "risorius/softbody/detail/read_numbers.h"

namespace risorius::softbody {
namespace {

Vec3 material_point(const JsonCursor& json, int axes) {
    const auto parts = json.items();
    if (static_cast<int>(parts.size()) != axes)
        json.fail(std::to_string(axes) + " material coordinates");
    Vec3 a = Vec3::Zero();
    for (std::size_t i = 0; i < parts.size(); ++i)
        a[static_cast<long>(i)] = parts[i].number({0, 1});
    return a;
}

Vec3 direction_of(const JsonCursor& json) {
    const Vec3 direction = json.vec3();
    if (!(direction.norm() > 0)) json.fail("a direction");
    return direction.normalized();
}

std::shared_ptr<const contact::Obstacle> read_shape(const JsonCursor& json) {
    if (const auto plane = json.find("plane")) {
        plane->allow_keys({"point_m", "normal"});
        return std::make_shared<contact::Obstacle>(
            contact::make_plane(),
            contact::plane_place(plane->at("point_m").vec3(), direction_of(plane->at("normal"))));
    }
    if (const auto sphere = json.find("sphere")) {
        sphere->allow_keys({"centre_m", "radius_m"});
        Rigid place = Rigid::Identity();
        place.translation() = sphere->at("centre_m").vec3();
        return std::make_shared<contact::Obstacle>(
            contact::make_sphere(detail::positive(sphere->at("radius_m")), sphere->place()), place);
    }
    const JsonCursor capsule = json.at("capsule");
    capsule.allow_keys({"start_m", "end_m", "radius_m"});
    return std::make_shared<contact::Obstacle>(
        contact::make_capsule(capsule.at("start_m").vec3(), capsule.at("end_m").vec3(),
                              detail::positive(capsule.at("radius_m")), capsule.place()));
}

}  // namespace

contact::ContactMaterial read_contact(const JsonCursor& json) {
    json.allow_keys(
        {"stiffness_pa_per_m", "thickness_m", "friction", "slip_speed_m_per_s", "damping_s"});
    contact::ContactMaterial material;
    if (const auto value = json.find("stiffness_pa_per_m"))
        material.stiffness_pa_per_m = detail::positive(*value);
    if (const auto value = json.find("thickness_m"))
        material.thickness_m = detail::positive(*value);
    material.friction = detail::not_negative(json, "friction", material.friction);
    if (const auto value = json.find("slip_speed_m_per_s"))
        material.slip_speed_m_per_s = detail::positive(*value);
    material.damping_s = detail::not_negative(json, "damping_s", material.damping_s);
    return material;
}

std::vector<SpringDescription> read_springs(const JsonCursor& json, int axes) {
    std::vector<SpringDescription> springs;
    for (const JsonCursor& entry : json.items()) {
        entry.allow_keys(
            {"at", "tied_to_m", "stiffness_n_per_m", "rest_length_m", "damping_ns_per_m"});
        SpringDescription one{.at = material_point(entry.at("at"), axes), .spring = {}};
        one.spring.tied_to = entry.at("tied_to_m").vec3();
        one.spring.stiffness_n_per_m = detail::not_negative(entry.at("stiffness_n_per_m"));
        one.spring.rest_length_m = detail::not_negative(entry, "rest_length_m", 0);
        one.spring.damping_ns_per_m = detail::not_negative(entry, "damping_ns_per_m", 0);
        springs.push_back(one);
    }
    return springs;
}

std::vector<PulseDescription> read_pulses(const JsonCursor& json, int axes) {
    std::vector<PulseDescription> pulses;
    for (const JsonCursor& entry : json.items()) {
        entry.allow_keys({"at", "direction", "shape", "amplitude_n", "start_s", "duration_s",
                          "frequency_hz", "phase_deg"});
        PulseDescription one{.at = material_point(entry.at("at"), axes), .generator = {}};
        one.generator.direction = direction_of(entry.at("direction"));
        tissue::Pulse& pulse = one.generator.pulse;
        pulse.shape =
            tissue::pulse_shape_named(entry.at("shape").one_of(tissue::pulse_shape_names()));
        pulse.amplitude_n = entry.at("amplitude_n").number();
        if (const auto start = entry.find("start_s")) pulse.start_s = start->number();
        if (const auto duration = entry.find("duration_s"))
            pulse.duration_s = detail::positive(*duration);
        else if (pulse.shape == tissue::PulseShape::kTriangle)
            entry.fail("the key \"duration_s\", which a triangle needs", "none");
        if (const auto frequency = entry.find("frequency_hz"))
            pulse.frequency_hz = detail::positive(*frequency);
        if (const auto phase = entry.find("phase_deg"))
            pulse.phase_rad = phase->number() * std::numbers::pi / 180;
        pulses.push_back(one);
    }
    return pulses;
}

ObstacleDescription read_obstacle(const JsonCursor& json) {
    json.allow_keys({"plane", "sphere", "capsule", "contact"});
    const int shapes = json.has("plane") + json.has("sphere") + json.has("capsule");
    if (shapes != 1)
        json.fail("one of \"plane\", \"sphere\" and \"capsule\"", shapes == 0 ? "none" : "several");
    ObstacleDescription one{.obstacle = read_shape(json), .contact = {}};
    if (const auto contact = json.find("contact")) one.contact = read_contact(*contact);
    return one;
}

std::vector<ObstacleDescription> read_obstacles(const JsonCursor& json) {
    std::vector<ObstacleDescription> obstacles;
    for (const JsonCursor& entry : json.items()) obstacles.push_back(read_obstacle(entry));
    return obstacles;
}

}  // namespace risorius::softbody
