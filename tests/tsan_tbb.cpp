// Only for builds with the thread sanitizer. oneTBB is not instrumented, so the sanitizer does not see that a task starts
// after it was spawned and that a wait ends after its tasks, and would report a race for everything that a task reads.
// A suppression of tbb::detail hides a race that is planted in a loop's body; without it, one loop has 37 false reports. So
// these functions replace oneTBB's entry points, tell the sanitizer exactly what the library guarantees, and call it. Two
// bodies of one loop stay unordered, and a race between them is found. For oneTBB 2021 (libtbb.so.12).
#include <dlfcn.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>
#include <oneapi/tbb/task_group.h>
#include <sanitizer/tsan_interface.h>

#include <cstdio>
#include <cstdlib>

namespace tbb::detail::r1 {

/// wait_context declares a class of this name, which no header defines, as a friend.
class external_waiter {
 public:
  /// Loads the counter that every finished task has released, as wait() did in code without instrumentation.
  static void synchronise(const d1::wait_context& wait) { (void)wait.continue_execution(); }
};

namespace {

/// The library's own function. Its name is the mangled one: the replacement has the same.
template <class Function>
Function* original(const char* name) {
  if (void* found = ::dlsym(RTLD_NEXT, name)) return reinterpret_cast<Function*>(found);
  std::fprintf(stderr, "tests/tsan_tbb.cpp: libtbb has no %s\n", name);
  std::abort();
}

/// Runs a task after everything that happened before it was spawned.
class Spawned final : public d1::task {
 public:
  static d1::task& make(d1::task& inner) {
    auto* spawned = new Spawned(inner);
    __tsan_release(spawned);
    return *spawned;
  }
  d1::task* execute(d1::execution_data& data) override {
    __tsan_acquire(this);
    d1::task* next = inner_.execute(data);  // if it throws, cancel() is called next
    delete this;
    return next;
  }
  d1::task* cancel(d1::execution_data& data) override {
    __tsan_acquire(this);
    d1::task* next = inner_.cancel(data);
    delete this;
    return next;
  }

 private:
  explicit Spawned(d1::task& inner) : inner_(inner) {}
  d1::task& inner_;
};

/// An arena without a free place lets another thread run the work.
class Delegated final : public d1::delegate_base {
 public:
  explicit Delegated(const d1::delegate_base& inner) : inner_(inner) { __tsan_release(this); }
  ~Delegated() override { __tsan_acquire(this); }
  bool operator()() const override {
    auto* self = const_cast<Delegated*>(this);
    __tsan_acquire(self);
    struct Done {
      Delegated* self;
      ~Done() { __tsan_release(self); }
    } done{self};
    return inner_();
  }

 private:
  const d1::delegate_base& inner_;
};

/// At the end of a wait, however it ends.
struct Waited {
  const d1::wait_context& wait;
  ~Waited() { external_waiter::synchronise(wait); }
};

}  // namespace

void spawn(d1::task& t, d1::task_group_context& context) {
  static auto* next = original<void(d1::task&, d1::task_group_context&)>(
      "_ZN3tbb6detail2r15spawnERNS0_2d14taskERNS2_18task_group_contextE");
  next(Spawned::make(t), context);
}

void spawn(d1::task& t, d1::task_group_context& context, d1::slot_id slot) {
  static auto* next = original<void(d1::task&, d1::task_group_context&, d1::slot_id)>(
      "_ZN3tbb6detail2r15spawnERNS0_2d14taskERNS2_18task_group_contextEt");
  next(Spawned::make(t), context, slot);
}

// The task itself is run by the thread that waits; what it spawns comes by the functions above.
void execute_and_wait(d1::task& t, d1::task_group_context& context, d1::wait_context& wait,
                      d1::task_group_context& wait_context) {
  static auto* next = original<void(d1::task&, d1::task_group_context&, d1::wait_context&,
                                    d1::task_group_context&)>(
      "_ZN3tbb6detail2r116execute_and_waitERNS0_2d14taskERNS2_18task_group_contextERNS2_12wait_"
      "contextES6_");
  const Waited waited{wait};
  next(t, context, wait, wait_context);
}

void wait(d1::wait_context& wait, d1::task_group_context& context) {
  static auto* next = original<void(d1::wait_context&, d1::task_group_context&)>(
      "_ZN3tbb6detail2r14waitERNS0_2d112wait_contextERNS2_18task_group_contextE");
  const Waited waited{wait};
  next(wait, context);
}

void execute(d1::task_arena_base& arena, d1::delegate_base& work) {
  static auto* next = original<void(d1::task_arena_base&, d1::delegate_base&)>(
      "_ZN3tbb6detail2r17executeERNS0_2d115task_arena_baseERNS2_13delegate_baseE");
  Delegated delegated(work);
  next(arena, delegated);
}

// Memory goes from thread to thread through the library's pools: it is allocated after it was freed.
void* allocate(d1::small_object_pool*& pool, std::size_t bytes) {
  static auto* next = original<void*(d1::small_object_pool*&, std::size_t)>(
      "_ZN3tbb6detail2r18allocateERPNS0_2d117small_object_poolEm");
  void* memory = next(pool, bytes);
  __tsan_acquire(memory);
  return memory;
}

void* allocate(d1::small_object_pool*& pool, std::size_t bytes, const d1::execution_data& data) {
  static auto* next =
      original<void*(d1::small_object_pool*&, std::size_t, const d1::execution_data&)>(
          "_ZN3tbb6detail2r18allocateERPNS0_2d117small_object_poolEmRKNS2_14execution_dataE");
  void* memory = next(pool, bytes, data);
  __tsan_acquire(memory);
  return memory;
}

void deallocate(d1::small_object_pool& pool, void* memory, std::size_t bytes) {
  static auto* next = original<void(d1::small_object_pool&, void*, std::size_t)>(
      "_ZN3tbb6detail2r110deallocateERNS0_2d117small_object_poolEPvm");
  __tsan_release(memory);
  next(pool, memory, bytes);
}

void deallocate(d1::small_object_pool& pool, void* memory, std::size_t bytes,
                const d1::execution_data& data) {
  static auto* next =
      original<void(d1::small_object_pool&, void*, std::size_t, const d1::execution_data&)>(
          "_ZN3tbb6detail2r110deallocateERNS0_2d117small_object_poolEPvmRKNS2_14execution_dataE");
  __tsan_release(memory);
  next(pool, memory, bytes, data);
}

void* cache_aligned_allocate(std::size_t bytes) {
  static auto* next = original<void*(std::size_t)>("_ZN3tbb6detail2r122cache_aligned_allocateEm");
  void* memory = next(bytes);
  __tsan_acquire(memory);
  return memory;
}

void cache_aligned_deallocate(void* memory) {
  static auto* next = original<void(void*)>("_ZN3tbb6detail2r124cache_aligned_deallocateEPv");
  __tsan_release(memory);
  next(memory);
}

}  // namespace tbb::detail::r1
