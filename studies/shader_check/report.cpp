#include "studies/shader_check/check.hpp"

#include <fmt/format.h>

#include "base/words/numbers.hpp"
#include "studies/shader_check/explain.hpp"
#include "studies/table.hpp"

namespace lobelia::shader_check {
namespace {

studies::Table error_table(const records::ShaderCheck& record) {
  studies::Table table{"",
                       {{"n", 8},
                        {"error of peak", 15, "{:.1e}"},
                        {"allowed", 10, "{:.1e}"},
                        {"N.L", 9, "{:.4f}"},
                        {"N.V", 8, "{:.4f}"},
                        {"lobe's angle", 14, "{:.2f}"},
                        {"it gives", 12, "{:.6g}"},
                        {"model", 12, "{:.6g}"}},
                       {}};
  for (const records::ShaderError& error : record.errors)
    table.rows.push_back({fmt::format("{:g}", error.exponent), error.max_of_peak,
                          error.allowed_of_peak, error.place.n_dot_l, error.place.n_dot_v,
                          error.place.lobe_degrees, error.place.value, error.place.expected});
  return table;
}

std::string place_text(const std::optional<records::ShaderPlace>& place) {
  return place ? fmt::format(
                     " (first at n = {:g}, N.L = {:.4f}, N.V = {:.4f}: {:g}, where the "
                     "model is {:g})",
                     place->exponent, place->n_dot_l, place->n_dot_v, place->value, place->expected)
               : "";
}

std::string oddities_text(const records::ShaderOddities& odd) {
  std::string text;
  const auto add = [&](std::size_t count, const std::string& what) {
    if (count > 0) text += fmt::format("  {} of {} calls {}\n", count, odd.calls, what);
  };
  add(odd.nan, "are NaN" + place_text(odd.first_nonfinite));
  add(odd.infinite, "are infinite" + (odd.nan > 0 ? "" : place_text(odd.first_nonfinite)));
  add(odd.unwritten, "are discarded where the model is not 0");
  add(odd.outside_support, "are not 0 where the model is" + place_text(odd.first_outside));
  add(odd.negative, "are negative");
  add(odd.coloured, "are coloured; red was compared");
  if (odd.hard_nonfinite > 0)
    text += fmt::format("  {} of {} hard cases, such as L = -V, are no finite number\n",
                        odd.hard_nonfinite, odd.hard_calls);
  if (odd.below_nonfinite + odd.below_lit > 0)
    text += fmt::format(
        "  with the eye below the surface, which no model defines: {} of {} calls are not 0, {} are no "
        "finite number\n",
        odd.below_lit, odd.below_calls, odd.below_nonfinite);
  return text.empty() ? "" : "\nodd results\n" + text;
}

/// A row for each exponent, a pair of columns for each angle of the eye.
studies::Table energy_table(const std::vector<records::ShaderEnergy>& energy) {
  studies::Table table{"energy over the hemisphere, for an eye at these angles", {{"n", 8}}, {}};
  for (const records::ShaderEnergy& at : energy) {
    if (table.rows.size() <= 1 && (table.rows.empty() || at.exponent == energy[0].exponent)) {
      table.columns.push_back({fmt::format("{:g} degrees", at.incidence_degrees), 12, "{:.4f}"});
      table.columns.push_back({"model", 9, "{:.4f}"});
    }
    const std::string n = fmt::format("{:g}", at.exponent);
    if (table.rows.empty() || table.rows.back().front().text != n) table.rows.push_back({n});
    table.rows.back().insert(table.rows.back().end(), {at.energy, at.of_model});
  }
  return table;
}

std::string half_text(const std::vector<records::ShaderHalf>& half) {
  if (half.empty()) return "";
  std::string text = "\nwith all arithmetic in half floats it would change by, of its peak\n ";
  for (const records::ShaderHalf& at : half)
    text += fmt::format(" n = {:g}: {:.1e}{};", at.exponent, at.max_of_peak,
                        at.nonfinite > 0 ? fmt::format(" and {} no number", at.nonfinite) : "");
  text.back() = '\n';
  return text;
}

/// "by name: uShininess = n; set: SpecColor = 1,1,1"
std::string bindings_text(const std::vector<records::ShaderBinding>& bindings) {
  std::string text;
  for (const std::string_view by : records::kShaderBindings) {
    std::string part;
    for (const records::ShaderBinding& one : bindings)
      if (one.by == by)
        part += (part.empty() ? "" : ", ") +
                (by == "result" ? one.name : fmt::format("{} = {}", one.name, one.value));
    if (!part.empty())
      text += fmt::format("{}: {}\n",
                          by == "name" || by == "trial" ? fmt::format("by {}", by)
                          : by == "set"                 ? "--set"
                                                        : std::string(by),
                          part);
  }
  return text.empty() ? "" : text + "\n";
}

std::string cost_text(const std::vector<records::ShaderCost>& costs) {
  std::string text;
  for (const records::ShaderCost& cost : costs)
    if (cost.instructions)
      text += fmt::format("{}{} {}", text.empty() ? "" : ", ",
                          cost.name == "function" ? "it" : cost.name, *cost.instructions);
  return text.empty() ? "" : "\ninstructions of optimised SPIR-V: " + text + "\n";
}

}  // namespace

std::string report_text(const records::ShaderCheck& record) {
  std::string text =
      fmt::format("{}: {}({}) {} {}, lobe {}, normalisation {}\non {}, {}\n\n", record.file,
                  record.function, record.arguments,
                  !record.model_found          ? "against"
                  : record.verdict == "passes" ? "is"
                                               : "is nearest to",
                  record.model, record.lobe, record.normalisation, record.device, record.driver);
  text += bindings_text(record.bindings);
  const std::string model = record.model_found ? record.model : "the model";
  text += record.verdict == "passes"
              ? fmt::format("passes: it is {} within the rounding of float32\n", model)
          : record.model_found ? fmt::format("differs from {}: ", model)
                               : "differs: ";
  if (record.explanation) {
    text += record.explanation->sentence + "\n";
    if (!record.explanation->mistakes.empty()) {
      text += "mistakes:";
      for (const std::string& mistake : record.explanation->mistakes) text += " " + mistake;
      text += "\n";
    }
  }
  text += "\n" + studies::table_text(error_table(record));
  text += oddities_text(record.oddities) + studies::table_text(energy_table(record.energy)) +
          half_text(record.half_floats) + cost_text(record.costs);
  for (const std::string& remark : record.remarks) text += remark + "\n";
  return text;
}

}  // namespace lobelia::shader_check
