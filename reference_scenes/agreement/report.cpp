#include "reference_scenes/agreement/report.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/text.hpp"

namespace lobelia::agreement {
namespace {

/// Columns as wide as their widest word but for the last.
std::string text_of(const Table& table) {
  std::vector<std::size_t> widths;
  const auto measure = [&](const std::vector<std::string>& words) {
    widths.resize(std::max(widths.size(), words.size()));
    for (std::size_t i = 0; i < words.size(); ++i) widths[i] = std::max(widths[i], words[i].size());
  };
  measure(table.head);
  for (const auto& row : table.rows) measure(row);
  std::string text = fmt::format("\n{}\n\n", table.title);
  const auto line = [&](const std::vector<std::string>& words) {
    std::string joined;
    for (std::size_t i = 0; i < words.size(); ++i)
      joined += fmt::format("{:<{}}  ", words[i], widths[i]);
    text += joined.substr(0, joined.find_last_not_of(' ') + 1) + "\n";
  };
  line(table.head);
  for (const auto& row : table.rows) line(row);
  return text;
}

}  // namespace

std::string report_text(const Agreement& agreement) {
  std::string text;
  for (const auto table : {lobe_table, model_table, effect_table, soft_table, refusal_table,
                           miss_table, headline_table}) {
    const Table made = table(agreement);
    if (!made.rows.empty()) text += text_of(made);
  }
  return text + "\n" + verdict_sentence(agreement) + "\n";
}

std::string report_csv(const Agreement& agreement) {
  std::string text =
      "group,what,model,lobe,normalisation,exponent,view,width,height,witness,max_of_peak,"
      "rms_of_peak,max_relative,ring_pixels,ring_over,ring_max_of_peak,target,verdict,why\n";
  for (const Row& row : agreement.rows) {
    const Case& one = agreement.cases[row.index];
    const HighlightChoice& h = one.highlight;
    const Figures& f = row.figures;
    const auto target = target_of(row.variant, h.exponent);
    const bool none = row.verdict == Verdict::kNotComparable || row.verdict == Verdict::kFailed;
    text += fmt::format(
        "{},{},{},{},{},{},{},{},{},{},{},{},{},{}\n", kGroupNames[std::size_t(one.group)],
        csv_field(one.what), h.model, h.lobe, h.normalisation, h.exponent,
        one.close_up ? "close-up" : "whole", one.scene.film.width, one.scene.film.height,
        row.variant.name,
        none ? ",,,,,"
             : fmt::format("{},{},{},{},{},{}", f.max_of_peak, f.rms_of_peak, f.max_relative,
                           f.ring_pixels, f.ring_over, f.ring_max_of_peak),
        target ? target_text(*target) : "", kVerdictNames[std::size_t(row.verdict)],
        csv_field(row.why));
  }
  return text;
}

}  // namespace lobelia::agreement
