#include "gallery/profile_data.hpp"

#include <algorithm>

#include "core/error.hpp"

namespace lobelia::gallery {
namespace {

constexpr const char* kZones[] = {"epicentre", "flank", "blooming"};

void read_zones(const Fields& zones, ProfileData& profile) {
  for (const char* zone : kZones) {
    const std::string key = std::string(zone) + "Degrees";
    const auto values = zones.numbers(key);
    if (values.empty()) continue;
    if (values.size() != 2) zones.fail(key, "must be two numbers");
    profile.zones.push_back({zone_title(zone), values[0], values[1]});
  }
}

/// An image's own numbers, and which power of a cosine was fitted to its highlight.
NamedNumbers figures_of(const Fields& image) {
  NamedNumbers figures = image.number_members();
  const auto highlight = image.object("highlight");
  const auto cosine = highlight ? highlight->object("cosineLobe") : std::nullopt;
  for (const char* key : {"exponent", "standardError"}) {
    const auto value = cosine ? cosine->number(key) : std::nullopt;
    if (value) figures.emplace_back(key, *value);
  }
  return figures;
}

void read_curves(const Fields& curve, ProfileData& profile) {
  for (auto& [name, values] : curve.number_arrays()) {
    if (name == "angleDegrees") {
      profile.degrees = values;
    } else if (name != "pixels") {
      profile.curves.push_back({name, values});
    }
  }
  for (const NamedCurve& c : profile.curves) {
    if (c.values.size() != profile.degrees.size()) {
      curve.fail(c.name, "must have as many values as 'angleDegrees'");
    }
  }
}

}  // namespace

const NamedCurve* ProfileData::find_curve(const std::string& name) const {
  const auto at = std::find_if(curves.begin(), curves.end(),
                               [&](const NamedCurve& curve) { return curve.name == name; });
  return at == curves.end() ? nullptr : &*at;
}

std::string zone_title(const std::string& zone) {
  return zone == "blooming" ? "blooming zone" : zone;
}

ProfileData read_profile(const std::filesystem::path& directory, const std::string& file) {
  ProfileData profile;
  profile.file = file;
  if (file.empty()) return profile;
  try {
    const Json record = read_record(directory / file, "profile");
    const Fields fields(record, file);
    profile.angle = fields.text("angle");
    if (const auto zones = fields.object("zones")) read_zones(*zones, profile);
    if (const auto curve = fields.object("curve")) read_curves(*curve, profile);
    if (const auto images = fields.object("images")) {
      for (const auto& [name, image] : images->object_members()) {
        profile.images.emplace_back(name, figures_of(image));
      }
    }
    if (const auto differences = fields.object("differences")) {
      for (const auto& [pair, zones] : differences->object_members()) {
        std::vector<ZoneDifference> rows;
        for (const auto& [zone, values] : zones.object_members()) {
          rows.push_back({zone, values.number_members()});
        }
        profile.differences.emplace_back(pair, std::move(rows));
      }
    }
  } catch (const Error& error) {
    if (error.code() != ExitCode::kInput) throw;
    profile = ProfileData{};
    profile.file = file;
    profile.problem = error.what();
  }
  return profile;
}

}  // namespace lobelia::gallery
