#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>

#include "base/system/interrupt.hpp"
#include "program/python/module.hpp"

namespace lobelia::python {
namespace {

/// Between looks for Ctrl-C.
constexpr std::chrono::milliseconds kLook{20};

}  // namespace

void run(const py::object& progress, const std::function<void(const ShowProgress&)>& work) {
  std::atomic<double> fraction{0};
  std::exception_ptr failure, stop;
  std::mutex mutex;
  std::condition_variable changed;
  bool finished = false;
  double shown = -1;
  // Python's signal handlers run in its main thread alone, so that one may not be away at work.
  std::thread worker([&] {
    try {
      work([&](double now) { fraction = now; });
    } catch (...) {
      failure = std::current_exception();
    }
    const std::lock_guard lock(mutex);
    finished = true;
    changed.notify_one();
  });
  const auto look = [&] {
    const py::gil_scoped_acquire gil;
    try {
      if (PyErr_CheckSignals() != 0) throw py::error_already_set();
      if (const double now = fraction; !progress.is_none() && now != shown) {
        progress(now);
        shown = now;
      }
    } catch (const py::error_already_set&) {
      stop = std::current_exception();
      request_interrupt();
    }
  };
  {
    const py::gil_scoped_release released;
    std::unique_lock lock(mutex);
    while (!changed.wait_for(lock, kLook, [&] { return finished; })) {
      if (stop) continue;
      lock.unlock();
      look();
      lock.lock();
    }
    lock.unlock();
    worker.join();
  }
  if (stop) {
    forget_interrupt();
    std::rethrow_exception(stop);
  }
  if (failure) std::rethrow_exception(failure);
  if (!progress.is_none() && shown != 1) progress(1.0);
}

}  // namespace lobelia::python
