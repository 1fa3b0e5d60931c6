#include "renderer/render.hpp"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/enumerable_thread_specific.h>
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <numbers>

#include "core/interrupt.hpp"
#include "core/threads.hpp"
#include "renderer/kernels/kernels.hpp"

namespace lobelia {
namespace {

/// Where in a pixel sample k falls. Sample 0 of 1 is the centre; otherwise the R2 sequence (Roberts
/// 2018), shifted for each pixel by a hash of the seed, so that no state is shared between threads.
struct PixelSamples {
  int count;
  std::uint64_t seed;

  static std::uint64_t mix(std::uint64_t x) {  // SplitMix64's finaliser (Steele et al. 2014)
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
    return x ^ (x >> 31);
  }
  std::pair<double, double> offset(std::uint64_t pixel, int k) const {
    if (count == 1) return {0.5, 0.5};
    constexpr double kStepX = 0.7548776662466927, kStepY = 0.5698402909980532;
    const std::uint64_t h = mix(mix(seed + 0x9e3779b97f4a7c15u) + pixel);
    const double x = double(h >> 32) * 0x1p-32 + kStepX * k;
    const double y = double(h & 0xffffffffu) * 0x1p-32 + kStepY * k;
    return {x - std::floor(x), y - std::floor(y)};
  }
};

/// What shading needs of a material, computed once for the picture.
struct PreparedMaterial {
  Highlight highlight;
  Fresnel fresnel = Fresnel::kNone;
  Rgb specular;  ///< reflectance times coefficient
  Rgb grazing;   ///< what Schlick's factor adds to it at grazing angles, at most
  Rgb diffuse;   ///< reflectance / pi
};

/// The buffers of one thread: about 100 KiB, within the second-level cache.
struct Workspace {
  alignas(64) double u[kChunk]{}, v[kChunk]{}, sphere[kChunk]{};
  Vec3Chunk point{}, normal{}, to_eye{};
  // The hits of one sphere, side by side.
  std::vector<int> pixel_of = std::vector<int>(kChunk);
  Vec3Chunk hit_point{}, hit_normal{}, hit_to_eye{}, to_light{};
  alignas(64) double falloff[kChunk]{}, distance[kChunk]{}, visible[kChunk]{};
  alignas(64) double specular[kChunk]{}, n_dot_l[kChunk]{}, fresnel[kChunk]{};
  std::vector<Rgb> sum = std::vector<Rgb>(kChunk);
};

class Renderer {
 public:
  Renderer(const Scene& scene, const Plan& plan, Image& image)
      : scene_(scene), plan_(plan), image_(image), frame_(camera_frame(scene.camera, scene.film)) {
    for (const Material& m : scene.materials) {
      const double coefficient = radiance_coefficient(m.highlight);
      const Rgb f0 = m.specular_reflectance;
      materials_.push_back({m.highlight, m.fresnel, coefficient * f0,
                            coefficient * Rgb{1 - f0.r, 1 - f0.g, 1 - f0.b},
                            std::numbers::inv_pi * m.diffuse_reflectance});
    }
  }

  /// Leaves the row unfinished on Ctrl-C.
  void render_row(int y, Workspace& work) {
    for (int x = 0; x < image_.width() && !interrupted(); x += int(kChunk))
      render_chunk(x, y, std::min(int(kChunk), image_.width() - x), work);
  }

  std::uint64_t camera_rays() const { return camera_rays_; }
  std::uint64_t shadow_rays() const { return shadow_rays_; }

 private:
  void render_chunk(int x0, int y, int count, Workspace& work) {
    const PixelSamples samples{scene_.sampler.sample_count, scene_.sampler.seed};
    std::fill_n(work.sum.begin(), count, Rgb{});
    for (int k = 0; k < samples.count; ++k) {
      for (int i = 0; i < count; ++i) {
        const auto [du, dv] =
            samples.offset(std::uint64_t(y) * image_.width() + std::uint64_t(x0 + i), k);
        work.u[i] = (2 * (x0 + i + du) / image_.width() - 1) * frame_.half_width;
        work.v[i] = (1 - 2 * (y + dv) / image_.height()) * frame_.half_height;
      }
      kernels_.trace(frame_, scene_.spheres, std::size_t(count), work.u, work.v, work.sphere,
                     work.point, work.normal, work.to_eye);
      shade_hits(count, work);
    }
    camera_rays_ += std::uint64_t(count) * samples.count;
    for (int i = 0; i < count; ++i) {
      const auto pixel = image_.pixel(x0 + i, y);
      const Rgb mean = 1.0 / samples.count * work.sum[i];
      pixel[0] = float(mean.r);
      pixel[1] = float(mean.g);
      pixel[2] = float(mean.b);
    }
  }

  /// Sphere by sphere, so that material and occluders are the same for a whole run of lanes.
  void shade_hits(int count, Workspace& work) {
    double lowest = -1, highest = -1;
    for (int i = 0; i < count; ++i) highest = std::max(highest, work.sphere[i]);
    if (highest < 0) return;
    for (double next = lowest; next <= highest;) {
      // The next sphere that was hit at all; most of a crowd is not, in any one chunk.
      next = highest + 1;
      for (int i = 0; i < count; ++i)
        if (work.sphere[i] > lowest) next = std::min(next, work.sphere[i]);
      if (next > highest) break;
      shade_sphere(int(next), gather(next, count, work), work);
      lowest = next;
    }
  }

