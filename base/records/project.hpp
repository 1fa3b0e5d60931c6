// A project of `lobelia compare`: sets of pictures and how to judge them. Written by people, as TOML or JSON.
#pragma once

#include <filesystem>

#include "base/records/struct_type.hpp"

namespace lobelia::records {

/// How some of the pairs are judged.
struct ProjectRule {
  std::string match;
  std::vector<std::string> fail, warn, mask, ignore;
  std::string tolerance;
  std::optional<bool> default_limits;
};

/// A difference that is no failure until it expires.
struct KnownDifference {
  std::string match, reason, expires;
};

struct Project {
  std::string title;
  std::vector<std::string> judged, references;
  std::string pairs, pattern, sets;
  std::vector<std::string> fail, warn, mask, ignore;
  std::string tolerance;
  std::optional<bool> default_limits;
  std::string exposure, layer, scene;
  std::vector<std::string> layer_types;
  std::optional<bool> ignore_alpha;
  std::string judged_variance, reference_variance;
  std::optional<double> judged_samples, reference_samples;
  std::string missing_reference;
  std::vector<ProjectRule> rules;
  std::vector<KnownDifference> known;
};

/// Reads TOML, or JSON where the file's name ends in .json. Throws Error(kInput) with the place, as read_record().
Project read_project(const std::filesystem::path& path);

void define_project_tables(Tables& tables);

}  // namespace lobelia::records
