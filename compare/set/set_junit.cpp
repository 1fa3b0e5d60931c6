// A set of comparisons as JUnit's XML, which continuous integration shows as tests. JUnit has no standard; this
// subset is read by both Jenkins and GitLab (testsuites, testsuite, testcase, failure, error, skipped; properties for
// the figures).
#include <fmt/format.h>

#include <algorithm>
#include <pugixml.hpp>
#include <sstream>

#include "base/words/text.hpp"
#include "compare/set/report.hpp"

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

/// How JUnit has an outcome; null for a pass.
const char* kind_of(const SetReport& report, const NameOutcome& one, bool skip_undecided) {
  switch (one.outcome) {
    case Outcome::kPass:
      return nullptr;
    case Outcome::kError:
      return "error";
    case Outcome::kKnown:
      return "skipped";
    case Outcome::kUndecided:
      return skip_undecided ? "skipped" : "failure";
    case Outcome::kExtra:
      return report.missing_reference_fails ? "failure" : "skipped";
    default:
      return "failure";
  }
}

void add_properties(pugi::xml_node one, const Comparison& comparison) {
  pugi::xml_node properties = one.append_child("properties");
  for (const auto& [id, value] : comparison.metrics) {
    pugi::xml_node property = properties.append_child("property");
    property.append_attribute("name") = id.c_str();
    property.append_attribute("value") = fmt::format("{}", value).c_str();
  }
}

}  // namespace

std::string set_junit(const SetReport& report, bool skip_undecided) {
  double seconds = 0;
  for (const PairReport& pair : report.pairs) seconds += pair.seconds;
  const std::vector<NameOutcome> all = outcomes(report);
  const auto count = [&](std::string_view kind) {
    return std::ranges::count_if(all, [&](const NameOutcome& one) {
      const char* const own = kind_of(report, one, skip_undecided);
      return own && own == kind;
    });
  };
  pugi::xml_document document;
  pugi::xml_node suites = document.append_child("testsuites");
  pugi::xml_node suite = suites.append_child("testsuite");
  for (pugi::xml_node node : {suites, suite}) {
    node.append_attribute("name") = printable_path(report.a + " against " + report.b).c_str();
    node.append_attribute("tests") = all.size();
    node.append_attribute("failures") = count("failure");
    node.append_attribute("errors") = count("error");
    node.append_attribute("skipped") = count("skipped");
    node.append_attribute("time") = fmt::format("{:.6f}", seconds).c_str();
  }
  for (const NameOutcome& one : all) {
    pugi::xml_node added = add_case(suite, one.name, one.pair ? one.pair->seconds : 0);
    if (one.pair && one.pair->comparison) add_properties(added, *one.pair->comparison);
    const char* const kind = kind_of(report, one, skip_undecided);
    if (!kind) continue;
    const std::string known = one.pair ? known_text(*one.pair) : "";
    add_outcome(added, kind, one.word(),
                known.empty() ? one.why() : fmt::format("{}; {}", known, one.why()));
  }
  std::ostringstream stream;
  document.save(stream, "  ");
  return stream.str();
}

}  // namespace lobelia
