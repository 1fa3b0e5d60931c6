#include <fmt/format.h>

#include "compare/disagreement.hpp"
#include "compare/metrics/catalogue.hpp"

namespace lobelia {
namespace {

std::string_view better_text(Better better) {
  switch (better) {
    case Better::kLower:
      return "lower";
    case Better::kNearZero:
      return "nearer to 0";
    case Better::kHigher:
      return "higher";
    case Better::kNeither:
      return "(a fact)";
  }
  return "";
}

std::string_view family_text(Family family) {
  switch (family) {
    case Family::kRadiance:
      return "radiance";
    case Family::kColour:
      return "colour";
    case Family::kStructure:
      return "structure";
    case Family::kVisibility:
      return "visibility";
  }
  return "";
}

std::string needs_text(Needs needs) {
  switch (needs) {
    case Needs::kNothing:
      return "";
    case Needs::kTolerance:
      return "`--tolerance`";
    case Needs::kMask:
      return "`--scene`";
    case Needs::kHdrExposures:
      return "`--exposures`";
    case Needs::kOneWindow:
      return fmt::format("{} pixels a side", kSsimSide);
    case Needs::kFiveScales:
      return fmt::format("{} pixels a side", kMsSsimSide);
  }
  return "";
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
      "| id | family | better | needs | what it is | source |\n"
      "|---|---|---|---|---|---|\n";
  for (const Metric* metric : metrics())
    for (const MetricOutput& output : metric->outputs)
      text += fmt::format("| `{}` | {} | {} | {} | {} | {} |\n", output.id,
                          family_text(metric->family), better_text(output.better),
                          needs_text(metric->needs), output.meaning, metric->source);
  text += fmt::format(
      "\n"
      "**Better** is what a limit means: `--fail rmse=0.01` passes up to 0.01, `--fail drift=0.01`\n"
      "from -0.01 to 0.01, `--fail ssim=0.99` from 0.99 up. A value that was not measured, or is NaN,\n"
      "passes no limit. Equal pictures have 0, 1 where the best is 1 (SSIM), and an infinite `psnr`.\n"
      "\n"
      "**Families** look at different things. *Radiance* is scene-linear values, neither exposed nor\n"
      "clipped. *Colour* and *structure* are of the picture as shown: exposed by `--exposure`, clipped,\n"
      "sRGB's primaries; so is *visibility*, at `--pixels-per-degree`. HDR-FLIP has a range of exposures\n"
      "in place of the one, through the ACES curve; the record names it. `--ocio`, `--display` and\n"
      "`--view` put a display of OpenColorIO's in place of the plain one, for all but HDR-FLIP.\n"
      "\n"
      "**Percentiles** are nearest ranks: the smallest value that so many per cent of the pixels do not\n"
      "exceed.\n"
      "\n"
      "**What is needed** and is not there leaves a metric out of the record. Errors in `.mask` are of the\n"
      "pixels whose centre sees a surface of the scene, the others of all pixels.\n"
      "\n"
      "**Metrics disagree** where, of two limits on metrics of different families, one passes and the\n"
      "other fails, and one of them by a wide margin: what fails takes up more than {0:g} times its limit,\n"
      "or what passes less than 1/{0:g} of its own. A value takes up |value| / limit; of SSIM\n"
      "(1 - value) / (1 - limit); of decibels the ratio of the errors, 10^((limit - value) / 20). The record\n"
      "has a sentence for each such pair; the verdict is that of the limits all the same.\n",
      kWideMargin);
  return text;
}

}  // namespace lobelia
