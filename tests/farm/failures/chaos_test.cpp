// Farms with faults at random, several at a time; afterwards the same command must end as if nothing had happened.
//
// LOBELIA_RANDOM_SEED is the seed of the first round, LOBELIA_RANDOM_SECONDS for how long rounds go on (60 without
// it); `make chaos` sets both. A round that fails tells its seed, with which it is the first one again.
#include <signal.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <thread>

#include "base/words/text.hpp"
#include "failing_farm.hpp"

namespace lobelia {
namespace {

using testing::AnyOf;

std::uint64_t number_of(const char* variable, std::uint64_t otherwise) {
  const char* text = std::getenv(variable);
  long long value = 0;
  return text && parse_integer(text, value) && value >= 0 ? std::uint64_t(value) : otherwise;
}

/// A farm that is disturbed in its files, at its work and by its engines, beside files of others that it must leave alone.
/// The law: whatever happens, the same command ends as if nothing had.
class Chaos : public FailingFarm {
 protected:
  Chaos() {
    grid({"8", "16", "32", "64", "128", "256"});
    undisturbed();
    // They look as if they were ours.
    const std::string key(64, 'a');
    for (const std::string& name : std::vector<std::string>{
             "notes.txt", "lobelia.exr", "cell.json", "result.json", "n8/povray.exr",
             "n8/notes.txt", "aa/" + key + "/result.json", "aa/" + key + ".json",
             "0123456789abcdef/lobelia.exr", ".lobelia.exr.1-1.part"}) {
      fs::create_directories((precious() / name).parent_path());
      write_file(precious() / name, name);
    }
    precious_before_ = everything_in(precious());
  }

  fs::path precious() const { return precious_directory_.path(); }

  // ---- choices
  std::size_t below(std::size_t count) { return std::size_t(random_() % count); }
  bool one_in(std::size_t count) { return below(count) == 0; }
  template <class T>
  const T& any_of(const std::vector<T>& all) {
    return all[below(all.size())];
  }
  std::string any_cell() {
    return any_of<std::string>({"n8", "n16", "n32", "n64", "n128", "n256"});
  }

  std::vector<fs::path> entries(const fs::path& directory, bool files) const {
    std::vector<fs::path> found;
    if (!is_here(directory)) return found;
    std::error_code gone;  // a farm may be at work there
    for (fs::recursive_directory_iterator entry(directory, gone), end; !gone && entry != end;
         entry.increment(gone))
      if (const auto type = entry->symlink_status(gone).type();
          !gone && type == (files ? fs::file_type::regular : fs::file_type::directory))
        found.push_back(entry->path());
    std::sort(found.begin(), found.end());
    return found;
  }

  /// Whether it is not behind a link: the faults, too, leave others' files alone.
  bool is_here(const fs::path& path) const {
    std::error_code gone;
    const fs::path real = fs::weakly_canonical(path, gone);
    return !gone && real == fs::canonical(root()) / path.lexically_relative(root());
  }
  /// A file with content that is ours to judge: one in cells/ may be the same file.
  fs::path any_file() { return any(entries(one_in(3) ? out() : cache() / "results", true)); }
  fs::path any(const std::vector<fs::path>& found) {
    return found.empty() ? fs::path() : any_of(found);
  }

  /// Gives up an engine that hangs, long before the test would.
  std::vector<std::string> impatient_command() const {
    return command({"--no-progress-limit", "4", "--time-limit", "30"});
  }
  void wait_a_moment() { std::this_thread::sleep_for(std::chrono::milliseconds(below(400))); }
  /// Living processes with these words on their command line, except farms.
  std::vector<int> processes_with(const std::string& words) const {
    std::vector<int> found;
    std::error_code ignored;
    for (const auto& entry : fs::directory_iterator("/proc", ignored)) {
      long long pid = 0;
      if (!parse_integer(entry.path().filename().string(), pid)) continue;
      const std::string line = command_line_of(entry.path());
      if (line.find(words) != line.npos && line.find("grid.xml") == line.npos && pid != ::getpid())
        found.push_back(int(pid));
    }
    return found;
  }

