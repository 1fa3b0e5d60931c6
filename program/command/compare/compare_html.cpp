#include "program/command/compare/compare_html.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "base/pictures/colour.hpp"
#include "base/pictures/image_io.hpp"
#include "base/pictures/image_values.hpp"
#include "base/records/record.hpp"
#include "base/system/files.hpp"
#include "base/system/sha256.hpp"
#include "base/system/standard_streams.hpp"
#include "base/words/text.hpp"
#include "compare/highlight_region.hpp"
#include "compare/highlights/words.hpp"
#include "compare/metrics/catalogue.hpp"
#include "gallery/pages/report.hpp"
#include "gallery/pages/single_file.hpp"
#include "gallery/site/publisher.hpp"
#include "program/command/commands.hpp"
#include "program/command/gallery/publish.hpp"
#include "program/command/options.hpp"

namespace lobelia::cli {
namespace {

namespace fs = std::filesystem;

/// "a", "b", ...: a set's name in files and links.
std::string set_name(std::size_t set) {
  constexpr std::size_t kLetters = 26;
  return set < kLetters ? std::string(1, char('a' + set)) : fmt::format("set{}", set + 1);
}

/// A row of the pairing with what was found of it.
struct Judged {
  std::size_t row = 0;
  std::vector<const PairReport*> pairs;
  Outcome outcome = Outcome::kPass;
  double excess = 0;
};

/// Lower is worse.
int rank(Outcome outcome) {
  constexpr Outcome kWorstFirst[] = {Outcome::kError,   Outcome::kMissing,   Outcome::kNonFinite,
                                     Outcome::kDiffers, Outcome::kUndecided, Outcome::kKnown,
                                     Outcome::kExtra,   Outcome::kPass};
  return int(std::ranges::find(kWorstFirst, outcome) - std::begin(kWorstFirst));
}

/// All rows, the worst first.
std::vector<Judged> judge_rows(const Pairing& pairing, const SetReport& report) {
  std::vector<Judged> rows(pairing.rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    rows[i].row = i;
    const std::vector<std::string>& files = pairing.rows[i].files;
    const bool has_reference = !pairing.references_of(pairing.rows[i]).empty();
    for (std::size_t set = 0; set < files.size(); ++set)
      if (!pairing.is_reference(set) && files[set].empty() == has_reference)
        rows[i].outcome = has_reference ? Outcome::kMissing : Outcome::kExtra;
  }
  for (const PairReport& pair : report.pairs) {
    Judged& row = rows[pair.row];
    row.pairs.push_back(&pair);
    const Outcome outcome = outcome_of(pair);
    if (rank(outcome) < rank(row.outcome)) row.outcome = outcome;
    if (pair.comparison) row.excess = std::max(row.excess, excess(pair));
  }
  std::ranges::stable_sort(rows, [](const Judged& p, const Judged& q) {
    return std::pair(rank(p.outcome), -p.excess) < std::pair(rank(q.outcome), -q.excess);
  });
  return rows;
}

/// The axes of the report: the fields of the names, or one axis of all rows, the worst first.
std::vector<records::Axis> axes_of(const Pairing& pairing, const std::vector<Judged>& rows) {
  std::vector<records::Axis> axes;
  if (pairing.fields.size() < 2) {
    records::Axis& axis = axes.emplace_back();
    axis.name = pairing.fields.empty() ? "picture" : pairing.fields.front();
    for (const Judged& judged : rows) {
      const std::string name = printable_path(pairing.rows[judged.row].name);
      axis.values.push_back({name, name});
    }
    return axes;
  }
  const auto by_number = [](const std::string& p, const std::string& q) {
    double a = 0, b = 0;
    if (parse_number(p, a) && parse_number(q, b) && a != b) return a < b;
    return p < q;
  };
  for (std::size_t field = 0; field < pairing.fields.size(); ++field) {
    std::set<std::string, decltype(by_number)> values(by_number);
    for (const PictureRow& row : pairing.rows) values.insert(printable(row.fields[field]));
    records::Axis& axis = axes.emplace_back();
    axis.name = printable(pairing.fields[field]);
    for (const std::string& value : values) axis.values.push_back({value, value});
  }
  return axes;
}

std::string hash_of(const Image& image) {
  const auto bytes = std::as_bytes(image.values());
  return fmt::format("{} x {} {}", image.width(), image.height(),
                     hex(sha256({reinterpret_cast<const char*>(bytes.data()), bytes.size()})));
}

records::Named<std::string> facts_of(const std::string& file, const PictureSource& source,
                                     const records::Named<std::string>& reading) {
  records::Named<std::string> facts;
  facts.emplace_back("File", printable_path(file));
  facts.emplace_back("Format", source.format);
  facts.emplace_back("Size", fmt::format("{} × {}", source.display.width, source.display.height));
  facts.emplace_back("Values", fmt::format("{}, {}", source.value_type, source.transfer));
  facts.insert(facts.end(), reading.begin(), reading.end());
  return facts;
}

/// Makes the cells of a report. The pictures of a cell are read again when it is written.
class ReportWriter {
 public:
  ReportWriter(const CompareJob& job, const Pairing& pairing, const SetReport& report)
      : job_(job), pairing_(pairing), rows_(judge_rows(pairing, report)) {
    for (const Judged& judged : rows_) by_id_[plain_id(pairing_.rows[judged.row].name)] = &judged;
  }

