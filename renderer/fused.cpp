#include "renderer/fused.hpp"

#include <fmt/format.h>

#include "renderer/chord.hpp"
#include "renderer/highlight_reach.hpp"
#include "renderer/kernels/kernels.hpp"

namespace lobelia {
namespace {

constexpr std::size_t kMostSpheres = 16;

int down_to_block(int x) { return x / kFusedBlock * kFusedBlock; }

FusedSphere prepare(const Scene& scene, const Plan& plan, std::size_t index) {
  const Sphere& sphere = scene.spheres[index];
  const Material& material = scene.materials[sphere.material];
  FusedSphere result;
  result.eye = scene.camera.origin;
  result.center = sphere.center;
  result.radius = sphere.radius;
  result.highlight = material.highlight;
  if (!scene.lights.empty())
    result.precision = plan.precision[0].empty()
                           ? plan.any_direction_precision[std::size_t(sphere.material)]
                           : plan.precision[0][index];
  // A black base adds 0 to every pixel.
  result.diffuse = !is_black(material.diffuse_reflectance);
  result.fresnel = material.fresnel == Fresnel::kSchlick;
  const double coefficient = radiance_coefficient(material.highlight);
  const Rgb f0 = material.specular_reflectance;
  const Rgb specular = coefficient * f0;
  const Rgb grazing = coefficient * Rgb{1 - f0.r, 1 - f0.g, 1 - f0.b};
  const Rgb diffuse = std::numbers::inv_pi * material.diffuse_reflectance;
  for (const Light& light : scene.lights) {
    const Lamp lamp = lamp_of(light);
    result.lights.push_back({lamp.is_distant, lamp.is_distant ? -lamp.direction : lamp.position,
                             lamp.strength * specular, lamp.strength * grazing,
                             lamp.strength * diffuse});
  }
  return result;
}

/// Balls around what each light's highlight reaches; none if a part of the sphere outside of them may shine.
std::vector<Sphere> lit_balls(const FusedSphere& prepared, const Scene& scene,
                              const Sphere& sphere) {
  if (prepared.diffuse) return {};
  std::vector<Sphere> balls;
  for (std::size_t l = 0; l < scene.lights.size(); ++l) {
    // All lights are added before they are rounded: what is nothing of each may be something of all.
    const double brightest =
        double(scene.lights.size()) *
        max_component(prepared.lights[l].specular + prepared.lights[l].grazing);
    const auto cap = highlight_reach(prepared.highlight, sphere, prepared.eye,
                                     lamp_of(scene.lights[l]), brightest);
    if (!cap) return {};
    balls.push_back(ball_around(*cap, sphere));
  }
  return balls;
}

}  // namespace

bool FusedRenderer::can_render(const Scene& scene, const Plan& plan) {
  if (plan.policy == EffectPolicy::kAll || scene.sampler.sample_count != 1 ||
      scene.spheres.size() > kMostSpheres || !beyond_delta_lights(scene).empty())
    return false;
  for (const Light& light : scene.lights)
    if (lamp_of(light).has_normal()) return false;
  for (const auto& by_sphere : plan.occluders)
    for (const auto& occluders : by_sphere)
      if (!occluders.empty()) return false;
  for (const auto& touched : plan.contacts)
    if (!touched.empty()) return false;
  // The kernel of a sphere has one precision for all lights. None emulates float16.
  for (const auto& by_sphere : plan.precision)
    if (by_sphere != plan.precision[0] || std::ranges::count(by_sphere, Precision::kFloat16) > 0)
      return false;
  return true;
}

FusedRenderer::FusedRenderer(const Scene& scene, const Plan& plan)
    : width_(scene.film.width),
      height_(scene.film.height),
      frame_(camera_frame(scene.camera, scene.film)),
      lights_(scene.lights.size()) {
  columns_.resize(std::size_t(down_to_block(width_ + kFusedBlock - 1)));
  for (std::size_t x = 0; x < columns_.size(); ++x) columns_[x] = frame_.film_u(int(x) + 0.5);
  for (std::size_t i = 0; i < scene.spheres.size(); ++i) {
    const Sphere& sphere = scene.spheres[i];
    if (!is_outside(sphere, frame_.origin)) continue;
    const FusedSphere prepared = prepare(scene, plan, i);
    bodies_.push_back({outline_of(sphere),
                       {},
                       {sphere.center, sphere.radius, false},
                       make_fused_kernel(prepared),
                       prepared.diffuse,
                       prepared.fresnel});
    for (const Sphere& ball : lit_balls(prepared, scene, sphere))
      bodies_.back().lit.push_back(outline_of(ball));
  }
}

FusedRenderer::Outline FusedRenderer::outline_of(const Sphere& sphere) const {
  const Vec3 to_center = sphere.center - frame_.origin;
  Outline outline{dot(to_center, frame_.forward), dot(to_center, frame_.right),
                  dot(to_center, frame_.up), 0, false};
  // Slightly wider than the sphere, by far more than rounding unless the eye is close to the surface.
  const double reach = dot(to_center, to_center), radius = sphere.radius * (1 + 1e-6);
  outline.tangent_squared = reach - radius * radius;
  outline.whole_rows = !(outline.tangent_squared > 1e-6 * reach);
  return outline;
}

/// The ray of (u, v), d = forward + u right + v up, meets the sphere if (c.d)^2 > |d|^2 K, with c the vector to the
/// centre and K the squared tangent from the eye: between the two roots of a quadratic in u.
PixelSpan FusedRenderer::span(const Outline& outline, double v) const {
  const PixelSpan whole{0, width_};
  if (outline.whole_rows) return whole;
  const double a = outline.ahead + v * outline.above, b = outline.aside;
  const double k = outline.tangent_squared, rest = k - b * b, stretch = 1 + v * v;
  // The outline is not an ellipse: it reaches beside the eye or behind it.
  if (!(rest > 1e-6 * k)) return whole;
  // A quarter of the discriminant over K, plus more than the rounding of a tiny and distant sphere.
  const double room = a * a - stretch * rest + 1e-12 * (a * a + stretch * k);
  if (room < 0 || a < 0) return {0, 0};
  const double middle = a * b / rest, half = std::sqrt(k * room) / rest;
  const auto column = [&](double u) {
    return ((u - frame_.shift_u) / frame_.half_width + 1) * width_ / 2 - 0.5;
  };
  const auto clamped = [&](double x) { return int(std::clamp(x, 0.0, double(width_))); };
  return {clamped(std::floor(column(middle - half)) - 1),
          clamped(std::ceil(column(middle + half)) + 2)};
}

/// The part of a body's columns in which its highlights may be seen.
PixelSpan FusedRenderer::lit_span(const Body& body, PixelSpan whole, double v) const {
  if (body.lit.empty()) return whole;
  PixelSpan lit{whole.end, whole.begin};
  for (const Outline& outline : body.lit) {
    const PixelSpan one = span(outline, v);
    if (one.begin >= one.end) continue;
    lit.begin = std::min(lit.begin, one.begin);
    lit.end = std::max(lit.end, one.end);
  }
  return {std::max(lit.begin, whole.begin), std::min(lit.end, whole.end)};
}

void FusedRenderer::render_rows(int y0, int y1, float* rgb, bool is_zero) const {
  for (int y = y0; y < y1; ++y) render_row(y, rgb + std::size_t(y - y0) * 3 * width_, is_zero);
}

void FusedRenderer::render_row(int y, float* rgb, bool is_zero) const {
  const double v = frame_.film_v(y + 0.5);
  const FusedRow row{frame_.forward, frame_.right, v * frame_.up, columns_.data(), rgb};
  const auto in_blocks = [&](PixelSpan exact) {
    return PixelSpan{down_to_block(exact.begin),
                     std::min(width_, down_to_block(exact.end + kFusedBlock - 1))};
  };
  std::array<PixelSpan, kMostSpheres> spans, lit;
  std::array<int, kMostSpheres> order;
  int count = 0;
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const PixelSpan exact = span(bodies_[i].outline, v);
    if (exact.begin >= exact.end) continue;
    spans[i] = in_blocks(exact);
    lit[i] = in_blocks(lit_span(bodies_[i], exact, v));
    order[count++] = int(i);
  }
  std::sort(order.begin(), order.begin() + count,
            [&](int i, int j) { return spans[i].begin < spans[j].begin; });
  const auto blacken = [&](int begin, int end) {
    if (!is_zero) std::fill(rgb + 3 * begin, rgb + 3 * end, 0.0f);
  };
  int done = 0;
  for (int first = 0, next; first < count; first = next) {
    PixelSpan all = spans[order[first]];
    for (next = first + 1; next < count && spans[order[next]].begin < all.end; ++next)
      all.end = std::max(all.end, spans[order[next]].end);
    // A single sphere overwrites its pixels.
    if (next == first + 1) all = lit[order[first]];
    if (all.begin >= all.end) continue;
    blacken(done, all.begin);
    // Several spheres add to each other's pixels.
    if (next > first + 1) blacken(all.begin, all.end);
    render_group(row, order.data() + first, next - first, lit.data(), all);
    done = all.end;
  }
  blacken(done, width_);
}

