// Preloaded into the program: no more threads live at once than $THREADS_ALLOWED, as under `ulimit -u`, which does not
// bind root.
#include <dlfcn.h>
#include <errno.h>
#include <pthread.h>
#include <stdlib.h>

#include <atomic>

namespace {

std::atomic<long> g_living{0};

const long g_allowed = [] {
  const char* const text = getenv("THREADS_ALLOWED");
  unsetenv("LD_PRELOAD");  // no business of the engines
  return text ? atol(text) : 0;
}();

struct Start {
  void* (*function)(void*);
  void* argument;
};

void* live(void* start) {
  const Start what = *static_cast<Start*>(start);
  delete static_cast<Start*>(start);
  struct End {
    ~End() { --g_living; }
  } const end;
  return what.function(what.argument);
}

}  // namespace

extern "C" int pthread_create(pthread_t* thread, const pthread_attr_t* attributes,
                              void* (*function)(void*), void* argument) {
  static const auto call =
      reinterpret_cast<int (*)(pthread_t*, const pthread_attr_t*, void* (*)(void*), void*)>(
          dlsym(RTLD_NEXT, "pthread_create"));
  if (++g_living > g_allowed) {
    --g_living;
    return EAGAIN;
  }
  auto* const start = new Start{function, argument};
  const int error = call(thread, attributes, live, start);
  if (error != 0) {
    --g_living;
    delete start;
  }
  return error;
}