  const std::vector<Judged>& rows() const { return rows_; }

  gallery::ShownFarm farm(const HtmlReport& html, const std::vector<gallery::MetricInfo>& metrics) {
    records::Farm farm;
    farm.title = !html.title.empty()   ? html.title
                 : !job_.title.empty() ? job_.title
                                       : fmt::format("{} and {}", judged_sets(),
                                                     printable_path(pairing_.sets[kReferenceSet]));
    farm.command = shell_join(command_line());
    farm.axes = axes_of(pairing_, rows_);
    add_set(farm, kReferenceSet);
    for (std::size_t set = 0; set < pairing_.sets.size(); ++set)
      if (!pairing_.is_reference(set)) add_set(farm, set);
    for (const Judged& judged : rows_) {
      const PictureRow& row = pairing_.rows[judged.row];
      records::FarmCell cell{
          plain_id(row.name), std::string(info(gallery::status_of(judged.outcome)).name), {}};
      for (std::size_t i = 0; i < farm.axes.size(); ++i)
        cell.axes.emplace_back(farm.axes[i].name, pairing_.fields.size() < 2
                                                      ? printable_path(row.name)
                                                      : printable(row.fields[i]));
      farm.cells.push_back(std::move(cell));
    }
    gallery::ShownFarm shown = show(std::move(farm), gallery::Metrics(metrics));
    if (pairing_.fields.empty())  // a name that begins with a digit needs no word before it
      for (std::size_t i = 0; i < rows_.size(); ++i)
        shown.cells[i].label = printable_path(pairing_.rows[rows_[i].row].name);
    shown.hub = set_name(kReferenceSet);
    shown.is_report = true;
    return shown;
  }

  gallery::ReportCell cell(const gallery::CellEntry& entry) const {
    const Judged& judged = *by_id_.at(entry.id);
    gallery::ReportCell made;
    gallery::CheckedCell& cell = made.cell;
    cell.id = entry.id;
    cell.hub = set_name(kReferenceSet);
    cell.status = gallery::status_of(judged.outcome);
    cell.has_record = true;
    for (const PairReport* pair : judged.pairs)
      if (pair->comparison)
        add_pair(*pair, made);
      else
        cell.record.problems.push_back({set_name(pair->set), printable_path(pair->error), "", 0});
    add_lonely_pictures(judged, made);
    std::ranges::stable_sort(cell.images, [&](const auto& p, const auto& q) {
      return (p.engine == cell.hub) > (q.engine == cell.hub);
    });
    return made;
  }