/// Renders spheres with overlapping pixels, of which each shines at `lit`; a single sphere overwrites.
void FusedRenderer::render_group(const FusedRow& row, const int* spheres, int count,
                                 const PixelSpan* lit, PixelSpan all) const {
  std::array<FusedRival, kMostSpheres> rivals;
  // Counts a ray once, though each sphere's kernel computes it again: up to where they are counted.
  int counted = all.begin;
  for (int i = 0; i < count; ++i) {
    std::size_t others = 0;
    for (int j = 0; j < count; ++j) {
      if (j == i) continue;
      rivals[others] = bodies_[spheres[j]].rival;
      rivals[others++].wins_ties = spheres[j] < spheres[i];
    }
    const PixelSpan own = lit[spheres[i]];
    if (own.begin >= own.end) continue;
    const Body& body = bodies_[spheres[i]];
    body.kernel->render(row, own.begin, own.end, {rivals.data(), others});
    const std::uint64_t pixels = std::uint64_t(own.end - own.begin);
    if (own.end > counted)
      rays_.fetch_add(std::uint64_t(own.end - std::max(own.begin, counted)),
                      std::memory_order_relaxed);
    counted = std::max(counted, own.end);
    if (body.diffuse) diffuse_.fetch_add(pixels * lights_, std::memory_order_relaxed);
    if (body.fresnel) fresnel_.fetch_add(pixels * lights_, std::memory_order_relaxed);
  }
}

Work FusedRenderer::work() const {
  Work work;
  work.camera_rays = rays_;
  work.of<effects::Diffuse>() = diffuse_;
  work.of<effects::Fresnel>() = fresnel_;
  return work;
}

std::string FusedRenderer::kernel_text() {
  return fmt::format(
      "fused: ray, sphere, lights and pixel in one loop over the pixels that a sphere "
      "can cover and its highlights reach, {}",
      kernels().instruction_set);
}

}  // namespace lobelia
