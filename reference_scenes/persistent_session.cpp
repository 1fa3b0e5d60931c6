#include "reference_scenes/persistent_session.hpp"

#include <fmt/format.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <condition_variable>
#include <cstring>
#include <deque>
#include <exception>
#include <future>
#include <mutex>
#include <optional>
#include <thread>

#include "base/system/error.hpp"
#include "base/system/files.hpp"
#include "base/system/interrupt.hpp"
#include "base/system/removal.hpp"
#include "base/words/text.hpp"
#include "reference_scenes/engine_program.hpp"
#include "reference_scenes/preparation.hpp"

namespace lobelia {
namespace {
namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr char kNextFile[] = "next";
constexpr int kSigAlrm = 14;
/// After so many processes in a row that began no scene, all scenes fail.
constexpr int kMostFailedStarts = 3;
/// How long a process waits for another scene.
constexpr std::chrono::duration<double> kIdle{1};
/// How often waiting threads look for Ctrl-C.
constexpr auto kPollInterval = std::chrono::milliseconds(50);

/// Adds up the pictures of a scene's passes, and removes their files.
Failure read_passes(const PersistentProgram& program, const fs::path& directory,
                    const SceneInput& input, const Scene& scene, Image& sum) {
  std::vector<Image> images(input.passes);
  for (std::size_t pass = 0; pass < input.passes; ++pass) {
    const fs::path file =
        directory / fmt::format("{}-{}.{}", input.name, pass, program.picture_format());
    if (Failure failure = read_engine_picture(program.info(), file, scene.film, images[pass]))
      return failure;
    remove_in_temporary_directory(file);
  }
  sum = sum_of(images);
  return {};
}

/// Two connected sockets: ours, and the program's stdin.
class SocketPair {
 public:
  SocketPair() {
    if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends_) != 0)
      throw Error(ExitCode::kEngine, "no socket: {}", std::strerror(errno));
  }
  ~SocketPair() {
    for (const int end : ends_) ::close(end);
  }
  SocketPair(const SocketPair&) = delete;
  SocketPair& operator=(const SocketPair&) = delete;
  int program_end() const { return ends_[1]; }
  /// So short that it never blocks. If the program has ended, run_engine() reports that.
  void send(std::string_view words) { ::send(ends_[0], words.data(), words.size(), MSG_NOSIGNAL); }
  void close() { ::shutdown(ends_[0], SHUT_WR); }

 private:
  int ends_[2];
};

/// A scene that a caller waits for.
struct Order {
  Scene scene;
  SceneInput input;
  int threads;  ///< of the program
  Clock::time_point begun = {};
  std::promise<ReferenceResult> result = {};
};
using OrderPointer = std::shared_ptr<Order>;

/// The scenes that wait for a process.
struct Queue {
  const PersistentProgram& program;
  const ReferenceOptions options;
  const EngineStatus& status;
  std::mutex mutex = {};  ///< of all below
  std::condition_variable changed = {};
  std::deque<OrderPointer> waiting = {};
  std::size_t idle = 0;                  ///< threads that wait for a scene
  int failed_starts = 0;                 ///< in a row, of all processes
  std::optional<Failure> no_start = {};  ///< why no further process is started
  std::exception_ptr broken = {};        ///< what ended the session
  bool closing = false;
  std::atomic<bool> stop = false;  ///< ends every process

  /// Waits for the next scene; none at the end of the session, or at `until`.
  OrderPointer take(std::optional<Clock::time_point> until = {}) {
    std::unique_lock lock(mutex);
    ++idle;
    while (waiting.empty() && !closing && !stop && !interrupted() &&
           (!until || Clock::now() < *until))
      changed.wait_for(lock, kPollInterval);
    --idle;
    throw_if_interrupted();
    if (stop) throw Error(ExitCode::kInterrupted, "interrupted");
    if (waiting.empty()) return nullptr;
    OrderPointer order = std::move(waiting.front());
    waiting.pop_front();
    order->begun = Clock::now();
    return order;
  }
  void put_back(OrderPointer order) {
    const std::scoped_lock lock(mutex);
    waiting.push_front(std::move(order));
  }
  void fail(const OrderPointer& order, const Failure& failure, const std::string& log) {
    ReferenceResult result = failed_result(program.info(), status, order->scene, failure);
    result.log = log;
    result.begun = order->begun;
    order->result.set_value(std::move(result));
  }
  /// A process has begun a scene.
  void note_start() {
    const std::scoped_lock lock(mutex);
    failed_starts = 0;
  }
  /// A process has ended without beginning a scene.
  void note_failed_start(const Failure& failure) {
    std::deque<OrderPointer> hopeless;
    {
      const std::scoped_lock lock(mutex);
      if (++failed_starts < kMostFailedStarts) return;
      no_start = failure;
      hopeless.swap(waiting);
    }
    for (const OrderPointer& order : hopeless) fail(order, failure, "");
  }
  /// Ends the session, on Ctrl-C or a full disk for example.
  void break_off(std::exception_ptr why) {
    std::deque<OrderPointer> left;
    {
      const std::scoped_lock lock(mutex);
      if (!broken) broken = why;
      left.swap(waiting);
    }
    stop = true;
    changed.notify_all();
    for (const OrderPointer& order : left) order->result.set_exception(broken);
  }
};

