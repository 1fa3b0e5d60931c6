// A set of comparisons as JUnit's XML, which continuous integration shows as tests. JUnit has no standard; this
// subset is read by both Jenkins and GitLab (testsuites, testsuite, testcase, failure, error, skipped; properties for
// the figures).
#include <fmt/format.h>

#include <pugixml.hpp>
#include <sstream>

#include "compare/set/report.hpp"
#include "core/text.hpp"

namespace lobelia {
namespace {

pugi::xml_node add_case(pugi::xml_node suite, const std::string& name, double seconds) {
  pugi::xml_node one = suite.append_child("testcase");
  one.append_attribute("classname") = "lobelia.compare";
  one.append_attribute("name") = printable_path(name).c_str();
  one.append_attribute("time") = fmt::format("{:.6f}", seconds).c_str();
  return one;
}

void add_outcome(pugi::xml_node one, const char* kind, std::string_view type,
                 const std::string& message) {
  pugi::xml_node outcome = one.append_child(kind);
  outcome.append_attribute("type") = std::string(type).c_str();
  outcome.append_attribute("message") = printable_path(message).c_str();
}

void add_pair(pugi::xml_node suite, const PairReport& pair, bool skip_undecided) {
  pugi::xml_node one = add_case(suite, pair.name, pair.seconds);
  if (!pair.comparison) {
    add_outcome(one, "error", "not compared", pair.error);
    return;
  }
  pugi::xml_node properties = one.append_child("properties");
  for (const auto& [id, value] : pair.comparison->metrics) {
    pugi::xml_node property = properties.append_child("property");
    property.append_attribute("name") = id.c_str();
    property.append_attribute("value") = fmt::format("{}", value).c_str();
  }
  if (is_pass(pair.verdict())) return;
  const bool skipped =
      pair.is_excused() || (skip_undecided && pair.verdict() == Verdict::kUndecided);
  const std::string known = known_text(pair);
  add_outcome(one, skipped ? "skipped" : "failure", verdict_name(pair.verdict()),
              known.empty() ? why_not_pass(pair) : known + "; " + why_not_pass(pair));
}

}  // namespace

std::string set_junit(const SetReport& report, bool skip_undecided) {
  const records::SetSummary counts = count(report);
  double seconds = 0;
  for (const PairReport& pair : report.pairs) seconds += pair.seconds;
  pugi::xml_document document;
  pugi::xml_node suites = document.append_child("testsuites");
  pugi::xml_node suite = suites.append_child("testsuite");
  const std::size_t not_looked_at =
      counts.missing + counts.links_not_followed + counts.misnamed.value_or(0);
  for (pugi::xml_node node : {suites, suite}) {
    node.append_attribute("name") = printable_path(report.a + " against " + report.b).c_str();
    node.append_attribute("tests") = report.pairs.size() + not_looked_at + counts.extra;
    node.append_attribute("failures") = counts.differs + counts.non_finite + not_looked_at +
                                        (skip_undecided ? 0 : counts.undecided);
    node.append_attribute("errors") = counts.errors;
    node.append_attribute("skipped") =
        counts.extra + counts.known.value_or(0) + (skip_undecided ? counts.undecided : 0);
    node.append_attribute("time") = fmt::format("{:.6f}", seconds).c_str();
  }
  for (const PairReport& pair : report.pairs) add_pair(suite, pair, skip_undecided);
  for (const std::string& name : report.missing)
    add_outcome(add_case(suite, name, 0), "failure", "missing", "there is only a reference");
  for (const std::string& name : report.extra)
    add_outcome(add_case(suite, name, 0), "skipped", "extra", "there is no reference");
  for (const std::string& name : report.not_followed)
    add_outcome(add_case(suite, name, 0), "failure", "not followed", std::string(kNotFollowed));
  for (const std::string& name : report.misnamed)
    add_outcome(add_case(suite, name, 0), "failure", "misnamed", std::string(kMisnamed));
  std::ostringstream stream;
  document.save(stream, "  ");
  return stream.str();
}

}  // namespace lobelia
