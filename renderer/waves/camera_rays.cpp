
#include "renderer/sobol.hpp"
#include "renderer/waves/waves.hpp"

namespace lobelia::waves {
namespace {

void place_on_film(const PreparedScene& prepared, std::span<const PixelSample> samples,
                   std::span<const SampleResult> results, Workspace& work) {
  const CameraFrame& frame = prepared.frame;
  RandomPairs& film = work.film;
  const std::size_t count = samples.size();
  if (prepared.scene.sampler.sample_count > 1)
    kernels().random(count, work.pixel.data(), work.index.data(), kPixel, film.u, film.v);
  for (std::size_t i = 0; i < count; ++i) {
    FilterSampler::Offset from_center{samples[i].dx, samples[i].dy};
    if (prepared.scene.sampler.sample_count > 1)
      from_center = prepared.filter(results[i].negative, film.u[i], film.v[i]);
    film.u[i] = frame.film_u(samples[i].x + (0.5 + from_center.x));
    film.v[i] = frame.film_v(samples[i].y + (0.5 + from_center.y));
  }
}

void place_on_lens(const PreparedScene& prepared, Wave& wave, Workspace& work) {
  const Camera& camera = prepared.scene.camera;
  const CameraFrame& frame = prepared.frame;
  RandomPairs& lens = work.lens;
  if (!prepared.plan.on<effects::DepthOfField>()) {
    std::fill_n(lens.u, wave.count, 0.0);
    std::fill_n(lens.v, wave.count, 0.0);
    return;
  }
  kernels().random(wave.count, work.pixel.data(), work.index.data(), kLens, lens.u, lens.v);
  for (std::size_t i = 0; i < wave.count; ++i) {
    // A point of the disc, evenly by area.
    const double radius = camera.aperture_radius * std::sqrt(lens.u[i]);
    const double turn = 2 * std::numbers::pi * lens.v[i];
    const double x = radius * std::cos(turn), y = radius * std::sin(turn);
    put(frame.origin + x * frame.right + y * frame.up, wave.origin, i);
    lens.u[i] = x / camera.focus_distance;
    lens.v[i] = y / camera.focus_distance;
  }
  work.work.of<effects::DepthOfField>() += wave.count;
}

}  // namespace

void start(const PreparedScene& prepared, std::span<const PixelSample> samples,
           std::span<SampleResult> results, Wave& wave, Workspace& work) {
  wave.count = samples.size();
  wave.left = prepared.plan.depth;
  wave.branch = 0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const PixelSample& s = samples[i];
    const FilterSampler::Place place = prepared.filter.place(s.index);
    const std::uint32_t pixel = sobol::pixel_hash(
        std::uint64_t(s.y) * std::uint64_t(prepared.scene.film.width) + std::uint64_t(s.x),
        prepared.scene.sampler.seed);
    // Each part of the filter has its own sequence.
    work.pixel[i] = place.negative ? sobol::hash(pixel) : pixel;
    work.index[i] = place.index;
    work.radiance[i] = {};
    wave.slot[i] = int(i);
    wave.weight[i] = {1, 1, 1};
    wave.leaves[i] = -1;
    results[i].negative = place.negative;
    put(prepared.frame.origin, wave.origin, i);
    if (s.index > 0) ++work.work.of<effects::Antialiasing>();
  }
  place_on_film(prepared, samples, results, work);
  place_on_lens(prepared, wave, work);
  kernels().camera_rays(prepared.frame, wave.count, work.film.u, work.film.v, work.lens.u,
                        work.lens.v, wave.to_eye);
  work.work.camera_rays += wave.count;
}

}  // namespace lobelia::waves
