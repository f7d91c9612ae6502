// SPDX-License-Identifier: MIT
/// \file
/// Writes uniforms that never change into the program's source as constants. llvmpipe fetches a uniform again for every pixel, while a
/// constant is part of an instruction.
#pragma once

#include <map>
#include <span>
#include <string>

#include "risorius/core/types.h"

namespace risorius::render {

class ShaderConstants {
  public:
    void set(const std::string& name, bool value);
    void set(const std::string& name, double value);
    void set(const std::string& name, const Vec2& value);
    void set(const std::string& name, const Vec3& value);
    void set(const std::string& name, const Eigen::Vector4f& value);
    void set(const std::string& name, const Mat3& value);
    /// Text that goes before all others of the source, such as constants in place of a part of a uniform block.
    void set_prelude(std::string text) { prelude_ = std::move(text); }

    /// GLSL, whose first line is its version, with those of its uniforms that have been set as constants.
    std::string in(std::string source) const;

  private:
    std::string prelude_;
    std::map<std::string, std::string> value_of_declaration_;  ///< "vec3 albedo" to "vec3(...)"
};

/// As GLSL has it: "vec4(1.0, 0.5, ...)", with as many digits as a float needs.
std::string glsl(const std::string& type, std::span<const float> numbers);

}  // namespace risorius::render
