// SPDX-License-Identifier: MIT
#include "risorius/render/detail/shader_constants.h"

#include <charconv>
#include <vector>

namespace risorius::render {
namespace {

std::string glsl(float number) {
    char text[32];
    const auto end = std::to_chars(text, text + sizeof text, number).ptr;
    std::string out(text, end);
    if (out.find_first_of(".e") == std::string::npos) out += ".0";
    return out;
}

template <typename Derived>
std::vector<float> floats(const Eigen::MatrixBase<Derived>& m) {
    std::vector<float> out;
    for (Eigen::Index column = 0; column < m.cols(); ++column)
        for (Eigen::Index row = 0; row < m.rows(); ++row)
            out.push_back(static_cast<float>(m(row, column)));
    return out;
}

}  // namespace

std::string glsl(const std::string& type, std::span<const float> numbers) {
    std::string out = type + "(";
    for (const float number : numbers) out += glsl(number) + ", ";
    out.resize(out.size() - 2);
    return out + ")";
}

void ShaderConstants::set(const std::string& name, bool value) {
    value_of_declaration_["bool " + name] = value ? "true" : "false";
}
void ShaderConstants::set(const std::string& name, double value) {
    value_of_declaration_["float " + name] = glsl(static_cast<float>(value));
}
void ShaderConstants::set(const std::string& name, const Vec2& value) {
    value_of_declaration_["vec2 " + name] = glsl("vec2", floats(value));
}
void ShaderConstants::set(const std::string& name, const Vec3& value) {
    value_of_declaration_["vec3 " + name] = glsl("vec3", floats(value));
}
void ShaderConstants::set(const std::string& name, const Eigen::Vector4f& value) {
    value_of_declaration_["vec4 " + name] = glsl("vec4", floats(value));
}
void ShaderConstants::set(const std::string& name, const Mat3& value) {
    value_of_declaration_["mat3 " + name] = glsl("mat3", floats(value));
}

std::string ShaderConstants::in(std::string source) const {
    for (const auto& [declaration, value] : value_of_declaration_) {
        const std::string uniform = "uniform " + declaration + ";";
        if (const std::size_t at = source.find(uniform); at != std::string::npos)
            source.replace(at, uniform.size(), "const " + declaration + " = " + value + ";");
    }
    return source.insert(source.find('\n') + 1, prelude_);
}

}  // namespace risorius::render
