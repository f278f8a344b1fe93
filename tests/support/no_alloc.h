// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <new>

// Replaces the global operator new and delete of a test program: include it in exactly one of its sources. While
// a NoAllocation lives, an allocation or a release by its thread ends the program with a message.
namespace afm::test {

// alignment as for the next section: mold 1.10 may leave a lone byte in a page that is not mapped
alignas(16) inline thread_local bool allocation_forbidden = false;

class NoAllocation {
 public:
  NoAllocation() { allocation_forbidden = true; }
  NoAllocation(const NoAllocation&) = delete;
  NoAllocation& operator=(const NoAllocation&) = delete;
  ~NoAllocation() { allocation_forbidden = false; }
};

inline void refuse_allocation(const char* what) {
  if (!allocation_forbidden) return;
  allocation_forbidden = false;
  std::fprintf(stderr, "%s where no allocation is allowed\n", what);
  std::abort();
}

}  // namespace afm::test

// ThreadSanitizer has its own operators, so the guard only has an effect in other builds.
#if defined(__has_feature)
#if __has_feature(thread_sanitizer)
#define AFM_TEST_SANITIZES_THREADS
#endif
#endif

#if !defined(AFM_TEST_SANITIZES_THREADS) && !defined(__SANITIZE_THREAD__)

// The standard library's array forms are defined by these; its nothrow form would be too, but AddressSanitizer has its
// own. Not inlined, because gcc 12 then mistakes the pair of operator new and free() for an error.
[[gnu::noinline]] void* operator new(std::size_t size) {
  afm::test::refuse_allocation("operator new");
  if (void* memory = std::malloc(size == 0 ? 1 : size)) return memory;
  throw std::bad_alloc();
}

[[gnu::noinline]] void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  afm::test::refuse_allocation("operator new");
  return std::malloc(size == 0 ? 1 : size);
}

void* operator new(std::size_t size, std::align_val_t alignment) {
  afm::test::refuse_allocation("operator new");
  const auto align = static_cast<std::size_t>(alignment);
  if (void* memory = std::aligned_alloc(align, (size + align - 1) / align * align)) return memory;
  throw std::bad_alloc();
}

[[gnu::noinline]] void operator delete(void* memory) noexcept {
  if (memory != nullptr) afm::test::refuse_allocation("operator delete");
  std::free(memory);
}

void operator delete(void* memory, std::size_t) noexcept { operator delete(memory); }
void operator delete(void* memory, std::align_val_t) noexcept { operator delete(memory); }
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept { operator delete(memory); }

#endif
