#include "failing_farm.hpp"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <thread>

#include "base/pictures/image_io.hpp"
#include "base/system/sha256.hpp"
#include "base/words/text.hpp"
#include "farm/grid.hpp"
#include "lobelia_paths.hpp"
#include "reference_scenes/engines/povray/povray_input.hpp"
#include "reference_scenes/preparation.hpp"
#include "renderer/render.hpp"
#include "tests/json.hpp"

extern char** environ;

namespace lobelia {
namespace {

constexpr std::uint64_t kMaxBytes = 1 << 28;

/// Drops who made a record, when, and at what cost.
void forget_circumstances(Json& record) {
  for (const char* key : {"seconds", "cpuSeconds", "peakMemoryBytes", "engineCommands", "command",
                          "host", "cache", "locks", "threads", "plan"})
    record.erase(key);
  // A cell's hashes are of records that have all that.
  if (record.value("kind", "") == "cell")
    for (const char* key : {"files", "seal"}) record.erase(key);
  // As many as there was work for at the time.
  if (record.contains("engineOptions"))
    std::erase_if(record["engineOptions"].get_ref<Json::array_t&>(), [](const Json& option) {
      return option.get<std::string>().starts_with("Work_Threads=");
    });
}

std::string first_difference(const std::string& a, const std::string& b) {
  const auto at =
      std::size_t(std::mismatch(a.begin(), a.end(), b.begin(), b.end()).first - a.begin());
  const std::size_t from = at > 40 ? at - 40 : 0;
  return fmt::format("'{}', not '{}'", printable(b.substr(from, 80), 200),
                     printable(a.substr(from, 80), 200));
}

struct ProcessState {
  std::string name, state, parent;
  /// A zombie is not, and where process 1 reaps late there are many.
  bool is_alive() const { return !state.empty() && state != "Z" && state != "X"; }
};

/// Empty if there is no such process: they come and go while we look.
ProcessState state_of(const fs::path& process) {
  std::ifstream file(process / "stat");
  std::string text;  // "123 (povray) S 100 ..."
  if (!std::getline(file, text)) return {};
  const auto open = text.find('('), close = text.rfind(')');
  if (open == text.npos || close == text.npos) return {};
  const auto fields = split(text.substr(close + 1), " ");
  if (fields.size() < 2) return {};
  return {text.substr(open + 1, close - open - 1), fields[0], fields[1]};
}

bool is_asked_its_version(const fs::path& process) {
  return command_line_of(process).find("--version") != std::string::npos;
}

std::size_t number_before(const std::string& text, const std::string& words) {
  const auto end = text.rfind(words);
  if (end == text.npos) return 0;
  auto begin = end;
  while (begin > 0 && std::isdigit(static_cast<unsigned char>(text[begin - 1]))) --begin;
  return std::stoul("0" + text.substr(begin, end - begin));
}

}  // namespace

Results results_of(const fs::path& farm_directory) {
  Results results;
  const auto take = [&](const fs::path& file, const std::string& name) {
    std::string text = read_file(file, kMaxBytes);
    if (name.ends_with(".log")) text.clear();
    if (name.ends_with(".json")) {
      Json record = Json::parse(text);
      forget_circumstances(record);
      text = record.dump(1);
    }
    results[name] = std::move(text);
  };
  take(farm_directory / "farm.json", "farm.json");
  for (const auto& entry : fs::recursive_directory_iterator(farm_directory / "cells"))
    if (entry.is_regular_file())
      take(entry.path(), entry.path().lexically_relative(farm_directory).string());
  return results;
}

std::vector<std::string> differences(const Results& a, const Results& b) {
  std::vector<std::string> names;
  for (const auto& [name, bytes] : a) {
    const auto there = b.find(name);
    if (there == b.end())
      names.push_back(name + " is missing");
    else if (there->second != bytes)
      names.push_back(name + ": " + first_difference(bytes, there->second));
  }
  for (const auto& [name, bytes] : b)
    if (!a.contains(name)) names.push_back(name + " is too much");
  return names;
}

Results everything_in(const fs::path& directory) {
  Results found;
  for (const auto& entry : fs::recursive_directory_iterator(directory)) {
    struct stat status {};
    ::lstat(entry.path().c_str(), &status);
    found[entry.path().lexically_relative(directory).string()] = fmt::format(
        "{:o} {} {}.{} {}", status.st_mode, status.st_ino, status.st_mtim.tv_sec,
        status.st_mtim.tv_nsec, S_ISREG(status.st_mode) ? hex(sha256_of_file(entry.path())) : "");
  }
  return found;
}

RunningFarm::RunningFarm(std::vector<std::string> arguments, const fs::path& directory,
                         const std::vector<std::string>& environment, const fs::path& output) {
  static int count = 0;
  output_ = output.empty() ? directory / fmt::format("output-{}.txt", count++) : output;
  arguments.insert(arguments.begin(), LOBELIA_PROGRAM);
  std::vector<std::string> variables = environment;
  // Where tests put what is temporary, so that what stays behind can be seen.
  variables.push_back("TMPDIR=" + (directory / "tmp").string());
  for (char** variable = environ; *variable; ++variable)
    if (const std::string_view text = *variable;
        !text.starts_with("TMPDIR=") && !text.starts_with("LOBELIA_CACHE="))
      variables.emplace_back(text);
  std::vector<char*> argv, envp;
  for (auto& argument : arguments) argv.push_back(argument.data());
  for (auto& variable : variables) envp.push_back(variable.data());
  argv.push_back(nullptr);
  envp.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, 0, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&actions, 1, output_.c_str(), O_WRONLY | O_CREAT | O_APPEND,
                                   0666);
  posix_spawn_file_actions_adddup2(&actions, 1, 2);
  posix_spawn_file_actions_addchdir_np(&actions, directory.c_str());
  const int error = posix_spawn(&pid_, argv[0], &actions, nullptr, argv.data(), envp.data());
  posix_spawn_file_actions_destroy(&actions);
  if (error != 0) throw std::runtime_error("the program cannot be started");
}