  // ---- to files
  void flip_a_bit() {
    const fs::path file = any_file();
    std::error_code gone;
    const auto size = file.empty() ? 0 : fs::file_size(file, gone);
    if (gone || size == 0) return;
    fs::permissions(file, fs::perms::owner_write, fs::perm_options::add, gone);
    std::fstream bytes(file, std::ios::in | std::ios::out | std::ios::binary);
    const auto at = std::streamoff(below(size));
    bytes.seekg(at);
    const char changed = char(bytes.get() ^ (1 << below(8)));
    bytes.seekp(at);
    bytes.put(changed);
  }
  void cut_a_file() {
    const fs::path file = any_file();
    std::error_code gone;
    if (const auto size = file.empty() ? 0 : fs::file_size(file, gone); !gone && size > 0)
      fs::resize_file(file, below(size), gone);
  }
  void remove_a_file() {
    std::error_code gone;
    if (const fs::path file = any_file(); !file.empty()) fs::remove(file, gone);
  }
  void replace_a_file() {
    const fs::path file = any_file();
    std::error_code gone;
    if (file.empty() || !fs::remove(file, gone)) return;
    if (one_in(3))
      fs::create_directory(file, gone);
    else if (one_in(2))
      ::mkfifo(file.c_str(), 0600);
    else
      fs::create_symlink(precious() / "lobelia.exr", file, gone);
  }
  void write_nonsense() {
    // Not the cache's marker: another layout is refused, as it should be.
    const fs::path file =
        any_of<fs::path>({out() / "farm.json", out() / "cells" / any_cell() / "cell.json"});
    std::error_code gone;
    if (!fs::exists(file, gone) || !is_here(file)) return;
    std::ofstream(file, std::ios::trunc)
        << any_of<std::string>({"", "{", "[]", "null", "{\"kind\":7}"});
  }
  void lose_a_part_of_the_cache() {
    std::vector<fs::path> parts{
        cache(),           cache() / "results",      cache() / "failures", cache() / "making",
        cache() / "locks", cache() / "lobelia-cache"};
    if (const fs::path one = any(entries(cache(), false)); !one.empty()) parts.push_back(one);
    std::error_code gone;
    fs::remove_all(any_of(parts), gone);
  }
  void lose_a_part_of_the_farm() {
    std::error_code gone;
    const fs::path part =
        any_of<fs::path>({out(), out() / "cells", out() / "farm.json", out() / "cells" / any_cell(),
                          out() / "cells" / any_cell() / "cell.json"});
    if (is_here(part.parent_path())) fs::remove_all(part, gone);
  }
  void rename_the_cache() {
    std::error_code gone;
    fs::rename(cache(), root() / fmt::format("elsewhere-{}", random_()), gone);
  }
  /// As an attacker would, or somebody who ran out of disk.
  void put_a_link_in_its_place() {
    std::vector<fs::path> places{cache() / "making", cache() / "results", cache() / "failures",
                                 out() / "cells", out() / "cells" / any_cell()};
    if (const fs::path shelf = any(entries(cache() / "results", false)); !shelf.empty())
      places.push_back(shelf);
    const fs::path place = any_of(places);
    std::error_code gone;
    if (!is_here(place.parent_path())) return;
    fs::remove_all(place, gone);
    fs::create_directories(place.parent_path(), gone);
    fs::create_directory_symlink(precious(), place, gone);
    if (!gone) links_.insert(place);
  }
  void lose_temporary_files() {
    for (const fs::path& directory : entries(root() / "tmp", false)) {
      std::error_code gone;
      fs::remove_all(directory, gone);
    }
  }
  void leave_a_part_behind() {
    std::error_code gone;
    if (const fs::path cell = out() / "cells" / any_cell();
        fs::is_directory(cell, gone) && is_here(cell))
      std::ofstream(cell / ".lobelia.exr.4194303-7.part") << "half";
  }

  // ---- to a farm at work
  void signal(RunningFarm& farm, int number) {
    farm.signal(number);
    ended_by_ = number;
  }
  void stop_for_a_while(RunningFarm& farm) {
    farm.signal(SIGSTOP);
    wait_a_moment();
    farm.signal(SIGCONT);
  }
  /// As `ulimit` would, but in the middle.
  void limit(const RunningFarm& farm, int resource, std::uint64_t most) {
    const rlimit bounds{most, most};
    ::prlimit(farm.pid(), __rlimit_resource(resource), &bounds, nullptr);
  }
  void run_beside(std::vector<std::string> arguments) {
    beside_.push_back(std::make_unique<RunningFarm>(std::move(arguments), root()));
  }
  void kill_an_engine() {
    const auto engines = processes_with((root() / "povray").string());
    if (!engines.empty()) ::kill(any_of(engines), SIGKILL);
  }

  struct Fault {
    const char* name;
    std::function<void(Chaos&)> at_rest;                ///< before a farm and while one is at work
    std::function<void(Chaos&, RunningFarm&)> at_work;  ///< only while one is at work
  };
  static const std::vector<Fault>& faults();

