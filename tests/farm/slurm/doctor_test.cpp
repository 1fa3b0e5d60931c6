#include "farm/slurm/doctor.hpp"

#include "tests/farm/slurm/fake_slurm.hpp"
#include "tests/json.hpp"
#include "tests/test.hpp"

namespace lobelia {
namespace {

using Verdict = DoctorCheck::Verdict;

class Doctor : public FakeSlurm {
 protected:
  Doctor() {
    checked.directory = in("shared");
    checked.program = LOBELIA_DOCTOR_NODE;
    checked.node_limit = std::chrono::minutes(10);
    checked.poll = std::chrono::milliseconds(20);
    checked.call_limit = std::chrono::minutes(10);
    config("MaxArraySize = 1001\nKillWait = 30 sec\nSlurmdTimeout = 300 sec");
  }
  void config(const std::string& text) {
    fake("scontrol",
         fmt::format("case $1 in ping) echo 'Slurmctld(primary) at vm is UP';; *) echo '{}';; esac",
                     text));
  }
  /// The one check that is not ok, and nothing else is wrong.
  DoctorCheck only_complaint() {
    const auto checks = doctor(checked);
    DoctorCheck found;
    int complaints = 0;
    for (const auto& check : checks)
      if (check.verdict != Verdict::kOk) {
        found = check;
        ++complaints;
      }
    EXPECT_EQ(complaints, 1) << doctor_text(checks);
    EXPECT_EQ(worst_of(checks), found.verdict);
    return found;
  }

  DoctorOptions checked;
};

TEST_F(Doctor, FindsNothingWrongWithASoundCluster) {
  const auto checks = doctor(checked);
  EXPECT_EQ(worst_of(checks), Verdict::kOk) << doctor_text(checks);
  EXPECT_EQ(checks.size(), 12u) << doctor_text(checks);
  EXPECT_TRUE(fs::is_empty(in("shared")));
  EXPECT_THAT(doctor_text(checks), HasSubstr("ok       hard links on a node: they work\n"));
}

TEST_F(Doctor, NamesAbsentProgramsFirst) {
  fs::remove(bin() / "sinfo");
  ::setenv("PATH", bin().c_str(), 1);
  const auto complaint = only_complaint();
  EXPECT_EQ(complaint.verdict, Verdict::kFailed);
  EXPECT_THAT(complaint.found, HasSubstr("not in $PATH: sinfo"));
  EXPECT_EQ(doctor(checked).size(), 1u);
}

TEST_F(Doctor, SeesAControllerThatIsDown) {
  fake("scontrol", "echo 'Slurmctld(primary) at vm is DOWN'");
  EXPECT_EQ(only_complaint().name, "controller");
}

TEST_F(Doctor, SeesLimitsThatHurt) {
  config("MaxArraySize = 1\nKillWait = 30 sec\nSlurmdTimeout = 300 sec");
  EXPECT_EQ(only_complaint().name, "MaxArraySize");
  config("MaxArraySize = 50\nKillWait = 30 sec\nSlurmdTimeout = 300 sec");
  EXPECT_EQ(only_complaint().verdict, Verdict::kWarning);
  config("MaxArraySize = 1001\nKillWait = 1 sec\nSlurmdTimeout = 300 sec");
  EXPECT_EQ(only_complaint().name, "KillWait");
  config("MaxArraySize = 1001\nKillWait = 30 sec\nSlurmdTimeout = 0 sec");
  EXPECT_EQ(only_complaint().name, "SlurmdTimeout");
}

TEST_F(Doctor, SeesAPartitionWithoutUsableNodes) {
  checked.slurm.partition = "none";
  EXPECT_THAT(only_complaint().found, HasSubstr("'none'"));
  checked.slurm.partition = "";
  fake("sinfo", "for n in n1 n2 n3; do echo \"$n|render*|up|drain|1|0/0/2/2\"; done");
  EXPECT_THAT(only_complaint().found, HasSubstr("0 of 3 nodes"));
}

TEST_F(Doctor, QuotesAJobThatIsRefused) {
  fake("sbatch", "echo 'sbatch: error: Batch job submission failed: Invalid account' >&2; exit 1");
  EXPECT_THAT(only_complaint().found, HasSubstr("Invalid account"));
}

TEST_F(Doctor, SeesAJobWithoutAnAnswer) {
  fake("sbatch", "echo 100");
  auto complaint = only_complaint();
  EXPECT_THAT(complaint.found, HasSubstr("left no answer"));
  EXPECT_THAT(complaint.advice, HasSubstr(in("shared").string()));
  fake("squeue", "echo 'N/A|PENDING|Priority|'");
  checked.node_limit = std::chrono::milliseconds(500);
  EXPECT_THAT(only_complaint().found, HasSubstr("PENDING (Priority)"));
  EXPECT_THAT(lines("cancelled").back(), HasSubstr("lobelia-doctor-"));
}

/// The answer of a node with a fault of that kind.
TEST_F(Doctor, SeesEachFaultOfANode) {
  const auto with = [&](const std::string& key, const std::string& value) {
    write_file(
        in("node"),
        fmt::format(
            "#!/bin/sh\n{} \"$@\"\nsed -i 's|\"{}\": \".*\"|\"{}\": \"{}\"|' \"$3/node.json\"\n",
            shell_quote(LOBELIA_DOCTOR_NODE), key, key, value));
    fs::permissions(in("node"), fs::perms::owner_all);
    checked.program = in("node");
    return only_complaint();
  };
  EXPECT_EQ(with("token", "other").name, "directory on a node");
  EXPECT_EQ(with("version", "lobelia 9.9.9").name, "program on a node");
  EXPECT_EQ(with("rename", "odd").name, "renaming on a node");
  EXPECT_EQ(with("link", "Operation not permitted").name, "hard links on a node");
  EXPECT_EQ(with("link", "Operation not permitted").verdict, Verdict::kFailed);
  const auto lock = with("lock", "no locks");
  EXPECT_EQ(lock.name, "locks across machines");
  EXPECT_EQ(lock.verdict, Verdict::kWarning);
  EXPECT_THAT(lock.advice, HasSubstr("one client"));
}

TEST_F(Doctor, SeesOnANodeALockThatIsGivenAwayTwice) {
  fs::create_directories(in("shared"));
  write_file(in("shared") / "token", "t");
  doctor_on_node(in("shared"));  // nobody holds it
  const Json answer = read_json(in("shared") / "node.json");
  EXPECT_THAT(answer["lock"].get<std::string>(), HasSubstr("given away again"));
  EXPECT_EQ(answer["rename"], "");
  EXPECT_EQ(answer["link"], "");
  EXPECT_EQ(answer["token"], "t");
}

}  // namespace
}  // namespace lobelia
