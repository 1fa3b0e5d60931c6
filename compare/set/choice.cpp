// The table of the options of a comparison, and how they are read by name.
#include "compare/set/choice.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "base/pictures/colour.hpp"
#include "base/words/choice.hpp"
#include "compare/uncertainty/z_test.hpp"

namespace lobelia {
namespace {

using Choice = CompareChoice;
using For = CompareOption::For;

constexpr double kMostSamples = 1e12;

std::vector<CompareOption> options_of_sets() {
  return {
      {"pairs", &Choice::pairs, For::kSets, "Pairs", "FILE.csv",
       "In place of A and B: a table whose first line has the titles of the sets, the "
       "reference second, and perhaps 'name'; each further line is a pair of files"},
      {"pattern", &Choice::pattern, For::kSets, "Pairs", "PATTERN",
       "Pair by fields of the names within the folders, such as '{scene}_{light}.exr'; {} "
       "fits what differs"},
      {"sets", &Choice::sets, For::kSets, "Pairs", "FIELD=A,B[,..]",
       "The field of --pattern that tells the sets apart, and its values: with it one folder "
       "can hold all sets"},
      {"project", &Choice::project, For::kSets, "Options", "FILE",
       "Sets of pictures, limits by their names, masks, known differences: TOML, or JSON if it "
       "ends in .json (docs/comparing.md). The command line counts more. Default without A: "
       "lobelia.toml"},
      {"also-accept", &Choice::also_accept, For::kSets, "Options", "B2",
       "A further reference, in the form of B: each picture is judged by the one that it "
       "fits best; may be given again"},
      {"reference-floor", &Choice::reference_floor, For::kSets, "Options", "C",
       "A second reference: how far it is from B is shown beside how far A is"},
      {.name = "missing-reference",
       .place = &Choice::missing_reference,
       .applies_to = For::kSets,
       .heading = "Verdict",
       .value = "",
       .meaning = "What a picture without a reference is: named, or a failure as a reference "
                  "without a picture always is",
       .words = {"notice", "fail"},
       .usual = "notice"},
      {"layer", &Choice::layer, For::kFiles, "Layers", "NAME",
       "Compare this layer of both files: a prefix of channels, an EXR part, a view of a stereo "
       "EXR, or one channel; diffuse=ViewLayer.DiffDir where the files call it differently"},
      {.name = "all-layers",
       .place = &Choice::all_layers,
       .applies_to = For::kFiles,
       .heading = "Layers",
       .value = "",
       .meaning =
           "Compare every layer; the verdict is the worst, and a layer that only B has fails",
       .excludes = {"layer"}},
      {"layer-type", &Choice::layer_type, For::kFiles, "Layers", "NAME=TYPE",
       fmt::format("What a layer is, where its name does not say it: {}. Each type has metrics "
                   "and default limits of its own; without NAME, of the picture; may be given "
                   "again",
                   join(records::kLayerTypes))},
      {"ignore-alpha", &Choice::ignore_alpha, For::kFiles, "Layers", "",
       "Do not judge the alpha of the picture; otherwise an alpha that one side alone has "
       "fails, unless it is 1 everywhere"},
  };
}

std::vector<CompareOption> options_of_verdict() {
  constexpr For kAny = For::kPictures;
  constexpr std::string_view kShape = "FILE|rect:X,Y,W,H|polygon:X,Y X,Y ...";
  return {
      {"fail", &Choice::fail, kAny, "Verdict", "METRIC=LIMIT",
       "Verdict 'differs' if METRIC is over LIMIT (a likeness, such as psnr: below it); a limit on "
       "a share may be a percentage (share_over.abs=0.004=10%); may be given again"},
      {"metrics", &Choice::metrics, kAny, "Verdict", "LIST",
       "Measure only these, and what the limits are on: ids or their beginnings (rmse,flip.ldr), "
       "families (colour), with a region (rmse.mask), regions (highlight), default or all. "
       "Default limits are still judged, unless --no-default-limits leaves them out"},
      {"no-default-limits", &Choice::no_default_limits, kAny, "Verdict", "",
       "Judge by --fail and --tolerance alone; otherwise they add to the default limits, "
       "each of which --fail on the same metric replaces"},
      {"warn", &Choice::warn, kAny, "Verdict", "METRIC=LIMIT",
       "As --fail, but a line and no verdict; may be given again"},
      {"tolerance", &Choice::tolerance, kAny, "Verdict", "REL,PEAK,COUNT",
       "A pixel is an outlier if |A - B| > REL * |B| + PEAK * (brightest value of B) in "
       "any channel; verdict 'differs' if there are more than COUNT"},
      {"scene", &Choice::scene, kAny, "Verdict", "",
       "Measure errors on the pixels that see a surface of this scene as well (ids in "
       ".mask); with --tolerance, outliers may lie only on its silhouettes, terminators "
       "and shadow edges"},
      {"allow-equal-nonfinite", &Choice::allow_equal_nonfinite, kAny, "Verdict", "",
       "A NaN or an infinity that both pictures have in the same pixel and channel is no "
       "difference; always so for layers named Z, ZBack, depth, distance or position"},
      {"mask", &Choice::mask, kAny, "Parts of the pictures", kShape,
       "Measure on this part as well (ids in .mask) and on the rest (.outside): the pixels of a "
       "picture that are not 0, a rectangle, or a polygon, in quotes; may be given again, which "
       "adds to the part. With --scene, only what lies on a surface too is inside"},
      {"ignore", &Choice::ignore, kAny, "Parts of the pictures", kShape,
       "These pixels count as equal in every metric: A has the values of B there; may be given "
       "again"},
      {"crop", &Choice::crop, kAny, "Parts of the pictures", "X,Y,W,H",
       "Compare this part of both pictures alone. Masks and scenes are of the whole pictures"},
  };
}

std::vector<CompareOption> options_of_noise() {
  constexpr std::string_view kHeading = "Noise of Monte-Carlo pictures";
  std::vector<CompareOption> options;
  const auto add_picture = [&](std::string_view picture, std::string_view replicate,
                               std::vector<std::string> Choice::*replicates, std::string_view error,
                               std::string Choice::*errors, std::string_view variance,
                               std::string Choice::*variances) {
    options.push_back(
        {replicate, replicates, For::kPictures, kHeading, "FILE|DIR",
         fmt::format(
             "Another, independent picture of what {0} is, from as many samples: {0} is their "
             "mean, and its noise what they scatter; may be given again. With one, the two "
             "are half-sample pictures",
             picture)});
    options.push_back(
        {.name = error,
         .place = errors,
         .applies_to = For::kPictures,
         .heading = kHeading,
         .value = "FILE|DIR|*END",
         .meaning = fmt::format("Picture of the standard errors of {}, as render and reference "
                                "--standard-error write; '*_error.exr' is the file beside it with "
                                "that in place of its ending",
                                picture),
         .excludes = {replicate}});
    options.push_back({.name = variance,
                       .place = variances,
                       .applies_to = For::kPictures,
                       .heading = kHeading,
                       .value = "FILE|DIR|*END",
                       .meaning = fmt::format(
                           "Likewise of the variance of one sample of {0}, with --{1}-samples; "
                           "with 1 sample, that of {0} itself",
                           picture, variance.front()),
                       .excludes = {replicate, error}});
  };
  add_picture("A", "a-replicate", &Choice::a_replicate, "a-error", &Choice::a_error, "a-variance",
              &Choice::a_variance);
  add_picture("B", "b-replicate", &Choice::b_replicate, "b-error", &Choice::b_error, "b-variance",
              &Choice::b_variance);
  options.push_back({.name = "noise-from-layers",
                     .place = &Choice::noise_from_layers,
                     .applies_to = For::kFiles,
                     .heading = kHeading,
                     .value = "",
                     .meaning = "Whose own file has its noise as layers, of Mitsuba, pbrt, old "
                                "Cycles, or called StandardError (docs/pictures.md)",
                     .words = {"a", "b", "both"}});
  for (const auto& [name, place] :
       {std::pair("a-samples", &Choice::a_samples), {"b-samples", &Choice::b_samples}})
    options.push_back({name, place, For::kPictures, kHeading, "NUMBER",
                       "Samples per pixel, for those layers or the variance, if the file does not "
                       "say them",
                       1, kMostSamples});
  options.push_back({"freedom", &Choice::freedom, For::kPictures, kHeading, "NUMBER",
                     "Degrees of freedom of pictures of errors: independent estimates less one", 1,
                     1e9});
  options.push_back({.name = "shared-noise",
                     .place = &Choice::shared_noise,
                     .applies_to = For::kPictures,
                     .heading = kHeading,
                     .value = "",
                     .meaning = "Whose pixels err together, as they share their points or were "
                                "filtered: a, b, both or none; default: what has a picture of "
                                "errors",
                     .words = {"a", "b", "both", "none"}});
  options.push_back(
      {"significance", &Choice::significance, For::kPictures, kHeading, "",
       "Chance that pictures of one expectation are called different, by any of the limits",
       kLeastSignificance, kMostSignificance});
  options.push_back(
      {"bootstrap", &Choice::bootstrap, For::kPictures, kHeading, "",
       "Pairs with noise that error bars are made of; each figure is measured twice as often",
       kFewestBootstraps, kMostBootstraps});
  options.push_back(
      {"seed", &Choice::seed, For::kPictures, kHeading, "", " of that noise", 0, double(1 << 30)});
  return options;
}

std::vector<CompareOption> options_of_viewing() {
  constexpr For kAny = For::kPictures;
  constexpr std::string_view kHeading = "Viewing";
  std::vector<CompareOption> options{
      {.name = "exposure",
       .place = &Choice::exposure,
       .applies_to = kAny,
       .heading = kHeading,
       .value = "STOPS|auto",
       .meaning =
           "Exposure at which the perceptual metrics look at the pictures, HDR-FLIP excepted; with "
           "auto it is 0 for what a display can show, and otherwise two that show the peak of the "
           "highlight and its tail, of which the worse counts",
       .usual = "auto"},
      {"exposures", &Choice::exposures, kAny, kHeading, "START,STOP[,COUNT]|auto",
       "Measure HDR-FLIP over COUNT exposures from START to STOP, in stops; one for each stop if "
       "there is no COUNT. Auto in place of START, STOP or both: what the reference alone "
       "suggests"},
      {.name = "tone-curve",
       .place = &Choice::tone_curve,
       .applies_to = kAny,
       .heading = kHeading,
       .value = "",
       .meaning = "The curve that these exposures are shown through",
       .words = {std::begin(kToneCurveNames) + 1, std::end(kToneCurveNames)},
       .needs = {"exposures"}},
      {"pixels-per-degree", &Choice::pixels_per_degree, kAny, kHeading, "NUMBER",
       "How many pixels of the display a degree of the viewer's eye sees, for FLIP",
       kMinPixelsPerDegree, kMaxPixelsPerDegree}};
  const auto add_viewer = [&](std::string_view name, double Choice::*place, double most,
                              const char* meaning) {
    options.push_back({.name = name,
                       .place = place,
                       .applies_to = kAny,
                       .heading = kHeading,
                       .value = "NUMBER",
                       .meaning = meaning,
                       .least = 1e-3,
                       .most = most,
                       .excludes = {"pixels-per-degree"}});
  };
  add_viewer("display-distance", &Choice::display_distance, 1e3,
             "Metres from the viewer to the display: this and the next two in place of "
             "--pixels-per-degree");
  add_viewer("display-width", &Choice::display_width, 1e3, "Metres that the display is wide");
  add_viewer("display-pixels", &Choice::display_pixels, 1e6, "Pixels that the display is wide");
  options.push_back(
      {"ocio", &Choice::ocio, kAny, kHeading, "FILE",
       fmt::format("Show the perceptual metrics what this OpenColorIO configuration shows; {} "
                   "is Lobelia's own; default: $OCIO, or Lobelia's own",
                   kOwnConfig)});
  options.push_back(
      {"display", &Choice::display, kAny, kHeading, "NAME", "Its display; default: its first"});
  options.push_back({"view", &Choice::view, kAny, kHeading, "NAME",
                     "The view of that display; default: its first"});
  options.push_back({"input-space", &Choice::input_space, kAny, kHeading, "NAME",
                     "The colour space of A and B in it; default: its linear Rec. 709, or else its "
                     "role scene_linear"});
  options.push_back({"threads", &Choice::threads, kAny, "Output", "", "", 0, 1024});
  return options;
}

const CompareOption& option_named(const std::string& given) {
  std::string name = given;
  std::ranges::replace(name, '_', '-');
  const std::span<const CompareOption> all = compare_options();
  std::vector<std::string> shown;
  for (const CompareOption& option : all) {
    shown.emplace_back(option.name);
    std::ranges::replace(shown.back(), '-', '_');
  }
  const std::vector<std::string_view> names(shown.begin(), shown.end());
  return *chosen(given, "option", names, [&](const std::string&) {
    const auto found = std::ranges::find(all, name, &CompareOption::name);
    return found == all.end() ? std::nullopt : std::optional(&*found);
  });
}

[[noreturn]] void refuse_value(const CompareOption& option, const std::string& why) {
  throw Error(ExitCode::kUsage, "--{}: {}", option.name, why);
}

void check_value(const CompareOption& option, const std::string& text) {
  const bool is_number = std::holds_alternative<int CompareChoice::*>(option.place) ||
                         std::holds_alternative<std::uint64_t CompareChoice::*>(option.place) ||
                         std::holds_alternative<double CompareChoice::*>(option.place);
  if (is_number)
    if (const std::string why = number_problem(text, option.least, option.most); !why.empty())
      refuse_value(option, why);
  if (!option.words.empty() && std::ranges::count(option.words, text) == 0)
    refuse_value(option, fmt::format("'{}' is unknown; allowed: {}", printable(text),
                                     fmt::join(option.words, ", ")));
}

/// Sets the member to the texts.
struct Setter {
  const CompareOption& option;
  const std::vector<std::string>& texts;
  CompareChoice& choice;

