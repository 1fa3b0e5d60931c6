#include "studies/shader_check/check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include "base/system/error.hpp"
#include "base/system/sha256.hpp"
#include "base/words/text.hpp"
#include "studies/shader_check/arguments.hpp"
#include "studies/shader_check/explain.hpp"
#include "studies/shader_check/own_shader.hpp"
#include "studies/shader_check/points.hpp"
#include "studies/shader_check/program_text.hpp"

namespace lobelia::shader_check {
namespace {

constexpr std::size_t kDomainPoints = 600, kArcPoints = 721;
constexpr int kSphereSize = 160;
constexpr double kLightDegrees[] = {20, 60, 120}, kIncidences[] = {0, 45, 75};
/// Where L + V is shorter, a rounding of the vectors turns H (docs/export.md).
constexpr double kNearlyOpposite = 0.2, kMoreWhereOpposite = 10;
/// A loop of Mesa's 65535 rounds takes hundreds of times as long as pow.
constexpr double kOfALoop = 100;

/// All points of a check in one list, with the place of each part.
struct Plan {
  std::vector<Point> points;
  struct Part {
    std::size_t begin = 0, count = 0;
  };
  Part domain, hard, arc;
  std::vector<Part> spheres;
  struct HemispherePart {
    Part part;
    double exponent, degrees;
    std::vector<double> solid_angles;
  };
  std::vector<HemispherePart> hemispheres;

  Part add(const std::vector<Point>& more) {
    const Part part{points.size(), more.size()};
    points.insert(points.end(), more.begin(), more.end());
    return part;
  }
};

Plan make_plan(const Request& request) {
  Plan plan;
  for (const double n : request.exponents)
    plan.domain.count += plan.add(domain_points(request.highlight, n, kDomainPoints)).count;
  plan.hard.begin = plan.points.size();
  for (const double n : request.exponents) plan.hard.count += plan.add(hard_points(n)).count;
  plan.arc = plan.add(arc_points(request.shown_exponent, kArcPoints));
  for (const double degrees : kLightDegrees)
    plan.spheres.push_back(plan.add(sphere_points(degrees, request.shown_exponent, kSphereSize)));
  for (const double n : request.exponents)
    for (const double degrees : kIncidences) {
      Hemisphere half = hemisphere_points(info(request.highlight.model).angle, degrees, n);
      plan.hemispheres.push_back({plan.add(half.points), n, degrees, std::move(half.solid_angles)});
    }
  return plan;
}

void require_function(const Request& request, const ShaderSource& source) {
  std::set<std::string> names = functions_in(plain_text(source));
  names.erase("main");
  if (names.contains(request.function)) return;
  const std::vector<std::string_view> known(names.begin(), names.end());
  throw Error(ExitCode::kInput,
              known.empty() ? fmt::format("{}: has no function", source.name)
                            : fmt::format("{}: has no function '{}'; it has {}{}", source.name,
                                          printable(request.function), join(known),
                                          did_you_mean(request.function, known)));
}

/// The results of a part of the plan, beside the model in double.
class Judge {
 public:
  Judge(const Request& request, const Plan& plan, const std::vector<ShaderValue>& values)
      : highlight_(request.highlight),
        plan_(plan),
        values_(values),
        coefficients_(request.highlight) {}

  double coefficient(double n) { return coefficients_.at(n); }
  double model(std::size_t i) {
    const Point& point = plan_.points[i];
    Highlight here = highlight_;
    here.exponent = point.exponent;
    return model_radiance(here, coefficient(point.exponent), Geometry(point));
  }
  double theirs(std::size_t i) const { return double(values_[i].r); }

  records::ShaderPlace place(std::size_t i) {
    const Geometry g(plan_.points[i]);
    const double s = info(highlight_.model).angle == LobeAngle::kReflection ? g.s_mirror : g.s_half;
    return {plan_.points[i].exponent,
            g.n_dot_l,
            g.n_dot_v,
            2 * std::asin(std::clamp(std::sqrt(s / 2), 0.0, 1.0)) * 180 / std::numbers::pi,
            theirs(i),
            model(i)};
  }

