#include "studies/shader_check/bsdf/calls.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/words/text.hpp"
#include "renderer/export/names.hpp"

namespace lobelia::shader_check::bsdf {
namespace {

constexpr std::size_t kEyeAt = 3, kLightAt = 6, kRandomAt = 9, kExponentAt = 12, kComponents = 15;

std::string vector_at(ShaderText language, std::size_t at) {
  return fmt::format("{}({}, {}, {})", vector_type(language), shader_component(at),
                     shader_component(at + 1), shader_component(at + 2));
}

/// n, alpha and roughness.
std::string parameters_of(ChangedParameter changed) {
  std::string text;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::string value = shader_component(kExponentAt + k);
    const char* format = changed == ChangedParameter::kSquared   ? ", ({0} * {0})"
                         : changed == ChangedParameter::kRoot    ? ", sqrt({0})"
                         : changed == ChangedParameter::kDoubled ? ", (2.0 * {0})"
                         : changed == ChangedParameter::kHalved  ? ", (0.5 * {0})"
                                                                 : ", {0}";
    text += fmt::format(fmt::runtime(format), value);
  }
  return text;
}

/// "lobelia_V", or "vec2(lobelia_u.x, lobelia_u.y)"
std::string argument(const BsdfValue& value, ShaderText language) {
  const std::string vector(vector_type(language)),
      any = vector.substr(0, vector.size() - 1) + std::to_string(value.components);
  switch (value.role) {
    case BsdfRole::kNormal:
      return "lobelia_N";
    case BsdfRole::kEye:
      return "lobelia_V";
    case BsdfRole::kLight:
      return "lobelia_L";
    case BsdfRole::kExponent:
      return "lobelia_n";
    case BsdfRole::kAlpha:
      return "lobelia_alpha";
    case BsdfRole::kRoughness:
      return "lobelia_roughness";
    case BsdfRole::kRandom:
      return "lobelia_u." + std::string("xyz").substr(std::size_t(value.first_random),
                                                      std::size_t(value.components));
    default:
      break;
  }
  std::string number = fmt::format("{:.9g}", value.number);
  if (number.find_first_of(".e") == number.npos) number += ".0";
  if (value.components == 1) return number;
  std::string all;
  for (int k = 0; k < value.components; ++k) all += (k == 0 ? "" : ", ") + number;
  return any + "(" + all + ")";
}

/// The statements that call a function: variables for what it gives, and then the call.
std::string statements(const BsdfFunction& function, ShaderText language) {
  std::string variables, list;
  for (std::size_t i = 0; i < function.parameters.size(); ++i) {
    const BsdfValue& value = function.parameters[i];
    list += i == 0 ? "" : ", ";
    if (!value.is_out) {
      list += argument(value, language);
      continue;
    }
    variables += fmt::format("    {} lobelia_out{};\n", value.type, i);
    list += fmt::format("lobelia_out{}", i);
  }
  const std::string call = fmt::format("{}({})", function.name, list);
  return variables +
         (function.result.type == "void"
              ? fmt::format("    {};\n", call)
              : fmt::format("    {} lobelia_result_of = {};\n", function.result.type, call));
}

/// The expression of what a function gives for a role; "" if it does not.
std::string given(const BsdfFunction& function, BsdfRole role) {
  const auto of = [&](const BsdfValue& value, const std::string& name) {
    return value.components == 4 ? name + ".xyz" : name;
  };
  for (std::size_t i = 0; i < function.parameters.size(); ++i)
    if (function.parameters[i].is_out && function.parameters[i].role == role)
      return of(function.parameters[i], fmt::format("lobelia_out{}", i));
  for (const BsdfValue& value : function.members)
    if (value.role == role) return of(value, "lobelia_result_of." + value.name);
  if (function.result.role == role) return of(function.result, "lobelia_result_of");
  // Four numbers are a direction and its pdf.
  if (role == BsdfRole::kPdf && function.result.role == BsdfRole::kDirection &&
      function.result.components == 4)
    return "lobelia_result_of.w";
  return "";
}

constexpr std::string_view kText = R"(
%vec3% lobelia_bsdf_eval(%vec3% lobelia_N, %vec3% lobelia_V, %vec3% lobelia_L, %parameters%)
{
%eval%    return %ones% * (%value%);
}
float lobelia_bsdf_pdf(%vec3% lobelia_N, %vec3% lobelia_V, %vec3% lobelia_L, %parameters%)
{
%pdf%    return %density%;
}
%vec3% lobelia_bsdf_sample(int lobelia_what, %vec3% lobelia_N, %vec3% lobelia_V, %vec3% lobelia_u, %parameters%)
{
%sample%    %vec3% lobelia_L = %direction%;
    if (lobelia_what == 0) return lobelia_L;
    if (lobelia_what == 1)
        return %vec3%(%given%, %valid%, lobelia_bsdf_pdf(lobelia_N, lobelia_V, lobelia_L, lobelia_n, lobelia_alpha, lobelia_roughness));
    if (lobelia_what == 2) return %ones% * (%weight%);
    return lobelia_bsdf_eval(lobelia_N, lobelia_V, lobelia_L, lobelia_n, lobelia_alpha, lobelia_roughness);
}
)";

}  // namespace

