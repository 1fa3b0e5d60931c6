#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "bench/light/cycles.hpp"
#include "bench/light/measure.hpp"
#include "bench/light/sections.hpp"
#include "core/error.hpp"
#include "core/files.hpp"
#include "core/process.hpp"
#include "renderer/scene/scene_io.hpp"

namespace lobelia::bench {
namespace {

constexpr std::array kSamples = {1, 4, 16, 64, 256, 1024};
constexpr int kRepeats = 3, kConverged = 2048;
constexpr int kProcessSamples = 64;

/// The last count takes seconds: in the first repeat alone.
std::size_t counts_of(int repeat) { return kSamples.size() - (repeat > 1); }

/// What one engine did with a scene.
struct Measured {
  Converged converged;
  std::array<std::vector<double>, kSamples.size()> seconds;
  std::array<std::vector<Image>, kSamples.size()> images;  ///< of other seeds each
  std::vector<double> process_seconds;

  void converge(const Image& a, const Image& b) {
    converged = {mean_of(a, b), rms_of_difference(a, b) / 2};
  }
  double time(std::size_t i) const { return median(seconds[i]); }
  /// Relative to the picture; what the converged picture is off by itself is taken out.
  double error(std::size_t i) const {
    double sum = 0;
    for (const Image& image : images[i])
      sum += std::pow(rms_of_difference(image, converged.image), 2);
    const double squared = sum / double(images[i].size()) - std::pow(converged.error, 2);
    return std::sqrt(std::max(squared, 1e-20)) / rms(converged.image);
  }
  double error_slope() const {
    std::vector<double> x, y;
    for (std::size_t i = 1; i < kSamples.size(); ++i)
      x.push_back(std::log(time(i))), y.push_back(std::log(error(i)));
    return slope(x, y);
  }
  /// Between the samples that were taken, or, beyond the last, as the last two go on.
  double time_to(double wanted) const {
    if (wanted >= error(0)) return time(0);
    std::size_t i = 1;
    while (i + 1 < kSamples.size() && error(i) > wanted) ++i;
    const double x0 = std::log(time(i - 1)), x1 = std::log(time(i));
    const double y0 = std::log(error(i - 1)), y1 = std::log(error(i));
    return std::exp(x0 + (std::log(wanted) - y0) / (y1 - y0) * (x1 - x0));
  }
  /// What went before the first sample, and a sample of the whole picture, from the last two counts.
  double sample_seconds() const {
    constexpr std::size_t kLast = kSamples.size() - 1;
    return (time(kLast) - time(kLast - 1)) / (kSamples[kLast] - kSamples[kLast - 1]);
  }
  double overhead() const { return std::max(0.0, time(0) - sample_seconds()); }
};

void measure_ours(const Scene& scene, int repeat, Measured& ours) {
  for (std::size_t i = 0; i < counts_of(repeat); ++i) {
    Timed timed = render_timed(scene, kSamples[i], std::uint64_t(repeat));
    ours.seconds[i].push_back(timed.seconds);
    ours.images[i].push_back(std::move(timed.result.image));
  }
}

/// A whole command, from start to picture on the disk.
double process_seconds(const Scene& scene, const std::filesystem::path& directory,
                       const std::filesystem::path& lobelia) {
  Scene with_samples = scene;
  with_samples.sampler.sample_count = kProcessSamples;
  write_file(directory / "scene.xml", scene_to_xml(with_samples));
  const ProcessResult ended =
      run_process({lobelia.string(), "render", (directory / "scene.xml").string(), "-q", "-o",
                   (directory / "ours.exr").string()},
                  {});
  if (ended.exit_code != 0)
    throw Error(ExitCode::kInternal, "lobelia render failed: " + ended.output_tail);
  return ended.seconds;
}

void measure_cycles(const std::filesystem::path& blender, const Scene& scene, int repeat,
                    const std::filesystem::path& directory, Measured& theirs) {
  const Film film = scene.film;
  std::vector<CyclesPicture> pictures;
  const auto add = [&](int side, int samples, int seed) {
    pictures.push_back({side, side, samples, std::uint64_t(seed), 0, {}});
  };
  // What a call costs without a picture to speak of; the first of a process costs more.
  constexpr std::size_t kTiny = 4;
  for (std::size_t i = 0; i < kTiny; ++i) add(8, 1, repeat);
  const std::size_t counts = counts_of(repeat);
  for (std::size_t i = 0; i < counts; ++i) add(film.width, kSamples[i], repeat);
  if (repeat == 1)
    for (const int seed : {101, 102}) add(film.width, kConverged, seed);
  const double whole = run_cycles(blender, scene, directory, pictures);
  double inside = 0, call = 1e9;
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    inside += pictures[i].seconds;
    if (i > 0 && i < kTiny) call = std::min(call, pictures[i].seconds);
    if (i >= kTiny) require_picture(pictures[i].image, "Cycles");
  }
  for (std::size_t i = 0; i < counts; ++i) {
    CyclesPicture& picture = pictures[kTiny + i];
    theirs.seconds[i].push_back(std::max(1e-4, picture.seconds - call));
    theirs.images[i].push_back(std::move(picture.image));
    if (kSamples[i] == kProcessSamples)
      theirs.process_seconds.push_back(whole - inside + picture.seconds);
  }
  if (repeat == 1) theirs.converge(pictures[kTiny + counts].image, pictures.back().image);
}

void print_engine(const char* name, const Measured& m, std::size_t pixels) {
  const double sample = m.sample_seconds();
  fmt::print(
      "{}: {:.0f} ns a sample on {} threads, {:.1f} ms before the first; at {} samples {:.1f} % is "
      "sampling: {}\n",
      name, 1e9 * sample / double(pixels), processors(), 1e3 * m.overhead(), kSamples.back(),
      100 * sample * kSamples.back() / m.time(kSamples.size() - 1),
      m.overhead() > 0.5 * m.time(2)
          ? "start-up limits up to 16 samples, then the samples themselves"
          : "the samples themselves limit, not start-up");
}

/// The two pictures are of the same scene if they differ by their noise alone.
void print_agreement(const Converged& ours, const Converged& theirs) {
  const double scale = rms(theirs.image);
  const double apart = rms_of_difference(ours.image, theirs.image) / scale;
  const double noise = std::hypot(ours.error, theirs.error) / scale;
  double worst = 0;
  for (std::size_t i = 0; i < ours.image.values().size(); ++i)
    worst = std::max(worst, std::abs(double(ours.image.values()[i]) - theirs.image.values()[i]));
  fmt::print(
      "converged pictures: apart by {:.2e} (rms), noise of both {:.2e}; worst value {:.2e}; means "
      "ours/Cycles {:.5f}: {}\n",
      apart, noise, worst / scale, mean(ours.image) / mean(theirs.image),
      apart < 2 * noise ? "the same within noise" : "THEY DIFFER");
}

void print_equal_error(const Measured& ours, const Measured& theirs) {
  fmt::print("{:>10} {:>12} {:>12} {:>8}\n", "to error", "ours s", "Cycles s", "ratio");
  for (const double wanted : {1e-1, 3e-2, 1e-2, 3e-3}) {
    const double a = ours.time_to(wanted), b = theirs.time_to(wanted);
    const auto mark = [&](const Measured& m) {
      return wanted >= m.error(0) ? '<' : wanted < m.error(kSamples.size() - 1) ? '~' : ' ';
    };
    fmt::print("{:>10.0e} {}{:>11.4f} {}{:>11.4f} {:>8.1f}\n", wanted, mark(ours), a, mark(theirs),
               b, b / a);
  }
  fmt::print("(<: one sample is better than that; ~: extrapolated)\n");
}

}  // namespace

