#include "base/records/lobe_search.hpp"

namespace lobelia::records {

void define_lobe_search_tables(Tables& tables) {
  tables.define<LobeTouch>(
      "A point of the certificate: where the best lobe has its largest error. With the signs of the errors the weights "
      "annihilate all terms of the polynomial, so that no other one is below the lower bound at all of these points.",
      [](auto& t) {
        t.key("ns", "t = n s").at_least(0);
        t.key("perExponent", "v = 1/n").within(0, 1);
        t.key("error", "the lobe's minus that of cos^n");
        t.key("weight", "they sum to 1").within(0, 1);
      });
  tables.define<LobeSearchErrors>(
      "Errors against cos^n, of the peak, the largest over the exponents that were looked at.",
      [](auto& t) {
        t.all().at_least(0);
        t.key("max", "the bound, if there is one");
        t.key("rms", "root mean square over the highlight");
        t.key("energy", "of the integral over s, relative");
        t.key("de2000", "largest CIEDE2000 in grey, the peak shown as white");
        t.key("rounding", "what the precision adds, largest seen");
      });
  tables.define<LobeTime>(
      "Of one value, as SIMD code in float32; the spread is half the distance of the quartiles, of the median.",
      [](auto& t) { t.all().at_least(0); });
  tables.define<LobeErrorAt>("The largest error at one exponent.", [](auto& t) {
    t.key("exponent").at_least(1);
    t.key("error", "of the peak, largest over the angles that were looked at").at_least(0);
  });
  tables.define<SearchedLobe>("The best lobe of a shape.", [](auto& t) {
    t.key("name", "cs16 and the like are the paper's lobes, schlick is Schlick's");
    t.key("formula", "of t = n s and n");
    t.key("code",
          "a function of s and n in GLSL; empty for a lobe of the catalogue, which can be exported")
        .if_any();
    t.key("price", "operations, a division counted as six").within(0, 1e6);
    t.key("byExponent", "degree of the coefficients in 1/n");
    t.key("coefficients", "of t^j / n^r, j = 1, 2, ... first; with a free peak from j = 0");
    t.key("bound", "of the error, proved for all s and n; null: not proved").at_least(0);
    t.key("lowerBound", "no lobe of this shape has a smaller error").at_least(0);
    t.key("isOnFront", "nearer by 0.5 % than all that are cheaper");
    t.key("touches", "the certificate of the lower bound").if_any();
  });
  tables.define<LobeSearch>(
      "The cheapest lobes for cos^n: 'lobelia search --json FILE'.", [](auto& t) {
        t.kind("lobe-search");
        t.key("leastExponent").at_least(1);
        t.key("mostExponent", "null: to infinity");
        t.key("family", "clamped polynomials, reciprocals, bits; all three with a free peak")
            .one_of(kSearchFamilies);
        t.key("metric", "that chooses").one_of(kSearchMetrics);
        t.key("coefficients", "constant or by-n");
        t.key("chosen", "the lobe that was asked for").if_any();
        t.key("answers", "which lobe to use for which error").if_any();
        t.key("lobes", "cheapest first");
        t.key("notProved",
              "shapes whose best lobe could not be proved, or is none: not among the lobes")
            .if_any();
      });
}

}  // namespace lobelia::records
