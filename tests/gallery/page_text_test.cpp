// Texts of records as pages show them.
#include "gallery/pages/page_text.hpp"

#include "gallery/pages/page.hpp"
#include "tests/test.hpp"

namespace lobelia::gallery {
namespace {

TEST(PageText, SetsFormulasAsTheyArePrinted) {
  const std::pair<const char*, const char*> cases[] = {
      {"cos^n exceeds cs16 by 1.7e-2 at most", "cosⁿ exceeds cs16 by 1.7 × 10⁻² at most"},
      {"theta_cr is nearly 6/sqrt(n)", "θ_cr is nearly 6/√n"},
      {"2 arcsin(sqrt(8/n))", "2 arcsin(√(8/n))"},
      {"8e+08 times, below 1e-15, 1e-02", "8 × 10⁸ times, below 10⁻¹⁵, 10⁻²"},
      {"-9.7e-3", "−9.7 × 10⁻³"},
      {"max(0, 1 - n s / 16)^16", "max(0, 1 − n s / 16)¹⁶"},
      {"n >= 16, n = 16..1024, 48 x 48", "n ≥ 16, n = 16 to 1024, 48 × 48"},
      {"start 0.00 ns, parse 286 us", "start 0, parse 286 µs"},
      {"takes 2764247337825939 s", "takes 2.76 × 10¹⁵ s"},
      {"4 pi where N.L = 1", "4 π where N·L = 1"},
      {"a-b.c, e-mail, 1.5, v2.0e", "a-b.c, e-mail, 1.5, v2.0e"}};
  for (const auto& [record, page] : cases) EXPECT_EQ(math_text(record), page);
}

TEST(PageText, RaisesExponentsByMarkup) {
  Html html;
  write_math(html, "2^(-n/2) < theta_cr");
  EXPECT_EQ(html.str(), "2<sup>−n/2</sup> &lt; θ<sub>cr</sub>");
}

TEST(PageText, EndsWhateverIsNested) {
  std::string deep;
  for (int i = 0; i < 100000; ++i) deep += "sqrt(2^(";
  EXPECT_GE(math_text(deep).size(), 1u);
  EXPECT_GE(math_text(std::string(5000, '9') + " s").size(), 1u);
}

TEST(DataScript, IsOneTextOfJavaScriptWhateverTheDataHold) {
  EXPECT_EQ(data_script("a", R"({"x":"it's \n"})"), R"(lobelia('a','{"x":"it\'s \\n"}');)"
                                                    "\n");
}

}  // namespace
}  // namespace lobelia::gallery