/// Runs one process after another. Each gets scene after scene while it lives.
class Worker {
 public:
  explicit Worker(Queue& queue) : queue_(queue), options_(queue.options) {}

  void run() {
    try {
      queue_.program.write_files(directory_.path());
      while ((given_ = queue_.take())) run_process();
    } catch (...) {
      queue_.break_off(std::current_exception());
      if (done_) done_->order->result.set_exception(queue_.broken);
      if (given_) given_->result.set_exception(queue_.broken);
    }
  }

 private:
  /// A scene that the program has rendered.
  struct Done {
    OrderPointer order;
    EngineLog log;
    EngineCost cost;
    bool has_cost = false;  ///< besides cost.seconds
  };

  /// Ends with fewer scenes waiting, or with the given one put back after others were done.
  void run_process() {
    threads_ = given_->threads;
    queue_.program.write_pictures(directory_.path(), given_->scene, given_->input);
    queue_.program.write_first(directory_.path(), threads_, options_, given_->input);
    const auto arguments = [&](const fs::path& directory) {
      return queue_.program.arguments(queue_.status.program.string(), directory);
    };
    // Without the temporary directory, which would make every record differ.
    command_ = shell_join(arguments(""));
    begin_log();
    begun_ = false;
    started_ = Clock::now();
    cpu_told_ = 0;
    SocketPair line;
    line_ = &line;
    ProcessOptions process;
    process.on_start = [&](const ProcessLimits& limits) { limits_ = limits; };
    process.environment = engine_environment(directory_.path());
    // For a program that hangs at its start: it gets no scene after one time limit, and each scene has its own alarm.
    process.timeout = 2 * options_.time_limit;
    process.stop = &queue_.stop;
    process.input = line.program_end();
    process.on_line = [&](std::string_view text) { take_line(text); };
    ProcessResult ended;
    const EngineInfo& engine = queue_.program.info();
    Failure failure = run_engine(engine, arguments(directory_.path()), directory_.path(), process,
                                 options_, ended);
    line_ = nullptr;
    report_done();
    if (begun_) queue_.note_start();
    if (!given_) return;
    if (ended.exit_code == 128 + kSigAlrm) {
      ended.timed_out = true;
      failure = process_failure(engine, ended, options_);
    }
    if (!failure)
      failure = {
          FailureClass::kNoOutput,
          fmt::format("{} {}: {}", engine.title,
                      current_ ? "stopped with exit code 0 in the middle" : "rendered nothing",
                      last_words(ended.output_tail))};
    if (begun_ && !current_) {  // it died between two scenes
      queue_.put_back(std::exchange(given_, nullptr));
      return;
    }
    current_ = false;
    fail_given(failure);
    if (!begun_) queue_.note_failed_start(failure);
  }

  /// An exception from here (such as a full disk) ends the program and leaves run_process().
  void take_line(std::string_view line) {
    log_.add(line);
    if (line.starts_with("lobelia: ")) take_message(split(line, " "));
  }

  /// See the header. Pictures are not read between done and more, so that the program need not wait.
  void take_message(const std::vector<std::string>& words) {
    if (words.size() == 2 && words[1] == "more") {
      go_on();
      return;
    }
    if (words.size() < 3 || !given_ || words[2] != given_->input.name) return;
    if (words[1] == "begin") {
      report_done();
      begun_ = current_ = true;
    } else if (words[1] == "failed") {
      const auto why = fmt::format(" {}", fmt::join(words.begin() + 3, words.end(), " "));
      current_ = false;
      fail_given({FailureClass::kExitCode,
                  fmt::format("{}:{}", queue_.program.info().title, printable(why, 300))});
    } else if (words[1] == "done") {
      begun_ = true;
      done_.emplace();
      EngineCost& cost = done_->cost;
      if (words.size() > 3) parse_number(words[3], cost.seconds);
      long long peak = 0;
      double cpu = 0;
      if (words.size() > 5 && parse_number(words[4], cpu) && parse_integer(words[5], peak)) {
        cost.cpu_seconds = cpu - cpu_told_;
        cost.peak_memory_bytes = std::uint64_t(std::max(0LL, peak));
        done_->has_cost = true;
        cpu_told_ = cpu;
      }
      done_->order = std::exchange(given_, nullptr);
      done_->log = std::exchange(log_, {});
      current_ = false;
      begin_log();
    }
  }

  /// Sends the next scene, if one waits already before the last picture is read.
  void go_on() {
    const auto clock_time = [](std::chrono::duration<double> time) {
      return std::chrono::duration_cast<Clock::duration>(time);
    };
    if (given_) return report_done();
    const auto end = started_ + clock_time(options_.time_limit);
    if (Clock::now() < end) {
      given_ = queue_.take(Clock::now());
      if (!given_) {
        report_done();
        const bool is_limited = options_.no_progress_limit.count() > 0;
        const auto idle = is_limited ? std::min(kIdle, options_.no_progress_limit / 4) : kIdle;
        given_ = queue_.take(std::min(end, Clock::now() + clock_time(idle)));
      }
    }
    if (given_) {
      queue_.program.write_pictures(directory_.path(), given_->scene, given_->input);
      write_file(directory_.path() / kNextFile, given_->input.text);
      line_->send(std::string(kNextFile) + "\n");
    } else {
      line_->close();
    }
    report_done();
  }

