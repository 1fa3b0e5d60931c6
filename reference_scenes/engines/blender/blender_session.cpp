#include "reference_scenes/engines/blender/blender_session.hpp"

#include <fmt/format.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <deque>
#include <exception>
#include <future>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

#include "core/error.hpp"
#include "core/files.hpp"
#include "core/image_io.hpp"
#include "core/interrupt.hpp"
#include "core/removal.hpp"
#include "core/text.hpp"
#include "reference_scenes/engine_program.hpp"
#include "reference_scenes/engines/blender/blender.hpp"
#include "reference_scenes/preparation.hpp"

namespace lobelia {
namespace {
namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr char kNextFile[] = "next.json";
constexpr int kSigAlrm = 14;
/// Processes in a row that came to no scene at all: then none will.
constexpr int kMostIdleStarts = 3;
/// How long a process waits for a further scene.
constexpr std::chrono::duration<double> kIdle{1};
/// Between two looks at whether the user has pressed Ctrl-C.
constexpr auto kLookAgain = std::chrono::milliseconds(50);

/// Adds up a scene's passes, and removes them.
Failure read_passes(const fs::path& directory, const std::string& name, const Scene& scene,
                    std::size_t passes, Image& sum) {
  std::vector<Image> images(passes);
  for (std::size_t pass = 0; pass < passes; ++pass) {
    const fs::path file = directory / fmt::format("{}-{}.exr", name, pass);
    if (Failure failure = read_engine_picture(kBlenderInfo, file, scene.film, images[pass]))
      return failure;
    remove_in_temporary_directory(file);
  }
  sum = sum_of(images);
  return {};
}

/// Our end, and the one that a program has as its stdin.
class SocketPair {
 public:
  SocketPair() {
    if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends_) != 0)
      throw Error(ExitCode::kEngine, fmt::format("no socket: {}", std::strerror(errno)));
  }
  ~SocketPair() {
    for (const int end : ends_) ::close(end);
  }
  SocketPair(const SocketPair&) = delete;
  SocketPair& operator=(const SocketPair&) = delete;
  int program_end() const { return ends_[1]; }
  /// Few enough bytes that it never waits. A program that has ended is noticed elsewhere.
  void send(std::string_view words) { ::send(ends_[0], words.data(), words.size(), MSG_NOSIGNAL); }
  void close() { ::shutdown(ends_[0], SHUT_WR); }

 private:
  int ends_[2];
};

/// Where the time of a scene goes, by when Blender says that it goes on.
class StageClock {
 public:
  void restart() { *this = {}; }
  void take(std::string_view line) {
    const auto ends = [&](std::string_view words) { return line.find(words) != line.npos; };
    if (ends("lobelia: begin")) {
      end(start_);
    } else if (ends("| Sample 0/")) {
      end(parse_);
    } else if (ends("| Finished")) {
      end(trace_);
    } else if (line.starts_with(" Time: ") || ends("lobelia: done")) {
      end(write_);
    }
  }
  void report(records::EngineSeconds& seconds) const {
    seconds.start = start_;
    seconds.parse = parse_;
    seconds.trace = trace_;
    seconds.write = write_;
  }

 private:
  using Clock = std::chrono::steady_clock;
  void end(double& stage) {
    const auto now = Clock::now();
    stage += std::chrono::duration<double>(now - since_).count();
    since_ = now;
  }
  Clock::time_point since_ = Clock::now();
  double start_ = 0, parse_ = 0, trace_ = 0, write_ = 0;
};

/// A scene that a caller waits for.
struct Order {
  Scene scene;
  BlenderScene input;
  int threads;  ///< of its process
  Clock::time_point begun = {};
  std::promise<ReferenceResult> result = {};
};
using OrderPointer = std::shared_ptr<Order>;

/// The scenes that wait, and whom the processes tell.
struct Queue {
  const ReferenceOptions options;
  const EngineStatus& status;
  std::mutex mutex = {};  ///< of all below
  std::condition_variable changed = {};
  std::deque<OrderPointer> waiting = {};
  std::size_t idle = 0;                  ///< threads that wait for a scene
  int idle_starts = 0;                   ///< in a row, of all processes
  std::optional<Failure> no_start = {};  ///< no process will come to a scene
  std::exception_ptr broken = {};        ///< what ended it all
  bool closing = false;
  std::atomic<bool> stop = false;  ///< every process

  bool native() const { return options.shading == Shading::kNative; }

  /// The next scene, once there is one; none at the end, or at `until`.
  OrderPointer take(std::optional<Clock::time_point> until = {}) {
    std::unique_lock lock(mutex);
    ++idle;
    while (waiting.empty() && !closing && !stop && !interrupted() &&
           (!until || Clock::now() < *until))
      changed.wait_for(lock, kLookAgain);
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
    ReferenceResult result = failed_result(kBlenderInfo, status, order->scene, failure);
    result.log = log;
    result.begun = order->begun;
    order->result.set_value(std::move(result));
  }
  void came_to_a_scene() {
    const std::scoped_lock lock(mutex);
    idle_starts = 0;
  }
  void came_to_none(const Failure& failure) {
    std::deque<OrderPointer> hopeless;
    {
      const std::scoped_lock lock(mutex);
      if (++idle_starts < kMostIdleStarts) return;
      no_start = failure;
      hopeless.swap(waiting);
    }
    for (const OrderPointer& order : hopeless) fail(order, failure, "");
  }
  /// A full disk, say, or Ctrl-C.
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

/// Processes one after the other, each of which is given one scene after the other for as long as it lives.
class Worker {
 public:
  explicit Worker(Queue& queue) : queue_(queue), options_(queue.options) {}

