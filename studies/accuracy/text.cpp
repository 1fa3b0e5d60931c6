// An accuracy as text and as a record.
#include <fmt/format.h>

#include "base/system/error.hpp"
#include "base/words/text.hpp"
#include "studies/accuracy/accuracy.hpp"

namespace lobelia::accuracy {

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
  record.basis = choice.basis == Basis::kBound ? "bound" : "look";
  record.predicted = choice.predicted;
  if (reached)
    record.reached = records::AccuracyReached{reached->value, reached->held(choice),
                                              reached->against, reached->seconds};
  return record;
}

std::string choice_text(const Choice& choice) {
  return fmt::format(
      "accuracy {}: {}, {}{}; {} predicted to be at most {:.2g}. {:g} operations a point, weighted, where the "
      "scene's own lobe in float64 takes {:g}.\n  {}.\n",
      accuracy_text(choice.asked),
      choice.lobe ? info(*choice.lobe).name : "each highlight's own lobe", name(choice.precision),
      choice.samples ? fmt::format(", {} samples a pixel", *choice.samples) : std::string(),
      measure_text(choice.measure), choice.predicted, choice.cost, choice.own_cost, choice.why);
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
