#include "renderer/reflector.hpp"

#include "renderer/frame.hpp"

namespace lobelia {
namespace {

bool is_direction(Vec3 v) {
  const double m = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z) && m > 0;
}

}  // namespace

std::optional<Reflector::Directions> Reflector::above_horizon(Vec3 normal, Vec3 to_eye,
                                                              Vec3 to_light) {
  if (!is_direction(normal) || !is_direction(to_eye) || !is_direction(to_light))
    return std::nullopt;
  const Directions d{normalize(normal), normalize(to_eye), normalize(to_light)};
  if (!(dot(d.normal, d.to_eye) > 0 && dot(d.normal, d.to_light) > 0)) return std::nullopt;
  return d;
}

Reflector::Reflector(const Material& material)
    : material_(material),
      has_highlight_(has_highlight(material)),
      lobe_(prepare(material.highlight.lobe, material.highlight.exponent)),
      coefficient_(radiance_coefficient(material.highlight)) {}

double Reflector::one_minus_cos(const Directions& d) const {
  const Vec3 difference = info(material_.highlight.model).angle == LobeAngle::kReflection
                              ? 2 * dot(d.normal, d.to_eye) * d.normal - d.to_eye - d.to_light
                              : d.normal - normalize(d.to_eye + d.to_light);
  return dot(difference, difference) / 2;
}

/// The share of draws that follow the highlight: its share of the reflectance at this angle.
double Reflector::specular_share(double n_dot_v) const {
  if (!has_highlight_) return 0;
  const double base = std::max(0.0, 1 - n_dot_v), weight = base * base * base * base * base;
  double specular = max_component(material_.specular_reflectance);
  if (material_.fresnel == Fresnel::kSchlick) specular += (1 - specular) * weight;
  const double diffuse = max_component(material_.diffuse_reflectance);
  return specular + diffuse > 0 ? specular / (specular + diffuse) : 1;
}

Rgb Reflector::eval(const Directions& d, double s) const {
  const double n_dot_l = dot(d.normal, d.to_light);
  const Rgb diffuse = n_dot_l * std::numbers::inv_pi * material_.diffuse_reflectance;
  if (!has_highlight_) return diffuse;
  const double value = coefficient_ * lobe_.value(s) *
                       geometry_factor(material_.highlight.model, material_.highlight.exponent,
                                       n_dot_l, dot(d.normal, d.to_eye));
  return value * fresnel_factor(material_.fresnel, material_.specular_reflectance, d.to_eye,
                                d.to_light) +
         diffuse;
}

double Reflector::pdf(const Directions& d, double s) const {
  const double share = specular_share(dot(d.normal, d.to_eye));
  double specular = 0;
  if (share > 0) {
    specular = lobe_.density(std::min(1.0, s)) / (2 * std::numbers::pi);
    // From half vectors to directions: dL = 4 (V.H) dH, V.H = |L + V| / 2.
    if (info(material_.highlight.model).angle == LobeAngle::kHalfVector)
      specular /= 2 * length(d.to_eye + d.to_light);
  }
  return share * specular + (1 - share) * dot(d.normal, d.to_light) * std::numbers::inv_pi;
}

Rgb Reflector::eval(Vec3 normal, Vec3 to_eye, Vec3 to_light) const {
  const auto d = above_horizon(normal, to_eye, to_light);
  return d ? eval(*d, one_minus_cos(*d)) : Rgb{};
}

double Reflector::pdf(Vec3 normal, Vec3 to_eye, Vec3 to_light) const {
  const auto d = above_horizon(normal, to_eye, to_light);
  return d ? pdf_above(*d) : 0;
}

double Reflector::pdf_above(const Directions& d) const {
  return pdf(d, has_highlight_ ? one_minus_cos(d) : 0);
}

std::optional<ReflectorSample> Reflector::sample(Vec3 normal, Vec3 to_eye, double choice, double u,
                                                 double v) const {
  const auto here = above_horizon(normal, to_eye, normal);
  return here ? sample_above(here->normal, here->to_eye, choice, u, v) : std::nullopt;
}

std::optional<ReflectorSample> Reflector::sample_above(Vec3 normal, Vec3 to_eye, double choice,
                                                       double u, double v) const {
  const double n_dot_v = dot(normal, to_eye);
  Vec3 to_light;
  if (choice < specular_share(n_dot_v)) {
    const double s = lobe_.sample(u);
    if (info(material_.highlight.model).angle == LobeAngle::kReflection) {
      to_light = about(2 * n_dot_v * normal - to_eye, s, v);
    } else {
      const Vec3 half = about(normal, s, v);
      to_light = 2 * dot(half, to_eye) * half - to_eye;
    }
  } else {
    // Malley's method: lifts a point of the disc. N.L = sqrt(1 - u).
    to_light = about(normal, u / (1 + std::sqrt(1 - u)), v);
  }
  to_light = 1 / std::sqrt(dot(to_light, to_light)) * to_light;
  const Directions d{normal, to_eye, to_light};
  if (!(dot(normal, to_light) > 0)) return std::nullopt;
  const double s = has_highlight_ ? one_minus_cos(d) : 0;
  const ReflectorSample drawn{to_light, eval(d, s), pdf(d, s)};
  // A pdf may underflow to 0 far from the lobe.
  if (!(drawn.pdf > 0)) return std::nullopt;
  return drawn;
}

}  // namespace lobelia
