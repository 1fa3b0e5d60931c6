#include "studies/verdicts/verdicts.hpp"

#include <fmt/format.h>
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <boost/math/distributions/binomial.hpp>

#include "base/pictures/image_io.hpp"
#include "base/system/files.hpp"
#include "base/system/interrupt.hpp"
#include "compare/compare.hpp"

namespace lobelia::verdicts {
namespace {

struct Change {
  std::string name;
  double dimmer = 0;
  int columns = 0;  ///< moved to the right by so many
  double wider = 1;

  bool fits(Noise noise) const { return wider == 1 || noise != Noise::kCycles; }
};

const std::vector<Change>& changes() {
  static const std::vector<Change> list{{"", 0, 0},
                                        {"2 % dimmer", 0.02, 0},
                                        {"5 % dimmer", 0.05, 0},
                                        {"10 % dimmer", 0.1, 0},
                                        {"30 % dimmer", 0.3, 0},
                                        {"moved by a pixel", 0, 1},
                                        {"10 % wider", 0, 0, 1.1}};
  return list;
}

/// "dimmer-5", "same"
std::string folder_of(const Change& change) {
  if (change.columns > 0) return fmt::format("moved-{}", change.columns);
  if (change.wider > 1) return fmt::format("wider-{:.0f}", 100 * (change.wider - 1));
  return change.dimmer > 0 ? fmt::format("dimmer-{:g}", 100 * change.dimmer) : "same";
}

Image changed(const Image& image, const Change& change) {
  Image result(image.width(), image.height());
  const auto factor = float(1 - change.dimmer);
  for (int y = 0; y < image.height(); ++y)
    for (int x = 0; x < image.width(); ++x)
      for (std::size_t c = 0; c < 3; ++c)
        result.pixel(x, y)[c] = factor * image.pixel(std::max(0, x - change.columns), y)[c];
  return result;
}

std::vector<Cell> cells_of(const Options& options) {
  std::vector<Cell> cells;
  for (std::size_t i = 0; i < std::size(kNoiseNames); ++i) {
    const auto noise = Noise(i);
    if (!options.noises.empty() && std::ranges::count(options.noises, noise) == 0) continue;
    if (options.small && noise == Noise::kCycles) continue;
    const auto add = [&](int size, int samples, int replicates) {
      cells.push_back({noise, size, samples, replicates});
    };
    add(48, 16, 2);
    add(48, 64, 4);
    if (options.small) continue;
    add(48, 4, 2);
    add(48, 64, 2);
    add(48, 16, 9);
    add(24, 16, 2);
    add(96, 16, 2);
  }
  return cells;
}

class Measurement {
 public:
  Measurement(const Options& options, const OnProgress& on_progress)
      : options_(options), on_progress_(on_progress), cells_(cells_of(options)) {
    judged_ = usual_options();
    // Nothing but what the default limits are on.
    judged_.metrics = {"max_rel_peak"};
    NoiseOptions& noise = judged_.noise.emplace();
    noise.significance = options.significance;
    if (options.bootstraps > 0) noise.bootstraps = options.bootstraps;
  }

  records::VerifyVerdicts run() {
    records::VerifyVerdicts result;
    result.significance = options_.significance;
    result.seeds = options_.seeds;
    result.bootstraps = judged_.noise->bootstraps;
    if (std::ranges::count(cells_, Noise::kCycles, &Cell::noise) > 0) {
      cycles_ = std::make_unique<Cycles>(options_.programs);
      if (!cycles_->why_not().empty()) {
        result.left_out = cycles_->why_not();
        std::erase_if(cells_, [](const Cell& cell) { return cell.noise == Noise::kCycles; });
      }
    }
    for (std::size_t i = 0; i < cells_.size(); ++i) {
      result.cells.push_back(measure(cells_[i]));
      result.outside += !result.cells.back().holds;
    }
    return result;
  }

