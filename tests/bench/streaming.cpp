#include "streaming.hpp"

#include <algorithm>
#include <functional>
#include <iomanip>
#include <ostream>
#include <stdexcept>
#include <string>
#include <vector>

#include "cases.hpp"
#include "growth.hpp"
#include "interleaved.hpp"
#include "stores.hpp"

namespace bench {

namespace {

constexpr std::int64_t per_call = 64;
constexpr double most_bytes = 3.8e9; // of results
constexpr int turns = 7;

struct Kind {
  std::string basis;
  bool enriched;
  std::int64_t padding; // of a tangent's columns
};

// `count` elements, 4096 different ones over and over, all inputs in arrays of their own length. Results,
// contiguous or with padded columns.
class Elements {
public:
  Elements(const Job& job, std::int64_t padding, std::int64_t most)
      : job_(job), leading_(job.dofs() + padding), residual_stride_(leading_),
        tangent_stride_(leading_ * job.dofs()),
        count_(std::min(most, static_cast<std::int64_t>(most_bytes / bytes()) / per_call * per_call)) {
    const mechanics::Elements& few = job.elements();
    slave_ = repeated(few.slave, few.count);
    master_ = repeated(few.master, few.count);
    start_ = repeated(few.start, few.count);
    area_ = repeated(few.area, few.count);
    input_.struct_size = sizeof input_;
    input_.slave_stride = job.dimension();
    input_.master_stride = job.dofs() - job.dimension();
    input_.start_stride = job.dimension() - 1;
    input_.area_stride = 1;
    output_.struct_size = sizeof output_;
    output_.wanted = ENTS_RESIDUAL | ENTS_TANGENT;
    output_.residual_stride = residual_stride_;
    output_.tangent_stride = tangent_stride_;
    output_.tangent_leading_dimension = leading_;
    // a cache line's length at its end, so that it can begin with one
    memory_.assign(static_cast<std::size_t>(count_ * (residual_stride_ + tangent_stride_)) + 8, 1.0);
    cached_.assign(static_cast<std::size_t>(per_call * (residual_stride_ + tangent_stride_)), 1.0);
    first_ = memory_.data();
    while (reinterpret_cast<std::uintptr_t>(first_) % 64 != 0) ++first_;
  }
  std::int64_t count() const { return count_; }
  double bytes() const { return 8.0 * static_cast<double>(residual_stride_ + tangent_stride_); }
  void store() { store_all(first_, entries(), 1.0); }
  void store_past() { store_past_caches(first_, entries(), 1.0); }

  // n elements in one call, results one behind the other
  void stream(std::int64_t n) { evaluate(0, n, n, first_); }
  // in calls of 64, results in the same places
  void reuse(std::int64_t n) {
    for (std::int64_t e = 0; e < n; e += per_call)
      evaluate(e, std::min(per_call, n - e), per_call, cached_.data());
  }

  // the same, each call's results then copied to places of their own: residuals and tangents of 64, of the
  // next 64, ..
  void copy(std::int64_t n) {
    const std::int64_t each = residual_stride_ + tangent_stride_;
    for (std::int64_t e = 0; e < n; e += per_call) {
      const std::int64_t some = std::min(per_call, n - e);
      evaluate(e, some, some, cached_.data());
      std::copy_n(cached_.data(), some * each, first_ + e * each);
    }
  }

private:
  std::size_t entries() const {
    return static_cast<std::size_t>(count_ * (residual_stride_ + tangent_stride_));
  } // even: n (n + 1) is
  std::vector<double> repeated(const std::vector<double>& few, std::int64_t different) const {
    const std::size_t entries = few.size() / static_cast<std::size_t>(different);
    std::vector<double> many(static_cast<std::size_t>(count_) * entries);
    for (std::size_t i = 0; i < many.size(); ++i) many[i] = few[i % few.size()];
    return many;
  }
  void evaluate(std::int64_t first, std::int64_t n, std::int64_t places, double* results) {
    input_.slave = slave_.data() + first * input_.slave_stride;
    input_.master = master_.data() + first * input_.master_stride;
    input_.start = start_.data() + first * input_.start_stride;
    input_.area = area_.data() + first;
    output_.residual = results;
    output_.tangent = results + places * residual_stride_;
    if (ents_evaluate(job_.model().handle(), 0, n, &input_, &output_, nullptr) != ENTS_OK)
      throw std::runtime_error("an element fails");
    asm volatile("" : : "r"(results) : "memory");
  }

