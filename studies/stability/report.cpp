#include "studies/stability/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <iterator>

#include "base/system/for_each_whole.hpp"
#include "base/system/interrupt.hpp"
#include "reference_scenes/engines/analytic/formulas/truth.hpp"
#include "renderer/kernels/kernels.hpp"
#include "studies/stability/naive.hpp"
#include "studies/stability/vectors.hpp"
#include "studies/table.hpp"

namespace lobelia::stability {
namespace {

using studies::Column;
using studies::Table;

struct Meaning {
  std::string_view group;
  std::string_view begins;  ///< the start of a case's name; empty: the group itself
  std::string_view words;
};

/// The first match counts.
constexpr Meaning kMeanings[] = {
    {"lobe", "", "The lobe alone in float32, at a given 1 - cos of its angle."},
    {"lobe", "angle 1e-8", "A cosine in float32 cannot tell this angle from 0."},
    {"lobe", "angle 1e-4", "A cosine in float32 knows this angle to one digit."},
    {"lobe", "half of the peak", "The flank, where an error of the angle counts most."},
    {"lobe", "just inside theta_cr", "The last number before a lobe of finite reach ends."},
    {"lobe", "inside theta_cr", "Close to where a lobe of finite reach ends."},
    {"lobe", "just outside theta_cr",
     "A negative base, raised to an even power, must give nothing."},
    {"lobe", "angle pi/2", "The horizon: the base of cos^n is 0."},
    {"lobe", "angle 2", "Beyond the horizon there is nothing, whatever the power says."},
    {"coefficient", "", "The number before the lobe, by closed form or by moments of the lobe."},
    {"coefficient", "smallest n", "A difference of two numbers that are nearly the same."},
    {"coefficient", "(n+2)(n+4)", "A product that float32 cannot hold, in a quotient that it can."},
    {"vectors", "", "Normal, eye and light as vectors, to the value of the highlight."},
    {"vectors", "mirror direction", "The peak itself, with vectors that are not along an axis."},
    {"vectors", "flank", "One width of the highlight away from its middle."},
    {"vectors", "dot product",
     "A dot product of unit vectors that rounds past 1: a power of it grows."},
    {"vectors", "L = -V", "The half vector of opposite directions: 0 divided by 0, or nearly."},
    {"vectors", "N.L", "The light at the horizon, and the next numbers above and below."},
    {"vectors", "N.V", "The eye at the horizon, and the next numbers above and below."},
    {"vectors", "R.L", "The light behind the lobe's hemisphere: nothing is to be seen."},
    {"vectors", "lengths", "The squared length underflows or overflows float32."},
    {"vectors", "denormal", "Components below the smallest normal number of their format."},
    {"density", "",
     "The density of samples, down to where it underflows: never denormal, never below 0."},
    {"spheres", "",
     "Whole pictures of spheres: the right sphere in every pixel, and the right radiance."},
    {"spheres", "radius 1e6, from", "An eye so close that the sphere is all but a plane."},
    {"spheres", "radius", "The quadratic formula must not care in which unit the scene is."},
    {"spheres", "1e7 radii", "b^2 - c cancels to nothing: float32 misses the sphere."},
    {"spheres", "two concentric", "Which sphere is seen, and whether it shades the other."},
    {"spheres", "the same sphere", "Two surfaces in one place must not shade each other."},
    {"spheres", "two spheres that touch", "A shadow ray that begins on both surfaces."},
    {"spheres", "light inside", "Nothing is lit from within."},
    {"spheres", "light just above", "Irradiance is largest where digits are fewest."},
    {"spheres", "light at a right angle", "The highlight is at the terminator."},
    {"spheres", "light behind", "The light grazes the silhouette."},
    {"spheres", "camera inside", "Spheres are seen from outside only."},
    {"spheres", "tangent ray", "Rays that touch a sphere, and the next numbers on either side."},
    {"float16", "",
     "All in half floats, as on a phone, and the textbook too: its cosine has lost the angle, its power may exceed 1."},
    {"precision", "",
     "1e5 random vectors and the worst of them made worse, against the stated bound."},
};

/// The meaning of a case, or of a group without a name. Empty if the name says it.
std::string_view meaning(std::string_view group, std::string_view name = "") {
  for (const Meaning& m : kMeanings)
    if (m.group == group && m.begins.empty() == name.empty() && name.starts_with(m.begins))
      return m.words;
  if (group == "lobe" && name.ends_with("times the smallest float32"))
    return "A result that is about to be no normal number any more.";
  return "";
}

void widen(records::StabilityErrors& worst, const Answer& other) {
  worst.ulp = std::max(worst.ulp, other.ulp);
  worst.of_peak = std::max(worst.of_peak, other.of_peak);
  worst.wrong_pixels += other.wrong_pixels;
}

/// The worst of the rows with the same summary by `make`, in the order of the rows.
template <class Summary, class Make, class Same>
std::vector<Summary> summarise(const Rows& rows, Make make, Same same) {
  std::vector<Summary> summaries;
  for (const Row& row : rows) {
    const Summary wanted = make(row);
    auto found = std::ranges::find_if(
        summaries, [&](const Summary& s) { return s.group == row.group && same(s, wanted); });
    if (found == summaries.end()) found = summaries.insert(summaries.end(), wanted);
    ++found->cases;
    found->outside += row.outcome == kOutside;
    found->not_compared += row.outcome == kNotCompared;
    widen(found->naive, row.naive);
    widen(found->ours, row.ours);
    found->of_bound = std::max(
        {found->of_bound, row.ours.of_peak / row.bound.of_peak, row.ours.ulp / row.bound.ulp});
  }
  return summaries;
}

std::vector<records::StabilityOfLobe> by_lobe(const Rows& rows, bool and_exponent) {
  using Summary = records::StabilityOfLobe;
  return summarise<Summary>(
      rows,
      [&](const Row& row) {
        Summary s;
        s.group = row.group;
        s.lobe = row.lobe;
        if (and_exponent) s.exponent = row.exponent;
        return s;
      },
      [](const Summary& a, const Summary& b) {
        return a.lobe == b.lobe && a.exponent == b.exponent;
      });
}

std::vector<records::StabilityOfCase> by_case(const Rows& rows) {
  using Summary = records::StabilityOfCase;
  return summarise<Summary>(
      rows,
      [](const Row& row) {
        Summary s;
        s.group = row.group;
        s.name = row.name;
        s.meaning = meaning(row.group, row.name);
        return s;
      },
      [](const Summary& a, const Summary& b) { return a.name == b.name; });
}

constexpr int kPoints = 120;
constexpr double kEnd = 1e-3;  // of the peak

records::StabilityCurve error_curve(double n) {
  const Highlight h{*find_model("modified_phong"), *find_lobe("cosine"), Normalisation::kExact, n};
  records::StabilityCurve curve;
  curve.exponent = n;
  curve.model = info(h.model).name;
  curve.lobe = info(h.lobe).name;
  // (2, 13, 31) is the mirror direction of (2, 3, 1) about (1, 2, 2), exactly; (13, -2, 0) is square to it.
  const Vec3 normal{1, 2, 2}, eye{2, 3, 1}, mirror{2, 13, 31}, beside{13, -2, 0};
  const double reach = std::acos(std::pow(kEnd, 1 / n));
  for (int i = 0; i <= kPoints; ++i) {
    const double angle = reach * i / kPoints;
    const Vec3 light = mirror + std::tan(angle) * length(mirror) / length(beside) * beside;
    double bound = 0;
    curve.degrees.push_back(angle * 180 / kPi);
    curve.truth.push_back(truth::shape(h, normal, eye, light));
    curve.naive.push_back(naive::shape(h, normal, eye, light));
    curve.ours.push_back(by_kernel(h, screen(info(h.model).angle, {normal, eye, light}), bound));
  }
  return curve;
}

template <class Summary>
std::string summary_text(const std::vector<Summary>& summaries, const std::string& first,
                         std::string Summary::*name) {
  Table table{"",
              {{first, -46},
               {"cases", 7},
               {"of peak", 9, "{:.2g}", 2, "naive float32"},
               {"ulp", 9, "{:.2g}"},
               {"pixels", 7},
               {"of peak", 9, "{:.2g}", 3, "ours"},
               {"ulp", 9, "{:.2g}"},
               {"pixels", 7},
               {"bound", 8, "{:.2f}", 2, " used of"},
               {"", 0, "", 2}},
              {}};
  std::string group;
  for (const Summary& s : summaries) {
    if (s.group != group) table.rows.push_back({group = s.group});
    table.rows.push_back({"  " + s.*name, double(s.cases), s.naive.of_peak, s.naive.ulp,
                          double(s.naive.wrong_pixels), s.ours.of_peak, s.ours.ulp,
                          double(s.ours.wrong_pixels), s.of_bound,
                          s.outside > 0        ? fmt::format("{} OUTSIDE", s.outside)
                          : s.not_compared > 0 ? fmt::format("{} not compared", s.not_compared)
                                               : std::string(kWithin)});
  }
  return table_text(table);
}

std::string rows_text(const Rows& rows) {
  Table table{"",
              {{"group", -12},
               {"case", -44},
               {"model", -24},
               {"lobe", -19},
               {"n", 7, "{:g}"},
               {"truth", 15, "{:.7g}"},
               {"naive", 15, "{:.7g}"},
               {"of peak", 10, "{:.2g}"},
               {"ulp", 10, "{:.2g}"},
               {"ours", 15, "{:.7g}"},
               {"of peak", 10, "{:.2g}"},
               {"ulp", 10, "{:.2g}"},
               {"bound", 10, "{:.2g}"},
               {"ulp", 10, "{:.2g}"},
               {}},
              {}};
  for (const Row& r : rows)
    table.rows.push_back({r.group, r.name, r.model, r.lobe, r.exponent, r.truth, r.naive.value,
                          r.naive.of_peak, r.naive.ulp, r.ours.value, r.ours.of_peak, r.ours.ulp,
                          r.bound.of_peak, r.bound.ulp,
                          r.outcome == kWithin ? "" : "  " + r.outcome});
  return table_text(table);
}

/// One point of one highlight by exponent, in digits that a reader can compare.
std::string digits(const Rows& rows) {
  Table table{"The flank of modified Phong's cos^n, in digits\n",
              {{"n", 9, "{:g}"},
               {"truth", -14, "{:.8f}", 2},
               {"naive float32", -16, "{:.8f}"},
               {"ours", -14, "{:.8f}"}},
              {}};
  for (const Row& r : rows)
    if (r.group == "vectors" && r.name == "flank, oblique" && r.model == "modified_phong" &&
        r.lobe == "cosine")
      table.rows.push_back({r.exponent, r.truth, r.naive.value, r.ours.value});
  return table_text(table);
}

}  // namespace

Rows all_rows(const std::vector<LobeId>& lobes, const std::function<void(double)>& on_progress) {
  std::vector<std::function<Rows()>> jobs;
  for (const auto rows_of :
       {lobe_rows, coefficient_rows, vector_rows, density_rows, float16_rows, sphere_rows})
    for (const LobeId& lobe : lobes) jobs.push_back([rows_of, lobe] { return rows_of(lobe); });
  for (const double n : kExponents)
    jobs.push_back([&lobes, n] { return precision_rows(lobes, n); });

  std::vector<Rows> parts(jobs.size());
  std::atomic<int> done{0};
  for_each_whole(jobs.size(), [&](std::size_t i) {
    if (interrupted()) return;
    parts[i] = jobs[i]();
    on_progress(double(++done) / double(jobs.size()));
  });
  throw_if_interrupted();
  Rows rows;
  for (Rows& part : parts)
    rows.insert(rows.end(), std::make_move_iterator(part.begin()),
                std::make_move_iterator(part.end()));
  return rows;
}

std::vector<records::StabilityCurve> error_curves() {
  std::vector<records::StabilityCurve> curves;
  for (const double n : {16.0, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8}) curves.push_back(error_curve(n));
  return curves;
}

void summarise(records::VerifyStability& report) {
  const Rows& rows = report.rows;
  report.instruction_set = kernels().instruction_set;
  report.cases = rows.size();
  report.outside = std::size_t(std::ranges::count(rows, kOutside, &Row::outcome));
  report.not_compared = std::size_t(std::ranges::count(rows, kNotCompared, &Row::outcome));
  report.by_lobe = by_lobe(rows, false);
  report.by_case = by_case(rows);
  report.by_exponent = by_lobe(rows, true);
  report.groups.clear();
  for (const records::StabilityOfCase& s : report.by_case)
    if (report.groups.empty() || report.groups.back().name != s.group)
      report.groups.push_back({s.group, std::string(meaning(s.group))});
}

void keep_rows_outside(records::VerifyStability& report) {
  std::erase_if(report.rows, [](const Row& row) { return row.outcome != kOutside; });
}

std::string report_text(const records::VerifyStability& report, bool all) {
  std::string text =
      all ? rows_text(report.rows)
          : summary_text(report.by_lobe, "worst of each lobe", &records::StabilityOfLobe::lobe) +
                "\n" +
                summary_text(report.by_case, "worst of each case",
                             &records::StabilityOfCase::name) +
                digits(report.rows);
  for (const records::StabilityPictures& p : report.pictures)
    text += fmt::format(
        "\nclose to a highlight of n = {:g}: naive off by {:.2g} of the peak, ours by {:.2g}",
        p.exponent, p.naive.largest_error_of_peak, p.ours.largest_error_of_peak);
  if (!report.pictures.empty()) text += "\n";
  return text + fmt::format("\n{} cases: {} within their bounds, {} outside, {} not compared\n",
                            report.cases, report.cases - report.outside - report.not_compared,
                            report.outside, report.not_compared);
}

}  // namespace lobelia::stability
