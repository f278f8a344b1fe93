// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <dlfcn.h>
#include <pthread.h>
#include <semaphore.h>

#include <cstddef>
#include <cstdio>
#include <cstdlib>

// Intercepts the locks and exceptions of a test program: include it in exactly one of its sources. While a NoLock
// exists, taking a lock or throwing in its thread ends the program with a message, even without contention and even if
// the exception were caught.
namespace afm::test {

// alignment as for the next section: mold 1.10 may leave a lone byte in a page that is not mapped
alignas(16) inline thread_local bool lock_forbidden = false;

class NoLock {
 public:
  NoLock() { lock_forbidden = true; }
  NoLock(const NoLock&) = delete;
  NoLock& operator=(const NoLock&) = delete;
  ~NoLock() { lock_forbidden = false; }
};

// Function that the name would have reached without this file.
template <class Function>
Function* next_of(const char* name) {
  if (lock_forbidden) {
    lock_forbidden = false;
    std::fprintf(stderr, "%s where nothing may lock or throw\n", name);
    std::abort();
  }
  return reinterpret_cast<Function*>(::dlsym(RTLD_NEXT, name));
}

}  // namespace afm::test

extern "C" {
int pthread_mutex_lock(pthread_mutex_t* mutex) noexcept {
  return afm::test::next_of<int(pthread_mutex_t*)>("pthread_mutex_lock")(mutex);
}
int pthread_mutex_trylock(pthread_mutex_t* mutex) noexcept {
  return afm::test::next_of<int(pthread_mutex_t*)>("pthread_mutex_trylock")(mutex);
}
int pthread_rwlock_rdlock(pthread_rwlock_t* lock) noexcept {
  return afm::test::next_of<int(pthread_rwlock_t*)>("pthread_rwlock_rdlock")(lock);
}
int pthread_rwlock_wrlock(pthread_rwlock_t* lock) noexcept {
  return afm::test::next_of<int(pthread_rwlock_t*)>("pthread_rwlock_wrlock")(lock);
}
int pthread_cond_signal(pthread_cond_t* condition) noexcept {
  return afm::test::next_of<int(pthread_cond_t*)>("pthread_cond_signal")(condition);
}
int sem_wait(sem_t* semaphore) { return afm::test::next_of<int(sem_t*)>("sem_wait")(semaphore); }

void* __cxa_allocate_exception(std::size_t size) noexcept {
  return afm::test::next_of<void*(std::size_t)>("__cxa_allocate_exception")(size);
}
}
