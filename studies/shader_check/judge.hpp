// The directions of a check, and the verdict on what a function gave there. The program and the explorer's page (web/)
// share it, so it runs no shader.
#pragma once

#include <map>
#include <vector>

#include "base/records/shader_check.hpp"
#include "renderer/highlight.hpp"
#include "studies/shader_check/points.hpp"
#include "studies/shader_check/run_shaders.hpp"

namespace lobelia::shader_check {

inline constexpr double kUsualExponents[] = {1, 4, 16, 64, 256, 1000};
inline constexpr int kSphereSize = 160;
inline constexpr double kLightDegrees[] = {20, 60, 120};

/// All points of a check in one list, with the place of each part.
struct Plan {
  std::vector<Point> points;
  struct Part {
    std::size_t begin = 0, count = 0;
  };
  Part domain, hard, below, arc;
  std::vector<double> arc_degrees;  ///< of the normal from the half vector
  std::vector<Part> spheres;        ///< by kLightDegrees
  struct HemispherePart {
    Part part;
    double exponent, degrees;
    std::vector<double> solid_angles;
  };
  std::vector<HemispherePart> hemispheres;  ///< for energies, which the verdict does not need

  Part add(const std::vector<Point>& more);
};
/// The parts that the verdict needs. `shown_exponent` is that of arc and spheres.
Plan judged_plan(const Highlight& highlight, const std::vector<double>& exponents,
                 double shown_exponent);
void add_sphere_points(double exponent, Plan& plan);
void add_hemispheres(const Highlight& highlight, const std::vector<double>& exponents, Plan& plan);

/// A function's values at the points of a plan, beside the model in double.
class Judge {
 public:
  /// Without the highlight's exponent. Keeps references to the others.
  Judge(const Highlight& highlight, const Plan& plan, const std::vector<ShaderValue>& values)
      : highlight_(highlight), plan_(plan), values_(values), coefficients_(highlight) {}

  double model(std::size_t i);
  double peak(double exponent) { return coefficients_.at(exponent); }
  /// 0 of a discarded call.
  double theirs(std::size_t i) const { return values_[i].written ? double(values_[i].r) : 0; }

  /// Sets the verdict, errors and oddities of the record.
  void judge(records::ShaderCheck& record);
  records::ShaderExplanation explanation(const records::ShaderOddities& odd, bool of_roughness);

 private:
  records::ShaderPlace place(std::size_t i);
  /// Compares every direction of a part with the model where it is defined, but for the edges.
  void add_errors(const Plan::Part& part, std::map<double, records::ShaderError>& worst,
                  records::ShaderOddities& odd);

  Highlight highlight_;
  const Plan& plan_;
  const std::vector<ShaderValue>& values_;
  Coefficients coefficients_;
};

}  // namespace lobelia::shader_check
