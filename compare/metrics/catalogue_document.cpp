#include <fmt/format.h>

#include <cmath>

#include "compare/compare.hpp"
#include "compare/disagreement.hpp"
#include "compare/highlight_region.hpp"
#include "compare/highlights/find.hpp"
#include "compare/metrics/catalogue.hpp"

namespace lobelia {
namespace {

// In the order of the enumerators.
constexpr std::string_view kBetter[] = {"lower", "nearer to 0", "higher", "(a fact)"};

std::string range_text(const MetricOutput& output) {
  const auto& [least, most] = output.range;
  if (output.better == Better::kNeither) return "";
  if (!std::isfinite(least)) return "any";
  return std::isfinite(most) ? fmt::format("{} to {}", least, most)
                             : fmt::format("{} and more", least);
}

std::string needs_text(const Metric& metric) {
  if (metric.layer && metric.needs == Needs::kNothing)
    return fmt::format("a layer of type {}", layer_type_name(*metric.layer));
  switch (metric.needs) {
    case Needs::kOneWindow:
      return fmt::format("{} pixels a side", kSsimSide);
    case Needs::kFiveScales:
      return fmt::format("{} pixels a side", kMsSsimSide);
    default:
      constexpr std::string_view kOptions[] = {"",
                                               "`--tolerance`",
                                               "",
                                               "",
                                               "`--exposures`",
                                               "",
                                               "",
                                               "`--a-replicate` and others",
                                               "a Cryptomatte"};
      return std::string(kOptions[std::size_t(metric.needs)]);
  }
}

}  // namespace

std::string metrics_document() {
  std::string text =
      "<!-- Written by `lobelia compare --list-metrics > docs/metrics.md`; do not edit. -->\n"
      "# Metrics\n"
      "\n"
      "For anyone who sets limits or reads a comparison: what each metric of `lobelia compare A B` measures.\n"
      "B is the reference. Each metric's file in `compare/metrics/` has its formula, constants and borders, and\n"
      "the tool that it agrees with.\n"
      "\n"
      "| id | family | better | range | regions | needs | what it is | source |\n"
      "|---|---|---|---|---|---|---|---|\n";
  for (const Metric* metric : metrics())
    for (const MetricOutput& output : metric->outputs)
      if (metric->region == Region::kWhole)
        text += fmt::format("| `{}` | {} | {} | {} | {} | {} | {} | {} |\n", output.id,
                            family_name(metric->family), kBetter[std::size_t(output.better)],
                            range_text(output), metric->in_regions ? "yes" : "",
                            metric->on_request ? "a request" : needs_text(*metric), output.meaning,
                            metric->source);
  text += fmt::format(
      "\n"
      "**Better** says what a limit means: `--fail rmse=0.01` passes up to 0.01, `--fail drift=0.01` from -0.01\n"
      "to 0.01, `--fail ssim=0.99` from 0.99 up. A limit beyond the range is an error. A value that was not\n"
      "measured, or is NaN, passes no limit. Equal pictures have 0, or 1 for SSIM, or an infinite `psnr`, also\n"
      "where a metric could not be measured of them.\n"
      "\n"
      "**Layers.** `depth`, `vector`, `identifier` and `coverage` are measured of layers of that type, and no others\n"
      "([types of layers](pictures.md#types-of-layers)).\n"
      "\n"
      "**Families.** *Radiance* metrics use scene-linear values, neither exposed nor clipped. *Colour* and\n"
      "*structure* use the picture as shown: exposed, clipped, sRGB's primaries. *Visibility* also uses\n"
      "`--pixels-per-degree`. HDR-FLIP uses a range of exposures and a tone curve. `--ocio`, `--display` and\n"
      "`--view` replace the display, except for HDR-FLIP.\n"
      "\n"
      "**Exposure.** With `--exposure auto`, the default, it is 0 if a display can show the brightest value.\n"
      "Otherwise there are two: at one the brightest value of A and B is white; the other, {1:g} stops more,\n"
      "shows the tail of the highlight. A highlight of B that is dark at both adds one that shows its peak. The\n"
      "worst figure counts; the record has all exposures.\n"
      "\n"
      "**Regions.** The black around a highlight dilutes every mean and percentile. So metrics with *yes* are\n"
      "also measured\n"
      "\n"
      "- in the highlight (`rmse.highlight`): pixels with a value of at least {2:g} % of the brightest of their\n"
      "  own picture, in A or in B. For FLIP and SSIM this is grown by the reach of their filters;\n"
      "- with `--mask`, inside (`.mask`) and outside (`.outside`);\n"
      "- with `--scene`, likewise on the pixels whose centre sees a surface. With both options a pixel must be\n"
      "  inside by both.\n"
      "\n"
      "**Highlights.** `energy`, `brightness`, `width` and `shift` of the highlight first take {2:g} % of the\n"
      "peak off. A pixel counts by how far the mean of its R, G and B exceeds that. What is less bright does\n"
      "not count. The peak is the largest mean that the median of the 3 x 3 pixels around reaches as well, so\n"
      "a firefly is none. They leave out the tail; `lobelia profile` measures the whole highlight.\n"
      "\n"
      "**Each highlight by itself.** `highlights.energy`, `.width` and `.shift` are the worst of all highlights of B,\n"
      "each judged against its own peak: beside a light in view, the others are dim. A highlight is a maximum of at\n"
      "least {5} pixels that stands out from its surroundings by a quarter of its peak; the {6} with the most light are\n"
      "judged. What noise, rounding and the texture around it may do is taken off. `highlights.x` and `.y` are the\n"
      "place of the worst, and the record lists up to 32. `compare/highlights/` has the formulas.\n"
      "\n"
      "**Parts.** `--ignore` gives A the values of B before anything is measured; the pixels still count in means\n"
      "and shares. `--crop` cuts both pictures first. Masks, scenes and noise have the coordinates of the whole\n"
      "pictures; places such as `max_abs.x` are of the part.\n"
      "\n"
      "**Default limits** judge the whole picture ({3}) and the highlight ({4}). Your limits add to them; one on\n"
      "the same metric replaces a default; `--no-default-limits` leaves all out. A limit that can hardly see the\n"
      "highlight draws a warning. `lobelia compare --sensitivity PICTURE` shows what limits find.\n"
      "\n"
      "**On request** (by a limit or `--metrics`): code values of an 8-bit sRGB picture, and pixels over a\n"
      "threshold. The 0 in `share_over.abs=0` stands for any threshold: `--fail share_over.abs=0.004=10%` passes\n"
      "if at most a tenth of the pixels is off by more than 0.004. Only shares take a percentage. In a region:\n"
      "`share_over.abs=0.004.mask`.\n"
      "\n"
      "**Difference pictures** (`--diff-image`) show one value a pixel, by `--diff-of`. Folders have one scale:\n"
      "`--diff-scale`, or the largest value of all pairs. FLIP's is always 0 to 1.\n"
      "\n"
      "**Percentiles** are nearest ranks: the smallest value that so many per cent of the pixels do not exceed.\n"
      "\n"
      "**Not measured.** A metric that needs an option is left out without it. One that was asked for and cannot\n"
      "be computed is in `notMeasured` with the reason, such as SSIM of a small picture.\n"
      "\n"
      "**Metrics disagree** if two limits on different families decide differently, one of them by a wide margin:\n"
      "a failing value uses more than {0:g} times its limit, or a passing one less than 1/{0:g}. For SSIM the use\n"
      "is (1 - value) / (1 - limit), for decibels 10^((limit - value) / 20). The record has a sentence; the\n"
      "verdict does not change.\n"
      "\n"
      "## Pictures with noise\n"
      "\n"
      "Tell the comparison the noise of a Monte-Carlo picture: by independent pictures of the same\n"
      "(`--a-replicate`, `--b-replicate`), by pictures of variances (`--a-variance`, `--b-variance`) or of standard\n"
      "errors (`--a-error`, `--b-error`). `profile/noise.hpp` has the assumptions.\n"
      "\n"
      "**z** is a difference in units of its noise, as a standard normal number that is as rare. Every value is\n"
      "tested, and sums over squares of 2, 4, 8, ... pixels, which find small drifts. Four sums over the picture\n"
      "are weighted by what a brighter, a moved or a wider picture would change (`compare/uncertainty/patterns.hpp`).\n"
      "Each size and each of these patterns has an equal share of the significance, and its m tests share that: by\n"
      "1 - (1 - s)^(1/m) (Sidak). `z.critical` is the z of a single value. A sum's z is that of a single value as rare\n"
      "among those.\n"
      "\n"
      "**Error bars** are about the figure that endless samples would give. For each figure the record has\n"
      "\n"
      "- `standardError`: its spread under the noise;\n"
      "- `noiseFloor`, `noiseFloorMost`: what two pictures with the same expectation show, in the mean and at the\n"
      "  most (97.5 %). A limit is broken only beyond that and another twentieth of the floor, as draws know it no\n"
      "  better;\n"
      "- `low` to `high`: up to the figure and 97.5 % of its spread, down to the figure less the floor at its\n"
      "  most. A signed figure has the mean that noise alone gives it taken off.\n"
      "\n"
      "Noise with **heavy tails** is named: `fireflies` is the share of pixels that err more than six times as much\n"
      "as all around them, and from 0.1 % on the report says so. Draws of noise come from the replicates, so they\n"
      "have the same tails. With heavy ones, errors that cannot be negative break no limit. The largest of single\n"
      "differences is judged by each value's own error.\n"
      "\n"
      "**The verdict.** A limit *holds* or is *broken* if that is so for its whole error bar; otherwise it is\n"
      "*open*. `--significance` is the chance that pictures of one expectation are called different. All limits\n"
      "share it (Bonferroni). Those on z have half of it as one. Of k others, the lower end of each bar is passed by\n"
      "chance in the other half divided by k ([verdicts](verdicts.md) measures it). The upper end is that of 97.5 %. Pictures are **different** if a limit is broken, the **same** if all hold, else **undecided**:\n"
      "exit code 6, with the estimated factor of extra samples needed. The limits are\n"
      "\n"
      "- with `--fail`, those;\n"
      "- with `--tolerance`, that no more pixels than it allows (`z.beyond`) and no region (`z.regions`) are\n"
      "  beyond tolerance and noise together. Alone it also asks that no more are open (`z.open`);\n"
      "- with neither, that nothing is beyond the noise. Pictures too noisy to find anything in are undecided;\n"
      "- the default limits. With `--fail` or `--tolerance`, one that noise leaves open does not count.\n"
      "\n"
      "Noise passes a limit on a z itself, because it asks whether a difference was found.\n",
      kWideMargin, kTailStops, 100 * kHighlightShare, limits_text(default_limits(), "`"),
      limits_text(highlight_limits(), "`"), kFewestPixelsOfOne, kMostHighlights);
  return text;
}

}  // namespace lobelia