  const Job& job_;
  std::int64_t leading_, residual_stride_, tangent_stride_, count_;
  std::vector<double> slave_, master_, start_, area_, memory_, cached_;
  double* first_ = nullptr;
  ents_input input_{};
  ents_output output_{};
};

} // namespace

void run_streaming(std::ostream& out, std::int64_t most) {
  out << "residual and tangent in array calls, frictionless; ns per element (thread CPU time, medians of "
      << turns
      << " in turns)\n"
         "memory: one call for all, results one behind the other; plain, past: their bytes alone, stored to "
         "the same "
         "memory through the caches and past them; % stores: what the faster of the two would take\n"
         "reused: calls of "
      << per_call
      << ", results in the same places; copied: the same, each call's results then copied to main memory\n"
         "slope: of log time over log n, n = 10^2 .. "
      << most << "\n\n"
      << std::setw(71) << "memory" << std::setw(26) << "reused"
      << "\n"
      << std::setw(31) << "n" << std::setw(7) << "bytes" << std::setw(7) << "plain" << std::setw(7) << "past"
      << std::setw(9) << "ns" << std::setw(10) << "% stores" << std::setw(8) << "slope" << std::setw(8)
      << "copied"
      << "  ";
  std::vector<std::int64_t> sizes;
  for (std::int64_t n = 100; n <= most; n *= 10) {
    sizes.push_back(n);
    out << std::setw(6) << "10^" << sizes.size() + 1 << " ";
  }
  out << std::setw(7) << "slope"
      << "\n";
  most = sizes.back();
  std::vector<Kind> kinds;
  for (const char* basis : {"line2", "tri3", "quad4", "quad9"})
    for (const bool enriched : {false, true}) {
      kinds.push_back({basis, enriched, 0});
      if (kinds.back().basis == "quad4") kinds.push_back({basis, enriched, 1});
    }
  for (const Kind& kind : kinds) {
    const Job job({kind.basis, kind.enriched ? "enriched" : "plain", "RK", Call::various});
    Elements elements(job, kind.padding, most);
    std::vector<std::function<void()>> pieces{[&] { elements.store(); }, [&] { elements.store_past(); }};
    std::vector<double> counts;
    for (std::int64_t n : sizes) {
      n = std::min(n, elements.count());
      counts.push_back(static_cast<double>(n));
      pieces.push_back([&elements, n] { elements.reuse(n); });
      pieces.push_back([&elements, n] { elements.stream(n); });
    }
    pieces.push_back([&elements] { elements.copy(elements.count()); });
    const std::vector<double> seconds = interleaved_seconds(pieces, turns);
    std::vector<double> reused, streamed;
    for (std::size_t i = 0; i < sizes.size(); ++i) {
      reused.push_back(seconds[2 + 2 * i]);
      streamed.push_back(seconds[3 + 2 * i]);
    }
    const double plain = 1e9 * seconds[0] / static_cast<double>(elements.count()),
                 past = 1e9 * seconds[1] / static_cast<double>(elements.count()),
                 memory = 1e9 * streamed.back() / counts.back();
    out << std::left << std::setw(22)
        << kind.basis + (kind.enriched ? " enriched" : " plain") + (kind.padding ? ", padded" : "")
        << std::right << std::fixed << std::setprecision(0) << std::setw(9) << counts.back() << std::setw(7)
        << elements.bytes() << std::setw(7) << plain << std::setw(7) << past << std::setw(9) << memory
        << std::setw(10) << 100.0 * std::min(plain, past) / memory << std::setprecision(2) << std::setw(8)
        << slope(counts, streamed) << std::setprecision(0) << std::setw(8)
        << 1e9 * seconds.back() / static_cast<double>(elements.count()) << std::setprecision(1) << "  ";
    for (std::size_t i = 0; i < sizes.size(); ++i) out << std::setw(8) << 1e9 * reused[i] / counts[i];
    out << std::setprecision(2) << std::setw(8) << slope(counts, reused) << std::endl;
  }
}

} // namespace bench
