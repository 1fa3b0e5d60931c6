#include "studies/shader_check/judge.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "studies/shader_check/explain.hpp"

namespace lobelia::shader_check {
namespace {

constexpr std::size_t kDomainPoints = 600, kPointsBelow = 100;
constexpr double kIncidences[] = {0, 45, 75};

}  // namespace

Plan::Part Plan::add(const std::vector<Point>& more) {
  const Part part{points.size(), more.size()};
  points.insert(points.end(), more.begin(), more.end());
  return part;
}

Plan judged_plan(const Highlight& highlight, const std::vector<double>& exponents,
                 double shown_exponent) {
  Plan plan;
  for (const double n : exponents)
    plan.domain.count += plan.add(domain_points(highlight, n, kDomainPoints)).count;
  plan.hard.begin = plan.points.size();
  for (const double n : exponents) plan.hard.count += plan.add(hard_points(n)).count;
  plan.below.begin = plan.points.size();
  for (const double n : exponents)
    plan.below.count += plan.add(points_below(highlight, n, kPointsBelow)).count;
  Arc arc = arc_points(shown_exponent);
  plan.arc = plan.add(arc.points);
  plan.arc_degrees = std::move(arc.degrees);
  add_sphere_points(shown_exponent, plan);
  return plan;
}

void add_sphere_points(double exponent, Plan& plan) {
  for (const double degrees : kLightDegrees)
    plan.spheres.push_back(plan.add(sphere_points(degrees, exponent, kSphereSize)));
}

void add_hemispheres(const Highlight& highlight, const std::vector<double>& exponents, Plan& plan) {
  for (const double n : exponents)
    for (const double degrees : kIncidences) {
      Hemisphere half = hemisphere_points(info(highlight.model).angle, degrees, n);
      plan.hemispheres.push_back({plan.add(half.points), n, degrees, std::move(half.solid_angles)});
    }
}

double Judge::model(std::size_t i) {
  const Point& point = plan_.points[i];
  Highlight here = highlight_;
  here.exponent = point.exponent;
  return model_radiance(here, coefficients_.at(point.exponent), Geometry(point));
}

records::ShaderPlace Judge::place(std::size_t i) {
  const Geometry g(plan_.points[i]);
  const double s = info(highlight_.model).angle == LobeAngle::kReflection ? g.s_mirror : g.s_half;
  return {plan_.points[i].exponent,
          g.n_dot_l,
          g.n_dot_v,
          2 * std::asin(std::clamp(std::sqrt(s / 2), 0.0, 1.0)) * 180 / std::numbers::pi,
          theirs(i),
          model(i)};
}

void Judge::add_errors(const Plan::Part& part, std::map<double, records::ShaderError>& worst,
                       records::ShaderOddities& odd) {
  for (std::size_t i = part.begin; i < part.begin + part.count; ++i) {
    const double n = plan_.points[i].exponent, peak = coefficients_.at(n), value = theirs(i);
    const Geometry geometry(plan_.points[i]);
    if (!is_defined(geometry)) {
      // At the silhouette a rounding decides on which side the eye is.
      if (geometry.n_dot_v >= 0) continue;
      ++odd.below_calls;
      odd.below_nonfinite += values_[i].written && !std::isfinite(value);
      odd.below_lit += std::isfinite(value) && value != 0;
      continue;
    }
    ++odd.calls;
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
    const double scale = more_where_opposite(geometry);
    // With shadowing the model's highlight is higher than its coefficient towards grazing.
    const double of_peak = std::abs(value - expected) / std::max(peak, expected) / scale;
    // A discarded pixel is as dark as 0.
    odd.unwritten += !values_[i].written && of_peak > error.allowed_of_peak;
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

void Judge::judge(records::ShaderCheck& record) {
  std::map<double, records::ShaderError> worst;
  records::ShaderOddities& odd = record.oddities;
  add_errors(plan_.domain, worst, odd);
  add_errors(plan_.below, worst, odd);
  add_errors(plan_.arc, worst, odd);
  for (const Plan::Part& sphere : plan_.spheres) add_errors(sphere, worst, odd);
  for (std::size_t i = plan_.hard.begin; i < plan_.hard.begin + plan_.hard.count; ++i) {
    ++odd.hard_calls;
    odd.hard_nonfinite += !std::isfinite(theirs(i));
  }
  bool passes = odd.nan + odd.infinite == 0;
  for (const auto& [n, error] : worst) {
    record.errors.push_back(error);
    passes = passes && error.max_of_peak <= error.allowed_of_peak;
  }
  record.verdict = records::kShaderVerdicts[passes ? 0 : 1];
}

records::ShaderExplanation Judge::explanation(const records::ShaderOddities& odd,
                                              bool of_roughness) {
  Observed observed{{}, {}, odd.calls, odd.nan};
  for (std::size_t i = plan_.domain.begin; i < plan_.domain.begin + plan_.domain.count; ++i) {
    observed.points.push_back(plan_.points[i]);
    observed.values.push_back(theirs(i));
  }
  return explain(highlight_, observed, of_roughness);
}

}  // namespace lobelia::shader_check
