#include "studies/shader_check/own_shader.hpp"

#include <cmath>

#include "base/system/error.hpp"
#include "base/words/text.hpp"
#include "renderer/export/export.hpp"
#include "renderer/export/names.hpp"
#include "studies/shader_check/explain.hpp"
#include "studies/shader_check/program_text.hpp"

namespace lobelia::shader_check {

ShaderSource own_source(const Request& request) {
  const ShaderText language = request.language;
  ShaderExport wanted{*find_shader_language(kShaderTextNames[std::size_t(language)]),
                      {request.highlight.model},
                      request.highlight.lobe,
                      request.highlight.normalisation,
                      {}};
  std::string text;
  try {
    text = shader_text(wanted);
  } catch (const Error&) {  // there is no closed form
    wanted.coefficient = CoefficientFrom::kArgument;
    text = shader_text(wanted);
  }
  std::string call =
      function_name(request.highlight) + "(" + common_vectors(language) + ", " + common_exponent();
  if (wanted.coefficient == CoefficientFrom::kArgument) call += ", " + common_coefficient();
  return {language, "ours", text, {call + ")"}, true};
}

ShaderProgram own_program(const Request& request, const ShaderSource& theirs,
                          const ShaderProgram& program, const ShaderPoints& points) {
  ShaderSource source = own_source(request);
  source.name = theirs.name;
  source.text = version_directive(theirs) + "\n" + source.text;
  ShaderProgram own =
      make_program(source, request.api, points.count(), points.components, request.time_limit);
  own.version_line = program.version_line;
  return own;
}

void require_right_driver(const Request& request, const std::string& device,
                          std::span<const Point> points, std::span<const ShaderValue> values) {
  Coefficients coefficients(request.highlight);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Geometry geometry(points[i]);
    Highlight here = request.highlight;
    here.exponent = points[i].exponent;
    const double peak = coefficients.at(here.exponent), value = double(values[i].r),
                 error = std::abs(value - model_radiance(here, peak, geometry)) / peak;
    // Without a peak a lobe takes more roundings (measured 9.2e-5).
    const double allowed =
        allowed_error(here.exponent) * more_where_opposite(geometry) * (here.exponent < 1 ? 10 : 2);
    if (values[i].written &&
        (error <= allowed || (std::isfinite(value) && is_at_an_edge(here, geometry))))
      continue;
    throw Error(ExitCode::kEngine,
                "{}: Lobelia's own export of {} is wrong there: it gives {:g} at n = {:g}, N.L = "
                "{:.4f}, an error of {:.1e} of the peak; the driver or Lobelia has a fault, and "
                "nothing is told of {}",
                device, info(here.model).name, value, here.exponent, geometry.n_dot_l, error,
                printable_path(request.file));
  }
}

}  // namespace lobelia::shader_check