  void run() {
    try {
      write_blender_scripts(directory_.path());
      while ((given_ = queue_.take())) run_process();
    } catch (...) {
      queue_.break_off(std::current_exception());
      if (done_) done_->order->result.set_exception(queue_.broken);
      if (given_) given_->result.set_exception(queue_.broken);
    }
  }

 private:
  /// A scene that Blender has rendered.
  struct Done {
    OrderPointer order;
    EngineLog log;
    StageClock clock;
    double seconds = 0, cpu_seconds = 0;
    std::uint64_t peak_memory_bytes = 0;
    bool cost_told = false;
  };

  /// Whatever happens, fewer scenes wait afterwards, or the given one does again after others were done.
  void run_process() {
    write_sky();
    threads_ = given_->threads;
    write_file(directory_.path() / kBlenderJobFile,
               blender_job(threads_, options_, given_->input, true));

    const std::string program = queue_.status.program.string();
    // The temporary directory is of no use to a reader, and would make every record differ.
    command_ = shell_join(blender_arguments(program, ""));
    begin_log();
    clock_.restart();
    begun_ = false;
    started_ = Clock::now();
    cpu_told_ = 0;
    SocketPair line;
    line_ = &line;
    ProcessOptions process;
    process.working_directory = process.writable = process.progress_directory = directory_.path();
    process.on_start = [&](const ProcessLimits& limits) { limits_ = limits; };
    process.environment = engine_environment(directory_.path());
    // It is given no scene after one time limit, and each scene has an alarm of its own; this is for
    // a Blender that never comes to that.
    process.timeout = 2 * options_.time_limit;
    process.no_progress_limit = options_.no_progress_limit;
    process.stop = &queue_.stop;
    process.input = line.program_end();
    process.on_line = [&](std::string_view text) { take_line(text); };
    ProcessResult ended;
    Failure failure = run_engine(kBlenderInfo, blender_arguments(program, directory_.path()),
                                 process, options_, ended);
    line_ = nullptr;
    report_done();
    if (begun_) queue_.came_to_a_scene();
    if (!given_) return;
    if (ended.exit_code == 128 + kSigAlrm) {
      ended.timed_out = true;
      failure = process_failure(kBlenderInfo, ended, options_);
    }
    if (!failure)
      failure = {
          FailureClass::kNoOutput,
          fmt::format("Blender {}: {}",
                      current_ ? "stopped with exit code 0 in the middle" : "rendered nothing",
                      last_words(ended.output_tail))};
    if (begun_ && !current_) {  // died between two
      queue_.put_back(std::exchange(given_, nullptr));
      return;
    }
    current_ = false;  // died with a scene in its hands: that scene's result, and no one else's
    fail_given(failure);
    if (!begun_) queue_.came_to_none(failure);
  }

  /// The picture of the sky, where the given scene has one.
  void write_sky() {
    for (const Light& light : given_->scene.lights)
      if (const auto picture = picture_of(light))
        write_exr(directory_.path() / sky_file(given_->input.name), *picture, {});
  }

  /// An exception from here (a full disk, say) ends Blender and comes out of run_process.
  void take_line(std::string_view line) {
    log_.add(line);
    clock_.take(line);
    if (line.starts_with("lobelia: ")) take_message(split(line, " "));
  }