  /// Compares every direction of a part, but for the edges.
  void add_errors(const Plan::Part& part, std::map<double, records::ShaderError>& worst,
                  records::ShaderOddities& odd) {
    for (std::size_t i = part.begin; i < part.begin + part.count; ++i) {
      const double n = plan_.points[i].exponent, peak = coefficient(n), value = theirs(i);
      const Geometry geometry(plan_.points[i]);
      ++odd.calls;
      if (!values_[i].written) {
        ++odd.unwritten;
        continue;
      }
      records::ShaderError& error = worst[n];
      error.exponent = n;
      error.allowed_of_peak = allowed_error(n);
      odd.nan += std::isnan(value);
      odd.infinite += std::isinf(value);
      odd.negative += value < 0;
      odd.coloured += values_[i].g != values_[i].r && std::isfinite(value);
      if (!std::isfinite(value)) {
        if (!odd.first_nonfinite) odd.first_nonfinite = place(i);
        continue;
      }
      if (is_at_an_edge(highlight_, geometry)) continue;
      const double expected = model(i);
      // In units of what is allowed there, so that the allowance is one number for an exponent.
      const double scale = geometry.half_length < kNearlyOpposite ? kMoreWhereOpposite : 1;
      const double of_peak = std::abs(value - expected) / peak / scale;
      if (expected == 0 && of_peak > error.allowed_of_peak) {
        ++odd.outside_support;
        if (!odd.first_outside) odd.first_outside = place(i);
      }
      if (of_peak > error.max_of_peak || error.place.exponent == 0) {
        error.max_of_peak = of_peak;
        error.place = place(i);
      }
    }
  }

