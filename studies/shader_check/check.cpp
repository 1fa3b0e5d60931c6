#include "studies/shader_check/check.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/system/error.hpp"
#include "base/system/sha256.hpp"
#include "base/words/text.hpp"
#include "studies/shader_check/choose_call.hpp"
#include "studies/shader_check/own_shader.hpp"

namespace lobelia::shader_check {
namespace {

/// A loop of Mesa's 65535 rounds takes hundreds of times as long as pow.
constexpr double kOfALoop = 100;

/// Three vectors and a number in every likely order.
constexpr std::size_t kMostCalls = 48;

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

void add_spheres(const Plan& plan, Judge& judge, Check& check) {
  const double exponent = plan.points[plan.spheres[0].begin].exponent;
  Spheres& spheres = check.spheres.emplace_back(Spheres{exponent, judge.peak(exponent), {}});
  for (std::size_t k = 0; k < plan.spheres.size(); ++k) {
    SpherePair& pair = spheres.pairs.emplace_back();
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
}

void add_curve(const Plan& plan, Judge& judge, Check& check) {
  check.curve.degrees = plan.arc_degrees;
  for (std::size_t i = 0; i < plan.arc.count; ++i) {
    check.curve.theirs.push_back(judge.theirs(plan.arc.begin + i));
    check.curve.model.push_back(judge.model(plan.arc.begin + i));
  }
}

/// A second run: only the first one tells which exponent that is.
void add_worst_spheres(const Request& request, const Arguments& arguments,
                       const ShaderSource& source, Check& check) {
  if (check.record.errors.empty()) return;
  const auto excess = [](const records::ShaderError& error) {
    return error.max_of_peak / error.allowed_of_peak;
  };
  const double worst = std::ranges::max_element(check.record.errors, {}, excess)->exponent;
  if (worst == check.spheres[0].exponent) return;
  Plan plan;
  add_sphere_points(worst, plan);
  const ShaderPoints points = arguments.of(plan.points);
  const ShaderRun run = run_programs(
      request.api, points,
      {make_program(source, request.api, points.count(), points.components, request.time_limit)}, 1,
      {request.time_limit, 0});
  Judge judge(request.highlight, plan, run.values.front());
  add_spheres(plan, judge, check);
}

/// Mesa leaves a loop after 65535 rounds, so that an endless one only takes long.
void require_end(const Request& request, const ShaderSource& source, const std::string& function,
                 const ShaderPoints& points) {
  if (request.api == ShaderApi::kWebGpu) return;
  const double times = times_as_long_as_pow(
      request,
      make_program(source, request.api, points.count(), points.components, request.time_limit),
      points);
  if (times > kOfALoop)
    throw Error(ExitCode::kInput,
                "{}: {} does not seem to end: it takes {:.0f} times as long as pow, and "
                "Mesa leaves a loop after 65535 rounds",
                source.name, function, times);
}

}  // namespace

Check check_shader(const Request& given) {
  ShaderCalls calls = shader_calls(given, kMostCalls);
  const ChosenCall chosen = choose_call(given, calls);
  Request request = given;
  request.highlight = chosen.highlight;
  const ShaderCall& call = calls.calls[chosen.call];
  const ShaderSource& source = call.source;
  Arguments& arguments = calls.arguments;
  arguments.set_highlight(chosen.highlight);
  Plan plan = judged_plan(request.highlight, request.exponents, request.shown_exponent);
  add_hemispheres(request.highlight, request.exponents, plan);
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
  record.function = call.function;
  record.arguments = call.list;
  record.bindings = call.bindings;
  record.remarks = call.remarks;
  record.model = info(request.highlight.model).name;
  record.lobe = info(request.highlight.lobe).name;
  record.normalisation = name(request.highlight.normalisation);
  record.model_found = !request.highlights.empty();
  record.api = kShaderApiNames[std::size_t(request.api)];
  record.device = run.device;
  record.driver = run.driver;

  const std::vector<ShaderValue>& values = run.values.back();
  if (std::ranges::none_of(values, &ShaderValue::written))
    throw Error(ExitCode::kInput, "{}: {} writes nothing: every call is discarded", record.file,
                call.function);
  Judge judge(request.highlight, plan, values);
  judge.judge(record);
  const bool passes = record.verdict == records::kShaderVerdicts[0];
  const auto begin = plan.points.begin() + std::ptrdiff_t(plan.domain.begin);
  const std::vector<Point> domain(begin, begin + std::ptrdiff_t(plan.domain.count));
  const ShaderPoints domain_points = arguments.of(domain);
  if (!passes) require_end(request, source, call.function, domain_points);
  if (!passes) record.explanation = judge.explanation(record.oddities, call.of_roughness);
  add_energy(judge, plan, record);
  add_spheres(plan, judge, check);
  add_curve(plan, judge, check);
  if (!passes && request.worst_spheres) add_worst_spheres(request, arguments, source, check);
  if (request.costs) {
    add_costs(request, source, domain, domain_points, values, record);
  }
  return check;
}

}  // namespace lobelia::shader_check
