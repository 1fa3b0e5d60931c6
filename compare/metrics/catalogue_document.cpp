#include <fmt/format.h>

#include "compare/compare.hpp"
#include "compare/disagreement.hpp"
#include "compare/highlight_region.hpp"
#include "compare/metrics/catalogue.hpp"

namespace lobelia {
namespace {

// In the order of the enumerators.
constexpr std::string_view kBetter[] = {"lower", "nearer to 0", "higher", "(a fact)"};

std::string needs_text(Needs needs) {
  switch (needs) {
    case Needs::kOneWindow:
      return fmt::format("{} pixels a side", kSsimSide);
    case Needs::kFiveScales:
      return fmt::format("{} pixels a side", kMsSsimSide);
    default:
      constexpr std::string_view kOptions[] = {
          "", "`--tolerance`", "", "`--exposures`", "", "", "`--a-replicate` and others"};
      return std::string(kOptions[std::size_t(needs)]);
  }
}

}  // namespace

std::string metrics_document() {
  std::string text =
      "<!-- Written by `lobelia compare --list-metrics > docs/metrics.md`; do not edit. -->\n"
      "# Metrics\n"
      "\n"
      "What `lobelia compare A B` measures, B being the reference. The file of a metric in\n"
      "`compare/metrics/` is its contract: formula, constants, borders, and which tool it agrees with\n"
      "to how many digits.\n"
      "\n"
      "| id | family | better | regions | needs | what it is | source |\n"
      "|---|---|---|---|---|---|---|\n";
  for (const Metric* metric : metrics())
    for (const MetricOutput& output : metric->outputs)
      if (metric->region == Region::kWhole)
        text += fmt::format("| `{}` | {} | {} | {} | {} | {} | {} |\n", output.id,
                            family_name(metric->family), kBetter[std::size_t(output.better)],
                            metric->in_regions ? "yes" : "",
                            metric->on_request ? "a request" : needs_text(metric->needs),
                            output.meaning, metric->source);
  text += fmt::format(
      "\n"
      "**Better** is what a limit means: `--fail rmse=0.01` passes up to 0.01, `--fail drift=0.01`\n"
      "from -0.01 to 0.01, `--fail ssim=0.99` from 0.99 up. A value that was not measured, or is NaN,\n"
      "passes no limit. Equal pictures have 0, 1 where the best is 1 (SSIM), and an infinite `psnr`.\n"
      "\n"
      "**Families** look at different things. *Radiance* is scene-linear values, neither exposed nor\n"
      "clipped. *Colour* and *structure* are of the picture as shown: exposed by `--exposure`, clipped,\n"
      "sRGB's primaries; so is *visibility*, at `--pixels-per-degree`. HDR-FLIP has a range of exposures\n"
      "in place of the one, through a tone curve; the record names both. `--ocio`, `--display` and\n"
      "`--view` put a display of OpenColorIO's in place of the plain one, for all but HDR-FLIP.\n"
      "\n"
      "**Exposure**: with `--exposure auto`, the default, it is 0 for pictures whose brightest value a display\n"
      "can show. Otherwise there are two: at the first the brightest value of A and B is white, at the second,\n"
      "{1:g} stops more, the tail of the highlight can be seen. Of the two figures the worse is given; the record\n"
      "has both exposures.\n"
      "\n"
      "**Regions**: a highlight is a small part of a picture, and the black around it dilutes every mean and\n"
      "percentile. So metrics with *yes* are also measured\n"
      "\n"
      "- in the highlight, under ids with `.highlight` (`rmse.highlight`). A pixel is in it if one of its values is\n"
      "  at least {2:g} % of the brightest of its own picture, in A or in B. For FLIP and SSIM it is grown by the\n"
      "  reach of their filters;\n"
      "- with `--mask`, on the pixels inside it, under ids with `.mask`, and on all others, with `.outside`;\n"
      "- with `--scene`, likewise on the pixels whose centre sees a surface. The highlight then lies on a surface.\n"
      "  With both options, a pixel is inside the mask if it is inside by both.\n"
      "\n"
      "**Parts**: `--ignore` takes pixels out of all metrics. A gets B's values there before anything is\n"
      "measured, so a window of SSIM or FLIP that reaches into the part sees no difference in it. The pixels still\n"
      "count in means and shares. `--crop` cuts both pictures first; data outside of the display window are then\n"
      "left out. Masks, scenes and noise have the size and the coordinates of the whole pictures; places such as\n"
      "`max_abs.x` are of the part.\n"
      "\n"
      "**Default limits** judge the whole picture ({3}) and the highlight ({4}). Limits that are given add to\n"
      "them. A limit on a metric that has a default replaces it; `--no-default-limits` leaves all of them out.\n"
      "A limit that can hardly see the highlight draws a warning. `lobelia compare --sensitivity PICTURE` shows\n"
      "what the limits find: it compares changed copies of the picture with it.\n"
      "\n"
      "**On request** only, by a limit or by `--metrics`, are code values and pixels over a threshold. Code values are\n"
      "those of an 8-bit sRGB picture, as shown. The 0 in `share_over.abs=0` stands for any threshold:\n"
      "`--fail share_over.abs=0.004=10%` passes if at most a tenth of the pixels is off by more than 0.004. Only\n"
      "shares take a percentage. In a region the id is `share_over.abs=0.004.mask`.\n"
      "\n"
      "**Difference pictures** (`--diff-image`) show one value a pixel, by `--diff-of`. Of two folders they have one\n"
      "scale: `--diff-scale`, or the largest value of all pairs that have a picture. FLIP's is always 0 to 1.\n"
      "`--histogram` writes the weighted histogram of FLIP's errors.\n"
      "\n"
      "**Percentiles** are nearest ranks: the smallest value that so many per cent of the pixels do not\n"
      "exceed.\n"
      "\n"
      "**What is needed** and is not there leaves a metric out of the record. What was asked for and cannot\n"
      "be computed is left out with its reason (`notMeasured`): SSIM of a small picture, or HDR-FLIP where\n"
      "`--exposures auto` finds no range.\n"
      "\n"
      "**Metrics disagree** where, of two limits on metrics of different families, one passes and the other\n"
      "fails, and one of them by a wide margin. That is: what fails takes up more than {0:g} times its limit, or\n"
      "what passes less than 1/{0:g} of its own. A value takes up |value| / limit; of SSIM\n"
      "(1 - value) / (1 - limit); of decibels the ratio of the errors, 10^((limit - value) / 20). The record\n"
      "has a sentence for each such pair; the verdict is that of the limits all the same.\n"
      "\n"
      "## Pictures with noise\n"
      "\n"
      "Where a picture is a Monte-Carlo estimate, the comparison can be told its noise. Give pictures of standard\n"
      "errors (`--a-error`, `--b-error`), or independent pictures of the same (`--a-replicate`, `--b-replicate`).\n"
      "With one replicate each, A and B are half-sample pictures. `compare/uncertainty/noise.hpp` says what is\n"
      "assumed of them, and where that errs.\n"
      "\n"
      "**z** is a difference in units of its noise, as a number of a standard normal distribution that is\n"
      "as rare. Each value is tested, and each sum over squares of 2, 4, 8, ... pixels up to the whole picture.\n"
      "The sums find what no pixel shows, such as a small drift. Of m such tests each is\n"
      "held to 1 - (1 - `--significance`)^(1/m) (Sidak); `z.critical` is the z of that.\n"
      "\n"
      "**Error bars** are of the figure that endless samples would give\n"
      "(`compare/uncertainty/error_bars.hpp`). For each figure the record has\n"
      "\n"
      "- `standardError`, its spread under the noise;\n"
      "- `noiseFloor` and `noiseFloorMost`, what two pictures of one expectation would show with this noise, in the\n"
      "  mean and at the most (97.5 %);\n"
      "- the interval `low` to `high`: up to the figure and 97.5 % of its spread, down to the figure less the floor\n"
      "  at its most.\n"
      "\n"
      "**The verdict** is one of three. A limit *holds* if it does for the whole error bar, is *broken* if it\n"
      "is for the whole bar, and otherwise *open*. Pictures are **different** if a limit is broken and the\n"
      "**same** if all hold. Else they are **undecided**: neither a pass nor a difference. The exit code is 6\n"
      "then, and the table says how many times the samples would tell. What is asked:\n"
      "\n"
      "- with `--fail`, those limits;\n"
      "- with `--tolerance`, that no more pixels than it allows are beyond tolerance and noise together\n"
      "  (`z.beyond`), and no region is (`z.regions`). Alone it also asks that no more are open\n"
      "  (`z.open`): the same is said of pictures that surely lie within it. With `--fail` it is what\n"
      "  rounding may do, and the limits say how fine the answer has to be;\n"
      "- with neither, that nothing is beyond the noise: so what is too noisy to find anything in is undecided;\n"
      "- the default limits, unless they are left out. With `--fail` or `--tolerance`, one that noise leaves open\n"
      "  does not count.\n"
      "\n"
      "A limit on a z itself is passed by noise: it asks whether a difference was found.\n",
      kWideMargin, kTailStops, 100 * kHighlightShare, limits_text(default_limits(), "`"),
      limits_text(highlight_limits(), "`"));
  return text;
}

}  // namespace lobelia