 private:
  Highlight highlight_;
  const Plan& plan_;
  const std::vector<ShaderValue>& values_;
  Coefficients coefficients_;
};

void add_energy(Judge& judge, const Plan& plan, records::ShaderCheck& record) {
  for (const auto& [part, exponent, degrees, solid_angles] : plan.hemispheres) {
    records::ShaderEnergy energy{exponent, degrees, 0, 0};
    for (std::size_t i = 0; i < part.count; ++i) {
      energy.energy += solid_angles[i] * judge.theirs(part.begin + i);
      energy.of_model += solid_angles[i] * judge.model(part.begin + i);
    }
    record.energy.push_back(energy);
  }
}

void add_explanation(const Request& request, const Plan& plan, Judge& judge, bool of_roughness,
                     records::ShaderCheck& record) {
  Observed observed;
  bool is_zero = true;
  for (std::size_t i = plan.domain.begin; i < plan.domain.begin + plan.domain.count; ++i) {
    observed.points.push_back(plan.points[i]);
    observed.values.push_back(judge.theirs(i));
    is_zero = is_zero && judge.theirs(i) == 0;
  }
  if (!is_zero && record.oddities.nan + record.oddities.infinite < record.oddities.calls) {
    record.explanation = explain(request.highlight, observed, of_roughness);
    return;
  }
  records::ShaderExplanation& found = record.explanation.emplace();
  found.mistakes = {is_zero ? "zero" : "no-number"};
  found.sentence = is_zero ? "it is 0 in every direction" : "it is no finite number anywhere";
  found.complete = true;
}

void add_pictures(const Plan& plan, Judge& judge, Check& check) {
  for (std::size_t k = 0; k < plan.spheres.size(); ++k) {
    SpherePair& pair = check.spheres.emplace_back();
    pair.light_degrees = kLightDegrees[k];
    pair.theirs = pair.model = Image(kSphereSize, kSphereSize);
    for (int y = 0; y < kSphereSize; ++y)
      for (int x = 0; x < kSphereSize; ++x) {
        if (!is_sphere(x, y, kSphereSize)) continue;
        const std::size_t i = plan.spheres[k].begin + std::size_t(y) * kSphereSize + std::size_t(x);
        std::ranges::fill(pair.theirs.pixel(x, y), float(judge.theirs(i)));
        std::ranges::fill(pair.model.pixel(x, y), float(judge.model(i)));
      }
  }
  for (std::size_t i = 0; i < plan.arc.count; ++i) {
    check.curve.degrees.push_back(-90 + 180 * double(i) / double(plan.arc.count - 1));
    check.curve.theirs.push_back(judge.theirs(plan.arc.begin + i));
    check.curve.model.push_back(judge.model(plan.arc.begin + i));
  }
}

/// Mesa leaves a loop after 65535 rounds, so that an endless one only takes long.
void require_end(const Request& request, const ShaderSource& source, const ShaderPoints& points) {
  if (request.api == ShaderApi::kWebGpu) return;
  const double times = times_as_long_as_pow(
      request,
      make_program(source, request.api, points.count(), points.components, request.time_limit),
      points);
  if (times > kOfALoop)
    throw Error(ExitCode::kInput,
                "{}: {} does not seem to end: it takes {:.0f} times as long as pow, and "
                "Mesa leaves a loop after 65535 rounds",
                source.name, request.function, times);
}

}  // namespace

Check check_shader(const Request& request) {
  const Arguments arguments(request.arguments, request.highlight);
  const ShaderSource source{request.language,
                            printable_path(request.file),
                            request.text,
                            {arguments.call(request.function, request.language)}};
  require_function(request, source);
  const Plan plan = make_plan(request);
  const ShaderPoints points = arguments.of(plan.points);
  const ShaderProgram program =
      make_program(source, request.api, points.count(), points.components, request.time_limit);
  const ShaderRun run =
      run_programs(request.api, points, {own_program(request, source, program, points), program}, 1,
                   {request.time_limit, 0});
  require_right_driver(request, run.device, std::span(plan.points).first(plan.domain.count),
                       run.values.front());

  Check check;
  check.shown_exponent = request.shown_exponent;
  records::ShaderCheck& record = check.record;
  record.file = printable_path(request.file);
  record.sha256 = hex(sha256(request.text));
  record.language = kShaderTextNames[std::size_t(request.language)];
  record.function = request.function;
  record.arguments = request.arguments;
  record.model = info(request.highlight.model).name;
  record.lobe = info(request.highlight.lobe).name;
  record.normalisation = name(request.highlight.normalisation);
  record.api = kShaderApiNames[std::size_t(request.api)];
  record.device = run.device;
  record.driver = run.driver;

  const std::vector<ShaderValue>& values = run.values.back();
  if (std::ranges::none_of(values, &ShaderValue::written))
    throw Error(ExitCode::kInput, "{}: {} writes nothing: every call is discarded", record.file,
                request.function);
  Judge judge(request, plan, values);
  std::map<double, records::ShaderError> worst;
  judge.add_errors(plan.domain, worst, record.oddities);
  judge.add_errors(plan.arc, worst, record.oddities);
  for (const Plan::Part& sphere : plan.spheres) judge.add_errors(sphere, worst, record.oddities);
  for (std::size_t i = plan.hard.begin; i < plan.hard.begin + plan.hard.count; ++i) {
    ++record.oddities.hard_calls;
    record.oddities.hard_nonfinite += !std::isfinite(judge.theirs(i));
  }
  bool passes = record.oddities.nan + record.oddities.infinite + record.oddities.unwritten == 0;
  for (const auto& [n, error] : worst) {
    record.errors.push_back(error);
    passes = passes && error.max_of_peak <= error.allowed_of_peak;
  }
  record.verdict = records::kShaderVerdicts[passes ? 0 : 1];
  const auto begin = plan.points.begin() + std::ptrdiff_t(plan.domain.begin);
  const std::vector<Point> domain(begin, begin + std::ptrdiff_t(plan.domain.count));
  const ShaderPoints domain_points = arguments.of(domain);
  if (!passes) require_end(request, source, domain_points);
  if (!passes) add_explanation(request, plan, judge, arguments.is_of_roughness(), record);
  add_energy(judge, plan, record);
  add_pictures(plan, judge, check);
  if (request.costs) {
    add_costs(request, arguments, domain, domain_points, values, record);
  }
  return check;
}

}  // namespace lobelia::shader_check