 private:
  std::string judged_sets() const {
    std::vector<std::string> titles;
    for (std::size_t set = 0; set < pairing_.sets.size(); ++set)
      if (!pairing_.is_reference(set)) titles.push_back(printable_path(pairing_.sets[set]));
    return fmt::format("{}", fmt::join(titles, ", "));
  }

  void add_set(records::Farm& farm, std::size_t set) const {
    records::FarmEngine engine;
    engine.name = set_name(set);
    engine.title = printable_path(pairing_.sets[set]);
    if (set == kReferenceSet) engine.title += " (reference)";
    engine.available = true;
    farm.engines.push_back(std::move(engine));
  }

  static void add_image(std::size_t set, const std::string& file, const Picture& picture,
                        const records::Named<std::string>& reading, double stops,
                        gallery::ReportCell& made) {
    gallery::EnginePicture image;
    image.engine = set_name(set);
    if (made.cell.find_image(image.engine)) return;
    image.exr = image.engine + ".exr";
    image.png.file = image.engine + ".png";
    image.exr_sha256 = hash_of(picture.image);
    image.facts = facts_of(file, picture.source, reading);
    made.shown[image.png.file] = to_display(picture.image, stops);
    made.pictures[image.exr] = picture.image;
    made.cell.images.push_back(std::move(image));
  }

  void add_pair(const PairReport& pair, gallery::ReportCell& made) const {
    const Comparison& comparison = *pair.comparison;
    const CompareJob job = job_of(job_, pair.name);
    ComparisonOptions options = job.comparison;
    const PicturePair read = read_compared(pair, job, options);
    const double stops = comparison.viewing.exposure_stops;
    if (!made.cell.record.exposure_stops) made.cell.record.exposure_stops = stops;
    const auto [reading_a, reading_b] = reading_of(pair);
    add_image(kReferenceSet, pair.b, read.b, reading_b, stops, made);
    add_image(pair.set, pair.a, read.a, reading_a, stops, made);
    gallery::CheckedComparison checked;
    checked.record = pair_record(pair);
    checked.verdict = verdict_name(pair.verdict());
    checked.entry.a = set_name(pair.set);
    checked.entry.b = set_name(kReferenceSet);
    const double largest = comparison.value("max_abs");
    const double of_peak = comparison.value("max_rel_peak");
    // Identifiers have neither.
    checked.entry.difference = {largest > 0 ? largest : 1, std::isnan(of_peak) ? 0 : of_peak};
    checked.png.file = fmt::format("{}-{}.png", checked.entry.a, checked.entry.b);
    made.shown[checked.png.file] =
        difference_picture(read.a.image, read.b.image, checked.entry.difference.white_at);
    checked.sentence = highlight_sentence(comparison, printable_path(pairing_.sets[pair.set]),
                                          printable_path(pairing_.sets[kReferenceSet]));
    for (const std::string& sentence : sentences_on_highlights(comparison.highlights))
      checked.sentence += (checked.sentence.empty() ? "" : "; ") + sentence;
    for (const std::string& more :
         {pair.references.size() > 1
              ? fmt::format("of {} acceptable references, this is the one that it fits best",
                            pair.references.size())
              : "",
          printable_path(known_text(pair)), comparison.finding, why_layers_differ(pair)})
      if (!more.empty()) checked.sentence += (checked.sentence.empty() ? "" : "; ") + more;
    made.cell.comparisons.push_back(std::move(checked));
  }

