#include "studies/shader_check/choose_call.hpp"

#include <algorithm>
#include <tuple>

#include "studies/shader_check/explain.hpp"

namespace lobelia::shader_check {
namespace {

/// For an exponent and for each of the angles that a lobe may see.
constexpr std::size_t kPoints = 200, kFirstPoints = 40;
/// An explanation takes up to a second.
constexpr std::size_t kMostExplained = 6;

/// Directions for models of both angles: the first few of all exponents before the rest.
std::vector<Point> points_of(const Request& request) {
  std::vector<Point> first, rest;
  for (const double n : request.exponents)
    for (const ModelId model : all_models()) {
      const bool is_new = model == *std::ranges::find(all_models(), info(model).angle,
                                                      [](ModelId one) { return info(one).angle; });
      if (!is_new) continue;
      const auto points = domain_points({model, request.highlight.lobe}, n, kPoints);
      first.insert(first.end(), points.begin(), points.begin() + kFirstPoints);
      rest.insert(rest.end(), points.begin() + kFirstPoints, points.end());
    }
  first.insert(first.end(), rest.begin(), rest.end());
  return first;
}

bool passes(const Highlight& highlight, Plan& plan, const std::vector<ShaderValue>& values) {
  // Most fail at once.
  for (const std::size_t count : {std::min(kFirstPoints, plan.points.size()), plan.points.size()}) {
    plan.domain = {0, count};
    records::ShaderCheck record;
    Judge(highlight, plan, values).judge(record);
    if (record.verdict != records::kShaderVerdicts[0]) return false;
  }
  return true;
}

Identified explained(std::span<const Highlight> highlights, const Plan& plan,
                     const std::vector<ShaderValue>& values, bool of_roughness) {
  Observed observed{plan.points, {}, 0, 0};
  for (const ShaderValue& value : values)
    observed.values.push_back(value.written ? double(value.r) : 0);
  if (highlights.size() > 1) return identify(highlights, observed, of_roughness);
  return {highlights.front(), explain(highlights.front(), observed, of_roughness)};
}

}  // namespace

ChosenCall choose_call(const Request& request, const ShaderCalls& calls) {
  const std::vector<Highlight> highlights =
      request.highlights.empty() ? std::vector{request.highlight} : request.highlights;
  if (calls.calls.size() * highlights.size() == 1) return {0, highlights.front()};
  Plan plan;
  plan.points = points_of(request);
  const ShaderPoints points = calls.arguments.of(plan.points);
  std::vector<ShaderProgram> programs;
  for (const ShaderCall& call : calls.calls)
    programs.push_back(make_program(call.source, request.api, points.count(), points.components,
                                    request.time_limit));
  const ShaderRun run = run_programs(request.api, points, programs, 1, {request.time_limit, 0});
  for (std::size_t k = 0; k < programs.size(); ++k)
    for (const Highlight& highlight : highlights)
      if (passes(highlight, plan, run.values[k])) return {k, highlight};
  ChosenCall best{0, highlights.front()};
  if (calls.calls.size() == 1) {
    best.highlight =
        explained(highlights, plan, run.values[0], calls.calls[0].of_roughness).highlight;
    return best;
  }
  std::tuple<bool, std::size_t> least{true, 0};
  for (std::size_t k = 0; k < std::min(kMostExplained, programs.size()); ++k) {
    const Identified found =
        explained(highlights, plan, run.values[k], calls.calls[k].of_roughness);
    const std::tuple cost{!found.explanation.complete, found.explanation.mistakes.size()};
    if (k > 0 && !(cost < least)) continue;
    least = cost;
    best = {k, found.highlight};
  }
  return best;
}

}  // namespace lobelia::shader_check
