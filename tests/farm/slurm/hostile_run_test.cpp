// Farms' directories with the record of a run that a stranger wrote.
#include <iterator>

#include "base/records/record.hpp"
#include "farm/slurm/slurm_farm.hpp"
#include "tests/farm/farm_fixture.hpp"
#include "tests/test.hpp"
#include "tests/thrown.hpp"

namespace lobelia {
namespace {

class HostileRun : public FarmTest {
 protected:
  HostileRun() {
    // Without Slurm, so that a run that is gone on with ends before it submits anything.
    ::setenv("PATH", here("bin").c_str(), 1);
    make_directories(slurm_run_directory(out()));
    own_identity().put_into(record_);
    record_.grid = here("grid.xml").string();
    record_.directory = out().string();
    record_.cache = (out() / "cache").string();
    record_.command = {"lobelia"};
  }
  ~HostileRun() override { ::setenv("PATH", path_.c_str(), 1); }
  fs::path here(const std::string& name) const { return directory_.path() / name; }
  /// How the run ends: its exit code, and why.
  std::pair<ExitCode, std::string> attached(const Leave& leave = {}) const {
    records::write_record(slurm_run_directory(out()) / "run.json", record_);
    const Error error = thrown_by([&] { attach_to_slurm_run(out(), {}, leave); });
    return {error.code(), error.what()};
  }
  /// The same of its last element, as it was submitted or after the record was changed.
  std::pair<ExitCode, std::string> finished(const Leave& leave = {},
                                            const records::FarmRun* planned = nullptr) const {
    records::FarmRun hashed = planned ? *planned : record_;
    hashed.command.clear();
    const Error error = thrown_by([&] {
      finish_slurm_run(slurm_run_directory(out()), sha256(records::record_text(hashed)), leave);
    });
    return {error.code(), error.what()};
  }
  bool is_untouched() const { return files_in_farm() == 1 && !fs::exists(here("started")); }
  std::size_t files_in_farm() const {
    return std::size_t(std::distance(fs::directory_iterator(out()), fs::directory_iterator()));
  }
  /// Answers as POV-Ray does, and leaves a trace.
  fs::path evil_povray() const {
    write_file(here("povray"), fmt::format("#!/bin/sh\n: > '{}'\necho 'POV-Ray 3.7.0.10' >&2\n",
                                           here("started").string()));
    fs::permissions(here("povray"), fs::perms::owner_all);
    return here("povray");
  }

  records::FarmRun record_;

