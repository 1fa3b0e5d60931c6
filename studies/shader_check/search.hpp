// The search for mistakes that make a model's formula give a shader's values.
#pragma once

#include <deque>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "studies/shader_check/coefficients.hpp"
#include "studies/shader_check/mistakes.hpp"
#include "studies/shader_check/samples.hpp"

namespace lobelia::shader_check {

struct Candidate {
  Highlight highlight;
  std::vector<const Mistake*> shape;
  Chain chain;
  Fit fit;
  NamedCoefficient coefficient;
  std::vector<records::ShaderFactor> factors;  ///< where a coefficient can be told
  double cost = 0;                             ///< of the mistakes, without what is left

  double score() const { return cost + fit.left.penalty(); }
  bool explains() const;
  std::vector<std::string_view> ids() const;
};

/// Values that are searched, as a sample and in full.
class Searched {
 public:
  explicit Searched(const Observed& observed);
  Searched(const Searched&) = delete;  // its clamp is pointed to
  struct Values {
    Samples samples;
    std::map<Chain, std::vector<Radiances>> radiances;
    const std::vector<Radiances>& of(const Chain& chain);
  };
  Values some, all;
  bool is_half = false;  ///< every value is a half float
  /// What may be done to a result: output_steps(), and a clamp to the largest value if several calls give that.
  std::vector<const OutputStep*> steps;
  /// The step value^exponent, each made once.
  const OutputStep* power(double exponent, const std::string& text);

 private:
  std::string clamp_words_;
  OutputStep clamp_{};
  struct Power {
    std::string words;
    OutputStep step;
  };
  std::map<double, Power> powers_;
};

/// The search for one model. Rounds go from the simple to the involved; each keeps the best that was found.
class Search {
 public:
  Search(const Highlight& highlight, Searched& values, bool of_roughness, bool other_models);

  void try_one_mistake();
  void try_two_mistakes();
  /// What usual engines have together: a geometry term, a floor of the denominator and a Fresnel factor.
  void try_microfacet_forms();
  const Candidate& best() const { return *best_; }
  /// Another explanation that is as simple and fits as well.
  const std::optional<Candidate>& other() const { return other_; }

 private:
  using Shape = std::vector<const Mistake*>;
  std::vector<Formula> formulas(const Shape& shape) const;
  void try_shape(const Shape& shape, const Chain& chain = {}, Additions additions = {});
  void try_additions(const Shape& shape, const Chain& chain);
  void try_fits(const Shape& shape, const Chain& chain, bool with_exponent);
  void try_powers(const Shape& shape);
  void name(Candidate& candidate);
  void keep(Candidate candidate);
  const Mistake* keep(Mistake mistake);
  // What a number may be that the shader has in place of the model's (search_fits.cpp).
  std::vector<const Mistake*> fitted_fresnel(const Shape& shape, const Chain& chain);
  std::vector<const Mistake*> fitted_floors(const Shape& shape, const Chain& chain);
  std::vector<const Mistake*> fitted_guards(const Shape& shape, const Chain& chain);
  std::vector<const Mistake*> guards_beside_fresnel(const Shape& shape);
  std::vector<const OutputStep*> fitted_powers(const Shape& shape);
  const Mistake* fitted_exponent(const Shape& shape);
  bool has(const Shape& shape, Part part) const;

  Highlight highlight_;
  Searched& values_;
  CoefficientNames names_;
  std::vector<const Mistake*> usable_;
  std::deque<Mistake> fitted_;
  std::optional<Candidate> best_, other_;
};

}  // namespace lobelia::shader_check
