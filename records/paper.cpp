#include "records/paper.hpp"

namespace lobelia::records {
namespace {

constexpr std::string_view kClaimVerdicts[] = {"confirmed", "not reproduced", "found"};

}  // namespace

const Struct& Measured::type() {
  return define<Measured>("Measured", "What was measured.", [](Struct& t) {
    t.key<&Measured::what>("what");
    t.key<&Measured::value>("value").may_be_nonfinite();
    t.key<&Measured::text>("text", "the value with the digits that are the same on every machine");
    t.key<&Measured::at>("at", "where the value was found").if_any();
  });
}

const Struct& Claim::type() {
  return define<Claim>("Claim", "A claim of the paper, or a finding.", [](Struct& t) {
    t.key<&Claim::name>("name");
    t.key<&Claim::where>("where", "in the paper");
    t.key<&Claim::statement>("statement");
    t.key<&Claim::printed>("printed", "figure or formula as printed; empty without one");
    t.key<&Claim::measured>("measured", "the verdict is about the first").items(1);
    t.key<&Claim::definition>("definition", "what was measured");
    t.key<&Claim::verdict>("verdict", "found: the paper does not speak of it")
        .one_of(kClaimVerdicts);
    t.key<&Claim::reason>("reason");
  });
}

const Struct& PaperFigure::type() {
  return define<PaperFigure>("PaperFigure", "A chart and the claims that it shows.", [](Struct& t) {
    t.key<&PaperFigure::id>("id");
    t.key<&PaperFigure::title>("title");
    t.key<&PaperFigure::description>("description");
    t.key<&PaperFigure::x>("x");
    t.key<&PaperFigure::y>("y");
    t.key<&PaperFigure::bands>("bands");
    t.key<&PaperFigure::series>("series");
    t.key<&PaperFigure::claims>("claims");
  });
}

const Struct& VerifyPaper::type() {
  return define<VerifyPaper>(
      "VerifyPaper", "The paper, measured: 'lobelia verify paper --json FILE'.", [](Struct& t) {
        t.kind("verify-paper");
        t.key<&VerifyPaper::command>("command").if_any();
        t.key<&VerifyPaper::confirmed>("confirmed");
        t.key<&VerifyPaper::not_reproduced>("notReproduced");
        t.key<&VerifyPaper::found>("found");
        t.key<&VerifyPaper::claims>("claims");
        t.key<&VerifyPaper::figures>("figures", "with --plots").if_any();
      });
}

}  // namespace lobelia::records