  static std::size_t gather(double sphere, int count, Workspace& work) {
    std::size_t hits = 0;
    const auto copy = [](const Vec3Chunk& from, int i, Vec3Chunk& to, std::size_t j) {
      to.x[j] = from.x[i];
      to.y[j] = from.y[i];
      to.z[j] = from.z[i];
    };
    for (int i = 0; i < count; ++i) {
      if (work.sphere[i] != sphere) continue;
      copy(work.point, i, work.hit_point, hits);
      copy(work.normal, i, work.hit_normal, hits);
      copy(work.to_eye, i, work.hit_to_eye, hits);
      work.pixel_of[hits++] = i;
    }
    return hits;
  }

  void shade_sphere(int sphere, std::size_t hits, Workspace& work) {
    const PreparedMaterial& material = materials_[scene_.spheres[sphere].material];
    for (std::size_t l = 0; l < scene_.lights.size(); ++l) {
      const Light& light = scene_.lights[l];
      kernels_.light(light, hits, work.hit_point, work.to_light, work.falloff, work.distance);
      const auto& occluders = plan_.occluders[l][sphere];
      if (!occluders.empty()) {
        kernels_.visibility(scene_.spheres, occluders, hits, work.hit_point, work.to_light,
                            work.distance, work.visible);
        for (std::size_t i = 0; i < hits; ++i) work.falloff[i] *= work.visible[i];
        shadow_rays_ += hits;
      }
      const Rgb emitted = strength(light);
      kernels_.shade(material.highlight, plan_.precision[l][sphere])(
          material.highlight, hits, work.hit_normal, work.hit_to_eye, work.to_light, work.specular);
      const Rgb specular = emitted * material.specular;
      for (std::size_t i = 0; i < hits; ++i) {
        Rgb& sum = work.sum[work.pixel_of[i]];
        sum = sum + work.falloff[i] * work.specular[i] * specular;
      }
      if (plan_.fresnel) add_fresnel(material, emitted, hits, work);
      if (!plan_.diffuse) continue;
      kernels_.cosine(hits, work.hit_normal, work.to_light, work.n_dot_l);
      const Rgb diffuse = emitted * material.diffuse;
      for (std::size_t i = 0; i < hits; ++i) {
        Rgb& sum = work.sum[work.pixel_of[i]];
        sum = sum + work.falloff[i] * work.n_dot_l[i] * diffuse;
      }
    }
  }

  void add_fresnel(const PreparedMaterial& material, Rgb emitted, std::size_t hits,
                   Workspace& work) {
    const Rgb grazing = material.fresnel == Fresnel::kSchlick ? emitted * material.grazing : Rgb{};
    kernels_.fresnel(hits, work.hit_to_eye, work.to_light, work.fresnel);
    for (std::size_t i = 0; i < hits; ++i) {
      Rgb& sum = work.sum[work.pixel_of[i]];
      sum = sum + work.falloff[i] * work.specular[i] * work.fresnel[i] * grazing;
    }
  }

  const Scene& scene_;
  const Plan& plan_;
  Image& image_;
  const KernelTable& kernels_ = kernels();
  CameraFrame frame_;
  std::vector<PreparedMaterial> materials_;
  std::atomic<std::uint64_t> camera_rays_{0}, shadow_rays_{0};
};

}  // namespace

RenderResult render(const Scene& scene, const RenderOptions& options) {
  using Clock = std::chrono::steady_clock;
  const auto start = Clock::now();
  RenderResult result;
  result.plan = make_plan(scene, options.effects, options.precision);
  const auto planned = Clock::now();
  result.image = Image(scene.film.width, scene.film.height);
  result.instruction_set = kernels().instruction_set;

  Renderer renderer(scene, result.plan, result.image);
  std::atomic<int> rows_done{0};
  oneapi::tbb::enumerable_thread_specific<Workspace> workspaces;
  ThreadLimit(options.threads).run([&] {
    oneapi::tbb::parallel_for(oneapi::tbb::blocked_range<int>(0, scene.film.height, 8),
                              [&](const oneapi::tbb::blocked_range<int>& rows) {
                                Workspace& work = workspaces.local();
                                for (int y = rows.begin(); y < rows.end(); ++y)
                                  renderer.render_row(y, work);
                                const int done = rows_done += rows.end() - rows.begin();
                                if (options.on_progress)
                                  options.on_progress(double(done) / scene.film.height);
                              });
  });
  throw_if_interrupted();
  const std::chrono::duration<double> plan_time = planned - start;
  const std::chrono::duration<double> render_time = Clock::now() - planned;
  result.plan_seconds = plan_time.count();
  result.render_seconds = render_time.count();
  result.camera_rays = renderer.camera_rays();
  result.shadow_rays = renderer.shadow_rays();
  return result;
}

}  // namespace lobelia