RunningFarm::~RunningFarm() {
  if (exit_code_ >= 0) return;
  ::kill(pid_, SIGKILL);
  ::waitpid(pid_, nullptr, 0);
}

void RunningFarm::signal(int number) const {
  if (exit_code_ < 0) ::kill(pid_, number);  // else the number may be another's by now
}

std::string RunningFarm::output() const {
  return fs::is_regular_file(output_) ? read_file(output_, 1 << 26) : "";
}

bool RunningFarm::has_ended() {
  int status = 0;
  if (exit_code_ < 0 && ::waitpid(pid_, &status, WNOHANG) == pid_)
    exit_code_ = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  return exit_code_ >= 0;
}

int RunningFarm::wait() {
  const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(30);
  while (!has_ended()) {
    if (std::chrono::steady_clock::now() > end) {
      signal(SIGKILL);
      throw std::runtime_error("it does not end: " + output());
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  return exit_code_;
}

std::vector<int> RunningFarm::engines(const std::string& name) const {
  std::map<std::string, std::string> parents;
  std::vector<int> found;
  std::error_code ignored;
  const auto is_ours = [&](std::string process) {
    while (process != std::to_string(pid_) && parents.contains(process)) process = parents[process];
    return process == std::to_string(pid_);
  };
  for (const auto& entry : fs::directory_iterator("/proc", ignored))
    if (const ProcessState process = state_of(entry.path()); !process.parent.empty())
      parents[entry.path().filename()] = process.parent;
  for (const auto& [process, parent] : parents) {
    const fs::path entry = fs::path("/proc") / process;
    const ProcessState state = state_of(entry);
    if (state.name == name && state.is_alive() && is_ours(parent) && !is_asked_its_version(entry))
      found.push_back(std::stoi(process));
  }
  return found;
}

std::string command_line_of(const fs::path& process) {
  std::ostringstream words;
  words << std::ifstream(process / "cmdline")
               .rdbuf();  // a process that goes meanwhile fails here, without an exception
  return words.str();
}

bool end_soon(const std::vector<int>& processes) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(10);
  while (std::any_of(processes.begin(), processes.end(), [](int process) {
    return state_of(fs::path("/proc") / std::to_string(process)).is_alive();
  })) {
    if (std::chrono::steady_clock::now() > end) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return true;
}

FailingFarm::FailingFarm() {
  fs::create_directory(root() / "tmp");
  grid({"8", "16", "32", "64"});
}

fs::path FailingFarm::grid(const std::vector<std::string>& exponents, const std::string& engines,
                           int size) {
  const fs::path file = root() / "grid.xml";
  pictures_ = (engines.empty() ? 1 : 2) * exponents.size();
  write_file(file,
             fmt::format("<grid version=\"1\" title=\"A small grid\">"
                         "<scene file=\"{}/reference_scenes/scenes/oblique_45.xml\"/>"
                         "<film width=\"{}\" height=\"{}\"/>"
                         "<axis name=\"exponent\" values=\"{}\"/>{}</grid>",
                         LOBELIA_SOURCE_DIR, size, size, fmt::join(exponents, ", "), engines));
  return file;
}

std::vector<std::string> FailingFarm::command(const std::vector<std::string>& more) const {
  std::vector<std::string> arguments{"farm", "grid.xml", "-o", "out", "--cache", "cache"};
  if (fs::exists(root() / "povray"))
    arguments.insert(arguments.end(), {"--povray", (root() / "povray").string()});
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

FarmRun FailingFarm::run_command(const std::vector<std::string>& arguments,
                                 const std::vector<std::string>& environment) const {
  RunningFarm farm(arguments, root(), environment);
  FarmRun run;
  run.exit_code = farm.wait();
  run.output = farm.output();
  run.rendered = number_before(run.output, " pictures rendered");
  run.kept = number_before(run.output, " kept\n");
  return run;
}

fs::path FailingFarm::script(const std::string& name, const std::string& text) const {
  const fs::path path = root() / name;
  write_file(path, "#!/bin/sh\n" + text);
  fs::permissions(path, fs::perms::owner_all);
  return path;
}

fs::path FailingFarm::fake_povray(const std::string& misdeeds) const {
  const fs::path pictures = root() / "pictures";
  if (!fs::exists(pictures / "ready")) {
    fs::create_directory(pictures);
    write_file(pictures / "ready", "");
    const Grid read = read_grid(root() / "grid.xml");
    for (const Cell& cell : cells_of(read)) {
      const Scene scene = scene_of(read, cell);
      const PovrayInput input = povray_input(in_engine_units(scene));
      if (input.passes.size() != 1) throw std::runtime_error("a cell of one pass was expected");
      Image image = render(scene, {}).image;
      for (float& value : image.values()) value *= float(input.passes[0].gain);
      const std::string name = hex(sha256(input.passes[0].scene()));
      write_exr(pictures / (name + ".exr"), image, {});
      write_file(pictures / (name + ".cell"), cell.id + "\n");
    }
  }
  // In a file of their own: a program of another content is another engine.
  write_file(root() / "misdeeds", misdeeds + "\n");
  // It may write nowhere but in its working directory.
  return script("povray",
                "case \"$*\" in *version*) echo 'POV-Ray 3.7.0.10' >&2; exit 0;; esac\n"
                "pictures='" +
                    pictures.string() +
                    "'\n"
                    "stem=${1%.ini}\n"
                    "name=$(sha256sum < $stem.pov); name=${name%% *}\n"
                    "read cell < $pictures/$name.cell || exit 77\n"
                    ". '" +
                    (root() / "misdeeds").string() + "'\ncp $pictures/$name.exr $stem.exr\n");
}

std::string FailingFarm::first_times(const std::string& name, int times) {
  const fs::path queue = root() / name;
  ::mkfifo(queue.c_str(), 0600);
  // Open at both ends: reading it takes a byte away for good, and never waits for a writer.
  const int fd = ::open(queue.c_str(), O_RDWR | O_CLOEXEC);
  held_open_.push_back(fd);
  const std::string tokens(std::size_t(times), 'x');
  if (::write(fd, tokens.data(), tokens.size()) != times) throw std::runtime_error("no queue");
  return fmt::format("[ -n \"$(dd if='{}' bs=1 count=1 iflag=nonblock 2>/dev/null)\" ]",
                     queue.string());
}

const Results& FailingFarm::undisturbed() {
  if (undisturbed_.empty()) {
    const fs::path good = fake_povray();
    fs::copy_file(good, root() / "good-povray", fs::copy_options::overwrite_existing);
    const FarmRun done =
        run_command({"farm", "grid.xml", "-o", "undisturbed", "--cache", "undisturbed-cache",
                     "--povray", (root() / "good-povray").string()});
    EXPECT_EQ(done.exit_code, 0) << done.output;
    EXPECT_EQ(done.rendered, pictures_) << done.output;
    undisturbed_ = results_of(root() / "undisturbed");
    EXPECT_GT(undisturbed_.size(), 2 * pictures_);
  }
  return undisturbed_;
}

void FailingFarm::expect_mended(const FarmRun& second, std::size_t lost_pictures) {
  EXPECT_EQ(second.rendered, lost_pictures) << second.output;
  EXPECT_EQ(second.kept, pictures_ - lost_pictures) << second.output;
  expect_mended(second);
}

void FailingFarm::expect_mended(const FarmRun& second) {
  EXPECT_EQ(second.exit_code, 0) << second.output;
  EXPECT_THAT(differences(undisturbed(), results_of(out())), testing::IsEmpty());
  expect_nothing_half_written();
}

void FailingFarm::expect_nothing_half_written() const {
  for (const auto& entry : fs::recursive_directory_iterator(root()))
    EXPECT_FALSE(entry.path().native().ends_with(".part")) << entry.path();
  for (const auto& entry : fs::directory_iterator(cache() / "making"))
    ADD_FAILURE() << entry.path();
  for (const auto& entry : fs::directory_iterator(root() / "tmp"))
    EXPECT_TRUE(fs::is_empty(entry.path())) << entry.path();
}

std::size_t FailingFarm::cached_pictures() const {
  std::size_t count = 0;
  if (!fs::exists(cache() / "results")) return 0;
  for (const auto& entry : fs::recursive_directory_iterator(cache() / "results")) {
    if (entry.path().filename() != "result.json") continue;
    const std::string job = read_json(entry.path()).at("job");
    count += job == "render" || job == "reference" ? 1 : 0;
  }
  return count;
}

fs::path FailingFarm::result_of(const std::string& cell, const std::string& job) const {
  const Json record = read_json(out() / "cells" / cell / "cell.json");
  const std::string key = record.at("results").at(job);
  return cache() / "results" / key.substr(0, 2) / key;
}

Json FailingFarm::failure_of(const std::string& cell) const {
  const Json record = read_json(out() / "cells" / cell / "cell.json");
  return record.at("problems").empty() ? Json::object() : record.at("problems")[0];
}

}  // namespace lobelia