Converged compare_with_cycles(const char* title, const Scene& scene,
                              const std::filesystem::path& directory,
                              const std::filesystem::path& blender,
                              const std::filesystem::path& lobelia) {
  const bool both = !blender.empty();
  Measured ours, theirs;
  ours.converge(render_timed(scene, kConverged, 101).result.image,
                render_timed(scene, kConverged, 102).result.image);
  // In turn, so that a change in the machine's speed meets both.
  for (int repeat = 1; repeat <= kRepeats; ++repeat) {
    measure_ours(scene, repeat, ours);
    if (both) measure_cycles(blender, scene, repeat, directory, theirs);
    if (!lobelia.empty())
      ours.process_seconds.push_back(process_seconds(scene, directory, lobelia));
  }

  fmt::print("\n{}: {} x {}, direct light, {} threads, median of {}\n", title, scene.film.width,
             scene.film.height, processors(), kRepeats);
  fmt::print("{:>10} {:>12} {:>12}", "samples", "ours s", "error");
  if (both) fmt::print(" {:>12} {:>12} {:>12}", "Cycles s", "error", "time ratio");
  fmt::print("\n");
  for (std::size_t i = 0; i < kSamples.size(); ++i) {
    fmt::print("{:>10} {:>12.4f} {:>12.2e}", kSamples[i], ours.time(i), ours.error(i));
    if (both)
      fmt::print(" {:>12.4f} {:>12.2e} {:>12.1f}", theirs.time(i), theirs.error(i),
                 theirs.time(i) / ours.time(i));
    fmt::print("\n");
  }
  fmt::print("slope of log error over log time: ours {:.2f}", ours.error_slope());
  if (both) fmt::print(", Cycles {:.2f}", theirs.error_slope());
  fmt::print("\n");
  if (both) {
    print_equal_error(ours, theirs);
    print_agreement(ours.converged, theirs.converged);
    if (!lobelia.empty())
      fmt::print("whole processes at {} samples: ours {:.3f} s, Blender {:.3f} s, ratio {:.1f}\n",
                 kProcessSamples, median(ours.process_seconds), median(theirs.process_seconds),
                 median(theirs.process_seconds) / median(ours.process_seconds));
  }
  const std::size_t pixels = scene.film.width * std::size_t(scene.film.height);
  print_engine("ours", ours, pixels);
  if (both) print_engine("Cycles", theirs, pixels);
  return std::move(ours.converged);
}

void measure_target_error(const char* title, const Scene& scene, const Converged& truth) {
  constexpr double kTarget = 1e-2;
  RenderOptions options;
  options.target_error = kTarget;
  std::vector<double> seconds, direct;
  double estimated = 0, squared = 0;
  int samples = 0;
  for (int repeat = 1; repeat <= kRepeats; ++repeat) {
    const Timed timed = render_timed(scene, 64, std::uint64_t(repeat), options);
    seconds.push_back(timed.seconds);
    estimated += timed.result.error.value_or(0) / kRepeats;
    squared += std::pow(rms_of_difference(timed.result.image, truth.image), 2) / kRepeats;
    samples = timed.result.samples;
    direct.push_back(render_timed(scene, samples, std::uint64_t(repeat)).seconds);
  }
  const double real =
      std::sqrt(std::max(0.0, squared - truth.error * truth.error)) / rms(truth.image);
  fmt::print("{:<24} {:>8} {:>12.2e} {:>12.2e} {:>12.2f} {:>10.4f} {:>10.4f}\n", title, samples,
             estimated, real, real / estimated, median(seconds), median(direct));
  fmt::print("  {}\n", median(seconds) < 1.15 * median(direct)
                           ? "limited by sampling, as the picture without a target is"
                           : "limited in part by the rounds: stopping and estimating after each");
}

}  // namespace lobelia::bench
