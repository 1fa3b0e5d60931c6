// `lobelia compare --accept`: judged pictures become the references. `lobelia accept --undo` is in accept.cpp.
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <iostream>
#include <optional>
#include <set>

#include "cli/compare_arguments.hpp"
#include "cli/replaced_references.hpp"
#include "core/image_io.hpp"
#include "core/image_values.hpp"
#include "core/replacement.hpp"
#include "core/text.hpp"

namespace lobelia::cli {
namespace {

namespace fs = std::filesystem;

/// Set by the services that run jobs without a person.
constexpr const char* kOfCi[] = {"CI", "JENKINS_URL", "TEAMCITY_VERSION", "TF_BUILD"};

struct NewReference {
  fs::path from, to;
  std::string why;                          ///< it is one of them
  std::string refusal = {};                 ///< why it is left alone; empty if it is not
  std::optional<Sha256Digest> bytes = {};   ///< of `from`
  std::optional<Sha256Digest> before = {};  ///< of `to`; nothing if there is no such reference
  fs::path place = {};                      ///< `to` without links on the way
};

/// Why a part of the two files was not compared, and would be replaced unseen. Empty if everything was.
std::string why_unseen(const PairReport& pair, const CompareJob& job) {
  const Comparison& comparison = *pair.comparison;
  if (comparison.crop) return "only a part was compared (--crop)";
  if (comparison.ignored) return "a part was not compared (--ignore)";
  if (!comparison.mask_of.empty()) return "a part was judged by itself (--mask or --scene)";
  if (job.noise.has_replicates()) return "the mean of several pictures was compared";
  const PictureSource &a = pair.sources->a, &b = pair.sources->b;
  if (a.gain_map == "left out" || b.gain_map == "left out")
    return "the gain map was not compared (--base-only)";
  const auto& common = pair.layers->common;
  NotCompared left = pair.layers->not_compared;
  // The smaller levels are made of the first.
  left.mip_levels = std::max(0, b.mip_levels - a.mip_levels);
  if (common) {  // what one side alone has was named
    const auto is_named = [&](const std::string& layer) {
      return std::ranges::count(common->only_a, layer) > 0;
    };
    std::erase_if(left.layers, is_named);
    left.alpha = left.alpha && !is_named(a.alpha);
  }
  if (is_empty(left)) return "";
  return fmt::format("not compared: {}{}", to_text(left), common ? "" : " (see --all-layers)");
}

/// Sets its hashes, or why it cannot be accepted.
void look_at_pair(const PairReport& pair, const CompareJob& job, NewReference& one) {
  one.bytes = pair.hashes.a;
  one.before = pair.hashes.b;
  const std::string from = printable_path(pair.a), to = printable_path(pair.b);
  if (pair.verdict() == Verdict::kNonFinite && pair.comparison->nonfinite.a > 0)
    one.refusal = from + " has values that are not finite";
  else if (lower_case(one.from.extension().string()) != lower_case(one.to.extension().string()))
    one.refusal = fmt::format("{} is in another format than {}", from, to);
  else if (const std::string why = why_unseen(pair, job); !why.empty())
    one.refusal = fmt::format("{}: {}", to, why);
  else if (!one.bytes || !one.before)
    one.refusal = fmt::format("{}: was changed while it was compared", one.bytes ? to : from);
}

/// The same for a picture without a reference, which nobody has read yet.
void look_at_picture(NewReference& one) try {
  const SteadyFile file(one.from);
  const std::vector<std::string> layers = layer_names(one.from);
  const std::string layer = layers.empty() ? "" : layers.front();
  if (!is_finite(read_picture(one.from, layer).image) && !is_depth_like(layer))
    one.refusal = printable_path(one.from.string()) + " has values that are not finite";
  one.bytes = file.digest();
  if (!one.bytes)
    one.refusal = printable_path(one.from.string()) + ": was changed while it was read";
} catch (const Error& error) {
  if (error.code() != ExitCode::kInput) throw;
  // What went wrong with the reader does not name the picture.
  const std::string why = error.what(), from = one.from.string();
  one.refusal = printable_path(why.starts_with(from) ? why : from + ": " + why);
}

/// `to` without links on the way. A link to nothing stays. Throws as real_path().
fs::path place_of(const fs::path& to) {
  const fs::path parent = to.parent_path();
  return real_path(parent.empty() ? fs::path(".") : parent) / to.filename();
}

/// Why a new reference cannot lie there: it would lie outside of `folder`, or there is a file that was not compared.
std::string why_no_place(const fs::path& place, const std::string& folder) {
  std::error_code unknown;
  if (!is_below(place, fs::canonical(folder, unknown))) return "a link leads out of the references";
  for (fs::path part = place.parent_path(); part != part.parent_path(); part = part.parent_path())
    if (fs::is_symlink(part, unknown))
      return printable_path(part.string()) + " is a link to nothing";
  switch (fs::symlink_status(place, unknown).type()) {
    case fs::file_type::not_found:
      return "";
    case fs::file_type::none:
      return "cannot be looked at: " + unknown.message();
    default:
      return "is there, and was not compared";
  }
}

/// The pictures that do not pass, and those without a reference where it is clear where that would lie.
std::vector<NewReference> new_references(const CompareArguments& options, const Pairing& pairing,
                                         const SetReport& report) {
  const CompareJob& job = options.job;
  std::vector<NewReference> list;
  std::set<const PairReport*> seen;  // its warnings are problems of their own
  for (const Problem& problem : problems(report))
    if (problem.pair && problem.weight != Problem::Weight::kNotice &&
        !is_pass(problem.pair->verdict()) && seen.insert(problem.pair).second) {
      list.push_back(
          {problem.pair->a, problem.pair->b, fmt::format("{}: {}", problem.what, problem.why)});
      look_at_pair(*problem.pair, job, list.back());
    }
  if (has_folders_by_name(job, pairing))
    for (const PictureRow& row : pairing.rows) {
      if (!pairing.references_of(row).empty()) continue;
      const std::string& folder = job.pictures.given[kReferenceSet];
      const fs::path to = fs::path(folder) / row.name;
      const std::string why_not = why_no_place(place_of(to), folder);
      for (const std::string& file : row.files) {
        if (file.empty()) continue;
        list.push_back({file, to, "new: there is no reference"});
        if (why_not.empty())
          look_at_picture(list.back());
        else
          list.back().refusal = fmt::format("{}: {}", printable_path(to.string()), why_not);
      }
    }
  for (NewReference& one : list) one.place = place_of(one.to);
  return list;
}

/// The nearest folder that holds all of them: of one set, the folder that was given.
fs::path common_folder(const std::vector<NewReference>& list,
                       const std::vector<fs::path>& folders) {
  fs::path common;
  for (const NewReference& one : list) {
    fs::path home = one.place.parent_path();
    for (const fs::path& folder : folders)
      if (is_below(home, folder)) home = folder;
    if (common.empty()) common = home;
    while (!is_below(home, common)) common = common.parent_path();
  }
  return common;
}

/// Whether somebody agrees.
bool ask(const std::vector<NewReference>& list) {
  fmt::print("\nThese references would be replaced:\n");
  for (const NewReference& one : list)
    fmt::print("  {}\n    by {}\n    {}\n", printable_path(one.to.string()),
               printable_path(one.from.string()), printable_path(one.why));
  fmt::print("Replace {}? Type yes: ", list.size());
  std::fflush(stdout);
  std::string answer;
  std::getline(std::cin, answer);
  if (answer != "yes") fmt::print("nothing was changed\n");
  return answer == "yes";
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
  for (const NewReference& one : list)
    if (!one.refusal.empty()) fmt::print("left alone: {}\n", one.refusal);
  std::erase_if(list, [](const NewReference& one) { return !one.refusal.empty(); });
  if (list.empty()) {
    fmt::print("\nno reference would change\n");
    return found == 0 && only_these;
  }
  std::set<fs::path> replaced;
  for (const NewReference& one : list)
    if (!replaced.insert(one.place).second)
      throw Error(
          ExitCode::kUsage,
          fmt::format("--accept: {} would be replaced by several pictures; leave one set to "
                      "judge",
                      printable_path(one.to.string())));
  if (!ask(list)) return false;
  const fs::path folder = common_folder(list, folders_of_references(options.job.pictures));
  std::vector<Replacement> files;
  for (const NewReference& one : list)
    files.push_back({one.from, *one.bytes, one.place.lexically_relative(folder), one.before});
  std::set<fs::path> known;
  for (const NewReference& one : list) known.insert(one.to);
  const fs::path shown = known_path(folder, known);
  replace_files(HeldDirectory(shown), files);
  fmt::print("{} references were replaced; 'lobelia accept --undo {}' puts the old ones back\n",
             list.size(), printable_path(shell_quote(shown.string())));
  return list.size() == found && only_these;
}

}  // namespace lobelia::cli
