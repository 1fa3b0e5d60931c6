#include "farm/slurm/slurm_client.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/system/error.hpp"
#include "base/system/process.hpp"
#include "base/words/text.hpp"

extern char** environ;

namespace lobelia {
namespace {

constexpr const char* kPrograms[] = {"sbatch", "squeue", "scancel", "scontrol", "sinfo"};
constexpr std::size_t kMostAnswerBytes = 16u << 20;  // a line of squeue for each of 1e5 elements

struct TooMuch {};

/// sbatch passes its environment to the job: this keeps secrets here, and SBATCH_* from changing what is submitted.
std::vector<std::string> clean_environment() {
  std::vector<std::string> result;
  for (char** variable = environ; *variable != nullptr; ++variable) {
    const std::string_view text = *variable;
    for (const char* start :
         {"PATH=", "HOME=", "USER=", "SLURM_CONF=", "LD_LIBRARY_PATH=", "LOBELIA_"})
      if (text.starts_with(start)) result.emplace_back(text);
  }
  return result;
}

bool contains(std::string_view text, std::string_view part) { return text.find(part) != text.npos; }

template <class T>
SlurmAnswer<T> understood(std::optional<T> value, std::string_view program,
                          const std::vector<std::string>& lines) {
  if (value) return {std::move(value), ""};
  return {{},
          fmt::format("{}'s answer is not understood: '{}'", program,
                      printable(lines.empty() ? "" : lines.front()))};
}

}  // namespace

std::vector<std::string> SlurmClient::absent_programs() {
  std::vector<std::string> result;
  for (const char* name : kPrograms)
    if (find_program(name).empty()) result.emplace_back(name);
  return result;
}

SlurmClient::Output SlurmClient::run(std::vector<std::string> arguments) const {
  Output output;
  const std::string name = arguments.front();
  arguments.front() = find_program(name).string();
  if (arguments.front().empty()) {
    output.why = fmt::format("no program '{}' in $PATH", name);
    return output;
  }
  std::size_t bytes = 0;
  ProcessOptions options;
  options.environment = clean_environment();
  options.only_environment = true;
  options.uninterruptible = true;
  options.timeout = time_limit_;
  options.on_line = [&](std::string_view line) {
    if ((bytes += line.size()) > kMostAnswerBytes) throw TooMuch();
    output.lines.emplace_back(line);
  };
  try {
    const ProcessResult result = run_process(arguments, options);
    output.in_time = !result.timed_out;
    if (result.timed_out) {
      output.why = fmt::format("{} gave no answer in {:g} s", name, time_limit_.count());
    } else if (result.exit_code != 0) {
      // The last line is the one that says why.
      const std::string said = output.lines.empty() ? "" : printable(output.lines.back(), 300);
      output.why =
          said.empty() ? fmt::format("{} ended with exit code {}", name, result.exit_code) : said;
    }
  } catch (const TooMuch&) {
    output.why = fmt::format("{}'s answer is longer than {} MiB", name, kMostAnswerBytes >> 20);
  } catch (const Error& error) {
    output.why = error.what();
  }
  return output;
}

SlurmSubmission SlurmClient::submit(const std::vector<std::string>& arguments,
                                    const std::filesystem::path& script) const {
  std::vector<std::string> command = {"sbatch", "--parsable"};
  command.insert(command.end(), arguments.begin(), arguments.end());
  command.push_back(script.string());
  const Output output = run(command);
  if (output.why.empty()) {
    const auto job = understood(parse_submission(output.lines), "sbatch", output.lines);
    return {job.value, job.why, !job};
  }
  SlurmSubmission result{{}, output.why, !output.in_time};
  for (const std::string& line : output.lines)
    for (const char* sign : {"timed out", "onnection", "Unable to contact", "Zero Bytes"})
      result.unclear |= contains(line, sign);
  return result;
}

template <class T>
SlurmAnswer<T> SlurmClient::ask(const std::vector<std::string>& arguments,
                                std::optional<T> (*parse)(std::span<const std::string>)) const {
  const Output output = run(arguments);
  if (!output.why.empty()) return {{}, output.why};
  return understood(parse(output.lines), arguments.front(), output.lines);
}

SlurmAnswer<std::vector<SlurmElement>> SlurmClient::elements(SlurmJobId job,
                                                             const std::string& name) const {
  auto found = ask({"squeue", "-h", "-r", "-t", "all", "-j", std::to_string(job), "--name=" + name,
                    "-o", "%K|%T|%r|%N"},
                   parse_elements);
  if (contains(found.why, "Invalid job id")) return {std::vector<SlurmElement>(), ""};
  return found;
}

SlurmAnswer<std::vector<SlurmLivingJob>> SlurmClient::living_jobs(const std::string& name) const {
  return ask({"squeue", "-h", "--me", "--name=" + name, "-o", "%F|%T|%k"}, parse_living_jobs);
}

std::string SlurmClient::cancel(const std::string& name) const {
  return run({"scancel", "--me", "--name=" + name}).why;
}

std::string SlurmClient::ping() const {
  const Output output = run({"scontrol", "ping"});
  if (!output.why.empty()) return output.why;
  for (const std::string& line : output.lines)
    if (line.ends_with(" is UP")) return "";
  return output.lines.empty() ? "scontrol ping says nothing" : printable(output.lines.front(), 300);
}

SlurmAnswer<std::map<std::string, std::string>> SlurmClient::config() const {
  return ask({"scontrol", "show", "config"}, parse_config);
}

SlurmAnswer<std::vector<SlurmNode>> SlurmClient::node_list(const std::string& partition) const {
  auto all = ask({"sinfo", "-h", "-N", "-o", "%N|%P|%a|%t|%m|%C"}, parse_node_list);
  const auto wanted = split(partition, ",");
  if (all)
    std::erase_if(*all.value, [&](const SlurmNode& node) {
      return wanted.empty() ? !node.is_default
                            : std::ranges::find(wanted, node.partition) == wanted.end();
    });
  return all;
}

SlurmAnswer<SlurmPartition> SlurmClient::partition(const std::string& name) const {
  return ask({"scontrol", "-o", "show", "partition", name}, parse_partition);
}

}  // namespace lobelia
