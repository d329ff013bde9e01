// SPDX-License-Identifier: BSD-3-Clause
#include "abi/read/height_registry.hpp"

#include <algorithm>
#include <limits>
#include <memory>
#include <mutex>
#include <utility>

#include "core/numbers/fingerprint.hpp"

namespace ents {

namespace {

// The only thing in the library that changes while it is used: models copy what they need when they are made.
struct Registry {
  std::mutex mutex;
  std::vector<RegisteredHeight> heights;
};
Registry& registry() {
  static Registry one;
  return one;
}

struct Callback {
  RegisteredHeight of;
  CallbackBounds bounds;
};

void callback_jets(const ExternalHeight& height, std::int32_t order, std::int32_t count, const double* s,
                   double* jet) {
  const Callback& callback = *static_cast<const Callback*>(height.data);
  if (callback.of.function(callback.of.user_data, order, count, s, jet) == 0) return;
  const int numbers = callback.of.dimension == 1 ? order + 1 : (order + 1) * (order + 2) / 2;
  std::fill_n(jet, numbers * count, std::numeric_limits<double>::quiet_NaN());
}

void callback_ranges(const ExternalHeight& height, const double*, const double*, double* least,
                     double* most) {
  const Callback& callback = *static_cast<const Callback*>(height.data);
  const int slopes = callback.of.dimension, curvatures = callback.of.dimension == 1 ? 1 : 3,
            numbers = callback.of.dimension == 1 ? 4 : 10;
  for (int i = 0; i < numbers; ++i) {
    most[i] = i == 0                     ? callback.bounds.height
              : i <= slopes              ? callback.bounds.slope
              : i <= slopes + curvatures ? callback.bounds.curvature
                                         : ExternalHeight::no_range;
    least[i] = -most[i];
  }
}

} // namespace

bool register_height(const RegisteredHeight& height) {
  Registry& r = registry();
  const std::lock_guard<std::mutex> lock(r.mutex);
  const auto same = [&](const RegisteredHeight& other) {
    return other.name == height.name && other.dimension == height.dimension;
  };
  std::erase_if(r.heights, same);
  if (!height.function) return true;
  if (r.heights.size() >= most_registered_heights) return false;
  r.heights.push_back(height);
  return true;
}

bool find_registered_height(std::string_view name, std::int32_t dimension, RegisteredHeight& height,
                            std::vector<std::string>& known) {
  Registry& r = registry();
  const std::lock_guard<std::mutex> lock(r.mutex);
  for (const RegisteredHeight& one : r.heights) {
    if (one.dimension != dimension) continue;
    if (one.name == name) {
      height = one;
      return true;
    }
    known.push_back(one.name);
  }
  return false;
}

Height callback_height(const RegisteredHeight& registered, const CallbackBounds& bounds) {
  ExternalSource source;
  source.dimension = registered.dimension;
  source.jets = callback_jets;
  source.ranges = callback_ranges;
  source.data = std::make_shared<const Callback>(Callback{registered, bounds});
  source.bound = bounds.height < ExternalHeight::no_range ? bounds.height : Height::unbounded;
  for (int a = 0; a < 2; ++a) source.feature_length[a] = bounds.feature_length[a];
  Fingerprint print; // functions of different names are different heights
  for (const char c : registered.name) print.add(static_cast<double>(c));
  for (const double bound : {bounds.height, bounds.slope, bounds.curvature}) print.add(bound);
  source.stamp = print.number();
  return Height::external(std::move(source));
}

} // namespace ents
