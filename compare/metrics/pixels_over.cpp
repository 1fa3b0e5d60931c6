// How many pixels differ by more than a threshold: the share of them, and their number.
//
// Source:       the failure rules of `idiff` (-fail, -failpercent), pixelmatch, odiff and reg-cli (threshold,
//               thresholdRate, thresholdPixel).
// Formula:      pixels of which the map of the same name (compare/maps/) is above the threshold, over all pixels. At a
//               threshold of 0 a pixel counts if it differs at all.
// Threshold:    in the id, in the map's unit: "share_over.abs=0.004". The catalogue lists 0, which stands for any
//               (find_metric()).
// Input:        that of the map.
// Agrees with:  `idiff -a` ("pixels over"), of opaque pictures; pixelmatch up to version 7 with includeAA, and odiff
//               without --antialiasing, of opaque pictures.
#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_reduce.h>

#include <array>

#include "base/system/scratch_memory.hpp"
#include "compare/maps/difference_map.hpp"
#include "compare/metrics/code_values.hpp"
#include "compare/metrics/flip_error.hpp"
#include "compare/metrics/shared_work.hpp"

namespace lobelia {
namespace {

using OverOutputs = std::array<MetricOutput, 2>;

constexpr OverOutputs over_outputs(std::string_view share_id, std::string_view pixels_id,
                                   std::string_view meaning) {
  return {{{share_id, "", Unit::kShare, Better::kLower, true, meaning, {}, 0, false, kUnitRange},
           {pixels_id, "", Unit::kCount, Better::kLower, true, "the number of these pixels"}}};
}

template <const char* kMap>
void measure_over(const MetricInput& input, std::span<double> values) {
  const auto map = shared(input, kMap, [&] { return find_difference_map(kMap)->measure(input); });
  struct Counts {
    std::int64_t over = 0, all = 0;
  };
  constexpr std::size_t kPart = std::size_t{1} << 14;
  const Counts counts = oneapi::tbb::parallel_reduce(
      oneapi::tbb::blocked_range<std::size_t>(0, map->size(), kPart), Counts(),
      [&](const auto& part, Counts sum) {
        for (std::size_t pixel = part.begin(); pixel < part.end(); ++pixel) {
          const bool inside = input.in_region(pixel);
          sum.all += inside;
          sum.over += inside && double((*map)[pixel]) > input.threshold;
        }
        looked_at(part.size() * sizeof(float));
        return sum;
      },
      [](const Counts& one, const Counts& other) {
        return Counts{one.over + other.over, one.all + other.all};
      });
  values[0] = double(counts.over) / double(std::max<std::int64_t>(counts.all, 1));
  values[1] = double(counts.over);
}

template <const char* kMap>
constexpr Metric over_metric(const OverOutputs& outputs, Family family, std::string_view source,
                             std::string_view work = kMap) {
  return {.outputs = outputs,
          .family = family,
          .needs = Needs::kNothing,
          .source = source,
          .measure = measure_over<kMap>,
          .work = work,
          .footprint = std::string_view(kMap).starts_with("flip") ? flip_radius : nullptr,
          .on_request = true};
}

constexpr char kAbs[] = "abs", kCode[] = "code", kYiq[] = "yiq", kCiede2000[] = "ciede2000",
               kItp[] = "delta_e_itp", kFlip[] = "flip.ldr";

constexpr OverOutputs kAbsOver = over_outputs(
                          "share_over.abs=0", "pixels_over.abs=0",
                          "share of pixels with an RGB value off by more, in radiance"),
                      kCodeOver =
                          over_outputs("share_over.code=0", "pixels_over.code=0",
                                       "share of pixels with an 8-bit code value off by more"),
                      kYiqOver = over_outputs("share_over.yiq=0", "pixels_over.yiq=0",
                                              "share of pixels farther apart in YIQ, of 0 to 1"),
                      kCiede2000Over =
                          over_outputs("share_over.ciede2000=0", "pixels_over.ciede2000=0",
                                       "share of pixels with a larger CIEDE2000"),
                      kItpOver =
                          over_outputs("share_over.delta_e_itp=0", "pixels_over.delta_e_itp=0",
                                       "share of pixels with a larger delta E ITP"),
                      kFlipOver = over_outputs("share_over.flip.ldr=0", "pixels_over.flip.ldr=0",
                                               "share of pixels with a larger LDR-FLIP");

}  // namespace

extern constinit const Metric abs_over_metric =
    over_metric<kAbs>(kAbsOver, Family::kRadiance, "idiff -fail, -failpercent");
extern constinit const Metric code_over_metric =
    over_metric<kCode>(kCodeOver, Family::kColour, "ours: 8-bit sRGB", kCodeWork);
extern constinit const Metric yiq_over_metric = over_metric<kYiq>(
    kYiqOver, Family::kColour, "Kotsarenko, Ramos 2010; pixelmatch, odiff", kCodeWork);
extern constinit const Metric ciede2000_over_metric =
    over_metric<kCiede2000>(kCiede2000Over, Family::kColour, "Sharma, Wu, Dalal 2005");
extern constinit const Metric delta_e_itp_over_metric =
    over_metric<kItp>(kItpOver, Family::kColour, "ITU-R BT.2124-0");
extern constinit const Metric flip_ldr_over_metric =
    over_metric<kFlip>(kFlipOver, Family::kVisibility, "Andersson et al. 2020; FLIP 1.6");

}  // namespace lobelia
