// SPDX-License-Identifier: Apache-2.0
// One allocation or one system call of a program fails, from the moment main() begins:
//   AFM_FAIL=memory:all | calls:all   each of them, in a process forked for it alone, which goes on to its end
//   AFM_FAIL=memory:N | calls:N       the Nth of this process
// With AFM_FAIL_PROGRAM set only what the program itself calls, and not its libraries: a driver that finds no memory
// ends every program. AFM_FAIL_REPORT names a file that gets a line for each forked process, "N CALL STATUS LINES
// HASH": what failed, as wait() gives its status, how many lines it wrote to stderr, a digest of what it wrote to
// stdout; and "count N" at the end. The last forked process that broke a rule leaves its stderr in AFM_FAIL_REPORT.err.
#include <dlfcn.h>
#include <fcntl.h>
#include <link.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdarg>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <new>

extern "C" {
// the C library's own allocator, whatever is called malloc
void* __libc_malloc(std::size_t);
void* __libc_calloc(std::size_t, std::size_t);
void* __libc_realloc(void*, std::size_t);
void* __libc_memalign(std::size_t, std::size_t);
}

namespace {

enum class What { Nothing, Memory, Calls };

constexpr int kSeconds = 20;  // time limit of a forked process

What armed = What::Nothing;
bool all = false;
long chosen = 0;
long counted = 0;
pid_t owner = 0;
int report = -1;
bool of_program_alone = false;
const char* program_begin = nullptr;
const char* program_end = nullptr;

void say(const char* format, ...) __attribute__((format(printf, 1, 2)));
void say(const char* format, ...) {
  std::array<char, 256> line{};
  va_list values;
  va_start(values, format);
  const int length = std::vsnprintf(line.data(), line.size(), format, values);
  va_end(values);
  [[maybe_unused]] const auto written = ::syscall(SYS_write, report, line.data(), length);
}

// Number of lines and FNV-1a of a file's contents.
struct Text {
  int lines = 0;
  std::uint64_t hash = 14695981039346656037ULL;
};
Text text_of(int file) {
  Text text;
  std::array<char, 4096> part{};
  for (off_t at = 0;;) {
    const long length = ::syscall(SYS_pread64, file, part.data(), part.size(), at);
    if (length <= 0) return text;
    at += length;
    for (long i = 0; i < length; ++i) {
      text.lines += part[static_cast<std::size_t>(i)] == '\n' ? 1 : 0;
      text.hash = (text.hash ^ static_cast<unsigned char>(part[static_cast<std::size_t>(i)])) * 1099511628211ULL;
    }
  }
}

// True in the process that is forked to fail here; false in the other, once that one has ended.
bool fails_in_a_fork(const char* call) {
  const What kind = armed;
  armed = What::Nothing;
  const int out = static_cast<int>(::syscall(SYS_memfd_create, "out", 0U));
  const int err = static_cast<int>(::syscall(SYS_memfd_create, "err", 0U));
  pid_t child = -1;
  for (int tries = 0; (child = ::fork()) < 0 && tries < 1000; ++tries) ::usleep(1000);
  if (child < 0) {
    say("%ld fork failed: no verdict\n", counted);
    ::_exit(99);
  }
  if (child == 0) {
    ::alarm(kSeconds);
    ::dup2(out, STDOUT_FILENO);
    ::dup2(err, STDERR_FILENO);
    ::syscall(SYS_close, out);
    ::syscall(SYS_close, err);
    ::syscall(SYS_close, report);
    return true;
  }
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  const Text said = text_of(err);
  say("%ld %s %d %d %llx\n", counted, call, status, said.lines, static_cast<unsigned long long>(text_of(out).hash));
  if (WIFSIGNALED(status) || said.lines > 1) {
    std::array<char, 2000> words{};
    const long length = ::syscall(SYS_pread64, err, words.data(), words.size(), 0);
    const char* name = std::getenv("AFM_FAIL_REPORT");
    std::array<char, 512> path{};
    std::snprintf(path.data(), path.size(), "%s.err", name);
    const int file = static_cast<int>(::syscall(SYS_openat, AT_FDCWD, path.data(), O_CREAT | O_WRONLY | O_TRUNC, 0600));
    [[maybe_unused]] const auto written = ::syscall(SYS_write, file, words.data(), length);
    ::syscall(SYS_close, file);
  }
  ::syscall(SYS_close, out);
  ::syscall(SYS_close, err);
  armed = kind;
  return false;
}

bool fails(What kind, const char* call, const void* caller) {
  if (armed != kind || ::syscall(SYS_getpid) != owner) return false;
  if (of_program_alone && (caller < program_begin || caller >= program_end)) return false;
  ++counted;
  if (all) return fails_in_a_fork(call);
  return counted == chosen;
}

bool fails_with(int error, const char* call, const void* caller) {
  const int before = errno;
  const bool failed = fails(What::Calls, call, caller);
  errno = failed ? error : before;
  return failed;
}

// The first object is the program.
int find_program(dl_phdr_info* object, std::size_t /*size*/, void* /*data*/) {
  for (int i = 0; i < object->dlpi_phnum; ++i) {
    const auto& part = object->dlpi_phdr[i];
    if (part.p_type != PT_LOAD || (part.p_flags & PF_X) == 0) continue;
    program_begin = reinterpret_cast<const char*>(object->dlpi_addr + part.p_vaddr);
    program_end = program_begin + part.p_memsz;
  }
  return 1;
}

using Main = int (*)(int, char**, char**);
Main program_main = nullptr;

int main_that_fails(int argc, char** argv, char** environment) {
  const char* wish = std::getenv("AFM_FAIL");
  if (const char* path = std::getenv("AFM_FAIL_REPORT")) {
    report = static_cast<int>(::syscall(SYS_openat, AT_FDCWD, path, O_CREAT | O_WRONLY | O_APPEND | O_CLOEXEC, 0600));
  }
  if (wish != nullptr) {
    const char* number = std::strchr(wish, ':');
    const bool memory = std::strncmp(wish, "memory", 6) == 0;
    all = number != nullptr && std::strcmp(number, ":all") == 0;
    chosen = number != nullptr && !all ? std::atol(number + 1) : 0;
    owner = ::getpid();
    of_program_alone = std::getenv("AFM_FAIL_PROGRAM") != nullptr;
    ::dl_iterate_phdr(find_program, nullptr);
    // programs that this one starts must not inherit it
    ::unsetenv("LD_PRELOAD");
    armed = memory ? What::Memory : What::Calls;
  }
  return program_main(argc, argv, environment);
}

__attribute__((destructor)) void tell_the_count() {
  if (armed == What::Nothing || ::syscall(SYS_getpid) != owner) return;
  armed = What::Nothing;
  say("count %ld\n", counted);
}

long as_libc(long result) { return result; }  // errno set by syscall()

}  // namespace

