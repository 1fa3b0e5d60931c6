#include "studies/shader_check/check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "base/system/error.hpp"
#include "base/words/text.hpp"
#include "studies/shader_check/own_shader.hpp"

namespace lobelia::shader_check {
namespace {

ShaderSource power(ShaderText language) {
  constexpr std::string_view kBody = "{ return pow(max(dot(N, normalize(L + V)), 0.0), n); }\n";
  const std::string_view v = vector_type(language);
  return {language,
          "pow",
          (language == ShaderText::kWgsl
               ? fmt::format("fn lobelia_pow(N: {0}, V: {0}, L: {0}, n: f32) -> f32\n", v)
               : fmt::format("float lobelia_pow({0} N, {0} V, {0} L, float n)\n", v)) +
              std::string(kBody),
          {fmt::format("lobelia_pow({}, {})", common_vectors(language), common_exponent())}};
}

class Costs {
 public:
  Costs(const Request& request, const ShaderSource& source, const ShaderPoints& points,
        records::ShaderCheck& record)
      : request_(request), points_(points), record_(record) {
    sources_ = {source, own_source(request), power(request.language)};
    for (const char* name : {"function", "ours", "pow"}) record.costs.push_back({name, {}});
  }

  /// Runs `measure`, whose failure is only a remark.
  template <class Measure>
  void try_to(const char* what, Measure measure) {
    try {
      measure();
    } catch (const Error& error) {
      if (error.code() == ExitCode::kInterrupted) throw;
      record_.remarks.push_back(fmt::format("not measured: {}: {}", what, error.lines().front()));
    }
  }

  void count() {
    const std::size_t base =
        instructions({request_.language, "nothing", "", {shader_component(0)}});
    for (std::size_t k = 0; k < record_.costs.size(); ++k) {
      const std::size_t all = instructions(sources_[k]);
      record_.costs[k].instructions = all > base ? all - base : 0;
    }
  }

  void half_floats(const std::vector<Point>& domain, const std::vector<ShaderValue>& values) {
    const ShaderProgram half = in_half_floats(spirv(sources_.front()), request_.time_limit);
    const ShaderRun run =
        run_programs(ShaderApi::kVulkan, points_, {half}, 1, {request_.time_limit, 0});
    std::map<double, records::ShaderHalf> worst;
    std::map<double, double> peaks;
    for (std::size_t i = 0; i < domain.size(); ++i)
      if (std::isfinite(values[i].r)) {
        double& peak = peaks[domain[i].exponent];
        peak = std::max(peak, double(std::abs(values[i].r)));
      }
    for (std::size_t i = 0; i < domain.size(); ++i) {
      const double n = domain[i].exponent, value = double(run.values.front()[i].r);
      records::ShaderHalf& half_at = worst[n];
      half_at.exponent = n;
      half_at.nonfinite += !std::isfinite(value);
      if (std::isfinite(value) && std::isfinite(values[i].r) && peaks[n] > 0)
        half_at.max_of_peak =
            std::max(half_at.max_of_peak, std::abs(value - double(values[i].r)) / peaks[n]);
    }
    for (const auto& [n, half_at] : worst) record_.half_floats.push_back(half_at);
  }

 private:
  ShaderProgram spirv(const ShaderSource& source) const {
    return make_program(source, ShaderApi::kVulkan, points_.count(), points_.components,
                        request_.time_limit);
  }
  std::size_t instructions(const ShaderSource& source) const {
    return count_instructions(spirv(source), request_.time_limit);
  }

  const Request& request_;
  const ShaderPoints& points_;
  records::ShaderCheck& record_;
  std::vector<ShaderSource> sources_;
};

}  // namespace

double times_as_long_as_pow(const Request& request, const ShaderProgram& program,
                            const ShaderPoints& points) {
  constexpr int kFewRounds = 5;
  const ShaderRun run =
      run_programs(request.api, points,
                   {program, make_program(power(request.language), request.api, points.count(),
                                          points.components, request.time_limit)},
                   1, {request.time_limit, kFewRounds});
  return std::ranges::min(run.seconds[0]) / std::ranges::min(run.seconds[1]);
}

void add_costs(const Request& request, const ShaderSource& source, const std::vector<Point>& domain,
               const ShaderPoints& points, const std::vector<ShaderValue>& values,
               records::ShaderCheck& record) {
  if (request.language == ShaderText::kWgsl) {
    record.remarks.push_back("not measured: instructions and half floats: glslang has no WGSL");
    return;
  }
  Costs costs(request, source, points, record);
  costs.try_to("instructions", [&] { costs.count(); });
  costs.try_to("half floats", [&] { costs.half_floats(domain, values); });
}

}  // namespace lobelia::shader_check
