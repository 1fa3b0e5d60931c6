#include "run_lobelia.hpp"
#include "tests/test.hpp"

namespace lobelia {
namespace {

struct Mistake {
  std::vector<std::string> arguments;
  int exit_code;
  std::string message;
};

TEST(Mistakes, EndInOneClearLineTheRightExitCodeAndNoFile) {
  const TemporaryDirectory inputs;
  const auto file = [&](const char* name, const std::string& text) {
    write_file(inputs.path() / name, text);
    return (inputs.path() / name).string();
  };
  const std::string scene = kScenes + "head_on.xml";
  const std::string broken = file("broken.xml", "<scene version=\"1\">\n<sensor");
  const std::string text_exr = file("text.exr", "this is text");
  const Mistake mistakes[] = {
      {{}, 2, "subcommand"},
      {{"rendr"}, 2, "did you mean 'render'?"},
      {{"render"}, 2, "SCENE"},
      {{"render", scene}, 2, "--output"},
      {{"render", "missing.xml", "-o", "a.exr"}, 3, "missing.xml: cannot read: No such file"},
      {{"render", ".", "-o", "a.exr"}, 3, "not a regular file"},
      {{"render", broken, "-o", "a.exr"}, 3, "broken.xml:2:"},
      {{"render", scene, "-o", "a.png"}, 2, "must end in .exr"},
      {{"render", scene, "-o", "a.exr", "--png", "a.exr"}, 2, "is written by this command already"},
      {{"render", scene, "-o", std::string(300, 'x') + ".exr"}, 4, "File name too long"},
      {{"render", scene, "-o", "no/such/a.exr"}, 4, "no/such/a.exr: cannot write: No such file"},
      {{"render", scene, "-o", "a.exr", "--exponent", "-3"},
       2,
       "--exponent -3 is out of range; allowed: 0 to 1e+08"},
      {{"render", scene, "-o", "a.exr", "--exponent", "nan"}, 2, "--exponent nan"},
      {{"render", scene, "-o", "a.exr", "--model", "phong"}, 2, "--model 'phong' is unknown"},
      {{"render", scene, "-o", "a.exr", "--lobe", "cosin"}, 2, "did you mean 'cosine'?"},
      {{"render", scene, "-o", "a.exr", "--width", "1000000"}, 2, "allowed: 1 to 32768"},
      {{"render", scene, "-o", "a.exr", "--width", "32768", "--height", "32768"}, 2, "too many"},
      {{"render", scene, "-o", "a.exr", "--threads", "-1"}, 2, "--threads"},
      {{"plan", "missing.xml"}, 3, "missing.xml"},
      {{"compare", "a.exr"}, 2, "B"},
      {{"compare", text_exr, text_exr}, 3, "text.exr: not a readable picture"},
      {{"compare", "a.exr", "b.exr"}, 3, "a.exr"},
      {{"compare", "a.exr", "b.exr", "--tolerance", "1,1,1", "--scene",
        kScenes + "effects/area_light.xml"},
       3,
       "this scene has a light with a size"},
      {{"compare", "a.exr", "b.exr", "--significance", "0"}, 2, "--significance"},
      {{"compare", "a.exr", "b.exr", "--bootstrap", "1"}, 2, "--bootstrap"},
      {{"compare", "a.exr", "b.exr", "--fail", "z.max=5"}, 2, "needs the noise of a picture"},
      {{"compare", "a.exr", "b.exr", "--a-error", "e.exr", "--a-replicate", "c.exr"},
       2,
       "excludes"},
      {{"profile", text_exr, "--scene", scene}, 3, "text.exr"},
      {{"reference", scene, "--engine", "maya", "-o", "a.exr"}, 2, "maya"},
      {{"reference", scene, "--engine", "povray", "--povray", "/no/such", "-o", "a.exr"},
       5,
       "/no/such"},
      {{"farm", "missing.xml", "-o", "out"}, 3, "missing.xml"},
      {{"gallery", "no-such-directory"}, 3, "no-such-directory"},
      {{"verify"}, 2, "subcommand"},
      {{"verify", "papers"},
       2,
       "unknown subcommand 'papers' of 'lobelia verify'; allowed: paper, stability, references, "
       "verdicts, profiles, highlights; did you mean 'paper'?"},
      {{"farm", "stauts", "out"}, 2, "did you mean 'status'?"},
      {{"gallery", "pubilsh", "out"}, 2, "did you mean 'publish'?"},
      {{"farm", "status", "--josn", "-", "out"}, 2, "did you mean '--json'?"},
      {{"render", "--sampels", "3"}, 2, "has no option '--sampels'; did you mean '--samples'?"},
      {{"render", scene, "--normalization=exact"}, 2, "did you mean '--normalisation'?"},
      {{"render", scene, "-o", "a.exr", "-j", "2"}, 2, "has no option '-j'"},
      {{"search", "--error", "1e-3", "-oa.json"}, 2, "use --json FILE"},
      {{"models", "--json", "--exponent", "3"}, 2, "'--exponent' is an option"},
      {{"compare", "a.exr", "b.exr", "--html", "-q"}, 2, "'-q' is an option"},
      {{"farm", "gc", ".", "--max-size", "10"}, 2, "allowed: 0, or a number with B, K, M, G or T"},
      {{"render", scene, "-o", "a.exr", "--time-limit", "10s"}, 2, "'10s' is not a number"},
      {{"export", "--language", "GLSL", "phong_rdf"}, 2, "did you mean 'glsl'?"},
      {{"models", "--json"}, 2, "with --json - it goes to stdout"},
      {{"plan", "--json", broken}, 2, "is no JSON; allowed: a file to write, or -"},
      {{"verify", "stability", "--lobe", "cs15"}, 2, "--lobe 'cs15' is unknown"},
      {{"verify", "stability", "--json", "no/such/s.json"}, 4, "no/such/s.json"},
      {{"verify", "stability", "--pictures", text_exr}, 4, "text.exr"},
      {{"cost", "--level", "fixed-point"}, 2, "; use lobelia "},
      {{"models", "--exponent", "nan"}, 2, "allowed: 0 to 1e+08"},
      {{"render", scene, "-o", "a.exr", "--exposure", "nan"}, 2, "allowed: -100 to 100"},
      {{"verify", "paper", "--json", "no/such/a.json"}, 4, "no/such/a.json: cannot write"},
      {{"verify", "paper", "--plots", text_exr}, 4, "text.exr"},
  };
  for (const auto& [arguments, exit_code, message] : mistakes) {
    const TemporaryDirectory directory;
    SCOPED_TRACE(testing::PrintToString(arguments));
    expect_one_line(run_lobelia(arguments, directory.path()), exit_code, message);
    EXPECT_EQ(files_in(directory.path()), 0u);
  }
}

TEST(Compare, PrintsTheSensitivityThatTheDocumentationShows) {
  const TemporaryDirectory directory;
  ASSERT_EQ(
      run_lobelia({"render", kScenes + "head_on.xml", "--exponent", "1000", "-o", "head_on.exr"},
                  directory.path())
          .exit_code,
      0);
  const std::string document =
      read_file(std::filesystem::path(LOBELIA_SOURCE_DIR) / "docs/limits.md", 1 << 20);
  const auto run = [&](std::vector<std::string> more) {
    more.insert(more.begin(), {"compare", "--sensitivity", "head_on.exr"});
    return run_lobelia(more, directory.path());
  };
  EXPECT_EQ(run({}).exit_code, 0);
  const auto blind =
      run({"--no-default-limits", "--fail", "ciede2000.p99=2", "--fail", "flip.ldr.mean=0.01"});
  EXPECT_EQ(blind.exit_code, 1);
  EXPECT_THAT(document, HasSubstr(blind.output_tail));
}

}  // namespace
}  // namespace lobelia