 private:
  const std::string path_ = std::getenv("PATH");
};

TEST_F(HostileRun, StartsNoProgramOfItsRecordWithoutLeave) {
  grid("16", "<engine name=\"povray\"/>");
  const std::string program = evil_povray().string();
  record_.programs = {{"povray", program}};
  const auto [code, why] = attached();
  EXPECT_EQ(code, ExitCode::kUsage);
  EXPECT_THAT(why,
              AllOf(HasSubstr("start '" + program + "' as povray"), HasSubstr("--allow-commands")));
  EXPECT_EQ(finished().first, ExitCode::kUsage);
  EXPECT_TRUE(is_untouched());
  EXPECT_EQ(attached(Leave::of_user(true)).first, ExitCode::kEngine) << "there is no Slurm";
  EXPECT_TRUE(fs::exists(here("started")));
}

TEST_F(HostileRun, StartsNoProgramOfItsGridWithoutLeave) {
  grid("16",
       "<engine name=\"mine\" command=\"evil {scene} {out}\" version-command=\"evil --version\"/>");
  const auto [code, why] = attached();
  EXPECT_EQ(code, ExitCode::kUsage);
  EXPECT_THAT(why, AllOf(HasSubstr("start 'evil --version' by engine mine"),
                         HasSubstr("--allow-commands")));
  EXPECT_TRUE(is_untouched());
}

TEST_F(HostileRun, TrustsAGridNoMoreThanItsRecord) {
  grid("16", "<engine name=\"mine\" command=\"evil {scene} {out}\"/>");
  make_directories(here("trusted"));
  fs::rename(here("grid.xml"), here("trusted/grid.xml"));
  record_.grid = here("trusted/grid.xml").string();
  ::setenv("LOBELIA_ALLOW_COMMANDS_IN", here("trusted").c_str(), 1);
  EXPECT_EQ(attached().first, ExitCode::kUsage);
  ::setenv("LOBELIA_ALLOW_COMMANDS_IN", directory_.path().c_str(), 1);
  EXPECT_EQ(attached().first, ExitCode::kEngine) << "the record lies in a trusted folder too";
  ::unsetenv("LOBELIA_ALLOW_COMMANDS_IN");
}

TEST_F(HostileRun, WritesOutsideOfItsFarmOnlyWithLeave) {
  grid("16");
  record_.cache = here("elsewhere").string();
  record_.gallery = here("site").string();
  const auto [code, why] = attached();
  EXPECT_EQ(code, ExitCode::kUsage);
  EXPECT_THAT(why, AllOf(HasSubstr("write into the cache '" + record_.cache + "'"),
                         HasSubstr("write a gallery into '" + record_.gallery + "'")));
  EXPECT_EQ(finished().first, ExitCode::kUsage);
  for (const char* name : {"elsewhere", "site"}) EXPECT_FALSE(fs::exists(here(name))) << name;
  EXPECT_TRUE(is_untouched());
}

TEST_F(HostileRun, WritesThroughNoLinkInItsFolder) {
  grid("16");
  make_directories(here("elsewhere"));
  fs::create_directory_symlink(here("elsewhere"), slurm_run_directory(out()) / "chunks");
  const auto [code, why] = attached(Leave::of_user(true));
  EXPECT_EQ(code, ExitCode::kOutput);
  EXPECT_THAT(why, HasSubstr("chunks: cannot write: a symbolic link"));
  EXPECT_TRUE(fs::is_empty(here("elsewhere")));
}

TEST_F(HostileRun, IsNotEndedByALateChangeOfItsRecord) {
  grid("16");
  const records::FarmRun planned = record_;
  const auto change = [&](auto member, const std::string& to) {
    record_ = planned;
    record_.*member = to;
    records::write_record(slurm_run_directory(out()) / "run.json", record_);
    const auto [code, why] = finished(Leave::of_user(true), &planned);
    EXPECT_EQ(code, ExitCode::kInput) << to;
    EXPECT_THAT(why, HasSubstr("other things than when this job was submitted")) << to;
    EXPECT_TRUE(is_untouched());
  };
  change(&records::FarmRun::gallery, here("site").string());
  change(&records::FarmRun::cache, here("elsewhere").string());
  change(&records::FarmRun::grid, here("evil.xml").string());
  // Another client of the run may have another command.
  record_ = planned;
  record_.command = {"lobelia", "farm", "--detach"};
  records::write_record(slurm_run_directory(out()) / "run.json", record_);
  EXPECT_EQ(finished(Leave::of_user(true), &planned), std::pair(ExitCode::kSuccess, std::string()));
}

TEST_F(HostileRun, NeedsLeaveForACacheBehindALinkInTheFarm) {
  grid("16");
  make_directories(here("elsewhere"));
  fs::create_directory_symlink(here("elsewhere"), out() / "cache");
  EXPECT_EQ(attached().first, ExitCode::kUsage);
  EXPECT_TRUE(fs::is_empty(here("elsewhere")));
}

TEST_F(HostileRun, ARunOfAnotherFarmIsRefused) {
  grid("16");
  make_directories(here("other"));
  record_.directory = here("other").string();
  const auto [code, why] = attached(Leave::of_user(true));
  EXPECT_EQ(code, ExitCode::kInput);
  EXPECT_THAT(why, HasSubstr("a run of the farm in '" + record_.directory + "'"));
  EXPECT_TRUE(fs::is_empty(here("other")));
}

}  // namespace
}  // namespace lobelia
