#include "renderer/plan/plan.hpp"

#include <fmt/format.h>

#include <map>

#include "base/pictures/half.hpp"
#include "base/system/error.hpp"
#include "renderer/fused.hpp"
#include "renderer/kernels/kernels.hpp"
#include "renderer/plan/idle_parts.hpp"

namespace lobelia {
namespace {

template <EffectOfLight E>
EffectDecision decide(const Scene& scene, EffectPolicy policy, Plan& plan) {
  EffectDecision decision = E::decide(scene, policy, plan);
  decision.name = E::kName;
  decision.work = E::kWork;
  decision.hides = E::kHides;
  if (policy == EffectPolicy::kAll && decision.on)
    decision.reason += " (forced: all effects were asked for)";
  return decision;
}

/// A lower bound of |L + V| over the points of a sphere that are seen and lit: from the directions at its centre,
/// each widened by the angle that the sphere fills. 0 if there is none.
double min_half_length(const Scene& scene, const Lamp& lamp, const Sphere& sphere) {
  const auto widening = [&](Vec3 from) {
    const double distance = length(from - sphere.center);
    return distance > sphere.radius ? std::asin(sphere.radius / distance) : std::numbers::pi;
  };
  const Vec3 to_eye = scene.camera.origin - sphere.center;
  if (length(to_eye) == 0) return 0;
  double angle = widening(scene.camera.origin);
  Vec3 to_light;
  if (lamp.is_distant) {
    to_light = -lamp.direction;
  } else {
    angle += widening(lamp.position);
    to_light = lamp.position - sphere.center;
    if (length(to_light) == 0) return 0;
  }
  angle += std::acos(std::clamp(dot(normalize(to_eye), normalize(to_light)), -1.0, 1.0));
  return angle < std::numbers::pi ? 2 * std::cos(angle / 2) : 0;
}

void decide_precision(const Scene& scene, std::optional<Precision> asked, Plan& plan) {
  if (asked == Precision::kFloat16)
    for (const Material& m : scene.materials)
      if (m.highlight.exponent > kGreatestHalf)
        throw Error(ExitCode::kInput,
                    "exponent {:g}: float16 has no number above {:g}; choose a wider "
                    "--precision",
                    m.highlight.exponent, kGreatestHalf);
  std::array<std::size_t, kPrecisionCount> pairs{};
  for (const Material& m : scene.materials)
    plan.any_direction_precision.push_back(asked ? *asked : sufficient_precision(m.highlight, 0));
  // By material and by |L + V|, rounded down to a power of 2^(1/4): a crowd of spheres needs few bounds then.
  std::map<std::pair<int, int>, Precision> known;
  const bool one_by_one = scene.spheres.size() * std::max(kMaxSummedLights, scene.lights.size()) <=
                              kMaxPairwiseSpheres * kMaxSummedLights &&
                          scene.camera.aperture_radius == 0;
  std::array<std::size_t, kPrecisionCount> of_any{};  // surfaces, by the precision of any direction
  for (const Sphere& sphere : scene.spheres)
    ++of_any[std::size_t(plan.any_direction_precision[std::size_t(sphere.material)])];
  for (const Light& light : scene.lights) {
    auto& row = plan.precision.emplace_back();
    const auto lamp = find_lamp(light);
    const bool any = !one_by_one || !lamp;
    for (std::size_t p = 0; any && p < pairs.size(); ++p) pairs[p] += of_any[p];
    for (const Sphere& sphere : scene.spheres) {
      if (any) break;
      Precision precision = asked.value_or(Precision::kFloat64);
      if (!asked) {
        const double least = min_half_length(scene, *lamp, sphere);
        constexpr int kShortest = -32;
        const int quarters =
            least > 0 ? std::max(kShortest, int(std::floor(4 * std::log2(least)))) : kShortest;
        const auto [entry, is_new] = known.try_emplace({sphere.material, quarters});
        if (is_new)
          entry->second =
              sufficient_precision(scene.materials[std::size_t(sphere.material)].highlight,
                                   quarters > kShortest ? std::exp2(quarters / 4.0) : 0);
        precision = entry->second;
      }
      row.push_back(precision);
      ++pairs[std::size_t(precision)];
    }
    for (const Plane& plane : scene.planes)
      ++pairs[std::size_t(plan.any_direction_precision[std::size_t(plane.material)])];
  }
  if (asked) {
    plan.precision_reason = fmt::format(
        "{} was asked for{}", name(*asked),
        *asked == Precision::kFloat16 ? ", and is emulated: its time is no phone's" : "");
    return;
  }
  for (std::size_t p = 0; p < pairs.size(); ++p)
    if (pairs[p] > 0)
      plan.precision_reason +=
          fmt::format("{}{} for {} of {} pairs of light and surface",
                      plan.precision_reason.empty() ? "" : ", ", name(Precision(p)), pairs[p],
                      scene.lights.size() * (scene.spheres.size() + scene.planes.size()));
  plan.precision_reason +=
      plan.precision_reason.empty()
          ? "nothing is lit"
          : fmt::format(": the narrowest that adds at most {:g} of the peak", kAllowedShadingError);
}

LightStrategy strategy_of(const Light& light, const Material& material, EffectPolicy policy,
                          Experiment::Directions asked) {
  using Directions = Experiment::Directions;
  if (is_delta(light) || asked == Directions::kLight) return LightStrategy::kLight;
  if (asked != Directions::kPlanned) return LightStrategy::kSurface;
  if (policy == EffectPolicy::kAll) return LightStrategy::kBoth;
  if (!is_environment(light))
    return has_highlight(material) ? LightStrategy::kBoth : LightStrategy::kLight;
  return info(light).varies ? LightStrategy::kBoth : LightStrategy::kSurface;
}

/// The sum of looked_at() over the tiles along one axis.
std::uint64_t looked_at_for_tiles(int size, Filter filter) {
  int sum = 0;
  for (int begin = 0; begin < size; begin += kTileSide) {
    const auto range = looked_at({begin, std::min(size, begin + kTileSide)}, size, filter);
    sum += range.end - range.begin;
  }
  return std::uint64_t(sum);
}

/// Upper bounds: every ray meets a surface.
void expect_rays(const Scene& scene, Plan& plan) {
  const Film& film = scene.film;
  const std::uint64_t pixels = std::uint64_t(film.width) * std::uint64_t(film.height);
  plan.camera_rays = pixels * std::uint64_t(scene.sampler.sample_count);
  if (plan.first_samples < scene.sampler.sample_count)
    plan.camera_rays +=
        std::uint64_t(plan.first_samples) * (looked_at_for_tiles(film.width, film.filter) *
                                                 looked_at_for_tiles(film.height, film.filter) -
                                             pixels);
  const bool sized = !std::ranges::all_of(scene.lights, is_delta);
  const bool by_surface = std::ranges::any_of(plan.strategy, [](const auto& row) {
    return std::ranges::any_of(row, [](LightStrategy s) { return s != LightStrategy::kLight; });
  });
  std::uint64_t shadowed_lights = 0, shadowed_area = 0, shadowed_lamps = 0;
  for (std::size_t l = 0; l < plan.occluders.size(); ++l) {
    const bool shadowed = !std::ranges::all_of(plan.occluders[l], &Occluders::empty);
    (is_area(scene.lights[l])    ? shadowed_area
     : is_delta(scene.lights[l]) ? shadowed_lamps
                                 : shadowed_lights) += shadowed;
  }
  shadowed_lights +=
      plan.draws_area_light ? std::min<std::uint64_t>(1, shadowed_area) : shadowed_area;
  const std::uint64_t later_lamps =
      plan.draws_lamp ? std::min<std::uint64_t>(1, shadowed_lamps) : shadowed_lamps;
  // A camera ray may go on as one ray of each kind, and each of those as one of either. Forced effects are traced
  // once.
  const std::uint64_t forced = plan.policy == EffectPolicy::kAll;
  const std::uint64_t mirrored =
      plan.on<effects::Mirror>()
          ? std::max(forced, std::uint64_t(plan.depth.mirror) + (sized ? 1 : 0))
          : 0;
  const std::uint64_t glossy = plan.on<effects::Glossy>() ? std::uint64_t(plan.depth.glossy) : 0;
  const std::uint64_t branches = (mirrored > 0) + (glossy > 0);
  const std::uint64_t shaded = 1 + branches * (mirrored + glossy);
  plan.max_mirror_rays = plan.camera_rays * mirrored * std::max<std::uint64_t>(1, branches);
  if (by_surface || glossy > 0)
    plan.max_scattered_rays = plan.camera_rays * (shaded + glossy);
  else
    plan.max_scattered_rays = forced * plan.camera_rays;
  const std::uint64_t at_each =
      shadowed_lights + shadowed_lamps + (shaded - 1) * (shadowed_lights + later_lamps);
  plan.max_shadow_rays = plan.camera_rays > 0 && at_each > UINT64_MAX / plan.camera_rays
                             ? UINT64_MAX
                             : plan.camera_rays * at_each;
}

template <EffectOfLight... E>
void decide_effects(TypeList<E...>, const Scene& scene, EffectPolicy policy, Plan& plan) {
  (plan.effects.push_back(decide<E>(scene, policy, plan)), ...);
}

std::string kernel_text(const Scene& scene, const Plan& plan) {
  if (FusedRenderer::can_render(scene, plan)) return FusedRenderer::kernel_text();
  const std::size_t spheres = scene.spheres.size();
  return fmt::format("waves of {} rays, {}; {}", kChunk, kernels().instruction_set,
                     spheres > kMaxLoopSpheres
                         ? fmt::format("Embree over {} spheres", spheres)
                         : fmt::format("every ray against each of {} spheres", spheres));
}

}  // namespace

Plan make_plan(const Scene& scene, EffectPolicy policy, std::optional<Precision> precision,
               Experiment experiment) {
  if (policy == EffectPolicy::kAsCalledFor)
    if (const auto trimmed = without_idle_parts(scene))
      return make_plan(*trimmed, policy, precision, experiment);
  Plan plan;
  plan.policy = policy;
  plan.experiment = experiment;
  plan.contacts = find_contacts(scene);
  decide_effects(Effects{}, scene, policy, plan);
  for (const Light& light : scene.lights) {
    auto& row = plan.strategy.emplace_back();
    for (const Material& material : scene.materials)
      row.push_back(strategy_of(light, material, policy, experiment.directions));
  }
  decide_precision(scene, precision, plan);
  expect_rays(scene, plan);
  plan.kernel = kernel_text(scene, plan);
  if (const auto lamps = std::ranges::count_if(scene.lights, is_delta);
      lamps > std::ptrdiff_t(kMaxSummedLights))
    plan.kernel += fmt::format("; {} sums the light of all {} lights without a size",
                               plan.draws_lamp ? "each first point" : "each point", lamps);
  if (std::ranges::any_of(scene.materials,
                          [](const Material& m) { return m.highlight.lobe.formula != nullptr; }))
    plan.kernel += "; slow: a lobe is a formula, computed point by point in float64";
  return plan;
}

std::vector<double> min_half_lengths(const Scene& scene) {
  std::vector<double> least(scene.materials.size(), 2);
  const auto bound = [&](int material, double length) {
    double& known = least[std::size_t(material)];
    known = std::min(known, length);
  };
  const bool any_direction =
      scene.camera.aperture_radius > 0 || scene.depth.mirror > 0 || scene.depth.glossy > 0;
  const bool unknown = any_direction || !std::ranges::all_of(scene.lights, is_delta);
  for (const Sphere& sphere : scene.spheres) {
    if (unknown && !scene.lights.empty()) bound(sphere.material, 0);
    for (const Light& light : scene.lights) {
      if (unknown) break;
      bound(sphere.material, min_half_length(scene, lamp_of(light), sphere));
    }
  }
  for (const Plane& plane : scene.planes) {
    bound(plane.material, 0);
    bound(plane.checker_material, 0);
  }
  return least;
}

}  // namespace lobelia
