#include "studies/agreement/report.hpp"

namespace lobelia::agreement {
std::string report_text(const Agreement& agreement) {
  std::string text;
  for (const auto table : {lobe_table, model_table, effect_table, soft_table, refusal_table,
                           miss_table, headline_table}) {
    Table made = table(agreement);
    made.title += "\n";
    made.remarks.clear();
    if (!made.rows.empty()) text += table_text(made);
  }
  return text + "\n" + verdict_sentence(agreement) + "\n";
}

std::string report_csv(const Agreement& agreement) {
  Table lines;
  for (const char* column :
       {"group", "what", "model", "lobe", "normalisation", "exponent", "view", "width", "height",
        "witness", "max_of_peak", "rms_of_peak", "max_relative", "ring_pixels", "ring_over",
        "ring_max_of_peak", "target", "verdict", "why"})
    lines.columns.push_back({column});
  for (const Row& row : agreement.rows) {
    const Case& one = agreement.cases[row.index];
    const HighlightChoice& h = one.highlight;
    const Figures& f = row.figures;
    const auto target = target_of(row.variant, h.exponent);
    const bool none = row.verdict == Verdict::kNotComparable || row.verdict == Verdict::kFailed;
    const auto figure = [&](double value) { return none ? studies::Cell("") : value; };
    lines.rows.push_back({kGroupNames[std::size_t(one.group)], one.what, h.model, h.lobe,
                          h.normalisation, h.exponent, one.close_up ? "close-up" : "whole",
                          one.scene.film.width, one.scene.film.height, row.variant.name,
                          figure(f.max_of_peak), figure(f.rms_of_peak), figure(f.max_relative),
                          figure(f.ring_pixels), figure(f.ring_over), figure(f.ring_max_of_peak),
                          target ? target_text(*target) : "",
                          kVerdictNames[std::size_t(row.verdict)], row.why});
  }
  return table_csv(lines);
}

}  // namespace lobelia::agreement
