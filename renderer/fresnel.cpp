#include "renderer/fresnel.hpp"

#include "base/words/text.hpp"

namespace lobelia {
namespace {
constexpr std::string_view kFresnelNames[] = {"none", "schlick"};
}

std::span<const std::string_view> fresnel_names() { return kFresnelNames; }
std::string_view name(Fresnel fresnel) { return kFresnelNames[std::size_t(fresnel)]; }
std::optional<Fresnel> find_fresnel(std::string_view name) {
  return find_id<Fresnel>(kFresnelNames, name);
}

double mirror_at_grazing(Rgb reflectance) { return std::min(1.0, 50 * max_component(reflectance)); }

Rgb fresnel_factor(Fresnel fresnel, Rgb reflectance, Vec3 to_eye, Vec3 to_light,
                   double at_grazing) {
  if (fresnel == Fresnel::kNone) return reflectance;
  const double base = std::max(0.0, 1 - length(to_eye + to_light) / 2);
  const double weight = base * base * base * base * base;
  const double added = weight * at_grazing;
  return (1 - weight) * reflectance + Rgb{added, added, added};
}

}  // namespace lobelia
