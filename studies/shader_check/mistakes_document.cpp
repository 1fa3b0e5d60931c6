#include "studies/shader_check/mistakes_document.hpp"

#include <fmt/format.h>

#include "studies/shader_check/bsdf/explain.hpp"

namespace lobelia::shader_check {
namespace {

struct NamedRow {
  std::string_view names, what;
};
/// In Markdown. Mistakes that differ in a number share a row.
constexpr NamedRow kNamedRows[] = {
    {"`pi-missing`, `pi-twice`", "no division by pi, or one too many"},
    {"`pi-rounded`", "pi is 3.14, 22 / 7 or the like"},
    {"`two-missing`, `two-twice`, `four-missing`, `four-twice`",
     "the same of a 2 or a 4, such as the 4 of the half-vector"},
    {"`two-pi-missing`, `four-pi-missing`, `eight-pi-missing`", "the whole denominator is missing"},
    {"`factor`", "another factor, the same at every exponent"},
    {"`coefficient-missing`, `coefficient-constant`",
     "no coefficient, or one that does not depend on n"},
    {"`coefficient`",
     "the coefficient of another model: n, n + 1, n + 2, n + 4, n + 6 or n + 8 over 1, 2, 4 or 8, with or without pi, the exact one, or a fitted a n + b"},
    {"`cosine-missing`, `cosine-twice`, `cosine-applied`",
     "N.L is not there, is there twice, or is there in a model without it"},
    {"`cosine-root`, `cosine-smoothstep`, `cosine-wrapped`",
     "sqrt(N.L), smoothstep(0, 1, N.L), 0.5 N.L + 0.5 or its square"},
    {"`eye-cosine`, `half-vector-cosine`", "N.V, N.H or V.H in place of N.L"},
    {"`shadowing-missing`", "the geometry term of `microfacet_smith` is (N.L)(N.V)"},
    {"`geometry-term`",
     "another one: separable or linear Smith, alpha for roughness, Schlick-GGX with the k of direct or of image-based light, Kelemen's, Neumann's, Ward's, Cook and Torrance's"},
    {"`over-eye-cosine`, `no-geometry-term`, `denominator-floor`",
     "a division by N.V or by (N.L)(N.V); the denominator 4 (N.L)(N.V) has a floor"},
    {"`fresnel`",
     "a Fresnel factor of Schlick's form, also of N.V or by Karis's power of 2. Its F0 is fitted"},
    {"`floor`", "max(N.L, 0.001) and the like, in place of max(N.L, 0). The floor is fitted"},
    {"`ambient`, `diffuse`",
     "light on top of the highlight: a constant, or one that N.L multiplies. Both are fitted"},
    {"`half-vector-not-normalised`, `half-vector-halved`", "H is L + V, or (L + V) / 2"},
    {"`half-vector-sign`, `reflect-sign`",
     "a direction points the wrong way: L - V; `reflect(V, N)`"},
    {"`light-reversed`, `normal-reversed`, `eye-reversed`", "-L, -N or -V throughout"},
    {"`test-reversed`, `two-sided`",
     "the test of N.L is the wrong way round; abs() of both cosines, or N is turned to the light"},
    {"`mirror-for-half-vector`, `half-vector-for-mirror`",
     "R.L in place of N.H, and the other way round"},
    {"`light-for-half-vector`, `eye-for-half-vector`, `eye-and-half-vector`, `light-and-eye`",
     "N.L, N.V, V.H or L.V in the lobe"},
    {"`lobe-missing`", "no lobe: diffuse light alone"},
    {"`abs-mirror`, `abs-cosine`, `light-behind`",
     "abs(R.L) or abs(N.L) in place of max, or no test at all: light from behind"},
    {"`exponent`, `exponent-fixed`",
     "n / 4, n / 2, 2 n, 4 n, 128 n, n / 1000, n - 1, n + 1, n + 2, n^2, sqrt(n) or another multiple in place of n; a fixed number"},
    {"`exponent-of-roughness`",
     "another rule than n = 2 / alpha^2 - 2: without the 2, not squared, squared too often, 1 / alpha, 2^(10 (1 - roughness) + 1), ..."},
    {"`lobe`", "another lobe, such as a spherical Gaussian"},
    {"`half-float-s`, `half-float-cosine`, `half-float-result`",
     "s, the cosine or the result was a half float on its way"},
    {"`float32-cosine`",
     "the exponent multiplies the rounding of the cosine: the differences are as small, and of both signs"},
    {"`negative-base`", "NaN exactly where the lobe's cosine is below 0: pow without max(..., 0)"},
    {"`clamped`, `tone-mapped`, `exposure`, `gamma`, `gamma-decoded`, `square-root`",
     "the result was; up to two of them in any order"},
    {"`srgb`, `srgb-twice`, `srgb-decoded`", "the result was encoded as sRGB, twice, or decoded"},
    {"`zero`, `no-number`", "it is 0, or no finite number, in every direction"}};

}  // namespace

std::string mistakes_document() {
  std::string text =
      "# Mistakes that have a name\n\n"
      "<!-- Written by `lobelia check-shader --list-mistakes > docs/shader_mistakes.md`; do not edit. -->\n\n"
      "For anyone who looks up a name that [`lobelia check-shader`](check_shader.md) printed.\n\n"
      "## Of a highlight\n\n| name | what the shader does |\n|---|---|\n";
  for (const auto& [names, what] : kNamedRows) text += fmt::format("| {} | {} |\n", names, what);
  text += "\n## Of a BSDF\n\n| name | what is wrong |\n|---|---|\n";
  for (const auto& [name, sentence] : bsdf::bsdf_mistakes())
    text += fmt::format("| `{}` | {} |\n", name, sentence);
  return text;
}

}  // namespace lobelia::shader_check
