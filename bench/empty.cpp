// An empty program with lobelia's libraries. It touches so many new pages, and writes and flushes so many small files.
//
//   bench_empty [PAGES [FILE]...]
#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cstdlib>

int main(int count, char** arguments) {
  const std::size_t page = std::size_t(::sysconf(_SC_PAGESIZE));
  const std::size_t bytes = count > 1 ? std::strtoul(arguments[1], nullptr, 10) * page : 0;
  if (bytes > 0) {
    void* const memory =
        ::mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (memory == MAP_FAILED) return 1;
    ::madvise(memory, bytes, MADV_NOHUGEPAGE);
    for (std::size_t i = 0; i < bytes; i += page) static_cast<volatile char*>(memory)[i] = 1;
  }
  for (int i = 2; i < count; ++i) {
    const int file = ::open(arguments[i], O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
    if (file < 0 || ::write(file, "empty\n", 6) != 6 || ::fsync(file) != 0) return 1;
    ::close(file);
  }
  return 0;
}
