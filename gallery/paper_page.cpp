#include "gallery/paper_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "core/chart_record.hpp"
#include "core/text.hpp"
#include "gallery/chart_data.hpp"
#include "gallery/page.hpp"
#include "gallery/record_page.hpp"

namespace lobelia::gallery {
namespace {

constexpr char kRecord[] = "paper/paper.json";
constexpr char kTitle[] = "The paper's claims, measured";

struct VerdictInfo {
  const char *name, *class_name, *mark, *word;
};
constexpr VerdictInfo kVerdicts[] = {{"confirmed", "pass", "✓", "confirmed"},
                                     {"not reproduced", "differs", "≠", "not reproduced"},
                                     {"found", "unchecked", "+", "found beyond the paper"}};

struct PaperFigure {
  Chart chart;
  std::vector<std::string> claims;
};

struct PaperClaim {
  const Fields* fields;
  std::string name, id;
  const VerdictInfo* verdict;
};

const VerdictInfo& verdict_of(const Fields& claim) {
  const std::string name = claim.text("verdict");
  const auto* found =
      std::ranges::find_if(kVerdicts, [&](const VerdictInfo& v) { return name == v.name; });
  if (found == std::end(kVerdicts))
    claim.fail("verdict", "must be confirmed, not reproduced or found");
  return *found;
}

void write_verdict(Html& html, const VerdictInfo& verdict) {
  const Tag badge(html, "span", {{"class", fmt::format("status {}", verdict.class_name)}});
  html.element("span", {{"aria-hidden", "true"}}, verdict.mark);
  html.text(fmt::format(" {}", verdict.word));
}

void write_counts(Html& html, const std::vector<PaperClaim>& claims) {
  const Tag list(html, "ul", {{"class", "counts"}});
  for (const VerdictInfo& verdict : kVerdicts) {
    const Tag item(html, "li");
    html.element("strong",
                 std::to_string(std::ranges::count(claims, &verdict, &PaperClaim::verdict)));
    html.text(" ");
    write_verdict(html, verdict);
  }
}

void write_measured(Html& html, const Fields& claim) {
  const Tag list(html, "ul", {{"class", "measured"}});
  for (const Fields& figure : claim.objects("measured")) {
    const Tag item(html, "li");
    html.text(figure.text("what") + ": ");
    html.element("strong", figure.text("text"));
    const std::string at = figure.text("at");
    if (!at.empty()) html.element("small", " at " + at);
  }
}

void write_links(Html& html, const std::string& words,
                 const std::vector<std::pair<std::string, std::string>>& links) {
  if (links.empty()) return;
  const Tag line(html, "p", {{"class", "shown-by"}});
  html.text(words);
  for (std::size_t i = 0; i < links.size(); ++i) {
    if (i > 0) html.text(", ");
    html.element("a", {{"href", "#" + links[i].first}}, links[i].second);
  }
}

void write_claim(Html& html, const PaperClaim& claim, const std::vector<PaperFigure>& figures) {
  const Fields& fields = *claim.fields;
  const Tag article(html, "article",
                    {{"class", "claim"}, {"id", claim.id}, {"data-verdict", claim.verdict->name}});
  {
    const Tag head(html, "h3");
    html.text(fields.text("statement"));
  }
  {
    const Tag line(html, "p", {{"class", "verdict-line"}});
    write_verdict(html, *claim.verdict);
    html.element("span", {{"class", "where"}}, fields.text("where"));
  }
  {
    const Tag pair(html, "dl", {{"class", "printed-measured"}});
    const std::string printed = fields.text("printed");
    if (!printed.empty()) {
      const Tag item(html, "div");
      html.element("dt", "printed");
      html.element("dd", printed);
    }
    const Tag item(html, "div");
    html.element("dt", "measured");
    const Tag value(html, "dd");
    write_measured(html, fields);
  }
  const std::string reason = fields.text("reason");
  if (!reason.empty()) html.element("p", reason);
  std::vector<std::pair<std::string, std::string>> links;
  for (const PaperFigure& figure : figures)
    if (std::ranges::find(figure.claims, claim.name) != figure.claims.end())
      links.push_back({figure.chart.id + "-figure", figure.chart.title});
  write_links(html, "Drawn in: ", links);
  const Tag details(html, "details");
  html.element("summary", "How it is measured");
  html.element("p", fields.text("definition"));
}

void write_figure(Html& html, const PaperFigure& figure, const std::vector<PaperClaim>& claims) {
  const Tag element(html, "figure",
                    {{"class", "chart-figure"},
                     {"id", figure.chart.id + "-figure"},
                     {"data-chart", figure.chart.id}});
  html.element("h3", figure.chart.title);
  html.raw(draw_chart(figure.chart));
  const Tag caption(html, "figcaption");
  html.text(figure.chart.description);
  std::vector<std::pair<std::string, std::string>> links;
  for (const PaperClaim& claim : claims)
    if (std::ranges::find(figure.claims, claim.name) != figure.claims.end())
      links.push_back({claim.id, claim.fields->text("statement")});
  write_links(html, "Shows: ", links);
}

void draw(ViewPage& page, const Fields& record) {
  const auto all = record.objects("claims");
  std::vector<PaperClaim> claims;
  for (std::size_t i = 0; i < all.size(); ++i)
    claims.push_back(
        {&all[i], all[i].text("name"), fmt::format("claim-{}", i + 1), &verdict_of(all[i])});
  std::vector<PaperFigure> figures;
  page.data["charts"] = Json::array();
  for (const Fields& fields : record.objects("figures")) {
    figures.push_back(
        {read_chart(fields, fmt::format("plot-{}", figures.size() + 1)), fields.texts("claims")});
    page.data["charts"].push_back(chart_record(figures.back().chart));
  }

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
    for (const PaperClaim& claim : claims) write_claim(html, claim, figures);
  }
  write_source(html, shell_join(record.texts("command")), kRecord);
}

}  // namespace

std::optional<ViewPage> paper_view(const std::filesystem::path& run) {
  return record_page(run, kRecord, "verify-paper", kTitle, draw);
}

}  // namespace lobelia::gallery
