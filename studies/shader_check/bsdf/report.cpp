#include <fmt/format.h>

#include "studies/shader_check/bsdf/check.hpp"
#include "studies/table.hpp"

namespace lobelia::shader_check::bsdf {
namespace {

studies::Table settings_table(const records::BsdfCheck& record) {
  studies::Table table{"",
                       {{"n", 6},
                        {"eye", 5},
                        {"pdf above", 11, "{:.5f}"},
                        {"below", 9, "{:.5f}"},
                        {"lost %", 8, "{:.3f}"},
                        {"chi square", 12, "{:.1f}"},
                        {"freedom", 9},
                        {"chance", 10, "{:.2g}"},
                        {"albedo", 9, "{:.5f}"},
                        {"of samples", 12, "{:.5f}"}},
                       {}};
  for (const records::BsdfSetting& s : record.settings)
    table.rows.push_back({fmt::format("{:g}", s.exponent), fmt::format("{:g}", s.eye_degrees),
                          s.pdf_above, s.pdf_below,
                          100 * double(s.samples_below + s.samples_rejected) / double(s.samples),
                          s.chi_square, s.freedom, s.chance, s.albedo, s.albedo_of_samples});
  return table;
}

}  // namespace

std::string bsdf_report(const records::BsdfCheck& record) {
  std::string text =
      fmt::format("{}: eval {}, sample {}, pdf {}\non {}, {}\n\n", record.file, record.eval,
                  record.sample, record.pdf, record.device, record.driver);
  text += record.verdict == records::kBsdfVerdicts[0]
              ? "passes: sample follows pdf, and eval agrees with both\n"
              : "fails\n";
  for (const records::BsdfFailure& failure : record.failures)
    text +=
        fmt::format("  {}: {}{}\n", failure.check, failure.sentence,
                    failure.settings > 1 ? fmt::format(", and {} more", failure.settings - 1) : "");
  for (const records::BsdfExplanation& one : record.explanations)
    text += fmt::format("explained by {}: {}\n", one.mistake, one.sentence);
  text += "\n" + studies::table_text(settings_table(record));
  for (const std::string& remark : record.remarks) text += remark + "\n";
  return text + fmt::format("{} random tests: a right BSDF fails one of them in {:g} of all runs\n",
                            record.random_tests, record.false_alarms);
}

}  // namespace lobelia::shader_check::bsdf
