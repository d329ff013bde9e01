// SPDX-License-Identifier: BSD-3-Clause
#include "support/memory.hpp"

#include <cerrno>
#include <cstddef>
#include <cstdlib>
#include <new>

#if ENTS_TEST_OWN_MALLOC
#include <dlfcn.h>
#include <pthread.h>
#include <semaphore.h>
#endif

namespace {

thread_local bool watched = false;
thread_local long attempts = 0, left = 0, locks = 0, failing_attempt = 0;
thread_local bool forever_after = false;

// Counts an allocation; false if it is to fail.
bool permitted() noexcept {
  if (!watched) return true;
  ++attempts;
  if (failing_attempt == 0 || attempts < failing_attempt || (attempts > failing_attempt && !forever_after))
    return true;
  errno = ENOMEM;
  return false;
}

void* counted(void* block) noexcept {
  if (watched && block) ++left;
  return block;
}

void released(void* block) noexcept {
  if (watched && block) --left;
}

} // namespace

extern "C" {

void memory_watch(long failing, int forever) {
  attempts = left = locks = 0;
  failing_attempt = failing;
  forever_after = forever != 0;
  watched = true;
}
void memory_unwatch(void) { watched = false; }
long memory_allocations(void) { return attempts; }
long memory_left(void) { return left; }
long memory_locks(void) { return locks; }

#if ENTS_TEST_OWN_MALLOC
// glibc's own names of what is replaced here
void* __libc_malloc(std::size_t);
void* __libc_calloc(std::size_t, std::size_t);
void* __libc_realloc(void*, std::size_t);
void* __libc_memalign(std::size_t, std::size_t);
void __libc_free(void*);

void* malloc(std::size_t size) { return permitted() ? counted(__libc_malloc(size)) : nullptr; }
void* calloc(std::size_t count, std::size_t size) {
  return permitted() ? counted(__libc_calloc(count, size)) : nullptr;
}
void* realloc(void* block, std::size_t size) {
  if (!permitted()) return nullptr;
  void* moved = __libc_realloc(block, size);
  return block ? moved : counted(moved);
}
void* memalign(std::size_t alignment, std::size_t size) {
  return permitted() ? counted(__libc_memalign(alignment, size)) : nullptr;
}
void* aligned_alloc(std::size_t alignment, std::size_t size) { return memalign(alignment, size); }
int posix_memalign(void** block, std::size_t alignment, std::size_t size) {
  *block = memalign(alignment, size);
  return *block ? 0 : ENOMEM;
}
void free(void* block) {
  released(block);
  __libc_free(block);
}

// What may block a thread, counted and passed on.
#define COUNT_LOCK(name, type)                                                                               \
  int name(type* object) {                                                                                   \
    if (watched) ++locks;                                                                                    \
    static int (*const original)(type*) = reinterpret_cast<int (*)(type*)>(dlsym(RTLD_NEXT, #name));         \
    return original(object);                                                                                 \
  }
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wpedantic"
COUNT_LOCK(pthread_mutex_lock, pthread_mutex_t)
COUNT_LOCK(pthread_mutex_trylock, pthread_mutex_t)
COUNT_LOCK(pthread_rwlock_rdlock, pthread_rwlock_t)
COUNT_LOCK(pthread_rwlock_wrlock, pthread_rwlock_t)
COUNT_LOCK(sem_wait, sem_t)
#pragma GCC diagnostic pop
#endif
} // extern "C"

#if !ENTS_TEST_OWN_MALLOC
void* operator new(std::size_t size) {
  void* block = permitted() ? counted(std::malloc(size)) : nullptr;
  if (!block) throw std::bad_alloc();
  return block;
}
void* operator new[](std::size_t size) { return operator new(size); }
void operator delete(void* block) noexcept {
  released(block);
  std::free(block);
}
void operator delete[](void* block) noexcept { operator delete(block); }
void operator delete(void* block, std::size_t) noexcept { operator delete(block); }
void operator delete[](void* block, std::size_t) noexcept { operator delete(block); }
#endif