  /// Pictures that were compared with nothing, as far as they can be read.
  void add_lonely_pictures(const Judged& judged, gallery::ReportCell& made) const {
    const std::vector<std::string>& files = pairing_.rows[judged.row].files;
    for (std::size_t set = 0; set < files.size(); ++set) {
      if (files[set].empty() || (set != kReferenceSet && pairing_.is_reference(set)) ||
          made.cell.find_image(set_name(set)))
        continue;
      try {
        const Picture picture = read_picture(
            files[set], set == kReferenceSet ? job_.layers.layer.b : job_.layers.layer.a);
        add_image(
            set, files[set], picture, reading_facts(picture.source),
            made.cell.record.exposure_stops.value_or(exposure_for_peak(peak_value(picture.image))),
            made);
      } catch (const Error& error) {
        if (error.code() != ExitCode::kInput) throw;
        if (std::ranges::none_of(made.cell.record.problems, [&](const auto& problem) {
              return problem.message.find(files[set]) != std::string::npos;
            }))
          made.cell.record.problems.push_back({set_name(set), printable_path(error.what()), "", 0});
      }
    }
  }

  const CompareJob& job_;
  const Pairing& pairing_;
  const std::vector<Judged> rows_;
  std::map<std::string, const Judged*> by_id_;
};

/// The share of its usual size that each pair may take in a single file, so that the file can be sent.
double share_for_one_file(const SetReport& report) {
  constexpr double kMostBytes = 64 << 20, kOfPair = 512 << 10, kOfPixels = 512 * 512;
  double bytes = 0;
  for (const PairReport& pair : report.pairs)
    if (pair.sources)
      bytes += kOfPair * std::max(1.0, double(pair.sources->b.display.width) *
                                           pair.sources->b.display.height / kOfPixels);
  return std::min(1.0, kMostBytes / std::max(bytes, 1.0));
}

/// The page that the reader opens.
fs::path index_of(const HtmlReport& html) {
  return html.single_file && html.path.extension() == ".html" ? html.path
                                                              : html.path / "index.html";
}

}  // namespace

void require_place(const HtmlReport& html) {
  const fs::path index = index_of(html);
  if (index.has_parent_path()) make_directories(index.parent_path());
  if (!html.single_file && gallery::kind_of_site(html.path) != gallery::SiteKind::kReport)
    for (const fs::path& file : {index, html.path / gallery::kSiteList})
      if (file_type_at(file, ExitCode::kOutput) != fs::file_type::not_found)
        throw Error(ExitCode::kOutput,
                    "{}: is there already, and not of a report; choose another folder",
                    printable_path(file.string()));
  require_writable(index);
}

void write_html(const HtmlReport& html, const CompareJob& job, const Pairing& pairing,
                const SetReport& report) {
  gallery::GalleryOptions options = gallery_options();
  if (!job.comparison.crop)  // the mask of a cut has another size
    options.region = [&](const Image& a, const Image& b) {
      ComparisonOptions parts = job.comparison;
      job.parts.apply(b.width(), b.height(), parts);
      return highlight_region(a, b, parts.mask);
    };
  ReportWriter writer(job, pairing, report);
  gallery::Report site;
  site.farm = writer.farm(html, options.metrics);
  for (const auto& [outcome, number, words] : counted_outcomes(report))
    site.farm.counts.emplace_back(number, words);
  site.cell = [&](const gallery::CellEntry& entry) { return writer.cell(entry); };
  const bool one = is_one_pair(pairing);
  site.files[one ? "comparison.json" : "comparison-set.json"] =
      one ? record_text(pair_record(report.pairs.front())) : record_text(set_record(report));
  const fs::path index = index_of(html);
  if (html.single_file) {
    const TemporaryDirectory scratch;
    options.site = scratch.path();
    options.share_of_bytes = share_for_one_file(report);
    site.only_small_pictures = true;
    write_report(site, options);
    write_file(index, gallery::single_file(scratch.path(), site.farm.record.title));
  } else {
    options.site = html.path;
    write_report(site, options);
  }
  say("lobelia: report: {}\n", printable_path(index.string()));
}

}  // namespace lobelia::cli
