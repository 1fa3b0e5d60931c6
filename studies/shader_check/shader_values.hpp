// Values of a shader's types, written in its language.
#pragma once

#include "studies/shader_check/declarations.hpp"
#include "studies/shader_check/meanings.hpp"

namespace lobelia::shader_check {

/// "1.0" for 1
std::string number_text(double number);

/// An expression of the type, of these components: as many as it has, one for all of them, or three of four, of which the
/// last is 1. A matrix of one number has it on its diagonal. "" if they do not fit.
std::string value_text(const std::string& type, std::vector<std::string> components,
                       ShaderText language);

/// "vec3 a[2];", "var a: vec3f;", with all members 0 where the language has a short way to say so.
std::string variable_text(const std::string& type, const std::string& name,
                          const std::string& dimensions, ShaderText language);

/// "a vec3", "a sampler2D" for messages.
std::string declared_text(const Declared& declared, std::string_view path);

/// The names and the places in arrays of "lights[0].position": "lights", "[0]", "position". Empty if it is no such path.
std::vector<std::string> parts_of_path(std::string_view path);

}  // namespace lobelia::shader_check
