// docs/models.md: every model and lobe, from the catalogues, with charts of what the program computes.
#include <fmt/format.h>

#include <numbers>

#include "base/words/svg_chart.hpp"
#include "program/command/manual/manual_tables.hpp"
#include "renderer/albedo.hpp"
#include "renderer/lobe_properties.hpp"

namespace lobelia::cli {
namespace {

constexpr double kOneDegree = std::numbers::pi / 180;
/// Where lobes are measured; `lobelia models` has the same.
constexpr double kMeasured = 64;

constexpr std::string_view kBegin = R"(# Models and lobes

<!-- Made by `lobelia manual --docs docs`; a test keeps the two the same. -->

For anyone who needs the formula of a highlight. Every model and lobe of the catalogue is here, as the program computes it.
`lobelia models` prints the same with costs and measurements, at any exponent. [Conventions](conventions.md) defines directions
and units, [the paper's formulas](paper.md) shows what the paper prints.

A highlight is a lobe $\ell(s)$ times a constant $C$. The lobe is 1 in the middle of the highlight and 0 for $s \ge 1$.

- $s$ is 1 minus the cosine of the lobe's angle. In the Phong family, $s = 1 - L \cdot R$. In the Blinn family, $s = 1 - N \cdot H$.
- $n$ is the exponent.
- $E$ is the irradiance on a plane normal to the beam. $L_o$ is the radiance towards the eye. It is 0 where $N \cdot L \le 0$.

## Models

Each model states an integral. Its exact *normalisation constant* $C$ makes that integral 1, for any lobe. It is computed from
the moments of the lobe, $M_j = \int_0^S \ell(s)\, s^j\, ds$. The *coefficient* is the whole factor of the lobe in $L_o$: a quarter
of $C$ where the lobe is a distribution of normals, else $C$. The normalisation `paper` has the constant that the paper prints, misprints
included ([the paper's formulas](paper.md#coefficients)).

The charts show what becomes of energy at other angles. *Eye* is the radiance towards an eye at this angle, under a uniform sky
of radiance 1. *Light* is the share of a beam from this angle that is reflected. For a reciprocal model both are the same curve.
A model with a value above 1 reflects more than arrives.
)";

std::string display(const std::string& formula) { return fmt::format("$$\n{}\n$$\n", formula); }
std::string inline_formula(std::string_view formula) { return fmt::format("${}$", latex(formula)); }

Chart small_chart(std::string id, std::string title, std::string description) {
  Chart chart;
  chart.id = std::move(id);
  chart.title = std::move(title);
  chart.description = std::move(description);
  chart.width = 760;
  chart.height = 360;
  return chart;
}

/// Draws the chart to a file, and returns the image that shows it on the page.
std::string picture(const Chart& chart, Files& files) {
  const std::string path = fmt::format("images/{}.svg", chart.id);
  files[path] = draw_chart_file(chart);
  return fmt::format("![{}]({})\n", chart.title, path);
}

template <class F>
ChartSeries curve(std::string label, int style, double to, double step, F value) {
  ChartSeries series;
  series.label = std::move(label);
  series.style = style;
  for (double x = 0; x <= to + step / 2; x += step) {
    series.x.push_back(x);
    series.y.push_back(value(x * kOneDegree));
  }
  return series;
}

bool is_reciprocal(const Highlight& highlight) { return reciprocity_gap(highlight) < 1e-9; }

Chart albedo_chart(ModelId model) {
  Chart chart = small_chart(fmt::format("albedo_{}", info(model).name),
                            fmt::format("Albedo of {} with the cosine lobe", info(model).title),
                            "The directional albedo by the angle from the normal.");
  chart.x = {"angle from the normal (degrees)", 0, 90};
  chart.y = {"albedo", 0, 1.6};
  int style = 0;
  for (const double n : {16., 64.}) {
    const Highlight highlight{model, *find_lobe("cosine"), Normalisation::kExact, n};
    const bool same = is_reciprocal(highlight);
    chart.series.push_back(curve(fmt::format("n = {}{}", n, same ? "" : ", eye"), ++style, 89, 1,
                                 [&](double x) { return directional_albedo(highlight, x); }));
    if (!same)
      chart.series.push_back(curve(fmt::format("n = {}, light", n), ++style, 89, 1, [&](double x) {
        return directional_albedo_of_light(highlight, x);
      }));
  }
  return chart;
}

/// "coef 2 pi integral of lobe(x) sin x, x = 0..pi/2", made 1.
std::string integral(const ModelInfo& model) {
  constexpr std::string_view kOf = "integral of ", kTo = " = 0..pi/2";
  const std::string_view text = model.integral;
  const std::size_t of = text.find(kOf), comma = text.rfind(", ");
  const std::string_view body = text.substr(of + kOf.size(), comma - of - kOf.size());
  const std::string_view variable = text.substr(comma + 2, text.find(kTo) - comma - 2);
  return fmt::format(R"(2 \pi\, C \int_0^{{\pi/2}} {}\, d{} = 1)", latex(body), variable);
}

std::string radiance(const ModelInfo& model) {
  if (model.has_shadowing) return R"(L_o = \frac{C\, \ell(s)\, G}{4\, (N \cdot V)}\, E)";
  std::string formula = "L_o = ";
  if (model.normalised != NormalisedQuantity::kRadiance) formula += R"(\frac{1}{4}\, )";
  formula += R"(C\, \ell(s)\, )";
  if (model.applies_cosine) formula += R"((N \cdot L)\, )";
  return formula + "E";
}

std::string_view conserved(NormalisedQuantity quantity) {
  switch (quantity) {
    case NormalisedQuantity::kRadiance:
      return "The energy that leaves at normal incidence is 1.";
    case NormalisedQuantity::kNormals:
      return "The integral of the distribution $D = C\\, \\ell$ over the hemisphere of normals is 1.";
    case NormalisedQuantity::kProjectedNormals:
      return "The projected area of the distribution's microfacets, the integral of $D\\, (N \\cdot H)$, is 1. "
             "Here $D = C\\, \\ell$.";
  }
  return "";
}

/// "1/(2 pi (M0 - M1)), s = 0 to 1".
std::string exact_constant(ModelId id) {
  const std::string text = exact_formula(id);
  const std::string_view to = ", s = 0 to ";
  const std::size_t at = text.find(to);
  return fmt::format("C = {}, \\quad S = {}", latex(text.substr(0, at)),
                     latex(text.substr(at + to.size())));
}

std::string measured(ModelId id) {
  const Highlight highlight{id, *find_lobe("cosine"), Normalisation::kExact, kMeasured};
  const AlbedoPeak light = largest_albedo_of_light(highlight);
  return fmt::format(
      "With the cosine lobe at n = {}, the albedo at normal incidence is {:.4f}. {}, and the model is {}.\n",
      kMeasured, directional_albedo(highlight, 0),
      light.above_one_from
          ? fmt::format("From {:.1f} degrees on, more of a beam is reflected than arrives",
                        *light.above_one_from / kOneDegree)
          : "It exceeds 1 at no angle",
      is_reciprocal(highlight) ? "reciprocal" : "not reciprocal");
}

std::string section(ModelId id, Files& files) {
  const ModelInfo& model = info(id);
  const ConstantFormulas coefficients = formulas(id);
  std::string text =
      fmt::format("\n### {}\n\n`{}`. The lobe's angle is that of {}.\n\n", model.title, model.name,
                  model.angle == LobeAngle::kReflection ? "L from R, the mirror direction of V"
                                                        : "N from H, the half vector");
  text += display(radiance(model));
  if (model.has_shadowing)
    text += "\n$G$ is Smith's shadowing and masking for GGX, with $\\alpha^2 = 2 / (n + 2)$.\n";
  text += fmt::format("\n*Conserves*: {} {}\n", conserved(model.normalised), measured(id));
  text += display(integral(model)) + "\n*Normalisation constant of any lobe*:\n\n" +
          display(exact_constant(id));
  text += fmt::format(
      "\n| lobe | normalisation constant |\n|---|---|\n| cosine, exact | {} |\n| cosine, as the paper prints it | {} |\n"
      "| cs16, as the paper prints it | {} |\n",
      inline_formula(coefficients.exact_cosine), inline_formula(coefficients.paper_cosine),
      inline_formula(coefficients.paper_cs16));
  text += fmt::format("\n*Source*: {}\n\n", model.source);
  return text + picture(albedo_chart(id), files);
}

Chart lobe_chart(std::span<const LobeId> members) {
  const std::string_view name = family(members.front());
  Chart chart =
      small_chart(fmt::format("lobe_{}", name),
                  fmt::format("{}, n = {}", family_info(members.front()).title, kMeasured),
                  "The lobe's value by its angle, on a logarithmic scale.");
  chart.x = {"angle (degrees)", 0, 45};
  chart.y = {"value, of the peak", 1e-4, 1, true};
  const auto add = [&](const LobeId& lobe, std::string_view label, int style) {
    chart.series.push_back(curve(std::string(label), style, 45, 0.25, [&](double angle) {
      return lobe_value(lobe, versine(angle), kMeasured);
    }));
  };
  if (name != "cosine") add(*find_lobe("cosine"), "cosine", 0);
  // A chart has five styles.
  for (std::size_t i = 0; i < std::min<std::size_t>(members.size(), 5); ++i)
    add(members[i], info(members[i]).name, int(i) + 1);
  return chart;
}

std::string moments(const LobeInfo& lobe) {
  if (lobe.moments.find('(') == std::string_view::npos)
    return fmt::format("*Moments*: {}.\n", lobe.moments);
  return display(fmt::format("M_j = {}", latex(lobe.moments)));
}

std::string measurement(const LobeId& lobe) {
  const LobeProperties p = measure(lobe, kMeasured);
  const auto difference = [](double value) {
    return value < 1e-12 ? std::string("0") : fmt::format("{:.2g}", value);
  };
  return fmt::format("| `{}` | {} | {:.3f} | {:.1f} | {} | {} |\n", info(lobe).name,
                     lobe.order ? std::to_string(lobe.order) : "", p.half_width / kOneDegree,
                     p.support / kOneDegree, difference(p.above_cosine),
                     difference(p.below_cosine));
}

/// A lobe, or the members of a family.
std::string section(std::span<const LobeId> members, Files& files) {
  const LobeInfo& lobe = family_info(members.front());
  std::string text = fmt::format("\n### {}\n\n", lobe.title);
  text += display(fmt::format("\\ell(s) = {}", latex(lobe.formula)));
  text += "\n" + moments(lobe);
  text += fmt::format("\n*Source*: {}\n\n", lobe.source);
  // The members' own formulas, where the family's formula only names their coefficients.
  std::string written;
  for (const LobeId& member : members)
    if (info(member).formula.size() > 2 * lobe.formula.size())
      written += fmt::format("{}: {}\n", info(member).name, info(member).formula);
  if (!written.empty()) text += fmt::format("```\n{}```\n\n", written);
  text += fmt::format(
      "| lobe, n = {} | k | half-width, degrees | 0 beyond, degrees | most above the cosine | most below |\n"
      "|---|---|---|---|---|---|\n",
      kMeasured);
  for (const LobeId& member : members) text += measurement(member);
  return text + "\n" + picture(lobe_chart(members), files);
}

}  // namespace

Files models_documentation() {
  Files files;
  std::string page(kBegin);
  for (const ModelId id : all_models()) page += section(id, files);
  page +=
      "\n## Lobes\n\nThe incomplete beta function is "
      "$\\mathrm{B}(x; a, b) = \\int_0^x t^{a-1} (1 - t)^{b-1}\\, dt$, the lower incomplete gamma function\n"
      "$\\gamma(a, x) = \\int_0^x t^{a-1} e^{-t}\\, dt$. Differences from the cosine lobe are shares of the peak. A scene may "
      "give a lobe of its own as\n[a formula](scene_format.md#a-lobe-by-its-formula).\n";
  const std::span<const LobeId> lobes = all_lobes();
  for (std::size_t from = 0, to = 0; from < lobes.size(); from = to) {
    while (to < lobes.size() && lobes[to].index == lobes[from].index) ++to;
    page += section(lobes.subspan(from, to - from), files);
  }
  files["models.md"] = page;
  return files;
}

}  // namespace lobelia::cli