  /// Misdeeds of engines, as shell for one cell.
  struct Misdeed {
    const char* name;
    const char* shell;
  };
  static constexpr Misdeed kMisdeeds[] = {
      {"engine crashes", "kill -SEGV $$"},
      {"engine fails", "echo Error: no memory; exit 3"},
      {"engine writes nothing", "exit 0"},
      {"engine writes nonsense", "head -c 5000 /dev/urandom > $stem.exr; exit 0"},
      {"engine writes a hole of 20 GB", "truncate -s 20G $stem.exr; exit 0"},
      {"engine hangs", "sleep 86400"},
      {"engine leaves children of another session",
       "setsid sh -c 'sleep 86400; exit' stray-$$ > /dev/null 2>&1 < /dev/null &"},
      {"engine behind a wrapper that ignores signals",
       "trap '' TERM INT HUP; sh -c 'sleep 0.3; exit' stray-$$"},
  };

  void round(std::uint64_t seed);
  void episode();
  void mend();

  std::mt19937_64 random_;
  const TemporaryDirectory precious_directory_;
  Results precious_before_;
  std::set<fs::path> links_;
  std::vector<std::unique_ptr<RunningFarm>> beside_;
  int ended_by_ = 0;
  std::set<std::string> used_;  ///< faults of this round
  std::string story_;           ///< of this round
  std::map<std::string, int> rounds_with_;
};

const std::vector<Chaos::Fault>& Chaos::faults() {
  static const auto signal = [](int number) {
    return [number](Chaos& self, RunningFarm& farm) { self.signal(farm, number); };
  };
  static const auto limit = [](int resource, std::uint64_t most) {
    return [resource, most](Chaos& self, RunningFarm& farm) { self.limit(farm, resource, most); };
  };
  static const auto beside = [](std::vector<std::string> arguments) {
    return [arguments](Chaos& self, RunningFarm&) { self.run_beside(arguments); };
  };
  static const std::vector<Fault> all{
      {"bit flipped", &Chaos::flip_a_bit, {}},
      {"file cut", &Chaos::cut_a_file, {}},
      {"file removed", &Chaos::remove_a_file, {}},
      {"file replaced by a link, a pipe or a directory", &Chaos::replace_a_file, {}},
      {"record overwritten", &Chaos::write_nonsense, {}},
      {"cache lost, whole or in part", &Chaos::lose_a_part_of_the_cache, {}},
      {"farm's directory lost, whole or in part", &Chaos::lose_a_part_of_the_farm, {}},
      {"cache renamed", &Chaos::rename_the_cache, {}},
      {"directory replaced by a link to others' files", &Chaos::put_a_link_in_its_place, {}},
      {"temporary files lost", &Chaos::lose_temporary_files, {}},
      {"half a file left behind", &Chaos::leave_a_part_behind, {}},
      {"kill -9", {}, signal(SIGKILL)},
      {"SIGTERM", {}, signal(SIGTERM)},
      {"Ctrl-C", {}, signal(SIGINT)},
      {"SIGHUP", {}, signal(SIGHUP)},
      {"stopped and continued", {}, &Chaos::stop_for_a_while},
      {"engine killed", {}, [](Chaos& self, RunningFarm&) { self.kill_an_engine(); }},
      {"ulimit -f", {}, limit(RLIMIT_FSIZE, 3000)},
      {"ulimit -n", {}, limit(RLIMIT_NOFILE, 12)},
      {"ulimit -v", {}, limit(RLIMIT_AS, 1 << 28)},
      {"second farm, same directory",
       {},
       [](Chaos& self, RunningFarm&) { self.run_beside(self.impatient_command()); }},
      {"second farm, same cache",
       {},
       [](Chaos& self, RunningFarm&) {
         auto arguments = self.impatient_command();
         arguments[3] = "beside";
         self.run_beside(arguments);
       }},
      {"gc beside it", {}, beside({"farm", "gc", "cache", "--max-size", "20K"})},
      {"clean beside it", {}, beside({"farm", "clean", "out", "--all"})},
      {"verify beside it", {}, beside({"farm", "verify", "out", "--remove"})},
  };
  return all;
}

/// Runs a farm and disturbs it.
void Chaos::episode() {
  const auto choose = [&]() -> const Fault& {
    const Fault& fault = any_of(faults());
    used_.insert(fault.name);
    story_ += fmt::format("  {}\n", fault.name);
    return fault;
  };
  std::string shell;
  for (const Misdeed& misdeed : kMisdeeds) {
    if (!one_in(12)) continue;
    used_.insert(misdeed.name);
    const std::string cell = any_cell();
    story_ += fmt::format("  {}: {}\n", cell, misdeed.name);
    shell += fmt::format("if [ $cell = {} ]; then {}\nfi\n", cell, misdeed.shell);
  }
  fake_povray(shell);
  const std::size_t before = below(3), meanwhile = below(3);
  for (std::size_t i = 0; i < before; ++i)
    if (const Fault& fault = choose(); fault.at_rest) fault.at_rest(*this);

  const std::string stderr_or_not = one_in(8) ? "/dev/full" : "";
  if (!stderr_or_not.empty()) {
    used_.insert("stdout and stderr full");
    story_ += "  stdout and stderr full\n";
  }
  story_ += "  farm\n";
  RunningFarm farm(impatient_command(), root(), {}, stderr_or_not);
  ended_by_ = 0;
  for (std::size_t i = 0; i < meanwhile; ++i) {
    wait_a_moment();
    const Fault& fault = choose();
    if (fault.at_rest)
      fault.at_rest(*this);
    else if (!farm.has_ended())
      fault.at_work(*this, farm);
  }
  const int code = farm.wait();
  story_ += fmt::format("  ended with {}\n", code);
  if (code != 128 + ended_by_) {
    EXPECT_THAT(code, AnyOf(0, 1, 3, 4, 5, 71, 129, 130, 143)) << "no crash and no internal error\n"
                                                               << farm.output();
    if (code == 71) {
      EXPECT_THAT(story_, HasSubstr("ulimit")) << farm.output();
    }
  }
  for (auto& one : beside_) {
    const int other = one->wait();
    EXPECT_THAT(other, AnyOf(0, 1, 3, 4, 5)) << one->output();
  }
  beside_.clear();
}

/// Repairs what a farm cannot know to be wrong.
void Chaos::mend() {
  std::error_code gone;
  for (const fs::path& link : links_)
    if (fs::is_symlink(link, gone)) fs::remove(link, gone);
  links_.clear();
  // A farm does not remove a directory or a link in its place.
  if (!fs::is_regular_file(out() / "farm.json")) fs::remove_all(out() / "farm.json", gone);
  fs::remove_all(root() / "beside", gone);
  for (const auto& entry : fs::directory_iterator(root()))
    if (entry.path().filename().native().starts_with("elsewhere-"))
      fs::remove_all(entry.path(), gone);
  fake_povray();
}

void Chaos::round(std::uint64_t seed) {
  random_.seed(seed);
  used_.clear();
  story_.clear();
  if (one_in(2))
    for (const fs::path& directory : {out(), cache()}) fs::remove_all(directory);
  for (std::size_t episodes = 1 + below(3); episodes > 0; --episodes) episode();
  EXPECT_THAT(differences(precious_before_, everything_in(precious())), IsEmpty())
      << "others' files were touched";
  EXPECT_TRUE(end_soon(processes_with("stray-"))) << "an engine's child lives on";
  EXPECT_TRUE(end_soon(processes_with((root() / "povray").string()))) << "an engine lives on";
  mend();
  const FarmRun last = run();
  EXPECT_EQ(last.exit_code, 0) << last.output;
  if (last.exit_code == 0) expect_mended(last);
  EXPECT_THAT(differences(precious_before_, everything_in(precious())), IsEmpty())
      << "others' files were touched";
  used_.insert("(rounds)");
  for (const std::string& name : used_) ++rounds_with_[name];
}

TEST_F(Chaos, ChangesNoResultOfTheSameCommand) {
  const std::uint64_t first = number_of("LOBELIA_RANDOM_SEED", 1);
  const auto end = std::chrono::steady_clock::now() +
                   std::chrono::seconds(number_of("LOBELIA_RANDOM_SECONDS", 60));
  std::uint64_t seed = first;
  do {
    round(seed);
    if (HasFailure()) {
      ADD_FAILURE() << "again: LOBELIA_RANDOM_SEED=" << seed << " LOBELIA_RANDOM_SECONDS=0\n"
                    << story_;
      break;
    }
    ++seed;
  } while (std::chrono::steady_clock::now() < end);
  std::string table = fmt::format("seeds {} to {}\n rounds  fault\n", first, seed - 1);
  for (const auto& [name, rounds] : rounds_with_) table += fmt::format("{:>7}  {}\n", rounds, name);
  std::fputs(table.c_str(), stdout);
}

}  // namespace
}  // namespace lobelia
