// A key has all that decides a result: the engine's files, its libraries, the arithmetic.
#include "base/words/text.hpp"
#include "failing_farm.hpp"
#include "lobelia_paths.hpp"
#include "tests/json.hpp"

namespace lobelia {
namespace {

void append(const fs::path& file, const std::string& text) {
  std::ofstream(file, std::ios::app | std::ios::binary) << text;
}

/// A processor of which glibc uses other functions without these.
bool has_fma() {
  std::ifstream file("/proc/cpuinfo");
  std::string text((std::istreambuf_iterator<char>(file)), {});
  return text.find(" fma ") != text.npos && text.find(" avx2 ") != text.npos;
}

constexpr char kWithoutFma[] = "GLIBC_TUNABLES=glibc.cpu.hwcaps=-AVX2,-FMA";

class Key : public FailingFarm {
 protected:
  Json results(const std::string& cell) const {
    return read_json(out() / "cells" / cell / "cell.json").at("results");
  }
  FarmRun explain(const std::vector<std::string>& more,
                  const std::vector<std::string>& environment = {}) const {
    std::vector<std::string> arguments{"farm", "explain", "out"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    if (fs::exists(root() / "povray"))
      arguments.insert(arguments.end(), {"--povray", (root() / "povray").string()});
    return run_command(arguments, environment);
  }
  /// Appending `more` to the engine's file makes another engine of it; undoing it gives the first one again.
  void expect_another_engine(const fs::path& file, const std::string& more) {
    const std::string before = read_file(file, 1 << 28);
    ASSERT_EQ(run().exit_code, 0);
    const Json keys = results("n16");
    append(file, more);
    EXPECT_THAT(
        run({"--dry-run"}).output,
        HasSubstr("n16/reference-povray: engine changed under the same version 3.7.0.10\n"));
    const FarmRun changed = run();
    EXPECT_EQ(changed.rendered, 4u) << "not served from the cache: " << changed.output;
    for (const char* job : {"reference-povray", "compare-povray", "profile"})
      EXPECT_NE(results("n16").at(job), keys.at(job)) << job;
    EXPECT_EQ(results("n16").at("render"), keys.at("render"));
    const FarmRun told = explain({"n16", "reference-povray"});
    EXPECT_EQ(told.exit_code, 0) << told.output;
    write_file(file, before);
    fs::permissions(file, fs::perms::owner_all);
    const FarmRun changed_back = explain({"n16", "reference-povray"});
    EXPECT_EQ(changed_back.exit_code, 1);
    EXPECT_THAT(changed_back.output, HasSubstr("POV-Ray: version: 3.7.0.10\n"));
    EXPECT_THAT(changed_back.output, HasSubstr("POV-Ray: content: CHANGED"));
    EXPECT_THAT(changed_back.output, HasSubstr("    " + file.string() + " changed\n"));
    EXPECT_EQ(run().rendered, 0u);
    EXPECT_EQ(results("n16"), keys);
  }
};

TEST_F(Key, HasTheEnginesProgramThoughTheVersionStaysTheSame) {
  expect_another_engine(fake_povray(), "# another one\n");
}

TEST_F(Key, HasTheProgramBehindAWrapper) {
  fs::rename(fake_povray(), root() / "fake.sh");
  fs::copy_file(fs::canonical("/bin/sh"), root() / "engine");
  script("povray", fmt::format("exec '{0}/engine' '{0}/fake.sh' \"$@\"\n", root().string()));
  expect_another_engine(root() / "engine", std::string(1, '\0'));
}

TEST_F(Key, HasTheLibrariesThatTheEngineLoads) {
  fs::rename(fake_povray(), root() / "fake.sh");
  fs::create_directory(root() / "lib");
  const fs::path libc = root() / "lib" / "libc.so.6";
  for (const char* place :
       {"/lib/x86_64-linux-gnu/libc.so.6", "/lib/aarch64-linux-gnu/libc.so.6", "/lib64/libc.so.6"})
    if (!fs::exists(libc) && fs::exists(place)) fs::copy_file(fs::canonical(place), libc);
  if (!fs::exists(libc)) GTEST_SKIP() << "no glibc where it is looked for";
  script("povray",
         fmt::format("export LD_LIBRARY_PATH='{0}/lib'\nexec /bin/sh '{0}/fake.sh' \"$@\"\n",
                     root().string()));
  expect_another_engine(libc, std::string(1, '\0'));
}

TEST_F(Key, HasHowTheCLibraryCalculates) {
  if (!has_fma()) GTEST_SKIP() << "this processor has one variant of each function";
  fake_povray();
  ASSERT_EQ(run().exit_code, 0);
  const Json keys = results("n16");
  EXPECT_THAT(run_command(command({"--dry-run"}), {kWithoutFma}).output,
              HasSubstr("n16/profile: arithmetic differs\n"));
  const FarmRun told = explain({"n16", "profile"}, {kWithoutFma});
  EXPECT_EQ(told.exit_code, 1);
  EXPECT_THAT(told.output, HasSubstr("arithmetic: libm: CHANGED"));
  EXPECT_THAT(told.output, Not(HasSubstr("program: CHANGED")));
  const FarmRun other = run_command(command(), {kWithoutFma});
  EXPECT_EQ(other.rendered, 8u) << other.output;
  for (const auto& [job, key] : keys.items()) EXPECT_NE(results("n16").at(job), key) << job;
  EXPECT_EQ(run().rendered, 0u);
  EXPECT_EQ(results("n16"), keys);
}

TEST_F(Key, IsNotMadeWithoutALibraryThatCannotBeRead) {
  fake_povray();
  ASSERT_EQ(run().exit_code, 0);
  const Json keys = results("n16");
  // A library that a module of ours needs, and the program does not.
  const std::string module =
      read_file(fs::path(LOBELIA_PROGRAM).parent_path() / "lobelia_image_io.so", 1 << 28);
  const std::size_t at = module.find("libOpenImageIO.so");
  ASSERT_NE(at, module.npos);
  const std::string name = module.substr(at, module.find('\0', at) - at);
  fs::create_directory(root() / "broken");
  write_file(root() / "broken" / name, "no library");
  const std::string path = "LD_LIBRARY_PATH=" + (root() / "broken").string();
  const FarmRun broken = run_command(command(), {path});
  EXPECT_EQ(broken.exit_code, 3) << broken.output;
  EXPECT_THAT(broken.output, HasSubstr("lobelia_image_io.so: its libraries cannot be listed: "));
  EXPECT_THAT(broken.output, HasSubstr(name + ": "));
  EXPECT_EQ(results("n16"), keys);
  EXPECT_EQ(run().rendered, 0u);
}

TEST_F(Key, HasEveryVariableThatChangesAResult) {
  grid({"16", "130"}, "<engine name=\"analytic\"/>");
  const auto made_with = [&](const std::vector<std::string>& environment) {
    fs::remove_all(out());
    fs::remove_all(cache());
    const FarmRun made = run_command(command(), environment);
    EXPECT_EQ(made.exit_code, 0) << made.output;
    return results_of(out());
  };
  const auto keys_of = [](const Results& made) {
    return Json::parse(made.at("cells/n130/cell.json")).at("results");
  };
  write_file(root() / "other.ocio", "ocio_profile_version: 1\n");
  const Results plain = made_with({});
  for (const std::string& variable :
       {std::string("OCIO=") + (root() / "other.ocio").string(), std::string("OCIO=/no/such/file"),
        std::string("OCIO_OPTIMIZATION_FLAGS=0"), std::string("OCIO_ACTIVE_DISPLAYS=none"),
        std::string("OPENIMAGEIO_THREADS=1"),
        std::string("OPENIMAGEIO_OPTIONS=exr_threads=1,png:linear_premult=1"),
        std::string("OMP_NUM_THREADS=1"), std::string("TBB_NUM_THREADS=1"),
        std::string("LC_ALL=de_DE.UTF-8"), std::string("LANG=tr_TR.UTF-8"),
        std::string("TZ=Asia/Tokyo"), std::string("MALLOC_PERTURB_=165"),
        std::string("LD_BIND_NOW=1"), std::string("CYCLES_CPU_NO_AVX2=1"),
        std::string("POVINI=/no/such/file"), std::string("LOBELIA_REQUIRE_ENGINES=1"),
        std::string("COLUMNS=20"), std::string(kWithoutFma),
        std::string("GLIBC_TUNABLES=glibc.malloc.perturb=165")}) {
    const Results other = made_with({variable});
    if (keys_of(other) == keys_of(plain)) {
      EXPECT_THAT(differences(plain, other), testing::IsEmpty()) << variable;
    }
    EXPECT_EQ(keys_of(other) == keys_of(plain), variable != kWithoutFma || !has_fma()) << variable;
  }
}

TEST_F(Key, IsExplainedAsARecordToo) {
  fake_povray();
  ASSERT_EQ(run().exit_code, 0);
  const Json told = Json::parse(explain({"n16", "--json", "-"}).output);
  EXPECT_EQ(told.at("kind"), "farm-explanation");
  ASSERT_EQ(told.at("jobs").size(), 4u);
  for (const Json& job : told.at("jobs")) {
    EXPECT_EQ(job.at("inCache"), true);
    EXPECT_EQ(job.at("key"), results("n16").at(job.at("job").get<std::string>()));
    EXPECT_GE(job.at("parts").size(), 6u);
    for (const Json& part : job.at("parts")) EXPECT_EQ(part.at("same"), true) << part;
  }
  fs::remove_all(cache() / "results");
  const FarmRun lost = explain({"n16"});
  EXPECT_EQ(lost.exit_code, 1);
  EXPECT_THAT(lost.output, HasSubstr("render: not in the cache: missing"));
  fs::remove_all(cache());
  EXPECT_THAT(explain({"n16"}).output,
              HasSubstr("render: not in the cache: the cache is not there"));
  EXPECT_FALSE(fs::exists(cache())) << "explaining makes nothing";
}

TEST_F(Key, IsNotExplainedForACellOutsideTheFarm) {
  fake_povray();
  ASSERT_EQ(run().exit_code, 0);
  fs::create_directory_symlink("n16", out() / "cells" / "link");
  fs::create_directory(root() / "outside");
  fs::copy_file(out() / "cells" / "n16" / "cell.json", root() / "outside" / "cell.json");
  for (const char* cell :
       {"..", ".", "", "../../outside", "n16/../n16", "/etc", "link", "no such", "\n\x1b[31m"}) {
    const FarmRun told = explain({cell});
    EXPECT_EQ(told.exit_code, 3) << cell << told.output;
    EXPECT_THAT(told.output, HasSubstr("no cell '"));
    EXPECT_THAT(told.output, Not(HasSubstr("\x1b")));
  }
  EXPECT_EQ(explain({"n16", "no-job"}).exit_code, 3);
  const fs::path file = out() / "cells" / "n16" / "cell.json";
  Json record = read_json(file);
  for (const char* key : {"results", "madeFrom", "problems", "status"}) {
    Json other = record;
    other[key] = Json::array({1, "../../x"});
    write_json(file, other);
    EXPECT_THAT(explain({"n16"}).exit_code, testing::AnyOf(0, 3)) << key;
    other.erase(key);
    write_json(file, other);
    EXPECT_EQ(explain({"n16"}).exit_code, 3) << key;
  }
  record["results"]["render"] = "../../../outside";
  write_json(file, record);
  EXPECT_EQ(explain({"n16"}).exit_code, 3);
}

}  // namespace
}  // namespace lobelia
