// The page on the paper's claims, measured.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/records/paper.hpp"
#include "base/words/svg_chart.hpp"
#include "base/words/text.hpp"
#include "gallery/pages/page.hpp"
#include "gallery/pages/page_text.hpp"
#include "gallery/pages/views.hpp"

namespace lobelia::gallery::paper_page {
namespace {

using records::Claim, records::PaperFigure, records::VerifyPaper;

/// The claim that a reader would be most surprised to see fail.
constexpr std::string_view kMostSurprising = "energy-cs16";
constexpr char kRecord[] = "paper/paper.json";
constexpr char kTitle[] = "The paper's claims, measured";

struct VerdictInfo {
  const char *name, *class_name, *mark, *word;
};
constexpr VerdictInfo kVerdicts[] = {{"confirmed", "pass", "✓", "confirmed"},
                                     {"not reproduced", "differs", "≠", "not reproduced"},
                                     {"found", "unchecked", "+", "found beyond the paper"}};

constexpr int kLastStyle = 5;

const VerdictInfo& verdict_of(const Claim& claim) {
  return *std::ranges::find_if(kVerdicts,
                               [&](const VerdictInfo& v) { return claim.verdict == v.name; });
}

/// The id on the page, by the claim's place in the record.
std::string id_of(const Claim& claim, const std::vector<Claim>& claims) {
  return fmt::format("claim-{}", &claim - claims.data() + 1);
}

void require_drawable(records::ChartAxis& axis) {
  const bool is_drawable = std::abs(axis.from) <= kLargestDrawn &&
                           std::abs(axis.to) <= kLargestDrawn && axis.from < axis.to &&
                           (!axis.logarithmic.value_or(false) || axis.from >= kSmallestDrawn);
  if (!is_drawable)
    throw Error(ExitCode::kInput, "{}: the axis '{}' cannot be drawn", kRecord,
                printable(axis.label));
  std::erase_if(axis.ticks, [&](double tick) { return !(tick >= axis.from && tick <= axis.to); });
}

/// The figure clipped to its axes, with its id on the page. Throws Error(kInput) for axes that cannot be drawn.
PaperFigure drawable(PaperFigure figure, std::size_t number) {
  figure.id = fmt::format("plot-{}", number);
  require_drawable(figure.x);
  require_drawable(figure.y);
  for (records::ChartBand& band : figure.bands) {
    band.from = std::max(figure.x.from, band.from);
    band.to = std::min(figure.x.to, band.to);
  }
  std::erase_if(figure.bands, [](const auto& band) { return !(band.from < band.to); });
  for (std::string* text : {&figure.title, &figure.description, &figure.x.label, &figure.y.label})
    *text = math_text(*text);
  for (records::ChartSeries& series : figure.series) {
    series.name = math_text(series.name);
    series.style = std::clamp(series.style, 0, kLastStyle);
  }
  return figure;
}

Chart chart_of(const PaperFigure& figure) {
  const auto axis = [](const records::ChartAxis& a) {
    return ChartAxis{a.label, a.from, a.to, a.logarithmic.value_or(false), a.ticks};
  };
  Chart chart{.id = figure.id,
              .title = figure.title,
              .description = figure.description,
              .width = 760,
              .height = 400,
              .x = axis(figure.x),
              .y = axis(figure.y)};
  for (const auto& [title, from, to] : figure.bands) chart.bands.push_back({from, to, title});
  for (const auto& [name, style, x, y] : figure.series) chart.series.push_back({name, x, y, style});
  return chart;
}

bool shows(const PaperFigure& figure, const Claim& claim) {
  return std::ranges::find(figure.claims, claim.name) != figure.claims.end();
}

void write_counts(Html& html, const std::vector<Claim>& claims) {
  const Tag list(html, "ul", {{"class", "counts"}});
  for (const VerdictInfo& verdict : kVerdicts) {
    const Tag item(html, "li");
    html.element("strong",
                 std::to_string(std::ranges::count(claims, verdict.name, &Claim::verdict)));
    html.text(" ");
    write_badge(html, verdict.class_name, verdict.mark, verdict.word);
  }
}

void write_measured(Html& html, const Claim& claim) {
  const Tag list(html, "ul", {{"class", "measured"}});
  for (const records::Measured& figure : claim.measured) {
    const Tag item(html, "li");
    write_math(html, figure.what + ": ");
    math_element(html, "strong", figure.text);
    if (!figure.at.empty()) math_element(html, "small", " at " + figure.at);
  }
}

void write_links(Html& html, const std::string& words,
                 const std::vector<std::pair<std::string, std::string>>& links) {
  if (links.empty()) return;
  const Tag line(html, "p", {{"class", "shown-by"}});
  html.text(words);
  for (std::size_t i = 0; i < links.size(); ++i) {
    if (i > 0) html.text(", ");
    math_element(html, "a", {{"href", "#" + links[i].first}}, links[i].second);
  }
}

/// A text with a link in place of the name of each other claim.
void write_reference(Html& html, std::string_view text, const std::vector<Claim>& claims) {
  const auto is_name = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '-';
  };
  std::size_t shown = 0;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end =
        std::ranges::find_if_not(text.substr(at), is_name) - text.substr(at).begin() + at;
    const std::string_view name = text.substr(at, end - at);
    const auto claim =
        name.find('-') == name.npos ? claims.end() : std::ranges::find(claims, name, &Claim::name);
    if (claim != claims.end()) {
      write_math(html, text.substr(shown, at - shown));
      html.text("“");
      math_element(html, "a", {{"href", "#" + id_of(*claim, claims)}}, claim->statement);
      html.text("”");
      shown = end;
    }
    at = std::max(end, at + 1);
  }
  write_math(html, text.substr(shown));
}

