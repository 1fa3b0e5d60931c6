// `lobelia compare --accept`: judged pictures become the references. `lobelia accept --undo` is in accept.cpp.
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <iterator>
#include <optional>
#include <set>

#include "base/pictures/image_io.hpp"
#include "base/pictures/image_values.hpp"
#include "base/system/removal.hpp"
#include "base/words/text.hpp"
#include "compare/accept/replacement.hpp"
#include "program/command/compare/compare_arguments.hpp"
#include "program/command/compare/replaced_references.hpp"

namespace lobelia::cli {
namespace {

namespace fs = std::filesystem;

/// Set by the services that run jobs without a person.
constexpr const char* kOfCi[] = {"CI", "JENKINS_URL", "TEAMCITY_VERSION", "TF_BUILD"};

constexpr char kLeadsOut[] = "a link leads out of the references";

struct NewReference {
  fs::path from, to;
  std::string why;                          ///< it is one of them
  std::string refusal = {};                 ///< why it is left alone; empty if it is not
  std::optional<Sha256Digest> bytes = {};   ///< of `from`
  std::optional<Sha256Digest> before = {};  ///< of `to`; nothing if there is no such reference
  fs::path place = {};                      ///< `to` without links on the way
};

std::string not_finite(const std::string& file, const std::string& layer) {
  return fmt::format("{} has values that are not finite{}", printable_path(file),
                     layer.empty() ? "" : " in " + layer);
}

/// Why a part of the two files was not compared, and would be replaced unseen. Empty if everything was.
std::string why_unseen(const PairReport& pair, const CompareJob& job) {
  const Comparison& comparison = *pair.comparison;
  if (comparison.crop) return "only a part was compared (--crop)";
  if (comparison.ignored) return "a part was not compared (--ignore)";
  if (!comparison.mask_of.empty()) return "a part was judged by itself (--mask or --scene)";
  if (job.noise.has_replicates()) return "the mean of several pictures was compared";
  const PictureSource &a = pair.sources->a, &b = pair.sources->b;
  if (a.has_gain_map || b.has_gain_map) return "the gain map was not compared";
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

/// In depth an infinity is far away.
bool may_be_infinite(const PictureSource& source) {
  return allows_equal_nonfinite(ComparisonOptions(), source);
}

/// Why a reference cannot have these layers of a picture: values that are not finite. Empty if it can. Throws as
/// read_picture().
std::string why_not_finite(const fs::path& file, const std::vector<std::string>& layers) {
  for (const std::string& layer : layers) {
    const Picture picture = read_picture(file, layer);
    for (const Image* image : {&picture.image, &picture.overscan})
      if (!is_finite(*image) &&
          (!may_be_infinite(picture.source) ||
           std::ranges::any_of(image->values(), [](float value) { return std::isnan(value); })))
        return not_finite(file.string(), layer.empty() ? "" : "layer " + printable(layer));
  }
  return "";
}

/// The same of what was compared, where an option may have allowed values that b has, too.
std::string why_not_finite(const PairReport& pair) {
  if (pair.comparison->nonfinite.a > 0 && !may_be_infinite(pair.sources->a))
    return not_finite(pair.a, "");
  for (const LayerComparison& layer : pair.layers->compared)
    if (layer.comparison && layer.comparison->nonfinite.a > 0 && !may_be_infinite(layer.a))
      return not_finite(pair.a, layer.title());
  return "";
}

/// The layers of the judged picture that were not compared, or have infinities that b has not.
std::vector<std::string> layers_left(const PairReport& pair) {
  std::set<std::string> left(pair.sources->a.layers.begin(), pair.sources->a.layers.end());
  left.erase(pair.sources->a.layer);
  for (const LayerComparison& layer : pair.layers->compared)
    if (layer.problem.empty()) left.erase(layer.a.layer);
  if (pair.comparison->nonfinite.a > 0) left.insert(pair.sources->a.layer);
  for (const LayerComparison& layer : pair.layers->compared)
    if (layer.comparison && layer.comparison->nonfinite.a > 0) left.insert(layer.a.layer);
  return {left.begin(), left.end()};
}

/// Sets its hashes, or why it cannot be accepted.
void look_at_pair(const PairReport& pair, const CompareJob& job, NewReference& one) {
  one.bytes = pair.hashes.a;
  one.before = pair.hashes.b;
  const std::string from = printable_path(pair.a), to = printable_path(pair.b);
  const std::string changed = ": was changed while it was compared";
  if (one.refusal = why_not_finite(pair); !one.refusal.empty()) return;
  if (lower_case(one.from.extension().string()) != lower_case(one.to.extension().string()))
    one.refusal = fmt::format("{} is in another format than {}", from, to);
  else if (const std::string why = why_unseen(pair, job); !why.empty())
    one.refusal = fmt::format("{}: {}", to, why);
  else if (!one.bytes || !one.before)
    one.refusal = (one.bytes ? to : from) + changed;
  else if (const std::vector<std::string> left = layers_left(pair); !left.empty()) {
    const SteadyFile file(one.from);
    one.refusal = why_not_finite(one.from, left);
    if (one.refusal.empty() && file.digest() != one.bytes) one.refusal = from + changed;
  }
}

/// The same for a picture without a reference, which nobody has read yet.
void look_at_picture(NewReference& one) {
  const SteadyFile file(one.from);
  one.refusal = why_not_finite(one.from, layer_names(one.from));
  one.bytes = file.digest();
  if (!one.bytes && one.refusal.empty())
    one.refusal = printable_path(one.from.string()) + ": was changed while it was read";
}

/// Leaves alone what cannot be read.
template <class Look>
void look_at(NewReference& one, Look look) try {
  look();
} catch (const Error& error) {
  if (error.code() != ExitCode::kInput) throw;
  // Errors of the reader itself do not name the picture.
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
  if (!is_below(place, fs::canonical(folder, unknown))) return kLeadsOut;
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

/// Why a reference is not where its name says: a link leads out of the folder that it is in. Otherwise sets its place, and
/// is empty. `trusted` is the folder of the table or project that names it, which somebody typed.
std::string find_place(NewReference& one, const fs::path& trusted) {
  const fs::path parent = one.to.parent_path();
  const bool is_within = !trusted.empty() && is_below(parent, trusted);
  auto name = is_within ? std::next(parent.begin(), std::distance(trusted.begin(), trusted.end()))
                        : parent.begin();
  fs::path shown = is_within ? trusted : fs::path();
  fs::path real = real_path(shown.empty() ? fs::path(parent.is_absolute() ? "/" : ".") : shown);
  for (; name != parent.end(); ++name) {
    shown /= *name;
    if (*name == "..") {
      real = real.parent_path();
      continue;
    }
    const fs::path next = real_path(real / *name);
    if (!is_below(next, real))
      return fmt::format("{} is a link that leads elsewhere; name {}",
                         printable_path(shown.string()),
                         printable_path((real_path(parent) / one.to.filename()).string()));
    real = next;
  }
  one.place = real / one.to.filename();
  return "";
}

/// The pictures that do not pass, and those without a reference where it is clear where that would lie.
std::vector<NewReference> new_references(const CompareArguments& options, const Pairing& pairing,
                                         const SetReport& report) {
  const CompareJob& job = options.job;
  std::vector<NewReference> list;
  const std::vector<fs::path> folders = folders_of_references(job.pictures);
  const bool is_in_folders = job.pictures.csv.empty() && !folders.empty();
  const fs::path trusted =
      fs::path(options.choice.project.empty() ? job.pictures.csv : options.choice.project)
          .parent_path();
  std::set<const PairReport*> seen;  // its warnings are problems of their own
  for (const Problem& problem : problems(report))
    if (problem.pair && problem.weight != Problem::Weight::kNotice &&
        !is_pass(problem.pair->verdict()) && seen.insert(problem.pair).second) {
      list.push_back(
          {problem.pair->a, problem.pair->b, fmt::format("{}: {}", problem.what, problem.why)});
      NewReference& one = list.back();
      one.place = place_of(one.to);
      std::string why_not;
      if (!is_in_folders)
        why_not = find_place(one, trusted);
      else if (std::ranges::none_of(
                   folders, [&](const fs::path& folder) { return is_below(one.place, folder); }))
        why_not = kLeadsOut;
      if (!why_not.empty())
        one.refusal = fmt::format("{}: {}", printable_path(one.to.string()), why_not);
      else
        look_at(one, [&] { look_at_pair(*problem.pair, job, one); });
    }
  if (pairing.is_by_name)
    for (const PictureRow& row : pairing.rows) {
      if (!pairing.references_of(row).empty()) continue;
      const std::string& folder = job.pictures.given[kReferenceSet];
      const fs::path to = fs::path(folder) / row.name;
      const fs::path place = place_of(to);
      const std::string why_not = why_no_place(place, folder);
      for (const std::string& file : row.files) {
        if (file.empty()) continue;
        list.push_back({file, to, "new: there is no reference"});
        list.back().place = place;
        if (why_not.empty())
          look_at(list.back(), [&] { look_at_picture(list.back()); });
        else
          list.back().refusal = fmt::format("{}: {}", printable_path(to.string()), why_not);
      }
    }
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

/// The folder under the name that the user knows, open: whatever becomes of the name while the question is open. Holds none
/// if it cannot be opened. Throws Error(kInput) if the name has come to lead elsewhere.
HeldDirectory held_folder(const fs::path& folder, const std::vector<NewReference>& list) {
  std::set<fs::path> known;
  for (const NewReference& one : list) known.insert(one.to);
  HeldDirectory root(known_path(folder, known));
  std::error_code unknown;
  const fs::path real = fs::read_symlink(fmt::format("/proc/self/fd/{}", root.fd()), unknown);
  if (root && !unknown && real != folder)
    throw Error(ExitCode::kInput, "{}: was moved while it was compared; compare again",
                printable_path(root.path().string()));
  return root;
}

/// Leaves alone what cannot be in one replacement of files below `folder`.
void leave_apart(std::vector<NewReference>& list, const fs::path& folder,
                 const HeldDirectory& root) {
  for (NewReference& one : list) {
    std::string why;
    if (folder == folder.root_path()) {
      why = "has no folder but / in common with what else would be replaced";
    } else {
      HeldDirectory held = root.copy();
      for (const fs::path& name : one.place.parent_path().lexically_relative(folder))
        if (held && name != ".") held = held.below(name.string());
      if (held || held.is_missing()) continue;
      why = fmt::format("{}: {}", printable_path(held.path().string()), held.why_not());
    }
    one.refusal = fmt::format("{}: {}", printable_path(one.to.string()), why);
  }
}

/// Names those that are left alone, and drops them.
void drop_refused(std::vector<NewReference>& list) {
  for (const NewReference& one : list)
    if (!one.refusal.empty()) fmt::print("left alone: {}\n", one.refusal);
  std::erase_if(list, [](const NewReference& one) { return !one.refusal.empty(); });
}

/// As an argument of a command: none begins with a dash.
std::string argument_of(const fs::path& path) {
  return shell_quote(path.native().starts_with('-') ? "./" + path.string() : path.string());
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
    throw Error(ExitCode::kUsage, "--accept: {}; somebody has to look at what changes", why);
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
  drop_refused(list);
  const fs::path folder = common_folder(list, folders_of_references(options.job.pictures));
  const HeldDirectory root = list.empty() ? HeldDirectory() : held_folder(folder, list);
  leave_apart(list, folder, root);
  drop_refused(list);
  if (list.empty()) {
    fmt::print("\nno reference would change\n");
    return found == 0 && only_these;
  }
  std::set<fs::path> replaced;
  for (const NewReference& one : list)
    if (!replaced.insert(one.place).second)
      throw Error(ExitCode::kUsage,
                  "--accept: {} would be replaced by several pictures; leave one set to "
                  "judge",
                  printable_path(one.to.string()));
  if (!ask(list)) return false;
  std::vector<Replacement> files;
  for (const NewReference& one : list)
    files.push_back({one.from, *one.bytes, one.place.lexically_relative(folder), one.before});
  replace_files(root, files);
  fmt::print("{} replaced; 'lobelia accept --undo {}' puts the old ones back\n", list.size(),
             printable_path(argument_of(root.path())));
  return list.size() == found && only_these;
}

}  // namespace lobelia::cli
