// SPDX-License-Identifier: MIT
#include "risorius/contact/contact_law.h"

#include <Eigen/Eigenvalues>

#include "risorius/core/json_cursor.h"

namespace risorius::contact {

void check(const ContactMaterial& material, const std::string& place) {
    const auto expect = [&](bool holds, const char* field, const char* expected, double found) {
        if (!holds || !std::isfinite(found))
            throw Error(place + "/" + field, expected, format_number(found));
    };
    expect(material.stiffness_pa_per_m > 0, "stiffness_pa_per_m", "(0, inf)",
           material.stiffness_pa_per_m);
    expect(material.thickness_m > 0, "thickness_m", "(0, inf)", material.thickness_m);
    expect(material.friction >= 0, "friction", "[0, inf)", material.friction);
    expect(material.slip_speed_m_per_s > 0, "slip_speed_m_per_s", "(0, inf)",
           material.slip_speed_m_per_s);
    expect(material.damping_s >= 0, "damping_s", "[0, inf)", material.damping_s);
}

Mat3 positive_part(const Mat3& symmetric) {
    const Eigen::SelfAdjointEigenSolver<Mat3> solver(symmetric);
    const Mat3& vectors = solver.eigenvectors();
    return vectors * solver.eigenvalues().cwiseMax(0.0).asDiagonal() * vectors.transpose();
}

}  // namespace risorius::contact