// Called by the program itself, where malloc is called by the C++ library.
void* operator new(std::size_t size) {
  if (of_program_alone && fails(What::Memory, "new", __builtin_return_address(0))) throw std::bad_alloc();
  if (void* place = std::malloc(size)) return place;
  throw std::bad_alloc();
}
void* operator new[](std::size_t size) {
  if (of_program_alone && fails(What::Memory, "new[]", __builtin_return_address(0))) throw std::bad_alloc();
  if (void* place = std::malloc(size)) return place;
  throw std::bad_alloc();
}
void operator delete(void* place) noexcept { std::free(place); }
void operator delete(void* place, std::size_t /*size*/) noexcept { std::free(place); }
void operator delete[](void* place) noexcept { std::free(place); }
void operator delete[](void* place, std::size_t /*size*/) noexcept { std::free(place); }

extern "C" {

int __libc_start_main(Main main, int argc, char** argv, void (*init)(), void (*fini)(), void (*rtld)(), void* stack) {
  program_main = main;
  using Start = int (*)(Main, int, char**, void (*)(), void (*)(), void (*)(), void*);
  const auto start = reinterpret_cast<Start>(::dlsym(RTLD_NEXT, "__libc_start_main"));
  return start(main_that_fails, argc, argv, init, fini, rtld, stack);
}

void* malloc(std::size_t size) {
  if (fails(What::Memory, "malloc", __builtin_return_address(0))) {
    errno = ENOMEM;
    return nullptr;
  }
  return __libc_malloc(size);
}
void* calloc(std::size_t count, std::size_t size) {
  if (fails(What::Memory, "calloc", __builtin_return_address(0))) {
    errno = ENOMEM;
    return nullptr;
  }
  return __libc_calloc(count, size);
}
void* realloc(void* old, std::size_t size) {
  if (fails(What::Memory, "realloc", __builtin_return_address(0))) {
    errno = ENOMEM;
    return nullptr;
  }
  return __libc_realloc(old, size);
}
void* aligned_alloc(std::size_t alignment, std::size_t size) {
  if (fails(What::Memory, "aligned_alloc", __builtin_return_address(0))) {
    errno = ENOMEM;
    return nullptr;
  }
  return __libc_memalign(alignment, size);
}
int posix_memalign(void** place, std::size_t alignment, std::size_t size) {
  if (fails(What::Memory, "posix_memalign", __builtin_return_address(0))) return ENOMEM;
  *place = __libc_memalign(alignment, size);
  return *place == nullptr ? ENOMEM : 0;
}

int openat(int folder, const char* path, int flags, ...) {
  if (fails_with(EIO, "open", __builtin_return_address(0))) return -1;
  va_list values;
  va_start(values, flags);
  const mode_t mode = (flags & (O_CREAT | O_TMPFILE)) != 0 ? va_arg(values, mode_t) : 0;
  va_end(values);
  return static_cast<int>(as_libc(::syscall(SYS_openat, folder, path, flags, mode)));
}
int open(const char* path, int flags, ...) {
  if (fails_with(EIO, "open", __builtin_return_address(0))) return -1;
  va_list values;
  va_start(values, flags);
  const mode_t mode = (flags & (O_CREAT | O_TMPFILE)) != 0 ? va_arg(values, mode_t) : 0;
  va_end(values);
  return static_cast<int>(as_libc(::syscall(SYS_openat, AT_FDCWD, path, flags, mode)));
}
int openat64(int, const char*, int, ...) __attribute__((alias("openat")));
int open64(const char*, int, ...) __attribute__((alias("open")));
FILE* fopen(const char* path, const char* mode) {
  if (fails_with(EIO, "fopen", __builtin_return_address(0))) return nullptr;
  return reinterpret_cast<FILE* (*)(const char*, const char*)>(::dlsym(RTLD_NEXT, "fopen"))(path, mode);
}
FILE* fopen64(const char*, const char*) __attribute__((alias("fopen")));
ssize_t read(int file, void* bytes, std::size_t count) {
  if (fails_with(EIO, "read", __builtin_return_address(0))) return -1;
  return as_libc(::syscall(SYS_read, file, bytes, count));
}
ssize_t pread(int file, void* bytes, std::size_t count, off_t at) {
  if (fails_with(EIO, "pread", __builtin_return_address(0))) return -1;
  return as_libc(::syscall(SYS_pread64, file, bytes, count, at));
}
// a failure to write to stderr is ignored
ssize_t write(int file, const void* bytes, std::size_t count) {
  if (file != STDERR_FILENO && fails_with(ENOSPC, "write", __builtin_return_address(0))) return -1;
  return as_libc(::syscall(SYS_write, file, bytes, count));
}
std::size_t fwrite(const void* bytes, std::size_t size, std::size_t count, FILE* file) {
  if (file != stderr && fails_with(ENOSPC, "fwrite", __builtin_return_address(0))) return 0;
  using Write = std::size_t (*)(const void*, std::size_t, std::size_t, FILE*);
  return reinterpret_cast<Write>(::dlsym(RTLD_NEXT, "fwrite"))(bytes, size, count, file);
}
int fsync(int file) {
  if (fails_with(EIO, "fsync", __builtin_return_address(0))) return -1;
  return static_cast<int>(as_libc(::syscall(SYS_fsync, file)));
}
int ftruncate(int file, off_t length) {
  if (fails_with(ENOSPC, "ftruncate", __builtin_return_address(0))) return -1;
  return static_cast<int>(as_libc(::syscall(SYS_ftruncate, file, length)));
}
int rename(const char* from, const char* to) {
  if (fails_with(EIO, "rename", __builtin_return_address(0))) return -1;
  return static_cast<int>(as_libc(::syscall(SYS_rename, from, to)));
}
int renameat(int from_folder, const char* from, int to_folder, const char* to) {
  if (fails_with(EIO, "renameat", __builtin_return_address(0))) return -1;
  return static_cast<int>(as_libc(::syscall(SYS_renameat, from_folder, from, to_folder, to)));
}
int mkdir(const char* path, mode_t mode) {
  if (fails_with(ENOSPC, "mkdir", __builtin_return_address(0))) return -1;
  return static_cast<int>(as_libc(::syscall(SYS_mkdir, path, mode)));
}
int socket(int domain, int type, int protocol) {
  if (fails_with(EMFILE, "socket", __builtin_return_address(0))) return -1;
  return static_cast<int>(as_libc(::syscall(SYS_socket, domain, type, protocol)));
}
int socketpair(int domain, int type, int protocol, int* ends) {
  if (fails_with(EMFILE, "socketpair", __builtin_return_address(0))) return -1;
  return static_cast<int>(as_libc(::syscall(SYS_socketpair, domain, type, protocol, ends)));
}
int memfd_create(const char* name, unsigned flags) noexcept {
  if (fails_with(ENOMEM, "memfd_create", __builtin_return_address(0))) return -1;
  return static_cast<int>(as_libc(::syscall(SYS_memfd_create, name, flags)));
}
int pipe2(int* ends, int flags) noexcept {
  if (fails_with(EMFILE, "pipe2", __builtin_return_address(0))) return -1;
  return static_cast<int>(as_libc(::syscall(SYS_pipe2, ends, flags)));
}

}  // extern "C"