  const std::string& one() const {
    if (texts.size() != 1)
      refuse_value(option, fmt::format("one value is expected, not {}", texts.size()));
    return texts.front();
  }
  void operator()(bool CompareChoice::*member) const {
    const std::string text = texts.empty() ? "true" : one();
    if (text != "true" && text != "false")
      refuse_value(option, fmt::format("'{}' is unknown; allowed: true, false", printable(text)));
    choice.*member = text == "true";
  }
  void operator()(double CompareChoice::*member) const { parse_number(one(), choice.*member); }
  template <class Integer>
  void operator()(Integer CompareChoice::*member) const {
    long long number = 0;
    if (!parse_integer(one(), number))
      refuse_value(option, fmt::format("'{}' is no whole number", printable(one())));
    choice.*member = Integer(number);
  }
  void operator()(std::string CompareChoice::*member) const { choice.*member = one(); }
  void operator()(std::vector<std::string> CompareChoice::*member) const { choice.*member = texts; }
};

}  // namespace

std::span<const CompareOption> compare_options() {
  static const std::vector<CompareOption> all = [] {
    std::vector<CompareOption> list = options_of_sets();
    for (const auto& more : {options_of_verdict(), options_of_noise(), options_of_viewing()})
      list.insert(list.end(), more.begin(), more.end());
    return list;
  }();
  return all;
}

CompareChoice read_choice(std::span<const GivenOption> options, For pictures) {
  CompareChoice choice;
  std::set<std::string_view> names;
  for (const auto& [name, texts] : options) {
    const CompareOption& option = option_named(name);
    if (option.applies_to > pictures)
      refuse_value(option, option.applies_to == For::kSets ? "is for sets of files"
                                                           : "is for pictures that are files");
    if (!texts) continue;
    for (const std::string& text : *texts) check_value(option, text);
    std::visit(Setter{option, *texts, choice}, option.place);
    const auto* flag = std::get_if<bool CompareChoice::*>(&option.place);
    if (!flag || choice.**flag) names.insert(option.name);
  }
  for (const std::string_view name : names) {
    const CompareOption& option = option_named(std::string(name));
    for (const std::string_view other : option.excludes)
      if (names.contains(other)) refuse_value(option, fmt::format("excludes --{}", other));
    for (const std::string_view other : option.needs)
      if (!names.contains(other)) refuse_value(option, fmt::format("requires --{}", other));
  }
  return choice;
}

}  // namespace lobelia
