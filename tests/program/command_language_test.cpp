// One language for all commands: what an option means, and what is said of words that are none.
#include "base/words/text.hpp"
#include "program/command/commands.hpp"
#include "program/command/common_options.hpp"
#include "program/command/manual/manual_tables.hpp"
#include "run_lobelia.hpp"
#include "tests/test.hpp"

namespace lobelia {
namespace {

std::vector<cli::CommandRow> commands(const std::string& wanted = "") {
  CLI::App app("", "lobelia");
  ExitCode code = ExitCode::kSuccess;
  cli::add_commands(app, code, wanted);
  return cli::command_rows(app);
}

TEST(OldOption, GivesAHintThatIsAnOptionOfItsCommand) {
  const TemporaryDirectory directory;
  const auto all = commands();
  for (const cli::OldOption& old : cli::old_options()) {
    const std::string command(old.command), hint(old.hint);
    const auto result = run_lobelia({command, std::string(old.option), "x"}, directory.path());
    EXPECT_EQ(result.exit_code, 2) << result.output_tail;
    EXPECT_THAT(result.output_tail, HasSubstr("use " + hint)) << command;
    const auto row = std::ranges::find(all, command, &cli::CommandRow::path);
    ASSERT_NE(row, all.end()) << command;
    EXPECT_TRUE(std::ranges::any_of(row->options, [&](const cli::OptionRow& option) {
      return std::ranges::count(option.names, hint.substr(0, hint.find(' '))) > 0;
    })) << command;
  }
}

TEST(CommonOption, MeansTheSameInEveryCommand) {
  for (const cli::CommandRow& command : commands()) {
    if (command.path.empty()) continue;
    std::set<std::string> found;
    for (const cli::OptionRow& option : command.options)
      for (const cli::CommonOption& common : cli::common_options())
        for (const std::string& name : option.names) {
          const auto names = split(common.names, ",");
          if (std::ranges::count(names, name) == 0) continue;
          const std::string shown = "lobelia " + command.path + " " + name;
          EXPECT_TRUE(found.insert(name).second) << shown;
          EXPECT_EQ(option.names.size(), names.size()) << shown;
          EXPECT_TRUE(option.help.starts_with(common.meaning)) << shown << ": " << option.help;
          EXPECT_TRUE(option.value.starts_with(common.value)) << shown << ": " << option.value;
          EXPECT_EQ(option.value.empty(), name.ends_with("-q") || name.ends_with("-v") ||
                                              name == "--quiet" || name == "--verbose")
              << shown;
        }
    EXPECT_TRUE(found.contains("-q") && found.contains("-v")) << command.path;
  }
}

TEST(Command, IsTheSameAloneAsAmongAll) {
  const auto all = commands();
  EXPECT_EQ(commands("manul").size(), all.size()) << "to suggest one";
  EXPECT_EQ(commands("manual").size(), all.size()) << "it writes about all";
  for (const std::string& name : all.at(0).subcommands) {
    if (name == "manual") continue;
    std::vector<std::string> expected, alone;
    for (const cli::CommandRow& row : all)
      if (row.path == name || row.path.starts_with(name + " "))
        expected.push_back(man_page(row, all));
    for (const cli::CommandRow& row : commands(name))
      if (!row.path.empty()) alone.push_back(man_page(row, all));
    EXPECT_EQ(alone, expected) << name;
  }
}

TEST(Help, IsThereForEveryCommandAndNamesThoseBelowIt) {
  const TemporaryDirectory directory;
  for (const cli::CommandRow& command : commands()) {
    SCOPED_TRACE(command.path);
    EXPECT_EQ(
        run_shell("\"$LOBELIA\" " + command.path + " --help > help", directory.path()).exit_code,
        0);
    const std::string help = read_file(directory.path() / "help", 1 << 20);
    EXPECT_THAT(help, HasSubstr(command.path.empty() ? "Exit codes" : "--help"));
    for (const std::string& name : command.subcommands) EXPECT_THAT(help, HasSubstr(name));
  }
}

TEST(Help, IsAWordTooAsIsVersion) {
  const TemporaryDirectory directory;
  const auto printed = [&](std::vector<std::string> arguments) {
    const auto result = run_lobelia(std::move(arguments), directory.path());
    EXPECT_EQ(result.exit_code, 0) << result.output_tail;
    return result.output_tail;
  };
  EXPECT_EQ(printed({"help", "farm", "status"}), printed({"farm", "status", "--help"}));
  EXPECT_EQ(printed({"help"}), printed({"--help"}));
  EXPECT_EQ(printed({"version"}), printed({"-V"}));
}

TEST(TimeLimit, EndsLongCommandsWithItsOwnExitCode) {
  for (const std::vector<std::string>& arguments : {std::vector<std::string>{"models"},
                                                    {"search", "--error", "1e-3"},
                                                    {"cost", "--quick"},
                                                    {"convert", "--to", "ggx", "--json", "a.json"},
                                                    {"verify", "paper", "--json", "a.json"},
                                                    {"verify", "stability", "--json", "a.json"}}) {
    const TemporaryDirectory directory;
    auto limited = arguments;
    limited.insert(limited.end(), {"--time-limit", "0.001"});
    const auto result = run_lobelia(limited, directory.path());
    EXPECT_EQ(result.exit_code, 124) << arguments[0] << result.output_tail;
    EXPECT_TRUE(result.output_tail.ends_with("lobelia: the time is over (--time-limit)\n"))
        << arguments[0] << result.output_tail;
    EXPECT_EQ(files_in(directory.path()), 0u) << arguments[0];
  }
}

TEST(Verbose, PrintsThePlanOfARenderWithItsTime) {
  const TemporaryDirectory directory;
  const auto result =
      run_lobelia({"render", kScenes + "head_on.xml", "-o", "a.exr", "-v"}, directory.path());
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.output_tail, HasSubstr("throws no light on itself"));
  EXPECT_THAT(result.output_tail, testing::ContainsRegex("lobelia render: .* s, .* MiB"));
  EXPECT_EQ(run_lobelia({"render", kScenes + "head_on.xml", "-o", "a.exr", "-q"}, directory.path())
                .output_tail,
            "");
  EXPECT_EQ(run_lobelia({"models", "-q", "-v"}, directory.path()).exit_code, 2);
}

TEST(Colours, AreForTerminalsWithoutNoColor) {
  const TemporaryDirectory directory;
  write_small_grid(directory.path(), "16");
  for (const auto& [more, coloured] :
       {std::pair{"env -u NO_COLOR ", true}, {"NO_COLOR=1 ", false}, {"NO_COLOR= ", true}}) {
    const auto result =
        run_shell("export LOBELIA; " + std::string(more) +
                      "script -qec '\"$LOBELIA\" farm grid.xml -q -o out' /dev/null",
                  directory.path());
    EXPECT_EQ(result.output_tail.find("\x1b[") != std::string::npos, coloured) << more;
  }
}

/// Files that users take for a scene.
TEST(Scene, IsNamedIfItIsOfAnotherProgram) {
  const TemporaryDirectory directory;
  for (const auto& [text, named] : {
           std::pair<std::string, std::string>{"LookAt 0 0 0\nWorldBegin\n",
                                               "is no XML; Lobelia reads scenes in its own XML"},
           {" {\"asset\":{\"version\":\"2.0\"}}", "is no XML"},
           {"<scene version=\"3.0.0\"><bsdf/></scene>", "--from mitsuba -o OUT.xml"},
           {"<grid version=\"1\"/>", "For a grid, type lobelia farm"},
           {"<scene version=\"1\"><camera/></scene>", "did you mean 'sensor'?"},
           {"<scene version=\"1\"><light/></scene>", "did you mean 'emitter'?"},
           {"<scene version=\"1\"><default name=\"n\" value=\"3\"/></scene>", "has no variables"},
       }) {
    write_file(directory.path() / "scene", text);
    const auto result = run_lobelia({"plan", "scene"}, directory.path());
    EXPECT_EQ(result.exit_code, 3) << text;
    EXPECT_THAT(result.output_tail, HasSubstr(named)) << text;
  }
  std::string scene = read_file(kScenes + "head_on.xml", 1 << 20);
  const std::string grey = "<rgb name=\"irradiance\" value=\"1\"/>";
  ASSERT_NE(scene.find(grey), std::string::npos);
  scene.replace(scene.find(grey), grey.size(), "<rgb name=\"irradiance\" value=\"#ff8800\"/>");
  write_file(directory.path() / "scene", scene);
  EXPECT_THAT(run_lobelia({"plan", "scene"}, directory.path()).output_tail,
              HasSubstr("(in linear light it is '1, 0.2462, 0')"));
  EXPECT_THAT(run_lobelia({"plan", kScenes + "head_on.xml", "--model", "phong"}, directory.path())
                  .output_tail,
              HasSubstr("did you mean 'phong_rdf' or 'modified_phong'?"));
}

}  // namespace
}  // namespace lobelia
