#include "machine.hpp"

#include <algorithm>
#include <cstring>
#include <stdexcept>
#include <vector>

#include "interleaved.hpp"
#include "stores.hpp"

namespace bench {

namespace {

#if defined(__x86_64__)
#define ENTS_AVX2 __attribute__((target("avx2")))
#define ENTS_AVX512 __attribute__((target("avx512f")))
#endif

// As many chains as the registers hold. Macros, because a function that is inlined must not have another
// target.
#define ENTS_SPIN(name, target, width, chains)                                                               \
  target double name(std::int64_t rounds) {                                                                  \
    typedef double Vector __attribute__((vector_size(8 * width)));                                           \
    Vector a[chains], b[chains];                                                                             \
    _Pragma("GCC unroll 16") for (int i = 0; i < chains; ++i) a[i] = b[i] = Vector{};                        \
    for (std::int64_t k = 0; k < rounds; ++k) {                                                              \
      _Pragma("GCC unroll 16") for (int i = 0; i < chains; ++i) a[i] = a[i] * 1.0000000001;                  \
      _Pragma("GCC unroll 16") for (int i = 0; i < chains; ++i) b[i] = b[i] + 1e-10;                         \
      _Pragma("GCC unroll 16") for (int i = 0; i < chains; ++i) asm volatile("" : "+v"(a[i]), "+v"(b[i]));   \
    }                                                                                                        \
    double sum = 0.0;                                                                                        \
    _Pragma("GCC unroll 16") for (int i = 0; i < chains; ++i) sum += a[i][0] + b[i][0];                      \
    return sum;                                                                                              \
  }
#define ENTS_STORE(name, target, width)                                                                      \
  template <int Dofs> target void name(double* to, std::int64_t columns) {                                   \
    typedef double Vector __attribute__((vector_size(8 * width), aligned(8), may_alias));                    \
    constexpr int last = Dofs > width ? Dofs - width : 0;                                                    \
    Vector v{};                                                                                              \
    asm volatile("" : "+v"(v));                                                                              \
    for (std::int64_t j = 0; j < columns; ++j, to += Dofs) {                                                 \
      _Pragma("GCC unroll 16") for (int i = 0; i < last; i += width) * reinterpret_cast<Vector*>(to + i) =   \
          v;                                                                                                 \
      if constexpr (Dofs >= width)                                                                           \
        *reinterpret_cast<Vector*>(to + last) = v;                                                           \
      else                                                                                                   \
        std::memcpy(to, &v, sizeof(double) * Dofs);                                                          \
    }                                                                                                        \
  }
#if defined(__x86_64__)
ENTS_SPIN(spin_portable, , 2, 7)
ENTS_SPIN(spin_avx2, ENTS_AVX2, 4, 7)
ENTS_SPIN(spin_avx512, ENTS_AVX512, 8, 10)
ENTS_STORE(store_portable, , 2)
ENTS_STORE(store_avx2, ENTS_AVX2, 4)
ENTS_STORE(store_avx512, ENTS_AVX512, 8)
#endif

template <int Dofs> void store_widest(double* to, std::int64_t columns) {
#if defined(__x86_64__)
  // a line2's six numbers are no whole register of eight
  if (Dofs >= 8 && __builtin_cpu_supports("avx512f"))
    store_avx512<Dofs>(to, columns);
  else if (__builtin_cpu_supports("avx2"))
    store_avx2<Dofs>(to, columns);
  else
    store_portable<Dofs>(to, columns);
#else
  std::fill_n(to, Dofs * columns, 0.0);
#endif
}

} // namespace

void store_columns(double* to, int dofs, std::int64_t columns) {
  switch (dofs) {
  case 6:
    store_widest<6>(to, columns);
    break;
  case 12:
    store_widest<12>(to, columns);
    break;
  case 15:
    store_widest<15>(to, columns);
    break;
  case 30:
    store_widest<30>(to, columns);
    break;
  default:
    throw std::invalid_argument("store_columns: 6, 12, 15 or 30 dofs");
  }
  asm volatile("" : : "r"(to) : "memory");
}

Machine measure_machine() {
  constexpr std::int64_t rounds = 2000000;
  Machine machine{};
  double (*run)(std::int64_t) = nullptr;
  double each = 0.0; // flops of a round
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx512f"))
    run = spin_avx512, each = 20.0 * 8.0, machine.registers = "64 bytes";
  else if (__builtin_cpu_supports("avx2"))
    run = spin_avx2, each = 14.0 * 4.0, machine.registers = "32 bytes";
  else
    run = spin_portable, each = 14.0 * 2.0, machine.registers = "16 bytes";
#endif
  volatile double sink = 0.0;
  std::vector<double> memory(std::size_t{1} << 25, 1.0); // 256 MiB
  const std::vector<double> seconds =
      interleaved_seconds({[&] {
                             if (run) sink = sink + run(rounds);
                           },
                           [&] { store_all(memory.data(), memory.size(), sink); }},
                          9);
  if (run) machine.flops = each * static_cast<double>(rounds) / seconds[0];
  machine.bytes = 8.0 * static_cast<double>(memory.size()) / seconds[1];
  return machine;
}

} // namespace bench