  /// Reads the picture that is ready, if one is.
  void report_done() {
    if (!done_) return;
    // It stays in done_ until it is read: run() passes on what is thrown here.
    const Done& done = *done_;
    const Order& order = *done.order;
    queue_.program.remove_pictures(directory_.path(), order.input);
    ReferenceResult result;
    const Failure failure =
        read_passes(queue_.program, directory_.path(), order.input, order.scene, result.image);
    if (failure) {
      queue_.fail(done.order, failure, done.log.text());
      done_.reset();
      return;
    }
    result.log = done.log.text();
    result.begun = order.begun;
    records::Reference& record = result.record =
        reference_record(queue_.program.info(), queue_.status, order.scene);
    record.shading = queue_.program.is_native() ? "native" : "expressed";
    record.method = queue_.program.method();
    record.passes = order.input.passes;
    record.engine_commands = {command_};
    record_limits(record, limits_);
    record.seconds.total = done.cost.seconds;
    if (done.has_cost) record_cost(record, done.cost, threads_);
    std::exchange(done_, std::nullopt)->order->result.set_value(std::move(result));
  }

  void fail_given(const Failure& failure) {
    queue_.fail(std::exchange(given_, nullptr), failure, log_.text());
    begin_log();
  }

  void begin_log() {
    log_ = {};
    log_.add("$ " + command_);
  }

  Queue& queue_;
  const ReferenceOptions& options_;
  const TemporaryDirectory directory_;
  OrderPointer given_;        ///< the scene that the process has, until it is done
  bool current_ = false;      ///< the process has begun it
  std::optional<Done> done_;  ///< not read yet
  // State of the process:
  bool begun_ = false;  ///< it has begun a scene
  int threads_ = 0;
  Clock::time_point started_;
  double cpu_told_ = 0;
  SocketPair* line_ = nullptr;
  std::string command_;
  ProcessLimits limits_;
  // Since its last scene:
  EngineLog log_;
};

class PersistentSession final : public SimpleSession {
 public:
  PersistentSession(std::unique_ptr<const PersistentProgram> program, const EngineStatus& status,
                    const ReferenceOptions& options)
      : program_(std::move(program)),
        queue_{*program_, options, status},
        processors_(threads_of(options)),
        // Most of a small picture's time is preparation on one processor.
        processes_(std::size_t(options.processes > 0 ? options.processes : processors_)) {}
  ~PersistentSession() override {
    {
      const std::scoped_lock lock(queue_.mutex);
      queue_.closing = true;
    }
    queue_.changed.notify_all();
  }

  /// Two for each process, so that a next scene is ready.
  int at_once(std::size_t scenes) const override {
    return int(std::clamp(scenes, std::size_t{1}, 2 * processes_));
  }
  void stop() override {
    queue_.break_off(std::make_exception_ptr(Error(ExitCode::kInterrupted, "interrupted")));
  }

  ReferenceResult render(const Scene& scene, std::size_t scenes) override {
    const std::size_t processes = std::clamp(scenes, std::size_t{1}, processes_);
    SceneInput input;
    try {
      input = program_->input(scene, fmt::format("scene{}", begun_++));
    } catch (const Error& refused) {
      return failed_result(program_->info(), queue_.status, scene,
                           {FailureClass::kRefused, refused.what()});
    }
    const auto order = std::make_shared<Order>(
        Order{scene, std::move(input), std::max(1, processors_ / int(processes))});
    auto result = order->result.get_future();
    {
      const std::scoped_lock lock(queue_.mutex);
      throw_if_interrupted();
      if (queue_.broken) std::rethrow_exception(queue_.broken);
      if (queue_.no_start)
        return failed_result(program_->info(), queue_.status, scene, *queue_.no_start);
      queue_.waiting.push_back(order);
      if (queue_.waiting.size() > queue_.idle && workers_.size() < processes)
        workers_.emplace_back([this] { Worker(queue_).run(); });
    }
    queue_.changed.notify_one();
    return result.get();
  }

 private:
  const std::unique_ptr<const PersistentProgram> program_;
  Queue queue_;
  const int processors_;
  const std::size_t processes_;
  std::atomic<std::size_t> begun_ = 0;
  std::vector<std::jthread> workers_;  ///< under the queue's lock
};

}  // namespace

void PersistentProgram::write_first(const fs::path& directory, int, const ReferenceOptions&,
                                    const SceneInput& input) const {
  write_file(directory / kFirstFile, input.text);
}

std::unique_ptr<SimpleSession> open_persistent(std::unique_ptr<const PersistentProgram> program,
                                               const EngineStatus& status,
                                               const ReferenceOptions& options) {
  return std::make_unique<PersistentSession>(std::move(program), status, options);
}

}  // namespace lobelia
