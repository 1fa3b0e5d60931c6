#include "studies/paper/report.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>

#include "base/system/files.hpp"
#include "base/system/for_each_whole.hpp"
#include "studies/paper/energy.hpp"

namespace lobelia::paper {
namespace {

constexpr int kPoints = 300;
const std::vector<double> kExponentTicks{16, 32, 64, 128, 256, 512, 1024};

/// A curve of `f` from `from` to `to`, evenly spaced or, for an exponent, in equal ratios.
template <class F>
ChartSeries curve(std::string label, int style, const ChartAxis& x, F f) {
  ChartSeries series{std::move(label), {}, {}, style};
  for (int i = 0; i <= kPoints; ++i) {
    const double share = double(i) / kPoints;
    const double at =
        x.logarithmic ? x.from * std::pow(x.to / x.from, share) : x.from + (x.to - x.from) * share;
    series.x.push_back(at);
    series.y.push_back(double(f(Real(at))));
  }
  return series;
}

Chart chart(std::string id, std::string title, std::string description, ChartAxis x, ChartAxis y) {
  Chart result;
  result.id = std::move(id);
  result.title = std::move(title);
  result.description = std::move(description);
  result.width = 1080;
  result.height = 420;
  result.x = std::move(x);
  result.y = std::move(y);
  return result;
}

ChartAxis exponent_axis() { return {"exponent n", 16, 1024, true, kExponentTicks}; }

Chart cs16_error() {
  Chart result = chart("cs16-error", "cos^n − cs16: never below 0, at most 1.7 % of the peak",
                       "The difference of the two lobes over the angle, for four exponents.",
                       {"angle times √n (radians)", 0, 6}, {"cos^n − cs16", 0, 0.02});
  int style = 1;
  for (const int n : {1024, 64, 32, 20}) {
    const auto difference = [n](Real scaled) {
      const Real x = scaled / std::sqrt(Real(n));
      return x < kRightAngle ? cosine_lobe(x, n) - cs16_lobe(x, n) : NAN;
    };
    result.series.push_back(curve(fmt::format("n = {}", n), style++, result.x, difference));
  }
  return result;
}

ChartSeries residual(const char* label, int style, const ChartAxis& x, RowNumber row, Cut cut) {
  return curve(label, style, x,
               [=](Real n) { return energy(kRows[row], Lobe::kCs16, n, cut) - 1; });
}

Chart residuals() {
  Chart result = chart("residuals", "Energy − 1 of the cs16 column, rows 1 to 3",
                       "Reflected energy at normal incidence with the printed coefficients.",
                       exponent_axis(), {"energy − 1", -0.002, 0.006});
  const ChartAxis& x = result.x;
  result.series = {
      residual("Phong (RDF)", 1, x, kPhong, Cut::kSupport),
      residual("modified Phong", 2, x, kModifiedPhong, Cut::kSupport),
      residual("Blinn-Phong (RDF)", 3, x, kBlinn, Cut::kSupport),
      residual("the same, cut at 6/√n", 4, x, kBlinn, Cut::kPrinted),
  };
  return result;
}

Chart residual_of_row_4() {
  Chart result = chart("residual-row-4", "Energy − 1 of the cs16 column, row 4",
                       "Reflected energy of modified Blinn-Phong at normal incidence.",
                       exponent_axis(), {"energy − 1", -0.06, 0.02});
  const ChartAxis& x = result.x;
  result.series = {
      residual("modified Blinn-Phong", 1, x, kModifiedBlinn, Cut::kSupport),
      residual("the same, cut at 6/√n", 4, x, kModifiedBlinn, Cut::kPrinted),
      // One line in two pieces: a value that is not a number is a gap.
      {"the paper: within ±9.5e-3 of 0",
       {16, 1024, NAN, 16, 1024},
       {-9.5e-3, -9.5e-3, NAN, 9.5e-3, 9.5e-3},
       0},
  };
  return result;
}

constexpr double kExponentOfLobes = 64;

Real radians(Real degrees) { return degrees * kPi / 180; }

/// As docs/profiles.md defines them.
std::vector<ChartBand> zones() {
  const auto reach = [](double level) {
    return double(degrees(std::acos(std::pow(level, 1 / kExponentOfLobes))));
  };
  return {{0, reach(0.5), "epicentre"},
          {reach(0.5), reach(0.05), "flank"},
          {reach(0.05), reach(0.001), "blooming zone"}};
}

/// A curve of `f` of each cheap lobe and cos^n over the angle, with the zones.
Chart chart_of_lobes(Chart result, Real (*f)(Real lobe, Real cosine)) {
  struct Named {
    const char* label;
    Real (*lobe)(Real, Real);
  };
  result.bands = zones();
  int style = 1;
  for (const auto& [label, lobe] :
       {Named{"cs16", cs16_lobe}, {"Schlick", schlick_lobe}, {"Gauss", gauss_lobe}})
    result.series.push_back(curve(label, style++, result.x, [f, lobe = lobe](Real x) {
      return f(lobe(radians(x), kExponentOfLobes), cosine_lobe(radians(x), kExponentOfLobes));
    }));
  return result;
}

Chart lobes() {
  Chart result =
      chart_of_lobes(chart("lobes", "The four lobes at n = 64",
                           "cos^n, cs16, Schlick's lobe and the Gaussian over the angle.",
                           {"angle (degrees)", 0, 60}, {"lobe (log)", 1e-4, 10, true}),
                     [](Real lobe, Real) { return lobe; });
  const auto cosine = [](Real x) { return cosine_lobe(radians(x), kExponentOfLobes); };
  result.series.insert(result.series.begin(), curve("cos^n", 0, result.x, cosine));
  return result;
}

Chart lobe_errors() {
  return chart_of_lobes(chart("lobe-errors", "What the cheap lobes miss of cos^n at n = 64",
                              "The difference of each lobe from cos^n over the angle.",
                              {"angle (degrees)", 0, 60}, {"lobe − cos^n", -0.05, 0.25}),
                        [](Real lobe, Real cosine) { return lobe - cosine; });
}

Chart albedos(Held held, Chart result) {
  constexpr Real kExponent = 64;
  int style = 1;
  for (const RowNumber number : {kPhong, kModifiedPhong, kBlinn, kModifiedBlinn, kNdf}) {
    const Row& row = kRows[number];
    const Real coefficient = true_cosine_column(row, kExponent);
    result.series.push_back(curve(std::string(row.title), style++, result.x, [&](Real x) {
      return albedo(row, Lobe::kCosine, kExponent, coefficient, double(radians(x)), held);
    }));
  }
  return result;
}

}  // namespace

std::vector<Plot> plots() {
  static const ChartAxis incidence{"incidence (degrees)", 0, 89.5};
  struct Drawn {
    const char* file;
    Chart (*draw)();
    std::vector<std::string_view> claims;
  };
  const std::vector<Drawn> all{
      {"cs16_error.svg", cs16_error, {"cs16-largest-error", "cs16-smallest-error"}},
      {"residuals.svg",
       residuals,
       {"residual-phong-rdf", "residual-modified-phong", "residual-blinn-phong-rdf",
        "residual-blinn-phong-rdf-cut"}},
      {"residual_row_4.svg", residual_of_row_4, {"residual-modified-blinn-phong"}},
      {"lobes.svg", lobes, {"cs16-tail", "schlick-epicentre", "schlick-tail", "gauss-accuracy"}},
      {"lobe_errors.svg", lobe_errors, {"schlick-epicentre", "gauss-accuracy"}},
      {"albedo_lit.svg",
       [] {
         return albedos(Held::kBeam,
                        chart("albedo-lit", "A beam's power that is reflected, n = 64, cos^n",
                              "Reflected over arriving power over the angle of incidence.",
                              incidence, {"share reflected", 0, 2}));
       },
       {"energy-brdf", "energy-rdf-lit"}},
      {"albedo_seen.svg",
       [] {
         return albedos(Held::kEye,
                        chart("albedo-seen", "Seen in surroundings of radiance 1, n = 64, cos^n",
                              "Radiance seen over the angle of the eye from the normal.",
                              {"angle of the eye (degrees)", 0, 89.5}, {"radiance", 0, 1.2}));
       },
       {"energy-rdf-seen", "energy-brdf"}},
  };
  std::vector<Plot> drawn(all.size());
  for_each_whole(all.size(), [&](std::size_t i) {
    drawn[i] = {all[i].file, all[i].draw(), all[i].claims};
  });
  return drawn;
}

namespace {

/// More digits than a drawing shows would only lengthen the record.
std::vector<double> rounded(std::vector<double> values) {
  for (double& value : values)
    if (std::isfinite(value)) value = std::strtod(fmt::format("{:.6g}", value).c_str(), nullptr);
  return values;
}

records::ChartAxis axis_record(const ChartAxis& axis) {
  return {axis.label, axis.from, axis.to, axis.logarithmic ? std::optional(true) : std::nullopt,
          axis.ticks};
}

records::PaperFigure figure_record(const Plot& plot) {
  const Chart& chart = plot.chart;
  records::PaperFigure record;
  record.id = chart.id;
  record.title = chart.title;
  record.description = chart.description;
  record.x = axis_record(chart.x);
  record.y = axis_record(chart.y);
  for (const ChartBand& band : chart.bands)
    record.bands.push_back({band.label, band.from, band.to});
  for (const ChartSeries& series : chart.series)
    record.series.push_back({series.label, series.style, rounded(series.x), rounded(series.y)});
  record.claims.assign(plot.claims.begin(), plot.claims.end());
  return record;
}

}  // namespace

std::vector<records::PaperFigure> figure_records(std::span<const Plot> plots) {
  std::vector<records::PaperFigure> figures;
  for (const Plot& plot : plots) figures.push_back(figure_record(plot));
  return figures;
}

void write_plots(const std::filesystem::path& directory, std::span<const Plot> plots) {
  make_directories(directory);
  for (const Plot& plot : plots) write_file(directory / plot.file, draw_chart_file(plot.chart));
}

}  // namespace lobelia::paper