void write_claim(Html& html, const Claim& claim, const std::string& id,
                 const std::vector<PaperFigure>& figures, const std::vector<Claim>& claims) {
  const Tag article(html, "article",
                    {{"class", "claim"}, {"id", id}, {"data-verdict", claim.verdict}});
  math_element(html, "h3", claim.statement);
  {
    const Tag line(html, "p", {{"class", "verdict-line"}});
    const VerdictInfo& verdict = verdict_of(claim);
    write_badge(html, verdict.class_name, verdict.mark, verdict.word);
    math_element(html, "span", {{"class", "where"}}, claim.where);
  }
  {
    const Tag pair(html, "dl", {{"class", "printed-measured"}});
    if (!claim.printed.empty()) {
      const Tag printed(html, "div");
      html.element("dt", "printed");
      math_element(html, "dd", claim.printed);
    }
    const Tag item(html, "div");
    html.element("dt", "measured");
    const Tag value(html, "dd");
    write_measured(html, claim);
  }
  if (!claim.reason.empty()) {
    const Tag reason(html, "p");
    write_reference(html, claim.reason, claims);
  }
  std::vector<std::pair<std::string, std::string>> links;
  for (const PaperFigure& figure : figures)
    if (shows(figure, claim)) links.push_back({figure.id + "-figure", figure.title});
  write_links(html, "Drawn in: ", links);
  const Tag details(html, "details");
  html.element("summary", "How it is measured");
  const Tag definition(html, "p");
  write_reference(html, claim.definition, claims);
}

/// The verdicts of the claims that a figure shows.
std::string finding_of(const PaperFigure& figure, const std::vector<Claim>& claims) {
  std::string finding;
  for (const VerdictInfo& verdict : kVerdicts) {
    const auto count = std::ranges::count_if(claims, [&](const Claim& claim) {
      return shows(figure, claim) && claim.verdict == verdict.name;
    });
    if (count > 0)
      finding += fmt::format("{}{} {}", finding.empty() ? "" : ", ", count, verdict.word);
  }
  return finding.empty() ? "" : "Claims shown here: " + finding + ".";
}

void write_figure(Html& html, const PaperFigure& figure, const std::vector<Claim>& claims) {
  const Tag element(html, "figure", {{"class", "chart-figure"}, {"id", figure.id + "-figure"}});
  html.element("h3", figure.title);
  if (const std::string finding = finding_of(figure, claims); !finding.empty())
    html.element("p", {{"class", "finding"}}, finding);
  html.raw(draw_chart(chart_of(figure)));
  const Tag caption(html, "figcaption");
  html.text(figure.description);
  std::vector<std::pair<std::string, std::string>> links;
  for (const Claim& claim : claims)
    if (shows(figure, claim)) links.push_back({id_of(claim, claims), claim.statement});
  write_links(html, "Shows: ", links);
}

void write(ViewPage& page, const VerifyPaper& record, const RunFiles&) {
  const std::vector<Claim>& claims = record.claims;
  std::vector<PaperFigure> figures;
  for (const PaperFigure& figure : record.figures)
    figures.push_back(drawable(figure, figures.size() + 1));

  Html& html = page.main;
  write_lead(
      html, kTitle,
      "Every figure and claim of the paper that these lobes and models come from, recomputed in "
      "extended precision from its formulas as printed. A claim is confirmed where the measurement "
      "rounds to what is printed.");
  write_counts(html, claims);
  {
    const Tag section(html, "section", {{"class", "figures-section"}});
    html.element("h2", "The curves behind the claims");
    if (figures.empty())
      write_absence(html, "The record has none: 'lobelia verify paper --plots' draws them.");
    const Tag grid(html, "div", {{"class", "figure-grid"}});
    for (const PaperFigure& figure : figures) write_figure(html, figure, claims);
  }
  {
    const Tag section(html, "section", {{"class", "claims"}});
    html.element("h2", "Claim by claim");
    const Tag grid(html, "div", {{"class", "claim-grid"}});
    for (const Claim& claim : claims)
      write_claim(html, claim, id_of(claim, claims), figures, claims);
  }
  write_source(html, shell_join(record.command), kRecord);
  page.finding = fmt::format("Of the paper’s claims, {} hold and {} could not be reproduced.",
                             record.confirmed, record.not_reproduced);
  const auto surprise = std::ranges::find(claims, kMostSurprising, &Claim::name);
  if (surprise != claims.end() && surprise->verdict == "not reproduced")
    page.finding += fmt::format(" It says that {}, but {}.", surprise->statement, surprise->reason);
}

}  // namespace
}  // namespace lobelia::gallery::paper_page

namespace lobelia::gallery {
extern const View paper_view{"paper", "Paper", "paper.html",
                             page_of(paper_page::kRecord, paper_page::kTitle, paper_page::write)};
}
