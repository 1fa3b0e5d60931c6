// An accuracy as text and as a record.
#include <fmt/format.h>

#include <algorithm>

#include "base/system/error.hpp"
#include "base/words/error_time_chart.hpp"
#include "base/words/text.hpp"
#include "studies/accuracy/accuracy.hpp"

namespace lobelia::accuracy {
namespace {

/// The command that writes the lobe's code; empty where there is none.
std::string code_text(const Choice& choice) {
  const auto with = std::ranges::find_if(choice.scene.materials, has_highlight);
  if (!choice.lobe || choice.lobe->formula || with == choice.scene.materials.end()) return "";
  return fmt::format("  Its code: lobelia export --language glsl {} --lobe {} --exponent {}\n",
                     info(with->highlight.model).name, info(*choice.lobe).name,
                     with->highlight.exponent);
}

}  // namespace

Accuracy parse_accuracy(const std::string& text) {
  constexpr std::string_view kCiede = "de2000=";
  Accuracy accuracy;
  std::string_view number = text;
  double least = kMinAccuracyOfPeak, most = kMaxAccuracyOfPeak;
  if (number.starts_with(kCiede)) {
    accuracy.unit = Accuracy::Unit::kCiede2000;
    number.remove_prefix(kCiede.size());
    least = kMinAccuracyCiede2000, most = kMaxAccuracyCiede2000;
  }
  if (!parse_number(number, accuracy.value) || !(accuracy.value >= least) ||
      !(accuracy.value <= most))
    throw Error(ExitCode::kUsage,
                "--accuracy '{}': allowed is a share of the peak, {:g} to {:g}, or "
                "de2000=X, X being {:g} to {:g}",
                printable(text), kMinAccuracyOfPeak, kMaxAccuracyOfPeak, kMinAccuracyCiede2000,
                kMaxAccuracyCiede2000);
  return accuracy;
}

std::string accuracy_text(const Accuracy& asked) {
  return asked.unit == Accuracy::Unit::kCiede2000 ? fmt::format("de2000={:g}", asked.value)
                                                  : fmt::format("{:g}", asked.value);
}

std::string measure_text(Measure measure) {
  constexpr const char* kTexts[] = {"largest error, of the peak",
                                    "root mean square of the errors, of the peak",
                                    "CIEDE2000 that 99 % of the pixels do not exceed"};
  return kTexts[std::size_t(measure)];
}

records::Accuracy accuracy_record(const Choice& choice, const std::optional<Reached>& reached) {
  records::Accuracy record;
  record.asked = choice.asked.value;
  record.unit = choice.asked.unit == Accuracy::Unit::kCiede2000 ? "de2000" : "ofPeak";
  record.measure = measure_text(choice.measure);
  if (choice.lobe) record.chose.lobe = info(*choice.lobe).name;
  record.chose.precision = name(choice.precision);
  record.chose.samples = choice.samples.value_or(1);
  record.why = choice.why;
  record.operations = {choice.cost, choice.own_cost};
  record.basis = choice.basis == Basis::kBound ? "bound" : "trial";
  record.predicted = choice.predicted;
  if (reached)
    record.reached = records::AccuracyReached{reached->value, reached->held(choice),
                                              reached->against, reached->seconds};
  return record;
}

std::string choice_text(const Choice& choice, const records::Accuracy& record) {
  const auto& seconds = record.value_seconds;
  return fmt::format(
      "accuracy {}: use {} in {}{}; {} predicted to be at most {:.2g}.\n"
      "  Price {:g}{}, where the scene's own lobe in float64 has {:g}{}.\n  {}.\n{}",
      accuracy_text(choice.asked),
      choice.lobe ? info(*choice.lobe).name : "each highlight's own lobe", name(choice.precision),
      choice.samples ? fmt::format(" with {} samples a pixel", *choice.samples) : std::string(),
      measure_text(choice.measure), choice.predicted, choice.cost,
      seconds ? fmt::format(", {} a value", short_time_text(seconds->chosen)) : std::string(),
      choice.own_cost,
      seconds ? fmt::format(", {}", short_time_text(seconds->own_in_float64)) : std::string(),
      choice.why, code_text(choice));
}

std::string reached_text(const Choice& choice, const Reached& reached) {
  if (reached.black)
    return fmt::format(
        "the picture is black, and so is its truth: there was nothing to measure ({:.2f} s)\n",
        reached.seconds);
  return fmt::format("reached {:.3g}, {} asked, {}; against {} ({:.2f} s)\n", reached.value,
                     accuracy_text(choice.asked),
                     reached.held(choice) ? "so it holds" : "so it does NOT hold", reached.against,
                     reached.seconds);
}

}  // namespace lobelia::accuracy