  /// "lobelia: begin NAME", "lobelia: done NAME SECONDS CPU_SECONDS PEAK_BYTES", "lobelia: failed NAME WHY" or
  /// "lobelia: more". Between done and more nothing is read, so that Blender need not wait.
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
      std::string why;
      for (std::size_t i = 3; i < words.size(); ++i) why += " " + words[i];
      current_ = false;
      fail_given({FailureClass::kExitCode, "Blender Cycles:" + printable(why, 300)});
    } else if (words[1] == "done") {
      begun_ = true;
      done_.emplace();
      if (words.size() > 3) parse_number(words[3], done_->seconds);
      long long peak = 0;
      double cpu = 0;
      if (words.size() > 5 && parse_number(words[4], cpu) && parse_integer(words[5], peak)) {
        done_->cpu_seconds = cpu - cpu_told_;
        done_->peak_memory_bytes = std::uint64_t(std::max(0LL, peak));
        done_->cost_told = true;
        cpu_told_ = cpu;
      }
      done_->order = std::exchange(given_, nullptr);
      done_->log = std::exchange(log_, {});
      done_->clock = clock_;
      current_ = false;
      begin_log();
      clock_.restart();
    }
  }

  /// The next scene is begun before the picture of the last is read, if one waits already.
  void go_on() {
    if (!given_) {
      const auto end = started_ + std::chrono::duration_cast<Clock::duration>(options_.time_limit);
      const auto now = Clock::now();
      if (now < end) given_ = queue_.take(now);
      if (!given_) {
        report_done();
        std::chrono::duration<double> idle = kIdle;
        if (options_.no_progress_limit.count() > 0)
          idle = std::min(idle, options_.no_progress_limit / 4);
        if (now < end)
          given_ = queue_.take(
              std::min(end, Clock::now() + std::chrono::duration_cast<Clock::duration>(idle)));
      }
      if (given_) {
        write_sky();
        write_file(directory_.path() / kNextFile, given_->input.json);
        line_->send(std::string(kNextFile) + "\n");
      } else {
        line_->close();
      }
    }
    report_done();
  }

  /// Reads the picture that is ready, if one is.
  void report_done() {
    if (!done_) return;
    const Done& done = *done_;
    const Scene& scene = done.order->scene;
    const std::size_t passes = done.order->input.passes;
    remove_in_temporary_directory(directory_.path() / sky_file(done.order->input.name));
    ReferenceResult result;
    if (const Failure failure =
            read_passes(directory_.path(), done.order->input.name, scene, passes, result.image)) {
      queue_.fail(std::exchange(done_->order, nullptr), failure, done.log.text());
      done_.reset();
      return;
    }
    result.log = done.log.text();
    result.begun = done.order->begun;
    result.record = reference_record(kBlenderInfo, queue_.status, scene);
    result.record.witness = queue_.native() || options_.own_transport ? "native" : "expressed";
    result.record.method = method();
    result.record.passes = passes;
    result.record.engine_commands = {command_};
    record_limits(result.record, limits_);
    result.record.seconds.total = done.seconds;
    if (done.cost_told)
      record_cost(result.record, done.cpu_seconds, done.peak_memory_bytes, threads_);
    if (options_.stages) done.clock.report(result.record.seconds);
    const OrderPointer order = done.order;
    done_.reset();
    order->result.set_value(std::move(result));
  }

  std::string method() const {
    if (options_.own_transport) return "Cycles' own light transport";
    if (queue_.native())
      return "Cycles' Ashikhmin-Shirley closure, its geometry term taken out by its colour, under a "
             "real lamp, one pass per light and reflection";
    return "shader nodes as the colour of a surface under a real lamp, one pass per light and "
           "reflection";
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
  OrderPointer given_;        ///< to the process, and not done
  bool current_ = false;      ///< it has begun that one
  std::optional<Done> done_;  ///< not yet read
  // The process at work:
  bool begun_ = false;  ///< any scene
  int threads_ = 0;
  Clock::time_point started_;
  double cpu_told_ = 0;
  SocketPair* line_ = nullptr;
  std::string command_;
  ProcessLimits limits_;
  // Since its last scene:
  StageClock clock_;
  EngineLog log_;
};

class BlenderSession final : public SimpleSession {
 public:
  BlenderSession(const EngineStatus& status, const ReferenceOptions& options)
      : queue_{options, status},
        processors_(threads_of(options)),
        // Preparing a scene keeps Blender on one processor for most of a small picture's time.
        processes_(std::size_t(options.processes > 0 ? options.processes : processors_)) {}
  ~BlenderSession() override {
    {
      const std::scoped_lock lock(queue_.mutex);
      queue_.closing = true;
    }
    queue_.changed.notify_all();
  }

  /// Two for each process: the next scene is there when one is done.
  int at_once(std::size_t scenes) const override {
    return int(std::clamp(scenes, std::size_t{1}, 2 * processes_));
  }
  void stop() override {
    queue_.break_off(std::make_exception_ptr(Error(ExitCode::kInterrupted, "interrupted")));
  }

  ReferenceResult render(const Scene& scene, std::size_t scenes) override {
    const std::size_t processes = std::clamp(scenes, std::size_t{1}, processes_);
    BlenderScene input;
    try {
      const std::string name = fmt::format("scene{}", begun_++);
      input = queue_.options.own_transport
                  ? cycles_transport_input(scene, name)
                  : blender_input(in_engine_units(scene), name, queue_.native());
    } catch (const Error& refused) {
      return failed_result(kBlenderInfo, queue_.status, scene,
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
        return failed_result(kBlenderInfo, queue_.status, scene, *queue_.no_start);
      queue_.waiting.push_back(order);
      if (queue_.waiting.size() > queue_.idle && workers_.size() < processes)
        workers_.emplace_back([this] { Worker(queue_).run(); });
    }
    queue_.changed.notify_one();
    return result.get();
  }

 private:
  Queue queue_;
  const int processors_;
  const std::size_t processes_;
  std::atomic<std::size_t> begun_ = 0;
  std::vector<std::jthread> workers_;  ///< under the queue's lock
};

}  // namespace

std::unique_ptr<SimpleSession> open_blender(const EngineStatus& status,
                                            const ReferenceOptions& options) {
  return std::make_unique<BlenderSession>(status, options);
}

}  // namespace lobelia
