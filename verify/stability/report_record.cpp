// The report as its record.
#include <string_view>

#include "renderer/kernels/kernels.hpp"
#include "verify/stability/meanings.hpp"
#include "verify/stability/report.hpp"

namespace lobelia::stability {
namespace {

records::StabilityErrors errors_record(const Answer& a) {
  return {a.of_peak, a.ulp, a.wrong_pixels};
}
records::StabilityAnswer answer_record(const Answer& a) {
  return {a.value, a.of_peak, a.ulp, a.wrong_pixels};
}

/// What summaries by lobe and by case have in common.
template <class T>
T summary_record(const Summary& s) {
  T record;
  record.group = s.group;
  record.cases = std::size_t(s.cases);
  record.outside = std::size_t(s.outside);
  record.not_compared = std::size_t(s.not_compared);
  record.naive = errors_record(s.naive);
  record.ours = errors_record(s.ours);
  record.of_bound = s.of_bound;
  return record;
}

std::vector<records::StabilityOfLobe> lobe_records(const std::vector<Summary>& all) {
  std::vector<records::StabilityOfLobe> list;
  for (const Summary& s : all) {
    list.push_back(summary_record<records::StabilityOfLobe>(s));
    list.back().lobe = s.name;
    if (s.exponent > 0) list.back().exponent = s.exponent;
  }
  return list;
}

std::vector<records::StabilityOfCase> case_records(const std::vector<Summary>& all) {
  std::vector<records::StabilityOfCase> list;
  for (const Summary& s : all) {
    list.push_back(summary_record<records::StabilityOfCase>(s));
    list.back().name = s.name;
    list.back().meaning = meaning_of_case(s.group, s.name);
  }
  return list;
}

std::vector<records::StabilityGroup> group_records(const std::vector<Summary>& by_case) {
  std::vector<records::StabilityGroup> groups;
  for (const Summary& s : by_case)
    if (groups.empty() || groups.back().name != s.group)
      groups.push_back({s.group, std::string(meaning_of_group(s.group))});
  return groups;
}

records::StabilityRow row_record(const Row& r) {
  records::StabilityRow record;
  record.group = r.group;
  record.name = r.name;
  record.model = r.model;
  record.lobe = r.lobe;
  record.exponent = r.exponent;
  record.truth = r.truth;
  record.naive = answer_record(r.naive);
  record.ours = answer_record(r.ours);
  record.bound = {r.bound_of_peak, r.bound_ulp};
  record.outcome = name(r.outcome);
  return record;
}

records::Nanoseconds time_record(const Timing& t) { return {t.median_ns, t.spread_ns}; }

records::StabilityPicture picture_record(const std::filesystem::path& directory,
                                         const PicturePair& p, const char* name, double error) {
  const std::string stem = (directory / picture_stem(p.exponent, name)).generic_string();
  return {stem + ".exr", stem + ".png", stem + "-error.png", error};
}

}  // namespace

records::VerifyStability report_record(const Report& report,
                                       const std::vector<std::string>& command,
                                       const std::filesystem::path& pictures, bool all) {
  const std::vector<Summary> cases = by_case(report.rows);
  records::VerifyStability record;
  record.command = command;
  record.instruction_set = kernels().instruction_set;
  record.cases = report.rows.size();
  record.outside = report.count(Outcome::kOutside);
  record.not_compared = report.count(Outcome::kNotCompared);
  record.groups = group_records(cases);
  record.by_lobe = lobe_records(by_lobe(report.rows));
  record.by_case = case_records(cases);
  record.by_exponent = lobe_records(by_exponent(report.rows));
  for (const ErrorCurve& c : report.curves)
    record.curves.push_back({c.exponent, std::string(c.model), std::string(c.lobe), c.degrees,
                             c.truth, c.naive, c.ours});
  for (const Row& row : report.rows)
    if (all || row.outcome == Outcome::kOutside) record.rows.push_back(row_record(row));
  for (const Stall& s : report.stalls)
    record.stalls.push_back({std::string(s.lobe), std::string(s.precision), time_record(s.ordinary),
                             time_record(s.underflow)});
  for (const Price& p : report.prices)
    record.price.push_back({std::string(p.lobe), std::string(p.model),
                            time_record(p.by_precision[0]), time_record(p.by_precision[1]),
                            time_record(p.by_precision[2])});
  for (const PicturePair& p : report.pictures)
    record.pictures.push_back({p.exponent, picture_record(pictures, p, "naive", p.naive_error),
                               picture_record(pictures, p, "ours", p.ours_error)});
  return record;
}

}  // namespace lobelia::stability