 private:
  records::VerdictCell measure(const Cell& cell) {
    records::VerdictCell result{std::string(kNoiseNames[std::size_t(cell.noise)]),
                                cell.size,
                                cell.samples,
                                cell.replicates,
                                {},
                                0,
                                false};
    std::vector<std::array<std::atomic<int>, 3>> counts(changes().size());
    const auto judge_one = [&](int seed) {
      throw_if_interrupted();
      judge_pair(cell, seed, counts);
      on_progress_(double(++done_) / (double(cells_.size()) * options_.seeds));
    };
    if (cell.noise == Noise::kCycles)
      for (int seed = 0; seed < options_.seeds; ++seed) judge_one(seed);
    else
      oneapi::tbb::parallel_for(0, options_.seeds, judge_one);
    for (std::size_t i = 0; i < changes().size(); ++i) {
      const int same = counts[i][0], undecided = counts[i][1], different = counts[i][2];
      result.changes.push_back({changes()[i].name, changes()[i].dimmer,
                                same + undecided + different, same, undecided, different});
    }
    constexpr double kOnceInAThousand = 1e-3;
    const boost::math::binomial allowed(options_.seeds,
                                        std::min(1.0, kMostOfPromise * options_.significance));
    result.most_false =
        int(boost::math::quantile(boost::math::complement(allowed, kOnceInAThousand)));
    result.holds = result.changes.front().different <= result.most_false;
    return result;
  }

  /// Adds to the numbers of same, undecided and different, by change.
  void judge_pair(const Cell& cell, int seed,
                  std::vector<std::array<std::atomic<int>, 3>>& counts) {
    const auto replicates = [&](bool of_b, double wider) {
      std::vector<Image> pictures;
      for (int r = 0; r < cell.replicates; ++r)
        pictures.push_back(
            picture_of(cell, next_seed(seed, cell.replicates, r, of_b), cycles_.get(), wider));
      return pictures;
    };
    const std::vector<Image> a = replicates(false, 1), b = replicates(true, 1);
    const NoisyPicture reference = mean_of_replicates(b, false);
    write(b, cell, "b", seed);
    for (std::size_t i = 0; i < changes().size(); ++i) {
      const Change& change = changes()[i];
      if (!change.fits(cell.noise) || (i > 0 && options_.changed > 0 && seed >= options_.changed))
        continue;
      std::vector<Image> pictures = change.wider > 1 ? replicates(false, change.wider) : a;
      for (Image& image : pictures) image = changed(image, change);
      NoisyPicture judged = mean_of_replicates(pictures, false);
      write(pictures, cell, folder_of(change) + "/a", seed);
      ComparisonOptions options = judged_;
      options.noise->a = std::move(judged.noise);
      options.noise->b = reference.noise;
      options.noise->seed = std::uint64_t(seed);
      const Verdict verdict = compare(judged.image, reference.image, options).verdict;
      ++counts[i][verdict == Verdict::kSame ? 0 : verdict == Verdict::kUndecided ? 1 : 2];
    }
  }

  void write(const std::vector<Image>& replicates, const Cell& cell, const std::string& side,
             int seed) const {
    if (options_.pictures.empty()) return;
    for (std::size_t r = 0; r < replicates.size(); ++r) {
      const auto folder = options_.pictures /
                          fmt::format("{}-{}-{}-{}", kNoiseNames[std::size_t(cell.noise)],
                                      cell.size, cell.samples, cell.replicates) /
                          fmt::format("{}{}", side, r + 1);
      make_directories(folder);
      write_exr(folder / fmt::format("{}.exr", seed), replicates[r], {});
    }
  }

  static std::uint64_t next_seed(int seed, int replicates, int replicate, bool of_b) {
    return 1 + 2 * (std::uint64_t(seed) * std::uint64_t(replicates) + std::uint64_t(replicate)) +
           of_b;
  }

  const Options& options_;
  const OnProgress& on_progress_;
  std::vector<Cell> cells_;
  ComparisonOptions judged_;
  std::unique_ptr<Cycles> cycles_;
  std::atomic<int> done_ = 0;
};

}  // namespace

records::VerifyVerdicts measure(const Options& options, const OnProgress& on_progress) {
  return Measurement(options, on_progress).run();
}

}  // namespace lobelia::verdicts
