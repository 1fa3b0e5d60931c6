// `lobelia compare --accept`: judged pictures become the references.
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <iostream>
#include <set>

#include "cli/compare_arguments.hpp"
#include "core/text.hpp"

namespace lobelia::cli {
namespace {

namespace fs = std::filesystem;

/// Set by the services that run jobs without a person.
constexpr const char* kOfCi[] = {"CI", "JENKINS_URL", "TEAMCITY_VERSION", "TF_BUILD"};

struct NewReference {
  fs::path from, to;
  std::string why;
  bool is_nonfinite = false;
};

/// The pictures that do not pass, and those without a reference where it is clear where that would lie.
std::vector<NewReference> new_references(const CompareArguments& options, const Pairing& pairing,
                                         const SetReport& report) {
  std::vector<NewReference> list;
  for (const Problem& problem : problems(report))
    if (problem.pair && problem.weight != Problem::Weight::kNotice &&
        !is_pass(problem.pair->verdict()))
      list.push_back({problem.pair->a, problem.pair->b,
                      fmt::format("{}: {}", problem.what, problem.why),
                      problem.pair->verdict() == Verdict::kNonFinite &&
                          problem.pair->comparison->nonfinite.a > 0});
  if (has_folders_by_name(options.job, pairing))
    for (const PictureRow& row : pairing.rows)
      if (pairing.references_of(row).empty())
        list.push_back({row.files.front(),
                        fs::path(options.job.pictures.given[kReferenceSet]) / row.name,
                        "new: there is no reference"});
  return list;
}

}  // namespace

void require_person() {
  const auto refuse = [](const std::string& why) {
    throw Error(ExitCode::kUsage,
                fmt::format("--accept: {}; somebody has to look at what changes", why));
  };
  for (const char* name : kOfCi)
    if (const char* value = std::getenv(name);
        value && *value && std::string_view(value) != "false")
      refuse(fmt::format("this is a CI job (${} is set)", name));
  if (::isatty(STDIN_FILENO) != 1 || ::isatty(STDOUT_FILENO) != 1) refuse("this is no terminal");
}

bool accept_pictures(const CompareArguments& options, const Pairing& pairing,
                     const SetReport& report) {
  std::vector<NewReference> list = new_references(options, pairing, report);
  const std::size_t found = list.size();
  const records::SetSummary counts = count(report);
  const bool only_these =
      counts.errors + counts.missing + counts.links_not_followed + counts.misnamed.value_or(0) == 0;
  std::erase_if(list, [](const NewReference& one) {
    if (one.is_nonfinite)
      fmt::print("left alone: {} has values that are not finite\n",
                 printable_path(one.from.string()));
    const bool fits =
        lower_case(one.from.extension().string()) == lower_case(one.to.extension().string());
    if (!fits)
      fmt::print("left alone: {} is in another format than {}\n", printable_path(one.from.string()),
                 printable_path(one.to.string()));
    return !fits || one.is_nonfinite;
  });
  if (list.empty()) {
    fmt::print("\nno reference would change\n");
    return found == 0 && only_these;
  }
  std::set<fs::path> replaced;
  for (const NewReference& one : list)
    if (!replaced.insert(one.to).second)
      throw Error(
          ExitCode::kUsage,
          fmt::format("--accept: {} would be replaced by several pictures; leave one set to "
                      "judge",
                      printable_path(one.to.string())));
  fmt::print("\nThese references would be replaced:\n");
  for (const NewReference& one : list)
    fmt::print("  {}\n    by {}\n    {}\n", printable_path(one.to.string()),
               printable_path(one.from.string()), printable_path(one.why));
  fmt::print("Replace {}? Type yes: ", list.size());
  std::fflush(stdout);
  std::string answer;
  std::getline(std::cin, answer);
  if (answer != "yes") {
    fmt::print("nothing was changed\n");
    return false;
  }
  constexpr std::uint64_t kMostBytes = std::uint64_t{4} << 30;
  FilesTogether files;
  for (const NewReference& one : list) {
    make_directories(one.to.parent_path());
    write_file(one.to, read_file(one.from, kMostBytes), AtLink::kReplace);
  }
  files.commit();
  fmt::print("{} references were replaced\n", list.size());
  return list.size() == found && only_these;
}

}  // namespace lobelia::cli
