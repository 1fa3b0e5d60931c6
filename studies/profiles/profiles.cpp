#include "studies/profiles/profiles.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "profile/blob.hpp"
#include "studies/profiles/made_pictures.hpp"
#include "studies/table.hpp"

namespace lobelia::profile_study {
namespace {

void measure_scene(const MadeScene& made, const ProfileOfScene& profile_of, Row& row) {
  const records::Profile profile = profile_of(made.scene, {{"made", &made.image}});
  const auto& explanations = records::find(profile.images, "made")->highlight->explanations;
  const auto one = std::ranges::find(explanations, made.family, &records::LobeExplanation::family);
  Tally& tally = row.figures["lobe"];
  if (one == explanations.end() || !one->because.empty()) {
    ++tally.missing;
    return;
  }
  tally.add((one->exponent ? one->exponent : one->alpha).value(), made.width,
            one->standard_error.value(), made.width);
}

void measure_blob(const MadeBlob& made, bool clipped, Row& row) {
  BlobOptions options;
  options.search.at = FilmPoint{made.x, made.y};
  const BlobFigures blob =
      measure_blobs({{"made", &made.image}}, options).highlights.front().blobs.front();
  const BlobErrors& e = blob.errors;
  // If the highlight is clipped, the peak is the one that its flank gives.
  if (clipped) {
    if (blob.clipped) {
      const Estimate& peak = blob.clipped->flank.peak;
      row.figures["peak"].add(peak.value, made.peak, peak.standard_error, made.peak);
    } else {
      ++row.figures["peak"].missing;
    }
  } else {
    row.figures["peak"].add(blob.peak.value, made.peak, e.peak, made.peak);
    row.figures["place"].add(blob.peak.place.x, made.x, e.place.x, 1);
    row.figures["place"].add(blob.peak.place.y, made.y, e.place.y, 1);
    row.figures["centroid"].add(blob.axes.centre.x, made.x, e.centroid.x, 1);
    row.figures["centroid"].add(blob.axes.centre.y, made.y, e.centroid.y, 1);
    row.figures["energy"].add(blob.energy, made.energy, e.energy, made.energy);
  }
  row.figures["half-width"].add(blob.major_half_width, made.major, e.half_width_pixels.major,
                                made.major);
  row.figures["half-width"].add(blob.minor_half_width, made.minor, e.half_width_pixels.minor,
                                made.minor);
}

double median_of(std::vector<double> values) {
  if (values.empty()) return kNaN;
  const auto middle = values.begin() + std::ptrdiff_t(values.size() / 2);
  std::ranges::nth_element(values, middle);
  return *middle;
}

constexpr std::array kFigures = {"lobe", "peak", "place", "centroid", "half-width", "energy"};

/// A cell for each figure; "-" where the row has none.
template <class Text>
void add_cells(std::vector<studies::Cell>& cells, const Row& row, const Text& text_of) {
  for (const char* name : kFigures) {
    const auto found = row.figures.find(name);
    cells.push_back(found == row.figures.end() ? std::string("-") : text_of(found->second));
  }
}

}  // namespace

void Tally::add(double found, double truth, double error, double unit) {
  if (!std::isfinite(found) || !(error >= 0)) {
    ++missing;
    return;
  }
  ++figures;
  const double away = std::abs(found - truth);
  within_one += away <= error;
  within_two += away <= 2 * error;
  distances.push_back(error > 0 ? away / error : away > 0 ? kInfinity : 0);
  errors.push_back(error / unit);
}

double Tally::worst() const { return distances.empty() ? 0 : *std::ranges::max_element(distances); }

double Row::median_distance() const {
  std::vector<double> all;
  for (const auto& [name, tally] : figures)
    all.insert(all.end(), tally.distances.begin(), tally.distances.end());
  return median_of(std::move(all));
}

double Row::share() const {
  int within = 0, all = 0;
  for (const auto& [name, tally] : figures) {
    within += tally.within_two;
    all += tally.figures + tally.missing;
  }
  return all > 0 ? double(within) / all : 0;
}

std::vector<Row> measure(const Options& options, const ProfileOfScene& profile_of,
                         const std::function<void(double)>& show) {
  std::vector<Row> rows;
  unsigned number = 0;
  for (const Kind& kind : kinds()) {
    // A kind has the same pictures if it is measured alone.
    std::seed_seq seed{options.seed, ++number};
    if (!options.only.empty() && kind.name != options.only) continue;
    std::mt19937 random(seed);
    Row& row = rows.emplace_back();
    row.kind = kind.name;
    for (int k = 0; k < options.pictures; ++k) {
      if (kind.with_scene)
        measure_scene(make_scene(kind, random), profile_of, row);
      else
        measure_blob(make_blob(kind, random), kind.clipped, row);
      ++row.pictures;
      show((number - 1 + double(row.pictures) / options.pictures) / double(kinds().size()));
    }
  }
  return rows;
}

std::string report_text(const std::vector<Row>& rows, bool markdown) {
  studies::Table table;
  table.title = "Share of the figures within two stated standard errors of the truth";
  table.columns = {{"pictures of highlights", -1}, {"pictures", 1, "{}", 2}};
  for (const char* name : kFigures) table.columns.push_back({name, 1, "{}", 2});
  table.columns.push_back({"all", 1, "{}", 2});
  table.columns.push_back({"median distance", 1, "{}", 2});
  int pictures = 0;
  std::string missed;
  for (const Row& row : rows) {
    std::vector<studies::Cell> cells{row.kind, row.pictures};
    add_cells(cells, row, [](const Tally& t) { return fmt::format("{:.1f} %", 100 * t.share()); });
    cells.push_back(fmt::format("{:.1f} %", 100 * row.share()));
    cells.push_back(fmt::format("{:.2f}", row.median_distance()));
    table.rows.push_back(std::move(cells));
    pictures += row.pictures;
    if (row.share() < kGoal) missed += (missed.empty() ? "" : ", ") + row.kind;
  }
  table.remarks = {fmt::format("{} pictures. The goal is {:.0f} % of each kind: {}", pictures,
                               100 * kGoal, missed.empty() ? "met." : "missed by " + missed + ".")};
  if (markdown) return studies::table_markdown(table) + '\n' + table.remarks.front() + '\n';
  // How large the errors are, so that none is met by errors that say nothing.
  studies::Table sizes;
  sizes.title = "Median of the stated errors, and the largest distance from the truth in errors";
  sizes.columns = {{"pictures of highlights", -1}};
  for (const char* name : kFigures) sizes.columns.push_back({name, 1, "{}", 2});
  for (const Row& row : rows) {
    std::vector<studies::Cell> cells{row.kind};
    add_cells(cells, row, [](const Tally& t) {
      return fmt::format("{:.1g} ({:.2g})", median_of(t.errors), t.worst());
    });
    sizes.rows.push_back(std::move(cells));
  }
  sizes.remarks = {"Errors of places and centroids are pixels, the others shares of the value."};
  table.columns[0].width = sizes.columns[0].width = -30;
  table.fit();
  sizes.fit();
  return studies::table_text(std::move(table)) + '\n' + studies::table_text(std::move(sizes));
}

bool meets_goal(const std::vector<Row>& rows) {
  return std::ranges::all_of(rows, [](const Row& row) { return row.share() >= kGoal; });
}

records::VerifyProfiles report_record(const std::vector<Row>& rows, unsigned seed) {
  records::VerifyProfiles record;
  record.seed = seed;
  record.goal = kGoal;
  for (const Row& row : rows) {
    record.outside += row.share() < kGoal;
    records::KindCoverage& kind = record.kinds.emplace_back();
    kind = {row.kind, row.pictures, row.share(), row.median_distance(), {}};
    for (const auto& [name, tally] : row.figures)
      kind.figures.push_back({name, tally.figures, tally.within_one, tally.within_two,
                              tally.missing, median_of(tally.distances), tally.worst(),
                              median_of(tally.errors)});
  }
  return record;
}

}  // namespace lobelia::profile_study
