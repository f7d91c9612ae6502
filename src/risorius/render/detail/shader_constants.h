// SPDX-License-Identifier: MIT
/// \file
/// Replaces uniforms that never change by constants in the source of a program. llvmpipe fetches a uniform again for every pixel,
/// while a constant is part of an instruction.
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
    /// Text that is put in front of the source, for instance constants that replace a part of a uniform block.
    void set_prelude(std::string text) { prelude_ = std::move(text); }

    /// Returns the GLSL source with the uniforms that have been set replaced by constants. The first line of the source is its
    /// version.
    std::string in(std::string source) const;

  private:
    std::string prelude_;
    std::map<std::string, std::string> value_of_declaration_;  ///< "vec3 albedo" to "vec3(...)"
};

/// Returns a GLSL literal such as "vec4(1.0, 0.5, ...)", with as many digits as a float needs.
std::string glsl(const std::string& type, std::span<const float> numbers);

}  // namespace risorius::render
