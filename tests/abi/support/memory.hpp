// SPDX-License-Identifier: BSD-3-Clause
// What a stretch of code asks of the heap and of locks, and memory that runs out on purpose. For programs
// linked with memory.cpp, which stands in for the C library's malloc and locks and for operator new.
#pragma once

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
// A sanitizer brings its own malloc and locks: only operator new is watched then.
#define ENTS_TEST_OWN_MALLOC 0
#else
#define ENTS_TEST_OWN_MALLOC 1
#endif

extern "C" {

// From now on this thread's allocations and locks are counted, and the `failing`-th allocation fails (0:
// none); `forever`: all after it, too.
void memory_watch(long failing, int forever);
// Stop it; a failure that has not come yet will not come.
void memory_unwatch(void);

long memory_allocations(void); // attempts since memory_watch
long memory_left(void);        // blocks allocated and not released since memory_watch
long memory_locks(void);       // since memory_watch
}