ShaderPoints shader_points(const std::vector<BsdfPoint>& points) {
  ShaderPoints all{kComponents, {}};
  all.values.reserve(points.size() * kComponents);
  for (const BsdfPoint& point : points) {
    for (const Vec3 v : {point.normal, point.to_eye, point.to_light, point.random})
      all.values.insert(all.values.end(), {float(v.x), float(v.y), float(v.z)});
    const double alpha = std::sqrt(2 / (point.exponent + 2));
    all.values.insert(all.values.end(),
                      {float(point.exponent), float(alpha), float(std::sqrt(alpha))});
  }
  return all;
}

ShaderSource with_bsdf_calls(const ShaderSource& source, const BsdfFunctions& functions) {
  const ShaderText language = source.language;
  const std::string vector(vector_type(language));
  const auto or_else = [](std::string text, const char* otherwise) {
    return text.empty() ? std::string(otherwise) : text;
  };
  const std::string valid = given(functions.sample, BsdfRole::kValid);
  const BsdfFunction& pdf = functions.pdf;
  ShaderSource all = source;
  all.text +=
      "\n" +
      fill(kText, {{"vec3", vector},
                   {"ones", vector + "(1.0, 1.0, 1.0)"},
                   {"parameters", "float lobelia_n, float lobelia_alpha, float lobelia_roughness"},
                   {"eval", statements(functions.eval, language)},
                   {"value", given(functions.eval, BsdfRole::kEval)},
                   {"pdf", statements(pdf, language)},
                   {"density",
                    functions.pdf_is_of_eval ? given(pdf, BsdfRole::kPdf) : "lobelia_result_of"},
                   {"sample", statements(functions.sample, language)},
                   {"direction", given(functions.sample, BsdfRole::kDirection)},
                   {"given", or_else(given(functions.sample, BsdfRole::kPdf), "0.0")},
                   {"valid", valid.empty() ? "1.0" : "(" + valid + " ? 1.0 : 0.0)"},
                   {"weight", or_else(given(functions.sample, BsdfRole::kWeight), "0.0")}});
  return all;
}

std::string call_of_eval(ShaderText language, bool swapped) {
  return fmt::format("lobelia_bsdf_eval({}, {}, {}{})", vector_at(language, 0),
                     vector_at(language, swapped ? kLightAt : kEyeAt),
                     vector_at(language, swapped ? kEyeAt : kLightAt),
                     parameters_of(ChangedParameter::kNone));
}

std::string call_of_pdf(ShaderText language, ChangedParameter changed) {
  return fmt::format("lobelia_bsdf_pdf({}, {}, {}{})", vector_at(language, 0),
                     vector_at(language, kEyeAt), vector_at(language, kLightAt),
                     parameters_of(changed));
}

std::string call_of_sample(ShaderText language, Sampled what) {
  return fmt::format("lobelia_bsdf_sample({}, {}, {}, {}{})", int(what), vector_at(language, 0),
                     vector_at(language, kEyeAt), vector_at(language, kRandomAt),
                     parameters_of(ChangedParameter::kNone));
}

bool gives_pdf(const BsdfFunction& sample) { return !given(sample, BsdfRole::kPdf).empty(); }
bool gives_weight(const BsdfFunction& sample) { return !given(sample, BsdfRole::kWeight).empty(); }

}  // namespace lobelia::shader_check::bsdf
